//! What can be wrong with a request to the physics.

use simworld_core::id::EntityId;
use simworld_core::scene::WorldError;
use simworld_core::seam::DynamicsError;
use thiserror::Error;

use crate::robot::RobotError;

/// Why the physics refused, or could not go on.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum PhysicsError {
    /// A setting out of range.
    #[error("{config}.{field} = {value} is out of range: give {allowed}")]
    Config {
        /// Which settings.
        config: &'static str,
        /// The field at fault.
        field: &'static str,
        /// Its value.
        value: f64,
        /// What is allowed, in words.
        allowed: &'static str,
    },
    /// No such entity in the world.
    #[error("there is no entity {id} to give a body: spawn it first")]
    Missing {
        /// The unknown id.
        id: EntityId,
    },
    /// The entity has a body already.
    #[error("{id} has a body already: remove that one first")]
    Occupied {
        /// The entity.
        id: EntityId,
    },
    /// The entity has no body here.
    #[error("{id} has no body in this physics: add one first")]
    Bodiless {
        /// The entity.
        id: EntityId,
    },
    /// Somebody cannot hold something.
    #[error("{who} cannot take hold of {thing}: {reason}")]
    Grasp {
        /// Who.
        who: EntityId,
        /// What.
        thing: EntityId,
        /// What is in the way, and what would do.
        reason: String,
    },
    /// Somebody holds nothing.
    #[error("{id} holds nothing to throw: let it pick something up first")]
    EmptyHanded {
        /// Who.
        id: EntityId,
    },
    /// Somebody has hold of nothing.
    #[error("{id} has hold of nothing to let go of")]
    NoGrasp {
        /// Who.
        id: EntityId,
    },
    /// A throw that the arm does not give.
    #[error(
        "{who} cannot throw {item} at {speed:.1} m/s: with {mass:.1} kg in hand the arm gives {most:.1} m/s"
    )]
    Weak {
        /// Who.
        who: EntityId,
        /// What.
        item: EntityId,
        /// Its mass, kg.
        mass: f64,
        /// The speed that was asked for, m/s.
        speed: f64,
        /// The greatest that there is, m/s.
        most: f64,
    },
    /// A target that stands too near to be thrown at.
    #[error("{to} is too near to {who} to be thrown at: give it, or step back")]
    TooNear {
        /// Who.
        who: EntityId,
        /// At whom.
        to: EntityId,
    },
    /// The world refuses what was to be done to it.
    #[error(transparent)]
    World(#[from] WorldError),
    /// The entity's shape does not suit the body.
    #[error("the shape of {id} does not suit a {body}: {reason}")]
    Shape {
        /// The entity.
        id: EntityId,
        /// The kind of body.
        body: &'static str,
        /// What is wrong, and what would do.
        reason: String,
    },
    /// The description of a robot is wrong.
    #[error("this is no robot: {0}")]
    Robot(#[from] RobotError),
    /// The state of a body stopped being finite and the engine has put it out of action.
    #[error("the motion of {id} is no longer finite: a force, mass or action on it is absurd")]
    NotFinite {
        /// The entity.
        id: EntityId,
    },
    /// Saved bytes that cannot be taken up.
    #[error("the saved physics cannot be taken up: {reason}")]
    Saved {
        /// What is wrong, and what would do.
        reason: String,
    },
}

impl From<PhysicsError> for DynamicsError {
    fn from(error: PhysicsError) -> Self {
        match error {
            PhysicsError::Saved { reason } => Self::Saved(reason),
            other => Self::Other(other.to_string()),
        }
    }
}

/// Checks that a setting lies in a range; NaN lies in none.
pub(crate) fn check_range(
    config: &'static str,
    field: &'static str,
    value: f64,
    range: std::ops::RangeInclusive<f64>,
    allowed: &'static str,
) -> Result<(), PhysicsError> {
    if range.contains(&value) { Ok(()) } else { Err(PhysicsError::Config { config, field, value, allowed }) }
}
