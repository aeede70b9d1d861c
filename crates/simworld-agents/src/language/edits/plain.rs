//! Words that are put plainly before they are read: contractions, what is said twice, what makes a wish no other.

use super::super::lexer::{Lexeme, Token};
use super::super::lexicon::{category, longest, longest_phrase};
use super::forms::word_at;
use super::parts::is_mark;

/// Words that make a wish stronger or weaker, and no other.
#[rustfmt::skip]
const ADVERBS: &[&str] = &["really", "definitely", "certainly", "absolutely", "totally", "seriously", "honestly", "literally", "basically", "desperately", "badly", "sorely",
    "urgently", "frankly", "truly", "obviously", "clearly", "surely", "undoubtedly", "ideally", "preferably", "presumably", "urgent", "personally", "sincerely", "finally"];
/// Where a name may follow, which is any word.
const CALLS: &[&str] = &["call", "name", "rename", "christen", "label", "title", "called", "named"];

/// What "more" makes of a word.
#[rustfmt::skip]
const MORE: &[(&str, &str)] = &[("small", "smaller"), ("big", "bigger"), ("large", "larger"), ("tall", "taller"), ("high", "higher"), ("little", "smaller"),
    ("short", "shorter"), ("close", "closer"), ("tiny", "smaller"), ("huge", "bigger")];
/// Words that slip in twice.
const TWICE: &[&str] = &[
    "far", "very", "really", "so", "please", "much", "way", "the", "a", "right", "next", "big", "to", "of",
    "and", "long",
];

/// A word twice in a row says no more than once, and "more small" is "smaller".
pub(super) fn in_plain_words(words: &str, lexemes: &mut Vec<Lexeme>) {
    contractions(words, lexemes);
    relatives(lexemes);
    let is_call =
        |lexeme: &Lexeme| matches!(&lexeme.token, Token::Word(word) if CALLS.contains(&word.as_str()));
    if !lexemes.iter().any(is_call) && lexemes.len() > 2 {
        lexemes
            .retain(|lexeme| !matches!(&lexeme.token, Token::Word(word) if ADVERBS.contains(&word.as_str())));
    }
    let is = |lexeme: &Lexeme, word: &str| matches!(&lexeme.token, Token::Word(own) if own == word);
    let mut at = 1;
    while at < lexemes.len() {
        let twice =
            lexemes[at].token == lexemes[at - 1].token && TWICE.iter().any(|word| is(&lexemes[at], word));
        let marks = is_mark(&lexemes[at]) && lexemes[at].token == lexemes[at - 1].token;
        let than = MORE.iter().find(|(plain, _)| is(&lexemes[at - 1], "more") && is(&lexemes[at], plain));
        if twice || marks {
            lexemes.remove(at);
        } else if let Some((_, comparative)) = than {
            lexemes[at] = word_at(&lexemes[at], comparative);
            lexemes.remove(at - 1);
        } else {
            at += 1;
        }
    }
}

/// "The taxi's in the way" is "the taxi is in the way", and "at its corner" is "at the corner of it".
fn contractions(words: &str, lexemes: &mut Vec<Lexeme>) {
    #[rustfmt::skip]
    const STATES: &[&str] = &["in", "too", "a", "on", "at", "so", "facing", "looking", "way", "always", "really", "just", "very", "not", "got", "ugly", "nice", "far",
        "much", "blocking", "still", "standing", "behind", "next", "near", "an", "been", "kind", "boring", "broken", "old", "empty", "dirty", "lonely", "quite", "rather", "wrong"];
    const SIDES: &[&str] = &["corner", "edge", "middle", "centre", "center", "side"];
    let mut at = 0;
    while at + 1 < lexemes.len() {
        let (Token::Word(word), Token::Word(next)) = (&lexemes[at].token, &lexemes[at + 1].token) else {
            at += 1;
            continue;
        };
        let written = words.get(lexemes[at].start..lexemes[at].end).unwrap_or_default();
        let is_contracted = (written.ends_with("'s") || written.ends_with("’s")) && word.len() > 4;
        if is_contracted
            && STATES.contains(&next.as_str())
            && !["thats", "whats", "theres", "wheres", "heres"].contains(&word.as_str())
        {
            let place = lexemes[at].clone();
            let stem = word[..word.len() - 1].to_owned();
            lexemes.splice(at..=at, [word_at(&place, &stem), word_at(&place, "is")]);
        } else if ["on", "inside", "onto", "behind", "under"].contains(&word.as_str()) && next == "there" {
            let place = lexemes[at + 1].clone();
            lexemes[at + 1] = word_at(&place, "it");
        } else if word == "what" && category(&lexemes[at + 1..]).is_some() {
            let place = lexemes[at].clone();
            lexemes[at] = word_at(&place, "which");
        } else if let Some(who) =
            ["we'll", "i'll", "they'll", "you'll", "it'll", "we’ll", "i’ll", "they’ll", "it’ll"]
                .iter()
                .find(|short| written.eq_ignore_ascii_case(short))
        {
            let (place, who) =
                (lexemes[at].clone(), who.split(['\'', '’']).next().unwrap_or_default().to_owned());
            lexemes.splice(at..=at, [word_at(&place, &who), word_at(&place, "will")]);
            at += 1;
        } else if ["its", "his", "her", "their"].contains(&word.as_str())
            && SIDES.contains(&next.as_str())
            && at > 0
        {
            let (place, side) = (lexemes[at].clone(), lexemes[at + 1].clone());
            lexemes.splice(
                at..=at + 1,
                [word_at(&place, "the"), side, word_at(&place, "of"), word_at(&place, "it")],
            );
        }
        at += 1;
    }
}

/// "A motorbike, black, by the kiosk" is a black motorbike, and "the hospital that has the museum near it" is near the museum.
fn relatives(lexemes: &mut Vec<Lexeme>) {
    let is_comma = |lexeme: &Lexeme| lexeme.token == Token::Comma;
    let mut at = 1;
    while at + 2 < lexemes.len() {
        if is_comma(&lexemes[at])
            && let Some((_, words)) = longest(&lexemes[at + 1..], super::super::paint::PAINTS)
            && lexemes.get(at + 1 + words).is_some_and(is_comma)
        {
            lexemes.remove(at + 1 + words);
            lexemes.remove(at);
        }
        at += 1;
    }
    let Some(has) = (0..lexemes.len()).find(|at| {
        longest_phrase(&lexemes[*at..], &["that has", "which has", "that have", "with the", "having"])
            .is_some()
    }) else {
        return;
    };
    let from = has
        + if matches!(&lexemes[has].token, Token::Word(word) if word == "with" || word == "having") {
            1
        } else {
            2
        };
    let it = |at: usize| matches!(lexemes.get(at).map(|lexeme| &lexeme.token), Some(Token::Word(word)) if word == "it" || word == "them");
    let found = (from + 1..lexemes.len().min(from + 8)).find_map(|at| {
        let (way, words) = longest(&lexemes[at..], super::words::WAYS)?;
        let near = matches!(way, super::words::Way::To(_));
        (near && it(at + words)).then_some((at, words))
    });
    if let Some((at, words)) = found {
        let place = lexemes[at].clone();
        let noun: Vec<Lexeme> = lexemes[from..at].to_vec();
        let relation: Vec<Lexeme> = match longest(&lexemes[at..], super::words::WAYS) {
            Some((super::words::Way::To(simworld_core::scene::Relation::NextTo), _)) => {
                lexemes[at..at + words].to_vec()
            }
            _ => vec![word_at(&place, "near")],
        };
        lexemes.splice(has..=at + words, relation.into_iter().chain(noun));
    }
}
