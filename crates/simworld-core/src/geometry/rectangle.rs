//! Rectangles in the plane, turned any way: what bodies take of the ground, and how far they are apart.

use super::{Obb, Point2, Vector2, planar};

/// Sides that are turned by less than this run along the axes, rad: over a kilometre that is a thousandth of a millimetre.
const ALONG_AXES: f64 = 1e-9;
/// The heading of an axis that points up or down but for this is not to be told.
const UPRIGHT: f64 = 1e-6;

/// A rectangle in the plane, turned any way: the footprint of a body.
///
/// ```
/// use std::f64::consts::FRAC_PI_4;
/// use simworld_core::geometry::{Point2, Rectangle, Vector2, direction};
/// let house = Rectangle { center: Point2::origin(), ahead: direction(FRAC_PI_4), half: Vector2::new(30.0, 5.0) };
/// let kiosk = Rectangle { center: house.center + direction(-FRAC_PI_4) * 20.0, half: Vector2::new(1.0, 1.0), ..house };
/// assert!((house.gap(&kiosk) - 14.0).abs() < 1e-12);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rectangle {
    /// Its middle, m.
    pub center: Point2,
    /// The way its length runs; a unit vector.
    pub ahead: Vector2,
    /// Half of its length, along `ahead`, and of its width, m.
    pub half: Vector2,
}

impl Rectangle {
    /// Whether its sides run along the axes of the world.
    pub fn is_along_axes(&self) -> bool {
        self.ahead.x.abs().min(self.ahead.y.abs()) <= ALONG_AXES
    }

    /// The four corners, counter-clockwise from the one ahead on the left.
    pub fn corners(&self) -> [Point2; 4] {
        let (long, wide) = (self.ahead * self.half.x, to_the_left(self.ahead) * self.half.y);
        [long + wide, wide - long, -long - wide, long - wide].map(|off| self.center + off)
    }

    /// From the rectangle to a point, m; zero inside.
    pub fn distance_to(&self, point: &Point2) -> f64 {
        square_off(&self.half, &self.seen(point - self.center)).sqrt()
    }

    /// Between two rectangles, m; zero where they share a point. The same, to the bit, whichever is asked for the other.
    pub fn gap(&self, other: &Self) -> f64 {
        let (way, turn) = (other.center - self.center, self.seen(other.ahead));
        let (apart, near) = corners_from(&self.half, self.seen(way), turn, &other.half);
        let back = Vector2::new(turn.x, -turn.y);
        let (apart_back, near_back) = corners_from(&other.half, other.seen(-way), back, &self.half);
        // Two rectangles share a point unless a side of one parts them; then a corner of one is nearest to the other.
        if apart.max(apart_back) <= 0.0 { 0.0 } else { near.min(near_back).sqrt() }
    }

    /// A displacement as seen from the rectangle: how much of it leads ahead, and how much to the left, m.
    fn seen(&self, way: Vector2) -> Vector2 {
        Vector2::new(self.ahead.dot(&way), self.ahead.perp(&way))
    }
}

impl Obb {
    /// The rectangle along its heading around what it covers seen from above: the footprint of an upright box. What looks straight up
    /// or down has the heading that its left side tells.
    pub fn rectangle(&self) -> Rectangle {
        let rotation = self.pose.rotation.to_rotation_matrix();
        let axes = rotation.matrix();
        let seen = |axis: usize| Vector2::new(axes[(0, axis)], axes[(1, axis)]);
        let ahead = seen(0).try_normalize(UPRIGHT).unwrap_or_else(|| -to_the_left(seen(1)).normalize());
        let reach = |axis: usize| {
            let way = seen(axis) * self.half_extents[axis];
            Vector2::new(ahead.dot(&way).abs(), ahead.perp(&way).abs())
        };
        Rectangle { center: planar(&self.pose), ahead, half: reach(0) + reach(1) + reach(2) }
    }
}

fn to_the_left(way: Vector2) -> Vector2 {
    Vector2::new(-way.y, way.x)
}

