//! Which of several are meant, put as it is read: "of the red cars, the one furthest west" is the red car furthest west, "whichever oak is nearest to
//! me" the oak nearest to me, "the limes unless they are taller than ten metres" all limes but those, "oaks taller than ten metres" all
//! of them, and "every car bar the green one" every car except it.

use super::super::lexer::{Lexeme, Token, is_mark};
use super::super::lexicon::{MOSTS, category, longest, longest_phrase};
use super::super::numbers;
use super::super::paint::PAINTS;
use super::super::phrases::Phrases;
use super::super::sorts::singulars;
use super::follow::species;
use super::forms::{word, word_at, words_at};

/// Before several things of which one is told then.
#[rustfmt::skip]
const OF: &Phrases = &Phrases::of(&["of the", "of those", "of these", "of all the", "of our", "out of the", "out of all the", "among the", "from among the", "from the"]);
/// Between a thing and what tells it from the others.
#[rustfmt::skip]
const IS: &Phrases = &Phrases::of(&["is", "is the", "stands", "stands the", "sits", "lies", "is standing", "is parked", "happens to be", "happens to be the", "happens to stand", "comes"]);
/// What tells it, with what it is nearest to behind it.
#[rustfmt::skip]
const NEAREST: &Phrases = &Phrases::of(&["nearest to", "closest to", "nearest", "closest", "farthest from", "furthest from", "farthest away from", "furthest away from", "farthest east", "farthest west", "farthest north", "farthest south", "furthest east", "furthest west", "furthest north", "furthest south"]);
/// Before a length that is a limit.
#[rustfmt::skip]
const THAN: &Phrases = &Phrases::of(&["taller than", "higher than", "shorter than", "lower than", "bigger than", "larger than", "smaller than", "longer than", "wider than"]);
/// Before a length as well, behind a noun.
const LIMITS: &Phrases = &Phrases::of(&["under", "over", "above", "below"]);
/// Behind several things, of which these are none.
#[rustfmt::skip]
const UNLESS: &Phrases = &Phrases::of(&["unless they are", "unless theyre", "except if they are", "except if theyre", "except when they are", "except where they are", "unless it is", "unless its"]);
/// Behind several things, of which only these are some.
#[rustfmt::skip]
const ONLY_IF: &Phrases = &Phrases::of(&["if they are", "if theyre", "only if they are", "only if theyre", "but only if they are", "provided they are", "provided that they are", "as long as they are", "so long as they are", "if it is", "only if it is"]);
/// Words for all of several.
const ALL: &[&str] = &["all", "every", "each", "any", "everything", "everybody", "everyone", "both"];
/// What is left out of them.
const BAR: &Phrases = &Phrases::of(&["bar", "bar for", "barring", "minus", "save for", "but for"]);
/// What is left out is named in so few words.
const LONGEST: usize = 5;
/// That something should be so.
#[rustfmt::skip]
const OUGHT: &Phrases = &Phrases::of(&["should", "must", "are to", "have to", "need to", "needs to", "shall", "ought to", "may", "can", "could", "have got to"]);

/// Puts the words so.
pub(super) fn in_plain_words(lexemes: &mut Vec<Lexeme>) {
    one_of_several(lexemes);
    whichever(lexemes);
    the_one(lexemes);
    limited(lexemes);
    all_limited(lexemes);
    barring(lexemes);
}

/// The words of a noun in the singular, if they are one in the plural.
fn singular(noun: &[Lexeme]) -> Option<Vec<Lexeme>> {
    let (last, before) = noun.split_last()?;
    singulars(word(noun, noun.len() - 1)).skip(1).find_map(|stem| {
        let said: Vec<Lexeme> = before.iter().cloned().chain([word_at(last, &stem)]).collect();
        names_class(&said).then_some(said)
    })
}

/// Whether words are the noun of a class, or a sort of tree.
fn names_class(noun: &[Lexeme]) -> bool {
    category(noun).is_some_and(|(_, words)| words == noun.len())
        || matches!(noun, [only] if species(only).is_some())
}

/// How many words name a class from here on, with a colour before it.
fn class_at(lexemes: &[Lexeme], at: usize) -> Option<usize> {
    let rest = lexemes.get(at..)?;
    let paint = longest(rest, PAINTS).map_or(0, |(_, words)| words);
    let noun = rest.get(paint..)?;
    let words =
        category(noun).map_or(0, |(_, words)| words).max(usize::from(species(noun.first()?).is_some()));
    (words > 0).then_some(paint + words)
}

/// Where a noun begins that ends before a word, in whatever number it is.
fn noun_before(lexemes: &[Lexeme], at: usize) -> Option<usize> {
    (at.saturating_sub(3)..at).find(|from| names_class(&lexemes[*from..at]))
}

/// A comparison with a length, and how many words it takes: "taller than ten metres".
fn limit(lexemes: &[Lexeme]) -> Option<usize> {
    let than = longest_phrase(lexemes, THAN)?;
    numbers::length(lexemes.get(than..)?).filter(|(_, words)| *words > 1).map(|(_, words)| than + words)
}

