//! How people talk who want something of the scene: what opens and closes the talk ([`super::openings`]), negations that add nothing ([`super::denied`]),
//! what is put right a sentence later ([`super::reconsidered`]) and turns of phrase ([`super::talk_turns`]), one after the other.
//!
//! What would be misunderstood is told plainly before it is read. All else is tried only where a sentence was refused, and counts only if what is left is
//! granted; so nothing that is understood is read otherwise.

use super::super::lexer::{Lexeme, Token, is_mark, word_of};
use super::super::lexicon::longest_phrase;
use super::super::names::Names;
use super::super::numbers;
use super::super::phrases::Phrases;
use super::forms::{is_same, word, word_at, words_at};
use super::retold::told_by;
use super::statements::clauses;
use super::talk_turns::{TALK, TALK_FIRST};
use super::{denied, openings, reconsidered};

/// All the way round, before a mark.
#[rustfmt::skip]
const ROUND: &Phrases = &Phrases::of(&["right round", "right around", "completely round", "completely around", "all the way round", "all the way around", "fully round", "fully around", "clean round", "totally round", "the whole way round", "entirely around", "entirely round"]);
/// That much, behind it.
const HALF_A_TURN: &Phrases = &Phrases::of(&["half a turn", "a half turn", "a half", "by half a turn"]);
/// Several in a line.
#[rustfmt::skip]
const STRINGS: &Phrases = &Phrases::of(&["a string of", "a series of", "a succession of", "a procession of", "a file of", "a column of", "a chain of", "a rank of", "a sequence of", "a parade of", "a train of"]);
/// That they stand evenly, between two commas.
#[rustfmt::skip]
const EVENLY: &Phrases = &Phrases::of(&["evenly spread", "spread evenly", "evenly spaced", "spaced evenly", "evenly distributed", "equally spaced", "spread out evenly", "evenly spread out", "nicely spread", "neatly spaced", "evenly", "at equal distances", "at even distances", "at regular intervals", "regularly spaced", "all evenly spread", "all evenly spaced"]);
/// Prepositions with an "of" too many.
const OVERFULL: &Phrases =
    &Phrases::of(&["behind of", "beside of", "between of", "near of", "near by of", "under of"]);
/// That something is to go, behind its name.
#[rustfmt::skip]
const GOES: &Phrases = &Phrases::of(&["can go", "may go", "must go", "should go", "has to go", "needs to go", "ought to go", "can go too", "may go too", "must go too", "should go too", "has to go too", "can go as well", "may go as well", "must go as well", "can go now", "may go now", "must go now", "can also go", "may also go", "must also go"]);
const JOINTS: &[&str] = &["and", "then", "also"];

/// How something is, at the end of an exclamation.
#[rustfmt::skip]
const IT_IS: &Phrases = &Phrases::of(&["this is", "that is", "it is", "that was", "this was", "it was", "we have", "we have today", "we are having", "we are having today", "weve had", "we had", "it has been", "its been", "this has been", "it is today", "this is today", "today", "it turned out to be", "this turned out to be"]);

/// Puts what would be misunderstood plainly.
pub(super) fn in_plain_words(lexemes: &mut Vec<Lexeme>) {
    without_exclamation(lexemes);
    denied::leave_out(lexemes);
    gone_in_turn(lexemes);
    *lexemes = told_by(lexemes, &[TALK_FIRST]);
}

/// What a sentence may have been meant to say, in plainer words: what is changed least comes first.
pub(super) fn ways(words: &str, heard: &[Lexeme], spelt: &[Lexeme], names: &Names<'_>) -> Vec<Vec<Lexeme>> {
    let mut ways: Vec<Vec<Lexeme>> = Vec::new();
    for said in [heard, spelt] {
        let said = reworded(said);
        let open = openings::without(words, &said, names);
        let plain = denied::without(&open);
        let right = reconsidered::put_right(&plain).unwrap_or_else(|| plain.clone());
        let told = told_by(&right, &[TALK]);
        let told_whole = told_by(&said, &[TALK]);
        for way in [told_whole, said, open, plain, right, told] {
            let is_known = [heard, spelt].into_iter().any(|said| is_same(&way, said))
                || ways.iter().any(|other| is_same(&way, other));
            if !is_known && way.iter().any(|lexeme| !is_mark(lexeme)) {
                ways.push(way);
            }
        }
    }
    ways
}

