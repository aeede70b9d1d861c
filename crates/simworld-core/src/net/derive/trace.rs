//! Paths across a junction, made ready to be asked which of them touch.

use crate::geometry::{Point2, Vector2};
use crate::net::polyline;

/// Of every so many points of a path one is looked at first.
const STRIDE: usize = 3;

/// One piece of a path.
struct Piece {
    start: Point2,
    step: Vector2,
    /// One over the square of its length, 1/m²; nothing if it has none.
    inverse: f64,
}

/// A path with the box around it and its pieces.
pub(super) struct Trace<'a> {
    path: &'a [Point2],
    pieces: Vec<Piece>,
    low: Point2,
    high: Point2,
    /// Length of its longest piece, m.
    longest: f64,
}

impl<'a> Trace<'a> {
    pub(super) fn of(path: &'a [Point2]) -> Self {
        let around = |(low, high): (Point2, Point2), point: &Point2| (low.inf(point), high.sup(point));
        let first = path.first().copied().unwrap_or_else(Point2::origin);
        let (low, high) = path.iter().fold((first, first), around);
        let mut longest: f64 = 0.0;
        let pieces = path.windows(2).map(|pair| {
            let step = pair[1] - pair[0];
            let squared = step.norm_squared();
            longest = longest.max(squared);
            Piece { start: pair[0], step, inverse: if squared > 0.0 { 1.0 / squared } else { 0.0 } }
        });
        let pieces = pieces.collect();
        Self { path, pieces, low, high, longest: longest.sqrt() }
    }

    /// Whether the two come nearer to each other than `limit` m: the same as to compare
    /// [`polyline::distance_between`], and much faster.
    pub(super) fn touches(&self, other: &Self, limit: f64) -> bool {
        let gap = (other.low - self.high).sup(&(self.low - other.high));
        if gap.max() >= limit {
            return false;
        }
        if self.has_points_near(other, limit) {
            return true;
        }
        if self.longest.max(other.longest) >= 2.0 * limit {
            return polyline::distance_between(self.path, other.path) < limit;
        }
        // Paths that do not cross are nearest at a point of one of them. If it is one of the other's, then one of ours
        // is farther from it by half a piece at most.
        let least = self.least_distance(other, limit, 0.5 * self.longest);
        least < limit || least < limit + 0.5 * self.longest && other.least_distance(self, limit, 0.0) < limit
    }

    /// Whether one of some points of the one is that near to one of some points of the other.
    fn has_points_near(&self, other: &Self, limit: f64) -> bool {
        let near = limit * limit;
        let some = |path: &'a [Point2]| path.iter().skip(STRIDE / 2).step_by(STRIDE);
        some(self.path).any(|a| some(other.path).any(|b| (a - b).norm_squared() < near))
    }

    /// The least distance of a point of this path from the other, m, as far as it is less than `limit + margin`. Points
    /// that cannot be that near, because the one before was too far away, are passed over; and it ends below `limit`.
    fn least_distance(&self, other: &Self, limit: f64, margin: f64) -> f64 {
        let (mut least, mut slack) = (f64::INFINITY, 0.0);
        for point in self.path {
            if slack <= 1e-6 {
                let distance = other.distance(point);
                least = least.min(distance);
                if least < limit {
                    return least;
                }
                slack = distance - limit - margin;
            }
            slack -= self.longest;
        }
        least
    }

    fn distance(&self, point: &Point2) -> f64 {
        let mut least = f64::INFINITY;
        for piece in &self.pieces {
            let to = point - piece.start;
            let share = (to.dot(&piece.step) * piece.inverse).clamp(0.0, 1.0);
            least = least.min((to - piece.step * share).norm_squared());
        }
        least.sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::seed::Seed;

    #[test]
    fn samples_say_what_the_whole_paths_say() {
        let mut rng = Seed(8).stream("trace").rng();
        let mut near = 0;
        for _ in 0..4000 {
            let mut path = || -> Vec<Point2> {
                let (mut at, mut heading) =
                    (Point2::new(rng.uniform(0.0, 20.0), rng.uniform(0.0, 20.0)), rng.uniform(-3.0, 3.0));
                let turn = rng.uniform(-0.25, 0.25);
                (0..14)
                    .map(|_| {
                        heading += turn;
                        at += crate::geometry::direction(heading) * 1.1;
                        at
                    })
                    .collect()
            };
            let (a, b) = (path(), path());
            let expected = polyline::distance_between(&a, &b) < 2.4;
            near += usize::from(expected);
            assert_eq!(Trace::of(&a).touches(&Trace::of(&b), 2.4), expected, "{a:?} {b:?}");
        }
        assert!((800..3200).contains(&near), "{near} of 4000 say nothing");
    }

    #[test]
    fn the_short_way_to_nearness_agrees_with_the_long_one() {
        let mut rng = Seed(5).stream("polyline").rng();
        let mut near = 0;
        for _ in 0..2000 {
            let mut path = |stride: f64| -> Vec<Point2> {
                let mut at = Point2::new(rng.uniform(0.0, 15.0), rng.uniform(0.0, 15.0));
                let mut step = || Vector2::new(rng.uniform(-stride, stride), rng.uniform(-stride, stride));
                (0..6)
                    .map(|_| {
                        at += step();
                        at
                    })
                    .collect()
            };
            let (a, b) = (path(2.0), path(9.0));
            let expected = polyline::distance_between(&a, &b) < 1.5;
            near += usize::from(expected);
            assert_eq!(Trace::of(&a).touches(&Trace::of(&b), 1.5), expected, "{a:?} {b:?}");
            assert_eq!(Trace::of(&b).touches(&Trace::of(&a), 1.5), expected, "{a:?} {b:?}");
        }
        assert!((400..1600).contains(&near), "{near} of 2000 say nothing");
    }
}
