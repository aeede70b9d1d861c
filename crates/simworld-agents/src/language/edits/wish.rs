//! What a sentence about the scene means, before anything is looked for.

use simworld_core::geometry::Point2;
use simworld_core::scene::Relation;

use super::super::clause::{Reference, Target};
use super::super::compass::Compass;
use super::super::paint::Paint;
use super::words::Sky;

/// One wish.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Wish {
    Add {
        things: Vec<NewThing>,
        at: Vec<Where>,
    },
    Remove {
        what: Vec<Reference>,
    },
    Move {
        what: Vec<Reference>,
        at: Vec<Where>,
    },
    /// Takes one away and puts another just there.
    Replace {
        what: Reference,
        with: NewThing,
    },
    Rotate {
        what: Vec<Reference>,
        angle: f64,
    },
    Face {
        what: Vec<Reference>,
        towards: Reference,
    },
    /// Looks in a direction of the compass.
    FaceCompass {
        what: Vec<Reference>,
        compass: Compass,
    },
    Swap {
        one: Reference,
        other: Option<Reference>,
    },
    Paint {
        what: Vec<Reference>,
        paint: Paint,
    },
    Scale {
        what: Vec<Reference>,
        factor: f64,
    },
    Copy {
        what: Reference,
        count: u32,
        at: Vec<Where>,
    },
    /// As many more as there are.
    Multiply {
        what: Reference,
        times: u32,
    },
    Name {
        what: Reference,
        name: String,
    },
    Count {
        what: Reference,
    },
    List {
        what: Option<Reference>,
        at: Vec<Where>,
    },
    Describe {
        what: Reference,
    },
    Sky(Vec<Sky>),
}

/// A thing that is to be made, in the words that name it.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct NewThing {
    /// Its noun and what is said of it, without count, colour and size.
    pub(super) words: Vec<String>,
    pub(super) count: u32,
    pub(super) paint: Option<Paint>,
    pub(super) scale: f64,
    pub(super) name: Option<String>,
    /// The words themselves, for answers.
    pub(super) text: String,
}

/// Where something is to stand.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Where {
    To(Relation, Anchor),
    Between(Anchor, Anchor),
    Across(Anchor),
    Along(Anchor),
    Corner(Anchor),
    Compass(Compass, Anchor),
    At(Point2),
    /// So far from where it is now, m east and north.
    Shift(f64, f64),
    Here,
    /// Where what was spoken of last stands, or stood.
    There,
    Anywhere,
}

/// What something is to stand to.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Anchor {
    Thing(Reference),
    /// A street by its name.
    Street(String),
    /// Itself.
    Itself,
    /// What was spoken of last.
    It,
    /// Who looks at the scene.
    Viewer,
}

impl Where {
    /// Takes "it" for what was named before in the same wish, and writes down what is named here.
    pub(super) fn means(&mut self, named: &mut Option<Anchor>) {
        let anchor = match self {
            Self::To(_, anchor)
            | Self::Between(anchor, _)
            | Self::Across(anchor)
            | Self::Along(anchor)
            | Self::Corner(anchor)
            | Self::Compass(_, anchor) => anchor,
            Self::At(_) | Self::Shift(..) | Self::Here | Self::There | Self::Anywhere => return,
        };
        let is_it = match anchor {
            Anchor::It => true,
            Anchor::Thing(reference) => matches!(reference.target, Target::It | Target::Them),
            _ => false,
        };
        match named {
            Some(named) if is_it => *anchor = named.clone(),
            _ if !is_it => *named = Some(anchor.clone()),
            _ => {}
        }
    }
}
