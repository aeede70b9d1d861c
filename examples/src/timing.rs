//! How long work takes: what the examples that print figures share.

use std::time::{Duration, Instant};

/// What work gives, and how long it took.
#[expect(clippy::disallowed_methods, reason = "measuring is what this is for")]
pub fn timed<T>(work: impl FnOnce() -> T) -> (T, Duration) {
    let start = Instant::now();
    let result = work();
    (result, start.elapsed())
}

/// The median of some times of the same work.
pub fn median<T>(times: usize, mut work: impl FnMut() -> T) -> Duration {
    let mut all: Vec<Duration> = (0..times).map(|_| timed(|| std::hint::black_box(work())).1).collect();
    all.sort_unstable();
    all[times / 2]
}

/// A time in microseconds, for tables.
pub fn micros(time: Duration) -> String {
    format!("{:.1} µs", time.as_secs_f64() * 1e6)
}
