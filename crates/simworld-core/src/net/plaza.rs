//! Open ground for walkers.

use serde::{Deserialize, Serialize};

use crate::geometry::Point2;

/// Open ground on which people walk wherever they like: a square between houses, a pedestrian precinct. [`Footpath`](super::Footpath)s
/// that name it are lines across it on which routes are found.
///
/// What of it is driven on or built over is no part of it. It is on the ground.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Plaza {
    /// Its corners, counter-clockwise, at least three, m.
    pub edge: Vec<Point2>,
    /// The corners of what stands in it, each clockwise, m.
    pub holes: Vec<Vec<Point2>>,
}

impl Plaza {
    /// The sides of its edge and of its holes, the plaza to the left of each.
    pub fn sides(&self) -> impl Iterator<Item = [Point2; 2]> + '_ {
        self.rings().flat_map(|ring| {
            let after = ring.iter().cycle().skip(1);
            ring.iter().zip(after).map(|(from, to)| [*from, *to])
        })
    }

    /// Its edge, and then its holes.
    pub fn rings(&self) -> impl Iterator<Item = &[Point2]> {
        std::iter::once(&self.edge).chain(&self.holes).map(Vec::as_slice)
    }

    /// Whether a place is on it.
    pub fn contains(&self, place: Point2) -> bool {
        // A ray to the east meets an odd number of sides.
        let is_met = |[a, b]: &[Point2; 2]| {
            let above = [a.y > place.y, b.y > place.y];
            above[0] != above[1] && ((b - a).perp(&(place - a)) > 0.0) == above[1]
        };
        self.sides().filter(is_met).count() % 2 == 1
    }

    /// Its area, m².
    pub fn area(&self) -> f64 {
        let Some(origin) = self.edge.first().copied() else { return 0.0 };
        self.sides().map(|[a, b]| (a - origin).perp(&(b - origin))).sum::<f64>() * 0.5
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Vector2;

    fn ring(corners: &[(f64, f64)]) -> Vec<Point2> {
        corners.iter().map(|(x, y)| Point2::new(*x, *y)).collect()
    }

    #[test]
    fn a_plaza_is_what_lies_within_its_edge_and_in_no_hole() {
        let plaza = Plaza {
            edge: ring(&[(0.0, 0.0), (10.0, 0.0), (10.0, 10.0), (0.0, 10.0)]),
            holes: vec![ring(&[(4.0, 4.0), (4.0, 6.0), (6.0, 6.0), (6.0, 4.0)])],
        };
        assert_eq!(plaza.area(), 96.0);
        assert_eq!(plaza.sides().count(), 8);
        let within = [(1.0, 1.0), (5.0, 3.0), (3.0, 4.0), (9.0, 6.0)];
        let beyond = [(5.0, 5.0), (-1.0, 4.0), (11.0, 4.0), (5.0, 10.5)];
        assert!(within.iter().all(|(x, y)| plaza.contains(Point2::new(*x, *y))));
        assert!(!beyond.iter().any(|(x, y)| plaza.contains(Point2::new(*x, *y))));
        // The plaza lies to the left of each side.
        for [from, to] in plaza.sides() {
            let left = to_left(to - from);
            assert!(plaza.contains(nalgebra::center(&from, &to) + left * 0.1));
        }
    }

    fn to_left(along: Vector2) -> Vector2 {
        Vector2::new(-along.y, along.x).normalize()
    }
}
