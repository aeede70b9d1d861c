//! Tokens to orders: how the orders of a sentence hang together.
//!
//! ```text
//! sentence  = statement { joint statement }
//! joint     = "," | "." | ";" | "and" | "then" | "next" | "after that" | ...
//! statement = "if" test group ["otherwise" group] | "when" test order | "until" test group | "keep" order
//!           | "repeat" number "times" group | "before" order "," order | order { tail }
//! group     = statement { "and" statement }
//! tail      = number "times" | "until" test | "while" test | "for" time | "if" test | "unless" test | "when" test
//!           | "before" order | "after" order
//! order     = a verb with its objects (see `orders`); without a verb, that of the order before ("then to the museum")
//! ```

use simworld_core::action::StepDirection;
use simworld_core::seam::PlanError;

use super::clause::{Clause, Pace, Test};
use super::lexer::{Lexeme, Token};
use super::lexicon::{Category, fits, longest_phrase, longest_verb};
use super::names::Names;
use super::numbers;
use super::politeness::{FILLERS, JOINTS, NEGATIONS};
use super::resolve::View;
use super::verbs::Verb;

/// What is understood, in one line, for answers.
pub(super) const UNDERSTOOD: &str = "say go to, follow, look at, pick up, drop off, put down, give, buy, sit down, stand up, \
     stop, wait, ride, drive to, get off, open, step, turn, wave at, point at, talk to, argue with or take a photo, joined by \
     \"and\" or \"then\"";
/// How deep conditions and repetitions may nest.
const DEEPEST: u32 = 4;

/// Reads a sentence from left to right.
pub(super) struct Parser<'a> {
    pub(super) words: &'a str,
    pub(super) lexemes: &'a [Lexeme],
    pub(super) names: &'a Names<'a>,
    pub(super) view: &'a View<'a>,
    pub(super) at: usize,
    /// The class that was named last: what "the red one" is one of.
    pub(super) class: Option<&'static Category>,
    /// The verb of the order before, for those that leave it out.
    pub(super) verb: Option<Verb>,
    /// Whether a condition is read: then "is" says what holds and not which thing is meant.
    pub(super) in_test: bool,
    depth: u32,
}

/// How the orders of a list hang together.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Extent {
    /// To the end of the words.
    Sentence,
    /// As far as "and" reaches.
    Group,
}

impl<'a> Parser<'a> {
    pub(super) fn new(
        words: &'a str,
        lexemes: &'a [Lexeme],
        names: &'a Names<'a>,
        view: &'a View<'a>,
    ) -> Self {
        Self { words, lexemes, names, view, at: 0, class: None, verb: None, in_test: false, depth: 0 }
    }

    /// All orders of the sentence, at least one.
    pub(super) fn sentence(&mut self) -> Result<Vec<Clause>, PlanError> {
        self.skip_joints();
        let clauses = self.orders(Extent::Sentence)?;
        if clauses.is_empty() { Err(self.not_understood(UNDERSTOOD)) } else { Ok(clauses) }
    }

    fn orders(&mut self, extent: Extent) -> Result<Vec<Clause>, PlanError> {
        let mut clauses: Vec<Clause> = Vec::new();
        let mut group = 0;
        while self.at < self.lexemes.len() {
            let statement = self.statement()?;
            clauses.extend(statement);
            self.tails(&mut clauses, group)?;
            if extent == Extent::Group && !self.goes_on_with_and() {
                return Ok(clauses);
            }
            let start = self.at;
            self.skip_fillers();
            let joined = self.skip_joints();
            let goes_on = longest_verb(self.rest()).is_some() || self.begins_block();
            if self.at < self.lexemes.len() && !joined && !goes_on {
                return Err(self.not_understood("end here, or go on with \"and\" or \"then\""));
            }
            if !self.is_and(start) {
                group = clauses.len();
            }
        }
        Ok(clauses)
    }

    /// Whether "and", and no comma nor "then", joins what follows.
    fn goes_on_with_and(&mut self) -> bool {
        let start = self.at;
        self.skip_fillers();
        let goes_on = fits(self.rest(), "and").is_some();
        if !goes_on {
            self.at = start;
        }
        goes_on
    }

