//! Points and sizes as they are written: lists of two numbers, or of three. World frame, m: x east, y north, z up.

use serde::{Deserialize, Serialize};
use simworld_core::geometry::Point2;

/// A point or a size of the plane, m: `[x, y]`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Vec<f64>", into = "Vec<f64>")]
pub struct Pair {
    /// East, or from west to east.
    pub x: f64,
    /// North, or from south to north.
    pub y: f64,
}

impl Pair {
    /// These two.
    pub const fn new(x: f64, y: f64) -> Self {
        Self { x, y }
    }

    /// As a point.
    pub fn point(self) -> Point2 {
        Point2::new(self.x, self.y)
    }
}

impl TryFrom<Vec<f64>> for Pair {
    type Error = &'static str;

    fn try_from(numbers: Vec<f64>) -> Result<Self, Self::Error> {
        match numbers[..] {
            [x, y] => Ok(Self { x, y }),
            _ => Err("give two numbers, [x, y]"),
        }
    }
}

impl From<Pair> for Vec<f64> {
    fn from(pair: Pair) -> Self {
        vec![pair.x, pair.y]
    }
}

/// Where the middle of a thing's bottom is, m: `[x, y]`, or `[x, y, z]`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Vec<f64>", into = "Vec<f64>")]
pub struct At {
    /// East.
    pub x: f64,
    /// North.
    pub y: f64,
    /// Up; without it the top of what it stands on, or the ground.
    pub z: Option<f64>,
}

impl At {
    /// A point of the plane, on whatever is there.
    pub const fn new(x: f64, y: f64) -> Self {
        Self { x, y, z: None }
    }

    /// The same at a height, m.
    #[must_use]
    pub const fn high(self, z: f64) -> Self {
        Self { z: Some(z), ..self }
    }
}

impl TryFrom<Vec<f64>> for At {
    type Error = &'static str;

    fn try_from(numbers: Vec<f64>) -> Result<Self, Self::Error> {
        match numbers[..] {
            [x, y] => Ok(Self { x, y, z: None }),
            [x, y, z] => Ok(Self { x, y, z: Some(z) }),
            _ => Err("give two numbers, [x, y], or three, [x, y, z]"),
        }
    }
}

impl From<At> for Vec<f64> {
    fn from(at: At) -> Self {
        [at.x, at.y].into_iter().chain(at.z).collect()
    }
}
