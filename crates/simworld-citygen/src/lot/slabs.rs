//! The offset and the skeleton pattern: rows of lots along the streets of a convex piece.
//!
//! A row is what lies within one depth of a street. Longer streets take their row first and with it the corners, as
//! corner houses do; what no street takes is the courtyard. With lots as deep as half the block the rows meet back to
//! back, along the lines of its skeleton where the streets are parallel.

use simworld_core::geometry::{Point2, Vector2};

use super::divide::Divider;
use super::{GreenKind, LotStyle};
use crate::block::{Border, Ring, Split};

/// A street shorter than this along a piece has no row of its own, m.
const SHORTEST_ROW: f64 = 6.0;
/// A courtyard narrower than this goes to the lots, m.
const NARROWEST_COURT: f64 = 9.0;

/// Divides a convex piece.
pub(super) fn divide(divider: &mut Divider<'_>, piece: Ring, style: LotStyle) {
    let mut streets: Vec<(Border, Point2, Vector2, f64)> = (0..piece.len())
        .filter(|index| piece.borders[*index].is_street())
        .filter_map(|index| {
            let along = piece.edge(index);
            let length = along.norm();
            (length >= SHORTEST_ROW)
                .then(|| (piece.borders[index], piece.corners[index], along / length, length))
        })
        .collect();
    // Longest first; equal ones in the order of the piece.
    streets.sort_by(|a, b| b.3.total_cmp(&a.3));
    // What is left and what is left of that change places: their names do, for a ring is long.
    let (mut one, mut other, mut row) = (piece, Ring::default(), Ring::default());
    let (mut left, mut rest) = (&mut one, &mut other);
    let mut rows: Vec<(Ring, Street)> = Vec::with_capacity(streets.len());
    for (border, start, along, _) in &streets {
        let street = Street { border: *border, start: *start, along: *along };
        let depth = depth(divider, left, &street, &streets, style);
        let inwards = street.inwards();
        match left.split(street.start + inwards * depth, inwards, &mut row, rest) {
            Split::Both => {
                rows.push((std::mem::take(&mut row), street));
                std::mem::swap(&mut left, &mut rest);
            }
            Split::Behind => {
                rows.push((std::mem::take(left), street));
                break;
            }
            Split::Ahead => {}
        }
    }
    for (row, street) in &rows {
        slice(divider, row, street);
    }
    divider.green(left, GreenKind::Courtyard);
}

/// A straight front of a piece, with the land on its left.
#[derive(Clone, Copy, Debug)]
pub(super) struct Street {
    pub(super) border: Border,
    pub(super) start: Point2,
    /// Unit vector.
    pub(super) along: Vector2,
}

impl Street {
    pub(super) fn inwards(&self) -> Vector2 {
        Vector2::new(-self.along.y, self.along.x)
    }
}

/// How deep the row of a street is, m: the depth of the zone, half of what there is if another street wants the other
/// half, all if only a strip would be left.
fn depth(
    divider: &Divider<'_>,
    left: &Ring,
    street: &Street,
    streets: &[(Border, Point2, Vector2, f64)],
    style: LotStyle,
) -> f64 {
    let inwards = street.inwards();
    let extent = left.corners.iter().map(|corner| (corner - street.start).dot(&inwards)).fold(0.0, f64::max);
    let is_shared = streets.iter().any(|other| {
        other.2.dot(&street.along) < -0.5 && left.borders.contains(&other.0) && other.0 != street.border
    });
    let wanted = divider.size().depth;
    let room = if is_shared { extent * 0.5 } else { extent };
    match style {
        LotStyle::Skeleton => room.min(2.0 * wanted),
        _ if is_shared && extent < 2.0 * wanted + NARROWEST_COURT => room,
        _ if !is_shared && extent < wanted + NARROWEST_COURT => room,
        _ => wanted,
    }
}

/// Cuts a row across into lots.
pub(super) fn slice(divider: &mut Divider<'_>, row: &Ring, street: &Street) {
    stations(divider, row, street, Divider::lot);
}

/// Hands out the lots of a row, one after the other.
pub(super) fn stations<'a>(
    divider: &mut Divider<'a>,
    row: &Ring,
    street: &Street,
    mut take: impl FnMut(&mut Divider<'a>, &Ring),
) {
    let Some((mut station, end)) = front(row, street) else {
        take(divider, row);
        return;
    };
    let size = divider.size();
    let (mut one, mut other, mut lot) = (row.clone(), Ring::default(), Ring::default());
    let (mut left, mut rest) = (&mut one, &mut other);
    loop {
        let room = end - station;
        let mut width = divider.rng.uniform(size.least_width, 0.5 * (size.least_width + size.most_width));
        if room <= size.most_width && room < width + size.least_width {
            break;
        }
        if room < width + size.least_width {
            width = room * 0.5;
        }
        station += width;
        match left.split(street.start + street.along * station, street.along, &mut lot, rest) {
            Split::Both => {
                take(divider, &lot);
                std::mem::swap(&mut left, &mut rest);
            }
            Split::Behind => break,
            Split::Ahead => {}
        }
    }
    take(divider, left);
}

/// From where to where a row borders its street, as stations on the street's line, m.
pub(super) fn front(row: &Ring, street: &Street) -> Option<(f64, f64)> {
    (0..row.len())
        .filter(|index| row.borders[*index] == street.border)
        .map(|index| {
            let at = |point: Point2| (point - street.start).dot(&street.along);
            (at(row.corners[index]), at(row.next(index)))
        })
        .reduce(|a, b| (a.0.min(b.0), a.1.max(b.1)))
        .filter(|(start, end)| end - start > 1.0)
}
