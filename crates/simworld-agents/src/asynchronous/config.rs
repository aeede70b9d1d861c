//! The settings of the asynchronous driver.

use std::time::Duration;

use serde::{Deserialize, Serialize};
use simworld_core::id::EntityId;
use thiserror::Error;

/// How fast the world goes.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Pace {
    /// So many simulated seconds a second of life, in [0.001, 1000]. A step that comes late by more than its length is not made up
    /// for: the schedule begins anew with it.
    RealTime {
        /// Simulated seconds a second.
        factor: f64,
    },
    /// No step waits.
    AsFastAsPossible,
}

/// The settings of an [`AsynchronousEpisode`](super::AsynchronousEpisode).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct AsynchronousConfig {
    /// How fast the world goes.
    pub pace: Pace,
    /// Simulated time from one gathering of actions to the next, s, in [0, 3600]; at least one step. The default is that of the
    /// paper's environment.
    pub gather: f64,
    /// Actions on a snapshot older than this are late, s of simulated time, in [0, 1e6]; without it none is.
    pub max_age: Option<f64>,
    /// How far back a mind is told what happened while it thought, in steps in which something did, at most 100 000.
    pub history: usize,
    /// How long the end waits for minds that still think, at most an hour.
    pub patience: Duration,
}

impl Default for AsynchronousConfig {
    fn default() -> Self {
        let pace = Pace::RealTime { factor: 1.0 };
        Self { pace, gather: 0.1, max_age: None, history: 600, patience: Duration::from_secs(2) }
    }
}

impl AsynchronousConfig {
    /// Checks every field against its range.
    ///
    /// # Errors
    /// The first field out of range; NaN always is.
    pub fn validate(&self) -> Result<(), AsynchronousError> {
        let factor = if let Pace::RealTime { factor } = self.pace { factor } else { 1.0 };
        let checks = [
            ("pace.factor", factor, 0.001, 1000.0, "0.001 to 1000"),
            ("gather", self.gather, 0.0, 3600.0, "0 to 3600 s"),
            ("max_age", self.max_age.unwrap_or(0.0), 0.0, 1e6, "0 to 1 000 000 s"),
            ("history", self.history as f64, 0.0, 1e5, "at most 100 000 steps"),
            ("patience", self.patience.as_secs_f64(), 0.0, 3600.0, "at most an hour"),
        ];
        match checks.into_iter().find(|(_, value, low, high, _)| !(low..=high).contains(&value)) {
            Some((field, value, _, _, allowed)) => Err(AsynchronousError::Config { field, value, allowed }),
            None => Ok(()),
        }
    }
}

/// Why an asynchronous run cannot begin.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum AsynchronousError {
    /// A setting out of range.
    #[error("{field} = {value} is out of range: give {allowed}")]
    Config {
        /// Which.
        field: &'static str,
        /// Its value.
        value: f64,
        /// What is allowed.
        allowed: &'static str,
    },
    /// A mind that cannot have a body.
    #[error("{who} cannot be given a mind: {reason}")]
    Mind {
        /// Whose.
        who: EntityId,
        /// Why not.
        reason: &'static str,
    },
    /// A thread could not be started.
    #[error("the thread of a mind cannot be started: {0}")]
    Thread(#[from] std::io::Error),
}
