//! A uniform grid of the pieces of streets, whose lists are chained through one arena, so that pieces come and go.

use simworld_core::geometry::Point2;

/// The end of a chain.
const END: u32 = u32::MAX;
/// Ranges are widened by this share of a cell, far above rounding, so that pieces that touch share a cell.
const SLACK: f64 = 1e-6;

#[derive(Clone, Copy, Debug)]
struct Entry {
    street: u32,
    piece: u32,
    next: u32,
}

/// Which pieces lie in which cells. Beyond the bounds the outermost cells go on without end.
#[derive(Clone, Debug)]
pub(super) struct PieceGrid {
    origin: Point2,
    cell: f64,
    columns: usize,
    rows: usize,
    heads: Vec<u32>,
    entries: Vec<Entry>,
    free: u32,
}

impl PieceGrid {
    /// An empty grid for about `pieces` pieces of `length` m in all, between two corners.
    pub(super) fn new(low: Point2, high: Point2, pieces: usize, length: f64) -> Self {
        let count = pieces.max(1) as f64;
        let size = high - low;
        // Cells are as long as pieces, but for pieces strewn so thinly that the grid would outgrow them.
        let cell = (length / count)
            .max((size.x * size.y / (2.0 * count)).sqrt())
            .max((size.x + size.y) / (count + 16.0))
            .max(1.0);
        let columns = (size.x / cell) as usize + 1;
        let rows = (size.y / cell) as usize + 1;
        let heads = vec![END; columns * rows];
        let entries = Vec::with_capacity(pieces * 3);
        Self { origin: low, cell, columns, rows, heads, entries, free: END }
    }

    fn column(&self, x: f64) -> usize {
        (((x - self.origin.x) / self.cell).max(0.0) as usize).min(self.columns - 1)
    }

    fn row(&self, y: f64) -> usize {
        (((y - self.origin.y) / self.cell).max(0.0) as usize).min(self.rows - 1)
    }

    /// Calls with the index of every cell that a straight piece touches.
    fn cells(&self, a: Point2, b: Point2, mut visit: impl FnMut(usize)) {
        let slack = SLACK * self.cell;
        let (first, last) = (self.row(a.y.min(b.y) - slack), self.row(a.y.max(b.y) + slack));
        for row in first..=last {
            // The part of the piece in this row; all of it, if it is level or there is but this row.
            let share =
                |y: f64| if a.y == b.y { f64::NAN } else { ((y - a.y) / (b.y - a.y)).clamp(0.0, 1.0) };
            let bottom = self.origin.y + row as f64 * self.cell - slack;
            let top = bottom + self.cell + 2.0 * slack;
            let low = if row == 0 { f64::NAN } else { share(bottom) };
            let high = if row == self.rows - 1 { f64::NAN } else { share(top) };
            let lower = if a.y <= b.y { a.x } else { b.x };
            let upper = if a.y <= b.y { b.x } else { a.x };
            let x = |share: f64, open: f64| if share.is_nan() { open } else { a.x + (b.x - a.x) * share };
            let (x0, x1) = (x(low, lower), x(high, upper));
            for column in self.column(x0.min(x1) - slack)..=self.column(x0.max(x1) + slack) {
                visit(row * self.columns + column);
            }
        }
    }

    /// Calls with the street and number of every piece in the cells that a straight piece touches, some more than once.
    pub(super) fn visit(&self, a: Point2, b: Point2, mut visit: impl FnMut(u32, u32)) {
        self.cells(a, b, |cell| {
            let mut at = self.heads[cell];
            while at != END {
                let entry = self.entries[at as usize];
                visit(entry.street, entry.piece);
                at = entry.next;
            }
        });
    }

    pub(super) fn insert(&mut self, street: u32, piece: u32, a: Point2, b: Point2) {
        // The grid is taken out, so that its cells can be walked while its arena grows.
        let mut heads = std::mem::take(&mut self.heads);
        let (mut entries, mut free) = (std::mem::take(&mut self.entries), self.free);
        self.cells(a, b, |cell| {
            let entry = Entry { street, piece, next: heads[cell] };
            if free == END {
                heads[cell] = entries.len() as u32;
                entries.push(entry);
            } else {
                heads[cell] = free;
                free = std::mem::replace(&mut entries[free as usize], entry).next;
            }
        });
        (self.heads, self.entries, self.free) = (heads, entries, free);
    }

    /// Takes out a piece that was put in with the same ends.
    pub(super) fn remove(&mut self, street: u32, piece: u32, a: Point2, b: Point2) {
        let mut heads = std::mem::take(&mut self.heads);
        let (mut entries, mut free) = (std::mem::take(&mut self.entries), self.free);
        self.cells(a, b, |cell| {
            let (mut before, mut at) = (END, heads[cell]);
            while at != END {
                let entry = entries[at as usize];
                if (entry.street, entry.piece) == (street, piece) {
                    match before {
                        END => heads[cell] = entry.next,
                        _ => entries[before as usize].next = entry.next,
                    }
                    entries[at as usize].next = free;
                    free = at;
                    return;
                }
                (before, at) = (at, entry.next);
            }
        });
        (self.heads, self.entries, self.free) = (heads, entries, free);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pieces_are_found_until_they_are_taken_out() {
        let at = |x: f64, y: f64| Point2::new(x, y);
        let mut grid = PieceGrid::new(at(0.0, 0.0), at(100.0, 100.0), 10, 200.0);
        let (a, b) = (at(-50.0, 3.0), at(140.0, 97.0));
        grid.insert(4, 2, a, b);
        let found = |grid: &PieceGrid, p: Point2, q: Point2| {
            let mut found = false;
            grid.visit(p, q, |street, piece| found |= (street, piece) == (4, 2));
            found
        };
        for share in 0..=100 {
            let on = a + (b - a) * (f64::from(share) / 100.0);
            assert!(found(&grid, on, on), "{on}");
        }
        assert!(!found(&grid, at(5.0, 95.0), at(6.0, 96.0)));
        grid.remove(4, 2, a, b);
        assert!(!found(&grid, a, b));
    }
}
