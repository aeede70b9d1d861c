//! What follows an order and says how often, how long, when and on what condition.

use simworld_core::action::StepDirection;
use simworld_core::seam::PlanError;

use super::clause::{Clause, Pace, Test};
use super::lexer::{Lexeme, Token};
use super::lexicon::{longest, longest_phrase};
use super::numbers;
use super::parser::{IF, Parser};
use super::politeness::MANNERS;
use super::requests;

/// Before where one goes in the end.
pub(super) const ON_THE_WAY: &[&str] = &[
    "on the way to",
    "on your way to",
    "on the way over to",
    "on your way over to",
    "en route to",
    "along the way to",
];

/// Doing what was said last, before how often.
const DO_SO: &[&str] = &[
    "do it",
    "and do it",
    "do that",
    "and do that",
    "do this",
    "and do this",
    "and do so",
    "repeat it",
    "and repeat it",
    "repeat that",
    "and repeat that",
];

impl Parser<'_> {
    /// What follows an order and says how often, how long or when; `whole` is where the sentence begins, and `group` what
    /// "and" joins.
    pub(super) fn tails(
        &mut self,
        clauses: &mut Vec<Clause>,
        whole: usize,
        group: usize,
    ) -> Result<(), PlanError> {
        loop {
            let start = self.at;
            if self.peeks("first") && matches!(self.rest().get(1), Some(Lexeme { token: Token::Comma, .. })) {
                self.at += 1; // "go there first, but before that ..."
            }
            self.eat_any(&["again and again", "over and over", "over and over again", "repeatedly"]);
            self.skip_fillers();
            self.at += requests::coda(self.rest());
            let comma = matches!(self.rest(), [Lexeme { token: Token::Comma, .. }, ..]);
            let goes_on = comma && {
                const AFTER_COMMA: &[&str] = &[
                    "until",
                    "till",
                    "unless",
                    "but first",
                    "but before that",
                    "but only if",
                    "only if",
                    "if and only if",
                    "but not if",
                    "but not before",
                ];
                longest_phrase(&self.rest()[1..], AFTER_COMMA).is_some()
            };
            let again =
                usize::from(comma) + longest_phrase(&self.rest()[usize::from(comma)..], DO_SO).unwrap_or(0);
            if again > usize::from(comma)
                && let Some((times, count)) = numbers::times(&self.rest()[again..])
            {
                self.at += again + count;
                repeat(clauses, group, times, false);
            } else if comma && self.but_first(clauses)? {
            } else if let Some((times, count)) = numbers::times(&self.rest()[usize::from(comma)..]) {
                self.at += usize::from(comma) + count;
                repeat(clauses, if comma { whole } else { group }, times, comma);
            } else if comma && !goes_on || !self.tail(clauses, comma)? {
                self.at = start;
                return Ok(());
            }
        }
    }

    /// ", one after the other": how, where it makes no difference.
    pub(super) fn skip_manner(&mut self) {
        let comma = usize::from(matches!(self.rest(), [Lexeme { token: Token::Comma, .. }, ..]));
        if let Some(count) = longest_phrase(&self.rest()[comma..], MANNERS) {
            self.at += comma + count;
        }
    }

    /// "..., but stop at the shop first".
    fn but_first(&mut self, clauses: &mut Vec<Clause>) -> Result<bool, PlanError> {
        let start = self.at;
        self.at += 1;
        let is_mark = |lexeme: &Lexeme| matches!(lexeme.token, Token::Comma | Token::Break);
        let end = self.at + self.rest().iter().position(is_mark).unwrap_or(self.rest().len());
        let is_first = |lexeme: &Lexeme| matches!(&lexeme.token, Token::Word(word) if word == "first");
        let said = self.eat_any(&["but"]) && self.lexemes[self.at..end].last().is_some_and(is_first);
        if !said || clauses.is_empty() {
            self.at = start;
            return Ok(false);
        }
        let earlier = self.order()?;
        if !self.eat_any(&["first"]) {
            self.at = start;
            return Ok(false);
        }
        let at = clauses.len() - 1;
        clauses.splice(at..at, earlier);
        Ok(true)
    }

    fn tail(&mut self, clauses: &mut Vec<Clause>, comma: bool) -> Result<bool, PlanError> {
        self.at += usize::from(comma);
        let Some(last) = clauses.last() else { return Ok(false) };
        if let Some((seconds, count)) = self.peek_interval() {
            self.at += count;
            let last = clauses.pop().into_iter().collect();
            clauses.push(over_and_over(last, seconds));
        } else if self.eat_any(&["until", "till", "up until"]) {
            let test = self.test()?;
            if let Some(Clause::Until { test: Test::Never, body }) = clauses.last() {
                let body = body.clone();
                clauses.pop();
                clauses.push(Clause::Until { test, body });
                return Ok(true);
            }
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
        } else if self.eat_any(IF) {
            let test = self.test()?;
            let then = clauses.pop().into_iter().collect();
            clauses.push(Clause::If { test, then, otherwise: Vec::new() });
        } else if self.eat_any(&["unless", "but not if"]) {
            let test = Test::Not(Box::new(self.test()?));
            let then = clauses.pop().into_iter().collect();
            clauses.push(Clause::If { test, then, otherwise: Vec::new() });
        } else if self.eat_any(&["when", "once", "as soon as"]) {
            let test = self.test()?;
            clauses.insert(clauses.len() - 1, Clause::Until { test, body: Vec::new() });
        } else if self.eat_any(ON_THE_WAY) {
            let to = self.reference(0)?;
            clauses.push(Clause::Go { to, side: None, pace: Pace::Usual, within: None });
        } else if self.eat_any(&["before"]) {
            clauses.extend(self.order()?);
        } else if self.eat_any(&[
            "after",
            "but first",
            "but before that",
            "but first of all",
            "but beforehand",
        ]) {
            self.eat_any(&["youve", "you have", "you had", "having", "you are done", "youre done"]);
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
            if let Some(Clause::Until { test: test @ Test::Never, .. }) = clauses.last_mut() {
                *test = Test::Elapsed(seconds);
            } else if rests && clauses.last_mut().is_some_and(|last| last.plural().is_some()) {
                let body = clauses.pop().map(Box::new);
                clauses.extend(body.map(|body| Clause::Stay { body, seconds }));
            } else if rests {
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
        (seconds > 0.0 && seconds <= super::staying::LONGEST_WAIT).then_some((seconds, words + count))
    }

    /// "Every five seconds", "once a minute".
    pub(super) fn peek_interval(&self) -> Option<(f64, usize)> {
        const UNITS: &[(&[&str], f64)] =
            &[(&["second"], 1.0), (&["minute"], 60.0), (&["hour"], 3600.0), (&["half minute"], 30.0)];
        const EVERY: &[&str] =
            &["every", "once every", "each", "once each", "at intervals of", "once a", "once an", "once per"];
        let words = longest_phrase(self.rest(), EVERY)?;
        let after = &self.rest()[words..];
        let (seconds, count) = match longest(after, UNITS) {
            Some(unit) => unit,
            // "Every bit" is no time, and a bare number is no interval.
            None => numbers::duration(after).filter(|(_, count)| *count > 1)?,
        };
        (seconds > 0.0 && seconds <= super::staying::LONGEST_WAIT).then_some((seconds, words + count))
    }
}

/// The last order, or all of the group if the last one is not a thing that one does twice in a row.
fn repeat(clauses: &mut Vec<Clause>, group: usize, times: u32, all: bool) {
    let last_alone = !all && clauses.last().is_some_and(Clause::is_repeatable);
    let from = if last_alone { clauses.len() - 1 } else { group.min(clauses.len()) };
    let body: Vec<Clause> = clauses.drain(from..).collect();
    match &body[..] {
        [Clause::Until { test: Test::Never, body }] => {
            clauses.push(Clause::Repeat { times, body: body.clone() });
        }
        _ if times == 1 => clauses.extend(body),
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

/// The same again and again, with so many seconds after each.
pub(super) fn over_and_over(mut body: Vec<Clause>, seconds: f64) -> Clause {
    // What was to be done for a while or until something holds is done so at these intervals.
    if let [Clause::Until { test, body: inner }] = &mut body[..] {
        inner.push(Clause::Wait { seconds });
        return Clause::Until { test: test.clone(), body: std::mem::take(inner) };
    }
    body.push(Clause::Wait { seconds });
    Clause::Until { test: Test::Never, body }
}
