//! Why there is no city.

use simworld_core::net::NetworkError;
use simworld_core::scene::WorldError;
use thiserror::Error;

/// Why a city cannot be made.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum CityError {
    /// A setting out of range.
    #[error("{field} = {value} is out of range: give {allowed}")]
    Config {
        /// The setting, as a path.
        field: &'static str,
        /// Its value.
        value: f64,
        /// What is allowed, in words.
        allowed: &'static str,
    },
    /// A source without streets.
    #[error("the source holds no street that can be built: give one with streets of 15 m and more")]
    NoStreets,
    /// The streets cannot be built.
    #[error(transparent)]
    Network(#[from] NetworkError),
    /// The world refused an entity.
    #[error(transparent)]
    World(#[from] WorldError),
}
