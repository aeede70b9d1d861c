//! Wishes without a verb of change: "the museum could use a bench", "a bench by the fountain, please".

use simworld_core::seam::PlanError;

use super::super::clause::{Count, Reference, Target};
use super::super::lexicon::{longest, longest_phrase};
use super::super::phrases::Phrases;
use super::parse::Reader;
use super::says::LACKS;
use super::wish::{Anchor, Where, Wish};
use super::words::ABOUT_IT;

/// How somebody is told to give.
#[derive(Clone, Copy)]
enum Gives {
    /// "Give Bo a chair".
    Plainly,
    /// "Spoil Bo with a chair", "set Bo up with a chair".
    With,
    /// "Treat Bo to a chair".
    To,
    /// "Let Bo have a chair".
    Have,
}

#[rustfmt::skip]
const GIVES: &[(&[&str], Gives)] = &[
    (&["give", "giving", "get", "hand", "buy", "lend", "offer", "pass", "fetch", "bring", "grant", "slip", "gift", "award", "donate"], Gives::Plainly),
    (&["spoil", "present", "surprise", "reward", "supply", "provide", "cheer", "hook", "set", "fix", "kit", "fit", "deck", "equip", "load", "furnish", "help", "serve", "honour", "honor", "bless", "gladden",
        "delight", "sort"], Gives::With),
    (&["treat"], Gives::To),
    (&["let"], Gives::Have),
];

