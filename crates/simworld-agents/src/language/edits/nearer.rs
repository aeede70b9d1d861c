//! Steps towards a thing and away from it: "two metres closer to the fountain", "halfway to the statue".

use simworld_core::geometry::{Point2, Vector2};
use simworld_core::id::EntityId;
use simworld_core::seam::PlanError;

use super::super::lexicon::longest_phrase;
use super::super::numbers;
use super::super::phrases::Phrases;
use super::parse::Reader;
use super::resolve::Finder;
use super::wish::Where;
use crate::editing::{Edit, EditError, Stand};

/// Behind a distance, that it leads to what follows.
#[rustfmt::skip]
const TOWARDS: &Phrases = &Phrases::of(&["closer to", "nearer to", "nearer", "closer", "towards", "toward", "in the direction of", "in direction of", "in the direction to", "over towards", "up towards", "on towards",
    "further towards", "farther towards", "further toward", "more towards"]);
/// That it leads away from it.
#[rustfmt::skip]
const AWAY: &Phrases = &Phrases::of(&["further away from", "farther away from", "further from", "farther from", "back from", "more away from", "further off from", "further off", "farther off"]);
/// Half of the way.
#[rustfmt::skip]
const HALFWAY: &Phrases = &Phrases::of(&["halfway to", "half way to", "half the way to", "halfway towards", "half way towards", "halfway over to", "midway to", "half of the way to", "halfway toward"]);

impl Reader<'_> {
    /// Whether a step to or from a thing begins at a token.
    pub(super) fn begins_step(&self, at: usize) -> bool {
        let rest = &self.lexemes[at.min(self.lexemes.len())..];
        let by = longest_phrase(rest, &["by"]).unwrap_or(0);
        let leads = |from: usize| {
            longest_phrase(&rest[from..], TOWARDS).or_else(|| longest_phrase(&rest[from..], AWAY))
        };
        let is_compass = |from: usize| self.parser(at + from, self.lexemes.len()).compass().is_some();
        longest_phrase(rest, HALFWAY).is_some()
            || numbers::walked(&rest[by..])
                .is_some_and(|(_, words)| leads(by + words).is_some() && !is_compass(by + words))
    }

    /// A step to or from a thing, if one stands here: how far may be told behind it too.
    ///
    /// # Errors
    /// The thing is not there.
    pub(super) fn step(&mut self, end: usize) -> Result<Option<Where>, PlanError> {
        let start = self.at;
        if self.eat_any(HALFWAY) {
            return Ok(Some(Where::Halfway(self.anchor(end)?)));
        }
        if self.begins_step(start) {
            self.eat_any(&["by"]);
            let (distance, words) = numbers::walked(self.rest(end)).unwrap_or((1.0, 0));
            self.at += words;
            let sign = if self.eat_any(TOWARDS) { 1.0 } else { -1.0 };
            if sign < 0.0 && !self.eat_any(AWAY) {
                self.at = start;
                return Ok(None);
            }
            return Ok(Some(Where::Nearer(sign * distance, self.anchor(end)?)));
        }
        let sign = if self.eat_any(TOWARDS) { 1.0 } else { -1.0 };
        if (sign > 0.0 || self.eat_any(AWAY))
            && let Ok(anchor) = self.anchor(end)
            && self.eat_any(&["by"])
            && let Some((distance, words)) = numbers::walked(self.rest(end))
        {
            self.at += words;
            return Ok(Some(Where::Nearer(sign * distance, anchor)));
        }
        self.at = start;
        Ok(None)
    }
}

impl Where {
    /// Whether it says how far something goes from where it is, which nothing new can do.
    pub(super) const fn is_step(&self) -> bool {
        matches!(self, Self::Shift(..) | Self::ShiftOwn(..) | Self::Nearer(..) | Self::Halfway(_))
    }
}

impl Finder<'_> {
    /// Things that go some way to or from another, if it is told so.
    pub(super) fn stepped(&self, things: &[EntityId], at: &[Where]) -> Result<Option<Vec<Edit>>, EditError> {
        let [step @ (Where::Nearer(_, to) | Where::Halfway(to))] = at else { return Ok(None) };
        let to = self.scene.entity(self.anchor(to, things)?).map_or(Point2::origin(), |to| to.planar());
        let stepped = |thing: &EntityId| {
            let from = self.scene.entity(*thing).map_or(to, |entity| entity.planar());
            let way: Vector2 = to - from;
            let far = way.norm();
            let point = match step {
                Where::Nearer(distance, _) if far > 1e-6 => from + way * (distance / far),
                Where::Halfway(_) => from + way * 0.5,
                _ => from,
            };
            Edit::Move { things: vec![*thing], stands: vec![Stand::At { point }] }
        };
        Ok(Some(things.iter().map(stepped).collect()))
    }
}

/// Every word of these tables, for the spelling.
pub(super) fn words() -> impl Iterator<Item = &'static str> {
    TOWARDS.iter().chain(AWAY).chain(HALFWAY).flat_map(|phrase| phrase.split(' '))
}
