//! Why streets make no planar graph.

use simworld_core::net::NetworkError;
use thiserror::Error;

use super::{NodeId, StreetId};

/// Why streets make no planar graph, or an edit is refused. A refused edit changes nothing.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum GraphError {
    /// The plan, or the street of an edit, cannot be built by itself.
    #[error(transparent)]
    Plan(#[from] NetworkError),
    /// Two streets touch where they have no node in common.
    #[error(
        "streets {first} and {second} touch at ({x:.2}, {y:.2}) without a node there: put one on both, or part them"
    )]
    Touching {
        /// The street that was there.
        first: StreetId,
        /// The street that came; the same one if it touches itself.
        second: StreetId,
        /// East of the origin, m.
        x: f64,
        /// North of the origin, m.
        y: f64,
    },
    /// A street would join two nodes that a street joins already.
    #[error("nodes {from} and {to} are joined by street {present} already: remove it, or put a node on one")]
    Joined {
        /// One end.
        from: NodeId,
        /// The other end.
        to: NodeId,
        /// The street between them.
        present: StreetId,
    },
    /// A course that is no line.
    #[error("a street needs a course of at least two points, all within ±1e7 m: {points} given")]
    Course {
        /// Number of points given.
        points: usize,
    },
    /// There is no such street.
    #[error("there is no street {0}: it was removed, or never built")]
    NoStreet(StreetId),
    /// There is no such node.
    #[error("there is no node {0}: it was removed, or never built")]
    NoNode(NodeId),
}
