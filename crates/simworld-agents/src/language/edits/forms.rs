//! Verbs in other forms: "painted", "moving", "thrown out" are of the orders "paint", "move" and "throw out".

use super::super::lexer::{Lexeme, Token};
use super::words::{VERBS, Verb};

/// Forms that no rule makes.
#[rustfmt::skip]
const IRREGULAR: &[(&str, &str)] = &[("thrown", "throw"), ("taken", "take"), ("made", "make"), ("given", "give"),
    ("brought", "bring"), ("torn", "tear"), ("lost", "lose"), ("built", "build"), ("grown", "grow"), ("shrunk", "shrink"),
    ("shrunken", "shrink"), ("spun", "spin"), ("sent", "send"), ("laid", "lay"), ("stuck", "stick"), ("hung", "hang"),
    ("drawn", "draw"), ("blown", "blow"), ("got", "get"), ("gotten", "get"), ("slid", "slide"), ("strung", "string"),
    ("dug", "dig"), ("swept", "sweep"), ("swung", "swing"), ("made", "make"), ("found", "find"), ("shown", "show"),
    ("told", "tell"), ("wiped", "wipe"), ("binned", "bin"), ("slung", "sling"), ("flung", "fling"), ("written", "write")];

/// The verb at the start in its base form, if the first word is a past participle or, with `ing`, a gerund of one.
fn base_of(word: &str) -> Vec<String> {
    if let Some((_, base)) = IRREGULAR.iter().find(|(form, _)| *form == word) {
        return vec![(*base).to_owned()];
    }
    let mut bases = Vec::new();
    for ending in ["ing", "ed"] {
        let Some(stem) = word.strip_suffix(ending).filter(|stem| stem.len() >= 2) else { continue };
        bases.push(format!("{stem}e"));
        bases.push(stem.to_owned());
        let letters: Vec<char> = stem.chars().collect();
        if let [.., a, b] = letters[..]
            && a == b
        {
            bases.push(letters[..letters.len() - 1].iter().collect());
        }
    }
    if ["put", "set", "cut", "shut"].contains(&word) {
        bases.push(word.to_owned());
    }
    bases.extend(word.strip_suffix("ied").map(|stem| format!("{stem}y")));
    bases
}

/// The words of an order whose verb stands at the start as a participle or a gerund, with that verb as orders have it.
pub(super) fn as_order(lexemes: &[Lexeme]) -> Option<(Verb, usize, Lexeme)> {
    let first = lexemes.first()?;
    let Token::Word(word) = &first.token else { return None };
    base_of(word).into_iter().find_map(|base| {
        let (verb, count) = VERBS.longest_behind(&base, &lexemes[1..])?;
        Some((verb, count, Lexeme { token: Token::Word(base), lemma: None, ..first.clone() }))
    })
}

/// Whether a word is a form of a verb.
pub(super) fn is_form(word: &str) -> bool {
    base_of(word).iter().any(|base| VERBS.begins(base))
}

/// Whether both say the same, wherever their words were read.
pub(super) fn is_same(one: &[Lexeme], other: &[Lexeme]) -> bool {
    one.len() == other.len() && one.iter().zip(other).all(|(one, other)| one.token == other.token)
}

/// The word at a place; empty where none is.
pub(super) fn word(lexemes: &[Lexeme], at: usize) -> &str {
    match lexemes.get(at).map(|lexeme| &lexeme.token) {
        Some(Token::Word(word)) => word,
        _ => "",
    }
}

/// A word that is not in the sentence, in the place of one that is.
pub(super) fn word_at(place: &Lexeme, word: &str) -> Lexeme {
    Lexeme { token: Token::Word(word.to_owned()), lemma: None, ..place.clone() }
}

/// As [`word_at`], for several words.
pub(super) fn words_at<'a>(place: &'a Lexeme, words: &'a str) -> impl Iterator<Item = Lexeme> + 'a {
    words.split(' ').map(move |word| word_at(place, word))
}
