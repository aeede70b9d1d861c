//! New things: the noun phrase of what is to be made, and lists of them with their places.

use simworld_core::scene::EntityKind;
use simworld_core::seam::PlanError;

use super::super::clause::{Reference, Target};
use super::super::lexer::{Lexeme, Token};
use super::super::lexicon::{longest, longest_phrase};
use super::super::numbers;
use super::super::paint::PAINTS;
use super::super::phrases::Phrases;
use super::parse::{Reader, joint};
use super::wish::{Anchor, NewThing, Where, Wish};
use super::words::{FACTORS, SIZES};

/// Articles and the like before a new thing.
#[rustfmt::skip]
pub(super) const ARTICLES: &Phrases = &Phrases::of(&["a", "an", "some", "another", "one", "the", "one more", "a new", "new", "a single",
    "yet another", "a few", "a second", "a third", "a fourth", "a fifth", "a further", "an extra", "an additional", "a pair of", "a couple of", "me", "us", "of", "up", "down", "a row of", "a line of",
    "a group of", "a bunch of", "any", "also", "like", "maybe", "about", "to see", "to have", "in", "also a",
    "around", "see", "please", "yet another", "one more of", "just one", "just a", "possibly", "ideally", "preferably"]);

/// Between new things and the place of all of them.
const ALL_OF_THEM: &[&str] =
    &["all", "both", "all of them", "both of them", "each", "all of those", "each of them"];

