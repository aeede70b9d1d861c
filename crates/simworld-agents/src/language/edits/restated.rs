//! What is said again by a part of it alone: "to the east of the van, no, sorry, to the west of it", "the van green, sorry, the van blue", "the blue
//! bench ... and the red one"; and points and lengths in words that few use: "at 25 east, 18 north", "400 cm".
//!
//! Each comes to plainer words, and is tried only where a sentence was refused.

use simworld_core::geometry::Point2;

use super::super::compass::DIRECTIONS;
use super::super::lexer::{Lexeme, Token, is_mark, word_of};
use super::super::lexicon::{category, longest, longest_phrase};
use super::super::names::Names;
use super::super::numbers;
use super::super::paint::PAINTS;
use super::super::phrases::Phrases;
use super::forms::{is_same, word, word_at};
use super::repairs::{TAKEN_BACK, needs_anchor};
use super::stood::point_at;
use super::words::{VERBS, Verb, WAYS};

/// A noun that is said twice takes no more words.
const LONGEST_NOUN: usize = 4;
/// So many words stand at most between "put" and the end of "one".
const FARTHEST_ONE: usize = 3;

/// The words in plainer ones, if any of these changes them.
pub(super) fn in_plain_words(lexemes: &[Lexeme], names: &Names<'_>) -> Vec<Lexeme> {
    let mut told = lexemes.to_vec();
    let ways = [in_metres, point_in_words, of_the_same, placed_again, one_of_the_same];
    for way in ways {
        told = way(&told).unwrap_or(told);
    }
    let told = none_is_there(&told, names).unwrap_or(told);
    let told = new_at_point(&told, names).unwrap_or(told);
    new_by_its_name(&told, names).unwrap_or(told)
}

/// As [`in_plain_words`], where the sentence would be misread: a thing that is painted twice.
pub(super) fn put_plainly(lexemes: &mut Vec<Lexeme>) {
    if let Some(told) = painted_again(lexemes) {
        *lexemes = told;
    }
}

/// "400 cm" is four metres.
fn in_metres(lexemes: &[Lexeme]) -> Option<Vec<Lexeme>> {
    #[rustfmt::skip]
    const CENTIMETRES: &[&str] = &["cm", "centimetre", "centimetres", "centimeter", "centimeters", "cms"];
    let mut told = lexemes.to_vec();
    let mut any = false;
    let mut at = 1;
    while at < told.len() {
        let place = told[at].clone();
        if CENTIMETRES.contains(&word_of(&place))
            && let Token::Number(length) = told[at - 1].token
        {
            told[at - 1].token = Token::Number(length / 100.0);
            told[at] = word_at(&place, "metres");
            any = true;
        }
        at += 1;
    }
    any.then_some(told)
}

/// "At 25 east, 18 north" is the point (25, 18). What is so far from something is none.
fn point_in_words(lexemes: &[Lexeme]) -> Option<Vec<Lexeme>> {
    #[rustfmt::skip]
    const AT: &Phrases = &Phrases::of(&["at", "at position", "at the position", "to the position", "at the point", "to the point", "at point", "at coordinates", "at the coordinates", "to the coordinates"]);
    (0..lexemes.len()).find_map(|at| {
        let from = at + longest_phrase(&lexemes[at..], AT)?;
        let (one, next) = part_of_point(lexemes, from)?;
        let is_joint = |at: &usize| lexemes[*at].token == Token::Comma || word(lexemes, *at) == "and";
        let joints = (next..lexemes.len()).take_while(is_joint).count();
        let (other, end) = part_of_point(lexemes, next + joints)?;
        let point = match (one, other) {
            (Part::Across(x), Part::Up(y)) | (Part::Up(y), Part::Across(x)) => Point2::new(x, y),
            _ => return None,
        };
        let is_offset = ["of", "from", "off", "away"].contains(&word(lexemes, end));
        (!is_offset).then(|| {
            let mut told = lexemes.to_vec();
            told.splice(at..end, point_at(&lexemes[at], point));
            told
        })
    })
}

