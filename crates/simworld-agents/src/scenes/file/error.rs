//! What is wrong with a scene file: where, what, and how to mend it.

use std::fmt;

use simworld_core::environment::{EnvironmentError, UnknownPreset};
use simworld_core::scene::WorldError;
use simworld_core::spec::SpecError;
use thiserror::Error;

use super::place::PlaceError;
use crate::editing::EditError;

/// So many problems are listed; the others are counted.
pub const MOST_LISTED: usize = 1000;

/// Why a scene file gives no scene.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum SceneFileError {
    /// The file cannot be read or written.
    #[error("{path}: {error}")]
    Io {
        /// Which.
        path: String,
        /// Why not.
        error: std::io::Error,
    },
    /// The file is larger than allowed.
    #[error("{path} has more than {limit} bytes: divide the scene into several files")]
    Large {
        /// Which.
        path: String,
        /// What is allowed.
        limit: u64,
    },
    /// The text is no scene file: no TOML, a key that is none, or a value of another kind.
    #[error("{at}: {why}")]
    Form {
        /// Where.
        at: Where,
        /// What is wrong and how to mend it.
        why: String,
    },
    /// The text is a scene file, and asks for what cannot be: everything that is wrong with it, at once.
    #[error("{0}")]
    Refused(Problems),
    /// The place, or its streets, cannot be made.
    #[error("{at}: the place cannot be made: {error}")]
    Place {
        /// Where it is asked for.
        at: Where,
        /// Why not.
        error: PlaceError,
    },
    /// The scene cannot be written as text.
    #[error("the scene cannot be written: {why}")]
    Write {
        /// Why not.
        why: String,
    },
}

/// A place in a scene file.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Where {
    /// The file, if it was read from one.
    pub file: Option<String>,
    /// Its line, from 1, if it was read.
    pub line: Option<usize>,
    /// The table or the row, such as `[[thing]] 3 (bench "left bench")`; empty for the file as a whole.
    pub row: String,
}

impl fmt::Display for Where {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.file.as_deref().unwrap_or("scene"))?;
        if let Some(line) = self.line {
            write!(f, ":{line}")?;
        }
        if self.row.is_empty() { Ok(()) } else { write!(f, ": {}", self.row) }
    }
}

/// Something that is wrong, and where.
#[derive(Clone, Debug, PartialEq, Error)]
#[error("{at}: {fault}")]
pub struct Problem {
    /// Where.
    pub at: Where,
    /// What, and how to mend it.
    pub fault: Fault,
}

