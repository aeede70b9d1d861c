//! Which of several things is meant that were told of before: "the other", "the western one", "the bigger of the two", "the third from the left",
//! "the one nearer to the chair".
//!
//! Only things of the set are looked at, and one is meant only if it stands out from all others of it; if none does, nothing decides.

use simworld_core::geometry::{Vector2, direction};
use simworld_core::id::EntityId;
use simworld_core::scene::EntityRef;

use super::super::compass::{DIRECTIONS, MOST};
use super::super::lexer::{is_mark, word_of};
use super::super::lexicon::{longest, longest_phrase};
use super::super::numbers;
use super::super::paint::{PAINTS, Paint};
use super::super::phrases::Phrases;
use super::super::relate::gap;
use super::parse::Reader;
use super::resolve::Finder;

/// As far or as near is what differs by less, m; as large what differs by less than this share.
const LEVEL: f64 = 0.05;
const ALIKE: f64 = 0.01;

/// By what one of several is told from the others.
#[derive(Clone, Copy)]
pub(super) enum By {
    /// The one that is farthest in a direction, world frame.
    Side(Vector2),
    /// The tallest or, with `false`, the shortest.
    Height(bool),
    /// The largest, or the smallest.
    Size(bool),
    /// The nearest to another thing.
    NearestTo(EntityId),
    /// The nearest to who speaks, or the farthest from them.
    Near(bool),
    /// The only one of a colour.
    Paint(Paint),
    /// The one in the middle of a row of an odd number.
    Middle,
    /// The nth, from 1, counted from the one that is farthest in a direction.
    Nth(usize, Vector2),
}

/// What may stand behind the words that tell which one is meant.
#[derive(Clone, Copy, PartialEq)]
enum Tail {
    /// "One", the noun or "of the two" must.
    Needed,
    /// They may: "the northernmost".
    Open,
    /// Nothing more is to be read.
    Read,
}

#[rustfmt::skip]
const MIDDLE: &Phrases = &Phrases::of(&["middle", "central", "centre", "center", "middlemost"]);
const IN_THE_MIDDLE: &Phrases =
    &Phrases::of(&["one in the middle", "one in the centre", "one in the center", "one between them"]);
#[rustfmt::skip]
const SIZES: &[(&[&str], By)] = &[
    (&["taller", "tallest", "higher", "highest"], By::Height(true)), (&["shorter", "shortest", "lower", "lowest"], By::Height(false)),
    (&["bigger", "biggest", "larger", "largest", "big", "large"], By::Size(true)), (&["smaller", "smallest", "small", "little", "tinier", "tiniest"], By::Size(false)),
];
/// As one looks, whether it is to the left.
const HANDS: &[(&[&str], bool)] = &[
    (&["left", "left hand", "leftmost", "left most", "far left"], true),
    (&["right", "right hand", "rightmost", "right most", "far right"], false),
];
#[rustfmt::skip]
const NEARER: &[(&[&str], bool)] = &[
    (&["nearer", "nearest", "closer", "closest"], true), (&["farther", "farthest", "further", "furthest", "more distant"], false),
];
/// Before what one of them is nearest to.
#[rustfmt::skip]
const NEARER_TO: &Phrases = &Phrases::of(&["nearer to", "nearest to", "closer to", "closest to", "one nearer to", "one nearest to", "one closer to", "one closest to", "one that is nearer to", "one that is nearest to", "one that is closer to", "one that is closest to", "one thats nearer to",
    "one thats closer to", "one which is nearer to", "one which is closer to", "one standing nearer to", "one standing closer to"]);
/// Who speaks.
const ME: &Phrases = &Phrases::of(&["me", "us", "you", "here", "where i am", "where i stand"]);
/// Before the side from which one counts.
#[rustfmt::skip]
const FROM: &Phrases = &Phrases::of(&["from the", "on the", "counting from the", "counted from the", "from", "from my", "counting from", "seen from the", "starting from the", "if you count from the", "from the far"]);
/// Behind what is said of one of them.
#[rustfmt::skip]
const OF_THEM: &Phrases = &Phrases::of(&["of the two", "of the three", "of the four", "of the five", "of them", "of these", "of those", "of these two", "of those two", "of both", "of the pair", "of the lot", "of the trio", "of all", "of all of them", "among them", "in the row"]);
/// Before all of them, named once more.
const OF: &Phrases = &Phrases::of(&["of the", "of those", "of these", "of our", "of all the", "among the"]);

