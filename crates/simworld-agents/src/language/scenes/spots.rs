//! Where in a place something is: "in the north", "in the middle", "by the station".

use simworld_core::scene::Place;
use simworld_core::spec::{Water, Whereabouts};

use super::super::compass::{DIRECTIONS, MOST};
use super::super::lexer::{Lexeme, Token};
use super::super::lexicon::{category, longest, longest_phrase};
use super::super::numbers;
use super::words::{DISTRICTS, FACTS, Fact, LANDMARKS};

/// Parts that lie in no direction.
#[rustfmt::skip]
const PARTS: &[(&[&str], Whereabouts)] = &[
    (&["in the middle", "in the centre", "in the center", "in its middle", "in its centre", "in its center", "at the centre", "at the center", "in the heart", "at the heart", "at its heart", "in the very middle",
        "in the very centre", "in the town centre", "in the town center", "in the city centre", "in the city center", "in the inner city", "around the centre", "around the center", "in the core"], Whereabouts::Middle),
    (&["on the outskirts", "at the outskirts", "in the outskirts", "at the edge", "on the edge", "at the edges", "on the edges", "around the edge", "around the edges", "on the fringe", "on the fringes", "on its outskirts",
        "at its edge", "on its edge", "around the outside", "on the periphery"], Whereabouts::Outskirts),
];
/// Before a direction.
const IN: &[&str] = &[
    "in the",
    "to the",
    "on the",
    "at the",
    "towards the",
    "toward the",
    "in its",
    "to its",
    "on its",
    "up in the",
    "over in the",
    "off to the",
    "lying to the",
    "in the far",
    "along the",
];
/// Behind a direction.
const PART: &[&str] =
    &["part", "side", "end", "half", "quarter", "corner", "edge", "outskirts", "parts", "third"];
/// Of what a part is: the place itself.
const OF_IT: &[&str] = &[
    "of it",
    "of town",
    "of the town",
    "of the city",
    "of the place",
    "of the village",
    "of this town",
    "of the settlement",
    "of the harbour town",
];
/// Parts of something else: "in the middle of the night".
const OF_OTHERS: &[&str] =
    &["of the night", "of the day", "of winter", "of summer", "of autumn", "of spring", "of nowhere"];
/// Before what something is beside.
#[rustfmt::skip]
const BESIDE: &[&str] = &["by", "next to", "near", "near to", "beside", "along", "at", "close to", "opposite", "around", "on", "facing", "across from", "not far from", "alongside", "right by",
    "overlooking", "right next to", "directly at", "on the bank of", "on the banks of", "in front of", "behind"];
/// Articles before that.
const ARTICLES: &[&str] = &["the", "a", "an", "its", "this", "that"];
/// Between a part and what lies there: "in the north there are factories".
const FRONTED: &[&str] = &[
    "there is",
    "there are",
    "is",
    "are",
    "lies",
    "lie",
    "stands",
    "stand",
    "we have",
    "has",
    "have",
    "comes",
    "i want",
    "put",
    "a",
    "an",
    "the",
    "some",
];

/// Where something is: in a part of the place, beside something, or both.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Spot {
    pub(super) at: Whereabouts,
    pub(super) by: Option<Beside>,
}

/// What something is beside.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Beside {
    Water(Water),
    Landmark(&'static str),
    Use(Place),
    Square,
    Park,
}

impl Beside {
    /// Its name in a spec.
    pub(super) const fn name(self) -> &'static str {
        match self {
            Self::Water(water) => water.as_str(),
            Self::Landmark(name) => name,
            Self::Use(place) => place.as_str(),
            Self::Square => "square",
            Self::Park => "park",
        }
    }
}

/// Where something is, and how many words say so.
pub(super) fn spot(lexemes: &[Lexeme]) -> Option<(Spot, usize)> {
    let (mut spot, mut at) = (Spot::default(), 0);
    while let Some((more, words)) = part(&lexemes[at..]) {
        match more {
            Spot { by: Some(by), .. } if spot.by.is_none() => spot.by = Some(by),
            Spot { by: None, at } if spot.at == Whereabouts::Anywhere => spot.at = at,
            _ => break,
        }
        at += words;
    }
    (at > 0).then_some((spot, at))
}

