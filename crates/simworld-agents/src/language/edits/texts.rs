//! What is to be done to words, and to nothing of the scene: "translate this paragraph into Finnish", though to translate a thing is to move it.

use super::super::lexicon::longest_phrase;
use super::super::phrases::Phrases;
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
