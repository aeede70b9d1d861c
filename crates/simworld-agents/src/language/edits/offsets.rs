//! Places with a distance: "10 metres north of the bench", "two metres to the left of the statue", "within 5 metres of the
//! fountain"; and where two streets meet.

use simworld_core::scene::Relation;
use simworld_core::seam::PlanError;

use super::super::lexicon::{longest, longest_phrase};
use super::super::numbers;
use super::super::phrases::Phrases;
use super::parse::Reader;
use super::wish::{Bearing, Where};
use super::words::{WAYS, Way};

/// What stands between a distance and the thing from which it is.
const FROM: &[&str] =
    &["from", "away from", "off", "apart from", "distant from", "of distance from", "away of"];
/// At most so far.
#[rustfmt::skip]
const WITHIN: &[&str] = &["within", "at most", "not more than", "no more than", "no farther than", "less than",
    "not farther than"];
/// At least so far.
#[rustfmt::skip]
const BEYOND: &[&str] = &["at least", "more than", "no less than", "not less than", "no closer than", "farther than",
    "no nearer than"];
/// Behind a distance, that it is the least.
#[rustfmt::skip]
const OR_MORE: &Phrases = &Phrases::of(&["or more", "or further", "or farther", "or so at least", "and more", "or upwards", "or above", "or over", "or beyond", "at least", "at the least", "at the very least", "minimum", "at a minimum", "as a minimum", "and up"]);
/// Behind a distance, that it is the greatest.
#[rustfmt::skip]
const OR_LESS: &Phrases = &Phrases::of(&["or less", "or nearer", "or closer", "or under", "or below", "at most", "at the most", "at the very most", "maximum", "at a maximum", "as a maximum", "tops"]);
/// What stands between a greatest distance and the thing.
const OF: &[&str] = &["of", "from", "away from", "around", "off", "to"];
/// As far beyond a least distance as is looked, m.
const REACH: f64 = 60.0;
/// Where streets meet.
#[rustfmt::skip]
const JUNCTIONS: &Phrases = &Phrases::of(&["at the corner of", "on the corner of", "at the intersection of", "at the junction of",
    "at the crossing of", "at the crossroads of", "on the intersection of", "near the corner of",
    "near the intersection of", "by the corner of", "at the corner between", "at the corner where", "where",
    "at the point where", "by the intersection of", "by the junction of", "at the place where", "on the corner where",
    "next to the intersection of", "near the junction of", "at the spot where", "at corner of"]);
/// Between the names of two streets that meet.
#[rustfmt::skip]
const AND: &Phrases = &Phrases::of(&["and", "meets", "crosses", "joins", "and the", "runs into", "intersects", "with", "hits", "meets with"]);
/// Behind them.
const MEET: &[&str] = &["meet", "cross", "join", "intersect", "come together", "meet each other"];
/// As a thing itself is turned.
const OWN: &[(&[&str], (f64, f64))] = &[
    (&["forward", "forwards", "ahead", "to the front", "straight ahead"], (1.0, 0.0)),
    (&["back", "backward", "backwards", "to the back"], (-1.0, 0.0)),
    (&["to the left", "left", "leftwards", "to its left"], (0.0, 1.0)),
    (&["to the right", "right", "rightwards", "to its right"], (0.0, -1.0)),
];

