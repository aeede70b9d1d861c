//! The files of the Python release: `roads.json`, `buildings.json`, `elements.json`, `routes.json` and the world file
//! `progen_world.json`.
//!
//! Coordinates are metres, rounded to four decimals; rotations are degrees. Reading never panics: what cannot be used is a
//! typed error, what can be mended is mended and named in a warning.

mod clean;
mod files;
mod layout;
mod world;

use std::fmt;

pub use clean::plan_from_roads;
pub use files::{
    BuildingRecord, BuildingsFile, ElementRecord, ElementsFile, RoadRecord, RoadsFile, RouteRecord,
    RoutesFile, Xy,
};
pub use layout::LayoutError;
use serde::Serialize;
use serde::de::DeserializeOwned;
use simworld_core::net::StreetPlan;
use thiserror::Error;
pub use world::{BaseMap, NodeProperties, Orientation, WorldFile, WorldNode, Xyz};

use crate::City;

/// Files larger than this are refused, bytes.
const MOST_BYTES: usize = 256 << 20;

/// Why a file cannot be read.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum FormatError {
    /// The text is no JSON of this format.
    #[error("at {path}: {source}")]
    Json {
        /// The place in the document, such as `roads[3].start.x`.
        path: String,
        /// What is wrong there.
        source: serde_json::Error,
    },
    /// The file is too large.
    #[error("{bytes} bytes are more than the {MOST_BYTES} allowed: split the file")]
    TooLarge {
        /// Its size.
        bytes: usize,
    },
    /// A number that is no coordinate.
    #[error("{path} = {value} is out of range: give metres within ±1e6")]
    Coordinate {
        /// The place in the document.
        path: String,
        /// The number.
        value: f64,
    },
    /// More road than can be checked in reasonable time and memory.
    #[error(
        "the roads are too many, too long or too dense: {what} {amount} is above {limit}; split the file"
    )]
    TooMuch {
        /// What there is too much of.
        what: &'static str,
        /// How much there is.
        amount: u64,
        /// How much is allowed.
        limit: u64,
    },
    /// Nothing is left to build on.
    #[error("the file holds no usable road: give at least one of {least} m or more")]
    Empty {
        /// The shortest usable road, m.
        least: f64,
    },
}

/// Something in a file that was mended.
#[derive(Clone, Debug, PartialEq)]
pub struct Warning {
    /// The road of the file it concerns, if one.
    pub road: Option<usize>,
    /// What was done and why.
    pub message: String,
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.road {
            Some(road) => write!(f, "roads[{road}]: {}", self.message),
            None => f.write_str(&self.message),
        }
    }
}

/// Reads a `roads.json` into a plan of streets that meet only at nodes and are all connected.
///
/// ```
/// let file = br#"{"roads": [
///     {"start": {"x": -200, "y": 0}, "end": {"x": 0, "y": 0}, "is_highway": false},
///     {"start": {"x": 0, "y": 0}, "end": {"x": 0, "y": 200}, "is_highway": true}
/// ]}"#;
/// let (plan, warnings) = simworld_citygen::python::read_roads(file)?;
/// assert_eq!((plan.nodes.len(), plan.streets.len()), (3, 2));
/// assert!(warnings.is_empty());
/// # Ok::<(), simworld_citygen::python::FormatError>(())
/// ```
///
/// # Errors
/// Bytes that are no such file, coordinates out of range, or no usable road.
pub fn read_roads(bytes: &[u8]) -> Result<(StreetPlan, Vec<Warning>), FormatError> {
    plan_from_roads(&read::<RoadsFile>(bytes)?)
}

/// Reads the roads of a `progen_world.json` into a plan.
///
/// # Errors
/// Bytes that are no such file, coordinates out of range, or no usable road.
pub fn read_world(bytes: &[u8]) -> Result<(StreetPlan, Vec<Warning>), FormatError> {
    plan_from_roads(&read::<WorldFile>(bytes)?.roads())
}

/// Reads any of the files.
///
/// # Errors
/// Bytes that are no such file.
pub fn read<T: DeserializeOwned>(bytes: &[u8]) -> Result<T, FormatError> {
    if bytes.len() > MOST_BYTES {
        return Err(FormatError::TooLarge { bytes: bytes.len() });
    }
    let mut deserializer = serde_json::Deserializer::from_slice(bytes);
    let value = serde_path_to_error::deserialize(&mut deserializer)
        .map_err(|error| FormatError::Json { path: error.path().to_string(), source: error.into_inner() })?;
    deserializer
        .end()
        .map_err(|source| FormatError::Json { path: "the end of the file".to_owned(), source })?;
    Ok(value)
}

/// Writes any of the files.
pub fn write<T: Serialize>(file: &T) -> String {
    // Plain structures of numbers and strings; numbers that are not finite become null, as in the Python release.
    serde_json::to_string_pretty(file).expect("plain structures serialise")
}

impl City {
    /// The city's streets, as `roads.json` holds them.
    pub fn roads_file(&self) -> RoadsFile {
        RoadsFile::of(self)
    }

    /// The city's buildings, as `buildings.json` holds them.
    pub fn buildings_file(&self) -> BuildingsFile {
        BuildingsFile::of(self)
    }

    /// The city's street elements, as `elements.json` holds them.
    pub fn elements_file(&self) -> ElementsFile {
        ElementsFile::of(self)
    }
}
