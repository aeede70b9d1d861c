//! Words that take back what was said just before: "paint it gold, no wait, yellow", "forty chairs, I mean twenty", "under, let
//! us say next to, the bench".
//!
//! What is put right is of the kind of what stands in its place: a number for a number, a colour for a colour, a place for a
//! place, an order for an order, a thing for a thing.

use super::super::compass::DIRECTIONS;
use super::super::lexer::{Lexeme, Token, is_mark};
use super::super::lexicon::{category, longest, longest_phrase};
use super::super::numbers;
use super::super::paint::PAINTS;
use super::super::phrases::Phrases;
use super::forms::word_at;
use super::replaced::{is_article, replaced};
use super::words::{FACTORS, VERBS, WAYS, Way};

/// That what follows is meant, and what stood before is not.
#[rustfmt::skip]
pub(super) const TAKEN_BACK: &Phrases = &Phrases::of(&["no wait", "wait no", "no no", "no sorry", "sorry no", "i mean", "i meant", "no i mean", "no i meant", "sorry i mean", "scratch that", "correction", "no make that",
    "make that", "or rather", "no rather", "oh no", "wait", "no make it", "ok fine", "okay fine", "ok just", "or better", "no better", "better still", "no actually", "actually no",
    "actually make that", "or no", "no not that one", "well i mean", "on second thought", "on second thoughts", "nope", "not that", "oops", "rather", "that is to say", "or simply", "or just", "well ok", "lets say", "let us say",
    "let me say", "say", "shall we say", "or lets say", "no", "well", "sorry", "actually", "ah no", "hang on", "hold on", "no hang on", "no hold on", "sorry make that", "meaning", "strike that", "err", "er", "or actually", "or actually make it", "or actually make that", "actually make it", "or make it", "or make that", "or rather make it", "or rather make that"]);
/// Behind what is meant.
const BEHIND: &[&str] = &["i mean", "i meant", "i should say", "rather"];
/// Of the words that take back, those that are also said where nothing is: no order and no thing is taken back by them.
const WEAK: &Phrases = &Phrases::of(&[
    "well",
    "say",
    "sorry",
    "actually",
    "rather",
    "lets say",
    "let us say",
    "let me say",
    "shall we say",
    "meaning",
    "err",
    "er",
]);

/// Of the weak ones, those behind which a new thing takes the place of the one just before: "a toolbox, sorry, a ladder".
const PUTS_RIGHT: &[&str] =
    &["sorry", "actually", "err", "er", "say", "lets say", "let us say", "let me say"];
/// What is no other thing behind them: "a bench, say, a bit further on".
const NO_THINGS: &[&str] = &["bit", "lot", "few", "little", "couple", "moment", "second", "minute", "while"];

/// Puts what was taken back right, as often as it was.
pub(super) fn put_right(lexemes: &mut Vec<Lexeme>) {
    // Nothing is taken back where nothing parts the words.
    if !lexemes.iter().any(is_mark) {
        side_by_side(lexemes);
        return;
    }
    without_first_word(lexemes);
    without_dangling(lexemes);
    side_by_side(lexemes);
    for _ in 0..MOST {
        let Some(right) = (1..lexemes.len()).find_map(|at| corrected(lexemes, at)) else { return };
        *lexemes = right;
    }
}

/// "Say, ten metres south of the kiosk": before all else it takes nothing back.
fn without_first_word(lexemes: &mut Vec<Lexeme>) {
    let said = longest_phrase(lexemes, &["say", "lets say", "let us say", "shall we say"]).unwrap_or(0);
    let is_comma = lexemes.get(said).is_some_and(|mark| mark.token == Token::Comma);
    let rest = lexemes.get(said + 1..).unwrap_or_default();
    if said > 0 && is_comma && (numbers::length(rest).is_some() || longest(rest, &WAYS).is_some()) {
        lexemes.drain(..=said);
    }
}

