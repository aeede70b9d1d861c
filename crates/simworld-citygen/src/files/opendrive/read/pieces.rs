//! Streets while a plan is gathered, and how they are cut.

use std::collections::BTreeSet;

use simworld_core::geometry::Point2;
use simworld_core::net::polyline;

use super::document::Road;
use super::heights::{self, Heights};

/// A height this near to a cut is that of the cut, m.
const AT_CUT: f64 = 0.5;

/// A street, and the road that it was.
#[derive(Clone, Debug)]
pub(super) struct Piece<'a> {
    pub(super) ends: [usize; 2],
    pub(super) line: Vec<Point2>,
    /// Heights between its ends.
    pub(super) heights: Heights,
    /// Between which stations it lies as the road does, and not drawn on to a node, m.
    pub(super) own: (f64, f64),
    pub(super) level: i8,
    pub(super) road: &'a Road,
    /// Whether the road begins there, and whether it ends there.
    pub(super) tips: [bool; 2],
}

/// Streets while they are gathered: nodes are those of the places and then those on streets that were cut.
pub(super) struct Gathered<'a> {
    pub(super) points: Vec<Point2>,
    /// Heights of the nodes, m.
    pub(super) heights: Vec<f64>,
    pub(super) pieces: Vec<Piece<'a>>,
    /// Places that a street joins already.
    pub(super) joined: BTreeSet<[usize; 2]>,
    /// The number of streets at each place.
    pub(super) degrees: Vec<usize>,
}

impl<'a> Gathered<'a> {
    /// The height of a street at a station, m.
    pub(super) fn height(&self, piece: &Piece<'_>, station: f64) -> f64 {
        let ends = piece.ends.map(|end| self.heights[end]);
        heights::at(&piece.heights, polyline::length(&piece.line), ends, station)
    }

    /// The parts of a street between ascending stations within it, where nodes are put.
    pub(super) fn cut(&mut self, piece: Piece<'a>, stations: &[f64]) -> Vec<Piece<'a>> {
        if stations.is_empty() {
            return vec![piece];
        }
        let length = polyline::length(&piece.line);
        let (mut before, mut from) = (piece.ends[0], 0.0);
        let mut parts = Vec::with_capacity(stations.len() + 1);
        for (rank, to) in stations.iter().copied().chain([length]).enumerate() {
            let is_last = rank == stations.len();
            let line = polyline::slice(&piece.line, from, to);
            let after = if is_last {
                piece.ends[1]
            } else {
                self.points.push(line[line.len() - 1]);
                self.heights.push(self.height(&piece, to));
                self.points.len() - 1
            };
            let within = |at: f64| at > from + AT_CUT && at < to - AT_CUT;
            let kept = piece.heights.iter().filter(|(at, _)| within(*at));
            parts.push(Piece {
                ends: [before, after],
                line,
                heights: kept.map(|(at, height)| (at - from, *height)).collect(),
                own: (piece.own.0 - from, piece.own.1 - from),
                level: piece.level,
                road: piece.road,
                tips: [rank == 0 && piece.tips[0], is_last && piece.tips[1]],
            });
            (before, from) = (after, to);
        }
        parts
    }
}
