//! Lots along the streets of an open block, as deep as there is room.

use simworld_core::geometry::Point2;
use simworld_core::seed::Stream;

use super::corner::{Corner, Front};
use super::divide::{Divider, longest_front};
use super::opposite::{Opposite, shared};
use super::slabs::{Street, front, stations};
use super::{GreenKind, LotSize, PER_METRE};
use crate::block::{Block, Border, Ring, Split};
use crate::key::stream_at;
use crate::occupancy::Occupancy;
use crate::zoning::Zone;

/// Fronts shorter than this have no lots, m.
const SHORTEST_FRONT: f64 = 6.0;
/// Where fronts that look at one another would have less than this each, the longer takes all, m.
const SHALLOWEST: f64 = 8.0;
/// A lot is not halved to less than this, m.
const NARROWEST_HALF: f64 = 7.0;

/// The land that lots are fitted into.
pub(super) struct Land<'a> {
    /// The streams of all lots.
    pub(super) streams: Stream,
    /// What they may not touch: the land of the roads.
    pub(super) taken: &'a Occupancy,
    /// Whether a front, by its edge, gets its lots: all do in a whole city.
    pub(super) is_fitted: &'a dyn Fn(usize) -> bool,
}

/// Lines the streets of an open block with lots that touch neither what is taken nor one another; says how long the front of each
/// is where buildings may stand, m.
pub(super) fn line(
    divider: &mut Divider<'_>,
    block: &Block,
    land: &Land<'_>,
    ribbons: &mut Occupancy,
) -> Vec<f64> {
    let ring = block.ring();
    let order = in_order(&ring);
    let mut fronts = vec![Front::default(); ring.len()];
    for (index, length) in &order {
        let is_built = divider.enter(enter(&street_of(&ring, *index, *length), *length)) != Zone::Park;
        fronts[*index] = Front { length: *length, is_built, depths: [0.0; 2] };
    }
    let built =
        order.iter().filter(|(index, _)| fronts[*index].is_built).map(|(_, length)| *length).collect();
    let opposite = Opposite::of(&ring, &fronts);
    for (index, length) in order.into_iter().filter(|(index, _)| (land.is_fitted)(*index)) {
        let street = street_of(&ring, index, length);
        divider.along = street.border;
        // A stream for each front, so that a change elsewhere on the outskirts changes no lot here.
        divider.rng = stream_at(street.start, PER_METRE, land.streams).rng();
        let is_park = divider.enter(enter(&street, length)) == Zone::Park;
        let size = divider.size();
        let depth = depth_of(size);
        let ends = [false, true].map(|is_end| Corner::of(&ring, &fronts, (index, street.along), is_end));
        let Some(row) = row(&street, ring.next(index), depth, &ends) else { continue };
        let facing = opposite.facing(&row, &street, depth);
        let least = SHALLOWEST.max(size.least_area / size.least_width);
        let mut lots = Vec::new();
        let mut depths: Option<[f64; 2]> = None;
        stations(divider, &row, &street, |_, lot| {
            let depth = shared(&facing, lot, &street, depth, least);
            depths = Some(depths.map_or([depth; 2], |[first, _]| [first, depth]));
            fit(lot, &Site { street: &street, depth, taken: land.taken }, ribbons, &mut lots);
        });
        fronts[index].depths = depths.unwrap_or([depth; 2]);
        for lot in lots {
            file(divider, &lot, is_park);
        }
    }
    built
}

/// Files a lot; one of a park, or too small or too narrow, is green.
fn file(divider: &mut Divider<'_>, lot: &Ring, is_park: bool) {
    let ((front, width), area) = (longest_front(lot), lot.area());
    if is_park {
        divider.green(lot, GreenKind::Park);
    } else if width >= 4.0 && area >= divider.size().least_area {
        divider.file_lot((lot, area), front);
    } else {
        divider.green(lot, GreenKind::Leftover);
    }
}

