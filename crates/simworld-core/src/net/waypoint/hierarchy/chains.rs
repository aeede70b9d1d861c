//! Chains: the ways between key waypoints, one for each direction, and where on them the waypoints between lie.

use super::Route;
use crate::id::WaypointId;
use crate::net::{WaypointGraph, WeightedEdge};

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

/// The ways between a waypoint and keys. They are two at most, for a waypoint between keys lies on two chains at most.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ways {
    count: usize,
    /// The number of the key that each leads to or comes from, and its weight.
    keys: [(u32, u64); 2],
    /// Where on its chain each begins or ends; nowhere, if the waypoint is the key.
    places: [Place; 2],
}

impl Ways {
    const NONE: Self = Self { count: 0, keys: [(NONE, 0); 2], places: [Place::NOWHERE; 2] };

    fn push(&mut self, key: u32, weight: u64, place: Place) {
        self.keys[self.count] = (key, weight);
        self.places[self.count] = place;
        self.count += 1;
    }

    /// The keys with what it costs to come there, or from there.
    pub(super) fn keys(&self) -> &[(u32, u64)] {
        &self.keys[..self.count]
    }

    pub(super) fn place(&self, index: usize) -> Place {
        self.places[index]
    }
}

/// A whole chain, so that to follow it is to look at one place.
#[derive(Clone, Copy, Debug)]
struct Link {
    /// The indices of its first and last stop.
    first: u32,
    last: u32,
    /// m.
    length: f64,
}

