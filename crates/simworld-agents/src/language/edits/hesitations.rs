//! What somebody puts right where he hesitates: "the blue bench, hmm, the red bench, I mean, five metres south", "six, er, seven metres", "between
//! Carol and, sorry, Dmitri".
//!
//! A sound between two commas is left out with both when a sentence is heard. Where what stands before it and what stands behind it are of one kind, and
//! nothing lists them, the second is meant; of certain things that are those of one class.

use super::super::lexer::{Lexeme, Token, is_mark};
use super::super::lexicon::{Category, longest, longest_phrase};
use super::super::phrases::Phrases;
use super::breaks::hides_sound;
use super::forms::word;
use super::repairs::{TAKEN_BACK, Value, is_whole_side, value};
use super::replaced::{class_at, is_article};
use super::wording::is_between;
use super::words::{VERBS, WAYS};

/// Before a thing that is known.
const CERTAIN: &Phrases = &Phrases::of(&["the", "that", "this", "my", "our"]);
/// Behind these nothing ends, so that nothing whole stands there which could be taken back.
const JOINTS: &[&str] = &["between", "with", "of", "at", "near", "behind", "beside"];
/// Behind what is meant.
const MEANT: &Phrases = &Phrases::of(&["i mean", "i meant", "i should say", "rather"]);
/// A thing has no more words than that from its article on.
const LONGEST: usize = 5;

/// Puts it right.
pub(super) fn in_plain_words(words: &str, lexemes: &mut Vec<Lexeme>) {
    if !words.contains(',') && !lexemes.iter().any(is_mark) {
        return;
    }
    without_taken_back(lexemes);
    let mut at = 1;
    while at < lexemes.len() {
        let between = words.get(lexemes[at - 1].end..lexemes[at].start).unwrap_or_default();
        if hides_sound(between) {
            if let Some(from) = value_before(lexemes, at) {
                lexemes.drain(from..at);
                at = from;
            } else if let Some((from, end)) = thing_before(lexemes, at) {
                lexemes.drain(from..at);
                without_meant(lexemes, end - (at - from));
                at = from;
            }
        }
        at += 1;
    }
}

/// "Carol and, sorry, Dmitri", "the, no, the red bench": what is said where nothing ends goes with both its commas.
fn without_taken_back(lexemes: &mut Vec<Lexeme>) {
    let mut at = 1;
    while at + 2 < lexemes.len() {
        let said = longest_phrase(&lexemes[at + 1..], TAKEN_BACK).filter(|_| is_comma(lexemes, at));
        let behind = said.map(|said| at + 1 + said).filter(|mark| is_comma(lexemes, *mark));
        let rest = behind.and_then(|mark| lexemes.get(mark + 1..)).unwrap_or_default();
        let is_thing = !rest.is_empty() && longest(rest, &VERBS).is_none() && longest(rest, &WAYS).is_none();
        if let Some(mark) = behind.filter(|_| is_thing) {
            if is_between(lexemes, at) || JOINTS.contains(&word(lexemes, at - 1)) {
                lexemes.drain(at..=mark);
            } else if is_article(&lexemes[at - 1..at]) && is_article(rest) {
                lexemes.drain(at - 1..=mark);
            }
        }
        at += 1;
    }
}

fn is_comma(lexemes: &[Lexeme], at: usize) -> bool {
    lexemes.get(at).is_some_and(|lexeme| lexeme.token == Token::Comma)
}

/// "Six, er, seven metres": where a number, a colour or a direction begins that another of its kind at `at` takes the place of.
fn value_before(lexemes: &[Lexeme], at: usize) -> Option<usize> {
    let (kind, count) = value(&lexemes[at..])?;
    let from = (at.saturating_sub(3)..at)
        .find(|from| value(&lexemes[*from..at]).is_some_and(|own| own == (kind, at - from)))?;
    let is_side = kind != Value::Side || is_whole_side(&lexemes[at..]);
    let is_same = |lexemes: &[Lexeme]| value(lexemes).is_some_and(|(other, _)| other == kind);
    let (behind, begin) = (at + count, from.saturating_sub(1));
    // "Red, blue, er, green ones" are of three colours, and (3, 4) is a point.
    let goes_on = is_joint(lexemes, behind)
        || lexemes.get(behind).is_some_and(is_mark) && lexemes.get(behind + 1..).is_some_and(is_same);
    let is_listed = from > 0
        && (is_joint(lexemes, begin)
            || lexemes[begin].token == Token::Open
            || is_mark(&lexemes[begin]) && begin > 0 && is_same(&lexemes[begin - 1..begin]));
    (is_side && !goes_on && !is_listed).then_some(from)
}

