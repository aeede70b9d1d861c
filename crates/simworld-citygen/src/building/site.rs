//! A lot while it is built on, seen from one of its streets.
//!
//! Lot frame: the origin is the first corner of the street's edge, x runs along the street, y into the lot. A building is
//! a rectangle in this frame, so that its façade is parallel to the street.

use std::cell::OnceCell;

use simworld_core::geometry::{Point2, Vector2, heading};
use simworld_core::id::RoadId;
use simworld_core::net::Side;

use crate::lot::{Land, Lot};
use crate::occupancy::{least, most};

/// A lot and one of its streets.
pub(super) struct Site<'a> {
    pub(super) lot: &'a Lot,
    pub(super) road: RoadId,
    pub(super) side: Side,
    /// Direction from the lot to the street, radians, once it was asked for.
    facing: OnceCell<f64>,
    /// How far the lot reaches inwards, m.
    pub(super) deep: f64,
    /// The corners of the lot in its frame, the last one first as well.
    pub(super) local: Vec<Point2>,
    /// Distance from the street to the façades, m.
    setback: f64,
    flanks: Flanks,
    /// From where to where the lot reaches at the façades, m.
    front: Option<(f64, f64)>,
    origin: Point2,
    along: Vector2,
    inwards: Vector2,
}

/// A rectangle in the frame of a lot: from x to x + width, from the setback to the setback and depth.
#[derive(Clone, Copy)]
pub(super) struct Spot {
    pub(super) x: f64,
    pub(super) width: f64,
    pub(super) depth: f64,
}

impl<'a> Site<'a> {
    /// A lot seen from the street beyond one of its edges; `None` if the edge has no length.
    pub(super) fn of(
        land: &Land,
        lot: &'a Lot,
        edge: usize,
        (road, side): (RoadId, Side),
        setback: f64,
        mut local: Vec<Point2>,
    ) -> Option<Self> {
        let outline = land.outline(lot);
        let origin = outline[edge];
        let along = (next(outline, edge) - origin).try_normalize(1e-9)?;
        let inwards = Vector2::new(-along.y, along.x);
        local.clear();
        let mut site = Self {
            lot,
            road,
            side,
            facing: OnceCell::new(),
            deep: 0.0,
            local: Vec::new(),
            setback,
            flanks: Flanks::default(),
            front: None,
            origin,
            along,
            inwards,
        };
        local.extend(outline.last().map(|corner| site.seen(*corner)));
        local.extend(outline.iter().map(|corner| site.seen(*corner)));
        site.deep = local.iter().map(|corner| corner.y).fold(0.0, most);
        site.flanks = Flanks::at(&local, setback);
        site.local = local;
        site.front = site.span(setback);
        Some(site)
    }

    /// Direction from the lot to the street, radians.
    pub(super) fn facing(&self) -> f64 {
        *self.facing.get_or_init(|| heading(&-self.inwards))
    }

    /// A point of the world in the lot frame.
    pub(super) fn seen(&self, point: Point2) -> Point2 {
        let to = point - self.origin;
        Point2::new(to.dot(&self.along), to.dot(&self.inwards))
    }

    /// The point of the world at a point of the lot frame.
    pub(super) fn at(&self, x: f64, y: f64) -> Point2 {
        self.origin + self.along * x + self.inwards * y
    }

    /// The corners of a spot in the world, counter-clockwise.
    pub(super) fn corners(&self, spot: Spot) -> [Point2; 4] {
        let (left, right) = (spot.x, spot.x + spot.width);
        let (near, far) = (self.setback, self.setback + spot.depth);
        [self.at(left, near), self.at(right, near), self.at(right, far), self.at(left, far)]
    }

    /// From where to where a building of that depth reaches inwards, m.
    pub(super) fn depths(&self, depth: f64) -> (f64, f64) {
        (self.setback, self.setback + depth)
    }

    /// From where to where the lot reaches at a distance from the street that is no less than the setback.
    fn span(&self, y: f64) -> Option<(f64, f64)> {
        if y < self.flanks.end { Some(self.flanks.span(y)) } else { span(&self.local, y) }
    }

    /// The stations between which a rectangle from the setback to that depth beyond it lies within the lot, with a
    /// margin to either side.
    pub(super) fn room(&self, depth: f64, margin: f64) -> Option<(f64, f64)> {
        let (front, rear) = (self.front?, self.span(self.setback + depth)?);
        let (low, high) = (most(front.0, rear.0) + margin, least(front.1, rear.1) - margin);
        (low < high).then_some((low, high))
    }

