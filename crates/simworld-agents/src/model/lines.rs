//! Files of JSON, a value a line, that several agents write to.

use std::fs::{File, OpenOptions};
use std::io::{Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

use serde::Serialize;
use serde::de::DeserializeOwned;

use super::ModelError;

/// A file that is written line by line; each line is whole on its own, whoever writes.
pub(super) struct Lines {
    path: PathBuf,
    file: Mutex<File>,
}

impl Lines {
    /// A new file; one that is there is not touched.
    pub(super) fn create(path: &Path) -> Result<Self, ModelError> {
        let file = OpenOptions::new().write(true).create_new(true).open(path).map_err(|error| match error
            .kind()
        {
            std::io::ErrorKind::AlreadyExists => {
                store(path, &"the file is there already: choose another name")
            }
            _ => store(path, &error),
        })?;
        Ok(Self::of(path, file))
    }

    /// Reads a file, or makes an empty one, and goes on after its last whole line.
    ///
    /// A last line without its end was being written when the writer died: it is dropped.
    pub(super) fn open<T: DeserializeOwned>(path: &Path) -> Result<(Vec<T>, Self), ModelError> {
        let mut file = OpenOptions::new()
            .read(true)
            .write(true)
            .create(true)
            .truncate(false)
            .open(path)
            .map_err(|error| store(path, &error))?;
        let (values, whole) = parse(path, &std::fs::read(path).map_err(|error| store(path, &error))?)?;
        file.set_len(whole as u64).map_err(|error| store(path, &error))?;
        file.seek(SeekFrom::End(0)).map_err(|error| store(path, &error))?;
        Ok((values, Self::of(path, file)))
    }

    /// Reads a file that must be there, and leaves it as it is.
    pub(super) fn read<T: DeserializeOwned>(path: &Path) -> Result<Vec<T>, ModelError> {
        let bytes = std::fs::read(path).map_err(|error| store(path, &error))?;
        parse(path, &bytes).map(|(values, _)| values)
    }

    /// Writes one line, at once.
    pub(super) fn append(&self, value: &impl Serialize) -> Result<(), ModelError> {
        let mut line = serde_json::to_vec(value).map_err(|error| store(&self.path, &error))?;
        line.push(b'\n');
        let mut file = self.file.lock().unwrap_or_else(PoisonError::into_inner);
        file.write_all(&line).map_err(|error| store(&self.path, &error))
    }

    pub(super) fn path(&self) -> &Path {
        &self.path
    }

    fn of(path: &Path, file: File) -> Self {
        Self { path: path.to_owned(), file: Mutex::new(file) }
    }
}

/// The values of all whole lines, and how many bytes those are.
fn parse<T: DeserializeOwned>(path: &Path, bytes: &[u8]) -> Result<(Vec<T>, usize), ModelError> {
    let whole = bytes.iter().rposition(|byte| *byte == b'\n').map_or(0, |last| last + 1);
    let mut values = Vec::new();
    for (index, line) in bytes[..whole].split_inclusive(|byte| *byte == b'\n').enumerate() {
        let value = serde_json::from_slice(line)
            .map_err(|error| store(path, &format!("line {}: {error}: mend or remove the line", index + 1)))?;
        values.push(value);
    }
    Ok((values, whole))
}

fn store(path: &Path, reason: &impl ToString) -> ModelError {
    ModelError::Store { path: path.display().to_string(), reason: reason.to_string() }
}
