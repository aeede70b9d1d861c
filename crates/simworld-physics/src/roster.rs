//! Who of the bodies has a say between the engine's steps, and what the engine asks of them.
//!
//! Most bodies of a city only lie and fall. What is done for each body in each substep goes over the others alone; who they are
//! changes with the list of bodies, which is looked over only then.

use crate::apart::Filter;
use crate::dynamics::{Owned, PhysicsDynamics};

/// What follows from which bodies there are.
#[derive(Debug, Default)]
pub(crate) struct Roster {
    /// Where in the list of bodies those are that are not inert, ascending.
    pub(crate) minds: Vec<usize>,
    /// Which solids of one body meet, where the engine has to ask.
    pub(crate) filter: Filter,
    /// Whether the list of bodies has changed since.
    pub(crate) is_stale: bool,
}

impl PhysicsDynamics {
    /// Looks over the list of bodies, if it has changed.
    pub(crate) fn call_the_roll(&mut self) {
        if !std::mem::take(&mut self.roster.is_stale) {
            return;
        }
        let Roster { minds, filter, .. } = &mut self.roster;
        minds.clear();
        minds.extend((0..self.bodies.len()).filter(|place| !self.bodies[*place].is_inert));
        filter.follow(minds.iter().map(|place| &self.bodies[*place]));
    }

    /// The bodies that are not inert, by ascending id, as of the last roll.
    pub(crate) fn minds(&self) -> impl Iterator<Item = &Owned> {
        self.roster.minds.iter().map(|place| &self.bodies[*place])
    }
}
