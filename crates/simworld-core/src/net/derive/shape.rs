//! The shape of a path as a whole: a look at another path from there says in most cases whether the two touch.

use std::cell::OnceCell;

use super::extent::Extent;
use crate::geometry::{Point2, Vector2};
use crate::ops::{greater, lesser};

/// Farther away than this no middle of a path that bends is looked for, m; and no path across a junction leads there.
const FARTHEST: f64 = 1e4;
/// A shorter chord has no direction to put a box along, m.
const SHORTEST: f64 = 1e-3;
/// What is decided by less than this, m, is left to those who measure every piece, whatever was rounded.
const SLACK: f64 = 1e-6;

/// A box that holds a path, by its middle and half its sides.
#[derive(Clone, Copy)]
struct Hull {
    middle: Point2,
    along: Vector2,
    across: Vector2,
}

impl Hull {
    /// One that says nothing, about a point.
    fn everywhere(middle: Point2) -> Self {
        Self { middle, along: Vector2::new(FARTHEST, 0.0), across: Vector2::new(0.0, FARTHEST) }
    }
}

/// The straight way between the ends of a path, along and across which it is seen.
#[derive(Clone, Copy)]
pub(super) struct Outline {
    start: Point2,
    end: Point2,
    /// The straight way from the beginning to the end, and the same turned to the left.
    chord: Vector2,
    left: Vector2,
}

/// A path seen along and across the straight way between its ends, and from the middle about which it bends.
#[derive(Clone)]
pub(super) struct Shape {
    outline: Outline,
    /// Length of the straight way, m.
    length: f64,
    /// Where the beginning lies along and across the chord, seen from the origin, times the length of that.
    first: [f64; 2],
    /// What the path takes along and across its chord, times the length of that.
    beside: Extent,
    hull: Hull,
    /// Of a path that bends the middle of the circle through its beginning, its middle and its end, and what the path takes of
    /// the distance from there; once it was asked for, as it is of few.
    bend: OnceCell<Option<(Point2, Radii)>>,
    /// A quarter of the square of the length of its longest piece, m².
    sag: f64,
}

impl Outline {
    /// That of a path.
    pub(super) fn of(path: &[Point2]) -> Self {
        let start = path.first().copied().unwrap_or_else(Point2::origin);
        let end = path.last().copied().unwrap_or(start);
        let chord = end - start;
        Self { start, end, chord, left: Vector2::new(-chord.y, chord.x) }
    }

    /// Where a point lies along and across the chord, seen from the origin.
    pub(super) fn turned(&self, point: &Point2) -> [f64; 2] {
        let (chord, left) = (&self.chord, &self.left);
        [point.x * chord.x + point.y * chord.y, point.x * left.x + point.y * left.y]
    }

    /// The shape, by what all points of its path take as they are turned, and by the square of the length of its longest piece, m².
    pub(super) fn filled(&self, turned: &Extent, longest: f64) -> Shape {
        let (first, length) = (self.turned(&self.start), self.chord.norm());
        let beside = turned.moved(first.map(|first| -first));
        let hull =
            if length > SHORTEST { self.hull_of(&beside, length) } else { Hull::everywhere(self.start) };
        Shape { outline: *self, length, first, beside, hull, bend: OnceCell::new(), sag: longest * 0.25 }
    }

    /// What lies so far along and across a chord of a length.
    fn hull_of(&self, extent: &Extent, length: f64) -> Hull {
        let inverse = 0.5 / (length * length);
        let middle = [0, 1].map(|axis| (extent.low[axis] + extent.high[axis]) * inverse);
        let half = [0, 1].map(|axis| (extent.high[axis] - extent.low[axis]) * inverse);
        Hull {
            middle: self.start + self.chord * middle[0] + self.left * middle[1],
            along: self.chord * half[0],
            across: self.left * half[1],
        }
    }
}

impl Shape {
    /// The middle of the circle through both ends and a point that lies so far from the first; `None` where the three are as good as
    /// on one line.
    fn center(&self, middle: Vector2) -> Option<Point2> {
        let Outline { start, chord, .. } = self.outline;
        let twice = 2.0 * chord.perp(&middle);
        let (far, near) = (chord.norm_squared(), middle.norm_squared());
        let to_center =
            Vector2::new(middle.y * far - chord.y * near, chord.x * near - middle.x * far) / twice;
        (to_center.norm_squared() < FARTHEST * FARTHEST).then(|| start + to_center)
    }

