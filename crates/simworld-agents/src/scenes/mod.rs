//! Whole scenes by words: "a small harbour town with narrow streets, fifty buildings, a market square and light rain" as a
//! [`SceneSpec`], which the city generator makes.
//!
//! [`GrammarSceneReader`] reads the same way every time and says which words it did not understand;
//! [`ModelSceneReader`](crate::thought::ModelSceneReader) asks a model for the same spec.
//!
//! Scenes that are written by hand, thing by thing, are files: module `file` (feature `scene-files`).

#[cfg(feature = "scene-files")]
pub mod file;

use simworld_core::spec::{SceneSpec, SpecError};
use thiserror::Error;

use crate::language::scenes::read;

/// What a sentence asks for.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SceneReading {
    /// As a spec, within its ranges.
    pub spec: SceneSpec,
    /// The words that were not understood, in order: nothing follows from them.
    pub unread: Vec<String>,
}

/// Why a sentence asks for no scene.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum SceneError {
    /// No word of it is about a scene.
    #[error("{words:?} asks for no scene: {hint}")]
    Nothing {
        /// What was said.
        words: String,
        /// What would.
        hint: String,
    },
    /// What it asks for is out of range.
    #[error(transparent)]
    Spec(#[from] SpecError),
    /// The model failed, or its answer cannot be used.
    #[error("a model was asked what {words:?} means, and its answer cannot be used: {fault}")]
    Model {
        /// What was said.
        words: String,
        /// What went wrong.
        fault: String,
    },
}

/// Reads sentences as specs of scenes.
pub trait SceneReader {
    /// The scene that a sentence asks for.
    ///
    /// # Errors
    /// It asks for none, or for what is out of range.
    fn read_scene(&mut self, words: &str) -> Result<SceneReading, SceneError>;
}

/// Reads by a grammar, without any model.
///
/// ```
/// use simworld_agents::scenes::{GrammarSceneReader, SceneReader};
/// use simworld_core::spec::Width;
/// let asked = "a harbour town with narrow streets, fifty buildings and a cathedral";
/// let reading = GrammarSceneReader.read_scene(asked)?;
/// assert_eq!((reading.spec.streets.width, reading.spec.buildings.count), (Width::Narrow, Some(50)));
/// assert_eq!(reading.unread, ["cathedral"]);
/// # Ok::<(), simworld_agents::scenes::SceneError>(())
/// ```
#[derive(Clone, Copy, Debug, Default)]
pub struct GrammarSceneReader;

impl SceneReader for GrammarSceneReader {
    fn read_scene(&mut self, words: &str) -> Result<SceneReading, SceneError> {
        let reading = read(words).ok_or_else(|| SceneError::Nothing {
            words: words.chars().take(200).collect(),
            hint: "say what kind of place: a town with so many houses, how its streets are, what it has, and the weather".to_owned(),
        })?;
        reading.spec.validate()?;
        Ok(reading)
    }
}
