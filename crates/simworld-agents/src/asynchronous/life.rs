//! A mind in a thread of its own.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::mpsc::Sender;
use std::thread::{Builder, JoinHandle, park};

use simworld_core::clock::Tick;
use simworld_core::id::EntityId;
use simworld_core::intent::Intent;
use simworld_core::scene::Scene;

use super::account::Accounts;
use super::buffer::{Buffer, Snapshot};
use super::{FreeMind, MindState};

/// What a mind hands in.
pub(super) enum Message {
    /// What it wants, after it saw the snapshot of a tick.
    Wants { index: usize, seen: Tick, intents: Vec<Intent> },
    /// Nothing any more.
    Died { index: usize, reason: String },
}

/// The thread of a mind, seen from the world.
pub(super) struct Life {
    pub(super) who: EntityId,
    /// What it died of, if it told so.
    pub(super) death: Option<String>,
    signs: Arc<Signs>,
    thread: Option<JoinHandle<()>>,
}

/// What thread and world know of each other.
#[derive(Default)]
struct Signs {
    /// It wants a newer snapshot.
    waits: AtomicBool,
    /// The tick that it thinks about.
    seen: AtomicU64,
}

impl Life {
    pub(super) fn begin<V: Send + Sync + 'static>(
        index: usize,
        who: EntityId,
        mind: FreeMind<V>,
        buffer: Arc<Buffer<V>>,
        hand_in: Sender<Message>,
        accounts: Arc<Accounts>,
    ) -> std::io::Result<Self> {
        let signs = Arc::new(Signs::default());
        let thinker = Thinker { index, who, mind, buffer, hand_in, accounts, signs: Arc::clone(&signs) };
        let thread = Builder::new().name(format!("mind {who}")).spawn(move || thinker.live())?;
        Ok(Self { who, death: None, signs, thread: Some(thread) })
    }

    pub(super) fn is_waiting(&self) -> bool {
        self.signs.waits.load(Ordering::SeqCst)
    }

    /// Wakes it if it waits.
    pub(super) fn wake(&self) {
        if self.signs.waits.swap(false, Ordering::SeqCst)
            && let Some(thread) = &self.thread
        {
            thread.thread().unpark();
        }
    }

    pub(super) fn state(&self) -> MindState {
        match &self.death {
            Some(reason) => MindState::Dead { reason: reason.clone() },
            None if self.is_waiting() => MindState::Waiting,
            None => MindState::Thinking { seen: Tick(self.signs.seen.load(Ordering::SeqCst)) },
        }
    }

    pub(super) fn has_ended(&self) -> bool {
        self.thread.as_ref().is_none_or(JoinHandle::is_finished)
    }

    /// Takes the thread back if it has ended; else it is let go, and ends after its thought.
    pub(super) fn join(&mut self) {
        if let Some(thread) = self.thread.take().filter(JoinHandle::is_finished) {
            // Panics of the mind are caught inside, so there is nothing to be told here.
            let _ = thread.join();
        }
    }
}

/// The same, seen from the thread.
struct Thinker<V> {
    index: usize,
    who: EntityId,
    mind: FreeMind<V>,
    buffer: Arc<Buffer<V>>,
    hand_in: Sender<Message>,
    accounts: Arc<Accounts>,
    signs: Arc<Signs>,
}

impl<V> Thinker<V> {
    /// Sees, thinks and hands in, until there is nothing more to see.
    fn live(mut self) {
        let mut seen = None;
        while let Some(snapshot) = self.look(seen) {
            let tick = snapshot.world.clock().tick();
            let before = seen.replace(tick);
            self.signs.seen.store(tick.0, Ordering::SeqCst);
            let mut intents = Vec::new();
            let thought = catch_unwind(AssertUnwindSafe(|| {
                for (_, events) in
                    snapshot.history.iter().filter(|(at, _)| before.is_none_or(|before| *at > before))
                {
                    self.mind.notice(events, self.who);
                }
                self.mind.decide(&snapshot.notes, &snapshot.world, self.who, &mut intents)
            }));
            drop(snapshot);
            self.accounts.decisions.fetch_add(1, Ordering::SeqCst);
            let death = match thought {
                Ok(Ok(())) => None,
                Ok(Err(error)) => Some(error.to_string()),
                Err(panic) => Some(format!("it panicked: {}", crate::panics::words(&*panic))),
            };
            if let Some(reason) = death {
                // What it wanted before it died was never handed in.
                let _ = self.hand_in.send(Message::Died { index: self.index, reason });
                return;
            }
            self.hand_in(tick, intents);
        }
    }

    /// The newest snapshot, when there is one newer than that tick; none at the end.
    fn look(&self, seen: Option<Tick>) -> Option<Arc<Snapshot<V>>> {
        loop {
            // First the sign, then the look: whoever puts in a newer one after the look sees the sign, and wakes.
            self.signs.waits.store(true, Ordering::SeqCst);
            if self.buffer.closed.load(Ordering::SeqCst) {
                return None;
            }
            if let Some(snapshot) = self.buffer.newer_than(seen) {
                self.signs.waits.store(false, Ordering::SeqCst);
                return Some(snapshot);
            }
            park();
        }
    }

    fn hand_in(&self, seen: Tick, intents: Vec<Intent>) {
        if intents.is_empty() {
            return;
        }
        let count = intents.len() as u64;
        self.accounts.handed_in.fetch_add(count, Ordering::SeqCst);
        if self.hand_in.send(Message::Wants { index: self.index, seen, intents }).is_err() {
            // The run is over and nobody listens.
            self.accounts.refused.fetch_add(count, Ordering::SeqCst);
        }
    }
}
