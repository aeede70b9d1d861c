//! What is not here by all the words of its name: "there is no sailing boat here", where "the sailing" was looked for.

use super::super::lexer::Lexeme;
use super::super::lexicon::longest;
use super::super::paint::PAINTS;
use super::forms::word;
use super::words::{VERBS, WAYS};
use crate::editing::Stock;

/// As many words more are said at most.
const MOST: usize = 2;
/// Words that are in names of things, and end what is looked for.
const SMALL: &[&str] = &["and", "the", "with", "for", "from", "too", "out", "off", "away"];

/// What was looked for, with the words of things that follow it where it was said.
pub(super) fn named(wanted: String, heard: &[Lexeme], stock: &Stock) -> String {
    let is_noun = |said: &str| {
        said.len() > 2
            && !SMALL.contains(&said)
            && (stock.has_word(said) || said.strip_suffix('s').is_some_and(|one| stock.has_word(one)))
    };
    in_full(wanted, heard, &is_noun)
}

/// As [`named`], with what may be a word of a thing.
fn in_full(wanted: String, heard: &[Lexeme], is_noun: &dyn Fn(&str) -> bool) -> String {
    let said: Vec<String> = wanted.split_whitespace().map(str::to_lowercase).collect();
    let is_said = |at: &usize| said.iter().enumerate().all(|(next, one)| word(heard, at + next) == one);
    let Some(at) = (0..heard.len()).find(is_said).filter(|_| !said.is_empty()) else { return wanted };
    let from = at + said.len();
    let more = (from..heard.len().min(from + MOST)).take_while(|next| {
        let rest = &heard[*next..];
        let is_other = longest(rest, PAINTS).is_some()
            || longest(rest, &WAYS).is_some()
            || longest(rest, &VERBS).is_some();
        !is_other && is_noun(word(heard, *next))
    });
    more.fold(wanted, |full, next| format!("{full} {}", word(heard, next)))
}

#[cfg(test)]
mod tests {
    use super::super::super::lexer::lex;
    use super::in_full;

    #[test]
    fn all_the_words_of_a_thing_are_told() {
        let full = |wanted: &str, said: &str| {
            in_full(wanted.to_owned(), &lex(said), &|word| ["boat", "bench", "green"].contains(&word))
        };
        assert_eq!(full("sailing", "paint the sailing boat green"), "sailing boat");
        assert_eq!(full("windmill", "paint the windmill green"), "windmill");
        assert_eq!(full("windmill", "move the windmill next to the bench"), "windmill");
        assert_eq!(
            full("anything \"it\" could stand for", "paint it green"),
            "anything \"it\" could stand for"
        );
    }
}
