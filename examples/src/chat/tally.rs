//! What became of everything that was said.

use std::fmt;

use simworld_core::seam::{Plan, PlanError};

/// How many sentences were said, and what became of them; as a line it is the last of a chat.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Tally {
    /// There was a plan.
    pub planned: u32,
    /// There was none, and the planner said why: the words, the world, or what a model made of them.
    pub refused: u32,
    /// The mind behind the planner failed: nobody answered.
    pub unanswered: u32,
}

impl Tally {
    /// Counts one sentence.
    pub fn count(&mut self, answer: &Result<Plan, PlanError>) {
        match answer {
            Ok(_) => self.planned += 1,
            Err(PlanError::Backend(_)) => self.unanswered += 1,
            Err(_) => self.refused += 1,
        }
    }
}

impl fmt::Display for Tally {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { planned, refused, unanswered } = self;
        let said = planned + refused + unanswered;
        write!(f, "sentences: {said} said, {planned} planned, {refused} refused, {unanswered} unanswered")
    }
}
