//! What stands between two others, and whose a part is: "between the two trees", "the door to the lab".

use simworld_core::scene::Relation;
use simworld_core::seam::PlanError;

use super::clause::{Choice, Count, Reference, Stands};
use super::lexer::Token;
use super::lexicon::longest_relation;
use super::parser::Parser;
use super::phrases::Phrases;
use super::reference::DEEPEST;

impl Parser<'_> {
    /// "To" says whose only of a door: "the door to the lab", but "bring the parcel to the lab".
    pub(super) fn of_follows(&self, start: usize) -> bool {
        let is_to =
            self.lexemes[start..self.at].iter().any(|lexeme| lexeme.token == Token::Word("to".to_owned()));
        let is_door = start > 0
            && matches!(&self.lexemes[start - 1].token, Token::Word(word) if ["door", "doorway", "entrance", "gate"].contains(&word.as_str()));
        !is_to || is_door
    }

    /// The two that a plural stands for: "between the two trees".
    pub(super) fn pair(both: &Reference) -> (Reference, Reference) {
        let nth = |nth| Reference { choice: Choice::Nth(nth), count: Count::One, ..both.clone() };
        (nth(1), nth(2))
    }

    /// "The tree that's got a chair next to it": the chair by which it stands.
    pub(super) fn has_beside(&mut self, depth: u32) -> Option<Stands> {
        const HAS: &Phrases = &Phrases::of(&[
            "that has",
            "thats got",
            "that is got",
            "that has got",
            "which has",
            "which has got",
            "with",
            "having",
            "who has",
            "got",
            "has",
            "has got",
        ]);
        let start = self.at;
        let found = (depth < DEEPEST && self.eat_any(HAS)).then(|| self.beside_it(depth)).flatten();
        if found.is_none() {
            self.at = start;
        }
        found
    }

    fn beside_it(&mut self, depth: u32) -> Option<Stands> {
        let start = self.at;
        let it = (start..self.lexemes.len().min(start + 8)).find(|at| {
            matches!(&self.lexemes[*at].token, Token::Word(word) if ["it", "him", "her"].contains(&word.as_str()))
        })?;
        let (relation, from) = (start + 1..it).find_map(|at| {
            longest_relation(&self.lexemes[at..])
                .filter(|(_, words)| at + words == it)
                .map(|(how, _)| (how, at))
        })?;
        let whole = self.lexemes;
        self.lexemes = &whole[..from];
        let anchor = self.reference(depth + 1).ok().filter(|_| self.at == from);
        self.lexemes = whole;
        let next = matches!(relation, Relation::NextTo | Relation::Near);
        let anchor = anchor.filter(|_| next)?;
        self.at = it + 1;
        Some(Stands::To(relation, Box::new(anchor)))
    }

    /// "Between the green and the red one": the noun stands behind the second alone.
    fn two_paints(&mut self, depth: u32) -> Option<Stands> {
        let start = self.at;
        self.eat_any(&["the", "a"]);
        if let Some((paint, words)) = self.peek_paint() {
            self.at += words;
            if self.eat_any(&["and"])
                && let Ok(other) = self.reference(depth + 1)
                && other.traits.paint.is_some()
            {
                let mut one = other.clone();
                one.traits.paint = Some(paint);
                return Some(Stands::Between(Box::new(one), Box::new(other)));
            }
        }
        self.at = start;
        None
    }

    /// "Between the hospital and the museum", "between the two trees".
    pub(super) fn between(&mut self, depth: u32) -> Result<Stands, PlanError> {
        if let Some(both) = self.two_paints(depth) {
            return Ok(both);
        }
        let one = self.reference(depth + 1)?;
        let start = self.at;
        if self.eat_any(&["and"]) {
            match self.reference(depth + 1) {
                Ok(other) => return Ok(Stands::Between(Box::new(one), Box::new(other))),
                // "Between the two trees and sit down".
                Err(_) if one.count == Count::Exactly(2) => self.at = start,
                Err(error) => return Err(error),
            }
        }
        let (one, other) = Self::pair(&one);
        Ok(Stands::Between(Box::new(one), Box::new(other)))
    }
}
