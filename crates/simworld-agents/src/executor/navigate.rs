//! Navigation: from waypoint to waypoint to the goal.

mod stuck;

use std::cell::RefCell;

use serde::{Deserialize, Serialize};
use simworld_core::action::Action;
use simworld_core::geometry::{Point2, direction, heading, yaw_of};
use simworld_core::id::{CrossingId, EntityId, WaypointId};
use simworld_core::net::{Route, RouteScratch, WaypointGraph, polyline};
use simworld_core::ops::wrap_angle;
use simworld_core::scene::{EntityRef, Scene};
use simworld_core::seam::Goal;

use super::ground::{self, Ground, MARGINS};
use super::{RuleExecutor, Stage, avoid, crossing};

/// A goal that moves farther than this is looked for anew on the roads, m.
pub(super) const FOLLOWED: f64 = 10.0;
/// A waypoint counts as passed within this distance, m.
const PASSED: f64 = 0.7;
/// A corner on the way round something solid counts as passed within this distance, m.
const ROUNDED: f64 = 0.25;
/// Heading errors below this are left alone, radians.
const STRAIGHT: f64 = 0.03;
/// With a larger heading error one turns on the spot, radians.
const FACING: f64 = 1.0;
/// With a larger heading error one goes no faster than `TURNING`, radians.
const BEARING: f64 = 0.3;
/// Speed at which anybody turns within the width of a sidewalk, m/s.
const TURNING: f64 = 1.4;
/// A place nearer than this is gone to over the ground if it is not straight ahead, m: no walkway leads there sooner.
const SHORT: f64 = 8.0;
/// Coming nearer by less than this is no progress, m.
const PROGRESS: f64 = 0.25;
/// How long an evasion lasts, s.
const EVASION: f64 = 1.2;
/// How far an evasion turns away from the goal, radians.
const EVASION_ANGLE: f64 = 1.1;

/// A place to pass.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
struct Leg {
    point: Point2,
    /// The crossing on the way to it, if there is one.
    crossing: Option<CrossingId>,
    footing: Footing,
}

/// What one walks on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
enum Footing {
    /// Sidewalks and crossings, kept free for those who walk, or the straight way.
    Walkway,
    /// Ground where things stand; the way leads round them.
    Open,
}

impl Leg {
    fn open(point: Point2) -> Self {
        Self { point, crossing: None, footing: Footing::Open }
    }

    /// How near one comes to its end before one goes on.
    const fn passed_within(&self) -> f64 {
        match self.footing {
            Footing::Walkway => PASSED,
            Footing::Open => ROUNDED,
        }
    }
}

/// A way being gone.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Navigation {
    legs: Vec<Leg>,
    next: usize,
    /// Where the goal was when the way was found.
    goal: Point2,
    /// Whether the crossing on the leg under way was begun, and the time at its kerb so far, s.
    crossing_begun: bool,
    at_kerb: f64,
    /// The least distance to the next place so far, m, and how long ago that was, s.
    least: f64,
    idle: f64,
    /// How often it was stuck, less what came on since, and in all; what is left of the evasion, s.
    stuck: u32,
    jams: u32,
    evading: f64,
    /// Waypoints that it did not get to.
    shut: Vec<WaypointId>,
}

/// Where a goal is by now.
pub(super) struct Destination {
    pub(super) point: Point2,
    /// How far it still is, m.
    pub(super) distance: f64,
    /// The thing itself, if one goes up to it and not to its door.
    thing: Option<EntityId>,
}

/// How a navigation stands.
pub(super) enum Arrival {
    Underway,
    There,
    Lost(String),
}

impl Navigation {
    fn along(legs: Vec<Leg>, goal: Point2) -> Self {
        Self {
            legs,
            next: 0,
            goal,
            crossing_begun: false,
            at_kerb: 0.0,
            least: f64::INFINITY,
            idle: 0.0,
            stuck: 0,
            jams: 0,
            evading: 0.0,
            shut: Vec::new(),
        }
    }

    /// Moves on to the next place.
    fn pass(&mut self) {
        self.next += 1;
        self.crossing_begun = false;
        self.at_kerb = 0.0;
        self.least = f64::INFINITY;
        self.idle = 0.0;
        // Progress makes up for an earlier jam, but not for all of them: who goes in circles gives up some day.
        self.stuck = self.stuck.saturating_sub(1);
    }
}

