//! Where lanes begin and end, looked up once for all the ways that lead there.

use crate::geometry::{Point2, Vector2, direction, heading};
use crate::net::{Lane, polyline};

/// A point and the direction of traffic there.
pub(super) type End = (Point2, Vector2);

/// Both ends of a lane.
pub(super) struct Ends {
    pub(super) begin: End,
    pub(super) end: End,
}

/// Those of a lane.
pub(super) fn of(lane: &Lane) -> Ends {
    let along = |step: Option<Vector2>| direction(step.map_or(0.0, |step| heading(&step)));
    let (begin, first) = polyline::at_piece(&lane.path, 0.0);
    let (end, last) = polyline::at_piece(&lane.path, lane.length);
    let leaving = along(first);
    // A straight lane has one piece.
    Ends { begin: (begin, leaving), end: (end, if last == first { leaving } else { along(last) }) }
}
