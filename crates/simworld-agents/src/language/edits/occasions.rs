//! Occasions of which is told beside a request: "we're having a party: ...", "..., we are having a concert". None of them is anything that is to
//! be put anywhere.

use super::super::lexer::{Lexeme, Token, is_mark};
use super::super::lexicon::{longest, longest_phrase};
use super::super::phrases::Phrases;
use super::retold::last_mark;
use super::words::WAYS;

/// Before an occasion.
const HAVING: &Phrases = &Phrases::of(&[
    "were having a",
    "we are throwing a",
    "we are planning a",
    "i am throwing a",
    "i am planning a",
    "they are having a",
    "they are throwing a",
    "we are having a",
    "im having a",
    "i am having a",
    "theyre having a",
    "were throwing a",
    "im throwing a",
    "weve got a",
    "were having our",
    "were planning a",
    "im planning a",
    "were celebrating a",
]);
/// What is no thing, though some are held in houses that are called after it.
#[rustfmt::skip]
const EVENTS: &[&str] = &["concert", "wedding", "party", "festival", "parade", "celebration", "reception", "ceremony", "jubilee", "gala", "rehearsal", "recital", "fair", "meeting"];

/// Leaves an occasion out that is told before a request, or at its end.
pub(super) fn leave_out(lexemes: &mut Vec<Lexeme>) {
    let end = last_mark(lexemes);
    if let Some(mark) = lexemes[..end].iter().rposition(is_mark).filter(|mark| *mark > 2)
        && longest_phrase(&lexemes[mark + 1..end], HAVING).is_some_and(|words| mark + words + 3 >= end)
        && matches!(&lexemes[end - 1].token, Token::Word(word) if EVENTS.contains(&word.as_str()))
    {
        lexemes.drain(mark..end);
        return;
    }
    let Some(mark) = lexemes.iter().position(is_mark).filter(|mark| mark + 1 < lexemes.len()) else { return };
    let is_plain = mark <= 9
        && longest_phrase(lexemes, HAVING).is_some()
        && !(0..mark).any(|at| longest(&lexemes[at..], &WAYS).is_some_and(|(_, words)| words > 1));
    if is_plain {
        lexemes.drain(..=mark);
    }
}
