//! Which edges are the two directions of one road.

use std::collections::BTreeMap;

use simworld_core::net::{DrivingSide, polyline};

use super::raw::{Edge, Function};

/// Two directions belong together across a median of at most this, m.
const WIDEST_MEDIAN: f64 = 8.0;

/// A road: the edge along its centreline, and the one against it. Indices of edges.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Pair {
    pub(super) along: usize,
    pub(super) against: Option<usize>,
}

/// Every edge with lanes that is no part of a junction, in one road; in the order of the file.
pub(super) fn pairs(edges: &[Edge], side: DrivingSide) -> Vec<Pair> {
    let is_road = |edge: &Edge| edge.function == Function::Normal && !edge.lanes.is_empty();
    let mut between: BTreeMap<(&str, &str), Vec<usize>> = BTreeMap::new();
    for (index, edge) in edges.iter().enumerate().filter(|(_, edge)| is_road(edge)) {
        between.entry((&edge.from, &edge.to)).or_default().push(index);
    }
    let mut taken = vec![false; edges.len()];
    let mut pairs = Vec::new();
    for (index, edge) in edges.iter().enumerate().filter(|(_, edge)| is_road(edge)) {
        if taken[index] {
            continue;
        }
        taken[index] = true;
        // A loop from a junction to itself has no other direction.
        let back = between.get(&(edge.to.as_str(), edge.from.as_str())).filter(|_| edge.from != edge.to);
        let free = back.into_iter().flatten().copied().filter(|other| !taken[*other]);
        let beside = free.filter_map(|other| Some((apart(edge, &edges[other], side)?, other)));
        let against = beside.min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, other)| other);
        if let Some(other) = against {
            taken[other] = true;
        }
        pairs.push(Pair { along: index, against });
    }
    pairs
}

/// How far the innermost lanes of two edges are apart, m, if the second is the other direction of the first.
fn apart(edge: &Edge, other: &Edge, side: DrivingSide) -> Option<f64> {
    let (own, back) = (edge.lanes.last()?, other.lanes.last()?);
    let middle = polyline::at(&back.shape.points, polyline::length(&back.shape.points) * 0.5).0;
    let near = polyline::closest(&own.shape.points, &middle)?;
    let inwards = if side == DrivingSide::Left { -near.lateral } else { near.lateral };
    let room = (own.width + back.width) * 0.5;
    (near.distance <= room + WIDEST_MEDIAN && inwards > -room * 0.5).then_some(near.distance)
}
