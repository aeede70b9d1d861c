//! The faces whose land has to be made anew when streets change.

use std::collections::{BTreeSet, VecDeque};

use simworld_core::geometry::bounds;
use simworld_core::net::{NetworkPatch, RoadNetwork};

use super::EditError;
use super::cells::{Cells, inflated};
use super::faces::NEAR;
use crate::block::sides_round;

/// The roads that a change of streets touches.
pub(super) struct Changed<'a> {
    /// Those that changed, by their numbers before and after it.
    pub(super) roads: [&'a BTreeSet<usize>; 2],
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
    /// The sides round the faces that the changed roads bound, by their numbers of one time, and those sides of the other time that are as
    /// they were.
    fn faces(&self, network: &RoadNetwork, time: usize, other: &BTreeSet<usize>) -> BTreeSet<usize> {
        let as_it_was = |side: &usize| self.roads.iter().all(|roads| !roads.contains(&(side / 2)));
        let start = both_sides(self.roads[time]).chain(other.iter().copied().filter(as_it_was));
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

    /// The roads near some faces to which no way leads from there. Faces of streets that hang together lie beside one another; the open land
    /// round a piece of a town that is cut off overlaps that of others, and who builds there first has it.
    fn strangers(&self, network: &RoadNetwork, time: usize, sides: &BTreeSet<usize>) -> BTreeSet<usize> {
        let mut known: BTreeSet<usize> = sides.iter().map(|side| side / 2).collect();
        let around = known.iter().filter_map(|road| bounds(&network.roads[*road].centerline));
        let is_there = |road: &usize| self.roads.iter().all(|roads| !roads.contains(road));
        let near: BTreeSet<usize> = around
            .flat_map(|around| self.near.near(inflated(around, NEAR)))
            .filter(is_there)
            .chain(self.roads[time].iter().copied())
            .collect();
        let mut strange: BTreeSet<usize> = BTreeSet::new();
        for road in &near {
            if !known.contains(road) && !strange.contains(road) {
                let (reached, meets) = piece(network, *road, &known);
                if meets { &mut known } else { &mut strange }.extend(reached);
            }
        }
        near.intersection(&strange).copied().collect()
    }
}

/// What is reached from a road, and whether a road that is known is among it; then no more is looked for.
fn piece(network: &RoadNetwork, from: usize, known: &BTreeSet<usize>) -> (BTreeSet<usize>, bool) {
    let (mut reached, mut open) = (BTreeSet::from([from]), VecDeque::from([from]));
    while let Some(road) = open.pop_front() {
        let ends = [network.roads[road].from, network.roads[road].to];
        for next in ends.iter().flat_map(|end| network.intersections[end.index()].roads.iter()) {
            if known.contains(&next.index()) {
                return (reached, true);
            }
            if reached.insert(next.index()) {
                open.push_back(next.index());
            }
        }
    }
    (reached, false)
}

fn both_sides(roads: &BTreeSet<usize>) -> impl Iterator<Item = usize> {
    roads.iter().flat_map(|road| [2 * road, 2 * road + 1])
}
