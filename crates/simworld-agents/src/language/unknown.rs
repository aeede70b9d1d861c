//! Noun phrases whose words are not known: misspelt, part of a name, or nothing that is here.

use simworld_core::seam::PlanError;

use super::clause::Target;
use super::lexer::{Lexeme, Token, lex, written};
use super::lexicon::{COPULAS, longest_phrase, longest_relation};
use super::names::Guess;
use super::parser::{Parser, shortened};
use super::phrases::Phrases;
use super::politeness::{filler, joint};

/// Words that end a phrase whose words are not known.
const BOUNDARIES: &Phrases = &Phrases::of(&[
    "to", "at", "in", "on", "for", "up", "down", "off", "into", "onto", "with", "until", "if", "unless",
    "when", "from", "of", "or", "that", "while", "before", "after", "via", "past",
]);

impl<'a> Parser<'a> {
    /// What such a phrase means, if one thing only can be meant.
    pub(super) fn misspelt(&mut self) -> Result<Target, PlanError> {
        let phrase = self.unknown_phrase();
        if phrase.is_empty() {
            return Err(self.not_understood("say what: a thing, a place, a name, #id or (x, y)"));
        }
        if !self.is_capital(self.at)
            && let Some(sort) = self.names.sort(&phrase[0].token)
        {
            self.at += 1;
            return Ok(Target::Named(sort));
        }
        let (guess, count) = self.names.guess_or_part(phrase);
        let phrase = &phrase[..count];
        let said = shortened(written(self.words, phrase));
        // "The bookshop" sells books.
        if let (Guess::Nothing(_), Token::Word(word)) = (&guess, &phrase[0].token)
            && let Some(goods) =
                ["shop", "store", "stall", "stand"].iter().find_map(|shop| word.strip_suffix(shop))
            && goods.len() > 2
        {
            let sellers = self.names.sellers(goods);
            if !sellers.is_empty() {
                self.at += 1;
                return Ok(Target::Named(sellers));
            }
        }
        match guess {
            Guess::Named(ids) => {
                self.at += phrase.len();
                Ok(Target::Named(ids))
            }
            Guess::Category(category, word) => {
                self.at += phrase.len();
                // "The dinner" is the one that is called a diner.
                let is_synonym = category.is_place() && word != category.words[0];
                match if is_synonym { self.names.part(&lex(word)) } else { None } {
                    Some(Guess::Named(ids)) => Ok(Target::Named(ids)),
                    _ => Ok(Target::Any(category)),
                }
            }
            Guess::Ambiguous(labels) => {
                let near = format!("it could be {}: say which", labels.join(" or "));
                Err(PlanError::NotFound { wanted: said, near })
            }
            Guess::Nothing(similar) => {
                let near = self.view.surroundings();
                let near = match similar {
                    Some(similar) => format!("did you mean {similar:?}? {near}"),
                    None => near,
                };
                Err(PlanError::NotFound { wanted: said, near })
            }
        }
    }

    /// Whether an order could go on or end here, so that no noun does.
    fn ends_phrase(&self) -> bool {
        joint(self.rest()).is_some()
            || [BOUNDARIES, COPULAS].iter().any(|words| longest_phrase(self.rest(), words).is_some())
    }

    /// The words up to where something known goes on.
    fn unknown_phrase(&self) -> &'a [Lexeme] {
        let rest = self.rest();
        let ends = |at: &usize| {
            let here = &rest[*at..];
            !matches!(here[0].token, Token::Word(_) | Token::Number(_))
                || joint(here).is_some()
                || filler(here).is_some()
                || [BOUNDARIES, COPULAS].iter().any(|words| longest_phrase(here, words).is_some())
                || longest_relation(here).is_some()
        };
        let mut end = (0..rest.len()).find(ends).unwrap_or(rest.len());
        if end == 0
            && matches!(rest.first(), Some(Lexeme { token: Token::Word(_), .. }))
            && !self.ends_phrase()
        {
            end = 1;
        }
        &rest[..end]
    }
}
