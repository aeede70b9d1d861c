//! The settings of the environment.

use serde::{Deserialize, Serialize};

use crate::{Flow, TrafficConfig, TrafficError};

/// The settings of a [`SignalEnv`](super::SignalEnv); the times are the defaults of sumo-rl.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct SignalEnvConfig {
    /// Who is there at the start, and how everybody behaves.
    pub traffic: TrafficConfig,
    /// Who comes later.
    pub flows: Vec<Flow>,
    /// Step of the simulation, s, in [0.01, 1].
    pub dt: f64,
    /// Time between two actions, s, in [1, 120].
    pub delta_time: f64,
    /// Shortest green, s, in [1, 120]; an action that would end it sooner is carried out when it is over, if it still stands.
    pub min_green: f64,
    /// Longest green, s, in [1, 600].
    pub max_green: f64,
    /// Whether a stage that has shown for longer than `max_green` gives way to the next.
    pub enforce_max_green: bool,
    /// Length of an episode, s, in [1, 1e7]; then it is truncated.
    pub seconds: f64,
}

impl Default for SignalEnvConfig {
    fn default() -> Self {
        Self {
            traffic: TrafficConfig { vehicles: 0, pedestrians: 0, ..TrafficConfig::default() },
            flows: Vec::new(),
            dt: 0.1,
            delta_time: 5.0,
            min_green: 5.0,
            max_green: 50.0,
            enforce_max_green: false,
            seconds: 3600.0,
        }
    }
}

impl SignalEnvConfig {
    /// Checks every field against its range.
    ///
    /// # Errors
    /// The first field out of range; NaN always is.
    pub fn validate(&self) -> Result<(), TrafficError> {
        self.traffic.validate()?;
        let checks = [
            ("dt", self.dt, 0.01, 1.0, "0.01 to 1 s"),
            ("delta_time", self.delta_time, 1.0, 120.0, "1 to 120 s"),
            ("min_green", self.min_green, 1.0, 120.0, "1 to 120 s"),
            ("max_green", self.max_green, self.min_green, 600.0, "min_green to 600 s"),
            ("seconds", self.seconds, 1.0, 1e7, "1 to 10 000 000 s"),
        ];
        for (field, value, low, high, allowed) in checks {
            if !(low..=high).contains(&value) {
                return Err(TrafficError::Config { field, value, allowed });
            }
        }
        Ok(())
    }
}
