//! Which of several something is, told before the request: "there are two bins, and the one near the bus stop is always full".

use super::super::lexer::{Lexeme, Token, is_mark};
use super::super::lexicon::{category, longest, longest_phrase};
use super::super::paint::PAINTS;
use super::super::phrases::Phrases;
use super::forms::words_at;
use super::words::WAYS;

/// Before several things of which one is told then.
#[rustfmt::skip]
const SEVERAL: &Phrases = &Phrases::of(&["there are", "there is", "theres", "we have", "weve got", "we have got", "we got", "one of the", "one of our", "one of these", "one of those"]);

/// "The bin near the bus stop is always full": the thing itself takes the place of all that was told before it.
pub(super) fn in_plain_words(lexemes: &mut Vec<Lexeme>) {
    let is = |lexeme: &Lexeme, said: &str| matches!(&lexeme.token, Token::Word(word) if word == said);
    let found = (3..lexemes.len().saturating_sub(2)).find_map(|at| {
        let is_one = is(&lexemes[at], "the") && is(&lexemes[at + 1], "one");
        let begins = is_mark(&lexemes[at - 1]) || is(&lexemes[at - 1], "and") || is(&lexemes[at - 1], "but");
        longest(&lexemes[at + 2..], &WAYS).filter(|_| is_one && begins)?;
        let start =
            lexemes[..at].iter().rposition(|lexeme| lexeme.token == Token::Break).map_or(0, |mark| mark + 1);
        let several = longest_phrase(&lexemes[start..at], SEVERAL)?;
        let (noun, class) = (start + several..at)
            .find_map(|noun| category(&lexemes[noun..at]).map(|(class, _)| (noun, class)))?;
        let paint = (start + several..noun).find(|from| {
            longest(&lexemes[*from..noun], PAINTS).is_some_and(|(_, words)| from + words == noun)
        });
        Some((start, at, paint.map(|paint| paint..noun), *class.words.first()?))
    });
    let Some((start, at, paint, noun)) = found else { return };
    let place = lexemes[at + 1].clone();
    let paint: Vec<Lexeme> = paint.map_or_else(Vec::new, |paint| lexemes[paint].to_vec());
    let thing: Vec<Lexeme> =
        std::iter::once(lexemes[at].clone()).chain(paint).chain(words_at(&place, noun)).collect();
    lexemes.splice(start..at + 2, thing);
}

#[cfg(test)]
mod tests {
    use super::super::super::lexer::rewritten;
    use super::*;

    fn plain(said: &str) -> String {
        rewritten(said, in_plain_words)
    }

    #[test]
    fn one_of_several_takes_the_place_of_what_was_told_before_it() {
        assert_eq!(
            plain("there are two red cars, and the one near the kiosk is old"),
            "the red car near the kiosk is old"
        );
        let other = "paint the car, and the one near the kiosk too";
        assert_eq!(plain(other), "paint the car , and the one near the kiosk too");
    }
}
