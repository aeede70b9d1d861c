//! The way to the kerb near a goal, found at the start and anew when it turns out otherwise.

use simworld_core::control::Driver;
use simworld_core::geometry::{Point2, Vector2, direction, yaw_of};
use simworld_core::id::{LaneId, RoadId};
use simworld_core::net::{LaneDirection, RoadNetwork, polyline};
use simworld_core::scene::{EntityRef, Scene};

use super::change::Change;
use super::kerb::{self, Berth};
use super::route::{From, Lanes, Way, is_closed, way};
use super::watch::Own;
use super::{CannotArrive, Driving};
use crate::lanes::{OnLane, lane, lane_at, leg_of, nearest_lane, nearest_lane_where};

/// Length over which a car of this length pulls in to the kerb, m; longer ones take as much more, so that their nose does not swing
/// over the kerb.
const PULL_IN: f64 = 16.0;
const CAR: f64 = 4.5;
/// One sees who stands at a place at the kerb from so near, m, looks each so many ticks, and turns away no more when one is
/// almost in it, m.
const IN_VIEW: f64 = 50.0;
const LOOKS: u64 = 10;
const ALMOST_IN: f64 = 5.0;
/// Lanes farther away than this are no part of the way, m: one drives over open ground.
const OFF_ROAD: f64 = 60.0;
/// Who stands so far beside a lane looks into the mirror before joining it, m.
const BESIDE: f64 = 1.2;

/// What a way is to be.
#[derive(Clone, Debug)]
pub(super) struct Wish {
    pub(super) goal: Point2,
    /// Legs that are left out, by their first lanes.
    pub(super) closed: Vec<LaneId>,
    /// By which lanes the first leg may be left.
    pub(super) lanes: Lanes,
    /// The lane where one is, if one knows, and how far one stays in it, m.
    pub(super) on: Option<(LaneId, f64)>,
    /// Why one drives otherwise than before, if one does.
    pub(super) why: Option<&'static str>,
}

impl Wish {
    pub(super) fn to(goal: Point2) -> Self {
        Self { goal, closed: Vec::new(), lanes: Lanes::All, on: None, why: None }
    }
}

impl Driving {
    /// The way from where a vehicle stands to the kerb near a goal.
    pub(super) fn new(
        scene: &dyn Scene,
        vehicle: &EntityRef<'_>,
        own: &Own<'_>,
        wish: Wish,
    ) -> Result<Self, CannotArrive> {
        let Wish { goal, .. } = wish;
        let on_roads = scene.roads().and_then(|network| {
            let from = start(network, vehicle, own, &wish)?;
            let to = nearest_open(scene, network, goal, from.lane)?;
            (from.distance.min(to.distance) <= OFF_ROAD).then_some((network, from, to))
        });
        let (mut found, berth) = match on_roads {
            Some((network, from, to)) => by_road(scene, network, own, (&from, &to), &wish)
                .map(|(way, berth)| (way, Some(berth)))
                .ok_or_else(|| no_way(scene, network, (own.at, goal)))?,
            None => (Way { path: vec![own.at, goal], ..Way::default() }, None),
        };
        // A piece of no length has no sides.
        found.path.dedup_by(|a, b| (*a - *b).norm() < 1e-6);
        Ok(Self {
            goal,
            berth,
            path: found.path,
            lines: found.lines,
            limits: found.limits,
            changes: found.changes,
            driver: Driver::of_length(own.half_length * 2.0),
            station: 0.0,
            best: 0.0,
            idle: 0.0,
            tries: 0,
            stuck_at: 0.0,
            backing: 0.0,
            turning: None,
            is_held: false,
            closed: wish.closed,
            news: wish.why,
        })
    }

