//! A sky that somebody says would suit something: "a clear, starry night would suit my story" asks for it, with all that is said of it.

use super::super::lexer::{Lexeme, Token, is_mark};
use super::super::lexicon::{longest, longest_phrase};
use super::super::phrases::Phrases;
use super::forms::{word, words_at};
use super::words::{SKIES, WAYS};

/// Before what is said of the sky.
#[rustfmt::skip]
const BEFORE: &Phrases = &Phrases::of(&["a", "an", "one", "some", "a nice", "a lovely", "a good", "a very", "a really", "a rather", "a long", "a quiet", "a crisp", "a perfectly"]);
/// Between what is said of it.
const BETWEEN: &[&str] = &["and", "but", "yet", "very", "rather", "really", "with"];
/// That it would suit what follows.
#[rustfmt::skip]
const SUITS: &Phrases = &Phrases::of(&["would suit", "might suit", "could suit", "will suit", "would fit", "might fit", "will fit", "would do for", "would work for", "would be right for", "would be just right for", "would be perfect for", "would be ideal for", "would be great for",
    "would be good for", "would be nice for", "would be lovely for", "would be best for", "would go well with", "would go with", "would match", "would complement", "would flatter", "is what i need for", "is just right for", "is perfect for"]);
/// What it suits takes no more words.
const LONGEST: usize = 6;
/// It suits nothing.
const NOTHING: &[&str] = &["nobody", "nothing", "none", "not", "no", "neither", "never", "hardly"];

/// Puts an order in the place of the statement, if the first sentence is one.
pub(super) fn in_plain_words(lexemes: &mut Vec<Lexeme>) {
    let end = lexemes.iter().position(|lexeme| lexeme.token == Token::Break).unwrap_or(lexemes.len());
    let Some(told) = sky_of(&lexemes[..end]) else { return };
    let Some(place) = lexemes.first().cloned() else { return };
    let order: Vec<Lexeme> = words_at(&place, "make it a").chain(told).collect();
    lexemes.splice(..end, order);
}

/// What is said of the sky, without the commas between, if the words say that it would suit something.
fn sky_of(lexemes: &[Lexeme]) -> Option<Vec<Lexeme>> {
    let mut at = longest_phrase(lexemes, BEFORE)?;
    let (mut told, mut skies): (Vec<Lexeme>, usize) = (Vec::new(), 0);
    let suits = loop {
        let rest = lexemes.get(at..)?;
        if let Some(words) = longest_phrase(rest, SUITS) {
            break at + words;
        } else if let Some((_, words)) = longest(rest, &SKIES) {
            told.extend_from_slice(&rest[..words]);
            skies += 1;
            at += words;
        } else if BETWEEN.contains(&word(lexemes, at)) || rest.first()?.token == Token::Comma {
            at += 1;
        } else {
            return None;
        }
    };
    let what = lexemes.get(suits..)?;
    let is_plain = |at: usize| {
        !is_mark(&what[at]) && longest(&what[at..], &WAYS).is_none() && !NOTHING.contains(&word(what, at))
    };
    let is_told = (1..=LONGEST).contains(&what.len()) && (0..what.len()).all(is_plain);
    (is_told && skies > 1).then_some(told)
}

#[cfg(test)]
mod tests {
    use super::super::super::lexer::rewritten;
    use super::in_plain_words;

    fn plain(said: &str) -> String {
        rewritten(said, in_plain_words)
    }

    #[test]
    fn what_would_suit_is_asked_for() {
        assert_eq!(plain("a clear, starry night would suit my story"), "make it a clear starry night");
        assert_eq!(plain("a foggy morning would be perfect for my film"), "make it a foggy morning");
    }

    #[test]
    fn what_suits_nobody_or_is_no_sky_stays() {
        for said in [
            "a cold , wet night would suit nobody",
            "a bright lamp would suit the street",
            "a clear , starry night would suit the bench by the oak",
            "fog would suit the scene",
        ] {
            assert_eq!(plain(said), said);
        }
    }
}
