//! Outlines as they stand on a map: any simple polygon, with courtyards.
//!
//! Body frame, as of every outline: the origin is the middle of the rectangle round it, x looks out of the entrance, y
//! to the left.

use earcut::Earcut;
use serde::{Deserialize, Serialize};
use simworld_core::geometry::Point2;

use super::footprint::Part;

/// Thickness of the slices in which walls that run askew are laid, m.
const SLICE: f64 = 3.0;
/// Most slices of one building: the boxes stay few.
const MOST_SLICES: f64 = 40.0;
/// Corners nearer to each other than this across the slices bound one slice, m.
const LEVEL: f64 = 0.4;
/// Boxes narrower than this are left out, m.
const NARROWEST: f64 = 0.3;

/// A polygon with holes; corners counter-clockwise, m.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Surveyed {
    /// The corners of the outline.
    pub outline: Vec<Point2>,
    /// The corners of each courtyard.
    pub courts: Vec<Vec<Point2>>,
}

/// Twice the area of a polygon, positive counter-clockwise, m².
fn doubled_area(corners: &[Point2]) -> f64 {
    let Some(origin) = corners.first() else { return 0.0 };
    corners.windows(2).map(|pair| (pair[0] - origin).perp(&(pair[1] - origin))).sum()
}

impl Surveyed {
    /// Area without the courtyards, m².
    pub fn area(&self) -> f64 {
        let courts: f64 = self.courts.iter().map(|court| doubled_area(court)).sum();
        (doubled_area(&self.outline) - courts) * 0.5
    }

    /// Whether all of it lies within a rectangle of that size and encloses something.
    pub(super) fn fits(&self, width: f64, depth: f64) -> bool {
        const ROUNDING: f64 = 1e-6;
        let inside = |point: &Point2| {
            point.x.abs() <= depth * 0.5 + ROUNDING && point.y.abs() <= width * 0.5 + ROUNDING
        };
        let is_ring = |ring: &Vec<Point2>| ring.len() >= 3 && ring.iter().all(inside);
        is_ring(&self.outline) && self.courts.iter().all(is_ring) && self.area() > 0.0
    }

    /// The edges of outline and courtyards.
    fn edges(&self) -> impl Iterator<Item = (Point2, Point2)> + '_ {
        let rings = std::iter::once(&self.outline).chain(&self.courts);
        rings.flat_map(|ring| ring.iter().copied().zip(ring.iter().copied().cycle().skip(1)))
    }

    /// Triangles that make it up.
    pub(crate) fn triangles(&self) -> Vec<[Point2; 3]> {
        let corners: Vec<Point2> = self.outline.iter().chain(self.courts.iter().flatten()).copied().collect();
        let mut starts = Vec::with_capacity(self.courts.len());
        let mut start = self.outline.len() as u32;
        for court in &self.courts {
            starts.push(start);
            start += court.len() as u32;
        }
        let mut indices: Vec<u32> = Vec::new();
        Earcut::new().earcut(corners.iter().map(|corner| [corner.x, corner.y]), &starts, &mut indices);
        indices.chunks_exact(3).map(|three| [0, 1, 2].map(|corner| corners[three[corner] as usize])).collect()
    }

    /// The boxes of which it is made: slices from left to right, exact where walls are parallel or square to the
    /// entrance's, in steps where they run askew. The first is the largest.
    pub(super) fn parts(&self, storeys: u32) -> Vec<Part> {
        let mut parts: Vec<Part> = Vec::new();
        let levels = self.levels();
        let mut crossings = Vec::new();
        for pair in levels.windows(2) {
            let (low, high) = (pair[0], pair[1]);
            let middle = (low + high) * 0.5;
            self.cut_at(middle, &mut crossings);
            for span in crossings.chunks_exact(2).filter(|span| span[1] - span[0] > NARROWEST) {
                let part = Part {
                    middle: Point2::new((span[0] + span[1]) * 0.5, middle),
                    length: span[1] - span[0],
                    width: high - low,
                    storeys,
                };
                match parts.iter_mut().rev().find(|other| continues(other, &part)) {
                    Some(other) => {
                        let right = other.middle.y - other.width * 0.5;
                        other.width = high - right;
                        other.middle.y = (right + high) * 0.5;
                    }
                    None => parts.push(part),
                }
            }
        }
        let area = |part: &Part| part.length * part.width;
        let largest = (0..parts.len()).max_by(|a, b| area(&parts[*a]).total_cmp(&area(&parts[*b])));
        if let Some(largest) = largest {
            parts.swap(0, largest);
        }
        parts
    }

    /// Where slices begin and end, ascending.
    fn levels(&self) -> Vec<f64> {
        let mut corners: Vec<f64> = self.edges().map(|(corner, _)| corner.y).collect();
        corners.sort_by(f64::total_cmp);
        corners.dedup_by(|a, b| *a - *b < LEVEL);
        let (Some(first), Some(last)) = (corners.first().copied(), corners.last().copied()) else {
            return Vec::new();
        };
        let thickness = SLICE.max((last - first) / MOST_SLICES);
        let mut levels = vec![first];
        for pair in corners.windows(2) {
            let runs_askew = self.edges().any(|(a, b)| {
                let spans = a.y.min(b.y) < pair[1] - LEVEL && a.y.max(b.y) > pair[0] + LEVEL;
                spans && (a.x - b.x).abs() > 0.05 * (a.y - b.y).abs()
            });
            let count = if runs_askew { ((pair[1] - pair[0]) / thickness).ceil().max(1.0) } else { 1.0 };
            let step = (pair[1] - pair[0]) / count;
            levels.extend((1..=count as u32).map(|index| pair[0] + step * f64::from(index)));
        }
        levels
    }

    /// Where a line across meets the walls, ascending.
    fn cut_at(&self, y: f64, crossings: &mut Vec<f64>) {
        crossings.clear();
        let cut = self.edges().filter(|(a, b)| (a.y > y) != (b.y > y));
        crossings.extend(cut.map(|(a, b)| a.x + (b.x - a.x) * ((y - a.y) / (b.y - a.y))));
        crossings.sort_by(f64::total_cmp);
    }
}

