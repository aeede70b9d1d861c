//! What a sentence about the scene means, before anything is looked for.

use simworld_core::geometry::Point2;
use simworld_core::id::RoadId;
use simworld_core::passage::Passage;
use simworld_core::scene::Relation;

use super::super::clause::{Count, Reference, Target};
use super::super::compass::Compass;
use super::super::paint::Paint;
use super::measures::Size;
use super::words::Sky;
use crate::editing::Spacing;

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
    /// Makes things of a size that is told by measure, or by another thing.
    Resize {
        what: Vec<Reference>,
        size: Size,
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
    /// Of several classes together.
    CountAll {
        what: Vec<Reference>,
        text: String,
    },
    List {
        what: Option<Reference>,
        at: Vec<Where>,
    },
    Describe {
        what: Reference,
    },
    Sky(Vec<Sky>),
    /// New things at even distances.
    Row {
        thing: NewThing,
        line: Where,
        spacing: Spacing,
    },
    /// Closes streets, or opens them.
    Passage {
        which: Vec<StreetRef>,
        passage: Passage,
    },
    /// Changes nothing, and says why.
    Nothing {
        why: String,
    },
    /// Gives each of several things a colour of its own.
    PaintEach {
        what: Vec<Reference>,
        paints: Vec<Paint>,
    },
    /// Gives things the colour of another.
    PaintLike {
        what: Vec<Reference>,
        like: Reference,
    },
    /// Asks which of these streets are closed; without any, which of all.
    AskPassage {
        which: Vec<StreetRef>,
    },
    /// Asks what time it is, and what the weather is like.
    AskSky,
    /// Asks how far one thing is from another.
    AskDistance {
        one: Reference,
        other: Reference,
    },
    /// Only if the sky is so or, with `false`, if it is not.
    When {
        sky: Vec<Sky>,
        so: bool,
        then: Box<Self>,
    },
    /// Only if these streets are closed or, with `false`, are not.
    WhenPassage {
        which: Vec<StreetRef>,
        closed: bool,
        then: Box<Self>,
    },
    /// Only if something is larger in some way than another or, with `false`, if it is not.
    WhenLarger {
        one: Reference,
        other: Reference,
        extent: super::measures::Extent,
        larger: bool,
        then: Box<Self>,
    },
    /// Several at once, in the scene as it is before the first.
    All(Vec<Self>),
    /// Only if there are so many of such things or, with `false`, if there are not.
    Given {
        what: Reference,
        least: u32,
        there: bool,
        then: Box<Self>,
    },
}

/// A street that is spoken of.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum StreetRef {
    /// By its name; between two that cross it, if they are named.
    Named { roads: Vec<RoadId>, between: Option<[Vec<RoadId>; 2]> },
    /// Of a street the pieces on a side of where another crosses it.
    Beyond { roads: Vec<RoadId>, compass: Compass, cross: Vec<RoadId> },
    /// Of a street the pieces on a side of its middle.
    Half(Vec<RoadId>, Compass),
    /// By how it runs to a thing.
    To(Relation, Reference),
    /// All around a thing.
    Around(Reference),
    /// The nearest to who looks at the scene.
    Nearest,
    /// What was spoken of last.
    It,
    /// Whatever is closed.
    Closed,
    /// A thing, which is no street.
    Thing(Reference),
    /// A name that no street bears.
    Unknown(String),
}