/// "Of the red cars, the one furthest west": the red car furthest west.
fn one_of_several(lexemes: &mut Vec<Lexeme>) {
    let starts = |at: usize| at == 0 || lexemes[at - 1].token == Token::Break;
    let found = (0..lexemes.len()).filter(|at| starts(*at)).find_map(|at| {
        let of = longest_phrase(&lexemes[at..], OF)?;
        let number = numbers::count(&lexemes[at + of..]).map_or(0, |(_, words)| words);
        let from = at + of + number;
        let comma = (from + 1..lexemes.len()).find(|at| is_mark(&lexemes[*at]))?;
        let paint = longest(&lexemes[from..comma], PAINTS).map_or(0, |(_, words)| words);
        let noun = singular(&lexemes[from + paint..comma])?;
        let one = (comma + 1..lexemes.len().min(comma + 5)).find(|at| word(lexemes, *at) == "one")?;
        let is_one = lexemes[comma].token == Token::Comma
            && word(lexemes, comma + 1) == "the"
            && !lexemes[comma + 1..one].iter().any(is_mark)
            && class_at(lexemes, one + 1).is_none();
        // Of what is said without a colour the noun alone is put in the place of "one" elsewhere.
        let says_more = paint > 0 || number > 0;
        let thing: Vec<Lexeme> = lexemes[from..from + paint].iter().cloned().chain(noun).collect();
        (is_one && says_more).then_some((at, comma, one, thing))
    });
    if let Some((at, comma, one, thing)) = found {
        lexemes.splice(one..=one, thing);
        lexemes.drain(at..=comma);
    }
}

/// "Whichever oak is nearest to me" is the oak nearest to me, and "whichever is the tallest oak" needs no more.
fn whichever(lexemes: &mut Vec<Lexeme>) {
    let found = (0..lexemes.len()).find_map(|at| {
        matches!(word(lexemes, at), "whichever" | "whatever").then_some(())?;
        let noun = at + 1 + class_at(lexemes, at + 1)?;
        let is = longest_phrase(lexemes.get(noun..)?, IS)?;
        let rest = lexemes.get(noun + is..)?;
        let most = longest(rest, MOSTS)
            .filter(|(_, words)| *words == 1 && word(rest, 0).ends_with("est"))
            .map(|(_, words)| words);
        let near = longest_phrase(rest, NEAREST);
        (near.is_some() || most.is_some()).then_some((at, noun, is, near.is_none()))
    });
    let Some((at, noun, is, is_most)) = found else { return };
    lexemes[at] = word_at(&lexemes[at], "the");
    lexemes.drain(noun..noun + is);
    if is_most {
        // "The tallest oak".
        let most = lexemes.remove(noun);
        lexemes.insert(at + 1, most);
    }
}

/// "The one tree under 8.5 m": the tree.
fn the_one(lexemes: &mut Vec<Lexeme>) {
    let found = (1..lexemes.len()).find(|at| {
        let is_one = word(lexemes, *at) == "one" && word(lexemes, at - 1) == "the";
        let behind = class_at(lexemes, at + 1).filter(|_| is_one).map(|words| at + 1 + words);
        behind.and_then(|behind| lexemes.get(behind..)).is_some_and(|rest| {
            let limits = longest_phrase(rest, LIMITS).and_then(|words| numbers::length(rest.get(words..)?));
            limits.is_some() || limit(rest).is_some()
        })
    });
    if let Some(at) = found {
        lexemes.remove(at);
    }
}

/// "Cut down the limes unless they are taller than ten metres": all limes but those that are, for it is asked of each.
fn limited(lexemes: &mut Vec<Lexeme>) {
    let found = (2..lexemes.len()).find_map(|at| {
        let rest = &lexemes[at..];
        let unless = longest_phrase(rest, UNLESS);
        let words = unless.or_else(|| longest_phrase(rest, ONLY_IF))?;
        let of_one = (at..at + words).any(|at| matches!(word(lexemes, at), "it" | "its"));
        let than = limit(rest.get(words..)?)?;
        let end = at + words + than;
        let stop = at - usize::from(is_mark(&lexemes[at - 1]));
        let noun = noun_limited(lexemes, stop, of_one)?;
        let ends = lexemes.get(end).is_none_or(|next| is_mark(next) || word(lexemes, end) == "please");
        ends.then_some((noun, stop, at + words..end, unless.is_some()))
    });
    let Some((noun, stop, than, unless)) = found else { return };
    let place = lexemes[than.start].clone();
    let end = than.end;
    let plain: Vec<Lexeme> = words_at(&place, if unless { "except the ones" } else { "that are" })
        .chain(lexemes[than].iter().cloned())
        .collect();
    lexemes.drain(stop..end);
    lexemes.splice(noun..noun, plain);
}