    /// Where a point lies along and across the chord, seen from the beginning. Ten thousand kilometres from the origin some 10 nm of
    /// it are rounded.
    fn locate(&self, point: &Point2) -> [f64; 2] {
        let [along, across] = self.outline.turned(point);
        [along - self.first[0], across - self.first[1]]
    }

    fn seen(&self, path: &[Point2]) -> Extent {
        let mut extent = Extent::NONE;
        for point in path {
            extent.add(self.outline.turned(point));
        }
        // What is least stays least: this is subtracted once for all.
        extent.moved(self.first.map(|first| -first))
    }

    fn seen_hull(&self, hull: &Hull) -> Extent {
        let (middle, chord) = (self.locate(&hull.middle), self.outline.chord);
        let half = [
            chord.dot(&hull.along).abs() + chord.dot(&hull.across).abs(),
            chord.perp(&hull.along).abs() + chord.perp(&hull.across).abs(),
        ];
        Extent {
            low: [middle[0] - half[0], middle[1] - half[1]],
            high: [middle[0] + half[0], middle[1] + half[1]],
        }
    }

    /// Whether another path comes nearer than `limit` m, where that is plain from the box that holds it.
    pub(super) fn touches_box(&self, other: &Self, limit: f64) -> Option<bool> {
        self.decides(other, &self.seen_hull(&other.hull), limit)
    }

    /// Whether another path comes nearer than `limit` m, where that is plain from here: it lies beside this one, or across it.
    pub(super) fn touches(&self, other: &Self, path: &[Point2], limit: f64) -> Option<bool> {
        self.decides(other, &self.seen(path), limit)
    }

    /// The same, by what another path takes, or what holds it.
    fn decides(&self, other: &Self, seen: &Extent, limit: f64) -> Option<bool> {
        if self.beside.apart(seen) > (limit + SLACK) * self.length {
            return Some(false);
        }
        // Who comes from one side of all of this one and leaves on the other, and is between its ends all the time, crosses it.
        let slack = SLACK * self.length;
        let is_between = seen.low[0] > slack && seen.high[0] < self.length * self.length - slack;
        let (first, last) = (self.locate(&other.outline.start)[1], self.locate(&other.outline.end)[1]);
        let (low, high) = (self.beside.low[1] - slack, self.beside.high[1] + slack);
        (is_between && lesser(first, last) < low && greater(first, last) > high).then_some(true)
    }

    /// Whether the path plainly lies on one side of a line, by so much at least: both are times the length of the line's direction.
    pub(super) fn is_aside(&self, point: Point2, along: Vector2, least: f64) -> bool {
        let Hull { middle, along: own, across } = &self.hull;
        let half = along.perp(own).abs() + along.perp(across).abs();
        along.perp(&(middle - point)).abs() - half > least
    }

    /// Whether a segment plainly lies beside the path.
    pub(super) fn is_beside(&self, start: &Point2, end: &Point2) -> bool {
        let mut seen = Extent::NONE;
        seen.add(self.locate(start));
        seen.add(self.locate(end));
        self.beside.apart(&seen) > SLACK * self.length
    }

    /// The middle about which its path bends, and what that takes of the distance from there.
    fn bend(&self, path: &[Point2]) -> Option<(Point2, Radii)> {
        *self.bend.get_or_init(|| {
            let center = self.center(path.get(path.len() / 2)? - self.outline.start)?;
            Some((center, Radii::of(path, center, self.sag)))
        })
    }

    /// Whether another path bends about the same middle as its own, more than `limit` m farther out or in.
    pub(super) fn is_round(&self, own: &[Point2], other: &Self, path: &[Point2], limit: f64) -> bool {
        let is_apart = |(center, own): (Point2, Radii)| {
            let seen = Radii::of(path, center, other.sag);
            greater(seen.low.sqrt() - own.high.sqrt(), own.low.sqrt() - seen.high.sqrt()) > limit + SLACK
        };
        self.bend(own).is_some_and(is_apart)
    }
}

/// The squares of the least and of the greatest distance of a path from a point, m²; the first may be less than it is.
#[derive(Clone, Copy)]
struct Radii {
    low: f64,
    high: f64,
}

impl Radii {
    /// `sag` is by how much the square of the distance may be less within a piece than at its ends, m²: a quarter of the square of
    /// its length.
    fn of(path: &[Point2], center: Point2, sag: f64) -> Self {
        let (mut low, mut high) = (f64::INFINITY, 0.0);
        for point in path {
            let squared = (point - center).norm_squared();
            (low, high) = (lesser(squared, low), greater(squared, high));
        }
        Self { low: greater(low - sag, 0.0), high }
    }
}
