//! What a sentence means, before anything is looked for: orders that refer to things.

use simworld_core::action::StepDirection;
use simworld_core::id::EntityId;
use simworld_core::net::{Aspect, Turn};
use simworld_core::scene::Relation;

use super::compass::Compass;
use super::lexicon::Category;
use super::paint::Paint;
pub(super) use super::stands::{Side, Stands};

/// One order, or a block of them.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Clause {
    /// Goes somewhere; `side` is where beside it.
    Go { to: Reference, side: Option<Spot>, pace: Pace, within: Option<f64> },
    /// Goes so far in a direction, m.
    Walk { course: Course, distance: f64, pace: Pace },
    /// Goes by a thing and a little beyond it.
    Past { what: Reference, pace: Pace },
    /// Goes once round a thing.
    Around { what: Reference, pace: Pace },
    /// Goes half of the way to a thing, or to the middle between two.
    Halfway { from: Option<Reference>, to: Reference, pace: Pace },
    /// Crosses the nearest road.
    Cross,
    /// Walks on and does not stop by itself.
    Forward,
    /// Goes after somebody.
    Follow { whom: Reference, pace: Pace },
    /// Takes something up and, if `to` is given, brings it there; a vehicle is ridden if the words allow it.
    Take { what: Reference, to: Option<Reference>, grip: Grip },
    /// Lets go of what is in hand, at a place if one is given.
    Drop { what: Option<Reference>, at: Option<Reference>, manner: Manner },
    /// Hands something over.
    Give { what: Option<Reference>, to: Reference },
    /// Throws something at somebody.
    Throw { what: Option<Reference>, to: Reference },
    /// Buys something, where it is sold or at a place, and gives it to somebody if one is named.
    Buy { goods: String, times: u32, at: Option<Reference>, whom: Option<Reference> },
    /// Speaks of something that later words stand for, and does nothing.
    Mention { what: Reference },
    /// Sits down, on the nearest free seat if none is named.
    Sit { on: Option<Reference> },
    /// Gets up.
    StandUp,
    /// Goes down on bent knees.
    Crouch,
    /// Halts.
    Stop,
    /// Waits.
    Wait { seconds: f64 },
    /// Gets on a scooter or into a car, and goes somewhere in or on it; to enter a building is to go to its door.
    Board { what: Reference, to: Option<Reference> },
    /// Goes somewhere by car.
    Drive { to: Reference, pace: Pace },
    /// Gets off or out.
    Alight { from: Vehicle },
    /// Takes a step.
    Step { direction: StepDirection, distance: f64 },
    /// Turns by an angle, radians, positive to the left.
    Turn { angle: f64 },
    /// Turns towards something.
    Face { what: Reference },
    /// Turns away from something.
    TurnFrom { what: Reference },
    /// Turns to a direction of the compass.
    FaceCompass(Compass),
    /// Drives on to a junction, the nth from here, and takes a turn there.
    TurnAt { turn: Turn, nth: u32, lights: Lights },
    /// Drives once round the block.
    Block,
    /// Stops at the kerb, at a place if one is given.
    Park { at: Option<(Reference, Option<Spot>)> },
    /// Does something and stays there for a while, s; where it is about several things, at each of them.
    Stay { body: Box<Self>, seconds: f64 },
    /// Raises (or, below zero, lowers) the gaze, radians.
    LookUp { angle: f64 },
    /// Points at something.
    Point { at: Reference },
    /// Waves at somebody.
    Wave { to: Reference },
    /// Says something to somebody.
    Say { to: Reference, words: String },
    /// Argues with somebody.
    Argue { with: Reference },
    /// Opens or closes a door.
    Door { what: Option<Reference>, open: bool },
    /// Takes photos, of something if it is named.
    Photo { of: Option<Reference>, times: u32 },
    /// Changes speed, m/s.
    Speed { speed: f64 },
    /// Does one thing or another.
    If { test: Test, then: Vec<Self>, otherwise: Vec<Self> },
    /// Does it over and over until something holds; with nothing to do, waits for it.
    Until { test: Test, body: Vec<Self> },
    /// Does it several times.
    Repeat { times: u32, body: Vec<Self> },
}