/// A thing that is to be made, in the words that name it.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct NewThing {
    /// Its noun and what is said of it, without count, colour and size.
    pub(super) words: Vec<String>,
    pub(super) count: u32,
    /// Whether they are several, and nobody says how many.
    pub(super) many: bool,
    pub(super) paint: Option<Paint>,
    pub(super) scale: f64,
    /// The size that it is to have, if one was said by measure or by another thing.
    pub(super) size: Option<Size>,
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
    /// At each of the four corners.
    Corners(Anchor),
    Compass(Compass, Anchor),
    At(Point2),
    /// Beside a thing, or in an area.
    By(Anchor),
    /// Near, and all around if there are many.
    Around(Anchor),
    /// On both sides of a street.
    BothSides(Anchor),
    /// A gap of so much, m, in a direction.
    Offset(f64, Bearing, Anchor),
    /// A gap within these, m, in any direction.
    Apart(f64, f64, Anchor),
    Block(Anchor),
    Middle(Anchor),
    Edge(Anchor),
    /// Where two streets meet.
    Junction(Vec<RoadId>, Vec<RoadId>, String),
    /// So far from where it is now as it is turned, m forward and to the left.
    ShiftOwn(f64, f64),
    /// So far from where it is now, m east and north.
    Shift(f64, f64),
    /// So far from where it is now to a thing or, below zero, away from it, m.
    Nearer(f64, Anchor),
    /// Half of the way to a thing.
    Halfway(Anchor),
    /// At an end of a street, the one in a direction if one is named.
    End(Option<Compass>, Vec<RoadId>, String),
    /// At both ends of a street.
    Ends(Vec<RoadId>, String),
    /// In the corner, or the half, of a thing that lies in a direction.
    Part(Compass, Part, Anchor),
    Here,
    /// Where what was spoken of last stands, or stood.
    There,
    Anywhere,
}

/// What of a thing lies in a direction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Part {
    Corner,
    /// Of an area.
    Half,
}

/// A direction from a thing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Bearing {
    /// By the compass.
    Compass(Compass),
    /// By the thing's own front: before it, behind it, to its left, to its right.
    Side(Relation),
}

/// What something is to stand to.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Anchor {
    Thing(Reference),
    /// A street by its name.
    Street(String, Vec<RoadId>),
    /// Itself.
    Itself,
    /// What was spoken of last.
    It,
    /// Who looks at the scene.
    Viewer,
}

impl Wish {
    /// Takes "it" for the first of the things that a remark was about, and behind "far from" and the like for the last of
    /// several, or for the only one if the wish itself is about something else.
    pub(super) fn is_about(&mut self, things: &[Reference]) {
        let (Some(first), Some(last)) = (things.first(), things.last()) else { return };
        let mut taken = false;
        // "Let her face it": it is what she is told of with.
        if let Self::Face { what, towards } = self
            && what.iter().all(|one| matches!(one.target, Target::It | Target::Them))
            && matches!(towards.target, Target::It | Target::Them)
        {
            *towards = last.clone();
        }
        // "The taxi and the van: swap them", "Anna and Ben are hungry, put a table between them".
        let is_open = |one: &Reference| matches!(one.target, Target::It | Target::Them);
        if let Self::Swap { one, other: other @ None } = self
            && things.len() > 1
            && is_open(one)
        {
            (*one, *other) = (first.clone(), Some(last.clone()));
            return;
        }
        for place in self.places_mut() {
            if let Where::Between(one, other) = place
                && things.len() > 1
                && one.is_it()
                && other.is_it()
            {
                (*one, *other) = (Anchor::Thing(first.clone()), Anchor::Thing(last.clone()));
            }
        }
        for one in self.objects_mut() {
            if matches!(one.target, Target::It | Target::Them) {
                *one = as_said(one, first);
                taken = true;
            }
        }
        if taken && things.len() == 1 {
            return;
        }
        for anchor in self.places_mut().iter_mut().filter_map(Where::anchor_mut) {
            if let Anchor::Thing(it) = anchor
                && matches!(it.target, Target::It | Target::Them)
            {
                *anchor = Anchor::Thing(as_said(it, last));
            } else if anchor.is_it() {
                *anchor = Anchor::Thing(last.clone());
            }
        }
    }

    /// What is changed, if it is one thing.
    pub(super) fn object(&self) -> Option<&Reference> {
        match self {
            Self::Move { what, .. }
            | Self::Remove { what }
            | Self::Rotate { what, .. }
            | Self::FaceCompass { what, .. }
            | Self::Face { what, .. }
            | Self::Paint { what, .. }
            | Self::Resize { what, .. }
            | Self::Scale { what, .. } => what.first().filter(|_| what.len() == 1),
            _ => None,
        }
    }

    /// Puts new things where a remark was about, if they have no place of their own.
    pub(super) fn stands(&mut self, place: &[Where]) {
        if let Self::Add { at, .. } = self
            && !place.is_empty()
            && (at.is_empty() || *at == [Where::There])
        {
            *at = place.to_vec();
        }
    }

