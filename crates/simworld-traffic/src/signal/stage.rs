//! Stages: the intervals of a plan in which somebody has green and nobody yellow, with the intervals that end them.

use simworld_core::net::{SignalGroup, SignalPlan};

/// Least green of a stage where its own interval is not shorter, s.
const LEAST_GREEN: f64 = 5.0;

/// A stage of a signal plan.
#[derive(Clone, Debug, PartialEq)]
pub struct Stage {
    /// Groups that show green, ascending.
    pub green: Vec<SignalGroup>,
    /// Index of its interval among the plan's phases.
    pub phase: usize,
    /// Indices of the phases that end it: clearance, yellow, all-red.
    pub ending: Vec<usize>,
    /// It shows for at least so long, s.
    pub least_green: f64,
}

/// The stages of a plan in its order; none if nobody ever has green.
pub(super) fn stages(plan: &SignalPlan) -> Vec<Stage> {
    let count = plan.phases.len();
    let is_main = |index: usize| {
        let phase = &plan.phases[index % count];
        !phase.green.is_empty() && phase.yellow.is_empty()
    };
    (0..count)
        .filter(|index| is_main(*index))
        .map(|phase| Stage {
            green: plan.phases[phase].green.to_vec(),
            phase,
            ending: (phase + 1..phase + count)
                .take_while(|next| !is_main(*next))
                .map(|next| next % count)
                .collect(),
            least_green: plan.phases[phase].duration.min(LEAST_GREEN),
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use simworld_core::net::{NetworkConfig, RoadNetwork, StreetPlan};

    use super::*;

    #[test]
    fn every_group_has_its_stage_and_every_stage_ends_on_red() {
        let network = RoadNetwork::derive(&StreetPlan::crossroads(100.0), &NetworkConfig::default()).unwrap();
        let plan = &network.signals[0];
        let stages = stages(plan);
        assert_eq!(stages.len(), 2);
        for group in &plan.groups {
            assert!(stages.iter().any(|stage| stage.green.contains(group)), "{group:?} never has green");
        }
        for stage in &stages {
            let last = &plan.phases[*stage.ending.last().unwrap()];
            assert!(last.green.is_empty() && last.yellow.is_empty(), "all red before the next stage");
        }
        let phases: usize = stages.iter().map(|stage| 1 + stage.ending.len()).sum();
        assert_eq!(phases, plan.phases.len());
    }
}
