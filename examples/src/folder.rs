//! The folder that an example writes to.

use std::path::{Path, PathBuf};

use thiserror::Error;

/// Why there is no folder to write to.
#[derive(Debug, Error)]
#[error("the folder {} cannot be made: {source}; give another, that can be written to", path.display())]
pub struct FolderError {
    /// Which folder.
    pub path: PathBuf,
    /// Why.
    pub source: std::io::Error,
}

/// Makes a folder, and those that it is in, unless it is there.
///
/// # Errors
/// A path where no folder can be made.
pub fn make_folder(path: &Path) -> Result<(), FolderError> {
    std::fs::create_dir_all(path).map_err(|source| FolderError { path: path.to_owned(), source })
}
