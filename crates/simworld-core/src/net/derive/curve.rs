//! Smooth curves from one lane to another.

use crate::geometry::{Point2, Vector2};

/// A piece of a curve's path departs from it by so much at most, m, but where that would take more than a point a metre.
const SAGITTA: f64 = 0.01;

/// A cubic Bézier curve that leaves and arrives along the given directions: a point about every metre where it bends, fewer
/// the straighter it is, and none between the ends of a straight one.
pub(in crate::net) fn curve(start: Point2, leaving: Vector2, end: Point2, arriving: Vector2) -> Vec<Point2> {
    let curve = Bezier::new(start, leaving, end, arriving);
    curve.points(curve.least_pieces()).collect()
}

/// Curves whose points lie at the same shares of their ways have them between their corners in the same proportions: those are
/// worked out once.
#[derive(Default)]
pub(super) struct Curves {
    /// The proportions at each point of a curve of so many pieces; empty until there is one.
    shares: Vec<Vec<[f64; 4]>>,
}

impl Curves {
    /// See [`curve`].
    pub(super) fn curve(
        &mut self,
        start: Point2,
        leaving: Vector2,
        end: Point2,
        arriving: Vector2,
    ) -> Vec<Point2> {
        let curve = Bezier::new(start, leaving, end, arriving);
        self.points(curve.corners, curve.least_pieces()).collect()
    }

    /// The same with a point about every metre wherever it leads.
    pub(super) fn dense_curve(
        &mut self,
        start: Point2,
        leaving: Vector2,
        end: Point2,
        arriving: Vector2,
    ) -> impl Iterator<Item = Point2> {
        let curve = Bezier::new(start, leaving, end, arriving);
        self.points(curve.corners, curve.metres())
    }

    fn points(&mut self, corners: [Point2; 4], pieces: usize) -> impl Iterator<Item = Point2> {
        if self.shares.len() <= pieces {
            self.shares.resize_with(pieces + 1, Vec::new);
        }
        let shares = &mut self.shares[pieces];
        if shares.is_empty() {
            shares.extend((0..=pieces).map(|index| Bezier::shares(index, pieces)));
        }
        shares.iter().map(move |shares| Bezier::point(&corners, shares))
    }
}

struct Bezier {
    /// Where it begins, what it is drawn to on its way, and where it ends.
    corners: [Point2; 4],
    /// From its beginning to its end, m.
    apart: f64,
    /// How far what it is drawn to lies on the left of the straight way to its end, m.
    aside: [f64; 2],
}

impl Bezier {
    fn new(start: Point2, leaving: Vector2, end: Point2, arriving: Vector2) -> Self {
        let chord = end - start;
        let apart = chord.norm();
        // Longer handles where the curve turns back, so that a U-turn bulges like half a circle.
        let turned_back = (1.0 - leaving.dot(&arriving)) * 0.5;
        let handle = apart * (0.36 + 0.3 * turned_back * turned_back);
        let aside = |drawn: Vector2| chord.perp(&drawn) / apart;
        Self {
            corners: [start, start + leaving * handle, end - arriving * handle, end],
            apart,
            aside: [aside(leaving * handle), aside(-arriving * handle)],
        }
    }

    fn metres(&self) -> usize {
        (self.apart.ceil() as usize).clamp(4, 200)
    }

    /// As many pieces as keep near the curve: a chord over so much of a parameter departs from it by an eighth of its square times
    /// the second derivative, of which only what points aside counts.
    fn least_pieces(&self) -> usize {
        let [a, b] = self.aside;
        let bent = 6.0 * (b - 2.0 * a).abs().max((a - 2.0 * b).abs());
        // A curve without a length is aside of nothing, and has one piece.
        ((bent / (8.0 * SAGITTA)).sqrt().ceil() as usize).clamp(1, self.metres())
    }

    fn points(&self, pieces: usize) -> impl Iterator<Item = Point2> + use<> {
        let corners = self.corners;
        (0..=pieces).map(move |index| Self::point(&corners, &Self::shares(index, pieces)))
    }

    /// How much each corner counts at one of the points between so many pieces.
    fn shares(index: usize, pieces: usize) -> [f64; 4] {
        let t = index as f64 / pieces as f64;
        let s = 1.0 - t;
        [s * s * s, 3.0 * s * s * t, 3.0 * s * t * t, t * t * t]
    }

    fn point(corners: &[Point2; 4], shares: &[f64; 4]) -> Point2 {
        let [start, a, b, end] = corners;
        let sum =
            start.coords * shares[0] + a.coords * shares[1] + b.coords * shares[2] + end.coords * shares[3];
        sum.into()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::direction;
    use crate::net::polyline;
    use crate::seed::Seed;

    #[test]
    fn fewer_points_are_as_near_to_the_curve() {
        let mut rng = Seed(3).stream("curve").rng();
        let (mut few, mut many, mut curves) = (0, 0, Curves::default());
        for _ in 0..2000 {
            let end = Point2::new(rng.uniform(3.0, 45.0), 0.0);
            let mut along = || direction(rng.uniform(-0.8, 0.8) * rng.uniform(0.0, 1.0));
            let (leaving, arriving) = (along(), along());
            let path = curve(Point2::origin(), leaving, end, arriving);
            assert_eq!(curves.curve(Point2::origin(), leaving, end, arriving), path);
            let dense: Vec<Point2> = curves.dense_curve(Point2::origin(), leaving, end, arriving).collect();
            (few, many) = (few + path.len(), many + dense.len());
            for point in &dense {
                let near = polyline::closest(&path, point).expect("it has two points");
                assert!(
                    near.distance <= SAGITTA || path.len() == dense.len(),
                    "{point} is {} m off {path:?}",
                    near.distance
                );
            }
            assert!((polyline::length(&path) - polyline::length(&dense)).abs() < 0.02);
        }
        assert!(4 * few < 3 * many, "{few} points for {many}");
    }

    #[test]
    fn a_straight_way_has_two_points_and_one_that_turns_back_bulges() {
        let (start, end, east) = (Point2::origin(), Point2::new(20.0, 0.0), Vector2::x());
        assert_eq!(curve(start, east, end, east).len(), 2);
        let back = curve(start, Vector2::y(), end, -Vector2::y());
        assert!(back.len() > 20 && back.iter().any(|point| point.y > 8.0));
        assert_eq!(curve(start, east, start, east), [start; 2]);
    }
}
