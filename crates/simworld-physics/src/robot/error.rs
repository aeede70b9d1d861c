//! What can be wrong with a robot.

use simworld_core::asset::ModelError;
use thiserror::Error;

/// Why a description, or a file with one, is no robot: what is wrong, where, and how to mend it.
///
/// Places are links and joints by name, and in files lines and columns, counted from 1.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum RobotError {
    /// A number that no robot has.
    #[error("{place}: {field} = {value} is out of range: give {allowed}")]
    Value {
        /// Which link, joint or element.
        place: String,
        /// What of it.
        field: &'static str,
        /// Its value.
        value: f64,
        /// What is allowed, in words.
        allowed: &'static str,
    },
    /// Two things of one name.
    #[error("two {kind} are called {name:?}: rename one of them")]
    Duplicate {
        /// Links or joints.
        kind: &'static str,
        /// The name.
        name: String,
    },
    /// A name that nothing has.
    #[error("{place} names the {kind} {name:?}, which is not there: add it or correct the name")]
    Unknown {
        /// Who names it.
        place: String,
        /// Link or joint.
        kind: &'static str,
        /// The name.
        name: String,
    },
    /// A link that hangs on two joints.
    #[error(
        "link {link:?} hangs on the joints {first:?} and {second:?}: a robot is a tree, so take one of them out"
    )]
    TwoParents {
        /// The link.
        link: String,
        /// The joint that was there first.
        first: String,
        /// The other one.
        second: String,
    },
    /// Not exactly one link that everything hangs on.
    #[error("{found} links hang on nothing ({names}): join them, so that exactly one is left")]
    Roots {
        /// How many there are.
        found: usize,
        /// The first of them.
        names: String,
    },
    /// Links that hang on one another.
    #[error("link {link:?} hangs on itself, by way of its joints: take one of them out")]
    Cycle {
        /// One of them.
        link: String,
    },
    /// More than is worked with.
    #[error("{place}: {found} {what} are too many: at most {most} are taken")]
    TooMany {
        /// Where.
        place: String,
        /// Of what.
        what: &'static str,
        /// How many there are, or how many were counted until it was enough.
        found: usize,
        /// How many may be.
        most: usize,
    },
    /// No XML.
    #[error("it is no XML: {reason}")]
    Xml {
        /// What the parser says, with line and column.
        reason: String,
    },
    /// Something that has to be there.
    #[error("{place}: {what} is missing: {mend}")]
    Missing {
        /// Where.
        place: String,
        /// What.
        what: String,
        /// What to do.
        mend: &'static str,
    },
    /// A text that is not what it should be.
    #[error("{place}: {attribute} = {value:?} cannot be read: give {allowed}")]
    Text {
        /// Where.
        place: String,
        /// Which attribute.
        attribute: String,
        /// Its text, shortened.
        value: String,
        /// What is allowed, in words.
        allowed: &'static str,
    },
    /// Something that this reader does not do.
    #[error("{place}: {what} is not understood: {mend}")]
    Unsupported {
        /// Where.
        place: String,
        /// What.
        what: String,
        /// What to do.
        mend: &'static str,
    },
    /// What is to be seen is no surface.
    #[error("{place}: what is seen of it is no surface: {error}")]
    Model {
        /// Which link.
        place: String,
        /// Why.
        error: ModelError,
    },
    /// A file that cannot be had.
    #[error("{path}: {reason}")]
    File {
        /// Which file.
        path: String,
        /// Why.
        reason: String,
    },
}

/// Checks that a number lies in a range; NaN lies in none.
pub(super) fn check(
    place: &dyn Fn() -> String,
    field: &'static str,
    value: f64,
    range: std::ops::RangeInclusive<f64>,
    allowed: &'static str,
) -> Result<(), RobotError> {
    if range.contains(&value) {
        Ok(())
    } else {
        Err(RobotError::Value { place: place(), field, value, allowed })
    }
}
