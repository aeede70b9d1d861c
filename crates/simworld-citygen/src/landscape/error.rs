//! Why there is no such land.

use simworld_core::ground::GroundError;
use simworld_core::net::NetworkError;
use simworld_core::scene::WorldError;
use simworld_core::spec::SpecError;
use thiserror::Error;

/// Why a place beyond the city cannot be made as it is asked for.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum LandscapeError {
    /// The spec is out of range.
    #[error(transparent)]
    Spec(#[from] SpecError),
    /// A city is asked for.
    #[error(
        "a city is made by `settlement::Settlement`: ask it, or for a countryside, a wilderness or an island"
    )]
    City,
    /// Something that such a place does not have.
    #[error("a {kind} has no {what}: {instead}")]
    Unsuited {
        /// The kind of scene.
        kind: &'static str,
        /// What it does not have.
        what: String,
        /// What can be asked for.
        instead: &'static str,
    },
    /// It has too many houses.
    #[error("{wanted} buildings, squares and parks find no room, {most} at most did: ask for fewer")]
    TooMany {
        /// How many are wanted.
        wanted: usize,
        /// How many found room.
        most: usize,
    },
    /// It has too few streets.
    #[error(
        "{wanted} pieces of road are wanted and {have} are there: ask for more houses, which bring roads, or for a city"
    )]
    Streets {
        /// How many are wanted.
        wanted: u32,
        /// How many there are.
        have: usize,
    },
    /// Nothing of the library is called that.
    #[error(
        "the library has no thing called {name:?}: name an asset, such as lighthouse, windmill or church"
    )]
    Landmark {
        /// What was asked for.
        name: String,
    },
    /// The land has no place for it, or no way there.
    #[error("the land has no place for {what}, or no way leads there: try another seed")]
    NoPlace {
        /// For what.
        what: String,
    },
    /// Its roads cannot be built.
    #[error(transparent)]
    Roads(#[from] NetworkError),
    /// Its heights are none.
    #[error(transparent)]
    Ground(#[from] GroundError),
    /// The world refused an entity.
    #[error(transparent)]
    World(#[from] WorldError),
}
