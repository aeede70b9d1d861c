//! Minds: what decides. A rule, a policy or a model; all speak in intents.
//!
//! What plans and acts for an agent is asked within the step of the world, and the world waits for it. Where that takes long, as
//! with a model behind a server, it belongs into the mind, which may think in a thread of its own: [`PlanningMind`] and
//! [`ActingMind`].

mod acting;
mod planning;

pub use acting::ActingMind;
pub use planning::PlanningMind;
use simworld_core::event::Event;
use simworld_core::id::EntityId;
use simworld_core::intent::Intent;
use simworld_core::scene::Scene;
use thiserror::Error;

/// Why a mind could not decide: in lockstep the episode ends with it, at their own pace only this mind does.
#[derive(Clone, Debug, PartialEq, Error)]
#[error("the mind of {who} failed: {reason}")]
pub struct MindError {
    /// Whose mind.
    pub who: EntityId,
    /// Why.
    pub reason: String,
}

/// Decides for one agent in a task `T`.
///
/// A mind is outside the simulation: what it wants is recorded, and a replay runs without it.
pub trait Mind<T: ?Sized> {
    /// Called once a step; appends what the agent wants now, usually nothing.
    ///
    /// # Errors
    /// The mind failed; one that merely does not know what to do appends nothing.
    fn decide(
        &mut self,
        task: &T,
        scene: &dyn Scene,
        who: EntityId,
        out: &mut Vec<Intent>,
    ) -> Result<(), MindError>;

    /// Called once a step, before [`decide`](Self::decide), with everything that happened in the last step: how its plans went,
    /// what was said to it. Nothing by default.
    fn notice(&mut self, _events: &[Event], _who: EntityId) {}

    /// The inner state as bytes for a snapshot; empty by default.
    fn save(&self) -> Vec<u8> {
        Vec::new()
    }

    /// Takes up a saved state; false if the bytes are not this mind's.
    fn restore(&mut self, _saved: &[u8]) -> bool {
        true
    }
}

/// A mind that wants nothing: for bodies that are told from outside what to do.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Silent;

impl<T: ?Sized> Mind<T> for Silent {
    fn decide(&mut self, _: &T, _: &dyn Scene, _: EntityId, _: &mut Vec<Intent>) -> Result<(), MindError> {
        Ok(())
    }
}

impl<T: ?Sized, M: Mind<T> + ?Sized> Mind<T> for Box<M> {
    fn decide(
        &mut self,
        task: &T,
        scene: &dyn Scene,
        who: EntityId,
        out: &mut Vec<Intent>,
    ) -> Result<(), MindError> {
        (**self).decide(task, scene, who, out)
    }

    fn notice(&mut self, events: &[Event], who: EntityId) {
        (**self).notice(events, who);
    }

    fn save(&self) -> Vec<u8> {
        (**self).save()
    }

    fn restore(&mut self, saved: &[u8]) -> bool {
        (**self).restore(saved)
    }
}
