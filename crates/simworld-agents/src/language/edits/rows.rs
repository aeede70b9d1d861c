//! Rows: "a bench every twenty metres along Oak Street", "a ring of twelve cones around the fountain".

use simworld_core::seam::PlanError;

use super::super::lexer::{Lexeme, Token};
use super::super::lexicon::{longest, longest_phrase};
use super::super::numbers;
use super::super::phrases::Phrases;
use super::parse::Reader;
use super::wish::{Anchor, NewThing, Where, Wish};
use crate::editing::Spacing;

/// Before a distance.
#[rustfmt::skip]
const EVERY: &Phrases = &Phrases::of(&["every", "each", "one every", "one each", "at intervals of", "at an interval of", "in intervals of",
    "with intervals of", "with a gap of", "with gaps of", "with a spacing of", "with a distance of", "at a spacing of",
    "at distances of", "spaced every", "and one every", "with one every", "placed every", "spaced", "per", "one per", "for every", "one for every", "one to every", "once every", "a piece every"]);
/// Of those, the ones that may be of a distance from one thing.
#[rustfmt::skip]
pub(super) const GAPS: &Phrases = &Phrases::of(&["with a gap of", "with a distance of", "at a distance of", "leaving a gap of", "at a gap of", "in a distance of", "with a clearance of", "keeping a distance of", "at an interval of"]);
/// Behind a distance.
#[rustfmt::skip]
const APART: &Phrases = &Phrases::of(&["apart", "apart from each other", "from each other", "between them", "between each", "between each other",
    "intervals", "between", "in between", "from one another", "between each of them", "away from each other",
    "between one and the next", "apart from one another", "between every two"]);
/// That things stand in a line.
#[rustfmt::skip]
const ROWS: &Phrases = &Phrases::of(&["a row of", "a line of", "in a row", "in a line", "in an even row", "in an evenly spaced row", "in a neat row", "in one row", "in a single row", "in a tidy row", "in a long row", "in an even line", "in a neat line", "in even rows", "a straight line of", "a queue of", "in a straight line", "a chain of",
    "an avenue of", "in line", "rows of", "evenly spaced", "evenly",
    "evenly distributed", "at even distances", "at equal distances", "equally spaced", "at regular intervals", "spaced evenly",
    "evenly spread", "spread evenly", "lined up", "one after another", "one after the other",
    "at equal gaps", "with equal gaps", "at even gaps", "with even gaps", "at regular gaps", "with regular gaps", "with equal distances", "with even distances", "with regular distances", "at regular distances", "at equal spaces", "with equal spaces", "with even spaces", "with regular spaces",
    "at equal spacing", "at even spacing", "with equal spacing", "with even spacing", "with regular spacing", "at a regular spacing", "at equal intervals", "at even intervals", "with equal intervals", "with even intervals", "with regular intervals", "in equal intervals", "in even intervals", "in regular intervals",
    "in equal distances", "in even distances", "in regular distances", "with equal gaps between them", "with even gaps between them", "with equal spaces between them", "with equal space between them", "with even space between them", "with the same gap between them", "with the same space between them",
    "with the same distance between them", "with the same spacing", "with equal space in between", "with equal spaces in between", "equal distances apart", "equidistant", "equidistantly", "equally far apart", "spaced out evenly", "evenly spaced out", "spaced out equally", "equally distributed", "regularly spaced", "uniformly spaced"]);
/// That things stand in a circle.
#[rustfmt::skip]
const RINGS: &[&str] = &["a ring of", "a circle of", "in a ring", "in a circle", "ring of", "circle of"];
/// Behind a number at the end.
#[rustfmt::skip]
const OF_THEM: &[&str] = &["of them", "of those", "in all", "in total", "altogether", "pieces"];

/// What was said of the row, and the words that say the rest.
#[derive(Default)]
struct Said {
    every: Option<f64>,
    count: Option<u32>,
    in_line: bool,
    in_ring: bool,
    rest: Vec<Lexeme>,
}

