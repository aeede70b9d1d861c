//! Bodies that are not the traffic's own: found on lanes and crossings, so that drivers stop for them.

use std::collections::BTreeMap;

use simworld_core::geometry::{Point2, Vector2};
use simworld_core::net::polyline;

use crate::vehicle::Tracks;

/// Width of a cell of the search grid, m.
const CELL: f64 = 8.0;
/// Half the width that a vehicle sweeps, with a margin, m.
const SWEPT: f64 = 1.3;

/// A body that is not the traffic's own.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Foreign {
    /// Where it stands, m.
    pub position: Point2,
    /// How far it reaches before and behind, m.
    pub radius: f64,
    /// How far it reaches to its sides, m.
    pub half_width: f64,
    /// Where its front is, of length one.
    pub direction: Vector2,
    /// m/s.
    pub velocity: Vector2,
}

impl Foreign {
    /// A round body that stands: how far it reaches to all sides, m.
    pub fn standing(position: Point2, radius: f64) -> Self {
        Self { position, radius, half_width: radius, direction: Vector2::x(), velocity: Vector2::zeros() }
    }
}

/// Finds the tracks and crossings at a place.
#[derive(Clone, Debug, Default)]
pub(super) struct Finder {
    tracks: BTreeMap<(i64, i64), Vec<u32>>,
    crossings: BTreeMap<(i64, i64), Vec<u32>>,
}

fn cell(x: f64) -> i64 {
    (x / CELL).floor() as i64
}

/// The cells around the pieces of a path.
fn cells(path: &[Point2], margin: f64) -> Vec<(i64, i64)> {
    let mut found = Vec::new();
    for piece in path.windows(2) {
        // Short pieces, so that a long diagonal does not fill its whole box.
        let steps = ((piece[1] - piece[0]).norm() / CELL).ceil().max(1.0) as u64;
        for step in 0..steps {
            let share = |n: u64| piece[0] + (piece[1] - piece[0]) * (n as f64 / steps as f64);
            let (a, b) = (share(step), share(step + 1));
            let rows = (cell(a.y.min(b.y) - margin), cell(a.y.max(b.y) + margin));
            for column in cell(a.x.min(b.x) - margin)..=cell(a.x.max(b.x) + margin) {
                found.extend((rows.0..=rows.1).map(|row| (column, row)));
            }
        }
    }
    found.sort_unstable();
    found.dedup();
    found
}

impl Finder {
    pub(super) fn new(tracks: &Tracks) -> Self {
        let mut finder = Self::default();
        for track in 0..tracks.count() as u32 {
            for cell in cells(tracks.path(track), SWEPT + 1.0) {
                finder.tracks.entry(cell).or_default().push(track);
            }
        }
        for (index, crossing) in tracks.network.crossings.iter().enumerate() {
            for cell in cells(&[crossing.start, crossing.end], crossing.width) {
                finder.crossings.entry(cell).or_default().push(index as u32);
            }
        }
        finder
    }

    /// Calls with each crossing that may lie along a straight way.
    pub(super) fn crossings_along(&self, from: Point2, to: Point2, each: &mut impl FnMut(u32)) {
        for cell in cells(&[from, to], CELL * 0.5) {
            self.crossings.get(&cell).into_iter().flatten().for_each(|index| each(*index));
        }
    }

    /// Counts foreign bodies on each crossing, and lists those on tracks by track and station, sorted.
    pub(super) fn find(
        &self,
        tracks: &Tracks,
        foreign: &[Foreign],
        on_crossing: &mut [u32],
        obstacles: &mut Vec<(u32, f64)>,
    ) {
        on_crossing.fill(0);
        obstacles.clear();
        for body in foreign {
            let reach = body.radius.max(body.half_width);
            let here = (cell(body.position.x), cell(body.position.y));
            let mut crosses = false;
            for index in self.crossings.get(&here).into_iter().flatten() {
                let crossing = &tracks.network.crossings[*index as usize];
                let strip = [crossing.start, crossing.end];
                let near = polyline::closest(&strip, &body.position);
                if near.is_some_and(|near| near.distance <= crossing.width * 0.5 + reach) {
                    on_crossing[*index as usize] += 1;
                    crosses = true;
                }
            }
            if crosses {
                continue; // drivers stop before the strip, not before the person
            }
            for track in self.tracks.get(&here).into_iter().flatten() {
                let near = polyline::closest(tracks.path(*track), &body.position);
                if let Some(near) = near.filter(|near| near.distance < SWEPT + reach) {
                    obstacles.push((*track, near.station - reach));
                }
            }
        }
        obstacles.sort_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
    }
}
