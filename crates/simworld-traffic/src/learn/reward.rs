//! What is rewarded: by default, that less is waited. The names and formulas are those of sumo-rl.

use super::JunctionState;

/// Says how good the last five seconds were for a junction.
pub trait SignalReward {
    /// An episode of so many junctions begins.
    fn reset(&mut self, junctions: usize);

    /// The reward of a junction; called once a step for each, in the order of their plans.
    fn reward(&mut self, junction: &JunctionState) -> f64;
}

/// By how much the waiting time of those before the junction has fallen since the last action, in hundreds of seconds.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct WaitingTimeReward {
    before: Vec<f64>,
}

impl SignalReward for WaitingTimeReward {
    fn reset(&mut self, junctions: usize) {
        self.before.clear();
        self.before.resize(junctions, 0.0);
    }

    fn reward(&mut self, junction: &JunctionState) -> f64 {
        let waited = junction.waited() / 100.0;
        let before =
            self.before.get_mut(junction.plan).map_or(0.0, |before| std::mem::replace(before, waited));
        before - waited
    }
}

/// The mean speed before the junction over the speed limit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct AverageSpeed;

impl SignalReward for AverageSpeed {
    fn reset(&mut self, _: usize) {}

    fn reward(&mut self, junction: &JunctionState) -> f64 {
        junction.average_speed()
    }
}

/// Less the number of queued vehicles.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct QueueReward;

impl SignalReward for QueueReward {
    fn reset(&mut self, _: usize) {}

    fn reward(&mut self, junction: &JunctionState) -> f64 {
        -f64::from(junction.queued())
    }
}

/// Vehicles that leave the junction less those that come to it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct PressureReward;

impl SignalReward for PressureReward {
    fn reset(&mut self, _: usize) {}

    fn reward(&mut self, junction: &JunctionState) -> f64 {
        junction.pressure()
    }
}
