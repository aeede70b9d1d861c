//! Routes: chains of legs, a leg being one direction of a road; and the quickest one between two.

mod delayed;
#[cfg(feature = "hierarchy")]
mod hierarchy;

pub(crate) use delayed::Search;
#[cfg(feature = "hierarchy")]
pub use hierarchy::{LegHierarchy, LegScratch};
use petgraph::algo::astar;
use petgraph::graph::{DiGraph, NodeIndex};
use petgraph::visit::EdgeRef;
use serde::{Deserialize, Serialize};
use simworld_core::id::{LaneId, RoadId};
use simworld_core::net::{LaneDirection, RoadNetwork};

use crate::TrafficError;
use crate::vehicle::Tracks;

/// One direction of a road.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Leg(u32);

impl Leg {
    /// The lanes of a road along its centreline, or against it.
    pub const fn new(road: RoadId, direction: LaneDirection) -> Self {
        Self(road.0 * 2 + matches!(direction, LaneDirection::Backward) as u32)
    }

    /// Its place among all legs: two a road.
    pub(crate) const fn index(self) -> usize {
        self.0 as usize
    }

    pub(crate) const fn from_index(index: usize) -> Self {
        Self(index as u32)
    }

    /// The leg to which a lane belongs.
    pub fn of(network: &RoadNetwork, lane: LaneId) -> Self {
        let (id, lane) = (lane, &network.lanes[lane.index()]);
        let road = &network.roads[lane.road.index()];
        // A road may lead back to where it begins.
        let is_forward = road.from == lane.from && !(road.from == road.to && road.backward.contains(&id));
        Self::new(lane.road, if is_forward { LaneDirection::Forward } else { LaneDirection::Backward })
    }

    /// Its road.
    pub const fn road(self) -> RoadId {
        RoadId(self.0 / 2)
    }

    /// Its lanes, from the middle outwards.
    pub fn lanes(self, network: &RoadNetwork) -> &[LaneId] {
        let Some(road) = network.roads.get(self.road().index()) else { return &[] };
        if self.0.is_multiple_of(2) { &road.forward } else { &road.backward }
    }
}

/// A way through the network, as legs that follow one another.
///
/// ```
/// use simworld_core::id::RoadId;
/// use simworld_core::net::{LaneDirection, NetworkConfig, RoadNetwork, StreetPlan};
/// use simworld_traffic::{Leg, Route, Router};
/// let network = RoadNetwork::derive(&StreetPlan::crossroads(100.0), &NetworkConfig::default())?;
/// // The arms lead away from the middle: in on the first, out on the third.
/// let (from, to) = (Leg::new(RoadId(0), LaneDirection::Backward), Leg::new(RoadId(2), LaneDirection::Forward));
/// let route = Router::new(&network).quickest(from, to).expect("the arms meet");
/// assert_eq!(route, Route(vec![from, to]));
/// # Ok::<(), simworld_core::net::NetworkError>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Route(pub Vec<Leg>);

impl Route {
    /// Checks that every leg has lanes and each leads on to the next.
    ///
    /// # Errors
    /// The first leg from which the route cannot go on.
    pub fn validate(&self, network: &RoadNetwork) -> Result<(), TrafficError> {
        let broken = |leg: usize, reason| Err(TrafficError::Route { leg, reason });
        if self.0.is_empty() {
            return broken(0, "a route has at least one leg");
        }
        for (index, leg) in self.0.iter().enumerate() {
            if leg.lanes(network).is_empty() {
                return broken(index, "the road has no lanes that way");
            }
            if let Some(next) = self.0.get(index + 1)
                && !leads_to(network, *leg, *next)
            {
                return broken(index, "no way across the intersection leads to the next leg");
            }
        }
        Ok(())
    }

    /// The same without the legs inside of joined junctions. Where no way across leads from one leg to the next, since one would
    /// have to cross one of them twice, it takes the quickest way round.
    pub(crate) fn outside(mut self, tracks: &Tracks) -> Self {
        let count = self.0.len();
        self.0.retain(|leg| !tracks.is_inside(*leg));
        if self.0.len() == count {
            return self;
        }
        let mut legs: Vec<Leg> = Vec::with_capacity(count);
        for leg in self.0 {
            let before = legs.last().filter(|before| !leads_to(&tracks.network, **before, leg));
            if let Some(round) = before.and_then(|before| tracks.router.quickest(*before, leg)) {
                legs.extend(&round.0[1..round.0.len() - 1]);
            }
            legs.push(leg);
        }
        Self(legs)
    }
}