    /// Goes on by another way to the same goal; what one has stood and tried is not forgotten.
    pub(super) fn renew(
        &mut self,
        scene: &dyn Scene,
        vehicle: &EntityRef<'_>,
        own: &Own<'_>,
        mut wish: Wish,
    ) -> Result<(), CannotArrive> {
        // On the way across a junction one is in no lane: the next is the one behind it.
        let across = self.lines.iter().rfind(|line| line.is_passed && wish.on.is_none());
        if let Some((line, network)) = across.zip(scene.roads()) {
            wish.on = Some((network.connections[line.turn.index()].to, 0.0));
        }
        let mut found = Self::new(scene, vehicle, own, wish)?;
        (found.driver, found.tries, found.idle) = (self.driver, self.tries, self.idle);
        for line in &mut found.lines {
            if let Some(known) = self.lines.iter().find(|known| known.turn == line.turn) {
                line.waited = known.waited;
            }
        }
        if let (Some(change), Some(known)) = (found.changes.first_mut(), self.changes.first())
            && change.to == known.to
        {
            change.waited = known.waited;
        }
        *self = found;
        Ok(())
    }

    /// Takes another way when a street ahead is closed.
    pub(super) fn mind_closures(
        &mut self,
        scene: &dyn Scene,
        vehicle: &EntityRef<'_>,
        own: &Own<'_>,
    ) -> Result<(), CannotArrive> {
        let Some(network) = scene.roads().filter(|_| scene.clock().tick().0.is_multiple_of(LOOKS)) else {
            return Ok(());
        };
        // Who is on the way across goes on: the street is left at its end.
        let ahead = self.lines.iter().filter(|line| !line.is_passed);
        let mut into = ahead.map(|line| network.connections[line.turn.index()].to);
        if into.any(|lane| is_closed(scene, network, lane)) {
            let why = Some("a street ahead is closed");
            self.renew(
                scene,
                vehicle,
                own,
                Wish { closed: self.closed.clone(), why, ..Wish::to(self.goal) },
            )?;
        }
        Ok(())
    }

    /// Looks for another place at the kerb when somebody has taken the one that one is coming to.
    pub(super) fn mind_berth(
        &mut self,
        scene: &dyn Scene,
        vehicle: &EntityRef<'_>,
        own: &Own<'_>,
    ) -> Result<(), CannotArrive> {
        let left = polyline::length(&self.path) - self.station;
        let Some((berth, network)) = self.berth.zip(scene.roads()) else { return Ok(()) };
        // In a turn one goes on as one is: a new path would begin across it. A rear that is still in it makes no difference.
        let in_last_lane = self.lines.iter().all(|line| line.is_behind(network, self.station));
        let looks = in_last_lane
            && (ALMOST_IN..IN_VIEW).contains(&left)
            && scene.clock().tick().0.is_multiple_of(LOOKS);
        if !looks || berth.aside <= 0.0 || berth.is_free(scene, network, own.ids, own.size()) {
            return Ok(());
        }
        let why = Some("the place at the kerb is taken");
        self.renew(scene, vehicle, own, Wish { closed: self.closed.clone(), why, ..Wish::to(self.goal) })
    }
}

/// The lane where one is.
fn start(network: &RoadNetwork, vehicle: &EntityRef<'_>, own: &Own<'_>, wish: &Wish) -> Option<OnLane> {
    if let Some((id, _)) = wish.on {
        let near = polyline::closest(&lane(network, id).path, &own.at)?;
        return Some(OnLane { lane: id, station: near.station, distance: near.distance });
    }
    let heading = yaw_of(vehicle.pose);
    lane_at(network, own.at, Some(heading)).or_else(|| nearest_lane(network, own.at, None))
}

/// The place nearest to a goal on a street that one may enter, or is in. Where that is a walk away, it is the closed street itself,
/// to which no way leads.
fn nearest_open(scene: &dyn Scene, network: &RoadNetwork, goal: Point2, own: LaneId) -> Option<OnLane> {
    let own = leg_of(network, own);
    let is_open = |id| leg_of(network, id) == own || !is_closed(scene, network, id);
    let nearest = nearest_lane(network, goal, None)?;
    if is_open(nearest.lane) {
        return Some(nearest);
    }
    let open = nearest_lane_where(network, goal, None, &is_open);
    open.filter(|open| open.distance <= nearest.distance + OFF_ROAD).or(Some(nearest))
}

