//! Heights along roads: elevation profiles as straight pieces, each a distance along the course and a height, m.
//!
//! Source: ASAM OpenDRIVE 1.7.0, chapter 8.4.

use roxmltree::Node;
use simworld_core::geometry::Point2;
use simworld_core::net::polyline;

use super::document::number;
use crate::simplify::simplified;

/// Greatest height, m.
const HIGHEST: f64 = 9000.0;
/// How far a straight piece may be from the profile, m.
const TOLERANCE: f64 = 0.05;
/// Steps along a bent piece, m, and their number at most.
const STEP: f64 = 5.0;
const MOST_STEPS: f64 = 400.0;
/// Places nearer to each other than this are one, m.
const NEAR: f64 = 0.5;

/// Heights along a line, ascending by distance.
pub(super) type Heights = Vec<(f64, f64)>;

/// The elevation profile of a road: where each cubic begins, and its coefficients.
pub(super) struct Elevation(Vec<(f64, [f64; 4])>);

impl Elevation {
    /// That of an `elevationProfile`, if there is one.
    pub(super) fn of(profile: Option<Node<'_, '_>>) -> Self {
        let records = profile.into_iter().flat_map(|profile| profile.children());
        let records = records.filter(|record| record.has_tag_name("elevation"));
        let mut cubics: Vec<(f64, [f64; 4])> = records
            .map(|record| {
                let of = |name| number(record, name).unwrap_or(0.0);
                (of("s"), ["a", "b", "c", "d"].map(of))
            })
            .collect();
        cubics.sort_by(|a, b| a.0.total_cmp(&b.0));
        Self(cubics)
    }

    /// The height at a place, m.
    fn at(&self, s: f64) -> f64 {
        let next = self.0.partition_point(|(from, _)| *from <= s).max(1);
        let Some((from, [a, b, c, d])) = self.0.get(next - 1) else { return 0.0 };
        let x = (s - from).max(0.0);
        let height = a + x * (b + x * (c + x * d));
        if height.is_finite() { height.clamp(-HIGHEST, HIGHEST) } else { 0.0 }
    }

    /// From one place to another, `scale` times as far from each other as on the road; at least its ends.
    pub(super) fn between(&self, (from, to): (f64, f64), scale: f64) -> Heights {
        let mut points = vec![Point2::new(0.0, self.at(from))];
        let inner = self.0.iter().map(|(start, _)| *start).filter(|start| *start > from && *start < to);
        let mut before = from;
        for end in inner.chain([to]) {
            let next = self.0.partition_point(|(start, _)| *start <= before).max(1);
            let is_bent = self.0.get(next - 1).is_some_and(|(_, [_, _, c, d])| *c != 0.0 || *d != 0.0);
            // A step is a short ramp.
            let x = (before - from) * scale;
            let is_step = points.last().is_some_and(|last| (last.y - self.at(before)).abs() > TOLERANCE);
            if is_step && end - before > 4.0 * NEAR {
                points.push(Point2::new(x + 2.0 * NEAR, self.at(before)));
            }
            let steps = if is_bent { ((end - before) / STEP).ceil().clamp(1.0, MOST_STEPS) } else { 1.0 };
            for step in 1..=steps as u32 {
                let s = before + (end - before) * f64::from(step) / steps;
                // What begins at the end is the next one.
                let height = if s < end { self.at(s) } else { self.at(s.next_down().max(before)) };
                points.push(Point2::new((s - from) * scale, height));
            }
            before = end;
        }
        simplified(&points, TOLERANCE).iter().map(|point| (point.x, point.y)).collect()
    }
}

/// The same seen from the other end of a line of some length, m.
pub(super) fn reversed(heights: &[(f64, f64)], length: f64) -> Heights {
    heights.iter().rev().map(|(station, height)| ((length - station).max(0.0), *height)).collect()
}

/// Those of two lines of which the second begins so far along both, m.
pub(super) fn joined(first: &[(f64, f64)], second: &[(f64, f64)], from: f64) -> Heights {
    let second = second.iter().map(|(station, height)| (station + from, *height));
    let mut all: Heights = first.iter().copied().chain(second).collect();
    all.dedup_by(|next, before| next.0 - before.0 < 1e-6);
    all
}

