//! Vehicles that are sent another way while they drive.

use super::Traffic;
use crate::Leg;
use crate::takeover::ControlError;

impl Traffic {
    /// Turns a vehicle round: it takes the quickest open way to the other direction of the road that it is on, or comes to if it
    /// crosses a junction, and goes on from there to the end of its route. Where a junction or a turning circle lets it turn, that
    /// is a U-turn, and otherwise a way round the block.
    ///
    /// ```
    /// use std::sync::Arc;
    /// use simworld_core::net::{NetworkConfig, RoadNetwork, StreetPlan};
    /// use simworld_core::seed::Seed;
    /// use simworld_traffic::{Traffic, TrafficConfig};
    /// let network = RoadNetwork::derive(&StreetPlan::grid(3, 3, 120.0), &NetworkConfig::default())?;
    /// let mut traffic = Traffic::new(Arc::new(network), &TrafficConfig::default(), Seed(1))?;
    /// traffic.turn_round(7)?;
    /// assert!(traffic.turn_round(70_000).is_err());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// No vehicle of that number on a lane, a road without another direction, or no open way there and on; it drives as before then.
    pub fn turn_round(&mut self, id: u32) -> Result<(), ControlError> {
        let streams = self.streams.named("vehicles");
        self.state.vehicles.turn_round(&self.tracks, &self.driving, streams, id)
    }

    /// Sends a vehicle through legs from where it is, by the quickest open way to each in turn; it leaves at the end of the last.
    ///
    /// # Errors
    /// No vehicle of that number on a lane, no legs, or no open way to one of them; it drives as before then.
    pub fn reroute(&mut self, id: u32, through: &[Leg]) -> Result<(), ControlError> {
        let streams = self.streams.named("vehicles");
        self.state.vehicles.reroute(&self.tracks, &self.driving, streams, id, through)
    }
}