    /// Whether the words from a place to here are "and" alone.
    fn is_and(&self, start: usize) -> bool {
        let joint = &self.lexemes[start..self.at];
        joint.iter().any(|lexeme| lexeme.token == Token::Word("and".to_owned()))
            && !joint.iter().any(|lexeme| matches!(&lexeme.token, Token::Word(word) if word == "then"))
            && !joint.iter().any(|lexeme| lexeme.token == Token::Break)
    }

    fn begins_block(&self) -> bool {
        const BLOCKS: &[&str] =
            &["if", "unless", "when", "until", "keep", "repeat", "before", "after", "while"];
        longest_phrase(self.rest(), BLOCKS).is_some()
    }

    /// One order or block, without what follows it.
    fn statement(&mut self) -> Result<Vec<Clause>, PlanError> {
        self.skip_fillers();
        if longest_phrase(self.rest(), NEGATIONS).is_some() && longest_verb(self.rest()).is_none() {
            return Err(self.not_understood("that says what not to do: say what to do"));
        }
        if self.depth >= DEEPEST {
            return Err(self.not_understood("put at most four conditions and repetitions into one another"));
        }
        self.depth += 1;
        let block = self.block();
        self.depth -= 1;
        match block? {
            Some(clauses) => Ok(clauses),
            None => self.order(),
        }
    }

    fn block(&mut self) -> Result<Option<Vec<Clause>>, PlanError> {
        if self.eat_any(&["if", "in case", "provided that", "provided"]) {
            return self.either(false).map(Some);
        }
        if self.eat_any(&["unless", "if not"]) {
            return self.either(true).map(Some);
        }
        if self.eat_any(&["until", "till"]) {
            let test = self.test()?;
            self.skip_joints();
            return Ok(Some(vec![Clause::Until { test, body: self.orders(Extent::Group)? }]));
        }
        if self.eat_any(&["while", "as long as"]) {
            let test = Test::Not(Box::new(self.test()?));
            self.skip_joints();
            let start = self.at;
            if self.eat_any(&["wait", "stop", "stand still", "stay", "wait here", "stand"])
                && self.ends_clause()
            {
                return Ok(Some(vec![Clause::Until { test, body: Vec::new() }]));
            }
            self.at = start;
            return Ok(Some(vec![Clause::Until { test, body: self.orders(Extent::Group)? }]));
        }
        if self.eat_any(&["when", "whenever", "once", "as soon as", "after"]) {
            return self.afterwards().map(Some);
        }
        if self.eat_any(&["before"]) {
            let later = self.statement()?;
            self.skip_joints();
            let mut clauses = self.statement()?;
            clauses.extend(later);
            return Ok(Some(clauses));
        }
        if self.eat_any(&["keep", "keep on", "continue", "continue to", "go on", "carry on", "dont stop"])
            && !self.ends_clause()
        {
            return self.keep().map(Some);
        }
        let start = self.at;
        self.eat_any(&["repeat", "repeat this", "do this", "do the following", "repeat the following"]);
        if let Some((times, count)) = numbers::times(self.rest()) {
            self.at += count;
            // "Repeat three times: ..." is about all that follows.
            let colon = matches!(self.rest(), [Lexeme { token: Token::Break, .. }, ..]);
            self.skip_joints();
            let extent = if colon { Extent::Sentence } else { Extent::Group };
            return Ok(Some(vec![Clause::Repeat { times, body: self.orders(extent)? }]));
        }
        self.at = start;
        Ok(None)
    }

    /// After "if": the test, what to do, and what else.
    fn either(&mut self, negated: bool) -> Result<Vec<Clause>, PlanError> {
        let test = self.test()?;
        let test = if negated { Test::Not(Box::new(test)) } else { test };
        self.skip_joints();
        let then = self.orders(Extent::Group)?;
        let end = self.at;
        self.skip_joints();
        let mut otherwise = Vec::new();
        if self.eat_any(&["otherwise", "else", "or else", "if not", "or"]) {
            self.skip_joints();
            otherwise = self.orders(Extent::Group)?;
        } else {
            self.at = end;
        }
        Ok(vec![Clause::If { test, then, otherwise }])
    }

