//! A sentence that was refused, heard anew in other words: questions ([`super::questions`]), scenes that are set by their weather
//! ([`super::set_scenes`]), everyday verbs and frames ([`super::everyday`]), copies of which is told once more that all of them go somewhere, and what says
//! that nothing else is to be touched.
//!
//! Each comes to plainer words, and counts only if these are granted. So nothing that is understood is read otherwise.

use super::super::lexer::{Lexeme, is_mark, word_of};
use super::super::lexicon::longest_phrase;
use super::super::names::Names;
use super::super::phrases::Phrases;
use super::everyday::EVERYDAY;
use super::forms::is_same;
use super::questions::QUESTIONS;
use super::retold::{Turns, told_by};
use super::set_scenes::SET_SCENES;
use super::{Focus, slips};
use crate::editing::Stock;

/// Several, and behind a mark where all of them go.
#[rustfmt::skip]
const SEVERAL: &Turns = &[
    ("O make|put|create|add|do|have|want|need|give|- D copies|copy|clones|duplicates|replicas|twins of A , all|both|each|every|them|they|one of|one|all|both|go|- them|- W", "O make D copies of A W"),
    ("O put|place|add|set|build|plant|park|have|want|need|- D A , all|both of|- them|these|those|- W", "O put D A W"),
];
/// That nothing else is to be otherwise, behind a request.
#[rustfmt::skip]
const NOTHING_ELSE: &Phrases = &Phrases::of(&["dont touch anything else", "do not touch anything else", "dont change anything else", "do not change anything else", "dont move anything else", "do not move anything else", "dont alter anything else", "do not alter anything else", "dont do anything else", "do not do anything else", "dont touch a thing besides", "dont touch the rest", "do not touch the rest",
    "touch nothing else", "change nothing else", "move nothing else", "alter nothing else", "do nothing else", "leave everything else alone", "leave everything else as it is", "leave everything else as is", "leave everything else the way it is", "leave everything else where it is", "leave everything else untouched", "leave all else as it is", "leave all else alone",
    "leave the rest alone", "leave the rest as it is", "leave the rest as is", "leave the rest the way it is", "leave the rest untouched", "keep everything else as it is", "keep the rest as it is", "everything else stays as it is", "everything else stays the same", "everything else stays where it is", "everything else stays", "everything else can stay as it is", "the rest stays as it is",
    "the rest stays the same", "the rest stays", "the rest can stay as it is", "nothing else changes", "nothing else should change", "nothing else must change", "nothing else is to change", "nothing else needs to change", "without touching anything else", "without changing anything else", "without moving anything else", "without altering anything else"]);
/// Before that.
const JOINTS: &[&str] = &["and", "but", "please", "just", "then", "so", "otherwise", "also"];

/// What a sentence may have been meant to say, in plainer words.
pub(super) fn ways(
    words: &str,
    heard: &[Lexeme],
    names: &Names<'_>,
    stock: &Stock,
    focus: &Focus,
) -> Vec<Vec<Lexeme>> {
    let said = slips::heard_and_spelt(words, heard, names, stock, &focus.streets);
    said.iter().filter_map(|said| told(said)).collect()
}

/// The words told otherwise, if they are.
fn told(lexemes: &[Lexeme]) -> Option<Vec<Lexeme>> {
    let kept = without_nothing_else(lexemes);
    let told = told_by(&kept, &[QUESTIONS, SET_SCENES, SEVERAL, EVERYDAY]);
    // "Who is next to me?" is about who speaks, of whom nothing is known in words like these.
    let has = |word: &str| told.iter().any(|lexeme| word_of(lexeme) == word);
    let is_about_me = has("people") && (has("me") || has("you") || has("us"));
    (!is_same(&told, lexemes) && !is_about_me && told.iter().any(|lexeme| !is_mark(lexeme))).then_some(told)
}

/// Without "and don't touch anything else" at the end.
fn without_nothing_else(lexemes: &[Lexeme]) -> Vec<Lexeme> {
    let end = lexemes.iter().rposition(|lexeme| !is_mark(lexeme)).map_or(0, |last| last + 1);
    let is_joint = |at: usize| is_mark(&lexemes[at]) || JOINTS.contains(&word_of(&lexemes[at]));
    let cut = (2..end).find(|at| {
        let from = at + (*at..end).take_while(|at| is_joint(*at)).count();
        let is_begun = from > *at || word_of(&lexemes[*at]) == "without";
        is_begun && longest_phrase(&lexemes[from..end], NOTHING_ELSE) == Some(end - from)
    });
    let Some(cut) = cut else { return lexemes.to_vec() };
    let mut kept = lexemes[..cut].to_vec();
    kept.extend_from_slice(&lexemes[end..]);
    kept
}

#[cfg(test)]
mod tests {
    use super::super::super::lexer::rewritten;
    use super::*;

    fn plain(said: &str) -> String {
        rewritten(said, |lexemes| {
            if let Some(plain) = told(lexemes) {
                *lexemes = plain;
            }
        })
    }

    #[test]
    fn questions_are_told_plainly() {
        for (said, meant) in [
            ("who sells ice cream", "list the buildings that sell ice cream"),
            ("where do they have newspapers for sale", "list the buildings that sell newspapers"),
            ("where can i get a cup of coffee around here", "list the buildings that sell coffee"),
            ("what can one buy at the blue spoon", "describe the blue spoon"),
            ("where is ben hanging around", "where is ben"),
            ("which is the tallest tree", "list the tallest tree"),
            ("which places are called elm cafe", "list all the buildings called elm cafe"),
            ("whos in the park", "list the people in the park"),
            ("which door cant i get through because it is locked", "list the locked doors"),
            ("who is next to me", "who is next to me"),
            ("which car should go", "which car should go"),
        ] {
            assert_eq!(plain(said), meant, "{said}");
        }
    }

    #[test]
    fn scenes_and_several_are_told_plainly() {
        for (said, meant) in [
            ("a sea mist rolls in", "make it mist"),
            ("for the opening shot i want thick fog at first light", "i want thick fog at first light"),
            ("enough of the bad weather , clear the sky", "clear the sky"),
            ("enough of the bad weather", "make it clear"),
            ("three copies of the cone , all close to rex", "make three copies of the cone close to rex"),
            ("put a bin here and dont touch anything else", "put a bin here"),
            ("put a bin here and dont touch anything", "put a bin here and dont touch anything"),
        ] {
            assert_eq!(plain(said), meant, "{said}");
        }
    }
}
