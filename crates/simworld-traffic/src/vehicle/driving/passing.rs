//! Passing what stands on a lane: on streets of one lane each way drivers get round a cone, a breakdown or works over the oncoming lane.
//!
//! Who has stood behind it for a while [looks](begin) whether the oncoming lane is free for as long as it takes to go out, past and back.
//! If it is, one stays in the queue of one's own lane, moves aside as in a change of lanes, and minds what stands there no more once one is
//! beside the way past it. The stretch of the oncoming lane is kept free meanwhile: to those who come it is a body that stands on their
//! lane. Who has been let wait for long asks one who comes to let him out. All that is decided before a step by one thread, for the two lanes
//! may be in two parts; in the step everybody only looks at it.
//!
//! Nobody goes back once out: the stretch is kept until one is in one's own lane again.

mod barrier;
mod begin;

use serde::{Deserialize, Serialize};
use simworld_core::hash::StateHasher;

use super::lane_change::{STEEPNESS, sideways};
use crate::vehicle::clock::Moment;
use crate::vehicle::foreign::strangers::of_track;
use crate::vehicle::manager::{NONE, STANDING, Vehicle, VehicleManager};
use crate::vehicle::tracks::{Obstacle, Track, Tracks};
use crate::{Counters, TrafficConfig};

/// Who is out on the oncoming lane goes no faster, m/s; ours, 18 km/h, as past works.
pub(super) const PASSING_SPEED: f64 = 5.0;
/// Who comes up to something that stands, and may get round it, stops so far before it, m: enough to get 2.5 m aside on the way.
pub(in crate::vehicle) const ROOM: f64 = 10.0;
/// Who stands nearer than that gets out by going to and fro: as much aside as he gets at this speed, m/s.
const SHUNTING: f64 = 1.0;
/// Room beside what is passed, and behind it before one turns in again, m.
const TO_SIDE: f64 = 0.4;
const BEHIND: f64 = 1.0;
/// Room beyond where one is back at the latest, m.
const SPARE: f64 = 2.0;
/// So near to the middle of its lane a body leaves the oncoming lane free, m.
const IN_LANE: f64 = 0.5;
/// The junction ahead is at least so far from where one is back, m: one who comes out of it has room to stop, and nobody turns in where others
/// wait at the line.
const JUNCTION: f64 = 12.0;
/// A shift that is so near to what was wanted is it, m: shifts have seven digits.
const NEARLY: f64 = 0.01;
/// What is on no track of the traffic's own, but keeps a lane free: it begins infinitely far beside.
const KEPT_FREE: f64 = f64::NEG_INFINITY;

/// Somebody who passes what stands on its lane.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Pass {
    /// Who, on which lane, and the lane over which it goes.
    id: u32,
    pub(in crate::vehicle) lane: Track,
    pub(in crate::vehicle) opposite: Track,
    /// Where what stands there begins and ends on its lane, m.
    pub(in crate::vehicle) near: f64,
    pub(in crate::vehicle) far: f64,
    /// How far to the left of its lane it goes, m; negative to the right.
    aside: f64,
    /// Where its front is at the latest when it is in its lane again, m.
    pub(in crate::vehicle) back: f64,
    /// The stretch of the oncoming lane that is kept free for it, m along that; and the same on its own, from back to front.
    pub(in crate::vehicle) kept: (f64, f64),
    own: (f64, f64),
    /// How many went before it one behind the other, and who of those that come lets them, or [`NONE`].
    number: u32,
    yields: u32,
}

/// Somebody who has been let wait for long, and who lets him out.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Ask {
    id: u32,
    lane: Track,
    /// Who is asked, on which lane, and where he stops, m.
    yields: u32,
    opposite: Track,
    line: f64,
}

impl Ask {
    /// Where one who is asked stops on its lane, m.
    pub(super) fn line_for(&self, vehicle: &Vehicle, lane: Track) -> Option<f64> {
        (self.yields == vehicle.id && self.opposite == lane && vehicle.s <= self.line).then_some(self.line)
    }
}

/// Who passes what stands on a lane, and who asks to.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Passings {
    pub(in crate::vehicle) list: Vec<Pass>,
    pub(in crate::vehicle) asks: Vec<Ask>,
}

impl Passings {
    #[inline]
    pub(in crate::vehicle) fn is_empty(&self) -> bool {
        self.list.is_empty() && self.asks.is_empty()
    }

    /// How a vehicle passes, if it does.
    #[inline]
    pub(in crate::vehicle) fn of(&self, id: u32) -> Option<&Pass> {
        self.list.iter().find(|pass| pass.id == id)
    }

    /// Whether somebody passes over a lane, or what stands on it.
    pub(in crate::vehicle) fn touches(&self, lane: Track) -> bool {
        self.lanes().any(|own| own == lane)
    }