/// Heights of a street between its nodes, whose line was drawn to them: `line` is that of the road and `course` that of the
/// street, from a node at the first height to one at the last.
pub(super) fn on_the_way(
    heights: &[(f64, f64)],
    (line, course): (&[Point2], &[Point2]),
    ends: [f64; 2],
) -> Heights {
    let [Some(first), Some(last)] = [line.first().zip(course.first()), line.last().zip(course.last())] else {
        return Vec::new();
    };
    let gaps = [first, last].map(|(a, b)| (b - a).norm());
    let (own, length) = (polyline::length(line), polyline::length(course));
    let scale = length / (gaps[0] + own + gaps[1]).max(1e-9);
    let mut points = vec![Point2::new(0.0, ends[0])];
    for (station, height) in heights {
        let station = (gaps[0] + station) * scale;
        let is_apart = points.last().is_some_and(|before| station - before.x >= NEAR);
        if is_apart && length - station >= NEAR {
            points.push(Point2::new(station, *height));
        }
    }
    points.push(Point2::new(length, ends[1]));
    let kept = simplified(&points, TOLERANCE);
    kept[1..kept.len() - 1].iter().map(|point| (point.x, point.y)).collect()
}

/// The height at a station of a street from a node at the first height to one at the last.
pub(super) fn at(heights: &[(f64, f64)], length: f64, ends: [f64; 2], station: f64) -> f64 {
    let next = heights.partition_point(|(at, _)| *at <= station);
    let before = next.checked_sub(1).map_or((0.0, ends[0]), |index| heights[index]);
    let after = heights.get(next).copied().unwrap_or((length, ends[1]));
    let share = ((station - before.0) / (after.0 - before.0).max(1e-9)).clamp(0.0, 1.0);
    before.1 + (after.1 - before.1) * share
}

/// A course with a point wherever its heights bend: what is built along it is straight from point to point.
pub(super) fn bent(course: &[Point2], heights: &[(f64, f64)]) -> Vec<Point2> {
    let mut line: Vec<Point2> = course[..1].to_vec();
    let (mut station, mut rest) = (0.0, heights);
    for pair in course.windows(2) {
        let end = station + (pair[1] - pair[0]).norm();
        while let Some(((at, _), others)) = rest.split_first().filter(|((at, _), _)| *at < end) {
            if at - station >= NEAR && end - at >= NEAR {
                line.push(pair[0] + (pair[1] - pair[0]) * ((at - station) / (end - station)));
            }
            rest = others;
        }
        line.push(pair[1]);
        station = end;
    }
    line
}

#[cfg(test)]
mod tests {
    use super::*;

    fn elevation(xml: &str) -> Elevation {
        let text = format!("<elevationProfile>{xml}</elevationProfile>");
        Elevation::of(Some(roxmltree::Document::parse(&text).expect("XML").root_element()))
    }

    #[test]
    fn straight_pieces_follow_cubics() {
        // A crest of 4 m, then level.
        let profile = elevation(
            "<elevation s='0' a='10' b='0.16' c='-0.0016' d='0'/><elevation s='100' a='10' b='0' c='0' d='0'/>",
        );
        let heights = profile.between((0.0, 200.0), 1.0);
        for step in 0..=200 {
            let s = f64::from(step);
            let found = at(&heights, 200.0, [10.0, 10.0], s);
            assert!((found - profile.at(s)).abs() < 0.06, "{found} at {s}");
        }
        assert!((4..20).contains(&heights.len()), "{heights:?}");
        let back = reversed(&heights, 200.0);
        assert!((at(&back, 200.0, [10.0, 10.0], 150.0) - 14.0).abs() < 0.06);
        assert_eq!(elevation("").between((5.0, 9.0), 1.0), [(0.0, 0.0), (4.0, 0.0)]);
        // A step between two pieces is as steep as it is.
        let step = elevation("<elevation s='0' a='1'/><elevation s='50' a='3'/>").between((0.0, 100.0), 1.0);
        assert!((at(&step, 100.0, [1.0, 3.0], 40.0) - 1.0).abs() < 0.06, "{step:?}");
    }

    #[test]
    fn a_line_gets_a_point_where_its_heights_bend() {
        let course = [Point2::new(0.0, 0.0), Point2::new(10.0, 0.0), Point2::new(10.0, 20.0)];
        let line = bent(&course, &[(4.0, 1.0), (10.2, 2.0), (25.0, 0.0)]);
        let wanted = [(0.0, 0.0), (4.0, 0.0), (10.0, 0.0), (10.0, 15.0), (10.0, 20.0)];
        assert_eq!(line, wanted.map(|(x, y)| Point2::new(x, y)));
    }
}
