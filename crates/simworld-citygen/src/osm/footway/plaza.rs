//! What of the squares is open to walkers: not the land of streets that is drawn over, nor what is built on them.

use i_overlay::core::fill_rule::FillRule;
use i_overlay::core::overlay_rule::OverlayRule;
use i_overlay::float::single::SingleFloatOverlay;
use simworld_core::geometry::{Point2, bounds};
use simworld_core::id::PlazaId;
use simworld_core::net::{Footpath, Plaza, polyline};

use super::land::Land;
use super::square::{Square, area};

/// A ring of corners, m.
type Ring = Vec<[f64; 2]>;

/// Rings of less are left out, m²: holes in which nobody would see anything, and slivers.
const LEAST_HOLE: f64 = 0.5;
const LEAST: f64 = 4.0;

/// The open parts of the squares on which some way lies, of which each is told which square it crosses; the ways are told on
/// which part they lie.
pub(super) fn open(
    squares: &[Square],
    land: &Land,
    paths: &mut [Footpath],
    across: &[Option<usize>],
) -> Vec<Plaza> {
    let mut plazas = Vec::new();
    for (number, square) in squares.iter().enumerate() {
        let ways: Vec<usize> = (0..paths.len()).filter(|way| across[*way] == Some(number)).collect();
        if ways.is_empty() {
            continue;
        }
        for part in parts(square, land) {
            let on_it = ways.iter().copied().filter(|way| {
                let path = &paths[*way].path;
                part.contains(polyline::at(path, polyline::length(path) * 0.5).0)
            });
            let on_it: Vec<usize> = on_it.collect();
            if on_it.is_empty() {
                continue;
            }
            let id = Some(PlazaId::from_index(plazas.len()));
            for way in on_it {
                paths[way].plaza = id;
            }
            plazas.push(part);
        }
    }
    plazas
}

/// The open parts of a square.
fn parts(square: &Square, land: &Land) -> Vec<Plaza> {
    let mut rings = square.rings();
    let Some(edge) = rings.next() else { return Vec::new() };
    let Some((low, high)) = bounds(edge) else { return Vec::new() };
    let closed: Vec<Ring> = rings.chain(land.near(low, high)).map(counter_clockwise).collect();
    let open = counter_clockwise(edge).overlay(&closed, OverlayRule::Difference, FillRule::NonZero);
    let parts = open.into_iter().filter_map(|part| {
        let mut rings = part.into_iter();
        let edge = directed(rings.next()?, 1.0);
        let holes = rings.map(|hole| directed(hole, -1.0)).filter(|hole| -area(hole) >= 2.0 * LEAST_HOLE);
        let part = Plaza { edge, holes: holes.collect() };
        (part.area() >= LEAST).then_some(part)
    });
    parts.collect()
}

/// A ring that goes round so, for those that go round otherwise would take nothing away where they lie on one another.
fn counter_clockwise(ring: &[Point2]) -> Ring {
    let corners = ring.iter().map(|corner| [corner.x, corner.y]);
    if area(ring) < 0.0 { corners.rev().collect() } else { corners.collect() }
}

/// A ring that goes round counter-clockwise, or clockwise if the sign is negative.
fn directed(ring: Ring, sign: f64) -> Vec<Point2> {
    let mut ring: Vec<Point2> = ring.into_iter().map(Point2::from).collect();
    if area(&ring) * sign < 0.0 {
        ring.reverse();
    }
    ring
}
