//! Where the parts of a place lie: its middle, its edge, and the directions from the middle.

use std::f64::consts::{FRAC_PI_2, PI};

use simworld_core::geometry::{Point2, direction, heading};
use simworld_core::ops::wrap_angle;
use simworld_core::spec::{Water, Whereabouts};

use crate::building::Building;

/// The middle reaches so far, as a share of the way to the farthest house, and what lies in a direction is looked for so far out.
const MIDDLE: f64 = 0.45;
const ASIDE: f64 = 0.6;
/// The outskirts begin there, and what lies there is looked for so far out.
const OUTSKIRTS: f64 = 0.6;
const EDGE: f64 = 0.85;
/// What lies in a direction is no farther aside than this, radians.
const WITHIN: f64 = 1.05;

/// How far a place reaches.
#[derive(Clone, Copy, Debug)]
pub(super) struct Extent {
    /// The middle of its houses, m.
    pub(super) heart: Point2,
    /// From there to the farthest of them, m.
    pub(super) radius: f64,
}

impl Extent {
    /// Of a place that keeps so many houses, those nearest to the middle.
    pub(super) fn of(buildings: &[Building], count: Option<u32>) -> Self {
        let heart = middle_of(buildings);
        let mut away: Vec<f64> = buildings.iter().map(|building| (building.center - heart).norm()).collect();
        away.sort_by(f64::total_cmp);
        let last = count.map_or(away.len(), |count| count as usize).clamp(1, away.len().max(1)) - 1;
        Self { heart, radius: away.get(last).copied().unwrap_or(0.0) }
    }

    /// How far a point is from where something in a part of the place is looked for, m.
    pub(super) fn away(&self, part: Whereabouts, point: Point2) -> f64 {
        let way = point - self.heart;
        match part {
            Whereabouts::Anywhere => 0.0,
            Whereabouts::Middle => way.norm(),
            Whereabouts::Outskirts => (way.norm() - EDGE * self.radius).abs(),
            Whereabouts::Towards(side) => (way - side.step() * self.radius * ASIDE).norm(),
        }
    }

    /// Whether a point lies in a part of the place.
    pub(super) fn holds(&self, part: Whereabouts, point: Point2) -> bool {
        let way = point - self.heart;
        match part {
            Whereabouts::Anywhere => true,
            Whereabouts::Middle => way.norm() <= MIDDLE * self.radius,
            Whereabouts::Outskirts => way.norm() >= OUTSKIRTS * self.radius,
            Whereabouts::Towards(side) => wrap_angle(heading(&way) - side.heading()).abs() <= WITHIN,
        }
    }

    /// How far a point is from the side of the place that lies in a direction, m.
    pub(super) fn way_to_side(&self, towards: f64, point: Point2) -> f64 {
        (self.radius - (point - self.heart).dot(&direction(towards))).max(0.0)
    }
}

/// The middle of some houses; the origin without any.
pub(super) fn middle_of(buildings: &[Building]) -> Point2 {
    let count = buildings.len().max(1) as f64;
    Point2::from(
        buildings.iter().fold(nalgebra::Vector2::zeros(), |sum, one| sum + one.center.coords / count),
    )
}

/// On which side of the place a water lies, radians from east: the first in the south, then east, north and west.
pub(super) fn side_of(waters: &[Water], name: &str) -> Option<f64> {
    let rank = waters.iter().position(|water| water.as_str() == name)?;
    Some([-FRAC_PI_2, 0.0, FRAC_PI_2, PI][rank % 4])
}

#[cfg(test)]
mod tests {
    use simworld_core::geometry::Compass;

    use super::*;

    #[test]
    fn parts_lie_where_they_are_named() {
        let extent = Extent { heart: Point2::new(100.0, 0.0), radius: 200.0 };
        let east = Point2::new(250.0, 20.0);
        assert!(
            extent.holds(Whereabouts::Towards(Compass::East), east)
                && !extent.holds(Whereabouts::Towards(Compass::West), east)
        );
        assert!(extent.holds(Whereabouts::Outskirts, east) && !extent.holds(Whereabouts::Middle, east));
        assert!(
            extent.away(Whereabouts::Towards(Compass::East), east)
                < extent.away(Whereabouts::Towards(Compass::North), east)
        );
        assert!(extent.way_to_side(0.0, east) < extent.way_to_side(PI, east));
        assert_eq!(side_of(&[Water::Lake, Water::River], "river"), Some(0.0));
        assert_eq!(side_of(&[Water::Lake], "harbour"), None);
    }
}
