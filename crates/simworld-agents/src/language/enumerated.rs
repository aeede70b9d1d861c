//! "Wave to three people, Lotte, then Milan, then Oscar": who was counted is named then, and nothing is done twice.

use std::mem::discriminant;

use super::clause::{Clause, Count};
use super::hearing;
use super::lexer::{Lexeme, word_of};
use super::verbs::longest_verb;

/// "Let's get a shot for the flyer: photograph the birch": one photo, announced and then said of what.
pub(super) fn without_announced_photo(clauses: &mut Vec<Clause>, words: &str) {
    let announced =
        matches!(clauses[..], [Clause::Photo { of: None, times: 1 }, Clause::Photo { of: Some(_), .. }, ..]);
    let told_apart = || {
        hearing::hear(words, None).iter().any(|lexeme| {
            ["and", "then", "also", "again", "another", "after", "too"].contains(&word_of(lexeme))
        })
    };
    if announced && !told_apart() {
        clauses.remove(0);
    }
}

/// Takes out what is done to so many things where the same is done to each of them behind it and the deed was said only once.
pub(super) fn once_each(clauses: &mut Vec<Clause>, words: &str) {
    let mut at = 0;
    while at < clauses.len() {
        let count = counted(&clauses[at]);
        let named = clauses.get(at + 1..at + 1 + count).filter(|named| count >= 2 && !named.is_empty());
        let same = |one: &Clause| {
            discriminant(one) == discriminant(&clauses[at])
                && one.about().is_some_and(|what| what.count == Count::One)
        };
        let further = clauses.get(at + 1 + count).is_some_and(same);
        if named.is_some_and(|named| named.iter().all(same)) && !further && is_said_once(words) {
            clauses.remove(at);
        }
        at += 1;
    }
}

/// How many things a deed is done to.
fn counted(clause: &Clause) -> usize {
    match clause.about().map(|what| &what.count) {
        Some(Count::Exactly(count)) => *count as usize,
        _ => 0,
    }
}

/// Whether the first verb stands there once.
fn is_said_once(words: &str) -> bool {
    let lexemes = hearing::hear(words, None);
    let first = (0..lexemes.len()).find(|at| longest_verb(&lexemes[*at..]).is_some());
    first.is_some_and(|first| {
        let verb = word_of(&lexemes[first]);
        let again = |lexeme: &Lexeme| word_of(lexeme) == verb || lexeme.lemma.as_deref() == Some(verb);
        !lexemes[first + 1..].iter().any(again)
    })
}
