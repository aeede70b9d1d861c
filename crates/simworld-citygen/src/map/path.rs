//! Path data in whole decimetres, relative from point to point: short and exact enough to look at.

use std::fmt::Write;

use simworld_core::geometry::Point2;

/// Collects lines, polygons and dots for the `d` of one path element.
#[derive(Clone, Debug)]
pub(super) struct Pen {
    data: String,
    /// The middle of the sheet, so that numbers stay short.
    origin: Point2,
    /// Where the pen stands, dm from the origin.
    at: (i64, i64),
}

impl Pen {
    pub(super) fn at(origin: Point2) -> Self {
        Self { data: String::new(), origin, at: (0, 0) }
    }

    pub(super) fn is_empty(&self) -> bool {
        self.data.is_empty()
    }

    pub(super) fn into_data(self) -> String {
        self.data
    }

    /// An open line through the points.
    pub(super) fn line(&mut self, points: &[Point2]) {
        self.run(points);
    }

    /// A closed polygon.
    pub(super) fn polygon(&mut self, points: &[Point2]) {
        let begin = self.run(points);
        if let Some(begin) = begin {
            self.data.push('z');
            self.at = begin;
        }
    }

    /// A line without length: a disc, where line ends are round.
    pub(super) fn dot(&mut self, point: &Point2) {
        if self.run(std::slice::from_ref(point)).is_some() {
            self.data.push_str("h0");
        }
    }

    fn run(&mut self, points: &[Point2]) -> Option<(i64, i64)> {
        let (first, rest) = points.split_first()?;
        self.step('m', first);
        let begin = self.at;
        let mut letter = 'l';
        for point in rest {
            if self.cell(point) != self.at {
                self.step(letter, point);
                letter = ' ';
            }
        }
        Some(begin)
    }

    fn cell(&self, point: &Point2) -> (i64, i64) {
        let from_origin = point - self.origin;
        ((from_origin.x * 10.0).round() as i64, (from_origin.y * 10.0).round() as i64)
    }

    fn step(&mut self, letter: char, point: &Point2) {
        let to = self.cell(point);
        let (dx, dy) = (to.0 - self.at.0, to.1 - self.at.1);
        if letter != ' ' {
            self.data.push(letter);
        } else if dx >= 0 {
            self.data.push(' ');
        }
        let gap = if dy >= 0 { " " } else { "" };
        // Writing to a string never fails.
        let _ = write!(self.data, "{dx}{gap}{dy}");
        self.at = to;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_run_together_where_they_may() {
        let mut pen = Pen::at(Point2::new(100.0, 0.0));
        let points = [(101.0, 2.0), (100.0, 1.96), (100.0, 1.96), (103.0, -2.0)];
        pen.line(&points.map(|(x, y)| Point2::new(x, y)));
        pen.dot(&Point2::new(103.0, -2.0));
        assert_eq!(pen.into_data(), "m10 20l-10 0 30-40m0 0h0");
    }

    #[test]
    fn a_polygon_brings_the_pen_back() {
        let mut pen = Pen::at(Point2::origin());
        pen.polygon(&[Point2::new(0.0, 0.0), Point2::new(1.0, 0.0), Point2::new(1.0, 1.0)]);
        pen.polygon(&[Point2::new(5.0, 0.0), Point2::new(6.0, 0.0), Point2::new(6.0, 1.0)]);
        assert_eq!(pen.into_data(), "m0 0l10 0 0 10zm50 0l10 0 0 10z");
    }
}