/// "What a lovely morning this is! Put ...": an exclamation before something else that does not speak of it.
fn without_exclamation(lexemes: &mut Vec<Lexeme>) {
    let lead = usize::from(["oh", "ah", "well", "my"].contains(&word(lexemes, 0)));
    let Some(end) = lexemes.iter().position(|lexeme| lexeme.token == Token::Break) else { return };
    let (said, rest) = (lexemes.get(lead..end).unwrap_or_default(), &lexemes[end + 1..]);
    let exclaims = longest_phrase(said, &["what a", "what an"]).is_some()
        && !said.iter().any(is_mark)
        && (3..said.len()).any(|at| longest_phrase(&said[at..], IT_IS) == Some(said.len() - at));
    let is_open = rest.iter().any(|lexeme| denied::OPEN.contains(&word_of(lexeme)));
    if exclaims && !is_open && rest.iter().any(|lexeme| !is_mark(lexeme)) {
        lexemes.drain(..=end);
    }
}

/// "The bin can go, the sign can go, and Fido ...": what goes one after the other.
fn gone_in_turn(lexemes: &mut Vec<Lexeme>) {
    /// "The old red bench".
    const LONGEST: usize = 4;
    let all = clauses(lexemes);
    let goes = |from: usize, end: usize| {
        let begin = from + usize::from(JOINTS.contains(&word(lexemes, from)));
        let cut = (begin + 2..end.min(begin + 1 + LONGEST))
            .find(|at| longest_phrase(&lexemes[*at..end], GOES) == Some(end - at))?;
        (word(lexemes, begin) == "the").then_some((begin, cut, end))
    };
    let gone: Vec<(usize, usize, usize)> =
        all.iter().filter_map(|clause| goes(clause.from, clause.end)).collect();
    if gone.len() < 2 {
        return;
    }
    for (begin, cut, end) in gone.into_iter().rev() {
        lexemes.drain(cut..end);
        let remove = word_at(&lexemes[begin], "remove");
        lexemes.insert(begin, remove);
    }
}

/// Words that are put otherwise wherever they stand.
pub(super) fn reworded(lexemes: &[Lexeme]) -> Vec<Lexeme> {
    let mut plain = lexemes.to_vec();
    turned_round(&mut plain);
    in_a_row(&mut plain);
    let overfull = (0..plain.len()).find_map(|at| Some((at, longest_phrase(&plain[at..], OVERFULL)?)));
    if let Some((at, words)) = overfull {
        plain.remove(at + words - 1);
    }
    plain
}

/// "Turn the bus right round, 180 degrees": round.
fn turned_round(lexemes: &mut Vec<Lexeme>) {
    let found = (1..lexemes.len()).find_map(|at| {
        let end = at + longest_phrase(&lexemes[at..], ROUND)?;
        lexemes
            .get(end)
            .is_none_or(|lexeme| is_mark(lexeme) || JOINTS.contains(&word(lexemes, end)))
            .then_some((at, end))
    });
    let Some((at, end)) = found else { return };
    let said = lexemes.get(end + 1..).unwrap_or_default();
    let by = longest_phrase(said, &["by", "through"]).unwrap_or(0);
    let degrees = numbers::number(&said[by..])
        .filter(|(number, _)| (number - 180.0).abs() < f64::EPSILON)
        .and_then(|(_, words)| {
            Some(by + words + longest_phrase(said.get(by + words..)?, &["degrees", "degree", "deg", "°"])?)
        });
    let measure = degrees.or_else(|| longest_phrase(said, HALF_A_TURN)).unwrap_or(0);
    let is_whole = measure > 0 && said.get(measure).is_none_or(is_mark);
    let stop = if is_whole { end + 1 + measure } else { end };
    let round = word_at(&lexemes[at], "round");
    lexemes.splice(at..stop, [round]);
}

