//! Noun phrases: what an order is about.

use simworld_core::scene::Relation;
use simworld_core::seam::PlanError;

use super::clause::{Choice, Reference, Target};
use super::lexer::{Lexeme, Token};
use super::lexicon::{
    COPULAS, DETERMINERS, FARTHEST, FILLERS, JOINTS, NEAREST, RELATIONS, category, longest, longest_phrase,
};
use super::names::Guess;
use super::parser::{Parser, shortened};

/// How many things may be described by one another: "the bench near the tree near ...".
const DEEPEST: u32 = 4;
/// Coordinates beyond this are outside every world, m.
const FARTHEST_POINT: f64 = 1.0e7;
/// Words that end a phrase whose words are not known.
const BOUNDARIES: &[&str] = &["to", "at", "in", "on", "for", "up", "down", "off", "into", "onto", "with"];

impl<'a> Parser<'a> {
    /// A thing or a place.
    pub(super) fn reference(&mut self, depth: u32) -> Result<Reference, PlanError> {
        self.eat_any(&["the point", "point", "the position", "position", "coordinates", "the coordinates"]);
        let (mut start, mut choice) = (self.at, Choice::Open);
        let target = if let Some(target) = self.simple_target()? {
            target
        } else {
            choice = self.choice();
            start = self.at; // answers leave the article out
            self.noun()?
        };
        let text = self.text_from(start);
        let relation = self.relation(depth)?;
        let text = if relation.is_some() { self.text_from(start) } else { text };
        Ok(Reference { target, choice, relation, text })
    }

    /// Pronouns, ids and coordinates.
    fn simple_target(&mut self) -> Result<Option<Target>, PlanError> {
        if self.eat_any(&["it", "them", "that one", "this one"]) {
            return Ok(Some(Target::It));
        }
        if self.eat_any(&["there"]) {
            return Ok(Some(Target::There));
        }
        if self.eat_any(&["here"]) {
            return Ok(Some(Target::Here));
        }
        match self.rest() {
            [Lexeme { token: Token::Id(id), .. }, ..] => {
                let id = *id;
                self.at += 1;
                Ok(Some(Target::Id(id)))
            }
            [Lexeme { token: Token::Open, .. }, ..] => self.point().map(Some),
            _ => Ok(None),
        }
    }

    fn point(&mut self) -> Result<Target, PlanError> {
        let start = self.at;
        self.at += 1;
        let mut numbers = Vec::new();
        while let Some(Lexeme { token: Token::Number(number), .. }) = self.rest().first() {
            numbers.push(*number);
            self.at += 1;
            if matches!(self.rest().first(), Some(Lexeme { token: Token::Comma, .. })) {
                self.at += 1;
            }
        }
        let closed = matches!(self.rest().first(), Some(Lexeme { token: Token::Close, .. }));
        let within = numbers.iter().all(|number| number.abs() <= FARTHEST_POINT);
        let (true, true, [x, y, height @ ..]) = (closed, within, &numbers[..]) else {
            self.at = start;
            return Err(self.not_understood("write a point as (x, y), metres east and north within ±1e7"));
        };
        if height.len() > 1 {
            self.at = start;
            return Err(self.not_understood("write a point with two or three numbers"));
        }
        self.at += 1;
        Ok(Target::Point { x: *x, y: *y, z: height.first().copied() })
    }

    fn choice(&mut self) -> Choice {
        let mut choice = Choice::Open;
        loop {
            if self.eat_any(NEAREST) {
                choice = Choice::Nearest;
            } else if self.eat_any(FARTHEST) {
                choice = Choice::Farthest;
            } else if !self.eat_any(DETERMINERS) && !self.eat_any(&["free", "empty", "available"]) {
                return choice;
            }
        }
    }

    /// A name or a class of things; of two that fit, the longer.
    fn noun(&mut self) -> Result<Target, PlanError> {
        let (named, class) = (self.names.exact(self.rest()), category(self.rest()));
        match (named, class) {
            (Some((ids, count)), class) if class.is_none_or(|(_, words)| count >= words) => {
                self.at += count;
                Ok(Target::Named(ids))
            }
            (_, Some((category, count))) => {
                self.at += count;
                Ok(Target::Any(category))
            }
            _ => self.misspelt(),
        }
    }

    fn misspelt(&mut self) -> Result<Target, PlanError> {
        let phrase = self.unknown_phrase();
        if phrase.is_empty() {
            return Err(self.not_understood("say what: a thing, a place, a name, #id or (x, y)"));
        }
        let guess = self.names.guess(phrase);
        let said = shortened(&self.words[phrase[0].start..phrase[phrase.len() - 1].end]);
        match guess {
            Guess::Named(ids) => {
                self.at += phrase.len();
                Ok(Target::Named(ids))
            }
            Guess::Category(category) => {
                self.at += phrase.len();
                Ok(Target::Any(category))
            }
            Guess::Ambiguous(labels) => {
                let near = format!("it could be {}: say which", labels.join(" or "));
                Err(PlanError::NotFound { wanted: said, near })
            }
            Guess::Nothing(similar) => {
                let near = self.view.surroundings();
                let near = match similar {
                    Some(similar) => format!("did you mean {similar:?}? {near}"),
                    None => near,
                };
                Err(PlanError::NotFound { wanted: said, near })
            }
        }
    }

    /// The words up to where something known goes on.
    fn unknown_phrase(&self) -> &'a [Lexeme] {
        let rest = self.rest();
        let ends = |at: &usize| {
            let here = &rest[*at..];
            !matches!(here[0].token, Token::Word(_) | Token::Number(_))
                || [JOINTS, FILLERS, BOUNDARIES, COPULAS]
                    .iter()
                    .any(|words| longest_phrase(here, words).is_some())
                || longest(here, RELATIONS).is_some()
        };
        let end = (0..rest.len()).find(ends).unwrap_or(rest.len());
        &rest[..end]
    }

    /// How the thing stands to another, if that is said.
    pub(super) fn relation(&mut self, depth: u32) -> Result<Option<(Relation, Box<Reference>)>, PlanError> {
        let start = self.at;
        self.eat_any(COPULAS);
        let Some((relation, count)) = longest(self.rest(), RELATIONS) else {
            self.at = start;
            return Ok(None);
        };
        if depth >= DEEPEST {
            return Err(self.not_understood("describe a thing by at most four others"));
        }
        self.at += count;
        Ok(Some((relation, Box::new(self.reference(depth + 1)?))))
    }

    pub(super) fn text_from(&self, start: usize) -> String {
        match self.lexemes.get(start..self.at) {
            Some([first, .., last]) => shortened(&self.words[first.start..last.end]),
            Some([only]) => shortened(&self.words[only.start..only.end]),
            _ => String::new(),
        }
    }
}