    /// The lanes on which somebody passes, and those over which they go.
    pub(in crate::vehicle) fn lanes(&self) -> impl Iterator<Item = Track> {
        self.list.iter().flat_map(|pass| [pass.lane, pass.opposite])
    }

    /// Whether a lane is free for so far from its beginning, m, apart from those on it.
    pub(in crate::vehicle) fn leave_room(&self, lane: Track, way: f64) -> bool {
        self.list.iter().all(|pass| pass.opposite != lane || pass.kept.0 > way + SPARE)
    }

    /// Whether what was saved is of this network.
    pub(in crate::vehicle) fn fits(&self, tracks: &Tracks, count: usize) -> bool {
        let are_two = |lane: Track, other: Track| tracks.opposite.get(lane as usize) == Some(&other);
        let is_known = |id: u32| (id as usize) < count;
        self.list.iter().all(|pass| {
            let Pass { near, far, aside, back, kept, own, .. } = *pass;
            let stations = [near, far, aside, back, kept.0, kept.1, own.0, own.1];
            is_known(pass.id)
                && pass.opposite != NONE
                && are_two(pass.lane, pass.opposite)
                && stations.iter().all(|station| station.is_finite())
                && kept.0 < kept.1
        }) && self.asks.iter().all(|ask| {
            is_known(ask.id)
                && ask.opposite != NONE
                && are_two(ask.lane, ask.opposite)
                && ask.line.is_finite()
        })
    }

    pub(in crate::vehicle) fn state_hash(&self, hasher: &mut StateHasher) {
        for pass in &self.list {
            let Pass { id, near, far, aside, back, kept, own, number, yields, .. } = *pass;
            hasher.u64(u64::from(id)).f64(near).f64(far).f64(aside).f64(back);
            hasher.f64(kept.0).f64(kept.1).f64(own.0).f64(own.1);
            hasher.u64(u64::from(number)).u64(u64::from(yields));
        }
        for ask in &self.asks {
            hasher.u64(u64::from(ask.id)).u64(u64::from(ask.yields)).f64(ask.line);
        }
    }
}

impl Pass {
    /// Whether it is far enough aside to go by.
    pub(super) fn is_clear(&self, vehicle: &Vehicle) -> bool {
        f64::from(vehicle.shift.abs()) >= self.aside.abs() - NEARLY
    }

    /// Whether its rear is by.
    pub(super) fn is_by(&self, vehicle: &Vehicle) -> bool {
        vehicle.s - vehicle.length() > self.far + BEHIND
    }

    /// Whether it needs the oncoming lane still.
    pub(super) fn needs_lane(&self, vehicle: &Vehicle) -> bool {
        !self.is_by(vehicle) || f64::from(vehicle.shift.abs()) > IN_LANE
    }

    /// Whether a body beside it on its own lane keeps it from turning in: what stood there has moved on.
    pub(in crate::vehicle) fn is_kept_out(
        &self,
        obstacles: &[Obstacle],
        vehicle: &Vehicle,
        half_width: f64,
    ) -> bool {
        let (rear, front) = (vehicle.s - vehicle.length() - BEHIND, vehicle.s + BEHIND);
        let is_beside = |body: &Obstacle| body.near < front && body.far > rear;
        of_track(obstacles, self.lane).iter().any(|body| body.bars(half_width) && is_beside(body))
    }

    /// Whether a body on its own lane has come so far aside that it is in the way past.
    pub(in crate::vehicle) fn meets(&self, body: &Obstacle, half_width: f64) -> bool {
        let reach = if self.aside > 0.0 { body.reach.1 } else { -body.reach.0 };
        reach > self.aside.abs() - half_width - TO_SIDE * 0.5
    }

    /// The nearest of what has come on to the stretch that is kept free, m from its front.
    pub(super) fn gap_on_oncoming(
        &self,
        obstacles: &[Obstacle],
        vehicle: &Vehicle,
        half_width: f64,
    ) -> Option<f64> {
        let ((start, end), (rear, front)) = (self.kept, self.own);
        // Along the oncoming lane one comes to the end of a body first.
        let own = |station: f64| front - (front - rear) * (station - start) / (end - start);
        let bodies = of_track(obstacles, self.opposite).iter();
        let there = bodies.filter(|body| body.aside > KEPT_FREE && body.bars(half_width) && body.far > start);
        there.map(|body| own(body.far) - vehicle.s).filter(|gap| *gap >= 0.0).min_by(f64::total_cmp)
    }

    /// How far beside the middle of its lane a vehicle is after a step of `dt` s, m: nearer to the way past, or to the middle.
    fn moved(&self, vehicle: &Vehicle, stays_out: bool, dt: f64) -> f64 {
        let (now, wanted) = (f64::from(vehicle.shift.abs()), if stays_out { self.aside.abs() } else { 0.0 });
        let step = aside(vehicle.v) * dt;
        if now < wanted { (now + step).min(wanted) } else { (now - step).max(wanted) }
    }
}