impl Reader<'_> {
    /// Whether a distance from something, or within which it is, begins at a token.
    pub(super) fn begins_offset(&self, at: usize) -> bool {
        let rest = &self.lexemes[at.min(self.lexemes.len())..];
        if let Some(gap) = longest_phrase(rest, super::rows::GAPS)
            && let Some((_, words)) = numbers::length(&rest[gap..])
        {
            return longest_phrase(&rest[gap + words..], &["to", "from"]).is_some();
        }
        let before = longest_phrase(rest, WITHIN).or(longest_phrase(rest, BEYOND)).unwrap_or(0);
        let Some((_, words)) = numbers::length(&rest[before..]) else { return false };
        self.is_bounded(at + words)
            || before > 0
            || self.direction_at(at + words).is_some()
            || longest(&rest[words..], OWN).is_some()
    }

    /// What direction, or none in particular, stands behind a distance, and how many words say so up to the thing.
    fn direction_at(&self, at: usize) -> Option<(Option<Bearing>, usize)> {
        let rest = &self.lexemes[at.min(self.lexemes.len())..];
        if let Some(words) = longest_phrase(rest, FROM) {
            return Some((None, words));
        }
        let mut parser = self.parser(at, self.lexemes.len());
        parser.eat_any(&["to the", "on the", "due", "further", "straight"]);
        if let Some(compass) = parser.compass() {
            parser.eat_any(&["side"]);
            return parser
                .eat_any(&["of", "from"])
                .then_some((Some(Bearing::Compass(compass)), parser.at - at));
        }
        match longest(rest, &WAYS) {
            Some((Way::To(relation), words)) if side(relation) => {
                Some((Some(Bearing::Side(relation)), words))
            }
            _ => None,
        }
    }

    /// A distance from something, if one stands here.
    pub(super) fn offset(&mut self, end: usize) -> Result<Option<Where>, PlanError> {
        let start = self.at;
        if self.eat_any(WITHIN)
            && let Some((most, words)) = numbers::length(self.rest(end))
        {
            self.at += words;
            if self.eat_any(OF) {
                return Ok(Some(Where::Apart(0.0, most, self.anchor(end)?)));
            }
        }
        self.at = start;
        if self.eat_any(BEYOND)
            && let Some((least, words)) = numbers::length(self.rest(end))
        {
            self.at += words;
            if self.eat_any(FROM) {
                return Ok(Some(Where::Apart(least, least + REACH, self.anchor(end)?)));
            }
        }
        self.at = start;
        if self.eat_any(super::rows::GAPS)
            && let Some((gap, words)) = numbers::length(self.rest(end))
        {
            self.at += words;
            if self.eat_any(&["to", "from"]) {
                return Ok(Some(Where::Apart((gap - 0.25).max(0.0), gap + 0.25, self.anchor(end)?)));
            }
        }
        self.at = start;
        self.eat_any(&["by", "at a distance of", "at"]);
        let Some((distance, words)) = numbers::length(self.rest(end)) else {
            self.at = start;
            return Ok(None);
        };
        let from = self.at + words;
        if let Some(place) = self.bounded(distance, from, end)? {
            return Ok(Some(place));
        }
        if let Some((bearing, words)) = self.direction_at(from) {
            self.at = from + words;
            let anchor = self.anchor(end)?;
            return Ok(Some(match bearing {
                Some(bearing) => Where::Offset(distance, bearing, anchor),
                None => Where::Apart((distance - 0.25).max(0.0), distance + 0.25, anchor),
            }));
        }
        if let Some(((forward, left), words)) = longest(&self.lexemes[from..end], OWN) {
            self.at = from + words;
            return Ok(Some(Where::ShiftOwn(forward * distance, left * distance)));
        }
        self.at = start;
        Ok(None)
    }

    /// Whether a bound on a distance stands here, and what it is from behind it.
    fn is_bounded(&self, at: usize) -> bool {
        let rest = &self.lexemes[at.min(self.lexemes.len())..];
        longest_phrase(rest, OR_MORE)
            .or_else(|| longest_phrase(rest, OR_LESS))
            .is_some_and(|words| longest_phrase(&rest[words..], FROM).is_some())
    }

    /// "... or more from the river", behind a distance, m.
    fn bounded(&mut self, distance: f64, at: usize, end: usize) -> Result<Option<Where>, PlanError> {
        if !self.is_bounded(at) {
            return Ok(None);
        }
        self.at = at;
        let is_least = self.eat_any(OR_MORE);
        let is_bound = is_least || self.eat_any(OR_LESS);
        if !is_bound || !self.eat_any(FROM) {
            return Ok(None);
        }
        let (least, most) = if is_least { (distance, distance + REACH) } else { (0.0, distance) };
        Ok(Some(Where::Apart(least, most, self.anchor(end)?)))
    }

    /// Whether the meeting of two streets begins at a token.
    pub(super) fn begins_junction(&self, at: usize) -> bool {
        self.junction_at(at, self.lexemes.len()).is_some()
    }

    /// Where two streets meet, if that stands here.
    pub(super) fn junction(&mut self, end: usize) -> Option<Where> {
        let (place, after) = self.junction_at(self.at, end)?;
        self.at = after;
        Some(place)
    }

    fn junction_at(&self, at: usize, end: usize) -> Option<(Where, usize)> {
        let streets = self.view.streets?;
        let words = |at: usize| &self.lexemes[at.min(end)..end];
        let mut at = at + longest_phrase(words(at), JUNCTIONS)?;
        at += longest_phrase(words(at), &["the"]).unwrap_or(0);
        // "Close Elm Street and put a cone where it meets Station Road".
        let it = longest_phrase(words(at), &["it", "this street", "that street", "the street"]);
        let said = it.and_then(|words| {
            let named = (0..at).rev().find_map(|before| streets.at(&self.lexemes[before..at]))?;
            Some((named, words))
        });
        let (one, count) = match said {
            Some((named, words)) => (named, words),
            None => streets.in_short(words(at)).map(|one| (one, one.words))?,
        };
        at += count;
        at += longest_phrase(words(at), AND)?;
        at += longest_phrase(words(at), &["the"]).unwrap_or(0);
        let other = streets.in_short(words(at))?;
        at += other.words;
        at += longest_phrase(words(at), &["streets", "roads"]).unwrap_or(0);
        at += longest_phrase(words(at), MEET).unwrap_or(0);
        let named = format!("{} and {}", one.name, other.name);
        Some((Where::Junction(one.roads.to_vec(), other.roads.to_vec(), named), at))
    }
}

/// Whether it is one of the four sides of a thing.
const fn side(relation: Relation) -> bool {
    matches!(relation, Relation::InFrontOf | Relation::Behind | Relation::LeftOf | Relation::RightOf)
}

/// Every word of these tables, for the spelling.
pub(super) fn words() -> impl Iterator<Item = &'static str> {
    let own = OWN.iter().flat_map(|(words, _)| *words).copied();
    let phrases = FROM
        .iter()
        .chain(WITHIN)
        .chain(BEYOND)
        .chain(OR_MORE)
        .chain(OR_LESS)
        .chain(JUNCTIONS)
        .chain(AND)
        .chain(MEET)
        .copied();
    phrases.chain(own).flat_map(|phrase| phrase.split(' '))
}
