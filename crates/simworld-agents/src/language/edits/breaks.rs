//! Where somebody breaks off or goes on with a dash: "a well... a bird bath", "all around the gallery - it's looking dull"; and what
//! is said once more with a better word: "a sign by the kiosk, a direction sign".
//!
//! A dash between blanks is a comma. New things that stand just before dots are taken back by those just behind them. What is named
//! again behind a comma, by a longer name that ends like the first, takes its place.

use super::super::lexer::{Lexeme, Token, is_mark};
use super::super::lexicon::{longest, longest_phrase};
use super::super::numbers;
use super::super::phrases::Phrases;
use super::polite::CODA;
use super::words::WAYS;

/// Sounds and words behind dots, before what is meant.
#[rustfmt::skip]
const SOUNDS: &Phrases = &Phrases::of(&["er", "erm", "um", "uh", "hmm", "hm", "err", "no", "no wait", "wait", "wait no", "i mean", "i meant", "make it", "make that", "no make it", "no make that", "well", "or rather", "or", "rather", "sorry", "no sorry", "actually", "no actually", "oh", "oh no", "no no", "ah", "just", "ok just", "let me think", "let me see", "lets say", "at least", "thats", "hang on", "hold on", "whats the word", "what is the word", "what was the word", "what was it", "what is it", "whats it called", "what are they called", "what do you call it", "what do you call them", "what do they call it", "how do you say", "whats the name", "what was it called", "you know", "you know the thing", "let me see now", "oh what was it", "now what was it", "one of those", "thingy", "whatsit", "just kidding", "only kidding", "just joking", "only joking", "kidding"]);
/// Before a noun, and no part of its name.
const DETERMINERS: &Phrases = &Phrases::of(&[
    "a",
    "an",
    "some",
    "another",
    "a new",
    "a second",
    "one more",
    "another pair of",
    "a pair of",
    "a couple of",
]);

/// Puts commas for dashes, and takes out what was broken off or named again.
pub(super) fn in_plain_words(words: &str, lexemes: &mut Vec<Lexeme>) {
    super::passing::leave_out_similes(words, lexemes);
    commas_for_dashes(words, lexemes);
    for _ in 0..2 {
        broken_off(lexemes);
    }
    no_parking(lexemes);
    something(lexemes);
    named_again(lexemes);
}

fn commas_for_dashes(words: &str, lexemes: &mut Vec<Lexeme>) {
    let mut at = 1;
    while at < lexemes.len() {
        let between = words.get(lexemes[at - 1].end..lexemes[at].start).unwrap_or_default();
        let is_dash =
            between.contains('—') || [" - ", " – ", " -- "].iter().any(|dash| between.contains(dash));
        // "The van, hmm, paint the van green" goes on.
        let is_no_order = longest(&lexemes[at..], &super::words::VERBS).is_none();
        if (is_dash || hides_sound(between) && is_no_order)
            && !is_mark(&lexemes[at - 1])
            && !is_mark(&lexemes[at])
        {
            let mark = Lexeme { token: Token::Comma, lemma: None, ..lexemes[at - 1].clone() };
            lexemes.insert(at, mark);
            at += 1;
        }
        at += 1;
    }
}

/// Whether a comma was left out together with a sound: "blue, hmm, no", "cake, oh that would be sweet".
pub(super) fn hides_sound(between: &str) -> bool {
    const HEARD: &[&str] = &["hmm", "hm", "oh", "um", "uh", "er", "erm", "ah", "eh", "umm", "hmmm"];
    let mut heard = between.split(|letter: char| !letter.is_alphabetic());
    between.contains(',') && heard.any(|word| HEARD.contains(&word.to_lowercase().as_str()))
}

/// Where the dots end that begin here.
fn dots(lexemes: &[Lexeme], at: usize) -> Option<usize> {
    let is_word = |lexeme: &Lexeme| lexeme.token == Token::Word("…".to_owned());
    let breaks = lexemes[at..].iter().take_while(|lexeme| lexeme.token == Token::Break).count();
    if is_word(lexemes.get(at)?) {
        return Some(at + 1);
    }
    (breaks > 1).then_some(at + breaks)
}

