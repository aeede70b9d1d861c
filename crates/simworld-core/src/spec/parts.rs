//! Where in a place something is to be: its districts, and the houses, landmarks and squares of which it is said where they are.

use serde::de::Error as _;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use crate::geometry::Compass;

/// A part of a place, seen from its middle. In files it is its [name](Whereabouts::as_str).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum Whereabouts {
    /// Not said: who makes the place chooses.
    #[default]
    Anywhere,
    /// The middle.
    Middle,
    /// The edge, all round.
    Outskirts,
    /// What lies in a direction from the middle.
    Towards(Compass),
}

impl Whereabouts {
    /// Every part, the directions counter-clockwise from east.
    pub const ALL: [Self; 11] = {
        let mut all = [Self::Anywhere; 11];
        all[1] = Self::Middle;
        all[2] = Self::Outskirts;
        let mut at = 0;
        while at < Compass::ALL.len() {
            all[3 + at] = Self::Towards(Compass::ALL[at]);
            at += 1;
        }
        all
    };

    /// The names of all of them.
    const NAMES: [&'static str; 11] = {
        let mut names = [""; 11];
        let mut at = 0;
        while at < names.len() {
            names[at] = Self::ALL[at].as_str();
            at += 1;
        }
        names
    };

    /// The name in files.
    pub const fn as_str(self) -> &'static str {
        match self {
            Self::Anywhere => "anywhere",
            Self::Middle => "middle",
            Self::Outskirts => "outskirts",
            Self::Towards(direction) => direction.as_str(),
        }
    }

    /// The part of that name.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|part| part.as_str() == name)
    }

    /// In which direction it lies from the middle, radians from east; none of those that lie in no direction.
    pub fn heading(self) -> Option<f64> {
        match self {
            Self::Anywhere | Self::Middle | Self::Outskirts => None,
            Self::Towards(direction) => Some(direction.heading()),
        }
    }
}

impl Serialize for Whereabouts {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.as_str())
    }
}

impl<'de> Deserialize<'de> for Whereabouts {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let name = String::deserialize(deserializer)?;
        Self::from_name(&name).ok_or_else(|| D::Error::unknown_variant(&name, &Self::NAMES))
    }
}

/// What a part of a city is like.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum DistrictKind {
    /// Close and low: dwellings with shops, restaurants and museums between.
    OldTown,
    /// Dwellings.
    Residential,
    /// Offices.
    Business,
    /// Shops and restaurants.
    Shopping,
    /// Factories and warehouses.
    Industrial,
    /// Schools, hospitals and museums.
    Civic,
    /// Green without houses.
    Green,
}

impl DistrictKind {
    /// Every kind.
    pub const ALL: [Self; 7] = [
        Self::OldTown,
        Self::Residential,
        Self::Business,
        Self::Shopping,
        Self::Industrial,
        Self::Civic,
        Self::Green,
    ];

    /// The name in files.
    pub const fn as_str(self) -> &'static str {
        match self {
            Self::OldTown => "old_town",
            Self::Residential => "residential",
            Self::Business => "business",
            Self::Shopping => "shopping",
            Self::Industrial => "industrial",
            Self::Civic => "civic",
            Self::Green => "green",
        }
    }

    /// The kind of that name.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|kind| kind.as_str() == name)
    }
}

/// A part of a city with a character of its own.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct DistrictWish {
    /// What it is like.
    pub kind: DistrictKind,
    /// Where it lies.
    #[serde(default)]
    pub at: Whereabouts,
    /// The water that it lies along: `harbour`, `river` or `lake`, which the place then has to have.
    #[serde(default)]
    pub by: Option<String>,
}

/// Where one of the houses, landmarks, squares or parks is to be that the spec asks for.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SiteWish {
    /// Which: a use, such as `hospital`, a thing of the library, such as `cathedral`, or the name of a square or a park.
    pub what: String,
    /// In which part of the place.
    #[serde(default)]
    pub at: Whereabouts,
    /// Beside what: a use, a thing of the library, a water, `square` or `park`.
    #[serde(default)]
    pub by: Option<String>,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_those_of_serde() {
        for part in Whereabouts::ALL {
            assert_eq!(serde_json::to_string(&part).unwrap(), format!("{:?}", part.as_str()));
            assert_eq!(serde_json::from_str::<Whereabouts>(&format!("{:?}", part.as_str())).unwrap(), part);
            assert_eq!(Whereabouts::from_name(part.as_str()), Some(part));
        }
        let directions = Compass::ALL.map(Whereabouts::Towards);
        assert_eq!(Whereabouts::ALL[3..], directions, "each direction once, and in order");
        let unknown = serde_json::from_str::<Whereabouts>("\"uphill\"").unwrap_err().to_string();
        assert!(unknown.contains("uphill") && unknown.contains("north_east"), "{unknown}");
        for kind in DistrictKind::ALL {
            assert_eq!(serde_json::to_string(&kind).unwrap(), format!("{:?}", kind.as_str()));
            assert_eq!(DistrictKind::from_name(kind.as_str()), Some(kind));
        }
    }

    #[test]
    fn north_is_a_quarter_of_a_turn_from_east() {
        let north = Whereabouts::Towards(Compass::North);
        assert_eq!(Whereabouts::Towards(Compass::East).heading(), Some(0.0));
        assert_eq!(north.heading(), Some(std::f64::consts::FRAC_PI_2));
        assert_eq!(Whereabouts::Middle.heading(), None);
    }
}
