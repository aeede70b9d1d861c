//! The only one of several that is in a direction from something: "the bin that stands north of the school", "the car to the east of the shop".
//!
//! It is found in the scene and put into the words where a sentence is refused; if several are there, nothing decides.

use simworld_core::geometry::Point2;
use simworld_core::id::EntityId;

use super::super::compass::DIRECTIONS;
use super::super::lexer::{Lexeme, is_mark};
use super::super::lexicon::{longest, longest_phrase};
use super::super::phrases::Phrases;
use super::parse::Reader;
use super::resolve::Finder;
use super::taken_up::those;

/// Between a noun and the direction.
#[rustfmt::skip]
const STANDS: &Phrases = &Phrases::of(&["that stands", "which stands", "who stands", "that is", "thats", "which is", "standing", "that lies", "which lies", "that is standing", "that is parked", "parked", "that sits", "located", "that is located"]);
const TO_THE: &Phrases = &Phrases::of(&["to the", "just", "right", "directly", "due", "straight"]);

impl Reader<'_> {
    /// The words with the thing itself for "the bin that stands north of the school".
    pub(super) fn with_directed(&self, finder: &Finder<'_>) -> Option<Vec<Lexeme>> {
        (0..self.lexemes.len()).find_map(|at| {
            let the = longest_phrase(&self.lexemes[at..], &["the", "that"])?;
            let called = self.all_called(at + the, finder)?;
            let stands = called.end + longest_phrase(self.lexemes.get(called.end..)?, STANDS)?;
            let to = stands + longest_phrase(self.lexemes.get(stands..)?, TO_THE).unwrap_or(0);
            let (compass, words) = longest(self.lexemes.get(to..)?, DIRECTIONS)?;
            let of = to + words;
            let of = of + longest_phrase(self.lexemes.get(of..)?, &["of", "from"])?;
            let (end, anchor) = self.anchor_at(of, finder)?;
            let end = (of + 1..=end).rev().find(|end| !is_mark(&self.lexemes[end - 1]))?;
            let position = |id: EntityId| finder.scene.entity(id).map(|thing| thing.planar());
            let from: Point2 = position(anchor)?;
            let lies = |id: &EntityId| {
                *id != anchor && position(*id).is_some_and(|point| compass.holds(from, point))
            };
            let found: Vec<EntityId> = called.things.into_iter().filter(lies).collect();
            (found.len() == 1).then_some(())?;
            let mut lexemes = self.lexemes.to_vec();
            lexemes.splice(at..end, [those(&self.lexemes[at], &found)]);
            Some(lexemes)
        })
    }
}