/// Whether a box goes on in the next slice, as long and at the same place.
fn continues(one: &Part, next: &Part) -> bool {
    const SAME: f64 = 0.1;
    let touches = (one.middle.y + one.width * 0.5 - (next.middle.y - next.width * 0.5)).abs() < 1e-9;
    touches && (one.middle.x - next.middle.x).abs() < SAME && (one.length - next.length).abs() < SAME
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ring(points: &[(f64, f64)]) -> Vec<Point2> {
        points.iter().map(|(x, y)| Point2::new(*x, *y)).collect()
    }

    fn boxes(form: &Surveyed) -> f64 {
        form.parts(3).iter().map(|part| part.length * part.width).sum()
    }

    #[test]
    fn square_walls_are_laid_exactly() {
        let outline = ring(&[(-10.0, -8.0), (10.0, -8.0), (10.0, 8.0), (2.0, 8.0), (2.0, 1.0), (-10.0, 1.0)]);
        let court = ring(&[(4.0, -4.0), (8.0, -4.0), (8.0, 4.0), (4.0, 4.0)]);
        let form = Surveyed { outline, courts: vec![court] };
        let area = 20.0 * 16.0 - 12.0 * 7.0 - 4.0 * 8.0;
        assert!((form.area() - area).abs() < 1e-9 && form.fits(16.0, 20.0) && !form.fits(15.0, 20.0));
        assert!((boxes(&form) - area).abs() < 1e-9);
        assert!(form.parts(3).len() <= 6, "{:?}", form.parts(3));
        let triangles = form.triangles();
        let sum: f64 = triangles.iter().map(|three| doubled_area(three).abs() * 0.5).sum();
        assert!((sum - area).abs() < 1e-9);
    }

    #[test]
    fn walls_askew_are_laid_in_steps() {
        let form = Surveyed {
            outline: ring(&[(-15.0, 0.0), (0.0, -15.0), (15.0, 0.0), (0.0, 15.0)]),
            courts: Vec::new(),
        };
        let parts = form.parts(2);
        assert!((boxes(&form) / form.area() - 1.0).abs() < 0.05, "{} of {}", boxes(&form), form.area());
        // No step reaches out of the walls by more than half a slice.
        for part in &parts {
            let reach = part.middle.x.abs() + part.length * 0.5 + part.middle.y.abs() + part.width * 0.5;
            assert!(reach < 15.0 + SLICE, "{part:?}");
        }
        assert!(parts.len() < 20);
    }
}
