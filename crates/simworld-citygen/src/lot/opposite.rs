//! Fronts that look at one another across a bay of an open block: each has the land up to half the way.

use simworld_core::geometry::Point2;

use super::corner::Front;
use super::slabs::Street;
use crate::block::Ring;

/// Fronts look at one another that turn away from being opposite by less than this; the cosine.
const OPPOSITE: f64 = -0.5;

/// Fronts along which buildings may stand, by where they lie.
pub(super) struct Opposite {
    /// Where each begins and ends, by their least coordinates along x.
    fronts: Vec<(Point2, Point2)>,
    /// How far the longest of them reaches along x, m.
    longest: f64,
}

impl Opposite {
    pub(super) fn of(ring: &Ring, fronts: &[Front]) -> Self {
        let built = (0..ring.len()).filter(|index| fronts[*index].is_built);
        let mut fronts: Vec<_> = built.map(|index| (ring.corners[index], ring.next(index))).collect();
        fronts.sort_by(|a, b| west(a).total_cmp(&west(b)));
        let longest = fronts.iter().map(|(start, end)| (end.x - start.x).abs()).fold(0.0, f64::max);
        Self { fronts, longest }
    }

    /// Those that look at a row of that depth from less than twice as far.
    pub(super) fn facing(&self, row: &Ring, street: &Street, depth: f64) -> Vec<(Point2, Point2)> {
        let reach = street.inwards() * (2.0 * depth);
        let ends = row.corners.iter().flat_map(|corner| [corner.x, corner.x + reach.x]);
        let (low, high) = ends.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), x| (a.min(x), b.max(x)));
        let first = self.fronts.partition_point(|front| west(front) < low - self.longest);
        let near = self.fronts[first..].iter().take_while(|front| west(front) <= high);
        near.filter(|(start, end)| {
            let along = end - start;
            along.dot(&street.along) < OPPOSITE * along.norm()
                && [start, end].iter().any(|corner| {
                    let height = (*corner - street.start).dot(&street.inwards());
                    (0.0..2.0 * depth).contains(&height)
                })
        })
        .copied()
        .collect()
    }
}

/// How deep a lot may be where others look at it, m: half the way to the nearest, if that is the least for both or more.
pub(super) fn shared(
    facing: &[(Point2, Point2)],
    lot: &Ring,
    street: &Street,
    depth: f64,
    least: f64,
) -> f64 {
    let station = |point: &Point2| (point - street.start).dot(&street.along);
    let (low, high) = lot
        .corners
        .iter()
        .map(station)
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), at| (low.min(at), high.max(at)));
    let mut nearest = f64::INFINITY;
    for (start, end) in facing {
        // It runs the other way.
        let (first, last) = (station(end), station(start));
        let (from, to) = (low.max(first), high.min(last));
        if from >= to {
            continue;
        }
        for at in [from, to] {
            let point = end + (start - end) * ((at - first) / (last - first));
            nearest = nearest.min((point - street.start).dot(&street.inwards()));
        }
    }
    if (2.0 * least..2.0 * depth).contains(&nearest) { nearest * 0.5 } else { depth }
}

fn west((start, end): &(Point2, Point2)) -> f64 {
    start.x.min(end.x)
}
