//! Whole sentences that ask for nothing, beside others that are understood: "The lamp hums at night. Remove the lamp."
//!
//! Where a sentence is understood neither by the words of remarks nor by the shape of its parts ([`super::told`]), each of its
//! sentences is looked at as a whole: one that tells something, orders nothing, wishes for nothing and sets no condition may be
//! passed over, whatever it speaks of. All others have to be understood.

use super::super::lexer::{Token, is_mark};
use super::super::lexicon::{category, longest_phrase};
use super::super::phrases::Phrases;
use super::parse::Reader;
use super::parts::Telling;
use super::told::ORDERS_ANYTHING;
use super::wish::Wish;

/// What begins a sentence that sets a condition or asks something.
#[rustfmt::skip]
const BEGINS: &Phrases = &Phrases::of(&["if", "unless", "should", "when", "once", "whenever", "as soon as", "in case", "suppose", "provided", "otherwise", "except", "not", "no", "none", "nor", "only",
    "how many", "how much", "which", "where is", "where are", "what is", "whats", "can", "could", "may", "will", "would", "is there", "are there", "does", "same", "ditto", "another", "also", "and"]);
/// By these a sentence changes what another asks for, or asks itself.
#[rustfmt::skip]
const CHANGES: &Phrases = &Phrases::of(&["unless", "except", "i mean", "i meant", "scratch that", "no wait", "wait no", "correction", "undo", "never mind", "forget it", "forget that", "please", "could you", "can you",
    "would you", "will you", "how about", "what about", "why not", "let us", "lets", "rather than", "i suggest", "i propose", "make sure", "another", "one more", "as well", "the same", "the others", "the rest",
    "instead please", "a new", "someone else", "is needed", "are needed", "is required", "is missing", "are missing", "no longer needed", "not needed", "isnt needed", "arent needed"]);
/// That something should be otherwise.
#[rustfmt::skip]
const OUGHT: &Phrases = &Phrases::of(&["should", "must", "ought", "shall", "has to be", "have to be", "has to go", "have to go", "has to stand", "needs to be", "need to be", "needs to go", "is to be", "are to be", "could use", "could do with", "lacks", "lack",
    "deserves", "deserve", "belongs", "belong", "goes", "can go", "may go", "would look", "would be", "looks better", "better", "could be", "needs a", "needs an", "needs some", "needs the", "wants a", "wants an", "need a", "need an", "need some", "want a", "want an",
    "wants the", "want the", "need the", "i want", "we want", "id like", "i would like", "wed like", "we would like", "id love", "i would love"]);
/// What a sentence behind a request may be about.
const OPEN: &[&str] = &["it", "its", "they", "them", "one", "ones", "he", "she", "him", "her"];

impl Reader<'_> {
    /// The wishes of sentences that are understood, if all the others ask for nothing.
    pub(super) fn of_sentences(
        &self,
        is_known: &dyn Fn(&Wish) -> bool,
        is_there: &dyn Fn(&[Vec<Wish>]) -> bool,
    ) -> Option<Vec<Vec<Wish>>> {
        // Of one sentence nothing is passed over as a whole.
        if !self.lexemes.iter().rev().skip(1).any(|lexeme| lexeme.token == Token::Break) {
            return None;
        }
        let found = self.in_parts(is_known, is_there, Telling::Sentence)?;
        // What is passed over may have said where.
        let is_nowhere = |wish: &Wish| matches!(wish, Wish::Add { at, .. } if at.is_empty());
        (is_there(&found) && !found.iter().flatten().any(is_nowhere)).then_some(found)
    }

    /// Where the sentence ends in which a token stands.
    pub(super) fn sentence_end(&self, from: usize) -> usize {
        (from..self.lexemes.len())
            .find(|at| self.lexemes[*at].token == Token::Break)
            .unwrap_or(self.lexemes.len())
    }

    /// Whether a whole sentence tells something, asks for nothing, and leaves what the others ask for as it is.
    pub(super) fn is_sentence_aside(
        &self,
        from: usize,
        end: usize,
        is_known: &dyn Fn(&Wish) -> bool,
    ) -> bool {
        let begins = from == 0
            || self.lexemes[..from]
                .iter()
                .rev()
                .take_while(|mark| is_mark(mark))
                .any(|mark| mark.token == Token::Break);
        let is_last = self.lexemes[end..].iter().all(is_mark);
        let words = &self.lexemes[from..end];
        if !begins || end != self.sentence_end(from) || words.len() < 3 {
            return false;
        }
        let any = |phrases: &Phrases| {
            (from..end).any(|at| longest_phrase(&self.lexemes[at..end], phrases).is_some())
        };
        // "It should be red" says how what was asked for is to be, and "people should be home by then" nothing of it.
        let is_open = (from..end).any(|at| self.word(at).is_some_and(|word| OPEN.contains(&word)));
        // "My keys must be under the bench" asks for nothing.
        let is_own = longest_phrase(words, &["my", "our", "his", "her", "their"]).is_some()
            && category(&words[1..]).is_none();
        let ought = any(OUGHT) && !is_own && (is_open || !self.names_nothing(from, end));
        let changes = ought || any(CHANGES) || is_last && self.may_take_back(from, end);
        longest_phrase(words, BEGINS).is_none()
            && longest_phrase(words, ORDERS_ANYTHING).is_none()
            && !changes
            && !self.orders_here(from, end)
            && !self.wishes_for_new(from, end)
            && self.tells_with_verb(from, end)
            && !self.is_read_as_wish(from, end, is_known)
    }
}
