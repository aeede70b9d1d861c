//! The one place where core's nalgebra types meet rapier's glam types. Both are `f64` in the same frames, so every
//! conversion is exact.

use nalgebra::{Quaternion, Translation3, UnitQuaternion};
use rapier3d_f64::math::{Pose as RapierPose, Rotation, Vector};
use simworld_core::geometry::{Point3, Pose, Vector3};

/// A displacement, velocity or direction for rapier.
pub fn to_vector(vector: &Vector3) -> Vector {
    Vector::new(vector.x, vector.y, vector.z)
}

/// A point for rapier, which does not tell points from vectors.
pub fn to_point(point: &Point3) -> Vector {
    to_vector(&point.coords)
}

/// A pose for rapier.
pub fn to_pose(pose: &Pose) -> RapierPose {
    let q = pose.rotation.coords;
    RapierPose::from_parts(to_vector(&pose.translation.vector), Rotation::from_xyzw(q.x, q.y, q.z, q.w))
}

/// A displacement, velocity or direction from rapier.
pub fn from_vector(vector: Vector) -> Vector3 {
    Vector3::new(vector.x, vector.y, vector.z)
}

/// A point from rapier.
pub fn from_point(point: Vector) -> Point3 {
    from_vector(point).into()
}

/// A pose from rapier; its rotation is taken as it is, without normalising it again.
pub fn from_pose(pose: &RapierPose) -> Pose {
    let q = pose.rotation;
    let rotation = UnitQuaternion::new_unchecked(Quaternion::new(q.w, q.x, q.y, q.z));
    Pose::from_parts(Translation3::from(from_vector(pose.translation)), rotation)
}

#[cfg(test)]
mod tests {
    use super::*;
    use simworld_core::geometry::pose_facing;

    #[test]
    fn a_pose_survives_the_journey_bit_for_bit() {
        let pose = pose_facing(Point3::new(1e4, -3.25, 0.1), 0.7);
        assert_eq!(from_pose(&to_pose(&pose)), pose);
        let point = Point3::new(2.0, 0.0, 1.0);
        let there = from_point(to_pose(&pose) * to_point(&point));
        assert!((there - pose * point).norm() < 1e-11);
    }
}