/// A condition that refers to things.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Test {
    Light {
        light: Option<Reference>,
        shows: Aspect,
    },
    Sees(Reference),
    Near {
        what: Reference,
        within: f64,
    },
    /// There is one near, free or not.
    There {
        what: Reference,
        free: bool,
    },
    InUse(Reference),
    Open(Reference),
    Holds(Option<Reference>),
    /// Two others are near one another.
    Together {
        one: Reference,
        other: Box<Reference>,
        within: f64,
    },
    Seated,
    Raining,
    Snowing,
    Dark,
    Elapsed(f64),
    /// One that refers to nothing that has to be found first.
    #[cfg(feature = "thought")]
    Stated(simworld_core::seam::Condition),
    /// Never: what is done goes on until somebody says otherwise.
    Never,
    Not(Box<Self>),
    Both(Box<Self>, Box<Self>),
    Either(Box<Self>, Box<Self>),
}

impl Test {
    /// The contrary; that of a contrary is the thing itself.
    pub(super) fn contrary(self) -> Self {
        match self {
            Self::Not(test) => *test,
            test => Self::Not(Box::new(test)),
        }
    }

    /// Whether a pronoun in it stands for what the order is about: "unless it is taken".
    pub(super) fn is_about_it(&self) -> bool {
        match self {
            Self::Sees(what)
            | Self::Near { what, .. }
            | Self::There { what, .. }
            | Self::InUse(what)
            | Self::Open(what)
            | Self::Holds(Some(what))
            | Self::Together { one: what, .. } => matches!(what.target, Target::It | Target::Them),
            Self::Not(test) => test.is_about_it(),
            Self::Both(one, other) | Self::Either(one, other) => one.is_about_it() || other.is_about_it(),
            _ => false,
        }
    }
}

/// Which junctions count.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Lights {
    /// Those with signals.
    Only,
    /// All of them.
    Any,
}

/// Where beside a thing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Spot {
    /// On a side of it as it stands, with so much room between, m.
    Beside(Relation, Option<f64>),
    /// On a side of it by the compass, so far from its middle, m.
    Compass(Compass, Option<f64>),
}

/// In which direction one goes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Course {
    /// By the compass.
    Compass(Compass),
    /// As one is turned.
    Relative(StepDirection),
}

/// How fast one goes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Pace {
    /// As the body pleases.
    Usual,
    /// Running.
    Run,
    /// Strolling.
    Slow,
    /// At a speed, m/s.
    At(f64),
}

/// What the words for taking allow.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Grip {
    /// Lifting it: "pick up".
    Lift,
    /// Lifting it or riding in or on it: "take the taxi".
    LiftOrRide,
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
    /// The place in the order of the choice, from 1: the second tallest is 2.
    pub(super) place: u32,
    pub(super) count: Count,
    pub(super) traits: Traits,
    /// How it stands to something else.
    pub(super) relation: Option<Stands>,
    /// Whether any of the class will do ("a bench") and not a certain one ("the bench").
    pub(super) indefinite: bool,
    /// Which of them are not meant.
    pub(super) except: Option<Box<Self>>,
    /// Of every nth, which one is the first, if that was said.
    pub(super) first: Option<First>,
    /// The words themselves, for answers.
    pub(super) text: String,
}

/// The first of every nth.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum First {
    /// By its place in the row, from 1.
    Nth(u8),
    /// The one farthest in a direction.
    Compass(Compass),
}

/// What is said of the thing itself.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Traits {
    pub(super) paint: Option<Paint>,
    /// The colours that it does not have.
    pub(super) unlike: Vec<Paint>,
    pub(super) free: bool,
    pub(super) parked: bool,
    /// An attribute of doors that is set or not.
    pub(super) state: Option<(&'static str, bool)>,
    /// What is sold there.
    pub(super) sells: Option<Box<str>>,
    /// Not the one spoken of last.
    pub(super) other: bool,
    /// More or, with `false`, less of a measure than this, in m and kg.
    pub(super) than: Option<(Measure, bool, f64)>,
    /// The name of the asset that it is made of: "the beehive", "the oak".
    pub(super) sort: Option<std::sync::Arc<String>>,
}

