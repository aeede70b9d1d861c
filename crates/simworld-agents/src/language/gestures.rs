//! Waves that are given: "give Ben a wave", "give three waves to Anna".

use simworld_core::seam::PlanError;

use super::clause::{Clause, Reference};
use super::numbers;
use super::parser::Parser;

impl Parser<'_> {
    /// "Give a wave to Ben", "give three waves to Anna".
    pub(super) fn gesture_to(&mut self) -> Result<Option<Vec<Clause>>, PlanError> {
        let start = self.at;
        let number = numbers::number(self.rest()).filter(|(number, _)| (1.0..=100.0).contains(number));
        self.at += number.map_or(0, |(_, count)| count);
        self.eat_any(&["big", "little", "friendly", "quick", "nice", "small"]);
        let waves = number.is_some()
            && self.eat_any(&["wave", "waves", "wave of your hand"])
            && self.eat_any(&["to", "at", "for", "over to", "towards"]);
        let Some((number, _)) = number.filter(|_| waves) else {
            self.at = start;
            return Ok(None);
        };
        let wave = Clause::Wave { to: self.reference(0)? };
        let times = number as u32;
        Ok(Some(vec![if times == 1 { wave } else { Clause::Repeat { times, body: vec![wave] } }]))
    }

    /// "Give Ben a wave".
    pub(super) fn gesture(&mut self, to: &Reference) -> Option<Vec<Clause>> {
        let start = self.at;
        let number = numbers::number(self.rest()).filter(|(number, _)| (1.0..=100.0).contains(number));
        self.at += number.map_or(0, |(_, count)| count);
        self.eat_any(&["big", "little", "friendly", "quick", "nice", "small"]);
        if number.is_none() || !self.eat_any(&["wave", "waves", "wave of your hand"]) {
            self.at = start;
            return None;
        }
        self.eat_any(&["from me", "from us", "for me"]);
        let wave = Clause::Wave { to: to.clone() };
        let times = number.map_or(1, |(number, _)| number as u32);
        Some(vec![if times == 1 { wave } else { Clause::Repeat { times, body: vec![wave] } }])
    }
}
