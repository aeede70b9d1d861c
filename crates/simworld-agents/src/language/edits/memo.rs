//! What was found out about words while a sentence is read, so that each question is answered once.

use std::cell::{Cell, RefCell};
use std::collections::BTreeMap;
use std::collections::hash_map::DefaultHasher;
use std::hash::{Hash, Hasher};

use simworld_core::seam::PlanError;

use super::super::clause::Reference;
use super::super::lexer::{Lexeme, Token};

/// As many phrases are looked up for one sentence; who says more is not understood. The sets of sentences take up to 185.
const MOST: u32 = 360;
/// As many wishes are tried for one sentence, whole or in parts, as it stands or put together anew. The sets take up to 31, and odd ones of
/// strangers twice that.
const MOST_STEPS: u32 = 64;

/// What words say: they are asked about in many orders, and mean the same in each.
type Words = u64;

/// Answers by the words that were asked about.
#[derive(Default)]
pub(super) struct Memo {
    things: RefCell<BTreeMap<Words, Result<Reference, PlanError>>>,
    places: RefCell<BTreeMap<Words, bool>>,
    asked: Cell<u32>,
    steps: Cell<u32>,
}

impl Memo {
    /// Whether enough was tried.
    pub(super) fn is_spent(&self) -> bool {
        self.asked.get() >= MOST || self.steps.get() >= MOST_STEPS
    }

    /// Counts a wish that is tried.
    pub(super) fn step(&self) {
        self.steps.set(self.steps.get() + 1);
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

/// What some words say, whatever order they were found in.
pub(super) fn said(lexemes: &[Lexeme]) -> u64 {
    let mut hasher = DefaultHasher::new();
    for lexeme in lexemes {
        lexeme.start.hash(&mut hasher);
        match &lexeme.token {
            Token::Word(word) => word.hash(&mut hasher),
            Token::Number(number) => number.to_bits().hash(&mut hasher),
            other => std::mem::discriminant(other).hash(&mut hasher),
        }
    }
    hasher.finish()
}
