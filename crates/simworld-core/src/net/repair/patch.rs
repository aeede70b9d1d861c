//! Patches of networks.

use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::net::{
    Connection, Crossing, Intersection, Lane, NetworkFault, Road, RoadNetwork, Sidewalk, SignalPlan,
};
use crate::patch::{ArrayPatch, Misfit};

/// Why a patch cannot be put on roads.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum PatchError {
    /// It is for other roads.
    #[error(transparent)]
    Misfit(#[from] Misfit),
    /// There are no roads to be changed.
    #[error("there are no roads: give the world its roads before they are changed")]
    NoRoads,
    /// Streets are closed, and the patch may number roads anew.
    #[error("{count} directions of roads are closed to traffic: open them before the roads are changed")]
    Closed {
        /// How many.
        count: usize,
    },
    /// The network with the patch would not hold together.
    #[error(transparent)]
    Fault(#[from] NetworkFault),
}

/// What changes of a network: its size is that of the change.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct NetworkPatch {
    /// Roads.
    pub roads: ArrayPatch<Road>,
    /// Lanes.
    pub lanes: ArrayPatch<Lane>,
    /// Connections.
    pub connections: ArrayPatch<Connection>,
    /// Intersections.
    pub intersections: ArrayPatch<Intersection>,
    /// Sidewalks.
    pub sidewalks: ArrayPatch<Sidewalk>,
    /// Crossings.
    pub crossings: ArrayPatch<Crossing>,
    /// Signal plans.
    pub signals: ArrayPatch<SignalPlan>,
    /// Names of roads.
    pub names: ArrayPatch<String>,
}

impl RoadNetwork {
    /// Puts a patch on the network; gives the patch that takes it off again.
    ///
    /// # Errors
    /// A patch that is for another network; then the network is as it was.
    pub fn put(&mut self, patch: NetworkPatch) -> Result<NetworkPatch, PatchError> {
        patch.roads.check(&self.roads, "roads")?;
        patch.lanes.check(&self.lanes, "lanes")?;
        patch.connections.check(&self.connections, "connections")?;
        patch.intersections.check(&self.intersections, "intersections")?;
        patch.sidewalks.check(&self.sidewalks, "sidewalks")?;
        patch.crossings.check(&self.crossings, "crossings")?;
        patch.signals.check(&self.signals, "signals")?;
        patch.names.check(&self.names, "names")?;
        Ok(NetworkPatch {
            roads: patch.roads.put_on(&mut self.roads, "roads")?,
            lanes: patch.lanes.put_on(&mut self.lanes, "lanes")?,
            connections: patch.connections.put_on(&mut self.connections, "connections")?,
            intersections: patch.intersections.put_on(&mut self.intersections, "intersections")?,
            sidewalks: patch.sidewalks.put_on(&mut self.sidewalks, "sidewalks")?,
            crossings: patch.crossings.put_on(&mut self.crossings, "crossings")?,
            signals: patch.signals.put_on(&mut self.signals, "signals")?,
            names: patch.names.put_on(&mut self.names, "names")?,
        })
    }

    /// Puts a patch from outside on the network and checks that the network then holds together. Takes as long as a look at
    /// the whole network.
    ///
    /// # Errors
    /// A patch that does not fit, or a network that would not hold together; then the network is as it was.
    pub fn put_checked(&mut self, patch: NetworkPatch) -> Result<NetworkPatch, PatchError> {
        let back = self.put(patch)?;
        if let Err(fault) = self.check() {
            self.put(back)?;
            return Err(fault.into());
        }
        Ok(back)
    }
}

impl NetworkPatch {
    /// The patch that changes nothing of a network.
    pub fn unchanged(network: &RoadNetwork) -> Self {
        Self {
            roads: ArrayPatch::unchanged(&network.roads),
            lanes: ArrayPatch::unchanged(&network.lanes),
            connections: ArrayPatch::unchanged(&network.connections),
            intersections: ArrayPatch::unchanged(&network.intersections),
            sidewalks: ArrayPatch::unchanged(&network.sidewalks),
            crossings: ArrayPatch::unchanged(&network.crossings),
            signals: ArrayPatch::unchanged(&network.signals),
            names: ArrayPatch::unchanged(&network.names),
        }
    }

    /// The patch that does again what this one takes back; the network is the one that this one is for.
    #[must_use]
    pub fn mirrored(&self, network: &RoadNetwork) -> Self {
        Self {
            roads: self.roads.mirrored(&network.roads),
            lanes: self.lanes.mirrored(&network.lanes),
            connections: self.connections.mirrored(&network.connections),
            intersections: self.intersections.mirrored(&network.intersections),
            sidewalks: self.sidewalks.mirrored(&network.sidewalks),
            crossings: self.crossings.mirrored(&network.crossings),
            signals: self.signals.mirrored(&network.signals),
            names: self.names.mirrored(&network.names),
        }
    }
}
