//! What is known of a junction: its signal, and the lanes before and behind it.

use simworld_core::id::LaneId;
use simworld_core::net::RoadNetwork;

use crate::Traffic;

/// Slower than this a vehicle is in a queue, m/s.
const HALTING: f64 = 0.1;
/// Room between two that stand, m.
const GAP: f64 = 2.5;

/// A lane that leads to a junction or away from it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LaneState {
    /// Which lane.
    pub lane: LaneId,
    /// Length, m.
    pub length: f64,
    /// Vehicles on it.
    pub vehicles: u32,
    /// Those of them that are slower than 0.1 m/s.
    pub queued: u32,
    /// Sum of their speeds over the speed limit.
    pub relative_speeds: f64,
    /// Time that those on it have stood on it, summed, s.
    pub waited: f64,
    /// Sum of their lengths, m.
    pub taken: f64,
}

impl LaneState {
    /// How many vehicles of the length of those on it the lane holds.
    fn holds(&self) -> f64 {
        let mean = if self.vehicles > 0 { self.taken / f64::from(self.vehicles) } else { 4.5 };
        (self.length / (mean + GAP)).max(1.0)
    }

    /// Vehicles of as many as it holds, in [0, 1].
    pub fn density(&self) -> f64 {
        (f64::from(self.vehicles) / self.holds()).min(1.0)
    }

    /// Queued vehicles of as many as it holds, in [0, 1].
    pub fn queue(&self) -> f64 {
        (f64::from(self.queued) / self.holds()).min(1.0)
    }
}

/// A junction as its agent may know it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct JunctionState {
    /// Its index among the signal plans.
    pub plan: usize,
    /// How many stages its plan has.
    pub stages: usize,
    /// The stage that shows green, or that comes to an end.
    pub stage: usize,
    /// How long it has shown green, s; none while it comes to an end.
    pub elapsed: Option<f64>,
    /// Whether its shortest green is over, so that another may follow.
    pub may_change: bool,
    /// The lanes that lead to it, ascending.
    pub incoming: Vec<LaneState>,
    /// The lanes that lead away, ascending.
    pub outgoing: Vec<LaneState>,
}

impl JunctionState {
    /// Time that those on the lanes that lead to it have stood there, summed, s.
    pub fn waited(&self) -> f64 {
        self.incoming.iter().map(|lane| lane.waited).sum()
    }

    /// Vehicles in its queues.
    pub fn queued(&self) -> u32 {
        self.incoming.iter().map(|lane| lane.queued).sum()
    }

    /// Mean speed over the speed limit on the lanes that lead to it; 1 if nobody is there.
    pub fn average_speed(&self) -> f64 {
        let count: u32 = self.incoming.iter().map(|lane| lane.vehicles).sum();
        let sum: f64 = self.incoming.iter().map(|lane| lane.relative_speeds).sum();
        if count > 0 { (sum / f64::from(count)).min(1.0) } else { 1.0 }
    }

    /// Vehicles that leave less vehicles that come.
    pub fn pressure(&self) -> f64 {
        let count = |lanes: &[LaneState]| lanes.iter().map(|lane| f64::from(lane.vehicles)).sum::<f64>();
        count(&self.outgoing) - count(&self.incoming)
    }
}

/// All junctions with signals, looked at step by step.
#[derive(Clone, Debug, Default)]
pub(super) struct Watch {
    pub(super) junctions: Vec<JunctionState>,
    /// Where each lane is counted: junction and rank before it, junction and rank behind it.
    places: Vec<[Option<(u32, u32)>; 2]>,
    /// Of each vehicle: the track that it is on, and how long it has stood there.
    waits: Vec<(u32, f64)>,
}

impl Watch {
    pub(super) fn new(network: &RoadNetwork) -> Self {
        let mut watch = Self { places: vec![[None; 2]; network.lanes.len()], ..Self::default() };
        for (plan, signals) in network.signals.iter().enumerate() {
            let junction = &network.intersections[signals.intersection.index()];
            let ways = || junction.connections.iter().map(|id| &network.connections[id.index()]);
            let mut state = JunctionState { plan, ..JunctionState::default() };
            let ends: [Vec<LaneId>; 2] =
                [ways().map(|way| way.from).collect(), ways().map(|way| way.to).collect()];
            for (side, mut lanes) in ends.into_iter().enumerate() {
                lanes.sort_unstable();
                lanes.dedup();
                for (rank, lane) in lanes.iter().enumerate() {
                    watch.places[lane.index()][side] = Some((plan as u32, rank as u32));
                }
                let length = |lane: &LaneId| network.lanes[lane.index()].length;
                let empty = lanes.iter().map(|lane| LaneState {
                    lane: *lane,
                    length: length(lane),
                    ..LaneState::default()
                });
                *(if side == 0 { &mut state.incoming } else { &mut state.outgoing }) = empty.collect();
            }
            watch.junctions.push(state);
        }
        watch
    }

    /// Takes note of who stands, once a step.
    pub(super) fn tick(&mut self, traffic: &Traffic, dt: f64) {
        for id in traffic.entered() {
            if let Some(wait) = self.waits.get_mut(*id as usize) {
                *wait = (u32::MAX, 0.0);
            }
        }
        for (id, track, _, v) in traffic.stations() {
            let index = id as usize;
            if self.waits.len() <= index {
                self.waits.resize(index + 1, (u32::MAX, 0.0));
            }
            let wait = &mut self.waits[index];
            if wait.0 != track {
                *wait = (track, 0.0);
            }
            wait.1 += if v < HALTING { dt } else { 0.0 };
        }
    }

    /// Counts who is where, and reads the signals.
    pub(super) fn look(&mut self, traffic: &Traffic, min_green: f64) {
        for junction in &mut self.junctions {
            for lane in junction.incoming.iter_mut().chain(&mut junction.outgoing) {
                *lane = LaneState { lane: lane.lane, length: lane.length, ..LaneState::default() };
            }
            if let Some(signal) = traffic.stage(junction.plan) {
                junction.stages = traffic.stages(junction.plan).len();
                junction.stage = signal.stage;
                junction.elapsed = (!signal.is_ending).then_some(signal.elapsed);
                junction.may_change = junction.elapsed.is_some_and(|elapsed| elapsed + 1e-6 >= min_green);
            }
        }
        let limits = &traffic.network().lanes;
        for ((id, track, _, v), length) in traffic.stations().zip(traffic.lengths()) {
            let Some(places) = self.places.get(track as usize) else { continue };
            let waited = self.waits.get(id as usize).map_or(0.0, |wait| wait.1);
            for (side, place) in places.iter().enumerate() {
                let Some((plan, rank)) = *place else { continue };
                let junction = &mut self.junctions[plan as usize];
                let lanes = if side == 0 { &mut junction.incoming } else { &mut junction.outgoing };
                let lane = &mut lanes[rank as usize];
                lane.vehicles += 1;
                lane.queued += u32::from(v < HALTING);
                lane.relative_speeds += v / limits[track as usize].speed_limit;
                lane.waited += waited;
                lane.taken += length;
            }
        }
    }
}
