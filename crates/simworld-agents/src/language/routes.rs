//! Ways by how long they take, which is how one goes anyway: "the shortest way to the well", "take the quickest route there".

use super::clause::{Clause, Pace};
use super::lexer::{Lexeme, Token};
use super::lexicon::longest_phrase;
use super::parser::Parser;
use super::phrases::Phrases;

/// What makes a way the best.
#[rustfmt::skip]
const BEST: &Phrases = &Phrases::of(&[
    "shortest", "quickest", "fastest", "most direct", "direct", "best", "easiest", "shortest possible", "quickest possible", "straightest",
    "short", "quick", "fast", "fastest possible", "nearest", "closest", "simplest", "shorter", "quicker", "faster", "usual", "normal",
    "shortest and quickest", "very shortest", "very quickest",
]);
const WAYS: &[&str] = &["way", "route", "path", "road", "ways", "line", "way round", "way over"];
/// What leads to a place behind a way.
const TO: &Phrases = &Phrases::of(&[
    "to",
    "over to",
    "back to",
    "towards",
    "into",
    "for",
    "to get to",
    "of getting to",
    "to reach",
    "from here to",
    "from you to",
    "to go to",
]);
/// Before a way that one takes.
#[rustfmt::skip]
const BY: &Phrases = &Phrases::of(&[
    "by", "using", "via", "along", "on", "taking", "and take", "and use", "but take", "but by", "but use", "following", "and go", "going", "and by",
]);
/// Asking for a way, or saying that one is wanted.
#[rustfmt::skip]
const ASKED: &Phrases = &Phrases::of(&[
    "whats", "what is", "which is", "where is", "wheres", "do you know", "show me", "i need", "i want", "i am looking for", "im looking for", "find",
    "you know", "there is", "theres", "tell me", "find out", "work out", "figure out", "think of", "i need to know", "i want to know", "look up",
]);
/// Taking the way that was asked for.
#[rustfmt::skip]
const TAKEN: &Phrases = &Phrases::of(&[
    "take it", "take that", "take that one", "take that way", "go that way", "follow it", "use it", "use that", "go there", "walk it", "go", "take that route",
    "take that path", "walk there", "go along it", "take this one", "go down it", "follow that", "head there", "walk that way", "go by it", "go for it",
]);

impl Parser<'_> {
    /// "The shortest way" with what is said of it, but not where it leads; the marks that are passed are given back if it is none.
    fn eat_way(&mut self) -> bool {
        let start = self.at;
        self.eat_any(&["the", "a", "your", "my", "whatever is the", "whichever is the"]);
        let best = self.eat_any(BEST);
        let way = self.eat_any(WAYS);
        self.eat_any(&[
            "possible",
            "you know",
            "you can find",
            "you can",
            "that you know",
            "available",
            "that there is",
        ]);
        if !(best && way) {
            self.at = start;
        }
        best && way
    }

    /// "The shortest way to", before a place; "there" is a place too.
    pub(super) fn best_way(&mut self) -> bool {
        let start = self.at;
        let leads = self.eat_way()
            && (self.eat_any(TO) || longest_phrase(self.rest(), &["there", "here", "back here"]).is_some());
        if !leads {
            self.at = start;
        }
        leads
    }

    /// "Go to the well and take the shortest way": that is how one goes.
    pub(super) fn way_alone(&mut self) -> bool {
        let start = self.at;
        if self.eat_way() && self.ends_clause() {
            return true;
        }
        self.at = start;
        false
    }

    /// "By the quickest route", behind where one goes.
    pub(super) fn by_best_way(&mut self) {
        let start = self.at;
        self.at += usize::from(matches!(self.rest(), [Lexeme { token: Token::Comma, .. }, ..]));
        self.eat_any(BY);
        if self.eat_way() {
            self.eat_any(&["there", "to it"]);
            if self.ends_clause() {
                return;
            }
        }
        self.at = start;
    }

    /// "What's the quickest way to the hospital? Take it".
    pub(super) fn way_asked(&mut self) -> Option<Vec<Clause>> {
        let uses = self.eat_any(&["use", "choose", "pick", "go for"]);
        if !uses && !self.eat_any(ASKED) || !self.best_way() {
            return None;
        }
        let to = self.reference(0).ok()?;
        if uses && self.ends_clause() {
            return Some(vec![Clause::Go { to, side: None, pace: Pace::Usual, within: None }]);
        }
        self.eat_any(&["from here", "is", "please"]);
        self.skip_joints();
        let taken = self.eat_any(TAKEN);
        (taken && self.ends_clause())
            .then(|| vec![Clause::Go { to, side: None, pace: Pace::Usual, within: None }])
    }
}