/// How far a point lies east, or north, m.
#[derive(Clone, Copy)]
enum Part {
    Across(f64),
    Up(f64),
}

/// "25 east" or "east 25", and where that ends.
fn part_of_point(lexemes: &[Lexeme], at: usize) -> Option<(Part, usize)> {
    let part = |way: usize, far: f64| match word(lexemes, way) {
        "east" => Some(Part::Across(far)),
        "west" => Some(Part::Across(-far)),
        "north" => Some(Part::Up(far)),
        "south" => Some(Part::Up(-far)),
        _ => None,
    };
    if let Some((far, count)) = numbers::number(lexemes.get(at..)?) {
        return Some((part(at + count, far)?, at + count + 1));
    }
    let (far, count) = numbers::number(lexemes.get(at + 1..)?)?;
    Some((part(at, far)?, at + 1 + count))
}

/// How many words tell a place that is one by something: "beside", "to the west of".
fn way_at(lexemes: &[Lexeme]) -> Option<usize> {
    let the = longest_phrase(lexemes, &["to the", "on the", "just", "directly"]).unwrap_or(0);
    let compass = longest(&lexemes[the..], DIRECTIONS).and_then(|(_, count)| {
        let of = longest_phrase(&lexemes[the + count..], &["of", "from"])?;
        Some(the + count + of)
    });
    let way = || longest(lexemes, &WAYS).filter(|(way, _)| needs_anchor(*way)).map(|(_, count)| count);
    compass.or_else(way)
}

/// Where the words go on behind those that take something back, and the marks between them.
fn behind_take_back(lexemes: &[Lexeme], from: usize) -> Option<usize> {
    let (mut at, mut is_said) = (from, false);
    loop {
        let rest = lexemes.get(at..)?;
        let said = longest_phrase(rest, TAKEN_BACK);
        is_said |= said.is_some();
        let Some(words) = said.or(rest.first().is_some_and(is_mark).then_some(1)) else { break };
        at += words;
    }
    is_said.then_some(at)
}

/// Where the place begins that is taken back at a mark, if it is the one place of its clause and of one thing.
fn place_before(lexemes: &[Lexeme], mark: usize) -> Option<usize> {
    let begin = lexemes[..mark].iter().rposition(is_mark).map_or(0, |at| at + 1);
    let from = (begin + 1..mark).find(|at| way_at(&lexemes[*at..mark]).is_some())?;
    lexemes[from..mark].iter().all(|lexeme| word_of(lexeme) != "and").then_some(from)
}

/// "To the east of the van, no, sorry, to the west of it" is to the west of the van.
fn of_the_same(lexemes: &[Lexeme]) -> Option<Vec<Lexeme>> {
    (2..lexemes.len()).filter(|mark| is_mark(&lexemes[*mark])).find_map(|mark| {
        let next = behind_take_back(lexemes, mark)?;
        let it = next + way_at(&lexemes[next..])?;
        let is_it = matches!(word(lexemes, it), "it" | "him" | "her" | "them");
        let from = place_before(lexemes, mark).filter(|_| is_it)?;
        let anchor = from + way_at(&lexemes[from..mark])?;
        let parts = [&lexemes[..from], &lexemes[next..it], &lexemes[anchor..mark], &lexemes[it + 1..]];
        (anchor < mark).then(|| parts.concat())
    })
}

/// "Beside the tree by the hospital, no, hang on, beside the tree closest to the hydrant": the second place is meant, and nothing of the first.
fn placed_again(lexemes: &[Lexeme]) -> Option<Vec<Lexeme>> {
    (2..lexemes.len()).filter(|mark| is_mark(&lexemes[*mark])).find_map(|mark| {
        let next = behind_take_back(lexemes, mark)?;
        let way = way_at(&lexemes[next..])?;
        let is_it = matches!(word(lexemes, next + way), "it" | "him" | "her" | "them");
        let from = place_before(lexemes, mark).filter(|_| !is_it)?;
        Some([&lexemes[..from], &lexemes[next..]].concat())
    })
}

