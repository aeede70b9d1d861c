//! Where a thing stands that is spoken of: by another thing, a street, a distance, a direction or a side.

use simworld_core::id::RoadId;
use simworld_core::scene::Relation;

use super::clause::Reference;
use super::compass::Compass;

/// How a thing stands to others.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Stands {
    /// In a relation to one thing.
    To(Relation, Box<Reference>),
    /// As a part of it or right at it: the door of the library.
    Of(Box<Reference>),
    /// Between two things.
    Between(Box<Reference>, Box<Reference>),
    /// Nearest to a thing or, with `false`, farthest from it.
    NearestTo(Box<Reference>, bool),
    /// On a side of the agent.
    Side(Side),
    /// On the edge of a street.
    OnStreet(Vec<RoadId>),
    /// On the edge of a street, on the side of it that lies in a direction.
    SideOfStreet(Compass, Vec<RoadId>),
    /// With a gap of at most so much to a thing, m.
    Within(f64, Box<Reference>),
    /// With a gap of at least so much to a thing, m.
    Beyond(f64, Box<Reference>),
    /// In a direction from a thing or, without one, from the agent.
    Compass(Compass, Option<Box<Reference>>),
    /// In all of these ways.
    All(Vec<Self>),
}

/// A side of the agent, as it will be turned by then.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Side {
    Left,
    Right,
    Ahead,
    Behind,
}