/// "A well... a bird bath" is a bird bath; what else stands before dots ends there.
fn broken_off(lexemes: &mut Vec<Lexeme>) {
    let found = (1..lexemes.len()).find_map(|at| dots(lexemes, at).map(|end| (at, end)));
    let Some((mark, end)) = found else { return };
    let mut meant = end;
    loop {
        let rest = &lexemes[meant.min(lexemes.len())..];
        let sound = longest_phrase(rest, SOUNDS).or(rest.first().is_some_and(is_mark).then_some(1));
        let Some(words) = sound else { break };
        meant += words;
    }
    let from = new_before(lexemes, mark).or_else(|| article_before(lexemes, mark));
    if let Some(from) = from
        && let Some(end) = forgotten(lexemes, meant)
    {
        forget(lexemes, from, end);
        return;
    }
    let counted = |at: usize| longest_phrase(&lexemes[at..], DETERMINERS).or(number(&lexemes[at..]));
    match from {
        // "A well... a bird bath", "half a dozen lobster... wooden barrels".
        Some(from) if meant < lexemes.len() => {
            let number = counted(from).unwrap_or(1).min(mark - from);
            let is_plain = !is_mark(&lexemes[meant])
                && longest(&lexemes[meant..], &WAYS).is_none()
                && longest(&lexemes[meant..], &super::words::VERBS).is_none();
            let is_small = longest_phrase(
                &lexemes[meant..],
                &["the", "and", "it", "so", "because", "i", "we", "they", "this", "that", "please", "but"],
            )
            .is_some();
            if counted(meant).is_some() {
                lexemes.drain(from..meant);
            } else if is_plain && !is_small {
                lexemes.drain(from + number..meant);
            } else {
                one_mark(lexemes, mark, end);
            }
        }
        _ => one_mark(lexemes, mark, end),
    }
}

/// "A gas... no, forget the gas, a barbecue": where that ends which takes back what was broken off.
fn forgotten(lexemes: &[Lexeme], at: usize) -> Option<usize> {
    const FORGETS: &[&str] = &["forget", "skip", "scratch", "never mind", "not", "no need for", "leave out"];
    let from = at + longest_phrase(lexemes.get(at..)?, FORGETS)?;
    let what = from + longest_phrase(&lexemes[from..], &["the", "that", "this", "a", "an", "about the"])?;
    let end = (what..lexemes.len()).find(|at| is_mark(&lexemes[*at])).unwrap_or(lexemes.len());
    ((1..=3).contains(&(end - what))).then_some(end)
}

/// Takes out what was broken off and the words that take it back; what is meant instead takes its place.
fn forget(lexemes: &mut Vec<Lexeme>, from: usize, end: usize) {
    let is_and = |at: usize| matches!(&lexemes[at].token, Token::Word(word) if word == "and");
    let meant = end + lexemes[end..].iter().take_while(|lexeme| is_mark(lexeme)).count();
    let is_new =
        longest_phrase(&lexemes[meant..], DETERMINERS).is_some() || number(&lexemes[meant..]).is_some();
    if is_new {
        lexemes.drain(from..meant);
        return;
    }
    let mut start = from;
    while start > 0 && (is_and(start - 1) || is_mark(&lexemes[start - 1])) {
        start -= 1;
    }
    // With nothing before it there is nothing else that is asked for.
    if start > 0 {
        lexemes.drain(start..end);
    }
}

/// "What about a...": the article at which somebody breaks off.
fn article_before(lexemes: &[Lexeme], mark: usize) -> Option<usize> {
    let from = mark.checked_sub(1)?;
    longest_phrase(&lexemes[from..mark], &["a", "an", "some", "another"]).map(|_| from)
}

