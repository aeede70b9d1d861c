//! Signals that somebody operates from outside: stages that are held, plans that are timed anew.
//!
//! Both go through the controllers: a held stage comes by clearance, yellow and all-red as any other, and a plan that is timed anew
//! cuts no interval short that has begun before its least green.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use simworld_core::hash::StateHasher;
use simworld_core::net::SignalPlan;
use simworld_core::traffic::SignalTiming;

use super::stage::stages;
use crate::TrafficError;

/// What was done from outside, by the index of the plan.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct ByHand {
    /// The stage that is held, and until when, s.
    held: BTreeMap<u32, (u32, f64)>,
    timed: BTreeMap<u32, SignalTiming>,
}

impl ByHand {
    /// The stage in which a plan is held.
    pub(super) fn held(&self, plan: usize) -> Option<usize> {
        // Most junctions are left to themselves.
        if self.held.is_empty() {
            return None;
        }
        self.held.get(&(plan as u32)).map(|(stage, _)| *stage as usize)
    }

    pub(crate) fn hold(&mut self, plan: usize, stage: usize, until: f64) {
        self.held.insert(plan as u32, (stage as u32, until));
    }

    /// Lets a plan go; false if nobody holds it.
    pub(crate) fn free(&mut self, plan: usize) -> bool {
        self.held.remove(&(plan as u32)).is_some()
    }

    pub(crate) fn set_timing(&mut self, plan: usize, timing: SignalTiming) {
        self.timed.insert(plan as u32, timing);
    }

    /// Lets go of those whose time is over.
    pub(crate) fn let_go(&mut self, seconds: f64) {
        self.held.retain(|_, (_, until)| seconds < *until);
    }

    /// Whether these can be those of plans with so many stages each.
    pub(crate) fn fits(&self, stages: &dyn Fn(usize) -> usize) -> bool {
        let is_stage = |(plan, (stage, until)): (&u32, &(u32, f64))| {
            (*stage as usize) < stages(*plan as usize) && !until.is_nan()
        };
        self.held.iter().all(is_stage)
            && self.timed.iter().all(|(plan, timing)| stages(*plan as usize) > 0 && check(timing).is_ok())
    }

    /// The plans as they were made, timed as they are now.
    pub(crate) fn apply(&self, mut plans: Vec<SignalPlan>) -> Vec<SignalPlan> {
        for (plan, timing) in &self.timed {
            if let Some(plan) = plans.get_mut(*plan as usize) {
                retime(plan, timing);
            }
        }
        plans
    }

    pub(crate) fn state_hash(&self, hasher: &mut StateHasher) {
        for (plan, (stage, until)) in &self.held {
            hasher.u64(u64::from(*plan)).u64(u64::from(*stage)).f64(*until);
        }
        for (plan, timing) in &self.timed {
            hasher.u64(u64::from(*plan)).f64(timing.green).f64(timing.yellow).f64(timing.walk);
        }
    }
}

/// Checks a timing.
///
/// # Errors
/// The first time out of range.
pub(crate) fn check(timing: &SignalTiming) -> Result<(), TrafficError> {
    let SignalTiming { green, yellow, walk } = *timing;
    let checks = [
        ("green", green, 5.0..=600.0, "5 to 600 s"),
        ("yellow", yellow, 2.0..=10.0, "2 to 10 s"),
        ("walk", walk, 4.0..=600.0, "4 to 600 s"),
    ];
    match checks.into_iter().find(|(_, value, range, _)| !range.contains(value)) {
        Some((field, value, _, allowed)) => Err(TrafficError::Config { field, value, allowed }),
        None => Ok(()),
    }
}

/// Gives the intervals of a plan other lengths; those in which crossings are cleared and all-red stay.
fn retime(plan: &mut SignalPlan, timing: &SignalTiming) {
    for stage in stages(plan) {
        let mut clearance = 0.0;
        for index in &stage.ending {
            let phase = &mut plan.phases[*index];
            match (phase.green.is_empty(), phase.yellow.is_empty()) {
                (false, _) => clearance += phase.duration,
                (true, false) => phase.duration = timing.yellow,
                (true, true) => {}
            }
        }
        // Without a clearance nobody walks beside the vehicles.
        let walk = if clearance > 0.0 { timing.walk } else { 0.0 };
        plan.phases[stage.phase].duration = (timing.green - clearance).max(walk);
    }
}