/// The edges of an open block that get lots and their lengths, m, in the order in which they do: longer streets take the corners.
pub(super) fn in_order(ring: &Ring) -> Vec<(usize, f64)> {
    let mut order: Vec<(usize, f64)> = (0..ring.len())
        .filter(|index| ring.borders[*index].is_street())
        .map(|index| (index, ring.edge(index).norm()))
        .filter(|(_, length)| *length >= SHORTEST_FRONT)
        .collect();
    order.sort_by(|a, b| b.1.total_cmp(&a.1).then(a.0.cmp(&b.0)));
    order
}

/// The street along an edge of that length, m.
pub(super) fn street_of(ring: &Ring, edge: usize, length: f64) -> Street {
    Street { border: ring.borders[edge], start: ring.corners[edge], along: ring.edge(edge) / length }
}

/// The place whose zone is that of the land along a street of that length, m.
pub(super) fn enter(street: &Street, length: f64) -> Point2 {
    street.start + street.along * (length * 0.5) + street.inwards() * 15.0
}

/// How deep lots of open land are at most, m.
pub(super) fn depth_of(size: &LotSize) -> f64 {
    size.depth.min(size.most_area / size.most_width)
}

/// The strip along one street, up to the limits at its ends; `None` if nothing is left.
fn row(street: &Street, end: Point2, depth: f64, ends: &[Option<Corner>; 2]) -> Option<Ring> {
    let start = street.start;
    let deep = street.inwards() * depth;
    let [before, after] =
        [0, 1].map(|end| street.along * (ends[end].as_ref().map_or(0.0, Corner::lean) * depth));
    let mut row = Ring {
        corners: [start, end, end + deep + after, start + deep - before].into_iter().collect(),
        borders: [street.border, Border::LAND, Border::LAND, Border::LAND].into_iter().collect(),
    };
    let (mut kept, mut cut) = (Ring::default(), Ring::default());
    for corner in ends.iter().flatten() {
        let (at, normal) = corner.limit();
        if row.split(at, normal, &mut kept, &mut cut) == Split::Ahead {
            return None;
        }
        std::mem::swap(&mut row, &mut kept);
    }
    for corner in ends.iter().flatten() {
        corner.label(&mut row);
    }
    Some(row)
}

/// Where a lot is to be fitted in.
struct Site<'a> {
    street: &'a Street,
    depth: f64,
    taken: &'a Occupancy,
}

/// Takes the lot, or as much of its depth as is free; where nothing is, whichever of its halves has room.
fn fit(lot: &Ring, site: &Site<'_>, ribbons: &mut Occupancy, lots: &mut Vec<Ring>) {
    if let Some(lot) = shorten(lot, site, ribbons) {
        ribbons.add(&lot.corners);
        lots.push(lot);
        return;
    }
    let Some((start, end)) = front(lot, site.street) else { return };
    let middle = site.street.start + site.street.along * (0.5 * (start + end));
    let (mut left, mut right) = (Ring::default(), Ring::default());
    if end - start >= NARROWEST_HALF * 2.0
        && lot.split(middle, site.street.along, &mut left, &mut right) == Split::Both
    {
        for half in [left, right] {
            if let Some(half) = shorten(&half, site, ribbons) {
                ribbons.add(&half.corners);
                lots.push(half);
            }
        }
    }
}

/// The lot, or as much of its depth as is free; `None` if too little is.
fn shorten(lot: &Ring, site: &Site<'_>, ribbons: &Occupancy) -> Option<Ring> {
    let inwards = site.street.inwards();
    // A lot begins where its sidewalk ends, so the test is made a little behind.
    let mut tested = Vec::with_capacity(lot.len() + 2);
    let mut is_free = |lot: &Ring| {
        let middle = lot.middle();
        tested.clear();
        tested.extend(lot.corners.iter().map(|corner| middle + (corner - middle) * 0.99));
        site.taken.is_free(&tested) && ribbons.is_free(&tested)
    };
    let (mut front, mut rear) = (Ring::default(), Ring::default());
    for share in [1.0, 0.7, 0.45] {
        let at = site.street.start + inwards * (site.depth * share);
        if lot.split(at, inwards, &mut front, &mut rear) != Split::Ahead && is_free(&front) {
            return Some(front);
        }
    }
    None
}
