//! From the middles of the sidewalks to the land behind them: the boundary moved inwards, and its many short pieces
//! joined to straight fronts on which houses can stand in a row.

use simworld_core::geometry::{Point2, Vector2};

use super::trace::{Boundary, Piece};
use super::{Border, Ring};
use crate::occupancy::most;

/// How far a front may leave the sidewalk, m.
const TOLERANCE: f64 = 2.4;
/// Corners less sharp than this are parts of a bend; the sine of the angle.
const STRAIGHT: f64 = 0.02;
/// A piece shorter than this has no direction, m.
const SHORTEST: f64 = 1e-3;
/// What differs by more than this share differs, whatever was rounded.
const PLAIN: f64 = 1e-9;
/// A mitred corner farther than this many offsets from the corner it belongs to is cut off.
const LONGEST_MITRE: f64 = 4.0;

/// The land within a boundary; `None` if nothing is left.
pub(super) fn inset(boundary: &Boundary) -> Option<Ring> {
    let moved = offset(boundary)?;
    let ring = straighten(&moved);
    (ring.len() >= 3).then_some(ring)
}

/// A straight line with the land on its left.
#[derive(Clone, Copy, Debug)]
struct Line {
    start: Point2,
    end: Point2,
    /// Its length, m: asked for again and again, and a root takes long.
    length: f64,
    border: Border,
}

impl Line {
    fn new(start: Point2, end: Point2, border: Border) -> Self {
        Self { start, end, length: (end - start).norm(), border }
    }

    fn along(&self) -> Vector2 {
        self.end - self.start
    }

    fn moved(&self, distance: f64) -> Self {
        let along = self.along();
        let shift = Vector2::new(-along.y, along.x) * (distance / self.length);
        Self::new(self.start + shift, self.end + shift, self.border)
    }
}

/// Every piece moved inwards by its own offset, neighbours joined where they meet; pieces that the offset turns round,
/// in corners tighter than it, are left out.
fn offset(boundary: &Boundary) -> Option<Ring> {
    let count = boundary.points.len();
    let mut lines = Vec::with_capacity(count);
    let mut offsets = Vec::with_capacity(count);
    for index in 0..count {
        let Piece { border, offset } = boundary.pieces[index];
        let line = Line::new(boundary.points[index], boundary.points[after(index, count)], border);
        if line.length > SHORTEST {
            lines.push(line.moved(offset));
            offsets.push(offset);
        }
    }
    label_corners(&mut lines);
    // Each round removes what was turned round; a corner arc of n pieces needs at most n rounds.
    for _ in 0..16 {
        if lines.len() < 3 {
            return None;
        }
        let ring = join(&lines, |index| Reach::evenly(LONGEST_MITRE * offsets[index].max(0.5)));
        let kept: Vec<bool> = ring.kept;
        if kept.iter().all(|kept| *kept) {
            return Some(ring.ring);
        }
        retain(&mut lines, &kept);
        retain(&mut offsets, &kept);
    }
    None
}

fn retain<T>(items: &mut Vec<T>, kept: &[bool]) {
    let mut index = 0;
    items.retain(|_| {
        index += 1;
        kept[index - 1]
    });
}

/// A piece of a corner that goes on straight from a sidewalk is part of that front.
fn label_corners(lines: &mut [Line]) {
    let count = lines.len();
    let goes_on = |a: &Line, b: &Line| {
        let (u, v) = (a.along(), b.along());
        u.dot(&v) > 0.0 && u.perp(&v).abs() < 2.0 * STRAIGHT * a.length * b.length
    };
    for index in 0..count {
        let (before, here) = (lines[before(index, count)], lines[index]);
        if here.border == Border::CORNER && before.border.is_street() && goes_on(&before, &here) {
            lines[index].border = before.border;
        }
    }
    for index in (0..count).rev() {
        let (here, after) = (lines[index], lines[after(index, count)]);
        if here.border == Border::CORNER && after.border.is_street() && goes_on(&here, &after) {
            lines[index].border = after.border;
        }
    }
}

struct Joined {
    ring: Ring,
    /// Which lines still run their way.
    kept: Vec<bool>,
}

