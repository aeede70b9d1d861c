//! Where the bytes of a saved city come from: memory, or a file of which a section at a time is read.

use std::borrow::Cow;
use std::fs::File;
use std::io::{Read, Seek, SeekFrom};
use std::path::Path;
use std::sync::{Mutex, PoisonError};

use super::{MOST_BYTES, SaveError};

/// Bytes that several threads may ask for.
pub(super) enum Source<'a> {
    Bytes(&'a [u8]),
    File {
        file: Mutex<File>,
        /// Its length when it was opened.
        length: u64,
    },
}

impl<'a> Source<'a> {
    pub(super) fn file(path: &Path) -> Result<Self, SaveError> {
        let file = File::open(path)?;
        let length = file.metadata()?.len();
        if length > MOST_BYTES {
            return Err(SaveError::TooLarge { bytes: length });
        }
        Ok(Self::File { file: Mutex::new(file), length })
    }

    pub(super) fn len(&self) -> u64 {
        match self {
            Self::Bytes(bytes) => bytes.len() as u64,
            Self::File { length, .. } => *length,
        }
    }

    /// So many bytes from `start` on. Both must lie within the length, unless the file has changed since.
    pub(super) fn read(&self, start: u64, length: u64) -> Result<Cow<'a, [u8]>, SaveError> {
        match self {
            Self::Bytes(bytes) => Ok(Cow::Borrowed(&bytes[start as usize..(start + length) as usize])),
            Self::File { file, .. } => {
                let mut bytes = vec![0; length as usize];
                // A thread that panicked while it held the file left nothing half done: every read seeks first.
                let mut file = file.lock().unwrap_or_else(PoisonError::into_inner);
                file.seek(SeekFrom::Start(start))?;
                file.read_exact(&mut bytes)?;
                Ok(Cow::Owned(bytes))
            }
        }
    }
}