impl RuleExecutor {
    pub(super) fn navigate(
        &mut self,
        scene: &dyn Scene,
        me: &EntityRef<'_>,
        to: Goal,
        within: f64,
        speed: f64,
        out: &mut Vec<Action>,
    ) -> Arrival {
        let here = me.planar();
        let Some(destination) = Destination::of(scene, to, here) else {
            return Arrival::Lost(format!("{to:?} is gone"));
        };
        if destination.distance <= within {
            return Arrival::There;
        }
        if let Some(bond) = me.attachment {
            return Arrival::Lost(format!("cannot walk off {}: get up or out first", bond.parent));
        }
        let goal = destination.point;
        let mut way = match std::mem::take(&mut self.state.stage) {
            // Who walked on is followed on the roads as well.
            Stage::Navigating(way) if way.crossing_begun || (goal - way.goal).norm() <= FOLLOWED => way,
            _ => Navigation::along(self.find_way(scene, me, goal, &[]), goal),
        };
        if let Some(last) = way.legs.last_mut() {
            last.point = goal;
        }
        let arrival = self.follow(scene, me, &mut way, &destination, speed, out);
        self.state.stage = Stage::Navigating(way);
        arrival
    }

    fn follow(
        &mut self,
        scene: &dyn Scene,
        me: &EntityRef<'_>,
        way: &mut Navigation,
        destination: &Destination,
        speed: f64,
        out: &mut Vec<Action>,
    ) -> Arrival {
        let (here, dt) = (me.planar(), scene.clock().dt());
        while let Some(leg) = way.legs.get(way.next)
            && way.next + 1 < way.legs.len()
            && (leg.point - here).norm() < leg.passed_within()
        {
            way.pass();
        }
        let leg = way.legs[way.next];
        if let Some(id) = leg.crossing.filter(|_| !way.crossing_begun) {
            if !crossing::may_begin(scene, me, id, leg.point, speed) {
                return self.wait_at_kerb(way, me, leg.point, dt, out);
            }
            way.crossing_begun = true;
        }
        let distance = (leg.point - here).norm();
        if distance < way.least - PROGRESS {
            way.least = distance;
            way.idle = 0.0;
        } else {
            way.idle += dt;
        }
        if way.idle > self.config.patience
            && let Some(arrival) = self.unstick(scene, me, way)
        {
            return arrival;
        }
        way.evading = (way.evading - dt).max(0.0);
        let aside = if way.evading > 0.0 {
            // Alternate sides from one evasion to the next.
            if way.stuck.is_multiple_of(2) { EVASION_ANGLE } else { -EVASION_ANGLE }
        } else {
            // The way over open ground leads round what stands there already.
            let who = if leg.footing == Footing::Open { avoid::Whom::Movers } else { avoid::Whom::All };
            avoid::detour(scene, me, leg.point, destination.thing, (self.config.look_ahead, who))
        };
        let aside = self.on_the_walkway(scene, here, way, leg.point, aside);
        let error = face(me, leg.point, aside, out);
        // Turning on the spot beats a wide circle round the waypoint, and who turns at speed swings off the kerb.
        let pace = match error.abs() {
            error if error > FACING => 0.0,
            error if error > BEARING || aside != 0.0 => speed.min(TURNING),
            _ => speed,
        };
        let pace = match way.legs.get(way.next + 1) {
            None => slow_for(pace, 0.0, destination.distance),
            Some(next) if next.crossing.is_some() || turns(here, leg.point, next.point) => {
                slow_for(pace, TURNING, distance)
            }
            Some(_) => pace,
        };
        self.tell_speed(pace, out);
        Arrival::Underway
    }

    /// How far to the left of the way to a point one turns aside, radians: as wished, but not off a kerb.
    fn on_the_walkway(
        &self,
        scene: &dyn Scene,
        here: Point2,
        way: &Navigation,
        point: Point2,
        wished: f64,
    ) -> f64 {
        if wished == 0.0 || way.crossing_begun {
            return wished;
        }
        let ahead = heading(&(point - here));
        let is_kept = |aside: &f64| !self.is_off_kerb(scene, here + direction(ahead + aside));
        [wished, -wished].into_iter().find(is_kept).unwrap_or(0.0)
    }

