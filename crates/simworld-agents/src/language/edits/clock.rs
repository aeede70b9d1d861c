//! Minutes that are told from the hour: "half past seven", "a quarter to nine", "ten minutes before noon".

use super::super::lexer::{Lexeme, is_mark};
use super::super::lexicon::{longest, longest_phrase};
use super::super::numbers;

/// Of an hour.
pub(super) const MINUTES: f64 = 60.0;
/// Of a day.
pub(super) const HOURS: f64 = 24.0;
/// Hours that have names, before which and behind which minutes are told.
pub(super) const NAMED_HOURS: &[(&[&str], f64)] = &[(&["noon", "midday"], 12.0), (&["midnight"], 0.0)];
/// Parts of an hour, in minutes.
const PARTS: &[(&[&str], f64)] = &[(&["quarter", "a quarter"], 15.0), (&["half"], 30.0)];
const UNITS: &[&str] = &["minutes", "minute", "mins", "min"];
const PAST: &[&str] = &["past", "after"];
const TO: &[&str] = &["to", "before", "till", "until"];
/// Behind a time whose minutes are a bare number, which may else be a range: "five to ten chairs".
#[rustfmt::skip]
const BEHIND: &[&str] = &["am", "pm", "a m", "p m", "in the", "at night", "oclock", "o clock", "sharp", "on the dot", "and", "please", "now", "today", "with"];

/// By how many minutes a time differs from the hour that is told behind them, and how many words say so.
pub(super) fn beside_the_hour(lexemes: &[Lexeme]) -> Option<(f64, usize)> {
    let (minutes, words, is_bare) = minutes(lexemes)?;
    let behind = lexemes.get(words..)?;
    let past = longest_phrase(behind, PAST);
    // Nobody says "half to".
    let to = longest_phrase(behind, TO).filter(|_| longest_phrase(lexemes, &["half"]).is_none());
    let side = past.or(to)?;
    let rest = behind.get(side..)?;
    let hour = hour_words(rest)?;
    let next = rest.get(hour..).unwrap_or_default();
    let ends = next.first().is_none_or(is_mark) || longest_phrase(next, BEHIND).is_some();
    let is_range = is_bare && (past.is_none() && !ends || longest_phrase(behind, &["past", "to"]).is_none());
    let minutes = if past.is_some() { minutes } else { -minutes };
    (!is_range).then_some((minutes, words + side))
}

/// So many minutes, how many words tell them, and whether that is a bare number.
fn minutes(lexemes: &[Lexeme]) -> Option<(f64, usize, bool)> {
    if let Some((part, words)) = longest(lexemes, PARTS) {
        return Some((part, words, false));
    }
    let (number, words) = numbers::number(lexemes)?;
    let unit = longest_phrase(lexemes.get(words..)?, UNITS);
    let is_told = unit.is_some() || [5.0, 10.0, 20.0, 25.0].contains(&number);
    (is_told && number.fract() == 0.0 && (1.0..MINUTES).contains(&number)).then_some((
        number,
        words + unit.unwrap_or(0),
        unit.is_none(),
    ))
}

/// How many words tell an hour of the clock.
fn hour_words(lexemes: &[Lexeme]) -> Option<usize> {
    if let Some((_, words)) = longest(lexemes, NAMED_HOURS) {
        return Some(words);
    }
    let is_article = longest_phrase(lexemes, &["a", "an", "half"]).is_some();
    let (hour, words) = numbers::number(lexemes).filter(|_| !is_article)?;
    (hour.fract() == 0.0 && (1.0..=HOURS).contains(&hour)).then_some(words)
}

/// Every word of these tables, for the spelling.
pub(super) fn words() -> impl Iterator<Item = &'static str> {
    PARTS
        .iter()
        .flat_map(|(words, _)| *words)
        .chain(UNITS)
        .chain(PAST)
        .chain(TO)
        .flat_map(|phrase| phrase.split(' '))
}

#[cfg(test)]
mod tests {
    use super::super::super::lexer::lex;
    use super::super::sky::hour;
    use super::super::words::Sky;

    #[test]
    fn minutes_are_told_from_the_hour() {
        for (said, meant) in [
            ("quarter to nine in the evening", 20.75),
            ("a quarter past five in the afternoon", 17.25),
            ("half past six in the evening", 18.5),
            ("ten minutes to eight am", 7.0 + 50.0 / 60.0),
            ("twenty past four", 4.0 + 20.0 / 60.0),
            ("quarter past twelve at night", 0.25),
            ("a quarter to midnight", 23.75),
            ("half past noon", 12.5),
            ("ten to nine", 8.0 + 50.0 / 60.0),
            ("8 pm", 20.0),
        ] {
            let lexemes = lex(said);
            let Some((Sky::Hour(got), words)) = hour(&lexemes) else { panic!("no hour in {said}") };
            assert!((got - meant).abs() < 1e-9 && words == lexemes.len(), "{said}: {got}, {words} words");
        }
    }

    #[test]
    fn a_range_is_no_time() {
        for said in ["five to ten chairs", "a quarter of nine chairs", "quarter", "half to nine"] {
            assert!(hour(&lex(said)).is_none_or(|(_, words)| words < 3), "{said}");
        }
    }
}
