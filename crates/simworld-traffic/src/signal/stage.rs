//! Stages: the intervals of a plan in which somebody has green and nobody yellow, with the intervals that end them.

use std::collections::VecDeque;

use simworld_core::net::{Phase, SignalGroup, SignalPlan};

/// Least green of a stage where its own interval is not shorter, s.
const LEAST_GREEN: f64 = 5.0;

/// A stage of a signal plan.
#[derive(Clone, Debug, PartialEq)]
pub struct Stage {
    /// Groups that show green, ascending.
    pub green: Vec<SignalGroup>,
    /// Index of its interval among the plan's phases.
    pub phase: usize,
    /// Indices of the phases that end it: clearance, yellow, all-red. If it has ways on of its own, those of the first of them.
    pub ending: Vec<usize>,
    /// It shows for at least so long, s.
    pub least_green: f64,
    /// The ways on, if the policy has [`Branches`] here, the first of which is usual; without any all stages may follow, each after
    /// the same ending.
    pub exits: Vec<Exit>,
}

/// A way on from a stage to one that may follow.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Exit {
    /// The index of the stage that follows.
    pub stage: usize,
    /// Indices of the phases between them.
    pub ending: Vec<usize>,
}

/// Ways on from the phases of a plan that do not merely follow one another, as a policy may bring them:
/// [`SignalPolicy::branches`](super::SignalPolicy::branches).
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Branches {
    /// Phases beside those of the plan, for the same groups; their indices are those after the plan's own. They are not timed anew from
    /// outside.
    pub phases: Vec<Phase>,
    /// By phase, the plan's own first, the indices of those that may follow it; the first is usual. A stage cannot follow itself.
    pub next: Vec<Vec<usize>>,
}

impl Stage {
    /// The phases that come between it and another stage.
    pub(super) fn ending_before(&self, stage: usize) -> &[usize] {
        self.exits.iter().find(|exit| exit.stage == stage).map_or(&self.ending, |exit| &exit.ending)
    }
}

/// The stage that usually follows.
pub(super) fn successor(stages: &[Stage], stage: usize) -> usize {
    stages[stage].exits.first().map_or((stage + 1) % stages.len(), |exit| exit.stage)
}

/// The stage by which one comes from one to another soonest, by the ways on that there are; `None` if it is never reached.
pub(super) fn towards(stages: &[Stage], from: usize, to: usize) -> Option<usize> {
    let leads = |stage: usize, next: usize| stages[stage].exits.iter().any(|exit| exit.stage == next);
    if leads(from, to) || stages.iter().all(|stage| stage.exits.is_empty()) {
        return Some(to);
    }
    // Backwards from where one wants to be.
    let mut ahead: Vec<Option<usize>> = vec![None; stages.len()];
    let mut reached = VecDeque::from([to]);
    while let Some(next) = reached.pop_front() {
        for (stage, hop) in ahead.iter_mut().enumerate() {
            if leads(stage, next) && hop.is_none() && stage != to {
                *hop = Some(next);
                reached.push_back(stage);
            }
        }
    }
    ahead[from]
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
            exits: Vec::new(),
        })
        .collect()
}

/// The stages of a plan whose phases are followed by the given ones.
pub(crate) fn branching(plan: &SignalPlan, next: &[Vec<usize>]) -> Vec<Stage> {
    let mut stages = stages(plan);
    let mut of_phase = vec![None; plan.phases.len()];
    for (index, stage) in stages.iter().enumerate() {
        of_phase[stage.phase] = Some(index);
    }
    for (index, stage) in stages.iter_mut().enumerate() {
        let mut exits = exits(stage.phase, &of_phase, next);
        exits.retain(|exit| exit.stage != index);
        stage.ending = exits.first().map(|exit| exit.ending.clone()).unwrap_or_default();
        stage.exits = exits;
    }
    stages
}

/// The ways from a phase to stages, in the order in which followers are named; the first to each stage.
fn exits(from: usize, of_phase: &[Option<usize>], next: &[Vec<usize>]) -> Vec<Exit> {
    let count = of_phase.len();
    let followers = |phase: usize| {
        let named = next.get(phase).map_or(&[][..], Vec::as_slice);
        let after = if named.is_empty() { Some((phase + 1) % count) } else { None };
        named.iter().copied().filter(move |phase| *phase < count).chain(after).rev()
    };
    let mut exits: Vec<Exit> = Vec::new();
    let mut seen = vec![false; count];
    let mut ahead: Vec<(usize, Vec<usize>)> = followers(from).map(|phase| (phase, Vec::new())).collect();
    while let Some((phase, mut ending)) = ahead.pop() {
        if let Some(stage) = of_phase[phase] {
            if exits.iter().all(|exit| exit.stage != stage) {
                exits.push(Exit { stage, ending });
            }
        } else if !seen[phase] {
            seen[phase] = true;
            ending.push(phase);
            ahead.extend(followers(phase).map(|phase| (phase, ending.clone())));
        }
    }
    exits
}

#[cfg(test)]
mod tests {
    use simworld_core::net::{Few, NetworkConfig, RoadNetwork, StreetPlan};

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

    #[test]
    fn ways_on_lead_to_where_one_wants_to_be() {
        let network = RoadNetwork::derive(&StreetPlan::crossroads(100.0), &NetworkConfig::default()).unwrap();
        let green = |duration| Phase { duration, ..network.signals[0].phases[0].clone() };
        let red = |duration| Phase { green: Few::new(), ..green(duration) };
        // Stages 0, 1 and 2; from 0 one comes to 1 by phase 1, to 2 from 1 alone, from there back, and from 3 nowhere.
        let phases = vec![green(9.0), red(2.0), green(8.0), green(7.0), red(3.0), green(6.0), red(1.0)];
        let plan = SignalPlan { phases, ..network.signals[0].clone() };
        let next =
            [vec![1, 0], vec![2, 6], vec![4, 3], vec![0, 99], vec![3], vec![6], vec![6]].map(Vec::from);
        let stages = branching(&plan, &next);
        let exit = |stage: usize, ending: &[usize]| Exit { stage, ending: ending.to_vec() };
        assert_eq!(stages.iter().map(|stage| stage.phase).collect::<Vec<_>>(), [0, 2, 3, 5]);
        assert_eq!((&stages[0].exits, &stages[0].ending), (&vec![exit(1, &[1])], &vec![1]));
        assert_eq!(stages[1].exits, [exit(2, &[4])], "the first way to a stage");
        assert_eq!((&stages[2].exits, stages[2].ending.len()), (&vec![exit(0, &[])], 0));
        assert_eq!(stages[3].exits, []);
        assert_eq!(
            [towards(&stages, 0, 2), towards(&stages, 1, 0), towards(&stages, 1, 2)],
            [Some(1), Some(2), Some(2)]
        );
        assert_eq!((towards(&stages, 3, 0), towards(&stages, 0, 3)), (None, None));
        // Without ways of their own all stages follow one another.
        assert_eq!(towards(&super::stages(&plan), 3, 1), Some(1));
    }
}
