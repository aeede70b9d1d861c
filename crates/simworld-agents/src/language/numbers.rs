//! Numbers, times and quantities in words.

use std::sync::LazyLock;

use super::lexer::{Lexeme, Token};
use super::lexicon::{fits, longest, longest_phrase};
use super::phrases::{Index, Phrases};

/// Numbers in words.
#[rustfmt::skip]
pub(crate) const NUMERALS: &[(&str, f64)] = &[
    ("a", 1.0), ("an", 1.0), ("one", 1.0), ("two", 2.0), ("three", 3.0), ("four", 4.0), ("five", 5.0), ("six",
    6.0), ("seven", 7.0), ("eight", 8.0), ("nine", 9.0), ("ten", 10.0), ("eleven", 11.0), ("twelve", 12.0),
    ("thirteen", 13.0), ("fourteen", 14.0), ("fifteen", 15.0), ("sixteen", 16.0), ("seventeen", 17.0),
    ("eighteen", 18.0), ("nineteen", 19.0), ("twenty", 20.0), ("thirty", 30.0), ("forty", 40.0), ("fifty",
    50.0), ("sixty", 60.0), ("seventy", 70.0), ("eighty", 80.0), ("ninety", 90.0), ("hundred", 100.0),
    ("thousand", 1000.0), ("dozen", 12.0), ("half", 0.5), ("couple", 2.0), ("pair", 2.0),
    ("trio", 3.0), ("threesome", 3.0), ("quartet", 4.0), ("foursome", 4.0), ("quintet", 5.0),
];

/// Places in a row, in words.
#[rustfmt::skip]
const ORDINALS: &[(&str, u32)] = &[
    ("first", 1), ("second", 2), ("third", 3), ("fourth", 4), ("fifth", 5), ("sixth", 6), ("seventh", 7),
    ("eighth", 8), ("ninth", 9), ("tenth", 10), ("1st", 1), ("2nd", 2), ("3rd", 3), ("4th", 4), ("5th", 5),
    ("6th", 6), ("7th", 7), ("8th", 8), ("9th", 9), ("10th", 10),
];

/// A little while, s, where none is said.
pub(super) const MOMENT: f64 = 2.0;