    /// Whether a place is on a crossing that begins nearby.
    fn is_off_kerb(&self, scene: &dyn Scene, at: Point2) -> bool {
        let (Some(roads), Some(ways)) = (scene.roads(), &self.ways) else { return false };
        let Some(nearest) = ways.nearest(at) else { return false };
        let beside = ways.edges(nearest).iter().flat_map(|edge| ways.edges(edge.to));
        let mut crossings = ways.edges(nearest).iter().chain(beside).filter_map(|edge| edge.crossing);
        crossings.any(|id| {
            let Some(crossing) = roads.crossings.get(id.index()) else { return false };
            let length = (crossing.end - crossing.start).norm();
            polyline::closest(&[crossing.start, crossing.end], &at).is_some_and(|near| {
                near.station > 0.0 && near.station < length && near.distance < crossing.width
            })
        })
    }

    /// Stands and looks across.
    fn wait_at_kerb(
        &mut self,
        way: &mut Navigation,
        me: &EntityRef<'_>,
        across: Point2,
        dt: f64,
        out: &mut Vec<Action>,
    ) -> Arrival {
        way.at_kerb += dt;
        if way.at_kerb > self.config.kerb_patience {
            let (here, waited) = (me.planar(), self.config.kerb_patience);
            let reason = format!("could not cross at ({:.1}, {:.1}) for {waited:.0} s", here.x, here.y);
            return Arrival::Lost(reason);
        }
        face(me, across, 0.0, out);
        self.tell_speed(0.0, out);
        Arrival::Underway
    }

    /// The places to pass from where one is to the goal, the goal last; by none of some waypoints, if it can be done without.
    fn find_way(&self, scene: &dyn Scene, me: &EntityRef<'_>, goal: Point2, shut: &[WaypointId]) -> Vec<Leg> {
        let here = me.planar();
        let Some(ways) = &self.ways else { return over_ground(scene, me, here, goal) };
        let (Some(from), Some(to)) = (ways.nearest(here), ways.nearest(goal)) else {
            return over_ground(scene, me, here, goal);
        };
        // In open country the walkways are few: who is nearer to the goal than to them goes straight there.
        let position = |waypoint| ways.waypoint(waypoint).position;
        let round = (position(from) - here).norm() + (position(to) - goal).norm();
        if scene.ground().is_some() && (goal - here).norm() <= round {
            return over_ground(scene, me, here, goal);
        }
        if (goal - here).norm() <= SHORT && ground::is_blocked(scene, me, here, goal) {
            let legs = over_ground(scene, me, here, goal);
            if legs.len() > 1 {
                return legs;
            }
        }
        let out = walkway_from(scene, me, ways, here, from);
        let back = walkway_from(scene, me, ways, goal, to);
        let ends = [&out, &back].map(|way| way.as_ref().map(|(waypoint, _)| *waypoint));
        let mut legs: Vec<Leg> = out.into_iter().flat_map(|(_, points)| points).map(Leg::open).collect();
        let between = [ends[0].unwrap_or(from), ends[1].unwrap_or(to)];
        walk_along(ways, between, shut, |route| {
            let from = ends[0].map_or(here, |waypoint| ways.waypoint(waypoint).position);
            let to = ends[1].map_or(goal, |waypoint| ways.waypoint(waypoint).position);
            let mut before: Option<WaypointId> = None;
            for waypoint in trimmed(ways, route, from, to) {
                let crossing = before.and_then(|b| ways.edge(b, *waypoint)).and_then(|edge| edge.crossing);
                let point = ways.waypoint(*waypoint).position;
                legs.push(Leg { point, crossing, footing: Footing::Walkway });
                before = Some(*waypoint);
            }
        });
        let footing = if let Some((_, mut points)) = back {
            // From the goal to the walkway, so the other way round.
            points.reverse();
            legs.extend(points.into_iter().map(Leg::open));
            Footing::Open
        } else {
            Footing::Walkway
        };
        legs.push(Leg { point: goal, crossing: None, footing });
        legs
    }
}

thread_local! {
    /// The memory of searches. It is as large as the network, so that one for each agent would not fit into the memory of a
    /// machine with a city of ten thousand; nothing of a search is left for the next.
    static SEARCH: RefCell<(RouteScratch, Route)> = RefCell::default();
}

/// Hands over the waypoints of the shortest route, if there is one; of one without those that are shut, if there is any.
fn walk_along(
    ways: &WaypointGraph,
    [from, to]: [WaypointId; 2],
    shut: &[WaypointId],
    walk: impl FnOnce(&[WaypointId]),
) {
    SEARCH.with_borrow_mut(|(scratch, route)| {
        if ways.route_avoiding(from, to, shut, scratch, route) || ways.route(from, to, scratch, route) {
            walk(&route.waypoints);
        }
    });
}

