//! Where somebody looks: elsewhere the traffic goes in longer steps.

use serde::{Deserialize, Serialize};
use simworld_core::geometry::Point2;

use super::{State, Traffic};
use crate::TrafficError;

/// A place around which traffic is to be as good as it can be.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Interest {
    /// Its middle, m.
    pub center: Point2,
    /// How far around it, m; zero or more.
    pub radius: f64,
}

impl Interest {
    pub(super) fn is_sound(&self) -> bool {
        self.center.x.is_finite() && self.center.y.is_finite() && self.radius >= 0.0
    }

    fn reaches(&self, at: &Point2) -> bool {
        (at - self.center).norm_squared() <= self.radius * self.radius
    }
}

impl Traffic {
    /// Says what is of interest. Where no interest reaches any of the intersections near one another that are worked on together,
    /// vehicles come up to the present every half second in one long step, in which they decide once, keep off one another and
    /// stop at red; until then they are where they were. Walkers that no interest reaches decide and go in the same rounds. With
    /// `None`, the default, everything is of interest.
    ///
    /// ```
    /// use std::sync::Arc;
    /// use simworld_core::geometry::Point2;
    /// use simworld_core::net::{NetworkConfig, RoadNetwork, StreetPlan};
    /// use simworld_core::seed::Seed;
    /// use simworld_traffic::{Interest, Traffic, TrafficConfig};
    /// let network = RoadNetwork::derive(&StreetPlan::grid(5, 5, 120.0), &NetworkConfig::default())?;
    /// let mut traffic = Traffic::new(Arc::new(network), &TrafficConfig::default(), Seed(1))?;
    /// traffic.set_interest(Some(vec![Interest { center: Point2::origin(), radius: 200.0 }]))?;
    /// for _ in 0..600 { traffic.step(0.1); }
    /// assert!(traffic.counters().crossings > 20);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// A place that is not finite, or a radius that is negative or not a number; nothing is changed then.
    pub fn set_interest(&mut self, interest: Option<Vec<Interest>>) -> Result<(), TrafficError> {
        if let Some(place) = interest.iter().flatten().find(|place| !place.is_sound()) {
            let (field, value, allowed) = if place.radius >= 0.0 {
                let far = if place.center.x.is_finite() { place.center.y } else { place.center.x };
                ("interest.center", far, "a finite place")
            } else {
                ("interest.radius", place.radius, "0 m or more")
            };
            return Err(TrafficError::Config { field, value, allowed });
        }
        self.state.interest = interest;
        self.mark_far();
        Ok(())
    }

    pub(super) fn mark_far(&mut self) {
        let State { vehicles, interest, .. } = &mut self.state;
        let network = &self.tracks.network;
        vehicles.set_far(&self.tracks, |junction| {
            let center = network.intersections[junction.index()].center;
            interest.as_ref().is_some_and(|places| !places.iter().any(|place| place.reaches(&center)))
        });
    }
}
