//! Assets made from words: one trait, [`AssetGenerator`], and what stands behind it.
//!
//! A generator is outside the simulation: what it makes enters a world by
//! [`Command::AddAsset`](simworld_core::command::Command::AddAsset), which carries the whole asset, so that a recorded run
//! replays without the generator.

mod error;
#[cfg(all(feature = "assets", feature = "http"))]
mod hunyuan;
mod procedural;
mod prompt;
mod reading;
mod sculpt;
mod stuff;
mod thing;
mod things;
mod words;

pub use error::GenerateError;
#[cfg(all(feature = "assets", feature = "http"))]
pub use hunyuan::{
    Canceller, HunyuanConfig, HunyuanError, HunyuanGenerator, HunyuanVersion, Texture, Ticket, Way,
};
pub use procedural::{KnownThing, ProceduralGenerator};
pub use prompt::{AssetPrompt, LONGEST_PROMPT, SizeHint, ViewImages};
use simworld_core::asset::Asset;

/// An asset that was made, and what of the prompt it does not show.
#[derive(Clone, Debug, PartialEq)]
pub struct Made {
    /// The asset, valid; its source says who made it and from which words.
    pub asset: Asset,
    /// The words that changed nothing, in their order; a generator that cannot tell gives none.
    pub unused: Vec<String>,
}

/// Makes assets from words: a grammar, a server, or something of one's own.
///
/// A generator may be asked from another thread than it was made on, and waits until the asset is there. What a
/// deterministic one makes is a function of the prompt alone.
pub trait AssetGenerator: Send {
    /// What it is, for people: `procedural`.
    fn name(&self) -> &str;

    /// Makes one asset, or nothing.
    ///
    /// # Errors
    /// The prompt asks for what this generator cannot make, or what came of it is no asset; see [`GenerateError`].
    fn generate(&mut self, prompt: &AssetPrompt) -> Result<Made, GenerateError>;
}

impl<G: AssetGenerator + ?Sized> AssetGenerator for Box<G> {
    fn name(&self) -> &str {
        (**self).name()
    }

    fn generate(&mut self, prompt: &AssetPrompt) -> Result<Made, GenerateError> {
        (**self).generate(prompt)
    }
}
