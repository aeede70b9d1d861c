//! What would be read as something else, put plainly before it is read: "me want small dog close to Anna" wants a new one, "me, I ..." is about nobody
//! else, who is cold asks for no cold weather, and what the museum is crying out for stands next to the museum.

use super::super::lexer::{Lexeme, Token, is_mark, word_of};
use super::super::lexicon::{category, longest, longest_phrase};
use super::super::names::Names;
use super::super::numbers;
use super::super::phrases::Phrases;
use super::forms::{is_same, word, word_at, words_at};
use super::kin::with_verb;
use super::kin_later;
use super::kin_turns::{FIRST, FIRST_WHOLE};
use super::retold::{by_turn, last_mark, told_by};
use super::words::{VERBS, WAYS};

const WANTS: &[&str] = &["want", "need", "like", "wish", "wants", "needs", "wanting", "needing"];
/// Before a noun, or in the place of one.
#[rustfmt::skip]
const DETERMINERS: &[&str] = &["the", "a", "an", "this", "that", "these", "those", "my", "our", "your", "his", "her", "their", "one", "another", "each", "every", "any", "some", "no", "all", "both", "to", "you", "it", "him", "them", "more", "not", "many", "few", "several", "half", "and", "for", "water"];
/// Who is in the weather.
const I_AM: &Phrases =
    &Phrases::of(&["i am", "im", "we are", "i feel", "we feel", "i am feeling", "im feeling", "me am"]);
const SO: &[&str] = &["so", "very", "really", "too", "all", "quite", "a bit", "rather", "always", "feeling"];
/// How he is.
#[rustfmt::skip]
const STATES: &[&str] = &["cold", "hot", "warm", "freezing", "wet", "frozen", "soaked", "chilly", "boiling", "cool", "sweating", "shivering"];

/// Who is no place by whom something could be put.
const NOBODY: &[&str] = &[
    "i",
    "we",
    "you",
    "he",
    "she",
    "it",
    "they",
    "nobody",
    "everybody",
    "everyone",
    "somebody",
    "this",
    "that",
];

/// Puts it plainly.
pub(super) fn in_plain_words(words: &str, lexemes: &mut Vec<Lexeme>, names: &Names<'_>) {
    kin_later::in_plain_words(lexemes, names);
    me_is_i(lexemes);
    without_own_state(lexemes);
    a_new_one(lexemes, names);
    she_needs_one(lexemes);
    hour_of_night(lexemes);
    by_turns(words, lexemes, names);
}

/// By the turns that would be read otherwise.
fn by_turns(words: &str, lexemes: &mut Vec<Lexeme>, names: &Names<'_>) {
    if NOBODY.contains(&word(lexemes, 0)) {
        return;
    }
    let mut said = lexemes.clone();
    with_verb(words, &mut said, names);
    let end = last_mark(&said);
    if let Some(mut told) = FIRST_WHOLE.iter().find_map(|(turn, meant)| by_turn(&said[..end], turn, meant)) {
        told.extend_from_slice(&said[end..]);
        *lexemes = told;
        return;
    }
    let told = told_by(&said, &[FIRST]);
    let is_by_who_speaks = told.iter().any(|lexeme| ["i", "we", "you"].contains(&word_of(lexeme)));
    if !is_same(&told, &said) && !is_by_who_speaks {
        *lexemes = told;
    }
}

/// "She need chair at her side": a chair.
fn she_needs_one(lexemes: &mut Vec<Lexeme>) {
    let found = (2..lexemes.len()).find(|at| {
        let (noun, behind) = (&lexemes[*at..=*at], lexemes.get(at + 1..).unwrap_or_default());
        matches!(word(lexemes, at - 2), "he" | "she")
            && matches!(word(lexemes, at - 1), "need" | "needs" | "want" | "wants")
            && category(noun).is_some()
            && !word(lexemes, *at).ends_with('s')
            && (longest(behind, &WAYS).is_some() || matches!(word(behind, 0), "at" | "by" | "on"))
    });
    if let Some(at) = found {
        let article = word_at(&lexemes[at], "a");
        lexemes.insert(at, article);
    }
}

/// "Late night only, eleven o'clock": eleven at night.
fn hour_of_night(lexemes: &mut Vec<Lexeme>) {
    let Some(at) = (1..lexemes.len()).find(|at| word(lexemes, *at) == "oclock") else { return };
    let hour = numbers::number(&lexemes[at - 1..]).map(|(hour, _)| hour);
    let said = |asked: &str| lexemes[..at].iter().any(|lexeme| word_of(lexeme) == asked);
    let half = match hour {
        Some(hour) if (8.0..12.0).contains(&hour) && said("night") => "at night",
        Some(hour) if (5.0..12.0).contains(&hour) && said("evening") => "in the evening",
        _ => return,
    };
    let is_last = lexemes.get(at + 1).is_none_or(is_mark);
    if is_last && !said("morning") && !said("not") {
        let (place, behind) = (lexemes[at].clone(), at + 1);
        lexemes.splice(behind..behind, words_at(&place, half).collect::<Vec<_>>());
    }
}

