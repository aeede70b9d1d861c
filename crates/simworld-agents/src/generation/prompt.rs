//! What a generator is asked for.

use serde::{Deserialize, Serialize};

use super::GenerateError;

/// The most characters that a prompt may have.
pub const LONGEST_PROMPT: usize = 400;

/// What is to be made.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct AssetPrompt {
    /// What it is, in words: `a tall green lamp post`.
    pub words: String,
    /// What the generator draws from: the same words with another seed are another thing of the kind.
    pub seed: u64,
    /// How large it is to be, where that is known.
    pub size: SizeHint,
    /// A picture of it, as the bytes of a PNG or JPEG file.
    pub image: Option<Vec<u8>>,
    /// Pictures of it from its sides, in place of the one.
    pub views: ViewImages,
    /// Its shape as the bytes of a GLB file, where it is there already and is to be painted.
    pub mesh: Option<Vec<u8>>,
}

/// Pictures of a thing from its sides, each as the bytes of a PNG or JPEG file.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct ViewImages {
    /// From before it.
    pub front: Option<Vec<u8>>,
    /// From its left.
    pub left: Option<Vec<u8>>,
    /// From behind it.
    pub back: Option<Vec<u8>>,
    /// From its right.
    pub right: Option<Vec<u8>>,
}

impl ViewImages {
    /// Those that there are, each with the side that it shows.
    pub fn iter(&self) -> impl Iterator<Item = (&'static str, &[u8])> {
        let sides =
            [("front", &self.front), ("left", &self.left), ("back", &self.back), ("right", &self.right)];
        sides.into_iter().filter_map(|(side, image)| Some((side, image.as_deref()?)))
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.iter().next().is_none()
    }
}

/// How large a thing is to be, m; what is not given is free.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct SizeHint {
    /// Along x, its front to its back, m.
    pub length: Option<f64>,
    /// Along y, m.
    pub width: Option<f64>,
    /// m.
    pub height: Option<f64>,
}

impl AssetPrompt {
    /// A prompt of words, with seed 0, any size, no picture and no shape.
    pub fn new(words: impl Into<String>) -> Self {
        Self { words: words.into(), ..Self::default() }
    }

    /// With another seed.
    #[must_use]
    pub fn seeded(mut self, seed: u64) -> Self {
        self.seed = seed;
        self
    }

    /// Whether it holds more than words: a picture, or a shape.
    pub fn shows_something(&self) -> bool {
        self.image.is_some() || !self.views.is_empty() || self.mesh.is_some()
    }

    /// The words without blanks around them.
    ///
    /// # Errors
    /// There are none, or more than [`LONGEST_PROMPT`] characters.
    pub fn checked_words(&self) -> Result<&str, GenerateError> {
        let words = self.words.trim();
        let length = words.chars().count();
        match length {
            0 => Err(GenerateError::Empty),
            1..=LONGEST_PROMPT => Ok(words),
            _ => Err(GenerateError::TooLong { length, most: LONGEST_PROMPT }),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_prompt_says_something_short() {
        assert!(matches!(AssetPrompt::new(" \t").checked_words(), Err(GenerateError::Empty)));
        let long = "é".repeat(LONGEST_PROMPT + 1);
        assert!(matches!(
            AssetPrompt::new(long).checked_words(),
            Err(GenerateError::TooLong { length: 401, .. })
        ));
        assert!(matches!(AssetPrompt::new(" a bench ").checked_words(), Ok("a bench")));
    }
}
