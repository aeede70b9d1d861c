//! Polylines in the plane: lengths, stations, offsets, nearest points. A station is a distance along, m.

use smallvec::SmallVec;

use crate::geometry::{Point2, Vector2};
use crate::ops;

/// Length, m.
pub fn length(path: &[Point2]) -> f64 {
    path.windows(2).map(|pair| (pair[1] - pair[0]).norm()).sum()
}

/// The point at a station and the heading there, radians; stations outside are clamped to the ends.
///
/// A path of one point has heading zero; an empty one gives the origin.
pub fn at(path: &[Point2], station: f64) -> (Point2, f64) {
    let (point, along) = at_piece(path, station);
    (point, along.map_or(0.0, |step| ops::atan2(step.y, step.x)))
}

/// The point at a station, and the piece on which it lies; its heading costs more than all else, and few ask for it.
pub(in crate::net) fn at_piece(path: &[Point2], station: f64) -> (Point2, Option<Vector2>) {
    let mut left = station.max(0.0);
    let mut last = (path.first().copied().unwrap_or_else(Point2::origin), None);
    for pair in path.windows(2) {
        let step = pair[1] - pair[0];
        let span = step.norm();
        if span == 0.0 {
            continue;
        }
        if left <= span {
            return (pair[0] + step * (left / span), Some(step));
        }
        left -= span;
        last = (pair[1], Some(step));
    }
    last
}

/// The part between two stations, both clamped to the path; two equal points if nothing is left.
pub fn slice(path: &[Point2], from: f64, to: f64) -> Vec<Point2> {
    let (from, to) = (from.max(0.0), to.min(length(path)));
    let mut out = Vec::with_capacity(path.len().min(8));
    out.push(at_piece(path, from).0);
    let mut station = 0.0;
    for pair in path.windows(2) {
        station += (pair[1] - pair[0]).norm();
        if station > from + 1e-9 && station < to - 1e-9 {
            out.push(pair[1]);
        }
    }
    out.push(at_piece(path, to.max(from)).0);
    out
}

/// The path shifted sideways, positive to the left; corners are mitred, sharp ones cut at twice the offset. Where it bends
/// more tightly than the shift, the pieces that would run backwards are left out.
pub fn offset(path: &[Point2], distance: f64) -> Vec<Point2> {
    let mut shifted = Vec::with_capacity(path.len());
    offset_into(path, distance, &mut shifted);
    shifted
}

/// The same, written over what was there.
pub(in crate::net) fn offset_into(path: &[Point2], distance: f64, shifted: &mut Vec<Point2>) {
    if mitre(path, distance, shifted) || path.len() < 3 {
        return;
    }
    let mut pieces = pieces(path);
    while pieces.len() > 1 {
        let before = pieces.len();
        let mut index = 0;
        pieces.retain(|piece| {
            index += 1;
            !is_backward((shifted[index - 1], shifted[index]), piece)
        });
        if pieces.len() == before || pieces.is_empty() {
            break;
        }
        *shifted = joined(path, &pieces, distance);
    }
}

/// Whether a piece runs backwards between where its ends were shifted to.
fn is_backward((start, end): (Point2, Point2), piece: &Piece) -> bool {
    (end - start).dot(&piece.along) < 0.0
}

/// A straight piece of a path: where it begins and its direction.
#[derive(Clone, Copy, Debug)]
struct Piece {
    start: Point2,
    along: Vector2,
}

impl Piece {
    fn left(&self) -> Vector2 {
        Vector2::new(-self.along.y, self.along.x)
    }
}

fn piece(pair: &[Point2]) -> Piece {
    let along = (pair[1] - pair[0]).try_normalize(1e-12).unwrap_or_else(Vector2::zeros);
    Piece { start: pair[0], along }
}

fn pieces(path: &[Point2]) -> Vec<Piece> {
    path.windows(2).map(piece).collect()
}

/// Writes every point shifted along the bisector of its two pieces over what was there, and tells whether all pieces still run
/// forwards.
fn mitre(path: &[Point2], distance: f64, shifted: &mut Vec<Point2>) -> bool {
    shifted.clear();
    let Some(first) = path.get(..2).map(piece) else {
        shifted.extend_from_slice(path);
        return true;
    };
    let (mut before, mut runs_on) = (first, true);
    for index in 0..path.len() {
        let after = path.get(index..index + 2).map_or(before, piece);
        let sum = before.left() + after.left();
        let scale = (2.0 / sum.norm_squared().max(1e-12)).min(2.0);
        shifted.push(path[index] + sum * scale * distance);
        runs_on &= index == 0 || !is_backward((shifted[index - 1], shifted[index]), &before);
        before = after;
    }
    runs_on
}

