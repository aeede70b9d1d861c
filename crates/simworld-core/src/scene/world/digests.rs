//! Digests of slots: renewed when somebody asks, for those alone that changed since somebody asked last.

use std::sync::{Mutex, MutexGuard, PoisonError};

/// The digest of each slot, zero for a free one, and those of them that are out of date.
#[derive(Debug, Default)]
pub(super) struct Digests {
    // Readers share a world, and whoever asks first renews for all.
    kept: Mutex<Kept>,
}

#[derive(Clone, Debug, Default)]
struct Kept {
    of: Vec<u64>,
    stale: Vec<u32>,
    /// By slot, whether it is among the stale.
    is_stale: Vec<bool>,
}

impl Digests {
    pub(super) fn add_slot(&mut self) {
        let kept = self.kept.get_mut().unwrap_or_else(PoisonError::into_inner);
        kept.of.push(0);
        kept.is_stale.push(false);
    }

    /// Notes slots that changed.
    pub(super) fn note(&mut self, slots: &[u32]) {
        let kept = self.kept.get_mut().unwrap_or_else(PoisonError::into_inner);
        for slot in slots {
            if !std::mem::replace(&mut kept.is_stale[*slot as usize], true) {
                kept.stale.push(*slot);
            }
        }
    }

    /// Shows the digests of all slots, after those that were noted, and some more, have been taken anew.
    pub(super) fn read<R>(
        &self,
        also: &[u32],
        anew: impl Fn(usize) -> u64,
        reader: impl FnOnce(&[u64]) -> R,
    ) -> R {
        let mut kept = self.lock();
        let Kept { of, stale, is_stale } = &mut *kept;
        for slot in stale.drain(..) {
            is_stale[slot as usize] = false;
            of[slot as usize] = anew(slot as usize);
        }
        for slot in also {
            of[*slot as usize] = anew(*slot as usize);
        }
        reader(of)
    }

    fn lock(&self) -> MutexGuard<'_, Kept> {
        // Whoever panicked while it held them left digests that are right or noted.
        self.kept.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Clone for Digests {
    fn clone(&self) -> Self {
        Self { kept: Mutex::new(self.lock().clone()) }
    }
}
