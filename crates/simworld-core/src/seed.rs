//! Named random streams, all split from one seed.
//!
//! A draw is a function of its path, `seed -> name -> index -> position in the stream`, and of nothing else: not
//! of the order in which streams are used, not of the thread that uses them. Two parts of the engine never share
//! a generator, so adding a draw to one changes no other.
//!
//! ```
//! use simworld_core::seed::Seed;
//! let pedestrians = Seed(7).stream("traffic/pedestrians");
//! let mut third = pedestrians.indexed(3).rng();
//! let speed = third.normal(1.34, 0.26); // m/s
//! assert_eq!(speed, Seed(7).stream("traffic/pedestrians").indexed(3).rng().normal(1.34, 0.26));
//! ```

use rand_core::{Rng, SeedableRng};
use rand_pcg::Pcg64;
use serde::{Deserialize, Serialize};
use xxhash_rust::xxh3::xxh3_64_with_seed;

use crate::ops;

/// The one number from which every random choice of a world follows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Seed(pub u64);

impl Seed {
    /// The stream of that name. Names are paths, `crate/purpose`.
    pub fn stream(self, name: &str) -> Stream {
        Stream(xxh3_64_with_seed(name.as_bytes(), self.0))
    }
}

/// A named place in the tree of streams: split it further, or draw from it with [`rng`](Stream::rng).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub struct Stream(u64);

impl Stream {
    /// The child stream of an index: an entity, a tile, a tick.
    #[must_use]
    #[inline]
    pub fn indexed(self, index: u64) -> Self {
        Self(xxh3_64_with_seed(&index.to_le_bytes(), self.0))
    }

    /// The child stream of a name.
    #[must_use]
    pub fn named(self, name: &str) -> Self {
        Self(xxh3_64_with_seed(name.as_bytes(), self.0))
    }

    /// This stream's key as a seed, for a part that wants one of its own.
    pub fn seed(self) -> Seed {
        Seed(self.0)
    }

    /// A generator at the start of this stream.
    pub fn rng(self) -> StreamRng {
        StreamRng(Pcg64::seed_from_u64(self.0))
    }
}

/// The generator of one stream: PCG XSL RR 128/64 (O'Neill 2014), the same bits on every platform.
///
/// It serialises, so a saved simulation goes on with the draw it would have made.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct StreamRng(Pcg64);

impl StreamRng {
    /// The next 64 random bits.
    #[inline]
    pub fn bits(&mut self) -> u64 {
        self.0.next_u64()
    }

    /// Uniform in [0, 1), with 53 random bits.
    #[inline]
    pub fn unit(&mut self) -> f64 {
        (self.bits() >> 11) as f64 * (1.0 / (1u64 << 53) as f64)
    }

