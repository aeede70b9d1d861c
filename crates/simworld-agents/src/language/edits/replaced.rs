//! Which of the words before are taken back by those that are meant: "forty chairs, I mean twenty", "a bench by the oak, no, a lamp".
//!
//! What is put right is of the kind of what stands in its place: a number for a number, a colour for a colour, a place for a
//! place, an order for an order, a thing for a thing.

use super::super::compass::DIRECTIONS;
use super::super::lexer::{Lexeme, Token, is_mark};
use super::super::lexicon::{Category, category, longest, longest_phrase};
use super::super::numbers::{self, NUMERALS};
use super::super::paint::PAINTS;
use super::words::{FACTORS, SKIES, VERBS, WAYS};

/// Which of the words before are taken back by those that are meant.
pub(super) fn replaced(before: &[Lexeme], meant: &[Lexeme], is_sure: bool) -> Option<(usize, usize)> {
    let clause = before.iter().rposition(|lexeme| lexeme.token == Token::Break).map_or(0, |at| at + 1);
    let all = before.len();
    let last = |fits: &dyn Fn(usize) -> Option<usize>| {
        (clause..all).rev().find_map(|at| fits(at).map(|words| (at, at + words)))
    };
    if numbers::number(meant).is_some_and(|(_, words)| words == meant.len() && !is_article(meant)) {
        return last(&|at| {
            numbers::number(&before[at..]).filter(|_| is_number(&before[at])).map(|(_, words)| words)
        });
    }
    if let Some(found) = length_before(before, meant, clause) {
        return Some(found);
    }
    if is_look(meant) {
        return look_before(before, meant, clause);
    }
    // "A white tent, no, a red one".
    if let Some(found) = new_coloured_before(before, meant, clause) {
        return Some(found);
    }
    if longest(meant, &SKIES).is_some() {
        return last(&|at| longest(&before[at..], &SKIES).map(|(_, words)| words)).or(Some((clause, all)));
    }
    if longest(meant, &VERBS).is_some() {
        // An order is taken back as a whole.
        return last(&|at| longest(&before[at..], &VERBS).filter(|_| is_sure).map(|_| all - at));
    }
    if longest(meant, &WAYS).is_some() {
        return place_before(before, meant, clause);
    }
    let noun = noun_in(meant);
    // "The white car, I mean the black one": the colour is taken back.
    if let [the, paint @ .., one] = meant
        && the.token == Token::Word("the".to_owned())
        && one.token == Token::Word("one".to_owned())
        && longest(paint, PAINTS).is_some_and(|(_, words)| words == paint.len())
    {
        return coloured_before(before, clause);
    }
    if is_article(meant) || meant.first().is_some_and(is_number) {
        return thing_before(before, meant, clause, is_sure);
    }
    let is_noun = is_sure && meant.len() <= LONGEST && noun.is_none_or(|noun| noun.to == meant.len());
    let is_word = matches!(before.last()?.token, Token::Word(_));
    let (from, to) = several_before(before, meant, clause).unwrap_or((all - 1, all));
    (is_noun && is_word && all > clause).then_some((from, to))
}

/// Of how far something is what it takes the place of: another length, or else a place; where neither was told, it stands behind all that was
/// said ("a weather station, say, ten metres south of the hall").
fn length_before(before: &[Lexeme], meant: &[Lexeme], clause: usize) -> Option<(usize, usize)> {
    /// Behind a length, that it is one of the way.
    const LEADS: &[&str] = &["to the", "to its", "to his", "to her", "from", "away", "off", "further"];
    /// Who that is was told in the place before.
    const OPEN: &[&str] = &["it", "him", "her", "them", "there", "that"];
    let all = before.len();
    let length = |lexemes: &[Lexeme]| numbers::length(lexemes).map(|(_, words)| words);
    let words = length(meant).filter(|_| !is_article(meant))?;
    let rest = &meant[words..];
    let is_way = longest(rest, DIRECTIONS).is_some()
        || longest(rest, &WAYS).is_some()
        || longest_phrase(rest, LEADS).is_some();
    let told = (clause..all).rev().find_map(|at| Some((at, length(&before[at..])?)));
    let is_place = |at: &usize| {
        longest(&before[*at..], &WAYS).is_some() || longest(&before[*at..], DIRECTIONS).is_some()
    };
    match told.filter(|(at, _)| is_number(&before[*at])) {
        // "Half a metre" begins with its half.
        Some((at, old)) if is_way || rest.is_empty() => {
            let from = (at.saturating_sub(3).max(clause)..at)
                .find(|from| length(&before[*from..]) == Some(at + old - from))
                .unwrap_or(at);
            Some((from, if is_way { all } else { at + old }))
        }
        None if is_way => match (clause..all).find(is_place) {
            // "By the oak, I mean, five metres south of it" says where with both.
            Some(_) if (0..rest.len()).any(|at| longest_phrase(&rest[at..], OPEN).is_some()) => None,
            Some(at) => place_before(before, meant, clause).or(Some((at, all))),
            None => Some((all, all)),
        },
        _ => None,
    }
}

