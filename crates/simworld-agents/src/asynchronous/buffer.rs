//! The central buffer: the newest snapshot that anybody wanted, behind a pointer that is swapped.

use std::collections::VecDeque;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError, TryLockError};

use simworld_core::clock::Tick;
use simworld_core::event::Event;
use simworld_core::scene::{Scene, World};

/// What happened in a step, and the tick after it.
pub(super) type Happened = (Tick, Arc<[Event]>);

/// The world and what minds know of the task, after a step.
pub(super) struct Snapshot<V> {
    pub(super) notes: V,
    pub(super) world: World,
    /// What happened in the last steps in which something did, up to this one.
    pub(super) history: VecDeque<Happened>,
}

/// The newest snapshot. Whoever reads holds the lock only to copy a pointer; the world never waits for it.
pub(super) struct Buffer<V> {
    newest: Mutex<Arc<Snapshot<V>>>,
    pub(super) closed: AtomicBool,
}

impl<V> Buffer<V> {
    pub(super) fn new(first: Snapshot<V>) -> Self {
        Self { newest: Mutex::new(Arc::new(first)), closed: AtomicBool::new(false) }
    }

    /// Puts a snapshot in; false if somebody copies the pointer at this moment: then the next one will do.
    pub(super) fn offer(&self, snapshot: Snapshot<V>) -> bool {
        let snapshot = Arc::new(snapshot);
        let old = match self.newest.try_lock() {
            Ok(mut newest) => std::mem::replace(&mut *newest, snapshot),
            // Nothing that panics is done under the lock, and a pointer is whole at any moment.
            Err(TryLockError::Poisoned(poisoned)) => std::mem::replace(&mut *poisoned.into_inner(), snapshot),
            Err(TryLockError::WouldBlock) => return false,
        };
        // taken down outside of the lock
        drop(old);
        true
    }

    /// The newest snapshot, if it is newer than that tick.
    pub(super) fn newer_than(&self, seen: Option<Tick>) -> Option<Arc<Snapshot<V>>> {
        let newest = self.newest.lock().unwrap_or_else(PoisonError::into_inner);
        let is_newer = seen.is_none_or(|seen| newest.world.clock().tick() > seen);
        is_newer.then(|| Arc::clone(&newest))
    }

    /// No more snapshots: minds are to end.
    pub(super) fn close(&self) {
        self.closed.store(true, Ordering::SeqCst);
    }
}