/// A straight way, or one over the ground if something stands in between.
fn over_ground(scene: &dyn Scene, me: &EntityRef<'_>, here: Point2, goal: Point2) -> Vec<Leg> {
    let straight = Leg { point: goal, crossing: None, footing: Footing::Walkway };
    if !ground::is_blocked(scene, me, here, goal) {
        return vec![straight];
    }
    let found = MARGINS
        .iter()
        .find_map(|margin| Ground::between(scene, me, (here, goal), *margin)?.way(here, &[goal]));
    found.map_or(vec![straight], |(_, points)| points.into_iter().map(Leg::open).collect())
}

/// Where one comes to the walkways from a place, and the points to pass until there, if the straight way to the waypoint
/// nearest to it is blocked.
fn walkway_from(
    scene: &dyn Scene,
    me: &EntityRef<'_>,
    ways: &WaypointGraph,
    place: Point2,
    nearest: WaypointId,
) -> Option<(WaypointId, Vec<Point2>)> {
    let at = ways.waypoint(nearest).position;
    if !ground::is_blocked(scene, me, place, at) {
        return None;
    }
    MARGINS.iter().find_map(|margin| {
        let ground = Ground::between(scene, me, (place, at), *margin)?;
        let inside: Vec<(WaypointId, Point2)> = (0..ways.waypoints().len())
            .map(|index| (WaypointId::from_index(index), ways.waypoints()[index].position))
            .filter(|(_, at)| ground.holds(*at))
            .collect();
        let places: Vec<Point2> = inside.iter().map(|(_, at)| *at).collect();
        let (index, points) = ground.way(place, &places)?;
        Some((inside[index].0, points))
    })
}

/// Turns towards a point, `aside` radians to its left; returns the heading error.
fn face(me: &EntityRef<'_>, point: Point2, aside: f64, out: &mut Vec<Action>) -> f64 {
    let error = wrap_angle(heading(&(point - me.planar())) + aside - yaw_of(me.pose));
    if error.abs() > STRAIGHT {
        out.push(Action::Rotate { angle: error });
    }
    error
}

/// The route less a first and a last waypoint that would mean going back; crossings are never cut short.
fn trimmed<'a>(
    ways: &WaypointGraph,
    route: &'a [WaypointId],
    here: Point2,
    goal: Point2,
) -> &'a [WaypointId] {
    let position = |id: WaypointId| ways.waypoint(id).position;
    let is_walkway = |a, b| ways.edge(a, b).is_some_and(|edge| edge.crossing.is_none());
    let mut route = route;
    if let [first, second, ..] = route
        && is_walkway(*first, *second)
        && (position(*second) - here).norm() <= (position(*second) - position(*first)).norm()
    {
        route = &route[1..];
    }
    if let [.., before, last] = route
        && is_walkway(*before, *last)
        && (position(*before) - goal).norm() <= (position(*before) - position(*last)).norm()
    {
        route = &route[..route.len() - 1];
    }
    route
}

impl Destination {
    /// Where a goal is, seen from `here`; `None` if it is gone.
    pub(super) fn of(scene: &dyn Scene, goal: Goal, here: Point2) -> Option<Self> {
        let at = |point: Point2| Self { point, distance: (point - here).norm(), thing: None };
        match goal {
            Goal::Point(point) => Some(at(point.xy())),
            Goal::Entity(id) => {
                let entity = scene.entity(id)?;
                Some(match entity.access_point() {
                    Some(access) => at(access.xy()),
                    // Without a door one goes up to the thing, from whatever side.
                    None => Self {
                        point: entity.planar(),
                        distance: entity.info.shape.planar_distance(entity.pose, &here),
                        thing: Some(id),
                    },
                })
            }
            _ => None,
        }
    }
}

/// Whether a way bends at a place by so much that one slows down for it.
fn turns(here: Point2, at: Point2, next: Point2) -> bool {
    wrap_angle(heading(&(next - at)) - heading(&(at - here))).abs() > BEARING
}

/// Speed at which one comes to a place, so far away, at no more than `there`: riders brake before it; walkers stop at once.
fn slow_for(speed: f64, there: f64, distance: f64) -> f64 {
    /// Comfortable braking, m/s².
    const BRAKING: f64 = 1.5;
    let arriving = (there * there + 2.0 * BRAKING * distance).sqrt();
    // In quarters of a metre a second, so that the body is not told anew every step.
    speed.min(((arriving * 4.0).ceil() * 0.25).max(0.5))
}