impl Reader<'_> {
    /// Which of some things is meant from "the" on, none if nothing decides, and how many words that takes; nothing if none of them is
    /// told from the others here.
    pub(super) fn which_of(
        &self,
        at: usize,
        (things, noun): (&[EntityId], &str),
        finder: &Finder<'_>,
    ) -> Option<(Option<EntityId>, usize)> {
        if !matches!(self.word(at), Some("the" | "that")) {
            return None;
        }
        let (by, next, tail) = self.by_what(at + 1, finder)?;
        let end = match self.behind_one(next, noun) {
            _ if tail == Tail::Read => next,
            Some(end) => end,
            None if tail == Tail::Open && self.ends_thing_at(next) => next,
            None => return None,
        };
        Some((finder.picked(things, by), end - at))
    }

    /// By what one of several is told from the others, and where the words for it end.
    fn by_what(&self, at: usize, finder: &Finder<'_>) -> Option<(By, usize, Tail)> {
        let rest = self.lexemes.get(at..)?;
        if let Some(words) = longest_phrase(rest, IN_THE_MIDDLE) {
            return Some((By::Middle, at + words, Tail::Read));
        }
        if let Some(words) = longest_phrase(rest, MIDDLE) {
            return Some((By::Middle, at + words, Tail::Needed));
        }
        if let Some(words) = longest_phrase(rest, NEARER_TO) {
            return self.nearer_to(at + words, finder);
        }
        if let Some((near, words)) = longest(rest, NEARER) {
            return Some((By::Near(near), at + words, Tail::Needed));
        }
        if let Some((compass, words)) = longest(rest, MOST) {
            return Some((By::Side(compass.step()), at + words, Tail::Open));
        }
        if let Some((by, words)) = longest(rest, SIZES) {
            return Some((by, at + words, Tail::Open));
        }
        if let Some((left, words)) = longest(rest, HANDS) {
            return Some((By::Side(finder.hand(left)?), at + words, Tail::Needed));
        }
        if let Some((paint, words)) = longest(rest, PAINTS) {
            return Some((By::Paint(paint), at + words, Tail::Needed));
        }
        self.counted_from(at, finder)
    }

    /// What is said of one of them: "nearer to the chair", "the taller one"; by what it is told from the others, and where that ends.
    pub(super) fn said_to_be(&self, at: usize, finder: &Finder<'_>) -> Option<(By, usize)> {
        let the = usize::from(self.word(at) == Some("the"));
        self.by_what(at + the, finder).map(|(by, end, _)| (by, end))
    }

    /// "Nearer to the chair", "closest to me".
    fn nearer_to(&self, from: usize, finder: &Finder<'_>) -> Option<(By, usize, Tail)> {
        if let Some(words) = longest_phrase(self.lexemes.get(from..)?, ME) {
            return Some((By::Near(true), from + words, Tail::Read));
        }
        let (end, anchor) = self.anchor_at(from, finder)?;
        let end = (from + 1..=end).rev().find(|end| !is_mark(&self.lexemes[end - 1]))?;
        Some((By::NearestTo(anchor), end, Tail::Read))
    }

    /// "Third from the left", "second one from the west".
    fn counted_from(&self, at: usize, finder: &Finder<'_>) -> Option<(By, usize, Tail)> {
        let nth = numbers::ordinal(self.lexemes.get(at..)?)?;
        let one = if self.word(at + 1) == Some("one") { 1 } else { self.noun_at(at + 1).unwrap_or(0) };
        let from = at + 1 + one;
        let side = from + longest_phrase(self.lexemes.get(from..)?, FROM)?;
        let rest = self.lexemes.get(side..)?;
        let (way, words) = match longest(rest, HANDS) {
            Some((left, words)) => (finder.hand(left)?, words),
            None => longest(rest, DIRECTIONS).map(|(compass, words)| (compass.step(), words))?,
        };
        let end = side + words;
        let end = end + longest_phrase(self.lexemes.get(end..)?, &["side", "end"]).unwrap_or(0);
        Some((By::Nth(nth as usize, way), end, Tail::Read))
    }

    /// Where "one", the noun and "of the two" end, if any of them stands here.
    fn behind_one(&self, from: usize, noun: &str) -> Option<usize> {
        let mut at = from;
        if self.word(at) == Some("one") {
            at += 1;
        } else if let Some(words) = self.noun_at(at)
            && self.word(at + words - 1) == Some(noun)
        {
            at += words;
        }
        let rest = self.lexemes.get(at..).unwrap_or_default();
        let of_them = longest_phrase(rest, OF_THEM).unwrap_or(0);
        let named = self.named_again(at, noun).unwrap_or(0);
        at += of_them.max(named);
        (at > from).then_some(at)
    }

    /// "Of the three street lamps": how many words that takes.
    fn named_again(&self, at: usize, noun: &str) -> Option<usize> {
        let of = longest_phrase(self.lexemes.get(at..)?, OF)?;
        let number = numbers::count(self.lexemes.get(at + of..)?).map_or(0, |(_, words)| words);
        let from = at + of + number;
        let from = from + longest(self.lexemes.get(from..)?, PAINTS).map_or(0, |(_, words)| words);
        let words = self.noun_at(from)?;
        let last = self.lexemes.get(from + words - 1).map_or("", word_of);
        (last == super::follow::plural_of(noun)).then_some(from + words - at)
    }
}