/// One way to say where something is.
fn part(lexemes: &[Lexeme]) -> Option<(Spot, usize)> {
    if let Some((at, words)) = longest(lexemes, PARTS) {
        let after = &lexemes[words..];
        if longest_phrase(after, OF_OTHERS).is_some() {
            return None;
        }
        return Some((Spot { at, by: None }, words + longest_phrase(after, OF_IT).unwrap_or(0)));
    }
    by_compass(lexemes).or_else(|| beside(lexemes))
}

/// "In the north", "in the eastern part of the town".
fn by_compass(lexemes: &[Lexeme]) -> Option<(Spot, usize)> {
    let before = longest_phrase(lexemes, IN)?;
    let rest = &lexemes[before..];
    let (compass, words) = longest(rest, DIRECTIONS).or_else(|| longest(rest, MOST))?;
    let mut end = before + words;
    for tail in [PART, OF_IT] {
        end += longest_phrase(&lexemes[end..], tail).unwrap_or(0);
    }
    Some((Spot { at: Whereabouts::Towards(compass), by: None }, end))
}

/// "By the station", "along the river".
fn beside(lexemes: &[Lexeme]) -> Option<(Spot, usize)> {
    let before = longest_phrase(lexemes, BESIDE)?;
    let article = longest_phrase(&lexemes[before..], ARTICLES).unwrap_or(0);
    let (by, words) = thing(&lexemes[before + article..])?;
    Some((Spot { at: Whereabouts::Anywhere, by: Some(by) }, before + article + words))
}

/// What something may be beside, by the longest name.
fn thing(lexemes: &[Lexeme]) -> Option<(Beside, usize)> {
    let fact = longest(lexemes, FACTS).and_then(|(fact, words)| {
        let by = match fact {
            Fact::Water(water) => Beside::Water(water),
            Fact::Square(_) => Beside::Square,
            Fact::Park => Beside::Park,
            _ => return None,
        };
        Some((by, words))
    });
    let landmark = longest(lexemes, LANDMARKS).map(|(name, words)| (Beside::Landmark(name), words));
    let place = category(lexemes).and_then(|(class, words)| Some((class.place()?, words)));
    let place = place.filter(|(place, _)| *place != Place::Home);
    let place = place.map(|(place, words)| (Beside::Use(place), words));
    // Of names as long the first counts.
    let named = [fact, landmark, place].into_iter().flatten();
    named.reduce(|best, next| if next.1 > best.1 { next } else { best })
}

/// Whether what follows names something that may be put into a part of the place; a comma may come first where the part begins
/// what is said.
pub(super) fn names_thing(lexemes: &[Lexeme], begins: bool) -> bool {
    let comma = begins && lexemes.first().is_some_and(|lexeme| lexeme.token == Token::Comma);
    let mut at = usize::from(comma);
    loop {
        let rest = &lexemes[at..];
        let number = || numbers::number(rest).map(|(_, words)| words);
        match longest_phrase(rest, FRONTED).or_else(number) {
            Some(words) => at += words,
            None => break,
        }
    }
    let rest = &lexemes[at..];
    longest(rest, DISTRICTS).is_some() || thing(rest).is_some_and(|(by, _)| !matches!(by, Beside::Water(_)))
}

/// Every phrase here, so that none of its words is taken for a misspelling.
pub(super) fn phrases() -> impl Iterator<Item = &'static &'static str> {
    let parts = PARTS.iter().flat_map(|(words, _)| *words);
    let directions = DIRECTIONS.iter().chain(MOST).flat_map(|(words, _)| *words);
    parts.chain(directions).chain(IN).chain(PART).chain(OF_IT).chain(OF_OTHERS).chain(BESIDE)
}
