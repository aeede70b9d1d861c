//! Which way a thing looks: degrees counter-clockwise from east, or a direction of the compass.

use std::fmt;

use serde::de::{self, Deserializer, Visitor};
use serde::ser::Serializer;
use serde::{Deserialize, Serialize};
use simworld_core::geometry::Compass;
use simworld_core::ops::wrap_angle;

/// Which way the front of a thing looks.
///
/// ```
/// use simworld_agents::scenes::file::Facing;
/// use simworld_core::geometry::Compass;
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

impl Facing {
    /// Radians counter-clockwise from east, in (-π, π].
    pub fn yaw(self) -> f64 {
        match self {
            Self::Degrees(degrees) => wrap_angle(degrees.to_radians()),
            Self::Compass(direction) => direction.heading(),
        }
    }
}

impl Serialize for Facing {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Degrees(degrees) => serializer.serialize_f64(*degrees),
            Self::Compass(direction) => serializer.serialize_str(&written(*direction)),
        }
    }
}

impl<'de> Deserialize<'de> for Facing {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(FacingVisitor)
    }
}

/// A direction as scene files write it: with a dash.
fn written(direction: Compass) -> String {
    direction.as_str().replace('_', "-")
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
            let known = Compass::ALL.map(written).join(", ");
            E::custom(format!(
                "{word:?} is no direction: give degrees counter-clockwise from east, or one of {known}"
            ))
        };
        Compass::from_name(word).map(Facing::Compass).ok_or_else(unknown)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[derive(Debug, PartialEq, Serialize, Deserialize)]
    struct Row {
        facing: Facing,
    }

    #[test]
    fn directions_are_written_with_dashes_and_lead_where_their_degrees_do() {
        for (index, direction) in Compass::ALL.into_iter().enumerate() {
            let row = Row { facing: Facing::Compass(direction) };
            let degrees = Facing::Degrees(45.0 * index as f64).yaw();
            assert!(wrap_angle(row.facing.yaw() - degrees).abs() < 1e-12, "{direction:?}");
            let file = toml::to_string(&row).unwrap();
            assert!(!file.contains('_'), "{file}");
            assert_eq!(toml::from_str::<Row>(&file).unwrap(), row);
        }
        let unknown = toml::from_str::<Row>("facing = \"up\"").unwrap_err().to_string();
        assert!(unknown.contains("\"up\" is no direction") && unknown.contains("north-west"), "{unknown}");
    }
}
