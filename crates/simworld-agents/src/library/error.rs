//! Why a folder of assets is refused.

use simworld_core::asset::{AssetError, ContentId};
use thiserror::Error;

use crate::assets::ImportError;

/// Why a folder of assets is refused; then nothing of it is taken.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum LibraryError {
    /// A file cannot be read.
    #[error("{path}: {error}")]
    Io {
        /// Which.
        path: String,
        /// Why not.
        error: std::io::Error,
    },
    /// A file, or all of them together, are larger than allowed.
    #[error("{path} has more than {limit} bytes: make it smaller, or raise `LibraryLimits`")]
    Large {
        /// Which file.
        path: String,
        /// What is allowed.
        limit: u64,
    },
    /// The manifest is none.
    #[error("{file}:{line}: {why}")]
    Manifest {
        /// The file.
        file: String,
        /// Its line, from 1.
        line: usize,
        /// What is wrong and how to mend it.
        why: String,
    },
    /// A path leads out of the folder, or to what is no file.
    #[error("{file}:{line}: {path:?} is refused: {why}")]
    Path {
        /// The manifest.
        file: String,
        /// Its line, from 1.
        line: usize,
        /// The path.
        path: String,
        /// Why, and what to give instead.
        why: &'static str,
    },
    /// A model is none.
    #[error("{file}:{line}: {path}: {error}")]
    Import {
        /// The manifest.
        file: String,
        /// Its line, from 1.
        line: usize,
        /// The file of the model.
        path: String,
        /// What is wrong with it.
        error: Box<ImportError>,
    },
    /// An asset is none.
    #[error("{file}:{line}: {error}")]
    Asset {
        /// The manifest.
        file: String,
        /// Its line, from 1.
        line: usize,
        /// What is wrong with it.
        error: Box<AssetError>,
    },
    /// A file is not what the lock says.
    #[error(
        "{path} is {got} and the lock says {wanted}: put the file back that was locked, or write the lock anew if it was \
         changed on purpose"
    )]
    Changed {
        /// Which file.
        path: String,
        /// What the lock says.
        wanted: ContentId,
        /// What it is.
        got: ContentId,
    },
    /// The lock and the manifest name different files.
    #[error("{path} is in the {has} and not in the {lacks}: write the lock anew if that is on purpose")]
    Unlocked {
        /// Which file.
        path: String,
        /// What names it.
        has: &'static str,
        /// What does not.
        lacks: &'static str,
    },
}
