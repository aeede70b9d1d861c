//! Small words that say which things are meant, how many there are, or how far something is turned, put as they are read: "the person who is
//! nearest to the museum", "every bench outside the square", "exactly nine stools", "by a quarter, clockwise".

use super::super::lexer::{Lexeme, Token, is_mark};
use super::super::lexicon::{category, longest, longest_phrase};
use super::super::numbers;
use super::super::phrases::Phrases;
use super::forms::{word, words_at};
use super::words::WAYS;

/// Before what is nearest or farthest, and says no more.
#[rustfmt::skip]
const WHO_IS: &Phrases = &Phrases::of(&["who is", "whos", "that is", "thats", "which is", "who stands", "that stands", "which stands", "who is standing", "that is standing", "which is standing", "who sits", "that sits", "that is parked", "which is parked", "who happens to be", "that happens to be", "standing",
    "located", "situated", "parked", "who lives"]);
/// Before where a thing is.
#[rustfmt::skip]
const STANDS: &Phrases = &Phrases::of(&["that stands", "which stands", "who stands", "that sits", "who sits", "that is standing", "which is standing", "who is standing", "that is parked", "which is parked", "that is located"]);
#[rustfmt::skip]
const NEAREST: &Phrases = &Phrases::of(&["nearest to", "closest to", "nearest", "closest", "farthest from", "furthest from", "farthest away from", "furthest away from", "the nearest to", "the closest to", "the farthest from", "the furthest from"]);
/// Before a number, of which it says nothing.
const EXACTLY: &Phrases = &Phrases::of(&[
    "exactly",
    "precisely",
    "no more than",
    "no fewer than",
    "not more than",
    "a total of",
    "all in all",
]);
/// Before a number that is told behind a request.
const SAY: &Phrases = &Phrases::of(&[
    "say",
    "lets say",
    "make it",
    "make that",
    "maybe",
    "perhaps",
    "about",
    "or so",
    "i would say",
    "id say",
]);
/// Which way something is turned, behind by how much.
#[rustfmt::skip]
const TURNED: &Phrases = &Phrases::of(&["clockwise", "anticlockwise", "counterclockwise", "counter clockwise", "anti clockwise", "to the left", "to the right", "to its left", "to its right"]);
/// What people are called who are to be pitied.
const POOR: &[&str] = &[
    "thing", "man", "woman", "boy", "girl", "soul", "dear", "guy", "fellow", "lad", "lass", "creature",
    "sod", "things", "souls", "kid", "chap", "devil", "love", "beast", "dog", "animal",
];

/// Puts the words so.
pub(super) fn in_plain_words(lexemes: &mut Vec<Lexeme>) {
    standing(lexemes);
    nearest(lexemes);
    outside(lexemes);
    counted(lexemes);
    turned(lexemes);
    pitied(lexemes);
}

/// Whether a noun of a class ends before a word.
fn ends_noun(lexemes: &[Lexeme], at: usize) -> bool {
    (at.saturating_sub(3)..at)
        .any(|from| category(&lexemes[from..at]).is_some_and(|(_, words)| from + words == at))
        || super::follow::species(&lexemes[at - 1]).is_some()
        || matches!(word(lexemes, at - 1), "one" | "ones" | "somebody" | "someone" | "whoever")
}

/// "Next to the chair that stands near the oak" is next to the chair near it.
fn standing(lexemes: &mut Vec<Lexeme>) {
    let mut at = 3;
    while at < lexemes.len() {
        let stands = longest_phrase(&lexemes[at..], STANDS)
            .filter(|words| longest(lexemes.get(at + words..).unwrap_or_default(), &WAYS).is_some());
        let is_anchor = || {
            (at.saturating_sub(4)..at).any(|the| {
                word(lexemes, the) == "the"
                    && (the.saturating_sub(4)..the).any(|from| {
                        longest(&lexemes[from..the], &WAYS).is_some_and(|(_, words)| from + words == the)
                    })
            })
        };
        if let Some(words) = stands.filter(|_| ends_noun(lexemes, at) && is_anchor()) {
            lexemes.drain(at..at + words);
        }
        at += 1;
    }
}

/// "The person who is nearest to the museum" is the person nearest to it.
fn nearest(lexemes: &mut Vec<Lexeme>) {
    let mut at = 2;
    while at < lexemes.len() {
        let words = longest_phrase(&lexemes[at..], WHO_IS)
            .filter(|words| longest_phrase(&lexemes[at + words..], NEAREST).is_some_and(|near| near > 1))
            .filter(|_| ends_noun(lexemes, at));
        if let Some(words) = words {
            let the = usize::from(word(lexemes, at + words) == "the");
            lexemes.drain(at..at + words + the);
        }
        at += 1;
    }
}