/// The lines of some of the pieces of a path, shifted, from where one meets the next; from beside the beginning of the
/// path to beside its end.
fn joined(path: &[Point2], pieces: &[Piece], distance: f64) -> Vec<Point2> {
    let lines: Vec<Piece> =
        pieces.iter().map(|piece| Piece { start: piece.start + piece.left() * distance, ..*piece }).collect();
    let foot = |line: &Piece, point: Point2| line.start + line.along * (point - line.start).dot(&line.along);
    let mut points = vec![foot(&lines[0], path[0])];
    for pair in lines.windows(2) {
        let meeting = meet(pair[0].start, pair[0].along, pair[1].start, pair[1].along);
        // Lines that are nearly parallel meet nowhere near: the next one begins where it would.
        points.push(meeting.unwrap_or(pair[1].start));
    }
    points.push(foot(&lines[lines.len() - 1], path[path.len() - 1]));
    points
}

/// The same way backwards.
pub fn reversed(path: &[Point2]) -> Vec<Point2> {
    path.iter().rev().copied().collect()
}

/// Where on a path a point is nearest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Closest {
    /// Distance along the path, m.
    pub station: f64,
    /// Distance from the path, m.
    pub distance: f64,
    /// Positive on the left of the path, negative on the right, m.
    pub lateral: f64,
}

/// The station nearest to a point; `None` for a path of fewer than two points.
///
/// In numbers rather than vectors: much of what makes a city asks this, and unoptimised builds do not see through vectors.
pub fn closest(path: &[Point2], point: &Point2) -> Option<Closest> {
    let mut best: Option<Closest> = None;
    let mut start = 0.0;
    for pair in path.windows(2) {
        let (along_x, along_y) = (pair[1].x - pair[0].x, pair[1].y - pair[0].y);
        let span = (along_x * along_x + along_y * along_y).sqrt();
        let (to_x, to_y) = (point.x - pair[0].x, point.y - pair[0].y);
        let share = (to_x * along_x + to_y * along_y) / (span * span);
        let share = if span > 0.0 { share.clamp(0.0, 1.0) } else { 0.0 };
        let (away_x, away_y) = (to_x - along_x * share, to_y - along_y * share);
        let distance = (away_x * away_x + away_y * away_y).sqrt();
        if best.is_none_or(|best| distance < best.distance) {
            let side = if along_x * to_y - along_y * to_x >= 0.0 { 1.0 } else { -1.0 };
            best = Some(Closest { station: start + share * span, distance, lateral: side * distance });
        }
        start += span;
    }
    best
}

/// A path whose pieces are measured once, for those who ask much of it: the answers are those of the functions of the same
/// names, to the bit.
///
/// ```
/// use simworld_core::geometry::Point2;
/// use simworld_core::net::polyline::{self, Measured};
/// let path = [(0.0, 0.0), (3.0, 4.0), (9.0, 4.0)].map(|(x, y)| Point2::new(x, y));
/// let measured = Measured::new(&path);
/// assert_eq!(measured.length(), 11.0);
/// assert_eq!(measured.slice(1.0, 7.0), polyline::slice(&path, 1.0, 7.0));
/// ```
#[derive(Clone, Debug)]
pub struct Measured<'a> {
    path: &'a [Point2],
    /// Length of each piece, m. Most paths have few.
    spans: SmallVec<[f64; 8]>,
    length: f64,
}

impl<'a> Measured<'a> {
    /// Measures a path.
    pub fn new(path: &'a [Point2]) -> Self {
        let spans: SmallVec<[f64; 8]> = path.windows(2).map(|pair| (pair[1] - pair[0]).norm()).collect();
        Self { path, length: spans.iter().sum(), spans }
    }

    /// See [`length`].
    pub fn length(&self) -> f64 {
        self.length
    }

    /// See [`slice`](fn@slice).
    pub fn slice(&self, from: f64, to: f64) -> Vec<Point2> {
        let mut out = Vec::with_capacity(self.path.len().min(8));
        self.slice_into(from, to, &mut out);
        out
    }

