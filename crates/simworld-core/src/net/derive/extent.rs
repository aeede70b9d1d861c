//! How far things reach along two axes.

use crate::ops::{greater, lesser};

/// The least and the greatest of some points along either of two axes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Extent {
    pub(super) low: [f64; 2],
    pub(super) high: [f64; 2],
}

impl Extent {
    /// That of no point.
    pub(super) const NONE: Self = Self { low: [f64::INFINITY; 2], high: [f64::NEG_INFINITY; 2] };

    /// Takes in a point.
    pub(super) fn add(&mut self, point: [f64; 2]) {
        for (axis, at) in point.into_iter().enumerate() {
            self.low[axis] = lesser(self.low[axis], at);
            self.high[axis] = greater(self.high[axis], at);
        }
    }

    /// The same so far on along either axis.
    pub(super) fn moved(&self, by: [f64; 2]) -> Self {
        let [low, high] = [self.low, self.high].map(|ends| [ends[0] + by[0], ends[1] + by[1]]);
        Self { low, high }
    }

    /// The gap between two of them along either axis; negative where they overlap.
    pub(super) fn gaps(&self, other: &Self) -> [f64; 2] {
        let gap = |axis: usize| greater(other.low[axis] - self.high[axis], self.low[axis] - other.high[axis]);
        [gap(0), gap(1)]
    }

    /// The wider of those gaps.
    pub(super) fn apart(&self, other: &Self) -> f64 {
        let [first, second] = self.gaps(other);
        greater(first, second)
    }
}
