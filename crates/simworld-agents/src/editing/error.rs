//! Why a scene is not edited as asked.

use simworld_core::command::CommandError;
use simworld_core::id::EntityId;
use thiserror::Error;

use super::relax::Relaxed;

/// Why a wish was not carried out; then the scene is as it was.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum EditError {
    /// The words make no sense here.
    #[error("cannot understand {words:?} at {fragment:?}: {hint}")]
    NotUnderstood {
        /// What was said.
        words: String,
        /// From where it makes no sense.
        fragment: String,
        /// What would.
        hint: String,
    },
    /// No such thing in the scene.
    #[error("there is no {wanted} here: {near}")]
    NotFound {
        /// What was looked for.
        wanted: String,
        /// What there is.
        near: String,
    },
    /// Several things fit, and nothing says which.
    #[error("which {wanted}? {}", list(.candidates))]
    Ambiguous {
        /// What was looked for.
        wanted: String,
        /// What fits, with what it is called, the nearest first.
        candidates: Vec<(EntityId, String)>,
    },
    /// Nothing like it in the catalogue.
    #[error("no {wanted:?} in the catalogue: {near}")]
    UnknownThing {
        /// What was asked for.
        wanted: String,
        /// What there is of the kind.
        near: String,
    },
    /// It fits nowhere in the relation that was asked for.
    #[error("no room for {what} {place}: {why}; {relaxed}")]
    NoRoom {
        /// What was to stand there.
        what: String,
        /// Where, in words.
        place: String,
        /// What was in the way, and how often.
        why: String,
        /// What would be possible instead, in words.
        relaxed: String,
        /// The same as it was found.
        instead: Box<Relaxed>,
    },
    /// It contradicts itself or the world.
    #[error("{what} is impossible: {why}")]
    Impossible {
        /// What was asked.
        what: String,
        /// Why not, and what to do instead.
        why: String,
    },
    /// The reader that was asked failed, or its answer cannot be used; the grammar did not understand the words.
    #[error(
        "{words:?} is not understood, and who was asked beside the grammar cannot say what it means: {fault}"
    )]
    Reader {
        /// What was said.
        words: String,
        /// What went wrong.
        fault: String,
    },
    /// The world refused a change.
    #[error(transparent)]
    Refused(#[from] CommandError),
}

impl EditError {
    /// With what a generator said of what it was to make and could not.
    pub(super) fn noting(self, notes: &[String]) -> Self {
        match self {
            Self::UnknownThing { wanted, near } if !notes.is_empty() => {
                Self::UnknownThing { wanted, near: format!("{near}; {}", notes.join("; ")) }
            }
            other => other,
        }
    }
}

fn list(candidates: &[(EntityId, String)]) -> String {
    let shown: Vec<String> = candidates.iter().take(8).map(|(id, label)| format!("{label} ({id})")).collect();
    let more = candidates.len().saturating_sub(shown.len());
    let rest = if more > 0 { format!(" or {more} more") } else { String::new() };
    format!("{}{rest}: say which, by its number, colour, place or \"the nearest\"", shown.join(", "))
}
