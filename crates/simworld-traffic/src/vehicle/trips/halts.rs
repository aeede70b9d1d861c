//! Halts: where vehicles stop on their way, how long they stand, and whether they go on.

use std::collections::{BTreeMap, VecDeque};

use serde::{Deserialize, Serialize};
use simworld_core::id::LaneId;

use crate::line::Stop;
use crate::vehicle::manager::{NONE, STANDING, Vehicle, VehicleManager};
use crate::vehicle::queues::path::Path;
use crate::vehicle::tracks::{Track, Tracks};
use crate::{Counters, Leg, TrafficConfig, TripEnd};

/// Who stands so near to its halt is there, m.
const AT_HALT: f64 = 2.0;

/// What comes after a halt.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) enum Then {
    GoOn,
    /// The trip ends there.
    Park,
}

/// Whether new halts come before those that there are, or after them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Order {
    First,
    Last,
}

/// One halt that is to come, or is going on.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Halt {
    /// The leg on which it is; none for the next place where one can.
    leg: Option<Leg>,
    station: f64,
    dwell: f64,
    /// When one may go on at the earliest, s.
    not_before: f64,
    /// Since when one stands there, s.
    since: Option<f64>,
    pub(in crate::vehicle) then: Then,
}

impl Halt {
    pub(crate) fn at(stop: &Stop, scheduled: f64, then: Then) -> Self {
        let not_before = if stop.not_before > 0.0 { scheduled + stop.not_before } else { 0.0 };
        Self { leg: Some(stop.leg), station: stop.station, dwell: stop.dwell, not_before, since: None, then }
    }

    /// As soon as it can, for so long.
    pub(crate) fn at_once(dwell: f64) -> Self {
        Self { leg: None, station: 0.0, dwell, not_before: 0.0, since: None, then: Then::GoOn }
    }

    /// Whether it is on that lane, ahead of a station.
    fn is_before(&self, tracks: &Tracks, lane: Track, s: f64) -> bool {
        self.leg == Some(Leg::of(&tracks.network, LaneId(lane))) && self.station > s + 0.5
    }

    fn is_over(&self, now: f64) -> bool {
        self.since.is_some_and(|since| now >= (since + self.dwell).max(self.not_before))
    }
}

/// The halts of all vehicles that have any.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Halts {
    /// By number of the vehicle, in the order in which they come.
    lists: BTreeMap<u32, VecDeque<Halt>>,
}

impl Halts {
    /// The station on a lane at which a vehicle halts next; infinite if it does not.
    pub(in crate::vehicle) fn on(
        &self,
        tracks: &Tracks,
        config: &TrafficConfig,
        vehicle: &Vehicle,
        lane: Track,
    ) -> f32 {
        let Some(halt) = self.lists.get(&vehicle.id).and_then(VecDeque::front) else { return f32::INFINITY };
        let driver = &config.vehicle_type(vehicle.row).driver;
        let stopping = vehicle.s + vehicle.v * vehicle.v / (2.0 * driver.deceleration);
        match halt.leg {
            None => (stopping + 1.0).min(tracks.length[lane as usize] - 0.5) as f32,
            Some(_) if halt.is_before(tracks, lane, vehicle.s) => halt.station as f32,
            Some(_) => f32::INFINITY,
        }
    }

    /// The first from a number on that is to park next.
    pub(super) fn next_parking(&self, from: u32) -> Option<u32> {
        let parks = |list: &VecDeque<Halt>| list.front().is_some_and(|halt| halt.then == Then::Park);
        self.lists.range(from..).find(|(_, list)| parks(list)).map(|(id, _)| *id)
    }

    /// Whether a vehicle has any.
    pub(in crate::vehicle) fn has(&self, id: u32) -> bool {
        self.lists.contains_key(&id)
    }

    /// Whether nobody has any.
    pub(in crate::vehicle) fn is_empty(&self) -> bool {
        self.lists.is_empty()
    }

    /// Whether a vehicle stands, or is about to, because it was told to at once: it broke down, or is unloaded where it is. Who stands at
    /// a stop or parks will go on, and is waited for.
    pub(in crate::vehicle) fn is_breakdown(&self, id: u32) -> bool {
        self.lists.get(&id).and_then(VecDeque::front).is_some_and(|halt| halt.leg.is_none())
    }

    /// The first from a number on that stands so.
    pub(in crate::vehicle) fn next_breakdown(&self, from: u32) -> Option<u32> {
        let stands = |list: &VecDeque<Halt>| {
            list.front().is_some_and(|halt| halt.leg.is_none() && halt.since.is_some())
        };
        self.lists.range(from..).find(|(_, list)| stands(list)).map(|(id, _)| *id)
    }

    pub(in crate::vehicle) fn remove(&mut self, id: u32) {
        self.lists.remove(&id);
    }

