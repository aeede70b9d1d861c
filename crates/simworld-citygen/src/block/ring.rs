//! A polygon whose edges know what they border, and its cuts by straight lines.

use std::ops::Range;

use simworld_core::geometry::{Point2, Vector2};
use smallvec::SmallVec;

use super::Border;
use crate::occupancy::{least, most};

/// What a polygon has for each corner. Nearly all have few, and are cut and thrown away by the thousand: those stand in place.
type PerCorner<T> = SmallVec<[T; 8]>;

/// A polygon; the i-th border belongs to the edge from corner i to the next.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Ring {
    pub(crate) corners: PerCorner<Point2>,
    pub(crate) borders: PerCorner<Border>,
}

/// Polygons of more corners are not tested for simplicity, which takes the square of their number; they are ragged
/// outskirts, and treated as if they were not simple.
const MOST_TESTED: usize = 600;

impl Ring {
    pub(crate) fn with_capacity(corners: usize) -> Self {
        Self { corners: PerCorner::with_capacity(corners), borders: PerCorner::with_capacity(corners) }
    }

    pub(crate) fn len(&self) -> usize {
        self.corners.len()
    }

    pub(crate) fn clear(&mut self) {
        self.corners.clear();
        self.borders.clear();
    }

    #[inline]
    pub(crate) fn push(&mut self, corner: Point2, border: Border) {
        self.corners.push(corner);
        self.borders.push(border);
    }

    /// Goes on with some of the corners of another ring.
    pub(crate) fn extend(&mut self, other: &Ring, corners: Range<usize>) {
        self.corners.extend_from_slice(&other.corners[corners.clone()]);
        self.borders.extend_from_slice(&other.borders[corners]);
    }

    /// Puts a corner before the i-th.
    pub(crate) fn insert(&mut self, index: usize, corner: Point2, border: Border) {
        self.corners.insert(index, corner);
        self.borders.insert(index, border);
    }

    /// Turns the ring so that it begins at the westernmost corner where one border ends and another begins, whatever the
    /// numbers of its streets.
    pub(crate) fn begin_at_least(&mut self) {
        let least = |a: &Point2, b: &Point2| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y));
        let count = self.len();
        let begins = |index: &usize| self.borders[*index] != self.borders[(index + count - 1) % count];
        let first = (0..count).filter(begins).min_by(|a, b| least(&self.corners[*a], &self.corners[*b]));
        if let Some(first) = first {
            self.corners.rotate_left(first);
            self.borders.rotate_left(first);
        }
    }

    /// The corner after the i-th.
    pub(crate) fn next(&self, index: usize) -> Point2 {
        self.corners[if index + 1 == self.corners.len() { 0 } else { index + 1 }]
    }

    /// The i-th edge as a vector.
    pub(crate) fn edge(&self, index: usize) -> Vector2 {
        self.next(index) - self.corners[index]
    }

    /// Area, m²; positive counter-clockwise.
    pub(crate) fn area(&self) -> f64 {
        // Relative to the first corner, so that nothing cancels far from the origin.
        let Some(origin) = self.corners.first() else { return 0.0 };
        let doubled: f64 =
            self.corners.windows(2).map(|pair| (pair[0] - origin).perp(&(pair[1] - origin))).sum();
        doubled * 0.5
    }

    /// The mean of the corners.
    pub(crate) fn middle(&self) -> Point2 {
        let sum = self.corners.iter().fold(Vector2::zeros(), |sum, corner| sum + corner.coords);
        (sum / self.len().max(1) as f64).into()
    }

    /// Whether no two edges meet but neighbours in their common corner.
    pub(crate) fn is_simple(&self) -> bool {
        let count = self.len();
        if !(3..=MOST_TESTED).contains(&count) {
            return false;
        }
        (0..count).all(|a| {
            // The last edge is a neighbour of the first.
            let last = if a == 0 { count - 1 } else { count };
            (a + 2..last).all(|b| !touch(self.corners[a], self.next(a), self.corners[b], self.next(b)))
        })
    }

    /// Cuts a convex ring by the line through `at` across `normal`: what lies behind goes to `behind`, what lies in the
    /// direction of the normal goes to `ahead`. Both cuts have the same corners to the bit.
    pub(crate) fn split(&self, at: Point2, normal: Vector2, behind: &mut Ring, ahead: &mut Ring) -> Split {
        behind.clear();
        ahead.clear();
        self.cut(
            (at, normal),
            |corner, border| behind.push(corner, border),
            |corner, border| ahead.push(corner, border),
        );
        Split::of(behind.len(), ahead.len())
    }

    /// The area of what lies behind such a line, m², to the bit, where something lies on both sides.
    pub(crate) fn area_behind(&self, at: Point2, normal: Vector2) -> Option<f64> {
        let (mut behind, mut ahead) = (Measure::default(), 0);
        self.cut((at, normal), |corner, _| behind.add(corner), |_, _| ahead += 1);
        (Split::of(behind.corners, ahead) == Split::Both).then_some(behind.doubled * 0.5)
    }

    /// Walks along the corners of what lies behind a line and of what lies ahead of it.
    #[inline]
    fn cut(
        &self,
        (at, normal): (Point2, Vector2),
        mut behind: impl FnMut(Point2, Border),
        mut ahead: impl FnMut(Point2, Border),
    ) {
        let height = |corner: Point2| {
            let height = (corner - at).dot(&normal);
            // A corner on the line is no reason for a sliver.
            if height.abs() < 1e-7 { 0.0 } else { height }
        };
        let mut here = self.corners.first().map_or(0.0, |corner| height(*corner));
        for index in 0..self.len() {
            let (corner, next, border) = (self.corners[index], self.next(index), self.borders[index]);
            let there = height(next);
            if here <= 0.0 {
                behind(corner, if here == 0.0 && there > 0.0 { Border::LAND } else { border });
            }
            if here >= 0.0 {
                ahead(corner, if here == 0.0 && there < 0.0 { Border::LAND } else { border });
            }
            if (here < 0.0 && there > 0.0) || (here > 0.0 && there < 0.0) {
                let cut = corner + (next - corner) * (here / (here - there));
                let (behind_border, ahead_border) =
                    if here < 0.0 { (Border::LAND, border) } else { (border, Border::LAND) };
                behind(cut, behind_border);
                ahead(cut, ahead_border);
            }
            here = there;
        }
    }
}

