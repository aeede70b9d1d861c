//! The solid shape of an entity, in its body frame.

use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::geometry::{Aabb, Obb, Point2, Point3, Pose, Vector3};
use crate::hash::StateHasher;

/// A shape that no body can have.
#[derive(Clone, Debug, PartialEq, Error)]
#[error("a {shape} with {field} = {value} is no solid: give a finite size from 1 mm to 100 km")]
pub struct ShapeError {
    /// The kind of shape.
    pub shape: &'static str,
    /// The dimension at fault.
    pub field: &'static str,
    /// Its value, m.
    pub value: f64,
}

/// A solid standing on its origin: the body frame's origin is the middle of the bottom, z points up.
///
/// A person 1.8 m tall at pose z = 0 has feet at 0 and the crown at 1.8.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum Shape {
    /// A box.
    Box {
        /// Length (x), width (y) and height (z), m.
        size: Vector3,
    },
    /// An upright cylinder.
    Cylinder {
        /// m.
        radius: f64,
        /// m.
        height: f64,
    },
    /// An upright capsule, round at both ends.
    Capsule {
        /// m.
        radius: f64,
        /// Over all, at least twice the radius, m.
        height: f64,
    },
    /// A ball.
    Sphere {
        /// m.
        radius: f64,
    },
}

impl Shape {
    /// A box of that length (x), width (y) and height (z), m.
    pub fn cuboid(length: f64, width: f64, height: f64) -> Self {
        Self::Box { size: Vector3::new(length, width, height) }
    }

    /// Length, width and height of the box around the shape in its body frame, m.
    #[inline]
    pub fn size(&self) -> Vector3 {
        match *self {
            Self::Box { size } => size,
            Self::Cylinder { radius, height } | Self::Capsule { radius, height } => {
                Vector3::new(2.0 * radius, 2.0 * radius, height)
            }
            Self::Sphere { radius } => Vector3::repeat(2.0 * radius),
        }
    }

    /// The oriented box around the shape at a pose.
    #[inline]
    pub fn obb(&self, world_from_body: &Pose) -> Obb {
        let half_extents = self.size() * 0.5;
        let to_center = nalgebra::Translation3::new(0.0, 0.0, half_extents.z);
        Obb { pose: world_from_body * to_center, half_extents }
    }

    /// The axis-aligned box around the shape at a pose.
    pub fn aabb(&self, world_from_body: &Pose) -> Aabb {
        self.obb(world_from_body).aabb()
    }

    /// The middle of the shape at a pose.
    pub fn center(&self, world_from_body: &Pose) -> Point3 {
        world_from_body * Point3::new(0.0, 0.0, self.size().z * 0.5)
    }

    /// Distance in the plane between the footprint's box and a point, m; zero inside.
    pub fn planar_distance(&self, world_from_body: &Pose, point: &Point2) -> f64 {
        let local = world_from_body.inverse_transform_point(&Point3::new(
            point.x,
            point.y,
            world_from_body.translation.z,
        ));
        let half = self.size() * 0.5;
        let (dx, dy) = ((local.x.abs() - half.x).max(0.0), (local.y.abs() - half.y).max(0.0));
        (dx * dx + dy * dy).sqrt()
    }

    /// Checks that the shape is a solid.
    ///
    /// # Errors
    /// A dimension that is not finite or not between 1 mm and 100 km.
    pub fn validate(&self) -> Result<(), ShapeError> {
        let (shape, fields): (_, [(&str, f64); 3]) = match *self {
            Self::Box { size } => ("box", [("length", size.x), ("width", size.y), ("height", size.z)]),
            Self::Cylinder { radius, height } => {
                ("cylinder", [("radius", radius), ("height", height), ("height", height)])
            }
            Self::Capsule { radius, height } => (
                "capsule",
                [("radius", radius), ("height", height), ("height - 2 radius", height - 2.0 * radius + 1e-3)],
            ),
            Self::Sphere { radius } => ("sphere", [("radius", radius); 3]),
        };
        match fields.into_iter().find(|(_, value)| !(1e-3..=1e5).contains(value)) {
            Some((field, value)) => Err(ShapeError { shape, field, value }),
            None => Ok(()),
        }
    }

    pub(crate) fn state_hash(&self, hasher: &mut StateHasher) {
        match *self {
            Self::Box { size } => hasher.u64(0).vector(&size),
            Self::Cylinder { radius, height } => hasher.u64(1).f64(radius).f64(height),
            Self::Capsule { radius, height } => hasher.u64(2).f64(radius).f64(height),
            Self::Sphere { radius } => hasher.u64(3).f64(radius),
        };
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::pose_facing;

    #[test]
    fn a_body_stands_on_its_origin() {
        let person = Shape::Capsule { radius: 0.25, height: 1.8 };
        let aabb = person.aabb(&pose_facing(Point3::new(3.0, 4.0, 0.5), 1.0));
        assert!((aabb.min.z - 0.5).abs() < 1e-12 && (aabb.max.z - 2.3).abs() < 1e-12);
    }

    #[test]
    fn degenerate_solids_are_refused() {
        assert!(Shape::cuboid(1.0, 0.0, 1.0).validate().is_err());
        assert!(Shape::Sphere { radius: f64::NAN }.validate().is_err());
        assert!(Shape::Capsule { radius: 1.0, height: 1.0 }.validate().is_err());
        assert!(Shape::Capsule { radius: 0.5, height: 1.0 }.validate().is_ok());
    }
}
