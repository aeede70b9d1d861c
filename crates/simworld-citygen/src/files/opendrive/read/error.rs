//! Why a file is no OpenDRIVE, and what was mended in one that is.

use std::fmt;
use std::io;

use thiserror::Error;

/// Why a file cannot be read.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum OpenDriveError {
    /// The file cannot be opened or read.
    #[error("the file cannot be read: {0}")]
    Io(#[from] io::Error),
    /// The text is no XML.
    #[error("no XML: {0}; write the file anew")]
    Xml(#[from] roxmltree::Error),
    /// XML of another kind.
    #[error("the document is `{found}`, not `OpenDRIVE`: give an .xodr file")]
    Foreign {
        /// The name of its first element.
        found: String,
    },
    /// More than is read.
    #[error("the file has more than the {limit} bytes that are read: cut out a part of it")]
    TooMuch {
        /// How much is allowed.
        limit: u64,
    },
}

/// Something odd in a file, and what was made of it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct OpenDriveWarning {
    /// The number of the road, as the file has it; if it is one.
    pub road: Option<String>,
    /// What it is and what was done, in words.
    pub what: String,
}

impl OpenDriveWarning {
    pub(super) fn of(road: &str, what: impl Into<String>) -> Self {
        Self { road: Some(road.to_owned()), what: what.into() }
    }
}

impl fmt::Display for OpenDriveWarning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(road) = &self.road {
            write!(f, "road {road}: ")?;
        }
        f.write_str(&self.what)
    }
}
