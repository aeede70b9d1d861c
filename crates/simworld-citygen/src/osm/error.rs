//! Why a file is no place, and what was mended in one that is.

use std::fmt;
use std::io;

use thiserror::Error;

/// Why a file cannot be read.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum OsmError {
    /// The file cannot be opened or read.
    #[error("the file cannot be read: {0}")]
    Io(#[from] io::Error),
    /// The text is no OSM XML.
    #[error("no OSM XML, at byte {offset}: {reason}; download the extract again")]
    Xml {
        /// Where, in the text before compression.
        offset: u64,
        /// What is wrong there.
        reason: String,
    },
    /// The bytes are no OSM PBF.
    #[error("no OSM PBF, in block {block}: {reason}; download the extract again")]
    Pbf {
        /// The number of the block, from 0.
        block: u64,
        /// What is wrong there.
        reason: &'static str,
    },
    /// The file needs something that is not known here.
    #[error(
        "the file needs the feature `{feature}`, which is not supported: convert it with another program"
    )]
    Feature {
        /// What it needs.
        feature: String,
    },
    /// More than is read.
    #[error("{what} are more than the {limit} that are read: cut out a smaller extract")]
    TooMuch {
        /// What there is too much of.
        what: &'static str,
        /// How much is allowed.
        limit: u64,
    },
    /// Nothing is in it.
    #[error("the file holds no node: give an extract with streets")]
    Empty,
}

/// An element of OpenStreetMap.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum OsmId {
    /// A point.
    Node(i64),
    /// A line or an area.
    Way(i64),
    /// A group of others.
    Relation(i64),
}

impl fmt::Display for OsmId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Node(id) => write!(f, "node {id}"),
            Self::Way(id) => write!(f, "way {id}"),
            Self::Relation(id) => write!(f, "relation {id}"),
        }
    }
}

/// Something odd in an extract, and what was made of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Warning {
    /// What it is and what was done, in words.
    pub what: String,
    /// The element, if it is one.
    pub element: Option<OsmId>,
    /// Where, longitude and latitude, degrees; if it is at one place.
    pub at: Option<[f64; 2]>,
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(element) = self.element {
            write!(f, "{element}: ")?;
        }
        f.write_str(&self.what)?;
        match self.at {
            Some([longitude, latitude]) => write!(f, " (at {latitude:.5}, {longitude:.5})"),
            None => Ok(()),
        }
    }
}
