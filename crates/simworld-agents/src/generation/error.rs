//! Why no asset is made from a prompt.

use simworld_core::asset::AssetError;
use thiserror::Error;

/// Why there is no asset; nothing was added anywhere.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum GenerateError {
    /// The prompt has no words, and the generator needs some.
    #[error("the prompt has no words: say what to make")]
    Empty,
    /// The prompt is too long.
    #[error("the prompt has {length} characters: say it in at most {most}")]
    TooLong {
        /// How many it has.
        length: usize,
        /// How many it may have.
        most: usize,
    },
    /// The generator cannot make what the words name.
    #[error("cannot make {words:?}; near are {}", .near.join(", "))]
    Unknown {
        /// What was asked for.
        words: String,
        /// The nearest things that it can make, the nearest first.
        near: Vec<String>,
    },
    /// A size or number that the thing cannot have.
    #[error("{thing} with {what} {value}: give {allowed}")]
    Range {
        /// The thing.
        thing: String,
        /// Which measure, with its unit.
        what: &'static str,
        /// What was asked.
        value: f64,
        /// What is possible.
        allowed: String,
    },
    /// The generator takes no pictures and no shapes.
    #[error("{generator} makes nothing from pictures or shapes: describe the thing in words")]
    Image {
        /// Which generator.
        generator: String,
    },
    /// What was made is no asset.
    #[error("what was made from {words:?} is no asset: {error}")]
    Asset {
        /// What was asked for.
        words: String,
        /// What is wrong with it.
        #[source]
        error: AssetError,
    },
    /// The generator itself failed: a server, a file, a broken answer.
    #[error(transparent)]
    Generator(Box<dyn std::error::Error + Send + Sync>),
}
