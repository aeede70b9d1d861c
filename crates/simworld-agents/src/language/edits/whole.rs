//! What is said of the whole scene and of places in figures, put as it is read: "if there is a hydrant anywhere on campus" is "if there is a
//! hydrant", "how many cars does the old town have" is "how many cars are there", and "at x = -5, y = 3" is "at (-5, 3)".

use super::super::lexer::{Lexeme, Token, is_mark};
use super::super::lexicon::{longest, longest_phrase};
use super::super::phrases::Phrases;
use super::forms::{word_at, words_at};

/// What begins a question or a condition on what there is.
#[rustfmt::skip]
const IS_THERE: &Phrases = &Phrases::of(&["if there is", "if there are", "if theres", "if there isnt", "if there arent", "unless there is", "unless there are", "unless theres", "if we have", "unless we have", "is there", "are there",
    "how many", "if you find", "if you see", "if there happens to be", "in case there is"]);
/// All of the scene.
#[rustfmt::skip]
const WHOLE: &[&str] = &["campus", "quarter", "harbour", "harbor", "town", "city", "scene", "map", "simulation", "world", "neighbourhood", "neighborhood", "district", "village", "environment", "quay", "quayside", "waterfront", "dockside", "docks", "premises"];
/// Before it.
#[rustfmt::skip]
const BEFORE_WHOLE: &Phrases = &Phrases::of(&["in", "on", "around", "across", "within", "throughout", "about", "all over", "anywhere in", "anywhere on", "anywhere around", "somewhere in", "somewhere on", "anywhere across", "left in", "left on", "already in",
    "already on", "to be found in", "to be found on"]);
/// Between those and it.
#[rustfmt::skip]
const ARTICLE: &Phrases = &Phrases::of(&["the", "this", "our", "the whole", "the entire", "this whole", "all of the", "the old", "this old", "my", "the current", "our little"]);
/// When it is asked, which is always now.
#[rustfmt::skip]
const NOW: &Phrases = &Phrases::of(&["at the moment", "right now", "currently", "at present", "as of now", "just now", "in total", "altogether", "all in all", "all together", "so far", "overall"]);
/// Asks what is known of a thing.
#[rustfmt::skip]
const KNOWN_OF: &Phrases = &Phrases::of(&["what do we know about", "what do you know about", "what is known about", "whats known about", "what can you tell me about", "what can you say about", "what can you tell us about", "what information is there on", "what information do we have on",
    "what do you have on", "what do we have on", "do you know anything about", "give me the details of", "give me details of", "give me details about", "give me some information on", "give me some information about", "give me information about",
    "show me the details of", "show me details of", "i would like to know more about", "id like to know more about", "i want to know more about", "tell me more about"]);
/// Behind that.
#[rustfmt::skip]
const TELL_ME: &Phrases = &Phrases::of(&["tell me", "please tell me", "tell us", "do tell", "to me", "for me", "to us"]);

/// Speaks of a sky as if it were so.
#[rustfmt::skip]
const PRETEND: &Phrases = &Phrases::of(&["lets pretend it is", "lets pretend its", "pretend it is", "pretend its", "imagine it is", "imagine its", "lets say it is", "lets say its", "lets imagine it is", "lets assume it is", "assume it is", "act as if it is", "we simulate", "simulate", "lets simulate",
    "we want to simulate", "i want to simulate", "pretend that it is", "suppose it is"]);
/// Says behind a thing that is to be moved, or copied, where it is to be.
#[rustfmt::skip]
const IT_SHOULD_BE: &Phrases = &Phrases::of(&["it should be", "it should go", "it should stand", "it belongs", "it goes", "it has to be", "it has to go", "it must be", "it must go", "it is to be", "it is to go", "it needs to be", "it needs to go", "the copy goes", "the copy should go", "the copy should be",
    "the copy belongs", "the copy is to go", "the copy has to go", "the copy stands", "the new one goes", "the new one should go", "the new one should be", "they should be", "they should go", "they belong", "they go", "he should be", "he should stand", "she should be", "she should stand"]);
/// Begins such an order.
#[rustfmt::skip]
const MOVES: &Phrases = &Phrases::of(&["move", "shift", "relocate", "please move", "please shift", "copy", "duplicate", "clone", "please copy", "please duplicate", "bring", "push"]);

