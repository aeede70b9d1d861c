//! Time as models' wrappers see it: waits between attempts, requests a minute, latencies.
//!
//! None of it reaches the simulation.

use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

/// A clock that goes forward and can be waited on.
pub trait Clock: Send + Sync {
    /// The time since a moment of the clock's own.
    fn now(&self) -> Duration;

    /// Returns when this much time has passed.
    fn sleep(&self, wait: Duration);
}

/// Real time; it begins when it is made.
#[derive(Clone, Copy, Debug)]
pub struct WallClock {
    start: Instant,
}

impl WallClock {
    /// A clock that shows zero now.
    // models are outside the simulation, and so is the time they take
    #[allow(clippy::disallowed_methods)]
    pub fn new() -> Self {
        Self { start: Instant::now() }
    }
}

impl Default for WallClock {
    fn default() -> Self {
        Self::new()
    }
}

impl Clock for WallClock {
    fn now(&self) -> Duration {
        self.start.elapsed()
    }

    fn sleep(&self, wait: Duration) {
        std::thread::sleep(wait);
    }
}

/// A clock that moves only while somebody sleeps, at once: for tests, and for replays that shall not wait.
#[derive(Debug, Default)]
pub struct ManualClock {
    now: Mutex<Duration>,
}

impl ManualClock {
    /// A clock that shows zero.
    pub fn new() -> Self {
        Self::default()
    }
}

impl Clock for ManualClock {
    fn now(&self) -> Duration {
        *self.now.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn sleep(&self, wait: Duration) {
        let mut now = self.now.lock().unwrap_or_else(PoisonError::into_inner);
        *now = now.saturating_add(wait);
    }
}
