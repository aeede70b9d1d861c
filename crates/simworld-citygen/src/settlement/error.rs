//! Why there is no such place.

use simworld_core::scene::WorldError;
use simworld_core::spec::SpecError;
use thiserror::Error;

use crate::CityError;

/// Why a place cannot be made as it is asked for.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum SettlementError {
    /// The spec is out of range.
    #[error(transparent)]
    Spec(#[from] SpecError),
    /// Another kind of scene.
    #[error(
        "a {kind} is no place of streets and houses: ask for a city, a town or a village, or make it by `landscape::Landscape`"
    )]
    Kind {
        /// Its name.
        kind: &'static str,
    },
    /// A landmark that the library does not have.
    #[error(
        "the library has no building {name:?}: give a name of `Catalogue::library`, such as cathedral, or a use, such as museum"
    )]
    Landmark {
        /// What was asked for.
        name: String,
    },
    /// It has too many houses.
    #[error("{wanted} buildings find no room, {most} at most did: ask for fewer, or for more streets")]
    TooMany {
        /// How many are wanted.
        wanted: u32,
        /// How many there were at most.
        most: usize,
    },
    /// No open ground was left.
    #[error("there is no room for {name}: ask for more streets, or for fewer squares, parks and landmarks")]
    NoGround {
        /// What it is called.
        name: String,
    },
    /// The city cannot be made.
    #[error(transparent)]
    City(#[from] CityError),
    /// The world refused an entity.
    #[error(transparent)]
    World(#[from] WorldError),
}

/// What a place has otherwise than it was asked for.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum SettlementRemark {
    /// A landmark for which no block is large enough.
    #[error("{name} is built at {percent} % of its size: between the streets there is no room for more")]
    Smaller {
        /// What it is called.
        name: String,
        /// Of its length, width and height.
        percent: u32,
    },
    /// A landmark that stands beyond the outermost streets.
    #[error("{name} stands outside the streets: no block between them holds it")]
    Outside {
        /// What it is called.
        name: String,
    },
    /// Something that found no room in the part of the place that was named.
    #[error("{name} is not in that part of the place ({part}): there is no room for it there")]
    Elsewhere {
        /// What it is called.
        name: String,
        /// The part, as in [`Whereabouts`](simworld_core::spec::Whereabouts).
        part: &'static str,
    },
    /// Something that found no room beside what was named.
    #[error("{name} is {distance:.0} m from the {by}: nearer there is no room for it")]
    Apart {
        /// What it is called.
        name: String,
        /// What it was to be beside.
        by: String,
        /// How far its middle is from it, m.
        distance: f64,
    },
}
