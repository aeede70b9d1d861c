//! A lot while it is built on, seen from one of its streets.
//!
//! Lot frame: the origin is the first corner of the street's edge, x runs along the street, y into the lot. A building is
//! a rectangle in this frame, so that its façade is parallel to the street.

use simworld_core::geometry::{Point2, Vector2, heading};
use simworld_core::id::RoadId;
use simworld_core::net::{RoadNetwork, Side};

use crate::lot::{Land, Lot};

/// A lot and one of its streets.
pub(super) struct Site<'a> {
    pub(super) lot: &'a Lot,
    pub(super) road: RoadId,
    pub(super) side: Side,
    /// Direction from the lot to the street, radians.
    pub(super) facing: f64,
    /// How far the lot reaches inwards, m.
    pub(super) deep: f64,
    /// The corners of the lot in its frame.
    pub(super) local: Vec<Point2>,
    /// Distance from the street to the façades, m, and from where to where the lot reaches there.
    setback: f64,
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
        let along = (outline[(edge + 1) % outline.len()] - origin).try_normalize(1e-9)?;
        let inwards = Vector2::new(-along.y, along.x);
        local.clear();
        local.extend(outline.iter().map(|corner| {
            let to = corner - origin;
            Point2::new(to.dot(&along), to.dot(&inwards))
        }));
        let deep = local.iter().map(|corner| corner.y).fold(0.0, f64::max);
        let (facing, front) = (heading(&-inwards), span(&local, setback));
        Some(Self { lot, road, side, facing, deep, local, setback, front, origin, along, inwards })
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

    /// The stations between which a rectangle from the setback to that depth beyond it lies within the lot, with a
    /// margin to either side.
    pub(super) fn room(&self, depth: f64, margin: f64) -> Option<(f64, f64)> {
        let (front, rear) = (self.front?, span(&self.local, self.setback + depth)?);
        let (low, high) = (front.0.max(rear.0) + margin, front.1.min(rear.1) - margin);
        (low < high).then_some((low, high))
    }

    /// The place on the walkways before a door: the middle of the sidewalk or, where that ends before the corner, of
    /// the walkway round it.
    pub(super) fn access(&self, network: &RoadNetwork, door: Point2) -> Point2 {
        let Some(walk) = network.sidewalk(self.road, self.side) else { return door };
        let mut best = nearest(&walk.path, door);
        if (best - door).norm() < walk.width {
            return best;
        }
        let road = &network.roads[self.road.index()];
        for intersection in [road.from, road.to] {
            for corner in network.intersections[intersection.index()].corners.iter().filter(|c| c.len() >= 2)
            {
                let at = nearest(corner, door);
                if (at - door).norm_squared() < (best - door).norm_squared() {
                    best = at;
                }
            }
        }
        best
    }

    /// Length of the streets of the lot along which a building stands no farther away than that, m: at its front and,
    /// on a corner, beside it.
    pub(super) fn frontage(&self, land: &Land, corners: &[Point2; 4], farthest: f64) -> f64 {
        let (outline, borders) = (land.outline(self.lot), land.borders(self.lot));
        let mut sum = 0.0;
        for index in (0..borders.len()).filter(|index| borders[*index].is_street()) {
            let start = outline[index];
            let edge = outline[(index + 1) % outline.len()] - start;
            let length = edge.norm();
            let (mut near, mut low, mut high) = (f64::INFINITY, f64::INFINITY, 0.0_f64);
            for corner in corners {
                let to = corner - start;
                near = near.min(edge.perp(&to) / length);
                let station = to.dot(&edge) / length;
                (low, high) = (low.min(station), high.max(station));
            }
            if near <= farthest {
                sum += (high.min(length) - low.max(0.0)).max(0.0);
            }
        }
        sum
    }
}

/// From where to where an outline reaches at a height.
fn span(outline: &[Point2], y: f64) -> Option<(f64, f64)> {
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    let mut a = *outline.last()?;
    for b in outline {
        // Reckoned for every side and kept of those that cross: which they are differs from lot to lot.
        let crosses = (a.y > y) != (b.y > y);
        let x = a.x + (b.x - a.x) * ((y - a.y) / (b.y - a.y));
        low = low.min(if crosses { x } else { f64::INFINITY });
        high = high.max(if crosses { x } else { f64::NEG_INFINITY });
        a = *b;
    }
    (low <= high).then_some((low, high))
}

/// The point of a path nearest to another.
fn nearest(path: &[Point2], point: Point2) -> Point2 {
    let mut best = (f64::INFINITY, point);
    for pair in path.windows(2) {
        let (step, to) = (pair[1] - pair[0], point - pair[0]);
        let (squared, along) = (step.norm_squared(), to.dot(&step));
        // Divided only where it is nearer; a hair of slack, so that rounding decides nothing.
        let beside = along > 0.0 && along < squared;
        let aside = to.perp(&step);
        if beside && aside * aside > best.0 * squared * (1.0 + 1e-9) {
            continue;
        }
        let share = if squared > 0.0 { (along / squared).clamp(0.0, 1.0) } else { 0.0 };
        let at = pair[0] + step * share;
        let distance = (point - at).norm_squared();
        if distance < best.0 {
            best = (distance, at);
        }
    }
    best.1
}