/// A graph as chains between key waypoints.
#[derive(Clone, Debug, Default)]
pub(super) struct Chains {
    /// The stops of chain i, both keys included, are those from `starts[i]` to `starts[i + 1]`.
    starts: Vec<u32>,
    stops: Vec<WaypointId>,
    /// Of each stop, the weight of the way to it from the beginning of its chain.
    weights: Vec<u64>,
    /// And its length, m.
    lengths: Vec<f64>,
    /// The number of each waypoint among the keys.
    key_of: Vec<u32>,
    /// Where each waypoint between keys lies: on one chain, or on one each way.
    places: Vec<[Place; 2]>,
    /// How many keys there are.
    keys: usize,
    /// The shortest chains from one key to another, sorted by both.
    links: Vec<Link>,
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
        let mut is_key = find_keys(graph);
        for waypoint in (0..count).filter(|waypoint| is_key[*waypoint]) {
            chains.number(waypoint);
        }
        for waypoint in (0..count).filter(|waypoint| is_key[*waypoint]) {
            chains.lay_from(graph, &is_key, waypoint);
        }
        // What no key leads to are rings without any: one waypoint of each becomes a key.
        for waypoint in 0..count {
            if !is_key[waypoint] && chains.places[waypoint][0] == Place::NOWHERE {
                is_key[waypoint] = true;
                chains.number(waypoint);
                chains.lay_from(graph, &is_key, waypoint);
            }
        }
        chains
    }

    fn number(&mut self, waypoint: usize) {
        self.key_of[waypoint] = self.keys as u32;
        self.keys += 1;
    }

    fn stop(&mut self, waypoint: WaypointId, weight: u64, length: f64) {
        self.stops.push(waypoint);
        self.weights.push(weight);
        self.lengths.push(length);
    }

    /// Lays every chain that leaves a key.
    fn lay_from(&mut self, graph: &WaypointGraph, is_key: &[bool], key: usize) {
        let first = WaypointId::from_index(key);
        for leaving in graph.edges(first) {
            let chain = (self.starts.len() - 1) as u32;
            let (mut weight, mut length) = (0, 0.0);
            self.stop(first, weight, length);
            let (mut before, mut edge) = (first, leaving);
            loop {
                weight += ((edge.length * UNITS).round() as u64).max(1);
                length += edge.length;
                self.stop(edge.to, weight, length);
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

    /// Finds the shortest chain between every two keys that one joins, as edges between the numbers of the keys. The
    /// chain of an edge is the link of its index.
    pub(super) fn link_keys(&mut self) -> Vec<WeightedEdge> {
        let mut found: Vec<(u32, u32, u64, u32)> = (0..self.starts.len() as u32 - 1)
            .map(|chain| {
                let (first, last) = self.span(chain);
                let ends = [first, last].map(|end| self.key_of[self.stops[end].index()]);
                (ends[0], ends[1], self.weights[last], chain)
            })
            .filter(|(from, to, ..)| from != to && *to != NONE)
            .collect();
        found.sort_unstable();
        found.dedup_by_key(|(from, to, ..)| (*from, *to));
        let link = |(.., chain): &(u32, u32, u64, u32)| {
            let (first, last) = self.span(*chain);
            Link { first: first as u32, last: last as u32, length: self.lengths[last] }
        };
        self.links = found.iter().map(link).collect();
        found.into_iter().map(|(from, to, weight, _)| WeightedEdge { from, to, weight }).collect()
    }

    /// How many keys there are.
    pub(super) fn keys(&self) -> usize {
        self.keys
    }

    /// The indices of the first and last stop of a chain.
    fn span(&self, chain: u32) -> (usize, usize) {
        (self.starts[chain as usize] as usize, self.starts[chain as usize + 1] as usize - 1)
    }

    /// The index of the stop at a place.
    fn stop_at(&self, place: Place) -> usize {
        (self.starts[place.chain as usize] + place.index) as usize
    }

    /// Where a waypoint between keys lies; nowhere if it is a key.
    fn places(&self, waypoint: WaypointId) -> impl Iterator<Item = Place> {
        self.places[waypoint.index()].into_iter().filter(|place| *place != Place::NOWHERE)
    }

    /// The ways from a waypoint on to keys.
    pub(super) fn exits(&self, from: WaypointId) -> Ways {
        self.ways(from, |place| {
            let last = self.span(place.chain).1;
            (last, self.weights[last] - self.weights[self.stop_at(place)])
        })
    }

    /// The ways from keys to a waypoint.
    pub(super) fn entries(&self, to: WaypointId) -> Ways {
        self.ways(to, |place| (self.span(place.chain).0, self.weights[self.stop_at(place)]))
    }

    fn ways(&self, waypoint: WaypointId, end: impl Fn(Place) -> (usize, u64)) -> Ways {
        let mut ways = Ways::NONE;
        let own = self.key_of[waypoint.index()];
        if own != NONE {
            ways.push(own, 0, Place::NOWHERE);
        }
        for place in self.places(waypoint) {
            let (stop, weight) = end(place);
            let key = self.key_of[self.stops[stop].index()];
            if key != NONE {
                ways.push(key, weight, place);
            }
        }
        ways
    }

    /// The way from one waypoint to another along one chain, with its weight.
    pub(super) fn along_one(&self, from: WaypointId, to: WaypointId) -> Option<(u64, Place, u32)> {
        let pairs = self.places(from).flat_map(|start| self.places(to).map(move |end| (start, end)));
        let along = pairs.filter(|(start, end)| start.chain == end.chain && start.index <= end.index);
        let weighed = along.map(|(start, end)| {
            (self.weights[self.stop_at(end)] - self.weights[self.stop_at(start)], start, end.index)
        });
        weighed.min_by_key(|(weight, ..)| *weight)
    }

    /// Follows a chain from a place to the key at its end; see [`follow`](Self::follow).
    pub(super) fn follow_out(&self, from: Place, route: &mut Route) {
        if from != Place::NOWHERE {
            let (first, last) = self.span(from.chain);
            self.follow(from, (last - first) as u32, route);
        }
    }

    /// Follows a chain from the key at its beginning to a place.
    pub(super) fn follow_in(&self, to: Place, route: &mut Route) {
        if to != Place::NOWHERE {
            self.follow(Place { index: 0, ..to }, to.index, route);
        }
    }

    /// Follows a link from its beginning to its end.
    pub(super) fn follow_link(&self, link: u32, route: &mut Route) {
        let Link { first, last, length } = self.links[link as usize];
        self.pass(first as usize, last as usize, length, route);
    }

    /// Adds the stops of a chain from a place to an index to a route that ends at the place, or is empty.
    pub(super) fn follow(&self, from: Place, to: u32, route: &mut Route) {
        let (first, last) = (self.stop_at(from), self.stop_at(Place { index: to, ..from }));
        self.pass(first, last, self.lengths[last] - self.lengths[first], route);
    }

    fn pass(&self, first: usize, last: usize, length: f64, route: &mut Route) {
        let known = usize::from(!route.waypoints.is_empty());
        route.waypoints.extend_from_slice(&self.stops[first + known..=last]);
        route.length += length;
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
