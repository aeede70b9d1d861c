//! What the schemas of answers have no words for.

use thiserror::Error;

/// Something that no answer of a model can say.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("no answer can say {what}")]
pub struct Unsayable {
    /// What it is.
    pub what: String,
}

impl Unsayable {
    pub(super) fn new(what: impl Into<String>) -> Self {
        Self { what: what.into() }
    }
}
