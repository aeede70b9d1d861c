//! The action vocabulary: the primitive actions of the paper's Table 3, typed.
//!
//! An [`Action`] is what a body is told at a step boundary. [`ActionKind`] names it without its arguments, and
//! an [`ActionSet`] says which kinds a body supports.

use std::fmt;

use serde::{Deserialize, Serialize};

use crate::geometry::Vector3;
use crate::id::EntityId;
use crate::scene::EntityKind;

/// Where a step goes, seen from the body.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum StepDirection {
    /// Along the body's x axis.
    Forward,
    /// Against the body's x axis.
    Backward,
    /// Along the body's y axis.
    Left,
    /// Against the body's y axis.
    Right,
}

/// Declares the actions, their kinds and the mapping between the two in one place.
macro_rules! actions {
    ($($(#[$doc:meta])* $name:ident $({ $($(#[$field_doc:meta])* $field:ident: $ty:ty),+ $(,)? })? ,)+) => {
        /// One primitive action with its arguments.
        #[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
        #[serde(rename_all = "snake_case")]
        #[non_exhaustive]
        pub enum Action {
            $($(#[$doc])* $name $({ $($(#[$field_doc])* $field: $ty),+ })?,)+
        }

        /// The kind of an action, without its arguments.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
        #[serde(rename_all = "snake_case")]
        #[non_exhaustive]
        pub enum ActionKind {
            $($(#[$doc])* $name,)+
        }

        impl ActionKind {
            /// Every kind, in the order of declaration.
            pub const ALL: &'static [Self] = &[$(Self::$name,)+];
        }

        impl Action {
            /// The kind of this action.
            pub fn kind(&self) -> ActionKind {
                match self {
                    $(Self::$name { .. } => ActionKind::$name,)+
                }
            }
        }
    };
}

actions! {
    /// Moves forward until told otherwise.
    MoveForward {
        /// Speed over ground, m/s, not negative.
        speed: f64,
    },
    /// Takes one step and stands.
    Step {
        /// Where to.
        direction: StepDirection,
        /// How far, m.
        distance: f64,
    },
    /// Turns on the spot or while walking.
    Rotate {
        /// By how much, radians, positive to the left.
        angle: f64,
    },
    /// Sets the walking speed without changing direction.
    ChangeSpeed {
        /// Speed over ground, m/s.
        speed: f64,
    },
    /// Turns the front wheels.
    Steer {
        /// Angle of the front wheels, radians, positive to the left.
        angle: f64,
    },
    /// Presses the accelerator; releases the brake.
    Throttle {
        /// Share of full throttle, in [-1, 1]; negative is reverse.
        level: f64,
    },
    /// Presses the brake; releases the accelerator.
    Brake {
        /// Share of full braking, in [0, 1].
        level: f64,
    },
    /// Halts all motion.
    Stop,
    /// Grasps an object small enough for one hand.
    PickUp {
        /// The object.
        item: EntityId,
    },
    /// Releases what the hand holds.
    DropOff,
    /// Lifts an object that needs both arms.
    CarryHeavy {
        /// The object.
        item: EntityId,
    },
    /// Puts the heavy object down.
    PutDownHeavy,
    /// Sits down on a seat.
    SitDown {
        /// The seat.
        seat: EntityId,
    },
    /// Gets up.
    StandUp,
    /// Opens a door.
    OpenDoor {
        /// The door.
        door: EntityId,
    },
    /// Gets into a car.
    EnterCar {
        /// The car.
        car: EntityId,
    },
    /// Gets out of the car.
    ExitCar,
    /// Gets on a scooter; movement is then the scooter's.
    RideScooter {
        /// The scooter.
        scooter: EntityId,
    },
    /// Gets off the scooter.
    GetOffScooter,
    /// Raises the gaze.
    LookUp {
        /// By how much, radians.
        angle: f64,
    },
    /// Lowers the gaze.
    LookDown {
        /// By how much, radians.
        angle: f64,
    },
    /// Narrows or widens the field of view.
    Focus {
        /// The new horizontal field of view, radians.
        horizontal_fov: f64,
    },
    /// Captures the current view as an image.
    TakePhoto,
    /// Says something to somebody.
    Converse {
        /// Who is spoken to.
        with: EntityId,
        /// What is said.
        words: String,
    },
    /// Points somewhere.
    PointDirection {
        /// Heading of the arm, radians counter-clockwise from east.
        heading: f64,
    },
    /// Waves.
    WaveHand {
        /// At whom.
        to: EntityId,
    },
    /// Shows disagreement by gestures.
    Argue {
        /// With whom.
        with: EntityId,
    },
    /// Closes a door.
    CloseDoor {
        /// The door.
        door: EntityId,
    },
    /// Hands over what the hand holds.
    Give {
        /// To whom.
        to: EntityId,
    },
    /// Buys something, which comes into the hand; what it costs is the task's business.
    Buy {
        /// What, as the place's attribute `sells` calls it.
        goods: String,
        /// Where.
        from: EntityId,
    },
    /// Throws what the hand or both arms hold. A body carries it out, with the strength of its arm.
    Throw {
        /// Velocity relative to the thrower, m/s, world frame, of at most 60 m/s.
        velocity: Vector3,
    },
    /// Throws what the hand or both arms hold at somebody or something, as gently as it gets there. A body carries it out.
    ThrowTo {
        /// At whom or what.
        to: EntityId,
    },
    /// Takes hold of something that can move, to push and pull it. A body carries it out.
    Grasp {
        /// What.
        thing: EntityId,
        /// Whether both hands hold, which turn what they hold; one lets it swing.
        both_hands: bool,
    },
    /// Lets go of everything that was taken hold of.
    LetGo,
    /// Goes down on bent knees, lower and slower, until it stands up. A body carries it out, and stays down under what is too low.
    Crouch,
}

impl fmt::Display for ActionKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        // `MoveForward` reads "move forward".
        for (index, letter) in format!("{self:?}").chars().enumerate() {
            if letter.is_uppercase() && index > 0 {
                write!(f, " ")?;
            }
            write!(f, "{}", letter.to_ascii_lowercase())?;
        }
        Ok(())
    }
}

/// A set of action kinds.
///
/// ```
/// use simworld_core::action::{ActionKind, ActionSet};
/// let walker = ActionSet::of(&[ActionKind::MoveForward, ActionKind::Rotate, ActionKind::Stop]);
/// assert!(walker.contains(ActionKind::Stop) && !walker.contains(ActionKind::Throttle));
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct ActionSet(u64);

impl ActionSet {
    /// The empty set.
    pub const NONE: Self = Self(0);

    /// What a person can do, by the paper's table.
    pub fn humanoid() -> Self {
        use ActionKind::{Brake, Steer, Throttle};
        Self::of(ActionKind::ALL).without(&[Steer, Throttle, Brake])
    }

    /// What a car, bus or truck can do.
    pub fn vehicle() -> Self {
        use ActionKind::{Brake, Steer, Stop, TakePhoto, Throttle};
        Self::of(&[Throttle, Brake, Steer, Stop, TakePhoto])
    }

    /// What a robot dog can do.
    pub fn dog() -> Self {
        use ActionKind::{ChangeSpeed, Focus, LookDown, LookUp, MoveForward, Rotate, Step, Stop, TakePhoto};
        Self::of(&[MoveForward, Step, Rotate, ChangeSpeed, LookUp, LookDown, Focus, TakePhoto, Stop])
    }

    /// What a body of that kind can ever do: a robot what a person can, since it may have arms and take a seat; what does
    /// not move by itself nothing.
    pub fn of_body(kind: EntityKind) -> Self {
        match kind {
            EntityKind::Person | EntityKind::Robot => Self::humanoid(),
            EntityKind::Dog => Self::dog(),
            kind if kind.is_vehicle() => Self::vehicle(),
            _ => Self::NONE,
        }
    }

    /// The set of these kinds.
    pub fn of(kinds: &[ActionKind]) -> Self {
        Self(kinds.iter().fold(0, |bits, kind| bits | 1 << *kind as u64))
    }

    /// This set less these kinds.
    #[must_use]
    pub fn without(self, kinds: &[ActionKind]) -> Self {
        Self(self.0 & !Self::of(kinds).0)
    }

    /// Whether the kind is in the set.
    pub fn contains(self, kind: ActionKind) -> bool {
        self.0 & (1 << kind as u64) != 0
    }

    /// The kinds in the set, in the order of declaration.
    pub fn iter(self) -> impl Iterator<Item = ActionKind> {
        ActionKind::ALL.iter().copied().filter(move |kind| self.contains(*kind))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_set_has_room_for_every_kind() {
        assert!(ActionKind::ALL.len() <= 64);
        assert_eq!(ActionSet::of(ActionKind::ALL).iter().count(), ActionKind::ALL.len());
    }

    #[test]
    fn what_moves_by_itself_can_do_something_and_nothing_else_can() {
        for kind in EntityKind::ALL {
            assert_eq!(ActionSet::of_body(*kind) != ActionSet::NONE, kind.is_mobile(), "{kind}");
        }
    }

    #[test]
    fn kinds_read_as_words() {
        assert_eq!(ActionKind::MoveForward.to_string(), "move forward");
        assert_eq!(ActionKind::Stop.to_string(), "stop");
    }

    #[test]
    fn actions_are_plain_json() {
        let action = Action::PickUp { item: EntityId::new(4, 0) };
        assert_eq!(serde_json::to_string(&action).unwrap(), r#"{"pick_up":{"item":4}}"#);
        assert_eq!(serde_json::to_string(&Action::Stop).unwrap(), r#""stop""#);
    }
}