impl Reader<'_> {
    /// New things and where they stand, in groups: "two benches and a bin next to the fountain and a tree behind it".
    pub(super) fn additions(&mut self, end: usize) -> Result<Vec<Vec<Wish>>, PlanError> {
        let mut wishes = Vec::new();
        let mut anchor: Option<Anchor> = None;
        let mut last: Option<NewThing> = None;
        let there = self.there_first(end);
        while self.at < end {
            if anchor.is_some() && self.is_bare_singular(end) {
                return Err(self.not_understood("say \"next to\" again, or \"a\" before what is to be made"));
            }
            let is_joined = self.at > 0 && matches!(self.word(self.at - 1), Some("and" | "also" | "plus"));
            let things = self.listed(last.as_ref(), end)?;
            let whose = self.for_whom(end);
            let from = self.at;
            self.skip_to_place(end);
            if whose.is_some() {
                anchor.clone_from(&whose);
            }
            if let Some(each) = self.each_place(end) {
                let things: Vec<NewThing> = things.iter().map(NewThing::not_many).collect();
                last = things.last().cloned();
                wishes.extend(at_each_place(&things, each));
                self.skip_joints_to(end);
                continue;
            }
            let at = self.place_of_new(from, whose, &mut anchor, end)?;
            // "A slide in Rose Park, and a seesaw": there too.
            let shared = || match wishes.last().and_then(|wish: &Vec<Wish>| wish.first()) {
                Some(Wish::Add { at, .. }) if is_joined => Some(at.clone()),
                _ => None,
            };
            let at = at.or_else(|| there.clone()).or_else(shared).unwrap_or_default();
            // "Three barrels next to the kiosk in red, white and blue".
            let things = match &things[..] {
                [only] if self.at < end => self.in_colours(only, end).unwrap_or(things),
                _ => things,
            };
            if at.iter().any(Where::is_step) {
                return Err(self.not_understood("say from what it is so far"));
            }
            last = things.last().cloned();
            if wishes.is_empty() && self.is_heading_of(&things, &at) {
                return Err(self.not_understood("say how many"));
            }
            // "Benches: one by the fountain, one by the kiosk".
            let is_topic =
                wishes.is_empty() && at.is_empty() && things.len() == 1 && self.is_topic(last.as_ref(), end);
            if is_topic {
                last = last.map(|thing| NewThing { count: 1, many: false, ..thing });
            } else if super::shared::is_one_each(&things, &at) {
                let things: Vec<NewThing> = things.iter().map(NewThing::not_many).collect();
                wishes.extend(at_each_place(&things, at));
            } else {
                wishes.push(vec![Wish::Add { things, at }]);
            }
            self.skip_joints_to(end);
        }
        if self.is_heading_alone(&wishes, end) {
            return Err(self.not_understood("say how many"));
        }
        super::shared::share_back(&mut wishes);
        if wishes.is_empty() { Err(self.not_understood("say what to add")) } else { Ok(wishes) }
    }

    /// Passes what stands between new things and their place: "a tent and a bench, both by the tree".
    fn skip_to_place(&mut self, end: usize) {
        if joint(self.rest(end)).is_none() || self.is_place(self.at) {
            return;
        }
        self.skip_joints_to(end);
        let all = longest_phrase(self.rest(end), ALL_OF_THEM).unwrap_or(0);
        self.at += if self.is_place((self.at + all).min(end)) { all } else { 0 };
    }

    /// Where new things go whose names end at `from`, if that is told: what stands here, or beside whose they are to be.
    fn place_of_new(
        &mut self,
        from: usize,
        whose: Option<Anchor>,
        anchor: &mut Option<Anchor>,
        end: usize,
    ) -> Result<Option<Vec<Where>>, PlanError> {
        if self.at >= end || !self.is_place(self.at) {
            self.at = from;
            return Ok(whose.map(|whose| vec![Where::By(whose)]));
        }
        let mut at = self.places(end)?;
        // "A tree behind the school and a bench in front of it": of the school.
        for place in &mut at {
            // "Two benches in the park and a bin between them": of the benches.
            if matches!(place, Where::Between(one, other) if one.is_it() && other.is_it()) {
                continue;
            }
            if !super::places::is_of_the_new(place, anchor.as_ref(), |thing| self.is_large(thing)) {
                place.means(anchor);
            }
        }
        Ok(Some(at))
    }

    /// "Benches: turn the red one around" asks for none.
    fn is_heading_alone(&self, wishes: &[Vec<Wish>], end: usize) -> bool {
        let [readings] = wishes else { return false };
        let [Wish::Add { things, at }] = &readings[..] else { return false };
        let colon = end > 0 && self.words[self.lexemes[end - 1].end..].trim_start().starts_with(':');
        at.is_empty() && things.iter().all(|thing| thing.many) && colon
    }

    /// "Deliveries to the hall: a pallet behind it" asks for no deliveries.
    fn is_heading_of(&self, things: &[NewThing], at: &[Where]) -> bool {
        !at.is_empty()
            && things.iter().all(|thing| thing.many)
            && self.at > 0
            && self.words[self.lexemes[self.at - 1].end..].trim_start().starts_with(':')
    }

    /// New things that share a place: "two benches, a bin and a lamp", "a table a lamp and a bin".
    pub(super) fn listed(&mut self, last: Option<&NewThing>, end: usize) -> Result<Vec<NewThing>, PlanError> {
        let mut things = match self.coloured_each(end) {
            Some(things) => things,
            None => vec![self.another(end, last).map_or_else(|| self.new_thing(end), Ok)?],
        };
        if let [only] = &things[..]
            && let Some(each) = self.in_colours(&only.clone(), end)
        {
            things = each;
        }
        while let Some(count) = joint(self.rest(end)).or_else(|| begins_another(self.rest(end)).then_some(0))
        {
            // "With a gap of ten metres" is where.
            if self.is_place(self.at) {
                break;
            }
            let start = self.at;
            self.at += count;
            self.skip_joints_to(end);
            // "Five students, all of them near the statue".
            let is_all = longest_phrase(self.rest(end), ALL_OF_THEM)
                .is_some_and(|words| self.is_place((self.at + words).min(end)));
            let is_more = || is_all || Reader { ..*self }.another(end, things.last()).is_some();
            if self.at >= end || self.is_place(self.at) || is_more() {
                self.at = start;
                break;
            }
            things.push(self.new_thing(end)?);
        }
        Ok(things)
    }

    /// "Plant there two palm trees": the place before them, which it passes.
    fn there_first(&mut self, end: usize) -> Option<Vec<Where>> {
        let is_there = matches!(self.word(self.at), Some("there" | "here"))
            && (!self.is_definite(self.at + 1) || self.is_bare_plural(self.at + 1, end));
        let there = if is_there { self.places_to(self.at, self.at + 1) } else { None };
        self.at += usize::from(there.is_some());
        there
    }

    /// Whether a thing is a building or an area.
    fn is_large(&self, thing: &Reference) -> bool {
        match &thing.target {
            Target::Any(class) => class.is_place() || class.is_area(),
            Target::Named(ids) => ids
                .iter()
                .filter_map(|id| self.view.scene.entity(*id))
                .any(|entity| matches!(entity.kind, EntityKind::Building | EntityKind::Ground)),
            _ => false,
        }
    }

    /// Whether what was named is only what "one" stands for behind it.
    fn is_topic(&self, last: Option<&NewThing>, end: usize) -> bool {
        let mut next = *self;
        next.skip_joints_to(end);
        next.at > self.at && next.another(end, last).is_some()
    }

    /// "Another one": as the thing before.
    pub(super) fn another(&mut self, end: usize, last: Option<&NewThing>) -> Option<NewThing> {
        let last = last?;
        let count = longest_phrase(
            self.rest(end),
            &[
                "another one",
                "one more",
                "another",
                "a second one",
                "one",
                "a third one",
                "the other one",
                "the other",
            ],
        )
        .map(|words| (1, words));
        // "Benches: ten along the museum".
        let (number, count) = count.or_else(|| numbers::count(self.rest(end)))?;
        let next = self.at + count;
        let is_for = self.word(next) == Some("for") && next + 1 < end && self.is_certain(next + 1);
        if !self.is_place(next) && !is_for {
            return None;
        }
        self.at += count;
        Some(NewThing { count: number, many: false, ..last.clone() })
    }

    /// "A parasol for the café": whose it is to be, if that is a thing of the scene.
    fn for_whom(&mut self, end: usize) -> Option<Anchor> {
        if self.word(self.at) != Some("for") || !self.is_certain(self.at + 1) {
            return None;
        }
        let mut parser = self.parser(self.at + 1, self.before_politeness(self.at, end));
        let thing = parser.reference(0).ok()?;
        let after = parser.at;
        let ends =
            after >= self.before_politeness(self.at, end) || self.is_joint(after) || self.is_place(after);
        ends.then(|| {
            self.at = after;
            Anchor::Thing(thing)
        })
    }

    /// "Next to the fountain, statue and kiosk": a noun without an article, behind a place, is no new thing.
    fn is_bare_singular(&self, end: usize) -> bool {
        let rest = self.rest(end);
        longest_phrase(rest, ARTICLES).is_none()
            && numbers::number(rest).is_none()
            && longest(rest, PAINTS).is_none()
            && longest(rest, &SIZES).is_none()
            && !self.is_bare_plural(self.at, end)
    }
}

/// The same new things at each of several places.
fn at_each_place(things: &[NewThing], places: Vec<Where>) -> impl Iterator<Item = Vec<Wish>> {
    places.into_iter().map(|place| vec![Wish::Add { things: things.to_vec(), at: vec![place] }])
}

/// Whether one more thing is named, with nothing between it and the one before.
pub(super) fn begins_another(lexemes: &[Lexeme]) -> bool {
    let in_words = lexemes.first().is_some_and(|lexeme| matches!(lexeme.token, Token::Word(_)));
    let is_size = longest(lexemes, &FACTORS).is_some()
        || longest_phrase(
            lexemes,
            &["a bit", "a little", "a lot", "a tad", "a metre", "a meter", "a bit of"],
        )
        .is_some();
    in_words
        && !is_size
        && numbers::length(lexemes).is_none()
        && (longest_phrase(lexemes, &["a", "an"]).is_some() || numbers::count(lexemes).is_some())
}
