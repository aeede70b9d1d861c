//! A body that takes actions.

use thiserror::Error;

use crate::action::{Action, ActionKind, ActionSet};
use crate::geometry::{Pose, Twist};

/// Where a body is and how it moves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BodyState {
    /// World from body.
    pub pose: Pose,
    /// Velocity, world frame.
    pub twist: Twist,
}

/// Why a body cannot do what it is told.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum EmbodimentError {
    /// This kind of body never does that.
    #[error("this body cannot {action}: it can {supported}")]
    Unsupported {
        /// The refused kind.
        action: ActionKind,
        /// What it can do, in words.
        supported: String,
    },
    /// An argument out of range.
    #[error("{action} with {field} = {value} is out of range: give {allowed}")]
    Argument {
        /// The kind of action.
        action: ActionKind,
        /// The argument.
        field: &'static str,
        /// Its value.
        value: f64,
        /// What is allowed, in words.
        allowed: &'static str,
    },
    /// Not in the body's present state.
    #[error("cannot {action} now: {reason}")]
    State {
        /// The kind of action.
        action: ActionKind,
        /// Why not.
        reason: String,
    },
}

impl EmbodimentError {
    /// The error for an action outside a body's set.
    pub fn unsupported(action: ActionKind, set: ActionSet) -> Self {
        let names: Vec<String> = set.iter().map(|kind| kind.to_string()).collect();
        Self::Unsupported { action, supported: names.join(", ") }
    }
}

/// A body that takes actions: which it supports, taking one, and where it is.
///
/// # Implementing it
///
/// A body without physics moves itself in [`advance`](Self::advance); a body in a physics world leaves that
/// to the physics.
///
/// ```
/// use simworld_core::action::{Action, ActionKind, ActionSet};
/// use simworld_core::geometry::{Pose, Twist, Vector3};
/// use simworld_core::seam::{BodyState, Embodiment, EmbodimentError};
///
/// /// A drone that hovers: it climbs while it is told to move.
/// struct Drone { state: BodyState, climb: f64 }
///
/// impl Embodiment for Drone {
///     fn supports(&self) -> ActionSet { ActionSet::of(&[ActionKind::MoveForward, ActionKind::Stop]) }
///
///     fn apply(&mut self, action: &Action) -> Result<(), EmbodimentError> {
///         self.climb = match action {
///             Action::MoveForward { speed } if speed.is_finite() => *speed,
///             Action::Stop => 0.0,
///             other => return Err(EmbodimentError::unsupported(other.kind(), self.supports())),
///         };
///         Ok(())
///     }
///
///     fn state(&self) -> BodyState { self.state }
///
///     fn advance(&mut self, dt: f64) {
///         self.state.twist.linear = Vector3::z() * self.climb;
///         self.state.pose.translation.z += self.climb * dt;
///     }
/// }
///
/// let start = BodyState { pose: Pose::identity(), twist: Twist::ZERO };
/// simworld_core::testing::check_embodiment(|| Box::new(Drone { state: start, climb: 0.0 }));
/// ```
pub trait Embodiment {
    /// The kinds of actions this body can ever do.
    fn supports(&self) -> ActionSet;

    /// Takes an action; it governs the body until another replaces it.
    ///
    /// # Errors
    /// The action is not supported, out of range, or impossible now; then the body goes on as before.
    fn apply(&mut self, action: &Action) -> Result<(), EmbodimentError>;

    /// Where the body is and how it moves.
    fn state(&self) -> BodyState;

    /// Moves a body that no physics moves by `dt` s; nothing by default.
    fn advance(&mut self, _dt: f64) {}

    /// The inner state as bytes for a snapshot; empty by default, which is right for a body without any
    /// beyond its [`BodyState`].
    fn save(&self) -> Vec<u8> {
        Vec::new()
    }

    /// Takes up a saved state; false if the bytes are not this body's.
    fn restore(&mut self, _state: &BodyState, _saved: &[u8]) -> bool {
        true
    }
}

macro_rules! forward_embodiment {
    ($($target:ty),+) => {
        $(impl<E: Embodiment + ?Sized> Embodiment for $target {
            fn supports(&self) -> ActionSet {
                (**self).supports()
            }
            fn apply(&mut self, action: &Action) -> Result<(), EmbodimentError> {
                (**self).apply(action)
            }
            fn state(&self) -> BodyState {
                (**self).state()
            }
            fn advance(&mut self, dt: f64) {
                (**self).advance(dt);
            }
            fn save(&self) -> Vec<u8> {
                (**self).save()
            }
            fn restore(&mut self, state: &BodyState, saved: &[u8]) -> bool {
                (**self).restore(state, saved)
            }
        })+
    };
}
forward_embodiment!(Box<E>, &mut E);
