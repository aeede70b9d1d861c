//! How much room the buildings leave: streets become narrower where walls stand close.
//!
//! Tags rarely say how wide a sidewalk is. Walls do: what is taken from the kind of street is cut to what there is.

use simworld_core::geometry::{Point2, Vector2};
use simworld_core::lists::Lists;
use simworld_core::net::polyline;

use super::profile::Profile;
use super::web::Web;
use crate::osm::building::Outline;
use crate::osm::mask::Mask;

/// Walls farther away than this do not matter, m.
const REACH: f64 = 16.0;
/// Width of a cell of the search grid, m.
const CELL: f64 = 16.0;
/// Distance of the places where a street is measured, m.
const STEP: f64 = 4.0;
/// How far from its ends a street is measured, m; there the walls are those of the next street.
const ENDS: f64 = 8.0;
/// The share of the places that may be narrower: a single oriel does not narrow a street.
const IGNORED: f64 = 0.08;
/// What is kept between sidewalk and wall, m.
const GAP: f64 = 0.1;
/// The narrowest sidewalk, dm; where there is less room there is none.
const LEAST_SIDEWALK: u16 = 10;
/// How far a carriageway is moved from where it was drawn, dm: maps are not more exact.
const MOST_SHIFT: i32 = 20;
/// The narrowest lane, dm.
const LEAST_LANE: u16 = 22;

/// Cells along one side of the grid; it is wrapped round, so that far walls share cells.
const SIDE: i64 = 512;

/// Walls by the cells that they pass.
struct Walls {
    /// Those of each cell.
    cells: Lists<[Point2; 2]>,
    /// Where there are any.
    mask: Mask,
}

fn cell(point: Point2) -> (i64, i64) {
    ((point.x / CELL).floor() as i64, (point.y / CELL).floor() as i64)
}

/// The places in the grid of the cells of a box.
fn cells(low: Point2, high: Point2) -> impl Iterator<Item = usize> {
    let (low, high) = (cell(low), cell(high));
    (low.0..=high.0).flat_map(move |x| {
        (low.1..=high.1).map(move |y| (x.rem_euclid(SIDE) * SIDE + y.rem_euclid(SIDE)) as usize)
    })
}

impl Walls {
    fn of(buildings: &[Outline]) -> Self {
        let mut mask = Mask::new();
        let mut filed: Vec<(usize, [Point2; 2])> = Vec::new();
        for building in buildings {
            let next = building.corners.iter().cycle().skip(1);
            for (a, b) in building.corners.iter().zip(next) {
                // In pieces no longer than a cell, so that each lies in few of them.
                let count = ((b - a).norm() / CELL).ceil().max(1.0);
                for index in 0..count as u32 {
                    let at = |index: u32| a + (b - a) * (f64::from(index) / count);
                    let piece = [at(index), at(index + 1)];
                    mask.mark(&piece, 0.0);
                    let passed = cells(piece[0].inf(&piece[1]), piece[0].sup(&piece[1]));
                    filed.extend(passed.map(|cell| (cell, piece)));
                }
            }
        }
        Self { cells: Lists::of((SIDE * SIDE) as usize, filed.into_iter()), mask }
    }

    /// How far one sees from a point in a direction, m; at most [`REACH`].
    fn distance(&self, from: Point2, towards: Vector2) -> f64 {
        let to = from + towards * REACH;
        let (low, high) = (from.inf(&to), from.sup(&to));
        let mut share: f64 = 1.0;
        for cell in cells(low, high) {
            for [a, b] in &self.cells[cell] {
                let is_beside = a.x.max(b.x) < low.x
                    || a.x.min(b.x) > high.x
                    || a.y.max(b.y) < low.y
                    || a.y.min(b.y) > high.y;
                if is_beside {
                    continue;
                }
                if let Some((along, _)) = polyline::crossing(from, to, *a, *b) {
                    share = share.min(along);
                }
            }
        }
        share * REACH
    }

    /// Whether there may be walls in sight of a piece of a street.
    fn are_near(&self, piece: &[Point2]) -> bool {
        self.mask.touches(piece, REACH)
    }
}

/// Narrows all streets to the room between the buildings.
pub(super) fn fit(web: &mut Web, buildings: &[Outline]) {
    if buildings.is_empty() {
        return;
    }
    let walls = Walls::of(buildings);
    let mut sides = [Vec::new(), Vec::new()];
    for edge in 0..web.edges.len() as u32 {
        let character = web.edge(edge).character;
        if !web.edge(edge).lives || character.is_covered || character.level != 0 {
            continue;
        }
        measure(&web.course(edge), &walls, &mut sides);
        let [left, right] = &mut sides;
        if let (Some(left), Some(right)) = (narrowest(left), narrowest(right)) {
            narrow(&mut web.edges[edge as usize].character.profile, [left, right]);
        }
    }
}

/// The room to the left and right of a line, place by place.
fn measure(line: &[Point2], walls: &Walls, sides: &mut [Vec<f64>; 2]) {
    sides.iter_mut().for_each(Vec::clear);
    let length = polyline::length(line);
    let ends = ENDS.min(length * 0.3);
    let (mut next, mut station) = (ends, 0.0);
    for pair in line.windows(2) {
        let step = pair[1] - pair[0];
        let span = step.norm();
        let are_near = walls.are_near(pair);
        while next <= station + span && next <= length - ends && span > 0.0 {
            let at = pair[0] + step * ((next - station) / span);
            let left = Vector2::new(-step.y, step.x) / span;
            for (side, towards) in sides.iter_mut().zip([left, -left]) {
                side.push(if are_near { walls.distance(at, towards) } else { REACH });
            }
            next += STEP;
        }
        station += span;
    }
}

/// The room that all but a few places have.
fn narrowest(room: &mut [f64]) -> Option<f64> {
    if room.is_empty() {
        return None;
    }
    let rank = (room.len() as f64 * IGNORED) as usize;
    Some(*room.select_nth_unstable_by(rank, f64::total_cmp).1)
}

/// Moves the carriageway from a wall that is too near to the other side, if there is room; then narrows what lies beside
/// the lanes, the lanes, and the sidewalks.
fn narrow(profile: &mut Profile, room: [f64; 2]) {
    let [left, right] = room.map(|room| ((room - GAP) * 10.0).max(0.0) as i32);
    let half = |profile: &Profile| (profile.carriageway() * 5.0).ceil() as i32;
    while 2 * half(profile) > left + right {
        if profile.parking != [0, 0] {
            profile.parking = [0, 0];
        } else if profile.cycle != [0, 0] {
            profile.cycle = [0, 0];
        } else if profile.median > 10 {
            profile.median = 10;
        } else {
            let lanes = i32::from(profile.forward + profile.backward);
            let lane = (left + right - i32::from(profile.median)) / lanes;
            profile.lane = lane.clamp(i32::from(LEAST_LANE), 60) as u16;
            break;
        }
    }
    let half = half(profile);
    // To the left where the right wall is too near, and the other way round; to the middle where both are.
    let shift = if left + right < 2 * half {
        (left - right) / 2
    } else {
        (half - right).max(0) - (half - left).max(0)
    };
    let shift = shift.clamp(-MOST_SHIFT, MOST_SHIFT);
    profile.shift = shift as i16;
    for (sidewalk, room) in profile.sidewalk.iter_mut().zip([left - shift, right + shift]) {
        let free = (room - half).max(0) as u16;
        *sidewalk = if free < LEAST_SIDEWALK { 0 } else { (*sidewalk).min(free) };
    }
}
