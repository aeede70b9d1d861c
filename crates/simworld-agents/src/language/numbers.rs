//! Numbers, times and quantities in words.

use super::lexer::{Lexeme, Token};
use super::lexicon::{fits, longest, longest_phrase};

/// Numbers in words.
pub(crate) const NUMERALS: &[(&str, f64)] = &[
    ("a", 1.0),
    ("an", 1.0),
    ("one", 1.0),
    ("two", 2.0),
    ("three", 3.0),
    ("four", 4.0),
    ("five", 5.0),
    ("six", 6.0),
    ("seven", 7.0),
    ("eight", 8.0),
    ("nine", 9.0),
    ("ten", 10.0),
    ("eleven", 11.0),
    ("twelve", 12.0),
    ("thirteen", 13.0),
    ("fourteen", 14.0),
    ("fifteen", 15.0),
    ("sixteen", 16.0),
    ("seventeen", 17.0),
    ("eighteen", 18.0),
    ("nineteen", 19.0),
    ("twenty", 20.0),
    ("thirty", 30.0),
    ("forty", 40.0),
    ("fifty", 50.0),
    ("sixty", 60.0),
    ("seventy", 70.0),
    ("eighty", 80.0),
    ("ninety", 90.0),
    ("hundred", 100.0),
    ("dozen", 12.0),
    ("half", 0.5),
    ("couple", 2.0),
    ("pair", 2.0),
];

/// Places in a row, in words.
const ORDINALS: &[(&str, u32)] = &[
    ("first", 1),
    ("second", 2),
    ("third", 3),
    ("fourth", 4),
    ("fifth", 5),
    ("sixth", 6),
    ("seventh", 7),
    ("eighth", 8),
    ("ninth", 9),
    ("tenth", 10),
    ("1st", 1),
    ("2nd", 2),
    ("3rd", 3),
    ("4th", 4),
    ("5th", 5),
    ("6th", 6),
    ("7th", 7),
    ("8th", 8),
    ("9th", 9),
    ("10th", 10),
];

/// A little while, s, where none is said.
pub(super) const MOMENT: f64 = 2.0;

fn numeral(lexeme: Option<&Lexeme>) -> Option<f64> {
    match &lexeme?.token {
        Token::Number(number) => Some(*number),
        Token::Word(word) => NUMERALS.iter().find(|(numeral, _)| numeral == word).map(|(_, number)| *number),
        _ => None,
    }
}

/// A number in digits or words at the start, with how many tokens it takes: "5", "twenty five", "half a", "a couple of".
pub(super) fn number(lexemes: &[Lexeme]) -> Option<(f64, usize)> {
    if ["minus", "negative"].iter().any(|word| fits(lexemes, word).is_some()) {
        return number(&lexemes[1..]).map(|(number, tokens)| (-number, tokens + 1));
    }
    let first = numeral(lexemes.first())?;
    let second = numeral(lexemes.get(1));
    let article =
        |at: usize| ["a", "an"].iter().any(|word| fits(&lexemes[at.min(lexemes.len())..], word).is_some());
    if first == 0.5 && article(1) && fits(&lexemes[2..], "dozen").is_some() {
        return Some((6.0, 3));
    }
    if first == 0.5 && article(1) {
        return Some((0.5, 2));
    }
    if article(0) && second.is_some_and(|second| second != 1.0) {
        // "a dozen", "a couple of", "a hundred", "a half"
        let of = usize::from(fits(&lexemes[2..], "of").is_some());
        return Some((second.unwrap_or(1.0), 2 + of));
    }
    if let Some(units) = second.filter(|units| *units >= 1.0 && *units < 10.0 && !article(1)) {
        let is_tens = (20.0..100.0).contains(&first) && first % 10.0 == 0.0;
        let in_words =
            matches!(lexemes[0].token, Token::Word(_)) && matches!(lexemes[1].token, Token::Word(_));
        if is_tens && in_words {
            return Some((first + units, 2));
        }
    }
    if second == Some(100.0) && first < 10.0 {
        return Some((first * 100.0, 2));
    }
    Some((first, 1))
}

/// A count of two or more before a plural: "two", "a couple of"; a lone article is none.
pub(super) fn count(lexemes: &[Lexeme]) -> Option<(u32, usize)> {
    let (number, tokens) = number(lexemes)?;
    ((2.0..=1000.0).contains(&number) && number.fract() == 0.0).then_some((number as u32, tokens))
}

