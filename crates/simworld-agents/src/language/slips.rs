//! Slips that make other words: "bye" for "buy", "siton" for "sit on".

use super::lexer::{Lexeme, Token};
use super::verbs;

/// "Go bye one": a word that sounds like a verb where an order begins and a quantity follows.
pub(super) fn sound_words(lexemes: &mut [Lexeme]) {
    const SAME: &[(&str, &str)] = &[
        ("bye", "buy"),
        ("by", "buy"),
        ("git", "get"),
        ("wright", "write"),
        ("weight", "wait"),
        ("rite", "right"),
        ("waite", "wait"),
    ];
    const BEFORE: &[&str] = &["go", "and", "then", "to", "please", "first", "you"];
    const BEHIND: &[&str] =
        &["a", "an", "one", "some", "two", "three", "on", "in", "for", "the", "me", "off", "out", "up"];
    for at in 0..lexemes.len() {
        let begins = at == 0
            || match &lexemes[at - 1].token {
                Token::Comma | Token::Break => true,
                Token::Word(word) => BEFORE.contains(&word.as_str()),
                _ => false,
            };
        let goes_on = matches!(lexemes.get(at + 1).map(|next| &next.token), Some(Token::Word(word)) if BEHIND.contains(&word.as_str()));
        let Token::Word(word) = &lexemes[at].token else { continue };
        let Some((_, right)) = SAME.iter().find(|(said, _)| said == word).filter(|_| begins && goes_on)
        else {
            continue;
        };
        // "By the museum" is a place.
        let is_place = word == "by"
            && matches!(&lexemes[at + 1].token, Token::Word(next) if next == "the" || next == "two");
        if !is_place {
            lexemes[at] =
                Lexeme { token: Token::Word((*right).to_owned()), lemma: None, ..lexemes[at].clone() };
        }
    }
}

/// "Siton the bench", "runto the bin": a verb and a small word that are written as one.
pub(super) fn run_together(word: &str) -> Option<[String; 2]> {
    ["into", "onto", "to", "on", "at", "the", "it", "up"].iter().find_map(|small| {
        let verb = word.strip_suffix(small).filter(|verb| verb.len() > 2 && verbs::is_verb(verb))?;
        Some([verb.to_owned(), (*small).to_owned()])
    })
}
