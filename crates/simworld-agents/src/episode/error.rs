//! Why an episode ended before its time.

use simworld_core::command::CommandError;
use simworld_core::id::EntityId;
use simworld_core::seam::{ExecutorError, TaskError};
use simworld_core::simulation::{RestoreError, SimulationError};
use thiserror::Error;

use crate::mind::MindError;

/// Why an episode cannot go on; its state is kept.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum EpisodeError {
    /// The episode came to its end before.
    #[error("the episode is over, or something in it failed: begin another")]
    Over,
    /// An agent that cannot take part.
    #[error("{id} cannot be an agent: {reason}")]
    Agent {
        /// Its body.
        id: EntityId,
        /// Why.
        reason: &'static str,
    },
    /// A mind failed.
    #[error(transparent)]
    Mind(#[from] MindError),
    /// The task failed.
    #[error("the task failed: {0}")]
    Task(#[from] TaskError),
    /// The task asked for something impossible.
    #[error("the task asked for something impossible: {0}")]
    TaskCommand(CommandError),
    /// An executor failed.
    #[error("an executor failed: {0}")]
    Executor(#[from] ExecutorError),
    /// A part of the simulation failed.
    #[error(transparent)]
    Simulation(#[from] SimulationError),
    /// A snapshot does not fit.
    #[error(transparent)]
    Restore(#[from] RestoreError),
    /// The task, a mind or an executor does not recognise its saved state.
    #[error("the saved state of {part} does not fit: restore onto an episode made with the same parts")]
    SavedState {
        /// What it belongs to.
        part: String,
    },
    /// The snapshot was taken with other agents.
    #[error("the snapshot holds the agents {saved:?}, this episode has {present:?}")]
    Agents {
        /// Those of the snapshot.
        saved: Vec<EntityId>,
        /// Those here.
        present: Vec<EntityId>,
    },
}
