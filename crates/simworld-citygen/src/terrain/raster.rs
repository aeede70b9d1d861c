//! Measured heights on a regular raster.

use simworld_core::geometry::Point2;
use thiserror::Error;

use super::HeightField;

/// Heights at the points of a square raster, joined bilinearly; beyond its edges they stay as they are on the edge.
#[derive(Clone, Debug, PartialEq)]
pub struct Raster {
    origin: Point2,
    spacing: f64,
    columns: usize,
    heights: Vec<f64>,
}

/// Why numbers are no raster.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum RasterError {
    /// Rows that are not full.
    #[error(
        "{values} heights do not fill rows of {columns}: give two rows and two columns at least, row by row"
    )]
    Shape {
        /// How many heights there are.
        values: usize,
        /// How many a row should have.
        columns: usize,
    },
    /// A distance that is none.
    #[error("a spacing of {0} m is out of range: give 0.1 to 10 000 m")]
    Spacing(f64),
    /// A height that is none.
    #[error("height {index} is {height} m: give -10 000 to 10 000 m")]
    Height {
        /// Its index.
        index: usize,
        /// Its value, m.
        height: f64,
    },
}

impl Raster {
    /// A raster from its south-western point, the distance between points, and heights row by row from the south, each row
    /// from the west, m.
    ///
    /// # Errors
    /// Rows that are not full, a spacing or a height out of range.
    pub fn new(origin: Point2, spacing: f64, columns: usize, heights: Vec<f64>) -> Result<Self, RasterError> {
        let values = heights.len();
        if columns < 2 || values < 2 * columns || !values.is_multiple_of(columns) {
            return Err(RasterError::Shape { values, columns });
        }
        if !(0.1..=1e4).contains(&spacing) {
            return Err(RasterError::Spacing(spacing));
        }
        match heights.iter().position(|height| !(-1e4..=1e4).contains(height)) {
            Some(index) => Err(RasterError::Height { index, height: heights[index] }),
            None => Ok(Self { origin, spacing, columns, heights }),
        }
    }
}

impl HeightField for Raster {
    fn height(&self, point: Point2) -> f64 {
        let rows = self.heights.len() / self.columns;
        let at = (point - self.origin) / self.spacing;
        let cell = |x: f64, count: usize| {
            let x = x.clamp(0.0, (count - 1) as f64);
            let index = (x as usize).min(count - 2);
            (index, x - index as f64)
        };
        let ((column, u), (row, v)) = (cell(at.x, self.columns), cell(at.y, rows));
        let value = |dx: usize, dy: usize| self.heights[(row + dy) * self.columns + column + dx];
        let south = value(0, 0) * (1.0 - u) + value(1, 0) * u;
        let north = value(0, 1) * (1.0 - u) + value(1, 1) * u;
        south * (1.0 - v) + north * v
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn heights_are_joined_between_points_and_held_beyond() {
        let heights = vec![0.0, 10.0, 20.0, 4.0, 14.0, 24.0];
        let raster = Raster::new(Point2::new(-50.0, 0.0), 50.0, 3, heights).unwrap();
        let cases = [((-50.0, 0.0), 0.0), ((-25.0, 25.0), 7.0), ((0.0, 50.0), 14.0), ((900.0, -900.0), 20.0)];
        for ((x, y), expected) in cases {
            assert!((raster.height(Point2::new(x, y)) - expected).abs() < 1e-12, "at {x}, {y}");
        }
    }

    #[test]
    fn what_is_no_raster_is_refused() {
        let at = Point2::origin();
        assert!(matches!(Raster::new(at, 1.0, 3, vec![0.0; 7]), Err(RasterError::Shape { values: 7, .. })));
        assert_eq!(Raster::new(at, 0.0, 2, vec![0.0; 4]), Err(RasterError::Spacing(0.0)));
        let error = Raster::new(at, 1.0, 2, vec![0.0, 1.0, f64::NAN, 0.0]).unwrap_err();
        assert!(error.to_string().contains("height 2"));
    }
}
