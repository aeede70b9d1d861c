//! Who and what an order is about that nobody has heard of: "turn Walter towards the school", "tear the library down".

use simworld_core::seam::PlanError;

use super::super::lexer::Token;
use super::super::lexicon::{category, longest, longest_phrase};
use super::super::phrases::Phrases;
use super::parse::Reader;
use super::words::{VERBS, Verb};

/// That somebody is to do something.
#[rustfmt::skip]
const SHALL: &Phrases = &Phrases::of(&["should", "must", "could", "shall", "can", "may", "has to", "needs to", "ought to", "is to", "wants to", "had better", "better", "would like to", "might", "should please", "will", "should not", "shouldnt", "mustnt"]);
/// What somebody does, and no thing.
#[rustfmt::skip]
const GOES: &Phrases = &Phrases::of(&["come", "go", "move", "walk", "stand", "sit", "wait", "look", "face", "turn", "join", "step", "stay", "be", "run", "head", "hurry", "leave", "please", "stop", "follow", "now", "just", "swap", "watch", "get", "rather", "really"]);
/// Words that begin a sentence and are no names.
#[rustfmt::skip]
const NO_NAMES: &Phrases = &Phrases::of(&["it", "he", "she", "they", "we", "you", "i", "that", "this", "these", "those", "there", "everything", "nothing", "something", "everybody", "everyone", "nobody", "somebody", "someone", "people", "all", "both", "the", "a", "an", "one", "my", "our", "your", "his", "her", "their", "what", "who", "which", "where", "how", "when", "if", "here", "now", "any", "anyone", "each", "every", "some", "and", "not", "no", "two", "three", "four", "five", "snow", "rain", "fog", "night", "day"]);

impl Reader<'_> {
    /// That what the first order is about is not there, where nothing else is understood of the sentence.
    pub(super) fn stranger(&self) -> Option<PlanError> {
        self.not_taken(self.lexemes.len()).or_else(|| self.unknown_name())
    }

    /// "Professor Novak should move next to the fountain": a name that nobody bears, before what somebody should do.
    ///
    /// Of names of one word nothing but their place is known, so that they may be a thing; those of more have capitals within a sentence.
    pub(super) fn unknown_somebody(&self, least: usize) -> Option<PlanError> {
        const LONGEST: usize = 3;
        let begins = |at: &usize| {
            *at == 0
                || super::super::lexer::is_mark(&self.lexemes[at - 1])
                || self.word(at - 1) == Some("and")
        };
        (0..self.lexemes.len()).filter(begins).find_map(|from| {
            let end = (from + least..=from + LONGEST).find(|at| {
                let rest = self.lexemes.get(*at..).unwrap_or_default();
                let shall = longest_phrase(rest, SHALL).unwrap_or(0);
                shall > 0 && longest_phrase(&rest[shall..], GOES).is_some()
            })?;
            let name = self.written(from, end);
            let is_name = |word: &str| {
                word.starts_with(char::is_uppercase) && word.chars().skip(1).all(char::is_lowercase)
            };
            let said = &self.lexemes[from..end];
            let whole = |at: usize, words: usize| at + words == said.len();
            let is_known = (0..said.len()).any(|at| {
                category(&said[at..]).is_some_and(|(_, words)| whole(at, words))
                    || self.names.asset_words(&said[at..]).is_some_and(|words| whole(at, words))
                    || self.names.exact(&said[at..]).is_some()
                    || self.view.streets.is_some_and(|streets| streets.at(&said[at..]).is_some())
            });
            let is_small = longest_phrase(said, NO_NAMES).is_some();
            (name.split(' ').all(is_name) && !is_known && !is_small)
                .then(|| PlanError::NotFound { wanted: name, near: "nobody here is called so".to_owned() })
        })
    }

    /// A name that nobody bears, just behind a verb: a capital within the sentence, and no word for a thing.
    fn unknown_name(&self) -> Option<PlanError> {
        let start = self.polite_at(0);
        let (verb, words) = longest(self.lexemes.get(start..)?, &VERBS)?;
        if !matches!(
            verb,
            Verb::Turn | Verb::Move | Verb::Remove | Verb::Paint | Verb::Swap | Verb::Put | Verb::Take
        ) {
            return None;
        }
        let at = start + words;
        let rest = self.lexemes.get(at..).filter(|rest| !rest.is_empty())?;
        let name = self.written(at, at + 1);
        let is_name = matches!(rest[0].token, Token::Word(_))
            && name.starts_with(char::is_uppercase)
            && name.chars().skip(1).all(char::is_lowercase)
            && category(rest).is_none()
            && self.names.exact(rest).is_none()
            && self.names.asset_words(rest).is_none();
        let ends = self.is_place(at + 1)
            || longest_phrase(&rest[1..], &["towards", "to", "and", "with", "so", "by", "away"]).is_some()
            || rest.get(1).is_none_or(super::super::lexer::is_mark);
        let near = "nobody here is called so".to_owned();
        (is_name && ends).then_some(PlanError::NotFound { wanted: name, near })
    }
}
