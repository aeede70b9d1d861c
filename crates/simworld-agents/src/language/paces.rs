//! Words of speed.

use super::clause::{Clause, Pace};
use super::lexer::Token;
use super::numbers;
use super::parser::Parser;
use super::phrases::Phrases;
use simworld_core::seam::PlanError;

impl Parser<'_> {
    /// "..., otherwise at 10": the same at another pace, and nothing else.
    pub(super) fn at_another_pace(&mut self, orders: &[Clause]) -> Option<Vec<Clause>> {
        let start = self.at;
        let said = if self.peeks("at") && numbers::number(&self.rest()[1..]).is_some() {
            self.at += 1;
            self.speed().ok().map(Pace::At)
        } else {
            self.pace(Pace::Usual).ok().filter(|pace| *pace != Pace::Usual)
        };
        let mut again = orders.to_vec();
        let last = again.last_mut().and_then(Clause::pace);
        if let (Some(said), Some(last), true) = (said, last, self.ends_at_mark()) {
            *last = said;
            return Some(again);
        }
        self.at = start;
        None
    }

    /// Words of speed.
    pub(super) fn pace(&mut self, usual: Pace) -> Result<Pace, PlanError> {
        #[rustfmt::skip]
        const FAST: &Phrases = &Phrases::of(&[
            "quickly", "fast", "in a hurry", "as fast as you can", "as quickly as possible",
            "as fast as possible", "rapidly", "at a run", "at full speed", "at top speed",
            "as quick as you can", "as quickly as you can", "at a jog", "at speed", "swiftly", "speedily",
            "very fast", "very quickly", "really fast", "real fast", "at a trot", "in haste", "hurriedly",
            "double quick", "like hell", "like the wind", "like mad", "like crazy", "like lightning", "like a shot", "as if your life depended on it",
        ]);
        #[rustfmt::skip]
        const SLOW: &Phrases = &Phrases::of(&[
            "slowly", "at a slow pace", "leisurely", "calmly", "carefully", "at a leisurely pace",
            "at a stroll", "very slowly", "nice and slowly", "unhurriedly", "at your leisure", "slow",
            "without hurry", "without hurrying", "without haste", "at a gentle pace", "at an easy pace",
            "slowly and carefully", "in slow motion",
        ]);
        if self.eat_any(SLOW) {
            return Ok(Pace::Slow);
        }
        if self.eat_any(FAST) {
            return Ok(Pace::Run);
        }
        let start = self.at;
        if self.eat_any(&["at a speed of", "at a pace of", "with a speed of", "doing", "at about", "at"])
            && numbers::number(self.rest()).is_some_and(|(_, words)| {
                matches!(self.rest().get(words).map(|unit| &unit.token), Some(Token::Word(_)))
            })
        {
            let in_digits = matches!(self.rest()[0].token, Token::Number(_));
            match self.speed() {
                Ok(speed) if in_digits || self.said_unit() => return Ok(Pace::At(speed)),
                Err(error) if in_digits => return Err(error),
                _ => {}
            }
        }
        self.at = start;
        Ok(usual)
    }

    /// Whether a unit of speed was said last.
    pub(super) fn said_unit(&self) -> bool {
        let last = self.at.checked_sub(1).and_then(|at| self.lexemes.get(at));
        matches!(last.map(|lexeme| &lexeme.token), Some(Token::Word(word))
            if ["s", "h", "mps", "kmh", "kph", "second", "hour", "sec"].contains(&word.as_str()))
    }

    /// A speed, m/s.
    pub(super) fn speed(&mut self) -> Result<f64, PlanError> {
        let number_at = self.at;
        if let Some((number, count)) = numbers::number(self.rest()) {
            self.at += count;
            let hourly = self.eat_any(&[
                "km / h",
                "kmh",
                "kph",
                "kilometres per hour",
                "kilometers per hour",
                "kilometres an hour",
                "kilometers an hour",
                "km an hour",
                "km per hour",
                "k an hour",
                "ks an hour",
            ]);
            let _ = hourly
                || self.eat_any(&[
                    "m / s",
                    "mps",
                    "metres per second",
                    "meters per second",
                    "metres a second",
                    "meters a second",
                    "m a second",
                    "m per second",
                    "metre per second",
                    "metre a second",
                    "meter per second",
                    "m / sec",
                ]);
            let speed = if hourly { number / 3.6 } else { number };
            if (0.1..=50.0).contains(&speed) {
                return Ok(speed);
            }
            self.at = number_at;
        }
        Err(self.not_understood("give a speed from 0.1 to 50 m/s"))
    }
}
