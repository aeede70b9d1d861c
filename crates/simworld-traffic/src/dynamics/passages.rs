//! Streets that the world has closed are closed to the traffic, until the world opens them.

use simworld_core::scene::World;
use simworld_core::seam::DynamicsError;
use simworld_core::traffic::RoadLeg;

use super::TrafficDynamics;
use crate::{Closed, Closure, Leg};

impl TrafficDynamics {
    /// Closes what the world has closed since, and opens what it has opened.
    pub(super) fn mind_passages(&mut self, world: &World) -> Result<(), DynamicsError> {
        let closed = world.closed_roads();
        if self.shut.keys().eq(closed) {
            return Ok(());
        }
        let opened: Vec<RoadLeg> = self.shut.keys().filter(|leg| !closed.contains(*leg)).copied().collect();
        for leg in opened {
            if let Some(number) = self.shut.remove(&leg) {
                self.traffic.reopen(number);
            }
        }
        for leg in closed {
            if !self.shut.contains_key(leg) {
                let what = Closed::Leg(Leg::new(leg.0, leg.1));
                let closure = Closure { from: self.traffic.seconds(), ..Closure::new(what) };
                let number =
                    self.traffic.close(closure).map_err(|error| DynamicsError::Other(error.to_string()))?;
                self.shut.insert(*leg, number);
            }
        }
        Ok(())
    }
}