/// The corners of a ring, counted and measured one by one as [`Ring::area`] does.
#[derive(Default)]
struct Measure {
    corners: usize,
    origin: Point2,
    last: Point2,
    doubled: f64,
}

impl Measure {
    #[inline]
    fn add(&mut self, corner: Point2) {
        if self.corners == 0 {
            self.origin = corner;
        } else {
            self.doubled += (self.last - self.origin).perp(&(corner - self.origin));
        }
        self.last = corner;
        self.corners += 1;
    }
}

/// Where a ring lies that was to be cut.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Split {
    /// On both sides.
    Both,
    /// All of it behind the line.
    Behind,
    /// All of it ahead.
    Ahead,
}

impl Split {
    /// By the numbers of corners behind and ahead.
    const fn of(behind: usize, ahead: usize) -> Self {
        match (behind >= 3, ahead >= 3) {
            (true, true) => Self::Both,
            (_, false) => Self::Behind,
            (false, true) => Self::Ahead,
        }
    }
}

/// Whether two segments share a point.
fn touch(a: Point2, b: Point2, c: Point2, d: Point2) -> bool {
    let is_apart = |[a, b]: [f64; 2], [c, d]: [f64; 2]| least(c, d) > most(a, b) || most(c, d) < least(a, b);
    if is_apart([a.x, b.x], [c.x, d.x]) || is_apart([a.y, b.y], [c.y, d.y]) {
        return false;
    }
    let side = |p: Point2, q: Point2, r: Point2| (q - p).perp(&(r - p));
    side(a, b, c) * side(a, b, d) <= 0.0 && side(c, d, a) * side(c, d, b) <= 0.0
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square() -> Ring {
        let corners = [(0.0, 0.0), (10.0, 0.0), (10.0, 10.0), (0.0, 10.0)].map(|(x, y)| Point2::new(x, y));
        let street = |road| {
            Border::street(simworld_core::id::RoadId::from_index(road), simworld_core::net::Side::Left)
        };
        Ring { corners: corners.into_iter().collect(), borders: (0..4).map(street).collect() }
    }

    #[test]
    fn a_cut_keeps_the_area_and_the_borders() {
        let (mut west, mut east) = (Ring::default(), Ring::default());
        let ring = square();
        assert_eq!(ring.split(Point2::new(4.0, 0.0), Vector2::x(), &mut west, &mut east), Split::Both);
        assert_eq!((west.area(), east.area()), (40.0, 60.0));
        assert_eq!(west.borders[..], [ring.borders[0], Border::LAND, ring.borders[2], ring.borders[3]]);
        let streets = |ring: &Ring| ring.borders.iter().filter(|border| border.is_street()).count();
        assert_eq!((streets(&west), streets(&east)), (3, 3));
        assert!(east.borders.contains(&ring.borders[1]) && !east.borders.contains(&ring.borders[3]));
    }

    #[test]
    fn what_lies_behind_a_line_is_measured_to_the_bit() {
        let (mut behind, mut ahead) = (Ring::default(), Ring::default());
        for step in -3..24 {
            let (at, normal) = (Point2::new(f64::from(step) * 0.57, 1.3), Vector2::new(0.8, 0.6));
            let split = square().split(at, normal, &mut behind, &mut ahead);
            let expected = (split == Split::Both).then(|| behind.area());
            assert_eq!(square().area_behind(at, normal), expected, "{at}");
        }
    }

    #[test]
    fn a_line_that_misses_cuts_nothing() {
        let (mut behind, mut ahead) = (Ring::default(), Ring::default());
        assert_eq!(
            square().split(Point2::new(10.0, 0.0), Vector2::x(), &mut behind, &mut ahead),
            Split::Behind
        );
        assert_eq!(
            square().split(Point2::new(0.0, 0.0), Vector2::x(), &mut behind, &mut ahead),
            Split::Ahead
        );
    }

    #[test]
    fn a_bow_is_not_simple() {
        assert!(square().is_simple());
        let mut bow = square();
        bow.corners.swap(1, 2);
        assert!(!bow.is_simple());
    }
}
