//! Mean and deviation of a stream of values.

use std::fmt;

use serde::{Deserialize, Serialize};

/// Number, mean, deviation, least and greatest of values that are added one by one or whole sets at a time.
///
/// Values that are not finite are counted apart and change nothing else. The mean and the sum of squares are updated as by
/// Welford (1962), sets joined as by Chan, Golub and `LeVeque` (1979).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Accumulator {
    count: u64,
    refused: u64,
    mean: f64,
    /// Sum of squared distances from the mean.
    squares: f64,
    least: f64,
    greatest: f64,
}

impl Default for Accumulator {
    fn default() -> Self {
        // Finite, so that it can be written in any format; both are meaningless until a value comes.
        Self { count: 0, refused: 0, mean: 0.0, squares: 0.0, least: 0.0, greatest: 0.0 }
    }
}

impl Accumulator {
    /// Adds a value.
    pub fn push(&mut self, value: f64) {
        if !value.is_finite() {
            self.refused += 1;
            return;
        }
        if self.count == 0 {
            (self.least, self.greatest) = (value, value);
        }
        self.count += 1;
        let before = value - self.mean;
        self.mean += before / self.count as f64;
        self.squares += before * (value - self.mean);
        (self.least, self.greatest) = (self.least.min(value), self.greatest.max(value));
    }

    /// Adds all values of another.
    pub fn merge(&mut self, other: &Self) {
        let refused = self.refused + other.refused;
        if self.count == 0 {
            *self = *other;
        } else if other.count > 0 {
            let (own, others) = (self.count as f64, other.count as f64);
            let apart = other.mean - self.mean;
            self.mean += apart * (others / (own + others));
            self.squares += other.squares + apart * apart * (own * others / (own + others));
            self.count += other.count;
            (self.least, self.greatest) = (self.least.min(other.least), self.greatest.max(other.greatest));
        }
        self.refused = refused;
    }

    /// Number of finite values.
    pub fn count(&self) -> u64 {
        self.count
    }

    /// Number of values that were not finite.
    pub fn refused(&self) -> u64 {
        self.refused
    }

    /// Their mean; zero without values.
    pub fn mean(&self) -> f64 {
        self.mean
    }

    /// Their sum.
    pub fn sum(&self) -> f64 {
        self.mean * self.count as f64
    }

    /// Their sample variance (n - 1); zero for fewer than two values.
    pub fn variance(&self) -> f64 {
        if self.count > 1 { self.squares / (self.count - 1) as f64 } else { 0.0 }
    }

    /// Their sample standard deviation (n - 1); zero for fewer than two values.
    pub fn deviation(&self) -> f64 {
        self.variance().sqrt()
    }

    /// The standard error of their mean; zero for fewer than two values.
    pub fn standard_error(&self) -> f64 {
        if self.count > 1 { (self.variance() / self.count as f64).sqrt() } else { 0.0 }
    }

    /// The least; `None` without values.
    pub fn least(&self) -> Option<f64> {
        (self.count > 0).then_some(self.least)
    }

    /// The greatest; `None` without values.
    pub fn greatest(&self) -> Option<f64> {
        (self.count > 0).then_some(self.greatest)
    }
}

impl Extend<f64> for Accumulator {
    fn extend<I: IntoIterator<Item = f64>>(&mut self, values: I) {
        for value in values {
            self.push(value);
        }
    }
}

impl FromIterator<f64> for Accumulator {
    fn from_iter<I: IntoIterator<Item = f64>>(values: I) -> Self {
        let mut accumulator = Self::default();
        accumulator.extend(values);
        accumulator
    }
}

impl fmt::Display for Accumulator {
    /// Mean ± standard deviation, with two digits unless a precision is given.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let digits = f.precision().unwrap_or(2);
        write!(f, "{:.digits$} ± {:.digits$}", self.mean(), self.deviation())
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn mean_and_deviation_are_those_of_a_sample() {
        let summary: Accumulator = [1.0, 2.0, 3.0].into_iter().collect();
        assert_eq!((summary.mean(), summary.deviation(), summary.sum()), (2.0, 1.0, 6.0));
        assert_eq!((summary.least(), summary.greatest()), (Some(1.0), Some(3.0)));
        let one: Accumulator = [4.0].into_iter().collect();
        assert_eq!((one.mean(), one.deviation()), (4.0, 0.0));
        assert_eq!(Accumulator::default().least(), None);
    }

    #[test]
    fn what_is_not_finite_is_counted_apart() {
        let summary: Accumulator = [f64::NAN, 5.0, f64::INFINITY].into_iter().collect();
        assert_eq!((summary.count(), summary.refused(), summary.mean()), (1, 2, 5.0));
    }

    #[test]
    fn a_great_offset_takes_no_digits_from_the_deviation() {
        let summary: Accumulator = [1e9 + 1.0, 1e9 + 2.0, 1e9 + 3.0].into_iter().collect();
        assert!((summary.deviation() - 1.0).abs() < 1e-9);
    }

    proptest! {
        #[test]
        fn parts_joined_are_the_whole(
            values in prop::collection::vec(-1e3..1e3_f64, 0..60), at in 0..60_usize,
        ) {
            let (left, right) = values.split_at(at.min(values.len()));
            let whole: Accumulator = values.iter().copied().collect();
            let mut joined: Accumulator = left.iter().copied().collect();
            joined.merge(&right.iter().copied().collect());
            prop_assert_eq!(joined.count(), whole.count());
            prop_assert!((joined.mean() - whole.mean()).abs() < 1e-9);
            prop_assert!((joined.variance() - whole.variance()).abs() < 1e-6);
            prop_assert_eq!(joined.least(), whole.least());
        }
    }
}
