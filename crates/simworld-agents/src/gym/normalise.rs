//! Observations with mean 0 and variance 1.

use serde::{Deserialize, Serialize};
use simworld_core::seam::{EnvError, Space, SpaceValue};

use super::observing::{ObservationMap, boxed};
use super::{Learning, RunningMoments};

/// Brings each entry to mean 0 and variance 1, by what was seen so far in all episodes. Save it with the policy: the policy is
/// worth nothing under other moments.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct NormaliseObservation {
    /// What was seen.
    pub moments: RunningMoments,
    /// Whether it goes on to learn.
    pub learning: Learning,
}

impl ObservationMap for NormaliseObservation {
    fn space(&self, inner: &Space) -> Result<Space, EnvError> {
        let (_, _, shape) = boxed(inner, "NormaliseObservation")?;
        Ok(Space::bounded(f64::NEG_INFINITY, f64::INFINITY, shape.to_vec()))
    }

    fn begin(&mut self, inner: &Space, seen: SpaceValue) -> Result<SpaceValue, EnvError> {
        self.next(inner, seen)
    }

    fn next(&mut self, _: &Space, seen: SpaceValue) -> Result<SpaceValue, EnvError> {
        let SpaceValue::Box(mut entries) = seen else { return Ok(seen) };
        if self.learning == Learning::Goes {
            self.moments.see(&entries);
        }
        for (index, entry) in entries.iter_mut().enumerate() {
            *entry = self.moments.normalised(index, *entry);
        }
        Ok(SpaceValue::Box(entries))
    }
}
