//! What lies where in the plane, for things that come and go in every step: a grid of which only the cells are kept that hold
//! something. Asking for what is near costs what is near, however much there is in all.

use std::collections::BTreeMap;

use simworld_core::geometry::{Point2, Vector2};

/// No further entry.
const END: u32 = u32::MAX;

/// Values by their place in the plane.
#[derive(Debug)]
pub(crate) struct Cells<T> {
    /// Width of a cell, m.
    width: f64,
    /// The last entry of each cell.
    last: BTreeMap<(i64, i64), u32>,
    /// Each with the entry of its cell that was put in before it.
    entries: Vec<(T, u32)>,
}

impl<T> Cells<T> {
    /// Nothing, in cells of this width, m: best twice as wide as one looks around.
    pub(crate) fn new(width: f64) -> Self {
        Self { width, last: BTreeMap::new(), entries: Vec::new() }
    }

    /// Forgets everything but the memory.
    pub(crate) fn clear(&mut self) {
        self.last.clear();
        self.entries.clear();
    }

    /// Puts something in.
    pub(crate) fn insert(&mut self, at: Point2, value: T) {
        let place = self.entries.len() as u32;
        let before = self.last.insert(self.cell(at), place).unwrap_or(END);
        self.entries.push((value, before));
    }

    /// Everything in the cells that a box touches, and so at least everything in the box; in no order that means anything.
    pub(crate) fn around(&self, low: Point2, high: Point2) -> impl Iterator<Item = &T> {
        let ((left, bottom), (right, top)) = (self.cell(low), self.cell(high));
        let span = |from: i64, to: i64| i128::from(to) - i128::from(from) + 1;
        // Of a box of more cells than there are things, all are looked at instead.
        let is_wide = span(left, right).saturating_mul(span(bottom, top)) > self.entries.len() as i128;
        let all = if is_wide { self.entries.as_slice() } else { &[] };
        let rows = (!is_wide).then_some(bottom..=top);
        let cells =
            rows.into_iter().flatten().flat_map(move |row| (left..=right).map(move |column| (column, row)));
        let found = cells.flat_map(move |cell| {
            let mut next = self.last.get(&cell).copied().unwrap_or(END);
            std::iter::from_fn(move || {
                let (value, before) = self.entries.get(next as usize)?;
                next = *before;
                Some(value)
            })
        });
        all.iter().map(|entry| &entry.0).chain(found)
    }

    /// As [`around`](Self::around) for all that is within a distance of a place, m.
    pub(crate) fn near(&self, at: Point2, distance: f64) -> impl Iterator<Item = &T> {
        let reach = Vector2::new(distance, distance);
        self.around(at - reach, at + reach)
    }

    fn cell(&self, point: Point2) -> (i64, i64) {
        ((point.x / self.width).floor() as i64, (point.y / self.width).floor() as i64)
    }
}

#[cfg(test)]
mod tests {
    use simworld_core::seed::Seed;

    use super::*;

    #[test]
    fn what_is_near_is_found_and_little_else() {
        let mut rng = Seed(3).stream("test/cells").rng();
        let mut point = || Point2::new(rng.uniform(-100.0, 100.0), rng.uniform(-100.0, 100.0));
        let points: Vec<Point2> = (0..2000).map(|_| point()).collect();
        let mut cells = Cells::new(8.0);
        for (index, at) in points.iter().enumerate() {
            cells.insert(*at, index);
        }
        for _ in 0..200 {
            let here = point();
            let mut found: Vec<usize> = cells.near(here, 4.0).copied().collect();
            found.sort_unstable();
            let near = |index: &usize| (points[*index] - here).norm() <= 4.0;
            for index in (0..points.len()).filter(near) {
                assert!(found.binary_search(&index).is_ok(), "point {index} is near {here}");
            }
            assert!(
                found.len() < 60,
                "{} of {} where some 13 are in a cell of four",
                found.len(),
                points.len()
            );
        }
        assert_eq!(cells.near(Point2::origin(), 1e300).count(), points.len());
        cells.clear();
        assert_eq!(cells.near(points[0], 4.0).count(), 0);
    }
}
