//! The intersection manager: one controller a signalised intersection, which carries out what a policy chooses.

use std::sync::Arc;

use serde::{Deserialize, Serialize};
use simworld_core::hash::StateHasher;
use simworld_core::net::{Aspect, RoadNetwork, SignalPlan};

use super::stage::{Stage, branching, stages, successor, towards};
use super::{Branches, ByHand, DelayDetector, Demand, FixedTime, JunctionView, SignalPolicy};

/// Sums of steps are compared with this much tolerance, s.
const ROUNDING: f64 = 1e-6;
/// A controller is looked at again so long before anything can happen to it, s: what clocks of long runs round.
const EARLY: f64 = 1e-3;

/// Where a controller is in its plan.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Controller {
    stage: u32,
    next: u32,
    /// How many intervals of its ending have begun; none while it shows green.
    ending: u32,
    /// Time in the interval, s.
    elapsed: f64,
}

/// The stage that a signal is in.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StageShown {
    /// Its index among the stages of the plan.
    pub stage: usize,
    /// Whether it comes to an end: clearance, yellow or all-red.
    pub is_ending: bool,
    /// How long it has shown green, or the interval of its ending, s.
    pub elapsed: f64,
}

/// All controllers, one a plan.
pub(crate) type Controllers = Vec<Controller>;

/// All signals of a network.
pub(crate) struct IntersectionManager {
    plans: Vec<SignalPlan>,
    /// The plans to which the policy brings phases, with them.
    branched: Vec<Option<SignalPlan>>,
    stages: Vec<Vec<Stage>>,
    policy: Box<dyn SignalPolicy + Send>,
    /// By plan, the time in its interval before which nothing can happen to its controller unless it is held, s: most of the memory of
    /// most plans need not be looked at in most steps. It follows from the rest.
    idle_until: Vec<f64>,
    pub(crate) aspects: Vec<Aspect>,
}

impl IntersectionManager {
    pub(crate) fn new(network: &Arc<RoadNetwork>) -> Self {
        let mut manager = Self {
            plans: Vec::new(),
            branched: Vec::new(),
            stages: Vec::new(),
            policy: Box::new(FixedTime),
            idle_until: Vec::new(),
            aspects: vec![Aspect::Red; network.signal_groups()],
        };
        manager.set_plans(network.signals.clone());
        manager
    }

    pub(crate) fn plans(&self) -> &[SignalPlan] {
        &self.plans
    }

    pub(crate) fn stages(&self, plan: usize) -> &[Stage] {
        self.stages.get(plan).map_or(&[], Vec::as_slice)
    }

    pub(crate) fn set_plans(&mut self, plans: Vec<SignalPlan>) {
        let policy = &self.policy;
        let of_plan = |plan: &SignalPlan| match policy.branches(plan) {
            Some(Branches { phases, next }) => {
                let mut plan = plan.clone();
                plan.phases.extend(phases);
                let stages = branching(&plan, &next);
                (Some(plan), stages)
            }
            None => (None, stages(plan)),
        };
        (self.branched, self.stages) = plans.iter().map(of_plan).unzip();
        self.plans = plans;
        self.wake();
    }

    /// By group the detector by which the policy looks for vehicles that have lost time.
    pub(crate) fn delay_detectors(&self) -> Vec<Option<DelayDetector>> {
        let mut detectors = vec![None; self.aspects.len()];
        for plan in &self.plans {
            let detector = self.policy.delays(plan);
            for group in &plan.groups {
                detectors[group.index()] = detector;
            }
        }
        detectors
    }

    /// Has every controller that has stages looked at in the next step.
    fn wake(&mut self) {
        let wakes = |stages: &Vec<Stage>| if stages.is_empty() { f64::INFINITY } else { 0.0 };
        self.idle_until = self.stages.iter().map(wakes).collect();
    }

    /// Has another policy decide; the plans are to be set anew, for it may have other ways on.
    pub(crate) fn set_policy(&mut self, policy: Box<dyn SignalPolicy + Send>) {
        self.policy = policy;
    }

    /// Controllers as they stand when the clock of the plans shows `seconds`.
    pub(crate) fn start(&self, seconds: f64) -> Controllers {
        // The clock goes through the phases of the plans alone, which are the first.
        let at = |(plan, stages): (&SignalPlan, &Vec<Stage>)| {
            let Some((phase, elapsed)) = phase_at(plan, seconds) else { return Controller::default() };
            let place = |index: usize, stage: &Stage| {
                let step = if stage.phase == phase {
                    0
                } else {
                    1 + stage.ending.iter().position(|ending| *ending == phase)?
                };
                let next = successor(stages, index);
                Some(Controller { stage: index as u32, next: next as u32, ending: step as u32, elapsed })
            };
            stages.iter().enumerate().find_map(|(index, stage)| place(index, stage)).unwrap_or_default()
        };
        self.plans.iter().zip(&self.stages).map(at).collect()
    }

    /// Whether saved controllers are those of these plans.
    pub(crate) fn fits(&self, controllers: &Controllers) -> bool {
        let fits = |(controller, stages): (&Controller, &Vec<Stage>)| {
            let stage = stages.get(controller.stage as usize);
            stages.is_empty()
                || ((controller.next as usize) < stages.len()
                    && controller.elapsed.is_finite()
                    && stage.is_some_and(|stage| {
                        controller.ending as usize <= stage.ending_before(controller.next as usize).len()
                    }))
        };
        controllers.len() == self.plans.len() && controllers.iter().zip(&self.stages).all(fits)
    }

