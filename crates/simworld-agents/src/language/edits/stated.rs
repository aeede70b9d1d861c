//! Wishes without a verb of change: "the museum could use a bench", "a bench by the fountain, please".

use simworld_core::seam::PlanError;

use super::super::lexicon::{longest, longest_phrase};
use super::parse::Reader;
use super::says::LACKS;
use super::wish::{Anchor, Where, Wish};
use super::words::ABOUT_IT;

impl Reader<'_> {
    /// "The museum could use a bench out front", "give the café a tree at the back".
    pub(super) fn lacking(&mut self, start: usize, end: usize) -> Option<Wish> {
        let asks = longest(&self.lexemes[start..end], super::words::VERBS).is_some_and(|(verb, _)| {
            matches!(
                verb,
                super::words::Verb::List | super::words::Verb::Count | super::words::Verb::Describe
            )
        });
        let gives = longest_phrase(&self.lexemes[start..end], &["give", "giving"]).filter(|_| !asks);
        let from = start + gives.unwrap_or(0);
        if let Some(wish) = gives.and_then(|_| self.given_a_name(from, end)) {
            self.at = end;
            return Some(wish);
        }
        for cut in from + 1..end {
            let lacks = longest_phrase(&self.lexemes[cut..end], LACKS);
            let Some(count) = (if gives.is_some() { Some(0) } else { lacks }) else { continue };
            self.at = from;
            let both = longest_phrase(
                &self.lexemes[from..cut],
                &["both sides of", "each side of", "either side of", "the two sides of"],
            );
            self.at = from + both.unwrap_or(0);
            let street = self.street(cut).filter(|_| self.at == cut);
            let anchor = match (street, self.one_of(from, cut)) {
                (Some(street), _) => street,
                (None, Ok(thing)) => Anchor::Thing(thing),
                (None, Err(_)) => continue,
            };
            self.at = cut + count;
            if self.is_definite(self.at) {
                // "Give Bo the chair".
                if gives.is_some()
                    && self.is_certain(self.at)
                    && let Anchor::Thing(whose) = &anchor
                    && !super::says::is_it(whose)
                    && let Ok(what) = self.things(self.at, end)
                {
                    self.at = end;
                    return Some(Wish::Move { what, at: vec![Where::By(anchor)] });
                }
                continue;
            }
            let Ok(thing) = self.new_thing(end) else { continue };
            if let Some(at) = self.one_there(end, &anchor) {
                self.at = end;
                return Some(Wish::Add { things: vec![thing], at });
            }
            if let Some(at) = self.aside_place(end, &anchor) {
                self.at = end;
                return Some(Wish::Add { things: vec![thing], at });
            }
            let relation = longest(self.rest(end), ABOUT_IT);
            let stop = self.at + relation.map_or(0, |(_, words)| words);
            if self.before_politeness(stop.saturating_sub(1), end) <= stop {
                self.at = end;
                let place = match (relation, anchor) {
                    (None, street @ Anchor::Street(..)) if both.is_some() => Where::BothSides(street),
                    (None, street @ Anchor::Street(..)) => Where::Along(street),
                    (None, anchor) => Where::By(anchor),
                    (Some((relation, _)), anchor) => Where::To(relation, anchor),
                };
                return Some(Wish::Add { things: vec![thing], at: vec![place] });
            }
        }
        self.at = start;
        None
    }

    /// "Give the robot a name: 'Willow'".
    fn given_a_name(&self, from: usize, end: usize) -> Option<Wish> {
        #[rustfmt::skip]
        const NAME: &[&str] = &["the name", "a name", "a new name", "the new name", "the nickname", "a nickname", "the title", "its name", "his name", "her name"];
        (from + 1..end).find_map(|cut| {
            let words = longest_phrase(&self.lexemes[cut..end], NAME)?;
            let what = self.one_of(from, cut).ok()?;
            let start = (cut + words..end).find(|at| !super::parts::is_mark(&self.lexemes[*at]))?;
            let quoted = (start..end).find_map(|at| self.quoted(at));
            let name = quoted.unwrap_or_else(|| self.written(start, self.before_politeness(start, end)));
            (!name.is_empty()).then_some(Wish::Name { what, name })
        })
    }

    /// "The bus stop is missing a bench, put one right by it": where the one that is missing goes.
    fn one_there(&self, end: usize, anchor: &Anchor) -> Option<Vec<Where>> {
        let mut reader = Reader { at: self.at, ..*self };
        reader.skip_joints_to(end);
        let puts = reader.eat_any(&[
            "put one",
            "add one",
            "place one",
            "set one",
            "stick one",
            "put it",
            "place it",
        ]);
        let mut at = puts.then(|| reader.places(end).ok()).flatten().filter(|_| reader.at >= end)?;
        for place in &mut at {
            place.means(&mut Some(anchor.clone()));
        }
        Some(at)
    }

    /// "..., right beside him": a place behind a mark.
    fn aside_place(&self, end: usize, anchor: &Anchor) -> Option<Vec<Where>> {
        let mut reader = Reader { at: self.at, ..*self };
        while reader.at < end && super::parts::is_mark(&self.lexemes[reader.at]) {
            reader.at += 1;
        }
        if reader.at == self.at {
            return None;
        }
        reader.eat_any(&[
            "right",
            "just",
            "directly",
            "and put it",
            "put it",
            "preferably",
            "ideally",
            "somewhere",
        ]);
        let mut at = reader.places_to(reader.at, end)?;
        for place in &mut at {
            place.means(&mut Some(anchor.clone()));
        }
        Some(at)
    }

    /// Without a verb: "a bench next to the fountain, please".
    pub(super) fn bare(&mut self, end: usize) -> Result<Option<Vec<Vec<Wish>>>, PlanError> {
        let start = self.at;
        self.at += self.polite_at(start);
        // "Three copies of the cone by the kiosk".
        if let Some(copies) = self.copies(end) {
            return Ok(Some(copies));
        }
        if self.is_definite(self.at) && !self.is_bare(self.at, end) {
            self.at = start;
            return Ok(None);
        }
        self.additions(end).map(Some)
    }

    /// "Benches", and "bench by the fountain": no article, and a place behind a thing.
    fn is_bare(&self, at: usize, end: usize) -> bool {
        let rest = &self.lexemes[at.min(end)..end];
        let noun = super::super::lexicon::category(rest);
        // "Cypresses along the road": a plural that is nothing of the scene.
        let place = (at + 1..end.min(at + 4)).find(|at| self.is_place(*at));
        let many = place.is_some_and(|place| {
            // Behind a preamble it may be a verb: "residents would benefit from ...".
            self.depth < super::says::DEEPEST
                && self.is_unknown(at, place)
                && self.one_of(at, place).is_err()
                && longest(&self.lexemes[at..place], super::words::VERBS).is_none()
                && super::follow::species(&self.lexemes[at]).is_none()
                && super::forms::as_order(&self.lexemes[at..place]).is_none()
                && self.names.exact(&self.lexemes[place - 1..place]).is_none()
        });
        many || self.is_bare_plural(at, end) || noun.is_some_and(|(_, words)| self.is_place(at + words))
    }
}
