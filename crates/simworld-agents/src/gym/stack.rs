//! Several observations as one.

use std::collections::VecDeque;

use serde::{Deserialize, Serialize};
use simworld_core::seam::{Bounds, EnvError, Space, SpaceValue};

use super::observing::{ObservationMap, boxed};

/// Shows the last observations together, the oldest first; the first of an episode stands for those before it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FrameStack {
    frames: usize,
    seen: VecDeque<Vec<f64>>,
}

impl FrameStack {
    /// So many observations together; at least one.
    pub fn new(frames: usize) -> Self {
        Self { frames, seen: VecDeque::new() }
    }

    fn shown(&self) -> SpaceValue {
        SpaceValue::Box(self.seen.iter().flatten().copied().collect())
    }
}

impl ObservationMap for FrameStack {
    fn space(&self, inner: &Space) -> Result<Space, EnvError> {
        let (low, high, shape) = boxed(inner, "FrameStack")?;
        if self.frames == 0 {
            let reason = "0 frames show nothing: give 1 or more".to_owned();
            return Err(EnvError::Wrapper { wrapper: "FrameStack", reason });
        }
        let repeated = |bounds: &Bounds| match bounds {
            Bounds::All(bound) => Bounds::All(*bound),
            Bounds::Each(each) => Bounds::Each(each.repeat(self.frames)),
        };
        let shape = std::iter::once(self.frames).chain(shape.iter().copied()).collect();
        Ok(Space::bounded(repeated(low), repeated(high), shape))
    }

    fn begin(&mut self, _: &Space, seen: SpaceValue) -> Result<SpaceValue, EnvError> {
        let SpaceValue::Box(entries) = seen else { return Ok(seen) };
        self.seen.clear();
        self.seen.extend(std::iter::repeat_n(entries, self.frames));
        Ok(self.shown())
    }

    fn next(&mut self, _: &Space, seen: SpaceValue) -> Result<SpaceValue, EnvError> {
        let SpaceValue::Box(entries) = seen else { return Ok(seen) };
        self.seen.pop_front();
        self.seen.push_back(entries);
        Ok(self.shown())
    }
}
