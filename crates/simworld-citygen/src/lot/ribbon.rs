//! Lots along the streets of an open block, as deep as there is room.

use simworld_core::geometry::Vector2;
use simworld_core::seed::Stream;

use super::divide::{Divider, longest_front};
use super::slabs::{Street, stations};
use super::{GreenKind, stream_at};
use crate::block::{Block, Border, Ring, Split};
use crate::occupancy::Occupancy;
use crate::zoning::Zone;

/// Fronts shorter than this have no lots, m.
const SHORTEST_FRONT: f64 = 6.0;

/// A lot is not halved to less than this, m.
const NARROWEST_HALF: f64 = 7.0;
/// A corner less sharp than this is a bend of one street; the sine of the angle.
const BEND: f64 = 0.3;

/// Lines the streets of an open block with lots that touch neither `taken` nor one another.
pub(super) fn line(
    divider: &mut Divider<'_>,
    block: &Block,
    streams: Stream,
    taken: &Occupancy,
    ribbons: &mut Occupancy,
) {
    let ring = block.ring();
    let mut fronts: Vec<(usize, f64)> = (0..ring.len())
        .filter(|index| ring.borders[*index].is_street())
        .map(|index| (index, ring.edge(index).norm()))
        .filter(|(_, length)| *length >= SHORTEST_FRONT)
        .collect();
    // Longer streets take the corners.
    fronts.sort_by(|a, b| b.1.total_cmp(&a.1).then(a.0.cmp(&b.0)));
    let mut depths = vec![0.0; ring.len()];
    for (index, length) in fronts {
        let along = ring.edge(index) / length;
        let street = Street { border: ring.borders[index], start: ring.corners[index], along };
        // A stream for each front, so that a change elsewhere on the outskirts changes no lot here.
        divider.rng = stream_at(street.start, streams).rng();
        let middle = street.start + along * (length * 0.5) + street.inwards() * 15.0;
        let is_park = divider.enter(middle) == Zone::Park;
        if !is_park {
            divider.add_frontage(length);
        }
        let size = divider.size();
        let depth = size.depth.min(size.most_area / size.most_width);
        let Some(row) = row(&ring, index, &street, depth, &depths) else { continue };
        depths[index] = depth;
        let mut lots = Vec::new();
        for lot in stations(divider, &row, &street) {
            fit(&lot, &Site { street: &street, depth, taken }, ribbons, &mut lots);
        }
        for lot in lots {
            let (front, width) = longest_front(&lot);
            if is_park {
                divider.green(&lot, GreenKind::Park);
            } else if width >= 4.0 && lot.area() >= size.least_area {
                divider.file_lot(&lot, front);
            } else {
                divider.green(&lot, GreenKind::Leftover);
            }
        }
    }
}

/// The strip along one edge: at a corner up to the street round it, or up to the row along that street if there is one
/// already; at a bend up to the line between the two strips. `None` if nothing is left.
fn row(ring: &Ring, index: usize, street: &Street, depth: f64, depths: &[f64]) -> Option<Ring> {
    let (start, end) = (street.start, ring.next(index));
    let deep = street.inwards() * depth;
    let mut row = Ring {
        corners: [start, end, end + deep, start + deep].into_iter().collect(),
        borders: [street.border, Border::LAND, Border::LAND, Border::LAND].into_iter().collect(),
    };
    let count = ring.len();
    let (mut kept, mut cut) = (Ring::default(), Ring::default());
    for (neighbour, corner) in [((index + count - 1) % count, start), ((index + 1) % count, end)] {
        let Some(along) = ring.edge(neighbour).try_normalize(1e-9) else { continue };
        let sine = if corner == start { along.perp(&street.along) } else { street.along.perp(&along) };
        if sine <= 1e-6 {
            continue;
        }
        let outwards = Vector2::new(along.y, -along.x);
        let (at, normal) = if sine < BEND {
            let bisector = if corner == start { street.along - along } else { along - street.along };
            let normal = Vector2::new(bisector.y, -bisector.x);
            (corner, if corner == start { -normal } else { normal })
        } else {
            (corner - outwards * depths[neighbour], outwards)
        };
        if row.split(at, normal, &mut kept, &mut cut) == Split::Ahead {
            return None;
        }
        std::mem::swap(&mut row, &mut kept);
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
    let (index, width) = longest_front(lot);
    let middle = lot.corners[index] + lot.edge(index) * 0.5;
    let (mut left, mut right) = (Ring::default(), Ring::default());
    if width >= NARROWEST_HALF * 2.0
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
    if is_free(lot) {
        return Some(lot.clone());
    }
    let (mut front, mut rear) = (Ring::default(), Ring::default());
    for share in [0.7, 0.45] {
        let at = site.street.start + inwards * (site.depth * share);
        if lot.split(at, inwards, &mut front, &mut rear) == Split::Both && is_free(&front) {
            return Some(front);
        }
    }
    None
}
