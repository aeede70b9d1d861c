//! Several colours for several things: "paint the benches red, white and blue", "a red, a white and a blue chair", "three barrels in
//! red, white and blue".

use simworld_core::id::EntityId;

use super::super::clause::{Count, Reference};
use super::super::lexicon::{longest, longest_phrase};
use super::super::paint::{PAINTS, Paint};
use super::super::phrases::Phrases;
use super::parse::{Reader, joint};
use super::resolve::Finder;
use super::wish::{NewThing, Wish};
use crate::editing::{Edit, EditError};

/// Behind several colours.
#[rustfmt::skip]
const IN_TURN: &Phrases = &Phrases::of(&["respectively", "in that order", "in this order", "in turn", "from left to right", "in order", "one each", "each in its own colour", "one of each"]);

impl Reader<'_> {
    /// Several colours from a place on, and where they end.
    pub(super) fn colours(&self, from: usize, end: usize) -> Option<(Vec<Paint>, usize)> {
        let mut at = from;
        let mut paints = Vec::new();
        while let Some((paint, words)) = longest(self.lexemes.get(at..end)?, PAINTS) {
            paints.push(paint);
            at += words;
            let mut next = at;
            while let Some(words) = joint(&self.lexemes[next..end]) {
                next += words;
            }
            next +=
                longest_phrase(&self.lexemes[next..end], &["the third", "the second", "the other", "one"])
                    .unwrap_or(0);
            if longest(&self.lexemes[next..end], PAINTS).is_none() {
                break;
            }
            at = next;
        }
        at += usize::from(
            self.lexemes.get(at).is_some_and(super::super::lexer::is_mark)
                && longest_phrase(self.lexemes.get(at + 1..end)?, IN_TURN).is_some(),
        );
        at += longest_phrase(self.lexemes.get(at..end)?, IN_TURN).unwrap_or(0);
        (paints.len() > 1).then_some((paints, at))
    }

    /// Things that get a colour each, if several of both are named up to the end.
    pub(super) fn painted_in_turn(&self, start: usize, end: usize) -> Option<Wish> {
        let end = self.before_politeness(start, end);
        (start + 1..end).find_map(|cut| {
            let (paints, _) = self.colours(cut, end).filter(|(_, after)| *after == end)?;
            let mut stop = cut;
            while stop > start + 1
                && longest_phrase(
                    &self.lexemes[stop - 1..stop],
                    &["in", "to", "be", "should", "the", "colours"],
                )
                .is_some()
            {
                stop -= 1;
            }
            let what = self.things(start, stop).ok().filter(|_| self.is_definite(start))?;
            are_several(&what).then_some(Wish::PaintEach { what, paints })
        })
    }

    /// "A red, a white and a blue chair": colours before the thing that has the last of them.
    pub(super) fn coloured_each(&mut self, end: usize) -> Option<Vec<NewThing>> {
        let start = self.at;
        let mut paints = Vec::new();
        loop {
            let article = longest_phrase(self.rest(end), &["a", "an", "one", "another"]);
            let at = self.at + article.unwrap_or(0);
            let Some((paint, words)) = longest(self.lexemes.get(at..end)?, PAINTS) else { break };
            let next = at + words;
            let Some(more) = joint(self.lexemes.get(next..end)?).filter(|_| article.is_some()) else { break };
            paints.push(paint);
            self.at = next + more;
            while let Some(words) = joint(self.rest(end)) {
                self.at += words;
            }
        }
        let last = if paints.is_empty() { None } else { self.new_thing(end).ok() };
        let Some(last) = last.filter(|last| last.paint.is_some() && last.count == 1) else {
            self.at = start;
            return None;
        };
        let one = |paint| NewThing { paint: Some(paint), ..last.clone() };
        Some(paints.into_iter().map(one).chain([last.clone()]).collect())
    }

    /// "Three barrels in red, white and blue": as many as there are colours.
    pub(super) fn in_colours(&mut self, thing: &NewThing, end: usize) -> Option<Vec<NewThing>> {
        let comma = usize::from(self.lexemes.get(self.at).is_some_and(super::super::lexer::is_mark));
        let start = self.at + comma;
        let from = start
            + longest_phrase(
                self.lexemes.get(start..end)?,
                &["in", "in the colours", "coloured", "painted", "one", "one in", "the first", "a"],
            )?;
        let (paints, mut after) = self.colours(from, end)?;
        let marked = self.lexemes.get(after).is_some_and(super::super::lexer::is_mark);
        after += usize::from(marked && after + 1 < end && self.is_place(after + 1));
        if thing.paint.is_some() || !(thing.many || thing.count as usize == paints.len()) {
            return None;
        }
        self.at = after;
        let one = |paint| NewThing { paint: Some(paint), count: 1, many: false, ..thing.clone() };
        Some(paints.into_iter().map(one).collect())
    }
}

/// Whether several things are spoken of.
pub(super) fn are_several(what: &[Reference]) -> bool {
    what.len() > 1 || what.iter().any(|one| one.count != Count::One || super::resolve::plural(one))
}

impl Finder<'_> {
    /// Things in the order in which they are named or stand, each in its own colour; where there are more of them the colours come again.
    pub(super) fn painted_each(&self, what: &[Reference], paints: &[Paint]) -> Result<Vec<Edit>, EditError> {
        let things: Vec<EntityId> = match what {
            [only] => self.in_a_row(&Reference { count: Count::All, ..only.clone() })?,
            several => self.all(several)?,
        };
        if things.len() < paints.len() {
            let what = format!("{} colours for {} things", paints.len(), things.len());
            return Err(EditError::Impossible { what, why: "name a colour for each of them".to_owned() });
        }
        let colored =
            |(thing, paint): (EntityId, &Paint)| Edit::Paint { things: vec![thing], color: paint.color() };
        Ok(things.into_iter().zip(paints.iter().cycle()).map(colored).collect())
    }
}