/// "Every bench outside the square" is every bench but those in it; what is outside a house is before it.
fn outside(lexemes: &mut Vec<Lexeme>) {
    let mut at = 2;
    while at + 2 < lexemes.len() {
        let of = usize::from(word(lexemes, at + 1) == "of");
        let area = at + 1 + of;
        let is_area = matches!(word(lexemes, area), "the" | "our" | "this")
            && (area + 1..lexemes.len().min(area + 4))
                .any(|noun| category(&lexemes[noun..]).is_some_and(|(class, _)| class.is_area()));
        let all = (at.saturating_sub(4)..at)
            .any(|from| matches!(word(lexemes, from), "all" | "every" | "each" | "any" | "many" | "which"));
        if word(lexemes, at) == "outside" && is_area && all && ends_noun(lexemes, at) {
            let place = lexemes[at].clone();
            let plain: Vec<Lexeme> = words_at(&place, "except the ones in").collect();
            lexemes.splice(at..area, plain);
        }
        at += 1;
    }
}

/// "Exactly nine stools" are nine; "more trees. Say, four" are four.
fn counted(lexemes: &mut Vec<Lexeme>) {
    let mut at = 0;
    while at < lexemes.len() {
        if let Some(words) = longest_phrase(&lexemes[at..], EXACTLY)
            && numbers::count(&lexemes[at + words..]).is_some()
            && numbers::length(&lexemes[at + words..]).is_none()
        {
            lexemes.drain(at..at + words);
        }
        if at > 0
            && is_mark(&lexemes[at - 1])
            && let Some(words) = longest_phrase(&lexemes[at..], SAY)
        {
            let comma = usize::from(lexemes.get(at + words).is_some_and(is_mark));
            let number = at + words + comma;
            let rest = lexemes.get(number..).unwrap_or_default();
            let ends = numbers::count(rest)
                .is_some_and(|(_, words)| rest.get(words).is_none_or(|next| next.token == Token::Break));
            if ends {
                lexemes.drain(at..number);
                lexemes[at - 1].token = Token::Comma;
            }
        }
        at += 1;
    }
}

/// "By a quarter, clockwise": the mark says nothing.
fn turned(lexemes: &mut Vec<Lexeme>) {
    let found = (1..lexemes.len()).find(|at| {
        let rest = &lexemes[at + 1..];
        lexemes[*at].token == Token::Comma
            && matches!(word(lexemes, at - 1), "quarter" | "turn" | "degrees" | "degree" | "half" | "angle")
            && longest_phrase(rest, TURNED).is_some_and(|words| {
                rest.get(words).is_none_or(|next| {
                    is_mark(next) || matches!(&next.token, Token::Word(word) if word == "and")
                })
            })
    });
    if let Some(at) = found {
        lexemes.remove(at);
    }
}

/// "Next to Hana, the poor thing": who she is was said.
fn pitied(lexemes: &mut Vec<Lexeme>) {
    let mut at = 2;
    while at + 1 < lexemes.len() {
        let the = usize::from(word(lexemes, at + 1) == "the");
        let poor = at + 1 + the;
        let is_said = lexemes[at].token == Token::Comma
            && word(lexemes, poor) == "poor"
            && POOR.contains(&word(lexemes, poor + 1))
            && lexemes.get(poor + 2).is_none_or(is_mark);
        if is_said {
            lexemes.drain(at..poor + 2);
        } else {
            at += 1;
        }
    }
}

/// Every word of these tables, for the spelling.
pub(super) fn words() -> impl Iterator<Item = &'static str> {
    let phrases = [WHO_IS, STANDS, NEAREST, EXACTLY, SAY, TURNED].into_iter().flatten();
    phrases.flat_map(|phrase| phrase.split(' ')).chain(POOR.iter().copied())
}

#[cfg(test)]
mod tests {
    use super::super::super::lexer::rewritten;
    use super::*;

    fn plain(said: &str) -> String {
        rewritten(said, in_plain_words)
    }

    #[test]
    fn what_says_nothing_is_left_out_and_the_rest_put_as_it_is_read() {
        assert_eq!(plain("the person who is nearest to the museum"), "the person nearest to the museum");
        assert_eq!(
            plain("paint every bench outside the park brown"),
            "paint every bench except the ones in the park brown"
        );
        assert_eq!(plain("put exactly nine stools here"), "put nine stools here");
        assert_eq!(plain("turn it by a quarter, clockwise"), "turn it by a quarter clockwise");
        assert_eq!(plain("next to Hana, the poor thing"), "next to hana");
        assert_eq!(plain("add trees, say, four"), "add trees , four");
    }

    #[test]
    fn what_says_something_stays() {
        for said in
            ["the bench that is near the museum", "put a bench outside the museum", "move the poor dog here"]
        {
            assert_eq!(plain(said), said.to_lowercase());
        }
    }
}
