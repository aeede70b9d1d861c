//! Sizes by measure and by other things: "six metres tall", "two metres taller", "as tall as the lab", "half the height of the statue".

use simworld_core::geometry::Vector3;
use simworld_core::id::EntityId;

use super::super::clause::Reference;
use super::super::lexer::is_mark;
use super::super::lexicon::{longest, longest_phrase};
use super::super::numbers;
use super::super::phrases::Phrases;
use super::parse::Reader;
use super::resolve::Finder;
use super::wish::{NewThing, Wish};
use crate::editing::{Edit, EditError, Make, Stock, called};

/// Which way something is measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Extent {
    Height,
    /// Its longer side on the ground.
    Length,
    /// Its longest side, whichever that is.
    Whole,
}

/// A size that something is to have.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Size {
    /// So many times what it is.
    Times(f64),
    /// So many metres.
    Metres(Extent, f64),
    /// So many metres more or, below zero, less.
    More(Extent, f64),
    /// So many times what another has.
    Like(Extent, f64, Box<Reference>),
}

/// Behind a length, or before it.
#[rustfmt::skip]
const EXTENTS: &[(&[&str], Extent)] = &[
    (&["tall", "high", "in height", "of height", "height", "upwards", "from top to bottom"], Extent::Height),
    (&["long", "wide", "across", "in length", "in width", "in diameter", "broad", "length", "width"], Extent::Length),
    (&["big", "large", "in size", "size"], Extent::Whole),
];
/// Before a length, which extent is meant.
#[rustfmt::skip]
const OF: &[(&[&str], Extent)] = &[
    (&["a height of", "the height of", "a total height of", "height of", "height to", "its height to", "a height to"], Extent::Height),
    (&["a length of", "a width of", "a diameter of", "the length of", "the width of"], Extent::Length),
    (&["a size of", "size to"], Extent::Whole),
];
/// Behind a length, by how much something is to be larger (1) or smaller (-1).
#[rustfmt::skip]
const MORE: &[(&[&str], (Extent, f64))] = &[
    (&["taller", "higher", "taller than now", "taller than it is", "higher than now"], (Extent::Height, 1.0)),
    (&["shorter", "lower", "less tall", "less high", "shorter than now", "shorter than it is"], (Extent::Height, -1.0)),
    (&["longer", "wider", "broader"], (Extent::Length, 1.0)),
    (&["narrower", "less wide"], (Extent::Length, -1.0)),
    (&["bigger", "larger"], (Extent::Whole, 1.0)),
    (&["smaller"], (Extent::Whole, -1.0)),
];
/// Before another thing, whose size is meant.
#[rustfmt::skip]
const LIKE: &[(&[&str], Extent)] = &[
    (&["as tall as", "as high as", "the same height as", "of the same height as", "at the same height as", "the height of", "equal in height to", "match the height of", "match the height",
        "level with", "the same height like", "just as tall as", "just as high as", "exactly as tall as", "exactly as high as", "height of", "no taller than", "equally tall as", "taller than"], Extent::Height),
    (&["as big as", "as large as", "the same size as", "of the same size as", "the size of", "match the size of", "just as big as", "exactly as big as", "just as large as", "as huge as", "size of",
        "the same size like", "no bigger than", "bigger than", "larger than"], Extent::Whole),
    (&["as long as", "as wide as", "the same length as", "the same width as", "the length of", "the width of"], Extent::Length),
];
/// Before that, how many times it.
#[rustfmt::skip]
const TIMES: &[(&[&str], f64)] = &[
    (&["twice", "double", "two times"], 2.0), (&["three times", "triple", "thrice"], 3.0), (&["four times"], 4.0), (&["half", "half of"], 0.5),
    (&["a third", "one third", "a third of"], 1.0 / 3.0), (&["a quarter", "one quarter", "a quarter of"], 0.25), (&["one and a half times"], 1.5),
];
/// Between a new thing and its size by another's.
const THAT_IS: &Phrases = &Phrases::of(&[
    "that is",
    "which is",
    "thats",
    "that are",
    "which are",
    "exactly",
    "of exactly",
    "that should be",
    "with",
    "about",
    "just",
]);
/// What says nothing before a size.
#[rustfmt::skip]
const SMALL: &Phrases = &Phrases::of(&["to", "to be", "be", "exactly", "about", "roughly", "just", "up to", "down to", "until it is", "so that it is", "so it is", "nearly", "almost", "to become", "become", "at", "of",
    "to have", "have", "to reach", "reach", "measure", "to measure", "measuring", "with", "only", "no more than", "it should be", "to its", "to a", "a", "to the"]);

