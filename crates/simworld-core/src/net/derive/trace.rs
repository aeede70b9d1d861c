//! Paths across a junction, made ready to be asked which of them touch.

use std::ops::Range;

use super::extent::Extent;
use super::pieces::{LANES, Pieces};
use super::shape::{Outline, Shape};
use crate::geometry::{Point2, Vector2};
use crate::net::polyline;
use crate::ops::{greater, lesser};

/// Of every so many points of a path one is looked at first.
const STRIDE: usize = 3;
/// On longer pieces points as far apart as this, m.
const SPACING: f64 = 3.0;

/// Boxes farther apart than this have no point in common, m; and what lies farther than this on one side of a line does not
/// reach the other, whatever was rounded.
const SLACK: f64 = 1e-6;

/// Some pieces of a path.
#[derive(Clone, Copy)]
struct Block {
    line: Pieces,
    /// One over the square of the length of each, 1/m²; nothing if it has none.
    inverse: [f64; LANES],
    /// The box round all of them.
    extent: Extent,
    /// How many points of the path belong to it: where its pieces begin, and where the last of the path ends.
    points: usize,
}

impl Block {
    fn of(path: &[Point2], first: usize) -> Self {
        let pieces = (path.len() - 1 - first).min(LANES);
        let mut extent = Extent::NONE;
        for point in &path[first..=first + pieces] {
            extent.add([point.x, point.y]);
        }
        let is_last = first + pieces == path.len() - 1;
        let line = Pieces::of(path, first);
        let inverse = |lane: usize| {
            let squared = line.length_squared(lane);
            if squared > 0.0 { 1.0 / squared } else { 0.0 }
        };
        Self { line, inverse: std::array::from_fn(inverse), extent, points: pieces + usize::from(is_last) }
    }

    /// Whether the boxes come nearer to each other than a distance of that square.
    fn is_near(&self, other: &Self, squared: f64) -> bool {
        let [x, y] = self.extent.gaps(&other.extent).map(|gap| greater(gap, 0.0));
        x * x + y * y < squared
    }

    /// The square of the least distance of a point from its pieces, m².
    fn distance_squared(&self, point: &Point2) -> f64 {
        let squares = self.line.distances_squared(point, |product, lane| product * self.inverse[lane]);
        squares.into_iter().fold(f64::INFINITY, |least, squared| lesser(squared, least))
    }
}

/// A path with the box around it.
#[derive(Clone)]
pub(super) struct Trace {
    points: Range<usize>,
    extent: Extent,
    /// Length of its longest piece, m.
    longest: f64,
    shape: Shape,
}

/// A strip that paths may cross: the segment along it.
pub(super) struct Strip {
    start: Point2,
    end: Point2,
    along: Vector2,
    extent: Extent,
    /// What lies farther than this from its line lies on one side of it: times the length of the strip, m².
    least: f64,
}

impl Strip {
    pub(super) fn of(start: Point2, end: Point2) -> Self {
        let mut extent = Extent::NONE;
        extent.add([start.x, start.y]);
        extent.add([end.x, end.y]);
        let along = end - start;
        Self { start, end, along, extent, least: SLACK * along.norm() }
    }
}

/// The paths across one junction, one after another.
#[derive(Default)]
pub(super) struct Traces {
    points: Vec<Point2>,
    /// Some points on the two paths of which that is asked, and their pieces.
    samples: [Vec<Point2>; 2],
    blocks: [Vec<Block>; 2],
}

impl Traces {
    /// Forgets all paths and keeps their memory.
    pub(super) fn clear(&mut self) {
        self.points.clear();
    }

    pub(super) fn add(&mut self, path: &[Point2]) -> Trace {
        let outline = Outline::of(path);
        let (mut extent, mut turned, mut longest) = (Extent::NONE, Extent::NONE, 0.0);
        let mut before = path.first().copied().unwrap_or_else(Point2::origin);
        // All in one go: each of them waits for what was before, and none for another.
        for point in path {
            extent.add([point.x, point.y]);
            turned.add(outline.turned(point));
            longest = greater(longest, (point - before).norm_squared());
            before = *point;
        }
        let first = self.points.len();
        self.points.extend_from_slice(path);
        Trace {
            points: first..self.points.len(),
            extent,
            longest: longest.sqrt(),
            shape: outline.filled(&turned, longest),
        }
    }

    /// Whether the two come nearer to each other than `limit` m: the same as to compare
    /// [`polyline::distance_between`], and much faster.
    pub(super) fn touch(&mut self, a: &Trace, b: &Trace, limit: f64) -> bool {
        if a.extent.apart(&b.extent) >= limit {
            return false;
        }
        let [own, other] = [a, b].map(|trace| self.path(trace));
        // Of half of them the boxes that hold them say it.
        let plain = (a.shape.touches_box(&b.shape, limit))
            .or_else(|| b.shape.touches_box(&a.shape, limit))
            .or_else(|| a.shape.touches(&b.shape, other, limit))
            .or_else(|| b.shape.touches(&a.shape, own, limit));
        if let Some(touches) = plain {
            return touches;
        }
        if a.shape.is_round(own, &b.shape, other, limit) || b.shape.is_round(other, &a.shape, own, limit) {
            return false;
        }
        self.have_points_near(a, b, limit) || self.have_pieces_near(a, b, limit)
    }

