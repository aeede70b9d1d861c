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
    /// Landmarks by name.
    #[error(
        "{name:?} finds no place of its own in a city: name a use, such as a museum, or ask for an island or a countryside"
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
    #[error("there is no room for {name}: ask for more streets, or for fewer squares and parks")]
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
