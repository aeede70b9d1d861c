//! Orders with words in them: what is said, and what is bought.

use simworld_core::id::EntityId;
use simworld_core::seam::PlanError;

use super::clause::{Clause, Count, Reference, Target};
use super::lexer::{Lexeme, Token};
use super::lexicon::longest_phrase;
use super::numbers;
use super::parser::{Parser, shortened};
use super::verbs::Verb;

/// Who sells what is said before: "the coffee shop".
const SELLERS: &[&str] = &["shop", "store", "stand", "stall", "kiosk", "seller", "vendor"];
/// What one says where no words are given.
const HELLO: &str = "hello";
/// The most that is said at once, in characters.
const LONGEST_SPEECH: usize = 500;

impl Parser<'_> {
    pub(super) fn speak(&mut self, verb: Verb) -> Result<Vec<Clause>, PlanError> {
        let clause = match verb {
            Verb::Argue => {
                self.eat_any(&["with"]);
                let with = self.reference(0)?;
                if self.eat_any(&["about", "over"]) {
                    self.speech(self.lexemes.len())?; // gestures have no words
                }
                Clause::Argue { with }
            }
            Verb::Say => self.say()?,
            Verb::Tell => {
                let to = self.reference(0)?;
                self.eat_any(&["that", "about", "to"]);
                let words = self.speech(self.lexemes.len())?;
                Clause::Say { to, words }
            }
            _ => {
                self.eat_any(&["to", "with"]);
                let to = self.reference(0)?;
                let words = if self.eat_any(&["about", "of"]) {
                    self.speech(self.lexemes.len())?
                } else {
                    HELLO.to_owned()
                };
                Clause::Say { to, words }
            }
        };
        Ok(vec![clause])
    }

    /// "Say good morning to Anna".
    fn say(&mut self) -> Result<Clause, PlanError> {
        let is_break = |lexeme: &Lexeme| lexeme.token == Token::Break;
        let end = self.rest().iter().position(is_break).map_or(self.lexemes.len(), |count| self.at + count);
        let is_to = |at: &usize| self.lexemes[*at].token == Token::Word("to".to_owned());
        let Some(to_at) = (self.at..end).rev().find(is_to) else {
            return Err(self.not_understood("say to whom, as in \"say hello to Anna\""));
        };
        let words = self.speech(to_at)?;
        self.at = to_at + 1;
        let words = if words.eq_ignore_ascii_case("hi") { HELLO.to_owned() } else { words };
        Ok(Clause::Say { to: self.reference(0)?, words })
    }

    /// The words as they were written, up to a token or the end of the sentence.
    fn speech(&mut self, end: usize) -> Result<String, PlanError> {
        let said = &self.lexemes[self.at..end];
        let ends = |at: &usize| match said[*at].token {
            Token::Break => true,
            // "..., then wait" is an order again.
            Token::Comma => {
                longest_phrase(&said[at + 1..], &["then", "and then", "after that", "and"]).is_some()
            }
            _ => false,
        };
        let count = (0..said.len()).find(ends).unwrap_or(said.len());
        let (Some(first), Some(last)) = (said.first().filter(|_| count > 0), said[..count].last()) else {
            return Err(self.not_understood("say what to say"));
        };
        let words = &self.words[first.start..last.end];
        if words.chars().count() > LONGEST_SPEECH {
            return Err(self.not_understood("say it in at most 500 characters"));
        }
        self.at += count;
        Ok(words.to_owned())
    }

    /// "Buy a coffee at the corner shop": goods are what a place nearby sells.
    pub(super) fn buy(&mut self) -> Result<Vec<Clause>, PlanError> {
        const VESSELS: &[&str] = &[
            "bottle of",
            "bottles of",
            "cup of",
            "cups of",
            "piece of",
            "pieces of",
            "loaf of",
            "bowl of",
            "bowls of",
            "can of",
            "cans of",
            "slice of",
            "slices of",
            "glass of",
            "portion of",
            "bag of",
            "copy of",
        ];
        self.eat_any(&["me", "yourself", "us", "him", "her"]);
        let mut times = 1;
        if let Some((Count::Exactly(count), words)) = self.peek_count() {
            times = count;
            self.at += words;
        }
        while self.eat_any(&["a", "an", "the", "some", "one", "any"]) {}
        self.eat_any(VESSELS);
        let Some((goods, count)) = self.names.goods(self.rest()) else {
            let rest = self.rest();
            let ends = ["at", "from", "in", "and", "then", "to", "for"];
            let end = (0..rest.len())
                .find(|at| {
                    !matches!(rest[*at].token, Token::Word(_))
                        || longest_phrase(&rest[*at..], &ends).is_some()
                })
                .unwrap_or(rest.len());
            let Some((first, last)) = rest[..end].first().zip(rest[..end].last()) else {
                return Err(self.not_understood("say what to buy"));
            };
            let wanted = format!("{} to buy", shortened(&self.words[first.start..last.end]));
            return Err(PlanError::NotFound { wanted, near: self.names.sold() });
        };
        self.at += count;
        let at = self.tail_place(&["at", "from", "in", "inside"])?;
        let after = numbers::times(self.rest());
        self.at += after.map_or(0, |(_, count)| count);
        let times = after.map_or(times, |(more, _)| more * times);
        Ok(vec![Clause::Buy { goods, times, at }])
    }

    /// "The coffee shop" is any that sells coffee, unless one is called so.
    pub(super) fn sellers(&mut self) -> Option<Vec<EntityId>> {
        let rest = self.rest();
        (1..4).find(|at| rest.get(*at..).is_some_and(|rest| longest_phrase(rest, SELLERS).is_some()))?;
        let (goods, count) = self.names.goods(rest)?;
        let words = count + longest_phrase(&rest[count..], SELLERS)?;
        if self.names.exact(rest).is_some_and(|(_, named)| named >= words) {
            return None;
        }
        self.at += words;
        Some(self.names.sellers(&goods))
    }

    /// Him, her or them: whoever was spoken of last.
    pub(super) fn somebody(&mut self) -> Option<Reference> {
        let start = self.at;
        self.eat_any(&["him", "her", "them", "he", "she", "they"])
            .then(|| Reference::to(Target::Them, self.text_from(start)))
    }
}