    /// The same, written over what was there.
    pub fn slice_into(&self, from: f64, to: f64, out: &mut Vec<Point2>) {
        let (from, to) = (from.max(0.0), to.min(self.length));
        out.clear();
        out.push(self.point_at(from));
        let mut station = 0.0;
        for (end, span) in self.path.iter().skip(1).zip(&self.spans) {
            station += span;
            if station >= to - 1e-9 {
                break;
            }
            if station > from + 1e-9 {
                out.push(*end);
            }
        }
        out.push(self.point_at(to.max(from)));
    }

    /// See [`at`]; only the point.
    pub fn point_at(&self, station: f64) -> Point2 {
        let mut left = station.max(0.0);
        let mut last = self.path.first().copied().unwrap_or_else(Point2::origin);
        for (pair, span) in self.path.windows(2).zip(&self.spans).filter(|(_, span)| **span != 0.0) {
            if left <= *span {
                return pair[0] + (pair[1] - pair[0]) * (left / span);
            }
            left -= span;
            last = pair[1];
        }
        last
    }

    /// See [`closest`]; only the station.
    pub fn closest_station(&self, point: &Point2) -> Option<f64> {
        let mut best: Option<(f64, f64, f64)> = None;
        let mut start = 0.0;
        for (pair, span) in self.path.windows(2).zip(&self.spans) {
            let (step, to_point) = (pair[1] - pair[0], point - pair[0]);
            let (along, most) = (to_point.dot(&step), span * span);
            // Divided only where it lies beside the piece: most pieces lie ahead of a point, or behind it.
            let along = match along {
                _ if along <= 0.0 || most == 0.0 => 0.0,
                _ if along >= most => 1.0,
                _ => along / most,
            };
            let squared = (to_point - step * along).norm_squared();
            // What is not nearer by its square is not nearer by its root.
            if best.is_none_or(|(least, ..)| squared < least) {
                let distance = squared.sqrt();
                if best.is_none_or(|(_, least, _)| distance < least) {
                    best = Some((squared, distance, start + along * span));
                }
            }
            start += span;
        }
        best.map(|(.., station)| station)
    }
}

/// The least distance between two paths, m; infinite if one is empty.
pub fn distance_between(a: &[Point2], b: &[Point2]) -> f64 {
    let one_way = |a: &[Point2], b: &[Point2]| {
        a.iter().filter_map(|point| closest(b, point)).map(|c| c.distance).fold(f64::INFINITY, f64::min)
    };
    let cross = a.windows(2).any(|p| b.windows(2).any(|q| crossing(p[0], p[1], q[0], q[1]).is_some()));
    if cross { 0.0 } else { one_way(a, b).min(one_way(b, a)) }
}

/// Where two segments cross, as shares of their lengths; `None` if they do not or are parallel.
pub fn crossing(a: Point2, b: Point2, c: Point2, d: Point2) -> Option<(f64, f64)> {
    let (r, s, between) = (b - a, d - c, c - a);
    let det = r.perp(&s);
    // Of long pieces on one line the rounding alone is more than any fixed bound.
    if det.abs() <= 1e-12 * r.norm() * s.norm() {
        return None;
    }
    let (t, u) = (between.perp(&s) / det, between.perp(&r) / det);
    ((0.0..=1.0).contains(&t) && (0.0..=1.0).contains(&u)).then_some((t, u))
}

