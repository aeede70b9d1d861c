//! Detectors: what is seen before every stop line with a signal, once a step.

use serde::{Deserialize, Serialize};
use simworld_core::hash::StateHasher;
use simworld_core::id::CrossingId;
use simworld_core::net::Aspect;

use super::Demand;
use super::losses::Losses;
use crate::vehicle::{NONE, STANDING, Tracks, Vehicle, VehicleManager, Way};

/// Video detection sees so far from the stop line, m.
const SEEN: f64 = 50.0;
/// The advance detector lies so far before the stop line at the speed limit, s.
const ADVANCE: f64 = 2.0;

/// What detectors remember: the time since each advance detector was last passed, s, by group.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Detectors {
    pub(crate) gap: Vec<f64>,
    /// Vehicle-seconds and pedestrian-seconds before each group since it last showed green.
    pub(crate) waited: Vec<f64>,
    pub(crate) kerb: Vec<f64>,
    /// Time since each group last showed green, s.
    pub(crate) since_green: Vec<f64>,
    pub(crate) losses: Losses,
    #[serde(skip)]
    approaching: Vec<u32>,
    #[serde(skip)]
    queued: Vec<u32>,
    #[serde(skip)]
    pressure: Vec<f64>,
    #[serde(skip)]
    waiting: Vec<u32>,
    /// Share of each lane that is taken, and of it by those who want each connection.
    #[serde(skip)]
    taken: Vec<f64>,
    #[serde(skip)]
    wanted: Vec<f64>,
    /// Lanes and connections with an entry.
    #[serde(skip)]
    lanes: Vec<u32>,
    #[serde(skip)]
    ways: Vec<u32>,
}

impl Detectors {
    pub(crate) fn new(groups: usize) -> Self {
        Self {
            gap: vec![f64::INFINITY; groups],
            waited: vec![0.0; groups],
            kerb: vec![0.0; groups],
            since_green: vec![0.0; groups],
            ..Self::default()
        }
    }

    pub(crate) fn demand(&self) -> Demand<'_> {
        Demand {
            approaching: &self.approaching,
            queued: &self.queued,
            gap: &self.gap,
            pressure: &self.pressure,
            waiting: &self.waiting,
            waited: &self.waited,
            kerb: &self.kerb,
            since_green: &self.since_green,
            delayed: &self.losses.delayed,
            in_range: &self.losses.in_range,
        }
    }

    /// Looks at all vehicles that may be before a stop line, and at all who wait at kerbs.
    pub(crate) fn look(
        &mut self,
        tracks: &Tracks,
        vehicles: &VehicleManager,
        waiting: &[u32],
        aspects: &[Aspect],
        dt: f64,
    ) {
        self.rest();
        self.losses.begin();
        for gap in &mut self.gap {
            *gap += dt;
        }
        self.clear_shares(tracks);
        for (lane, queue) in vehicles.queues(tracks) {
            self.look_at_lane(tracks, queue, lane, dt);
        }
        self.losses.end();
        self.press(tracks);
        for (index, count) in waiting.iter().enumerate() {
            if let Some(group) = tracks.network.crossings[CrossingId::from_index(index).index()].signal {
                self.waiting[group.index()] += count;
            }
        }
        self.sum_up(aspects, dt);
    }

    /// Adds up who waits before a red, and for how long there has been no green.
    fn sum_up(&mut self, aspects: &[Aspect], dt: f64) {
        for (group, aspect) in aspects.iter().enumerate() {
            let is_green = *aspect == Aspect::Green;
            let add = |sum: f64, count: u32| if is_green { 0.0 } else { sum + f64::from(count) * dt };
            self.waited[group] = add(self.waited[group], self.approaching[group]);
            self.kerb[group] = add(self.kerb[group], self.waiting[group]);
            self.since_green[group] = add(self.since_green[group], 1);
        }
    }

    /// Whether a saved state is one of so many groups.
    pub(crate) fn fits(&self, groups: usize) -> bool {
        let lists = [&self.gap, &self.waited, &self.kerb, &self.since_green];
        lists.iter().all(|of_group| of_group.len() == groups) && self.losses.is_sound()
    }

    pub(crate) fn state_hash(&self, hasher: &mut StateHasher) {
        for number in self.gap.iter().chain(&self.waited).chain(&self.kerb).chain(&self.since_green) {
            hasher.f64(*number);
        }
        self.losses.state_hash(hasher);
    }

    /// Tells of nobody.
    pub(crate) fn rest(&mut self) {
        let groups = self.gap.len();
        for counts in [&mut self.approaching, &mut self.queued, &mut self.waiting] {
            counts.clear();
            counts.resize(groups, 0);
        }
        self.pressure.clear();
        self.pressure.resize(groups, 0.0);
        self.losses.rest(groups);
    }

    /// Whether it has places for what it tells.
    pub(crate) fn is_ready(&self) -> bool {
        self.pressure.len() == self.gap.len()
    }

    fn clear_shares(&mut self, tracks: &Tracks) {
        self.taken.resize(tracks.lanes, 0.0);
        self.wanted.resize(tracks.count() - tracks.lanes, 0.0);
        self.lanes.drain(..).for_each(|lane| self.taken[lane as usize] = 0.0);
        self.ways.drain(..).for_each(|way| self.wanted[way as usize] = 0.0);
    }

    /// The pressure of a movement is what is before it less what is behind it, and never less than nothing.
    fn press(&mut self, tracks: &Tracks) {
        for way in &self.ways {
            let Way { to, signal, .. } = tracks.ways[*way as usize];
            if signal != NONE {
                let behind = self.taken[to as usize];
                self.pressure[signal as usize] += (self.wanted[*way as usize] - behind).max(0.0);
            }
        }
    }

    fn look_at_lane(&mut self, tracks: &Tracks, queue: &[Vehicle], lane: u32, dt: f64) {
        let end = tracks.length[lane as usize];
        self.lanes.push(lane);
        let advance = (end - ADVANCE * tracks.speed[lane as usize]).max(0.0);
        for vehicle in queue {
            let signal = tracks.ways.get(vehicle.next as usize).map(|way| way.signal);
            let Some(group) = signal.filter(|signal| *signal != NONE) else { continue };
            let group = group as usize;
            // A vehicle at rest takes its length and the gap before it.
            let share = (vehicle.length() + 2.0) / end;
            self.taken[lane as usize] += share;
            if self.wanted[vehicle.next as usize] == 0.0 {
                self.ways.push(vehicle.next);
            }
            self.wanted[vehicle.next as usize] += share;
            if end - vehicle.s < SEEN {
                self.approaching[group] += 1;
                self.queued[group] += u32::from(vehicle.v < STANDING);
            }
            self.losses.see(group, vehicle, (end, tracks.speed[lane as usize]), dt);
            let moved = vehicle.v * dt;
            if vehicle.s >= advance && vehicle.s - moved - vehicle.length() <= advance {
                self.gap[group] = 0.0;
            }
        }
    }
}
