//! What is to become of a thing that is named before a colon, as in a list of works: "Bench near the museum: 45 degrees to the left", "the kiosk: a
//! tenth smaller", "Ada: a half turn". No new bench is asked for.

use super::super::lexer::{Lexeme, Token, is_mark};
use super::super::lexicon::{category, longest, longest_phrase};
use super::super::names::Names;
use super::super::paint::PAINTS;
use super::super::phrases::Phrases;
use super::follow::species;
use super::forms::{word, word_at};
use super::words::{VERBS, WAYS};

/// Before a thing that is there.
const THE: &Phrases = &Phrases::of(&["the", "this", "that", "these", "those", "my", "our", "your"]);
/// Words of turning, without which a side is no angle.
#[rustfmt::skip]
const TURNS: &[&str] = &["degrees", "degree", "deg", "°", "turn", "clockwise", "anticlockwise", "counterclockwise", "round", "around"];

/// Puts the heading and what stands behind its colon as an order.
pub(super) fn in_plain_words(words: &str, lexemes: &mut Vec<Lexeme>, names: &Names<'_>) {
    let mut from = 0;
    while let Some(at) = (from..lexemes.len()).find(|at| lexemes[*at].token == Token::Break) {
        let is_colon = words.get(lexemes[at].start..).is_some_and(|rest| rest.starts_with(':'));
        let begin = (from..at).rev().find(|at| is_mark(&lexemes[*at])).map_or(from, |mark| mark + 1);
        let end = (at + 1..lexemes.len()).find(|at| is_mark(&lexemes[*at])).unwrap_or(lexemes.len());
        // "Bench: small, red, next to the oak" is a new one.
        let closes = lexemes.get(end).is_none_or(|mark| mark.token == Token::Break);
        let told =
            if is_colon && closes { order(&lexemes[begin..at], &lexemes[at + 1..end], names) } else { None };
        match told {
            Some(told) => {
                from = begin + told.len();
                lexemes.splice(begin..end, told);
            }
            None => from = at + 1,
        }
    }
}

/// The order about what a heading names, if that is a thing and what is told of it is a turn, a size or a colour and nothing else.
fn order(heading: &[Lexeme], told: &[Lexeme], names: &Names<'_>) -> Option<Vec<Lexeme>> {
    let place = heading.first()?;
    let the = longest_phrase(heading, THE);
    let noun = the.unwrap_or(0);
    let noun = noun + longest(&heading[noun..], PAINTS).map_or(0, |(_, words)| words);
    let rest = heading.get(noun..).filter(|rest| !rest.is_empty())?;
    let named = names.exact(heading).map_or(0, |(_, words)| words);
    let class = category(rest).map_or(0, |(_, words)| words).max(usize::from(species(&rest[0]).is_some()));
    let verb = longest(heading, &VERBS).map_or(0, |(_, words)| words);
    let is_thing = named > 0 || class > 0 || names.exact(rest).is_some();
    if !is_thing || verb >= named.max(class).max(1) {
        return None;
    }
    let is_certain =
        the.is_some() || named > 0 || (1..heading.len()).any(|at| longest(&heading[at..], &WAYS).is_some());
    let turns = (0..told.len()).any(|at| TURNS.contains(&word(told, at)));
    let verb = if turns && super::turn::angle(told).is_some() {
        "turn"
    } else if is_certain && super::predicates::size_of(told).is_some() {
        "make"
    } else if is_certain && longest(told, PAINTS).is_some_and(|(_, words)| words == told.len()) {
        "paint"
    } else {
        return None;
    };
    let the = (the.is_none() && named == 0).then(|| word_at(place, "the"));
    Some(
        std::iter::once(word_at(place, verb))
            .chain(the)
            .chain(heading.iter().cloned())
            .chain(told.iter().cloned())
            .collect(),
    )
}
