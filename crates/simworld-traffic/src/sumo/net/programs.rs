//! Actuated programs: phases that last as long as vehicles keep coming, or have lost time, within the bounds of the file, and that are
//! followed by whichever is wanted most.
//!
//! Source: SUMO user documentation, *Simulation/Traffic Lights*, type `actuated`: from `minDur` on a phase ends when the time since the
//! last vehicle passed a detector two seconds before the line is longer than `max-gap` on all lanes that have green, and at `maxDur` at the
//! latest; the next of the program follows, whether or not anybody waits for it. Where a phase names several that may follow (`next`), the
//! one with the most detectors follows that somebody passes or passed since they last had green; the phase itself goes on while its own
//! count for more; the first that is named follows if nobody comes at all. Where SUMO has a detector a lane, here is one a signal group.
//! Type `delay_based`: a phase goes on while a vehicle that has lost more than `minTimeLoss` within `detectorRange` before the line could
//! pass by `maxDur`, and up to `maxDur` while nobody is within that range on a red lane, with `extendMaxDur` even longer.

use std::collections::BTreeMap;

use simworld_core::id::IntersectionId;
use simworld_core::net::{Phase, SignalGroup, SignalPlan};

use crate::signal::{Branches, DelayDetector, Exit, FixedTime, JunctionView, SignalPolicy, Stage, branching};

/// SUMO's `inactive-threshold`, s, where the file says nothing: after so long without green a detector counts its seconds.
const INACTIVE: f64 = 180.0;
/// What a detector counts that has green already.
const SERVED: f64 = 10.0;
/// What people count who wait at the kerb.
const AT_KERB: f64 = 100.0;

/// The policy that the programs of a network ask for: [`Traffic::set_policy`](crate::Traffic::set_policy) takes a copy. Those of type
/// `actuated` and `delay_based` follow their vehicles, all others the clock. Junctions that were joined
/// ([`TrafficConfig::join_nearer`](crate::TrafficConfig::join_nearer)) have other plans, which follow the clock.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SumoPrograms {
    actuated: BTreeMap<IntersectionId, Program>,
}

/// One actuated program.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Program {
    extends: Extends,
    /// Shortest and longest duration of each phase of the plan, s.
    bounds: Vec<(f64, f64)>,
    choice: Option<Choice>,
}

/// What lets a phase go on after its shortest duration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Extends {
    /// No longer gap than this, s.
    Gap(f64),
    /// Whoever has lost time; and, if it says so, nobody elsewhere even beyond the longest duration.
    Delay(DelayDetector, bool),
}

/// What may follow where something is to be chosen.
#[derive(Clone, Debug, PartialEq)]
struct Choice {
    branches: Branches,
    /// The phases of the plan to which it belongs, which may be timed anew.
    own: Vec<Phase>,
    /// After so long without green, s, a detector counts its seconds.
    inactive: f64,
    /// What may follow each stage.
    ways: Vec<Ways>,
}

/// What may follow a stage.
#[derive(Clone, Debug, PartialEq)]
struct Ways {
    /// Whether it names several itself: then it goes on only while its vehicles count for most.
    is_choice: bool,
    /// Whether it goes on where nobody comes at all.
    rests: bool,
    /// Each stage that may follow, and those that are reached soonest by it; in the order of the file.
    candidates: Vec<(usize, Vec<usize>)>,
}

impl SumoPrograms {
    /// How many of the programs are actuated.
    pub fn actuated(&self) -> usize {
        self.actuated.len()
    }

    pub(super) fn add(&mut self, place: IntersectionId, program: Program) {
        self.actuated.insert(place, program);
    }

    /// The program of a plan that is the file's own.
    fn of(&self, plan: &SignalPlan) -> Option<&Program> {
        self.actuated.get(&plan.intersection).filter(|program| program.bounds.len() == plan.phases.len())
    }
}

impl SignalPolicy for SumoPrograms {
    fn next_stage(&mut self, junction: &JunctionView<'_>) -> usize {
        let Some(program) = self.of(junction.plan) else { return FixedTime.next_stage(junction) };
        program.next_stage(junction)
    }

    fn watches(&self) -> bool {
        !self.actuated.is_empty()
    }

    fn keeps(&self, junction: &JunctionView<'_>) -> f64 {
        let Some(program) = self.of(junction.plan) else { return FixedTime.keeps(junction) };
        let (least, _) = program.bounds[junction.stages[junction.current].phase];
        (least - junction.elapsed).max(0.0)
    }

    fn delays(&self, plan: &SignalPlan) -> Option<DelayDetector> {
        match self.actuated.get(&plan.intersection)?.extends {
            Extends::Delay(detector, _) => Some(detector),
            Extends::Gap(_) => None,
        }
    }

    fn branches(&self, plan: &SignalPlan) -> Option<Branches> {
        let choice = self.actuated.get(&plan.intersection)?.choice.as_ref()?;
        let is_same = |(own, phase): (&Phase, &Phase)| own.green == phase.green && own.yellow == phase.yellow;
        let is_own =
            choice.own.len() == plan.phases.len() && choice.own.iter().zip(&plan.phases).all(is_same);
        is_own.then(|| choice.branches.clone())
    }
}

impl Program {
    pub(super) const fn new(extends: Extends, bounds: Vec<(f64, f64)>) -> Self {
        Self { extends, bounds, choice: None }
    }

