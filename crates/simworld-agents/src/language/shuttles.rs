//! From one place to another, and back: "from the statue to the fountain", "back and forth between the benches".

use simworld_core::seam::PlanError;

use super::clause::{Clause, Pace, Reference, Target};
use super::lexer::{Lexeme, is_mark, word_of};
use super::numbers;
use super::parser::Parser;
use super::resolve::Purpose;
use super::verbs::longest_verb;

/// How far behind an order it is looked for which end comes first, in words.
const MOST_WORDS: usize = 6;

impl Parser<'_> {
    /// "From the statue to the fountain"; "around until ..." leads nowhere in particular.
    pub(super) fn between_places(&mut self, pace: Pace) -> Result<Option<Vec<Clause>>, PlanError> {
        let start = self.at;
        if self.eat_any(&["around", "about", "round"]) && self.goes_on() {
            return Ok(Some(vec![Clause::Forward]));
        }
        self.at = start;
        if !self.eat_any(&["from"]) {
            let vehicle = self.by_vehicle();
            let leads = vehicle.is_some() && self.eat_any(&["to", "over to", "back to", "towards"]);
            let Some(board) = vehicle.filter(|_| leads) else {
                self.at = start;
                return Ok(None);
            };
            let to = self.reference(0)?;
            return Ok(Some(vec![board, Clause::Go { to, side: None, pace, within: None }]));
        }
        let go = |to| Clause::Go { to, side: None, pace, within: None };
        let one = self.reference(0)?;
        if !self.eat_any(&["to", "over to", "towards", "on to"]) {
            return Err(self.not_understood("say from where to where"));
        }
        let other = self.reference(0)?;
        let begins_here = one.target == Target::Here;
        if self.eat_any(&["and back again", "and back"]) {
            return Ok(Some(vec![Clause::Repeat { times: 1, body: vec![go(one), go(other)] }]));
        }
        // "Keep walking from the pump to the board until it rains": there and back again and again.
        Ok(Some(match (begins_here, self.goes_on()) {
            (true, _) => vec![go(other)],
            (false, true) => vec![Clause::Repeat { times: 1, body: vec![go(one), go(other)] }],
            (false, false) => vec![go(one), go(other)],
        }))
    }

    /// "From the pump to the tyre three times, pump first": at which end one begins; whether that was said.
    pub(super) fn end_first(&mut self, clauses: &mut [Clause]) -> bool {
        let Some(Clause::Repeat { body, .. }) = clauses.last_mut() else { return false };
        let [Clause::Go { to: one, .. }, Clause::Go { to: other, .. }] = &body[..] else { return false };
        let start = self.at;
        let first = |lexeme: &Lexeme| word_of(lexeme) == "first";
        let said = self.rest().iter().take(MOST_WORDS).position(first).is_some();
        let marked = self.rest().first().is_some_and(is_mark);
        self.at += usize::from(marked);
        let found = |what: &Reference| self.view.find(what, Purpose::Any).ok().map(|found| found.id);
        let (one, other) = (found(one), found(other));
        if said
            && marked
            && longest_verb(self.rest()).is_none()
            && let Ok(end) = self.reference(0)
            && let Some(end) = self.view.find(&end, Purpose::Any).ok().map(|found| found.id)
            && (Some(end) == one || Some(end) == other)
            && self.eat_any(&["first"])
            && self.ends_clause()
        {
            if Some(end) == other {
                body.reverse();
            }
            return true;
        }
        self.at = start;
        false
    }

    pub(super) fn back_and_forth(&mut self, pace: Pace) -> Result<Vec<Clause>, PlanError> {
        let one = self.reference(0)?;
        let (one, other) =
            if self.eat_any(&["and", "to"]) { (one, self.reference(0)?) } else { Self::pair(&one) };
        let go = |to| Clause::Go { to, side: None, pace, within: None };
        let times = numbers::times(self.rest());
        self.at += times.map_or(0, |(_, count)| count);
        self.eat_any(&["and back", "and back again"]);
        let body = vec![go(one), go(other)];
        Ok(vec![Clause::Repeat { times: times.map_or(1, |(times, _)| times), body }])
    }
}
