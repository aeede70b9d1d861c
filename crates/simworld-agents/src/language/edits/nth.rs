//! Which of every second one is the first: "every other lamp, starting with the southernmost".

use simworld_core::geometry::Point2;
use simworld_core::id::EntityId;

use super::super::clause::{Choice, Count, First, Reference};
use super::super::lexer::{Lexeme, Token, is_mark};
use super::super::lexicon::{category, longest, longest_phrase};
use super::super::numbers;
use super::super::phrases::Phrases;
use super::resolve::Finder;
use super::wish::Wish;

/// Before the first of them.
#[rustfmt::skip]
const STARTS: &Phrases = &Phrases::of(&["starting with", "starting from", "starting at", "starting in", "beginning with", "beginning from", "beginning at", "beginning in", "start with", "start from", "start at",
    "start in", "begin with", "begin from", "begin at", "begin in", "counting from", "counted from", "starting on", "beginning on", "with", "starting off with", "starting off in", "as from", "from"]);
/// Of those, the words that say so only behind "every second".
const WEAK: &[&str] = &["with", "from"];
/// Behind it.
#[rustfmt::skip]
const BEHIND: &Phrases = &Phrases::of(&["one", "end", "side", "of them", "of all", "one first", "of the row", "one of them", "end of the row"]);

/// Takes the words out that say which of every second one is the first.
pub(super) fn first_of(lexemes: &mut Vec<Lexeme>) -> Option<First> {
    let every = (0..lexemes.len()).any(|at| {
        longest_phrase(&lexemes[at..], &["every", "each"])
            .is_some_and(|words| numbers::ordinal(&lexemes[at + words..]).is_some())
    });
    if !every {
        return None;
    }
    let (from, to, first) = (0..lexemes.len()).find_map(|at| {
        let starts = longest_phrase(&lexemes[at..], STARTS)?;
        let is_weak = longest_phrase(&lexemes[at..], WEAK) == Some(starts);
        let mut next = at + starts;
        next += longest_phrase(&lexemes[next..], &["the", "those in the", "what is"]).unwrap_or(0);
        let (first, words) = named_first(&lexemes[next..])?;
        next += words;
        next += longest_phrase(&lexemes[next..], BEHIND)
            .or_else(|| category(&lexemes[next..]).map(|(_, words)| words))
            .unwrap_or(0);
        let ends = lexemes.get(next).is_none_or(is_mark);
        // "With the first" alone says nothing of where one starts.
        (ends && !is_weak).then_some((at, next, first))
    })?;
    let before = lexemes[..from].iter().rev().take_while(|lexeme| is_mark(lexeme) || is_and(lexeme)).count();
    let from = from - before;
    // At the start of a sentence the mark goes with it.
    let to = if from == 0 { to + usize::from(lexemes.get(to).is_some_and(is_mark)) } else { to };
    lexemes.drain(from..to);
    Some(first)
}

fn is_and(lexeme: &Lexeme) -> bool {
    matches!(&lexeme.token, Token::Word(word) if word == "and")
}

/// "First", "southernmost", "south".
fn named_first(lexemes: &[Lexeme]) -> Option<(First, usize)> {
    if let Some(nth) = numbers::ordinal(lexemes) {
        return Some((First::Nth(u8::try_from(nth).unwrap_or(u8::MAX)), 1));
    }
    longest(lexemes, super::super::compass::MOST)
        .or_else(|| longest(lexemes, super::super::compass::DIRECTIONS))
        .map(|(compass, words)| (First::Compass(compass), words))
}

/// Has every second one begin there; whether one was asked for at all.
pub(super) fn begin(wishes: &mut [Vec<Wish>], first: First) -> bool {
    let mut any = false;
    for object in wishes.iter_mut().flatten().flat_map(Wish::objects_mut) {
        if is_every_nth(object) {
            object.first = Some(first);
            any = true;
        }
    }
    any
}

fn is_every_nth(reference: &Reference) -> bool {
    reference.count == Count::All && matches!(reference.choice, Choice::Nth(_))
}

impl Finder<'_> {
    /// Things in a row, without those before the one with which every nth of them begins.
    pub(super) fn every_from(&self, mut all: Vec<EntityId>, nth: u32, first: Option<First>) -> Vec<EntityId> {
        let skipped = match first {
            None => nth.max(1) as usize - 1,
            Some(First::Nth(rank)) => usize::from(rank.max(1)) - 1,
            Some(First::Compass(compass)) => {
                let far = |id: &EntityId| {
                    let at = self.scene.entity(*id).map_or(Point2::origin(), |entity| entity.planar());
                    at.coords.dot(&compass.step())
                };
                if let (Some(start), Some(end)) = (all.first(), all.last())
                    && far(start) < far(end)
                {
                    all.reverse();
                }
                0
            }
        };
        all.into_iter().skip(skipped).step_by(nth.max(1) as usize).collect()
    }
}

/// Every word of these tables, for the spelling.
pub(super) fn words() -> impl Iterator<Item = &'static str> {
    STARTS.iter().chain(BEHIND).flat_map(|phrase| phrase.split(' '))
}