    /// Whether saved halts are those of vehicles that there are.
    pub(in crate::vehicle) fn fits(&self, tracks: &Tracks, count: usize) -> bool {
        let is_leg = |leg: Leg| !leg.lanes(&tracks.network).is_empty();
        let is_sound =
            |halt: &Halt| halt.leg.is_none_or(is_leg) && halt.station.is_finite() && halt.dwell >= 0.0;
        self.lists.iter().all(|(id, list)| (*id as usize) < count && list.iter().all(is_sound))
    }
}

impl VehicleManager {
    /// Who stands at a stop of theirs now: the number of the vehicle, the leg, and the station, m.
    pub(crate) fn halting(&self) -> impl Iterator<Item = (u32, Leg, f64)> {
        self.halts.lists.iter().filter_map(|(id, list)| {
            let halt = list.front().filter(|halt| halt.since.is_some())?;
            Some((*id, halt.leg?, halt.station))
        })
    }

    /// Gives a vehicle halts, after those that it has, or before them; false if there is none of that number.
    pub(crate) fn order(
        &mut self,
        tracks: &Tracks,
        config: &TrafficConfig,
        id: u32,
        halts: impl IntoIterator<Item = Halt>,
        place: Order,
    ) -> bool {
        if self.find(tracks, id).is_none() {
            return false;
        }
        let list = self.halts.lists.entry(id).or_default();
        for halt in halts {
            match place {
                Order::First => list.push_front(halt),
                Order::Last => list.push_back(halt),
            }
        }
        self.aim(tracks, config, id);
        true
    }

    /// Tells a vehicle where it halts on its lane, if it does. Who has leave to cross uses it before.
    pub(in crate::vehicle) fn aim(&mut self, tracks: &Tracks, config: &TrafficConfig, id: u32) {
        let Some((track, vehicle, _)) = self.find(tracks, id) else { return };
        let passes = self.passings.of(id).is_some();
        let has_leave = vehicle.holding != NONE && vehicle.holding == vehicle.next;
        let halt = if tracks.connection(track).is_some() || has_leave {
            f32::INFINITY
        } else {
            self.halts.on(tracks, config, vehicle, track)
        };
        let (queue, _) = self.both_mut(tracks, track);
        if let Some(vehicle) = queue.iter_mut().find(|vehicle| vehicle.id == id) {
            vehicle.halt = halt;
            if halt.is_infinite() && !passes && vehicle.shift != 0.0 && tracks.connection(track).is_none() {
                // It had begun to park and does not after all.
                self.move_in(tracks, track, id);
            }
        }
    }

    /// Those who have come to their halt stand there; those who have stood long enough go on, or are done. Stops that the way
    /// no longer leads to are given up.
    pub(in crate::vehicle) fn serve_halts(
        &mut self,
        tracks: &Tracks,
        config: &TrafficConfig,
        now: f64,
        counters: &mut Counters,
    ) {
        if self.halts.lists.is_empty() {
            return;
        }
        let mut lists = std::mem::take(&mut self.halts.lists);
        let (mut over, mut parked) = (Vec::new(), Vec::new());
        lists.retain(|id, list| {
            let (Some((track, vehicle, path)), Some(halt)) = (self.find(tracks, *id), list.front_mut())
            else {
                return false;
            };
            let is_lane = tracks.connection(track).is_none();
            if halt.since.is_none() && is_lane && vehicle.halt.is_finite() && has_stopped(vehicle) {
                halt.since = Some(now);
                counters.halts += 1;
            }
            let is_missed =
                is_lane && vehicle.halt.is_infinite() && self.misses(tracks, halt, track, vehicle, path);
            if is_missed || halt.is_over(now) {
                counters.missed_stops += u64::from(is_missed);
                if halt.then == Then::Park && !is_missed {
                    parked.push(*id);
                }
                list.pop_front();
                over.push(*id);
            }
            !list.is_empty()
        });
        self.halts.lists = lists;
        for id in over {
            self.aim(tracks, config, id);
        }
        for id in parked {
            counters.removed += u64::from(self.remove(tracks, config, id, TripEnd::Parked, now));
        }
    }

    /// Whether a vehicle will not come by a halt any more.
    fn misses(&self, tracks: &Tracks, halt: &Halt, lane: Track, vehicle: &Vehicle, path: &Path) -> bool {
        let Some(leg) = halt.leg else { return false };
        let route = self.routes.get(path.route as usize);
        let rest = route.and_then(|route| route.0.get(path.leg as usize + 1..)).unwrap_or_default();
        !halt.is_before(tracks, lane, vehicle.s) && !rest.contains(&leg)
    }
}

/// Whether a vehicle stands where it is to halt.
fn has_stopped(vehicle: &Vehicle) -> bool {
    f64::from(vehicle.halt) - vehicle.s < AT_HALT && vehicle.v < STANDING
}
