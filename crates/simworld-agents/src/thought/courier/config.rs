//! How a courier with a model thinks: when, in how many requests, with what it remembers.

use serde::{Deserialize, Serialize};
use thiserror::Error;

/// In how many requests a decision is made.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Thinking {
    /// One: a sentence of thought and the deed together.
    #[default]
    Once,
    /// Two, as in the paper: one to reason, and one to act on it.
    ReasonThenAct,
}

/// When a courier thinks.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Waking {
    /// When something happened that concerns it, and at least every so often.
    #[default]
    Events,
    /// In every step, as in the paper.
    EveryStep,
}

/// How a [`ModelCourier`](super::ModelCourier) thinks.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct CourierConfig {
    /// In how many requests.
    pub thinking: Thinking,
    /// When.
    pub waking: Waking,
    /// Shortest time between two thoughts, s, in [0.1, 3600]: news that come sooner are thought of together. Longer by as much
    /// as a thought took more requests than it needs, because an answer could not be used.
    pub pause: f64,
    /// Longest time between two thoughts, s, in [`pause`, 3600].
    pub interval: f64,
    /// How long the model takes for an answer, s of the simulation, in [0, 3600]. A world in lockstep stands still while a model
    /// answers; with this it goes on, and what is decided is done so much later. 0: at once.
    pub latency: f64,
    /// Memories that come to mind at a thought, in [0, 100].
    pub memories: usize,
    /// Failures of the model in a row (no connection, no time) after which the mind fails, in [1, 10 000]. An answer that
    /// cannot be used is no failure: it costs the turn.
    pub patience: u32,
}

impl Default for CourierConfig {
    fn default() -> Self {
        Self {
            thinking: Thinking::Once,
            waking: Waking::Events,
            pause: 1.0,
            interval: 5.0,
            latency: 0.0,
            memories: 0,
            patience: 3,
        }
    }
}

/// A setting that no courier can think with.
#[derive(Clone, Debug, PartialEq, Error)]
#[error("{field} = {value} is out of range: give {allowed}")]
pub struct CourierConfigError {
    /// The setting.
    pub field: &'static str,
    /// Its value.
    pub value: f64,
    /// What is allowed.
    pub allowed: &'static str,
}

impl CourierConfig {
    /// That of the paper, but for its haste: two requests a decision, memories, and at most one decision in six seconds, so that
    /// 500 s take fewer than 170 requests, where the paper's take 10,000.
    pub fn patient() -> Self {
        Self { thinking: Thinking::ReasonThenAct, pause: 6.0, interval: 20.0, memories: 5, ..Self::default() }
    }

    /// That of the paper: two requests in every step.
    pub fn every_step() -> Self {
        Self { waking: Waking::EveryStep, ..Self::patient() }
    }

    /// Checks every field against its range; NaN is in none.
    ///
    /// # Errors
    /// The first field out of range.
    pub fn validate(&self) -> Result<(), CourierConfigError> {
        let checks = [
            ("pause", self.pause, 0.1..=3600.0, "0.1 to 3600 s"),
            ("interval", self.interval, self.pause..=3600.0, "pause to 3600 s"),
            ("latency", self.latency, 0.0..=3600.0, "0 to 3600 s"),
            ("memories", self.memories as f64, 0.0..=100.0, "0 to 100"),
            ("patience", f64::from(self.patience), 1.0..=10_000.0, "1 to 10 000"),
        ];
        match checks.into_iter().find(|(_, value, range, _)| !range.contains(value)) {
            Some((field, value, _, allowed)) => Err(CourierConfigError { field, value, allowed }),
            None => Ok(()),
        }
    }
}
