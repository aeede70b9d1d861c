//! The graph of a road network: a link a leg, and one a way from a leg to another.

use simworld_core::net::RoadNetwork;

use super::{Link, PathFlow};
use crate::{Leg, Route};

/// A graph for assignment over the legs of a network. Nodes are the beginning of each leg, `2 i`, and its end, `2 i + 1`.
#[derive(Clone, Debug, Default)]
pub struct LegGraph {
    /// The links.
    pub links: Vec<Link>,
    /// Of each link the leg that it is; `None` for ways across intersections.
    pub legs: Vec<Option<Leg>>,
}

impl LegGraph {
    /// The graph of a network whose lanes carry so many vehicles an hour each, as far as signals and right of way let them;
    /// half of the 1900 of a free lane is usual where half of the time is green.
    pub fn new(network: &RoadNetwork, lane_capacity: f64) -> Self {
        let mut graph = Self::default();
        let mut times = vec![0.0; network.roads.len() * 2];
        for (index, time) in times.iter_mut().enumerate() {
            let leg = Leg::from_index(index);
            let lanes: Vec<_> = leg
                .lanes(network)
                .iter()
                .map(|lane| &network.lanes[lane.index()])
                .filter(|lane| lane.is_driven())
                .collect();
            let quickest =
                lanes.iter().map(|lane| lane.length / lane.speed_limit).fold(f64::INFINITY, f64::min);
            if lanes.is_empty() {
                continue;
            }
            *time = quickest;
            let capacity = lane_capacity * lanes.len() as f64;
            let (from, to) = Self::nodes(leg);
            graph.links.push(Link::bpr(from, to, quickest, capacity));
            graph.legs.push(Some(leg));
        }
        let is_driven = |way: &&simworld_core::net::Connection| {
            [way.from, way.to].iter().all(|lane| network.lanes[lane.index()].is_driven())
        };
        let mut ways: Vec<(Leg, Leg, f64)> = network
            .connections
            .iter()
            .filter(is_driven)
            .map(|way| {
                let time = way.length / network.lanes[way.to.index()].speed_limit;
                (Leg::of(network, way.from), Leg::of(network, way.to), time)
            })
            .collect();
        ways.sort_by(|a, b| (a.0, a.1).cmp(&(b.0, b.1)).then(a.2.total_cmp(&b.2)));
        ways.dedup_by_key(|way| (way.0, way.1));
        for (from, to, time) in ways {
            graph.links.push(Link::constant(Self::nodes(from).1, Self::nodes(to).0, time));
            graph.legs.push(None);
        }
        graph
    }

    /// The nodes at the beginning of a leg and at its end: trips go from the first of one to the second of another.
    pub const fn nodes(leg: Leg) -> (u32, u32) {
        (leg.index() as u32 * 2, leg.index() as u32 * 2 + 1)
    }

    /// The link that a leg is.
    pub fn link(&self, leg: Leg) -> Option<u32> {
        // Links of legs come first, in the order of legs.
        let count = self.legs.iter().take_while(|leg| leg.is_some()).count();
        self.legs[..count].binary_search(&Some(leg)).ok().map(|link| link as u32)
    }

    /// The route of a path.
    pub fn route(&self, path: &PathFlow) -> Route {
        Route(path.links.iter().filter_map(|link| self.legs.get(*link as usize).copied().flatten()).collect())
    }
}
