//! The wall clock: the only place of this crate's simulation that reads it, and nothing of it reaches a result.

use std::time::{Duration, Instant};

use serde::Serialize;
use simworld_core::clock::Clock;

use super::Pace;

/// How ticks kept their time.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct PaceReport {
    /// Ticks that had a time to begin.
    pub ticks: u64,
    /// How late the latest of them began.
    pub worst: Duration,
    /// How late all began together.
    pub total: Duration,
    /// Ticks that began later than a whole step, after which the schedule began anew.
    pub overruns: u64,
}

impl PaceReport {
    /// How late a tick began on average.
    pub fn mean(&self) -> Duration {
        self.total / u32::try_from(self.ticks.max(1)).unwrap_or(u32::MAX)
    }
}

/// Lets ticks begin in time.
pub(super) struct Pacer {
    /// Length of a step in life; none if no step waits.
    step: Option<Duration>,
    /// When the next tick is due.
    due: Option<Instant>,
    report: PaceReport,
}

impl Pacer {
    pub(super) fn new(pace: Pace, clock: Clock) -> Self {
        let step = match pace {
            Pace::RealTime { factor } => Some(Duration::from_secs_f64(clock.dt() / factor)),
            Pace::AsFastAsPossible => None,
        };
        Self { step, due: None, report: PaceReport::default() }
    }

    /// Waits until the next tick is due; the first is due at once.
    pub(super) fn wait(&mut self) {
        let Some(step) = self.step else { return };
        let due = *self.due.get_or_insert_with(now);
        if let Some(early) = due.checked_duration_since(now()) {
            std::thread::sleep(early);
        }
        let begun = now();
        let late = begun.saturating_duration_since(due);
        self.report.ticks += 1;
        self.report.worst = self.report.worst.max(late);
        self.report.total += late;
        let is_overrun = late > step;
        self.report.overruns += u64::from(is_overrun);
        self.due = Some(if is_overrun { begun } else { due } + step);
    }

    pub(super) fn report(&self) -> &PaceReport {
        &self.report
    }
}

/// The time of life.
#[expect(
    clippy::disallowed_methods,
    reason = "when a step begins is outside of the simulation; what it does is not"
)]
pub(super) fn now() -> Instant {
    Instant::now()
}