/// "The blue bench, hmm, the red bench": where a certain thing begins that another of its class at `at` takes the place of, and where that ends.
fn thing_before(lexemes: &[Lexeme], at: usize) -> Option<(usize, usize)> {
    let (class, end) = certain_thing(lexemes, at)?;
    let from = (at.saturating_sub(LONGEST)..at).rev().find(|from| {
        certain_thing(lexemes, *from).is_some_and(|(own, stop)| stop == at && std::ptr::eq(own, class))
    })?;
    let is_listed = is_joint(lexemes, end)
        || from > 0 && (is_joint(lexemes, from - 1) || word(lexemes, from - 1) == "between");
    (!is_listed).then_some((from, end))
}

/// The class of a certain thing that begins here, and where it ends.
fn certain_thing(lexemes: &[Lexeme], from: usize) -> Option<(&'static Category, usize)> {
    longest_phrase(&lexemes[from..], CERTAIN)?;
    let is_word = |at: &usize| lexemes.get(*at).is_some_and(|lexeme| matches!(lexeme.token, Token::Word(_)));
    (from + 1..from + LONGEST - 1).take_while(is_word).find_map(|at| class_at(lexemes, at))
}

/// Whether a word joins what stands before it to what stands behind it.
fn is_joint(lexemes: &[Lexeme], at: usize) -> bool {
    matches!(word(lexemes, at), "and" | "or")
}

/// "The red bench, I mean, five metres south": behind what is meant these words say no more.
fn without_meant(lexemes: &mut Vec<Lexeme>, mark: usize) {
    let said = lexemes.get(mark + 1..).and_then(|rest| longest_phrase(rest, MEANT));
    let Some(end) = said.map(|said| mark + 1 + said).filter(|_| is_comma(lexemes, mark)) else { return };
    let (is_between, is_last) = (is_comma(lexemes, end), lexemes.get(end).is_none_or(is_mark));
    if is_between {
        lexemes.drain(mark..=end);
    } else if is_last {
        lexemes.drain(mark..end);
    }
}

#[cfg(test)]
mod tests {
    use super::super::super::hearing::hear;
    use super::super::super::lexer::rewritten;
    use super::*;

    fn plain(said: &str) -> String {
        rewritten(said, |lexemes| {
            *lexemes = hear(said, None);
            in_plain_words(said, lexemes);
        })
    }

    #[test]
    fn behind_a_sound_the_second_of_two_of_a_kind_is_meant() {
        for (said, meant) in [
            (
                "move the blue bench, hmm, the red bench, I mean, five metres south",
                "move the red bench five metres south",
            ),
            ("delete the blue bench, er, the red bench", "delete the red bench"),
            ("delete the blue bench, er, the red bench, I mean", "delete the red bench"),
            ("put it six, um, seven metres north of the oak", "put it seven metres north of the oak"),
            ("paint it red, hmm, blue", "paint it blue"),
            ("put a bin ten metres north, er, south of the oak", "put a bin ten metres south of the oak"),
            ("put a bin between Carol and, sorry, Dmitri", "put a bin between carol and dmitri"),
            ("paint the, no, the red bench green", "paint the red bench green"),
        ] {
            assert_eq!(plain(said), meant, "{said}");
        }
    }

    #[test]
    fn what_is_listed_or_of_two_kinds_stays() {
        for (said, meant) in [
            ("paint the benches red, blue, er, green", "paint the benches red , blue green"),
            ("we read of towns and, well, they have trees", "we read of towns and , well , they have trees"),
            ("remove the van, um, the oak", "remove the van the oak"),
            (
                "remove the red bench, um, the blue bench and the oak",
                "remove the red bench the blue bench and the oak",
            ),
            ("put a bench here, um, a bin there", "put a bench here a bin there"),
            ("move it left, er, right next to the oak", "move it left right next to the oak"),
            ("put a bench by the oak, no, by the lamp", "put a bench by the oak , no , by the lamp"),
        ] {
            assert_eq!(plain(said), meant, "{said}");
        }
    }
}