impl Reader<'_> {
    /// A size by measure or by another thing, if all words up to the end say so.
    pub(super) fn measure(&self, at: usize, end: usize) -> Option<Size> {
        let end = self.before_politeness(at, end);
        let small = longest_phrase(&self.lexemes[at..end], SMALL).unwrap_or(0);
        let to = (at..at + small).any(|at| self.word(at) == Some("to"));
        let more = longest_phrase(&self.lexemes[at..end], &["by", "up by"]).unwrap_or(0);
        [0, small, more].into_iter().find_map(|skip| {
            let from = at + skip;
            self.in_metres(from, end, to && skip > 0).or_else(|| self.like_another(from, end))
        })
    }

    /// "Six metres tall", "a height of six metres", "two metres taller"; behind "to" six metres are a height.
    fn in_metres(&self, at: usize, end: usize, to: bool) -> Option<Size> {
        if let Some((extent, words)) = longest(&self.lexemes[at..end], OF) {
            let (metres, count) = numbers::length(&self.lexemes[at + words..end])?;
            return (at + words + count == end).then_some(Size::Metres(extent, metres));
        }
        let (metres, count) = numbers::length(&self.lexemes[at..end])?;
        let rest = &self.lexemes[at + count..end];
        if rest.is_empty() {
            return to.then_some(Size::Metres(Extent::Height, metres));
        }
        let whole = |words: usize| words == rest.len();
        if let Some((extent, _)) = longest(rest, EXTENTS).filter(|(_, words)| whole(*words)) {
            return Some(Size::Metres(extent, metres));
        }
        let ((extent, sign), _) = longest(rest, MORE).filter(|(_, words)| whole(*words))?;
        Some(Size::More(extent, metres * sign))
    }

    /// "As tall as the lab", "half the height of the statue".
    fn like_another(&self, at: usize, end: usize) -> Option<Size> {
        let (times, words) = longest(&self.lexemes[at..end], TIMES)
            .or_else(|| {
                let (number, words) = numbers::number(&self.lexemes[at..end])?;
                let times = longest_phrase(&self.lexemes[at + words..end], &["times"])?;
                Some((number, words + times))
            })
            .unwrap_or((1.0, 0));
        let like = at + words;
        let (extent, count) = longest(self.lexemes.get(like..end)?, LIKE)?;
        let than = self.word(like + count - 1) == Some("than");
        let from = like + count;
        // "Taller than the lab" leaves open by how much, but for so many times.
        if from >= end || than && words == 0 || !self.is_certain(from) {
            return None;
        }
        let other = self.one_of(from, end).ok().filter(|other| !super::says::is_it(other))?;
        Some(Size::Like(extent, times, Box::new(other)))
    }

    /// "Set the height of the statue to six metres".
    pub(super) fn measured(&self, start: usize, end: usize) -> Option<Wish> {
        #[rustfmt::skip]
        const SETS: &Phrases = &Phrases::of(&["set", "change", "adjust", "make", "bring", "put", "fix", "scale", "increase", "raise", "lower", "reduce", "let"]);
        let end = self.before_politeness(start, end);
        let at = start + longest_phrase(&self.lexemes[start..end], SETS)?;
        let (extent, words) = longest(&self.lexemes[at..end], LIKE)
            .filter(|_| matches!(self.word(at), Some("the" | "height" | "size")))?;
        let from = at + words;
        (from + 1..end).find_map(|cut| {
            let to = longest_phrase(&self.lexemes[cut..end], &["to", "to be", "be", "at", "to exactly"])?;
            let (metres, count) = numbers::length(&self.lexemes[cut + to..end])?;
            let what = self.things(from, cut).ok().filter(|_| cut + to + count == end)?;
            Some(Wish::Resize { what, size: Size::Metres(extent, metres) })
        })
    }

    /// How large a new thing is to be, "six metres tall", "with a height of six metres" or, behind its noun, "as tall as the lab", and how
    /// many words say so.
    pub(super) fn new_size(&self, is_first: bool, end: usize) -> Option<(Size, usize)> {
        let rest = self.rest(end);
        let with = longest_phrase(rest, &["with a height of", "of a height of", "with the height of"]);
        if let Some(words) = with
            && let Some((metres, count)) = numbers::length(&rest[words..])
        {
            return Some((Size::Metres(Extent::Height, metres), words + count));
        }
        if let Some((metres, words)) = numbers::length(rest)
            && let Some(tall) = longest_phrase(&rest[words..], &["tall", "high", "in height"])
        {
            return Some((Size::Metres(Extent::Height, metres), words + tall));
        }
        if is_first {
            return None;
        }
        let that_is = longest_phrase(rest, THAT_IS).unwrap_or(0);
        self.new_size_like(self.at + that_is, end).map(|(size, words)| (size, that_is + words))
    }

    /// "As tall as the lab", up to where the new thing stands: the lab is named by its shortest name.
    fn new_size_like(&self, at: usize, end: usize) -> Option<(Size, usize)> {
        let stop = self.before_politeness(at, end);
        let ends = |cut: &usize| {
            *cut == stop
                || is_mark(&self.lexemes[*cut])
                || self.is_place(*cut)
                || super::parse::joint(&self.lexemes[*cut..stop]).is_some()
        };
        let is_said = |from: usize| {
            longest(&self.lexemes[from..stop], LIKE).is_some()
                || longest(&self.lexemes[from..stop], TIMES)
                    .is_some_and(|(_, words)| longest(&self.lexemes[from + words..stop], LIKE).is_some())
        };
        if at >= stop || !is_said(at) {
            return None;
        }
        (at + 2..=stop)
            .filter(ends)
            .find_map(|cut| self.like_another(at, cut).map(|size| (size, cut - self.at)))
            .map(|(size, words)| (size, words - (at - self.at)))
    }
}