/// How far from the ends of two lines they may meet, m.
#[derive(Clone, Copy)]
struct Reach {
    /// Before the end of the one and behind the beginning of the other.
    short: f64,
    /// Beyond them.
    beyond: f64,
}

impl Reach {
    const fn evenly(reach: f64) -> Self {
        Self { short: reach, beyond: reach }
    }

    /// Whether a place so far along a line from its end, m, is within.
    fn holds(self, along: f64) -> bool {
        (-self.short..=self.beyond).contains(&along)
    }
}

/// Joins lines into a ring: neighbours at the point where they meet, or by an edge of their own where they are nearly
/// parallel or meet farther than `reach` from their ends.
fn join(lines: &[Line], reach: impl Fn(usize) -> Reach) -> Joined {
    let count = lines.len();
    let mut ring = Ring::with_capacity(count);
    let mut kept = Vec::with_capacity(count);
    let turn = |index: usize| corner(&lines[index], &lines[after(index, count)], reach(index));
    // The first line is entered where the last one is left.
    let last = turn(count - 1);
    let mut start = last.1;
    for (index, line) in lines.iter().enumerate() {
        let (end, next) = if index + 1 == count { last } else { turn(index) };
        kept.push((end - start).dot(&line.along()) > SHORTEST * line.length);
        ring.push(start, line.border);
        if is_longer(&(next - end), SHORTEST) {
            ring.push(end, Border::CORNER);
        }
        start = next;
    }
    Joined { ring, kept }
}

/// Where one line is left and the next entered.
fn corner(line: &Line, next: &Line, reach: Reach) -> (Point2, Point2) {
    let (u, v) = (line.along(), next.along());
    let sine = u.perp(&v) / (line.length * next.length);
    if sine.abs() > STRAIGHT {
        let met = line.start + u * ((next.start - line.start).perp(&v) / u.perp(&v));
        let beyond = (met - line.end).dot(&u) / line.length;
        let before = (next.start - met).dot(&v) / next.length;
        if reach.holds(beyond) && reach.holds(before) {
            return (met, met);
        }
    }
    let gap = next.start - line.end;
    if u.dot(&v) > 0.0 && gap.norm() < 0.05 {
        let middle = nalgebra::center(&line.end, &next.start);
        return (middle, middle);
    }
    (line.end, next.start)
}

/// Runs of edges of one street that are almost straight become one front, moved inwards until all of the run is behind
/// it; so no front reaches over its sidewalk.
fn straighten(ring: &Ring) -> Ring {
    let runs = runs(ring);
    if runs.len() < 3 {
        return ring.clone();
    }
    let count = ring.len();
    let lines: Vec<Line> = runs
        .iter()
        .map(|(first, length)| {
            let at = |step: usize| ring.corners[onwards(*first, step, count)];
            let line = Line::new(at(0), at(*length), ring.borders[*first]);
            let along = line.along() / line.length;
            let deepest = (1..*length).map(|step| along.perp(&(at(step) - line.start))).fold(0.0, f64::max);
            if deepest > 1e-6 { line.moved(deepest) } else { line }
        })
        .collect();
    // A front that went on past its own run would leave a street that bends there.
    let joined = join(&lines, |_| Reach { short: 6.0 * TOLERANCE, beyond: TOLERANCE });
    if joined.kept.iter().all(|kept| *kept) { joined.ring } else { ring.clone() }
}

/// Splits a ring into runs, each the index of its first edge and its number of edges.
fn runs(ring: &Ring) -> Vec<(usize, usize)> {
    let count = ring.len();
    let starts_run = |index: usize| {
        let before = before(index, count);
        ring.borders[index] != ring.borders[before] || !ring.borders[index].is_street() || turns(ring, before)
    };
    let Some(start) = (0..count).find(|index| starts_run(*index)) else { return Vec::new() };
    let mut runs: Vec<(usize, usize)> = Vec::new();
    for step in 0..count {
        let index = onwards(start, step, count);
        match runs.last_mut() {
            Some((first, length)) if !starts_run(index) && stays_straight(ring, *first, *length + 1) => {
                *length += 1;
            }
            _ => runs.push((index, 1)),
        }
    }
    runs
}

