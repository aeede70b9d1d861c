//! A block cut into convex pieces, at the corners where streets reach into it.

use simworld_core::geometry::{Point2, Vector2};

use super::{Border, Ring};

/// Corners that turn in by less than this are taken as straight, against rounding; the sine of the angle.
const FLAT: f64 = 1e-7;
/// Corners less sharp than this are bends; the sine of the angle.
const BEND: f64 = 0.6;
/// Pieces that one block may be cut into.
const MOST_PIECES: usize = 400;

/// Convex pieces that make up a simple ring exactly; what could not be cut, in shapes thinner than rounding, is left
/// out and comes back as the second value, m².
pub(crate) fn decompose(ring: Ring) -> (Vec<Ring>, f64) {
    let mut pending = vec![ring];
    let mut pieces = Vec::new();
    let mut lost = 0.0;
    while let Some(ring) = pending.pop() {
        if ring.area() < 1e-6 {
            continue;
        }
        let Some(reflex) = (0..ring.len()).find(|index| is_reflex(&ring, *index)) else {
            pieces.push(ring);
            continue;
        };
        match cut_at(&ring, reflex).filter(|_| pieces.len() + pending.len() < MOST_PIECES) {
            Some((a, b)) => pending.extend([b, a]),
            None => lost += ring.area(),
        }
    }
    (pieces, lost)
}

fn before(ring: &Ring, index: usize) -> usize {
    if index == 0 { ring.len() - 1 } else { index - 1 }
}

fn after(ring: &Ring, index: usize) -> usize {
    if index + 1 == ring.len() { 0 } else { index + 1 }
}

fn is_reflex(ring: &Ring, index: usize) -> bool {
    let (u, v) = (ring.edge(before(ring, index)), ring.edge(index));
    let turned = u.perp(&v);
    // Most corners turn out.
    turned < 0.0 && turned < -FLAT * u.norm() * v.norm()
}

/// Cuts a ring in two at a corner that turns in. At the bend of a street the cut runs between its edges; at a sharp
/// corner also on along one of them, which leaves rectangles: whichever is shortest, rectangles at a discount.
fn cut_at(ring: &Ring, corner: usize) -> Option<(Ring, Ring)> {
    let along_in = ring.edge(before(ring, corner)).try_normalize(1e-12)?;
    let along_out = ring.edge(corner).try_normalize(1e-12)?;
    let between = (along_in - along_out).try_normalize(1e-9).unwrap_or(Vector2::new(-along_in.y, along_in.x));
    let bisector = if between.dot(&Vector2::new(-along_in.y, along_in.x)) < 0.0 { -between } else { between };
    let is_bend = along_in.perp(&along_out).abs() < BEND && along_in.dot(&along_out) > 0.0;
    let directions = [(bisector, 1.5), (along_in, 1.0), (-along_out, 1.0)];
    directions[..if is_bend { 1 } else { 3 }]
        .iter()
        .filter_map(|(direction, price)| {
            let hit = first_hit(ring, corner, *direction)?;
            Some((hit.distance * price, hit))
        })
        .min_by(|a, b| a.0.total_cmp(&b.0))
        .map(|(_, hit)| divide(ring, corner, &hit))
}

struct Hit {
    edge: usize,
    point: Point2,
    distance: f64,
}

/// The first edge that a ray from a corner meets.
#[expect(clippy::needless_bitwise_bool, reason = "which of the three it is cannot be foretold")]
fn first_hit(ring: &Ring, corner: usize, direction: Vector2) -> Option<Hit> {
    let origin = ring.corners[corner];
    let mut best: Option<Hit> = None;
    for edge in 0..ring.len() {
        if edge == corner || edge == before(ring, corner) {
            continue;
        }
        let (start, along) = (ring.corners[edge], ring.edge(edge));
        let det = direction.perp(&along);
        if det.abs() < 1e-12 {
            continue;
        }
        let to_start = start - origin;
        let (distance, share) = (to_start.perp(&along), to_start.perp(&direction));
        // Most edges lie behind, or plainly beside the ray: that is seen without a division.
        if (distance * det < 0.0) | (share * det < 0.0) | (share.abs() > det.abs() * (1.0 + 1e-9)) {
            continue;
        }
        let (distance, share) = (distance / det, share / det);
        let is_hit = distance > 1e-6 && (0.0..=1.0).contains(&share);
        if is_hit && best.as_ref().is_none_or(|best| distance < best.distance) {
            best = Some(Hit { edge, point: start + along * share, distance });
        }
    }
    best
}

/// The two parts of a ring on either side of a cut from a corner to a point of an edge.
fn divide(ring: &Ring, corner: usize, hit: &Hit) -> (Ring, Ring) {
    let mut left = part(ring, (corner, hit.edge), &[]);
    left.push(hit.point, Border::LAND);
    let cut = [(ring.corners[corner], Border::LAND), (hit.point, ring.borders[hit.edge])];
    let right = part(ring, (after(ring, hit.edge), before(ring, corner)), &cut);
    (tidy(left), tidy(right))
}

/// The corners of a ring from one round to another, behind some others.
fn part(ring: &Ring, (from, to): (usize, usize), ahead: &[(Point2, Border)]) -> Ring {
    let count = if from <= to { to + 1 - from } else { ring.len() - from + to + 1 };
    // One more, for the end of the cut.
    let mut part = Ring::with_capacity(count + ahead.len() + 1);
    for (corner, border) in ahead {
        part.push(*corner, *border);
    }
    if from <= to {
        part.extend(ring, from..to + 1);
    } else {
        part.extend(ring, from..ring.len());
        part.extend(ring, 0..to + 1);
    }
    part
}

/// Without corners that coincide.
fn tidy(ring: Ring) -> Ring {
    let is_apart = |index: &usize| ring.edge(*index).norm_squared() > 1e-14;
    // Hardly ever do any.
    if (0..ring.len()).all(|index| is_apart(&index)) {
        return ring;
    }
    let mut clean = Ring::default();
    for index in (0..ring.len()).filter(is_apart) {
        clean.push(ring.corners[index], ring.borders[index]);
    }
    clean
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ring(points: &[(f64, f64)]) -> Ring {
        let corners: Vec<Point2> = points.iter().map(|(x, y)| Point2::new(*x, *y)).collect();
        let borders = vec![Border::CORNER; corners.len()];
        Ring { corners: corners.into(), borders: borders.into() }
    }

    #[test]
    fn an_l_is_two_rectangles() {
        let l = ring(&[(0.0, 0.0), (60.0, 0.0), (60.0, 30.0), (30.0, 30.0), (30.0, 70.0), (0.0, 70.0)]);
        let area = l.area();
        let (pieces, lost) = decompose(l);
        assert_eq!((pieces.len(), lost), (2, 0.0));
        assert!((pieces.iter().map(Ring::area).sum::<f64>() - area).abs() < 1e-9);
        assert!(pieces.iter().all(|piece| piece.len() == 4 || piece.len() == 5));
    }

    #[test]
    fn a_dead_end_leaves_convex_land() {
        let points = [
            (0.0, 0.0),
            (45.0, 0.0),
            (45.0, 50.0),
            (55.0, 50.0),
            (55.0, 0.0),
            (100.0, 0.0),
            (100.0, 90.0),
            (0.0, 90.0),
        ];
        let block = ring(&points);
        let area = block.area();
        let (pieces, _) = decompose(block);
        assert!((pieces.iter().map(Ring::area).sum::<f64>() - area).abs() < 1e-9);
        for piece in &pieces {
            assert!((0..piece.len()).all(|index| !is_reflex(piece, index)));
        }
    }
}
