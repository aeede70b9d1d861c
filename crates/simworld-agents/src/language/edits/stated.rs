//! Wishes that are no orders: "the truck should be blue", "the museum could use a bench", "a bench by the fountain, please".

use simworld_core::seam::PlanError;

use super::super::lexicon::{longest, longest_phrase};
use super::super::paint::PAINTS;
use super::parse::Reader;
use super::wish::{Anchor, Where, Wish};
use super::words::{ABOUT_IT, FACTORS};

/// How a thing should be.
#[rustfmt::skip]
const OUGHT: &[&str] = &["should be", "must be", "ought to be", "has to be", "have to be", "needs to be",
        "need to be", "shall be", "is supposed to be", "be", "would look better", "should become", "should turn",
        "could be", "becomes", "become", "turns", "should be standing", "should stand", "should sit",
        "should be placed", "should be moved", "would be better", "would be nicer", "should go", "must stand", "should be over", "has to be standing", "must be standing",
        "belongs", "belong", "must go", "has to go", "needs to go", "can go", "is to be", "be standing",
        "should get"];
/// After them: that it should not be.
const GONE: &[&str] = &["gone", "removed", "deleted", "away", "taken away"];
/// That it should not be, whole.
#[rustfmt::skip]
const GOES: &[&str] = &["should go", "must go", "has to go", "have to go", "needs to go", "can go",
        "has got to go", "ought to go", "is no longer needed", "isnt needed", "is not needed", "has to disappear",
        "should disappear", "must disappear"];
/// That two should stand where the other does.
#[rustfmt::skip]
const TRADES: &[&str] = &["should change places", "should swap places", "should trade places", "should swap",
        "should switch places", "must change places", "must swap places", "have to change places",
        "have to swap places", "ought to swap places", "should trade spots", "could trade spots", "could swap places", "could trade places",
        "could change places", "could swap spots", "should swap spots", "should swap positions", "need to swap places"];

/// That something is not there, and should be.
#[rustfmt::skip]
const LACKS: &[&str] = &["could use", "needs", "need", "wants", "lacks", "is missing", "deserves",
    "should have", "should get", "must have", "has to have", "could do with", "can use", "ought to have"];

impl Reader<'_> {
    /// Statements: "the truck should be blue", "it is noon", "there should be a bench".
    pub(super) fn stated(&mut self, end: usize) -> Result<Option<Vec<Vec<Wish>>>, PlanError> {
        let start = self.at;
        let mut from = start + self.polite_at(start);
        from +=
            longest_phrase(&self.lexemes[from..end], &["could", "can", "may", "should", "would", "might"])
                .unwrap_or(0);
        if let Some(wish) = self.gone_or_traded(from, end)? {
            return Ok(Some(vec![vec![wish]]));
        }
        if let Some(wish) = self.lacking(from, end) {
            return Ok(Some(vec![vec![wish]]));
        }
        for cut in from + 1..end {
            let Some(count) = longest_phrase(&self.lexemes[cut..end], OUGHT) else { continue };
            let Ok(what) = self.things(from, cut) else { continue };
            let then = cut + count;
            if longest_phrase(&self.lexemes[then..end], GONE) == Some(end - then) {
                self.at = end;
                return Ok(Some(vec![vec![Wish::Remove { what }]]));
            }
            if let Some((paint, words)) = longest(&self.lexemes[then..end], PAINTS) {
                let rest = then + words;
                if rest == end
                    || longest_phrase(&self.lexemes[rest..end], &["instead", "please", "now"]).is_some()
                {
                    self.at = end;
                    return Ok(Some(vec![vec![Wish::Paint { what, paint }]]));
                }
            }
            if let Some((factor, words)) = longest(&self.lexemes[then..end], FACTORS)
                && then + words == end
            {
                self.at = end;
                return Ok(Some(vec![vec![Wish::Scale { what, factor }]]));
            }
            self.at = then;
            if self.is_place(then)
                && let Ok(at) = self.places(end)
                && self.at == end
            {
                return Ok(Some(vec![vec![Wish::Move { what, at }]]));
            }
        }
        self.at = start;
        Ok(None)
    }

    /// "The crate has to go", "the two should change places".
    fn gone_or_traded(&mut self, from: usize, end: usize) -> Result<Option<Wish>, PlanError> {
        let stop = self.before_politeness(from, end);
        for cut in from + 1..stop {
            let rest = &self.lexemes[cut..stop];
            if longest_phrase(rest, GOES) == Some(rest.len())
                && let Ok(what) = self.things(from, cut)
            {
                self.at = end;
                return Ok(Some(Wish::Remove { what }));
            }
            if longest_phrase(rest, TRADES) == Some(rest.len()) {
                self.at = from;
                let wish = self.pair_up(from, cut)?;
                self.at = end;
                return Ok(Some(wish));
            }
        }
        Ok(None)
    }

    /// "The museum could use a bench out front", "give the café a tree at the back".
    pub(super) fn lacking(&mut self, start: usize, end: usize) -> Option<Wish> {
        let gives = longest_phrase(&self.lexemes[start..end], &["give", "giving"]);
        let from = start + gives.unwrap_or(0);
        for cut in from + 1..end {
            let lacks = longest_phrase(&self.lexemes[cut..end], LACKS);
            let Some(count) = (if gives.is_some() { Some(0) } else { lacks }) else { continue };
            self.at = from;
            let street = self.street(cut).filter(|_| self.at == cut);
            let anchor = match (street, self.one_of(from, cut)) {
                (Some(street), _) => street,
                (None, Ok(thing)) => Anchor::Thing(thing),
                (None, Err(_)) => continue,
            };
            self.at = cut + count;
            if self.is_definite(self.at) {
                continue;
            }
            let Ok(thing) = self.new_thing(end) else { continue };
            if let Some(at) = self.one_there(end, &anchor) {
                self.at = end;
                return Some(Wish::Add { things: vec![thing], at });
            }
            let relation = longest(self.rest(end), ABOUT_IT);
            let stop = self.at + relation.map_or(0, |(_, words)| words);
            if self.before_politeness(stop.saturating_sub(1), end) <= stop {
                self.at = end;
                let place = match (relation, anchor) {
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

    /// Without a verb: "a bench next to the fountain, please".
    pub(super) fn bare(&mut self, end: usize) -> Result<Option<Vec<Vec<Wish>>>, PlanError> {
        let start = self.at;
        self.at += self.polite_at(start);
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
        self.is_bare_plural(at, end) || noun.is_some_and(|(_, words)| self.is_place(at + words))
    }
}

/// Every word of these tables, for the spelling.
pub(super) fn words() -> impl Iterator<Item = &'static str> {
    let lists = OUGHT.iter().chain(GONE).chain(GOES).chain(TRADES).chain(LACKS);
    lists.flat_map(|phrase| phrase.split(' '))
}
