//! Sizes as people write them: `3km`, `800m`.

use std::fmt;
use std::str::FromStr;

use simworld_citygen::{Style, growth};
use simworld_core::geometry::{Point2, Vector2};
use simworld_core::seed::Seed;
use thiserror::Error;

/// How far a city reaches from one side to the other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Size {
    /// m.
    pub metres: f64,
}

/// Smallest and largest city, m.
const RANGE: (f64, f64) = (200.0, 50_000.0);

/// Why a text is no size.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum SizeError {
    /// No number, or no unit that is known.
    #[error("`{0}` is no size: give a number and a unit, such as 3km or 800m")]
    Text(String),
    /// Too small or too large.
    #[error("{0} m is out of range: give 200m to 50km")]
    Range(f64),
}

impl FromStr for Size {
    type Err = SizeError;

    fn from_str(text: &str) -> Result<Self, SizeError> {
        let text = text.trim();
        let (number, unit) = match (text.strip_suffix("km"), text.strip_suffix('m')) {
            (Some(number), _) => (number, 1000.0),
            (None, Some(number)) => (number, 1.0),
            (None, None) => return Err(SizeError::Text(text.to_owned())),
        };
        let number: f64 = number.trim().parse().map_err(|_| SizeError::Text(text.to_owned()))?;
        let metres = number * unit;
        if (RANGE.0..=RANGE.1).contains(&metres) {
            Ok(Self { metres })
        } else {
            Err(SizeError::Range(metres))
        }
    }
}

impl Size {
    /// The number of street segments with which a city of that style and seed reaches so far.
    pub fn segments(self, style: Style, seed: Seed) -> u32 {
        // The style says how densely streets lie; growing them is the way to know.
        let kilometres = self.metres / 1000.0;
        let mut count = (150.0 * kilometres * kilometres).max(6.0);
        let mut best = (f64::INFINITY, count);
        for _ in 0..6 {
            let plan = growth::grow(&style.roads(count as u32), seed);
            let share = self.metres / reach(&plan.nodes);
            let miss = (share - 1.0).abs();
            if miss < best.0 {
                best = (miss, count);
            }
            if miss < 0.02 {
                break;
            }
            // A little less than the area says, lest it swing about its aim.
            count = (count * share * share.sqrt()).clamp(6.0, 1e6);
        }
        best.1 as u32
    }
}

/// The diameter of the disc that a city fills, m: nine in ten junctions lie within the root of nine tenths of its radius.
/// Highways that leave the city do not count.
fn reach(nodes: &[Point2]) -> f64 {
    let count = nodes.len().max(1) as f64;
    let middle = nodes.iter().fold(Vector2::zeros(), |sum, node| sum + node.coords / count);
    let mut distances: Vec<f64> = nodes.iter().map(|node| (node.coords - middle).norm()).collect();
    distances.sort_by(f64::total_cmp);
    let ninth = distances.get(distances.len() * 9 / 10).copied().unwrap_or(0.0);
    (2.0 * ninth / 0.9_f64.sqrt()).max(1.0)
}

impl fmt::Display for Size {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.metres < 1000.0 {
            write!(f, "{}m", self.metres)
        } else {
            write!(f, "{}km", self.metres / 1000.0)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_are_read_as_people_write_them() {
        assert_eq!("3km".parse(), Ok(Size { metres: 3000.0 }));
        assert_eq!(" 800 m ".parse(), Ok(Size { metres: 800.0 }));
        assert_eq!("1.5km".parse::<Size>().unwrap().to_string(), "1.5km");
        for wrong in ["3", "", "km", "3 miles", "m", "NaNkm", "-1km", "1e9km", "10m"] {
            assert!(wrong.parse::<Size>().is_err(), "{wrong}");
        }
    }

    #[test]
    fn cities_reach_as_far_as_asked() {
        for style in Style::ALL {
            for metres in [1000.0, 2500.0] {
                let count = Size { metres }.segments(style, Seed(3));
                let nodes = growth::grow(&style.roads(count), Seed(3)).nodes;
                let middle =
                    nodes.iter().fold(Vector2::zeros(), |sum, node| sum + node.coords) / nodes.len() as f64;
                let within = |radius: f64| {
                    let inside = nodes.iter().filter(|node| (node.coords - middle).norm() < radius).count();
                    inside as f64 / nodes.len() as f64
                };
                let (most, half) = (within(metres * 0.55), within(metres * 0.3));
                // A disc has 0.36 of its area there; streets are longer where fewer live, so the middle has more of the
                // nodes than that.
                assert!(
                    most > 0.85 && half < 0.65,
                    "{style}, {metres} m: {most:.2} and {half:.2} of the nodes"
                );
            }
        }
    }
}