impl Reader<'_> {
    /// Things at even distances, if the words up to the end say so.
    ///
    /// # Errors
    /// What it is along is not there.
    pub(super) fn rows(&self, end: usize) -> Result<Option<Vec<Vec<Wish>>>, PlanError> {
        let mut said = self.row_words(end);
        if said.every.is_none() && said.count.is_none() && !said.in_line && !said.in_ring {
            return Ok(None);
        }
        if said.in_line {
            from_to_between(&mut said.rest);
        }
        let mut reader = self.over(&said.rest);
        let stop = reader.before_politeness(0, said.rest.len());
        match reader.wish(stop) {
            Ok(wishes) if reader.at >= stop => {
                Ok(wishes.into_iter().map(|readings| said.as_rows(readings)).collect())
            }
            Err(error @ PlanError::NotFound { .. }) if said.every.is_some() => Err(error),
            _ => Ok(None),
        }
    }

    /// Takes the words about distances, rows and numbers out.
    fn row_words(&self, end: usize) -> Said {
        let mut said = Said::default();
        let mut at = self.at;
        while at < end {
            let rest = &self.lexemes[at..end];
            let words = spacing(rest).map(|(every, words)| {
                said.every = said.every.or(Some(every));
                words
            });
            let words = words
                .or_else(|| longest_phrase(rest, ROWS).inspect(|_| said.in_line = true))
                .or_else(|| longest_phrase(rest, RINGS).inspect(|_| said.in_ring = true))
                .or_else(|| {
                    let (count, words) = numbers::count(rest)?;
                    let more =
                        longest_phrase(&rest[words..], OF_THEM).filter(|more| words + more == rest.len())?;
                    said.count = Some(count);
                    Some(words + more)
                });
            if let Some(words) = words {
                at += words;
                // "Every ten metres of Harbour Road" is along it.
                if at < end && self.word(at) == Some("of") && said.every.is_some() {
                    said.rest.push(super::forms::word_at(&self.lexemes[at], "along"));
                    at += 1;
                }
            } else {
                said.rest.push(rest[0].clone());
                at += 1;
            }
        }
        while said.rest.last().is_some_and(|last| matches!(last.token, Token::Comma | Token::Break)) {
            said.rest.pop();
        }
        said
    }
}

impl Said {
    /// The readings of a wish as rows; nothing if a distance was named and it is none.
    fn as_rows(&self, readings: Vec<Wish>) -> Option<Vec<Wish>> {
        let rows: Vec<Wish> = readings.into_iter().filter_map(|wish| self.row(wish)).collect();
        (!rows.is_empty()).then_some(rows)
    }

    fn row(&self, wish: Wish) -> Option<Wish> {
        let Wish::Add { mut things, mut at } = wish else { return None };
        let ([thing], [line]) = (&mut things[..], &mut at[..]) else { return None };
        if let Some(count) = self.count {
            (thing.count, thing.many) = (count, false);
        }
        let spacing = self.every.map_or(Spacing::Count(thing.count), Spacing::Every);
        if thing.many && self.every.is_none() && !self.in_ring {
            // "A row of trees along Oak Street": as many as there is room for.
            *line = along(line.clone()).unwrap_or_else(|| line.clone());
            return Some(Wish::Add { things, at });
        }
        if self.every.is_some() {
            // "Two benches every twenty metres" is not understood, rather than half of it.
            let is_plain = thing.count == 1;
            *line = along(line.clone()).filter(|_| is_plain)?;
        } else if self.in_ring {
            *line = Where::Around(anchor_of(line)?);
            if thing.many {
                return Some(Wish::Add { things, at });
            }
        } else if let Some(line_up) = along(line.clone()) {
            *line = line_up;
        } else {
            // A row of trees before a house: as many as that, somewhere there.
            return Some(Wish::Add { things, at });
        }
        let (thing, line): (NewThing, Where) = (thing.clone(), line.clone());
        Some(Wish::Row { thing, line, spacing })
    }
}

/// The line that a place is, if things can be lined up there.
fn along(place: Where) -> Option<Where> {
    match place {
        Where::Along(_)
        | Where::Between(..)
        | Where::BothSides(_)
        | Where::Around(_)
        | Where::Compass(_, Anchor::Street(..)) => Some(place),
        Where::By(anchor)
        | Where::Edge(anchor)
        | Where::To(simworld_core::scene::Relation::NextTo, anchor) => Some(Where::Along(anchor)),
        Where::To(simworld_core::scene::Relation::OnTopOf, anchor @ Anchor::Street(..)) => {
            Some(Where::Along(anchor))
        }
        _ => None,
    }
}

fn anchor_of(place: &Where) -> Option<Anchor> {
    match place {
        Where::Around(anchor) | Where::By(anchor) | Where::To(_, anchor) | Where::Along(anchor) => {
            Some(anchor.clone())
        }
        _ => None,
    }
}

