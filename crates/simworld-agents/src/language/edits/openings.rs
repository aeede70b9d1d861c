//! What opens a talk and what closes it, and asks for nothing: "okay, Merlin, listen: ...", "excuse me, ...", "..., and thank you in advance", "..., there's
//! a good chap"; and what it is for, before what is asked for: "for the smuggler film I need ...".
//!
//! They are left out only where a sentence was refused with them.

use super::super::lexer::{Lexeme, is_mark, word_of};
use super::super::lexicon::{category, longest, longest_phrase};
use super::super::names::Names;
use super::super::paint::PAINTS;
use super::super::phrases::Phrases;
use super::forms::word;
use super::words::{SKIES, VERBS};

/// Before a mark, at the beginning.
#[rustfmt::skip]
const OPENERS: &Phrases = &Phrases::of(&["okay", "ok", "right", "right then", "alright", "all right", "well", "well then", "now", "now then", "so", "hello", "hello there", "hi", "hi there", "hey", "hey there", "hiya", "howdy", "ahoy", "greetings", "good morning", "good afternoon", "good evening", "good day", "morning all", "evening all",
    "listen", "listen up", "listen here", "now listen", "look", "look here", "see here", "attention", "attention please", "excuse me", "excuse me please", "pardon me", "beg your pardon", "i beg your pardon", "sorry", "sorry to bother you", "sorry to trouble you", "sorry to bother you again", "sorry to interrupt", "forgive me", "please excuse me",
    "one more thing", "one last thing", "one other thing", "just one thing", "another thing", "by the way", "quick question", "a quick question", "quick one", "just a question", "question", "here is what i want", "heres what i want", "here is the plan", "heres the plan", "heres the thing", "here is the thing", "heres a thought", "here is a thought",
    "i have a wish", "ive got a wish", "i have a request", "ive a request", "i have a question", "ive got a question", "i have an idea", "ive got an idea", "ive an idea", "tell you what", "ill tell you what", "you know what", "know what", "do me a favour", "do me a favor", "be a dear", "be an angel", "ladies and gentlemen", "my friend", "my dear", "dear friend", "dear sir", "dear madam", "sir", "madam", "captain", "boss", "maestro", "computer", "wizard", "my good man"]);
/// Behind a mark or "and", at the end.
#[rustfmt::skip]
const CLOSERS: &Phrases = &Phrases::of(&["thank you in advance", "thanks in advance", "many thanks in advance", "thanking you in advance", "thanking you", "with thanks", "with many thanks", "thank you for your help", "thanks for your help", "thank you for helping", "thanks for helping", "thank you for your trouble", "thanks for your trouble", "thank you for your time", "thanks for your time", "thank you for listening", "thanks for listening", "thank you for your patience", "thanks for your patience",
    "thanks awfully", "thank you kindly", "thank you ever so much", "much obliged", "im much obliged", "i am much obliged", "i owe you one", "i owe you a coffee", "i owe you a beer", "ill be forever grateful", "ill owe you one", "the drinks are on me", "please to put", "please to add", "please to make", "please to place", "please to do", "please to do it", "please to do so", "please do", "please do so", "please do it", "please be so kind", "will you", "would you", "wont you", "you hear", "do you hear", "do you hear me", "got it", "understood", "is that clear",
    "there is a good chap", "theres a good chap", "theres a good girl", "theres a good boy", "theres a good fellow", "theres a good lad", "theres a good lass", "theres a good man", "theres a good sport", "theres a good soul", "theres a dear", "theres a love", "theres a pet", "theres a good dear", "be a good chap", "be a good sport", "be a good fellow", "be a sport", "good man", "good lad", "good chap", "old chap", "old boy", "old man", "old sport", "old bean", "my good man", "my good fellow",
    "ive lost track", "i have lost track", "i lost track", "ive lost count", "i have lost count", "i lost count", "i forget", "i forgot", "ive forgotten", "i have forgotten", "i cant remember", "i cannot remember", "i dont remember", "i can never remember", "i keep forgetting", "i never remember", "i cant keep track", "i can not keep track", "i lose track", "remind me", "please remind me", "i cant find him", "i cant find her", "i cant see him", "i cant see her", "i dont see him", "i dont see her", "i cant tell from here", "i cannot tell from here",
    "roughly", "approximately", "more or less", "give or take", "as the crow flies", "in metres", "in meters", "roughly speaking", "over and out", "copy that", "roger", "make it snappy", "snap to it", "look lively", "look sharp", "no arguing", "no arguments", "no buts", "no backchat", "no dawdling", "no excuses", "no questions asked", "no questions", "dont ask", "dont ask why", "mums the word", "bobs your uncle", "bob is your uncle", "hope thats all right", "i hope thats all right", "i hope that is all right", "i hope thats okay", "i hope thats ok", "i hope you dont mind", "hope you dont mind",
    "if i may ask", "if i might ask", "may i ask", "id like to know", "i would like to know", "i want to know", "id love to know", "i wonder", "i was wondering", "just wondering", "im just wondering", "i am wondering", "im wondering", "just asking", "im just asking", "just curious", "im curious", "i am curious", "im just curious", "out of curiosity", "out of interest", "any idea", "any ideas", "do you know", "do you happen to know", "can you tell me", "could you tell me",
    "cheerio", "ciao", "bye", "bye bye", "goodbye", "bye for now", "see you", "see you later", "yours truly", "over to you", "the rest is up to you", "take your time", "theres no rush", "theres no hurry", "there is no rush", "there is no hurry", "no hurry", "no rush", "no worries", "whenever it suits you", "the sooner the better", "sooner rather than later"]);
