//! Heat: how much of something lies around each place, as areas that darken level by level.

use std::fmt::Write as _;

use simworld_core::geometry::Point2;
use simworld_core::ops;

use super::frame::Frame;

/// Cells along the longer side of the map.
const CELLS: i64 = 160;
/// Least side of a cell, units of the drawing: finer than this nobody walks.
const FINEST: i64 = 60;
/// Each level begins at this share of the greatest; steps widen, because most of the time lies in few places.
const LEVELS: [f64; 6] = [0.03, 0.08, 0.17, 0.32, 0.54, 0.8];
/// Reach of a kernel, in its deviations.
const REACH: f64 = 2.6;

/// A grid over a map, and how much lies in each of its cells.
pub(super) struct Heat {
    /// Side of a cell, units of the drawing.
    pub(super) cell: i64,
    columns: usize,
    rows: usize,
    weights: Vec<f64>,
}

impl Heat {
    /// Points with their weights; what lies outside of the map is left out. `blur` is the deviation of the Gaussian kernel, m.
    pub(super) fn of(frame: &Frame, points: impl Iterator<Item = (Point2, f64)>, blur: f64) -> Self {
        let longer = frame.size.0.max(frame.size.1);
        let cell = (longer / CELLS).max(FINEST);
        let count = |side: i64| (side.div_euclid(cell) + 1) as usize;
        let (columns, rows) = (count(frame.size.0), count(frame.size.1));
        let mut weights = vec![0.0; columns * rows];
        for (point, weight) in points {
            let (x, y) = frame.cell(point);
            let (column, row) = (x.div_euclid(cell), y.div_euclid(cell));
            if (0..columns as i64).contains(&column) && (0..rows as i64).contains(&row) {
                weights[row as usize * columns + column as usize] += weight;
            }
        }
        let mut heat = Self { cell, columns, rows, weights };
        heat.smooth(blur * 10.0 / cell as f64);
        heat
    }

    /// Spreads each weight round its cell, first along rows, then along columns.
    fn smooth(&mut self, deviation: f64) {
        let reach = (deviation * REACH).ceil() as usize;
        let bell = |away: usize| {
            let away = away as f64 / deviation;
            ops::exp(-0.5 * away * away)
        };
        let half: Vec<f64> = (0..=reach).map(bell).collect();
        let whole = 2.0 * half.iter().sum::<f64>() - 1.0;
        for (length, stride, lines, next) in
            [(self.columns, 1, self.rows, self.columns), (self.rows, self.columns, self.columns, 1)]
        {
            for line in 0..lines {
                let at = |place: usize| line * next + place * stride;
                let before: Vec<f64> = (0..length).map(|place| self.weights[at(place)]).collect();
                for place in 0..length {
                    let from = place.saturating_sub(reach);
                    let near = before[from..length.min(place + reach + 1)].iter().enumerate();
                    let sum: f64 =
                        near.map(|(step, weight)| weight * half[(from + step).abs_diff(place)]).sum();
                    self.weights[at(place)] = sum / whole;
                }
            }
        }
    }

    /// The greatest weight of a cell.
    fn most(&self) -> f64 {
        self.weights.iter().copied().fold(0.0, f64::max)
    }

    /// The greatest weight on a square metre.
    pub(super) fn greatest(&self) -> f64 {
        let side = self.cell as f64 / 10.0;
        self.most() / (side * side)
    }

    /// The areas as elements of SVG, one a level, the faintest first; they lie on each other, and so grow darker.
    pub(super) fn areas(&self) -> String {
        let most = self.most();
        let mut text = String::new();
        if most <= 0.0 {
            return text;
        }
        for level in LEVELS {
            let mut data = String::new();
            for row in 0..self.rows {
                let cells = &self.weights[row * self.columns..(row + 1) * self.columns];
                self.runs(cells, row, level * most, &mut data);
            }
            // Writing to a string cannot fail.
            let _ = write!(text, "<path d=\"{data}\"/>");
        }
        text
    }

    /// Rectangles over the runs of cells of a row that reach a level.
    fn runs(&self, cells: &[f64], row: usize, level: f64, data: &mut String) {
        let (side, y) = (self.cell, row as i64 * self.cell);
        let mut column = 0;
        for run in cells.chunk_by(|a, b| (*a >= level) == (*b >= level)) {
            if run[0] >= level {
                let (x, width) = (column as i64 * side, run.len() as i64 * side);
                let _ = write!(data, "M{x} {y}h{width}v{side}h-{width}z");
            }
            column += run.len();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn heat_is_where_the_weights_are_and_none_is_lost() {
        let frame = Frame::around(Point2::origin(), Point2::new(300.0, 200.0), 0.0);
        let points = [(Point2::new(150.0, 100.0), 3.0), (Point2::new(153.0, 101.0), 2.0)];
        let heat = Heat::of(&frame, points.into_iter(), 12.0);
        let sum: f64 = heat.weights.iter().sum();
        assert!((sum - 5.0).abs() < 1e-9, "{sum}");
        let (rank, _) = heat.weights.iter().enumerate().max_by(|a, b| a.1.total_cmp(b.1)).unwrap();
        assert_eq!((rank % heat.columns, rank / heat.columns), (25, 16));
        assert_eq!(heat.areas().matches("<path").count(), LEVELS.len());
        let outside = Heat::of(&frame, [(Point2::new(-50.0, 1e6), 1.0)].into_iter(), 12.0);
        assert_eq!((outside.greatest(), outside.areas().as_str()), (0.0, ""));
    }

    #[test]
    fn a_level_is_covered_by_runs() {
        let heat = Heat { cell: 60, columns: 4, rows: 1, weights: vec![0.0; 4] };
        let mut data = String::new();
        heat.runs(&[1.0, 2.0, 0.0, 1.0], 2, 1.0, &mut data);
        assert_eq!(data, "M0 120h120v60h-120zM180 120h60v60h-60z");
    }
}
