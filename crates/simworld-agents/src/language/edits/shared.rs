//! What several places or things share: "next to the statue and the fountain", "next to both the bank and the shop", "one to the
//! left and one to the right of the door"; and places that stand before what is put there.

use super::super::clause::{Count, Reference, Target};
use super::super::lexicon::{longest, longest_phrase};
use super::super::phrases::Phrases;
use super::parse::Reader;
use super::says::is_it;
use super::wish::{Anchor, NewThing, StreetRef, Where, Wish};
use super::words::{WAYS, Way};

/// That each of what follows is meant, behind a word of place.
const EACH: &[&str] = &["each of", "both of", "both", "each", "every one of", "all of", "all three of"];
/// Before what something is painted like.
#[rustfmt::skip]
const LIKE: &Phrases = &Phrases::of(&["like", "the same colour as", "the same color as", "in the same colour as", "in the same color as", "in the colour of", "in the color of", "the colour of", "the color of", "to match", "to match the colour of",
    "to match the color of", "with the colour of", "with the same colour as", "as the same colour as", "the same as", "so that it matches", "so it matches", "so that they match", "to go with", "of the same colour as", "match",
    "match the colour of", "match the color of", "matching", "in the same colour like", "the same shade as", "in the same shade as", "just like", "exactly like", "same colour as", "same color as", "be the same colour as",
    "have the same colour as", "have the colour of", "has the same colour as", "the exact colour of", "the same colour like", "in the same paint as"]);

