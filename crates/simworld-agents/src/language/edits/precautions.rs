//! Precautions: "just in case of a blaze, put a fire extinguisher there". What may happen one day is why something is wanted, and no condition on what
//! there is now. A condition on the sky ("in case of rain") or on what is there stays one.

use super::super::lexer::{Lexeme, Token, is_mark};
use super::super::lexicon::longest_phrase;
use super::super::phrases::Phrases;
use super::forms::word;

/// What begins a precaution.
#[rustfmt::skip]
const IN_CASE: &Phrases = &Phrases::of(&["just in case of", "in case of", "in the event of", "just in case there is", "just in case theres", "just in case there was", "just in case there should be", "just in case we have", "just in case they have", "just in case somebody has", "just in case someone has"]);
/// Before what may happen.
const BEFORE: &Phrases = &Phrases::of(&["a", "an", "any", "another", "some", "the", "more"]);
/// What may happen one day, and is nothing that stands anywhere.
#[rustfmt::skip]
const EVENTS: &Phrases = &Phrases::of(&["blaze", "blazes", "fire", "fires", "emergency", "emergencies", "an emergency", "accident", "accidents", "trouble", "burglary", "burglaries", "burglars", "thieves", "theft", "thefts", "robbery", "injury", "injuries", "flood", "floods", "flooding",
    "power cut", "power cuts", "blackout", "outage", "power outage", "breakdown", "breakdowns", "disaster", "disasters", "evacuation", "explosion", "heart attack", "attack", "panic", "crash", "crashes", "puncture", "punctures", "leak", "leaks", "spill", "spills", "war", "need", "doubt", "problems", "a problem", "fainting", "illness", "small fire", "house fire", "medical emergency", "medical emergencies"]);

/// Leaves precautions out that stand between marks.
pub(super) fn leave_out(lexemes: &mut Vec<Lexeme>) {
    let mut at = 0;
    while at < lexemes.len() {
        let begins =
            at == 0 || is_mark(&lexemes[at - 1]) || ["and", "then", "so"].contains(&word(lexemes, at - 1));
        if let Some(end) = end_of(lexemes, at)
            && (begins || is_last(lexemes, at, end))
        {
            let (from, to) = with_its_marks(lexemes, at, end);
            lexemes.drain(from..to);
        } else {
            at += 1;
        }
    }
}

/// Where the precaution ends that begins here, before a mark or with the words.
fn end_of(lexemes: &[Lexeme], at: usize) -> Option<usize> {
    let case = at + longest_phrase(&lexemes[at..], IN_CASE)?;
    let rest = lexemes.get(case..)?;
    let from = case + longest_phrase(rest, BEFORE).unwrap_or(0);
    let end = from + longest_phrase(lexemes.get(from..)?, EVENTS)?;
    lexemes.get(end).is_none_or(is_mark).then_some(end)
}

/// Whether a precaution stands at the end of its sentence, behind what it is for.
fn is_last(lexemes: &[Lexeme], at: usize, end: usize) -> bool {
    at > 1 && lexemes.get(end).is_none_or(|mark| mark.token == Token::Break)
}

/// The words with one of the marks around them, or with both where nothing but a joint stands before.
fn with_its_marks(lexemes: &[Lexeme], at: usize, end: usize) -> (usize, usize) {
    let is_comma = |at: usize| lexemes.get(at).is_some_and(|lexeme| lexeme.token == Token::Comma);
    let before = at > 0 && is_comma(at - 1);
    let behind = is_comma(end);
    let joint = at.checked_sub(if before { 2 } else { 1 }).map_or("", |at| word(lexemes, at));
    let is_joint = ["and", "then", "so", "but", "also", "please"].contains(&joint);
    let from = if before && (is_joint || !behind) { at - 1 } else { at };
    let to = if behind && (from == at || is_joint) { end + 1 } else { end };
    (from, to)
}

#[cfg(test)]
mod tests {
    use super::super::super::lexer::rewritten;
    use super::leave_out;

    fn plain(said: &str) -> String {
        rewritten(said, leave_out)
    }

    #[test]
    fn what_may_happen_is_no_condition() {
        for (said, meant) in [
            (
                "uproot the hydrant, then, just in case of a blaze, put a tent in its place",
                "uproot the hydrant , then put a tent in its place",
            ),
            ("in case of fire, put a bucket by the oak", "put a bucket by the oak"),
            ("put a bucket by the oak, just in case of fire", "put a bucket by the oak"),
            ("put a bucket by the oak in case of fire", "put a bucket by the oak"),
            ("remove it, and in case of an emergency, add a ladder", "remove it , and add a ladder"),
        ] {
            assert_eq!(plain(said), meant, "{said}");
        }
    }

    #[test]
    fn conditions_stay() {
        for said in [
            "in case of rain , put an umbrella next to fay",
            "in case there is a campfire , put a bucket next to it",
            "just in case of a fire engine , add a hydrant",
        ] {
            assert_eq!(plain(said), said);
        }
    }
}