    /// Length of the streets of the lot along which a building stands no farther away than that, m: at its front and,
    /// on a corner, beside it.
    pub(super) fn frontage(&self, land: &Land, corners: &[Point2; 4], farthest: f64) -> f64 {
        let (outline, borders) = (land.outline(self.lot), land.borders(self.lot));
        let mut sum = 0.0;
        for index in (0..borders.len()).filter(|index| borders[*index].is_street()) {
            let start = outline[index];
            let edge = next(outline, index) - start;
            let length = edge.norm();
            // Of all corners the least and the greatest, times the length: what is least stays least when it is divided.
            let (mut near, mut low, mut high) = (f64::INFINITY, f64::INFINITY, 0.0_f64);
            for corner in corners {
                let to = corner - start;
                let (inwards, station) = (edge.perp(&to), to.dot(&edge));
                (near, low, high) = (least(near, inwards), least(low, station), most(high, station));
            }
            if near / length <= farthest {
                sum += most(least(high / length, length) - most(low / length, 0.0), 0.0);
            }
        }
        sum
    }
}

/// The corner after one of an outline.
fn next(outline: &[Point2], corner: usize) -> Point2 {
    outline.get(corner + 1).copied().unwrap_or(outline[0])
}

/// The two sides of an outline that cross a height, and all heights above it up to an end. Most lots reach straight inwards:
/// most of what is asked is answered by these two.
#[derive(Default)]
struct Flanks {
    sides: [[Point2; 2]; 2],
    end: f64,
}

impl Flanks {
    /// The sides at a height, of an outline whose last corner stands first as well. If they are not two, nothing is below the
    /// end.
    fn at(outline: &[Point2], y: f64) -> Self {
        let (mut sides, mut count) = ([[Point2::origin(); 2]; 2], 0);
        let mut end = f64::INFINITY;
        for pair in outline.windows(2) {
            let (start, stop) = (pair[0].y > y, pair[1].y > y);
            if stop {
                end = least(end, pair[1].y);
            }
            if start != stop {
                sides[count.min(1)] = [pair[0], pair[1]];
                count += 1;
            }
        }
        Self { sides, end: if count == 2 { end } else { f64::NEG_INFINITY } }
    }

    /// From where to where they reach at a height.
    fn span(&self, y: f64) -> (f64, f64) {
        let [one, other] = self.sides.map(|[a, b]| crossing(a, b, y));
        (least(one, other), most(one, other))
    }
}

/// Where a side crosses a height.
#[inline]
fn crossing(a: Point2, b: Point2, y: f64) -> f64 {
    a.x + (b.x - a.x) * ((y - a.y) / (b.y - a.y))
}

/// Corners of an outline whose heights are compared together.
const TOGETHER: usize = 32;

/// From where to where an outline reaches at a height; its last corner stands first as well.
pub(super) fn span(outline: &[Point2], y: f64) -> Option<(f64, f64)> {
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    let mut rest = outline;
    while rest.len() > 1 {
        let part = &rest[..rest.len().min(TOGETHER)];
        // A bit for each corner, the last one the lowest.
        let above = part.iter().fold(0_u64, |above, corner| above << 1 | u64::from(corner.y > y));
        // The sides that cross: mostly two, and which they are differs from lot to lot.
        let mut crosses = (above ^ (above >> 1)) & ((1 << (part.len() - 1)) - 1);
        while crosses != 0 {
            let place = part.len() - 2 - crosses.trailing_zeros() as usize;
            let x = crossing(part[place], part[place + 1], y);
            (low, high) = (least(low, x), most(high, x));
            crosses &= crosses - 1;
        }
        rest = &rest[part.len() - 1..];
    }
    (low <= high).then_some((low, high))
}

#[cfg(test)]
mod tests {
    use simworld_core::geometry::direction;

    use super::*;

    #[test]
    fn a_round_outline_is_as_wide_as_its_circle() {
        for corners in [3, 4, 31, 32, 33, 64, 65, 200] {
            let step = std::f64::consts::TAU / f64::from(corners);
            let outline: Vec<Point2> = (0..=corners)
                .map(|corner| Point2::origin() + direction(0.1 + step * f64::from(corner)) * 10.0)
                .collect();
            let inner = 10.0 * simworld_core::ops::cos(step * 0.5);
            for y in [-4.9, 0.0, 3.0] {
                let Some((low, high)) = span(&outline, y) else { panic!("{corners} corners at {y}") };
                let half = |radius: f64| (radius * radius - y * y).max(0.0).sqrt();
                let widths = half(inner) * 2.0 - 1e-9..=half(10.0) * 2.0 + 1e-9;
                assert!(widths.contains(&(high - low)), "{corners} corners at {y}: {low} to {high}");
            }
            assert!(span(&outline, 10.1).is_none());
        }
    }
}
