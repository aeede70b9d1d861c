//! Why a file is no SUMO file, and what of one that is has no counterpart here.

use std::borrow::Cow;
use std::fmt;
use std::io;

use simworld_core::net::NetworkFault;
use thiserror::Error;

/// Why a SUMO file cannot be read.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum SumoError {
    /// The file cannot be opened or read.
    #[error("the file cannot be read: {0}")]
    Io(#[from] io::Error),
    /// The text is no XML, or another kind of document.
    #[error("no SUMO file, at byte {offset}: {reason}")]
    Xml {
        /// Where in the text.
        offset: u64,
        /// What is wrong there.
        reason: String,
    },
    /// An attribute that is missing, or that says nothing sensible.
    #[error("{element} `{id}`: attribute `{attribute}` {reason}")]
    Attribute {
        /// The element.
        element: String,
        /// Its id, if it has one.
        id: String,
        /// The attribute.
        attribute: &'static str,
        /// What is wrong with it.
        reason: Cow<'static, str>,
    },
    /// A reference to something that is not in the file.
    #[error(
        "{element} `{id}` names {what} `{target}`, which is not there: write the file anew with netconvert"
    )]
    Dangling {
        /// The element.
        element: &'static str,
        /// Its id.
        id: String,
        /// What it names.
        what: &'static str,
        /// The id of that.
        target: String,
    },
    /// Internal lanes that lead in a circle.
    #[error("connection from lane `{lane}`: its internal lanes never leave the junction")]
    Circle {
        /// The lane it leaves.
        lane: String,
    },
    /// An id that is given twice.
    #[error("{element} `{id}` is there twice: give every one its own id")]
    Twice {
        /// The element.
        element: &'static str,
        /// Its id.
        id: String,
    },
    /// More than is read.
    #[error("{what} are more than the {limit} that are read: cut out a part with netconvert")]
    TooMuch {
        /// What there is too much of.
        what: &'static str,
        /// How much is allowed.
        limit: u64,
    },
    /// Nothing to drive on.
    #[error("the file holds no edge with lanes: give a network written by netconvert or netgenerate")]
    Empty,
    /// Something that cannot be built.
    #[error("the network does not hold together: {0}")]
    Network(#[from] NetworkFault),
}

/// Something of a file that has no counterpart here, or not quite.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct SumoWarning {
    /// The element.
    pub element: &'static str,
    /// Its id.
    pub id: String,
    /// What became of it.
    pub reason: Cow<'static, str>,
}

impl SumoWarning {
    pub(super) fn new(
        element: &'static str,
        id: impl Into<String>,
        reason: impl Into<Cow<'static, str>>,
    ) -> Self {
        Self { element, id: id.into(), reason: reason.into() }
    }
}

impl fmt::Display for SumoWarning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} `{}` {}", self.element, self.id, self.reason)
    }
}