/// Takes out a word of place at which somebody breaks off: "under... next to the bench".
fn without_dangling(lexemes: &mut Vec<Lexeme>) {
    let mut at = 1;
    while at < lexemes.len() {
        let behind = at + lexemes[at..].iter().take_while(|lexeme| is_mark(lexeme)).count();
        let said = longest_phrase(&lexemes[behind..], TAKEN_BACK)
            .filter(|words| longest(&lexemes[behind + words..], &WAYS).is_some());
        let next = behind + said.unwrap_or(0);
        let dangles = behind > at && longest(&lexemes[next..], &WAYS).is_some();
        let from = (at.saturating_sub(4)..at).find(|from| {
            dangles
                && longest(&lexemes[*from..at], &WAYS)
                    .is_some_and(|(way, words)| from + words == at && needs_anchor(way))
        });
        match from {
            Some(from) => {
                lexemes.drain(from..next);
                at = from + 1;
            }
            None => at += 1,
        }
    }
}

/// Whether a relation says nothing without what it is to.
pub(super) const fn needs_anchor(way: Way) -> bool {
    !matches!(way, Way::Here | Way::There | Way::InItsPlace | Way::Anywhere)
}

/// "Two, no, three benches", "the blue, I mean the red car", "north, sorry, south of the hall": of two numbers, colours or directions with nothing
/// between them but words that take back, the second is meant.
fn side_by_side(lexemes: &mut Vec<Lexeme>) {
    let mut at = 0;
    while at < lexemes.len() {
        match beside(lexemes, at) {
            Some(behind) => drop(lexemes.drain(at..behind)),
            None => at += 1,
        }
    }
}

/// Where the second of two values stands, behind the first and words that take it back.
fn beside(lexemes: &[Lexeme], at: usize) -> Option<usize> {
    let (kind, words) = value(&lexemes[at..])?;
    let (mut next, mut is_said) = (at + words, false);
    loop {
        let rest = lexemes.get(next..)?;
        let said = longest_phrase(rest, TAKEN_BACK);
        is_said |= said.is_some();
        let Some(words) = said.or(rest.first().is_some_and(is_mark).then_some(1)) else { break };
        next += words;
    }
    // "The blue, I mean the red car" has its article already.
    let is_led = at > 0 && is_article(&lexemes[at - 1..at]);
    let the = longest_phrase(&lexemes[next..], &["the", "a", "an"]).filter(|_| is_led).unwrap_or(0);
    let (other, _) = value(&lexemes[next + the..])?;
    // "Left, well, right next to it" is no other side.
    let is_side = || is_whole_side(&lexemes[next + the..]);
    (is_said && kind == other && (kind != Value::Side || is_side())).then_some(next + the)
}

/// What may be taken back by another of its kind just behind it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Value {
    Paint,
    Number,
    Compass,
    Side,
}

/// A value at the start, and how many words tell it; "a" and "one" are no numbers.
pub(super) fn value(lexemes: &[Lexeme]) -> Option<(Value, usize)> {
    if let Some((_, words)) = longest(lexemes, PAINTS) {
        return Some((Value::Paint, words));
    }
    if let Some((_, words)) = longest(lexemes, DIRECTIONS) {
        return Some((Value::Compass, words));
    }
    if let Some(words) = longest_phrase(lexemes, &["left", "right"]) {
        return Some((Value::Side, words));
    }
    let is_plain = longest_phrase(lexemes, &["a", "an", "one", "half"]).is_none();
    numbers::number(lexemes).filter(|_| is_plain).map(|(_, words)| (Value::Number, words))
}

/// Whether a side at the start is told as one, and is no "right next to".
pub(super) fn is_whole_side(lexemes: &[Lexeme]) -> bool {
    lexemes.get(1).is_none_or(is_mark)
        || longest_phrase(&lexemes[1..], &["of", "side", "hand", "please"]).is_some()
}

/// Nobody takes back more than that in a sentence.
const MOST: usize = 3;