/// "Me, I ...", "me I ...": I.
fn me_is_i(lexemes: &mut Vec<Lexeme>) {
    if word(lexemes, 0) != "me" {
        return;
    }
    let mark = 1 + usize::from(lexemes.get(1).is_some_and(|mark| mark.token == Token::Comma));
    let wants = matches!(word(lexemes, mark + 1), "need" | "want" | "wish" | "like" | "would" | "am" | "are");
    if matches!(word(lexemes, mark), "i" | "we") && wants {
        lexemes.drain(..mark);
    }
}

/// "I am cold, so ...": without what he is, if more is said.
fn without_own_state(lexemes: &mut Vec<Lexeme>) {
    let Some(am) = longest_phrase(lexemes, I_AM) else { return };
    let so = am + lexemes.get(am..).and_then(|rest| longest_phrase(rest, SO)).unwrap_or(0);
    let is_state = STATES.contains(&word(lexemes, so));
    let mark = so + 1;
    let is_end = lexemes.get(mark).is_some_and(is_mark);
    let rest = lexemes.get(mark + 1..).unwrap_or_default();
    if !is_state || !is_end || rest.iter().all(is_mark) {
        return;
    }
    let therefore = longest_phrase(rest, &["so", "and so"]).unwrap_or(0);
    if therefore < rest.len() {
        lexemes.drain(..mark + 1 + therefore);
    }
}

/// "Me want small dog close to Anna": a small dog, where nothing says that it is one that is there.
fn a_new_one(lexemes: &mut Vec<Lexeme>, names: &Names<'_>) {
    if word(lexemes, 0) != "me" || !WANTS.contains(&word(lexemes, 1)) {
        return;
    }
    let Some(place) = lexemes.first().cloned() else { return };
    lexemes[0] = word_at(&place, "i");
    lexemes[1] = word_at(&place, if word(lexemes, 1).starts_with("want") { "want" } else { "need" });
    let end = lexemes.iter().position(is_mark).unwrap_or(lexemes.len());
    let Some(rest) = lexemes.get(2..end) else { return };
    let way = (1..rest.len()).find(|at| longest(&rest[*at..], &WAYS).is_some());
    let is_several = way.is_some_and(|way| word(rest, way - 1).ends_with('s'));
    let is_known = DETERMINERS.contains(&word(rest, 0))
        || numbers::count(rest).is_some()
        || names.exact(rest).is_some()
        || longest(rest, &VERBS).is_some();
    if way.is_some() && !is_several && !is_known {
        lexemes.insert(2, word_at(&place, "a"));
    }
}

#[cfg(test)]
mod tests {
    use super::super::super::lexer::Lexeme;
    use super::super::super::lexer::rewritten;
    use super::{hour_of_night, me_is_i, she_needs_one, told_by, without_own_state};
    use crate::language::edits::kin_turns::FIRST;

    #[test]
    fn who_speaks_is_spoken_of_plainly() {
        let plain = |said: &str| {
            rewritten(said, |lexemes| {
                me_is_i(lexemes);
                without_own_state(lexemes);
            })
        };
        for (said, meant) in [
            ("me, i am cold, so please one campfire close to eve", "please one campfire close to eve"),
            ("me i need one laptop", "i need one laptop"),
            ("i am freezing. put a campfire here", "put a campfire here"),
            // These say something else.
            ("i am cold", "i am cold"),
            ("me and dmitri want a bench", "me and dmitri want a bench"),
            ("i am here, put a bench next to me", "i am here , put a bench next to me"),
        ] {
            assert_eq!(plain(said), meant, "{said}");
        }
    }

    #[test]
    fn what_would_be_misread_is_put_plainly() {
        let plain = |said: &str| {
            rewritten(said, |lexemes: &mut Vec<Lexeme>| {
                she_needs_one(lexemes);
                hour_of_night(lexemes);
                *lexemes = told_by(lexemes, &[FIRST]);
            })
        };
        for (said, meant) in [
            (
                "the museum is crying out for a bike rack, sling one next to it",
                "put a bike rack next to the museum",
            ),
            ("fido is needing a kennel, it must stay beside him", "put a kennel beside fido"),
            ("my little boy is scared of the orange lorry, so it'll have to go", "remove the orange lorry"),
            ("traffic has no business on elm street, shut it", "close elm street"),
            ("she need chair at her side", "she need a chair at her side"),
            ("late night only, eleven oclock", "late night only , eleven oclock at night"),
            // These say something else.
            ("fido is needing a kennel", "fido is needing a kennel"),
            ("make it eleven oclock", "make it eleven oclock"),
            ("not night, eleven oclock in the morning", "not night , eleven oclock in the morning"),
        ] {
            assert_eq!(plain(said), meant, "{said}");
        }
    }
}
