//! Chains: the ways between key waypoints, one for each direction, and where on them the waypoints between lie.

use super::Route;
use crate::id::WaypointId;
use crate::net::WaypointGraph;

/// Weights are whole numbers, so that sums do not depend on their order: tenths of a millimetre.
const UNITS: f64 = 1e4;
const NONE: u32 = u32::MAX;

/// A place on a chain: its number, and the index of the waypoint along it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Place {
    chain: u32,
    index: u32,
}

impl Place {
    const NOWHERE: Self = Self { chain: NONE, index: 0 };
}

/// One waypoint of a chain, with the way to it from the beginning of the chain.
#[derive(Clone, Copy, Debug)]
struct Stop {
    waypoint: WaypointId,
    weight: usize,
    length: f64,
}

/// A graph as chains between key waypoints.
#[derive(Clone, Debug, Default)]
pub(super) struct Chains {
    /// The stops of chain i, both keys included, are `stops[starts[i]..starts[i + 1]]`.
    starts: Vec<u32>,
    stops: Vec<Stop>,
    /// The number of each waypoint among the keys.
    key_of: Vec<u32>,
    /// Where each waypoint between keys lies: on one chain, or on one each way.
    places: Vec<[Place; 2]>,
    /// The quickest chain from one key to another, sorted by both.
    links: Vec<(u32, u32, u32)>,
}

impl Chains {
    pub(super) fn of(graph: &WaypointGraph) -> Self {
        let count = graph.waypoints().len();
        let mut chains = Self {
            starts: vec![0],
            key_of: vec![NONE; count],
            places: vec![[Place::NOWHERE; 2]; count],
            ..Self::default()
        };
        let mut keys = Vec::new();
        let mut is_key = find_keys(graph);
        for waypoint in (0..count).filter(|waypoint| is_key[*waypoint]) {
            chains.key_of[waypoint] = keys.len() as u32;
            keys.push(waypoint);
        }
        for key in keys.clone() {
            chains.lay_from(graph, &is_key, key);
        }
        // What no key leads to are rings without any: one waypoint of each becomes a key.
        for waypoint in 0..count {
            if !is_key[waypoint] && chains.places[waypoint][0] == Place::NOWHERE {
                is_key[waypoint] = true;
                chains.key_of[waypoint] = keys.len() as u32;
                keys.push(waypoint);
                chains.lay_from(graph, &is_key, waypoint);
            }
        }
        chains.link_keys();
        chains
    }

    /// Lays every chain that leaves a key.
    fn lay_from(&mut self, graph: &WaypointGraph, is_key: &[bool], key: usize) {
        let first = WaypointId::from_index(key);
        for leaving in graph.edges(first) {
            let chain = (self.starts.len() - 1) as u32;
            let mut stop = Stop { waypoint: first, weight: 0, length: 0.0 };
            self.stops.push(stop);
            let (mut before, mut edge) = (first, leaving);
            loop {
                stop = Stop {
                    waypoint: edge.to,
                    weight: stop.weight + ((edge.length * UNITS).round() as usize).max(1),
                    length: stop.length + edge.length,
                };
                self.stops.push(stop);
                let here = edge.to;
                if is_key[here.index()] {
                    break;
                }
                let index = self.stops.len() as u32 - 1 - self.starts[chain as usize];
                let places = &mut self.places[here.index()];
                let free = usize::from(places[0] != Place::NOWHERE);
                places[free] = Place { chain, index };
                // Between keys there is one way on that does not lead back.
                let Some(on) = graph.edges(here).iter().find(|edge| edge.to != before) else { break };
                (before, edge) = (here, on);
            }
            self.starts.push(self.stops.len() as u32);
        }
    }

    fn link_keys(&mut self) {
        let mut found: Vec<(u32, u32, usize, u32)> = (0..self.starts.len() as u32 - 1)
            .map(|chain| {
                let stops = self.chain(chain);
                let (first, last) = (stops[0], stops[stops.len() - 1]);
                let ends = [first.waypoint, last.waypoint].map(|end| self.key_of[end.index()]);
                (ends[0], ends[1], last.weight, chain)
            })
            .filter(|(from, to, ..)| from != to && *to != NONE)
            .collect();
        found.sort_unstable();
        found.dedup_by_key(|(from, to, ..)| (*from, *to));
        self.links = found.into_iter().map(|(from, to, _, chain)| (from, to, chain)).collect();
    }

    fn chain(&self, chain: u32) -> &[Stop] {
        &self.stops[self.starts[chain as usize] as usize..self.starts[chain as usize + 1] as usize]
    }

    /// Every link between two keys: from, to, weight.
    pub(super) fn links(&self) -> impl Iterator<Item = (usize, usize, usize)> {
        self.links.iter().map(|(from, to, chain)| {
            let stops = self.chain(*chain);
            (*from as usize, *to as usize, stops[stops.len() - 1].weight)
        })
    }

