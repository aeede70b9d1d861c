//! The eight directions of the compass, in the plane: east along x, north along y.

use std::f64::consts::FRAC_PI_4;

use serde::{Deserialize, Serialize};

use super::{Point2, Vector2, direction, heading};
use crate::ops::wrap_angle;

/// Two places as near as this lie in no direction from each other, m.
const SAME_PLACE: f64 = 1e-6;

/// A direction of the compass.
///
/// ```
/// use simworld_core::geometry::{Compass, Point2};
/// assert_eq!(Compass::North.heading(), std::f64::consts::FRAC_PI_2);
/// assert!(Compass::North.holds(Point2::origin(), Point2::new(3.0, 8.0)));
/// assert_eq!(Compass::from_name("North-West"), Some(Compass::NorthWest));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
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
            Self::NorthEast => "north_east",
            Self::North => "north",
            Self::NorthWest => "north_west",
            Self::West => "west",
            Self::SouthWest => "south_west",
            Self::South => "south",
            Self::SouthEast => "south_east",
        }
    }

    /// The direction of that name; capitals, spaces, dashes and underscores do not matter.
    pub fn from_name(name: &str) -> Option<Self> {
        let plain: String = name.chars().filter(|letter| letter.is_alphabetic()).collect();
        let plain = plain.to_ascii_lowercase();
        Self::ALL.into_iter().find(|direction| direction.as_str().replace('_', "") == plain)
    }

    /// Where it leads, radians counter-clockwise from east, in (-π, π].
    pub fn heading(self) -> f64 {
        wrap_angle(f64::from(self as u8) * FRAC_PI_4)
    }

    /// A step of one metre.
    pub fn step(self) -> Vector2 {
        direction(self.heading())
    }

    /// Whether it lies between two of the four winds.
    pub const fn is_between(self) -> bool {
        matches!(self, Self::NorthEast | Self::NorthWest | Self::SouthWest | Self::SouthEast)
    }

    /// Whether a place lies in this direction from another: within 45° of the four winds, and within 22.5° of those between them,
    /// as people say it.
    pub fn holds(self, from: Point2, to: Point2) -> bool {
        let way = to - from;
        let width = if self.is_between() { FRAC_PI_4 * 0.5 } else { FRAC_PI_4 };
        way.norm() > SAME_PLACE && wrap_angle(heading(&way) - self.heading()).abs() <= width
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{FRAC_PI_2, PI};

    use super::*;

    #[test]
    fn directions_are_an_eighth_of_a_turn_apart_and_north_is_along_y() {
        for (index, direction) in Compass::ALL.into_iter().enumerate() {
            let expected = (45.0 * index as f64).to_radians();
            assert!(wrap_angle(direction.heading() - expected).abs() < 1e-12, "{direction:?}");
            assert_eq!(direction.is_between(), index % 2 == 1, "{direction:?}");
        }
        assert_eq!(Compass::North.heading(), FRAC_PI_2);
        assert!((Compass::West.heading().abs() - PI).abs() < 1e-12);
        assert!((Compass::South.step() - Vector2::new(0.0, -1.0)).norm() < 1e-12);
    }

    #[test]
    fn names_are_those_of_serde_and_read_as_people_write_them() {
        for direction in Compass::ALL {
            assert_eq!(serde_json::to_string(&direction).unwrap(), format!("{:?}", direction.as_str()));
            assert_eq!(Compass::from_name(direction.as_str()), Some(direction));
        }
        for name in ["North West", "northwest", "NORTH_WEST", "north-west"] {
            assert_eq!(Compass::from_name(name), Some(Compass::NorthWest), "{name}");
        }
        for name in ["", "up", "northish", "n"] {
            assert_eq!(Compass::from_name(name), None, "{name}");
        }
    }

    #[test]
    fn sectors_are_as_wide_as_people_mean_them() {
        let from = Point2::origin();
        let east = Compass::East;
        assert!(east.holds(from, Point2::new(10.0, 9.0)) && !east.holds(from, Point2::new(9.0, 10.0)));
        assert!(!east.holds(from, from), "a place lies in no direction from itself");
        let north_west = Compass::NorthWest;
        assert!(
            north_west.holds(from, Point2::new(-10.0, 9.0))
                && !north_west.holds(from, Point2::new(-10.0, 2.0))
        );
    }
}
