//! The signals of the traffic: their step, their plans, and how they are operated from outside: held, freed, timed anew.

use simworld_core::net::{SignalGroup, SignalPlan};
use simworld_core::traffic::SignalTiming;

use super::{State, Traffic};
use crate::TrafficError;
use crate::parts::in_parts;
use crate::signal::{ByHand, SignalPolicy, check_timing};

impl Traffic {
    /// Gives the signals another policy than [`FixedTime`](crate::signal::FixedTime); it decides from the next step on. If either
    /// has [ways on](SignalPolicy::branches) of its own and some signal shows what the other has not, all begin anew where the clock
    /// stands.
    pub fn set_policy(&mut self, policy: Box<dyn SignalPolicy + Send>) {
        self.signals.set_policy(policy);
        self.retime();
        if !self.signals.goes_on(&self.state.controllers) {
            self.restart_signals();
        }
        self.state.detectors.rest();
    }

    /// Gives the signals other plans, for the same groups; they begin at once, where their clocks stand now. Nobody holds them
    /// any more, and they are timed as the plans say.
    ///
    /// # Errors
    /// Plans that are not for the same intersections and groups, or that have a phase without duration.
    pub fn set_plans(&mut self, plans: Vec<SignalPlan>) -> Result<(), TrafficError> {
        let own = self.signals.plans();
        let differs = |(old, new): (&SignalPlan, &SignalPlan)| {
            old.intersection != new.intersection
                || old.groups != new.groups
                || !new.offset.is_finite()
                || new.phases.iter().any(|phase| !(phase.duration > 0.0 && phase.duration.is_finite()))
        };
        let other = own.iter().zip(&plans).position(differs);
        if let Some(plan) = other.or((own.len() != plans.len()).then_some(own.len().min(plans.len()))) {
            return Err(TrafficError::Plan { plan });
        }
        self.plans = plans;
        self.state.by_hand = ByHand::default();
        self.retime();
        self.restart_signals();
        Ok(())
    }

    /// Lets a signal group go green as soon as that is safe, through clearance, yellow and all-red of who has green now, and keeps
    /// its junction in that stage for so many seconds, infinite until it is [freed](Self::free_signal). Who held it before holds
    /// it no more.
    ///
    /// # Errors
    /// A group that is not there or never shows green, or a time that is negative or not a number.
    pub fn hold_signal(&mut self, group: SignalGroup, seconds: f64) -> Result<(), TrafficError> {
        if seconds.is_nan() || seconds < 0.0 {
            let allowed = "0 s or more";
            return Err(TrafficError::Config { field: "seconds", value: seconds, allowed });
        }
        let plan = self.plan_of(group)?;
        let stages = self.stages(plan);
        let has_green = |stage: usize| stages[stage].green.contains(&group);
        // If it has green already, that stage goes on.
        let current = self.stage(plan).map(|shown| shown.stage).filter(|stage| has_green(*stage));
        let never = TrafficError::Signal { group: group.0, reason: "it never shows green" };
        let stage = current.or_else(|| (0..stages.len()).find(|stage| has_green(*stage))).ok_or(never)?;
        self.state.by_hand.hold(plan, stage, self.state.seconds + seconds);
        Ok(())
    }

    /// Lets the signals of the junction of a group change by themselves again.
    ///
    /// # Errors
    /// A group that is not there, or whose junction nobody holds.
    pub fn free_signal(&mut self, group: SignalGroup) -> Result<(), TrafficError> {
        let plan = self.plan_of(group)?;
        if self.state.by_hand.free(plan) {
            return Ok(());
        }
        Err(TrafficError::Signal { group: group.0, reason: "nobody holds its junction" })
    }

    /// Times the signals of the junction of a group anew. What they show goes on, and ends as the new times say.
    ///
    /// # Errors
    /// A group that is not there, or a time out of range.
    pub fn time_signal(&mut self, group: SignalGroup, timing: SignalTiming) -> Result<(), TrafficError> {
        check_timing(&timing)?;
        let plan = self.plan_of(group)?;
        self.state.by_hand.set_timing(plan, timing);
        self.retime();
        Ok(())
    }

    /// Takes up the plans as they are timed now; the controllers go on where they are.
    pub(super) fn retime(&mut self) {
        self.signals.set_plans(self.state.by_hand.apply(self.plans.clone()));
        self.state.detectors.losses.set_detectors(self.signals.delay_detectors());
    }

    pub(super) fn update_signals(&mut self, dt: f64) {
        let State { vehicles, pedestrians, controllers, by_hand, detectors, seconds, .. } = &mut self.state;
        by_hand.let_go(*seconds);
        if self.signals.watches() {
            detectors.look(&self.tracks, vehicles, &pedestrians.waiting, &self.signals.aspects, dt);
        } else if !detectors.is_ready() {
            detectors.rest();
        }
        self.signals.step(controllers, by_hand, *seconds, detectors.demand(), dt);
        let State { aspects, shown, .. } = &mut self.state;
        let (old, new) = (&*aspects, &self.signals.aspects);
        in_parts(&*self.workers, shown, &|_, first, shown| {
            for ((shown, old), new) in shown.iter_mut().zip(&old[first..]).zip(&new[first..]) {
                *shown = if old == new { *shown + dt } else { 0.0 };
            }
        });
        aspects.copy_from_slice(new);
    }

    pub(super) fn restart_signals(&mut self) {
        self.state.controllers = self.signals.start(self.state.seconds);
        self.signals.show(&self.state.controllers);
        self.state.aspects.clone_from(&self.signals.aspects);
        self.state.shown = vec![0.0; self.signals.aspects.len()];
    }

    fn plan_of(&self, group: SignalGroup) -> Result<usize, TrafficError> {
        let plan = self.signals.plans().iter().position(|plan| plan.groups.contains(&group));
        plan.ok_or(TrafficError::Signal { group: group.0, reason: "there is no such group" })
    }
}