    /// Whether a point of one path is that near to a piece of the other, or they cross. Only where the boxes round a few of their
    /// pieces are that near is it asked of each.
    fn have_pieces_near(&mut self, a: &Trace, b: &Trace, limit: f64) -> bool {
        for (blocks, trace) in self.blocks.iter_mut().zip([a, b]) {
            let path = &self.points[trace.points.clone()];
            blocks.clear();
            blocks.extend((1..path.len()).step_by(LANES).map(|first| Block::of(path, first - 1)));
        }
        // Paths that do not cross are nearest at a point of one of them, and a short piece that is crossed has an end near by.
        let may_cross = a.longest.min(b.longest) >= 2.0 * limit;
        let roughly = (limit + SLACK) * (limit + SLACK);
        let [blocks, others] = &self.blocks;
        blocks.iter().enumerate().any(|(rank, own)| {
            let near = |(other_rank, other): (usize, &Block)| {
                let is_near = |point: &Point2, block: &Block| {
                    let squared = block.distance_squared(point);
                    squared < roughly && squared.sqrt() < limit
                };
                own.is_near(other, roughly)
                    && (self.points_of(a, rank, own).iter().any(|point| is_near(point, other))
                        || self.points_of(b, other_rank, other).iter().any(|point| is_near(point, own))
                        || may_cross && cross(self.line_of(a, rank), self.line_of(b, other_rank)))
            };
            others.iter().enumerate().any(near)
        })
    }

    /// The points that belong to the block of that rank of a path.
    fn points_of(&self, trace: &Trace, rank: usize, block: &Block) -> &[Point2] {
        &self.path(trace)[rank * LANES..rank * LANES + block.points]
    }

    /// The pieces of the block of that rank of a path.
    fn line_of(&self, trace: &Trace, rank: usize) -> &[Point2] {
        let path = self.path(trace);
        &path[rank * LANES..path.len().min((rank + 1) * LANES + 1)]
    }

    /// Whether a path crosses a strip.
    pub(super) fn crosses(&self, trace: &Trace, strip: &Strip) -> bool {
        // A piece with both ends on one side of the strip's line does not cross it.
        let Strip { start, end, along, extent, least } = *strip;
        let is_off = trace.shape.is_beside(&start, &end) | trace.shape.is_aside(start, along, least);
        if (extent.apart(&trace.extent) > SLACK) | is_off {
            return false;
        }
        let side = |point: &Point2| along.perp(&(point - start));
        let is_aside = |a: f64, b: f64| (a > least && b > least) || (a < -least && b < -least);
        let is_crossed = |piece: &[Point2]| polyline::crossing(piece[0], piece[1], start, end).is_some();
        let path = self.path(trace);
        let (Some(first), Some(last)) = (path.first(), path.last()) else { return false };
        // A strip lies near one end of the paths that cross it.
        if (last - start).norm_squared() < (first - start).norm_squared() {
            let mut there = side(last);
            path.windows(2).rev().any(|piece| {
                let here = std::mem::replace(&mut there, side(&piece[0]));
                !is_aside(there, here) && is_crossed(piece)
            })
        } else {
            let mut here = side(first);
            path.windows(2).any(|piece| {
                let there = std::mem::replace(&mut here, side(&piece[1]));
                !is_aside(there, here) && is_crossed(piece)
            })
        }
    }

    fn path(&self, trace: &Trace) -> &[Point2] {
        &self.points[trace.points.clone()]
    }

    /// Whether one of some points on the one is that near to one of some points on the other.
    fn have_points_near(&mut self, a: &Trace, b: &Trace, limit: f64) -> bool {
        for (samples, trace) in self.samples.iter_mut().zip([a, b]) {
            samples.clear();
            sample(&self.points[trace.points.clone()], trace.longest, samples);
        }
        let (near, [samples, others]) = (limit * limit, &self.samples);
        // All of the others at once: several fit into one instruction.
        let is_near = |a: &Point2| others.iter().fold(false, |any, b| any | ((a - b).norm_squared() < near));
        samples.iter().any(is_near)
    }
}

/// Adds some points on a path, of which the length of the longest piece is given, m.
fn sample(path: &[Point2], longest: f64, samples: &mut Vec<Point2>) {
    samples.extend(path.iter().skip(STRIDE / 2).step_by(STRIDE));
    if longest <= SPACING {
        return;
    }
    for piece in path.windows(2) {
        let step = piece[1] - piece[0];
        let squared = step.norm_squared();
        if squared > SPACING * SPACING {
            let parts = (squared.sqrt() / SPACING).ceil();
            samples.extend((1..parts as usize).map(|part| piece[0] + step * (part as f64 / parts)));
        }
    }
}

