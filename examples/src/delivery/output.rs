//! The folder that a run writes to.

use std::path::{Path, PathBuf};

use simworld_core::seed::Seed;
use thiserror::Error;

/// Why the folder cannot be used.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum OutputError {
    /// It holds something already.
    #[error("{path} holds something already: give another folder with --out, or empty this one")]
    NotEmpty {
        /// The folder.
        path: PathBuf,
    },
    /// It cannot be written to.
    #[error("cannot write to {path}: {source}; give a folder you may write to with --out")]
    NotWritable {
        /// The file or folder.
        path: PathBuf,
        /// Why not.
        source: std::io::Error,
    },
}

/// A folder for one run, made anew.
#[derive(Clone, Debug)]
pub struct OutputFolder {
    path: PathBuf,
}

impl OutputFolder {
    /// Makes the folder, with those above it; an empty one may exist.
    ///
    /// # Errors
    /// It holds something, or cannot be made.
    pub fn create(path: &Path) -> Result<Self, OutputError> {
        let fail = |source| OutputError::NotWritable { path: path.to_owned(), source };
        std::fs::create_dir_all(path).map_err(fail)?;
        if std::fs::read_dir(path).map_err(fail)?.next().is_some() {
            return Err(OutputError::NotEmpty { path: path.to_owned() });
        }
        let probe = path.join(".probe");
        std::fs::write(&probe, []).and_then(|()| std::fs::remove_file(&probe)).map_err(fail)?;
        Ok(Self { path: path.to_owned() })
    }

    /// Goes on in a folder that is there.
    ///
    /// # Errors
    /// It is not there, or cannot be written to.
    pub fn open(path: &Path) -> Result<Self, OutputError> {
        let probe = path.join(".probe");
        let fail = |source| OutputError::NotWritable { path: path.to_owned(), source };
        std::fs::write(&probe, []).and_then(|()| std::fs::remove_file(&probe)).map_err(fail)?;
        Ok(Self { path: path.to_owned() })
    }

    /// Makes the first folder `stem-1`, `stem-2` ... that does not exist yet or is empty: what a run without `--out` uses.
    ///
    /// # Errors
    /// None can be made.
    pub fn create_numbered(stem: &str) -> Result<Self, OutputError> {
        let is_free =
            |path: &PathBuf| std::fs::read_dir(path).map_or(!path.exists(), |mut held| held.next().is_none());
        let path = (1..u32::MAX).map(|n| PathBuf::from(format!("{stem}-{n}"))).find(is_free);
        Self::create(&path.unwrap_or_else(|| PathBuf::from(stem)))
    }

    /// The folder.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Makes the folder of one seed.
    ///
    /// # Errors
    /// It cannot be made.
    pub fn seed_folder(&self, seed: Seed) -> Result<PathBuf, OutputError> {
        let path = self.path.join(format!("seed-{}", seed.0));
        std::fs::create_dir_all(&path)
            .map_err(|source| OutputError::NotWritable { path: path.clone(), source })?;
        Ok(path)
    }

    /// Writes a file of the folder.
    ///
    /// # Errors
    /// The disk is full, or the folder went away.
    pub fn write(&self, name: impl AsRef<Path>, contents: impl AsRef<[u8]>) -> Result<PathBuf, OutputError> {
        let path = self.path.join(name);
        std::fs::write(&path, contents)
            .map_err(|source| OutputError::NotWritable { path: path.clone(), source })?;
        Ok(path)
    }
}
