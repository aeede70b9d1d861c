//! What lies near a place: rectangles by the cells of a coarse grid that they touch.

use std::collections::{BTreeMap, BTreeSet};

use simworld_core::geometry::{Point2, Vector2};

/// Width of a cell, m: a few blocks.
const CELL: f64 = 250.0;

/// Rectangles with numbers, filed by cells.
#[derive(Clone, Debug, Default)]
pub(super) struct Cells {
    cells: BTreeMap<(i32, i32), Vec<u32>>,
}

/// A rectangle, least and greatest corner.
pub(super) type Bounds = (Point2, Point2);

/// A rectangle with so much more on every side.
pub(super) fn inflated((low, high): Bounds, by: f64) -> Bounds {
    let by = Vector2::repeat(by);
    (low - by, high + by)
}

impl Cells {
    fn touched((low, high): Bounds) -> impl Iterator<Item = (i32, i32)> {
        let cell = |x: f64| (x / CELL).floor() as i32;
        let rows = cell(low.y)..=cell(high.y);
        (cell(low.x)..=cell(high.x)).flat_map(move |column| rows.clone().map(move |row| (column, row)))
    }

    pub(super) fn insert(&mut self, number: usize, bounds: Bounds) {
        for cell in Self::touched(bounds) {
            self.cells.entry(cell).or_default().push(number as u32);
        }
    }

    pub(super) fn remove(&mut self, number: usize, bounds: Bounds) {
        for cell in Self::touched(bounds) {
            if let Some(list) = self.cells.get_mut(&cell) {
                list.retain(|other| *other as usize != number);
            }
        }
    }

    /// The numbers of what may touch a rectangle.
    pub(super) fn near(&self, bounds: Bounds) -> BTreeSet<usize> {
        self.near_any([bounds])
    }

    /// The numbers of what may touch one of some rectangles.
    pub(super) fn near_any(&self, bounds: impl IntoIterator<Item = Bounds>) -> BTreeSet<usize> {
        let touched: BTreeSet<(i32, i32)> = bounds.into_iter().flat_map(Self::touched).collect();
        let numbers = touched.iter().filter_map(|cell| self.cells.get(cell)).flatten();
        numbers.map(|number| *number as usize).collect()
    }
}
