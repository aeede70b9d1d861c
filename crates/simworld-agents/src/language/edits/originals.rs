//! "Copy the red bench to the left of the library and paint the original yellow": the original is what was copied.
//!
//! By the time of the second order there are two red benches, so that the one that is meant is put into the words before any order is carried out.

use super::super::lexer::{Lexeme, Token};
use super::super::lexicon::{category, longest, longest_phrase};
use super::super::paint::PAINTS;
use super::super::phrases::Phrases;
use super::parse::Reader;
use super::resolve::Finder;
use super::words::{VERBS, Verb};

/// What was copied, as it is called behind that.
#[rustfmt::skip]
const ORIGINAL: &Phrases = &Phrases::of(&["the original one", "the original", "the one i copied", "the old one", "the one that was copied", "the one you copied"]);
/// What is no thing that was copied: "in its original place".
#[rustfmt::skip]
const NO_THINGS: &[&str] = &["place", "spot", "position", "location", "colour", "color", "size", "name", "copy", "plan", "idea", "site"];

impl Reader<'_> {
    /// The words with what was copied in the place of "the original".
    pub(super) fn with_originals(&self, finder: &Finder<'_>) -> Option<Vec<Lexeme>> {
        let (at, words) = (1..self.lexemes.len()).find_map(|at| Some((at, self.original_at(at)?)))?;
        let copied = self.copied_before(at)?;
        let mut parser = self.parser(copied, at);
        let what = parser.reference(0).ok()?;
        // "The red bench to the left of the library" goes there.
        let mut bare = what.clone();
        bare.relation = None;
        let thing = finder.one(&bare).or_else(|_| finder.one(&what)).ok()?;
        let mut lexemes = self.lexemes.to_vec();
        let id = Lexeme { token: Token::Id(thing), lemma: None, ..self.lexemes[at].clone() };
        lexemes.splice(at..at + words, [id]);
        Some(lexemes)
    }

    /// How many words from here on mean what was copied.
    fn original_at(&self, at: usize) -> Option<usize> {
        let words = longest_phrase(&self.lexemes[at..], ORIGINAL)?;
        let next = at + words;
        if self.word(next).is_some_and(|word| NO_THINGS.contains(&word)) {
            return None;
        }
        // "The original bench".
        let rest = self.lexemes.get(next..).unwrap_or_default();
        // Green is a colour before it is a place.
        let noun = category(rest).filter(|_| words == 2 && longest(rest, PAINTS).is_none());
        Some(words + noun.map_or(0, |(_, words)| words))
    }

    /// Where what is copied stands, behind the last order before a word that copies something certain.
    fn copied_before(&self, before: usize) -> Option<usize> {
        (0..before).rev().find_map(|at| {
            let (verb, words) = longest(&self.lexemes[at..before], &VERBS)?;
            let what = at + words;
            (verb == Verb::Copy && what < before && self.is_certain(what)).then_some(what)
        })
    }
}

/// Every word of the table, for the spelling.
pub(super) fn words() -> impl Iterator<Item = &'static str> {
    ORIGINAL.iter().flat_map(|phrase| phrase.split(' '))
}
