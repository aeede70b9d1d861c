//! What somebody puts right a sentence later, or in many words: "south of the hydrant. Actually no, make that north of it", "open a parasol, I mean place
//! one, beside the bench", "a swing set, oh wait, my mistake, a seesaw".
//!
//! The other corrections ([`super::repairs`]) are of the kind of what stands just before them. These are looked for only where a sentence was refused.

use super::super::compass::DIRECTIONS;
use super::super::lexer::{Lexeme, Token, is_mark};
use super::super::lexicon::{longest, longest_phrase};
use super::super::numbers;
use super::super::phrases::Phrases;
use super::breaks::new_before;
use super::forms::{word, words_at};
use super::repairs::{TAKEN_BACK, needs_anchor};
use super::words::{VERBS, WAYS};

/// That what was said was wrong, in words by which nothing else is taken back.
#[rustfmt::skip]
const MISTAKEN: &Phrases = &Phrases::of(&["wait", "oh wait", "no wait", "wait no", "wait wait", "my mistake", "sorry my mistake", "my bad", "silly me", "stupid me", "whoops", "oops", "what am i saying", "slip of the tongue", "wrong word", "thats wrong", "that is wrong", "no thats wrong", "thats not right", "that is not right", "thats not it", "i misspoke", "i take that back", "i take it back", "wait a second", "wait a minute", "wait a moment", "hold on a second", "hang on a second", "hold on a moment", 
    "force of habit", "i said that wrong", "i got that wrong", "i got it wrong", "i made a mistake", "got that wrong", "let me correct that", "let me correct myself", "let me rephrase", "let me rephrase that", "let me start again", "let me start over", "how silly of me", "how stupid of me", "i meant something else", "thats not what i meant", "that is not what i meant", "not what i meant", "i mixed that up", "i mixed them up", "i changed my mind", "ive changed my mind", "i have changed my mind", "change of plan", "change of plans", "change of mind", "new plan", "no no no"]);
/// Before what is meant.
#[rustfmt::skip]
const MAKES: &Phrases = &Phrases::of(&["make that", "make it", "make them", "put it", "put them", "put that", "let it be", "have it", "i want it", "i want them", "it should be", "it should go", "it should stand", "they should be", "it goes", "it belongs", "better", "rather", "i mean", "i meant", "place it", "move it"]);
/// What was spoken of.
const IT: &Phrases = &Phrases::of(&["it", "him", "her", "them", "that"]);
/// A new thing that was spoken of.
const ONE: &Phrases = &Phrases::of(&["one", "it", "them", "that"]);
/// Before a new thing.
const DETERMINERS: &Phrases = &Phrases::of(&["a", "an", "some", "another"]);

/// The words with what is meant in the place of what was taken back, if something was.
pub(super) fn put_right(lexemes: &[Lexeme]) -> Option<Vec<Lexeme>> {
    place_put_right(lexemes).or_else(|| order_put_right(lexemes)).or_else(|| thing_put_right(lexemes))
}

/// "South of the hydrant. Actually no, make that north of it": north of the hydrant.
fn place_put_right(lexemes: &[Lexeme]) -> Option<Vec<Lexeme>> {
    (2..lexemes.len()).filter(|at| is_mark(&lexemes[*at])).find_map(|mark| {
        let (taken, at) = behind_taken_back(lexemes, mark);
        let make = longest_phrase(lexemes.get(at..)?, MAKES).unwrap_or(0);
        let place = at + make;
        let words = place_words(lexemes.get(place..)?)?;
        let it = longest_phrase(lexemes.get(place + words..)?, IT)?;
        let behind = place + words + it;
        let is_whole = taken && lexemes[behind..].iter().all(is_mark);
        let (from, end) = last_place(&lexemes[..mark]).filter(|_| is_whole)?;
        let mut right = lexemes[..from].to_vec();
        right.extend_from_slice(&lexemes[place..place + words]);
        right.extend_from_slice(&lexemes[end..mark]);
        right.extend_from_slice(&lexemes[behind..]);
        Some(right)
    })
}

/// Whether words behind a mark take something back, and where they end.
fn behind_taken_back(lexemes: &[Lexeme], mark: usize) -> (bool, usize) {
    let (mut at, mut taken) = (mark, false);
    while let Some(first) = lexemes.get(at) {
        let rest = &lexemes[at..];
        // "Make that north of it" says itself what is meant.
        let said = if longest_phrase(rest, MAKES).is_some() {
            None
        } else {
            longest_phrase(rest, TAKEN_BACK).max(longest_phrase(rest, MISTAKEN))
        };
        match said {
            Some(words) => (taken, at) = (true, at + words),
            None if is_mark(first) => at += 1,
            None => break,
        }
    }
    (taken, at)
}

/// How many words tell a place that something else follows: "next to", "north of".
fn place_words(rest: &[Lexeme]) -> Option<usize> {
    let compass = longest(rest, DIRECTIONS)
        .and_then(|(_, words)| Some(words + longest_phrase(rest.get(words..)?, &["of"])?));
    let to_the = longest_phrase(rest, &["to the", "on the", "in the", "at the"]).unwrap_or(0);
    let far = || {
        let (_, words) = longest(rest.get(to_the..)?, DIRECTIONS)?;
        Some(to_the + words + longest_phrase(rest.get(to_the + words..)?, &["of"])?)
    };
    let way = || longest(rest, &WAYS).filter(|(way, _)| needs_anchor(*way)).map(|(_, words)| words);
    compass.or_else(far).or_else(way)
}

