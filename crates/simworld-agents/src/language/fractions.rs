//! Numbers of several words with a part of one behind: "one and a half metres", "two point five seconds", "three quarters of a metre".
//! They become one number before anything else is read, where a unit follows.

use super::lexer::{Lexeme, Token};
use super::lexicon::{longest, longest_phrase};
use super::numbers;
use super::phrases::Phrases;

/// Parts behind a whole number.
#[rustfmt::skip]
const PARTS: &[(&[&str], f64)] = &[
    (&["a half", "half", "one half", "a half a"], 0.5), (&["a quarter", "quarter", "one quarter"], 0.25),
    (&["three quarters", "three quarter"], 0.75), (&["a third", "one third"], 1.0 / 3.0), (&["two thirds"], 2.0 / 3.0),
];
/// Parts by themselves, before one of what they are parts of.
const SHARES: &[(&[&str], f64)] = &[
    (&["three quarters of a", "three quarter of a", "three quarters of an"], 0.75),
    (&["a third of a", "one third of a"], 1.0 / 3.0),
    (&["two thirds of a", "two thirds of an"], 2.0 / 3.0),
];
#[rustfmt::skip]
const UNITS: &Phrases = &Phrases::of(&[
    "metres", "metre", "meters", "meter", "m", "steps", "step", "paces", "pace", "strides", "feet", "foot", "yards", "yard", "kilometres", "kilometre", "kilometers",
    "km", "centimetres", "cm", "seconds", "second", "secs", "minutes", "minute", "mins", "hours", "hour", "degrees", "times", "turns",
]);

/// Makes one number of each that is said in several words.
pub(super) fn in_one(lexemes: &mut Vec<Lexeme>) {
    let mut at = 0;
    while at < lexemes.len() {
        match &lexemes[at].token {
            Token::Word(word) if at > 0 && word == "and" => with_part(lexemes, at),
            Token::Word(word) if at > 0 && word == "point" => with_digits(lexemes, at),
            Token::Word(word) if at > 0 && (word == "more" || word == "further") => without_more(lexemes, at),
            Token::Word(word) if word == "three" || word == "two" || word == "a" => share(lexemes, at),
            _ => {}
        }
        at += 1;
    }
}

/// The whole number that ends at a place, with where it begins.
fn number_before(lexemes: &[Lexeme], at: usize) -> Option<(f64, usize)> {
    let begins = (at.saturating_sub(4)..at).find_map(|from| {
        let (number, words) = numbers::number(&lexemes[from..at])?;
        (from + words == at).then_some((number, from))
    });
    let article =
        |from: usize| matches!(&lexemes[from].token, Token::Word(word) if word == "a" || word == "an");
    begins.filter(|(number, from)| {
        number.fract() == 0.0 && *number >= 0.0 && !(article(*from) && from + 1 == at)
    })
}

fn unit_follows(lexemes: &[Lexeme], at: usize) -> bool {
    lexemes.get(at..).is_some_and(|rest| longest_phrase(rest, UNITS).is_some())
}

fn put(lexemes: &mut Vec<Lexeme>, from: usize, to: usize, number: f64) {
    let lexeme = Lexeme {
        token: Token::Number(number),
        lemma: None,
        start: lexemes[from].start,
        end: lexemes[to - 1].end,
    };
    lexemes.splice(from..to, [lexeme]);
}

/// "One and a half metres".
fn with_part(lexemes: &mut Vec<Lexeme>, at: usize) {
    let Some((part, words)) = longest(&lexemes[at + 1..], PARTS) else { return };
    let end = at + 1 + words;
    if let Some((number, from)) = number_before(lexemes, at).filter(|_| unit_follows(lexemes, end)) {
        put(lexemes, from, end, number + part);
    }
}

/// "Two point five metres".
fn with_digits(lexemes: &mut Vec<Lexeme>, at: usize) {
    let (mut part, mut place, mut end) = (0.0, 0.1, at + 1);
    while let Some((digit, 1)) = lexemes.get(end..).and_then(numbers::number)
        && (0.0..10.0).contains(&digit)
        && digit.fract() == 0.0
    {
        part += digit * place;
        place *= 0.1;
        end += 1;
    }
    if end == at + 1 || !unit_follows(lexemes, end) {
        return;
    }
    if let Some((number, from)) = number_before(lexemes, at) {
        // As it would be read from digits: without the error of the sum.
        let exact = ((number + part) / place * 10.0).round() * place / 10.0;
        put(lexemes, from, end, (exact * 1e6).round() / 1e6);
    }
}

/// "Five more metres" are five, wherever one is by then.
fn without_more(lexemes: &mut Vec<Lexeme>, at: usize) {
    let again = longest_phrase(&lexemes[at + 1..], &["times", "turns"]).is_some();
    if !again && unit_follows(lexemes, at + 1) && number_before(lexemes, at).is_some() {
        lexemes.remove(at);
    }
}

/// "Three quarters of a metre".
fn share(lexemes: &mut Vec<Lexeme>, at: usize) {
    if let Some((part, words)) = longest(&lexemes[at..], SHARES)
        && unit_follows(lexemes, at + words)
    {
        put(lexemes, at, at + words, part);
    }
}

#[cfg(test)]
mod tests {
    use super::super::lexer::rewritten;
    use super::*;

    #[test]
    fn numbers_with_a_part_behind_are_one() {
        for (said, number) in [
            ("step one and a half metres to the right", "step 1.5 metres to the right"),
            ("twenty two and a quarter metres", "22.25 metres"),
            ("wait one and three quarter minutes", "wait 1.75 minutes"),
            ("step two point five metres forward", "step 2.5 metres forward"),
            ("five more metres west", "five metres west"),
            ("wave three more times", "wave three more times"),
            ("three quarters of a metre", "0.75 metre"),
            ("12 and a half steps", "12.5 steps"),
            ("wait a minute and a half", "wait a minute and a half"),
            ("turn one and a half back", "turn one and a half back"),
            ("go to the bench and point five times", "go to the bench and point five times"),
        ] {
            assert_eq!(rewritten(said, in_one), number, "{said}");
        }
    }
}
