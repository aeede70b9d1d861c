//! New things that are to be like one that is there, or are spoken of as the new one: "another postbox, exactly like the one we've got"
//! is a copy of the postbox, and "the new one" behind what was just asked for is that.

use super::super::compass::DIRECTIONS;
use super::super::lexer::{Lexeme, Token, is_mark};
use super::super::lexicon::{longest, longest_phrase};
use super::super::paint::PAINTS;
use super::super::phrases::Phrases;
use super::forms::{word, word_at, words_at};
use super::words::WAYS;

/// Before what is to be copied.
#[rustfmt::skip]
const LIKE: &Phrases = &Phrases::of(&["like", "exactly like", "just like", "precisely like", "the same as", "exactly the same as", "just the same as", "same as", "identical to", "similar to", "of the same kind as", "the very same as", "a twin of", "which is like", "that is like", "that looks like", "that looks just like", "that looks exactly like", "which looks like"]);
/// Of the one that is there, what says no more than that.
#[rustfmt::skip]
const THERE: &[&str] = &["that", "which", "is", "s", "stands", "stand", "we", "you", "they", "i", "have", "ve", "weve", "youve", "theyve", "ive", "got", "had", "has", "already", "there", "thats", "now", "standing", "over", "own"];
/// A noun has no more words than that.
const LONGEST: usize = 3;
/// Before a noun, that it is to be one more.
#[rustfmt::skip]
const ONE_MORE: &Phrases = &Phrases::of(&["another", "yet another", "one more", "a second", "a further", "an additional", "an extra", "one other"]);
/// What stands for one more of what was spoken of, and for that.
const MORE: &[&str] = &["another one", "another", "one more"];
const THAT: &[&str] = &["that one", "this one", "that thing", "this thing", "that", "this"];
/// Behind that, where nothing follows that it would belong to.
const ENDS: &[&str] = &["here", "there", "and", "too", "please", "also", "as well"];

/// Puts the words so.
pub(super) fn in_plain_words(lexemes: &mut Vec<Lexeme>) {
    like_it(lexemes);
    if let Some(plain) = copied(lexemes) {
        *lexemes = plain;
    }
    the_new_one(lexemes);
}

/// "Another one like that next to the fountain": like it.
fn like_it(lexemes: &mut Vec<Lexeme>) {
    let that = (0..lexemes.len()).find_map(|at| {
        let more = at + longest_phrase(&lexemes[at..], MORE)?;
        let from = more + longest_phrase(&lexemes[more..], LIKE)?;
        let end = from + longest_phrase(&lexemes[from..], THAT)?;
        let behind = &lexemes[end..];
        let ends = behind.first().is_none_or(is_mark)
            || longest(behind, &WAYS).is_some()
            || longest_phrase(behind, ENDS).is_some();
        ends.then_some(from..end)
    });
    if let Some(that) = that {
        let it = word_at(&lexemes[that.start], "it");
        lexemes.splice(that, [it]);
    }
}

/// "Another bench like the red one": a copy of the red bench.
fn copied(lexemes: &[Lexeme]) -> Option<Vec<Lexeme>> {
    (0..lexemes.len()).find_map(|at| {
        let more = longest_phrase(&lexemes[at..], ONE_MORE)?;
        copied_at(lexemes, at, at + more)
    })
}

