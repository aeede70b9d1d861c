//! Straight pieces of streets, and the exact test whether two touch.

use std::cmp::Ordering;

use robust::{Coord, orient2d};
use simworld_core::geometry::Point2;

/// What lies at an end of a piece: two pieces may meet only where they have this in common.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Joint {
    /// A node.
    Node(u32),
    /// Point `1` on the course of street `0`.
    Bend(u32, u32),
}

/// A straight piece of a street's course.
#[derive(Clone, Copy, Debug)]
pub(super) struct Piece {
    pub(super) ends: [Point2; 2],
    pub(super) joints: [Joint; 2],
}

/// Positive if `c` lies to the left of the line from `a` to `b`; the sign is exact.
pub(super) fn side(a: Point2, b: Point2, c: Point2) -> f64 {
    let coord = |point: Point2| Coord { x: point.x, y: point.y };
    orient2d(coord(a), coord(b), coord(c))
}

/// The order of the directions from `centre` to `a` and to `b`, counterclockwise from east; exact.
pub(super) fn by_direction(centre: Point2, a: Point2, b: Point2) -> Ordering {
    let lower = |point: Point2| !(point.y > centre.y || (point.y == centre.y && point.x > centre.x));
    lower(a).cmp(&lower(b)).then_with(|| 0.0_f64.total_cmp(&(side(centre, a, b) + 0.0)))
}

impl Piece {
    /// Where two pieces touch beyond what they have in common, if they do.
    pub(super) fn touches(&self, other: &Self) -> Option<Point2> {
        if self.apart(other) {
            return None;
        }
        let shared = |i: usize, j: usize| self.joints[i] == other.joints[j];
        let mut common = [(0, 0), (0, 1), (1, 0), (1, 1)].into_iter().filter(|(i, j)| shared(*i, *j));
        match common.clone().count() {
            0 => self.meets(other),
            1 => common.next_back().and_then(|(i, j)| self.leaves_with(other, i, j)),
            _ => Some(nalgebra::center(&self.ends[0], &self.ends[1])),
        }
    }

    /// Whether the two have an end in common.
    pub(super) fn has_common(&self, other: &Self) -> bool {
        self.joints.iter().any(|joint| other.joints.contains(joint))
    }

    /// Whether their boxes are apart.
    fn apart(&self, other: &Self) -> bool {
        let ([a, b], [c, d]) = (self.ends, other.ends);
        a.x.max(b.x) < c.x.min(d.x)
            || c.x.max(d.x) < a.x.min(b.x)
            || a.y.max(b.y) < c.y.min(d.y)
            || c.y.max(d.y) < a.y.min(b.y)
    }

    /// From end `i`, which is end `j` of the other, both go the same way.
    fn leaves_with(&self, other: &Self, i: usize, j: usize) -> Option<Point2> {
        let (start, far, others) = (self.ends[i], self.ends[1 - i], other.ends[1 - j]);
        let together = side(start, far, others) == 0.0 && (far - start).dot(&(others - start)) > 0.0;
        together.then_some(start)
    }

    /// A point of both, if they have one.
    fn meets(&self, other: &Self) -> Option<Point2> {
        let ([a, b], [c, d]) = (self.ends, other.ends);
        let [of_c, of_d] = [side(a, b, c), side(a, b, d)];
        let [of_a, of_b] = [side(c, d, a), side(c, d, b)];
        let within = |point: Point2, p: Point2, q: Point2| {
            p.x.min(q.x) <= point.x
                && point.x <= p.x.max(q.x)
                && p.y.min(q.y) <= point.y
                && point.y <= p.y.max(q.y)
        };
        let ends = [(of_c, c, a, b), (of_d, d, a, b), (of_a, a, c, d), (of_b, b, c, d)];
        if let Some((_, point, ..)) =
            ends.into_iter().find(|(side, point, p, q)| *side == 0.0 && within(*point, *p, *q))
        {
            return Some(point);
        }
        let parted = (of_c > 0.0) != (of_d > 0.0) && (of_a > 0.0) != (of_b > 0.0);
        let proper = [of_a, of_b, of_c, of_d].iter().all(|side| *side != 0.0);
        (parted && proper).then(|| a + (b - a) * (of_a / (of_a - of_b)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn piece(ends: [(f64, f64); 2], joints: [u32; 2]) -> Piece {
        Piece { ends: ends.map(|(x, y)| Point2::new(x, y)), joints: joints.map(Joint::Node) }
    }

    #[test]
    fn pieces_that_cross_touch_where_they_cross() {
        let a = piece([(0.0, 0.0), (4.0, 4.0)], [0, 1]);
        let b = piece([(0.0, 2.0), (2.0, 0.0)], [2, 3]);
        assert_eq!(a.touches(&b), Some(Point2::new(1.0, 1.0)));
        assert_eq!(a.touches(&piece([(5.0, 5.0), (6.0, 6.0)], [2, 3])), None);
        assert_eq!(a.touches(&piece([(3.0, 3.0), (6.0, 6.0)], [2, 3])), Some(Point2::new(3.0, 3.0)));
        assert_eq!(a.touches(&piece([(2.0, 2.0), (9.0, 0.0)], [2, 3])), Some(Point2::new(2.0, 2.0)));
    }

    #[test]
    fn pieces_of_one_node_touch_only_along_each_other() {
        let a = piece([(0.0, 0.0), (4.0, 4.0)], [0, 1]);
        assert_eq!(a.touches(&piece([(0.0, 0.0), (4.0, 0.0)], [0, 2])), None);
        assert_eq!(a.touches(&piece([(0.0, 0.0), (-1.0, -1.0)], [0, 2])), None);
        assert!(a.touches(&piece([(0.0, 0.0), (1.0, 1.0)], [0, 2])).is_some());
        assert!(a.touches(&piece([(4.0, 4.0), (0.0, 0.0)], [1, 0])).is_some());
    }

    #[test]
    fn directions_go_round_from_east() {
        let centre = Point2::new(1.0, 1.0);
        let round = [(2.0, 1.0), (2.0, 2.0), (1.0, 2.0), (0.0, 1.0), (0.0, 0.0), (1.0, 0.0), (2.0, 0.5)];
        for pair in round.map(|(x, y)| Point2::new(x, y)).windows(2) {
            assert_eq!(by_direction(centre, pair[0], pair[1]), Ordering::Less, "{pair:?}");
            assert_eq!(by_direction(centre, pair[1], pair[0]), Ordering::Greater, "{pair:?}");
        }
    }
}
