//! Conditions on what there is, in other words than "if there is": "if the harbour has got a windmill", "provided that a tractor is about", "if a
//! snowman is standing anywhere", "unless there is a picnic table already".

use super::super::lexer::{Lexeme, is_mark};
use super::super::lexicon::{category, longest, longest_phrase};
use super::super::phrases::Phrases;
use super::forms::{word, words_at};
use super::words::WAYS;

/// What begins a condition, and how it is put.
#[rustfmt::skip]
const IF: &[(&[&str], &str)] = &[
    (&["if", "in case", "provided", "provided that", "providing", "providing that", "as long as", "so long as", "assuming", "assuming that", "supposing", "supposing that", "on condition that", "on the condition that"], "if"),
    (&["only if", "but only if"], "only if"),
    (&["unless"], "unless"),
];
/// Before something new or unknown.
const ARTICLE: &Phrases = &Phrases::of(&["a", "an", "any", "some"]);
/// Between a place and what may be there.
#[rustfmt::skip]
const HAS: &Phrases = &Phrases::of(&["has", "has got", "have", "have got", "holds", "contains", "features", "includes", "boasts", "possesses", "already has", "already has got", "has already got", "still has"]);
/// Between a place and what may not be there.
#[rustfmt::skip]
const HAS_NOT: &Phrases = &Phrases::of(&["has no", "has got no", "lacks", "lacks a", "lacks an", "lacks any", "hasnt got a", "hasnt got an", "hasnt got any", "hasnt a", "hasnt any", "has not got a", "has not got an", "has not got any", "doesnt have a", "doesnt have an", "doesnt have any",
    "does not have a", "does not have an", "does not have any", "doesnt contain a", "doesnt contain any", "does not contain a", "does not contain any", "has not a", "have no", "is without a", "is without an", "is without any"]);
/// That something is there, wherever that is.
#[rustfmt::skip]
const IS_ABOUT: &Phrases = &Phrases::of(&["is about", "is around", "is here", "is there", "is present", "is available", "is anywhere", "is somewhere", "is somewhere about", "is somewhere around", "is anywhere about", "is anywhere around", "is anywhere to be seen", "is anywhere to be found",
    "is standing anywhere", "is standing somewhere", "is standing around", "is standing about", "is standing there", "is standing here", "is standing around here", "is standing around anywhere", "stands anywhere", "stands somewhere", "stands around", "stands about", "is parked anywhere", "is parked somewhere",
    "is parked around here", "is lying around", "is lying about", "is lying anywhere", "is sitting anywhere", "is sitting around", "is to be found", "is to be found anywhere", "is to be seen", "can be found", "can be found anywhere", "can be seen", "can be seen anywhere", "is in sight", "is at hand",
    "is on hand", "is around here", "is about here", "is around somewhere", "is still about", "is still around", "happens to be about", "happens to be around", "happens to be there", "happens to be here"]);
/// That it is not.
#[rustfmt::skip]
const IS_NOWHERE: &Phrases = &Phrases::of(&["is nowhere", "is nowhere to be seen", "is nowhere to be found", "is nowhere in sight", "is not about", "is not around", "is not anywhere", "is not there", "is not here", "is not present", "isnt about", "isnt around", "isnt anywhere", "isnt there", "isnt here", "isnt present",
    "cannot be found", "cannot be seen", "cant be found", "cant be seen"]);
/// The plain words for it.
#[rustfmt::skip]
const IS_THERE: &Phrases = &Phrases::of(&["if there is", "if there are", "if theres", "only if there is", "only if theres", "unless there is", "unless there are", "unless theres", "in case there is", "in case theres"]);
/// What is looked for has no more words.
const LONGEST: usize = 5;

/// Puts the words so.
pub(super) fn in_plain_words(lexemes: &mut Vec<Lexeme>) {
    owned(lexemes);
    about(lexemes);
    already(lexemes);
    set_up(lexemes);
}

/// Where the words of a condition end.
fn end_of(lexemes: &[Lexeme], from: usize) -> usize {
    (from..lexemes.len())
        .find(|at| is_mark(&lexemes[*at]) || word(lexemes, *at) == "then")
        .unwrap_or(lexemes.len())
}

/// "If the harbour has got a windmill" is if there is one, and "if the park lacks a bench" if there is none in the park.
fn owned(lexemes: &mut Vec<Lexeme>) {
    let found = (0..lexemes.len()).find_map(|at| {
        let (condition, words) = longest(&lexemes[at..], IF)?;
        let from = at + words;
        let whole = super::whole::whole_at(lexemes, from);
        let to = whole.or_else(|| area_at(lexemes, from))?;
        let rest = lexemes.get(to..)?;
        let not = longest_phrase(rest, HAS_NOT);
        let has = longest_phrase(rest, HAS).filter(|has| longest_phrase(&rest[*has..], ARTICLE).is_some());
        let (is, count) = match (not, has) {
            (Some(not), _) => ("there is no", not),
            (None, has) => ("there is", has?),
        };
        let noun = to + count;
        let end = end_of(lexemes, noun);
        let place = if whole.is_none() { from..to } else { from..from };
        (noun < end).then_some((at, condition, is, noun..end, place))
    });
    let Some((at, condition, is, noun, place)) = found else { return };
    let first = lexemes[at].clone();
    let end = noun.end;
    let within: Vec<Lexeme> = if place.is_empty() { Vec::new() } else { words_at(&first, "in").collect() };
    let plain: Vec<Lexeme> = words_at(&first, condition)
        .chain(words_at(&first, is))
        .chain(lexemes[noun].iter().cloned())
        .chain(within)
        .chain(lexemes[place].iter().cloned())
        .collect();
    lexemes.splice(at..end, plain);
}

