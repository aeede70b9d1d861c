//! The faces whose land has to be made anew when streets change.

use std::collections::{BTreeMap, BTreeSet, VecDeque};

use simworld_core::geometry::bounds;
use simworld_core::net::{NetworkPatch, RoadNetwork};

use super::EditError;
use super::cells::{Cells, inflated};
use super::faces::NEAR;
use super::moved::Moved;
use crate::block::sides_round;

/// The roads that a change of streets touches.
pub(super) struct Changed<'a> {
    /// Those that changed, by their numbers before and after it.
    pub(super) roads: [&'a BTreeSet<usize>; 2],
    /// Those that only got another number.
    pub(super) moved: &'a Moved,
    /// Where the roads were before it.
    pub(super) near: &'a Cells,
}

/// The sides round all faces that a change touches, as they were and as they are, where a patch takes the change back. Leaves the roads as
/// they were, and gives what changes them once more.
///
/// A street that is the only way between two parts of a town has one face round both. When it goes there are two, and the far one may have no
/// road that changed; so whatever bounds a face on the one side of the change belongs to the faces on the other.
pub(super) fn both_faces(
    network: &mut RoadNetwork,
    mut patch: NetworkPatch,
    changed: &Changed<'_>,
) -> Result<(NetworkPatch, [BTreeSet<usize>; 2]), EditError> {
    let mut before = BTreeSet::new();
    loop {
        let after = changed.faces(network, 1, &before);
        patch = network.put(patch)?;
        let grown = changed.faces(network, 0, &after);
        if grown == before {
            return Ok((patch, [before, after]));
        }
        before = grown;
        patch = network.put(patch)?;
    }
}

impl Changed<'_> {
    /// The sides round the faces that the changed roads bound, by their numbers of one time, and those sides of the other time, by its numbers,
    /// that are as they were.
    fn faces(&self, network: &RoadNetwork, time: usize, other: &BTreeSet<usize>) -> BTreeSet<usize> {
        let as_it_was = |side: &&usize| !self.roads[1 - time].contains(&(**side / 2));
        let here = |side: &usize| 2 * self.moved.number_at(time, side / 2) + side % 2;
        let start = both_sides(self.roads[time]).chain(other.iter().filter(as_it_was).map(here));
        let mut sides = sides_round(network, start);
        loop {
            let strangers = self.strangers(network, time, &sides);
            if strangers.is_empty() {
                return sides;
            }
            let start: Vec<usize> = sides.iter().copied().chain(both_sides(&strangers)).collect();
            sides = sides_round(network, start);
        }
    }

    /// The roads near some faces that belong to another piece of the town than these, and are not round them yet. Faces of one piece lie
    /// beside one another; the open land round a piece that is cut off overlaps that of others, and who builds there first has it.
    fn strangers(&self, network: &RoadNetwork, time: usize, sides: &BTreeSet<usize>) -> BTreeSet<usize> {
        let own: BTreeSet<usize> = sides.iter().map(|side| side / 2).collect();
        let around =
            |road: &usize| bounds(&network.roads[*road].centerline).map(|around| inflated(around, NEAR));
        let is_as_it_was = |once: &usize| !self.roads[0].contains(once);
        let here = |once: usize| if time == 0 { once } else { self.moved.number_at(1, once) };
        let near = self.near.near_any(own.iter().filter_map(around)).into_iter().filter(is_as_it_was);
        let all: BTreeSet<usize> = near.map(here).chain(self.roads[time].iter().copied()).collect();
        let pieces = Pieces::of(network, own.iter().chain(&all));
        if pieces.count == 1 {
            return BTreeSet::new();
        }
        let piece = &pieces.by_road;
        let others = |road: &usize| {
            let own = piece[road];
            let near = around(road).into_iter().flat_map(|around| self.near.near(around));
            let near = near.filter(is_as_it_was).map(here);
            near.filter(move |other| piece[other] != own).collect::<Vec<usize>>()
        };
        let is_new = |road: &usize| [2 * road, 2 * road + 1].iter().any(|side| !sides.contains(side));
        own.iter().flat_map(others).filter(is_new).collect()
    }
}

/// Which roads hang together.
struct Pieces {
    by_road: BTreeMap<usize, usize>,
    count: usize,
}

impl Pieces {
    /// Of some roads, of which there is one: no more of the others is looked at than it takes to come from each to one that is known.
    fn of<'a>(network: &RoadNetwork, roads: impl Iterator<Item = &'a usize>) -> Self {
        let roads: BTreeSet<usize> = roads.copied().collect();
        let mut pieces = Self { by_road: BTreeMap::new(), count: 0 };
        for road in &roads {
            if pieces.count == 0 {
                pieces.count = 1;
                pieces.take(network, &roads, (*road, 0));
            } else if !pieces.by_road.contains_key(road) {
                let (reached, piece) = pieces.explore(network, *road);
                pieces.count = pieces.count.max(piece + 1);
                for road in reached {
                    pieces.take(network, &roads, (road, piece));
                }
            }
        }
        pieces
    }

    /// Takes a road into a piece, and those of some roads that it comes to by these alone: most are found so, for they lie side by side.
    fn take(&mut self, network: &RoadNetwork, roads: &BTreeSet<usize>, (road, piece): (usize, usize)) {
        let mut open = vec![road];
        while let Some(road) = open.pop() {
            if self.by_road.insert(road, piece).is_none() {
                let next = neighbours(network, road);
                open.extend(next.filter(|next| roads.contains(next) && !self.by_road.contains_key(next)));
            }
        }
    }

    /// The roads that are reached from one until one of them is known, and their piece: a new one if none is.
    fn explore(&self, network: &RoadNetwork, from: usize) -> (BTreeSet<usize>, usize) {
        let (mut reached, mut open) = (BTreeSet::from([from]), VecDeque::from([from]));
        while let Some(road) = open.pop_front() {
            for next in neighbours(network, road) {
                if let Some(piece) = self.by_road.get(&next) {
                    return (reached, *piece);
                }
                if reached.insert(next) {
                    open.push_back(next);
                }
            }
        }
        (reached, self.count)
    }
}

/// The roads that meet a road, itself among them.
fn neighbours(network: &RoadNetwork, road: usize) -> impl Iterator<Item = usize> + '_ {
    let ends = [network.roads[road].from, network.roads[road].to];
    let roads = ends.into_iter().flat_map(|end| &network.intersections[end.index()].roads);
    roads.map(|road| road.index())
}

fn both_sides(roads: &BTreeSet<usize>) -> impl Iterator<Item = usize> {
    roads.iter().flat_map(|road| [2 * road, 2 * road + 1])
}
