//! Orders to look somewhere.

use std::f64::consts::{FRAC_PI_2, PI};

use simworld_core::seam::PlanError;

use super::clause::{Clause, Reference, Target};
use super::lexicon::longest;
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
}