impl Reader<'_> {
    /// "... and the fountain": one more thing to which the last place is.
    pub(super) fn more_anchors(&mut self, last: &Where, end: usize) -> Option<Where> {
        let shares = matches!(
            last,
            Where::To(..) | Where::By(_) | Where::Across(_) | Where::Around(_) | Where::Compass(..)
        );
        let from = self.at
            + longest_phrase(self.rest(end), &["and", "and also", "and to", "as well as"]).or_else(|| {
                self.lexemes
                    .get(self.at)
                    .is_some_and(|mark| mark.token == super::super::lexer::Token::Comma)
                    .then_some(1)
            })?;
        if !shares || from >= end || !self.is_certain(from) || !matches!(last.anchor()?, Anchor::Thing(_)) {
            return None;
        }
        let mut parser = self.parser(from, self.before_politeness(from, end));
        let what = parser.reference(0).ok()?;
        let is_plain = what.relation.is_none()
            && !is_it(&what)
            && matches!(what.target, Target::Any(_) | Target::Named(_) | Target::Id(_));
        let after = parser.at;
        let ends = after >= self.before_politeness(from, end) || self.is_joint(after);
        if !is_plain || !ends {
            return None;
        }
        self.at = after;
        let mut place = last.clone();
        *place.anchor_mut()? = Anchor::Thing(what);
        Some(place)
    }

    /// "Next to both the bank and the shop": a place at each of them.
    pub(super) fn each_place(&mut self, end: usize) -> Option<Vec<Where>> {
        let (way, words) = longest(self.rest(end), &WAYS)?;
        let from = self.at + words;
        let from = from + longest_phrase(&self.lexemes[from..end], EACH)?;
        let stop = self.before_politeness(from, end);
        let found = (from + 3..=stop).rev().find_map(|stop| {
            let whole = stop == end || self.is_joint(stop) || stop == self.before_politeness(from, end);
            let things = if whole { self.things(from, stop).ok()? } else { return None };
            (things.len() > 1).then_some((things, stop))
        });
        let (things, stop) = found?;
        let places =
            things.into_iter().map(|thing| at_way(way, Anchor::Thing(thing))).collect::<Option<Vec<_>>>()?;
        self.at = stop;
        Some(places)
    }

    /// "Put between the fountain and the statue a bench": the place before what goes there.
    pub(super) fn place_then_thing(&mut self, end: usize) -> Option<Vec<Vec<Wish>>> {
        let start = self.at;
        let found = self.try_place_then_thing(end);
        if found.is_none() {
            self.at = start;
        }
        found
    }

    fn try_place_then_thing(&mut self, end: usize) -> Option<Vec<Vec<Wish>>> {
        if !self.is_place(self.at) {
            return None;
        }
        let mut at = vec![self.place(end).ok()?];
        if self.lexemes.get(self.at).is_some_and(super::super::lexer::is_mark) {
            self.at += 1;
        }
        let stop = self.before_politeness(self.at, end);
        if self.at >= stop || self.is_place(self.at) || self.is_joint(self.at) {
            return None;
        }
        let wish = if self.is_certain(self.at) && !self.is_bare_plural(self.at, stop) {
            Wish::Move { what: self.things(self.at, stop).ok()?, at }
        } else {
            let thing = self.new_thing(stop).ok().filter(|_| self.at >= stop)?;
            if let [Where::To(_, Anchor::It)] = &at[..] {
                at.clear();
            }
            Wish::Add { things: vec![thing], at }
        };
        self.at = end;
        Some(vec![vec![wish]])
    }

    /// "Paint the chair like the bench".
    pub(super) fn painted_as(&self, start: usize, end: usize) -> Option<Wish> {
        let stop = self.before_politeness(start, end);
        (start + 1..stop).find_map(|cut| {
            let words = longest_phrase(&self.lexemes[cut..stop], LIKE)?;
            let what = self.things(start, cut).ok()?;
            let like = self.one_of(cut + words, stop).ok().filter(|_| self.is_certain(start))?;
            Some(Wish::PaintLike { what, like })
        })
    }

    /// "Swap the colours of the two benches".
    pub(super) fn colours_swapped(&mut self, end: usize) -> Option<Wish> {
        let start = self.at;
        self.eat_any(&[
            "the colours of",
            "the colors of",
            "colours of",
            "colors of",
            "the colour of",
            "the color of",
        ]);
        if self.at == start {
            return None;
        }
        let stop = self.before_politeness(self.at, end);
        let things = self.things(self.at, stop).ok();
        self.at = start;
        let [one, other] = &things?[..] else { return None };
        let like = |what: &Reference, like: &Reference| Wish::PaintLike {
            what: vec![what.clone()],
            like: like.clone(),
        };
        Some(Wish::All(vec![like(one, other), like(other, one)]))
    }

    /// "The park could use some life": what is lacking is no thing.
    pub(super) fn lacks_something(&self, from: usize, end: usize) -> bool {
        (from + 1..end).any(|at| {
            longest_phrase(&self.lexemes[at..end], super::says::LACKS).is_some_and(|words| {
                self.is_lack(at + words, self.before_politeness(at + words, end)) && self.is_certain(from)
            })
        })
    }

    /// "More light near the bakery": what is lacking, which is no thing.
    pub(super) fn is_lack(&self, from: usize, end: usize) -> bool {
        #[rustfmt::skip]
        const MORE: &Phrases = &Phrases::of(&["more", "some more", "a bit more", "we need more", "we need", "need more", "i need more", "i want more", "better", "extra", "not enough", "too little", "there is not enough", "there isnt enough",
            "theres not enough", "for more", "some", "a little more", "we want more", "a lack of", "lack of", "no", "a bit of", "a touch of", "a little bit of", "a bit more of"]);
        #[rustfmt::skip]
        const OF: &Phrases = &Phrases::of(&["light", "lighting", "shade", "seating", "greenery", "life", "parking", "green", "colour", "seats", "safety", "shelter", "comfort", "decoration", "storage", "space to sit", "places to sit", "room to sit", "illumination", "charm", "atmosphere", "entertainment", "fun", "cheering up", "love", "attention", "help", "company", "protection", "security", "brightening up", "livening up", "sprucing up", "shade", "fresh air"]);
        let Some(more) = longest_phrase(&self.lexemes[from..end], MORE) else { return false };
        let Some(words) = longest_phrase(&self.lexemes[from + more..end], OF) else { return false };
        let at = from + more + words;
        at == end || self.places_to(at, end).is_some()
    }
}

