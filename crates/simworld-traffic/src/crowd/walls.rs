//! Straight walls, found by cell.

use simworld_core::geometry::Point2;
use simworld_core::lists::Lists;

use super::{Surroundings, Wall};

/// Walls farther away than this are not noticed, m: more than one walks in a step.
const REACH: f64 = 1.5;
/// Least width of a cell, m.
const CELL: f64 = 2.0;
/// Cells a wall, beyond which they are made wider.
const CELLS: f64 = 64.0;

/// The straight walls of a place, found by a grid over their bounds.
///
/// ```
/// use simworld_core::geometry::Point2;
/// use simworld_traffic::crowd::{Surroundings, Walls};
/// let walls = Walls::new(vec![(Point2::new(0.0, 0.0), Point2::new(10.0, 0.0))]);
/// let mut near = Vec::new();
/// walls.near(0, Point2::new(4.0, 1.0), &mut near);
/// assert_eq!(near[0].distance, 1.0);
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Walls {
    pieces: Vec<(Point2, Point2)>,
    low: Point2,
    width: f64,
    columns: usize,
    rows: usize,
    /// The numbers of the walls near each cell.
    near: Lists<u32>,
}

impl Walls {
    /// Walls from point to point; those that are not finite are left out.
    pub fn new(mut pieces: Vec<(Point2, Point2)>) -> Self {
        let finite = |point: &Point2| point.x.is_finite() && point.y.is_finite();
        pieces.retain(|(a, b)| finite(a) && finite(b));
        let Some(first) = pieces.first().map(|piece| piece.0) else { return Self::default() };
        let ends = || pieces.iter().flat_map(|(a, b)| [*a, *b]);
        let margin = nalgebra::Vector2::new(REACH, REACH);
        let low = ends().fold(first, |low, point| low.inf(&point)) - margin;
        let high = ends().fold(first, |high, point| high.sup(&point)) + margin;
        let span = high - low;
        let most = CELLS * pieces.len() as f64;
        let width = CELL.max((span.x * span.y / most).sqrt()).max(span.max() / most);
        let count = |span: f64| (span / width).floor() as usize + 1;
        let (columns, rows) = (count(span.x), count(span.y));
        let mut walls = Self { pieces, low, width, columns, rows, near: Lists::default() };
        walls.sort();
        walls
    }

    fn sort(&mut self) {
        let mut cells: Vec<(usize, u32)> = Vec::new();
        let around = REACH + self.width * std::f64::consts::FRAC_1_SQRT_2;
        for (index, (a, b)) in self.pieces.iter().enumerate() {
            let margin = nalgebra::Vector2::new(REACH, REACH);
            let (low, high) = (a.inf(b) - margin, a.sup(b) + margin);
            let rows = self.line(low.y - self.low.y, self.rows)..=self.line(high.y - self.low.y, self.rows);
            for row in rows {
                let columns = self.line(low.x - self.low.x, self.columns)
                    ..=self.line(high.x - self.low.x, self.columns);
                for column in columns {
                    let middle = nalgebra::Vector2::new(column as f64 + 0.5, row as f64 + 0.5) * self.width;
                    if (nearest((*a, *b), self.low + middle) - (self.low + middle)).norm() <= around {
                        cells.push((row * self.columns + column, index as u32));
                    }
                }
            }
        }
        self.near = Lists::of(self.columns * self.rows, cells.into_iter());
    }

    /// The row or column at a distance from the first.
    fn line(&self, distance: f64, count: usize) -> usize {
        ((distance / self.width).max(0.0) as usize).min(count - 1)
    }
}

impl Surroundings for Walls {
    fn near(&self, _: usize, at: Point2, found: &mut Vec<Wall>) {
        let from_low = at - self.low;
        let (column, row) = (from_low.x / self.width, from_low.y / self.width);
        let inside = (0.0..self.columns as f64).contains(&column) && (0.0..self.rows as f64).contains(&row);
        if !inside {
            return;
        }
        for index in &self.near[row as usize * self.columns + column as usize] {
            let offset = nearest(self.pieces[*index as usize], at) - at;
            let distance = offset.norm();
            if distance > 0.0 && distance <= REACH {
                found.push(Wall { toward: offset / distance, distance });
            }
        }
    }
}

/// The point of a wall that is nearest to a place.
fn nearest((a, b): (Point2, Point2), place: Point2) -> Point2 {
    let along = b - a;
    let length = along.norm_squared();
    let share = if length > 0.0 { ((place - a).dot(&along) / length).clamp(0.0, 1.0) } else { 0.0 };
    a + along * share
}