impl Finder<'_> {
    /// To the left as one looks, or to the right, if somebody does.
    pub(super) fn hand(&self, left: bool) -> Option<Vector2> {
        self.focus.who?;
        let ahead = direction(self.view.heading);
        let to_left = Vector2::new(-ahead.y, ahead.x);
        Some(if left { to_left } else { -to_left })
    }

    /// The one of some things that stands out so; none if none does.
    pub(super) fn picked(&self, things: &[EntityId], by: By) -> Option<EntityId> {
        let sign = |most: bool| if most { 1.0 } else { -1.0 };
        match by {
            By::Side(way) => foremost(&self.ranked(things, along(way)), LEVEL, 0.0),
            By::Height(most) => {
                let height = |thing: &EntityRef<'_>| sign(most) * thing.info.shape.size().z;
                foremost(&self.ranked(things, height), 0.0, ALIKE)
            }
            By::Size(most) => {
                let volume = |thing: &EntityRef<'_>| {
                    let size = thing.info.shape.size();
                    sign(most) * size.x * size.y * size.z
                };
                foremost(&self.ranked(things, volume), 0.0, ALIKE)
            }
            By::NearestTo(anchor) => {
                let anchor = self.scene.entity(anchor)?;
                foremost(&self.ranked(things, |thing| -gap(&anchor, thing)), LEVEL, 0.0)
            }
            By::Near(near) => {
                let from = self.focus.from;
                let near_by = |thing: &EntityRef<'_>| -sign(near) * (thing.planar() - from).norm();
                foremost(&self.ranked(things, near_by), LEVEL, 0.0)
            }
            By::Paint(paint) => {
                let has = |id: &&EntityId| {
                    self.scene
                        .entity(**id)
                        .is_some_and(|thing| thing.info.color.map(Paint::of) == Some(paint))
                };
                let mut painted = things.iter().filter(has);
                let one = painted.next().copied();
                one.filter(|_| painted.next().is_none())
            }
            By::Middle => self.in_the_middle(things),
            By::Nth(nth, way) => {
                let ranked = self.ranked(things, along(way));
                let decides = are_apart(&ranked);
                ranked.get(nth.checked_sub(1)?).filter(|_| decides).map(|(_, id)| *id)
            }
        }
    }

    /// The one in the middle of an odd number, along the axis of the world on which they lie farthest apart.
    fn in_the_middle(&self, things: &[EntityId]) -> Option<EntityId> {
        let [by_east, by_north] = [Vector2::x(), Vector2::y()].map(|way| self.ranked(things, along(way)));
        let length = |ranked: &[(f64, EntityId)]| match ranked {
            [first, .., last] => first.0 - last.0,
            _ => 0.0,
        };
        let row = if length(&by_east) >= length(&by_north) { by_east } else { by_north };
        let is_odd = row.len() % 2 == 1 && row.len() > 1;
        row.get(row.len() / 2).filter(|_| is_odd && are_apart(&row)).map(|(_, id)| *id)
    }

    /// Things by a measure, the most first.
    fn ranked(&self, things: &[EntityId], measure: impl Fn(&EntityRef<'_>) -> f64) -> Vec<(f64, EntityId)> {
        let measured = |id: &EntityId| Some((measure(&self.scene.entity(*id)?), *id));
        let mut ranked: Vec<(f64, EntityId)> = things.iter().filter_map(measured).collect();
        ranked.sort_by(|one, other| other.0.total_cmp(&one.0));
        ranked
    }
}

/// How far a thing is in a direction, m.
fn along(way: Vector2) -> impl Fn(&EntityRef<'_>) -> f64 {
    move |thing: &EntityRef<'_>| thing.planar().coords.dot(&way)
}

/// The first of things by their measure, if it differs from the second by more than so much, and than so large a share of itself.
fn foremost(ranked: &[(f64, EntityId)], level: f64, share: f64) -> Option<EntityId> {
    let (first, rest) = ranked.split_first()?;
    let differs = rest.first().is_none_or(|next| first.0 - next.0 > level + share * first.0.abs());
    differs.then_some(first.1)
}

/// Whether no two things of a row are level.
fn are_apart(ranked: &[(f64, EntityId)]) -> bool {
    ranked.windows(2).all(|pair| pair[0].0 - pair[1].0 > LEVEL)
}

/// Every word of these tables, for the spelling.
pub(super) fn words() -> impl Iterator<Item = &'static str> {
    let phrases = [MIDDLE, IN_THE_MIDDLE, NEARER_TO, FROM, OF_THEM].into_iter().flatten();
    phrases.flat_map(|phrase| phrase.split(' '))
}
