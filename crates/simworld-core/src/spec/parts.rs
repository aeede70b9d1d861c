//! Where in a place something is to be: its districts, and the houses, landmarks and squares of which it is said where they are.

use std::f64::consts::FRAC_PI_4;

use serde::{Deserialize, Serialize};

use crate::ops::wrap_angle;

/// A part of a place, seen from its middle.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Whereabouts {
    /// Not said: who makes the place chooses.
    #[default]
    Anywhere,
    /// The middle.
    Middle,
    /// The edge, all round.
    Outskirts,
    /// The east.
    East,
    /// The north-east.
    NorthEast,
    /// The north.
    North,
    /// The north-west.
    NorthWest,
    /// The west.
    West,
    /// The south-west.
    SouthWest,
    /// The south.
    South,
    /// The south-east.
    SouthEast,
}

impl Whereabouts {
    /// Every part, the directions counter-clockwise from east.
    pub const ALL: [Self; 11] = [
        Self::Anywhere,
        Self::Middle,
        Self::Outskirts,
        Self::East,
        Self::NorthEast,
        Self::North,
        Self::NorthWest,
        Self::West,
        Self::SouthWest,
        Self::South,
        Self::SouthEast,
    ];

    /// The name in files.
    pub const fn as_str(self) -> &'static str {
        match self {
            Self::Anywhere => "anywhere",
            Self::Middle => "middle",
            Self::Outskirts => "outskirts",
            Self::East => "east",
            Self::NorthEast => "north_east",
            Self::North => "north",
            Self::NorthWest => "north_west",
            Self::West => "west",
            Self::SouthWest => "south_west",
            Self::South => "south",
            Self::SouthEast => "south_east",
        }
    }

    /// The part of that name.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|part| part.as_str() == name)
    }

    /// In which direction it lies from the middle, radians from east; none of those that lie in no direction.
    pub fn heading(self) -> Option<f64> {
        let eighth: u8 = match self {
            Self::Anywhere | Self::Middle | Self::Outskirts => return None,
            Self::East => 0,
            Self::NorthEast => 1,
            Self::North => 2,
            Self::NorthWest => 3,
            Self::West => 4,
            Self::SouthWest => 5,
            Self::South => 6,
            Self::SouthEast => 7,
        };
        Some(wrap_angle(f64::from(eighth) * FRAC_PI_4))
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
            assert_eq!(Whereabouts::from_name(part.as_str()), Some(part));
        }
        for kind in DistrictKind::ALL {
            assert_eq!(serde_json::to_string(&kind).unwrap(), format!("{:?}", kind.as_str()));
            assert_eq!(DistrictKind::from_name(kind.as_str()), Some(kind));
        }
    }

    #[test]
    fn north_is_a_quarter_of_a_turn_from_east() {
        assert_eq!(Whereabouts::East.heading(), Some(0.0));
        assert_eq!(Whereabouts::North.heading(), Some(std::f64::consts::FRAC_PI_2));
        assert_eq!(Whereabouts::Middle.heading(), None);
    }
}
