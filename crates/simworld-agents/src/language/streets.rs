//! What streets are called.

use std::collections::BTreeMap;
use std::sync::Arc;

use simworld_core::id::RoadId;
use simworld_core::net::RoadNetwork;

use super::lexer::{Lexeme, Token, lex};

/// The names of streets, by their first words; made once for a network.
#[derive(Clone, Debug, Default)]
pub(crate) struct StreetNames {
    network: Option<Arc<RoadNetwork>>,
    streets: Vec<Street>,
    /// Streets by the first word of their name.
    first: BTreeMap<String, Vec<usize>>,
}

/// One street: all roads of one name.
#[derive(Clone, Debug)]
struct Street {
    name: String,
    words: Vec<String>,
    roads: Vec<RoadId>,
}

/// A street that is named.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Named<'a> {
    pub(crate) name: &'a str,
    /// Its pieces, ascending.
    pub(crate) roads: &'a [RoadId],
    /// How many words name it.
    pub(crate) words: usize,
}

impl StreetNames {
    /// The names of a network; none without one.
    pub(crate) fn of(network: Option<&Arc<RoadNetwork>>) -> Self {
        let mut named: BTreeMap<&str, Vec<RoadId>> = BTreeMap::new();
        for road in (0..network.map_or(0, |network| network.roads.len())).map(RoadId::from_index) {
            if let Some(name) = network.and_then(|network| network.road_name(road)) {
                named.entry(name).or_default().push(road);
            }
        }
        let street = |(name, roads): (&str, Vec<RoadId>)| {
            let words = lex(name).into_iter().filter_map(|lexeme| word_of(&lexeme)).collect();
            Street { name: name.to_owned(), words, roads }
        };
        let streets: Vec<Street> =
            named.into_iter().map(street).filter(|street| !street.words.is_empty()).collect();
        let mut first: BTreeMap<String, Vec<usize>> = BTreeMap::new();
        for (index, street) in streets.iter().enumerate() {
            first.entry(street.words[0].clone()).or_default().push(index);
        }
        Self { network: network.cloned(), streets, first }
    }

    /// Whether these are the names of that network.
    pub(crate) fn is_of(&self, network: Option<&Arc<RoadNetwork>>) -> bool {
        match (&self.network, network) {
            (Some(own), Some(other)) => Arc::ptr_eq(own, other),
            (None, None) => true,
            _ => false,
        }
    }

    /// The street whose name begins the words, the longest.
    pub(super) fn at(&self, lexemes: &[Lexeme]) -> Option<Named<'_>> {
        let begins = |street: &&Street| says(lexemes, &street.words);
        let street = self.beginning(lexemes).filter(begins).max_by_key(|street| street.words.len())?;
        Some(street.named(street.words.len()))
    }

    /// As [`Self::at`], and also without the last word, where only one street is meant: "the corner of Elm and Oak".
    pub(super) fn in_short(&self, lexemes: &[Lexeme]) -> Option<Named<'_>> {
        self.at(lexemes).or_else(|| {
            let short = |street: &&Street| {
                street.words.len() > 1 && says(lexemes, &street.words[..street.words.len() - 1])
            };
            let mut found = self.beginning(lexemes).filter(short);
            match (found.next(), found.next()) {
                (Some(street), None) => Some(street.named(street.words.len() - 1)),
                _ => None,
            }
        })
    }

    /// Whether it is a word of a name.
    pub(super) fn has_word(&self, word: &str) -> bool {
        self.first.contains_key(word)
            || self.streets.iter().any(|street| street.words.iter().any(|own| own == word))
    }

    fn beginning(&self, lexemes: &[Lexeme]) -> impl Iterator<Item = &Street> {
        let first = lexemes.first().and_then(word_of);
        let indices = first.and_then(|first| self.first.get(&first));
        indices.into_iter().flatten().map(|index| &self.streets[*index])
    }
}

impl Street {
    fn named(&self, words: usize) -> Named<'_> {
        Named { name: &self.name, roads: &self.roads, words }
    }
}

fn word_of(lexeme: &Lexeme) -> Option<String> {
    match &lexeme.token {
        Token::Word(word) => Some(word.clone()),
        Token::Number(number) => Some(number.to_string()),
        _ => None,
    }
}

fn says(lexemes: &[Lexeme], words: &[String]) -> bool {
    lexemes.len() >= words.len()
        && lexemes.iter().zip(words).all(|(lexeme, word)| word_of(lexeme).as_ref() == Some(word))
}
