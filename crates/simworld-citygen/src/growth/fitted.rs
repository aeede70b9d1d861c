//! Segments that fit: where they begin and where they arrive.

use simworld_core::geometry::Point2;
use simworld_core::net::RoadClass;

/// Where a segment begins.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Start {
    /// At a junction.
    Node(u32),
    /// In the middle of a street, which is split there.
    Middle(u32),
}

/// Where a segment arrives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Arrival {
    /// In the open.
    New(Point2),
    /// At a junction.
    Node(u32),
    /// On a street, which is split there.
    Interior(u32, Point2),
}

/// A proposal that may be built.
#[derive(Clone, Copy, Debug)]
pub(super) struct Fitted {
    pub(super) from: Start,
    pub(super) class: RoadClass,
    pub(super) arrival: Arrival,
}

impl Fitted {
    /// Whether it arrives in the open.
    pub(super) fn is_open(&self) -> bool {
        matches!(self.arrival, Arrival::New(_))
    }
}