/// Where the last place begins of which something is told, and where its words end.
fn last_place(before: &[Lexeme]) -> Option<(usize, usize)> {
    /// So many words it takes at most.
    const LONGEST: usize = 6;
    let end_at =
        |at: usize| place_words(&before[at..]).map(|words| at + words).filter(|end| *end < before.len());
    let (last, end) = (1..before.len()).rev().find_map(|at| Some((at, end_at(at)?)))?;
    // "To the left of" is longer than "left of".
    let from = (last.saturating_sub(LONGEST).max(1)..=last).find(|at| end_at(*at) == Some(end))?;
    Some((from, end))
}

/// "Open a parasol, I mean place one, beside the bench": place a parasol there.
fn order_put_right(lexemes: &[Lexeme]) -> Option<Vec<Lexeme>> {
    (2..lexemes.len()).filter(|at| is_mark(&lexemes[*at])).find_map(|mark| {
        let (taken, at) = behind_meant(lexemes, mark);
        let (_, verb) = longest(lexemes.get(at..)?, &VERBS).filter(|_| taken)?;
        let one = longest_phrase(lexemes.get(at + verb..)?, ONE)?;
        let mut behind = at + verb + one;
        let begin =
            lexemes[..mark].iter().rposition(|lexeme| lexeme.token == Token::Break).map_or(0, |at| at + 1);
        let (from, thing) = (begin..mark).find_map(|from| {
            let (_, words) = longest(&lexemes[from..mark], &VERBS)?;
            let thing = from + words;
            is_new(lexemes.get(thing..mark)?).then_some((from, thing))
        })?;
        if lexemes.get(behind).is_some_and(|lexeme| lexeme.token == Token::Comma)
            && longest(&lexemes[behind + 1..], &WAYS).is_some()
        {
            behind += 1;
        }
        let mut right = lexemes[..from].to_vec();
        right.extend_from_slice(&lexemes[at..at + verb]);
        right.extend_from_slice(&lexemes[thing..mark]);
        right.extend_from_slice(&lexemes[behind..]);
        Some(right)
    })
}

/// As [`behind_taken_back`], by "I mean" too.
fn behind_meant(lexemes: &[Lexeme], mark: usize) -> (bool, usize) {
    let (taken, at) = behind_taken_back(lexemes, mark);
    let meant = lexemes.get(at..).and_then(|rest| {
        longest_phrase(rest, &["i mean", "i meant", "i mean to", "i meant to", "rather", "i should say"])
    });
    (taken || meant.is_some(), at + meant.unwrap_or(0))
}

/// "A swing set, oh wait, my mistake, a seesaw": the seesaw.
fn thing_put_right(lexemes: &[Lexeme]) -> Option<Vec<Lexeme>> {
    (1..lexemes.len()).find_map(|at| {
        let begins = is_mark(&lexemes[at]) || longest_phrase(&lexemes[at..], MISTAKEN).is_some();
        let end = mistaken_until(lexemes, at).filter(|_| begins)?;
        let rest = lexemes.get(end..).filter(|rest| !rest.is_empty())?;
        let old = new_before(lexemes, at).filter(|_| is_new(rest));
        let mut right = lexemes[..old.unwrap_or(at)].to_vec();
        if old.is_none() {
            let comma = Lexeme { token: Token::Comma, lemma: None, ..lexemes[at].clone() };
            right.push(comma.clone());
            right.extend(words_at(&lexemes[at], "no wait"));
            right.push(comma);
        }
        right.extend_from_slice(rest);
        Some(right)
    })
}

/// Where words end that say that something was wrong, the last of them before a mark.
fn mistaken_until(lexemes: &[Lexeme], from: usize) -> Option<usize> {
    let (mut at, mut mistaken) = (from, 0);
    while let Some(first) = lexemes.get(at) {
        let rest = &lexemes[at..];
        let wrong = longest_phrase(rest, MISTAKEN);
        let said = wrong.max(longest_phrase(rest, TAKEN_BACK));
        match said {
            Some(words) => {
                mistaken += usize::from(wrong.is_some());
                at += words;
            }
            None if is_mark(first) => at += 1,
            None => break,
        }
    }
    let is_marked = at > from && is_mark(&lexemes[at - 1]);
    // "No wait" alone is known to those who put right by kinds.
    let is_more = mistaken > 1 || mistaken == 1 && longest_phrase(&lexemes[from..], TAKEN_BACK).is_none();
    (is_marked && is_more && at > from + 1).then_some(at)
}

/// "A seesaw", "two chairs".
fn is_new(rest: &[Lexeme]) -> bool {
    let number = numbers::count(rest).map(|(_, words)| words);
    longest_phrase(rest, DETERMINERS).or(number).is_some_and(|words| !word(rest, words).is_empty())
}

#[cfg(test)]
mod tests {
    use super::super::super::lexer::rewritten;
    use super::put_right;

    fn plain(said: &str) -> String {
        rewritten(said, |lexemes| {
            if let Some(right) = put_right(lexemes) {
                *lexemes = right;
            }
        })
    }

    #[test]
    fn what_is_meant_takes_the_place_of_what_was_said() {
        for (said, meant) in [
            (
                "set down a suitcase south of the hydrant, actually no, make that north of it",
                "set down a suitcase north of the hydrant",
            ),
            ("put a bin to the left of the oak, no, sorry, put it behind it", "put a bin behind the oak"),
            ("open a parasol, i mean place one, beside the bench", "place a parasol beside the bench"),
            (
                "could we have a swing set, oh wait, my mistake, a seesaw west of the statue",
                "could we have a seesaw west of the statue",
            ),
            // Nothing is taken back by these.
            (
                "put a bench south of the oak, and a bin north of it",
                "put a bench south of the oak , and a bin north of it",
            ),
            ("put a bench south of the oak, make it red", "put a bench south of the oak , make it red"),
            ("remove the oak, i mean it", "remove the oak , i mean it"),
        ] {
            assert_eq!(plain(said), meant, "{said}");
        }
    }
}
