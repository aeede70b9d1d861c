//! What follows an order and says how long it lasts, with which pauses, and how fast.

use super::clause::{Clause, Pace, Test};
use super::lexer::Token;
use super::lexicon::{longest, longest_phrase};
use super::numbers;
use super::parser::Parser;
use super::phrases::Phrases;
use super::repeats::body_of;
use simworld_core::seam::PlanError;

impl Parser<'_> {
    /// "For ten seconds".
    pub(super) fn for_a_while(&mut self, clauses: &mut Vec<Clause>) -> bool {
        let Some((seconds, count)) = self.peek_for() else { return false };
        // "Towards the museum for ten seconds" is on the way; "to the museum for ten seconds" is there.
        let earlier = &self.lexemes[self.at.saturating_sub(6)..self.at];
        let towards = earlier
            .iter()
            .any(|lexeme| matches!(&lexeme.token, Token::Word(word) if word.starts_with("toward")));
        let rests = !towards
            && matches!(
                clauses.last(),
                Some(
                    Clause::Sit { .. }
                        | Clause::Go { .. }
                        | Clause::StandUp
                        | Clause::Crouch
                        | Clause::Stop
                        | Clause::Park { .. }
                )
            );
        // "Look south for a second": a look, as long as one takes.
        let a_look = longest_phrase(self.rest(), &["for a second", "for a sec", "for a moment"]).is_some()
            && matches!(clauses.last(), Some(Clause::FaceCompass(_)));
        self.at += count;
        if a_look {
        } else if let Some(Clause::Until { test: test @ Test::Never, .. }) = clauses.last_mut() {
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
        true
    }

    /// "..., with five seconds after each shot".
    pub(super) fn with_pauses(&mut self, clauses: &mut Vec<Clause>) -> bool {
        let start = self.at;
        let pause = if self.eat_any(&[
            "with",
            "and wait",
            "waiting",
            "pausing",
            "and pause",
            "and leave",
            "leaving",
            "with a pause of",
            "with a break of",
            "at intervals of",
        ]) {
            self.eat_any(&["a pause of", "a break of", "for"]);
            numbers::duration(self.rest())
        } else {
            None
        };
        if let Some((seconds, count)) = pause {
            self.at += count;
            self.eat_any(&["pause", "break", "rest"]);
            let each = self.eat_any(&[
                "after each",
                "after every",
                "between each",
                "in between",
                "between them",
                "each time",
                "after each one",
                "between",
                "every time",
                "between two",
                "between the",
            ]);
            self.eat_any(&[
                "shot", "photo", "picture", "time", "one", "wave", "turn", "round", "lap", "shots", "photos",
                "pictures", "waves", "go", "of them",
            ]);
            if each && let Some(paused) = clauses.pop() {
                clauses.extend(pausing(paused, seconds));
                return true;
            }
        }
        self.at = start;
        false
    }

    /// "..., at twelve metres a second", "..., run!".
    pub(super) fn at_a_pace(&mut self, clauses: &mut [Clause]) -> Result<bool, PlanError> {
        let start = self.at;
        let Some(Clause::Go { pace, .. } | Clause::Drive { pace, .. } | Clause::Follow { pace, .. }) =
            clauses.last_mut()
        else {
            return Ok(false);
        };
        if *pace != Pace::Usual {
            return Ok(false);
        }
        if self.rest().len() > 1
            && longest_phrase(&self.rest()[1..], &["slowly", "quickly", "fast", "at", "run"]).is_some()
        {
            self.eat_any(&["but", "and"]);
        }
        let run = self.eat_any(&[
            "run",
            "running",
            "sprint",
            "at the double",
            "on the double",
            "at full speed",
            "full speed",
            "as fast as your legs can carry you",
        ]);
        let found = if run { Pace::Run } else { self.pace(Pace::Usual)? };
        if found == Pace::Usual || !self.ends_clause() {
            self.at = start;
            return Ok(false);
        }
        *pace = found;
        Ok(true)
    }

    /// "For ten seconds".
    pub(super) fn peek_for(&self) -> Option<(f64, usize)> {
        let words = longest_phrase(self.rest(), &["for", "for about", "during", "for at least"])?;
        let (seconds, count) = numbers::duration(&self.rest()[words..])?;
        (seconds > 0.0 && seconds <= super::staying::LONGEST_WAIT).then_some((seconds, words + count))
    }

    /// "Every five seconds", "once a minute".
    pub(super) fn peek_interval(&self) -> Option<(f64, usize)> {
        const UNITS: &[(&[&str], f64)] =
            &[(&["second"], 1.0), (&["minute"], 60.0), (&["hour"], 3600.0), (&["half minute"], 30.0)];
        const EVERY: &Phrases = &Phrases::of(&[
            "every",
            "once every",
            "each",
            "once each",
            "at intervals of",
            "once a",
            "once an",
            "once per",
        ]);
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

/// What was to be done several times, with a pause after each.
fn pausing(clause: Clause, seconds: f64) -> Vec<Clause> {
    match clause {
        Clause::Photo { of, times } => {
            let face = of.map(|what| Clause::Face { what });
            let body = vec![Clause::Photo { of: None, times: 1 }, Clause::Wait { seconds }];
            face.into_iter().chain([Clause::Repeat { times, body }]).collect()
        }
        Clause::Repeat { times, mut body } => {
            body.push(Clause::Wait { seconds });
            vec![Clause::Repeat { times, body }]
        }
        Clause::Until { test, mut body } => {
            body.push(Clause::Wait { seconds });
            vec![Clause::Until { test, body }]
        }
        other => vec![other, Clause::Wait { seconds }],
    }
}
