//! Actions on objects: their preconditions and what they change.
//!
//! Locomotion belongs to bodies; taking, giving, sitting, riding, opening, buying and talking belong to the world,
//! because they are facts that everybody sees. [`check_action`] says whether an action is possible, for any
//! scene and without changing it; the world checks and then makes or breaks one bond, sets one attribute, or
//! reports one event.

mod check;
mod effect;
mod room;

pub use check::check_action;
use thiserror::Error;

use super::{EntityKind, Role, Scene};
use crate::action::ActionKind;
use crate::asset::Affordance;
use crate::geometry::Point3;
use crate::id::EntityId;

/// How far a person reaches, m, measured in the plane to the object's footprint or access point.
pub const ARM_REACH: f64 = 2.0;
/// How far a voice or a gesture reaches somebody who is spoken to, m: the far edge of "social distance" is 3.6 m and
/// of comfortable public speech 7.6 m (Hall, The Hidden Dimension, 1966), and a raised voice carries a little farther.
pub const EARSHOT: f64 = 10.0;
/// What one person lifts with both arms at most, kg: the reference mass of ISO 11228-1 for the working population.
pub const CARRY_LIMIT: f64 = 25.0;
/// What one lifts with one hand at most, kg: the multiplier of EN 1005-2 for work with one hand is 0.6.
pub const HAND_LIMIT: f64 = 15.0;
/// Faster than this nothing is thrown, m/s: a little more than the fastest throws on record.
pub const MOST_THROWN: f64 = 60.0;
/// The attribute of somebody that holds the elevation of the gaze above the horizon, radians in [-π/2, π/2]; level without it.
pub const GAZE: &str = "gaze";
/// The attribute of somebody that holds the horizontal field of view it focuses on, radians; relaxed without it.
pub const FIELD_OF_VIEW: &str = "field_of_view";
/// The attribute of a door, or of a building with one, that says whether it is open.
pub const OPEN: &str = "open";
/// The attribute of a door that says whether it is locked.
pub const LOCKED: &str = "locked";
/// The attribute of a place that lists what it sells, separated by commas.
pub const SELLS: &str = "sells";

/// Why an action on an object is impossible.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum InteractionError {
    /// The actor or the object does not exist.
    #[error("there is no entity {id}: it was removed, or never spawned")]
    Missing {
        /// The unknown id.
        id: EntityId,
    },
    /// The object is too far away.
    #[error("{label} {id} is {distance:.1} m away and the reach is {ARM_REACH} m: go there first")]
    OutOfReach {
        /// The object.
        id: EntityId,
        /// What it is called.
        label: String,
        /// Distance, m.
        distance: f64,
    },
    /// The object is not of a kind that can be used so.
    #[error("a {kind} cannot be used to {verb}")]
    WrongKind {
        /// The object's kind.
        kind: EntityKind,
        /// The attempted use.
        verb: &'static str,
    },
    /// A body of that kind never does it.
    #[error("a {kind} cannot {action}: {who} can {able}")]
    Unable {
        /// The actor.
        who: EntityId,
        /// What it is.
        kind: EntityKind,
        /// The attempted action.
        action: ActionKind,
        /// What it can do, in words.
        able: String,
    },
    /// The object weighs more than one lifts so.
    #[error("{label} {id} weighs {mass:.0} kg and {limit} kg is what one can {verb} at most")]
    TooHeavy {
        /// The object.
        id: EntityId,
        /// What it is called.
        label: String,
        /// Its mass, kg.
        mass: f64,
        /// The most that is lifted so, kg.
        limit: f64,
        /// How it was to be lifted.
        verb: &'static str,
    },
    /// An argument out of range.
    #[error("{action} with {field} = {value} is out of range: give {allowed}")]
    Argument {
        /// The attempted action.
        action: ActionKind,
        /// The argument.
        field: &'static str,
        /// Its value.
        value: f64,
        /// What is allowed, in words.
        allowed: &'static str,
    },
    /// Somebody else uses the object.
    #[error("{label} {id} is taken by {by}")]
    Taken {
        /// The object.
        id: EntityId,
        /// What it is called.
        label: String,
        /// Who has it.
        by: EntityId,
    },
    /// The actor already does something that excludes the action.
    #[error("{who} cannot {verb} while {state}")]
    Busy {
        /// The actor.
        who: EntityId,
        /// The attempted action.
        verb: &'static str,
        /// What is in the way.
        state: &'static str,
    },
    /// Somebody is too far away to hear or see.
    #[error("{label} {id} is {distance:.1} m away and a voice carries {EARSHOT} m: go nearer first")]
    OutOfEarshot {
        /// Who.
        id: EntityId,
        /// What it is called.
        label: String,
        /// Distance, m.
        distance: f64,
    },
    /// The object is in a state that rules the action out.
    #[error("{label} {id} is {state}")]
    State {
        /// The object.
        id: EntityId,
        /// What it is called.
        label: String,
        /// Its state: "locked", "open already".
        state: &'static str,
    },
    /// The place does not sell it.
    #[error("{label} {id} does not sell {goods:?}: it sells {sells}")]
    NotSold {
        /// The place.
        id: EntityId,
        /// What it is called.
        label: String,
        /// What was asked for.
        goods: String,
        /// What there is.
        sells: String,
    },
}

/// The use of an object that an action stands for.
struct Use {
    verb: &'static str,
    role: Role,
    affordance: Affordance,
    /// What the object weighs at most, kg.
    limit: f64,
    /// Where the child sits in the parent's body frame.
    offset: Point3,
}

const PICK_UP: Use = Use {
    verb: "pick up",
    role: Role::Held,
    affordance: Affordance::PickUp,
    limit: HAND_LIMIT,
    offset: Point3::new(0.35, -0.25, 0.9),
};
const CARRY: Use = Use {
    verb: "carry",
    role: Role::Carried,
    affordance: Affordance::Carry,
    limit: CARRY_LIMIT,
    offset: Point3::new(0.5, 0.0, 0.8),
};
const SIT: Use = Use {
    verb: "sit",
    role: Role::Seated,
    affordance: Affordance::Sit,
    limit: f64::INFINITY,
    offset: Point3::new(0.0, 0.0, 0.0),
};
const RIDE: Use = Use {
    verb: "ride",
    role: Role::Ridden,
    affordance: Affordance::Ride,
    limit: f64::INFINITY,
    offset: Point3::new(0.0, 0.0, 0.0),
};
const ENTER: Use = Use {
    verb: "enter",
    role: Role::Aboard,
    affordance: Affordance::Enter,
    limit: f64::INFINITY,
    offset: Point3::new(0.2, 0.4, 0.3),
};
const MOUNT: Use = Use {
    verb: "enter",
    role: Role::Aboard,
    affordance: Affordance::Enter,
    limit: f64::INFINITY,
    offset: Point3::new(-0.15, 0.0, 0.2),
};

/// How one gets into a vehicle with pedals, or on to one with two wheels.
fn entering(scene: &dyn Scene, vehicle: EntityId) -> &'static Use {
    match scene.entity(vehicle).map(|vehicle| vehicle.kind) {
        Some(EntityKind::Motorcycle | EntityKind::Bicycle) => &MOUNT,
        _ => &ENTER,
    }
}
