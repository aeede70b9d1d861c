//! Pronouns, ids and coordinates: what stands for a thing or a place without naming it.

use simworld_core::seam::PlanError;

use super::clause::Target;
use super::lexer::{Lexeme, Token};
use super::parser::Parser;

/// Coordinates beyond this are outside every world, m.
const FARTHEST_POINT: f64 = 1.0e7;

impl Parser<'_> {
    /// Pronouns, ids and coordinates.
    pub(super) fn simple_target(&mut self) -> Result<Option<Target>, PlanError> {
        if self.eat_any(&["it", "that one", "this one", "this thing", "that thing"]) {
            return Ok(Some(Target::It));
        }
        if self.eat_any(&["there", "that place"]) {
            return Ok(Some(Target::There));
        }
        if self.eat_any(&[
            "here",
            "where you started",
            "where you were",
            "where you are",
            "where you started from",
            "your starting point",
            "the start",
            "where you came from",
            "where you began",
            "where you are standing",
            "where you stand",
            "where you are now",
            "your start",
            "your old place",
            "the place where you started",
            "the spot where you started",
            "where we started",
            "where you set out",
            "where you set off",
            "the place you started from",
            "the starting point",
            "the point where you started",
        ]) {
            return Ok(Some(Target::Here));
        }
        if let Some(speaker) = self.view.speaker
            && self.eat_any(&["me", "us", "myself", "where i am", "where i stand"])
        {
            return Ok(Some(Target::Id(speaker)));
        }
        match self.rest() {
            [Lexeme { token: Token::Id(id), .. }, ..] => {
                let id = *id;
                self.at += 1;
                Ok(Some(Target::Id(id)))
            }
            [Lexeme { token: Token::Open, .. }, ..] => self.point().map(Some),
            // "Go to 10, 20": two numbers without a unit.
            [
                Lexeme { token: Token::Number(x), .. },
                Lexeme { token: Token::Comma, .. },
                Lexeme { token: Token::Number(y), .. },
                after @ ..,
            ] if !matches!(after.first(), Some(Lexeme { token: Token::Word(_), .. }))
                || super::politeness::joint(after).is_some() =>
            {
                let (x, y) = (*x, *y);
                self.at += 3;
                Ok(Some(Target::Point { x, y, z: None }))
            }
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
}
