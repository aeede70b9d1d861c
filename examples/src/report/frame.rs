//! From metres of the world to the units of a drawing: whole decimetres, x to the right, y down.

use std::fmt::Write as _;

use simworld_core::geometry::Point2;

/// Units a metre.
const UNITS: f64 = 10.0;

/// The part of the world that a drawing shows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Frame {
    /// South-west corner, m.
    low: Point2,
    /// Width and height, units.
    pub(super) size: (i64, i64),
}

impl Frame {
    /// Everything between two corners, m, and a margin round it.
    pub(super) fn around(low: Point2, high: Point2, margin: f64) -> Self {
        let span = (high - low).map(|side| ((side.max(0.0) + 2.0 * margin) * UNITS).ceil() as i64);
        Self { low: Point2::new(low.x - margin, low.y - margin), size: (span.x.max(1), span.y.max(1)) }
    }

    /// The part of this drawing that holds the points with a margin round them, m: as a `viewBox`, of the same shape
    /// whatever the points are, and its width in units.
    pub(super) fn detail(&self, points: &[Point2], margin: f64) -> (String, i64) {
        let cells = points.iter().map(|point| self.cell(*point));
        let (mut low, mut high) = ((i64::MAX, i64::MAX), (i64::MIN, i64::MIN));
        for (x, y) in cells {
            (low, high) = ((low.0.min(x), low.1.min(y)), (high.0.max(x), high.1.max(y)));
        }
        if points.is_empty() {
            (low, high) = ((0, 0), self.size);
        }
        let edge = (margin * UNITS) as i64;
        // Three to two, as the pictures of stories are.
        let height = (high.1 - low.1 + 2 * edge).max((high.0 - low.0 + 2 * edge) * 2 / 3);
        let width = height * 3 / 2;
        let middle = (i64::midpoint(low.0, high.0), i64::midpoint(low.1, high.1));
        (format!("{} {} {width} {height}", middle.0 - width / 2, middle.1 - height / 2), width)
    }

    /// A point in units.
    pub(super) fn cell(&self, point: Point2) -> (i64, i64) {
        let from = (point - self.low) * UNITS;
        (from.x.round() as i64, self.size.1 - from.y.round() as i64)
    }

    /// The `viewBox` of the whole.
    pub(super) fn view_box(&self) -> String {
        format!("0 0 {} {}", self.size.0, self.size.1)
    }

    /// A length on a sheet that is that many of its widths, units: what reads equally well in every city.
    pub(super) fn share(&self, share: f64) -> f64 {
        (self.size.0.max(self.size.1) as f64 * share).round()
    }

    /// An open line as path data, or a closed one with [`Self::area`]; points that fall together are one.
    pub(super) fn line(&self, points: &[Point2]) -> String {
        let mut data = String::new();
        let mut at: Option<(i64, i64)> = None;
        for point in points {
            let to = self.cell(*point);
            // Writing to a string cannot fail.
            let _ = match at {
                None => write!(data, "M{} {}", to.0, to.1),
                Some(at) if at == to => continue,
                Some(at) => write!(data, "l{} {}", to.0 - at.0, to.1 - at.1),
            };
            at = Some(to);
        }
        data
    }

    /// A closed outline as path data.
    pub(super) fn area(&self, points: &[Point2]) -> String {
        let line = self.line(points);
        if line.is_empty() { line } else { line + "z" }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn north_is_up_and_points_that_fall_together_are_one() {
        let frame = Frame::around(Point2::new(-10.0, 0.0), Point2::new(10.0, 5.0), 1.0);
        assert_eq!(frame.size, (220, 70));
        assert_eq!(frame.cell(Point2::new(-10.0, 5.0)), (10, 10));
        let walk = [(-10.0, 5.0), (-10.0, 5.01), (0.0, 0.0)].map(|(x, y)| Point2::new(x, y));
        assert_eq!(frame.area(&walk), "M10 10l100 50z");
    }

    #[test]
    fn a_detail_holds_its_points() {
        let frame = Frame::around(Point2::origin(), Point2::new(100.0, 100.0), 0.0);
        let points = [Point2::new(10.0, 20.0), Point2::new(10.0, 80.0)];
        // 60 m and twice 10 m high, half as much again wide.
        assert_eq!(frame.detail(&points, 10.0), ("-500 100 1200 800".to_owned(), 1200));
    }
}
