//! What is not to be done before something else is: "don't sit down until you have waved to Greta", "the statue, but not before
//! you have been to the kiosk", "only when you've said hello may you sit down".

use super::clause::{Clause, Pace, Reference, Target};
use super::lexer::{Lexeme, Token};
use super::lexicon::longest_phrase;
use super::numbers;
use super::parser::Parser;
use super::phrases::Phrases;
use super::verbs::longest_verb;
use simworld_core::seam::PlanError;

/// Having been somewhere, before where.
#[rustfmt::skip]
const BEEN: &Phrases = &Phrases::of(&[
    "youve been to", "you have been to", "youve been at", "you have been at", "having been to", "having been at", "been to", "been at", "youve been by",
    "you have been by", "youve been over to", "you have been over to", "youve seen", "you have seen",
]);
/// Having done something, before what.
#[rustfmt::skip]
const DONE: &Phrases = &Phrases::of(&[
    "youve", "you have", "you had", "having", "youve finished", "you have finished", "youre done", "you are done", "youve first", "you have first",
    "youve at least", "you have at least", "youve also", "you have also",
]);
/// What comes before a deed that has to be done first.
#[rustfmt::skip]
const NOT_BEFORE: &Phrases = &Phrases::of(&[
    "not until", "not before", "only when", "only once", "only after", "only as soon as", "not till",
]);
/// Between that deed and what is done then.
#[rustfmt::skip]
const MAY_YOU: &Phrases = &Phrases::of(&[
    "may you", "are you to", "can you", "should you", "do you", "shall you", "are you allowed to", "will you", "must you", "could you", "i want you to",
    "you may", "you can", "you should", "are you", "is it time to", "do i want you to", "would i like you to",
]);

impl Parser<'_> {
    /// "You have waved to Greta and bought a coffee": what is done first; nothing is taken where that is not said.
    pub(super) fn deed_done(&mut self) -> Option<Vec<Clause>> {
        let start = self.at;
        if self.eat_any(BEEN)
            && let Ok(to) = self.reference(0)
            && self.ends_clause()
        {
            return Some(vec![Clause::Go { to, side: None, pace: Pace::Usual, within: None }]);
        }
        self.at = start;
        let doing = |lexeme: &Lexeme| matches!(&lexeme.token, Token::Word(word) if word.ends_with("ing"));
        let said = self.eat_any(DONE) || self.rest().first().is_some_and(doing);
        let done = said && self.rest().first().is_some_and(|lexeme| lexeme.lemma.is_some());
        let mut clauses = if done { self.order().ok() } else { None };
        if let Some(clauses) = &mut clauses {
            self.for_a_while(clauses);
            while longest_phrase(self.rest(), &["and"])
                .is_some_and(|words| longest_verb(&self.rest()[words..]).is_some())
                && self.rest().get(1).is_some_and(|lexeme| lexeme.lemma.is_some())
            {
                self.at += 1;
                let Ok(more) = self.order() else { break };
                clauses.extend(more);
            }
        }
        if clauses.is_none() || !self.ends_clause() {
            self.at = start;
            return None;
        }
        clauses
    }

    /// "Only when you've said hello to Dmitri may you sit down".
    pub(super) fn only_then(&mut self) -> Option<Vec<Clause>> {
        if !self.eat_any(NOT_BEFORE) {
            return None;
        }
        let mut clauses = self.deed_before_may()?;
        self.skip_joints();
        if !self.eat_any(MAY_YOU) {
            return None;
        }
        clauses.extend(self.statement_here()?);
        Some(clauses)
    }

    /// The deed before "may you", which is no part of it.
    fn deed_before_may(&mut self) -> Option<Vec<Clause>> {
        let whole = self.lexemes;
        let end = (self.at + 1..whole.len()).find(|at| longest_phrase(&whole[*at..], MAY_YOU).is_some())?;
        self.lexemes = &whole[..end];
        let clauses = self.deed_done();
        self.lexemes = whole;
        clauses
    }

    /// "Meet me at the well in five minutes": what is waited for first.
    pub(super) fn delayed(&mut self, clauses: &mut Vec<Clause>) -> bool {
        let start = self.at;
        let time = if self.eat_any(&["in", "in about"]) { numbers::duration(self.rest()) } else { None };
        if let Some((seconds, words)) = time.filter(|(seconds, words)| *seconds > 0.0 && *words > 1) {
            self.at += words;
            self.eat_any(&["time", "from now"]);
            if self.ends_clause() {
                clauses.insert(clauses.len() - 1, Clause::Wait { seconds });
                return true;
            }
        }
        self.at = start;
        false
    }

    /// What was done before: an order, or a place alone.
    pub(super) fn earlier(&mut self) -> Result<Vec<Clause>, PlanError> {
        let start = self.at;
        if longest_verb(self.rest()).is_none()
            && let Ok(to) = self.reference(0)
        {
            return Ok(vec![Clause::Go { to, side: None, pace: Pace::Usual, within: None }]);
        }
        self.at = start;
        self.order()
    }
}

/// What is done first and what later, where words of the first may stand for what the later is about: "don't go to Fay until
/// you've bought her a soup".
pub(super) fn first_and_later(first: Vec<Clause>, later: Vec<Clause>) -> Vec<Clause> {
    let taken_up = first.iter().any(|clause| {
        clause.about().is_some_and(is_pronoun)
            || matches!(clause, Clause::Buy { whom: Some(whom), .. } | Clause::Give { to: whom, .. } if is_pronoun(whom))
    });
    let spoken_of = later.first().and_then(Clause::about).filter(|_| taken_up).cloned();
    let mut clauses: Vec<Clause> = spoken_of.into_iter().map(|what| Clause::Mention { what }).collect();
    clauses.extend(first);
    clauses.extend(later);
    clauses
}

fn is_pronoun(reference: &Reference) -> bool {
    matches!(reference.target, Target::It | Target::Them | Target::There)
}