fn numeral(lexeme: Option<&Lexeme>) -> Option<f64> {
    static INDEX: LazyLock<Index<f64>> = LazyLock::new(|| Index::new(NUMERALS.iter().copied()));
    match &lexeme?.token {
        Token::Number(number) => Some(*number),
        Token::Word(word) => INDEX.alone(word),
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
        if second == Some(100.0) {
            return Some(with_rest(lexemes, 100.0, 2));
        }
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
    if (2.0..100.0).contains(&first)
        && ["dozen", "dozens"].iter().any(|word| fits(&lexemes[1..], word).is_some())
    {
        let of = usize::from(lexemes.get(2).is_some_and(|_| fits(&lexemes[2..], "of").is_some()));
        return Some((first * 12.0, 2 + of));
    }
    if second == Some(100.0) && first < 10.0 {
        return Some(with_rest(lexemes, first * 100.0, 2));
    }
    Some(if first == 100.0 && matches!(lexemes[0].token, Token::Word(_)) {
        with_rest(lexemes, first, 1)
    } else {
        (first, 1)
    })
}

/// "A hundred and twenty": what follows hundreds in words and is less than one.
fn with_rest(lexemes: &[Lexeme], hundreds: f64, at: usize) -> (f64, usize) {
    let and = longest_phrase(&lexemes[at..], &["and"]).unwrap_or(0);
    let rest = &lexemes[at + and..];
    let in_words =
        matches!(rest.first(), Some(Lexeme { token: Token::Word(word), .. }) if word != "a" && word != "an");
    match number(rest).filter(|(more, _)| in_words && (1.0..100.0).contains(more) && more.fract() == 0.0) {
        Some((more, words)) => (hundreds + more, at + and + words),
        None => (hundreds, at),
    }
}

/// A count of two or more before a plural: "two", "a couple of"; a lone article is none.
pub(super) fn count(lexemes: &[Lexeme]) -> Option<(u32, usize)> {
    let (number, tokens) = number(lexemes)?;
    ((2.0..=1000.0).contains(&number) && number.fract() == 0.0).then_some((number as u32, tokens))
}

/// A place in a row.
pub(super) fn ordinal(lexemes: &[Lexeme]) -> Option<u32> {
    static INDEX: LazyLock<Index<u32>> = LazyLock::new(|| Index::new(ORDINALS.iter().copied()));
    let Token::Word(word) = &lexemes.first()?.token else { return None };
    INDEX.alone(word)
}

/// How many times: "twice", "three times", "once", "on two occasions".
pub(super) fn times(lexemes: &[Lexeme]) -> Option<(u32, usize)> {
    #[rustfmt::skip]
    const UNITS: &[&str] = &[
        "times", "time", "more times", "times over", "times in a row", "times running", "times in total",
        "times in all", "times each", "times altogether", "times more", "times through", "x", "repetitions", "reps",
        "repeats", "goes", "rounds of it", "rounds of that", "repetitions of that", "times running please", "rounds in all",
        "times back to back", "times without a break", "times on the trot",
    ];
    const ONES: &[(&[&str], u32)] = &[
        (&["once", "once each", "just once", "only once", "a single time", "one single time"], 1),
        (&["twice", "twice over", "twice in a row", "twice each", "two times", "twice more"], 2),
        (&["thrice"], 3),
    ];
    if let Some(found) = longest(lexemes, ONES) {
        return Some(found);
    }
    let before = longest_phrase(lexemes, &["a total of", "on", "for", "altogether"]).unwrap_or(0);
    let (number, tokens) = number(&lexemes[before..])?;
    let after = &lexemes[before + tokens..];
    let units = if fits(lexemes, "on").is_some() {
        &["occasions", "different occasions", "separate occasions"][..]
    } else {
        UNITS
    };
    let unit = longest_phrase(after, units)?;
    ((1.0..=1000.0).contains(&number) && number.fract() == 0.0)
        .then_some((number as u32, before + tokens + unit))
}

/// So many of a unit at the start, with how many tokens that takes: "5 m", "half an hour", "two and a half minutes",
/// "a minute and a half", "three quarters of an hour".
fn quantity(lexemes: &[Lexeme], units: &[(&[&str], f64)]) -> Option<(f64, usize)> {
    const FRACTIONS: &[(&[&str], f64)] = &[
        (&["a quarter of a", "a quarter of an", "quarter of an", "quarter of a", "a quarter"], 0.25),
        (&["three quarters of a", "three quarters of an", "three quarter of an"], 0.75),
        (&["half of a", "half of an", "a half"], 0.5),
    ];
    const MORE: &[(&[&str], f64)] =
        &[(&["and a half"], 0.5), (&["and a quarter"], 0.25), (&["and three quarters"], 0.75)];
    let of_unit = |at: usize| longest(lexemes.get(at..)?, units);
    if let Some((part, words)) = longest(lexemes, FRACTIONS)
        && let Some((unit, count)) = of_unit(words)
    {
        return Some((part * unit, words + count));
    }
    let (mut number, mut at) = number(lexemes)?;
    if let Some((more, words)) =
        longest(&lexemes[at..], MORE).filter(|(_, words)| of_unit(at + words).is_some())
    {
        (number, at) = (number + more, at + words);
    }
    let (unit, count) = of_unit(at)?;
    at += count;
    if let Some((more, words)) = longest(&lexemes[at..], MORE) {
        (number, at) = (number + more, at + words);
    }
    Some((number * unit, at))
}

/// A length of time, s, with how many tokens it takes; a bare number in digits is seconds.
pub(super) fn duration(lexemes: &[Lexeme]) -> Option<(f64, usize)> {
    #[rustfmt::skip]
    const UNITS: &[(&[&str], f64)] = &[
        (&["seconds", "second", "secs", "sec", "s", "full seconds", "whole seconds"], 1.0),
        (&["minutes", "minute", "mins", "min", "full minutes", "whole minutes", "full minute", "whole minute"],
        60.0),
        (&["hours", "hour", "h", "hrs", "hr", "full hour", "whole hour"], 3600.0),
    ];
    #[rustfmt::skip]
    const MOMENTS: &Phrases = &Phrases::of(&[
        "a moment", "a bit", "a while", "a little while", "a little", "a short while", "briefly",
        "a few seconds", "some time", "a few moments", "a little bit", "a sec", "a short moment",
        "a second or two", "a tick", "a jiffy",
    ]);
    let about = longest_phrase(lexemes, ABOUT).unwrap_or(0);
    let after = &lexemes[about..];
    if let Some(tokens) = longest_phrase(after, MOMENTS) {
        let is_second = fits(after, "a sec").is_some();
        return Some((if is_second { 1.0 } else { MOMENT }, about + tokens));
    }
    let Some((mut seconds, mut at)) = quantity(after, UNITS) else {
        let (number, tokens) = number(after)?;
        return matches!(after[0].token, Token::Number(_)).then_some((number, about + tokens));
    };
    // "One minute and 30 seconds": each further part is of a smaller unit.
    while let Some((more, words)) = further(&after[at..], UNITS, seconds) {
        (seconds, at) = (seconds + more, at + words);
    }
    Some((seconds, about + at))
}

/// The next part of a quantity, if it is less than what was said so far.
fn further(lexemes: &[Lexeme], units: &[(&[&str], f64)], so_far: f64) -> Option<(f64, usize)> {
    let and = longest_phrase(lexemes, &["and"]).unwrap_or(0);
    let (more, words) = quantity(&lexemes[and..], units)?;
    (more < so_far.min(60.0)).then_some((more, and + words))
}

/// How far one walks, m; a step is taken for a metre.
pub(super) fn walked(lexemes: &[Lexeme]) -> Option<(f64, usize)> {
    const STEPS: &[(&[&str], f64)] = &[(
        &["steps", "step", "paces", "pace", "strides", "stride", "big steps", "little steps", "small steps"],
        1.0,
    )];
    length(lexemes).or_else(|| {
        let about = longest_phrase(lexemes, ABOUT).unwrap_or(0);
        let (steps, words) = quantity(&lexemes[about..], STEPS)?;
        steps.is_finite().then_some((steps, about + words))
    })
}

/// An angle, radians, with how many tokens it takes: "45 degrees", "1.5 rad", "a quarter turn", "half a circle"; a bare
/// number is degrees.
pub(super) fn angle(lexemes: &[Lexeme]) -> Option<(f64, usize)> {
    #[rustfmt::skip]
    const TURNS: &[(&[&str], f64)] = &[
        (&["a quarter turn", "quarter turn", "a quarter of a turn", "a quarter circle", "a quarter of a circle",
        "one quarter turn"], 0.25),
        (&["a half turn", "half a turn", "half turn", "half a circle", "a half circle"], 0.5),
        (&["three quarters of a turn", "a three quarter turn", "three quarter turn"], 0.75),
        (&["a full turn", "a full circle", "full circle", "a whole turn", "a complete turn", "one full turn",
        "a full rotation", "a complete circle", "full turn"], 1.0),
    ];
    const UNITS: &[(&[&str], f64)] = &[
        (&["degrees", "degree", "deg", "°", "degs"], std::f64::consts::PI / 180.0),
        (&["radians", "radian", "rad", "rads"], 1.0),
    ];
    if let Some((turns, words)) = longest(lexemes, TURNS) {
        return Some((turns * std::f64::consts::TAU, words));
    }
    quantity(lexemes, UNITS).or_else(|| {
        let (number, words) = number(lexemes).filter(|_| times(lexemes).is_none())?;
        Some((number.to_radians(), words))
    })
}

/// A length, m, with how many tokens it takes: "5 metres", "half a metre", "one and a half metres", "150 cm", "six feet".
pub(super) fn length(lexemes: &[Lexeme]) -> Option<(f64, usize)> {
    let about = longest_phrase(lexemes, ABOUT).unwrap_or(0);
    let (length, words) = quantity(lexemes.get(about..)?, UNITS)?;
    (length > 0.0 && length.is_finite()).then_some((length, about + words))
}

/// What makes a number no less exact.
#[rustfmt::skip]
const ABOUT: &Phrases = &Phrases::of(&[
    "some", "about", "around", "roughly", "exactly", "approximately", "just", "only", "a good", "another",
    "a further", "at least", "a full", "exactly", "precisely", "maybe", "say", "nearly", "almost",
]);

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
