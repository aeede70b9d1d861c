//! What is to be done to words, and to nothing of the scene: "translate this paragraph into Finnish", though to translate a thing is to move it;
//! and words that are asked for: "tell me a good joke", "do you know a recipe for pancakes?", "send an e-mail to my boss".

use super::super::lexer::{Lexeme, is_mark};
use super::super::lexicon::{longest, longest_phrase};
use super::super::phrases::Phrases;
use super::forms::word;
use super::parse::Reader;

/// What is done to words.
const VERBS: &Phrases =
    &Phrases::of(&["translate", "proofread", "summarise", "summarize", "paraphrase", "rephrase"]);
/// Before such an order.
#[rustfmt::skip]
const LEADS: &Phrases = &Phrases::of(&["please", "can you", "could you", "would you", "will you", "can you please", "could you please", "kindly", "now", "and", "i want you to", "i need you to", "help me", "help me to", "lets", "hey", "hi", "hello", "ok", "okay", "just", "quickly"]);
/// Before what somebody is to tell.
#[rustfmt::skip]
const ASKS: &Phrases = &Phrases::of(&["do you know a", "do you know any", "do you know some", "know a", "know any", "tell me a", "tell us a", "tell me another", "tell a", "have you got a", "got a", "have you heard a", "do you have a", "tell me some"]);
const JOKES: &[&str] =
    &["joke", "jokes", "riddle", "riddles", "pun", "puns", "limerick", "anecdote", "anecdotes"];
/// Words, in pieces of all lengths.
#[rustfmt::skip]
const TEXTS: &[&str] = &["paragraph", "paragraphs", "sentence", "sentences", "text", "texts", "letter", "letters", "email", "emails", "mail", "message", "messages", "poem", "poems", "word", "words", "page", "pages", "chapter", "article", "essay", "speech", "phrase", "phrases", "paper", "report", "document", "documents", "lyrics", "song", "recipe", "manual", "note", "notes", "quote", "story", "novel"];
/// Languages.
#[rustfmt::skip]
const LANGUAGES: &[&str] = &["english", "finnish", "swedish", "norwegian", "danish", "german", "dutch", "french", "spanish", "portuguese", "italian", "greek", "latin", "polish", "czech", "hungarian", "russian", "ukrainian", "turkish", "arabic", "hebrew", "hindi", "chinese", "mandarin", "japanese", "korean", "vietnamese", "thai", "icelandic", "estonian", "latvian", "lithuanian", "romanian", "bulgarian", "serbian", "croatian", "welsh", "irish", "gaelic", "esperanto"];
/// Before a language.
const INTO: &[&str] = &["into", "to", "in", "from"];
/// So many words may stand between the order and what it is about: "this very long paragraph".
const FARTHEST: usize = 5;

/// What asks somebody for words.
#[rustfmt::skip]
const TELLS: &Phrases = &Phrases::of(&["tell me a", "tell me another", "tell us a", "tell me some", "do you know a", "do you know any", "do you know some", "do you happen to know a", "do you have a", "have you got a", "know any", "give me a", "give us a", "write me a", "write a", "write an", "sing me a", "send a", "send an", "send me a", "send me an", "send him an", "send her an"]);
/// The words that are asked for.
#[rustfmt::skip]
const ASKED: &[&str] = &["joke", "jokes", "riddle", "riddles", "recipe", "recipes", "poem", "poems", "limerick", "limericks", "pun", "puns", "email", "emails"];
/// They stand no farther behind that: "a really good joke".
const NEAR: usize = 4;

/// Whether words are asked for, and nothing of the scene behind them.
pub(super) fn asks_for_words(lexemes: &[Lexeme]) -> bool {
    let mut at = 0;
    while let Some(words) = lexemes.get(at..).and_then(led) {
        at += words;
    }
    let Some(words) = lexemes.get(at..).and_then(|rest| longest_phrase(rest, TELLS)) else { return false };
    let from = at + words;
    let end = (from..lexemes.len()).find(|at| is_mark(&lexemes[*at])).unwrap_or(lexemes.len());
    let is_words = |at: usize| {
        ASKED.contains(&word(lexemes, at)) || word(lexemes, at) == "e" && word(lexemes, at + 1) == "mail"
    };
    let orders = |at: usize| {
        let joins = is_mark(&lexemes[at]) || word(lexemes, at) == "and";
        joins && longest(&lexemes[at + 1..], &super::words::VERBS).is_some()
    };
    (from..end.min(from + NEAR)).any(is_words) && !(from..lexemes.len()).any(orders)
}

/// How many words before an order lead to it: a mark, or what is said first.
fn led(rest: &[Lexeme]) -> Option<usize> {
    let first = rest.first()?;
    let by_the_way = || longest_phrase(rest, &["by the way", "btw", "oh", "so", "well", "say"]);
    longest_phrase(rest, LEADS).or_else(by_the_way).or(is_mark(first).then_some(1))
}

impl Reader<'_> {
    /// Whether a sentence asks that something be done to words.
    pub(super) fn is_about_texts(&self) -> bool {
        let mut at = 0;
        while at < self.lexemes.len() {
            let rest = &self.lexemes[at..];
            let is_mark = super::super::lexer::is_mark(&rest[0]);
            let Some(words) = longest_phrase(rest, LEADS).or(is_mark.then_some(1)) else { break };
            at += words;
        }
        if self.asks_for_a_joke(at) {
            return true;
        }
        let Some(words) = self.lexemes.get(at..).and_then(|rest| longest_phrase(rest, VERBS)) else {
            return false;
        };
        let from = at + words;
        let is_one_of = |at: usize, list: &[&str]| self.word(at).is_some_and(|word| list.contains(&word));
        let is_text = (from..from + FARTHEST).any(|at| is_one_of(at, TEXTS));
        let is_language = |at: usize| is_one_of(at, INTO) && is_one_of(at + 1, LANGUAGES);
        (is_text || (from..self.lexemes.len()).any(is_language))
            && !(from..self.lexemes.len()).any(|at| {
                super::super::numbers::length(&self.lexemes[at..]).is_some_and(|(_, words)| words > 1)
            })
    }

    /// "Do you know a good joke?"
    fn asks_for_a_joke(&self, at: usize) -> bool {
        let asked = longest_phrase(self.lexemes.get(at..).unwrap_or_default(), ASKS);
        asked.is_some_and(|words| {
            let from = at + words;
            (from..from + FARTHEST).any(|at| self.word(at).is_some_and(|word| JOKES.contains(&word)))
                && (from..self.lexemes.len()).all(|at| !self.is_place(at))
        })
    }
}

/// Words of these tables that are near others, for the spelling.
pub(super) fn words() -> impl Iterator<Item = &'static str> {
    VERBS.iter().chain(LANGUAGES).copied().chain(["paragraph", "paragraphs"])
}
