//! Who reads what the grammar does not: the seam for readers of edits, such as a model.

use std::fmt;
use std::sync::{Arc, Mutex, PoisonError};

use simworld_core::asset::Catalogue;
use simworld_core::geometry::Point2;
use simworld_core::id::EntityId;
use simworld_core::scene::Scene;

use super::edit::Edit;
use super::error::EditError;

/// A sentence, and the scene that it is about.
#[derive(Clone, Copy)]
pub struct Asked<'a> {
    /// The sentence.
    pub words: &'a str,
    /// The scene as it is.
    pub scene: &'a dyn Scene,
    /// What can be added.
    pub catalogue: &'a Catalogue,
    /// From where the scene is looked at, m.
    pub from: Point2,
    /// Who looks, if somebody in the scene does; no part of what is edited.
    pub who: Option<EntityId>,
    /// What was spoken of last.
    pub it: Option<EntityId>,
}

/// Reads sentences as edits.
pub trait EditReader: Send {
    /// The edits that a sentence means, at least one.
    ///
    /// # Errors
    /// It means none, or the reader failed.
    fn read(&mut self, asked: &Asked<'_>) -> Result<Vec<Edit>, EditError>;
}

/// Who understood a sentence.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ReadBy {
    /// The grammar, which is always asked first.
    #[default]
    Grammar,
    /// The reader of [`SceneEditor::with_reader`](super::SceneEditor::with_reader).
    Reader,
}

/// A reader that the copies of an editor share.
#[derive(Clone)]
pub(super) struct Shared(Arc<Mutex<dyn EditReader>>);

impl Shared {
    pub(super) fn new(reader: impl EditReader + 'static) -> Self {
        Self(Arc::new(Mutex::new(reader)))
    }

    pub(super) fn read(&self, asked: &Asked<'_>) -> Result<Vec<Edit>, EditError> {
        // A reader that panicked once may answer the next sentence.
        self.0.lock().unwrap_or_else(PoisonError::into_inner).read(asked)
    }
}

impl fmt::Debug for Shared {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a reader")
    }
}

/// Whether a reader may do better: the words were not understood. What is there twice, or does not fit, is so for every reader.
pub(super) const fn is_open(error: &EditError) -> bool {
    matches!(error, EditError::NotUnderstood { .. } | EditError::UnknownThing { .. })
}
