//! What was found out about words while a sentence is read, so that each question is answered once.

use std::cell::{Cell, RefCell};
use std::collections::BTreeMap;

use simworld_core::seam::PlanError;

use super::super::clause::Reference;

/// As many phrases are looked up for one sentence; who says more is not understood. A phrase takes some 20 µs.
const MOST: u32 = 500;

/// The text that words are of, and where they begin and end in it.
type Words = (u32, usize, usize);

/// Answers by the words that were asked about.
#[derive(Default)]
pub(super) struct Memo {
    things: RefCell<BTreeMap<Words, Result<Reference, PlanError>>>,
    places: RefCell<BTreeMap<Words, bool>>,
    texts: Cell<u32>,
    asked: Cell<u32>,
}

impl Memo {
    /// A number for words that stand in another order than those before.
    pub(super) fn new_text(&self) -> u32 {
        self.texts.set(self.texts.get() + 1);
        self.texts.get()
    }

    /// Whether enough was tried.
    pub(super) fn is_spent(&self) -> bool {
        self.asked.get() >= MOST
    }

    /// What words name.
    pub(super) fn thing(
        &self,
        key: Words,
        find: impl FnOnce() -> Result<Reference, PlanError>,
    ) -> Result<Reference, PlanError> {
        if let Some(known) = self.things.borrow().get(&key) {
            return known.clone();
        }
        self.asked.set(self.asked.get() + 1);
        let found = find();
        self.things.borrow_mut().insert(key, found.clone());
        found
    }

    /// Whether a place begins somewhere.
    pub(super) fn place(&self, key: Words, find: impl FnOnce() -> bool) -> bool {
        if let Some(known) = self.places.borrow().get(&key) {
            return *known;
        }
        let found = find();
        self.places.borrow_mut().insert(key, found);
        found
    }
}
