//! A uniform grid over fixed points, for nearest-point queries.

use super::Waypoint;
use crate::geometry::Point2;
use crate::id::WaypointId;

/// Width of a cell, m.
const CELL: f64 = 20.0;
/// More cells than this are not made; the cells grow instead.
const MOST_CELLS: f64 = 4e6;

/// Points sorted into cells; the points of cell i are `points[starts[i]..starts[i + 1]]`.
#[derive(Clone, Debug, Default)]
pub(super) struct PointGrid {
    origin: Point2,
    cell: f64,
    columns: usize,
    rows: usize,
    starts: Vec<u32>,
    points: Vec<u32>,
}

impl PointGrid {
    pub(super) fn new(waypoints: &[Waypoint]) -> Self {
        let Some(first) = waypoints.first() else { return Self::default() };
        let bounds = (first.position, first.position);
        let (low, high) =
            waypoints.iter().fold(bounds, |(low, high), w| (low.inf(&w.position), high.sup(&w.position)));
        let size = high - low;
        let cell = CELL.max((size.x * size.y / MOST_CELLS).sqrt());
        let columns = (size.x / cell) as usize + 1;
        let rows = (size.y / cell) as usize + 1;
        let mut grid =
            Self { origin: low, cell, columns, rows, starts: vec![0; columns * rows + 1], points: vec![] };
        let cells: Vec<usize> = waypoints.iter().map(|w| grid.cell_of(w.position)).collect();
        for cell in &cells {
            grid.starts[cell + 1] += 1;
        }
        for index in 1..grid.starts.len() {
            grid.starts[index] += grid.starts[index - 1];
        }
        let mut next = grid.starts.clone();
        grid.points = vec![0; waypoints.len()];
        for (point, cell) in cells.into_iter().enumerate() {
            grid.points[next[cell] as usize] = point as u32;
            next[cell] += 1;
        }
        grid
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

    /// Searches rings of cells outwards until no nearer point can follow.
    pub(super) fn nearest(&self, waypoints: &[Waypoint], point: Point2) -> Option<WaypointId> {
        if waypoints.is_empty() {
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
                let distance = (waypoints[candidate as usize].position - point).norm_squared();
                if best.is_none_or(|best| (distance, candidate) < best) {
                    best = Some((distance, candidate));
                }
            });
        }
        best.map(|(_, index)| WaypointId(index))
    }

    /// How far a point lies outside the grid, m.
    fn distance_outside(&self, point: Point2) -> f64 {
        let far =
            self.origin + crate::geometry::Vector2::new(self.columns as f64, self.rows as f64) * self.cell;
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
                let cell = r as usize * self.columns + c as usize;
                for point in &self.points[self.starts[cell] as usize..self.starts[cell + 1] as usize] {
                    visitor(*point);
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::WaypointKind;
    use super::*;
    use crate::seed::Seed;

    #[test]
    fn the_nearest_is_that_of_a_full_search() {
        let mut rng = Seed(9).stream("grid").rng();
        let mut random =
            |reach: f64| Point2::new(rng.uniform(-reach, reach), rng.uniform(-reach, reach * 0.3));
        let waypoints: Vec<Waypoint> =
            (0..400).map(|_| Waypoint { position: random(300.0), kind: WaypointKind::Sidewalk }).collect();
        let grid = PointGrid::new(&waypoints);
        for _ in 0..500 {
            let point = random(600.0);
            let distance = |id: WaypointId| (waypoints[id.index()].position - point).norm();
            let full = (0..400).map(WaypointId).min_by(|a, b| distance(*a).total_cmp(&distance(*b)));
            assert_eq!(grid.nearest(&waypoints, point), full);
        }
    }
}
