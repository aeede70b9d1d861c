//! Worlds that can be edited, and changes that are made whole or not at all.

use simworld_core::command::{Applied, Command, CommandError};
use simworld_core::scene::World;
use simworld_core::simulation::Simulation;

/// A world that can be edited: one by itself, or that of a running simulation between the halves of a step.
pub trait Editable {
    /// The world as it is.
    fn world(&self) -> &World;

    /// Carries out a command from outside.
    ///
    /// # Errors
    /// The command is impossible; then nothing has changed.
    fn change(&mut self, command: &Command) -> Result<Applied, CommandError>;
}

impl Editable for World {
    fn world(&self) -> &World {
        self
    }

    fn change(&mut self, command: &Command) -> Result<Applied, CommandError> {
        self.apply(command)
    }
}

/// The commands are recorded, so that a run that was edited replays.
impl Editable for Simulation {
    fn world(&self) -> &World {
        Self::world(self)
    }

    fn change(&mut self, command: &Command) -> Result<Applied, CommandError> {
        self.apply_from_outside(command)
    }
}

/// Carries out commands, all of them or none; gives those that take them back, in order.
pub(super) fn change_all(
    scene: &mut dyn Editable,
    commands: &[Command],
) -> Result<Vec<Command>, CommandError> {
    let mut back = Vec::new();
    for command in commands {
        match scene.change(command) {
            Ok(applied) => back.extend(applied.undo),
            Err(error) => {
                for command in back.iter().rev() {
                    // What was just done can be taken back: nothing else changed since.
                    let _ = scene.change(command);
                }
                return Err(error);
            }
        }
    }
    back.reverse();
    Ok(back)
}
