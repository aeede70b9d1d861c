//! Which way a thing looks: degrees counter-clockwise from east, or a direction of the compass.

use std::f64::consts::FRAC_PI_4;
use std::fmt;

use serde::de::{self, Deserializer, Visitor};
use serde::ser::Serializer;
use serde::{Deserialize, Serialize};
use simworld_core::ops::wrap_angle;

/// Which way the front of a thing looks.
///
/// ```
/// use simworld_agents::scenes::file::{Compass, Facing};
/// let north = Facing::Compass(Compass::North);
/// assert_eq!(north.yaw(), std::f64::consts::FRAC_PI_2);
/// assert!((Facing::Degrees(90.0).yaw() - north.yaw()).abs() < 1e-15);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Facing {
    /// Degrees counter-clockwise from east, seen from above: 0 is east, 90 north, 180 west, -90 south.
    Degrees(f64),
    /// A direction of the compass.
    Compass(Compass),
}

/// A direction of the compass.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Compass {
    /// Along x.
    East,
    /// Between the two.
    NorthEast,
    /// Along y.
    North,
    /// Between the two.
    NorthWest,
    /// Against x.
    West,
    /// Between the two.
    SouthWest,
    /// Against y.
    South,
    /// Between the two.
    SouthEast,
}

impl Compass {
    /// Every direction, counter-clockwise from east, an eighth of a turn apart.
    pub const ALL: [Self; 8] = [
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
            Self::East => "east",
            Self::NorthEast => "north-east",
            Self::North => "north",
            Self::NorthWest => "north-west",
            Self::West => "west",
            Self::SouthWest => "south-west",
            Self::South => "south",
            Self::SouthEast => "south-east",
        }
    }

    /// The direction of that name; capitals, spaces, dashes and underscores do not matter.
    pub fn from_name(name: &str) -> Option<Self> {
        let plain: String = name.chars().filter(|letter| letter.is_alphabetic()).collect();
        let plain = plain.to_ascii_lowercase();
        Self::ALL.into_iter().find(|direction| direction.as_str().replace('-', "") == plain)
    }
}

impl Facing {
    /// Radians counter-clockwise from east, in (-π, π].
    pub fn yaw(self) -> f64 {
        match self {
            Self::Degrees(degrees) => wrap_angle(degrees.to_radians()),
            Self::Compass(direction) => wrap_angle(f64::from(direction as u8) * FRAC_PI_4),
        }
    }
}

impl Serialize for Facing {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Degrees(degrees) => serializer.serialize_f64(*degrees),
            Self::Compass(direction) => serializer.serialize_str(direction.as_str()),
        }
    }
}

impl<'de> Deserialize<'de> for Facing {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(FacingVisitor)
    }
}

struct FacingVisitor;

impl Visitor<'_> for FacingVisitor {
    type Value = Facing;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(
            "degrees counter-clockwise from east, or a direction of the compass such as \"north-west\"",
        )
    }

    fn visit_f64<E: de::Error>(self, degrees: f64) -> Result<Facing, E> {
        Ok(Facing::Degrees(degrees))
    }

    fn visit_i64<E: de::Error>(self, degrees: i64) -> Result<Facing, E> {
        Ok(Facing::Degrees(degrees as f64))
    }

    fn visit_u64<E: de::Error>(self, degrees: u64) -> Result<Facing, E> {
        Ok(Facing::Degrees(degrees as f64))
    }

    fn visit_str<E: de::Error>(self, word: &str) -> Result<Facing, E> {
        let unknown = || {
            let word: String = word.chars().take(40).collect();
            let known = Compass::ALL.map(Compass::as_str).join(", ");
            E::custom(format!(
                "{word:?} is no direction: give degrees counter-clockwise from east, or one of {known}"
            ))
        };
        Compass::from_name(word).map(Facing::Compass).ok_or_else(unknown)
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{FRAC_PI_2, PI};

    use super::*;

    #[test]
    fn directions_are_an_eighth_of_a_turn_apart_and_north_is_along_y() {
        for (index, direction) in Compass::ALL.into_iter().enumerate() {
            let yaw = Facing::Compass(direction).yaw();
            let degrees = Facing::Degrees(45.0 * index as f64).yaw();
            assert!(wrap_angle(yaw - degrees).abs() < 1e-12, "{direction:?}");
            assert_eq!(Compass::from_name(direction.as_str()), Some(direction));
        }
        assert_eq!(Facing::Compass(Compass::North).yaw(), FRAC_PI_2);
        assert!((Facing::Compass(Compass::West).yaw().abs() - PI).abs() < 1e-12);
    }

    #[test]
    fn names_are_read_as_people_write_them() {
        for name in ["North West", "northwest", "NORTH_WEST", "north-west"] {
            assert_eq!(Compass::from_name(name), Some(Compass::NorthWest), "{name}");
        }
        for name in ["", "up", "northish", "n"] {
            assert_eq!(Compass::from_name(name), None, "{name}");
        }
    }
}