/// Puts the words of a sentence so.
pub(super) fn in_plain_words(lexemes: &mut Vec<Lexeme>) {
    pretended(lexemes);
    put_by_hand(lexemes);
    sides_behind(lexemes);
    told_behind(lexemes);
    nearby(lexemes);
    coordinates(lexemes);
    asked_of_topic(lexemes);
    how_many_has(lexemes);
    everywhere(lexemes);
    known_of(lexemes);
}

fn is_word(lexemes: &[Lexeme], at: usize, word: &str) -> bool {
    matches!(lexemes.get(at).map(|lexeme| &lexeme.token), Some(Token::Word(own)) if own == word)
}

/// "Let's pretend it is nine in the evening" makes it nine.
fn pretended(lexemes: &mut Vec<Lexeme>) {
    let Some(words) = longest_phrase(lexemes, PRETEND).filter(|words| *words < lexemes.len()) else { return };
    let place = lexemes[0].clone();
    lexemes.splice(..words, words_at(&place, "make it"));
}

/// "Shove a bin behind the hall" puts a new one there, and "I'm after a bin" wants one.
fn put_by_hand(lexemes: &mut Vec<Lexeme>) {
    const NEW: &[&str] = &["a", "an", "another", "some", "two", "three", "four", "five"];
    let is_new = |lexemes: &[Lexeme], at: usize| NEW.iter().any(|word| is_word(lexemes, at, word));
    if ["shove", "bung", "slap", "whack", "plonk"].iter().any(|verb| is_word(lexemes, 0, verb))
        && is_new(lexemes, 1)
    {
        lexemes[0] = word_at(&lexemes[0].clone(), "put");
    }
    let after = (0..lexemes.len()).find_map(|at| {
        let words =
            longest_phrase(&lexemes[at..], &["im after", "i am after", "we are after", "were after"])?;
        is_new(lexemes, at + words).then_some((at, words))
    });
    if let Some((at, words)) = after {
        let place = lexemes[at].clone();
        lexemes.splice(at..at + words, words_at(&place, "i want"));
    }
}

/// "..., on both sides" belongs to the row before it, and "on one side only" is what a row does anyway.
fn sides_behind(lexemes: &mut Vec<Lexeme>) {
    const BOTH: &Phrases = &Phrases::of(&["on both sides", "both sides", "on either side", "on each side"]);
    const ONE: &Phrases = &Phrases::of(&[
        "on one side only",
        "one side only",
        "on one side",
        "only on one side",
        "just on one side",
        "just one side",
    ]);
    let Some(mark) = (1..lexemes.len()).find(|at| {
        let behind = &lexemes[at + 1..];
        let ends = |words: usize| behind.get(words).is_none_or(is_mark);
        is_mark(&lexemes[*at])
            && (longest_phrase(behind, BOTH).is_some_and(ends)
                || longest_phrase(behind, ONE).is_some_and(ends))
    }) else {
        return;
    };
    match longest_phrase(&lexemes[mark + 1..], ONE) {
        Some(words) => drop(lexemes.drain(mark..=mark + words)),
        None => drop(lexemes.remove(mark)),
    }
}

/// "Move the bench, it should be beside the hall" moves it there.
fn told_behind(lexemes: &mut Vec<Lexeme>) {
    if longest_phrase(lexemes, MOVES).is_none() {
        return;
    }
    let Some(mark) = lexemes.iter().position(is_mark) else { return };
    let moved = longest_phrase(&lexemes[mark + 1..], IT_SHOULD_BE).filter(|words| {
        longest(lexemes.get(mark + 1 + words..).unwrap_or_default(), &super::words::WAYS).is_some()
    });
    let placed = lexemes[..mark]
        .iter()
        .enumerate()
        .any(|(at, _)| at > 1 && longest(&lexemes[at..mark], &super::words::WAYS).is_some());
    if let Some(words) = moved.filter(|_| !placed) {
        lexemes.drain(mark..=mark + words);
    }
}