    /// Whether controllers of other plans or another policy can go on with these, and show the same.
    pub(crate) fn goes_on(&mut self, controllers: &Controllers) -> bool {
        let before = self.aspects.clone();
        let fits = self.fits(controllers);
        if fits {
            self.show(controllers);
        }
        fits && self.aspects == before
    }

    /// Moves every controller on by `dt` s and shows what it says.
    pub(crate) fn step(
        &mut self,
        controllers: &mut Controllers,
        by_hand: &ByHand,
        seconds: f64,
        demand: Demand<'_>,
        dt: f64,
    ) {
        let Self { plans, branched, stages, policy, idle_until, aspects } = self;
        for (number, (controller, idle_until)) in controllers.iter_mut().zip(idle_until).enumerate() {
            if *idle_until == f64::INFINITY {
                continue; // it has no stages
            }
            controller.elapsed += dt;
            let held = by_hand.held(number);
            if controller.elapsed < *idle_until && held.is_none() {
                continue;
            }
            let (plan, stages) = (whole(plans, branched, number), &stages[number]);
            let before = (controller.stage, controller.ending);
            let current = controller.stage as usize;
            let mut keeps = 0.0;
            if controller.ending == 0 && controller.elapsed + ROUNDING >= stages[current].least_green {
                let elapsed = controller.elapsed;
                let junction = JunctionView { plan, stages, current, elapsed, seconds, demand };
                let wish = held.unwrap_or_else(|| policy.next_stage(&junction));
                let is_other = wish < stages.len() && wish != current;
                if let Some(next) = is_other.then(|| towards(stages, current, wish)).flatten() {
                    controller.next = next as u32;
                    controller.ending = 1;
                    controller.elapsed = 0.0;
                } else if held.is_none() {
                    keeps = policy.keeps(&junction);
                }
            }
            controller.go_through_ending(plan, stages);
            if (controller.stage, controller.ending) != before {
                controller.show(plan, stages, aspects);
            }
            *idle_until = controller.earliest(plan, stages).max(controller.elapsed + keeps) - EARLY;
        }
    }

    /// Whether the policy looks at what detectors tell.
    pub(crate) fn watches(&self) -> bool {
        self.policy.watches()
    }

    /// Writes the aspects that the controllers show.
    pub(crate) fn show(&mut self, controllers: &Controllers) {
        let Self { plans, branched, stages, aspects, .. } = self;
        for (number, (stages, controller)) in stages.iter().zip(controllers).enumerate() {
            controller.show(whole(plans, branched, number), stages, aspects);
        }
    }
}

impl Controller {
    pub(crate) fn shown(&self) -> StageShown {
        StageShown { stage: self.stage as usize, is_ending: self.ending > 0, elapsed: self.elapsed }
    }

    pub(crate) fn state_hash(&self, hasher: &mut StateHasher) {
        hasher.u64(u64::from(self.stage)).u64(u64::from(self.next)).u64(u64::from(self.ending));
        hasher.f64(self.elapsed);
    }

    /// Writes the aspects of its groups.
    fn show(&self, plan: &SignalPlan, stages: &[Stage], aspects: &mut [Aspect]) {
        let Some(stage) = stages.get(self.stage as usize) else { return };
        let phase = match self.ending {
            0 => stage.phase,
            step => stage.ending_before(self.next as usize)[step as usize - 1],
        };
        for group in &plan.groups {
            aspects[group.index()] = plan.phases[phase].aspect(*group);
        }
    }

    /// The time in its interval at which something can happen at the earliest: its least green or the end of what ends it, s.
    fn earliest(&self, plan: &SignalPlan, stages: &[Stage]) -> f64 {
        let stage = &stages[self.stage as usize];
        match self.ending {
            0 => stage.least_green,
            step => {
                let ending = stage.ending_before(self.next as usize);
                ending.get(step as usize - 1).map_or(0.0, |phase| plan.phases[*phase].duration)
            }
        }
    }

    /// Passes the intervals of an ending that are over; what is left of the time counts for the next.
    fn go_through_ending(&mut self, plan: &SignalPlan, stages: &[Stage]) {
        while self.ending > 0 {
            let ending = stages[self.stage as usize].ending_before(self.next as usize);
            let Some(phase) = ending.get(self.ending as usize - 1) else {
                self.stage = self.next;
                self.ending = 0;
                return;
            };
            let duration = plan.phases[*phase].duration;
            if self.elapsed + ROUNDING < duration {
                return;
            }
            self.elapsed -= duration;
            self.ending += 1;
        }
    }
}

/// A plan with the phases that the policy brings.
fn whole<'a>(plans: &'a [SignalPlan], branched: &'a [Option<SignalPlan>], number: usize) -> &'a SignalPlan {
    branched[number].as_ref().unwrap_or(&plans[number])
}

/// The phase that a plan's clock shows, and for how long it has; `None` for a plan without phases.
pub(super) fn phase_at(plan: &SignalPlan, seconds: f64) -> Option<(usize, f64)> {
    let mut into = (seconds + plan.offset).rem_euclid(plan.cycle());
    for (index, phase) in plan.phases.iter().enumerate() {
        if into < phase.duration {
            return Some((index, into));
        }
        into -= phase.duration;
    }
    // Rounding may leave nothing of the cycle: then the first phase begins again.
    (!plan.phases.is_empty()).then_some((0, 0.0))
}