impl Reader<'_> {
    /// "If the lab is taller than the tower, ...", told before or behind.
    pub(super) fn given_larger(&mut self, end: usize) -> Option<Vec<Vec<Wish>>> {
        let start = self.at;
        (start..end).find_map(|at| {
            let words =
                longest_phrase(&self.lexemes[at..end], &["if", "unless", "only if", "provided", "in case"])?;
            let unless = self.word(at) == Some("unless");
            let from = at + words;
            let stop = (from..end).find(|at| super::super::lexer::is_mark(&self.lexemes[*at])).unwrap_or(end);
            let (one, extent, larger, next) = (from + 1..stop).find_map(|cut| {
                let is =
                    longest_phrase(&self.lexemes[cut..stop], &["is", "is not", "isnt", "are", "stands"])?;
                let not = (cut..cut + is).any(|at| matches!(self.word(at), Some("not" | "isnt")));
                let ((extent, sign), more) = longest(&self.lexemes[cut + is..stop], MORE)?;
                let than = longest_phrase(&self.lexemes[cut + is + more..stop], &["than"])?;
                let one = self.one_of(from, cut).ok()?;
                Some((one, extent, (sign > 0.0) != not, cut + is + more + than))
            })?;
            let other = self.one_of(next, self.before_politeness(next, stop)).ok()?;
            let (begin, last) = if at == start { (stop, end) } else { (start, at) };
            if at > start && stop < end {
                return None;
            }
            let wishes = self.wishes_between(begin, last).ok()?;
            let when = |wish| Wish::WhenLarger {
                one: one.clone(),
                other: other.clone(),
                extent,
                larger: larger != unless,
                then: Box::new(wish),
            };
            self.at = end;
            Some(vec![super::conditions::at_once(wishes).into_iter().map(when).collect()])
        })
    }
}

