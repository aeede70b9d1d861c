//! Who and what an order is about that nobody has heard of: "turn Walter towards the school", "tear the library down".

use simworld_core::seam::PlanError;

use super::super::lexer::Token;
use super::super::lexicon::{category, longest, longest_phrase};
use super::parse::Reader;
use super::words::{VERBS, Verb};

impl Reader<'_> {
    /// That what the first order is about is not there, where nothing else is understood of the sentence.
    pub(super) fn stranger(&self) -> Option<PlanError> {
        self.not_taken(self.lexemes.len()).or_else(|| self.unknown_name())
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
