//! Reference lines: straight pieces joined by arcs, and cubics across junctions.

use std::io::{self, Write};

use simworld_core::geometry::{Point2, Vector2, direction, heading};
use simworld_core::net::polyline;
use simworld_core::ops::{self, wrap_angle};

/// Farthest from a corner at which its arc begins, m.
const CUT: f64 = 6.0;
/// Bends below this are no bends, radians.
const STRAIGHT: f64 = 1e-6;

/// One `geometry` element.
pub(super) struct Piece {
    start: Point2,
    heading: f64,
    length: f64,
    kind: Kind,
}

impl Piece {
    /// Where it ends, and its heading there.
    fn end(&self) -> (Point2, f64) {
        let ahead = direction(self.heading);
        let world = |x: f64, y: f64| self.start + ahead * x + Vector2::new(-ahead.y, ahead.x) * y;
        match self.kind {
            Kind::Line => (world(self.length, 0.0), self.heading),
            Kind::Arc(curvature) => {
                let (sin, cos) = ops::sin_cos(curvature * self.length);
                let end = world(sin / curvature, (1.0 - cos) / curvature);
                (end, wrap_angle(self.heading + curvature * self.length))
            }
            Kind::Cubic(u, v) => {
                let ([x, dx], [y, dy]) = (at(u, 1.0), at(v, 1.0));
                (world(x, y), wrap_angle(self.heading + ops::atan2(dy, dx)))
            }
        }
    }
}

enum Kind {
    Line,
    /// Curvature, 1/m, positive to the left.
    Arc(f64),
    /// Coefficients of p, p², p³ of u and of v, p in [0, 1].
    Cubic([f64; 3], [f64; 3]),
}

/// A line with its corners rounded off.
pub(super) fn rounded(line: &[Point2]) -> Vec<Piece> {
    let mut points: Vec<Point2> = line.to_vec();
    points.dedup_by(|a, b| (*a - *b).norm() < 1e-6);
    let mut pieces = Vec::new();
    let mut from = points.first().copied().unwrap_or_else(Point2::origin);
    for corner in points.windows(3) {
        let (before, after) = (corner[1] - corner[0], corner[2] - corner[1]);
        let angle = wrap_angle(heading(&after) - heading(&before));
        if angle.abs() < STRAIGHT {
            continue;
        }
        // Both neighbours of a piece may take half of it.
        let cut = CUT.min(before.norm() * 0.5).min(after.norm() * 0.5);
        let start = corner[1] - before.normalize() * cut;
        straight(&mut pieces, from, start);
        let radius = cut / ops::tan(angle.abs() * 0.5);
        let curvature = angle.signum() / radius;
        pieces.push(Piece {
            start,
            heading: heading(&before),
            length: angle.abs() * radius,
            kind: Kind::Arc(curvature),
        });
        from = corner[1] + after.normalize() * cut;
    }
    if let Some(last) = points.last() {
        straight(&mut pieces, from, *last);
    }
    pieces
}

fn straight(pieces: &mut Vec<Piece>, from: Point2, to: Point2) {
    let step = to - from;
    let length = step.norm();
    if length > 1e-6 {
        pieces.push(Piece { start: from, heading: heading(&step), length, kind: Kind::Line });
    }
}

/// A path with its ends moved to other places, and all between the more the nearer it is to that end.
pub(super) fn moved(path: &[Point2], [start, end]: [Point2; 2]) -> Vec<Point2> {
    let (Some(first), Some(last)) = (path.first(), path.last()) else { return Vec::new() };
    let shifts = (start - first, end - last);
    let length = polyline::length(path).max(1e-9);
    let (mut station, mut before) = (0.0, *first);
    let shifted = path.iter().map(|point| {
        station += (point - before).norm();
        before = *point;
        let share = station / length;
        point + shifts.0 * (1.0 - share) + shifts.1 * share
    });
    shifted.collect()
}

/// The most that one cubic turns, radians.
const MOST_TURN: f64 = 2.0;

/// Cubics along a path that leaves and arrives in given directions, radians: one, unless the path winds as that round a
/// turning circle does.
pub(super) fn cubics(path: &[Point2], (leaves, arrives): (f64, f64)) -> Vec<Piece> {
    let mut pieces = Vec::new();
    let (mut first, mut heading_before, mut turned) = (0, leaves, 0.0);
    for index in 1..path.len().saturating_sub(1) {
        let (before, after) = (path[index] - path[index - 1], path[index + 1] - path[index]);
        turned += ops::atan2(before.perp(&after), before.dot(&after)).abs();
        if turned > MOST_TURN {
            let along = heading(&(before.normalize() + after.normalize()));
            let part = &path[first..=index];
            pieces.push(cubic(part, polyline::length(part), (heading_before, along)));
            (first, heading_before, turned) = (index, along, 0.0);
        }
    }
    let rest = &path[first..];
    pieces.push(cubic(rest, polyline::length(rest), (heading_before, arrives)));
    pieces
}

