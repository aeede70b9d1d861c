//! Routes: chains of legs, a leg being one direction of a road; and the quickest one between two.

#[cfg(feature = "hierarchy")]
mod hierarchy;
mod landmarks;
mod legs;
mod router;
mod search;

#[cfg(feature = "hierarchy")]
pub use hierarchy::{LegHierarchy, LegScratch};
pub(crate) use landmarks::Landmarks;
pub use router::Router;
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
