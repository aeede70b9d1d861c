//! Slips that make other words: "bye" for "buy", "siton" for "sit on".

use super::lexer::{Lexeme, Token, is_mark};
use super::numbers;
use super::verbs;

/// "Walk to the willlow", "..., than sit down", "go to the well an wait": what no word is written like, or stands for another.
pub(super) fn small_slips(lexemes: &mut [Lexeme]) {
    for at in 0..lexemes.len() {
        let begins = at > 0 && matches!(lexemes[at - 1].token, Token::Comma | Token::Break);
        let rest = &lexemes[at + 1..];
        let verb_follows = || verbs::longest_verb(rest).is_some();
        let (is_and, is_then) = match &lexemes[at].token {
            Token::Word(word) => (
                word == "an" && at > 0 && consonant_follows(rest) && verb_follows(),
                word == "than" && begins && verb_follows(),
            ),
            _ => continue,
        };
        if is_and || is_then {
            lexemes[at].token = Token::Word(if is_and { "and" } else { "then" }.to_owned());
        } else if let Token::Word(word) = &mut lexemes[at].token
            && word.as_bytes().windows(3).any(|three| three[0] == three[1] && three[1] == three[2])
        {
            let mut kept = String::with_capacity(word.len());
            for letter in word.chars() {
                let doubled = kept.ends_with(&format!("{letter}{letter}"));
                if !doubled || !letter.is_alphabetic() {
                    kept.push(letter);
                }
            }
            *word = kept;
        }
    }
}

/// Whether no "an" stands before the next word.
fn consonant_follows(rest: &[Lexeme]) -> bool {
    matches!(rest.first(), Some(Lexeme { token: Token::Word(word), .. }) if !word.starts_with(['a', 'e', 'i', 'o', 'u', 'h']))
}

/// "Go bye one": a word that sounds like a verb where an order begins and a quantity follows.
pub(super) fn sound_words(lexemes: &mut [Lexeme]) {
    const SAME: &[(&str, &str)] = &[
        ("bye", "buy"),
        ("by", "buy"),
        ("git", "get"),
        ("pic", "pick"),
        ("wright", "write"),
        ("weight", "wait"),
        ("rite", "right"),
        ("waite", "wait"),
    ];
    const BEFORE: &[&str] = &["go", "and", "then", "to", "please", "first", "you"];
    const BEHIND: &[&str] =
        &["a", "an", "one", "some", "two", "three", "on", "in", "for", "the", "me", "off", "out", "up"];
    for at in 0..lexemes.len() {
        if is_doubled_to(lexemes, at) {
            lexemes[at].token = Token::Word("to".to_owned());
        }
        let begins = at == 0
            || match &lexemes[at - 1].token {
                Token::Comma | Token::Break => true,
                Token::Word(word) => BEFORE.contains(&word.as_str()),
                _ => false,
            };
        let next = lexemes.get(at + 1).map(|next| &next.token);
        let goes_on = matches!(next, Some(Token::Word(word)) if BEHIND.contains(&word.as_str()))
            || at == 0 && numbers::count(&lexemes[1..]).is_some(); // "by three waffles"
        if let Some(short) = in_full(lexemes, at) {
            lexemes[at] = Lexeme {
                token: Token::Word(short.to_owned()),
                lemma: verbs::base_form(short),
                ..lexemes[at].clone()
            };
        }
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

/// "Cn you", "frm the hut": words that people write without their vowels, and slips that are no single edit.
fn in_full(lexemes: &[Lexeme], at: usize) -> Option<&'static str> {
    #[rustfmt::skip]
    const SHORT: &[(&str, &str)] = &[
        ("cn", "can"), ("sry", "sorry"), ("srry", "sorry"), ("sory", "sorry"), ("withe", "white"), ("thx", "thanks"), ("frm", "from"), ("wlk", "walk"), ("nxt", "next"), ("rde", "ride"), ("ried", "ride"), ("th", "the"), ("teh", "the"), ("hte", "the"), ("thn", "then"),
        ("opn", "open"), ("wth", "with"), ("plse", "please"), ("gt", "get"), ("nd", "and"), ("adn", "and"), ("fo", "of"), ("ot", "to"),
    ];
    let Token::Word(word) = &lexemes[at].token else { return None };
    SHORT.iter().find(|(short, _)| short == word).map(|(_, full)| *full)
}

/// "Wave too Nina": behind a verb, with something behind it.
fn is_doubled_to(lexemes: &[Lexeme], at: usize) -> bool {
    let word = |at: usize| match lexemes.get(at).map(|lexeme| &lexeme.token) {
        Some(Token::Word(word)) => Some(word.as_str()),
        _ => None,
    };
    let measured = [
        "much", "many", "far", "fast", "long", "late", "soon", "close", "near", "big", "small", "loud",
        "hard", "slowly", "quickly",
    ];
    word(at) == Some("too")
        && at > 0
        && word(at - 1).is_some_and(verbs::is_verb)
        && word(at + 1).is_some_and(|next| !measured.contains(&next))
}

/// "Siton the bench", "runto the bin": a verb and a small word that are written as one.
pub(super) fn run_together(word: &str) -> Option<[String; 2]> {
    ["into", "onto", "to", "on", "at", "the", "it", "up"].iter().find_map(|small| {
        let verb = word.strip_suffix(small).filter(|verb| verb.len() > 2 && verbs::is_verb(verb))?;
        Some([verb.to_owned(), (*small).to_owned()])
    })
}

/// "Plase", "pleaes", where people say "please": first or last, at a mark, or before a verb.
pub(super) fn asked_politely(word: &str, at: usize, lexemes: &[Lexeme]) -> Option<String> {
    const PLEASE: &str = "please";
    let marked = |at: usize| lexemes.get(at).is_none_or(is_mark);
    let verb = |lexeme: &Lexeme| matches!(&lexeme.token, Token::Word(word) if verbs::is_verb(word));
    let apart = at == 0 || marked(at - 1) || marked(at + 1) || lexemes.get(at + 1).is_some_and(verb);
    let alike = word.starts_with("pl") && word.len() > 3 && strsim::osa_distance(word, PLEASE) <= 2;
    (apart && alike).then(|| PLEASE.to_owned())
}
