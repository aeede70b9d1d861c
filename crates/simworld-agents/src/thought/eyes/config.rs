//! How a body is steered by its camera.

use serde::{Deserialize, Serialize};
use thiserror::Error;

/// How a [`VisualExecutor`](super::VisualExecutor) looks and moves.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct VisualConfig {
    /// Walking speed where a plan names none, m/s, 0.1 to 20.
    pub speed: f64,
    /// The pictures that the model is shown, the newest among them, 1 to 16.
    pub frames: usize,
    /// The movements that it is told of, 0 to 100.
    pub deeds: usize,
    /// Movements towards one goal after which the plan fails, 1 to 100 000.
    pub most_movements: u32,
    /// How often it may say that it is there when it is not, in one plan, 0 to 1000.
    pub claims: u32,
    /// Answers in a row that cannot be used, each after its repair, that a plan survives, 0 to 1000.
    pub faults: u32,
}

impl Default for VisualConfig {
    fn default() -> Self {
        Self { speed: 1.4, frames: 2, deeds: 8, most_movements: 60, claims: 2, faults: 1 }
    }
}

/// A setting that nobody can be steered by.
#[derive(Clone, Debug, PartialEq, Error)]
#[error("{field} = {value} is out of range: give {allowed}")]
pub struct VisualConfigError {
    /// The setting.
    pub field: &'static str,
    /// Its value.
    pub value: f64,
    /// What is allowed.
    pub allowed: &'static str,
}

impl VisualConfig {
    /// Checks every field against its range; NaN is in none.
    ///
    /// # Errors
    /// The first field out of range.
    pub fn validate(&self) -> Result<(), VisualConfigError> {
        let checks = [
            ("speed", self.speed, 0.1..=20.0, "0.1 to 20 m/s"),
            ("frames", self.frames as f64, 1.0..=16.0, "1 to 16"),
            ("deeds", self.deeds as f64, 0.0..=100.0, "0 to 100"),
            ("most_movements", f64::from(self.most_movements), 1.0..=100_000.0, "1 to 100 000"),
            ("claims", f64::from(self.claims), 0.0..=1000.0, "0 to 1000"),
            ("faults", f64::from(self.faults), 0.0..=1000.0, "0 to 1000"),
        ];
        match checks.into_iter().find(|(_, value, range, _)| !range.contains(value)) {
            Some((field, value, _, allowed)) => Err(VisualConfigError { field, value, allowed }),
            None => Ok(()),
        }
    }
}