/// Whether the street turns sharply after an edge: by more than 17°.
fn turns(ring: &Ring, index: usize) -> bool {
    let (u, v) = (ring.edge(index), ring.edge(after(index, ring.len())));
    u.dot(&v) <= 0.0 || {
        // By the squares: roots are taken only where it is a close call.
        let (sine, bound) = (u.perp(&v), 0.09 * u.norm_squared() * v.norm_squared());
        is_greater(sine * sine, bound).unwrap_or_else(|| sine.abs() > 0.3 * u.norm() * v.norm())
    }
}

/// Whether something is longer than a bound, m; by their squares, but for a close call.
pub(super) fn is_longer(way: &Vector2, bound: f64) -> bool {
    is_greater(way.norm_squared(), bound * bound).unwrap_or_else(|| way.norm() > bound)
}

/// Whether one number is greater than another, where that is plain whatever was rounded.
fn is_greater(a: f64, b: f64) -> Option<bool> {
    ((a - b).abs() > PLAIN * b).then_some(a > b)
}

/// So many steps on round a ring, no more than once round: no division, which takes longer than all else that is asked.
const fn onwards(index: usize, steps: usize, count: usize) -> usize {
    let on = index + steps;
    if on < count { on } else { on - count }
}

const fn after(index: usize, count: usize) -> usize {
    onwards(index, 1, count)
}

const fn before(index: usize, count: usize) -> usize {
    if index == 0 { count - 1 } else { index - 1 }
}

fn stays_straight(ring: &Ring, first: usize, length: usize) -> bool {
    let (corners, last) = (&ring.corners[..], first + length);
    let (start, end) = (corners[first], corners[onwards(first, length, corners.len())]);
    let along = end - start;
    let aside =
        |between: &[Point2]| between.iter().map(|corner| along.perp(&(corner - start)).abs()).fold(0.0, most);
    // Those before the end of the list, and those that come round to its beginning.
    let (before, behind) =
        (&corners[first + 1..last.min(corners.len())], &corners[..last.saturating_sub(corners.len())]);
    let (farthest, norm) = (most(aside(before), aside(behind)), along.norm());
    // The greatest is the greatest still when it is divided.
    norm > 1e-6 && farthest / norm <= TOLERANCE
}

#[cfg(test)]
mod tests {
    use simworld_core::id::RoadId;
    use simworld_core::net::Side;

    use super::*;

    fn boundary(points: &[(f64, f64)], offset: f64) -> Boundary {
        let border = |index: usize| Border::street(RoadId::from_index(index), Side::Left);
        Boundary {
            points: points.iter().map(|(x, y)| Point2::new(*x, *y)).collect(),
            pieces: (0..points.len()).map(|index| Piece { border: border(index), offset }).collect(),
        }
    }

    #[test]
    fn a_square_shrinks_on_every_side() {
        let ring = inset(&boundary(&[(0.0, 0.0), (50.0, 0.0), (50.0, 40.0), (0.0, 40.0)], 1.5)).unwrap();
        assert_eq!(ring.len(), 4);
        assert!((ring.area() - 47.0 * 37.0).abs() < 1e-9);
    }

    #[test]
    fn a_sliver_leaves_nothing_simple() {
        let ring = inset(&boundary(&[(0.0, 0.0), (50.0, 0.0), (50.0, 2.0), (0.0, 2.0)], 1.5));
        assert!(ring.is_none_or(|ring| ring.area() <= 0.0 || !ring.is_simple()));
    }

    #[test]
    fn a_bend_becomes_one_front_behind_the_sidewalk() {
        let mut bend = boundary(&[(0.0, 0.0), (30.0, 0.5), (60.0, 0.0), (60.0, 50.0), (0.0, 50.0)], 1.0);
        bend.pieces[1] = bend.pieces[0];
        let ring = inset(&bend).unwrap();
        assert_eq!(ring.len(), 4);
        let lowest = ring.corners.iter().map(|corner| corner.y).fold(f64::INFINITY, f64::min);
        assert!((1.499..1.6).contains(&lowest), "the front begins at {lowest} m");
    }
}
