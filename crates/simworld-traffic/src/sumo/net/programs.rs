//! Actuated programs: phases that last as long as vehicles keep coming, within the bounds of the file.
//!
//! Source: SUMO user documentation, *Simulation/Traffic Lights*, type `actuated`: from `minDur` on a phase ends when the time since the
//! last vehicle passed a detector two seconds before the line is longer than `max-gap` on all lanes that have green, and at `maxDur` at the
//! latest; the next of the program follows, whether or not anybody waits for it.

use std::collections::BTreeMap;

use simworld_core::id::IntersectionId;
use simworld_core::net::SignalPlan;

use crate::signal::{FixedTime, JunctionView, SignalPolicy};

/// SUMO's `max-gap`, s, where the file says nothing.
const LONGEST_GAP: f64 = 3.0;

/// The policy that the programs of a network ask for: [`Traffic::set_policy`](crate::Traffic::set_policy) takes a copy. Those of type
/// `actuated` follow their vehicles, all others the clock. Junctions that were joined
/// ([`TrafficConfig::join_nearer`](crate::TrafficConfig::join_nearer)) have other plans, which follow the clock.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SumoPrograms {
    actuated: BTreeMap<IntersectionId, Program>,
}

/// One actuated program.
#[derive(Clone, Debug, PartialEq)]
struct Program {
    /// A gap longer than this ends a phase, s.
    longest_gap: f64,
    /// Shortest and longest duration of each phase of the plan, s.
    bounds: Vec<(f64, f64)>,
}

impl SumoPrograms {
    /// How many of the programs are actuated.
    pub fn actuated(&self) -> usize {
        self.actuated.len()
    }

    pub(super) fn add(&mut self, place: IntersectionId, longest_gap: Option<f64>, bounds: Vec<(f64, f64)>) {
        let longest_gap = longest_gap.unwrap_or(LONGEST_GAP);
        self.actuated.insert(place, Program { longest_gap, bounds });
    }

    /// The program of a plan that is the file's own.
    fn of(&self, plan: &SignalPlan) -> Option<&Program> {
        self.actuated.get(&plan.intersection).filter(|program| program.bounds.len() == plan.phases.len())
    }
}

impl SignalPolicy for SumoPrograms {
    fn next_stage(&mut self, junction: &JunctionView<'_>) -> usize {
        let Some(program) = self.of(junction.plan) else { return FixedTime.next_stage(junction) };
        let stage = &junction.stages[junction.current];
        let (least, longest) = program.bounds[stage.phase];
        let keeps_coming =
            stage.green.iter().any(|group| junction.demand.gap[group.index()] <= program.longest_gap);
        let goes_on = junction.elapsed < least || (keeps_coming && junction.elapsed < longest);
        if goes_on { junction.current } else { junction.successor() }
    }

    fn watches(&self) -> bool {
        !self.actuated.is_empty()
    }

    fn keeps(&self, junction: &JunctionView<'_>) -> f64 {
        let Some(program) = self.of(junction.plan) else { return FixedTime.keeps(junction) };
        let (least, _) = program.bounds[junction.stages[junction.current].phase];
        (least - junction.elapsed).max(0.0)
    }
}
