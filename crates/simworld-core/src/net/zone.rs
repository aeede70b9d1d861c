//! Where ways across an intersection meet: the stretch of each on which a vehicle could touch one on the other.

use serde::{Deserialize, Serialize};

use super::Connection;
use crate::geometry::Point2;

/// Room before and behind the stretch, m.
const ROOM: f64 = 0.3;
/// How often the stretch between two points is halved to find where it begins: to some centimetres.
const HALVINGS: u32 = 5;
/// A rear so far beyond the beginning of a common end leaves room to follow it there, m.
const FOLLOW: f64 = 2.0;
/// A path that bends less than this is as good as straight, m.
const STRAIGHT: f64 = 0.05;

/// A stretch of a way on which it meets another, m along it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Zone {
    /// A front before this station touches nobody on the other way.
    pub enter: f32,
    /// A rear beyond this one touches nobody any more; infinite where both ways end in one lane.
    pub leave: f32,
}

impl Zone {
    /// Where a front touches nobody yet, m.
    pub fn enter(self) -> f64 {
        f64::from(self.enter)
    }

    /// Where a rear must be for the other to go on, m: out of the stretch, or far enough on it to be followed.
    pub fn passed(self) -> f64 {
        if self.leave.is_finite() { f64::from(self.leave) } else { self.enter() + FOLLOW }
    }
}

/// Whether two ways end in one lane.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Ends {
    /// They do: behind where they meet one follows the other.
    Together,
    /// They part again.
    Apart,
}

impl Ends {
    /// How two ways end.
    pub fn of(one: &Connection, other: &Connection) -> Self {
        if one.to == other.to { Self::Together } else { Self::Apart }
    }
}

/// A path as distances are taken from and to it.
///
/// ```
/// use simworld_core::net::{Ends, NetworkConfig, RoadNetwork, StreetPlan, WayTrace};
/// let network = RoadNetwork::derive(&StreetPlan::crossroads(100.0), &NetworkConfig::default())?;
/// let own = &network.connections[0];
/// let other = &network.connections[own.conflicts[0].index()];
/// let zone = WayTrace::new(own).zone(&WayTrace::new(other), 2.7, Ends::of(own, other));
/// assert!(zone.enter() < own.length && zone.passed() > zone.enter());
/// # Ok::<(), simworld_core::net::NetworkError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct WayTrace {
    /// Points about a metre apart, with their stations.
    points: Vec<(f64, Point2)>,
    /// The path with as few corners as do.
    corners: Vec<Point2>,
    length: f64,
}

impl WayTrace {
    /// That of a way across an intersection.
    pub fn new(way: &Connection) -> Self {
        let mut points = Vec::with_capacity(way.path.len());
        let mut station = 0.0;
        for piece in way.path.windows(2) {
            let step = piece[1] - piece[0];
            let span = step.norm();
            let parts = span.ceil().max(1.0);
            points.extend((0..parts as u32).map(|part| {
                let share = f64::from(part) / parts;
                (station + span * share, piece[0] + step * share)
            }));
            station += span;
        }
        points.extend(way.path.last().map(|last| (station, *last)));
        Self { points, corners: corners(&way.path), length: way.length }
    }

    /// Where this path is nearer to the other than `near`, m, with or without the common end of ways that merge in one lane; all
    /// of it if they are nowhere so near, for whoever says that they touch knows why.
    pub fn zone(&self, other: &Self, near: f64, ends: Ends) -> Zone {
        let square = near * near;
        let is_near = |(_, point): &(f64, Point2)| {
            other.corners.windows(2).any(|piece| square_to_piece(point, piece) < square)
        };
        let first = self.points.iter().position(is_near);
        // The point before the first that is near and the one behind the last are not.
        let enter = first.map_or(0.0, |first| match first.checked_sub(1) {
            Some(before) => between(self.points[before], self.points[first], is_near),
            None => self.points[first].0,
        });
        let leave = if ends == Ends::Together {
            f32::INFINITY
        } else {
            let last = self.points.iter().rposition(is_near);
            let leaves = last.and_then(|last| {
                let behind = self.points.get(last + 1)?;
                Some(between(*behind, self.points[last], is_near))
            });
            (leaves.unwrap_or(self.length) + ROOM) as f32
        };
        Zone { enter: (enter - ROOM).max(0.0) as f32, leave }
    }
}

/// The station between a point that is not near and one that is, at which a path is about to be near, m.
fn between(
    (mut far, far_point): (f64, Point2),
    (mut near, near_point): (f64, Point2),
    is_near: impl Fn(&(f64, Point2)) -> bool,
) -> f64 {
    let (from, span, step) = (far, near - far, near_point - far_point);
    for _ in 0..HALVINGS {
        let middle = (far + near) * 0.5;
        let point = far_point + step * ((middle - from) / span);
        if is_near(&(middle, point)) {
            near = middle;
        } else {
            far = middle;
        }
    }
    far
}

/// The corners of a path that are needed to stay near it.
fn corners(path: &[Point2]) -> Vec<Point2> {
    let (Some(first), Some(last)) = (path.first(), path.last()) else { return Vec::new() };
    let mut kept = vec![*first];
    let mut from = 0;
    for to in 2..path.len() {
        let piece = [path[from], path[to]];
        let between = &path[from + 1..to];
        if between.iter().any(|point| square_to_piece(point, &piece) > STRAIGHT * STRAIGHT) {
            from = to - 1;
            kept.push(path[from]);
        }
    }
    kept.push(*last);
    kept
}

/// The square of the distance of a point from a piece of a path, m².
fn square_to_piece(point: &Point2, piece: &[Point2]) -> f64 {
    let step = piece[1] - piece[0];
    let to_point = point - piece[0];
    let square = step.norm_squared();
    let along = if square > 0.0 { (to_point.dot(&step) / square).clamp(0.0, 1.0) } else { 0.0 };
    (to_point - step * along).norm_squared()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::net::{NetworkConfig, RoadNetwork, StreetPlan, Turn, polyline};

    #[test]
    fn a_zone_begins_and_ends_where_the_paths_come_near() {
        let network = RoadNetwork::derive(&StreetPlan::crossroads(100.0), &NetworkConfig::default());
        let network = network.expect("it is a plan");
        let mut met = 0;
        for own in network.connections.iter().filter(|way| way.turn != Turn::UTurn) {
            for other in own.conflicts.iter().map(|id| &network.connections[id.index()]) {
                let ends = Ends::of(own, other);
                let zone = WayTrace::new(own).zone(&WayTrace::new(other), 2.7, ends);
                let apart = |station: f64| {
                    let point = polyline::at(&own.path, station).0;
                    polyline::closest(&other.path, &point).map_or(0.0, |closest| closest.distance)
                };
                // Decimetres within the stretch they are as near as was asked for, as far as straight pieces stand for bends.
                let enters = zone.enter() + ROOM;
                if zone.enter() > 0.0 {
                    assert!((apart(enters) - 2.7).abs() < 0.15, "{} m where it begins", apart(enters));
                    met += 1;
                }
                if ends == Ends::Apart && f64::from(zone.leave) < own.length {
                    let leaves = f64::from(zone.leave) - ROOM;
                    assert!((apart(leaves) - 2.7).abs() < 0.15, "{} m where it ends", apart(leaves));
                    met += 1;
                }
            }
        }
        assert!(met > 20, "{met} ends of stretches");
    }
}
