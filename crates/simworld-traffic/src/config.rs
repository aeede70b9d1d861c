//! How much traffic there is, and how it behaves.

use serde::{Deserialize, Serialize};
use simworld_core::net::NetworkError;
use simworld_core::scene::WorldError;
use thiserror::Error;

use crate::crowd::AnticipationVelocity;
use crate::vehicle::{Idm, Mobil};

/// How much traffic there is, and how it behaves.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct TrafficConfig {
    /// Vehicles to place, in [0, 10 000 000]; as many as the lanes hold are placed.
    pub vehicles: u32,
    /// Pedestrians to place, in [0, 10 000 000].
    pub pedestrians: u32,
    /// Car following.
    pub idm: Idm,
    /// Lane changes.
    pub mobil: Mobil,
    /// Share of buses among the vehicles, in [0, 1].
    pub buses: f64,
    /// Share of vans, in [0, 1].
    pub vans: f64,
    /// Lateral acceleration at which drivers take turns, m/s², in [0.5, 6].
    pub lateral_acceleration: f64,
    /// Weights of going straight, right and left at an intersection, each in [0, 1000], one of them positive.
    pub turns: [f64; 3],
    /// How people walk among people.
    pub walking: AnticipationVelocity,
    /// Mean free walking speed, m/s, in [0.3, 3] (Weidmann 1993: 1.34).
    pub walking_speed: f64,
    /// Its standard deviation, m/s, in [0, 1] (Weidmann 1993: 0.26).
    pub walking_deviation: f64,
    /// Weight of crossing a road against going on along the sidewalk, in [0, 10].
    pub crossing_weight: f64,
}

impl Default for TrafficConfig {
    fn default() -> Self {
        Self {
            vehicles: 40,
            pedestrians: 80,
            idm: Idm::default(),
            mobil: Mobil::default(),
            buses: 0.04,
            vans: 0.1,
            lateral_acceleration: 2.5,
            turns: [0.6, 0.2, 0.2],
            walking: AnticipationVelocity::default(),
            walking_speed: 1.34,
            walking_deviation: 0.26,
            crossing_weight: 0.6,
        }
    }
}

/// Why there is no traffic.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum TrafficError {
    /// A setting out of range.
    #[error("{field} = {value} is out of range: give {allowed}")]
    Config {
        /// The setting, as a path.
        field: &'static str,
        /// Its value.
        value: f64,
        /// What is allowed, in words.
        allowed: &'static str,
    },
    /// The walkways cannot be made.
    #[error(transparent)]
    Network(#[from] NetworkError),
    /// The world refused an entity.
    #[error(transparent)]
    World(#[from] WorldError),
    /// A signal plan that is not for the intersection or the groups it was given for.
    #[error(
        "signal plan {plan} does not fit: keep its intersection and groups, and give every phase a positive duration"
    )]
    Plan {
        /// Its index.
        plan: usize,
    },
    /// A route that cannot be driven.
    #[error("leg {leg} of the route: {reason}")]
    Route {
        /// Its index.
        leg: usize,
        /// What is wrong with it.
        reason: &'static str,
    },
    /// The world has no roads.
    #[error(
        "the world has no roads: call World::set_roads, or populate it from a city, before adding traffic"
    )]
    NoRoads,
}

impl TrafficConfig {
    /// Checks every field against its range.
    ///
    /// # Errors
    /// The first field out of range; NaN always is.
    pub fn validate(&self) -> Result<(), TrafficError> {
        let Idm { desired_speed, headway, gap, acceleration, deceleration } = self.idm;
        let [straight, right, left] = self.turns;
        let checks = [
            ("vehicles", f64::from(self.vehicles), 0.0, 1e7, "0 to 10 000 000"),
            ("pedestrians", f64::from(self.pedestrians), 0.0, 1e7, "0 to 10 000 000"),
            ("idm.desired_speed", desired_speed, 1.0, 70.0, "1 to 70 m/s"),
            ("idm.headway", headway, 0.3, 5.0, "0.3 to 5 s"),
            ("idm.gap", gap, 0.5, 10.0, "0.5 to 10 m"),
            ("idm.acceleration", acceleration, 0.2, 6.0, "0.2 to 6 m/s²"),
            ("idm.deceleration", deceleration, 0.5, 6.0, "0.5 to 6 m/s²"),
            ("mobil.politeness", self.mobil.politeness, 0.0, 2.0, "0 to 2"),
            ("mobil.threshold", self.mobil.threshold, 0.0, 5.0, "0 to 5 m/s²"),
            ("mobil.safe_braking", self.mobil.safe_braking, 0.5, 8.0, "0.5 to 8 m/s²"),
            ("buses", self.buses, 0.0, 1.0, "0 to 1"),
            ("vans", self.vans, 0.0, 1.0, "0 to 1"),
            ("lateral_acceleration", self.lateral_acceleration, 0.5, 6.0, "0.5 to 6 m/s²"),
            ("turns[0]", straight, 0.0, 1000.0, "0 to 1000"),
            ("turns[1]", right, 0.0, 1000.0, "0 to 1000"),
            ("turns[2]", left, 0.0, 1000.0, "0 to 1000"),
            ("turns (their sum)", straight + right + left, 1e-6, 3000.0, "at least one positive weight"),
            ("walking_speed", self.walking_speed, 0.3, 3.0, "0.3 to 3 m/s"),
            ("walking_deviation", self.walking_deviation, 0.0, 1.0, "0 to 1 m/s"),
            ("crossing_weight", self.crossing_weight, 0.0, 10.0, "0 to 10"),
        ];
        for (field, value, low, high, allowed) in checks.into_iter().chain(self.walking.ranges()) {
            if !(low..=high).contains(&value) {
                return Err(TrafficError::Config { field, value, allowed });
            }
        }
        Ok(())
    }
}