/// What a phrase names.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Target {
    /// What was spoken of last.
    It,
    /// Who was spoken of last.
    Them,
    /// Where one went last.
    There,
    /// Where one was when the sentence was said.
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
    /// Not said.
    Open,
    /// The nearest.
    Nearest,
    /// The farthest.
    Farthest,
    /// The nth, counted from the nearest, from 1.
    Nth(u32),
    /// The one farthest in a direction.
    Compass(Compass),
    /// The one with the most or, with `false`, the least of a measure.
    Most(Measure, bool),
    /// The one farthest to a side of the agent.
    Side(Side),
    /// The one in the middle of an odd number.
    Middle,
}

/// What can be compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Measure {
    Height,
    Volume,
    Mass,
}

/// How many are meant.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Count {
    One,
    Exactly(u32),
    All,
}

impl Reference {
    pub(super) fn to(target: Target, text: String) -> Self {
        Self {
            target,
            choice: Choice::Open,
            place: 1,
            count: Count::One,
            traits: Traits::default(),
            relation: None,
            indefinite: false,
            except: None,
            first: None,
            text,
        }
    }

    /// "The nearest" of a class.
    pub(super) fn nearest(category: &'static Category) -> Self {
        let text = category.words[0].to_owned();
        Self { choice: Choice::Nearest, ..Self::to(Target::Any(category), text) }
    }
}

/// The thing that an order is about, by whichever reference the order is given.
macro_rules! about {
    ($clause:expr) => {
        match $clause {
            Self::Go { to: what, .. }
            | Self::Take { what, .. }
            | Self::Wave { to: what }
            | Self::Say { to: what, .. }
            | Self::Face { what }
            | Self::Point { at: what }
            | Self::Argue { with: what }
            | Self::Follow { whom: what, .. }
            | Self::Board { what, .. }
            | Self::Drive { to: what, .. }
            | Self::Around { what, .. }
            | Self::Past { what, .. }
            | Self::Buy { at: Some(what), .. }
            | Self::Door { what: Some(what), .. }
            | Self::Sit { on: Some(what) }
            | Self::Photo { of: Some(what), .. } => Some(what),
            _ => None,
        }
    };
}

impl Clause {
    /// The phrase that says how many times the order is to be done: to both chairs, at two people.
    pub(super) fn plural(&mut self) -> Option<&mut Reference> {
        let (Self::Go { to: what, .. }
        | Self::Wave { to: what }
        | Self::Say { to: what, .. }
        | Self::Take { what, .. }
        | Self::Face { what }
        | Self::Point { at: what }
        | Self::Argue { with: what }
        | Self::Follow { whom: what, .. }
        | Self::Drop { what: Some(what), .. }
        | Self::Give { what: Some(what), .. }
        | Self::Throw { what: Some(what), .. }
        | Self::Door { what: Some(what), .. }
        | Self::Sit { on: Some(what) }
        | Self::Photo { of: Some(what), .. }) = self
        else {
            return if let Self::Stay { body, .. } = self { body.plural() } else { None };
        };
        (what.count != Count::One).then_some(what)
    }

    /// The thing that an order is about, if it is about one.
    pub(super) const fn about(&self) -> Option<&Reference> {
        about!(self)
    }

    /// The thing that is handed over or put down.
    pub(super) const fn handled(&self) -> Option<&Reference> {
        match self {
            Self::Give { what: Some(what), .. }
            | Self::Throw { what: Some(what), .. }
            | Self::Drop { what: Some(what), .. } => Some(what),
            _ => None,
        }
    }

    /// As [`about`](Self::about), to be put in another's place.
    pub(super) const fn about_mut(&mut self) -> Option<&mut Reference> {
        about!(self)
    }

    /// How fast one goes, if the order is about going.
    pub(super) const fn pace(&mut self) -> Option<&mut Pace> {
        match self {
            Self::Go { pace, .. }
            | Self::Walk { pace, .. }
            | Self::Past { pace, .. }
            | Self::Around { pace, .. }
            | Self::Halfway { pace, .. }
            | Self::Follow { pace, .. }
            | Self::Drive { pace, .. } => Some(pace),
            _ => None,
        }
    }

    /// Whether doing it twice in a row is doing something twice: waving is, sitting down is not.
    pub(super) const fn is_repeatable(&self) -> bool {
        matches!(
            self,
            Self::Wave { .. }
                | Self::Turn { .. }
                | Self::Step { .. }
                | Self::Photo { .. }
                | Self::Say { .. }
                | Self::Argue { .. }
                | Self::Point { .. }
                | Self::Buy { .. }
                | Self::LookUp { .. }
        )
    }
}
