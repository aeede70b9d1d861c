//! Sizes by shares of what a thing has: "by a tenth", "two fifths bigger", "30 percent smaller", "bigger by half", "to three fifths of its size".

use super::super::lexer::Lexeme;
use super::super::lexicon::{longest, longest_phrase};
use super::super::numbers;
use super::super::phrases::Phrases;

/// Parts of a whole, by how many of them make one.
#[rustfmt::skip]
const PARTS: &[(&[&str], f64)] = &[
    (&["half", "halves"], 2.0), (&["third", "thirds"], 3.0), (&["quarter", "quarters", "fourth", "fourths"], 4.0), (&["fifth", "fifths"], 5.0), (&["sixth", "sixths"], 6.0), (&["seventh", "sevenths"], 7.0),
    (&["eighth", "eighths"], 8.0), (&["ninth", "ninths"], 9.0), (&["tenth", "tenths"], 10.0), (&["twelfth", "twelfths"], 12.0), (&["twentieth", "twentieths"], 20.0), (&["hundredth", "hundredths"], 100.0),
];
/// How many of them are taken.
#[rustfmt::skip]
const TAKEN: &[(&[&str], f64)] = &[
    (&["a", "an", "one", "a whole", "a full", "a good"], 1.0), (&["two"], 2.0), (&["three"], 3.0), (&["four"], 4.0), (&["five"], 5.0), (&["six"], 6.0), (&["seven"], 7.0), (&["eight"], 8.0), (&["nine"], 9.0),
];
const PERCENT: &Phrases = &Phrases::of(&["percent", "per cent", "%"]);
/// What says nothing before a share.
const ABOUT: &Phrases = &Phrases::of(&["about", "around", "roughly", "exactly", "some", "another"]);
/// Of what a share is one.
#[rustfmt::skip]
const OF_IT: &Phrases = &Phrases::of(&["of its size", "of its height", "of their size", "of its present size", "of its current size", "of its original size", "of the size", "of what it is", "of what it is now", "of that", "of it", "its size", "its height", "in size", "in height"]);
const LARGER: &Phrases = &Phrases::of(&["bigger", "larger", "taller", "higher", "greater"]);
const SMALLER: &Phrases = &Phrases::of(&["smaller", "shorter", "lower", "littler"]);

/// A share of a whole at the start, and how many words it takes: "a tenth", "two thirds", "half", "30 percent"; more than a whole only in
/// percent.
pub(super) fn share(lexemes: &[Lexeme]) -> Option<(f64, usize)> {
    let about = longest_phrase(lexemes, ABOUT).unwrap_or(0);
    let rest = &lexemes[about..];
    let (share, words) = in_percent(rest).or_else(|| in_parts(rest))?;
    let of_it = longest_phrase(rest.get(words..)?, OF_IT).unwrap_or(0);
    Some((share, about + words + of_it))
}

fn in_percent(lexemes: &[Lexeme]) -> Option<(f64, usize)> {
    let (number, words) = numbers::number(lexemes)?;
    let percent = longest_phrase(lexemes.get(words..)?, PERCENT)?;
    (number > 0.0 && number.is_finite()).then_some((number / 100.0, words + percent))
}

fn in_parts(lexemes: &[Lexeme]) -> Option<(f64, usize)> {
    // "Half", with no number before it.
    if let Some(words) = longest_phrase(lexemes, &["half"]) {
        return Some((0.5, words));
    }
    let (taken, words) = longest(lexemes, TAKEN)?;
    let (parts, count) = longest(lexemes.get(words..)?, PARTS)?;
    (taken < parts).then_some((taken / parts, words + count))
}

/// How many times as large something is to be, if all the words say so by a share: "a tenth smaller", "bigger by half", "by a fifth larger",
/// "down by a tenth", "to three fifths of its size".
pub(super) fn factor(lexemes: &[Lexeme]) -> Option<f64> {
    let whole = |from: usize| {
        let (share, words) = share(lexemes.get(from..)?)?;
        (from + words == lexemes.len()).then_some(share)
    };
    // "Bigger by half", "down by a tenth".
    let behind = |more: bool, words: usize| {
        let by = longest_phrase(lexemes.get(words..)?, &["by"])?;
        grown(whole(words + by)?, more)
    };
    if let Some(words) = longest_phrase(lexemes, &["to", "down to", "up to", "at"]) {
        return whole(words);
    }
    if let Some(words) = longest_phrase(lexemes, LARGER).or_else(|| longest_phrase(lexemes, &["up"])) {
        return behind(true, words);
    }
    if let Some(words) = longest_phrase(lexemes, SMALLER).or_else(|| longest_phrase(lexemes, &["down"])) {
        return behind(false, words);
    }
    // "By a fifth larger", "a fifth larger".
    let by = longest_phrase(lexemes, &["by"]).unwrap_or(0);
    let (share, words) = share(lexemes.get(by..)?)?;
    let rest = lexemes.get(by + words..)?;
    let ends = |list: &Phrases| longest_phrase(rest, list) == Some(rest.len());
    match (ends(LARGER), ends(SMALLER)) {
        (true, _) => grown(share, true),
        (_, true) => grown(share, false),
        _ => None,
    }
}

/// By how much a thing is multiplied that is larger by a share of what it is or, with `false`, smaller; none if nothing would be left.
pub(super) fn grown(share: f64, more: bool) -> Option<f64> {
    let factor = if more { 1.0 + share } else { 1.0 - share };
    (factor > 0.0).then_some(factor)
}

#[cfg(test)]
mod tests {
    use super::super::super::lexer::lex;
    use super::*;

    #[test]
    fn shares_make_things_larger_or_smaller() {
        for (said, meant) in [
            ("a tenth smaller", 0.9),
            ("two fifths bigger", 1.4),
            ("bigger by half", 1.5),
            ("by a fifth larger", 1.2),
            ("30 % smaller", 0.7),
            ("twenty five per cent bigger", 1.25),
            ("down by a tenth", 0.9),
            ("smaller by three quarters", 0.25),
            ("to three fifths of its size", 0.6),
            ("down to a tenth", 0.1),
        ] {
            let factor = factor(&lex(said));
            assert!(factor.is_some_and(|factor| (factor - meant).abs() < 1e-9), "{said}: {factor:?}");
        }
    }

    #[test]
    fn what_is_no_share_of_the_whole_is_none() {
        for said in
            ["by a tenth", "two bigger", "five fourths bigger", "smaller by 100 percent", "a tenth", "bigger"]
        {
            assert_eq!(factor(&lex(said)), None, "{said}");
        }
    }
}