/// A place by a word of relation and what it is to.
fn at_way(way: Way, anchor: Anchor) -> Option<Where> {
    Some(match way {
        Way::To(relation) => Where::To(relation, anchor),
        Way::Across => Where::Across(anchor),
        Way::Along => Where::Along(anchor),
        Way::Corner => Where::Corner(anchor),
        Way::At => Where::By(anchor),
        Way::Around => Where::Around(anchor),
        _ => return None,
    })
}

/// The places of things of which one stands at each: several anchors of one relation.
pub(super) fn is_one_each(things: &[NewThing], at: &[Where]) -> bool {
    let alike = |one: &Where, other: &Where| std::mem::discriminant(one) == std::mem::discriminant(other);
    let relation = |place: &Where| match place {
        Where::To(relation, _) => Some(*relation),
        _ => None,
    };
    things.iter().any(|thing| thing.many)
        && at.len() > 1
        && at.windows(2).all(|pair| alike(&pair[0], &pair[1]) && relation(&pair[0]) == relation(&pair[1]))
        && at
            .iter()
            .all(|place| matches!(place.anchor(), Some(Anchor::Thing(anchor)) if anchor.count == Count::One))
}

/// "One to the left and one to the right of the door": what is named last is meant before, if nothing else was.
pub(super) fn share_back(wishes: &mut [Vec<Wish>]) {
    let named = wishes.iter().flatten().find_map(|wish| match wish {
        Wish::Add { at, .. } => at.iter().find_map(Where::anchor).filter(|anchor| !anchor.is_it()),
        _ => None,
    });
    let Some(named) = named else { return };
    for wish in wishes.iter_mut().flatten() {
        let Wish::Add { at, .. } = wish else { return };
        for place in at.iter_mut() {
            match place {
                Where::To(_, anchor @ Anchor::It) => *anchor = named.clone(),
                place if place.anchor().is_some_and(|anchor| !anchor.is_it()) => return,
                _ => {}
            }
        }
    }
}

/// "Close Oak Street and put cones on it", "block Oak Street with a truck": the street is where things go.
pub(super) fn on_street(before: &Wish, wish: &mut Wish, with: bool) {
    // "Every bench gets a lamp behind it and a bin next to it".
    if let (Wish::Add { at: first, .. }, Wish::Add { at, .. }) = (before, &mut *wish)
        && let [Some(Anchor::Thing(each))] = &first.iter().map(Where::anchor).collect::<Vec<_>>()[..]
        && each.count == Count::All
    {
        for anchor in at.iter_mut().filter_map(Where::anchor_mut).filter(|anchor| anchor.is_it()) {
            *anchor = Anchor::Thing(each.clone());
        }
        return;
    }
    let Wish::Passage { which, .. } = before else { return };
    let [StreetRef::Named { roads, .. }] = &which[..] else { return };
    let street = Anchor::Street("that street".to_owned(), roads.clone());
    if let Wish::Add { at, .. } = wish
        && at.is_empty()
        && with
    {
        at.push(Where::Along(street.clone()));
    }
    for place in wish.places_mut() {
        let is_on = matches!(place, Where::To(simworld_core::scene::Relation::OnTopOf, _));
        if let Some(anchor) = place.anchor_mut().filter(|anchor| anchor.is_it()) {
            *anchor = street.clone();
            if is_on {
                *place = Where::Along(street.clone());
            }
        }
    }
}

/// Every word of these tables, for the spelling.
pub(super) fn words() -> impl Iterator<Item = &'static str> {
    EACH.iter().chain(LIKE).flat_map(|phrase| phrase.split(' '))
}
