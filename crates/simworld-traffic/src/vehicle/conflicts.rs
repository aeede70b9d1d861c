//! Where ways across an intersection meet: the stretch of each on which a vehicle could touch one on the other.

use simworld_core::geometry::Point2;
use simworld_core::id::ConnectionId;
use simworld_core::net::{Connection, RoadNetwork};

use super::ragged::Ragged;
use super::types::is_long;
use crate::TrafficConfig;

/// Room beside a body for what it sweeps over in a turn: the chord of seven metres on a radius of eight, and toes, m.
const SWEPT: f64 = 0.9;
/// Room before and behind the stretch, m.
const ROOM: f64 = 0.3;
/// A rear so far beyond the beginning of a common end leaves room to follow it there, m.
const FOLLOW: f64 = 2.0;
/// A path that bends less than this is as good as straight, m.
const STRAIGHT: f64 = 0.05;

/// A stretch of a way on which it meets another, m along it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Zone {
    /// A front before this station touches nobody on the other way.
    pub(crate) enter: f32,
    /// A rear beyond this one touches nobody any more; infinite where both ways end in one lane.
    pub(crate) leave: f32,
}

impl Zone {
    pub(crate) fn enter(self) -> f64 {
        f64::from(self.enter)
    }

    /// Where a rear must be for the other to go on: out of the stretch, or far enough on it to be followed.
    pub(crate) fn passed(self) -> f64 {
        if self.leave.is_finite() { f64::from(self.leave) } else { self.enter() + FOLLOW }
    }
}

/// Another way that meets one's own.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Conflict {
    pub(crate) way: u32,
    /// Whether one gives way to it while both may go, and the least gap before who comes on it that one takes then, s.
    pub(crate) yields: bool,
    pub(crate) critical: f32,
    /// Whether both end in the same lane.
    pub(crate) merges: bool,
    pub(crate) own: Zone,
    pub(crate) other: Zone,
}

/// The ways that meet each way, in the order of their numbers.
pub(crate) fn conflicts(network: &RoadNetwork, config: &TrafficConfig) -> Ragged<Conflict> {
    let short = config.types.iter().filter(|row| !is_long(row.length));
    let near = short.map(|row| row.width).fold(0.0, f64::max) + SWEPT;
    let traces: Vec<Trace> = network.connections.iter().map(Trace::new).collect();
    let of = |(index, own): (usize, &Connection)| -> Vec<Conflict> {
        let conflict = |id: &ConnectionId| {
            let other = &network.connections[id.index()];
            let merges = own.to == other.to;
            let yields = own.yields_to.binary_search(id).is_ok();
            let (mine, theirs) = (&traces[index], &traces[id.index()]);
            Conflict {
                way: id.0,
                yields,
                critical: if yields { config.gaps.critical(network, own, other) as f32 } else { 0.0 },
                merges,
                own: mine.zone(theirs, near, merges),
                other: theirs.zone(mine, near, merges),
            }
        };
        own.conflicts.iter().map(conflict).collect()
    };
    network.connections.iter().enumerate().map(of).collect()
}

/// A path as distances are taken from and to it.
struct Trace {
    /// Points about a metre apart, with their stations.
    points: Vec<(f64, Point2)>,
    /// The path with as few corners as do.
    corners: Vec<Point2>,
    length: f64,
}

impl Trace {
    fn new(way: &Connection) -> Self {
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

    /// Where this path is nearer to the other than `near`; all of it if they are nowhere, for whoever says that they touch
    /// knows why.
    fn zone(&self, other: &Self, near: f64, merges: bool) -> Zone {
        let square = near * near;
        let is_near = |(_, point): &(f64, Point2)| {
            other.corners.windows(2).any(|piece| square_to_piece(point, piece) < square)
        };
        let first = self.points.iter().position(is_near);
        // The point before the first that is near and the one behind the last are not.
        let enter = first.map_or(0.0, |first| self.points[first.saturating_sub(1)].0);
        let leave = if merges {
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

#[cfg(test)]
mod tests {
    use simworld_core::net::{NetworkConfig, StreetPlan, Turn, polyline};

    use super::*;

    fn crossroads() -> (RoadNetwork, Ragged<Conflict>) {
        let plan = StreetPlan::crossroads(120.0);
        let network = RoadNetwork::derive(&plan, &NetworkConfig::default()).expect("it is a plan");
        let conflicts = conflicts(&network, &TrafficConfig::default());
        (network, conflicts)
    }

    #[test]
    fn outside_of_the_zones_two_ways_are_apart() {
        let (network, conflicts) = crossroads();
        let mut met = 0;
        for (index, way) in network.connections.iter().enumerate() {
            for conflict in &conflicts[index] {
                let other = &network.connections[conflict.way as usize];
                let mut station = 0.0;
                while station < way.length {
                    let point = polyline::at(&way.path, station).0;
                    let apart = polyline::closest(&other.path, &point).expect("a path").distance;
                    let outside = station < conflict.own.enter() || station > f64::from(conflict.own.leave);
                    assert!(apart > 2.4 || !outside, "{apart} m apart {station} m along {index}");
                    station += 0.25;
                    met += usize::from(outside);
                }
            }
        }
        assert!(met > 1000, "zones are not whole ways: {met}");
    }

    #[test]
    fn both_sides_tell_the_same_of_a_meeting() {
        let (network, conflicts) = crossroads();
        for index in 0..network.connections.len() {
            for conflict in &conflicts[index] {
                let back = conflicts[conflict.way as usize].iter().find(|back| back.way as usize == index);
                let back = back.expect("who touches is touched");
                assert_eq!(
                    (back.own, back.other, back.merges),
                    (conflict.other, conflict.own, conflict.merges)
                );
                assert!(!(back.yields && conflict.yields));
            }
        }
    }

    #[test]
    fn who_goes_straight_across_is_out_of_the_way_half_way() {
        let (network, conflicts) = crossroads();
        let straight = |index: &u32| network.connections[*index as usize].turn == Turn::Straight;
        let pair = (0..network.connections.len() as u32).filter(straight).find_map(|index| {
            let crossing =
                conflicts[index as usize].iter().find(|conflict| straight(&conflict.way) && !conflict.merges);
            Some((index, *crossing?))
        });
        let (index, conflict) = pair.expect("straight ways cross");
        let length = network.connections[index as usize].length;
        let stretch = f64::from(conflict.own.leave) - conflict.own.enter();
        assert!(stretch > 4.0 && stretch < 0.6 * length, "{stretch} m of {length} m");
    }
}
