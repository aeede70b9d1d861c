//! Whole scenes by words: "a small harbour town with narrow streets, fifty buildings, a market square and light rain" as a
//! [`SceneSpec`], which the city generator makes.
//!
//! [`GrammarSceneReader`] reads the same way every time and says which words it did not understand;
//! [`ModelSceneReader`](crate::thought::ModelSceneReader) asks a model for the same spec. What was understood and cannot be so is
//! told by a [`SceneRemark`].
//!
//! Scenes that are written by hand, thing by thing, are files: module `file` (feature `scene-files`).

#[cfg(feature = "scene-files")]
pub mod file;

use simworld_core::spec::{SceneKind, SceneSpec, SpecError};
use thiserror::Error;

use crate::language::scenes::read;

/// What a sentence asks for.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SceneReading {
    /// As a spec, within its ranges.
    pub spec: SceneSpec,
    /// The words from which nothing follows, in order.
    pub unread: Vec<String>,
    /// What was understood, and is left out or otherwise than it was asked for.
    pub remarks: Vec<SceneRemark>,
}

/// What a sentence asks for and its scene does not have.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum SceneRemark {
    /// No place of that kind has it.
    #[error("{what}: no {kind} has it; say {instead}, if you want it")]
    Unsuited {
        /// What was asked for.
        what: String,
        /// The kind of place.
        kind: &'static str,
        /// A kind that has it.
        instead: &'static str,
    },
    /// It is there, and not where it was asked for.
    #[error("{what}: not {place}, since {why}")]
    Unplaced {
        /// What was asked for.
        what: String,
        /// Where.
        place: String,
        /// Why it cannot be there.
        why: &'static str,
    },
}

/// Takes out of a spec what its kind of place does not have, and says so.
pub(crate) fn suited(spec: &mut SceneSpec) -> Vec<SceneRemark> {
    if spec.kind == SceneKind::City {
        return Vec::new();
    }
    let (kind, instead) = (spec.kind.as_str(), SceneKind::City.as_str());
    let districts = std::mem::take(&mut spec.features.districts).into_iter().map(|district| {
        let what = format!("{} district", district.kind.as_str().replace('_', " "));
        SceneRemark::Unsuited { what, kind, instead }
    });
    let sites = std::mem::take(&mut spec.features.sites).into_iter().map(|site| {
        let by = site.by.map(|by| format!("by the {by}"));
        let place = by.unwrap_or_else(|| format!("in the {}", site.at.as_str()));
        let why = "beyond the city everything is where the land has room for it";
        SceneRemark::Unplaced { what: site.what.replace('_', " "), place: place.replace('_', " "), why }
    });
    districts.chain(sites).collect()
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
/// let asked = "a harbour town with narrow streets, fifty buildings, a cathedral in the middle and a dragon";
/// let reading = GrammarSceneReader.read_scene(asked)?;
/// assert_eq!((reading.spec.streets.width, reading.spec.buildings.count), (Width::Narrow, Some(50)));
/// assert_eq!(reading.spec.features.landmarks["cathedral"], 1);
/// assert_eq!(reading.unread, ["dragon"]);
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
