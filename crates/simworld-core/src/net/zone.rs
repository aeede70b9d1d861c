//! Where ways across an intersection meet: the stretch of each on which a vehicle could touch one on the other.

use serde::{Deserialize, Serialize};

use super::Connection;
use crate::geometry::Point2;

/// Room before and behind the stretch, m.
const ROOM: f64 = 0.3;
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
        let enter = first.map_or(0.0, |first| self.points[first.saturating_sub(1)].0);
        let leave = if ends == Ends::Together {
            f32::INFINITY
        } else {
            let last = self.points.iter().rposition(is_near);
            let behind = last.and_then(|last| self.points.get(last + 1));
            (behind.map_or(self.length, |point| point.0) + ROOM) as f32
        };
        Zone { enter: (enter - ROOM).max(0.0) as f32, leave }
    }
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
