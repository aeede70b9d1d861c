//! Which junctions are near one another.

use crate::id::{CrossingId, IntersectionId, RoadId};
use crate::net::{Control, Road, RoadNetwork};

/// More nodes than this are no single intersection.
const MOST: usize = 12;

/// Who leaves an intersection on a road that leads back to it has room there if it is as long as that, m: else he would stand in his
/// own way. Shorter ones are inside.
const BACK: f64 = 45.0;

/// Nodes that are one intersection.
#[derive(Clone, Debug)]
pub(super) struct Compound {
    /// Ascending.
    pub(super) nodes: Vec<IntersectionId>,
    /// The one whose number the intersection has: the first that has signals, or the one at which most roads meet.
    pub(super) main: IntersectionId,
    /// The roads inside, ascending.
    pub(super) roads: Vec<RoadId>,
}

impl Compound {
    /// The crossings of all its nodes.
    pub(super) fn crossings(&self, network: &RoadNetwork) -> Vec<CrossingId> {
        let of = |node: &IntersectionId| network.intersections[node.index()].crossings.iter().copied();
        self.nodes.iter().flat_map(of).collect()
    }

    pub(super) fn has(&self, node: IntersectionId) -> bool {
        self.nodes.binary_search(&node).is_ok()
    }

    pub(super) fn is_inside(&self, road: RoadId) -> bool {
        self.roads.binary_search(&road).is_ok()
    }
}

/// The nodes that roads join of which every lane is shorter than that, in the order of their lowest nodes.
pub(super) fn compounds(network: &RoadNetwork, shorter: f64) -> Vec<Compound> {
    let ids = (0..network.roads.len()).map(RoadId::from_index);
    let joins: Vec<bool> = ids.map(|road| is_short(network, road, shorter)).collect();
    let mut seen = vec![false; network.intersections.len()];
    let mut found = Vec::new();
    for first in 0..network.intersections.len() {
        let (mut nodes, mut roads) = (vec![IntersectionId::from_index(first)], Vec::new());
        let mut next = 0;
        while let Some(node) = nodes.get(next).copied().filter(|node| !seen[node.index()] || next > 0) {
            next += 1;
            seen[node.index()] = true;
            for road in network.intersections[node.index()].roads.iter().filter(|road| joins[road.index()]) {
                let Road { from, to, .. } = network.roads[road.index()];
                roads.push(*road);
                for end in [from, to] {
                    if !seen[end.index()] {
                        seen[end.index()] = true;
                        nodes.push(end);
                    }
                }
            }
        }
        if (2..=MOST).contains(&nodes.len()) {
            nodes.sort_unstable();
            found.extend(compound(network, nodes, roads));
        }
    }
    found
}

/// Nodes as one, with roads inside. `None` if a roundabout leads back there too soon.
fn compound(network: &RoadNetwork, nodes: Vec<IntersectionId>, mut roads: Vec<RoadId>) -> Option<Compound> {
    let has = |node: &IntersectionId| nodes.binary_search(node).is_ok();
    let legs = nodes.iter().flat_map(|node| &network.intersections[node.index()].roads);
    let leads_back = |road: &&RoadId| {
        let Road { from, to, .. } = &network.roads[road.index()];
        has(from) && has(to)
    };
    for id in legs.filter(leads_back) {
        let road = &network.roads[id.index()];
        if road.lanes().any(|lane| network.lanes[lane.index()].length < BACK) {
            if is_of_ring(network, *id) {
                return None;
            }
            roads.push(*id);
        }
    }
    roads.sort_unstable();
    roads.dedup();
    Some(Compound { main: main(network, &nodes), nodes, roads })
}

/// Whether nobody can stand on a road between the junctions at its ends.
fn is_short(network: &RoadNetwork, id: RoadId, shorter: f64) -> bool {
    let road = &network.roads[id.index()];
    let goes_on = |node: IntersectionId| network.intersections[node.index()].roads.len() > 1;
    let mut lanes = road.lanes().map(|lane| network.lanes[lane.index()].length).peekable();
    !is_of_ring(network, id)
        && road.from != road.to
        && goes_on(road.from)
        && goes_on(road.to)
        && lanes.peek().is_some()
        && lanes.all(|length| length < shorter)
}

/// Whether a road is a piece of a roundabout with others before and behind it. Maps say so of single pieces of small triangles as well, round
/// which nobody goes by the rule of roundabouts.
fn is_of_ring(network: &RoadNetwork, id: RoadId) -> bool {
    let road = &network.roads[id.index()];
    let goes_on = |node: IntersectionId| {
        let mut others = network.intersections[node.index()].roads.iter().filter(|other| **other != id);
        others.any(|other| network.roads[other.index()].roundabout)
    };
    road.roundabout && (road.from == road.to || (goes_on(road.from) && goes_on(road.to)))
}

fn main(network: &RoadNetwork, nodes: &[IntersectionId]) -> IntersectionId {
    let place = |node: &IntersectionId| &network.intersections[node.index()];
    let rank = |node: &&IntersectionId| (place(node).control == Control::Signals, place(node).roads.len());
    // Of equals the first.
    let best = nodes.iter().rev().max_by_key(rank);
    best.copied().unwrap_or(nodes[0])
}
