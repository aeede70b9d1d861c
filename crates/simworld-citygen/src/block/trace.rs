//! The boundaries of the faces of a network: sidewalk, corner, sidewalk ... with the face on the left.

use std::collections::BTreeSet;

use simworld_core::geometry::Point2;
use simworld_core::id::RoadId;
use simworld_core::net::{RoadNetwork, Side, polyline};

use super::Border;
use super::inset::is_longer;

/// Most boundaries have no more points.
const USUAL_POINTS: usize = 64;

/// A closed line along the middles of sidewalks. The i-th piece leads from point i to the next.
#[derive(Clone, Debug, Default)]
pub(super) struct Boundary {
    pub(super) points: Vec<Point2>,
    pub(super) pieces: Vec<Piece>,
}

/// What a piece of a boundary is.
#[derive(Clone, Copy, Debug)]
pub(super) struct Piece {
    pub(super) border: Border,
    /// How far the land begins to the left of the piece, m.
    pub(super) offset: f64,
}

/// The boundary of every face that some sides of roads bound, each once, in the order of the first of them.
pub(super) fn boundaries(network: &RoadNetwork, sides: impl IntoIterator<Item = usize>) -> Vec<Boundary> {
    let tracer = Tracer { network };
    let mut seen = vec![false; network.roads.len() * 2];
    let mut found = Vec::new();
    for start in sides {
        if seen[start] {
            continue;
        }
        let mut boundary = Boundary::with_capacity(USUAL_POINTS);
        let mut half = start;
        while !seen[half] {
            seen[half] = true;
            half = tracer.follow(half, &mut boundary);
        }
        if boundary.points.len() >= 3 {
            found.push(boundary);
        }
    }
    found
}

/// The sides of streets round the faces that some sides bound: side 2i is the left of road i, side 2i + 1 its right.
pub(crate) fn sides_round(network: &RoadNetwork, some: impl IntoIterator<Item = usize>) -> BTreeSet<usize> {
    let tracer = Tracer { network };
    let mut all = BTreeSet::new();
    for side in some {
        let mut at = side;
        while all.insert(at) {
            at = tracer.next(at).0;
        }
    }
    all
}

/// Whether a side is walked along its road.
const fn is_forward(half: usize) -> bool {
    half.is_multiple_of(2)
}

struct Tracer<'a> {
    network: &'a RoadNetwork,
}

impl Tracer<'_> {
    /// Adds one side of a road, seen with the face on its left, and the corner at its end; gives the side that
    /// follows. Side 2i is walked along road i, side 2i + 1 against it.
    fn follow(&self, half: usize, boundary: &mut Boundary) -> usize {
        let road = &self.network.roads[half / 2];
        let (side, node) = if is_forward(half) { (Side::Left, road.to) } else { (Side::Right, road.from) };
        let (next, before) = self.next(half);
        let id = RoadId::from_index(half / 2);
        let sidewalk = self.network.sidewalk(id, side);
        if let Some(sidewalk) = sidewalk {
            // Nothing is built along bridges and in tunnels.
            let border = if road.level == 0 { Border::street(id, side) } else { Border::CORNER };
            let piece = Piece { border, offset: sidewalk.width * 0.5 };
            boundary.extend(&sidewalk.path, side == Side::Right, piece);
        } else {
            let piece = Piece { border: Border::CORNER, offset: 0.0 };
            boundary.extend(&self.kerb(half), side == Side::Right, piece);
        }
        // The corner leads from the left of one road to the right of the next, this one: it is walked against.
        let intersection = &self.network.intersections[node.index()];
        if let Some(corner) = intersection.corners.get(before).filter(|corner| corner.len() >= 2) {
            let offset = sidewalk.map_or(0.0, |sidewalk| sidewalk.width * 0.5);
            boundary.extend(corner, true, Piece { border: Border::CORNER, offset });
        }
        next
    }

    /// The side that follows round the face, and the rank of its road at the intersection between.
    fn next(&self, half: usize) -> (usize, usize) {
        let road = &self.network.roads[half / 2];
        let node = if is_forward(half) { road.to } else { road.from };
        let roads = &self.network.intersections[node.index()].roads;
        // No road leads from an intersection to itself, so each is there once.
        let rank = roads.iter().position(|leg| leg.index() == half / 2).unwrap_or(0);
        let before = (rank + roads.len() - 1) % roads.len().max(1);
        let next = roads.get(before).map_or(half / 2, |road| road.index());
        (2 * next + usize::from(self.network.roads[next].from != node), before)
    }

    /// The kerb of a road without a sidewalk, kept clear of the junctions at its ends.
    fn kerb(&self, half: usize) -> Vec<Point2> {
        let road = &self.network.roads[half / 2];
        let offset = if is_forward(half) { road.left_kerb } else { -road.right_kerb };
        let length = polyline::length(&road.centerline);
        let reach = |node: usize| {
            let intersection = &self.network.intersections[node];
            let widest = intersection
                .roads
                .iter()
                .map(|road| self.network.roads[road.index()].width)
                .fold(0.0, f64::max);
            if intersection.roads.len() == 1 { 0.0 } else { widest.min(length * 0.3) }
        };
        let middle =
            polyline::slice(&road.centerline, reach(road.from.index()), length - reach(road.to.index()));
        polyline::offset(&middle, offset)
    }
}

impl Boundary {
    fn with_capacity(points: usize) -> Self {
        Self { points: Vec::with_capacity(points), pieces: Vec::with_capacity(points) }
    }

    /// Goes on along a path, or against it; the way to its first point is a corner.
    fn extend(&mut self, path: &[Point2], against: bool, piece: Piece) {
        if let Some(last) = self.pieces.last_mut() {
            // What joins two paths: usually nothing, for a corner begins where the sidewalk ends.
            *last = Piece { border: Border::CORNER, offset: last.offset.min(piece.offset) };
        }
        let count = path.len();
        for index in 0..count {
            let point = path[if against { count - 1 - index } else { index }];
            if self.points.last().is_none_or(|last| is_longer(&(point - last), 1e-3)) {
                self.points.push(point);
                self.pieces.push(piece);
            } else if let Some(last) = self.pieces.last_mut() {
                *last = piece;
            }
        }
    }
}