/// One mark for the dots.
fn one_mark(lexemes: &mut Vec<Lexeme>, mark: usize, end: usize) {
    lexemes[mark].token = Token::Break;
    lexemes.drain(mark + 1..end);
}

fn number(lexemes: &[Lexeme]) -> Option<usize> {
    numbers::count(lexemes).map(|(_, words)| words)
}

/// Where new things begin that end at a mark: "a ping pong", "half a dozen lobster".
pub(super) fn new_before(lexemes: &[Lexeme], mark: usize) -> Option<usize> {
    const LONGEST: usize = 5;
    (mark.saturating_sub(LONGEST)..mark).find(|from| {
        let words = longest_phrase(&lexemes[*from..mark], DETERMINERS).or(number(&lexemes[*from..mark]));
        words.is_some_and(|words| {
            let noun = &lexemes[from + words..mark];
            !noun.is_empty()
                && noun.len() <= 3
                && noun.iter().all(|word| matches!(word.token, Token::Word(_)))
                && !(0..noun.len()).any(|at| {
                    longest(&noun[at..], &WAYS).is_some()
                        || longest_phrase(&noun[at..], &["and", "or", "the", "is", "are", "of", "to"])
                            .is_some()
                })
        })
    })
}

/// "A sign by the kiosk, a direction sign": the second name for the first.
fn named_again(lexemes: &mut Vec<Lexeme>) {
    let found =
        (2..lexemes.len()).filter(|at| is_mark(&lexemes[*at])).find_map(|mark| again_at(lexemes, mark));
    let Some((noun, count, name, from, to)) = found else { return };
    lexemes.drain(from..to);
    lexemes.splice(noun..noun + count, name);
}

/// "A no parking sign" denies nothing: its name is as clear without "no".
fn no_parking(lexemes: &mut Vec<Lexeme>) {
    let found = (1..lexemes.len()).find(|at| {
        longest_phrase(&lexemes[*at..], &["no parking sign", "no parking signs"]).is_some()
            && (longest_phrase(&lexemes[at - 1..], DETERMINERS).is_some()
                || number(&lexemes[at - 1..*at]).is_some())
    });
    if let Some(at) = found {
        lexemes.remove(at);
    }
}

/// "Something to sit on, a stool, next to Anna": the stool.
fn something(lexemes: &mut Vec<Lexeme>) {
    let found = (1..lexemes.len()).filter(|at| is_mark(&lexemes[*at])).find_map(|mark| {
        let from = (mark.saturating_sub(5)..mark).find(|at| {
            longest_phrase(&lexemes[*at..], &["something", "anything"]).is_some()
                && !(*at..mark)
                    .any(|at| longest(&lexemes[at..mark], &WAYS).is_some_and(|(_, words)| words > 1))
        })?;
        longest_phrase(&lexemes[mark + 1..], &["a", "an"])?;
        let end = (mark + 1..lexemes.len()).find(|at| is_mark(&lexemes[*at]))?;
        Some((from, mark, end))
    });
    if let Some((from, mark, end)) = found {
        // With the mark behind it, so that its place is that of the first.
        lexemes.remove(end);
        lexemes.drain(from..=mark);
    }
}