/// Why no way was found.
fn no_way(scene: &dyn Scene, network: &RoadNetwork, (from, to): (Point2, Point2)) -> CannotArrive {
    let legs = |road: usize| {
        [LaneDirection::Forward, LaneDirection::Backward].map(|way| (RoadId::from_index(road), way))
    };
    let closed = (0..network.roads.len()).flat_map(legs).filter(|leg| scene.is_closed(*leg)).count();
    if closed > 0 { CannotArrive::Closed { from, to, closed } } else { CannotArrive::NoWay { from, to } }
}

fn by_road(
    scene: &dyn Scene,
    network: &RoadNetwork,
    own: &Own<'_>,
    (from, to): (&OnLane, &OnLane),
    wish: &Wish,
) -> Option<(Way, Berth)> {
    // What one has passed is not gone back to, and nobody begins to pull in within the turn before a lane.
    let pull = PULL_IN * longer_than_a_car(own.half_length * 2.0);
    let is_ahead = to.lane == from.lane && to.station > from.station;
    let first = if is_ahead { from.station + pull } else { pull };
    let berth = kerb::berth(scene, network, own.ids, (to, first), own.size());
    // From beside the lane one joins it some way ahead.
    let join = match from.distance {
        // Before its begin one is in a junction.
        _ if from.station < 0.01 => 2.0,
        distance if distance > 0.5 => 6.0 + 2.0 * distance,
        _ => 0.0,
    };
    let length = lane(network, from.lane).length;
    let entry = OnLane { station: (from.station + join).min(length), ..*from };
    let hold = wish.on.map_or(2.0, |(_, hold)| hold);
    // Who is in the lane begins in its middle: a first piece across it would have all behind beside one.
    let at = if join > 0.0 { own.at } else { polyline::at(&lane(network, entry.lane).path, entry.station).0 };
    let begin = From { on: &entry, at, hold, lanes: wish.lanes };
    let is_shut = |leg| is_closed(scene, network, leg);
    let mut found = way(network, &begin, &berth.on, &|leg| wish.closed.contains(&leg) || is_shut(leg))
        .or_else(|| way(network, &begin, &berth.on, &is_shut))?;
    if from.distance > BESIDE && own.speed < 1.0 {
        let mirror = Change {
            begin: 0.0,
            end: join,
            latest: 0.0,
            from: from.lane,
            to: from.lane,
            is_begun: false,
            waited: 0.0,
        };
        found.changes.insert(0, mirror);
    }
    // On a short lane there may be less room.
    let has_room = to.lane == from.lane || berth.on.station >= pull;
    pull_in(&mut found.path, berth.aside, if has_room { pull } else { PULL_IN });
    Some((found, berth))
}

/// How many times as long as a car a vehicle is, at least once.
pub(super) fn longer_than_a_car(length: f64) -> f64 {
    (length / CAR).max(1.0)
}

/// Bends the end of a path to the right, by so much, m, over such a length, m.
fn pull_in(path: &mut Vec<Point2>, aside: f64, over: f64) {
    const POINTS: u32 = 16;
    if aside <= 0.0 {
        return;
    }
    let length = polyline::length(path);
    let begin = (length - over).max(0.0);
    let mut bent = polyline::slice(path, 0.0, begin);
    for step in 1..=POINTS {
        let share = f64::from(step) / f64::from(POINTS);
        let (point, heading) = polyline::at(path, begin + (length - begin) * share);
        let ahead = direction(heading);
        // One is at the kerb after two thirds of the way, and straightens up on the last.
        let eased = smooth((share * 1.5).min(1.0));
        bent.push(point + Vector2::new(ahead.y, -ahead.x) * (aside * eased));
    }
    *path = bent;
}

/// From 0 to 1 without corners.
pub(super) fn smooth(share: f64) -> f64 {
    share * share * (3.0 - 2.0 * share)
}