fn leads_to(network: &RoadNetwork, from: Leg, to: Leg) -> bool {
    let ways = from.lanes(network).iter().flat_map(|lane| &network.lanes[lane.index()].outgoing);
    ways.into_iter().any(|way| Leg::of(network, network.connections[way.index()].to) == to)
}

/// Finds quickest routes by free travel time.
#[derive(Clone, Debug)]
pub struct Router {
    graph: DiGraph<(), f64, u32>,
    legs: delayed::Legs,
}

impl Router {
    /// Prepares a network.
    pub fn new(network: &RoadNetwork) -> Self {
        let mut graph = DiGraph::with_capacity(network.roads.len() * 2, network.connections.len());
        for _ in 0..network.roads.len() * 2 {
            graph.add_node(());
        }
        let mut known = Vec::new();
        // Cycle lanes are no way for a vehicle.
        let is_driven = |lane: LaneId| network.lanes[lane.index()].is_driven();
        for connection in network.connections.iter().filter(|way| is_driven(way.from) && is_driven(way.to)) {
            let (from, to) = (Leg::of(network, connection.from), Leg::of(network, connection.to));
            let lane = &network.lanes[connection.to.index()];
            known.push((from, to, (connection.length + lane.length) / lane.speed_limit));
        }
        // One edge a pair of legs, the quickest of the ways between their lanes.
        known.sort_by(|a, b| (a.0, a.1).cmp(&(b.0, b.1)).then(a.2.total_cmp(&b.2)));
        known.dedup_by_key(|edge| (edge.0, edge.1));
        for (from, to, time) in &known {
            graph.add_edge(NodeIndex::new(from.0 as usize), NodeIndex::new(to.0 as usize), *time);
        }
        Self { graph, legs: delayed::Legs::new(network, &known) }
    }

    /// The quickest route from one leg to another, both included; `None` if there is none.
    pub fn quickest(&self, from: Leg, to: Leg) -> Option<Route> {
        self.quickest_open(from, to, |_| true)
    }

    /// The quickest route on legs that are open, the first apart, on which one is already; `None` if there is none.
    pub fn quickest_open(&self, from: Leg, to: Leg, is_open: impl Fn(Leg) -> bool) -> Option<Route> {
        self.quickest_between(from, to, |_, leg| is_open(leg))
    }

    /// The same where it depends on the leg before whether one can go on to a leg.
    pub(crate) fn quickest_between(
        &self,
        from: Leg,
        to: Leg,
        is_open: impl Fn(Leg, Leg) -> bool,
    ) -> Option<Route> {
        let count = self.graph.node_count() as u32;
        if from.0 >= count || to.0 >= count {
            return None;
        }
        let target = NodeIndex::new(to.0 as usize);
        let found = astar(
            &self.graph,
            NodeIndex::new(from.0 as usize),
            |node| node == target,
            |edge| {
                let ends = [edge.source(), edge.target()].map(|node| Leg(node.index() as u32));
                if is_open(ends[0], ends[1]) { *edge.weight() } else { f64::INFINITY }
            },
            |_| 0.0,
        )?;
        if found.0.is_infinite() {
            return None; // it leads over what is closed
        }
        Some(Route(found.1.into_iter().map(|node| Leg(node.index() as u32)).collect()))
    }

    /// Free travel time of a route after its first leg, s: what [`quickest`](Self::quickest) makes least. `None` if a leg
    /// does not lead on to the next.
    pub fn time(&self, route: &Route) -> Option<f64> {
        let node = |leg: Leg| NodeIndex::new(leg.0 as usize);
        let time = |pair: &[Leg]| {
            let edge = self.graph.find_edge(node(pair[0]), node(pair[1]))?;
            self.graph.edge_weight(edge).copied()
        };
        route.0.windows(2).map(time).sum()
    }

    /// Every pair of legs that follow one another, with the time that the second takes, s.
    #[cfg(feature = "hierarchy")]
    fn edges(&self) -> impl Iterator<Item = (Leg, Leg, f64)> {
        let leg = |node: NodeIndex| Leg(node.index() as u32);
        self.graph.edge_references().map(move |edge| (leg(edge.source()), leg(edge.target()), *edge.weight()))
    }

    /// The legs that follow one, ascending.
    pub fn after(&self, leg: Leg) -> Vec<Leg> {
        let mut next: Vec<Leg> = self
            .graph
            .edges(NodeIndex::new(leg.0 as usize))
            .map(|edge| Leg(edge.target().index() as u32))
            .collect();
        next.sort_unstable();
        next
    }
}
