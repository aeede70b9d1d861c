//! Whole scenes as they are asked for: what kind of place, how its streets and houses are, what it has, and its weather.
//!
//! A spec says what is wished for and no more; who makes the scene chooses the rest. It is a file format too, written by hand
//! or by who reads sentences: any serde format will do, TOML is meant.
//!
//! ```toml
//! version = 1
//! kind = "city"
//! title = "Harbour town"
//! [streets]
//! width = "narrow"
//! [buildings]
//! count = 50
//! [features]
//! squares = ["Market Square"]
//! waters = ["harbour"]
//! [features.places]
//! museum = 1
//! ```

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::environment::{Environment, EnvironmentError};
use crate::scene::Place;

/// The version of the format that is written.
pub const VERSION: u32 = 1;

/// A scene as it is asked for.
///
/// ```
/// use simworld_core::spec::{SceneSpec, Width};
/// let mut spec = SceneSpec::default();
/// spec.buildings.count = Some(50);
/// spec.streets.width = Width::Narrow;
/// assert!(spec.validate().is_ok());
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct SceneSpec {
    /// The version of the format: 1.
    pub version: u32,
    /// What kind of place.
    pub kind: SceneKind,
    /// What it is called.
    pub title: Option<String>,
    /// Its streets.
    pub streets: StreetWish,
    /// Its houses.
    pub buildings: BuildingWish,
    /// What else it has.
    pub features: FeatureWish,
    /// Sun and weather.
    pub environment: Environment,
}

impl Default for SceneSpec {
    fn default() -> Self {
        Self {
            version: VERSION,
            kind: SceneKind::City,
            title: None,
            streets: StreetWish::default(),
            buildings: BuildingWish::default(),
            features: FeatureWish::default(),
            environment: Environment::default(),
        }
    }
}

/// What kind of place. Who makes scenes says which it can make.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum SceneKind {
    /// Streets and houses, from a hamlet to a large city.
    #[default]
    City,
    /// Fields, paths and a few houses.
    Countryside,
    /// No houses and no streets.
    Wilderness,
    /// Land with water all around.
    Island,
}

impl SceneKind {
    /// The name in files.
    pub const fn as_str(self) -> &'static str {
        match self {
            Self::City => "city",
            Self::Countryside => "countryside",
            Self::Wilderness => "wilderness",
            Self::Island => "island",
        }
    }
}

/// How streets are.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct StreetWish {
    /// How many pieces from junction to junction, at least, 2 to 20 000; as many as the houses need, if it is not said.
    pub count: Option<u32>,
    /// How they run.
    pub pattern: Pattern,
    /// How wide they are.
    pub width: Width,
    /// How many trees stand along them and in parks.
    pub trees: Amount,
    /// How many cars are parked in them.
    pub parked: Amount,
}

/// How streets run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Pattern {
    /// Straight ones and winding ones.
    #[default]
    Mixed,
    /// Straight and at right angles.
    Grid,
    /// Winding, as in old towns.
    Winding,
    /// With dead ends, as in suburbs.
    Suburb,
}

/// How wide streets are.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Width {
    /// Lanes of 2.6 m and narrow sidewalks, without room to park.
    Narrow,
    /// As in most towns.
    #[default]
    Usual,
    /// Lanes of 3.75 m, two each way in main streets, and broad sidewalks.
    Wide,
}

/// How much of something there is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Amount {
    /// None at all.
    None,
    /// Less than usual.
    Few,
    /// As usual.
    #[default]
    Usual,
    /// More than usual.
    Many,
}

/// How houses are.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct BuildingWish {
    /// How many there are, exactly, 1 to 20 000.
    pub count: Option<u32>,
    /// How high they are.
    pub height: Height,
}

/// How high houses are.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Height {
    /// At most two storeys.
    Low,
    /// As in most towns.
    #[default]
    Usual,
    /// At least six storeys in the middle, and towers.
    High,
}

/// What else a place has.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct FeatureWish {
    /// Houses of a use: exactly so many, 0 to 100 each. What is not named is as it comes.
    pub places: BTreeMap<Place, u32>,
    /// Squares by name, at most 16; each is open ground of some 30 m.
    pub squares: Vec<String>,
    /// Parks by name, at most 16.
    pub parks: Vec<String>,
    /// Water beside the place, at most 4.
    pub waters: Vec<Water>,
    /// Things of the library by name, such as `lighthouse` or `windmill`: exactly so many each, at most 8, and 16 kinds. Beyond
    /// the city alone.
    pub landmarks: BTreeMap<String, u32>,
}

/// Water beside a place.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Water {
    /// A basin along one side.
    Harbour,
    /// A river along one side.
    River,
    /// A lake beside it.
    Lake,
}

impl Water {
    /// The name in files, and the use of its ground.
    pub const fn as_str(self) -> &'static str {
        match self {
            Self::Harbour => "harbour",
            Self::River => "river",
            Self::Lake => "lake",
        }
    }
}

/// A scene that cannot be asked for.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum SpecError {
    /// A format of another version.
    #[error("version {0} of the format is not known: write version = {VERSION}")]
    Version(u32),
    /// A number out of range.
    #[error("{field} = {value} is out of range: give {allowed}")]
    Range {
        /// The field, as a path.
        field: &'static str,
        /// The refused value.
        value: u32,
        /// The allowed range, in words.
        allowed: &'static str,
    },
    /// Sun or weather out of range.
    #[error(transparent)]
    Environment(#[from] EnvironmentError),
}

impl SceneSpec {
    /// Checks every field against its range.
    ///
    /// # Errors
    /// The first field out of range.
    pub fn validate(&self) -> Result<(), SpecError> {
        if self.version != VERSION {
            return Err(SpecError::Version(self.version));
        }
        let within = |field, value: u32, low, high, allowed| {
            if (low..=high).contains(&value) {
                Ok(())
            } else {
                Err(SpecError::Range { field, value, allowed })
            }
        };
        within("streets.count", self.streets.count.unwrap_or(2), 2, 20_000, "2 to 20 000")?;
        within("buildings.count", self.buildings.count.unwrap_or(1), 1, 20_000, "1 to 20 000")?;
        for count in self.features.places.values() {
            within("features.places", *count, 0, 100, "0 to 100 of each")?;
        }
        let places: u32 = self.features.places.values().sum();
        let room = self.buildings.count.unwrap_or(u32::MAX);
        within("features.places", places, 0, room, "no more of them than there are buildings")?;
        within("features.squares", self.features.squares.len() as u32, 0, 16, "at most 16")?;
        within("features.parks", self.features.parks.len() as u32, 0, 16, "at most 16")?;
        within("features.waters", self.features.waters.len() as u32, 0, 4, "at most 4")?;
        within("features.landmarks", self.features.landmarks.len() as u32, 0, 16, "at most 16 kinds")?;
        for count in self.features.landmarks.values() {
            within("features.landmarks", *count, 0, 8, "0 to 8 of each")?;
        }
        Ok(self.environment.validate()?)
    }
}