/// As [`copied`], of the noun behind the words that say so.
fn copied_at(lexemes: &[Lexeme], another: usize, noun: usize) -> Option<Vec<Lexeme>> {
    let (stop, behind) = (noun + 1..lexemes.len().min(noun + LONGEST + 1)).find_map(|stop| {
        let from = stop + usize::from(is_mark(&lexemes[stop]));
        longest_phrase(&lexemes[from..], LIKE).map(|words| (stop, from + words))
    })?;
    let name = lexemes.get(noun..stop).filter(|name| !name.iter().any(is_mark))?;
    // "One more like that one" is read elsewhere.
    let is_another = word(lexemes, noun - 1) == "another";
    longest_phrase(&lexemes[behind..], &["the", "our", "ours"]).or(is_another.then_some(0))?;
    // "Like the one we have", "like ours", "like the red one".
    let the = longest_phrase(&lexemes[behind..], &["the", "that", "this", "our", "those"]).unwrap_or(0);
    let paint = longest(&lexemes[behind + the..], PAINTS).map_or(0, |(_, words)| words);
    let one = behind + the + paint;
    let said =
        longest_phrase(&lexemes[one..], &["one", "first one", "old one", "other one", "first", "other"])
            .or_else(|| longest_phrase(&lexemes[behind..], &["ours", "that"]).filter(|_| the == 0))
            .or_else(|| {
                let own = lexemes.get(one..one + name.len())?;
                let is_named = own.iter().map(|word| &word.token).eq(name.iter().map(|word| &word.token));
                is_named.then_some(name.len())
            })?;
    let mut end = one + said;
    // "The one we have in front of the dorm" may be there, or to be put there: the marks say which.
    while THERE.contains(&word(lexemes, end))
        && longest(&lexemes[end..], &WAYS).is_none_or(|(_, words)| words == 1)
    {
        end += 1;
    }
    let is_apart = lexemes.get(stop).is_some_and(is_mark);
    let ends = lexemes.get(end + 1).is_none_or(is_mark);
    end += usize::from(is_apart && ends && word(lexemes, end) == "here");
    // "..., east of the kiosk" is where the copy goes.
    let is_place = lexemes
        .get(end + 1..)
        .is_some_and(|rest| longest(rest, &WAYS).is_some() || longest(rest, DIRECTIONS).is_some());
    let drops = is_apart || is_place && !is_another;
    end += usize::from(drops && lexemes.get(end).is_some_and(|mark| mark.token == Token::Comma));
    let place = &lexemes[another];
    let plain: Vec<Lexeme> = words_at(place, "a copy of the")
        .chain(lexemes[behind + the..behind + the + paint].iter().cloned())
        .chain(name.iter().cloned())
        .collect();
    let mut words = lexemes[..another].to_vec();
    words.extend(plain);
    words.extend_from_slice(&lexemes[end..]);
    Some(words)
}

/// "Put a table here and paint the new one green", "... the new table": what was just asked for.
fn the_new_one(lexemes: &mut Vec<Lexeme>) {
    let new =
        |at: usize| word(lexemes, at) == "the" && ["new", "newer", "added"].contains(&word(lexemes, at + 1));
    let Some(at) = (3..lexemes.len()).find(|at| new(*at)) else { return };
    let noun = word(lexemes, at + 2).to_owned();
    let is_one = noun == "one";
    let single = |before: usize| {
        ["a", "an", "one", "another"].contains(&word(lexemes, before))
            && (is_one || (before + 1..at.min(before + 4)).any(|at| word(lexemes, at) == noun))
    };
    // Of several new things nobody knows which.
    let told = (0..at).filter(|before| single(*before)).count();
    if told != 1 || noun.is_empty() {
        return;
    }
    let place = lexemes[at].clone();
    lexemes.splice(at..at + 3, [word_at(&place, "it")]);
}

/// Every word of these tables, for the spelling.
pub(super) fn words() -> impl Iterator<Item = &'static str> {
    LIKE.iter().flat_map(|phrase| phrase.split(' ')).chain(THERE.iter().copied())
}

#[cfg(test)]
mod tests {
    use super::super::super::lexer::rewritten;
    use super::*;

    fn plain(said: &str) -> String {
        rewritten(said, in_plain_words)
    }

    #[test]
    fn another_like_one_that_is_there_is_a_copy_of_it() {
        assert_eq!(
            plain("i want another postbox, exactly like the one weve got, next to Carol"),
            "i want a copy of the postbox next to carol"
        );
        assert_eq!(plain("another bench like the red one here"), "a copy of the red bench here");
        assert_eq!(
            plain("one more fountain like the one we have, east of the kiosk"),
            "a copy of the fountain east of the kiosk"
        );
        assert_eq!(plain("a second bench by the red one"), "a second bench by the red one");
        assert_eq!(plain("another bench next to the red one"), "another bench next to the red one");
    }

    #[test]
    fn another_one_like_that_is_one_like_it() {
        assert_eq!(
            plain("add another one like that next to the fountain"),
            "add another one like it next to the fountain"
        );
        assert_eq!(plain("another exactly like that one, please"), "another exactly like it , please");
        assert_eq!(plain("another one like that bench"), "another one like that bench");
        assert_eq!(plain("one more lamp like that one here"), "one more lamp like that one here");
    }

    #[test]
    fn the_new_one_is_what_was_just_asked_for() {
        assert_eq!(
            plain("put a table here and paint the new one green"),
            "put a table here and paint it green"
        );
        assert_eq!(plain("paint the new one green"), "paint the new one green");
    }
}
