//! Reference lines: the curves of OpenDRIVE as points.
//!
//! Source: ASAM OpenDRIVE 1.7.0, chapter 7. Each piece has its own beginning, so that errors do not add up.

use roxmltree::Node;
use simworld_core::geometry::{Point2, Vector2, direction};
use simworld_core::ops;

use super::document::number;

/// Longest piece that is read, m.
const LONGEST: f64 = 100_000.0;
/// Points of one piece at most.
const MOST_POINTS: f64 = 2000.0;
/// Farthest coordinate, m; a plan allows more.
const FARTHEST: f64 = 5e6;
/// Turn from one point to the next, radians.
const TURN: f64 = 0.08;

/// One piece of a reference line.
struct Piece {
    start: Point2,
    heading: f64,
    length: f64,
}

/// The points of a `planView`; `None` where a piece is nowhere or of a shape that is not known.
pub(super) fn points(plan_view: Node<'_, '_>) -> Option<Vec<Point2>> {
    let mut line: Vec<Point2> = Vec::new();
    for geometry in plan_view.children().filter(|child| child.has_tag_name("geometry")) {
        let of = |name| number(geometry, name);
        let piece =
            Piece { start: Point2::new(of("x")?, of("y")?), heading: of("hdg")?, length: of("length")? };
        if piece.length <= 0.0 {
            continue;
        }
        let shape = geometry.children().find(Node::is_element)?;
        let is_near = piece.start.coords.amax() <= FARTHEST && piece.heading.abs() <= 1e4;
        if !is_near || piece.length > LONGEST {
            return None;
        }
        piece.sample(shape, &mut line)?;
    }
    // Pieces begin where the one before ends.
    line.dedup_by(|a, b| (*a - *b).norm() < 0.01);
    let is_line = line.len() >= 2 && line.iter().all(|point| point.coords.amax() <= FARTHEST);
    is_line.then_some(line)
}

impl Piece {
    /// A point at some metres along and to the left of its beginning.
    fn at(&self, along: f64, left: f64) -> Point2 {
        let ahead = direction(self.heading);
        self.start + ahead * along + Vector2::new(-ahead.y, ahead.x) * left
    }

    fn sample(&self, shape: Node<'_, '_>, line: &mut Vec<Point2>) -> Option<()> {
        let of = |name| number(shape, name);
        match shape.tag_name().name() {
            "line" => line.extend([self.start, self.at(self.length, 0.0)]),
            "arc" => self.bent(of("curvature")?, of("curvature")?, line),
            "spiral" => self.bent(of("curvStart")?, of("curvEnd")?, line),
            "poly3" => self.cubic([of("a")?, of("b")?, of("c")?, of("d")?], line),
            "paramPoly3" => {
                let of = |name| number(shape, name).unwrap_or(0.0);
                let u = [of("aU"), of("bU"), of("cU"), of("dU")];
                let v = [of("aV"), of("bV"), of("cV"), of("dV")];
                let is_by_length = shape.attribute("pRange") == Some("arcLength");
                self.parametric(u, v, if is_by_length { self.length } else { 1.0 }, line);
            }
            _ => return None,
        }
        Some(())
    }

    /// The number of steps for a turn of so many radians.
    fn steps(&self, turn: f64) -> u32 {
        (turn.abs() / TURN).max(self.length / 25.0).ceil().clamp(1.0, MOST_POINTS) as u32
    }

    /// An arc, or a clothoid whose curvature goes evenly from one value to another: integrated by Simpson's rule.
    fn bent(&self, first: f64, last: f64, line: &mut Vec<Point2>) {
        let heading = |s: f64| self.heading + s * (first + (last - first) * s / (2.0 * self.length));
        let count = self.steps(first.abs().max(last.abs()) * self.length);
        let step = self.length / f64::from(count);
        let mut at = self.start;
        line.push(at);
        for index in 0..count {
            let s = f64::from(index) * step;
            let [a, b, c] = [s, s + step * 0.5, s + step].map(|s| {
                let (sin, cos) = ops::sin_cos(heading(s));
                Vector2::new(cos, sin)
            });
            at += (a + b * 4.0 + c) * (step / 6.0);
            line.push(at);
        }
    }