/// The square of the distance to a point from a rectangle around the origin along the axes, m².
fn square_off(half: &Vector2, point: &Vector2) -> f64 {
    (point.abs() - half).sup(&Vector2::zeros()).norm_squared()
}

/// How far a side of a rectangle around the origin along the axes parts it from another at `middle`, whose length runs to `turn`, m
/// (not above zero where none does); and the square of the distance to the nearest corner of the other, m².
fn corners_from(half: &Vector2, middle: Vector2, turn: Vector2, other: &Vector2) -> (f64, f64) {
    let (long, wide) = (turn * other.x, to_the_left(turn) * other.y);
    let apart = (middle.abs() - half - long.abs() - wide.abs()).max();
    let offs = [long + wide, wide - long, -long - wide, long - wide];
    let squares = offs.map(|off| square_off(half, &(middle + off)));
    (apart, squares.into_iter().fold(f64::INFINITY, f64::min))
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, TAU};

    use nalgebra::UnitQuaternion;
    use proptest::prelude::*;

    use super::*;
    use crate::geometry::{Point3, Pose, Vector3, direction, pose_facing};

    /// So many points stand for a side.
    const STEPS: u32 = 40;

    /// Where it is, how it is turned, and half its sides.
    type Told = (f64, f64, f64, f64, f64);

    fn told() -> impl Strategy<Value = Told> {
        (-25.0..25.0_f64, -25.0..25.0_f64, 0.0..TAU, 0.2..14.0_f64, 0.2..14.0_f64)
    }

    fn rectangle((x, y, yaw, long, wide): Told) -> Rectangle {
        Rectangle { center: Point2::new(x, y), ahead: direction(yaw), half: Vector2::new(long, wide) }
    }

    /// Points all along the outline, and how far one is from the next at the most, m.
    fn outline((x, y, yaw, long, wide): Told) -> (Vec<Point2>, f64) {
        let place = |forward: f64, left: f64| {
            Point2::new(x, y) + direction(yaw) * forward + direction(yaw + FRAC_PI_2) * left
        };
        let shares = (0..=STEPS).map(|step| f64::from(step) / f64::from(STEPS) * 2.0 - 1.0);
        let sides = shares.flat_map(|share| {
            let (forward, left) = (long * share, wide * share);
            [place(forward, wide), place(forward, -wide), place(long, left), place(-long, left)]
        });
        (sides.collect(), 2.0 * long.max(wide) / f64::from(STEPS))
    }

    /// Whether a point is in the rectangle, and not just on its edge.
    fn holds((x, y, yaw, long, wide): Told, point: &Point2) -> bool {
        let way = point - Point2::new(x, y);
        way.dot(&direction(yaw)).abs() < long - 1e-9
            && way.dot(&direction(yaw + FRAC_PI_2)).abs() < wide - 1e-9
    }

    proptest! {
        #[test]
        fn the_gap_is_that_between_the_outlines(one in told(), other in told()) {
            let gap = rectangle(one).gap(&rectangle(other));
            let ((here, step), (there, step_there)) = (outline(one), outline(other));
            let overlap = here.iter().any(|point| holds(other, point)) || there.iter().any(|point| holds(one, point));
            let nearest = here.iter().flat_map(|a| there.iter().map(move |b| (a - b).norm())).fold(f64::INFINITY, f64::min);
            if overlap {
                prop_assert_eq!(gap, 0.0);
            } else {
                prop_assert!(gap <= nearest + 1e-9, "{} is more than {}", gap, nearest);
                // The nearest point of each is at most half a step from one of those.
                prop_assert!(gap >= nearest - (step + step_there) * 0.5 - 1e-9, "{} is less than {}", gap, nearest);
            }
        }

        #[test]
        fn the_gap_is_the_same_either_way_and_however_the_whole_is_turned(
            one in told(), other in told(), angle in 0.0..TAU, east in -1e3..1e3_f64,
        ) {
            let (a, b) = (rectangle(one), rectangle(other));
            let gap = a.gap(&b);
            prop_assert_eq!(gap, b.gap(&a));
            let turned = |(x, y, yaw, long, wide): Told| {
                let at = direction(angle) * x + direction(angle + FRAC_PI_2) * y;
                rectangle((at.x + east, at.y, yaw + angle, long, wide))
            };
            prop_assert!((turned(one).gap(&turned(other)) - gap).abs() < 1e-9);
        }

        #[test]
        fn a_point_is_as_far_off_as_a_rectangle_without_sides(one in told(), x in -40.0..40.0_f64, y in -40.0..40.0_f64) {
            let point = Rectangle { half: Vector2::zeros(), ..rectangle((x, y, 0.3, 1.0, 1.0)) };
            let lawn = rectangle(one);
            prop_assert!((lawn.distance_to(&point.center) - lawn.gap(&point)).abs() < 1e-9);
        }

        #[test]
        fn an_upright_box_has_its_footprint_and_one_that_leans_stays_in_its_rectangle(
            at in (-25.0..25.0_f64, -25.0..25.0_f64), yaw in 0.0..TAU, lean in (-1.6..1.6_f64, -1.6..1.6_f64),
            half in (0.1..8.0_f64, 0.1..8.0_f64, 0.1..8.0_f64),
        ) {
            let half_extents = Vector3::new(half.0, half.1, half.2);
            let pose = pose_facing(Point3::new(at.0, at.1, 1.0), yaw);
            let upright = Obb { pose, half_extents };
            for (corner, known) in upright.rectangle().corners().iter().zip(upright.footprint()) {
                prop_assert!((corner - known).norm() < 1e-9);
            }
            let leaning = Obb { pose: pose * UnitQuaternion::from_euler_angles(lean.0, lean.1, 0.0), half_extents };
            let (seen, mut reach) = (leaning.rectangle(), Vector2::zeros());
            for corner in 0..8_u32 {
                let sign = |bit: u32| if (corner >> bit) & 1 == 0 { 1.0 } else { -1.0 };
                let own = Point3::new(sign(0) * half.0, sign(1) * half.1, sign(2) * half.2);
                let world = leaning.pose * own;
                let way = seen.seen(Point2::new(world.x, world.y) - seen.center);
                prop_assert!(seen.distance_to(&Point2::new(world.x, world.y)) < 1e-9);
                reach = reach.sup(&way);
            }
            prop_assert!((reach - seen.half).norm() < 1e-9, "it is no larger than need be");
        }
    }

    #[test]
    fn what_looks_up_is_turned_as_its_left_side_is() {
        let upwards = UnitQuaternion::from_euler_angles(0.0, -FRAC_PI_2, 0.0);
        let pose = Pose::from_parts(Point3::origin().into(), upwards);
        let mast = Obb { pose, half_extents: Vector3::new(9.0, 2.0, 1.0) }.rectangle();
        assert!((mast.half - Vector2::new(1.0, 2.0)).norm() < 1e-9, "{mast:?}");
        assert!((mast.ahead - Vector2::x()).norm() < 1e-9 && mast.is_along_axes());
    }

    #[test]
    fn sides_run_along_the_axes_after_quarter_turns_alone() {
        let turned = |yaw: f64| rectangle((3.0, 4.0, yaw, 5.0, 2.0)).is_along_axes();
        assert!((-4..=4).all(|quarter| turned(f64::from(quarter) * FRAC_PI_2)));
        assert!(!turned(FRAC_PI_4) && !turned(1e-3) && !turned(FRAC_PI_2 - 1e-3));
    }

    #[test]
    fn crosswise_rectangles_meet_though_no_corner_lies_in_the_other() {
        let (beam, other) = (rectangle((0.0, 0.0, 0.2, 10.0, 0.5)), rectangle((0.0, 0.0, 1.7, 10.0, 0.5)));
        assert_eq!(beam.gap(&other), 0.0);
        // Two beams that lie past each other: the boxes around them meet, and they do not.
        let past =
            rectangle((-4.0, 4.0, FRAC_PI_4, 10.0, 0.5)).gap(&rectangle((4.0, -4.0, FRAC_PI_4, 10.0, 0.5)));
        assert!((past - (8.0 * 2f64.sqrt() - 1.0)).abs() < 1e-9);
    }
}
