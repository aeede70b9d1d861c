//! What is spoken of first and pointed at then: "you know the tallest lime? put a bench next to it", "there's a car between the two, put a cone
//! next to that one"; and who goes where without an order: "Bruno over next to Carol", "Hana moves next to the statue".

use super::super::lexer::{Lexeme, Token, is_mark};
use super::super::lexicon::{category, longest, longest_phrase};
use super::super::names::Names;
use super::super::paint::PAINTS;
use super::super::phrases::Phrases;
use super::forms::{word, word_at, words_at};
use super::words::{VERBS, Verb, WAYS};

/// Puts it plainly.
pub(super) fn in_plain_words(words: &str, lexemes: &mut Vec<Lexeme>, names: &Names<'_>) {
    without_you_know(lexemes);
    that_one(lexemes);
    goes_over(words, lexemes, names);
    nearer_of(lexemes);
}

/// "You know the tallest lime? ..." speaks of the lime.
fn without_you_know(lexemes: &mut Vec<Lexeme>) {
    #[rustfmt::skip]
    const KNOW: &Phrases = &Phrases::of(&["you know", "do you know", "you see", "do you see", "can you see", "you remember", "do you remember", "remember", "see", "you recall", "you know how", "know", "you noticed", "have you seen", "have you noticed", "did you see", "did you notice", "ever noticed", "you know about", "so you know", "so you see", "now you see", "look at", "take a look at", "just look at"]);
    const CERTAIN: &Phrases = &Phrases::of(&["the", "that", "those", "our", "my", "these", "this"]);
    const OPEN: &[&str] = &["it", "there", "him", "her", "them", "one", "both", "its"];
    let Some(know) = longest_phrase(lexemes, KNOW) else { return };
    let Some(end) = lexemes.iter().position(is_mark) else { return };
    let is_named = know < end && longest_phrase(&lexemes[know..end], CERTAIN).is_some();
    let is_pointed_at = lexemes[end..]
        .iter()
        .any(|lexeme| matches!(&lexeme.token, Token::Word(word) if OPEN.contains(&word.as_str())));
    if is_named && is_pointed_at {
        lexemes.drain(..know);
    }
}

/// "There's a car between the white one and the green one. Put a cone next to that one": next to the car between the two.
fn that_one(lexemes: &mut Vec<Lexeme>) {
    const THERE: &Phrases = &Phrases::of(&[
        "theres a",
        "theres an",
        "theres one",
        "there is a",
        "there is an",
        "there is one",
        "you see a",
        "i see a",
        "we have a",
        "there stands a",
        "we have got a",
        "weve got a",
        "theres this",
        "theres that",
    ]);
    const THAT: &Phrases = &Phrases::of(&["that one", "this one", "that very one", "exactly that one"]);
    let Some(there) = longest_phrase(lexemes, THERE) else { return };
    let Some(end) = lexemes.iter().position(is_mark) else { return };
    // "A fallen log next to it": it is what was told of in its place.
    let is_it = |at: usize| {
        let way =
            |from: usize| longest(&lexemes[from..at], &WAYS).is_some_and(|(_, words)| from + words == at);
        word(lexemes, at) == "it" && (at.saturating_sub(4)..at).any(way)
    };
    let points = |at: &usize| longest_phrase(&lexemes[*at..], THAT).is_some() || is_it(*at);
    let Some(that) = (end..lexemes.len()).find(points) else { return };
    let what = &lexemes[there.min(end)..end];
    let Some((_, noun)) = category(what) else { return };
    // "The white one" among cars is the white car.
    let mut told = vec![word_at(&lexemes[0], "the")];
    for (at, lexeme) in what.iter().enumerate() {
        let is_coloured = at > 0
            && matches!(word(what, at), "one")
            && (0..at)
                .any(|from| longest(&what[from..at], PAINTS).is_some_and(|(_, words)| from + words == at));
        if is_coloured {
            told.extend(what[..noun].iter().cloned());
        } else {
            told.push(lexeme.clone());
        }
    }
    let is_placed = longest(&what[noun..], &WAYS).is_some();
    if is_placed {
        let words = longest_phrase(&lexemes[that..], THAT).unwrap_or(1);
        lexemes.splice(that..that + words, told);
        lexemes.drain(..=end);
    }
}

