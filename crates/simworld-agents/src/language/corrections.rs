//! What takes back what was said before: "go to the clinic, no, the kiosk", "... instead of the museum".

use simworld_core::seam::PlanError;

use super::blocks::UNTIL;
use super::clause::{Clause, Pace, Test};
use super::deferred::first_and_later;
use super::lexer::{Lexeme, Token};
use super::lexicon::longest_phrase;
use super::parser::Parser;
use super::phrases::Phrases;
use super::politeness::NEGATIONS;
use super::verbs::longest_verb;

/// What says that the order before was a slip.
#[rustfmt::skip]
const CORRECTIONS: &Phrases = &Phrases::of(&[
    "no wait", "wait no", "no sorry", "sorry no", "sorry i mean", "sorry i meant", "no i mean", "no i meant",
    "i mean", "i meant", "or rather", "make that", "no make that", "actually make that", "actually no",
    "no actually", "scratch that", "strike that", "correction", "on second thoughts", "on second thought",
    "change of plan", "no hang on", "hang on no", "forget that", "better still", "that is", "that is to say",
    "in other words", "by which i mean", "as in", "or should i say", "or better", "no forget it", "forget it",
    "never mind", "wait what no", "belay that", "cancel that", "no no", "oh no", "oops no", "i said", "rather",
    "not that one", "not this one", "not that", "not there", "not him", "not her", "not those", "not them", "well make it", "make it", "no make it", "i take that back", "my mistake", "or perhaps better",
]);
/// What is not to be done, behind what is.
const INSTEAD: &[&str] =
    &["instead of", "rather than", "and not", "but not", "not", "in place of", "as opposed to"];

impl Parser<'_> {
    /// "Strike that; ...", "no, no, ...": what takes back what was said in another sentence.
    pub(super) fn skip_first_correction(&mut self) {
        loop {
            let start = self.at;
            let said = self.eat_any(CORRECTIONS)
                || self.eat_any(&[
                    "no",
                    "cut",
                    "action",
                    "not there",
                    "not that",
                    "not that one",
                    "not this one",
                    "not him",
                    "not her",
                    "not yet",
                    "as you were",
                    "wrong",
                    "stop stop",
                ]);
            let marked =
                matches!(self.rest().first().map(|lexeme| &lexeme.token), Some(Token::Comma | Token::Break));
            if !said || !marked || !self.skip_joints() || self.at >= self.lexemes.len() {
                self.at = start;
                return;
            }
        }
    }

    /// The order that takes the place of the one before, if what follows says that it was a slip.
    pub(super) fn correction(&mut self) -> Result<Option<Vec<Clause>>, PlanError> {
        let start = self.at;
        while matches!(self.rest().first().map(|lexeme| &lexeme.token), Some(Token::Comma | Token::Break)) {
            self.at += 1;
        }
        let marked = self.at > start;
        // "Go to the well. Well, ..." begins another sentence.
        let comma = marked && self.lexemes[self.at - 1].token == Token::Comma;
        let lone_no = marked
            && (self.peeks("no") || comma && self.peeks("well"))
            && matches!(self.rest().get(1), Some(Lexeme { token: Token::Comma, .. }));
        if lone_no {
            self.at += 1;
        } else if !self.eat_any(CORRECTIONS) {
            self.at = start;
            return Ok(None);
        }
        self.skip_joints();
        if self.at >= self.lexemes.len() {
            self.at = start;
            return Ok(None);
        }
        self.statement().map(Some)
    }

    /// "... instead of the museum", "..., not to the museum": passed over, if it is understood.
    pub(super) fn skip_instead(&mut self) -> bool {
        let start = self.at;
        if matches!(self.rest(), [Lexeme { token: Token::Comma, .. }, ..]) {
            self.at += 1;
        }
        if self.eat_any(INSTEAD) {
            self.eat_any(&["to", "at", "on", "in", "from", "with", "into"]);
            let at = self.at;
            let named = longest_verb(self.rest()).is_none()
                && (self.goods().is_some() || self.reference(0).is_ok())
                && self.ends_clause();
            if named {
                return true;
            }
            self.at = at;
            if self.lexemes.get(at).is_some_and(|lexeme| lexeme.lemma.is_some())
                && self.order().is_ok()
                && self.ends_clause()
            {
                return true;
            }
        }
        self.at = start;
        false
    }

    /// "Don't go to the museum, go to the school", "instead of waiting, sit down": what is not to be done is understood
    /// and left out, if something is to be done.
    pub(super) fn other_than_that(&mut self) -> Option<()> {
        let start = self.at;
        let negated = self.eat_any(&["instead of", "rather than", "in place of"]) || self.eat_any(NEGATIONS);
        if negated {
            let at = self.at;
            let understood = self.order().is_ok() || {
                self.at = at;
                self.eat_any(&["to", "at"]);
                self.reference(0).is_ok()
            };
            let mark =
                matches!(self.rest().first().map(|lexeme| &lexeme.token), Some(Token::Comma | Token::Break))
                    || longest_phrase(self.rest(), &["but"]).is_some();
            if understood
                && mark
                && self.skip_joints()
                && self.at < self.lexemes.len()
                && longest_phrase(self.rest(), NEGATIONS).is_none()
            {
                return Some(());
            }
        }
        self.at = start;
        None
    }

    /// "Don't put it down until you get to the museum": later, and not now.
    pub(super) fn not_until(&mut self) -> Result<Vec<Clause>, PlanError> {
        let start = self.at;
        self.eat_any(NEGATIONS);
        let later = self.order();
        if let Ok(later) = later
            && (self.eat_any(UNTIL) || self.eat_any(&["before", "unless", "without first", "without"]))
        {
            if let Some(first) = self.deed_done() {
                return Ok(first_and_later(first, later));
            }
            let unless = self.word_before() == "unless";
            let holds = matches!(self.word_before(), "until" | "till" | "til" | "before") || unless;
            let Some(test) = self.test().ok().filter(|_| holds) else {
                self.at = start;
                return Err(self.not_understood("that says what not to do: say what to do"));
            };
            if unless {
                return Ok(vec![Clause::If { test, then: later, otherwise: Vec::new() }]);
            }
            let mut clauses = vec![match test {
                Test::Near { what, .. } => {
                    Clause::Go { to: what, side: None, pace: Pace::Usual, within: None }
                }
                test => Clause::Until { test, body: Vec::new() },
            }];
            // "Don't cross until it is green, then walk to the clinic": the way there is what crosses.
            if !(matches!(later[..], [Clause::Cross]) && self.goes_next()) {
                clauses.extend(later);
            }
            return Ok(clauses);
        }
        self.at = start;
        Err(self.not_understood("that says what not to do: say what to do"))
    }

    /// Whether what follows sends somewhere; nothing is taken.
    fn goes_next(&mut self) -> bool {
        let start = self.at;
        let goes = self.skip_joints() && matches!(self.order().as_deref(), Ok([Clause::Go { .. }, ..]));
        self.at = start;
        goes
    }

    /// What is done instead of what is not to be done.
    pub(super) fn instead(&mut self) -> Option<Vec<Clause>> {
        let start = self.at;
        self.other_than_that()?;
        let order = std::mem::replace(&mut self.at, start);
        let mut clauses = self.names_within(order);
        self.at = order;
        clauses.extend(self.statement().ok()?);
        Some(clauses)
    }
}