    /// Uniform in [low, high).
    #[inline]
    pub fn uniform(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    /// Uniform in 0..n without bias (Lemire 2019); zero for n = 0.
    #[inline]
    pub fn below(&mut self, n: usize) -> usize {
        let n = n as u64;
        if n == 0 {
            return 0;
        }
        loop {
            let product = u128::from(self.bits()) * u128::from(n);
            // What is rejected is below n itself: hardly ever has it to be reckoned.
            if product as u64 >= n || product as u64 >= n.wrapping_neg() % n {
                return (product >> 64) as usize;
            }
        }
    }

    /// True with probability `p`.
    #[inline]
    pub fn chance(&mut self, p: f64) -> bool {
        self.unit() < p
    }

    /// Normally distributed, by the Box-Muller transform; it takes two draws whatever they are.
    pub fn normal(&mut self, mean: f64, standard_deviation: f64) -> f64 {
        let radius = (-2.0 * ops::ln(1.0 - self.unit())).sqrt();
        let angle = std::f64::consts::TAU * self.unit();
        mean + standard_deviation * radius * ops::cos(angle)
    }

    /// Normally distributed, clamped to [low, high].
    pub fn normal_clamped(&mut self, mean: f64, standard_deviation: f64, low: f64, high: f64) -> f64 {
        self.normal(mean, standard_deviation).clamp(low, high)
    }

    /// Exponentially distributed with the given rate, 1/s for waiting times in s.
    pub fn exponential(&mut self, rate: f64) -> f64 {
        -ops::ln(1.0 - self.unit()) / rate
    }

    /// One item, uniformly; `None` from an empty slice.
    pub fn choose<'a, T>(&mut self, items: &'a [T]) -> Option<&'a T> {
        if items.is_empty() { None } else { Some(&items[self.below(items.len())]) }
    }

    /// An index with probability proportional to its weight; `None` if no weight is positive.
    pub fn weighted(&mut self, weights: &[f64]) -> Option<usize> {
        self.weighted_of(weights, Self::total(weights))
    }

    /// The sum of some weights, for [`weighted_of`](Self::weighted_of).
    pub fn total(weights: &[f64]) -> f64 {
        weights.iter().filter(|w| **w > 0.0).sum()
    }

    /// [`weighted`](Self::weighted) for one who draws often by the same weights: their sum is not reckoned each time.
    #[inline]
    pub fn weighted_of(&mut self, weights: &[f64], total: f64) -> Option<usize> {
        if total.is_nan() || total <= 0.0 {
            return None;
        }
        let mut left = self.unit() * total;
        let mut last = None;
        for (index, weight) in weights.iter().enumerate().filter(|(_, w)| **w > 0.0) {
            last = Some(index);
            left -= weight;
            if left < 0.0 {
                break;
            }
        }
        last
    }

    /// Puts the items in a uniformly random order (Fisher-Yates).
    pub fn shuffle<T>(&mut self, items: &mut [T]) {
        for end in (1..items.len()).rev() {
            items.swap(end, self.below(end + 1));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn streams_are_functions_of_their_path() {
        let a = Seed(1).stream("roads").indexed(4);
        assert_eq!(a, Seed(1).stream("roads").indexed(4));
        assert_ne!(a, Seed(1).stream("roads").indexed(5));
        assert_ne!(a, Seed(2).stream("roads").indexed(4));
        assert_ne!(a, Seed(1).stream("buildings").indexed(4));
    }

    #[test]
    fn the_first_draws_never_change() {
        // Golden: a change here changes every world of every user.
        let mut rng = Seed(42).stream("golden").rng();
        let drawn: Vec<u64> = (0..3).map(|_| rng.bits()).collect();
        assert_eq!(drawn, GOLDEN);
    }

    const GOLDEN: [u64; 3] =
        [16_302_466_539_911_818_085, 1_447_628_802_093_749_082, 10_264_349_137_012_654_675];

    #[test]
    fn moments_are_those_of_the_distributions() {
        let mut rng = Seed(3).stream("moments").rng();
        let n = 40_000;
        let draws: Vec<f64> = (0..n).map(|_| rng.normal(2.0, 3.0)).collect();
        let mean = draws.iter().sum::<f64>() / f64::from(n);
        let variance = draws.iter().map(|d| (d - mean) * (d - mean)).sum::<f64>() / f64::from(n);
        // four standard errors: 4 · 3/√n = 0.06, and 4 · 9·√(2/n) = 0.25
        assert!((mean - 2.0).abs() < 0.06, "mean {mean}");
        assert!((variance - 9.0).abs() < 0.25, "variance {variance}");
        let waits = (0..n).map(|_| rng.exponential(4.0)).sum::<f64>() / f64::from(n);
        assert!((waits - 0.25).abs() < 0.005, "mean wait {waits}");
    }

    #[test]
    fn weights_are_kept_and_zero_is_never_drawn() {
        let mut rng = Seed(3).stream("weights").rng();
        let mut counts = [0u32; 3];
        for _ in 0..30_000 {
            counts[rng.weighted(&[1.0, 0.0, 2.0]).unwrap()] += 1;
        }
        assert_eq!(counts[1], 0);
        assert!((f64::from(counts[0]) - 10_000.0).abs() < 330.0, "{counts:?}");
        assert_eq!(rng.weighted(&[0.0, -1.0]), None);
    }
}