/// Before what it is for.
#[rustfmt::skip]
const FOR: &Phrases = &Phrases::of(&["for the", "for our", "for my", "for this", "for that", "for a", "for an", "for his", "for her", "for their", "for todays", "for tonights", "for tomorrows"]);
/// What it is for.
#[rustfmt::skip]
const OCCASIONS: &[&str] = &["film", "movie", "scene", "shot", "video", "clip", "documentary", "series", "episode", "story", "play", "show", "musical", "opera", "painting", "picture", "photo", "poster", "postcard", "advert", "commercial", "festival", "party", "wedding", "parade", "concert", "fair", "fete", "exhibition", "ceremony", "contest", "competition", "race", "marathon", "lesson", "rehearsal", "performance", "reenactment", "game", "quest"];
/// What is asked for begins so.
#[rustfmt::skip]
const REQUESTS: &Phrases = &Phrases::of(&["i", "we", "id", "wed", "please", "can", "could", "would", "a", "an", "there", "lets", "let us", "make"]);

/// The words without what opens and closes the talk.
pub(super) fn without(words: &str, lexemes: &[Lexeme], names: &Names<'_>) -> Vec<Lexeme> {
    let from = behind_openers(words, lexemes, names);
    let rest = &lexemes[from..];
    let end = before_closers(rest);
    let mut kept = rest[..end].to_vec();
    kept.extend(rest[end..].last().filter(|last| is_mark(last)).cloned());
    kept
}

/// How many words open the talk.
fn behind_openers(words: &str, lexemes: &[Lexeme], names: &Names<'_>) -> usize {
    let mut at = 0;
    loop {
        let rest = &lexemes[at..];
        let called = || (at > 0 && is_called(words, rest, names)).then_some(1);
        let Some(said) = longest_phrase(rest, OPENERS).or_else(called) else { break };
        let marks = rest[said..].iter().take_while(|lexeme| is_mark(lexeme)).count();
        if marks == 0 || at + said + marks >= lexemes.len() {
            break;
        }
        at += said + marks;
    }
    at + occasion(&lexemes[at..]).unwrap_or(0)
}

/// "Merlin": who is spoken to behind "okay", by a name that nobody and nothing here bears.
fn is_called(words: &str, rest: &[Lexeme], names: &Names<'_>) -> bool {
    let [called, mark, ..] = rest else { return false };
    let is_name = words.get(called.start..).is_some_and(|said| said.starts_with(char::is_uppercase));
    is_name
        && is_mark(mark)
        && !word_of(called).is_empty()
        && names.exact(rest).is_none()
        && names.asset_words(rest).is_none()
        && category(rest).is_none()
        && longest(rest, &VERBS).is_none()
        && longest(rest, &SKIES).is_none()
        && longest(rest, PAINTS).is_none()
        && super::sky::hour(rest).is_none()
}

/// "For the smuggler film" before a request.
fn occasion(rest: &[Lexeme]) -> Option<usize> {
    /// So many words name it at most.
    const LONGEST: usize = 4;
    let from = longest_phrase(rest, FOR)?;
    let noun = (from..from + LONGEST).find(|at| OCCASIONS.contains(&word(rest, *at)))?;
    if rest[..noun].iter().any(is_mark) {
        return None;
    }
    let behind = noun + 1 + usize::from(rest.get(noun + 1).is_some_and(is_mark));
    let request = rest.get(behind..)?;
    let begins = longest_phrase(request, REQUESTS).is_some() || longest(request, &VERBS).is_some();
    begins.then_some(behind)
}

/// Where the words end before what closes the talk.
fn before_closers(lexemes: &[Lexeme]) -> usize {
    let mut end = end_of(lexemes);
    loop {
        let closes = |at: &usize| {
            let is_joined = ["and", "but", "so"].contains(&word(lexemes, *at));
            let from = *at + usize::from(is_joined);
            (is_mark(&lexemes[*at - 1]) || word(lexemes, *at) == "and")
                && from < end
                && longest_phrase(&lexemes[from..end], CLOSERS) == Some(end - from)
        };
        let kept = (1..end).find(closes).map_or(0, |at| end_of(&lexemes[..at]));
        if kept == 0 {
            return end;
        }
        end = kept;
    }
}

/// Behind the last word.
fn end_of(lexemes: &[Lexeme]) -> usize {
    lexemes.iter().rposition(|lexeme| !is_mark(lexeme)).map_or(0, |last| last + 1)
}
