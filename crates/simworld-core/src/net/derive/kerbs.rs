//! Kerbs round a junction: rounded corners, the turning circle at a dead end, and the outline that they make.

use super::hammerhead;
use super::legs::{Leg, corner};
use crate::geometry::{Point2, Vector2};
use crate::net::{Few, TurningCircle};
use crate::ops;

/// Radius of the kerb where a turning circle opens out of its street, m.
const FLARE: f64 = 5.0;
/// A turning circle is wider than its street by this at least, on either side, m.
const LEAST_BULGE: f64 = 1.0;
/// Kerbs with a smaller radius stay sharp, m.
const LEAST_RADIUS: f64 = 0.3;
/// Points nearer than this are one, m.
const SAME: f64 = 1e-3;
/// Legs turn by more than this, as the sine, where their kerbs are no straight line.
const PARALLEL: f64 = 0.15;
/// The most that an arc turns between two of its points, radians.
pub(super) const KERB_STEP: f64 = 0.32;
pub(super) const WALK_STEP: f64 = 0.8;

/// The paved area of a junction, counter-clockwise, and the point at which the kerb on the left of each leg begins. The
/// i-th kerb leads from the left of leg i round the corner to the right of the next one.
pub(super) fn outline(center: Point2, legs: &[Leg]) -> (Vec<Point2>, Few<u32>) {
    if legs.is_empty() {
        return (vec![center], Few::new());
    }
    let mut outline = Vec::with_capacity(legs.len() * 8);
    let mut starts = Few::with_capacity(legs.len());
    for (index, leg) in legs.iter().enumerate() {
        let next = &legs[(index + 1) % legs.len()];
        starts.push(outline.len() as u32);
        outline.push(leg.point(leg.reach, leg.left));
        match legs {
            [leg] if leg.turning > 0.0 => Bulb::of(leg).round(0.0, KERB_STEP, &mut outline),
            [leg] if leg.hammerhead => hammerhead::kerb(leg, &mut outline),
            [leg] => outline.extend([leg.point(0.0, leg.left), leg.point(0.0, -leg.right)]),
            _ => rounded(center, leg, next, &mut outline),
        }
        outline.push(next.point(next.reach, -next.right));
    }
    (outline, starts)
}

/// The kerb between two legs, without its ends: an arc that touches both kerbs, as wide as the class of the lesser street
/// asks and as there is room before the junction ends.
fn rounded(center: Point2, leg: &Leg, next: &Leg, outline: &mut Vec<Point2>) {
    let (out, back) = (leg.direction(), next.direction());
    let Some(met) = corner(leg, next, (0.0, 0.0)) else {
        if out.perp(&back) < -PARALLEL {
            // The outer kerbs of a sharp bend meet far away: the corner is cut.
            outline.extend([leg.point(0.0, leg.left), next.point(0.0, -next.right)]);
        }
        return;
    };
    let room = (leg.reach - (met - center).dot(&out)).min(next.reach - (met - center).dot(&back));
    if room < 0.0 {
        // A corner farther out than the area reaches would fold it over itself.
        return;
    }
    let (sin, cos) = (out.perp(&back), out.dot(&back));
    // Tangent of half the angle between the legs (1 + cos is not nothing, for the kerbs meet).
    let half = (sin / (1.0 + cos)).abs();
    // Round the outside of a bend the kerb runs about the same middle as round its inside.
    let across = if sin < 0.0 { leg.left + leg.right } else { 0.0 };
    let radius = (leg.rounding.min(next.rounding) + across).min(room * half);
    if radius < LEAST_RADIUS {
        outline.push(met);
        return;
    }
    // Where there is no more room the arc begins, or ends, with the kerb.
    let ends = [outline[outline.len() - 1], next.point(next.reach, -next.right)];
    let first = outline.len();
    let start = met + out * (radius / half);
    let inwards = if sin < 0.0 { -1.0 } else { 1.0 };
    let middle = start + Vector2::new(-out.y, out.x) * (radius * inwards);
    let turn = std::f64::consts::PI - 2.0 * ops::atan2(half, 1.0);
    arc(middle, start, -turn * inwards, KERB_STEP, outline);
    if outline.last().is_some_and(|last| (last - ends[1]).norm() < SAME) {
        outline.pop();
    }
    if (start - ends[0]).norm() < SAME {
        outline.remove(first);
    }
}

/// Points on an arc about a middle from a start on, both ends included.
pub(super) fn arc(middle: Point2, start: Point2, turn: f64, step: f64, points: &mut Vec<Point2>) {
    let pieces = (turn.abs() / step).ceil().max(1.0);
    let (sin, cos) = ops::sin_cos(turn / pieces);
    let mut from_middle = start - middle;
    points.push(start);
    for _ in 0..pieces as u32 {
        from_middle = Vector2::new(
            from_middle.x * cos - from_middle.y * sin,
            from_middle.x * sin + from_middle.y * cos,
        );
        points.push(middle + from_middle);
    }
}

