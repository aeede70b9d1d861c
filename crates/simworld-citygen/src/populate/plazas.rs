//! Plazas as entities: paving in strips along the longest side, none of which reaches beyond an edge.

use simworld_core::geometry::{Point2, Vector2};
use simworld_core::id::PlazaId;
use simworld_core::net::Plaza;
use simworld_core::scene::EntityDesc;

use super::{CLIMB, Parts, Stripe};

/// Widest strip where an edge runs askew, m, and where none does; the larger a plaza, the wider the first.
const STRIP: f64 = 1.0;
const WIDEST: f64 = 1e3;
const MOST_STRIPS: f64 = 64.0;
/// Strips that are shorter or narrower are left out, m.
const LEAST: f64 = 0.05;
/// Edges that depart from square by less of their length run straight.
const ASKEW: f64 = 1e-3;

impl Parts<'_> {
    /// The paving of the plazas that the ways for walkers cross.
    pub(super) fn plazas(&self, descs: &mut Vec<EntityDesc>) {
        let mut crossed: Vec<usize> =
            self.footpaths().filter_map(|way| way.plaza).map(PlazaId::index).collect();
        crossed.sort_unstable();
        crossed.dedup();
        let widest = if self.heights.is_level() { WIDEST } else { CLIMB };
        for plaza in crossed.into_iter().filter_map(|plaza| self.network.plazas.get(plaza)) {
            for stripe in strips(plaza, widest) {
                let Stripe { a, b, half, .. } = stripe;
                self.walk(&super::in_pieces(&[a, b], widest), half * 2.0, descs);
            }
        }
    }
}

/// Strips that cover a plaza but for what is left beside edges that run askew; no wider than so much, m.
fn strips(plaza: &Plaza, widest: f64) -> Vec<Stripe> {
    let longest =
        plaza.sides().map(|[a, b]| b - a).max_by(|a, b| a.norm_squared().total_cmp(&b.norm_squared()));
    let Some(along) = longest.and_then(|side| side.try_normalize(1e-9)) else { return Vec::new() };
    let left = Vector2::new(-along.y, along.x);
    // As seen from the longest side: stations along it, and distances to its left.
    let seen = |at: Point2| Point2::new(along.dot(&at.coords), left.dot(&at.coords));
    let sides: Vec<[Point2; 2]> = plaza.sides().map(|side| side.map(seen)).collect();
    let mut found = Vec::new();
    for (low, high) in bands(&sides, widest) {
        for (from, to) in spans(&sides, low, high).into_iter().filter(|(from, to)| to - from > LEAST) {
            let middle = (low + high) * 0.5;
            let at = |station: f64| Point2::from(along * station + left * middle);
            found.push(Stripe { a: at(from), b: at(to), half: (high - low) * 0.5, extend: 0.0 });
        }
    }
    found
}

/// Distances between which strips lie, ascending: each band begins and ends at a corner, or is narrow where a side runs askew.
fn bands(sides: &[[Point2; 2]], widest: f64) -> Vec<(f64, f64)> {
    let mut levels: Vec<f64> = sides.iter().map(|[corner, _]| corner.y).collect();
    levels.sort_by(f64::total_cmp);
    let height = levels.last().zip(levels.first()).map_or(0.0, |(last, first)| last - first);
    let narrow = STRIP.max(height / MOST_STRIPS).min(widest);
    let mut bands = Vec::new();
    for pair in levels.windows(2).filter(|pair| pair[1] - pair[0] > LEAST) {
        let (low, high) = (pair[0], pair[1]);
        let is_askew = sides.iter().any(|[a, b]| {
            let passes = a.y.min(b.y) <= low && a.y.max(b.y) >= high;
            passes && (b.x - a.x).abs() > ASKEW * (b.y - a.y).abs()
        });
        let count = ((high - low) / if is_askew { narrow } else { widest }).ceil().max(1.0);
        let step = (high - low) / count;
        bands.extend((0..count as u32).map(|index| {
            let from = low + step * f64::from(index);
            (from, from + step)
        }));
    }
    bands
}

/// The parts of a band that lie within the plaza over its whole width, from station to station.
fn spans(sides: &[[Point2; 2]], low: f64, high: f64) -> Vec<(f64, f64)> {
    let middle = (low + high) * 0.5;
    let mut crossed: Vec<(f64, [f64; 2])> = sides
        .iter()
        .filter(|[a, b]| (a.y > middle) != (b.y > middle))
        .map(|[a, b]| {
            let at = |y: f64| a.x + (b.x - a.x) * ((y - a.y) / (b.y - a.y)).clamp(0.0, 1.0);
            (at(middle), [at(low), at(high)])
        })
        .collect();
    crossed.sort_by(|a, b| a.0.total_cmp(&b.0));
    let within = |pair: &[(f64, [f64; 2])]| {
        let [(_, [a, b]), (_, [c, d])] = [pair[0], pair[1]];
        (a.max(b), c.min(d))
    };
    crossed.chunks_exact(2).map(within).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ring(corners: &[(f64, f64)]) -> Vec<Point2> {
        corners.iter().map(|(x, y)| Point2::new(*x, *y)).collect()
    }

    fn area(strips: &[Stripe]) -> f64 {
        strips.iter().map(|Stripe { a, b, half, .. }| (b - a).norm() * half * 2.0).sum()
    }

    #[test]
    fn square_plazas_are_paved_whole_with_few_strips() {
        let turned = nalgebra::Rotation2::new(0.4);
        let edge = ring(&[(0.0, 0.0), (60.0, 0.0), (60.0, 40.0), (0.0, 40.0)]);
        let hole = ring(&[(20.0, 10.0), (20.0, 20.0), (30.0, 20.0), (30.0, 10.0)]);
        let turn = |ring: Vec<Point2>| ring.into_iter().map(|corner| turned * corner).collect();
        let plaza = Plaza { edge: turn(edge), holes: vec![turn(hole)] };
        let found = strips(&plaza, WIDEST);
        assert_eq!(found.len(), 4);
        assert!((area(&found) - 2300.0).abs() < 1e-6);
    }

    #[test]
    fn strips_stay_within_edges_that_run_askew() {
        let edge = ring(&[(0.0, 0.0), (50.0, 5.0), (62.0, 30.0), (20.0, 44.0), (-9.0, 20.0)]);
        let plaza = Plaza { edge, holes: vec![ring(&[(20.0, 15.0), (24.0, 24.0), (33.0, 19.0)])] };
        let found = strips(&plaza, WIDEST);
        let share = area(&found) / plaza.area();
        assert!((0.9..1.0).contains(&share), "{share} of it is paved");
        for Stripe { a, b, half, .. } in &found {
            let along = (b - a).normalize();
            let aside = Vector2::new(-along.y, along.x) * (half - 1e-6);
            for corner in [a + aside, a - aside, b + aside, b - aside] {
                let inner = corner + (nalgebra::center(a, b) - corner) * 1e-6;
                assert!(plaza.contains(inner), "{corner} is beyond the edge");
            }
        }
    }
}