/// "A string of seven barrels, evenly spread, between ...": a row of seven barrels between.
fn in_a_row(lexemes: &mut Vec<Lexeme>) {
    let found = (0..lexemes.len()).find_map(|at| {
        let end = at + longest_phrase(&lexemes[at..], STRINGS)?;
        numbers::count(&lexemes[end..]).map(|_| (at, end))
    });
    let Some((at, end)) = found else { return };
    let row: Vec<Lexeme> = words_at(&lexemes[at], "a row of").collect();
    lexemes.splice(at..end, row);
    let evenly = (at + 1..lexemes.len()).filter(|mark| is_mark(&lexemes[*mark])).find_map(|mark| {
        let end = mark + 1 + longest_phrase(lexemes.get(mark + 1..)?, EVENLY)?;
        Some((mark, end))
    });
    if let Some((mark, end)) = evenly {
        // The comma behind it goes with it, and the full stop stays.
        let is_comma = lexemes.get(end).is_some_and(|lexeme| lexeme.token == Token::Comma);
        lexemes.drain(mark..end + usize::from(is_comma));
    }
}

#[cfg(test)]
mod tests {
    use super::super::super::lexer::rewritten;
    use super::*;

    #[test]
    fn what_adds_nothing_is_left_out_before_a_sentence_is_read() {
        for (said, meant) in [
            (
                "make a copy of the bench and put it next to carol, the old one may stay where it is",
                "make a copy of the bench and put it next to carol",
            ),
            ("we dont need another bench, what we do need is a fountain", "what we do need is a fountain"),
            ("i would be having a great happiness if it would be snowing", "make it snowing"),
            (
                "the bin can go, the sign can go, and fido should be moved next to hana",
                "remove the bin , remove the sign , and fido should be moved next to hana",
            ),
            ("what a lovely morning this is! put a bench west of carol", "put a bench west of carol"),
            // These say something.
            ("what a fine bench that is! paint it red", "what a fine bench that is , paint it red"),
            ("what a lovely morning this is", "what a lovely morning this is"),
            ("we dont need another bench, remove it", "we dont need another bench , remove it"),
            ("we dont need the bench, add a lamp", "we dont need the bench , add a lamp"),
            ("remove the cars, the old one may stay", "remove the cars , the old one may stay"),
            ("the bin can go, the sign can stay", "the bin can go , the sign can stay"),
        ] {
            assert_eq!(rewritten(said, in_plain_words), meant, "{said}");
        }
    }

    #[test]
    fn negations_that_add_nothing_are_left_out() {
        for (said, meant) in [
            ("put a guitar beside the table, not on it, beside it", "put a guitar beside the table"),
            (
                "i want a pair of beehives near ivy cottage, and not a word to the neighbours",
                "i want a pair of beehives near ivy cottage",
            ),
            ("a bin next to the table, and not a soul more than that", "a bin next to the table"),
            (
                "how many benches have we got, dont add any, i only want to know",
                "how many benches have we got",
            ),
            // These say something.
            (
                "put a guitar on the table, not on it, beside it",
                "put a guitar on the table , not on it , beside it",
            ),
            ("add two benches, dont add any", "add two benches , dont add any"),
            ("remove the red car, not that one", "remove the red car , not that one"),
        ] {
            assert_eq!(rewritten(said, |lexemes| *lexemes = denied::without(lexemes)), meant, "{said}");
        }
    }

    #[test]
    fn what_is_said_round_about_is_put_plainly() {
        for (said, meant) in [
            ("turn the bus right round, 180 degrees", "turn the bus round"),
            ("turn the bus right round", "turn the bus round"),
            (
                "a string of seven barrels, evenly spread, between the pine and the parcel",
                "a row of seven barrels between the pine and the parcel",
            ),
            ("a string of lights along the quay", "a string of lights along the quay"),
        ] {
            assert_eq!(rewritten(said, |lexemes| *lexemes = reworded(lexemes)), meant, "{said}");
        }
    }
}
