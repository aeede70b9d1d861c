//! What drivers get wrong: they decide every so often, and misjudge gaps and speeds.
//!
//! Errors change slowly, as those of the Human Driver Model (Treiber, Kesting and Helbing 2006, Physica A 360). They are a function
//! of the seed, of the vehicle and of the time, so nothing has to be kept of them from step to step.

use serde::{Deserialize, Serialize};
use simworld_core::ops;
use simworld_core::seed::Stream;

use super::following::Leader;
use crate::vehicle::clock::Moment;

/// A driver who is not perfect. The errors of the default are those of the Human Driver Model's authors; a decision a second,
/// half a second late on average, is ours.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Perception {
    /// Time from one decision to the next, s, in [0, 3]; 0 decides in every step. On average what happens is answered half of it
    /// later; by Krauss, whose driver is only as safe as he is quick, at most the headway. Who would have to brake harder than comfortably, is near to where it must stand, or changes lanes, decides at once.
    pub reaction_time: f64,
    /// Standard deviation of the logarithm of the gaps that one judges, in [0, 0.2].
    pub gap_error: f64,
    /// Standard deviation of the speed at which one takes oneself to approach, over the gap, 1/s, in [0, 0.1].
    pub speed_error: f64,
    /// How long an error lasts, s, in [1, 300]: the integral of its correlation over time.
    pub persistence: f64,
}

impl Default for Perception {
    fn default() -> Self {
        Self { reaction_time: 1.0, gap_error: 0.05, speed_error: 0.01, persistence: 20.0 }
    }
}

impl Perception {
    /// Its fields with their ranges.
    pub(crate) fn ranges(&self) -> [(&'static str, f64, f64, f64, &'static str); 4] {
        [
            ("perception.reaction_time", self.reaction_time, 0.0, 3.0, "0 to 3 s"),
            ("perception.gap_error", self.gap_error, 0.0, 0.2, "0 to 0.2"),
            ("perception.speed_error", self.speed_error, 0.0, 0.1, "0 to 0.1 per second"),
            ("perception.persistence", self.persistence, 1.0, 300.0, "1 to 300 s"),
        ]
    }

    /// Steps from one decision to the next.
    fn steps(&self, dt: f64) -> u64 {
        (self.reaction_time / dt).round().max(1.0) as u64
    }

    /// Time from one decision to the next in whole steps, s.
    #[inline]
    pub(crate) fn interval(&self, dt: f64) -> f64 {
        self.steps(dt) as f64 * dt
    }

    /// Whether a vehicle decides in a step; those of other numbers do so in other steps.
    #[inline]
    pub(crate) fn decides(&self, id: u32, step: u64, dt: f64) -> bool {
        (step + u64::from(id)).is_multiple_of(self.steps(dt))
    }

    /// How a vehicle misjudges now what moves ahead of it.
    pub(crate) fn errors(&self, streams: Stream, id: u32, at: &Moment) -> Errors {
        if self.gap_error == 0.0 && self.speed_error == 0.0 {
            return Errors::NONE;
        }
        let own = streams.named("perception").indexed(u64::from(id));
        let error = |which: u64| slow_noise(own.indexed(which), at.now / self.persistence);
        Errors { gap: ops::exp(self.gap_error * error(0)), approach: self.speed_error * error(1) }
    }
}

/// What somebody misjudges at a moment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Errors {
    /// The judged gap over the true one.
    gap: f64,
    /// The error of the speed of approach over the gap, 1/s.
    approach: f64,
}

impl Errors {
    pub(crate) const NONE: Self = Self { gap: 1.0, approach: 0.0 };

    /// What somebody takes for what is ahead. Where something stands is seen rightly, by what stands around it.
    pub(crate) fn of(&self, leader: Leader) -> Leader {
        if leader.speed <= 0.0 || !leader.gap.is_finite() {
            return leader;
        }
        let speed = (leader.speed - self.approach * leader.gap).max(0.0);
        Leader { gap: leader.gap * self.gap, speed, ..leader }
    }
}

/// Noise of mean 0 and variance 1 at a time, in units of its persistence: drawn at even times, the draws of each stream at
/// others, and mixed between them so that the variance is the same at all times.
fn slow_noise(stream: Stream, time: f64) -> f64 {
    /// Time between two draws. The correlation, averaged over where in it one is, then has an integral of 1.
    const BETWEEN: f64 = 1.0 / INTEGRAL;
    const INTEGRAL: f64 = 0.7768;
    let place = time / BETWEEN + unit(stream.seed().0);
    let before = place.floor();
    let share = place - before;
    let draw = |number: f64| about_normal(stream.indexed(number as u64).seed().0);
    let sum = (1.0 - share) * draw(before) + share * draw(before + 1.0);
    sum / ((1.0 - share) * (1.0 - share) + share * share).sqrt()
}

/// In [0, 1), of random bits.
fn unit(bits: u64) -> f64 {
    (bits >> 11) as f64 * (1.0 / (1_u64 << 53) as f64)
}

/// The sum of four even draws, of mean 0 and variance 1: near to normal, and never beyond 2 √3 (Irwin and Hall).
fn about_normal(bits: u64) -> f64 {
    let sum: u64 = (0..4).map(|part| bits >> (16 * part) & 0xffff).sum();
    (sum as f64 / 65_536.0 - 2.0 + 2.0 / 65_536.0) * 3.0_f64.sqrt()
}

#[cfg(test)]
mod tests {
    use simworld_core::seed::Seed;

    use super::*;

    fn mean(values: impl Iterator<Item = f64>) -> f64 {
        let (sum, count) = values.fold((0.0, 0.0), |(sum, count), value| (sum + value, count + 1.0));
        sum / count
    }

    #[test]
    fn noise_has_the_variance_and_the_persistence_that_it_says() {
        let stream = Seed(5).stream("noise");
        let at = |id: u32, time: f64| slow_noise(stream.indexed(u64::from(id)), time);
        // Four standard errors of 20 000 streams: 4/√20 000 = 0.03, of the variance 4 √(2/20 000) = 0.04.
        let all = || 0..20_000_u32;
        for time in [0.0, 0.3, 7.7] {
            assert!(mean(all().map(|id| at(id, time))).abs() < 0.03);
            assert!((mean(all().map(|id| at(id, time) * at(id, time))) - 1.0).abs() < 0.04);
        }
        let lags = (0..30).map(|lag| f64::from(lag) * 0.1 + 0.05);
        let integral: f64 = lags.map(|lag| 0.1 * mean(all().map(|id| at(id, 3.0) * at(id, 3.0 + lag)))).sum();
        assert!((integral - 1.0).abs() < 0.03, "{integral}");
        // It does not jump.
        let steps = (0..2000).map(|step| at(1, f64::from(step) * 0.005));
        let most = steps.clone().zip(steps.skip(1)).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(most < 0.05, "{most}");
    }

    #[test]
    fn decisions_are_taken_in_turns() {
        let perception = Perception { reaction_time: 0.8, ..Perception::default() };
        let count = |id| (0..80).filter(|step| perception.decides(id, *step, 0.1)).count();
        assert!((0..20).all(|id| count(id) == 10));
        assert_eq!((0..8).filter(|id| perception.decides(*id, 3, 0.1)).count(), 1);
        let at_once = Perception { reaction_time: 0.0, ..perception };
        assert!((0..9).all(|step| at_once.decides(7, step, 0.1)));
    }
}
