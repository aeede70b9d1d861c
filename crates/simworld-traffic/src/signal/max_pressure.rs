//! Max-pressure control (Varaiya 2013): green to the stage that relieves the network most.

use serde::{Deserialize, Serialize};

use super::{JunctionView, SignalPolicy};

/// Gives green to the stage with the greatest pressure, that is vehicles before its stop lines less those behind them.
///
/// With Poisson arrivals below capacity it keeps all queues bounded without knowing the flows (Varaiya 2013, Transportation
/// Research C 36). People at the kerb add to the pressure, so that nobody waits for ever.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct MaxPressure {
    /// Shortest green, s.
    pub least_green: f64,
    /// Pressure of one pedestrian at the kerb, in full lanes.
    pub pedestrian: f64,
}

impl Default for MaxPressure {
    fn default() -> Self {
        Self { least_green: 10.0, pedestrian: 0.05 }
    }
}

impl MaxPressure {
    fn pressure(&self, junction: &JunctionView<'_>, stage: usize) -> f64 {
        let of_group = |index: usize| {
            junction.demand.pressure[index] + self.pedestrian * f64::from(junction.demand.waiting[index])
        };
        junction.stages[stage].green.iter().map(|group| of_group(group.index())).sum()
    }
}

impl SignalPolicy for MaxPressure {
    fn next_stage(&mut self, junction: &JunctionView<'_>) -> usize {
        if junction.elapsed < self.least_green {
            return junction.current;
        }
        let mut best = (junction.current, self.pressure(junction, junction.current));
        for stage in 0..junction.stages.len() {
            let pressure = self.pressure(junction, stage);
            if pressure > best.1 + 1e-9 {
                best = (stage, pressure);
            }
        }
        best.0
    }
}
