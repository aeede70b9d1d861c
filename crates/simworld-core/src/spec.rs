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
//! [features.landmarks]
//! cathedral = 1
//! [[features.sites]]
//! what = "museum"
//! by = "cathedral"
//! [[features.districts]]
//! kind = "industrial"
//! at = "east"
//! ```

mod parts;

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::environment::{Environment, EnvironmentError};
use crate::scene::Place;

pub use parts::{DistrictKind, DistrictWish, SiteWish, Whereabouts};

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
    /// Things of the library by name, such as `lighthouse` or `cathedral`: exactly so many each, at most 8, and 16 kinds. They are
    /// none of the buildings that are counted.
    pub landmarks: BTreeMap<String, u32>,
    /// Where some of all these are, at most 16. Of a city alone.
    pub sites: Vec<SiteWish>,
    /// Parts of the place with a character of their own, at most 9. Of a city alone.
    pub districts: Vec<DistrictWish>,
}

impl FeatureWish {
    /// How many of something are asked for: of a use, of a thing of the library, of squares or parks of that name.
    fn counted(&self, name: &str) -> u32 {
        let place = Place::from_name(name).and_then(|place| self.places.get(&place));
        let number = place.or_else(|| self.landmarks.get(name)).copied();
        number.unwrap_or_else(|| {
            self.squares.iter().chain(&self.parks).filter(|own| *own == name).count() as u32
        })
    }

    /// Whether the place has something of that name: a use, a thing of the library, a water, `square` or `park`.
    fn has(&self, name: &str) -> bool {
        match Place::from_name(name) {
            // What is not counted is as it comes.
            Some(place) => self.places.get(&place) != Some(&0),
            None => {
                self.counted(name) > 0
                    || self.waters.iter().any(|water| water.as_str() == name)
                    || name == "square" && !self.squares.is_empty()
                    || name == "park" && !self.parks.is_empty()
            }
        }
    }

    /// Checks sites and districts: what they name is asked for.
    fn validate_parts(&self) -> Result<(), SpecError> {
        within("features.sites", self.sites.len() as u32, 0, 16, "at most 16")?;
        within("features.districts", self.districts.len() as u32, 0, 9, "at most 9")?;
        let unasked =
            |field, name: &str, hint| Err(SpecError::Unasked { field, name: name.to_owned(), hint });
        for site in &self.sites {
            let alike = self.sites.iter().filter(|other| other.what == site.what).count() as u32;
            if alike > self.counted(&site.what) {
                let hint = "ask for as many under features.places, landmarks, squares or parks";
                return unasked("features.sites.what", &site.what, hint);
            }
            if let Some(by) = site.by.as_deref().filter(|by| !self.has(by)) {
                return unasked("features.sites.by", by, "ask for it too, or say in which part of the place");
            }
        }
        for by in self.districts.iter().filter_map(|district| district.by.as_deref()) {
            if !self.waters.iter().any(|water| water.as_str() == by) {
                return unasked("features.districts.by", by, "name a water that features.waters has");
            }
        }
        Ok(())
    }
}

/// Whether a number lies in its range.
fn within(
    field: &'static str,
    value: u32,
    low: u32,
    high: u32,
    allowed: &'static str,
) -> Result<(), SpecError> {
    if (low..=high).contains(&value) { Ok(()) } else { Err(SpecError::Range { field, value, allowed }) }
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
    /// A site or a district that names something which the spec does not ask for.
    #[error("{field} = {name:?}, which the place is not asked to have: {hint}")]
    Unasked {
        /// The field, as a path.
        field: &'static str,
        /// What it names.
        name: String,
        /// What would be right.
        hint: &'static str,
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
        self.features.validate_parts()?;
        Ok(self.environment.validate()?)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn site(what: &str, by: Option<&str>) -> SiteWish {
        SiteWish { what: what.to_owned(), at: Whereabouts::Anywhere, by: by.map(str::to_owned) }
    }

    #[test]
    fn a_site_is_of_what_is_counted_and_beside_what_is_there() {
        let mut spec = SceneSpec::default();
        spec.features.places.insert(Place::Hospital, 1);
        spec.features.landmarks.insert("train_station".to_owned(), 1);
        spec.features.sites = vec![site("hospital", Some("train_station")), site("train_station", None)];
        assert_eq!(spec.validate(), Ok(()));
        for (wrong, field) in [
            (site("cathedral", None), "features.sites.what"),
            (site("hospital", None), "features.sites.what"),
            (site("museum", None), "features.sites.what"),
        ] {
            let mut spec = spec.clone();
            spec.features.sites.push(wrong);
            let error = spec.validate().unwrap_err();
            assert!(matches!(&error, SpecError::Unasked { field: at, .. } if *at == field), "{error}");
        }
        spec.features.sites[0].by = Some("river".to_owned());
        assert!(matches!(spec.validate(), Err(SpecError::Unasked { field: "features.sites.by", .. })));
        spec.features.waters.push(Water::River);
        assert_eq!(spec.validate(), Ok(()));
    }

    #[test]
    fn a_district_lies_along_water_that_is_there() {
        let mut spec = SceneSpec::default();
        let homes = DistrictWish {
            kind: DistrictKind::Residential,
            at: Whereabouts::Anywhere,
            by: Some("river".to_owned()),
        };
        spec.features.districts = vec![homes];
        assert!(matches!(spec.validate(), Err(SpecError::Unasked { field: "features.districts.by", .. })));
        spec.features.waters.push(Water::River);
        assert_eq!(spec.validate(), Ok(()));
        spec.features.districts = vec![spec.features.districts[0].clone(); 10];
        assert!(matches!(spec.validate(), Err(SpecError::Range { field: "features.districts", .. })));
    }
}
