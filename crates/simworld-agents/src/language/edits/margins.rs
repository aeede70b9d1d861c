//! How much room stays between what is put somewhere and something else, told by what is left: "a planter so that 80 cm stay free between it and the
//! statue", "leaving two metres between it and the kiosk", "with half a metre of clearance to the wall". Each is "with a gap of 80 cm to the statue".
//!
//! Such a clause begins like one that says what for, and would be left out as one; but it says where.

use super::super::lexer::{Lexeme, Token};
use super::super::lexicon::{longest, longest_phrase};
use super::super::numbers;
use super::super::phrases::Phrases;
use super::forms::{word, word_at, words_at};
use super::words::{WAYS, Way};

/// Before how much room is left.
#[rustfmt::skip]
const LEADS: &Phrases = &Phrases::of(&["so that", "such that", "in such a way that", "so there is", "so there are", "so that there is", "so that there are", "so that there remain", "so that there remains", "so as to leave", "so as to keep", "so that you leave", "so that it leaves", "so you leave", "leaving", "and leave", "but leave", "and keep", "but keep", "keeping", "with"]);
/// Before a length, that it is just that; "at least" is another thing.
const JUST: &Phrases = &Phrases::of(&[
    "a gap of",
    "a distance of",
    "a space of",
    "exactly",
    "precisely",
    "just",
    "about",
    "some",
    "a full",
    "a good",
]);
/// That it is left, and of what.
#[rustfmt::skip]
const FREE: &Phrases = &Phrases::of(&["of free space", "of free room", "of space", "of room", "of clearance", "of distance", "of air", "of open space", "of clear space", "space", "room", "clearance", "distance", "free", "clear", "empty", "open", "left", "spare", "stay", "stays", "remain", "remains", "is", "are", "is left", "are left", "will stay", "will remain", "be", "stand"]);
/// Of these, those that tell a length from one by which something stands to a side.
const ROOM: &[&str] =
    &["space", "room", "clearance", "distance", "air", "free", "clear", "empty", "open", "left", "spare"];
/// What it is left from, which is what is put there.
const ITSELF: &Phrases = &Phrases::of(&[
    "between it and",
    "between them and",
    "between him and",
    "between her and",
    "between itself and",
    "between this and",
    "between that and",
]);
/// Before the noun of what is put there.
const ARTICLES: &Phrases = &Phrases::of(&["the", "this", "that", "my", "our"]);
/// A noun has no more words than that.
const LONGEST: usize = 3;

/// Puts it as a gap.
pub(super) fn in_plain_words(lexemes: &mut Vec<Lexeme>) {
    let Some((from, (start, stop), end)) = (1..lexemes.len()).find_map(|from| margin(lexemes, from)) else {
        return;
    };
    let place = lexemes[from].clone();
    let length = lexemes[start..stop].to_vec();
    // "At least two metres" are two or more.
    let is_least = longest_phrase(&length, &["at least"]).is_some();
    let (before, behind) = if is_least { (None, "from") } else { (Some("with a gap of"), "to") };
    let before = before.into_iter().flat_map(|said| words_at(&place, said));
    let plain: Vec<Lexeme> = before.chain(length).chain([word_at(&place, behind)]).collect();
    let is_led = lexemes[from - 1].token == Token::Comma;
    lexemes.splice(from - usize::from(is_led)..end, plain);
}

/// Whether some words say how much room is left to something.
pub(super) fn tells_room(clause: &[Lexeme]) -> bool {
    let any = |fits: &dyn Fn(&[Lexeme]) -> bool| (0..clause.len()).any(|at| fits(&clause[at..]));
    any(&|rest| numbers::length(rest).is_some_and(|(_, words)| words > 1))
        && any(&|rest| longest_phrase(rest, &["between", "apart", "clearance", "gap"]).is_some())
}

/// The clause that begins here: where its length begins and ends, and where what it is to begins.
fn margin(lexemes: &[Lexeme], from: usize) -> Option<(usize, (usize, usize), usize)> {
    let mut start = from + longest_phrase(&lexemes[from..], LEADS)?;
    start += longest_phrase(lexemes.get(start..)?, JUST).unwrap_or(0);
    let (_, words) = numbers::length(lexemes.get(start..)?).filter(|(_, words)| *words > 1)?;
    let stop = start + words;
    let mut at = stop;
    while let Some(words) = longest_phrase(lexemes.get(at..)?, FREE) {
        at += words;
    }
    let is_room = (stop..at).any(|at| ROOM.contains(&word(lexemes, at)));
    let rest = lexemes.get(at..)?;
    let to = longest_phrase(rest, ITSELF).or_else(|| between_noun(lexemes, from, at)).or_else(|| {
        // "To the left of" is a side.
        let is_side = longest(rest, &WAYS).is_some_and(|(way, words)| words > 1 && way != Way::At);
        longest_phrase(rest, &["to", "from"]).filter(|_| is_room && !is_side)
    })?;
    (at + to < lexemes.len()).then_some((from, (start, stop), at + to))
}

/// "Between the planter and", where a planter was named before.
fn between_noun(lexemes: &[Lexeme], from: usize, at: usize) -> Option<usize> {
    let between = longest_phrase(lexemes.get(at..)?, &["between"])?;
    let noun = at + between + longest_phrase(lexemes.get(at + between..)?, ARTICLES)?;
    let and = (noun + 1..=noun + LONGEST).find(|at| word(lexemes, *at) == "and")?;
    let is_new = (1..from).any(|at| {
        longest_phrase(&lexemes[at - 1..], &["a", "an", "another", "one"]).is_some()
            && (at..from.min(at + LONGEST)).any(|at| lexemes[at].token == lexemes[and - 1].token)
    });
    is_new.then_some(and + 1 - at)
}

#[cfg(test)]
mod tests {
    use super::super::super::lexer::rewritten;
    use super::in_plain_words;

    #[test]
    fn what_is_left_is_a_gap() {
        for (said, meant) in [
            (
                "set down a planter so that 80 cm stay free between it and the statue",
                "set down a planter with a gap of 80 cm to the statue",
            ),
            ("put a bin, leaving 2 m between it and the kiosk", "put a bin with a gap of 2 m to the kiosk"),
            (
                "put a bin with 2 metres of clearance to the kiosk",
                "put a bin with a gap of 2 metres to the kiosk",
            ),
            (
                "put a bin so that at least 2 m stay free between it and the kiosk",
                "put a bin at least 2 m from the kiosk",
            ),
            (
                "put a bin so that there is 1 metre of space between the bin and the oak",
                "put a bin with a gap of 1 metre to the oak",
            ),
        ] {
            assert_eq!(rewritten(said, in_plain_words), meant, "{said}");
        }
    }

    #[test]
    fn what_is_no_gap_stays() {
        for said in [
            "put benches with 2 metres between them",
            "put a row of lamps with 5 metres between the oak and the kiosk",
            "put a bin so that people can sit between it and the oak",
            "put a bin with 2 metres to the left of the oak",
        ] {
            assert_eq!(rewritten(said, in_plain_words), said, "{said}");
        }
    }
}