/// "To a point five metres west of the mailbox" is five metres west of it, and "to within two metres" within them.
fn nearby(lexemes: &mut Vec<Lexeme>) {
    const POINT: &Phrases = &Phrases::of(&[
        "to a point",
        "to a spot",
        "to a place",
        "at a point",
        "at a spot",
        "to a position",
        "at a position",
        "to the point",
        "to the spot",
    ]);
    let found = (1..lexemes.len()).find_map(|at| {
        if is_word(lexemes, at, "to") && is_word(lexemes, at + 1, "within") {
            return Some((at, 1));
        }
        let words = longest_phrase(&lexemes[at..], POINT)?;
        let rest = lexemes.get(at + words..)?;
        (super::super::numbers::number(rest).is_some() || matches!(rest.first()?.token, Token::Number(_)))
            .then_some((at, words))
    });
    if let Some((at, words)) = found {
        lexemes.drain(at..at + words);
    }
}

/// Behind "the old town" and the like, if that is what begins there.
pub(super) fn whole_at(lexemes: &[Lexeme], from: usize) -> Option<usize> {
    let whole = from + longest_phrase(lexemes.get(from..)?, ARTICLE).unwrap_or(0);
    WHOLE.iter().any(|word| is_word(lexemes, whole, word)).then_some(whole + 1)
}

/// "X = -5, y = 3" is (-5, 3).
fn coordinates(lexemes: &mut Vec<Lexeme>) {
    let figure = |from: usize, axis: &str| {
        if !is_word(lexemes, from, axis) {
            return None;
        }
        let by = 1 + usize::from(is_word(lexemes, from + 1, "=") || is_word(lexemes, from + 1, "is"));
        let by =
            by + usize::from(matches!(lexemes.get(from + by).map(|next| &next.token), Some(Token::Break)));
        match lexemes.get(from + by)?.token {
            Token::Number(_) => Some(from + by),
            _ => None,
        }
    };
    let found = (0..lexemes.len()).find_map(|at| {
        let x = figure(at, "x")?;
        let joint = lexemes[x + 1..].iter().take_while(|lexeme| is_mark(lexeme)).count();
        let joint = x + 1 + joint;
        let y = figure(joint + usize::from(is_word(lexemes, joint, "and")), "y")?;
        Some((at, x, y))
    });
    let Some((at, x, y)) = found else { return };
    let mark = |token: Token| Lexeme { token, ..lexemes[at].clone() };
    let point =
        [mark(Token::Open), lexemes[x].clone(), mark(Token::Comma), lexemes[y].clone(), mark(Token::Close)];
    lexemes.splice(at..=y, point);
}

/// "Dogs, how many of them do we have?" is "how many dogs are there", and so is "chairs and tables together, how many is that?" of both.
fn asked_of_topic(lexemes: &mut Vec<Lexeme>) {
    const OF_THEM: &Phrases =
        &Phrases::of(&["how many of them", "how many of those", "how many of these", "how many"]);
    #[rustfmt::skip]
    const HAVE: &Phrases = &Phrases::of(&["we have", "do we have", "are there", "there are", "have we", "have we got", "are here", "you have", "do you see", "do you count", "exist",
        "is that", "is that in total", "is that altogether", "is that in all", "is that together", "is that all in all", "is it", "is it in total", "is it altogether", "does that make", "does that make in total", "does that make altogether", "does that make together",
        "would that be", "would that make", "do they make", "are they", "are they together", "are they in total", "are there together", "are there in total", "are there altogether", "are there in all", "do we have together", "do we have in total", "do we have altogether"]);
    /// Behind several that are counted as one.
    #[rustfmt::skip]
    const TOGETHER: &Phrases = &Phrases::of(&["together", "all together", "altogether", "combined", "in total", "in all", "all told", "taken together", "put together", "added together", "added up", "counted together"]);
    /// "The red cars, how many are there?"
    const LONGEST_TOPIC: usize = 5;
    let Some(mark) = lexemes.iter().position(is_mark) else { return };
    let topic =
        (0..mark).find(|at| longest_phrase(&lexemes[*at..mark], TOGETHER) == Some(mark - at)).unwrap_or(mark);
    if !(1..=LONGEST_TOPIC).contains(&topic) {
        return;
    }
    let Some(asks) = longest_phrase(&lexemes[mark + 1..], OF_THEM) else { return };
    let tail = mark + 1 + asks;
    let end = lexemes.iter().rposition(|lexeme| !is_mark(lexeme)).map_or(0, |last| last + 1);
    if tail >= end || longest_phrase(&lexemes[tail..end], HAVE) != Some(end - tail) {
        return;
    }
    let place = lexemes[mark].clone();
    let topic: Vec<Lexeme> = lexemes[..topic]
        .iter()
        .filter(|lexeme| !matches!(&lexeme.token, Token::Word(word) if word == "the"))
        .cloned()
        .collect();
    let plain: Vec<Lexeme> =
        words_at(&place, "how many").chain(topic).chain(words_at(&place, "are there")).collect();
    lexemes.splice(..end, plain);
}

