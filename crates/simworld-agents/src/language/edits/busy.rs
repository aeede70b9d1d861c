//! Several who are to be busy somewhere are new: "four joggers should be warming up near the street lamp".

use super::super::compass::DIRECTIONS;
use super::super::lexer::{Lexeme, is_mark};
use super::super::lexicon::{longest, longest_phrase};
use super::super::numbers;
use super::super::phrases::Phrases;
use super::forms::{word, word_at};
use super::words::WAYS;

/// Before what they are to be doing.
#[rustfmt::skip]
const SHALL_BE: &Phrases = &Phrases::of(&["should be", "could be", "must be", "shall be", "might be", "ought to be", "have to be", "has to be", "need to be"]);
/// These say how something is to be changed, or are no deeds.
#[rustfmt::skip]
pub(super) const NO_DEEDS: &[&str] = &["facing", "missing", "turning", "leaving", "moving", "going", "looking", "pointing", "something", "anything", "nothing", "everything", "replacing", "matching"];
/// Who they are takes no more words.
const LONGEST: usize = 5;
/// As many words stand at most between what they do and where: "warming up", "playing football".
const MOST: usize = 2;

/// The order to add them, if the words are such a wish.
pub(super) fn in_plain_words(lexemes: &[Lexeme]) -> Option<Vec<Lexeme>> {
    let number = numbers::count(lexemes).map(|(_, words)| words);
    let count = number.or_else(|| longest_phrase(lexemes, &["a", "an", "some"]))?;
    let (shall, deed) = (count + 1..=count + LONGEST).find_map(|at| {
        let words = longest_phrase(lexemes.get(at..)?, SHALL_BE)?;
        Some((at, at + words))
    })?;
    let doing = word(lexemes, deed);
    if !doing.ends_with("ing") || NO_DEEDS.contains(&doing) {
        return None;
    }
    let place = (deed + 1..=deed + 1 + MOST).find(|at| {
        let rest = lexemes.get(*at..).unwrap_or_default();
        longest(rest, &WAYS).is_some() || longest(rest, DIRECTIONS).is_some()
    })?;
    if lexemes[..place].iter().any(is_mark) {
        return None;
    }
    let mut told = vec![word_at(&lexemes[0], "add")];
    told.extend_from_slice(&lexemes[..shall]);
    told.extend_from_slice(&lexemes[place..]);
    Some(told)
}

#[cfg(test)]
mod tests {
    use super::super::super::lexer::{Lexeme, lex, rewritten};
    use super::in_plain_words;

    #[test]
    fn who_is_to_be_busy_somewhere_is_new() {
        for (said, meant) in [
            ("four joggers should be warming up near the lamp", "add four joggers near the lamp"),
            ("five children should be playing near the fountain", "add five children near the fountain"),
        ] {
            let told = |lexemes: &mut Vec<Lexeme>| *lexemes = in_plain_words(lexemes).unwrap();
            assert_eq!(rewritten(said, told), meant, "{said}");
        }
        for said in ["two benches should be red near the lamp", "two benches should be facing the lamp"] {
            assert!(in_plain_words(&lex(said)).is_none(), "{said}");
        }
    }
}
