//! Sentences that begin anew in the middle, or end with what others begin with: "the chair, you know, the one by the oak, sit on it",
//! "sixteen metres north, go". They are told straight only where a sentence is not understood as it is.

use super::lexer::{Lexeme, Token, is_mark, word_of};
use super::lexicon::longest_phrase;
use super::phrases::Phrases;

const ARTICLES: &[&str] = &["the", "a", "an", "that", "this", "my"];
/// What may stand between a thing and its second, better description.
const BETWEEN: &Phrases =
    &Phrases::of(&["you know", "i mean", "you see", "well", "yes", "no", "or rather", "namely"]);
/// What ends a description, or makes a list of two.
#[rustfmt::skip]
const ENDS: &[&str] = &["by", "near", "next", "beside", "behind", "with", "and", "or", "in", "on", "at", "to", "that", "which", "under", "between", "of"];
/// How far behind a noun may stand in its description.
const LONGEST: usize = 4;

/// The sentence as it would have been said at once, if it can be told so.
pub(super) fn told_straight(lexemes: &[Lexeme]) -> Option<Vec<Lexeme>> {
    verb_first(lexemes).or_else(|| described_anew(lexemes))
}

/// "Sixteen metres north, go": where to, with the verb behind.
fn verb_first(lexemes: &[Lexeme]) -> Option<Vec<Lexeme>> {
    const MOVES: &Phrases = &Phrases::of(&[
        "go",
        "walk",
        "run",
        "head",
        "move",
        "you go",
        "march",
        "jog",
        "off you go",
        "lets go",
        "let us go",
    ]);
    let end = lexemes.iter().rposition(|lexeme| !is_mark(lexeme))? + 1;
    let mark = lexemes[..end].iter().rposition(is_mark);
    // "Ten metres north you go" needs no comma.
    let from = mark.map_or_else(|| end.saturating_sub(2), |mark| mark + 1);
    let whole = longest_phrase(&lexemes[from..end], MOVES) == Some(end - from);
    let alone = mark.is_none_or(|mark| lexemes[..mark].iter().all(|lexeme| !is_mark(lexeme)));
    if !whole || !alone || mark.is_none() && word_of(&lexemes[from]) != "you" || from == 0 {
        return None;
    }
    let verb = lexemes[end - 1].clone();
    let rest = &lexemes[..mark.unwrap_or(from)];
    Some([&[verb], rest].concat())
}

/// "The chair, the one by the oak, sit on it": a thing that is described a second time.
fn described_anew(lexemes: &[Lexeme]) -> Option<Vec<Lexeme>> {
    let is_article = |at: &usize| ARTICLES.contains(&word_of(&lexemes[*at]));
    for at in (0..lexemes.len()).filter(is_article) {
        let again =
            (at + 2..lexemes.len().min(at + 2 + LONGEST)).find(|at| is_article(at) || is_mark(&lexemes[*at]));
        let Some(end) =
            again.filter(|end| !lexemes[at + 1..*end].iter().any(|lexeme| ENDS.contains(&word_of(lexeme))))
        else {
            continue;
        };
        let mut from = end;
        loop {
            if matches!(lexemes.get(from), Some(Lexeme { token: Token::Comma, .. })) {
                from += 1;
            } else if let Some(words) = longest_phrase(&lexemes[from.min(lexemes.len())..], BETWEEN) {
                from += words;
            } else {
                break;
            }
        }
        if from >= lexemes.len() || !is_article(&from) {
            continue;
        }
        let noun = &lexemes[end - 1];
        let behind = (from + 1..lexemes.len().min(from + 1 + LONGEST))
            .take_while(|at| !ENDS.contains(&word_of(&lexemes[*at])) && !is_mark(&lexemes[*at]))
            .find(|at| lexemes[*at].token == noun.token || word_of(&lexemes[*at]) == "one");
        if let Some(behind) = behind.filter(|_| !word_of(noun).ends_with('s')) {
            let mut told = [&lexemes[..at], &lexemes[from..]].concat();
            told[at + behind - from] = noun.clone();
            return Some(told);
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::super::lexer::{lex, written};
    use super::*;

    fn told(text: &str) -> Option<String> {
        let words = told_straight(&lex(text))?;
        Some(words.iter().map(|word| written(text, std::slice::from_ref(word))).collect::<Vec<_>>().join(" "))
    }

    #[test]
    fn sentences_that_begin_anew_are_told_straight() {
        for (said, straight) in [
            ("sixteen metres north, go", Some("go sixteen metres north")),
            ("ten metres north you go", Some("go ten metres north")),
            ("the chair the one by the oak, sit on it", Some("the chair by the oak , sit on it")),
            ("sit on the chair, you know, the white one", Some("sit on the white chair")),
            ("go to the bin the bin by the oak", Some("go to the bin by the oak")),
            ("go to the chair and the one by the oak", None),
            ("point at the chairs, the white one", None),
        ] {
            assert_eq!(told(said).as_deref(), straight, "{said}");
        }
    }
}
