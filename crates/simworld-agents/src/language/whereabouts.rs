//! What is said behind a thing where a scene is spoken of: on which street it stands, in which park, within how many metres,
//! and that it is taller than so much.

use simworld_core::scene::{EntityKind, Relation};
use simworld_core::seam::PlanError;

use super::clause::{Measure, Reference, Stands, Target};
use super::lexicon::{longest, longest_phrase};
use super::numbers;
use super::parser::Parser;
use super::phrases::Phrases;

/// What stands before a street.
#[rustfmt::skip]
const ON_STREET: &Phrases = &Phrases::of(&[
    "on", "along", "in", "at", "down", "lining", "beside", "off", "of", "from", "all along", "up and down", "on the edge of",
    "along the edge of", "on both sides of", "by", "right by", "next to", "right next to",
]);
/// What stands before an area in which something is.
#[rustfmt::skip]
const IN_AREA: &Phrases = &Phrases::of(&["in", "on", "inside", "at", "within", "of", "in the middle of", "from", "around in"]);
/// What stands before a distance that is the greatest.
#[rustfmt::skip]
const WITHIN: &[&str] = &["within", "not more than", "no more than", "at most", "less than", "no farther than", "in a radius of"];
/// What stands before a distance that is the least.
#[rustfmt::skip]
const BEYOND: &[&str] = &["more than", "at least", "farther than", "further than", "farther away than", "further away than", "not within", "no less than", "no closer than", "no nearer than"];
/// What stands behind it.
const OF: &[&str] = &["of", "from", "away from", "around", "off", "to"];
/// Words that compare with a number.
const THAN: &[(&[&str], (Measure, bool))] = &[
    (&["taller than", "higher than"], (Measure::Height, true)),
    (&["shorter than", "lower than", "smaller than"], (Measure::Height, false)),
    (&["heavier than"], (Measure::Mass, true)),
    (&["lighter than"], (Measure::Mass, false)),
];

impl Parser<'_> {
    /// "Within five metres of the lamp": a distance behind such words and the thing that it is from; nothing is read where that is not all there.
    fn distance_from(&mut self, words: &[&str], depth: u32) -> Result<Option<(f64, Reference)>, PlanError> {
        let start = self.at;
        if self.eat_any(words)
            && let Some((reach, words)) = numbers::length(self.rest())
        {
            self.at += words;
            if self.eat_any(OF) {
                return Ok(Some((reach, self.reference(depth + 1)?)));
            }
        }
        self.at = start;
        Ok(None)
    }

    /// On a street, in an area, or within a distance.
    pub(super) fn on_ground(&mut self, depth: u32) -> Result<Option<Stands>, PlanError> {
        let start = self.at;
        let Some(streets) = self.view.streets else {
            // "The tallest tree in the park".
            if depth < 3
                && self.eat_any(&["in", "inside", "within", "of"])
                && let Some(area) = self.area(depth)
            {
                return Ok(Some(Stands::To(Relation::Inside, Box::new(area))));
            }
            self.at = start;
            return Ok(None);
        };
        if let Some((reach, from)) = self.distance_from(WITHIN, depth)? {
            return Ok(Some(Stands::Within(reach, Box::new(from))));
        }
        if let Some((reach, from)) = self.distance_from(BEYOND, depth)? {
            return Ok(Some(Stands::Beyond(reach, Box::new(from))));
        }
        // "The oak on the south side of Oak Street".
        if self.eat_any(&["on the", "along the", "at the"])
            && let Some(compass) = self.compass_of_part()
            && self.eat_any(&["side of the", "side of"])
            && let Some(street) = streets.at(self.rest())
        {
            self.at += street.words;
            return Ok(Some(Stands::SideOfStreet(compass, street.roads.to_vec())));
        }
        self.at = start;
        if self.eat_any(ON_STREET) {
            self.eat_any(&["the"]);
            if let Some(street) = streets.at(self.rest()) {
                self.at += street.words;
                return Ok(Some(Stands::OnStreet(street.roads.to_vec())));
            }
        }
        self.at = start;
        // "The tree in the western half of the park".
        if depth < 3
            && self.eat_any(&["in the", "on the", "at the", "inside the"])
            && let Some(compass) = self.compass_of_part()
            && self.eat_any(&[
                "half of",
                "part of",
                "corner of",
                "section of",
                "end of",
                "side of",
                "area of",
            ])
            && let Some(area) = self.area(depth)
        {
            let there = Stands::Compass(compass, Some(Box::new(area.clone())));
            return Ok(Some(Stands::All(vec![Stands::To(Relation::Inside, Box::new(area)), there])));
        }
        self.at = start;
        if depth < 3
            && self.eat_any(IN_AREA)
            && let Some(area) = self.area(depth)
        {
            return Ok(Some(Stands::To(Relation::Inside, Box::new(area))));
        }
        self.at = start;
        // "The car at the bus stop".
        if depth < 3
            && self.eat_any(&["at", "over at"])
            && longest_phrase(self.rest(), &["the", "that", "this", "our", "my"]).is_some()
            && let Ok(thing) = self.reference(depth + 1)
        {
            return Ok(Some(Stands::To(Relation::NextTo, Box::new(thing))));
        }
        self.at = start;
        Ok(None)
    }

    /// A piece of ground; "that is red" behind it is said of what stands there.
    fn area(&mut self, depth: u32) -> Option<Reference> {
        let is_that = |at: &usize| longest_phrase(&self.lexemes[*at..], &["that", "which", "who"]).is_some();
        let whole = self.lexemes;
        let cut = (self.at + 1..whole.len()).find(is_that).unwrap_or(whole.len());
        self.lexemes = &whole[..cut];
        let area = self.reference(depth + 1);
        self.lexemes = whole;
        area.ok().filter(|area| self.is_area(area))
    }

    /// "Taller than 8 metres".
    pub(super) fn comparison(&mut self) -> Option<(Measure, bool, f64)> {
        self.view.streets?;
        let rest = self.rest();
        let ((measure, more), words) = longest(rest, THAN)?;
        let (limit, count) = match measure {
            Measure::Mass => {
                let (number, count) = numbers::number(&rest[words..])?;
                let unit = longest_phrase(
                    &rest[words + count..],
                    &["kg", "kilos", "kilograms", "kilo", "kilogrammes"],
                )?;
                (number, count + unit)
            }
            _ => numbers::length(&rest[words..])?,
        };
        self.at += words + count;
        self.eat_any(&["tall", "high", "in height"]);
        Some((measure, more, limit))
    }

    /// Whether a phrase means a piece of ground.
    fn is_area(&self, reference: &Reference) -> bool {
        let is_ground =
            |id| self.view.scene.entity(id).is_some_and(|entity| entity.kind == EntityKind::Ground);
        match &reference.target {
            Target::Any(class) => class.is_area(),
            Target::Named(ids) => !ids.is_empty() && ids.iter().copied().all(is_ground),
            Target::Id(id) => is_ground(*id),
            _ => false,
        }
    }
}

/// Every word of these tables, for the spelling.
pub(super) fn words() -> impl Iterator<Item = &'static str> {
    let than = THAN.iter().flat_map(|(words, _)| *words).copied();
    than.chain(WITHIN.iter().chain(BEYOND).copied()).flat_map(|phrase| phrase.split(' '))
}
