//! Conditions that are told as a question, by the order of words, or without "if": "is there a horse? If not, put a dog by the
//! school", "should a dog be on the square, take it off", "if a cone exists, ...".

use super::super::lexer::{Lexeme, Token, is_mark};
use super::super::lexicon::longest_phrase;
use super::super::phrases::Phrases;
use super::forms::words_at;

/// Asks whether there is something.
#[rustfmt::skip]
const ASKED: &Phrases = &Phrases::of(&["is there", "are there", "do we have", "have we", "have we got", "do you see", "is there maybe", "have you got", "do you have", "can you see", "was there", "where is the", "where is",
    "does anybody see", "is there still", "wheres the", "wheres"]);
/// That there is.
#[rustfmt::skip]
const SO: &Phrases = &Phrases::of(&["if so", "if yes", "if there is", "if there are", "if it is", "in that case", "if that is so", "if you do", "if we do", "if there is one", "if they are", "if you can", "if you find one"]);
/// That there is not.
#[rustfmt::skip]
const NOT_SO: &Phrases = &Phrases::of(&["if not", "if there is not", "if there is none", "if there are none", "if no", "if there is not one", "if there is no one", "if you do not", "if we do not", "if there are not any",
    "there is none so", "there are none so", "theres none so", "if none", "if there isnt", "if there isnt one", "if there arent", "if there is not any", "if nobody"]);
/// Where something is that may be there.
const BE: &Phrases = &Phrases::of(&[
    "be",
    "stand",
    "exist",
    "appear",
    "sit",
    "lie",
    "be found",
    "be standing",
    "be parked",
    "be there",
    "be present",
]);

/// Puts conditions into the words that conditions begin with.
pub(super) fn in_plain_words(lexemes: &mut Vec<Lexeme>) {
    asked(lexemes);
    inverted(lexemes);
    existing(lexemes);
}

/// "Is there a horse? If not, put ...".
fn asked(lexemes: &mut Vec<Lexeme>) {
    let Some(words) = longest_phrase(lexemes, ASKED) else { return };
    let Some(mark) = (words..lexemes.len()).find(|at| lexemes[*at].token == Token::Break) else { return };
    let behind = mark + lexemes[mark..].iter().take_while(|lexeme| is_mark(lexeme)).count();
    let rest = lexemes[behind..].to_vec();
    // "There is none, so" has a comma in it.
    let plain: Vec<Lexeme> = rest
        .iter()
        .enumerate()
        .filter(|(at, lexeme)| *at > 4 || !is_mark(lexeme))
        .map(|(_, lexeme)| lexeme.clone())
        .collect();
    let (so, not_so) = (longest_phrase(&rest, SO), longest_phrase(&plain, NOT_SO));
    let place = lexemes[0].clone();
    let mut thing = lexemes[words..mark].to_vec();
    let (start, then) = match (so, not_so) {
        (_, Some(words)) => {
            let article = longest_phrase(&thing, &["a", "an", "any", "some", "the"]).unwrap_or(0);
            thing.drain(..article);
            ("if there is no", plain[words..].to_vec())
        }
        (Some(words), None) => ("if there is", rest[words..].to_vec()),
        (None, None) => return,
    };
    if thing.is_empty() || then.is_empty() {
        return;
    }
    let mark = Lexeme { token: Token::Comma, lemma: None, ..lexemes[mark].clone() };
    let then = then.into_iter().skip_while(is_mark);
    *lexemes = words_at(&place, start).chain(thing).chain([mark]).chain(then).collect();
}

/// "Should a dog be on the square, take it off".
fn inverted(lexemes: &mut Vec<Lexeme>) {
    let starts = |at: usize| at == 0 || is_mark(&lexemes[at - 1]);
    let found = (0..lexemes.len()).filter(|at| starts(*at)).find_map(|at| {
        let words = longest_phrase(
            &lexemes[at..],
            &[
                "should a",
                "should an",
                "should any",
                "should one",
                "should there be a",
                "should there be any",
                "should there be an",
            ],
        )?;
        let end = at + lexemes[at..].iter().position(is_mark)?;
        let be = (at + words + 1..end)
            .find_map(|be| longest_phrase(&lexemes[be..end], BE).map(|count| (be, count)));
        Some((at, words, be))
    });
    let Some((at, words, be)) = found else { return };
    if let Some((be, count)) = be {
        lexemes.drain(be..be + count);
    }
    let place = lexemes[at].clone();
    lexemes.splice(at..at + words, words_at(&place, "if there is a"));
}

/// "If a cone exists, ...".
fn existing(lexemes: &mut Vec<Lexeme>) {
    let Some(at) = (0..lexemes.len()).find(|at| longest_phrase(&lexemes[*at..], &["if"]).is_some()) else {
        return;
    };
    let end = at + lexemes[at..].iter().position(is_mark).unwrap_or(lexemes.len() - at);
    let Some(exists) = (at + 2..end).find(|at| {
        longest_phrase(&lexemes[*at..end], &["exists", "exist", "is present", "is there", "are there"])
            == Some(end - at)
    }) else {
        return;
    };
    lexemes.drain(exists..end);
    let place = lexemes[at].clone();
    let article = longest_phrase(&lexemes[at + 1..], &["there is", "there are"]).is_none();
    if article {
        lexemes.splice(at..=at, words_at(&place, "if there is"));
    }
}

/// Every word of these tables, for the spelling.
pub(super) fn words() -> impl Iterator<Item = &'static str> {
    ASKED.iter().chain(SO).chain(NOT_SO).chain(BE).flat_map(|phrase| phrase.split(' '))
}