impl Reader<'_> {
    /// "The museum could use a bench out front", "give the café a tree at the back", "set the office up with a flagpole".
    pub(super) fn lacking(&mut self, start: usize, end: usize) -> Option<Wish> {
        let asks = longest(&self.lexemes[start..end], &super::words::VERBS).is_some_and(|(verb, _)| {
            matches!(
                verb,
                super::words::Verb::List | super::words::Verb::Count | super::words::Verb::Describe
            )
        });
        let gives = longest(&self.lexemes[start..end], GIVES).filter(|_| !asks);
        let from = start + gives.map_or(0, |(_, words)| words);
        if let Some(wish) = gives.and_then(|_| self.given_a_name(from, end)) {
            self.at = end;
            return Some(wish);
        }
        // Whoever speaks is given things by other rules.
        if gives.is_some() && matches!(self.word(from), Some("me" | "us" | "myself")) {
            return None;
        }
        let found = (from + 1..end).find_map(|cut| {
            let rest = &self.lexemes[cut..end];
            let count = match gives {
                Some((Gives::Plainly, _)) => Some(0),
                Some((Gives::With, _)) => longest_phrase(rest, &["with", "up with", "out with", "over with"]),
                Some((Gives::To, _)) => longest_phrase(rest, &["to"]),
                Some((Gives::Have, _)) => longest_phrase(rest, &["have", "get", "own"]),
                None => longest_phrase(rest, LACKS),
            }?;
            let mut reader = *self;
            let wish = reader.lacked((from, cut), cut + count, end, gives.is_some());
            wish.or_else(|| self.each_lacks((from, cut), cut + count, end))
        });
        self.at = if found.is_some() { end } else { start };
        found
    }

    /// What is asked for something, whose name stands between two places, from a place on.
    fn lacked(&mut self, (from, cut): (usize, usize), at: usize, end: usize, gives: bool) -> Option<Wish> {
        self.at = from;
        let both = longest_phrase(
            &self.lexemes[from..cut],
            &["both sides of", "each side of", "either side of", "the two sides of"],
        );
        self.at = from + both.unwrap_or(0);
        let street = self.street(cut).filter(|_| self.at == cut);
        let anchor = match street {
            Some(street) => street,
            None => Anchor::Thing(self.one_named(from, cut)?),
        };
        self.at = at;
        if let Anchor::Thing(whose) = &anchor
            && let Some(wish) = self.made_so(whose, at, end, gives)
        {
            return Some(wish);
        }
        if self.is_definite(at) {
            return None;
        }
        let thing = self.new_thing(end).ok()?;
        if let Some(at) = self.one_there(end, &anchor).or_else(|| self.aside_place(end, &anchor)) {
            return Some(Wish::Add { things: vec![thing], at });
        }
        // "Give him a dog right beside him".
        if gives
            && let Some(mut at) = self.places_to(self.at, self.before_politeness(self.at, end))
            && at.iter().all(|place| place.anchor().is_some_and(|anchor| anchor.is_it()))
        {
            for place in &mut at {
                place.means(&mut Some(anchor.clone()));
            }
            return Some(Wish::Add { things: vec![thing], at });
        }
        let relation = longest(self.rest(end), &ABOUT_IT);
        let stop = self.at + relation.map_or(0, |(_, words)| words);
        if self.before_politeness(stop.saturating_sub(1), end) > stop {
            return None;
        }
        let place = match (relation, anchor) {
            (None, street @ Anchor::Street(..)) if both.is_some() => Where::BothSides(street),
            (None, street @ Anchor::Street(..)) => Where::Along(street),
            (None, anchor) => Where::By(anchor),
            (Some((relation, _)), anchor) => Where::To(relation, anchor),
        };
        Some(Wish::Add { things: vec![thing], at: vec![place] })
    }

    /// One thing that is named, or both of two.
    fn one_named(&self, from: usize, cut: usize) -> Option<Reference> {
        let one = self.one_of(from, cut).ok().filter(|one| one.target != Target::Here)?;
        let mut one = super::spoken::group_at(&one).unwrap_or(one);
        if self.word(from) == Some("both") && one.count == Count::Exactly(2) && self.how_many(&one) == 2 {
            one.count = Count::All;
        }
        Some(one)
    }

    /// "Give the truck a quarter turn", "the table deserves a fresh coat of blue", "give Bo the chair".
    fn made_so(&self, whose: &Reference, at: usize, end: usize, gives: bool) -> Option<Wish> {
        let stop = self.before_politeness(at, end);
        if let Some(paint) = self.paint_to(at, stop) {
            return Some(Wish::Paint { what: vec![whose.clone()], paint });
        }
        if let Some(factor) = super::predicates::size_of(&self.lexemes[at..stop]) {
            return Some(Wish::Scale { what: vec![whose.clone()], factor });
        }
        if let Some(angle) = super::turn::angle(&self.lexemes[at..stop]).filter(|_| gives) {
            return Some(Wish::Rotate { what: vec![whose.clone()], angle });
        }
        let brings = gives && self.is_definite(at) && self.is_certain(at) && !super::says::is_it(whose);
        let what = if brings { self.things(at, stop).ok()? } else { return None };
        Some(Wish::Move { what, at: vec![Where::By(Anchor::Thing(whose.clone()))] })
    }

    /// "Ada and Bo each need a stool": one for each of several.
    fn each_lacks(&self, (from, cut): (usize, usize), at: usize, end: usize) -> Option<Wish> {
        let stop = if matches!(self.word(cut - 1), Some("each" | "both" | "all")) { cut - 1 } else { cut };
        if stop <= from || self.is_definite(at) {
            return None;
        }
        let several = self.things(from, stop).ok().filter(|things| things.len() > 1)?;
        let mut end = self.before_politeness(at, end);
        end -= usize::from(self.word(end - 1) == Some("each"));
        let reader = self.up_to(end);
        let wishes: Option<Vec<Wish>> =
            several.into_iter().map(|one| reader.given_to(&Anchor::Thing(one), at, end)).collect();
        wishes.map(Wish::All)
    }

    /// "Give the robot a name: 'Willow'".
    fn given_a_name(&self, from: usize, end: usize) -> Option<Wish> {
        #[rustfmt::skip]
        const NAME: &Phrases = &Phrases::of(&["the name", "a name", "a new name", "the new name", "the nickname", "a nickname", "the title", "its name", "his name", "her name"]);
        (from + 1..end).find_map(|cut| {
            let words = longest_phrase(&self.lexemes[cut..end], NAME)?;
            let what = self.one_of(from, cut).ok()?;
            let start = (cut + words..end).find(|at| !super::super::lexer::is_mark(&self.lexemes[*at]))?;
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
        while reader.at < end && super::super::lexer::is_mark(&self.lexemes[reader.at]) {
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
                // "Cyclists fall into the river".
                && (place == at + 1
                    || self.word(place - 1).is_some_and(|word| word.ends_with('s'))
                    || self.names.asset_words(&self.lexemes[at..place]) == Some(place - at)
                    || !self.word(at).is_some_and(|word| word.ends_with('s')))
                && self.one_of(at, place).is_err()
                && self.order_at(at, place).is_none()
                // "Willows along the river" are new where none is there, and "willow by the river" is one of the scene.
                && super::follow::species(&self.lexemes[at]).is_none_or(|one| self.word(at) != Some(one))
                && super::forms::as_order(&self.lexemes[at..place]).is_none()
                && self.names.exact(&self.lexemes[place - 1..place]).is_none()
        });
        // "Park lanterns along the road".
        let is_asset = place.is_some_and(|place| {
            self.names.asset_words(&self.lexemes[at..place]) == Some(place - at)
                && self.word(place - 1).is_some_and(|word| word.ends_with('s'))
                && place > at + 1
        });
        many || is_asset
            || self.is_bare_plural(at, end)
            || noun.is_some_and(|(_, words)| self.is_place(at + words))
    }
}

/// Every word of these tables, for the spelling.
pub(super) fn words() -> impl Iterator<Item = &'static str> {
    GIVES.iter().flat_map(|(words, _)| *words).copied()
}
