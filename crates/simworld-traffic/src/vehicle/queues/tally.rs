//! Counts that several threads add to.

use std::sync::atomic::{AtomicU32, Ordering};

use serde::{Deserialize, Serialize};

/// Counts by number. Sums do not depend on the order in which they are made: who adds, and on which thread, leaves no trace,
/// as long as nobody reads a count in the phase in which others add to it.
#[derive(Debug, Default, Serialize, Deserialize)]
#[serde(transparent)]
pub(crate) struct Tally(Vec<AtomicU32>);

impl Tally {
    pub(crate) fn new(len: usize) -> Self {
        Self((0..len).map(|_| AtomicU32::new(0)).collect())
    }

    pub(crate) fn len(&self) -> usize {
        self.0.len()
    }

    #[inline]
    pub(crate) fn get(&self, index: usize) -> u32 {
        self.0[index].load(Ordering::Relaxed)
    }

    /// Puts a value in the place of the old one; only one thread may do so for an index in a phase.
    #[inline]
    pub(crate) fn set(&self, index: usize, value: u32) {
        self.0[index].store(value, Ordering::Relaxed);
    }

    #[inline]
    pub(crate) fn add(&self, index: usize, count: u32) {
        self.0[index].fetch_add(count, Ordering::Relaxed);
    }

    #[inline]
    pub(crate) fn take(&self, index: usize, count: u32) {
        self.0[index].fetch_sub(count, Ordering::Relaxed);
    }

    pub(crate) fn push(&mut self, value: u32) {
        self.0.push(AtomicU32::new(value));
    }

    /// Every count back to nothing.
    pub(crate) fn clear(&mut self) {
        for count in &mut self.0 {
            *count.get_mut() = 0;
        }
    }

    pub(crate) fn iter(&self) -> impl Iterator<Item = u32> {
        self.0.iter().map(|count| count.load(Ordering::Relaxed))
    }
}

impl Clone for Tally {
    fn clone(&self) -> Self {
        Self(self.iter().map(AtomicU32::new).collect())
    }
}