/// "How many lamps does the scene have" asks how many there are.
fn how_many_has(lexemes: &mut Vec<Lexeme>) {
    let Some(asks) = (0..lexemes.len()).find(|at| longest_phrase(&lexemes[*at..], &["how many"]).is_some())
    else {
        return;
    };
    let found = (asks + 3..lexemes.len()).find_map(|at| {
        if is_word(lexemes, at, "does") {
            let has = whole_at(lexemes, at + 1)?;
            let words =
                longest_phrase(lexemes.get(has..)?, &["have", "contain", "hold", "include", "have got"])?;
            return Some((at, has + words));
        }
        let are = longest_phrase(&lexemes[at..], &["are", "is", "stand", "exist", "can be found"])?;
        let before = longest_phrase(lexemes.get(at + are..)?, BEFORE_WHOLE)?;
        Some((at, whole_at(lexemes, at + are + before)?))
    });
    if let Some((at, after)) = found {
        let place = lexemes[at].clone();
        lexemes.splice(at..after, words_at(&place, "are there"));
    }
}

/// "If there is a hydrant anywhere on campus": where else.
fn everywhere(lexemes: &mut Vec<Lexeme>) {
    let mut asked = false;
    let mut at = 0;
    while at < lexemes.len() {
        if let Some(words) = longest_phrase(&lexemes[at..], IS_THERE) {
            asked = true;
            if is_word(lexemes, at + words, "already") {
                lexemes.remove(at + words);
            }
        } else if is_mark(&lexemes[at]) {
            asked = false;
        }
        let before = longest_phrase(&lexemes[at..], BEFORE_WHOLE).filter(|_| asked);
        let whole = before.and_then(|before| whole_at(lexemes, at + before)).filter(|after| {
            let rest = &lexemes[*after..];
            rest.first().is_none_or(is_mark)
                || longest_phrase(rest, NOW).is_some()
                || is_word(rest, 0, "then")
        });
        let now = longest_phrase(&lexemes[at..], NOW).filter(|_| asked).map(|words| at + words);
        match whole.or(now) {
            Some(after) => drop(lexemes.drain(at..after)),
            None => at += 1,
        }
    }
}

/// "What do we know about the diner? Tell me" is "describe the diner".
fn known_of(lexemes: &mut Vec<Lexeme>) {
    let Some(words) = longest_phrase(lexemes, KNOWN_OF) else { return };
    lexemes.splice(..words, [word_at(&lexemes[0].clone(), "describe")]);
    let end =
        |lexemes: &[Lexeme]| lexemes.iter().rposition(|lexeme| !is_mark(lexeme)).map_or(0, |last| last + 1);
    let stop = end(lexemes);
    if let Some(tell) = (2..stop).find(|at| longest_phrase(&lexemes[*at..stop], TELL_ME) == Some(stop - at)) {
        lexemes.truncate(tell);
        lexemes.truncate(end(lexemes));
    }
}

/// Every word of these tables, for the spelling.
pub(super) fn words() -> impl Iterator<Item = &'static str> {
    [IS_THERE, BEFORE_WHOLE, ARTICLE, NOW, KNOWN_OF, TELL_ME, PRETEND, IT_SHOULD_BE, MOVES]
        .into_iter()
        .flatten()
        .flat_map(|phrase| phrase.split(' '))
        .chain(WHOLE.iter().copied())
}