    /// The whole chain from one key to another.
    pub(super) fn link(&self, from: usize, to: usize) -> Option<(Place, u32)> {
        let wanted = (from as u32, to as u32);
        let index = self.links.binary_search_by_key(&wanted, |(from, to, _)| (*from, *to)).ok()?;
        let chain = self.links[index].2;
        Some((Place { chain, index: 0 }, self.chain(chain).len() as u32 - 1))
    }

    /// Where a waypoint between keys lies; nowhere if it is a key.
    fn places(&self, waypoint: WaypointId) -> impl Iterator<Item = Place> {
        self.places[waypoint.index()].into_iter().filter(|place| *place != Place::NOWHERE)
    }

    /// The keys to which one comes from a waypoint, with the weight of the way.
    pub(super) fn exits(&self, from: WaypointId) -> Vec<(usize, usize)> {
        let own = self.key_of[from.index()];
        if own != NONE {
            return vec![(own as usize, 0)];
        }
        self.places(from).filter_map(|place| self.exit(place)).collect()
    }

    fn exit(&self, place: Place) -> Option<(usize, usize)> {
        let stops = self.chain(place.chain);
        let last = stops[stops.len() - 1];
        let key = self.key_of[last.waypoint.index()];
        (key != NONE).then(|| (key as usize, last.weight - stops[place.index as usize].weight))
    }

    /// The keys from which one comes to a waypoint, with the weight of the way.
    pub(super) fn entries(&self, to: WaypointId) -> Vec<(usize, usize)> {
        let own = self.key_of[to.index()];
        if own != NONE {
            return vec![(own as usize, 0)];
        }
        self.places(to).map(|place| self.entry(place)).collect()
    }

    fn entry(&self, place: Place) -> (usize, usize) {
        let stops = self.chain(place.chain);
        (self.key_of[stops[0].waypoint.index()] as usize, stops[place.index as usize].weight)
    }

    /// The quickest way from a waypoint between keys to a key at the end of its chain.
    pub(super) fn exit_to(&self, from: WaypointId, key: usize) -> Option<(Place, u32)> {
        let ways = self.places(from).filter_map(|place| Some((self.exit(place)?, place)));
        let best = ways.filter(|((end, _), _)| *end == key).min_by_key(|((_, weight), _)| *weight)?;
        Some((best.1, self.chain(best.1.chain).len() as u32 - 1))
    }

    /// The quickest way to a waypoint between keys from a key at the beginning of its chain.
    pub(super) fn entry_from(&self, to: WaypointId, key: usize) -> Option<(Place, u32)> {
        let ways = self.places(to).map(|place| (self.entry(place), place));
        let best = ways.filter(|((start, _), _)| *start == key).min_by_key(|((_, weight), _)| *weight)?;
        Some((Place { index: 0, ..best.1 }, best.1.index))
    }

    /// The way from one waypoint to another along one chain, with its weight.
    pub(super) fn along_one(&self, from: WaypointId, to: WaypointId) -> Option<(usize, Place, u32)> {
        let pairs = self.places(from).flat_map(|start| self.places(to).map(move |end| (start, end)));
        let along = pairs.filter(|(start, end)| start.chain == end.chain && start.index <= end.index);
        let weighed = along.map(|(start, end)| {
            let stops = self.chain(start.chain);
            let weight = stops[end.index as usize].weight - stops[start.index as usize].weight;
            (weight, start, end.index)
        });
        weighed.min_by_key(|(weight, ..)| *weight)
    }

    /// Adds the stops of a chain from a place to an index to a route that ends at the place, or is empty.
    pub(super) fn follow(&self, from: Place, to: u32, route: &mut Route) {
        let stops = &self.chain(from.chain)[from.index as usize..=to as usize];
        let known = usize::from(!route.waypoints.is_empty());
        route.waypoints.extend(stops[known..].iter().map(|stop| stop.waypoint));
        route.length += stops[stops.len() - 1].length - stops[0].length;
    }
}

/// Which waypoints are keys: all but those with one way through, or one through each way.
fn find_keys(graph: &WaypointGraph) -> Vec<bool> {
    let count = graph.waypoints().len();
    // Of the first two waypoints from which one comes to each, and how many there are.
    let mut arriving = vec![([NONE; 2], 0_u32); count];
    for from in 0..count as u32 {
        for edge in graph.edges(WaypointId(from)) {
            let (known, number) = &mut arriving[edge.to.index()];
            if let Some(place) = known.get_mut(*number as usize) {
                *place = from;
            }
            *number += 1;
        }
    }
    (0..count as u32)
        .map(|waypoint| {
            let (from, number) = arriving[waypoint as usize];
            let is_through = match (graph.edges(WaypointId(waypoint)), number) {
                ([on], 1) => on.to.0 != from[0] && on.to.0 != waypoint,
                ([a, b], 2) => {
                    let to = [a.to.0, b.to.0];
                    a.to != b.to && !to.contains(&waypoint) && (to == from || to == [from[1], from[0]])
                }
                _ => false,
            };
            !is_through
        })
        .collect()
}