/// How far a turning circle reaches into its street, m; `None` where it would be no wider than the street.
pub(super) fn bulb_reach(leg: &Leg) -> Option<f64> {
    (leg.turning >= (leg.left + leg.right) * 0.5 + LEAST_BULGE).then(|| Bulb::of(leg).reach)
}

/// The turning circle of a dead end that has one.
pub(super) fn turning_circle(legs: &[Leg]) -> Option<TurningCircle> {
    let [leg] = legs else { return None };
    let center = leg.point(0.0, Bulb::of(leg).shift);
    (leg.turning > 0.0).then_some(TurningCircle { center, radius: leg.turning })
}

/// A turning circle about the end of a street.
struct Bulb<'a> {
    leg: &'a Leg,
    /// Its middle lies so far to the left of the centreline, m.
    shift: f64,
    /// Half the width of the street, m.
    half: f64,
    /// Where the flare begins, m from the node.
    reach: f64,
}

impl<'a> Bulb<'a> {
    fn of(leg: &'a Leg) -> Self {
        let (shift, half) = ((leg.left - leg.right) * 0.5, (leg.left + leg.right) * 0.5);
        let (to_flare, beside) = (leg.turning + FLARE, half + FLARE);
        Self { leg, shift, half, reach: (to_flare * to_flare - beside * beside).max(0.0).sqrt() }
    }

    /// Adds the way round at a distance outside of the kerb, counter-clockwise from the left of the street to its right.
    fn round(&self, outside: f64, step: f64, points: &mut Vec<Point2>) {
        let outside = outside.min(FLARE);
        let flare = |side: f64| self.leg.point(self.reach, self.shift + side * (self.half + FLARE));
        let beside = |side: f64| self.leg.point(self.reach, self.shift + side * (self.half + outside));
        let middle = self.leg.point(0.0, self.shift);
        // The angle at the middle between the street and a flare.
        let angle = ops::atan2(self.half + FLARE, self.reach);
        let touch = |side: f64| {
            let towards = flare(side) - middle;
            middle + towards * ((self.leg.turning + outside) / towards.norm())
        };
        let turn = std::f64::consts::FRAC_PI_2 - angle;
        if outside < FLARE {
            arc(flare(1.0), beside(1.0), -turn, step, points);
            points.pop();
        }
        arc(middle, touch(1.0), 2.0 * (std::f64::consts::PI - angle), step, points);
        if outside < FLARE {
            points.pop();
            arc(flare(-1.0), touch(-1.0), -turn, step, points);
        }
    }
}

/// The walkway round a turning circle, so far outside of its kerbs.
pub(super) fn walk_round_bulb(leg: &Leg, outside: f64) -> Vec<Point2> {
    let mut points = Vec::new();
    Bulb::of(leg).round(outside, WALK_STEP, &mut points);
    points
}

/// The way of a vehicle round a turning circle; see [`way_round`]. `keep` is the distance of its middle from the kerb.
pub(super) fn turning_path(leg: &Leg, lanes: (f64, f64), keep: f64) -> Option<Vec<Point2>> {
    way_round(leg, (0.0, leg.turning - keep), lanes)
}

/// The way of a vehicle round at a dead end, from a lane `left` m to the left of the centreline to one `right` m to its
/// right, both seen leaving: out of the lane to the right, on a circle to the left, and back. The middle of the circle lies
/// `along` m into the street. `None` where it has no room for that.
pub(super) fn way_round(
    leg: &Leg,
    (along, radius): (f64, f64),
    (left, right): (f64, f64),
) -> Option<Vec<Point2>> {
    let shift = (leg.left - leg.right) * 0.5;
    let stop = leg.stop - along;
    // The radius of the way out of a lane that touches the circle and begins at the end of the lane.
    let swing = |beside: f64| {
        let swing = (stop * stop - radius * radius + beside * beside) / (2.0 * (radius - beside));
        (beside.abs() < radius - 0.5 && swing > 1.0).then_some(swing)
    };
    let (to_left, to_right) = (left - shift, right + shift);
    let (out, back) = (swing(to_left)?, swing(to_right)?);
    let middle = leg.point(along, shift);
    let angle = |beside: f64, swing: f64| ops::atan2(beside + swing, stop);
    let (first, last) = (angle(to_left, out), angle(to_right, back));
    let mut points = Vec::with_capacity(64);
    let turn = |angle: f64| std::f64::consts::FRAC_PI_2 - angle;
    arc(leg.point(leg.stop, left + out), leg.point(leg.stop, left), -turn(first), 0.15, &mut points);
    let start = points.pop()?;
    arc(middle, start, std::f64::consts::TAU - first - last, 0.15, &mut points);
    let start = points.pop()?;
    arc(leg.point(leg.stop, -right - back), start, -turn(last), 0.15, &mut points);
    Some(points)
}