/// The words without what is taken back at a mark, if something is.
fn corrected(lexemes: &[Lexeme], mark: usize) -> Option<Vec<Lexeme>> {
    if !is_mark(&lexemes[mark]) {
        return None;
    }
    let from = mark + (mark..lexemes.len()).take_while(|at| is_mark(&lexemes[*at])).count();
    let rest = lexemes.get(from..)?;
    let end = from + rest.iter().position(is_mark).unwrap_or(rest.len());
    let (mut is_sure, mut is_put_right) = (true, false);
    let (from, to, behind) = if let Some(words) = longest_phrase(rest, TAKEN_BACK) {
        is_sure = longest_phrase(rest, WEAK) != Some(words);
        is_put_right = longest_phrase(rest, PUTS_RIGHT) == Some(words);
        // "The robot, make that one orange" speaks of another.
        let part = lexemes[..mark].iter().rposition(is_mark).map_or(0, |at| at + 1);
        if longest_phrase(rest, &["make that one", "have that one", "make this one"]).is_some()
            && longest_phrase(&lexemes[part..mark], &["the", "that", "my", "our"]).is_some()
        {
            return None;
        }
        // "No clouds" takes nothing back, and "no, clouds" does.
        let is_no = words == 1 && longest_phrase(rest, &["no"]).is_some();
        let is_none = is_no && !rest.get(1).is_some_and(is_mark) && !goes_on(&rest[1..]);
        if is_none || longest(rest, &WAYS).is_some() {
            return None;
        }
        let mut from = from + words;
        from += lexemes[from..].iter().take_while(|lexeme| is_mark(lexeme)).count();
        // "Sorry, I meant the black one", "no, hang on, make that a blue one".
        while let Some(words) = said_again(&lexemes[from..]) {
            is_sure |= longest_phrase(&lexemes[from..], WEAK) != Some(words);
            from += words;
            from += lexemes[from..].iter().take_while(|lexeme| is_mark(lexeme)).count();
        }
        // "No, the other one, the blue one": the last of them says which.
        if let Some(words) = longest_phrase(&lexemes[from..], &["the other one", "the other", "another one"])
            && lexemes.get(from + words).is_some_and(is_mark)
            && lexemes.get(from + words + 1..).is_some_and(is_article)
        {
            from += words + 1;
        }
        let end = from + lexemes[from..].iter().position(is_mark).unwrap_or(lexemes.len() - from);
        (from, end, end)
    } else {
        // "Could it be pale, white I mean".
        let cut = (from + 1..end).find(|at| longest_phrase(&lexemes[*at..end], BEHIND) == Some(end - at))?;
        (from, cut, end)
    };
    let (before, meant) = (&lexemes[..mark], without_make_it(without_of_them(&lexemes[from..to])));
    if meant.is_empty() {
        return None;
    }
    let meant = &with_one(of_what_was_named(before, meant))[..];
    let is_sure = is_sure || is_put_right && is_new_for_new(before, meant);
    let (start, stop) = replaced(before, meant, is_sure)?;
    let mut right = before[..start].to_vec();
    right.extend(with_its_noun(meant, &before[start..stop]));
    right.extend_from_slice(&before[stop..]);
    right.extend_from_slice(behind_it(&lexemes[behind..]));
    Some(right)
}

/// What stands behind what is meant; a place there is its own: "a toolbox, sorry, a ladder, behind the bakery".
fn behind_it(rest: &[Lexeme]) -> &[Lexeme] {
    match rest {
        [comma, place @ ..] if comma.token == Token::Comma && longest(place, &WAYS).is_some() => place,
        _ => rest,
    }
}

/// Behind "no" and without a mark: "no a taxi", "no the other one", "no three", "no behind it". "No clouds" takes nothing back.
fn goes_on(rest: &[Lexeme]) -> bool {
    longest(rest, &VERBS).is_some()
        || longest_phrase(rest, &["a", "an", "the", "behind", "beside", "near", "between", "opposite"])
            .is_some()
        || longest(rest, &WAYS).is_some_and(|(_, words)| words > 1)
        || numbers::count(rest).is_some()
}

