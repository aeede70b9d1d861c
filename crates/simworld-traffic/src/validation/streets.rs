//! The streets on which is measured, and who passes a line.

use std::sync::Arc;

use simworld_core::id::{LaneId, RoadId};
use simworld_core::net::{Aspect, LaneDirection, NetworkConfig, NetworkError, RoadNetwork, StreetPlan};
use simworld_core::seed::Seed;

use super::ValidationError;
use crate::vehicle::{Idm, VehicleKind, VehicleType};
use crate::{Leg, Route, Traffic, TrafficConfig};

/// The vehicle with which is measured.
pub(super) const CAR: VehicleKind = VehicleKind::Car;
/// Its length, m.
pub(super) const LENGTH: f64 = 4.5;
/// Length of the arms of a measured crossroads, m.
pub(super) const ARM: f64 = 320.0;
/// Red between two stages that is measured with, s.
const ALL_RED: f64 = 2.0;

/// Nobody at the start; all who come are cars whose drivers are alike.
pub(super) fn empty() -> TrafficConfig {
    let car = VehicleType {
        kind: CAR,
        share: 1.0,
        length: LENGTH,
        speed_factor: 1.0,
        speed_deviation: 0.0,
        driver: Idm::default(),
        ..VehicleType::default()
    };
    TrafficConfig { vehicles: 0, pedestrians: 0, types: vec![car], ..TrafficConfig::default() }
}

/// A network of a plan, and nobody on it.
pub(super) fn traffic(plan: &StreetPlan, seed: u64) -> Result<Traffic, ValidationError> {
    Ok(Traffic::new(Arc::new(derive(plan)?), &empty(), Seed(seed))?)
}

pub(super) fn derive(plan: &StreetPlan) -> Result<RoadNetwork, NetworkError> {
    RoadNetwork::derive(plan, &NetworkConfig::default())
}

/// In on one arm of a crossroads and out on another: 0 is the east, 1 the north, 2 the west, 3 the south.
pub(super) fn across(from: u32, to: u32) -> Route {
    let inwards = Leg::new(RoadId(from), LaneDirection::Backward);
    Route(vec![inwards, Leg::new(RoadId(to), LaneDirection::Forward)])
}

/// A crossroads with a fixed plan of two stages without people.
pub(super) struct Signalised {
    pub(super) traffic: Traffic,
    /// Length of its cycle, s.
    pub(super) cycle: f64,
}

impl Signalised {
    /// The first arm is red for `red` s, then green for `green` s, then yellow, and so on; red begins at time zero.
    pub(super) fn new(red: f64, green: f64, seed: u64) -> Result<Self, ValidationError> {
        Self::of(&empty(), red, green, seed)
    }

    /// The same with other settings.
    pub(super) fn of(
        config: &TrafficConfig,
        red: f64,
        green: f64,
        seed: u64,
    ) -> Result<Self, ValidationError> {
        let network = Arc::new(derive(&StreetPlan::crossroads(ARM))?);
        let mut traffic = Traffic::new(network, config, Seed(seed))?;
        let ours = signal_of(&traffic, inner_lane(&traffic, 0)).ok_or_else(|| ValidationError::Nothing {
            measure: "fixed signal",
            reason: "the crossroads has no signals".to_owned(),
        })?;
        let mut plans = traffic.plans().to_vec();
        let plan = &mut plans[0];
        plan.phases.retain(|phase| phase.yellow.is_empty() || phase.green.is_empty());
        let yellow = plan.phases.iter().find(|phase| !phase.yellow.is_empty()).map_or(3.0, |p| p.duration);
        for phase in &mut plan.phases {
            // The other stage and both all-reds together are red to us.
            phase.duration = match (phase.green.iter().any(|group| group.index() == ours), &phase.yellow[..])
            {
                (true, _) => green,
                (false, []) if phase.green.is_empty() => ALL_RED,
                (false, []) => red - yellow - 2.0 * ALL_RED,
                _ => yellow,
            };
        }
        let ended = plan.phases.iter().position(|phase| phase.yellow.iter().any(|g| g.index() == ours));
        plan.offset = plan.phases.iter().take(ended.map_or(0, |index| index + 1)).map(|p| p.duration).sum();
        let cycle = plan.cycle();
        traffic.set_plans(plans)?;
        Ok(Self { traffic, cycle })
    }
}

/// The lane next to the middle on which one comes in on an arm of a crossroads.
pub(super) fn inner_lane(traffic: &Traffic, arm: usize) -> LaneId {
    traffic.network().roads[arm].backward[0]
}

/// The index of the signal group at the end of a lane.
pub(super) fn signal_of(traffic: &Traffic, lane: LaneId) -> Option<usize> {
    let network = traffic.network();
    let way = network.lanes[lane.index()].outgoing.first()?;
    network.connections[way.index()].signal.map(simworld_core::net::SignalGroup::index)
}

/// Whether the signal at the end of a lane shows green.
pub(super) fn is_green(traffic: &Traffic, lane: LaneId) -> bool {
    signal_of(traffic, lane).is_some_and(|group| traffic.signals()[group] == Aspect::Green)
}

/// A stop line: who passes it, and when to a fraction of a step.
#[derive(Clone, Debug)]
pub(super) struct StopLine {
    lane: u32,
    /// How far beyond the end of the lane the line is, m; less than anybody drives in a step.
    pub(super) beyond: f64,
    before: Vec<u32>,
    /// Number of the vehicle and the time at which its front passed, s.
    pub(super) passed: Vec<(u32, f64)>,
}

impl StopLine {
    pub(super) fn new(lane: LaneId) -> Self {
        Self { lane: lane.0, beyond: 0.0, before: Vec::new(), passed: Vec::new() }
    }

    /// Looks at the traffic after a step.
    pub(super) fn look(&mut self, traffic: &Traffic) {
        let lanes = traffic.network().lanes.len() as u32;
        for (id, track, s, v) in traffic.stations() {
            if track == self.lane {
                if !self.before.contains(&id) {
                    self.before.push(id);
                }
            } else if track >= lanes
                && let Some(rank) = self.before.iter().position(|other| *other == id)
            {
                self.before.remove(rank);
                self.passed.push((id, traffic.seconds() - (s - self.beyond) / v.max(0.1)));
            }
        }
    }
}

/// A line across a lane: who passes it, and when to a fraction of a step.
#[derive(Clone, Debug)]
pub(super) struct Line {
    lane: u32,
    /// Where it is, m along the lane.
    station: f64,
    /// Those on the lane who are beyond it.
    beyond: Vec<u32>,
    /// Number of the vehicle and the time at which its front passed, s.
    pub(super) passed: Vec<(u32, f64)>,
}

impl Line {
    pub(super) fn new(lane: LaneId, station: f64) -> Self {
        Self { lane: lane.0, station, beyond: Vec::new(), passed: Vec::new() }
    }

    /// Looks at the traffic after a step.
    pub(super) fn look(&mut self, traffic: &Traffic) {
        let mut beyond = Vec::with_capacity(self.beyond.len() + 1);
        for (id, track, s, v) in traffic.stations() {
            if track == self.lane && s >= self.station {
                if !self.beyond.contains(&id) {
                    self.passed.push((id, traffic.seconds() - (s - self.station) / v.max(0.1)));
                }
                beyond.push(id);
            }
        }
        self.beyond = beyond;
    }
}

/// The mean of some values; NaN of none.
pub(super) fn mean(values: impl IntoIterator<Item = f64>) -> f64 {
    let (mut sum, mut count) = (0.0, 0.0);
    for value in values {
        sum += value;
        count += 1.0;
    }
    sum / count
}