    /// What is changed.
    pub(super) fn objects_mut(&mut self) -> Vec<&mut Reference> {
        match self {
            Self::Move { what, .. }
            | Self::Remove { what }
            | Self::Rotate { what, .. }
            | Self::FaceCompass { what, .. }
            | Self::Paint { what, .. }
            | Self::PaintEach { what, .. }
            | Self::Resize { what, .. }
            | Self::Scale { what, .. } => what.iter_mut().collect(),
            Self::Face { what, towards } => what.iter_mut().chain([towards]).collect(),
            Self::Replace { what, .. }
            | Self::Copy { what, .. }
            | Self::Multiply { what, .. }
            | Self::Name { what, .. }
            | Self::Describe { what } => vec![what],
            Self::Swap { one, other } => std::iter::once(one).chain(other).collect(),
            Self::Passage { which, .. } => which
                .iter_mut()
                .filter_map(|street| match street {
                    StreetRef::To(_, thing) | StreetRef::Around(thing) | StreetRef::Thing(thing) => {
                        Some(thing)
                    }
                    _ => None,
                })
                .collect(),
            _ => Vec::new(),
        }
    }

    /// Where something is to stand.
    pub(super) fn places_mut(&mut self) -> &mut [Where] {
        match self {
            Self::Move { at, .. } | Self::Add { at, .. } | Self::Copy { at, .. } => at,
            Self::Row { line, .. } => std::slice::from_mut(line),
            _ => &mut [],
        }
    }
}

/// What was spoken of, all of it where "each of them" is said.
fn as_said(it: &Reference, of: &Reference) -> Reference {
    let each = ["each of", "all of", "every one of", "both of"].iter().any(|each| it.text.contains(each));
    let count = if each || it.count == Count::All { Count::All } else { of.count };
    Reference { count, ..of.clone() }
}

impl Anchor {
    /// Whether it says nothing but what was spoken of.
    pub(super) const fn is_it(&self) -> bool {
        match self {
            Self::It => true,
            Self::Thing(reference) => matches!(reference.target, Target::It | Target::Them),
            _ => false,
        }
    }
}

impl Anchor {
    /// Whether it says no more than "the building", behind one that was named.
    pub(super) fn is_the_building(&self) -> bool {
        matches!(self, Self::Thing(own) if ["building", "house", "place"].contains(&own.text.as_str())
            && *own == Reference::to(own.target.clone(), own.text.clone()))
            && matches!(self, Self::Thing(own) if matches!(own.target, Target::Any(_)))
    }
}

impl Where {
    /// Takes "it" for what was named before in the same wish, and writes down what is named here.
    pub(super) fn means(&mut self, named: &mut Option<Anchor>) {
        let Some(anchor) = self.anchor_mut() else { return };
        let is_it = anchor.is_it();
        match named {
            Some(named) if is_it => *anchor = named.clone(),
            _ if !is_it => *named = Some(anchor.clone()),
            _ => {}
        }
    }

    /// What it is to, if it is to something.
    pub(super) const fn anchor_mut(&mut self) -> Option<&mut Anchor> {
        match self {
            Self::To(_, anchor)
            | Self::Between(anchor, _)
            | Self::Across(anchor)
            | Self::Along(anchor)
            | Self::Corner(anchor)
            | Self::Corners(anchor)
            | Self::By(anchor)
            | Self::Around(anchor)
            | Self::BothSides(anchor)
            | Self::Offset(_, _, anchor)
            | Self::Apart(_, _, anchor)
            | Self::Block(anchor)
            | Self::Middle(anchor)
            | Self::Edge(anchor)
            | Self::Nearer(_, anchor)
            | Self::Halfway(anchor)
            | Self::Part(_, _, anchor)
            | Self::Compass(_, anchor) => Some(anchor),
            Self::At(_)
            | Self::End(..)
            | Self::Ends(..)
            | Self::Shift(..)
            | Self::ShiftOwn(..)
            | Self::Junction(..)
            | Self::Here
            | Self::There
            | Self::Anywhere => None,
        }
    }
}
