//! Why an edit of a city is refused.

use simworld_core::net::{NetworkError, PatchError};
use simworld_core::patch::Misfit;
use thiserror::Error;

use crate::graph::GraphError;
use crate::terrain::BridgeWarning;

/// Why an edit is refused; the city is as it was.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum EditError {
    /// The streets would not fit together. The numbers of streets and nodes are those of the part of the city round the edit.
    #[error("near the edit: {0}")]
    Streets(#[from] GraphError),
    /// The roads cannot be derived.
    #[error(transparent)]
    Network(#[from] NetworkError),
    /// A bridge would be too low.
    #[error(transparent)]
    Bridge(#[from] BridgeWarning),
    /// A patch that is for other roads.
    #[error(transparent)]
    Roads(#[from] PatchError),
    /// A patch that is for another city.
    #[error(transparent)]
    Misfit(#[from] Misfit),
    /// There is no such thing in the city.
    #[error("there is no {what} {index}: the city has {count}")]
    Missing {
        /// What was asked for.
        what: &'static str,
        /// Its index.
        index: usize,
        /// How many there are.
        count: usize,
    },
    /// A building or an element of an impossible size or place.
    #[error("the {what} has no possible size or place: give finite metres, sizes of 0.01 to 2000 m")]
    Size {
        /// What it is.
        what: &'static str,
    },
    /// A building far from any sidewalk.
    #[error("no sidewalk lies within {reach} m of ({x:.1}, {y:.1}): build nearer to a street")]
    NoStreet {
        /// East of the origin, m.
        x: f64,
        /// North of the origin, m.
        y: f64,
        /// How far a door may be from a sidewalk, m.
        reach: f64,
    },
    /// The place is taken.
    #[error("the place at ({x:.1}, {y:.1}) is taken by {by}: choose another one, or take that away first")]
    Taken {
        /// East of the origin, m.
        x: f64,
        /// North of the origin, m.
        y: f64,
        /// What stands there.
        by: String,
    },
}
