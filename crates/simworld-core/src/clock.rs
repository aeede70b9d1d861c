//! Simulated time: integer ticks of a fixed step.
//!
//! Time is counted, never accumulated: after 10⁹ ticks of 0.1 s the clock still reads exactly 10⁸ s.

use serde::{Deserialize, Serialize};
use thiserror::Error;

/// A count of steps since the world began.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Tick(pub u64);

impl Tick {
    /// The tick after this one.
    #[must_use]
    pub const fn next(self) -> Self {
        Self(self.0 + 1)
    }
}

impl std::fmt::Display for Tick {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        self.0.fmt(f)
    }
}

/// A step length that the clock cannot run on.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[error("a step of {microseconds} µs is out of range: give 1 to 60 000 000 µs (the default is 100 000)")]
pub struct ClockError {
    /// The refused step, µs.
    pub microseconds: u64,
}

/// A clock that advances by whole steps.
///
/// ```
/// use simworld_core::clock::Clock;
/// let mut clock = Clock::default(); // 0.1 s a step
/// for _ in 0..5000 { clock.advance(); }
/// assert_eq!(clock.seconds(), 500.0);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(try_from = "RawClock")]
pub struct Clock {
    tick: Tick,
    step_microseconds: u64,
}

#[derive(Deserialize)]
struct RawClock {
    tick: Tick,
    step_microseconds: u64,
}

impl TryFrom<RawClock> for Clock {
    type Error = ClockError;

    fn try_from(raw: RawClock) -> Result<Self, ClockError> {
        Ok(Self { tick: raw.tick, ..Self::new(raw.step_microseconds)? })
    }
}

impl Default for Clock {
    /// 0.1 s a step, the interval at which the paper's environment processes actions.
    fn default() -> Self {
        Self { tick: Tick(0), step_microseconds: 100_000 }
    }
}

impl Clock {
    /// A clock at tick zero.
    ///
    /// # Errors
    /// A step of zero or of more than a minute is refused.
    pub fn new(step_microseconds: u64) -> Result<Self, ClockError> {
        if !(1..=60_000_000).contains(&step_microseconds) {
            return Err(ClockError { microseconds: step_microseconds });
        }
        Ok(Self { tick: Tick(0), step_microseconds })
    }

    /// The current tick.
    pub const fn tick(&self) -> Tick {
        self.tick
    }

    /// The length of a step, s.
    pub fn dt(&self) -> f64 {
        self.step_microseconds as f64 * 1e-6
    }

    /// Simulated time since the world began, s.
    pub fn seconds(&self) -> f64 {
        (self.tick.0 * self.step_microseconds) as f64 * 1e-6
    }

    /// The number of whole ticks that cover `seconds`, at least one.
    pub fn ticks_in(&self, seconds: f64) -> u64 {
        ((seconds / self.dt()).ceil() as u64).max(1)
    }

    /// Moves on by one step.
    pub fn advance(&mut self) {
        self.tick = self.tick.next();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_clock_of_no_length_is_refused() {
        assert!(Clock::new(0).is_err());
        assert!(serde_json::from_str::<Clock>(r#"{"tick":3,"step_microseconds":0}"#).is_err());
    }

    #[test]
    fn ticks_cover_a_duration() {
        let clock = Clock::default();
        assert_eq!(clock.ticks_in(30.0), 300);
        assert_eq!(clock.ticks_in(0.01), 1);
    }
}