/// "The blue car, I mean the red": the red one.
fn with_one(mut meant: Vec<Lexeme>) -> Vec<Lexeme> {
    let is_bare = longest_phrase(&meant, &["the"]).is_some()
        && longest(&meant[1..], PAINTS).is_some_and(|(_, words)| words + 1 == meant.len());
    if let Some(place) = meant.last().filter(|_| is_bare).cloned() {
        meant.push(word_at(&place, "one"));
    }
    meant
}

/// "A toolbox, sorry, a ladder": a new thing just behind another that has no place yet.
fn is_new_for_new(before: &[Lexeme], meant: &[Lexeme]) -> bool {
    let is_thing =
        |lexeme: &Lexeme| matches!(&lexeme.token, Token::Word(word) if !NO_THINGS.contains(&word.as_str()));
    let is_new = longest_phrase(meant, &["a", "an"]).is_some() || numbers::count(meant).is_some();
    is_new && meant.get(1).is_some_and(is_thing) && super::breaks::new_before(before, before.len()).is_some()
}

/// "No wait, three of them": the number that is meant.
fn without_of_them(meant: &[Lexeme]) -> &[Lexeme] {
    let number = numbers::number(meant).map(|(_, words)| words);
    let of = number
        .and_then(|words| longest_phrase(&meant[words..], &["of them", "of those", "of these", "in all"]));
    match (number, of) {
        (Some(words), Some(of)) if words + of == meant.len() => &meant[..words],
        _ => meant,
    }
}

/// "Closer to Anna, I mean right next to her": her is who stood behind the place that is taken back.
fn with_its_anchor(meant: &[Lexeme], instead_of: &[Lexeme]) -> Option<Vec<Lexeme>> {
    let (_, way) = longest(meant, &WAYS)?;
    let (_, old) = longest(instead_of, &WAYS).filter(|(_, words)| *words < instead_of.len())?;
    let is_open = longest_phrase(&meant[way..], &["him", "her", "it", "them"]) == Some(meant.len() - way);
    is_open.then(|| meant[..way].iter().chain(&instead_of[old..]).cloned().collect())
}

/// "No, make it purple": the colour, or the size, that is meant.
fn without_make_it(meant: &[Lexeme]) -> &[Lexeme] {
    #[rustfmt::skip]
    const MAKE_IT: &Phrases = &Phrases::of(&["make it", "make that", "make them", "paint it", "paint them", "colour it", "color it", "have it", "let it be", "it should be", "they should be", "go for", "lets go for", "lets make it", "lets have it", "i want it", "better", "rather", "just make it", "please make it", "do it in", "take"]);
    let Some(rest) = longest_phrase(meant, MAKE_IT).and_then(|words| meant.get(words..)) else {
        return meant;
    };
    let whole = |found: Option<usize>| found == Some(rest.len()) && !rest.is_empty();
    let is_paint = whole(longest(rest, PAINTS).map(|(_, words)| words));
    let is_size = whole(longest(rest, &FACTORS).map(|(_, words)| words));
    if is_paint || is_size { rest } else { meant }
}

/// "Move the bus north, no, move it south": "it" is what was named in the order that is taken back.
fn of_what_was_named(before: &[Lexeme], meant: &[Lexeme]) -> Vec<Lexeme> {
    let mut plain = meant.to_vec();
    let is_it = |lexeme: &Lexeme| matches!(&lexeme.token, Token::Word(word) if ["it", "him", "her", "them"].contains(&word.as_str()));
    let Some((_, verb)) = longest(meant, &VERBS).filter(|(_, verb)| meant.get(*verb).is_some_and(is_it))
    else {
        return plain;
    };
    let named = (0..before.len()).rev().find_map(|at| {
        let (_, words) = longest(&before[at..], &VERBS)?;
        let from = at + words;
        let the = longest_phrase(before.get(from..)?, &["the", "that", "this", "my", "our"])?;
        let paint = longest(&before[from + the..], PAINTS).map_or(0, |(_, words)| words);
        let (_, noun) = category(before.get(from + the + paint..)?)?;
        Some(before[from..from + the + paint + noun].to_vec())
    });
    if let Some(named) = named {
        plain.splice(verb..=verb, named);
    }
    plain
}

