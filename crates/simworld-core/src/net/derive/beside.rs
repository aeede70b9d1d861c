//! How far points are from a kerb, asked of many points.

use crate::geometry::Point2;
#[cfg(test)]
use crate::net::polyline;

/// So many pieces are measured at once: each instruction works on several.
const LANES: usize = 4;

/// Some pieces of a kerb. What is left of the last block repeats the last piece.
#[derive(Clone, Copy, Default)]
struct Block {
    /// Where each begins.
    x: [f64; LANES],
    y: [f64; LANES],
    /// The way to its end.
    step_x: [f64; LANES],
    step_y: [f64; LANES],
    /// The square of its length, m²; infinite if it has none, so that every point is nearest to where it begins.
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
        let is_left = self.blocks[piece / LANES].is_left(piece % LANES, point);
        if is_left { distance } else { -distance }
    }
}

impl Block {
    fn of(line: &[Point2], first: usize) -> Self {
        let mut block = Self::default();
        for lane in 0..LANES {
            let index = (first + lane).min(line.len() - 2);
            let (start, step) = (line[index], line[index + 1] - line[index]);
            let span = step.norm();
            (block.x[lane], block.y[lane]) = (start.x, start.y);
            (block.step_x[lane], block.step_y[lane]) = (step.x, step.y);
            block.squared[lane] = if span > 0.0 { span * span } else { f64::INFINITY };
        }
        block
    }

    /// The squares of the distances of a point from its pieces, m².
    fn distances_squared(&self, point: &Point2) -> [f64; LANES] {
        std::array::from_fn(|lane| {
            let (to_x, to_y) = (point.x - self.x[lane], point.y - self.y[lane]);
            let (along_x, along_y) = (self.step_x[lane], self.step_y[lane]);
            let share = ((to_x * along_x + to_y * along_y) / self.squared[lane]).clamp(0.0, 1.0);
            let (away_x, away_y) = (to_x - along_x * share, to_y - along_y * share);
            away_x * away_x + away_y * away_y
        })
    }

    /// Whether a point lies on the left of one of its pieces.
    fn is_left(&self, lane: usize, point: &Point2) -> bool {
        let (to_x, to_y) = (point.x - self.x[lane], point.y - self.y[lane]);
        self.step_x[lane] * to_y - self.step_y[lane] * to_x >= 0.0
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