/// One cubic along a path that leaves and arrives in given directions, radians: of Hermite's cubics the one that passes
/// nearest to the points of the path, by least squares over the lengths of its two tangents.
fn cubic(path: &[Point2], length: f64, (leaves, arrives): (f64, f64)) -> Piece {
    let (start, end) = (polyline::at(path, 0.0).0, polyline::at(path, length).0);
    let ahead = direction(leaves);
    let local = |v: Vector2| Vector2::new(v.dot(&ahead), ahead.perp(&v));
    let (chord, out) = (local(end - start), direction(arrives - leaves));
    if chord.y.abs() < 1e-3 && wrap_angle(arrives - leaves).abs() < 1e-4 && chord.x > 0.0 {
        return Piece { start, heading: leaves, length: chord.x, kind: Kind::Line };
    }
    let points: Vec<Vector2> = path.iter().map(|point| local(point - start)).collect();
    let (u, v) = fit(&points, chord, out, length);
    Piece { start, heading: leaves, length: arc_length(u, v), kind: Kind::Cubic(u, v) }
}

/// Rounds in which every point is given to the place of the cubic next to it, and the cubic fitted anew (Hoschek 1988).
const ROUNDS: u32 = 8;

/// Coefficients of the cubic from the origin along x to `chord`, where it arrives along `out`.
fn fit(points: &[Vector2], chord: Vector2, out: Vector2, length: f64) -> ([f64; 3], [f64; 3]) {
    let mut station = 0.0;
    let mut places: Vec<f64> = vec![0.0];
    places.extend(points.windows(2).map(|pair| {
        station += (pair[1] - pair[0]).norm();
        station / length
    }));
    let mut tangents = (length, length);
    for _ in 0..ROUNDS {
        let found = tangents_through(points, &places, chord, out);
        let is_good = |tangent: f64| (0.2..=3.0).contains(&(tangent / length));
        if !is_good(found.0) || !is_good(found.1) {
            break;
        }
        tangents = found;
        let (u, v) = coefficients(tangents, chord, out);
        for (place, point) in places.iter_mut().zip(points) {
            let [x, dx] = at(u, *place);
            let [y, dy] = at(v, *place);
            let step = ((point.x - x) * dx + (point.y - y) * dy) / (dx * dx + dy * dy).max(1e-9);
            *place = (*place + step).clamp(0.0, 1.0);
        }
    }
    coefficients(tangents, chord, out)
}

/// Value and slope of a cubic without a constant.
fn at(c: [f64; 3], p: f64) -> [f64; 2] {
    [((c[2] * p + c[1]) * p + c[0]) * p, (3.0 * c[2] * p + 2.0 * c[1]) * p + c[0]]
}

fn coefficients((first, last): (f64, f64), chord: Vector2, out: Vector2) -> ([f64; 3], [f64; 3]) {
    let (first, last) = (Vector2::new(first, 0.0), out * last);
    let second = chord * 3.0 - first * 2.0 - last;
    let third = first + last - chord * 2.0;
    ([first.x, second.x, third.x], [first.y, second.y, third.y])
}

/// Lengths of the tangents with which the cubic passes nearest to the points at their places.
fn tangents_through(points: &[Vector2], places: &[f64], chord: Vector2, out: Vector2) -> (f64, f64) {
    let (mut aa, mut ab, mut bb, mut ar, mut br) = (0.0, 0.0, 0.0, 0.0, 0.0);
    for (point, p) in points.iter().zip(places) {
        // Hermite's base: the first tangent, the last tangent, the end.
        let (a, b) = (Vector2::new(p * (1.0 - p) * (1.0 - p), 0.0), out * (p * p * (p - 1.0)));
        let rest = point - chord * (p * p * (3.0 - 2.0 * p));
        aa += a.dot(&a);
        ab += a.dot(&b);
        bb += b.dot(&b);
        ar += a.dot(&rest);
        br += b.dot(&rest);
    }
    let det = aa * bb - ab * ab;
    ((ar * bb - br * ab) / det, (br * aa - ar * ab) / det)
}

