//! What a sentence means, before anything is looked for: orders that refer to things.

use simworld_core::action::StepDirection;
use simworld_core::id::EntityId;
use simworld_core::scene::Relation;

use super::lexicon::Category;

/// One order.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Clause {
    /// Goes somewhere; `side` is where beside it.
    Go { to: Reference, side: Option<Relation>, pace: Pace, within: Option<f64> },
    /// Takes something up and, if `to` is given, brings it there.
    Take { what: Reference, to: Option<Reference> },
    /// Lets go of what is in hand, at a place if one is given.
    Drop { what: Option<Reference>, at: Option<Reference>, manner: Manner },
    /// Sits down, on the nearest free seat if none is named.
    Sit { on: Option<Reference> },
    /// Gets up.
    StandUp,
    /// Halts.
    Stop,
    /// Waits.
    Wait { seconds: f64 },
    /// Gets on a scooter or into a car, and goes somewhere on the scooter; to enter a building is to go to its door.
    Board { what: Reference, to: Option<Reference> },
    /// Gets off or out.
    Alight { from: Vehicle },
    /// Takes a step.
    Step { direction: StepDirection, distance: f64 },
    /// Turns by an angle, radians, positive to the left.
    Turn { angle: f64 },
    /// Waves at somebody.
    Wave { to: Reference },
    /// Takes a photo.
    Photo,
}

/// How fast one goes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Pace {
    /// As the body pleases.
    Usual,
    /// Running.
    Run,
    /// At a speed, m/s.
    At(f64),
}

/// What is let go of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Manner {
    /// What the hand holds.
    DropOff,
    /// What both arms carry, or else what the hand holds.
    PutDown,
    /// As drop off, and what is not in hand yet is fetched first.
    Deliver,
}

/// What one gets off or out of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Vehicle {
    /// Whatever one is in or on.
    Any,
    /// A car, bus or truck.
    Car,
    /// A scooter.
    Scooter,
}

/// A phrase that stands for a thing or a place.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Reference {
    pub(super) target: Target,
    pub(super) choice: Choice,
    /// How it stands to something else.
    pub(super) relation: Option<(Relation, Box<Reference>)>,
    /// The words themselves, for answers.
    pub(super) text: String,
}

/// What a phrase names.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Target {
    /// What was spoken of last.
    It,
    /// Where one went last.
    There,
    /// Where one is.
    Here,
    /// An entity by its id.
    Id(EntityId),
    /// A point, world frame, m; without a height, on the level of the agent.
    Point { x: f64, y: f64, z: Option<f64> },
    /// Entities that bear the name.
    Named(Vec<EntityId>),
    /// Anything of a class.
    Any(&'static Category),
}

/// Which of several.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Choice {
    /// Not said: the nearest, or the one that stands closest to what it is described by.
    Open,
    /// The nearest.
    Nearest,
    /// The farthest.
    Farthest,
}

impl Reference {
    /// "The nearest seat".
    pub(super) fn to_any_seat() -> Self {
        let target = Target::Any(Category::seat());
        Self { target, choice: Choice::Nearest, relation: None, text: "seat".to_owned() }
    }
}