/// How quickly one who passes moves aside at a speed, m/s.
fn aside(v: f64) -> f64 {
    sideways(v.max(SHUNTING))
}

/// How much of its lane a vehicle of a length takes from the end of what it passes to where it is back and the junction is far enough, m, if
/// it goes so far aside.
pub(super) fn room_behind(length: f64, aside: f64) -> f64 {
    BEHIND + length + aside / STEEPNESS + SPARE + JUNCTION
}

/// What the vehicles look at before a step.
#[derive(Clone, Copy)]
struct Mind<'a> {
    tracks: &'a Tracks,
    config: &'a TrafficConfig,
    /// Bodies on tracks that are not the traffic's own, by track and near side.
    obstacles: &'a [Obstacle],
    at: Moment,
}

impl VehicleManager {
    /// Lets those go on who pass what stands on their lanes, lets others begin to, and adds what they keep free to the bodies that are seen
    /// in this step. Where nothing stands on any lane that costs nothing.
    pub(crate) fn pass_obstacles(
        &mut self,
        tracks: &Tracks,
        config: &TrafficConfig,
        obstacles: &mut Vec<Obstacle>,
        at: Moment,
        counters: &mut Counters,
    ) {
        let stands_nothing = obstacles.is_empty()
            && self.closures.blocks.is_empty()
            && self.halts.is_empty()
            && self.controls.is_empty();
        if self.passings.is_empty() && (stands_nothing || !config.pass_obstacles) {
            return;
        }
        let mind = Mind { tracks, config, obstacles: obstacles.as_slice(), at };
        self.go_on_passing(&mind);
        if config.pass_obstacles {
            counters.obstacles_passed += self.begin_passing(&mind);
        }
        for pass in &self.passings.list {
            let vehicle = self.queue(tracks, pass.lane).iter().find(|vehicle| vehicle.id == pass.id);
            if vehicle.is_some_and(|vehicle| pass.needs_lane(vehicle)) {
                show(obstacles, pass);
            }
        }
    }

    fn go_on_passing(&mut self, mind: &Mind<'_>) {
        let mut list = std::mem::take(&mut self.passings.list);
        list.retain(|pass| self.pass_on_by(mind, pass));
        self.passings.list = list;
        let mut asks = std::mem::take(&mut self.passings.asks);
        asks.retain(|ask| {
            let asker = self.queue(mind.tracks, ask.lane).iter().find(|vehicle| vehicle.id == ask.id);
            asker.is_some_and(|asker| asker.v < STANDING && self.passings.of(ask.id).is_none())
        });
        self.passings.asks = asks;
    }

    /// Moves one aside, or back; false if it is in its lane again, or nowhere.
    fn pass_on_by(&mut self, mind: &Mind<'_>, pass: &Pass) -> bool {
        let Mind { tracks, config, obstacles, at } = *mind;
        let (queue, paths) = self.both_mut(tracks, pass.lane);
        let Some(mut rank) = queue.iter().position(|vehicle| vehicle.id == pass.id) else { return false };
        let vehicle = &mut queue[rank];
        let half_width = config.vehicle_type(vehicle.row).width * 0.5;
        let stays_out = !pass.is_by(vehicle) || pass.is_kept_out(obstacles, vehicle, half_width);
        let next = pass.moved(vehicle, stays_out, at.dt);
        let is_back = next <= 0.0 && !stays_out;
        vehicle.shift = if is_back { 0.0 } else { (next as f32).copysign(pass.aside as f32) };
        let halts = vehicle.halt.is_finite();
        // Queues are from front to back: who is by a breakdown is before it.
        while rank > 0 && queue[rank - 1].s < queue[rank].s {
            queue.swap(rank - 1, rank);
            paths.swap(rank - 1, rank);
            rank -= 1;
        }
        if is_back && halts {
            // Where it was told to halt meanwhile it did not.
            self.aim(tracks, config, pass.id);
        }
        !is_back
    }
}

/// Adds what is kept free for somebody to the bodies that are seen, in their order: those who come stop before it.
fn show(obstacles: &mut Vec<Obstacle>, pass: &Pass) {
    let (track, (near, far)) = (pass.opposite, pass.kept);
    let place = obstacles.partition_point(|body| {
        body.track < track || (body.track == track && body.near.total_cmp(&near).is_lt())
    });
    // It goes away by itself: nobody looks for a way round it.
    let body = Obstacle { track, near, far, aside: KEPT_FREE, reach: (0.0, 0.0), v: 0.0, stands: false };
    obstacles.insert(place, body);
}
