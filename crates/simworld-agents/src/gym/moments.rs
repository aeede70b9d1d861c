//! Mean and variance of what was seen so far.

use serde::{Deserialize, Serialize};

/// Added to variances, so that what never varies divides by no zero; the value of Gymnasium.
const EPSILON: f64 = 1e-8;

/// Whether moments follow what is seen.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Learning {
    /// They follow: while a policy is trained.
    #[default]
    Goes,
    /// They stay: while it is judged.
    Rests,
}

/// Mean and variance of each entry, by the method of Welford (1962); plain data, so that they can be saved with a policy.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct RunningMoments {
    count: u64,
    mean: Vec<f64>,
    /// Sum of squared differences from the mean.
    squares: Vec<f64>,
}

impl RunningMoments {
    /// How many were seen.
    pub fn count(&self) -> u64 {
        self.count
    }

    /// The mean of each entry.
    pub fn mean(&self) -> &[f64] {
        &self.mean
    }

    /// The variance of an entry, of all that were seen; 1 as long as fewer than two were.
    pub fn variance(&self, index: usize) -> f64 {
        match self.squares.get(index) {
            Some(squares) if self.count > 1 => squares / self.count as f64,
            _ => 1.0,
        }
    }

    /// Takes note of a sample. One with an entry that is not finite, or of another length, is passed over: it would spoil
    /// all that come after.
    pub fn see(&mut self, sample: &[f64]) {
        if self.count == 0 {
            self.mean = vec![0.0; sample.len()];
            self.squares = vec![0.0; sample.len()];
        }
        if sample.len() != self.mean.len() || !sample.iter().all(|entry| entry.is_finite()) {
            return;
        }
        self.count += 1;
        for ((mean, squares), entry) in self.mean.iter_mut().zip(&mut self.squares).zip(sample) {
            let before = entry - *mean;
            *mean += before / self.count as f64;
            *squares += before * (entry - *mean);
        }
    }

    /// An entry, less its mean and over its standard deviation.
    pub fn normalised(&self, index: usize, entry: f64) -> f64 {
        (entry - self.mean.get(index).copied().unwrap_or(0.0)) / self.deviation(index)
    }

    /// The standard deviation of an entry, never zero.
    pub fn deviation(&self, index: usize) -> f64 {
        (self.variance(index) + EPSILON).sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn they_are_those_of_the_whole_sample() {
        let mut moments = RunningMoments::default();
        assert_eq!(moments.variance(0), 1.0);
        for sample in
            [[2.0, 7.0], [4.0, 7.0], [4.0, 7.0], [4.0, 7.0], [5.0, 7.0], [5.0, 7.0], [7.0, 7.0], [9.0, 7.0]]
        {
            moments.see(&sample);
            moments.see(&[f64::INFINITY, 0.0]);
            moments.see(&[1.0]);
        }
        assert_eq!((moments.count(), moments.mean()), (8, &[5.0, 7.0][..]));
        assert!((moments.variance(0) - 4.0).abs() < 1e-12 && moments.variance(1) == 0.0);
        assert!((moments.normalised(0, 9.0) - 2.0).abs() < 1e-6 && moments.normalised(1, 7.0) == 0.0);
    }
}
