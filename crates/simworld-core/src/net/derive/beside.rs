//! How far points are from a kerb, asked of many points.

use super::outside::Outside;
use super::pieces::{LANES, Pieces};
use crate::geometry::Point2;
use crate::net::polyline;
use crate::ops::{greater, lesser};

/// Where it is plain that a point is farther off than something, it is by more than this, m, whatever was rounded.
const SLACK: f64 = 1e-6;

/// Some pieces of a kerb.
#[derive(Clone, Copy)]
struct Block {
    line: Pieces,
    /// The square of the length of each, m²; infinite if it has none, so that every point is nearest to where it begins.
    squared: [f64; LANES],
}

/// A kerb of which much is asked. It keeps its memory from one kerb to the next.
#[derive(Default)]
pub(super) struct Kerb {
    line: Vec<Point2>,
    outside: Option<Outside>,
    /// Its pieces, once they are measured.
    blocks: Vec<Block>,
}

impl Kerb {
    /// Takes another kerb.
    pub(super) fn set(&mut self, line: &[Point2]) {
        self.line.clear();
        self.line.extend_from_slice(line);
        self.outside = Outside::of(line);
        self.blocks.clear();
    }

    /// How far the nearest point of a path is from it, where it lies on the path's right, m; negative beyond the kerb, and no more
    /// than `most`.
    pub(super) fn clearance(&mut self, path: &[Point2], most: f64) -> f64 {
        self.clearance_above(path, f64::NEG_INFINITY, most).unwrap_or(f64::NEG_INFINITY)
    }

    /// The same, if it is more than `least` m.
    pub(super) fn clearance_above(&mut self, path: &[Point2], least: f64, most: f64) -> Option<f64> {
        // It is nearest to the middle of most paths: from there on fewer points are asked exactly.
        let (before, after) = path.split_at(path.len() / 2);
        let mut points = after.iter().chain(before.iter().rev());
        points.try_fold(most, |nearest, point| {
            let plainly = self.outside.as_ref().map_or(f64::NEG_INFINITY, |outside| outside.least(point));
            if plainly > greater(nearest, 0.0) + SLACK {
                return Some(nearest);
            }
            let beside = self.beside(point);
            (beside > least).then(|| lesser(beside, nearest))
        })
    }

    /// How far a point is from it on the side of the carriageway, m: the lateral of [`polyline::closest`], to the bit, and
    /// infinite if it has no piece. It is a function by itself: the loop over what is plainly farther off stays small.
    #[inline(never)]
    fn beside(&mut self, point: &Point2) -> f64 {
        if self.blocks.is_empty() {
            let firsts = (1..self.line.len()).step_by(LANES).map(|first| first - 1);
            self.blocks.extend(firsts.map(|first| Block::of(&self.line, first)));
        }
        // Which piece is nearest is anybody's guess, and who guesses wrong waits; that it has the point on its left can be foretold.
        let (mut least, mut right) = ([f64::INFINITY; LANES], [f64::INFINITY; LANES]);
        for block in &self.blocks {
            let (squares, sides) = (block.distances_squared(point), block.line.sides(point));
            for lane in 0..LANES {
                let on_right = if sides[lane] >= 0.0 { f64::INFINITY } else { squares[lane] };
                least[lane] = lesser(squares[lane], least[lane]);
                right[lane] = lesser(on_right, right[lane]);
            }
        }
        let [least, right] = [least, right].map(|squares| squares.into_iter().fold(f64::INFINITY, lesser));
        // Several squares that differ by a bit may have one root, and of pieces equally far by the root the first counts.
        if right > least * (1.0 + 1e-15) {
            return least.sqrt();
        }
        polyline::closest(&self.line, point).map_or(f64::INFINITY, |near| near.lateral)
    }
}

impl Block {
    fn of(kerb: &[Point2], first: usize) -> Self {
        let line = Pieces::of(kerb, first);
        let squared = |lane: usize| {
            // By the length, as `closest` has it: the square of the step may be another by a bit.
            let span = line.length_squared(lane).sqrt();
            if span > 0.0 { span * span } else { f64::INFINITY }
        };
        Self { line, squared: std::array::from_fn(squared) }
    }

    /// The squares of the distances of a point from its pieces, m².
    fn distances_squared(&self, point: &Point2) -> [f64; LANES] {
        self.line.distances_squared(point, |product, lane| product / self.squared[lane])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::seed::Seed;

    #[test]
    fn what_is_plainly_off_a_kerb_changes_no_clearance() {
        let mut rng = Seed(9).stream("clearance").rng();
        let mut kerb = Kerb::default();
        let mut limits = [0; 2];
        for _ in 0..2000 {
            let (mut at, mut heading) = (Point2::origin(), rng.uniform(-3.0, 3.0));
            let mut line = vec![at];
            for _ in 0..8 {
                at += crate::geometry::direction(heading) * rng.uniform(0.1, 3.0);
                heading -= rng.uniform(-0.01, 0.4);
                line.push(at);
            }
            kerb.set(&line);
            let point = |_| Point2::new(rng.uniform(-9.0, 9.0), rng.uniform(-9.0, 9.0));
            let path: Vec<Point2> = (0..3).map(point).collect();
            let lateral = |point| polyline::closest(&line, point).map_or(f64::INFINITY, |near| near.lateral);
            let clear = path.iter().map(lateral).fold(f64::INFINITY, f64::min);
            for most in [-2.0, 0.0, 2.0, f64::INFINITY] {
                assert_eq!(kerb.clearance(&path, most), clear.min(most), "{path:?} beside {line:?}");
                let above = (clear > 1.0).then_some(clear.min(most)).filter(|_| most > 1.0);
                assert!(most <= 1.0 || kerb.clearance_above(&path, 1.0, most) == above);
            }
            limits[usize::from(clear > 0.0)] += 1;
        }
        assert!(limits.iter().all(|count| *count > 300), "{limits:?} say nothing");
    }

    #[test]
    fn it_is_the_lateral_of_the_nearest_point_to_the_bit() {
        let mut rng = Seed(5).stream("beside").rng();
        let mut kerb = Kerb::default();
        for pieces in 0..9 {
            for _ in 0..200 {
                let mut line: Vec<Point2> = (0..=pieces)
                    .map(|_| Point2::new(rng.uniform(-9.0, 9.0), rng.uniform(-9.0, 9.0)))
                    .collect();
                // Pieces without a length are none; corners are nearest to many points.
                if pieces > 3 {
                    line[2] = line[1];
                }
                kerb.set(&line);
                for _ in 0..20 {
                    let point = Point2::new(rng.uniform(-15.0, 15.0), rng.uniform(-15.0, 15.0));
                    let lateral = polyline::closest(&line, &point).map_or(f64::INFINITY, |near| near.lateral);
                    assert_eq!(kerb.beside(&point).to_bits(), lateral.to_bits(), "{point} beside {line:?}");
                }
                // The points of a kerb themselves, where several pieces are as near.
                for point in &line {
                    let lateral = polyline::closest(&line, point).map_or(f64::INFINITY, |near| near.lateral);
                    assert_eq!(kerb.beside(point).to_bits(), lateral.to_bits(), "{point} of {line:?}");
                }
            }
        }
    }
}
