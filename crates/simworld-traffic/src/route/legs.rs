//! Legs with those that follow them, close together in memory.

use simworld_core::id::LaneId;
use simworld_core::lists::Lists;
use simworld_core::net::RoadNetwork;

use super::Leg;

/// By leg: which follow it, ascending, and the time to their ends when they are free, s.
#[derive(Clone, Debug, Default)]
pub(super) struct Legs(Lists<(Leg, f64)>);

impl Legs {
    pub(super) fn new(network: &RoadNetwork) -> Self {
        Self(by_first(network.roads.len() * 2, &pairs(network)))
    }

    /// The same pairs the other way round: by leg, those that lead to it, with the time to the end of that leg.
    pub(super) fn reversed(&self) -> Self {
        let legs = (0..self.count()).map(Leg::from_index);
        let turned = |leg| self.after(leg).iter().map(move |(next, time)| (*next, leg, *time));
        let mut pairs: Vec<(Leg, Leg, f64)> = legs.flat_map(turned).collect();
        pairs.sort_by_key(|pair| (pair.0, pair.1));
        Self(by_first(self.count(), &pairs))
    }

    pub(super) fn count(&self) -> usize {
        self.0.len()
    }

    /// The legs that follow one, ascending, and the time to the end of each when it is free, s; none behind a leg of another network.
    #[inline]
    pub(super) fn after(&self, leg: Leg) -> &[(Leg, f64)] {
        if leg.index() < self.count() { &self.0[leg.index()] } else { &[] }
    }

    /// The time from the end of a leg to that of one that follows it, s.
    pub(super) fn time(&self, from: Leg, to: Leg) -> Option<f64> {
        self.after(from).iter().find(|next| next.0 == to).map(|next| next.1)
    }
}

/// Pairs of legs that follow one another, ascending, with the time that the second takes by the quickest of the ways between their lanes, s.
fn pairs(network: &RoadNetwork) -> Vec<(Leg, Leg, f64)> {
    // Cycle lanes are no way for a vehicle.
    let is_driven = |lane: LaneId| network.lanes[lane.index()].is_driven();
    let ways = network.connections.iter().filter(|way| is_driven(way.from) && is_driven(way.to));
    let mut pairs: Vec<(Leg, Leg, f64)> = ways
        .map(|way| {
            let lane = &network.lanes[way.to.index()];
            let time = (way.length + lane.length) / lane.speed_limit;
            (Leg::of(network, way.from), Leg::of(network, way.to), time)
        })
        .collect();
    pairs.sort_by(|a, b| (a.0, a.1).cmp(&(b.0, b.1)).then(a.2.total_cmp(&b.2)));
    pairs.dedup_by_key(|pair| (pair.0, pair.1));
    pairs
}

/// Sorted pairs, by the first leg of each.
fn by_first(count: usize, pairs: &[(Leg, Leg, f64)]) -> Lists<(Leg, f64)> {
    let start = |index: usize| pairs.partition_point(|pair| pair.0.index() < index);
    let list =
        |index: usize| pairs[start(index)..start(index + 1)].iter().map(|pair| (pair.1, pair.2)).collect();
    (0..count).map(list).collect::<Lists<_>>()
}
