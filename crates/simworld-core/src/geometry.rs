//! Points, poses, twists, bounding boxes and footprints.
//!
//! World frame: right-handed, x east, y north, z up (ROS REP-103); body frame: x forward, y left, z up. Metres,
//! radians, seconds, `f64`. A pose named `world_from_body` maps points of the body frame into the world:
//! `world_from_body * point_in_body`.

mod compass;
mod rectangle;

use nalgebra::{Isometry3, UnitQuaternion};
use serde::{Deserialize, Serialize};

pub use compass::Compass;
pub use rectangle::Rectangle;

use crate::ops;

/// A point in the plane, m.
pub type Point2 = nalgebra::Point2<f64>;
/// A point in space, m.
pub type Point3 = nalgebra::Point3<f64>;
/// A displacement or direction in the plane.
pub type Vector2 = nalgebra::Vector2<f64>;
/// A displacement, velocity or direction in space.
pub type Vector3 = nalgebra::Vector3<f64>;
/// A rigid transform: where a frame stands in another, by default a body in the world.
pub type Pose = Isometry3<f64>;

/// The pose at `position` that faces `yaw` radians counter-clockwise from east, upright.
#[inline]
pub fn pose_facing(position: Point3, yaw: f64) -> Pose {
    Pose::from_parts(position.into(), UnitQuaternion::from_axis_angle(&Vector3::z_axis(), yaw))
}

/// The heading of a pose: the angle of its forward axis seen from above, radians in (-π, π].
pub fn yaw_of(pose: &Pose) -> f64 {
    let forward = pose.rotation * Vector3::x();
    ops::atan2(forward.y, forward.x)
}

/// The position of a pose in the plane.
pub fn planar(pose: &Pose) -> Point2 {
    Point2::new(pose.translation.x, pose.translation.y)
}

/// The unit vector that points `yaw` radians counter-clockwise from east.
#[inline]
pub fn direction(yaw: f64) -> Vector2 {
    let (sin, cos) = ops::sin_cos(yaw);
    Vector2::new(cos, sin)
}

/// The heading of a displacement, radians in (-π, π].
#[inline]
pub fn heading(displacement: &Vector2) -> f64 {
    ops::atan2(displacement.y, displacement.x)
}

/// The least and the greatest corner of the rectangle around some points; `None` without any.
pub fn bounds<'a>(points: impl IntoIterator<Item = &'a Point2>) -> Option<(Point2, Point2)> {
    let mut points = points.into_iter();
    let first = *points.next()?;
    Some(points.fold((first, first), |(low, high), point| (low.inf(point), high.sup(point))))
}

/// Linear and angular velocity of a body, in the world frame.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Twist {
    /// Velocity of the body's origin, m/s.
    pub linear: Vector3,
    /// Angular velocity, rad/s.
    pub angular: Vector3,
}

impl Twist {
    /// At rest.
    pub const ZERO: Self = Self { linear: Vector3::new(0.0, 0.0, 0.0), angular: Vector3::new(0.0, 0.0, 0.0) };

    /// Speed over ground, m/s.
    pub fn ground_speed(&self) -> f64 {
        (self.linear.x * self.linear.x + self.linear.y * self.linear.y).sqrt()
    }
}

/// An axis-aligned box in the world frame, m.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Aabb {
    /// The corner with the least coordinates.
    pub min: Point3,
    /// The corner with the greatest coordinates.
    pub max: Point3,
}

impl Aabb {
    /// The box between two corners; they may be given in any order.
    pub fn new(a: Point3, b: Point3) -> Self {
        Self { min: a.inf(&b), max: a.sup(&b) }
    }

    /// The box around `center` that reaches `half_extents` to each side.
    pub fn around(center: Point3, half_extents: Vector3) -> Self {
        Self { min: center - half_extents, max: center + half_extents }
    }

    /// A vertical column over a rectangle of the plane, unbounded in height.
    pub fn column(min: Point2, max: Point2) -> Self {
        Self {
            min: Point3::new(min.x.min(max.x), min.y.min(max.y), f64::NEG_INFINITY),
            max: Point3::new(max.x.max(min.x), max.y.max(min.y), f64::INFINITY),
        }
    }

    /// A vertical column of `radius` to each side of `center`, unbounded in height.
    pub fn column_around(center: Point2, radius: f64) -> Self {
        let reach = Vector2::new(radius, radius);
        Self::column(center - reach, center + reach)
    }

    /// The middle of the box.
    pub fn center(&self) -> Point3 {
        nalgebra::center(&self.min, &self.max)
    }

    /// Half the size along each axis.
    pub fn half_extents(&self) -> Vector3 {
        (self.max - self.min) * 0.5
    }

    /// Whether the two boxes share a point; touching counts.
    pub fn intersects(&self, other: &Self) -> bool {
        (0..3).all(|axis| self.min[axis] <= other.max[axis] && other.min[axis] <= self.max[axis])
    }

    /// Whether the point lies in the box; the boundary counts.
    pub fn contains(&self, point: &Point3) -> bool {
        (0..3).all(|axis| self.min[axis] <= point[axis] && point[axis] <= self.max[axis])
    }

    /// The smallest box that holds both.
    #[must_use]
    pub fn union(&self, other: &Self) -> Self {
        Self { min: self.min.inf(&other.min), max: self.max.sup(&other.max) }
    }

