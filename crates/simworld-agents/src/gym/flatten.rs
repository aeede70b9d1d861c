//! Observations as plain vectors.

use serde::{Deserialize, Serialize};
use simworld_core::seam::{EnvError, Space, SpaceValue};

use super::observing::ObservationMap;

/// Makes observations plain vectors, by [`Space::flatten`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct FlattenObservation;

impl ObservationMap for FlattenObservation {
    fn space(&self, inner: &Space) -> Result<Space, EnvError> {
        flat("FlattenObservation", inner)
    }

    fn begin(&mut self, inner: &Space, seen: SpaceValue) -> Result<SpaceValue, EnvError> {
        self.next(inner, seen)
    }

    fn next(&mut self, inner: &Space, seen: SpaceValue) -> Result<SpaceValue, EnvError> {
        let flat = inner.flatten(&seen);
        flat.map(SpaceValue::Box).map_err(|source| EnvError::NotInSpace { what: "observation", source })
    }
}

/// The space of flat forms.
pub(super) fn flat(wrapper: &'static str, inner: &Space) -> Result<Space, EnvError> {
    let reason = || "the space has no flat form: leave out sequences, graphs and very long texts".to_owned();
    inner.flattened().ok_or_else(|| EnvError::Wrapper { wrapper, reason: reason() })
}