/// "Bruno over next to Carol", "Hana moves next to the statue": somebody by name, or a certain thing, is moved.
fn goes_over(words: &str, lexemes: &mut Vec<Lexeme>, names: &Names<'_>) {
    const MOVES: &Phrases = &Phrases::of(&[
        "moves",
        "moves over",
        "moves up",
        "moves back",
        "moves across",
        "moves to",
        "relocates",
        "goes over",
        "steps over",
        "walks over",
        "over",
        "moves down",
    ]);
    let (mut at, mut moved) = (0, false);
    while at < lexemes.len() {
        let begins = at == 0
            || is_mark(&lexemes[at - 1])
            || matches!(word(lexemes, at - 1), "and" | "then" | "while")
                && (moved || at < 2 || is_mark(&lexemes[at - 2]));
        let is_capital =
            words.get(lexemes[at].start..).is_some_and(|rest| rest.starts_with(char::is_uppercase));
        let named = names.exact(&lexemes[at..]).map(|(_, count)| count).filter(|_| begins && is_capital);
        let called = || {
            let the = longest_phrase(&lexemes[at..], &["the"]).filter(|_| begins)?;
            let (paint, from) = longest(&lexemes[at + the..], PAINTS)
                .map_or((0, at + the), |(_, words)| (words, at + the + words));
            category(lexemes.get(from..)?).map(|(_, noun)| the + paint + noun)
        };
        if let Some(who) = named.or_else(called)
            && let Some(moves) = longest_phrase(lexemes.get(at + who..).unwrap_or_default(), MOVES)
            && longest(lexemes.get(at + who + moves..).unwrap_or_default(), &WAYS).is_some()
            && !(word(lexemes, at + who) == "over" && (named.is_none() || tells(lexemes, at + who)))
        {
            let behind = at + who;
            let keeps_to = word(lexemes, behind + moves - 1) == "to";
            lexemes.drain(behind..behind + moves - usize::from(keeps_to));
            let place = lexemes[at].clone();
            lexemes.insert(at, word_at(&place, "move"));
            moved = true;
        }
        at += 1;
    }
}

/// "Ben over by the kiosk looks lonely" tells something of him.
fn tells(lexemes: &[Lexeme], at: usize) -> bool {
    #[rustfmt::skip]
    const TELLS: &[&str] = &["is", "are", "was", "looks", "seems", "needs", "wants", "has", "gets", "should", "could", "would", "must", "feels", "keeps", "who", "that", "can", "will", "likes", "loves", "says", "there"];
    let end = (at..lexemes.len())
        .find(|at| is_mark(&lexemes[*at]) || word(lexemes, *at) == "and")
        .unwrap_or(lexemes.len());
    (at..end).any(|at| TELLS.contains(&word(lexemes, at)))
}

/// "Next to the bin nearer to the bus stop": of the bins the nearest.
fn nearer_of(lexemes: &mut Vec<Lexeme>) {
    let found = (2..lexemes.len().saturating_sub(2)).find(|at| {
        let is_nearer = matches!(word(lexemes, *at), "nearer" | "closer") && word(lexemes, at + 1) == "to";
        let noun = (at.saturating_sub(3)..*at)
            .find(|from| category(&lexemes[*from..*at]).is_some_and(|(_, words)| from + words == *at));
        let Some(the) = noun.and_then(|noun| noun.checked_sub(1)).filter(|_| is_nearer) else { return false };
        let ends_way =
            |from: usize| longest(&lexemes[from..], &WAYS).is_some_and(|(_, words)| from + words == the);
        let is_place = (the.saturating_sub(4)..the).any(ends_way);
        let is_changed = the > 0
            && longest(&lexemes[the - 1..], &VERBS).is_some_and(|(verb, _)| {
                matches!(verb, Verb::Remove | Verb::Paint | Verb::Copy | Verb::Name | Verb::Describe)
            });
        matches!(word(lexemes, the), "the" | "that") && (is_place || is_changed)
    });
    if let Some(at) = found {
        let place = lexemes[at].clone();
        let nearest: Vec<Lexeme> = words_at(&place, "nearest").collect();
        lexemes.splice(at..=at, nearest);
    }
}
