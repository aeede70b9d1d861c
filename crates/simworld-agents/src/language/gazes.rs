//! Orders to look somewhere, and to see how somebody is.

use std::f64::consts::{FRAC_PI_2, PI};

use simworld_core::seam::PlanError;

use super::clause::{Clause, Reference, Target};
use super::lexer::Token;
use super::lexicon::{longest, longest_phrase};
use super::motion::{GLANCE, SENSES};
use super::numbers;
use super::parser::Parser;

impl Parser<'_> {
    /// "Look up", "look behind you", "look at the statue".
    pub(super) fn look(&mut self) -> Result<Clause, PlanError> {
        for (way, sign) in [("up", 1.0), ("down", -1.0)] {
            if self.peeks(way) {
                self.at += 1;
                self.eat_any(&["by"]);
                let angle = numbers::angle(self.rest());
                self.at += angle.map_or(0, |(_, count)| count);
                let angle = angle.map_or(GLANCE, |(angle, _)| angle);
                if !(angle > 0.0 && angle <= FRAC_PI_2) {
                    return Err(self.not_understood("look up or down by more than 0 and at most 90 degrees"));
                }
                return Ok(Clause::LookUp { angle: sign * angle });
            }
        }
        if self.eat_any(&["behind you", "behind yourself", "over your shoulder", "back over your shoulder"]) {
            return Ok(Clause::Turn { angle: PI });
        }
        if let Some(speaker) =
            self.view.speaker.filter(|_| self.eat_any(&["here", "over here", "up here", "this way"]))
        {
            return Ok(Clause::Face { what: Reference::to(Target::Id(speaker), "here".to_owned()) });
        }
        if longest(self.rest(), SENSES).is_some() {
            return self.turn();
        }
        if let Some(compass) = self.compass() {
            return Ok(Clause::FaceCompass(compass));
        }
        self.eat_any(&["over", "at", "to", "towards", "over at", "over to", "back at"]);
        Ok(Clause::Face { what: self.reference(0)? })
    }

    /// "Go and see what he wants", "go see how Fay is doing": one has to be there for that.
    pub(super) fn what_somebody_is_up_to(&mut self, start: usize) -> Option<Reference> {
        let sees = self.lexemes[start..self.at].iter().any(|lexeme| {
            matches!(&lexeme.token, Token::Word(word) if ["see", "check", "find", "out"].contains(&word.as_str()))
        });
        let here = self.at;
        if sees && self.eat_any(&["what", "how", "whether", "if", "where", "why"]) {
            let pronoun = longest_phrase(self.rest(), &["he", "she", "they"]).is_some();
            if let Some(who) = if pronoun { self.somebody() } else { self.somebody_here() }
                && !self.ends_at_mark()
            {
                self.at = self.mark_from(self.at);
                return Some(who);
            }
        }
        self.at = here;
        None
    }
}
