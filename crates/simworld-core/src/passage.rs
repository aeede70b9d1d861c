//! Streets that are closed to traffic: a fact of the world, that whoever moves the traffic follows from its next step on.
//!
//! [`Command::SetPassage`](crate::command::Command::SetPassage) closes and opens one direction of a road, and can be taken back.
//! Closures for a while, of lanes or of stretches are orders to the traffic instead
//! ([`TrafficOrder::Close`](crate::traffic::TrafficOrder::Close)).

use std::collections::BTreeSet;

use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::id::RoadId;
use crate::net::{LaneDirection, Road, RoadNetwork};
use crate::scene::World;
use crate::traffic::RoadLeg;

/// Whether traffic may enter.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Passage {
    /// It may.
    #[default]
    Open,
    /// Nobody enters; who is in drives on and out.
    Closed,
}

/// A street that can be neither closed nor opened.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[error("road {} has no lanes that go {direction:?}: name a road of this world and a direction that it has", road.0)]
pub struct PassageError {
    /// Which road.
    pub road: RoadId,
    /// In which direction.
    pub direction: LaneDirection,
}

impl Road {
    /// The directions in which it has lanes for motor vehicles.
    ///
    /// ```
    /// use simworld_core::net::{LaneDirection, NetworkConfig, RoadNetwork, StreetPlan};
    /// let network = RoadNetwork::derive(&StreetPlan::crossroads(100.0), &NetworkConfig::default())?;
    /// assert!(network.roads[0].directions().eq([LaneDirection::Forward, LaneDirection::Backward]));
    /// # Ok::<(), simworld_core::net::NetworkError>(())
    /// ```
    pub fn directions(&self) -> impl Iterator<Item = LaneDirection> {
        let forward = (!self.forward.is_empty()).then_some(LaneDirection::Forward);
        let backward = (!self.backward.is_empty()).then_some(LaneDirection::Backward);
        forward.into_iter().chain(backward)
    }
}

/// Whether the network has that direction of that road.
pub(crate) fn is_leg(network: Option<&RoadNetwork>, (road, direction): RoadLeg) -> bool {
    let road = network.and_then(|network| network.roads.get(road.index()));
    road.is_some_and(|road| road.directions().any(|own| own == direction))
}

impl World {
    /// The directions of roads that are closed to traffic.
    ///
    /// ```
    /// use std::sync::Arc;
    /// use simworld_core::command::Command;
    /// use simworld_core::id::RoadId;
    /// use simworld_core::net::{LaneDirection, NetworkConfig, RoadNetwork, StreetPlan};
    /// use simworld_core::passage::Passage;
    /// use simworld_core::scene::World;
    /// let mut world = World::new();
    /// world.set_roads(Arc::new(RoadNetwork::derive(&StreetPlan::crossroads(100.0), &NetworkConfig::default())?));
    /// let leg = (RoadId(2), LaneDirection::Forward);
    /// let done = world.apply(&Command::SetPassage { leg, passage: Passage::Closed })?;
    /// assert!(world.closed_roads().contains(&leg));
    /// world.apply(&done.undo.unwrap())?;
    /// assert!(world.closed_roads().is_empty());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub const fn closed_roads(&self) -> &BTreeSet<RoadLeg> {
        &self.closed
    }

    /// Closes or opens one direction of a road; gives what it was.
    ///
    /// # Errors
    /// The world has no such road, or the road no lanes in that direction; then nothing has changed.
    pub fn set_passage(&mut self, leg: RoadLeg, passage: Passage) -> Result<Passage, PassageError> {
        if !is_leg(self.roads.as_deref(), leg) {
            return Err(PassageError { road: leg.0, direction: leg.1 });
        }
        let was_open = match passage {
            Passage::Closed => self.closed.insert(leg),
            Passage::Open => !self.closed.remove(&leg),
        };
        Ok(if was_open { Passage::Open } else { Passage::Closed })
    }
}
