//! Actuated control: a stage goes on while vehicles keep coming, within bounds.

use serde::{Deserialize, Serialize};

use super::{JunctionView, SignalPolicy};

/// Ends a stage when a gap opens in its traffic or its longest green is over, if anybody waits for another.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Actuated {
    /// Shortest green, s.
    pub least_green: f64,
    /// Longest green while others wait, s.
    pub longest_green: f64,
    /// A gap longer than this ends the green, s.
    pub longest_gap: f64,
}

impl Default for Actuated {
    /// The values of SUMO's documented example: 5 to 45 s, gap 3 s.
    fn default() -> Self {
        Self { least_green: 5.0, longest_green: 45.0, longest_gap: 3.0 }
    }
}

impl SignalPolicy for Actuated {
    fn next_stage(&mut self, junction: &JunctionView<'_>) -> usize {
        if junction.elapsed < self.least_green {
            return junction.current;
        }
        let groups = &junction.stages[junction.current].green;
        let keeps_coming = groups.iter().any(|group| junction.demand.gap[group.index()] <= self.longest_gap);
        if keeps_coming && junction.elapsed < self.longest_green {
            return junction.current;
        }
        let count = junction.stages.len();
        (1..count)
            .map(|step| (junction.current + step) % count)
            .find(|stage| junction.demand_of(*stage) > 0)
            .unwrap_or(junction.current)
    }
}