/// "The van green, sorry, the van blue" is the van blue.
fn painted_again(lexemes: &[Lexeme]) -> Option<Vec<Lexeme>> {
    (0..lexemes.len()).filter(|the| word(lexemes, *the) == "the").find_map(|the| {
        (the + 2..lexemes.len().min(the + 1 + LONGEST_NOUN)).find_map(|paint| {
            let (_, count) = longest(&lexemes[paint..], PAINTS)?;
            let next = behind_take_back(lexemes, paint + count)?;
            let noun = &lexemes[the..paint];
            let again = lexemes.get(next..next + noun.len())?;
            let rest = lexemes.get(next + noun.len()..)?;
            let (_, count) = longest(rest, PAINTS)?;
            let ends = rest.get(count).is_none_or(|end| is_mark(end) || word_of(end) == "and");
            (is_same(noun, again) && ends).then(|| [&lexemes[..paint], rest].concat())
        })
    })
}

/// "The blue bench ... and the red one" is the red bench, where all that had a colour before are benches.
fn one_of_the_same(lexemes: &[Lexeme]) -> Option<Vec<Lexeme>> {
    let is_paint = |at: usize| longest(&lexemes[at..=at], PAINTS).is_some();
    let one = (4..lexemes.len())
        .find(|at| word(lexemes, *at) == "one" && is_paint(at - 1) && word(lexemes, at - 2) == "the")?;
    let painted = |the: &usize| word(lexemes, *the) == "the" && is_paint(the + 1);
    let nouns: Option<Vec<&[Lexeme]>> = (0..one - 2)
        .filter(painted)
        .map(|the| {
            let noun = lexemes.get(the + 2..one)?;
            category(noun).map(|(_, count)| &noun[..count])
        })
        .collect();
    let nouns = nouns?;
    let noun = *nouns.first()?;
    let is_plural = noun.last().is_some_and(|last| word_of(last).ends_with('s') && word_of(last) != "bus");
    if is_plural || !nouns.iter().all(|other| is_same(noun, other)) {
        return None;
    }
    Some([&lexemes[..one], noun, &lexemes[one + 1..]].concat())
}

/// "If there's no bike rack near the cottage, put one in front of it": where there is no such thing at all, there is none there either.
fn none_is_there(lexemes: &[Lexeme], names: &Names<'_>) -> Option<Vec<Lexeme>> {
    #[rustfmt::skip]
    const NONE: &Phrases = &Phrases::of(&["if there is no", "if theres no", "if there isnt a", "if there isnt an", "if there isnt any", "if there is not a", "if there is not any", "if there are no", "unless there is a", "unless theres a"]);
    let none = longest_phrase(lexemes, NONE)?;
    let asset = none + names.asset_words(&lexemes[none..])?;
    if !names.is_sort_of_none(&lexemes[none..asset]) {
        return None;
    }
    let place = asset + way_at(&lexemes[asset..])?;
    let comma = (place + 1..lexemes.len()).find(|at| is_mark(&lexemes[*at]))?;
    // "..., which I can hardly believe, ...".
    let is_told = matches!(word(lexemes, comma + 1), "which" | "what");
    let mark = if is_told { (comma + 1..lexemes.len()).find(|at| is_mark(&lexemes[*at]))? } else { comma };
    let (verb, count) = longest(lexemes.get(mark + 1..)?, &VERBS)?;
    let behind = mark + 1 + count;
    let one = (behind..lexemes.len().min(behind + FARTHEST_ONE)).find(|at| word(lexemes, *at) == "one")?;
    let it = one + 1 + way_at(&lexemes[one + 1..])?;
    let is_it = matches!(word(lexemes, it), "it" | "him" | "her") && matches!(verb, Verb::Add | Verb::Put);
    is_it.then(|| {
        let first = [word_at(&lexemes[0], "put"), word_at(&lexemes[0], "a")];
        let parts = [&lexemes[none..asset], &lexemes[one + 1..it], &lexemes[place..comma]];
        [&first[..], &parts.concat()[..], &lexemes[it + 1..]].concat()
    })
}

