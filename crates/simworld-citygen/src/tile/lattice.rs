//! The lattice of main streets: crossings and courses as functions of whole numbers.
//!
//! A crossing, and the course of a main street with its gates, is drawn from a stream of its own place on the lattice. So
//! whoever asks, from whichever side and in whatever order, gets the same bits; nothing here remembers anything.

use std::f64::consts::{PI, TAU};

use simworld_core::geometry::{Point2, Vector2};
use simworld_core::ops;
use simworld_core::seed::{Seed, Stream, StreamRng};

use super::LatticeConfig;
use crate::growth::Gate;

/// How far a gate may lie from its even place, as a share of the distance between gates.
const UNEVENNESS: f64 = 0.3;

/// Which way a main street runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Axis {
    /// From a crossing to the next one in the east.
    East,
    /// From a crossing to the next one in the north.
    North,
}

/// A place where streets may join a main street.
#[derive(Clone, Copy, Debug)]
pub(super) struct Junction {
    pub(super) at: Point2,
    /// Whether one may join from the left, and from the right.
    pub(super) opens: [bool; 2],
}

/// The lattice of a seed.
#[derive(Clone, Debug)]
pub(super) struct Lattice {
    config: LatticeConfig,
    nodes: Stream,
    edges: Stream,
}

impl Lattice {
    pub(super) fn new(config: &LatticeConfig, seed: Seed) -> Self {
        let stream = seed.stream("citygen/lattice");
        Self { config: config.clone(), nodes: stream.named("nodes"), edges: stream.named("edges") }
    }

    /// Where the main streets of a column and a row cross.
    pub(super) fn crossing(&self, column: i64, row: i64) -> Point2 {
        let mut rng = self.nodes.indexed(column as u64).indexed(row as u64).rng();
        let LatticeConfig { spacing, jitter, .. } = self.config;
        let mut place = |index: i64| (index as f64 + rng.uniform(-jitter, jitter)) * spacing;
        let (x, y) = (place(column), place(row));
        Point2::new(x, y)
    }

    /// The main street that leaves a crossing along an axis, up to the next crossing; both ends are closed.
    pub(super) fn street(&self, column: i64, row: i64, axis: Axis) -> Vec<Junction> {
        let from = self.crossing(column, row);
        let to = match axis {
            Axis::East => self.crossing(column + 1, row),
            Axis::North => self.crossing(column, row + 1),
        };
        let mut rng = self.edges.indexed(axis as u64).indexed(column as u64).indexed(row as u64).rng();
        let along = to - from;
        let length = along.norm();
        let across = Vector2::new(-along.y, along.x) * (self.config.bow * rng.uniform(-1.0, 1.0));
        let turns = if rng.chance(0.35) { TAU } else { PI };
        let pieces = (length / self.config.gates * rng.uniform(0.45, 1.25)).round().max(2.0);
        let mut junctions = Vec::with_capacity(pieces as usize + 1);
        junctions.push(Junction { at: from, opens: [false; 2] });
        for index in 1..pieces as u32 {
            let share = (f64::from(index) + rng.uniform(-UNEVENNESS, UNEVENNESS)) / pieces;
            let at = from + along * share + across * ops::sin(turns * share);
            junctions.push(Junction { at, opens: self.opens(&mut rng) });
        }
        junctions.push(Junction { at: to, opens: [false; 2] });
        junctions
    }

    /// From which sides streets may join.
    fn opens(&self, rng: &mut StreamRng) -> [bool; 2] {
        if rng.chance(self.config.crossroads) {
            return [true; 2];
        }
        let left = rng.chance(0.5);
        [left, !left]
    }

    /// The main streets round a superblock, counter-clockwise, with the gates that lead into it.
    pub(super) fn wall(&self, column: i64, row: i64) -> Vec<Gate> {
        let sides = [
            (self.street(column, row, Axis::East), Way::Along),
            (self.street(column + 1, row, Axis::North), Way::Along),
            (self.street(column, row + 1, Axis::East), Way::Against),
            (self.street(column, row, Axis::North), Way::Against),
        ];
        let mut wall = Vec::with_capacity(32);
        for (mut street, way) in sides {
            // Seen along the way round, the superblock lies on the left.
            let inside = usize::from(way == Way::Against);
            if way == Way::Against {
                street.reverse();
            }
            // The last is the first of the next side.
            street.pop();
            wall.extend(street.iter().map(|gate| Gate { at: gate.at, is_open: gate.opens[inside] }));
        }
        wall
    }
}

/// Whether a street is walked from its beginning to its end.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Way {
    Along,
    Against,
}