/// What can be wrong. Those from [`Fault::Penetrates`] on are about how things stand: they are placed as they are written, and the
/// scene is there all the same.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum Fault {
    /// A number out of range.
    #[error("{key} = {value:?} is out of range: give {allowed}")]
    Number {
        /// The key.
        key: &'static str,
        /// The refused value.
        value: f64,
        /// What is allowed, in words.
        allowed: &'static str,
    },
    /// A text that is none.
    #[error("{key} = {value:?} {why}")]
    Text {
        /// The key.
        key: &'static str,
        /// The refused value, or the beginning of it.
        value: String,
        /// Why, and what to give instead.
        why: &'static str,
    },
    /// Keys that do not go together, or one that is missing beside another.
    #[error("{0}")]
    Keys(&'static str),
    /// Too many of something.
    #[error("{count} {what}: give at most {most}, or divide the scene into several files")]
    TooMany {
        /// Of what.
        what: &'static str,
        /// How many there are.
        count: u64,
        /// How many are allowed.
        most: u64,
    },
    /// Nothing of the library is called that.
    #[error("no asset is called {name:?}: {}", instead(.near, "name one of the library, or add the library that has it"))]
    UnknownAsset {
        /// What was asked for.
        name: String,
        /// Names that are like it, the likest first.
        near: Vec<String>,
    },
    /// Two things have one name.
    #[error("{name:?} is the name of {other} already: give each thing a name of its own")]
    Taken {
        /// The name.
        name: String,
        /// Who has it.
        other: String,
    },
    /// It is to stand on a thing that the file does not have.
    #[error("no thing of this file is called {name:?}: {}", instead(.near, "give the thing that it stands on a name"))]
    UnknownSupport {
        /// What it is to stand on.
        name: String,
        /// Names that are like it, the likest first.
        near: Vec<String>,
    },
    /// Things stand on each other in a circle.
    #[error("{} stand on each other in a circle: let one of them stand on the ground", .things.join(", "))]
    Circle {
        /// All of them, each on the next and the last on the first.
        things: Vec<String>,
    },
    /// Two streets touch where they have no point in common.
    #[error(
        "it meets {other} at ({x:.2}, {y:.2}): write one point there into both, or keep them a metre apart"
    )]
    Touches {
        /// The other street.
        other: String,
        /// East, m.
        x: f64,
        /// North, m.
        y: f64,
    },
    /// A street that cannot be built.
    #[error("the street {0}")]
    Street(String),
    /// A sentence that was not carried out.
    #[error("{words:?} was not carried out: {answer}")]
    Said {
        /// The sentence.
        words: String,
        /// The answer of the editor.
        answer: Box<EditError>,
    },
    /// A weather that is none.
    #[error(transparent)]
    Weather(#[from] UnknownPreset),
    /// Sun or weather out of range.
    #[error(transparent)]
    Environment(#[from] EnvironmentError),
    /// A wish out of range.
    #[error(transparent)]
    Spec(#[from] SpecError),
    /// The world refused it.
    #[error(transparent)]
    World(#[from] WorldError),
    /// Two things share space.
    #[error("it shares space with {other}, {depth:.3} m deep: move one of them by as much, or leave one out")]
    Penetrates {
        /// The other.
        other: String,
        /// The least way by which one of them is free of the other, m.
        depth: f64,
    },
    /// Nothing holds it up.
    #[error(
        "it hangs {gap:.3} m above {below}: leave out the third number of at, or name what it stands on with on"
    )]
    Hangs {
        /// What is nearest below it.
        below: String,
        /// Between the two, m.
        gap: f64,
    },
    /// It is sunk into the ground.
    #[error("it is sunk {depth:.3} m into {into}: leave out the third number of at, or give more")]
    Sunk {
        /// Into what.
        into: String,
        /// How deep, m.
        depth: f64,
    },
    /// Its middle is not above what it is to stand on.
    #[error(
        "its middle is {by:.3} m beside {support}, on which it is to stand: leave at out, or give a point above it"
    )]
    Beside {
        /// What it is to stand on.
        support: String,
        /// From the edge of that to its middle, m.
        by: f64,
    },
    /// What it is to stand on has no level top.
    #[error("{support}, on which it is to stand, has no level top: let it stand on something else")]
    NoTop {
        /// What it is to stand on.
        support: String,
    },
    /// There is no ground at all below it.
    #[error("no ground is below it: move it, or make the ground larger")]
    NoGround,
}

/// Names to give instead, or what to do if there are none.
fn instead(near: &[String], otherwise: &str) -> String {
    if near.is_empty() { otherwise.to_owned() } else { format!("perhaps {}", near.join(", ")) }
}

/// Everything that is wrong, in the order in which it was found: what is about the whole file, then row by row.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Problems {
    /// The first [`MOST_LISTED`] of them.
    pub list: Vec<Problem>,
    /// How many more there are.
    pub more: usize,
}

impl Problems {
    /// Whether nothing is wrong.
    pub fn is_empty(&self) -> bool {
        self.list.is_empty()
    }

    /// How many there are.
    pub fn count(&self) -> usize {
        self.list.len() + self.more
    }

    /// Those that are listed.
    pub fn iter(&self) -> impl Iterator<Item = &Problem> {
        self.list.iter()
    }

    pub(super) fn push(&mut self, at: Where, fault: impl Into<Fault>) {
        if self.list.len() < MOST_LISTED {
            self.list.push(Problem { at, fault: fault.into() });
        } else {
            self.more += 1;
        }
    }

    /// This, or the list as an error if there is one.
    pub(super) fn none_or<T>(self, value: T) -> Result<T, SceneFileError> {
        if self.is_empty() { Ok(value) } else { Err(SceneFileError::Refused(self)) }
    }
}

impl fmt::Display for Problems {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.list[..] {
            [] => return f.write_str("nothing is wrong"),
            [only] if self.more == 0 => return only.fmt(f),
            list => write!(f, "{} problems:", list.len() + self.more)?,
        }
        for problem in &self.list {
            write!(f, "\n  {problem}")?;
        }
        if self.more > 0 { write!(f, "\n  and {} more", self.more) } else { Ok(()) }
    }
}
