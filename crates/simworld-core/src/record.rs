//! Recordings: the stamped commands of a run and the trail of its state hashes.
//!
//! A run is a start, a sequence of commands and nothing else; whoever applies the same commands at the same ticks
//! to the same start sees the same hashes.

use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::clock::Tick;
use crate::command::Command;
use crate::hash::StateDigest;

/// A command with the step at whose start it took effect.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Stamped {
    /// The step.
    pub tick: Tick,
    /// The command.
    pub command: Command,
}

/// What the outside did to a world, and where that led.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Recording {
    /// The commands in the order they took effect.
    pub commands: Vec<Stamped>,
    /// The digest after each recorded step.
    pub trail: Vec<(Tick, StateDigest)>,
}

/// The first step at which a replay went another way.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[error("the replay leaves the recording at tick {tick}: recorded {recorded}, replayed {replayed}")]
pub struct Divergence {
    /// The step.
    pub tick: Tick,
    /// What the recording says.
    pub recorded: StateDigest,
    /// What came out.
    pub replayed: StateDigest,
}

impl Recording {
    /// The commands of one step, in order.
    pub fn commands_at(&self, tick: Tick) -> impl Iterator<Item = &Command> {
        let start = self.commands.partition_point(|stamped| stamped.tick < tick);
        self.commands[start..].iter().take_while(move |stamped| stamped.tick == tick).map(|s| &s.command)
    }

    /// Compares the digest after a step with the recorded one; a step without a recorded digest passes.
    ///
    /// # Errors
    /// The two differ.
    pub fn confirm(&self, tick: Tick, replayed: StateDigest) -> Result<(), Divergence> {
        match self.trail.binary_search_by_key(&tick, |(at, _)| *at) {
            Ok(index) if self.trail[index].1 != replayed => {
                Err(Divergence { tick, recorded: self.trail[index].1, replayed })
            }
            _ => Ok(()),
        }
    }
}
