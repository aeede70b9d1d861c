//! Conditions on what a door is: "if the door of the lab is locked", "unless the bakery's door is open", "if the library door isn't shut".
//!
//! They are put as conditions on there being such a door of the building, which the grammar reads. They are tried only where a sentence was refused.

use super::super::lexer::{Lexeme, is_mark, word_of};
use super::super::lexicon::{longest, longest_phrase};
use super::super::paint::PAINTS;
use super::super::phrases::Phrases;
use super::forms::{word, word_at, words_at};
use super::words::VERBS;

/// What begins a condition, and the plain word for it.
const IF: &[(&[&str], &str)] = &[
    (
        &[
            "if",
            "in case",
            "provided",
            "provided that",
            "as long as",
            "so long as",
            "assuming",
            "assuming that",
            "given that",
        ],
        "if",
    ),
    (&["only if", "but only if"], "only if"),
    (&["unless"], "unless"),
];
/// That the door is so, or with `false` that it is not.
#[rustfmt::skip]
const IS: &[(&[&str], bool)] = &[
    (&["is", "stands", "stays", "is still", "is already", "is currently", "is now", "is standing", "is left", "was left", "happens to be", "has been left", "turns out to be"], true),
    (&["isnt", "is not", "is no longer", "isnt yet", "is not yet", "does not stand", "doesnt stand"], false),
];
/// What it is, and what it is if it is not that.
const STATES: &[(&[&str], (&str, &str))] = &[
    (&["open", "opened", "ajar", "wide open"], ("open", "closed")),
    (&["closed", "shut"], ("closed", "open")),
    (&["locked", "bolted", "locked up"], ("locked", "unlocked")),
    (&["unlocked"], ("unlocked", "locked")),
];
/// Behind what it is.
const NOW: &Phrases =
    &Phrases::of(&["now", "already", "at the moment", "right now", "today", "by now", "by then", "still"]);
/// What a door is called.
#[rustfmt::skip]
const DOORS: &Phrases = &Phrases::of(&["door", "front door", "main door", "doorway", "entrance", "entrance door", "gate"]);
/// Between a door and whose it is.
const OF: &Phrases = &Phrases::of(&["of", "to", "at", "in", "on", "into", "belonging to"]);
const DETERMINERS: &Phrases = &Phrases::of(&["the", "this", "that", "our", "my"]);
/// Words before a door that say which of several it is, and not whose.
const WHICH: &Phrases =
    &Phrases::of(&["left", "right", "first", "second", "third", "last", "other", "nearest", "closest"]);
/// Whose door it is and that takes no more words.
const LONGEST: usize = 9;

/// The words with such a condition put plainly, if there is one.
pub(super) fn in_plain_words(words: &str, lexemes: &[Lexeme]) -> Option<Vec<Lexeme>> {
    (0..lexemes.len()).find_map(|at| {
        let (condition, count) = longest(&lexemes[at..], IF)?;
        let from = at + count;
        let (is, so, behind) = (from + 1..lexemes.len().min(from + LONGEST)).find_map(|is| {
            let (so, count) = longest(&lexemes[is..], IS)?;
            Some((is, so, is + count))
        })?;
        let ((state, contrary), count) = longest(lexemes.get(behind..)?, STATES)?;
        let end = behind + count;
        let end = end + lexemes.get(end..).and_then(|rest| longest_phrase(rest, NOW)).unwrap_or(0);
        let whose = whose(words, &lexemes[from..is]).filter(|_| ends(lexemes, end))?;
        let place = &lexemes[at];
        let state = if so { state } else { contrary };
        let article = if state.starts_with(['o', 'u']) { "an" } else { "a" };
        let mut told = lexemes[..at].to_vec();
        told.extend(words_at(place, condition));
        told.extend(words_at(place, "there is"));
        told.extend([article, state, "door", "of"].map(|plain| word_at(place, plain)));
        told.extend(whose);
        told.extend_from_slice(&lexemes[end..]);
        Some(told)
    })
}

/// Whether a condition may end there: at a mark, at an order, or with the sentence.
fn ends(lexemes: &[Lexeme], at: usize) -> bool {
    let rest = lexemes.get(at..).unwrap_or_default();
    rest.first().is_none_or(is_mark) || word(lexemes, at) == "then" || longest(rest, &VERBS).is_some()
}

/// "The door of the lab", "the lab door", "the lab's door": the lab. A door of which nobody says whose it is stays as it is.
fn whose(words: &str, said: &[Lexeme]) -> Option<Vec<Lexeme>> {
    if said.iter().any(is_mark) {
        return None;
    }
    let the = longest_phrase(said, DETERMINERS).unwrap_or(0);
    if let Some(door) = longest_phrase(&said[the..], DOORS) {
        let of = the + door + longest_phrase(&said[the + door..], OF)?;
        return (of < said.len()).then(|| said[of..].to_vec());
    }
    let door =
        (the + 1..said.len()).find(|at| longest_phrase(&said[*at..], DOORS) == Some(said.len() - at))?;
    let owner = &said[the..door];
    if longest(owner, PAINTS).is_some() || longest_phrase(owner, WHICH).is_some() {
        return None;
    }
    let mut whose = said[..door].to_vec();
    let last = whose.last_mut()?;
    let written = words.get(last.start..last.end).unwrap_or_default();
    if ["'s", "’s"].iter().any(|end| written.ends_with(*end)) {
        let stem = word_of(last).strip_suffix('s')?.to_owned();
        *last = word_at(&last.clone(), &stem);
    }
    Some(whose)
}

#[cfg(test)]
mod tests {
    use super::super::super::lexer::{Lexeme, lex, rewritten};
    use super::in_plain_words;

    #[test]
    fn conditions_on_doors_are_put_plainly() {
        for (said, meant) in [
            (
                "if the door of the lab is locked, put a cone here",
                "if there is a locked door of the lab , put a cone here",
            ),
            (
                "if the bakery door is open put a chef here",
                "if there is an open door of the bakery put a chef here",
            ),
            (
                "unless the kiosk's door is shut, add a bench",
                "unless there is a closed door of the kiosk , add a bench",
            ),
            (
                "add a bench if the door to the lab isn't locked",
                "add a bench if there is an unlocked door of the lab",
            ),
        ] {
            let told = |lexemes: &mut Vec<Lexeme>| *lexemes = in_plain_words(said, lexemes).unwrap();
            assert_eq!(rewritten(said, told), meant, "{said}");
        }
    }

    #[test]
    fn other_conditions_stay() {
        for said in [
            "if the door is open, put a chef here",
            "if the red door is open, put a chef here",
            "if the shop is open, put a chef here",
            "if the door of the lab is green, paint it red",
        ] {
            assert!(in_plain_words(said, &lex(said)).is_none(), "{said}");
        }
    }
}
