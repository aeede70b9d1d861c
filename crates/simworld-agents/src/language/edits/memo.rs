//! What was found out about words while a sentence is read, so that each question is answered once.

use std::cell::{Cell, RefCell};
use std::collections::BTreeMap;

use simworld_core::seam::PlanError;
use xxhash_rust::xxh3::xxh3_64_with_seed;

use super::super::clause::Reference;
use super::super::lexer::{Lexeme, Token};
use super::wish::Wish;

/// As many phrases are looked up for one sentence; who says more is not understood. The sets of sentences take up to 185.
const MOST: u32 = 1200;
/// As many wishes are tried for one sentence, whole or in parts, as it stands or put together anew. The sets take up to 31, and odd ones of
/// strangers twice that.
const MOST_STEPS: u32 = 160;

/// What words say: they are asked about in many orders, and mean the same in each.
type Words = u64;

/// All words of a reader, where in them a wish begins and ends, and how often they were put together anew.
type Asked = (Words, usize, usize, u8);
/// What was read there, and up to where.
type Read = (Result<Vec<Vec<Wish>>, PlanError>, usize);

/// Answers by the words that were asked about.
#[derive(Default)]
pub(super) struct Memo {
    things: RefCell<BTreeMap<Words, Result<Reference, PlanError>>>,
    places: RefCell<BTreeMap<Words, bool>>,
    wishes: RefCell<BTreeMap<Asked, Read>>,
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

    /// The wish that was read before.
    pub(super) fn wish(&self, asked: &Asked) -> Option<Read> {
        self.wishes.borrow().get(asked).cloned()
    }

    /// Keeps what was read.
    pub(super) fn keep_wish(&self, asked: Asked, read: &Result<Vec<Vec<Wish>>, PlanError>, at: usize) {
        self.wishes.borrow_mut().insert(asked, (read.clone(), at));
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
    lexemes.iter().fold(0, |so_far, lexeme| {
        let seed = so_far ^ (lexeme.start as u64).wrapping_mul(0x9E37_79B9_7F4A_7C15);
        match &lexeme.token {
            Token::Word(word) => xxh3_64_with_seed(word.as_bytes(), seed),
            Token::Number(number) => xxh3_64_with_seed(&number.to_bits().to_le_bytes(), seed),
            Token::Id(id) => xxh3_64_with_seed(&id.index().to_le_bytes(), !seed),
            Token::Ids(ids) => {
                ids.iter().fold(!seed, |so_far, id| xxh3_64_with_seed(&id.index().to_le_bytes(), so_far))
            }
            Token::Open => xxh3_64_with_seed(b"(", seed),
            Token::Close => xxh3_64_with_seed(b")", seed),
            Token::Comma => xxh3_64_with_seed(b",", seed),
            Token::Break => xxh3_64_with_seed(b".", seed),
        }
    })
}