/// Behind the noun of the only several things of a clause that ends here or, with `of_one`, of the only things each of which is meant.
fn noun_limited(lexemes: &[Lexeme], stop: usize, of_one: bool) -> Option<usize> {
    let clause = lexemes[..stop].iter().rposition(is_mark).map_or(0, |mark| mark + 1);
    let is_led = |from: usize, words: &[&str]| {
        (from.saturating_sub(3).max(clause)..from).any(|at| words.contains(&word(lexemes, at)))
    };
    let nouns: Vec<usize> = (clause + 1..=stop)
        .filter(|end| {
            noun_before(lexemes, *end).is_some_and(|from| {
                let is_plural = singular(&lexemes[from..*end]).is_some();
                from >= clause
                    && (is_led(from, &["all", "every", "each", "any"])
                        || !of_one && is_plural && is_led(from, &["the", "these", "those", "our", "my"]))
            })
        })
        .collect();
    match nouns[..] {
        [noun] => Some(noun),
        _ => None,
    }
}

/// "Oaks taller than eight metres are to be felled": all of them.
fn all_limited(lexemes: &mut Vec<Lexeme>) {
    let starts = |at: usize| at == 0 || lexemes[at - 1].token == Token::Break;
    let found = (0..lexemes.len()).filter(|at| starts(*at)).find(|at| {
        let Some(noun) = class_at(lexemes, *at).map(|words| at + words) else { return false };
        let rest = lexemes.get(noun..).unwrap_or_default();
        let that_are = longest_phrase(rest, &["that are", "which are"]).unwrap_or(0);
        let Some(than) = limit(&rest[that_are..]) else { return false };
        let behind = &rest[that_are + than..];
        let is_plural =
            noun_before(lexemes, noun).is_some_and(|from| singular(&lexemes[from..noun]).is_some());
        is_plural && longest_phrase(behind, OUGHT).is_some()
    });
    if let Some(at) = found {
        let all = word_at(&lexemes[at], "all");
        lexemes.insert(at, all);
    }
}

/// "Every car bar the green one" is every car except it.
fn barring(lexemes: &mut Vec<Lexeme>) {
    const CERTAIN: &Phrases = &Phrases::of(&["the", "that", "those", "this", "these", "my", "our"]);
    let found = (2..lexemes.len()).find_map(|at| {
        let words = longest_phrase(&lexemes[at..], BAR)?;
        longest_phrase(lexemes.get(at + words..)?, CERTAIN)?;
        let stop = at - usize::from(lexemes[at - 1].token == Token::Comma);
        // "Remove all tents, bar the road" closes the road.
        let of_them =
            (at + words + 1..at + words + LONGEST).any(|at| matches!(word(lexemes, at), "one" | "ones"));
        if stop < at && word(lexemes, at) == "bar" && !of_them {
            return None;
        }
        let noun = noun_before(lexemes, stop);
        let is_all = noun
            .is_some_and(|noun| (noun.saturating_sub(3)..noun).any(|at| ALL.contains(&word(lexemes, at))))
            || stop > 0 && ALL.contains(&word(lexemes, stop - 1));
        is_all.then_some((stop, at + words))
    });
    if let Some((from, to)) = found {
        let except = word_at(&lexemes[to - 1], "except");
        lexemes.splice(from..to, [except]);
    }
}

#[cfg(test)]
mod tests {
    use super::super::super::lexer::rewritten;
    use super::*;

    fn plain(said: &str) -> String {
        rewritten(said, in_plain_words)
    }

    #[test]
    fn which_are_meant_is_put_as_it_is_read() {
        for (said, meant) in [
            ("of the red cars, the one furthest west should go", "the red car furthest west should go"),
            ("whichever oak is nearest to me should go", "the oak nearest to me should go"),
            ("paint whichever red car is the tallest blue", "paint the tallest red car blue"),
            ("name the one tree under 8.5 m Junior", "name the tree under 8.5 m junior"),
            (
                "cut down the limes unless they are taller than 10 metres",
                "cut down the limes except the ones taller than 10 metres",
            ),
            (
                "paint every tree red unless it is taller than 10 metres",
                "paint every tree except the ones taller than 10 metres red",
            ),
            ("remove the oaks if they are shorter than 6 m", "remove the oaks that are shorter than 6 m"),
            (
                "oaks taller than eight metres are to be felled",
                "all oaks taller than eight metres are to be felled",
            ),
            ("every car bar the green one has to go", "every car except the green one has to go"),
            ("remove all benches, barring the red one", "remove all benches except the red one"),
        ] {
            assert_eq!(plain(said), meant);
        }
    }

    #[test]
    fn what_does_not_say_which_stays() {
        for said in [
            "close the road , bar the gate",
            "remove all tents , bar the road",
            "remove the oak unless it is taller than 10 metres",
            "oaks taller than eight metres grow here",
            "whatever you do",
            "the one chair near the lab",
            "paint the benches and the cars red unless they are taller than 2 m",
        ] {
            assert_eq!(plain(said), said);
        }
    }
}
