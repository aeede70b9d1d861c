//! Plan to actions, step by step.

use thiserror::Error;

use super::{Plan, PlanStep};
use crate::action::Action;
use crate::hash::StateHasher;
use crate::id::EntityId;
use crate::scene::Scene;

/// How far an execution has come.
#[derive(Clone, Debug, PartialEq)]
pub enum Progress {
    /// There is no plan.
    Idle,
    /// Under way.
    Running,
    /// Under way; a step was taken up just now.
    Begun {
        /// The step, of blocks the innermost.
        step: Box<PlanStep>,
    },
    /// Under way, and otherwise than before: by another way, or round something.
    Rerouted {
        /// Why.
        reason: String,
    },
    /// Carried out to the end, in this very step.
    Done,
    /// Given up, in this very step.
    Failed {
        /// Why.
        reason: String,
    },
}

impl Progress {
    /// Whether the plan is under way still.
    pub fn goes_on(&self) -> bool {
        matches!(self, Self::Running | Self::Begun { .. } | Self::Rerouted { .. })
    }
}

/// Why an executor cannot work at all; a plan that merely fails is [`Progress::Failed`].
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum ExecutorError {
    /// The agent is not in the scene.
    #[error("there is no entity {id} to act for")]
    Missing {
        /// The unknown id.
        id: EntityId,
    },
    /// The plan holds a step this executor does not know.
    #[error("this executor cannot carry out {step}")]
    Unsupported {
        /// The step.
        step: String,
    },
    /// The mind behind the executor failed.
    #[error("{0}")]
    Backend(String),
}

/// Carries out plans: asked once a step, it answers with the actions of that step.
///
/// # Implementing it
///
/// ```
/// use simworld_core::action::Action;
/// use simworld_core::hash::StateHasher;
/// use simworld_core::id::EntityId;
/// use simworld_core::scene::Scene;
/// use simworld_core::seam::{Executor, ExecutorError, Plan, PlanStep, Progress};
///
/// /// Does the primitive actions of a plan, one a step, and cannot walk.
/// #[derive(Default)]
/// struct Gestures { left: Vec<Action> }
///
/// impl Executor for Gestures {
///     fn start(&mut self, plan: Plan, _: &dyn Scene, _: EntityId) -> Result<(), ExecutorError> {
///         let action = |step| match step {
///             PlanStep::Act(action) => Ok(action),
///             other => Err(ExecutorError::Unsupported { step: format!("{other:?}") }),
///         };
///         self.left = plan.steps.into_iter().rev().map(action).collect::<Result<_, _>>()?;
///         Ok(())
///     }
///
///     fn advance(&mut self, _: &dyn Scene, _: EntityId, out: &mut Vec<Action>)
///         -> Result<Progress, ExecutorError>
///     {
///         let Some(action) = self.left.pop() else { return Ok(Progress::Idle) };
///         out.push(action);
///         Ok(if self.left.is_empty() { Progress::Done } else { Progress::Running })
///     }
///
///     fn state_hash(&self, hasher: &mut StateHasher) { hasher.u64(self.left.len() as u64); }
/// }
/// ```
pub trait Executor {
    /// Takes up a plan; one under way is dropped.
    ///
    /// # Errors
    /// The plan cannot be carried out by this executor; the one under way goes on.
    fn start(&mut self, plan: Plan, scene: &dyn Scene, who: EntityId) -> Result<(), ExecutorError>;

    /// Appends the actions of this step to `out` and says how far it is.
    ///
    /// # Errors
    /// The executor itself cannot work; the episode ends with this error.
    fn advance(
        &mut self,
        scene: &dyn Scene,
        who: EntityId,
        out: &mut Vec<Action>,
    ) -> Result<Progress, ExecutorError>;

    /// Drops the plan under way; `out` receives what brings the body to rest. By default just a stop.
    fn cancel(&mut self, out: &mut Vec<Action>) {
        out.push(Action::Stop);
    }

    /// The inner state as bytes for a snapshot; empty by default.
    fn save(&self) -> Vec<u8> {
        Vec::new()
    }

    /// Takes up a saved state; false if the bytes are not this executor's.
    fn restore(&mut self, _saved: &[u8]) -> bool {
        true
    }

    /// Feeds inner state that influences the future; nothing by default.
    fn state_hash(&self, _hasher: &mut StateHasher) {}
}

macro_rules! forward_executor {
    ($($target:ty),+) => {
        $(impl<E: Executor + ?Sized> Executor for $target {
            fn start(&mut self, plan: Plan, scene: &dyn Scene, who: EntityId) -> Result<(), ExecutorError> {
                (**self).start(plan, scene, who)
            }
            fn advance(
                &mut self,
                scene: &dyn Scene,
                who: EntityId,
                out: &mut Vec<Action>,
            ) -> Result<Progress, ExecutorError> {
                (**self).advance(scene, who, out)
            }
            fn cancel(&mut self, out: &mut Vec<Action>) {
                (**self).cancel(out);
            }
            fn save(&self) -> Vec<u8> {
                (**self).save()
            }
            fn restore(&mut self, saved: &[u8]) -> bool {
                (**self).restore(saved)
            }
            fn state_hash(&self, hasher: &mut StateHasher) {
                (**self).state_hash(hasher);
            }
        })+
    };
}
forward_executor!(Box<E>, &mut E);