/// Of a colour or a size what it takes the place of.
fn look_before(before: &[Lexeme], meant: &[Lexeme], clause: usize) -> Option<(usize, usize)> {
    let last = |fits: &dyn Fn(usize) -> Option<usize>| {
        (clause..before.len()).rev().find_map(|at| fits(at).map(|words| (at, at + words)))
    };
    if longest(meant, PAINTS).is_some() {
        return last(&|at| longest(&before[at..], PAINTS).map(|(_, words)| words));
    }
    let (from, to) = last(&|at| longest(&before[at..], &FACTORS).map(|(_, words)| words))?;
    Some((whole_factor(before, from), to))
}

/// Whether some words are a colour or a size, and no more.
fn is_look(meant: &[Lexeme]) -> bool {
    longest(meant, PAINTS).is_some_and(|(_, words)| words == meant.len())
        || longest(meant, &FACTORS).is_some_and(|(_, words)| words == meant.len())
}

/// A noun of a class, where it stands and where it ends.
#[derive(Clone, Copy)]
struct Noun {
    class: &'static Category,
    from: usize,
    to: usize,
}

/// The first noun of a class. "Green" is a colour before it is a place.
fn noun_in(lexemes: &[Lexeme]) -> Option<Noun> {
    (0..lexemes.len()).find_map(|at| noun_at(lexemes, at))
}

/// The class that is named just here, and where its noun ends.
pub(super) fn class_at(lexemes: &[Lexeme], at: usize) -> Option<(&'static Category, usize)> {
    lexemes.get(at..)?;
    noun_at(lexemes, at).map(|noun| (noun.class, noun.to))
}

fn noun_at(lexemes: &[Lexeme], at: usize) -> Option<Noun> {
    let (class, words) = category(&lexemes[at..])?;
    let paint = longest(&lexemes[at..], PAINTS).map_or(0, |(_, words)| words);
    (paint < words).then_some(Noun { class, from: at, to: at + words })
}

/// Of a thing with its article or number what it takes the place of.
fn thing_before(before: &[Lexeme], meant: &[Lexeme], clause: usize, is_sure: bool) -> Option<(usize, usize)> {
    let all = before.len();
    let noun = noun_in(meant);
    let of_class = |at: usize| {
        noun_at(before, at).filter(|own| noun.is_some_and(|noun| std::ptr::eq(own.class, noun.class)))
    };
    let is_way = |at: usize| longest(&before[at..], &WAYS).is_some();
    let led = |noun: Noun| {
        let mut words =
            (clause..noun.from).rev().take(4).take_while(|at| !is_way(*at) && !is_mark(&before[*at]));
        words.find(|at| is_number(&before[*at]) || is_article(&before[*at..]))
    };
    // "A seat in front of the clinic, no, two seats".
    if noun.is_some_and(|noun| noun.to == meant.len())
        && let Some(own) = (clause..all).rev().find_map(of_class)
    {
        return Some((led(own).unwrap_or(own.from), own.to));
    }
    let is_new = longest_phrase(meant, &["the"]).is_none();
    if is_sure
        && is_new
        && let Some(found) = new_thing_before(before, meant, clause)
    {
        return Some(found);
    }
    // "The bench near the museum, no, the bench near the school".
    if is_sure && let Some(from) = (clause..all).rev().filter_map(of_class).find_map(led) {
        return Some((from, all));
    }
    let begins = |at: &usize| {
        is_number(&before[*at])
            || is_article(&before[*at..])
            || longest_phrase(&before[*at..], &["another"]).is_some()
    };
    (clause..all).rev().find(begins).filter(|_| is_sure).map(|from| (from, all))
}

/// "A bench by the oak, no, a lamp": the last new thing before and, if another place is told too, its place.
fn new_thing_before(before: &[Lexeme], meant: &[Lexeme], clause: usize) -> Option<(usize, usize)> {
    let is_place = |lexemes: &[Lexeme]| {
        longest(lexemes, &WAYS).is_some() || numbers::length(lexemes).is_some_and(|(_, words)| words > 1)
    };
    let is_new = |at: &usize| {
        let rest = &before[*at..];
        let is_led =
            longest_phrase(rest, &["a", "an", "some", "another"]).is_some() || is_number(&before[*at]);
        is_led && !is_place(rest)
    };
    let from = (clause..before.len()).rev().find(is_new)?;
    let place = (from + 1..before.len()).find(|at| is_place(&before[*at..]));
    let has_place = (1..meant.len()).any(|at| is_place(&meant[at..]));
    Some((from, place.filter(|_| !has_place).unwrap_or(before.len())))
}