/// A place in a row.
pub(super) fn ordinal(lexemes: &[Lexeme]) -> Option<u32> {
    let Token::Word(word) = &lexemes.first()?.token else { return None };
    ORDINALS.iter().find(|(ordinal, _)| ordinal == word).map(|(_, place)| *place)
}

/// How many times: "twice", "three times", "once".
pub(super) fn times(lexemes: &[Lexeme]) -> Option<(u32, usize)> {
    for (word, times) in [("once", 1), ("twice", 2), ("thrice", 3)] {
        if fits(lexemes, word).is_some() {
            return Some((times, 1));
        }
    }
    let (number, tokens) = number(lexemes)?;
    let unit = longest_phrase(&lexemes[tokens..], &["times", "time", "more times", "times over"])?;
    ((1.0..=1000.0).contains(&number) && number.fract() == 0.0).then_some((number as u32, tokens + unit))
}

/// A length of time, s, with how many tokens it takes; a bare number is seconds.
pub(super) fn duration(lexemes: &[Lexeme]) -> Option<(f64, usize)> {
    const UNITS: &[(&[&str], u32)] = &[
        (&["seconds", "second", "secs", "sec", "s"], 1),
        (&["minutes", "minute", "mins", "min"], 60),
        (&["hours", "hour", "h"], 3600),
    ];
    const MOMENTS: &[&str] = &[
        "a moment",
        "a bit",
        "a while",
        "a little while",
        "a little",
        "a short while",
        "briefly",
        "a few seconds",
        "some time",
        "a few moments",
        "a little bit",
        "a sec",
    ];
    if let Some(tokens) = longest_phrase(lexemes, MOMENTS) {
        let is_second = fits(lexemes, "a sec").is_some();
        return Some((if is_second { 1.0 } else { MOMENT }, tokens));
    }
    let (number, tokens) = number(lexemes)?;
    match longest(&lexemes[tokens..], UNITS) {
        Some((unit, words)) => Some((number * f64::from(unit), tokens + words)),
        None if matches!(lexemes[0].token, Token::Number(_)) => Some((number, tokens)),
        None => None,
    }
}

/// A length, m, with how many tokens it takes: "5 metres", "half a metre", "one and a half metres", "150 cm", "six feet".
pub(super) fn length(lexemes: &[Lexeme]) -> Option<(f64, usize)> {
    let about = longest_phrase(lexemes, ABOUT).unwrap_or(0);
    let (mut number, mut at) = number(lexemes.get(about..)?)?;
    at += about;
    if let Some(words) = longest_phrase(&lexemes[at..], &["and a half"]) {
        (number, at) = (number + 0.5, at + words);
    }
    let (unit, words) = longest(&lexemes[at..], UNITS)?;
    at += words;
    if let Some(words) = longest_phrase(&lexemes[at..], &["and a half"]) {
        (number, at) = (number + 0.5, at + words);
    }
    (number > 0.0 && number.is_finite()).then_some((number * unit, at))
}

/// What makes a number no less exact.
const ABOUT: &[&str] =
    &["some", "about", "around", "roughly", "exactly", "approximately", "just", "only", "a good"];

/// Units of length, m.
pub(super) const UNITS: &[(&[&str], f64)] = &[
    (&["metres", "metre", "meters", "meter", "m", "ms", "mtrs"], 1.0),
    (&["centimetres", "centimetre", "centimeters", "centimeter", "cm", "cms"], 0.01),
    (&["kilometres", "kilometre", "kilometers", "kilometer", "km", "kms"], 1000.0),
    (&["feet", "foot", "ft", "feets"], 0.3048),
    (&["yards", "yard", "yd", "yds"], 0.9144),
    (&["inches", "inch"], 0.0254),
];

/// Every word of these tables, for the spelling.
pub(super) fn words_of_length() -> impl Iterator<Item = &'static str> {
    let numerals = NUMERALS.iter().map(|(word, _)| *word);
    let units = UNITS.iter().flat_map(|(words, _)| *words).copied();
    numerals.chain(units).chain(ABOUT.iter().flat_map(|phrase| phrase.split(' ')))
}