/// A distance from one to the next at the start of the words, m, and how many words say so.
fn spacing(lexemes: &[Lexeme]) -> Option<(f64, usize)> {
    let unit = |lexemes: &[Lexeme]| longest(lexemes, numbers::UNITS);
    if let Some(before) = longest_phrase(lexemes, EVERY)
        && let Some((every, words)) = numbers::length(&lexemes[before..]).or_else(|| unit(&lexemes[before..]))
    {
        let behind = &lexemes[before + words..];
        // "With a gap of ten metres to the tower" says where.
        if longest_phrase(lexemes, GAPS) == Some(before) && longest_phrase(behind, &["to", "from"]).is_some()
        {
            return None;
        }
        // "Every two metres between the kiosk and the statue" says where.
        let is_where = |after: &usize| {
            *after == 1 && longest_phrase(behind, &["between"]).is_some() && behind.len() > *after
        };
        let after = longest_phrase(behind, APART).filter(|after| !is_where(after)).unwrap_or(0);
        return Some((every, before + words + after));
    }
    let with = longest_phrase(lexemes, &["with", "leaving", "at", "in", "keep", "leave"]).unwrap_or(0);
    let (every, words) = numbers::length(&lexemes[with..])?;
    let after = longest_phrase(&lexemes[with + words..], APART)?;
    // "Two metres between the bench and the tree" is a place.
    let is_place = after == 1
        && matches!(&lexemes[with + words].token, Token::Word(word) if word == "between")
        && lexemes.len() > with + words + after;
    (!is_place).then_some((every, with + words + after))
}

/// "River Walk: a bench every 40 metres, both sides" is a bench every 40 metres on both sides of River Walk.
pub(super) fn on_both_sides(lexemes: &mut Vec<Lexeme>, streets: &super::super::streets::StreetNames) {
    #[rustfmt::skip]
    const BOTH: &Phrases = &Phrases::of(&["on both sides", "on either side", "on each side", "both sides", "along both sides", "at both sides", "to both sides", "left and right", "on the left and on the right", "on both sides of it", "on either side of it", "each side"]);
    const EVERY: &Phrases =
        &Phrases::of(&["every", "each", "per", "apart", "in a row", "in a line", "evenly"]);
    let is_mark = |lexeme: &Lexeme| matches!(lexeme.token, Token::Comma | Token::Break);
    let Some(place) = lexemes.first().cloned() else { return };
    if let Some(street) = streets.at(lexemes)
        && lexemes.get(street.words).is_some_and(is_mark)
        && (street.words..lexemes.len()).any(|at| longest_phrase(&lexemes[at..], EVERY).is_some())
        && (street.words..lexemes.len()).all(|at| streets.at(&lexemes[at..]).is_none())
    {
        let name: Vec<Lexeme> = lexemes.drain(..=street.words).take(street.words).collect();
        let end = lexemes.iter().rposition(|lexeme| !is_mark(lexeme)).map_or(0, |last| last + 1);
        let both = (0..end).find(|at| longest_phrase(&lexemes[*at..end], BOTH) == Some(end - at));
        let at =
            both.map_or(end, |both| if both > 0 && is_mark(&lexemes[both - 1]) { both - 1 } else { both });
        let along = super::forms::word_at(&place, "along");
        lexemes.splice(at..at, std::iter::once(along).chain(name));
    }
    let end = lexemes.iter().rposition(|lexeme| !is_mark(lexeme)).map_or(0, |last| last + 1);
    let Some(both) = (1..end).find(|at| longest_phrase(&lexemes[*at..end], BOTH) == Some(end - at)) else {
        return;
    };
    let named = (1..both).rev().find_map(|at| {
        let street = streets.at(&lexemes[at..both])?;
        let way = (at.saturating_sub(4)..at).find(|way| {
            longest(&lexemes[*way..at], &super::words::WAYS).is_some_and(|(_, words)| way + words == at)
        })?;
        Some((way, at, at + street.words))
    });
    if let Some((way, at, _)) = named {
        let from = if is_mark(&lexemes[both - 1]) { both - 1 } else { both };
        lexemes.drain(from..end);
        let sides: Vec<Lexeme> = super::forms::words_at(&place, "on both sides of").collect();
        lexemes.splice(way..at, sides);
    }
}

/// "From the bench to the tree" is between the two.
fn from_to_between(lexemes: &mut [Lexeme]) {
    let find = |lexemes: &[Lexeme], word: &str| {
        lexemes.iter().rposition(|lexeme| matches!(&lexeme.token, Token::Word(own) if own == word))
    };
    if let (Some(from), Some(to)) = (find(lexemes, "from"), find(lexemes, "to"))
        && from < to
    {
        lexemes[from].token = Token::Word("between".to_owned());
        lexemes[to].token = Token::Word("and".to_owned());
    }
}

/// Every word of these tables, for the spelling.
pub(super) fn words() -> impl Iterator<Item = &'static str> {
    EVERY.iter().chain(APART).chain(ROWS).chain(RINGS).chain(OF_THEM).flat_map(|phrase| phrase.split(' '))
}
