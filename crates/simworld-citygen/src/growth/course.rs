//! The straight course of a proposal against points and other segments: exact in length, without a root.

use simworld_core::geometry::{Point2, Vector2};

/// A straight line from one point to another.
#[derive(Clone, Copy, Debug)]
pub(super) struct Course {
    start: Point2,
    end: Point2,
    along: Vector2,
    /// One over the square of its length, 1/m².
    inverse: f64,
}

impl Course {
    pub(super) fn new(start: Point2, end: Point2) -> Self {
        let along = end - start;
        Self { start, end, along, inverse: 1.0 / along.norm_squared().max(1e-12) }
    }

    /// The share of it at which it crosses another segment; ends count. Parallels do not cross.
    pub(super) fn crossing(&self, a: Point2, b: Point2) -> Option<f64> {
        let (along, between) = (b - a, a - self.start);
        let det = self.along.perp(&along);
        let (t, u) = (between.perp(&along), between.perp(&self.along));
        // The shares are t / det and u / det: divided only if both lie from 0 to 1.
        let (size, t, u) = if det < 0.0 { (-det, -t, -u) } else { (det, t, u) };
        // All of it is reckoned and nothing decided before the end: most segments fail, each by another one of these.
        let meets = [size >= 1e-12, t >= 0.0, t <= size, u >= 0.0, u <= size] == [true; 5];
        meets.then(|| t / size)
    }

    /// Whether it crosses another segment.
    pub(super) fn crosses(&self, a: Point2, b: Point2) -> bool {
        self.crossing(a, b).is_some()
    }

    /// The square of the distance to a point, m².
    pub(super) fn distance_squared(&self, point: Point2) -> f64 {
        let share = ((point - self.start).dot(&self.along) * self.inverse).clamp(0.0, 1.0);
        (self.start + self.along * share - point).norm_squared()
    }

    /// Whether the square of the distance to another segment is at least so much, m².
    pub(super) fn keeps_from(&self, a: Point2, b: Point2, least: f64) -> bool {
        // Far enough to one side, as most are: both ends are, in the frame of the course.
        let (aside, bside) = ((a - self.start).perp(&self.along), (b - self.start).perp(&self.along));
        let nearer = if aside.abs() < bside.abs() { aside } else { bside };
        if aside * bside > 0.0 && nearer * nearer * self.inverse > least {
            return true;
        }
        self.distance_squared(a) >= least
            && self.distance_squared(b) >= least
            && (nearest(a, b, self.start) - self.start).norm_squared() >= least
            && (nearest(a, b, self.end) - self.end).norm_squared() >= least
            && !self.crosses(a, b)
    }
}

/// The point of a segment that is nearest to another point.
pub(super) fn nearest(a: Point2, b: Point2, point: Point2) -> Point2 {
    let along = b - a;
    let share = ((point - a).dot(&along) / along.norm_squared().max(1e-12)).clamp(0.0, 1.0);
    a + along * share
}