/// "Wooden crate at (-15, 15)": a new one, where nothing is called so.
fn new_at_point(lexemes: &[Lexeme], names: &Names<'_>) -> Option<Vec<Lexeme>> {
    let asset = names.asset_words(lexemes)?;
    let is_open = lexemes.get(asset + 1).is_some_and(|open| open.token == Token::Open);
    let is_new = is_open && word(lexemes, asset) == "at" && names.exact(lexemes).is_none();
    is_new.then(|| {
        let put = [word_at(&lexemes[0], "put"), word_at(&lexemes[0], "a")];
        [&put[..], lexemes].concat()
    })
}

/// "Place the generator within 4 metres of the kiosk": what is named as if it were there is new where none is, and where it is told where it goes.
fn new_by_its_name(lexemes: &[Lexeme], names: &Names<'_>) -> Option<Vec<Lexeme>> {
    let begins =
        |at: usize| at == 0 || is_mark(&lexemes[at - 1]) || matches!(word(lexemes, at - 1), "and" | "please");
    (0..lexemes.len()).filter(|at| begins(*at)).find_map(|at| {
        let (verb, count) = longest(&lexemes[at..], &VERBS)?;
        let the = at + count;
        let is_new = matches!(verb, Verb::Add | Verb::Put) && word(lexemes, the) == "the";
        let noun = lexemes.get(the + 1..).filter(|_| is_new)?;
        let asset = names.asset_words(noun)?;
        let is_none = names.is_sort_of_none(&noun[..asset]) && category(noun).is_none();
        let is_place = word(noun, asset) == "within" && noun.get(asset + 1).is_some();
        (is_none && is_place).then(|| {
            let mut told = lexemes.to_vec();
            told[the] = word_at(&lexemes[the], "a");
            told
        })
    })
}

#[cfg(test)]
mod tests {
    use super::super::super::lexer::rewritten;
    use super::*;

    /// What a rule makes of words, or the words.
    fn told(said: &str, rule: fn(&[Lexeme]) -> Option<Vec<Lexeme>>) -> String {
        rewritten(said, |lexemes| {
            if let Some(plain) = rule(lexemes) {
                *lexemes = plain;
            }
        })
    }

    #[test]
    fn places_are_taken_back_as_a_whole() {
        assert_eq!(
            told("move the taxi to the east of the van, no, sorry, to the west of it", of_the_same),
            "move the taxi to the west of the van"
        );
        assert_eq!(
            told(
                "put a bin beside the tree by the bank, no, hang on, beside the tree near the oak",
                placed_again
            ),
            "put a bin beside the tree near the oak"
        );
        let several = "put a bin by the oak and a lamp by the pine, no, hang on, by the bank";
        assert_eq!(told(several, placed_again), told(several, |_| None));
    }

    #[test]
    fn colours_are_said_again() {
        assert_eq!(
            told("paint the taxi black and the van green - sorry, the van blue", painted_again),
            "paint the taxi black and the van blue"
        );
        assert_eq!(
            told("move the red bench here and repaint the blue one green", one_of_the_same),
            "move the red bench here and repaint the blue bench green"
        );
        let two = "move the red bench and the white car here and paint the blue one green";
        assert_eq!(told(two, one_of_the_same), two);
    }

    #[test]
    fn points_and_lengths_are_told_in_numbers() {
        assert_eq!(told("plant a tree at 25 east, 18 north", point_in_words), "plant a tree at , 25 , 18 ,");
        assert_eq!(told("put it at 5 south and 3 west", point_in_words), "put it at , -3 , -5 ,");
        let offset = "put it at 5 east and 3 north of the bank";
        assert_eq!(told(offset, point_in_words), offset);
        assert_eq!(told("within 400 cm of it", in_metres), "within 4 metres of it");
    }
}