/// Where a noun stands that is named again behind a mark, of how many words it is, the longer name, and where that stands.
fn again_at(lexemes: &[Lexeme], mark: usize) -> Option<(usize, usize, Vec<Lexeme>, usize, usize)> {
    let from = mark + 1;
    let begin = from + longest_phrase(&lexemes[from..], &["a", "an", "some"]).unwrap_or(0);
    let end = (begin..lexemes.len()).find(|at| is_mark(&lexemes[*at])).unwrap_or(lexemes.len());
    let end = (begin + 1..end)
        .find(|at| {
            longest_phrase(&lexemes[*at..], CODA) == Some(end - at)
                || longest_phrase(&lexemes[*at..], &["i mean", "i meant"]) == Some(end - at)
        })
        .unwrap_or(end);
    // "A tree, an oak".
    let is_kind = |name: &[Lexeme]| {
        begin > from && name.last().is_some_and(|last| super::follow::species(last).is_some())
    };
    let name = lexemes
        .get(begin..end)
        .filter(|name| (2..=3).contains(&name.len()) || name.len() == 1 && is_kind(name))?;
    // "A van, forget the van" names nothing again.
    let is_small = |word: &Lexeme| matches!(&word.token, Token::Word(word) if ["the", "that", "this", "it", "no", "not", "forget"].contains(&word.as_str()));
    let all_words = name.iter().all(|word| matches!(word.token, Token::Word(_)) && !is_small(word));
    let head = if name.len() == 1 { "tree" } else { head_of(name.last()?)? };
    let sentence =
        lexemes[..mark].iter().rposition(|lexeme| lexeme.token == Token::Break).map_or(0, |at| at + 1);
    let noun = (sentence..mark).find(|at| head_of(&lexemes[*at]) == Some(head))?;
    // New things alone are named again so.
    let new = (sentence..noun).rev().take(1).any(|at| {
        longest_phrase(&lexemes[at..], &["a", "an", "some"]).is_some()
            || number(&lexemes[at..noun]).is_some()
            || matches!(&lexemes[at].token, Token::Word(word) if ["put", "add", "place", "plant", "want", "set", "like"].contains(&word.as_str()))
    });
    let is_old = lexemes[noun..mark].windows(2).any(|pair| {
        matches!(&pair[0].token, Token::Word(word) if word == "the") && head_of(&pair[1]) == Some(head)
    });
    let is_other = longest_phrase(
        name,
        &["red", "blue", "green", "yellow", "white", "black", "another", "second", "one", "two", "the"],
    )
    .is_some();
    (all_words && new && !is_old && !is_other).then(|| (noun, 1, name.to_vec(), mark, end))
}

/// A noun without its plural.
fn head_of(lexeme: &Lexeme) -> Option<&str> {
    match &lexeme.token {
        Token::Word(word) if word.len() > 2 => Some(
            word.strip_suffix("es")
                .filter(|stem| stem.ends_with("ch"))
                .or(word.strip_suffix('s'))
                .unwrap_or(word),
        ),
        _ => None,
    }
}

/// Every word of these tables, for the spelling.
pub(super) fn words() -> impl Iterator<Item = &'static str> {
    [SOUNDS, DETERMINERS].into_iter().flatten().flat_map(|phrase| phrase.split(' '))
}

#[cfg(test)]
mod tests {
    use super::super::super::lexer::lex;
    use super::*;

    fn plain(said: &str) -> String {
        let mut lexemes = lex(said);
        in_plain_words(said, &mut lexemes);
        let words = lexemes.iter().map(|lexeme| match &lexeme.token {
            Token::Word(word) => word.clone(),
            Token::Comma => ",".to_owned(),
            Token::Break => ".".to_owned(),
            Token::Number(number) => number.to_string(),
            _ => "?".to_owned(),
        });
        words.collect::<Vec<_>>().join(" ")
    }

    #[test]
    fn what_was_broken_off_is_taken_back() {
        assert_eq!(plain("put a well... a bird bath here"), "put a bird bath here");
        assert_eq!(plain("six lobster... er, wooden barrels"), "six wooden barrels");
        assert_eq!(plain("put a bench... the red one goes"), "put a bench . the red one goes");
    }

    #[test]
    fn a_dash_is_a_comma_and_a_hyphen_is_none() {
        assert_eq!(plain("roses around it - so dull"), "roses around it , so dull");
        assert_eq!(plain("a first-aid kit"), "a first aid kit");
    }

    #[test]
    fn what_is_named_again_by_a_longer_name_is_one_thing() {
        assert_eq!(plain("put a sign by the kiosk, a direction sign"), "put a direction sign by the kiosk");
        assert_eq!(plain("put a bench here, a red bench"), "put a bench here , a red bench");
    }
}
