//! The wall clock of the server: for time limits and for the pace of the world, never for what happens in it.

use std::time::{Duration, Instant};

/// The time now.
#[expect(
    clippy::disallowed_methods,
    reason = "limits of clients and the pace of steps are outside the simulation"
)]
pub(super) fn now() -> Instant {
    Instant::now()
}

/// A time span of so many seconds; an hour at most, and not less than nothing.
pub(super) fn span(seconds: f64) -> Duration {
    Duration::from_secs_f64(seconds.clamp(0.0, 86_400.0))
}
