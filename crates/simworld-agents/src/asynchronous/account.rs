//! What became of every intent.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use serde::Serialize;
use simworld_core::clock::Tick;
use simworld_core::id::EntityId;

/// Why intents are refused that come after the end.
pub(super) const OVER: &str = "the run is over";

/// What became of an intent.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Fate {
    /// It took effect in the step of that tick, and stands in the recording.
    Applied {
        /// The tick that used it.
        tick: Tick,
    },
    /// It was about a snapshot older than is allowed.
    Late {
        /// The tick at which it was gathered.
        tick: Tick,
    },
    /// It could not be taken.
    Refused {
        /// Why.
        reason: &'static str,
    },
}

/// What became of one intent.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Receipt {
    /// Whose it was.
    pub who: EntityId,
    /// Which of those that this mind handed in, from 0.
    pub serial: u64,
    /// The tick of the snapshot that it was about.
    pub seen: Tick,
    /// What became of it.
    pub fate: Fate,
}

/// How many intents were handed in, and what became of them. When all minds have ended, the first number is the sum of the others.
#[derive(Debug, Default)]
pub struct Accounts {
    pub(super) handed_in: AtomicU64,
    pub(super) applied: AtomicU64,
    pub(super) late: AtomicU64,
    pub(super) refused: AtomicU64,
    pub(super) decisions: AtomicU64,
}

impl Accounts {
    /// Intents that minds handed in; minds count them themselves.
    pub fn handed_in(&self) -> u64 {
        self.handed_in.load(Ordering::SeqCst)
    }

    /// Those that took effect.
    pub fn applied(&self) -> u64 {
        self.applied.load(Ordering::SeqCst)
    }

    /// Those that were too old.
    pub fn late(&self) -> u64 {
        self.late.load(Ordering::SeqCst)
    }

    /// Those that could not be taken.
    pub fn refused(&self) -> u64 {
        self.refused.load(Ordering::SeqCst)
    }

    /// How often minds decided, also on nothing.
    pub fn decisions(&self) -> u64 {
        self.decisions.load(Ordering::SeqCst)
    }
}

/// Receipts that nobody asked for yet, and the sums.
pub(super) struct Books {
    accounts: Arc<Accounts>,
    receipts: Vec<Receipt>,
    /// The next serial of each mind.
    serials: Vec<u64>,
}

impl Books {
    pub(super) fn new(minds: usize) -> Self {
        Self { accounts: Arc::default(), receipts: Vec::new(), serials: vec![0; minds] }
    }

    pub(super) fn accounts(&self) -> Arc<Accounts> {
        Arc::clone(&self.accounts)
    }

    pub(super) fn take(&mut self) -> Vec<Receipt> {
        std::mem::take(&mut self.receipts)
    }

    /// Enters what became of the next intent of a mind.
    pub(super) fn enter(&mut self, mind: usize, who: EntityId, seen: Tick, fate: Fate) {
        let counter = match &fate {
            Fate::Applied { .. } => &self.accounts.applied,
            Fate::Late { .. } => &self.accounts.late,
            Fate::Refused { .. } => &self.accounts.refused,
        };
        counter.fetch_add(1, Ordering::SeqCst);
        let serial = self.serials[mind];
        self.serials[mind] += 1;
        self.receipts.push(Receipt { who, serial, seen, fate });
    }
}