/// Whether a piece of one line crosses a piece of the other.
fn cross(a: &[Point2], b: &[Point2]) -> bool {
    a.windows(2).any(|p| b.windows(2).any(|q| polyline::crossing(p[0], p[1], q[0], q[1]).is_some()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::seed::Seed;

    fn touch(a: &[Point2], b: &[Point2], limit: f64) -> bool {
        let mut traces = Traces::default();
        // What was added before, and forgotten, must not matter.
        traces.add(b);
        traces.clear();
        let (a, b) = (traces.add(a), traces.add(b));
        traces.touch(&a, &b, limit)
    }

    #[test]
    fn samples_say_what_the_whole_paths_say() {
        let mut rng = Seed(8).stream("trace").rng();
        let mut near = 0;
        for _ in 0..4000 {
            let mut path = || -> Vec<Point2> {
                let (mut at, mut heading) =
                    (Point2::new(rng.uniform(0.0, 20.0), rng.uniform(0.0, 20.0)), rng.uniform(-3.0, 3.0));
                let turn = rng.uniform(-0.25, 0.25);
                (0..14)
                    .map(|_| {
                        heading += turn;
                        at += crate::geometry::direction(heading) * 1.1;
                        at
                    })
                    .collect()
            };
            let (a, b) = (path(), path());
            let expected = polyline::distance_between(&a, &b) < 2.4;
            near += usize::from(expected);
            assert_eq!(touch(&a, &b, 2.4), expected, "{a:?} {b:?}");
        }
        assert!((800..3200).contains(&near), "{near} of 4000 say nothing");
    }

    #[test]
    fn bends_about_one_middle_touch_as_their_pieces_do() {
        let mut rng = Seed(4).stream("bends").rng();
        let (mut near, mut plain) = (0, 0);
        for _ in 0..4000 {
            let (inner, turn) = (rng.uniform(0.5, 9.0), rng.uniform(0.0, 2.5));
            let mut bend = |radius: f64, points: u32| -> Vec<Point2> {
                let shift = Vector2::new(rng.uniform(-0.3, 0.3), rng.uniform(-0.3, 0.3));
                let at = |index: u32| crate::geometry::direction(turn * f64::from(index) / f64::from(points));
                (0..=points).map(|index| Point2::from(shift + at(index) * radius)).collect()
            };
            let (a, mut b) = (bend(inner, 9), bend(inner + 2.4, 12));
            b.reverse();
            let expected = polyline::distance_between(&a, &b) < 2.3;
            near += usize::from(expected);
            for (own, other) in [(&a, &b), (&b, &a)] {
                assert_eq!(touch(own, other, 2.3), expected, "{a:?} {b:?}");
                let shape = |path: &[Point2]| Traces::default().add(path).shape;
                plain += usize::from(shape(own).is_round(own, &shape(other), other, 2.3));
            }
        }
        assert!((800..3200).contains(&near) && plain > 800, "{near} of 4000, {plain} of 8000 say nothing");
    }

    #[test]
    fn a_path_crosses_what_one_of_its_pieces_crosses() {
        let mut rng = Seed(6).stream("crosses").rng();
        let mut point = || Point2::new(rng.uniform(0.0, 20.0), rng.uniform(0.0, 20.0));
        let mut crossed = 0;
        for _ in 0..2000 {
            let (path, start, end) = ([point(), point(), point()], point(), point());
            let mut traces = Traces::default();
            let trace = traces.add(&path);
            let expected =
                path.windows(2).any(|piece| polyline::crossing(piece[0], piece[1], start, end).is_some());
            crossed += usize::from(expected);
            assert_eq!(traces.crosses(&trace, &Strip::of(start, end)), expected, "{path:?} {start} {end}");
        }
        assert!((400..1600).contains(&crossed), "{crossed} of 2000 say nothing");
    }

    #[test]
    fn the_short_way_to_nearness_agrees_with_the_long_one() {
        let mut rng = Seed(5).stream("polyline").rng();
        let mut near = 0;
        for _ in 0..2000 {
            let mut path = |stride: f64| -> Vec<Point2> {
                let mut at = Point2::new(rng.uniform(0.0, 15.0), rng.uniform(0.0, 15.0));
                let mut step = || Vector2::new(rng.uniform(-stride, stride), rng.uniform(-stride, stride));
                (0..6)
                    .map(|_| {
                        at += step();
                        at
                    })
                    .collect()
            };
            for (a, b) in [(path(2.0), path(9.0)), (path(9.0), path(9.0))] {
                let expected = polyline::distance_between(&a, &b) < 1.5;
                near += usize::from(expected);
                assert_eq!(touch(&a, &b, 1.5), expected, "{a:?} {b:?}");
                assert_eq!(touch(&b, &a, 1.5), expected, "{a:?} {b:?}");
            }
        }
        assert!((800..3200).contains(&near), "{near} of 4000 say nothing");
    }
}
