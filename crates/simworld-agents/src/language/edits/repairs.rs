//! Words that take back what was said just before: "paint it gold, no wait, yellow", "forty chairs, I mean twenty", "under, let
//! us say next to, the bench".
//!
//! What is put right is of the kind of what stands in its place: a number for a number, a colour for a colour, a place for a
//! place, an order for an order, a thing for a thing.

use super::super::lexer::{Lexeme, Token, is_mark};
use super::super::lexicon::{category, longest, longest_phrase};
use super::super::numbers::{self, NUMERALS};
use super::super::paint::PAINTS;
use super::super::phrases::Phrases;
use super::words::{FACTORS, SKIES, VERBS, WAYS, Way};

/// That what follows is meant, and what stood before is not.
#[rustfmt::skip]
const TAKEN_BACK: &Phrases = &Phrases::of(&["no wait", "wait no", "no no", "no sorry", "sorry no", "i mean", "i meant", "no i mean", "no i meant", "sorry i mean", "scratch that", "correction", "no make that",
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

/// Puts what was taken back right, as often as it was.
pub(super) fn put_right(lexemes: &mut Vec<Lexeme>) {
    without_dangling(lexemes);
    for _ in 0..MOST {
        let Some(right) = (1..lexemes.len()).find_map(|at| corrected(lexemes, at)) else { return };
        *lexemes = right;
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
    let mut is_sure = true;
    let (from, to, behind) = if let Some(words) = longest_phrase(rest, TAKEN_BACK) {
        is_sure = longest_phrase(rest, WEAK) != Some(words);
        // "The robot, make that one orange" speaks of another.
        let part = lexemes[..mark].iter().rposition(is_mark).map_or(0, |at| at + 1);
        if longest_phrase(rest, &["make that one", "have that one", "make this one"]).is_some()
            && longest_phrase(&lexemes[part..mark], &["the", "that", "my", "our"]).is_some()
        {
            return None;
        }
        // "No clouds" takes nothing back, and "no, clouds" does.
        if longest(rest, &WAYS).is_some() {
            return None;
        }
        let is_no = words == 1 && longest_phrase(rest, &["no"]).is_some();
        if is_no && !rest.get(1).is_some_and(is_mark) && longest(&rest[1..], &VERBS).is_none() {
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
    let meant = &of_what_was_named(before, meant)[..];
    let (start, stop) = replaced(before, meant, is_sure)?;
    let mut right = before[..start].to_vec();
    right.extend(with_its_noun(meant, &before[start..stop]));
    right.extend_from_slice(&before[stop..]);
    right.extend_from_slice(&lexemes[behind..]);
    Some(right)
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

/// Of a colour or a size what it takes the place of.
fn look_before(before: &[Lexeme], meant: &[Lexeme], clause: usize) -> Option<(usize, usize)> {
    let last = |fits: &dyn Fn(usize) -> Option<usize>| {
        (clause..before.len()).rev().find_map(|at| fits(at).map(|words| (at, at + words)))
    };
    if longest(meant, PAINTS).is_some() {
        return last(&|at| longest(&before[at..], PAINTS).map(|(_, words)| words));
    }
    let (from, to) = last(&|at| longest(&before[at..], &FACTORS).map(|(_, words)| words))?;
    Some((whole_factor(before, from), to))
}

/// Whether some words are a colour or a size, and no more.
fn is_look(meant: &[Lexeme]) -> bool {
    longest(meant, PAINTS).is_some_and(|(_, words)| words == meant.len())
        || longest(meant, &FACTORS).is_some_and(|(_, words)| words == meant.len())
}

/// How many words say once more that something is taken back, before what is meant.
fn said_again(rest: &[Lexeme]) -> Option<usize> {
    let meant = longest_phrase(rest, &["i mean", "i meant", "make that", "rather"]);
    meant.or_else(|| longest_phrase(rest, TAKEN_BACK).filter(|words| rest.get(*words).is_some_and(is_mark)))
}

/// Which of the words before are taken back by those that are meant.
fn replaced(before: &[Lexeme], meant: &[Lexeme], is_sure: bool) -> Option<(usize, usize)> {
    let clause = before.iter().rposition(|lexeme| lexeme.token == Token::Break).map_or(0, |at| at + 1);
    let all = before.len();
    let last = |fits: &dyn Fn(usize) -> Option<usize>| {
        (clause..all).rev().find_map(|at| fits(at).map(|words| (at, at + words)))
    };
    if let Some((_, words)) =
        numbers::number(meant).filter(|(_, words)| *words == meant.len() && !is_article(meant))
    {
        return last(&|at| {
            numbers::number(&before[at..]).filter(|_| is_number(&before[at])).map(|(_, words)| words)
        });
    }
    if is_look(meant) {
        return look_before(before, meant, clause);
    }
    // "A white tent, no, a red one".
    if let Some(found) = new_coloured_before(before, meant, clause) {
        return Some(found);
    }
    if longest(meant, &SKIES).is_some() {
        return last(&|at| longest(&before[at..], &SKIES).map(|(_, words)| words)).or(Some((clause, all)));
    }
    if longest(meant, &VERBS).is_some() {
        // An order is taken back as a whole.
        return last(&|at| longest(&before[at..], &VERBS).filter(|_| is_sure).map(|_| all - at));
    }
    if longest(meant, &WAYS).is_some() {
        return last(&|at| longest(&before[at..], &WAYS).map(|_| all - at))
            .map(|(from, _)| (whole_way(before, from), all));
    }
    let noun =
        (0..meant.len()).find_map(|at| category(&meant[at..]).map(|(class, words)| (class, at + words)));
    // "The white car, I mean the black one": the colour is taken back.
    if let [the, paint @ .., one] = meant
        && the.token == Token::Word("the".to_owned())
        && one.token == Token::Word("one".to_owned())
        && longest(paint, PAINTS).is_some_and(|(_, words)| words == paint.len())
    {
        return coloured_before(before, clause);
    }
    if is_article(meant) || meant.first().is_some_and(is_number) {
        // "A seat in front of the clinic, no, two seats".
        if let Some((class, words)) = noun
            && words == meant.len()
            && let Some((from, to)) =
                last(&|at| category(&before[at..]).filter(|(own, _)| *own == class).map(|(_, words)| words))
        {
            let start = (clause..from).rev().take(4).find(|at| is_number(&before[*at]));
            return Some((start.unwrap_or(from), to));
        }
        let begins = |at: usize| {
            is_number(&before[at])
                || is_article(&before[at..])
                || longest_phrase(&before[at..], &["another"]).is_some()
        };
        return last(&|at| (is_sure && begins(at)).then_some(all - at));
    }
    let is_noun = is_sure && meant.len() <= LONGEST && noun.is_none_or(|(_, words)| words == meant.len());
    let is_word = matches!(before.last()?.token, Token::Word(_));
    (is_noun && is_word && all > clause).then_some((all - 1, all))
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

/// The last thing before that is told by its colour: "the white car".
fn coloured_before(before: &[Lexeme], clause: usize) -> Option<(usize, usize)> {
    (clause..before.len()).rev().find_map(|at| {
        if before[at].token != Token::Word("the".to_owned()) {
            return None;
        }
        let (_, paint) = longest(&before[at + 1..], PAINTS)?;
        let (_, noun) = category(&before[at + 1 + paint..])?;
        Some((at, at + 1 + paint + noun))
    })
}

/// Behind "a red one" the last new thing before that is told by its colour, up to one word behind it: "a white tent".
fn new_coloured_before(before: &[Lexeme], meant: &[Lexeme], clause: usize) -> Option<(usize, usize)> {
    let [a, paint @ .., one] = meant else { return None };
    let is_coloured = matches!(&a.token, Token::Word(word) if word == "a" || word == "an")
        && one.token == Token::Word("one".to_owned())
        && longest(paint, PAINTS).is_some_and(|(_, words)| words == paint.len());
    (clause..before.len()).rev().filter(|_| is_coloured).find_map(|at| {
        longest_phrase(&before[at..], &["a", "an"])?;
        let (_, paint) = longest(&before[at + 1..], PAINTS)?;
        let end = at + 1 + paint + 1;
        matches!(before.get(end - 1)?.token, Token::Word(_)).then_some((at, end))
    })
}

/// The first word of a size of several words that ends in a shorter one: "three times as big".
fn whole_factor(before: &[Lexeme], from: usize) -> usize {
    (from.saturating_sub(4)..from)
        .find(|at| longest(&before[*at..], &FACTORS).is_some_and(|(_, words)| at + words > from))
        .unwrap_or(from)
}

/// A noun without an article has no more words than that.
const LONGEST: usize = 3;

/// The first word of a relation of several words that ends in a shorter one: "on top of".
fn whole_way(before: &[Lexeme], from: usize) -> usize {
    (from.saturating_sub(3)..from)
        .find(|at| longest(&before[*at..], &WAYS).is_some_and(|(_, words)| at + words > from))
        .unwrap_or(from)
}

/// Whether an article stands first.
fn is_article(lexemes: &[Lexeme]) -> bool {
    longest_phrase(lexemes, &["a", "an", "the", "some"]).is_some()
}

/// Whether a word is a number, an article among them.
fn is_number(lexeme: &Lexeme) -> bool {
    match &lexeme.token {
        Token::Number(_) => true,
        Token::Word(word) => NUMERALS.iter().any(|(numeral, _)| numeral == word),
        _ => false,
    }
}

/// Every word of these tables, for the spelling.
pub(super) fn words() -> impl Iterator<Item = &'static str> {
    TAKEN_BACK.iter().chain(BEHIND).flat_map(|phrase| phrase.split(' '))
}
