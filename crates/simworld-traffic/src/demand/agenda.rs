//! When somebody is due: single ones at their time, those of flows one after the other.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use simworld_core::seed::Stream;

use super::Arrivals;

/// Numbers that are due at times: the earliest first, and the least number first of one time.
#[derive(Clone, Debug, Default)]
pub(super) struct Agenda(BinaryHeap<Reverse<(u64, usize)>>);

impl Agenda {
    /// Times before 0 are 0; the bits of those that are not negative are in their order.
    pub(super) fn add(&mut self, time: f64, number: usize) {
        self.0.push(Reverse((time.max(0.0).to_bits(), number)));
    }

    /// Whether one is due by now.
    pub(super) fn is_due(&self, now: f64) -> bool {
        self.0.peek().is_some_and(|Reverse((bits, _))| f64::from_bits(*bits) <= now)
    }

    /// Takes the next that is due by now.
    pub(super) fn take(&mut self, now: f64) -> Option<(f64, usize)> {
        if !self.is_due(now) {
            return None;
        }
        self.0.pop().map(|Reverse((bits, number))| (f64::from_bits(bits), number))
    }

    pub(super) fn len(&self) -> usize {
        self.0.len()
    }

    pub(super) fn is_empty(&self) -> bool {
        self.0.is_empty()
    }
}

/// The times at which those of a flow come.
#[derive(Clone, Debug)]
pub(super) struct Beat {
    /// How many come an hour.
    pub(super) per_hour: f64,
    pub(super) arrivals: Arrivals,
    /// When no more come, s.
    pub(super) until: f64,
    /// At most so many.
    pub(super) number: u64,
    /// How many came.
    pub(super) drawn: u64,
    pub(super) stream: Stream,
}

impl Beat {
    /// When the first comes of a flow that begins at a time, s.
    pub(super) fn first(&self, from: f64) -> Option<f64> {
        let wait = if self.arrivals == Arrivals::Poisson { self.wait() } else { 0.0 };
        self.is_time(from + wait)
    }

    /// Counts one who comes at a time, and says when the next does, s.
    pub(super) fn count(&mut self, time: f64) -> Option<f64> {
        self.drawn += 1;
        self.is_time(time + self.wait())
    }

    fn is_time(&self, time: f64) -> Option<f64> {
        (self.drawn < self.number && time < self.until).then_some(time)
    }

    /// Time to the next of them, s.
    fn wait(&self) -> f64 {
        let rate = self.per_hour / 3600.0;
        match self.arrivals {
            Arrivals::Uniform => 1.0 / rate,
            Arrivals::Poisson => self.stream.indexed(self.drawn).rng().exponential(rate),
        }
    }
}