impl Finder<'_> {
    /// A wish, if one thing is larger than another or, with `false`, is not.
    pub(super) fn when_larger(
        &self,
        (one, other): (&Reference, &Reference),
        (extent, larger): (Extent, bool),
        then: &Wish,
    ) -> Result<Vec<Edit>, EditError> {
        let (one, other) = (self.one(one)?, self.one(other)?);
        if (self.extent_of(one, extent) > self.extent_of(other, extent)) != larger {
            let label = |id: EntityId| {
                self.scene.entity(id).map_or_else(String::new, |thing| called(self.scene, &thing))
            };
            let why = format!("nothing was changed: it is not so of {} and {}", label(one), label(other));
            return Ok(vec![Edit::Leave { why }]);
        }
        let focus = self.focus_on(Some(one));
        let view = super::view_of(self.scene, &focus);
        self.looking_with(&focus, view).edits(then)
    }

    /// Each of some things in the size that was asked for.
    pub(super) fn resized(&self, what: &[Reference], size: &Size) -> Result<Vec<Edit>, EditError> {
        let like = match size {
            Size::Like(extent, times, other) => Some(self.extent_of(self.one(other)?, *extent) * times),
            _ => None,
        };
        let resize = |thing: EntityId| {
            let factor = match size {
                Size::Times(factor) => *factor,
                Size::Metres(extent, metres) => metres / self.extent_of(thing, *extent),
                Size::More(extent, metres) => {
                    let now = self.extent_of(thing, *extent);
                    (now + metres) / now
                }
                Size::Like(extent, ..) => like.unwrap_or(1.0) / self.extent_of(thing, *extent),
            };
            if !factor.is_finite() || factor <= 0.0 {
                let what = "to be of that size".to_owned();
                return Err(EditError::Impossible { what, why: "nothing would be left of it".to_owned() });
            }
            Ok(Edit::Scale { things: vec![thing], factor })
        };
        self.all(what)?.into_iter().map(resize).collect()
    }

    fn extent_of(&self, thing: EntityId, extent: Extent) -> f64 {
        self.scene.entity(thing).map_or(f64::NAN, |entity| extent.of(entity.info.shape.size()))
    }
}

impl Extent {
    fn of(self, size: Vector3) -> f64 {
        match self {
            Self::Height => size.z,
            Self::Length => size.x.max(size.y),
            Self::Whole => size.max(),
        }
    }
}

impl Finder<'_> {
    /// What is to be made, as large as the thing is now that its size was told by.
    pub(super) fn made(&self, thing: &NewThing) -> Result<Make, EditError> {
        let Some(Size::Like(extent, times, other)) = &thing.size else { return thing.make(self.stock) };
        let metres = self.extent_of(self.one(other)?, *extent) * times;
        NewThing { size: Some(Size::Metres(*extent, metres)), ..thing.clone() }.make(self.stock)
    }
}

impl NewThing {
    /// Over its asset's size, where so many metres were asked for.
    pub(super) fn scale_of(&self, asset: &str, scale: f64, stock: &Stock) -> f64 {
        let found = stock.catalogue.find(asset).and_then(|id| stock.catalogue.get(id));
        match (&self.size, found) {
            (Some(Size::Metres(extent, metres)), Some(asset)) => metres / extent.of(asset.collider.size()),
            _ => scale,
        }
    }
}

/// Every word of these tables, for the spelling.
pub(super) fn words() -> impl Iterator<Item = &'static str> {
    let extents = EXTENTS.iter().chain(OF).chain(LIKE).flat_map(|(words, _)| *words);
    let more = MORE.iter().flat_map(|(words, _)| *words);
    let times = TIMES.iter().flat_map(|(words, _)| *words);
    extents.chain(more).chain(times).copied().flat_map(|phrase| phrase.split(' '))
}