    /// Whether vehicles let the current stage go on, which has lasted its shortest duration.
    fn goes_on(&self, junction: &JunctionView<'_>) -> bool {
        let JunctionView { plan, elapsed, demand, .. } = *junction;
        let stage = &junction.stages[junction.current];
        let (_, longest) = self.bounds[stage.phase];
        match self.extends {
            Extends::Gap(gap) => {
                elapsed < longest && stage.green.iter().any(|group| demand.gap[group.index()] <= gap)
            }
            Extends::Delay(_, beyond) => {
                let soonest = stage.green.iter().map(|group| demand.delayed[group.index()]);
                let red = plan.groups.iter().filter(|group| stage.green.binary_search(group).is_err());
                elapsed + soonest.fold(f64::INFINITY, f64::min) <= longest
                    || ((elapsed < longest || beyond)
                        && red.into_iter().all(|group| demand.in_range[group.index()] == 0))
            }
        }
    }

    /// Gives it the ways on among which it is to choose. Returns a phase after which no other green comes, if there is one.
    pub(super) fn choose(
        &mut self,
        plan: &SignalPlan,
        branches: Branches,
        inactive: Option<f64>,
    ) -> Option<usize> {
        let mut whole = plan.clone();
        whole.phases.extend(branches.phases.iter().cloned());
        let stages = branching(&whole, &branches.next);
        let ways_of = |(index, stage): (usize, &Stage)| Ways {
            is_choice: branches.next[stage.phase].len() > 1,
            rests: branches.next[stage.phase].first() == Some(&stage.phase),
            candidates: candidates(&whole, &stages, index),
        };
        let ways: Vec<Ways> = stages.iter().enumerate().map(ways_of).collect();
        let dead_end = ways.iter().zip(&stages).find(|(ways, _)| ways.candidates.is_empty());
        let dead_end = dead_end.map(|(_, stage)| stage.phase);
        let (own, inactive) = (plan.phases.clone(), inactive.unwrap_or(INACTIVE));
        self.choice = Some(Choice { branches, own, inactive, ways });
        dead_end
    }

    fn next_stage(&self, junction: &JunctionView<'_>) -> usize {
        let stage = &junction.stages[junction.current];
        let (least, longest) = self.bounds[stage.phase];
        if junction.elapsed < least {
            return junction.current;
        }
        let ways = self.choice.as_ref().map(|choice| (choice, &choice.ways[junction.current]));
        match ways {
            Some((choice, ways)) if ways.is_choice || !self.goes_on(junction) => {
                self.chosen(choice, ways, junction.elapsed < longest, junction)
            }
            None if !self.goes_on(junction) => junction.successor(),
            _ => junction.current,
        }
    }

    /// The stage that is wanted most.
    fn chosen(&self, choice: &Choice, ways: &Ways, may_go_on: bool, junction: &JunctionView<'_>) -> usize {
        let current = junction.current;
        let wanted = |stage: usize| self.wanted(choice, stage, may_go_on, junction);
        let usual = ways.candidates.first().filter(|_| !ways.rests).map_or(current, |(stage, _)| *stage);
        let mut best = (usual, 0.0);
        if ways.is_choice && may_go_on {
            let own = wanted(current);
            if own > best.1 {
                best = (current, own);
            }
        }
        for (stage, reached) in &ways.candidates {
            let count = reached.iter().map(|stage| wanted(*stage)).sum();
            if count > best.1 {
                best = (*stage, count);
            }
        }
        best.0
    }

    /// How much a stage is wanted, in detectors.
    fn wanted(&self, choice: &Choice, stage: usize, may_go_on: bool, junction: &JunctionView<'_>) -> f64 {
        let demand = &junction.demand;
        let Extends::Gap(longest_gap) = self.extends else { return 0.0 };
        let served = &junction.stages[junction.current].green;
        let of_group = |group: &SignalGroup| {
            let index = group.index();
            let (gap, red) = (demand.gap[index], demand.since_green[index]);
            let kerb = if demand.waiting[index] > 0 { AT_KERB } else { 0.0 };
            let detected = match () {
                () if gap > longest_gap && gap >= red => 0.0,
                () if red > choice.inactive => red.floor(),
                () if served.binary_search(group).is_err() => 1.0,
                () if may_go_on => SERVED,
                () => 0.0,
            };
            kerb + detected
        };
        junction.stages[stage].green.iter().map(of_group).sum()
    }
}

/// The stages that may follow one, each with those that are reached by it with the shortest endings between.
fn candidates(plan: &SignalPlan, stages: &[Stage], from: usize) -> Vec<(usize, Vec<usize>)> {
    let length = |exit: &Exit| exit.ending.iter().map(|phase| plan.phases[*phase].duration).sum::<f64>();
    let exits = &stages[from].exits;
    // Of each stage how soon it is reached, s, and by which exit.
    let mut soonest: Vec<Option<(f64, usize)>> = vec![None; stages.len()];
    for (rank, exit) in exits.iter().enumerate() {
        soonest[exit.stage] = Some((length(exit), rank));
    }
    let mut is_done = vec![false; stages.len()];
    is_done[from] = true;
    loop {
        let open = (0..stages.len()).filter(|stage| !is_done[*stage]);
        let open = open.filter_map(|stage| soonest[stage].map(|(time, rank)| (time, rank, stage)));
        let Some((time, rank, stage)) = open.min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1))) else {
            break;
        };
        is_done[stage] = true;
        for exit in &stages[stage].exits {
            // Where a way on leads itself, no longer one is as good.
            let later = time + length(exit);
            if soonest[exit.stage].is_none_or(|known| later < known.0) {
                soonest[exit.stage] = Some((later, rank));
            }
        }
    }
    soonest[from] = None;
    let reached = |rank: usize| {
        (0..stages.len()).filter(|stage| soonest[*stage].is_some_and(|known| known.1 == rank)).collect()
    };
    exits.iter().enumerate().map(|(rank, exit)| (exit.stage, reached(rank))).collect()
}

#[cfg(test)]
#[path = "programs_tests.rs"]
mod tests;
