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
        let (crosses, t, size) = self.meets(a, b);
        crosses.then(|| t / size)
    }

    /// Whether it crosses another segment.
    pub(super) fn crosses(&self, a: Point2, b: Point2) -> bool {
        self.meets(a, b).0
    }

    /// Whether it crosses another segment, and two numbers: if it does, it is at the share of the one in the other.
    fn meets(&self, a: Point2, b: Point2) -> (bool, f64, f64) {
        let (along, between) = (b - a, a - self.start);
        let det = self.along.perp(&along);
        // Both are shares times the determinant; by its sign they are turned.
        let sign = 1.0_f64.copysign(det);
        let (size, t, u) = (det.abs(), sign * between.perp(&along), sign * between.perp(&self.along));
        // All of it is reckoned and nothing decided before the end: most segments fail, each by another one of these.
        let crosses = all([size >= 1e-12, t >= 0.0, t <= size, u >= 0.0, u <= size]);
        (crosses, t, size)
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

/// Whether the square of the distance of a point to a segment may be as little as `least`, m²: nothing that is so near is
/// denied, and next to nothing else is affirmed.
pub(super) fn may_be_near(a: Point2, b: Point2, point: Point2, least: f64) -> bool {
    // Far above rounding.
    let least = least * (1.0 + 1e-6);
    let (along, from) = (b - a, point - a);
    let (square, share, aside) = (along.norm_squared(), from.dot(&along), from.perp(&along));
    let is_beside = all([share >= 0.0, share <= square, aside * aside <= least * square]);
    let [is_near_a, is_near_b] = [from, point - b].map(|way| way.norm_squared() <= least);
    is_beside | is_near_a | is_near_b
}

/// Whether all are true, for which all are asked: none of them can be foretold.
pub(super) fn all<const COUNT: usize>(answers: [bool; COUNT]) -> bool {
    answers.into_iter().fold(true, |all, one| all & one)
}

/// The point of a segment that is nearest to another point.
pub(super) fn nearest(a: Point2, b: Point2, point: Point2) -> Point2 {
    let along = b - a;
    let share = ((point - a).dot(&along) / along.norm_squared().max(1e-12)).clamp(0.0, 1.0);
    a + along * share
}