/// How many words say once more that something is taken back, before what is meant.
fn said_again(rest: &[Lexeme]) -> Option<usize> {
    let meant = longest_phrase(rest, &["i mean", "i meant", "make that", "rather"]);
    meant.or_else(|| longest_phrase(rest, TAKEN_BACK).filter(|words| rest.get(*words).is_some_and(is_mark)))
}

/// "The black one" in the place of the white car is the black car.
fn with_its_noun(meant: &[Lexeme], instead_of: &[Lexeme]) -> Vec<Lexeme> {
    if let Some(plain) = with_its_anchor(meant, instead_of) {
        return plain;
    }
    // "A red car" is told by its noun, and not by the colour that is taken back.
    let is_noun =
        |at: &usize| category(&instead_of[*at..]).is_some() && longest(&instead_of[*at..], PAINTS).is_none();
    // "A white tent": behind its colour.
    let behind_paint = || {
        let paint = (0..instead_of.len())
            .find_map(|at| longest(&instead_of[at..], PAINTS).map(|(_, words)| at + words));
        paint.filter(|at| *at + 1 == instead_of.len())
    };
    let noun = (0..instead_of.len()).find(is_noun).or_else(behind_paint);
    match (meant, noun) {
        ([head @ .., one], Some(noun)) if one.token == Token::Word("one".to_owned()) && !head.is_empty() => {
            head.iter().chain(&instead_of[noun..]).cloned().collect()
        }
        _ => meant.to_vec(),
    }
}

/// Every word of these tables, for the spelling.
pub(super) fn words() -> impl Iterator<Item = &'static str> {
    TAKEN_BACK.iter().chain(BEHIND).flat_map(|phrase| phrase.split(' '))
}

#[cfg(test)]
mod tests {
    use super::super::super::lexer::rewritten;
    use super::put_right;

    #[test]
    fn what_is_meant_takes_the_place_of_what_is_of_its_kind() {
        for (said, meant) in [
            ("put a toolbox, sorry, a ladder, behind the bakery", "put a ladder behind the bakery"),
            ("put two, no, three benches here", "put three benches here"),
            ("put two no three benches here", "put three benches here"),
            ("paint the blue, i mean the red car green", "paint the red car green"),
            ("paint the blue, sorry, red car green", "paint the red car green"),
            ("remove the blue car, i mean the red", "remove the red car"),
            ("put a boat, no a taxi by the oak", "put a taxi by the oak"),
            ("put a bucket by the oak, no, by the lamp", "put a bucket by the lamp"),
            ("a tree north, sorry, south of the museum", "a tree south of the museum"),
            ("a tree left, no, right of the museum", "a tree right of the museum"),
            ("paint it red, or rather blue", "paint it blue"),
            ("a station, say, ten metres south of the hall", "a station ten metres south of the hall"),
            ("say, ten metres south of the hall put a bin", "ten metres south of the hall put a bin"),
            ("move the red bench, i mean, five metres south", "move the red bench five metres south"),
            ("move it ten metres north, sorry, five metres south", "move it five metres south"),
            ("move it five metres north, i mean, ten metres", "move it ten metres north"),
            ("a bin by the oak, no, ten metres south of the lamp", "a bin ten metres south of the lamp"),
            // Nothing is taken back by these.
            ("put a bench, well away from the oak", "put a bench , well away from the oak"),
            ("put two benches and three chairs here", "put two benches and three chairs here"),
            ("no clouds, please", "no clouds , please"),
            ("put it left, well, right next to the oak", "put it left , well , right next to the oak"),
            (
                "put a bin north of the oak, say, a green one",
                "put a bin north of the oak , say , a green one",
            ),
        ] {
            assert_eq!(rewritten(said, put_right), meant, "{said}");
        }
    }
}
