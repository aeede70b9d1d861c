//! A uniform grid over fixed points in the plane: what is nearest, and what is within a distance.

use crate::geometry::{Point2, Vector2};
use crate::lists::Lists;

/// More cells than this are not made; the cells grow instead.
const MOST_CELLS: f64 = 4e6;

/// Fixed points sorted into cells, each known by its place in the list that the grid was made of.
///
/// ```
/// use simworld_core::geometry::Point2;
/// use simworld_core::grid::PointGrid;
/// let points = [0.0, 10.0, 25.0].map(|x| Point2::new(x, 0.0));
/// let grid = PointGrid::new(points.to_vec(), 20.0);
/// assert_eq!(grid.nearest(Point2::new(12.0, 1.0)), Some(1));
/// let mut near = Vec::new();
/// grid.within(Point2::new(12.0, 1.0), 13.0, &mut near);
/// assert_eq!(near, [0, 1]);
/// ```
#[derive(Clone, Debug, Default)]
pub struct PointGrid {
    origin: Point2,
    cell: f64,
    columns: usize,
    rows: usize,
    /// The points of each cell.
    cells: Lists<u32>,
    points: Vec<Point2>,
}

impl PointGrid {
    /// A grid of cells of this width, m; where there would be millions of them, of larger ones.
    pub fn new(points: Vec<Point2>, cell: f64) -> Self {
        let Some(first) = points.first() else { return Self::default() };
        let (low, high) = points.iter().fold((*first, *first), |(low, high), p| (low.inf(p), high.sup(p)));
        let size = high - low;
        let cell = cell.max((size.x * size.y / MOST_CELLS).sqrt()).max(size.max() / MOST_CELLS);
        let columns = (size.x / cell) as usize + 1;
        let rows = (size.y / cell) as usize + 1;
        let mut grid = Self { origin: low, cell, columns, rows, cells: Lists::default(), points };
        let cells: Vec<usize> = grid.points.iter().map(|point| grid.cell_of(*point)).collect();
        grid.cells = Lists::of(columns * rows, cells.into_iter().zip(0..));
        grid
    }

    /// The points, in the order that they were given in.
    pub fn points(&self) -> &[Point2] {
        &self.points
    }

    fn column_row(&self, point: Point2) -> (usize, usize) {
        let offset = (point - self.origin) / self.cell;
        let clamp = |x: f64, count: usize| (x.max(0.0) as usize).min(count - 1);
        (clamp(offset.x, self.columns), clamp(offset.y, self.rows))
    }

    fn cell_of(&self, point: Point2) -> usize {
        let (column, row) = self.column_row(point);
        row * self.columns + column
    }

    /// The nearest point, of those that are equally near the first; `None` of no points.
    ///
    /// Searches rings of cells outwards until no nearer point can follow.
    pub fn nearest(&self, point: Point2) -> Option<usize> {
        if self.points.is_empty() {
            return None;
        }
        let (column, row) = self.column_row(point);
        let mut best: Option<(f64, u32)> = None;
        for ring in 0..self.columns.max(self.rows) {
            // A point in this ring is at least this far from the cell that the search started in.
            let least = (ring as f64 - 1.0).max(0.0) * self.cell;
            let outside = self.distance_outside(point);
            if best.is_some_and(|(distance, _)| distance < (least * least).max(outside * outside)) {
                break;
            }
            self.visit_ring(column, row, ring, &mut |candidate| {
                let distance = (self.points[candidate as usize] - point).norm_squared();
                if best.is_none_or(|best| (distance, candidate) < best) {
                    best = Some((distance, candidate));
                }
            });
        }
        best.map(|(_, index)| index as usize)
    }

    /// Puts the places of all points within a distance, m, into `out`, ascending; what it held is forgotten.
    pub fn within(&self, point: Point2, distance: f64, out: &mut Vec<u32>) {
        out.clear();
        if self.points.is_empty() {
            return;
        }
        let reach = Vector2::new(distance, distance);
        let ((left, bottom), (right, top)) = (self.column_row(point - reach), self.column_row(point + reach));
        for row in bottom..=top {
            let (first, last) = (row * self.columns + left, row * self.columns + right);
            let candidates = self.cells.run(first..=last);
            let near = |index: &&u32| (self.points[**index as usize] - point).norm() <= distance;
            out.extend(candidates.iter().filter(near));
        }
        out.sort_unstable();
    }

    /// How far a point lies outside the grid, m.
    fn distance_outside(&self, point: Point2) -> f64 {
        let far = self.origin + Vector2::new(self.columns as f64, self.rows as f64) * self.cell;
        let dx = (self.origin.x - point.x).max(point.x - far.x).max(0.0);
        let dy = (self.origin.y - point.y).max(point.y - far.y).max(0.0);
        (dx * dx + dy * dy).sqrt()
    }

    fn visit_ring(&self, column: usize, row: usize, ring: usize, visitor: &mut dyn FnMut(u32)) {
        let (left, right) = (column as isize - ring as isize, column as isize + ring as isize);
        let (bottom, top) = (row as isize - ring as isize, row as isize + ring as isize);
        let inside = |c: isize, r: isize| {
            (0..self.columns as isize).contains(&c) && (0..self.rows as isize).contains(&r)
        };
        for r in bottom.max(0)..=top.min(self.rows as isize - 1) {
            let on_edge = r == bottom || r == top;
            let step = if on_edge || ring == 0 { 1 } else { (right - left) as usize };
            for c in (left..=right).step_by(step).filter(|c| inside(*c, r)) {
                for point in &self.cells[r as usize * self.columns + c as usize] {
                    visitor(*point);
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::seed::Seed;

    #[test]
    fn what_is_found_is_that_of_a_full_search() {
        let mut rng = Seed(9).stream("grid").rng();
        let mut random =
            |reach: f64| Point2::new(rng.uniform(-reach, reach), rng.uniform(-reach, reach * 0.3));
        let points: Vec<Point2> = (0..400).map(|_| random(300.0)).collect();
        let grid = PointGrid::new(points.clone(), 20.0);
        let mut near = Vec::new();
        for index in 0..500 {
            let point = random(600.0);
            let distance = |id: usize| (points[id] - point).norm();
            let full = (0..400).min_by(|a, b| distance(*a).total_cmp(&distance(*b)));
            assert_eq!(grid.nearest(point), full);
            let radius = f64::from(index);
            let all: Vec<u32> = (0..400).filter(|id| distance(*id as usize) <= radius).collect();
            grid.within(point, radius, &mut near);
            assert_eq!(near, all);
        }
        assert_eq!(PointGrid::new(Vec::new(), 20.0).nearest(Point2::origin()), None);
        // A row of points far apart has not as many cells as it is long.
        let far = PointGrid::new(vec![Point2::origin(), Point2::new(1e9, 0.0)], 1.0);
        assert_eq!(far.nearest(Point2::new(6e8, 5.0)), Some(1));
    }
}
