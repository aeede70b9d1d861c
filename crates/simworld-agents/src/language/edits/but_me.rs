//! "List all the people except me": who speaks is never one of those that are meant, so that the exception says nothing.

use super::super::lexer::{Lexeme, Token, is_mark};
use super::super::lexicon::longest_phrase;
use super::super::phrases::Phrases;
use super::forms::word;

/// That who speaks is not meant. "Besides me" is beside him.
#[rustfmt::skip]
const BUT_ME: &Phrases = &Phrases::of(&["except me", "except for me", "except myself", "except for myself", "excepting me", "excluding me", "excluding myself", "but me", "but for me", "but not me", "but myself", "bar me", "apart from me", "apart from myself", "aside from me", "aside from myself", "other than me", "other than myself",
    "not counting me", "not counting myself", "not including me", "not including myself", "leaving me out", "save for me", "with the exception of me", "with the exception of myself", "me excepted", "me excluded", "me not included", "except us"]);
/// Of whom all are meant.
#[rustfmt::skip]
const ALL: &[&str] = &["all", "every", "everybody", "everyone", "each", "people", "persons", "person", "anybody", "anyone", "many", "who", "whos", "which", "count", "list"];
/// By these he alone is meant.
const NONE: &[&str] =
    &["nobody", "noone", "no", "none", "nothing", "not", "never", "dont", "only", "just", "nowhere"];
/// Behind it, in the same part.
const ENDS: &[&str] = &["and", "please", "here", "then", "in", "on", "at", "near", "who", "that", "by", "to"];

/// Leaves the exception out.
pub(super) fn in_plain_words(lexemes: &mut Vec<Lexeme>) {
    let found = (1..lexemes.len()).find_map(|at| {
        let words = longest_phrase(&lexemes[at..], BUT_ME)?;
        let end = at + words;
        let ends = lexemes.get(end).is_none_or(is_mark) || ENDS.contains(&word(lexemes, end));
        let begin =
            lexemes[..at].iter().rposition(|mark| mark.token == Token::Break).map_or(0, |mark| mark + 1);
        let said = |list: &[&str]| (begin..at).any(|at| list.contains(&word(lexemes, at)));
        (ends && said(ALL) && !said(NONE)).then_some((at, end))
    });
    let Some((at, end)) = found else { return };
    let from = if lexemes[at - 1].token == Token::Comma { at - 1 } else { at };
    lexemes.drain(from..end);
}

#[cfg(test)]
mod tests {
    use super::super::super::lexer::rewritten;
    use super::in_plain_words;

    #[test]
    fn who_speaks_is_no_exception() {
        for (said, meant) in [
            ("list all the people except me", "list all the people"),
            ("list everybody but myself in the park", "list everybody in the park"),
            ("how many people are here, not counting me", "how many people are here"),
            // These mean somebody else, or him alone.
            ("list all the people except anna", "list all the people except anna"),
            ("nobody but me", "nobody but me"),
            ("list the people besides me", "list the people besides me"),
            ("put a bench here but me", "put a bench here but me"),
        ] {
            assert_eq!(rewritten(said, in_plain_words), meant, "{said}");
        }
    }
}