    /// After "when": a test to wait for, or an order that comes first.
    fn afterwards(&mut self) -> Result<Vec<Clause>, PlanError> {
        let start = self.at;
        if let Ok(test) = self.test() {
            self.skip_joints();
            let mut clauses = vec![Clause::Until { test, body: Vec::new() }];
            if self.at < self.lexemes.len() {
                clauses.extend(self.statement()?);
            }
            return Ok(clauses);
        }
        self.at = start;
        self.eat_any(&["you", "you have", "youve", "you are", "you had", "having"]);
        self.statement()
    }

    /// After "keep": an order that goes on.
    fn keep(&mut self) -> Result<Vec<Clause>, PlanError> {
        let mut body = self.order()?;
        if let [Clause::Step { direction: StepDirection::Forward, .. }] = body[..] {
            body = vec![Clause::Forward];
        }
        Ok(body)
    }

    /// What follows an order and says how often, how long or when.
    fn tails(&mut self, clauses: &mut Vec<Clause>, group: usize) -> Result<(), PlanError> {
        loop {
            let start = self.at;
            self.eat_any(&["again and again", "over and over", "over and over again", "repeatedly"]);
            self.skip_fillers();
            let comma = matches!(self.rest(), [Lexeme { token: Token::Comma, .. }, ..]);
            let goes_on = || {
                const AFTER_COMMA: &[&str] = &["until", "till", "unless", "but first", "but before that"];
                longest_phrase(&self.rest()[1..], AFTER_COMMA).is_some()
            };
            if let Some((times, count)) = numbers::times(&self.rest()[usize::from(comma)..]) {
                self.at += usize::from(comma) + count;
                repeat(clauses, group, times, comma);
            } else if comma && !goes_on() || !self.tail(clauses, comma)? {
                self.at = start;
                return Ok(());
            }
        }
    }

    fn tail(&mut self, clauses: &mut Vec<Clause>, comma: bool) -> Result<bool, PlanError> {
        self.at += usize::from(comma);
        let Some(last) = clauses.last() else { return Ok(false) };
        if self.eat_any(&["until", "till"]) {
            let test = self.test()?;
            let body = match (clauses.pop(), &test) {
                // Whoever walks until he is somewhere goes there.
                (Some(Clause::Forward), Test::Near { what, .. }) => {
                    let (to, pace) = (what.clone(), Pace::Usual);
                    vec![Clause::Go { to, side: None, pace, within: None }]
                }
                (last, _) => body_of(last),
            };
            clauses.push(Clause::Until { test, body });
        } else if self.eat_any(&["while", "as long as"]) {
            let test = Test::Not(Box::new(self.test()?));
            let body = body_of(clauses.pop());
            clauses.push(Clause::Until { test, body });
        } else if self.eat_any(&["if", "provided that", "in case", "provided"]) {
            let test = self.test()?;
            let then = clauses.pop().into_iter().collect();
            clauses.push(Clause::If { test, then, otherwise: Vec::new() });
        } else if self.eat_any(&["unless"]) {
            let test = Test::Not(Box::new(self.test()?));
            let then = clauses.pop().into_iter().collect();
            clauses.push(Clause::If { test, then, otherwise: Vec::new() });
        } else if self.eat_any(&["when", "once", "as soon as"]) {
            let test = self.test()?;
            clauses.insert(clauses.len() - 1, Clause::Until { test, body: Vec::new() });
        } else if self.eat_any(&["before"]) {
            clauses.extend(self.order()?);
        } else if self.eat_any(&[
            "after",
            "but first",
            "but before that",
            "but first of all",
            "but beforehand",
        ]) {
            let earlier = self.order()?;
            let at = clauses.len() - 1;
            clauses.splice(at..at, earlier);
        } else if let Some((seconds, count)) = self.peek_for() {
            // "Towards the museum for ten seconds" is on the way; "to the museum for ten seconds" is there.
            let earlier = &self.lexemes[self.at.saturating_sub(6)..self.at];
            let towards = earlier
                .iter()
                .any(|lexeme| matches!(&lexeme.token, Token::Word(word) if word.starts_with("toward")));
            let rests = !towards
                && matches!(last, Clause::Sit { .. } | Clause::Go { .. } | Clause::StandUp | Clause::Stop);
            self.at += count;
            if rests {
                clauses.push(Clause::Wait { seconds });
            } else {
                let body = body_of(clauses.pop());
                clauses.push(Clause::Until { test: Test::Elapsed(seconds), body });
            }
        } else {
            return Ok(false);
        }
        Ok(true)
    }

