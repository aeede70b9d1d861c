//! The colour of a thing: a word, or linear light.

use std::fmt;

use serde::de::{self, Deserializer, SeqAccess, Visitor};
use serde::ser::Serializer;
use serde::{Deserialize, Serialize};

use crate::language::paint::PAINTS;

/// A colour.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Colour {
    /// By a word, as paint has it; one of [`Colour::words`].
    Word(&'static str),
    /// Linear-light sRGB primaries in [0, 1], as in manifests of libraries.
    Linear([f32; 3]),
}

impl Colour {
    /// The words that are known.
    pub fn words() -> impl Iterator<Item = &'static str> {
        PAINTS.iter().flat_map(|(words, _)| *words).copied()
    }

    /// The colour of a word.
    ///
    /// ```
    /// use simworld_agents::scenes::file::Colour;
    /// let [red, green, blue] = Colour::of("crimson").unwrap().linear();
    /// assert!(red > 10.0 * green && red > 10.0 * blue);
    /// assert_eq!(Colour::of("loud"), None);
    /// ```
    pub fn of(word: &str) -> Option<Self> {
        let word = word.trim();
        Self::words().find(|known| known.eq_ignore_ascii_case(word)).map(Self::Word)
    }

    /// Linear-light sRGB primaries.
    pub fn linear(self) -> [f32; 3] {
        match self {
            Self::Linear(color) => color,
            Self::Word(word) => {
                let paint = PAINTS.iter().find(|(words, _)| words.contains(&word));
                // A word that a program made up is the grey of unpainted things.
                paint.map_or([0.5; 3], |(_, paint)| paint.color())
            }
        }
    }
}

impl Serialize for Colour {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Word(word) => serializer.serialize_str(word),
            Self::Linear(color) => color.serialize(serializer),
        }
    }
}

impl<'de> Deserialize<'de> for Colour {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(ColourVisitor)
    }
}

struct ColourVisitor;

impl<'de> Visitor<'de> for ColourVisitor {
    type Value = Colour;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a colour: a word such as \"red\", or [red, green, blue] from 0 to 1")
    }

    fn visit_str<E: de::Error>(self, word: &str) -> Result<Colour, E> {
        Colour::of(word).ok_or_else(|| {
            let word: String = word.chars().take(40).collect();
            let known: Vec<&str> = PAINTS.iter().map(|(words, _)| words[0]).collect();
            let known = known.join(", ");
            E::custom(format!(
                "{word:?} is no colour that is known: give one of {known}, or [red, green, blue] from 0 to 1"
            ))
        })
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut numbers: A) -> Result<Colour, A::Error> {
        let mut color: Vec<f32> = Vec::new();
        while let Some(channel) = numbers.next_element()? {
            color.push(channel);
        }
        let told = "a colour has three numbers: give [red, green, blue] from 0 to 1";
        let color = <[f32; 3]>::try_from(color).map_err(|_| <A::Error as de::Error>::custom(told))?;
        Ok(Colour::Linear(color))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_word_is_a_colour_of_its_own_name() {
        for word in Colour::words() {
            let colour = Colour::of(word).expect("it is among them");
            assert_eq!(colour, Colour::Word(word));
            assert_ne!(colour.linear(), [0.5; 3], "{word}");
        }
        assert_eq!(Colour::of(" Grey "), Some(Colour::Word("grey")));
    }
}