/// Simpson's rule over the speed of the curve.
fn arc_length(u: [f64; 3], v: [f64; 3]) -> f64 {
    const STEPS: u32 = 64;
    let slope = |c: [f64; 3], p: f64| c[0] + 2.0 * c[1] * p + 3.0 * c[2] * p * p;
    let speed = |index: u32| {
        let p = f64::from(index) / f64::from(STEPS);
        let (du, dv) = (slope(u, p), slope(v, p));
        (du * du + dv * dv).sqrt()
    };
    let sum: f64 = (0..=STEPS)
        .map(|index| match index {
            0 | STEPS => speed(index),
            odd if odd % 2 == 1 => 4.0 * speed(index),
            _ => 2.0 * speed(index),
        })
        .sum();
    sum / (3.0 * f64::from(STEPS))
}

/// Where a reference line begins and where it ends, and its headings there, radians; `None` if it has no length.
pub(super) fn ends(pieces: &[Piece]) -> Option<[(Point2, f64); 2]> {
    let (first, last) = (pieces.first()?, pieces.last()?);
    Some([(first.start, first.heading), last.end()])
}

/// Length of a reference line, m.
pub(super) fn length(pieces: &[Piece]) -> f64 {
    pieces.iter().map(|piece| piece.length).sum()
}

pub(super) fn write(pieces: &[Piece], out: &mut impl Write) -> io::Result<()> {
    writeln!(out, "<planView>")?;
    let mut s = 0.0;
    for piece in pieces {
        let Piece { start, heading, length, kind } = piece;
        write!(
            out,
            r#"<geometry s="{s:.6}" x="{:.6}" y="{:.6}" hdg="{heading:.9}" length="{length:.6}">"#,
            start.x, start.y
        )?;
        match kind {
            Kind::Line => write!(out, "<line/>")?,
            Kind::Arc(curvature) => write!(out, r#"<arc curvature="{curvature:.9}"/>"#)?,
            Kind::Cubic(u, v) => write!(
                out,
                r#"<paramPoly3 aU="0" bU="{:.9}" cU="{:.9}" dU="{:.9}" aV="0" bV="{:.9}" cV="{:.9}" dV="{:.9}" pRange="normalized"/>"#,
                u[0], u[1], u[2], v[0], v[1], v[2]
            )?,
        }
        writeln!(out, "</geometry>")?;
        s += length;
    }
    writeln!(out, "</planView>")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_corner_becomes_an_arc_that_joins_smoothly() {
        let corner = [Point2::new(0.0, 0.0), Point2::new(20.0, 0.0), Point2::new(20.0, 20.0)];
        let pieces = rounded(&corner);
        let lengths: Vec<f64> = pieces.iter().map(|piece| piece.length).collect();
        assert_eq!(pieces.len(), 3);
        // A right angle cut at 6 m has a radius of 6 m.
        assert!((lengths[0] - 14.0).abs() < 1e-9 && (lengths[1] - 9.424_778).abs() < 1e-6);
        assert!(matches!(pieces[1].kind, Kind::Arc(curvature) if (curvature - 1.0 / 6.0).abs() < 1e-9));
        assert!((length(&pieces) - (28.0 + 9.424_778)).abs() < 1e-6);
    }

    #[test]
    fn a_reference_line_ends_where_its_last_piece_ends() {
        let corner = [Point2::new(0.0, 0.0), Point2::new(20.0, 0.0), Point2::new(20.0, 20.0)];
        let up = std::f64::consts::FRAC_PI_2;
        let mut pieces = rounded(&corner);
        assert_eq!(ends(&[]).map(|_| ()), None);
        for (end, wanted) in [(ends(&pieces).unwrap()[1], Point2::new(20.0, 20.0)), {
            pieces.pop();
            (ends(&pieces).unwrap()[1], Point2::new(20.0, 6.0))
        }] {
            assert!((end.0 - wanted).norm() < 1e-9 && (end.1 - up).abs() < 1e-9, "{end:?}");
        }
        let turn = cubics(&[Point2::new(1.0, 2.0), Point2::new(8.0, 4.0), Point2::new(10.0, 9.0)], (0.0, up));
        let [start, end] = ends(&turn).unwrap();
        assert_eq!(start, (Point2::new(1.0, 2.0), 0.0));
        assert!((end.0 - Point2::new(10.0, 9.0)).norm() < 1e-9 && (end.1 - up).abs() < 1e-9, "{end:?}");
    }

    #[test]
    fn a_quarter_turn_is_as_long_as_its_arc() {
        let radius = 8.0;
        let path: Vec<Point2> = (0..=90)
            .map(|degree| {
                let (sin, cos) = ops::sin_cos(f64::from(degree).to_radians());
                Point2::new(radius * sin, radius * (1.0 - cos))
            })
            .collect();
        let along = polyline::length(&path);
        let piece = cubic(&path, along, (0.0, std::f64::consts::FRAC_PI_2));
        assert!((piece.length - along).abs() < 0.05, "{} {along}", piece.length);
    }
}
