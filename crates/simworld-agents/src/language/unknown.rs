//! Noun phrases whose words are not known: misspelt, part of a name, or nothing that is here.

use simworld_core::seam::PlanError;

use super::clause::Target;
use super::lexer::{Lexeme, Token, is_mark, lex, word_of, written};
use super::lexicon::{COPULAS, category, longest_phrase, longest_relation};
use super::names::{Guess, Names};
use super::parser::{Parser, shortened};
use super::phrases::Phrases;
use super::politeness::{filler, joint};
use super::verbs::longest_verb;

/// Words that end a phrase whose words are not known.
const BOUNDARIES: &Phrases = &Phrases::of(&[
    "to", "at", "in", "on", "for", "up", "down", "off", "into", "onto", "with", "until", "if", "unless",
    "when", "from", "of", "or", "that", "while", "before", "after", "via", "past",
]);

/// "Water the sunflowers": what is not here, in an order that is not known either; with politeness and with nothing else. None if
/// the thing is one that is here or may be, of which it is the deed that nobody knows.
pub(super) fn unknown_deed(words: &str, names: &Names<'_>) -> Option<String> {
    #[rustfmt::skip]
    const LEADS: &Phrases = &Phrases::of(&[
        "the", "onto the", "on the", "up the", "down the", "into the", "in the", "over the", "with the", "out the", "off the", "something on the", "a song on the", "a tune on the",
        "at the", "from the", "some of the", "all the", "through the",
    ]);
    /// What people do with things, and nobody here can.
    #[rustfmt::skip]
    const DEEDS: &[&str] = &[
        "water", "play", "climb", "milk", "feed", "mow", "sweep", "clean", "wash", "ring", "light", "repair", "fix", "cook", "brush", "stroke", "pet", "jump", "swim", "dance", "read", "plant", "dig",
        "bake", "fly", "sail", "row", "fill", "empty", "polish", "rake", "prune", "groom", "saddle", "shear", "pluck", "pick", "switch", "start", "wind", "hang", "fold", "iron", "load", "unload", "tune", "dust", "mop",
    ];
    let lexemes = super::hearing::hear(words, None);
    let end = lexemes.iter().rposition(|lexeme| !is_mark(lexeme))? + 1;
    let mut said = &lexemes[..end];
    while let Some(count) = filler(said).or_else(|| said.first().filter(|first| is_mark(first)).map(|_| 1)) {
        said = &said[count..];
    }
    let plain = |lexeme: &Lexeme| matches!(lexeme.token, Token::Word(_));
    let deed = said.first().filter(|first| plain(first))?;
    let lead = longest_phrase(&said[1..], LEADS)?;
    let noun = said.get(1 + lead).filter(|noun| plain(noun))?;
    // Up to where it stands: "the sunflowers behind the depot".
    let behind = said.get(2 + lead..).unwrap_or_default();
    let ends = behind.is_empty() || longest_relation(behind).is_some();
    let here = |noun: &Lexeme| {
        let said = std::slice::from_ref(noun);
        category(said).is_some() || names.goods(said).is_some() || names.has_word(word_of(noun))
    };
    let known = longest_verb(said).is_some() || !DEEDS.contains(&word_of(deed));
    (ends && !known && !here(noun)).then(|| word_of(noun).to_owned())
}

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
