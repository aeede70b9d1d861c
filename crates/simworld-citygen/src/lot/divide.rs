//! One block into lots: the common part of all patterns, and the recursive one.

use simworld_core::geometry::{Point2, Vector2};
use simworld_core::seed::{Stream, StreamRng};

use super::{Green, GreenKind, Land, Lot, LotConfig, LotSize, LotStyle, slabs, stream_of};
use crate::block::{Block, Border, Ring, Split, decompose};
use crate::zoning::{Zone, Zoning};

/// Pieces smaller than this are not worth a green, m².
const SPECK: f64 = 1e-9;
/// Two areas that differ by more than this differ, whatever was rounded, m².
const PLAIN: f64 = 1e-5;
/// So far about a depth it is not plain to which side of it another one lies, m.
const NEAR: f64 = 1e-5;

/// Divides one block and files the result.
pub(super) struct Divider<'a> {
    land: &'a mut Land,
    block: u32,
    /// The sidewalk that greens belong to.
    pub(super) along: Border,
    zoning: &'a Zoning,
    config: &'a LotConfig,
    pub(super) rng: StreamRng,
    zone: Zone,
    density: f64,
}

impl<'a> Divider<'a> {
    pub(super) fn new(
        land: &'a mut Land,
        (block, whole): (u32, &Block),
        zoning: &'a Zoning,
        config: &'a LotConfig,
        streams: Stream,
    ) -> Self {
        let along = whole.borders.iter().copied().find(|border| border.is_street()).unwrap_or(Border::LAND);
        let rng = stream_of(whole, streams).rng();
        let (zone, density) = (Zone::default(), 0.0);
        Self { land, block, along, zoning, config, rng, zone, density }
    }

    /// Sets the zone to that of a point.
    pub(super) fn enter(&mut self, point: Point2) -> Zone {
        (self.zone, self.density) = self.zoning.at(point);
        self.zone
    }

    pub(super) fn size(&self) -> &'a LotSize {
        self.config.size(self.zone)
    }

    /// Divides a closed block.
    pub(super) fn divide(&mut self, ring: Ring) {
        if self.enter(ring.middle()) == Zone::Park || ring.area() < self.size().least_area {
            self.green(&ring, GreenKind::Park);
            return;
        }
        let streets = (0..ring.len()).filter(|index| ring.borders[*index].is_street());
        self.land.frontage += streets.map(|index| ring.edge(index).norm()).sum::<f64>();
        let (pieces, _) = decompose(ring);
        for piece in pieces {
            match self.config.style(self.zone) {
                LotStyle::Recursive => self.halve(&piece, 0),
                style => slabs::divide(self, piece, style),
            }
        }
    }

    /// Halves a convex piece across its longer side, as long as both halves have a street and are large enough.
    fn halve(&mut self, ring: &Ring, depth: u32) {
        let size = self.size();
        let wanted = self.rng.uniform(0.45, 1.0) * size.most_area;
        let (mut behind, mut ahead) = (Ring::default(), Ring::default());
        if ring.area() > wanted && depth < 24 {
            let share = self.rng.uniform(0.42, 0.58);
            for (at, normal) in cuts(ring, share) {
                let has_room =
                    |half: &Ring| half.area() >= size.least_area && longest_front(half).1 >= size.least_width;
                let split = ring.split(at, normal, &mut behind, &mut ahead);
                if split == Split::Both && has_room(&behind) && has_room(&ahead) {
                    self.halve(&behind, depth + 1);
                    self.halve(&ahead, depth + 1);
                    return;
                }
            }
        }
        self.lot(ring);
    }

    /// Files a lot; what is too small, too narrow or has no street becomes green, and so does the rear of what is too
    /// large.
    pub(super) fn lot(&mut self, ring: &Ring) {
        let size = *self.size();
        let (front, width) = longest_front(ring);
        if width < 4.0 {
            self.green(ring, GreenKind::Courtyard);
            return;
        }
        let area = ring.area();
        if area < size.least_area {
            self.green(ring, GreenKind::Leftover);
            return;
        }
        if area <= size.most_area {
            self.file_lot((ring, area), front);
            return;
        }
        let (mut lot, mut rear) = (Ring::default(), Ring::default());
        if self.shorten(ring, front, &mut lot, &mut rear) {
            let front = longest_front(&lot).0;
            self.file_lot((&lot, lot.area()), front);
            self.green(&rear, GreenKind::Courtyard);
        } else {
            self.green(ring, GreenKind::Courtyard);
        }
    }

    /// Cuts off the rear of a lot so that the greatest area is left, by bisection.
    fn shorten(&self, ring: &Ring, front: usize, lot: &mut Ring, rear: &mut Ring) -> bool {
        let along = ring.edge(front);
        let inwards = Vector2::new(-along.y, along.x) / along.norm();
        let origin = ring.corners[front];
        let most = self.size().most_area;
        let deepest = ring.corners.iter().map(|corner| (corner - origin).dot(&inwards)).fold(0.0, f64::max);
        let area = |depth: f64| ring.area_behind(origin + inwards * depth, inwards);
        let plain = plain_depths(most, (deepest, ring.area()), area);
        let (mut low, mut high) = (0.0, deepest);
        for _ in 0..40 {
            let middle = 0.5 * (low + high);
            let is_less = match plain {
                Some((less, _)) if middle <= less => true,
                Some((_, more)) if middle >= more => false,
                _ => area(middle).is_some_and(|area| area <= most),
            };
            if is_less {
                low = middle;
            } else {
                high = middle;
            }
        }
        let split = ring.split(origin + inwards * low, inwards, lot, rear);
        split == Split::Both && lot.area() >= self.size().least_area
    }

    /// Files a lot of an area, m², that begins with its front.
    pub(super) fn file_lot(&mut self, (ring, area): (&Ring, f64), front: usize) {
        let Some((road, side)) = ring.borders[front].as_street() else { return };
        let (start, count) = self.land.store(ring, front);
        let (block, zone, density) = (self.block, self.zone, self.density);
        self.land.lots.push(Lot { start, count, block, zone, density, area, road, side });
    }

    pub(super) fn green(&mut self, ring: &Ring, kind: GreenKind) {
        let area = ring.area();
        if area > SPECK {
            let (start, count) = self.land.store(ring, 0);
            let (block, along) = (self.block, self.along);
            self.land.greens.push(Green { start, count, block, along, kind, area });
        }
    }
}

