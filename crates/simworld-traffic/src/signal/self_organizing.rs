//! Self-organising lights: a red that has kept enough people waiting turns green, and platoons are not cut.

use serde::{Deserialize, Serialize};

use super::{JunctionView, SignalPolicy};

/// Self-organising traffic lights with platoons (SOTL; Gershenson 2005, and Cools, Gershenson and D'Hooghe 2013).
///
/// Before each red the time that vehicles have waited or approached is summed. When the sum of a stage exceeds `threshold`
/// and the green has lasted for `least_green`, that stage comes next, unless the last few of a platoon are still to pass the
/// green: fewer than `platoon` and more than none. Nobody counts cycles, and junctions know nothing of one another.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct SelfOrganizing {
    /// Shortest green, s.
    pub least_green: f64,
    /// Vehicle-seconds before a red at which it is to end.
    pub threshold: f64,
    /// A platoon of fewer vehicles than this is let through whole.
    pub platoon: u32,
    /// Longest green while others wait, s, so that a short stream never waits for ever.
    pub longest_green: f64,
    /// What one pedestrian at the kerb counts, in vehicles.
    pub pedestrian: f64,
}

impl Default for SelfOrganizing {
    /// The threshold of 41 vehicle-seconds and the platoon of three are those of the authors.
    fn default() -> Self {
        Self { least_green: 10.0, threshold: 41.0, platoon: 3, longest_green: 60.0, pedestrian: 0.5 }
    }
}

impl SelfOrganizing {
    /// Vehicle-seconds before the reds that a stage would turn green.
    fn waited(&self, junction: &JunctionView<'_>, stage: usize) -> f64 {
        let shown = &junction.stages[junction.current].green;
        let red = junction.stages[stage].green.iter().filter(|group| !shown.contains(group));
        red.map(|group| {
            let index = group.index();
            junction.demand.waited[index] + self.pedestrian * junction.demand.kerb[index]
        })
        .sum()
    }
}

impl SignalPolicy for SelfOrganizing {
    fn next_stage(&mut self, junction: &JunctionView<'_>) -> usize {
        let current = junction.current;
        if junction.elapsed < self.least_green {
            return current;
        }
        let mut best = (current, 0.0);
        for stage in (0..junction.stages.len()).filter(|stage| *stage != current) {
            let waited = self.waited(junction, stage);
            if waited > best.1 {
                best = (stage, waited);
            }
        }
        let green = &junction.stages[current].green;
        let passing: u32 = green.iter().map(|group| junction.demand.approaching[group.index()]).sum();
        let cuts_a_platoon = (1..self.platoon).contains(&passing) && junction.elapsed < self.longest_green;
        let is_due = best.1 >= self.threshold || (best.1 > 0.0 && junction.elapsed >= self.longest_green);
        if is_due && !cuts_a_platoon { best.0 } else { current }
    }
}
