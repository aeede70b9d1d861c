//! Long vehicles in tight bends: their rear axle cuts the corner and their nose swings out, so that they need more than their lane.

use simworld_core::control::Driver;
use simworld_core::geometry::Point2;
use simworld_core::id::ConnectionId;
use simworld_core::net::{Connection, RoadNetwork, polyline};
use simworld_core::ops::wrap_angle;

use super::watch::Own;

/// Shorter ones keep to their lane, m.
const LONG: f64 = 6.0;
/// Less of a turn is no bend, radians.
const BENT: f64 = 0.3;
/// Half the width that others are taken to have, m: a van's; and the room between both, m.
const OTHERS: f64 = 1.0;
const ROOM: f64 = 0.3;

/// The ways across the same junction that do not meet a turn, and on which one would be met while one swings through it, each with
/// how near its middle comes to be met, m.
pub(super) fn swung_into(
    network: &RoadNetwork,
    turn: &Connection,
    own: &Own<'_>,
) -> Vec<(ConnectionId, f64)> {
    let heading = |way: &Connection, station: f64| polyline::at(&way.path, station).1;
    let turned = wrap_angle(heading(turn, turn.length) - heading(turn, 0.0)).abs();
    if own.half_length * 2.0 < LONG || turned < BENT {
        return Vec::new();
    }
    // On a circle the rear axle is so much farther inside than the front one.
    let (wheelbase, radius) = (Driver::of_length(own.half_length * 2.0).wheelbase, turn.length / turned);
    let near = own.half_width + OTHERS + ROOM + wheelbase * wheelbase / (2.0 * radius);
    let comes_near = |other: &Connection| {
        let distance =
            |point: &Point2| polyline::closest(&turn.path, point).map_or(f64::INFINITY, |near| near.distance);
        other.path.iter().any(|point| distance(point) < near)
    };
    let ways = network.intersections[turn.intersection.index()].connections.iter();
    let beside = ways.filter(|id| {
        let other = &network.connections[id.index()];
        other.from != turn.from
            && other.to != turn.to
            && turn.conflicts.binary_search(id).is_err()
            && comes_near(other)
    });
    beside.map(|id| (*id, near)).collect()
}