    /// The deprecated cubic `v(u)`, as long as the piece.
    fn cubic(&self, [a, b, c, d]: [f64; 4], line: &mut Vec<Point2>) {
        let count = self.length.ceil().clamp(8.0, MOST_POINTS);
        let step = self.length / count;
        let mut u = 0.0;
        for _ in 0..=count as u32 {
            line.push(self.at(u, a + u * (b + u * (c + u * d))));
            let slope = b + u * (2.0 * c + u * 3.0 * d);
            u += step / (1.0 + slope * slope).sqrt();
        }
    }

    /// The parametric cubic, its parameter from 0 to `last`.
    fn parametric(&self, u: [f64; 4], v: [f64; 4], last: f64, line: &mut Vec<Point2>) {
        let count = self.length.ceil().clamp(8.0, MOST_POINTS);
        let value = |[a, b, c, d]: [f64; 4], p: f64| a + p * (b + p * (c + p * d));
        for index in 0..=count as u32 {
            let p = last * f64::from(index) / count;
            line.push(self.at(value(u, p), value(v, p)));
        }
    }
}

#[cfg(test)]
mod tests {
    use simworld_core::net::polyline;

    use super::*;

    fn line(xml: &str) -> Option<Vec<Point2>> {
        let text = format!("<planView>{xml}</planView>");
        points(roxmltree::Document::parse(&text).expect("XML").root_element())
    }

    fn geometry(length: f64, shape: &str) -> String {
        format!("<geometry s='0' x='10' y='5' hdg='0' length='{length}'>{shape}</geometry>")
    }

    #[test]
    fn every_curve_ends_where_it_ends() {
        let quarter = std::f64::consts::FRAC_PI_2 * 50.0;
        // A clothoid of A² = 2500 after 50 m: Fresnel's integrals, by their series.
        let cases = [
            (geometry(40.0, "<line/>"), (50.0, 5.0), 40.0),
            (geometry(quarter, "<arc curvature='0.02'/>"), (60.0, 55.0), quarter),
            (geometry(50.0, "<spiral curvStart='0' curvEnd='0.02'/>"), (10.0 + 48.7643, 5.0 + 8.1859), 50.0),
            (geometry(40.0, "<poly3 a='0' b='0' c='0' d='0'/>"), (50.0, 5.0), 40.0),
            (geometry(40.0, "<paramPoly3 bU='30' bV='0' cV='9' pRange='normalized'/>"), (40.0, 14.0), 31.7),
        ];
        for (xml, (x, y), length) in cases {
            let line = line(&xml).unwrap();
            let end = line[line.len() - 1];
            assert!((end - Point2::new(x, y)).norm() < 0.02, "{xml} ends at {end}");
            assert!((polyline::length(&line) - length).abs() < 0.05, "{xml}: {}", polyline::length(&line));
        }
    }

    #[test]
    fn what_is_nowhere_is_no_line() {
        for xml in [
            "<geometry x='0' y='0' hdg='0' length='10'/>".to_owned(),
            geometry(10.0, "<helix/>"),
            geometry(1e9, "<line/>"),
            geometry(10.0, "<arc/>"),
            geometry(10.0, "<paramPoly3 dU='1e300'/>"),
            "<geometry x='NaN' y='0' hdg='0' length='10'><line/></geometry>".to_owned(),
            String::new(),
        ] {
            assert_eq!(line(&xml), None, "{xml}");
        }
        let hostile = line(&geometry(90_000.0, "<arc curvature='1e6'/>")).unwrap();
        assert!(hostile.len() < 3000);
    }
}