    /// The box grown by `margin` on every side.
    #[must_use]
    pub fn inflated(&self, margin: f64) -> Self {
        let reach = Vector3::repeat(margin);
        Self { min: self.min - reach, max: self.max + reach }
    }

    /// Least distance in the plane between the box and a point, m; zero above, below and inside it.
    pub fn planar_distance(&self, point: &Point2) -> f64 {
        let dx = (self.min.x - point.x).max(point.x - self.max.x).max(0.0);
        let dy = (self.min.y - point.y).max(point.y - self.max.y).max(0.0);
        (dx * dx + dy * dy).sqrt()
    }
}

/// An oriented box: a pose at its centre and half sizes along its own axes.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Obb {
    /// World from box; the origin is the centre of the box.
    pub pose: Pose,
    /// Half the size along the box's own x, y and z, m.
    pub half_extents: Vector3,
}

impl Obb {
    /// The axis-aligned box around this one.
    pub fn aabb(&self) -> Aabb {
        let axes = self.pose.rotation.to_rotation_matrix();
        let reach = axes.matrix().abs() * self.half_extents;
        Aabb::around(self.pose.translation.vector.into(), reach)
    }

    /// The four corners of the footprint seen from above, counter-clockwise; exact for upright boxes.
    #[inline]
    pub fn footprint(&self) -> [Point2; 4] {
        let (half, center) = (self.half_extents, planar(&self.pose));
        // What lies on the other side of the centre lies as far from it, to the bit.
        let turned = |x: f64| (self.pose.rotation * Vector3::new(x, half.y, 0.0)).xy();
        let [front, rear] = [turned(half.x), turned(-half.x)];
        [center + front, center + rear, center - front, center - rear]
    }

    /// Whether the footprints of two upright boxes share interior points, by the separating-axis test.
    ///
    /// Touching edges do not count: two row houses may share a wall.
    pub fn footprints_overlap(&self, other: &Self) -> bool {
        let (a, b) = (self.footprint(), other.footprint());
        let axes = [a[0] - a[1], a[1] - a[2], b[0] - b[1], b[1] - b[2]];
        axes.iter().all(|axis| {
            let span = |corners: &[Point2; 4]| {
                corners
                    .iter()
                    .map(|c| c.coords.dot(axis))
                    .fold((f64::INFINITY, f64::NEG_INFINITY), |(lo, hi), d| (lo.min(d), hi.max(d)))
            };
            let ((a_lo, a_hi), (b_lo, b_hi)) = (span(&a), span(&b));
            a_lo < b_hi && b_lo < a_hi
        })
    }
}

/// A half-line with a unit direction.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Ray {
    /// Where it starts, world frame, m.
    pub origin: Point3,
    /// Where it points; unit length.
    pub direction: Vector3,
}

impl Ray {
    /// A ray from `origin` towards `target`, or `None` if they coincide.
    pub fn towards(origin: Point3, target: Point3) -> Option<Self> {
        let direction = (target - origin).try_normalize(f64::EPSILON)?;
        Some(Self { origin, direction })
    }

    /// The point `distance` metres along the ray.
    pub fn at(&self, distance: f64) -> Point3 {
        self.origin + self.direction * distance
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};

    use super::*;

    #[test]
    fn a_rotated_box_reaches_by_its_diagonal() {
        let obb =
            Obb { pose: pose_facing(Point3::origin(), FRAC_PI_4), half_extents: Vector3::new(1.0, 1.0, 2.0) };
        let reach = obb.aabb().half_extents();
        assert!((reach.x - 2f64.sqrt()).abs() < 1e-12 && (reach.z - 2.0).abs() < 1e-12);
    }

    #[test]
    fn a_footprint_is_where_the_pose_puts_its_corners() {
        for step in 0..1000 {
            let at = |by: f64| f64::from(step) * by;
            let position = Point3::new(at(731.7), at(-0.37), 1.0);
            let half_extents = Vector3::new(0.1 + at(0.013), 9.0 - at(0.007), 1.0);
            let obb = Obb { pose: pose_facing(position, at(0.11) - 50.0), half_extents };
            let (x, y) = (half_extents.x, half_extents.y);
            let corner = |(x, y): (f64, f64)| (obb.pose * Point3::new(x, y, 0.0)).xy();
            assert_eq!(obb.footprint(), [(x, y), (-x, y), (-x, -y), (x, -y)].map(corner));
        }
    }

    #[test]
    fn row_houses_touch_without_overlap() {
        let house = |x| Obb {
            pose: pose_facing(Point3::new(x, 0.0, 0.0), FRAC_PI_2),
            half_extents: Vector3::new(3.0, 5.0, 4.0),
        };
        assert!(!house(0.0).footprints_overlap(&house(10.0 + 1e-9)));
        assert!(house(0.0).footprints_overlap(&house(9.9)));
    }

    #[test]
    fn yaw_survives_a_round_trip() {
        for step in -31..=31 {
            let yaw = f64::from(step) * 0.1;
            assert!((yaw_of(&pose_facing(Point3::new(5.0, -3.0, 1.0), yaw)) - yaw).abs() < 1e-12);
        }
    }
}