/// The depths up to which, and from which on, what lies before is plainly less and more than a wanted area; `None` where they are
/// not found soon. The area grows with the depth: it is nothing at none, and known at the greatest.
fn plain_depths(wanted: f64, greatest: (f64, f64), area: impl Fn(f64) -> Option<f64>) -> Option<(f64, f64)> {
    let (mut before, mut here) = ((0.0, 0.0), greatest);
    for _ in 0..4 {
        // Most lots are as wide all the way in.
        let width = (here.1 - before.1) / (here.0 - before.0);
        let depth = here.0 + (wanted - here.1) / width;
        (before, here) = (here, (depth, area(depth)?));
        if (here.1 - wanted).abs() < PLAIN {
            break;
        }
    }
    let (less, more) = (here.0 - NEAR, here.0 + NEAR);
    (area(less)? < wanted - PLAIN && area(more)? > wanted + PLAIN).then_some((less, more))
}

/// The longest edge along a street and its length, m; zero if there is none.
pub(super) fn longest_front(ring: &Ring) -> (usize, f64) {
    (0..ring.len())
        .filter(|index| ring.borders[*index].is_street())
        .map(|index| (index, ring.edge(index).norm()))
        .fold((0, 0.0), |best, next| if next.1 > best.1 { next } else { best })
}

/// The two cuts through the smallest box round a convex ring, across its longer side and along it: a point and a normal.
fn cuts(ring: &Ring, share: f64) -> [(Point2, Vector2); 2] {
    let origin = ring.corners[0];
    let mut best = (f64::INFINITY, (origin, Vector2::x()), (origin, Vector2::y()));
    for index in 0..ring.len() {
        // One side of the smallest box round a convex polygon lies on an edge of it (Freeman and Shapira 1975).
        let Some(along) = ring.edge(index).try_normalize(1e-9) else { continue };
        let across = Vector2::new(-along.y, along.x);
        let span = |axis: &Vector2| {
            ring.corners
                .iter()
                .map(|corner| (corner - origin).dot(axis))
                .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), at| (low.min(at), high.max(at)))
        };
        let (u, v) = (span(&along), span(&across));
        let (length, width) = (u.1 - u.0, v.1 - v.0);
        if length * width < best.0 {
            let over_long = (origin + along * (u.0 + length * share), along);
            let over_short = (origin + across * (v.0 + width * share), across);
            best = if length >= width {
                (length * width, over_long, over_short)
            } else {
                (length * width, over_short, over_long)
            };
        }
    }
    [best.1, best.2]
}
