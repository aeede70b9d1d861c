//! How far points are from a kerb, asked of many points.

use super::pieces::{LANES, Pieces};
use crate::geometry::Point2;
#[cfg(test)]
use crate::net::polyline;

/// Some pieces of a kerb.
#[derive(Clone, Copy)]
struct Block {
    line: Pieces,
    /// The square of the length of each, m²; infinite if it has none, so that every point is nearest to where it begins.
    squared: [f64; LANES],
}

/// A kerb whose pieces are measured once. It keeps its memory from one kerb to the next.
#[derive(Default)]
pub(super) struct Kerb {
    blocks: Vec<Block>,
    /// The squares of the distances of a point from the pieces of each block, m².
    squares: Vec<[f64; LANES]>,
}

impl Kerb {
    /// Measures another kerb.
    pub(super) fn set(&mut self, line: &[Point2]) {
        self.blocks.clear();
        self.blocks.extend((1..line.len()).step_by(LANES).map(|first| Block::of(line, first - 1)));
        self.squares.resize(self.blocks.len(), [0.0; LANES]);
    }

    /// How far the nearest point of a path is from it, where it lies on the path's right, m; negative beyond the kerb.
    pub(super) fn clearance(&mut self, path: &[Point2]) -> f64 {
        path.iter().map(|point| self.beside(point)).fold(f64::INFINITY, f64::min)
    }

    /// The same, if it is more than `least` m.
    pub(super) fn clearance_above(&mut self, path: &[Point2], least: f64) -> Option<f64> {
        path.iter().try_fold(f64::INFINITY, |nearest: f64, point| {
            let beside = self.beside(point);
            (beside > least).then(|| nearest.min(beside))
        })
    }

    /// How far a point is from it on the side of the carriageway, m: the lateral of [`polyline::closest`], to the bit, and
    /// infinite if it has no piece.
    pub(super) fn beside(&mut self, point: &Point2) -> f64 {
        let mut least = f64::INFINITY;
        for (block, squares) in self.blocks.iter().zip(&mut self.squares) {
            *squares = block.distances_squared(point);
            least =
                squares.iter().fold(least, |least, squared| if *squared < least { *squared } else { least });
        }
        // Of those equally far by the root the first counts, and the roots of several squares are one number.
        let (distance, bound) = (least.sqrt(), least * (1.0 + 1e-15));
        let is_nearest = |squared: &f64| *squared <= bound && squared.sqrt() == distance;
        let Some(piece) = self.squares.as_flattened().iter().position(is_nearest) else {
            return f64::INFINITY;
        };
        let is_left = self.blocks[piece / LANES].line.is_left(piece % LANES, point);
        if is_left { distance } else { -distance }
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