    /// "For ten seconds".
    fn peek_for(&self) -> Option<(f64, usize)> {
        let words = longest_phrase(self.rest(), &["for", "for about", "during", "for at least"])?;
        let (seconds, count) = numbers::duration(&self.rest()[words..])?;
        (seconds > 0.0 && seconds <= super::orders::LONGEST_WAIT).then_some((seconds, words + count))
    }

    // ---- the cursor ----

    pub(super) fn rest(&self) -> &'a [Lexeme] {
        &self.lexemes[self.at..]
    }

    pub(super) fn peeks(&self, word: &str) -> bool {
        fits(self.rest(), word).is_some()
    }

    /// Passes the longest of these phrases, if one is there.
    pub(super) fn eat_any(&mut self, phrases: &[&str]) -> bool {
        let count = longest_phrase(self.rest(), phrases);
        self.at += count.unwrap_or(0);
        count.is_some()
    }

    pub(super) fn ends_clause(&self) -> bool {
        const TAILS: &[&str] =
            &["until", "till", "if", "unless", "when", "while", "before", "after", "as soon as", "for"];
        matches!(self.rest().first().map(|lexeme| &lexeme.token), None | Some(Token::Comma | Token::Break))
            || [JOINTS, FILLERS, TAILS].iter().any(|words| longest_phrase(self.rest(), words).is_some())
            || numbers::times(self.rest()).is_some()
    }

    /// Passes what joins orders, with the politeness around it; whether there was any.
    pub(super) fn skip_joints(&mut self) -> bool {
        let start = self.at;
        loop {
            self.skip_fillers();
            let mark =
                matches!(self.rest().first(), Some(l) if matches!(l.token, Token::Comma | Token::Break));
            if mark {
                self.at += 1;
            } else if !self.eat_any(JOINTS) {
                return self.at > start;
            }
        }
    }

    /// Passes politeness, unless the words begin an order.
    pub(super) fn skip_fillers(&mut self) {
        while let Some(count) = longest_phrase(self.rest(), FILLERS) {
            if longest_verb(self.rest()).is_some_and(|(_, words)| words >= count) {
                return;
            }
            self.at += count;
        }
    }

    /// The answer when the words from here on make no sense.
    pub(super) fn not_understood(&self, hint: &str) -> PlanError {
        let start = self.rest().first().map_or(self.words.len(), |lexeme| lexeme.start);
        PlanError::NotUnderstood {
            words: shortened(self.words),
            fragment: shortened(&self.words[start..]),
            hint: hint.to_owned(),
        }
    }
}

/// The last order, or all of the group if the last one is not a thing that one does twice in a row.
fn repeat(clauses: &mut Vec<Clause>, group: usize, times: u32, all: bool) {
    let last_alone = !all && clauses.last().is_some_and(Clause::is_repeatable);
    let from = if last_alone { clauses.len() - 1 } else { group.min(clauses.len()) };
    let body: Vec<Clause> = clauses.drain(from..).collect();
    match &body[..] {
        [Clause::Photo { of, times: 1 }] => clauses.push(Clause::Photo { of: of.clone(), times }),
        _ => clauses.push(Clause::Repeat { times, body }),
    }
}

/// What goes on until something happens: waiting needs no order, and a step forward is the first of many.
fn body_of(clause: Option<Clause>) -> Vec<Clause> {
    match clause {
        None | Some(Clause::Wait { .. } | Clause::Stop) => Vec::new(),
        Some(Clause::Step { direction: StepDirection::Forward, .. }) => vec![Clause::Forward],
        Some(clause) => vec![clause],
    }
}

/// A text cut to a length that fits into an answer.
pub(super) fn shortened(text: &str) -> String {
    const MOST: usize = 80;
    match text.char_indices().nth(MOST) {
        Some((end, _)) => format!("{}...", &text[..end]),
        None => text.to_owned(),
    }
}
