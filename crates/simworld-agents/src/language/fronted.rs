//! Places and spans of time before what is done there or so long.

use super::clause::{Clause, Pace, Reference, Target};
use super::lexer::{Lexeme, Token};
use super::lexicon::longest_phrase;
use super::numbers;
use super::parser::Parser;
use super::phrases::Phrases;
use super::verbs::longest_verb;

impl Parser<'_> {
    /// "For ten seconds", "for the next minute", before what is done so long.
    pub(super) fn peek_span(&self) -> Option<(f64, usize)> {
        let words = longest_phrase(
            self.rest(),
            &[
                "for",
                "for the next",
                "over the next",
                "during the next",
                "for the space of",
                "for a period of",
            ],
        )?;
        let (seconds, count) =
            numbers::duration(&self.rest()[words..]).filter(|(seconds, _)| *seconds > 0.0).or_else(|| {
                // "For the next minute".
                let one = [
                    Lexeme { token: Token::Word("one".to_owned()), lemma: None, start: 0, end: 0 },
                    self.rest().get(words)?.clone(),
                ];
                numbers::duration(&one).map(|(seconds, count)| (seconds, count - 1))
            })?;
        (seconds <= super::staying::LONGEST_WAIT).then_some((seconds, words + count))
    }

    /// "After the school": a place where one was before.
    pub(super) fn visited(&mut self) -> Option<Vec<Clause>> {
        let start = self.at;
        let names_place = longest_verb(self.rest()).is_none();
        let to = if names_place { self.reference(0).ok() } else { None };
        let is_place = to
            .as_ref()
            .is_some_and(|to| !matches!(to.target, Target::It | Target::Them | Target::Here | Target::There));
        let Some(to) = to.filter(|_| is_place) else {
            self.at = start;
            return None;
        };
        self.skip_joints();
        let mut clauses = vec![Clause::Go { to, side: None, pace: Pace::Usual, within: None }];
        if let Ok(more) = self.statement() {
            clauses.extend(more);
            Some(clauses)
        } else {
            self.at = start;
            None
        }
    }

    /// "At the statue, turn left", "on the red bench: ...": where one goes for what follows.
    pub(super) fn fronted_place(&mut self) -> Option<Vec<Clause>> {
        #[rustfmt::skip]
        const PLACED: &Phrases = &Phrases::of(&[
            "at", "on", "in", "by", "near", "next to", "beside", "inside", "outside", "in front of", "over at",
            "down at", "up at", "over by", "from", "under", "opposite", "close to", "behind", "over to",
            "off to", "to", "up to", "down to", "across to", "back to", "away to", "into", "back at", "via", "by way of",
        ]);
        let start = self.at;
        if !self.eat_any(PLACED) {
            return None;
        }
        let to: Option<Reference> = self.reference(0).ok();
        let marked = to.is_some() && (self.ends_at_mark() || longest_verb(self.rest()).is_some());
        if marked {
            let mark = self.at;
            let heads = matches!(self.rest().first(), Some(Lexeme { token: Token::Break, .. }));
            self.skip_joints();
            if self.at < self.lexemes.len()
                && let Ok(more) = self.statement()
            {
                if heads {
                    self.at = mark; // what follows a colon is a list of its own
                    return to.map(|to| vec![Clause::Go { to, side: None, pace: Pace::Usual, within: None }]);
                }
                let mut clauses: Vec<Clause> = to
                    .into_iter()
                    .map(|to| Clause::Go { to, side: None, pace: Pace::Usual, within: None })
                    .collect();
                clauses.extend(more);
                return Some(clauses);
            }
        }
        self.at = start;
        None
    }

    /// "The oak gives shade, stand there": where that is, if one thing was spoken of.
    pub(super) fn stands_there(&mut self, said: &[Clause]) -> Option<Clause> {
        let start = self.at;
        let spoken_of = matches!(said, [Clause::Mention { .. }]);
        if spoken_of
            && self.eat_any(&["stand there", "go stand there", "go and stand there"])
            && self.ends_clause()
        {
            let to = Reference::to(Target::There, "there".to_owned());
            return Some(Clause::Go { to, side: None, pace: Pace::Usual, within: None });
        }
        self.at = start;
        None
    }

    pub(super) fn word_before(&self) -> &str {
        self.word_before_at(self.at)
    }

    pub(super) fn word_before_at(&self, at: usize) -> &str {
        match at.checked_sub(1).map(|at| &self.lexemes[at].token) {
            Some(Token::Word(word)) => word,
            _ => "",
        }
    }
}