/// Where two lines meet, each given by a point and a direction; `None` if they are nearly parallel.
pub(crate) fn meet(p: Point2, along_p: Vector2, q: Point2, along_q: Vector2) -> Option<Point2> {
    let det = along_p.perp(&along_q);
    (det.abs() > 0.15).then(|| p + along_p * ((q - p).perp(&along_q) / det))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bend() -> Vec<Point2> {
        vec![Point2::new(0.0, 0.0), Point2::new(10.0, 0.0), Point2::new(10.0, 5.0)]
    }

    #[test]
    fn the_nearest_point_is_that_of_vectors_to_the_bit() {
        let path = bend();
        for step in 0..500 {
            let (sin, cos) = ops::sin_cos(f64::from(step) * 0.7);
            let point = Point2::new(6.0 + 9.0 * cos, 2.0 + 7.0 * sin);
            let near = path.windows(2).map(|pair| {
                let (along, to) = (pair[1] - pair[0], point - pair[0]);
                let share = (to.dot(&along) / (along.norm() * along.norm())).clamp(0.0, 1.0);
                (to - along * share).norm()
            });
            let distance = near.fold(f64::INFINITY, f64::min);
            let found = closest(&path, &point).expect("it has pieces");
            assert_eq!(found.distance.to_bits(), distance.to_bits(), "{point}");
            assert_eq!(found.lateral.abs().to_bits(), distance.to_bits(), "{point}");
        }
    }

    #[test]
    fn pieces_of_one_line_do_not_cross() {
        // A street and its continuation farther on, turned: parallel but for rounding, whatever their length.
        for step in 1..2000 {
            let along = ops::sin_cos(f64::from(step) * 0.0031);
            let at = |station: f64| Point2::new(along.1, along.0) * station;
            for length in [1.0, 137.3, 5000.0] {
                let (own, other) = ((at(-3.0 * length), at(-1.1 * length)), (at(0.0), at(1.7 * length)));
                assert_eq!(crossing(own.0, own.1, other.0, other.1), None, "step {step}, {length} m");
            }
        }
        let own = (Point2::new(0.0, 0.0), Point2::new(100.0, 90.0));
        let across = (Point2::new(10.0, 30.0), Point2::new(30.0, 10.0));
        assert!(crossing(own.0, own.1, across.0, across.1).is_some());
    }

    #[test]
    fn stations_run_round_the_bend() {
        assert_eq!(length(&bend()), 15.0);
        let (point, heading) = at(&bend(), 12.0);
        assert!((point - Point2::new(10.0, 2.0)).norm() < 1e-12);
        assert!((heading - std::f64::consts::FRAC_PI_2).abs() < 1e-12);
        assert_eq!(at(&bend(), 99.0).0, Point2::new(10.0, 5.0));
    }

    #[test]
    fn an_offset_to_the_left_cuts_the_inner_corner() {
        let inner = offset(&bend(), 1.0);
        assert!((inner[1] - Point2::new(9.0, 1.0)).norm() < 1e-12, "{}", inner[1]);
        let outer = offset(&bend(), -1.0);
        assert!((outer[1] - Point2::new(11.0, -1.0)).norm() < 1e-12, "{}", outer[1]);
    }

    #[test]
    fn an_offset_leaves_out_what_would_run_backwards() {
        // A stub of 0.2 m after a sharp bend to the left: at 3 m to the left there is no room for it.
        let path = [Point2::new(0.0, 0.0), Point2::new(20.0, 0.0), Point2::new(20.1, 0.2)];
        let inner = offset(&path, 3.0);
        assert_eq!(inner.len(), 2);
        assert!((inner[0] - Point2::new(0.0, 3.0)).norm() < 1e-12);
        assert!(inner[1].x > 19.0 && (inner[1].y - 3.0).abs() < 1e-12, "{inner:?}");
        // A bow tighter than the offset: no piece runs against its own part of the path.
        let bow: Vec<Point2> = (0..=12)
            .map(|index| {
                let (sin, cos) = ops::sin_cos(f64::from(index) * std::f64::consts::PI / 12.0);
                Point2::new(2.0 * sin, 2.0 - 2.0 * cos)
            })
            .collect();
        let path = [vec![Point2::new(-30.0, 0.0)], bow, vec![Point2::new(-30.0, 4.0)]].concat();
        let inner = offset(&path, 3.0);
        let turned =
            inner.windows(3).filter(|corner| (corner[1] - corner[0]).dot(&(corner[2] - corner[1])) < 0.0);
        assert!(turned.count() <= 1, "{inner:?}");
    }

    #[test]
    fn a_measured_path_gives_the_same_answers() {
        let mut rng = crate::seed::Seed(11).stream("measured").rng();
        for count in 0..400_usize {
            let mut point = || Point2::new(rng.uniform(-50.0, 50.0), rng.uniform(-50.0, 50.0));
            let mut path: Vec<Point2> = (0..count % 9).map(|_| point()).collect();
            if let Some(last) = path.last().copied().filter(|_| count % 3 == 0) {
                path.push(last);
            }
            let (measured, from) = (Measured::new(&path), point());
            assert_eq!(measured.length(), length(&path));
            assert_eq!(measured.slice(from.x, from.x + from.y), slice(&path, from.x, from.x + from.y));
            let to = path.first().copied().filter(|_| count % 2 == 0).unwrap_or(from);
            assert_eq!(measured.closest_station(&to), closest(&path, &to).map(|near| near.station));
        }
    }

    #[test]
    fn the_nearest_station_knows_its_side() {
        let found = closest(&bend(), &Point2::new(4.0, 2.0)).unwrap();
        assert_eq!((found.station, found.lateral), (4.0, 2.0));
        assert_eq!(closest(&bend(), &Point2::new(4.0, -2.0)).unwrap().lateral, -2.0);
        assert_eq!(slice(&bend(), 4.0, 12.0).len(), 3);
    }
}