/// Behind "the park" or "Rose Park", if that is what begins there.
fn area_at(lexemes: &[Lexeme], from: usize) -> Option<usize> {
    let the = longest_phrase(lexemes.get(from..)?, &["the", "this", "our", "that"]).unwrap_or(0);
    let noun = from + the;
    // A name of one word before it: "Rose Park".
    (noun..noun + 2).find_map(|at| {
        let (class, words) = category(lexemes.get(at..)?)?;
        (class.is_area() && (the > 0 || at > noun)).then_some(at + words)
    })
}

/// "Provided that a tractor is about" is if there is a tractor.
fn about(lexemes: &mut Vec<Lexeme>) {
    let found = (0..lexemes.len()).find_map(|at| {
        let (condition, words) = longest(&lexemes[at..], IF)?;
        let from = at + words;
        let article = longest_phrase(lexemes.get(from..)?, ARTICLE)?;
        let noun = from + article;
        let end = end_of(lexemes, noun);
        let ends = |is: usize, list: &Phrases| longest_phrase(&lexemes[is..end], list) == Some(end - is);
        (noun + 1..end.min(noun + LONGEST)).find_map(|is| {
            let not = ends(is, IS_NOWHERE);
            let from = if not { noun } else { from };
            (not || ends(is, IS_ABOUT)).then_some((at, condition, not, from..is, end))
        })
    });
    let Some((at, condition, not, what, end)) = found else { return };
    let first = lexemes[at].clone();
    let plain: Vec<Lexeme> = words_at(&first, condition)
        .chain(words_at(&first, if not { "there is no" } else { "there is" }))
        .chain(lexemes[what].iter().cloned())
        .collect();
    lexemes.splice(at..end, plain);
}

/// "Unless there is a picnic table already": it is asked of what is there now.
fn already(lexemes: &mut Vec<Lexeme>) {
    let found = (0..lexemes.len()).find_map(|at| {
        let words = longest_phrase(&lexemes[at..], IS_THERE)?;
        let end = end_of(lexemes, at + words);
        // "If there's no bench yet" is known as it is.
        let none = word(lexemes, at + words) == "no" && matches!(word(lexemes, at + words - 1), "is" | "are");
        let is_late = |late: &usize| {
            let words = longest_phrase(&lexemes[*late..end], &["already", "by now"])
                .or_else(|| longest_phrase(&lexemes[*late..end], &["yet"]).filter(|_| none));
            words == Some(end - late)
        };
        let late = (at + words + 1..end).find(is_late)?;
        Some(late..end)
    });
    if let Some(late) = found {
        lexemes.drain(late);
    }
}

/// "Set one up next to the birch": the particle is no part of the place.
fn set_up(lexemes: &mut Vec<Lexeme>) {
    const PUTS: &[&str] = &["set", "put", "place", "stick", "pop", "build", "rig", "plonk"];
    let found = (2..lexemes.len()).find(|at| {
        let is_particle = matches!(word(lexemes, *at), "up" | "down");
        let puts = word(lexemes, at - 1) == "one" && PUTS.contains(&word(lexemes, at - 2));
        let place = |at: usize| lexemes.get(at..).and_then(|rest| longest(rest, &WAYS));
        is_particle && puts && place(*at).is_none() && place(at + 1).is_some()
    });
    if let Some(at) = found {
        lexemes.remove(at);
    }
}

#[cfg(test)]
mod tests {
    use super::super::super::lexer::rewritten;
    use super::*;

    fn plain(said: &str) -> String {
        rewritten(said, in_plain_words)
    }

    #[test]
    fn what_there_is_is_asked_in_plain_words() {
        assert_eq!(
            plain("if the harbour has got a windmill, knock it down"),
            "if there is a windmill , knock it down"
        );
        assert_eq!(
            plain("if the park has a statue, turn it round"),
            "if there is a statue in the park , turn it round"
        );
        assert_eq!(
            plain("unless Rose Park lacks a bench, leave it"),
            "unless there is no bench in rose park , leave it"
        );
        assert_eq!(plain("provided that a tractor is about, move it"), "if there is a tractor , move it");
        assert_eq!(
            plain("if a snowman is standing anywhere, take it away"),
            "if there is a snowman , take it away"
        );
        assert_eq!(plain("if a dog is nowhere to be seen, add one"), "if there is no dog , add one");
    }

    #[test]
    fn what_is_not_there_yet_is_not_there() {
        assert_eq!(
            plain("in case the campus has no bus stop yet, set one up in front of the library"),
            "if there is no bus stop , set one in front of the library"
        );
    }

    #[test]
    fn other_conditions_stay() {
        for said in [
            "if a bench is near the oak , paint it red",
            "if the museum has a door , paint it red",
            "as long as the lamp is about as tall as the tree",
            "put one up",
        ] {
            assert_eq!(plain(said), said);
        }
    }
}