/// Of a place what it takes the place of: of several the last at a thing of the same class, or at one that is not named ("by the black, sorry, by
/// the green scooter"), or else the last.
fn place_before(before: &[Lexeme], meant: &[Lexeme], clause: usize) -> Option<(usize, usize)> {
    let all = before.len();
    let wanted = noun_in(meant);
    let (mut last, mut stop) = (None, all);
    for at in (clause..all).rev() {
        if longest(&before[at..], &WAYS).is_none() {
            continue;
        }
        let start = whole_way(before, at);
        if start >= stop {
            continue;
        }
        last = last.or(Some(start));
        let own = noun_in(&before[start..stop]);
        let is_alike = match (own, wanted) {
            (Some(own), Some(wanted)) => std::ptr::eq(own.class, wanted.class),
            _ => true,
        };
        if is_alike {
            return Some((start, all));
        }
        stop = start;
    }
    last.map(|start| (start, all))
}

/// "Two benches by the oak, I mean chairs": the last new things before that are told by their number.
fn several_before(before: &[Lexeme], meant: &[Lexeme], clause: usize) -> Option<(usize, usize)> {
    let is_plural = |lexemes: &[Lexeme], noun: Noun| matches!(&lexemes[noun.to - 1].token, Token::Word(word) if word.ends_with('s'));
    noun_in(meant).filter(|noun| is_plural(meant, *noun))?;
    let counted = |at: usize| {
        let (_, words) = numbers::count(&before[at..])?;
        noun_at(before, at + words).filter(|noun| is_plural(before, *noun))
    };
    (clause..before.len()).rev().find_map(counted).map(|noun| (noun.from, noun.to))
}

/// The last thing before that is told by its colour: "the white car".
fn coloured_before(before: &[Lexeme], clause: usize) -> Option<(usize, usize)> {
    (clause..before.len()).rev().find_map(|at| {
        if before[at].token != Token::Word("the".to_owned()) {
            return None;
        }
        let (_, paint) = longest(&before[at + 1..], PAINTS)?;
        let (_, noun) = category(&before[at + 1 + paint..])?;
        Some((at, at + 1 + paint + noun))
    })
}

/// Behind "a red one" the last new thing before that is told by its colour, up to one word behind it: "a white tent".
fn new_coloured_before(before: &[Lexeme], meant: &[Lexeme], clause: usize) -> Option<(usize, usize)> {
    let [a, paint @ .., one] = meant else { return None };
    let is_coloured = matches!(&a.token, Token::Word(word) if word == "a" || word == "an")
        && one.token == Token::Word("one".to_owned())
        && longest(paint, PAINTS).is_some_and(|(_, words)| words == paint.len());
    (clause..before.len()).rev().filter(|_| is_coloured).find_map(|at| {
        longest_phrase(&before[at..], &["a", "an"])?;
        let (_, paint) = longest(&before[at + 1..], PAINTS)?;
        let end = at + 1 + paint + 1;
        matches!(before.get(end - 1)?.token, Token::Word(_)).then_some((at, end))
    })
}

/// The first word of a size of several words that ends in a shorter one: "three times as big".
fn whole_factor(before: &[Lexeme], from: usize) -> usize {
    (from.saturating_sub(4)..from)
        .find(|at| longest(&before[*at..], &FACTORS).is_some_and(|(_, words)| at + words > from))
        .unwrap_or(from)
}

/// The first word of a relation of several words that ends in a shorter one: "on top of".
fn whole_way(before: &[Lexeme], from: usize) -> usize {
    (from.saturating_sub(3)..from)
        .find(|at| longest(&before[*at..], &WAYS).is_some_and(|(_, words)| at + words > from))
        .unwrap_or(from)
}

/// A noun without an article has no more words than that.
const LONGEST: usize = 3;

/// Whether an article stands first.
pub(super) fn is_article(lexemes: &[Lexeme]) -> bool {
    longest_phrase(lexemes, &["a", "an", "the", "some"]).is_some()
}

/// Whether a word is a number, an article among them.
fn is_number(lexeme: &Lexeme) -> bool {
    match &lexeme.token {
        Token::Number(_) => true,
        Token::Word(word) => NUMERALS.iter().any(|(numeral, _)| numeral == word),
        _ => false,
    }
}
