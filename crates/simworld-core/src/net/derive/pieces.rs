//! Some pieces of a line, side by side: several are measured by each instruction.

use crate::geometry::Point2;
use crate::ops::{greater, lesser};

/// So many pieces are measured at once.
pub(super) const LANES: usize = 4;

/// Where pieces of a line begin, and the way to their ends. What is left of the last ones of a line repeats its last piece.
#[derive(Clone, Copy, Default)]
pub(super) struct Pieces {
    x: [f64; LANES],
    y: [f64; LANES],
    step_x: [f64; LANES],
    step_y: [f64; LANES],
}

impl Pieces {
    /// Those from a point of a line on, which is not its last one.
    pub(super) fn of(line: &[Point2], first: usize) -> Self {
        let mut pieces = Self::default();
        for lane in 0..LANES {
            let index = (first + lane).min(line.len() - 2);
            let (start, step) = (line[index], line[index + 1] - line[index]);
            (pieces.x[lane], pieces.y[lane]) = (start.x, start.y);
            (pieces.step_x[lane], pieces.step_y[lane]) = (step.x, step.y);
        }
        pieces
    }

    /// The square of the length of a piece, m².
    pub(super) fn length_squared(&self, lane: usize) -> f64 {
        self.step_x[lane] * self.step_x[lane] + self.step_y[lane] * self.step_y[lane]
    }

    /// The squares of the distances of a point from the pieces, m². `share` makes of the dot product of a piece with the way to the
    /// point the share of the piece at which the point is nearest.
    #[inline]
    pub(super) fn distances_squared(
        &self,
        point: &Point2,
        share: impl Fn(f64, usize) -> f64,
    ) -> [f64; LANES] {
        std::array::from_fn(|lane| {
            let (to_x, to_y) = (point.x - self.x[lane], point.y - self.y[lane]);
            let (along_x, along_y) = (self.step_x[lane], self.step_y[lane]);
            let share = lesser(greater(share(to_x * along_x + to_y * along_y, lane), 0.0), 1.0);
            let (away_x, away_y) = (to_x - along_x * share, to_y - along_y * share);
            away_x * away_x + away_y * away_y
        })
    }

    /// On which side of each piece a point lies: on the left, or on its line, where the number is not negative.
    #[inline]
    pub(super) fn sides(&self, point: &Point2) -> [f64; LANES] {
        std::array::from_fn(|lane| {
            let (to_x, to_y) = (point.x - self.x[lane], point.y - self.y[lane]);
            self.step_x[lane] * to_y - self.step_y[lane] * to_x
        })
    }
}
