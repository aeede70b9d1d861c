//! Names of assets with slips in several of their words at once: "a shiping contaner", "a concrte barier".
//!
//! Word by word each is near several others; together they are near one asset only. This is asked only in sentences that were refused, and of two assets
//! that are as near neither is meant.

use super::super::lexer::{Lexeme, Token, word_of};
use super::super::lexicon::longest_phrase;
use super::super::numbers;
use super::super::paint::PAINTS;
use super::super::verbs::base_form;
use crate::editing::Stock;

/// From this length on two slips are forgiven.
const LONG: usize = 8;
/// Shorter words are taken as they are.
const SHORTEST: usize = 4;
/// Before what is new, or there.
#[rustfmt::skip]
const BEFORE: &[&str] = &["a", "an", "another", "one", "the", "that", "this", "some", "my", "our"];

/// The words with every name of an asset put right that is misspelt in some of its words; none if nothing is.
pub(super) fn in_plain_spelling(lexemes: &[Lexeme], stock: &Stock) -> Option<Vec<Lexeme>> {
    let mut right = lexemes.to_vec();
    let mut at = 1;
    while at < right.len() {
        if is_behind_article(&right, at)
            && let Some(name) = nearest(&right[at..], stock)
        {
            for (lexeme, word) in right[at..].iter_mut().zip(name) {
                lexeme.lemma = base_form(&word);
                lexeme.token = Token::Word(word);
            }
        }
        at += 1;
    }
    let is_other = right.iter().zip(lexemes).any(|(one, other)| one.token != other.token);
    is_other.then_some(right)
}

/// Whether an article, a number, or a colour behind one stands before a word.
fn is_behind_article(lexemes: &[Lexeme], at: usize) -> bool {
    let before = &lexemes[at - 1..];
    longest_phrase(before, BEFORE).is_some()
        || numbers::count(before).is_some_and(|(_, words)| words == 1)
        || super::super::lexicon::longest(before, PAINTS).is_some_and(|(_, words)| words == 1)
}

/// The words of the one asset of several words to which the words from here on are near; none if they are its own, or two are as near.
fn nearest(rest: &[Lexeme], stock: &Stock) -> Option<Vec<String>> {
    let mut best: Option<(usize, Vec<String>)> = None;
    let mut is_shared = false;
    for (_, asset) in stock.catalogue.iter() {
        let Some((distance, name)) = near(rest, &asset.name) else { continue };
        match &best {
            Some((least, known)) if distance > *least || *known == name => {}
            Some((least, _)) if distance == *least => is_shared = true,
            _ => {
                best = Some((distance, name));
                is_shared = false;
            }
        }
    }
    best.filter(|(distance, _)| *distance > 0 && !is_shared).map(|(_, name)| name)
}

/// By how many slips some words are the name of an asset, and that name as it is said: in the plural if the last of them is.
fn near(rest: &[Lexeme], name: &str) -> Option<(usize, Vec<String>)> {
    let mut words: Vec<String> = name.split('_').map(str::to_owned).collect();
    if words.len() < 2 || words.len() > rest.len() {
        return None;
    }
    let last = words.len() - 1;
    let said = |at: usize| word_of(&rest[at]);
    if said(last).ends_with('s') && !words[last].ends_with('s') {
        words[last].push('s');
    }
    let (mut distance, mut short) = (0, 0);
    for (at, word) in words.iter().enumerate() {
        let lacks_letter = || is_short_of_a_letter(&rest[at], word).then_some(1);
        let slip = slips(said(at), word);
        short += usize::from(slip.is_none());
        distance += slip.or_else(lacks_letter)?;
    }
    // Beside a short word that is misspelt all others are as they should be.
    (short == 0 || distance == 1).then_some((distance, words))
}

/// Whether a word too short for other slips is another without its vowel: "bn".
fn is_short_of_a_letter(said: &Lexeme, word: &str) -> bool {
    let own = word_of(said);
    let is_begun = own.chars().next() == word.chars().next();
    let is_one_less = own.chars().count() + 1 == word.chars().count();
    // With a vowel it may be a word of its own: "at", "by".
    let has_vowel = own.contains(['a', 'e', 'i', 'o', 'u', 'y']);
    let is_short = (2..SHORTEST).contains(&own.chars().count()) && !has_vowel;
    is_short && is_begun && is_one_less && strsim::osa_distance(own, word) == 1
}

/// How many slips make one word of another; none if they are too many.
fn slips(said: &str, word: &str) -> Option<usize> {
    if said == word {
        return Some(0);
    }
    let letters = said.chars().count().min(word.chars().count());
    let is_begun = said.chars().next() == word.chars().next();
    let allowed = if letters >= LONG { 2 } else { 1 };
    if letters < SHORTEST || !is_begun {
        return None;
    }
    Some(strsim::osa_distance(said, word)).filter(|distance| *distance <= allowed)
}

#[cfg(test)]
mod tests {
    use super::super::super::lexer::lex;
    use super::{near, slips};

    #[test]
    fn every_word_of_a_name_may_be_misspelt() {
        let said = |words: &str, name: &str| near(&lex(words), name).map(|(distance, _)| distance);
        assert_eq!(said("shiping contaner behind", "shipping_container"), Some(2));
        assert_eq!(said("concrte barier behind", "concrete_barrier"), Some(2));
        assert_eq!(said("concrte bariers behind", "concrete_barrier"), Some(2));
        assert_eq!(said("traffic barrel", "traffic_barrel"), Some(0));
        assert_eq!(said("wheelie bn near", "wheelie_bin"), Some(1));
    }

    #[test]
    fn what_is_near_in_one_word_alone_is_another() {
        let said = |words: &str, name: &str| near(&lex(words), name).is_some();
        assert!(!said("concrte bench", "concrete_barrier"));
        assert!(!said("concrte", "concrete_barrier"));
        assert!(!said("hand car", "hand_cart"));
        assert!(!said("wheelie bp", "wheelie_bin"));
        assert!(!said("weelie bn", "wheelie_bin"));
        assert_eq!(slips("cat", "car"), None);
    }
}
