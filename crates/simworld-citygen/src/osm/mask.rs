//! A coarse map of the places that matter, so that nothing is worked out for the others.

use simworld_core::geometry::{Point2, bounds};

/// Width of a cell of the mask, m.
const CELL: f64 = 16.0;
/// Cells along one side of the mask; it is wrapped round, so that far places share cells.
const SIDE: i64 = 1024;
/// What covers more cells than this along one side is taken to touch anything.
const MOST_CELLS: i64 = 64;

/// Places that matter: a set of cells, which may say yes where the truth is no, but never the other way round.
pub(super) struct Mask {
    bits: Vec<u64>,
    is_full: bool,
}

impl Mask {
    pub(super) fn new() -> Self {
        Self { bits: vec![0; (SIDE * SIDE / 64) as usize], is_full: false }
    }

    /// Marks the box round some points, and so much round it, m.
    pub(super) fn mark(&mut self, points: &[Point2], beside: f64) {
        match cells(points, beside) {
            Some(cells) => cells.for_each(|(word, bit)| self.bits[word] |= bit),
            None => self.is_full = true,
        }
    }

    /// Whether a piece of a path, and so much round it, touches a place that matters.
    pub(super) fn touches_path(&self, path: &[Point2], beside: f64) -> bool {
        path.windows(2).any(|piece| self.touches(piece, beside))
    }

    /// Whether the box round some points, and so much round it, touches a place that matters.
    pub(super) fn touches(&self, points: &[Point2], beside: f64) -> bool {
        let Some(mut cells) = cells(points, beside) else { return true };
        self.is_full || cells.any(|(word, bit)| self.bits[word] & bit != 0)
    }
}

/// The words and bits of the cells of a box; `None` if they are too many.
fn cells(points: &[Point2], beside: f64) -> Option<impl Iterator<Item = (usize, u64)>> {
    let (low, high) = bounds(points).unwrap_or_default();
    let cell = |x: f64| (x / CELL).floor() as i64;
    let columns = cell(low.x - beside)..=cell(high.x + beside);
    let rows = cell(low.y - beside)..=cell(high.y + beside);
    let is_small = [&columns, &rows].iter().all(|range| range.end() - range.start() < MOST_CELLS);
    is_small.then(|| {
        rows.flat_map(move |row| {
            columns.clone().map(move |column| {
                let index = row.rem_euclid(SIDE) * SIDE + column.rem_euclid(SIDE);
                ((index / 64) as usize, 1 << (index % 64))
            })
        })
    })
}
