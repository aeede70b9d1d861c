//! Pinhole cameras: intrinsics in pixels, pose as world from optical frame.
//!
//! Optical frame (`OpenCV`): x right, y down, z forward. Pixel (0, 0) is the top left one and its centre is at
//! (0.5, 0.5).

use nalgebra::{Matrix3, UnitQuaternion};
use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::geometry::{Point2, Point3, Pose};
use crate::ops;

/// A camera that cannot exist.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum CameraError {
    /// The image is empty or larger than any device allows.
    #[error("an image of {width} x {height} pixels is out of range: give 1 to 16384 each way")]
    Size {
        /// Pixels across.
        width: u32,
        /// Pixels down.
        height: u32,
    },
    /// The field of view is not a usable angle.
    #[error("a horizontal field of view of {radians} rad is out of range: give more than 0 and less than π")]
    FieldOfView {
        /// The refused angle.
        radians: f64,
    },
}

/// The projection of a pinhole camera, in pixels.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Intrinsics {
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
    /// Focal length along x, pixels.
    pub fx: f64,
    /// Focal length along y, pixels.
    pub fy: f64,
    /// Principal point along x, pixels from the left edge.
    pub cx: f64,
    /// Principal point along y, pixels from the top edge.
    pub cy: f64,
}

impl Intrinsics {
    /// Square pixels, centred principal point, `horizontal_fov` radians across the image.
    ///
    /// A 640-pixel image with π/2 has fx = 320.
    ///
    /// # Errors
    /// An empty or oversized image, or a field of view outside (0, π).
    pub fn from_fov(width: u32, height: u32, horizontal_fov: f64) -> Result<Self, CameraError> {
        if !(1..=16384).contains(&width) || !(1..=16384).contains(&height) {
            return Err(CameraError::Size { width, height });
        }
        if !(horizontal_fov > 0.0 && horizontal_fov < std::f64::consts::PI) {
            return Err(CameraError::FieldOfView { radians: horizontal_fov });
        }
        let focal = f64::from(width) * 0.5 / ops::tan(horizontal_fov * 0.5);
        Ok(Self {
            width,
            height,
            fx: focal,
            fy: focal,
            cx: f64::from(width) * 0.5,
            cy: f64::from(height) * 0.5,
        })
    }

    /// The 3x3 matrix K that maps optical-frame points to homogeneous pixels.
    pub fn matrix(&self) -> Matrix3<f64> {
        Matrix3::new(self.fx, 0.0, self.cx, 0.0, self.fy, self.cy, 0.0, 0.0, 1.0)
    }

    /// The pixel on which an optical-frame point falls and its planar depth in m; `None` behind the camera.
    pub fn project(&self, point_in_optical: &Point3) -> Option<(Point2, f64)> {
        let depth = point_in_optical.z;
        (depth > 0.0).then(|| {
            let u = self.fx * point_in_optical.x / depth + self.cx;
            let v = self.fy * point_in_optical.y / depth + self.cy;
            (Point2::new(u, v), depth)
        })
    }

    /// The optical-frame point at planar `depth` m behind a pixel.
    pub fn unproject(&self, pixel: &Point2, depth: f64) -> Point3 {
        Point3::new((pixel.x - self.cx) / self.fx * depth, (pixel.y - self.cy) / self.fy * depth, depth)
    }
}

/// A camera standing in the world.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Camera {
    /// World from optical frame.
    pub world_from_optical: Pose,
    /// The projection.
    pub intrinsics: Intrinsics,
}

impl Camera {
    /// A camera at a body-frame pose (x forward, y left, z up), looking along its forward axis.
    pub fn looking_along(world_from_body: &Pose, intrinsics: Intrinsics) -> Self {
        Self { world_from_optical: world_from_body * body_from_optical(), intrinsics }
    }

    /// A camera at `eye` that looks at `target`, upright; straight down it keeps north at the top.
    pub fn looking_at(eye: Point3, target: Point3, intrinsics: Intrinsics) -> Self {
        let ahead = target - eye;
        let flat = ops::hypot(ahead.x, ahead.y);
        let yaw = if flat > 1e-9 { ops::atan2(ahead.y, ahead.x) } else { std::f64::consts::FRAC_PI_2 };
        let pitch = ops::atan2(-ahead.z, flat);
        let rotation = UnitQuaternion::from_euler_angles(0.0, pitch, yaw);
        Self::looking_along(&Pose::from_parts(eye.into(), rotation), intrinsics)
    }

    /// The pixel and the planar depth (m) of a world point; `None` behind the camera.
    pub fn project(&self, point: &Point3) -> Option<(Point2, f64)> {
        self.intrinsics.project(&self.world_from_optical.inverse_transform_point(point))
    }
}

/// The rotation from the optical frame (x right, y down, z forward) to the body frame (x forward, y left, z up).
pub fn body_from_optical() -> Pose {
    let axes = Matrix3::new(0.0, 0.0, 1.0, -1.0, 0.0, 0.0, 0.0, -1.0, 0.0);
    let rotation = nalgebra::Rotation3::from_matrix_unchecked(axes);
    Pose::from_parts(nalgebra::Translation3::identity(), UnitQuaternion::from_rotation_matrix(&rotation))
}

#[cfg(test)]
mod tests {
    use std::f64::consts::FRAC_PI_2;

    use super::*;

    #[test]
    fn a_point_to_the_left_and_above_falls_left_and_above_the_centre() {
        let intrinsics = Intrinsics::from_fov(640, 480, FRAC_PI_2).unwrap();
        let camera = Camera::looking_along(&Pose::identity(), intrinsics);
        let (pixel, depth) = camera.project(&Point3::new(10.0, 5.0, 2.0)).unwrap();
        assert!((pixel - Point2::new(320.0 - 160.0, 240.0 - 64.0)).norm() < 1e-9, "{pixel}");
        assert!((depth - 10.0).abs() < 1e-12);
        assert!(camera.project(&Point3::new(-1.0, 0.0, 0.0)).is_none());
    }

    #[test]
    fn what_it_looks_at_is_in_the_middle() {
        let intrinsics = Intrinsics::from_fov(100, 100, 1.0).unwrap();
        for target in [Point3::new(3.0, -8.0, 0.5), Point3::new(0.0, 0.0, -20.0), Point3::new(-4.0, 0.0, 9.0)]
        {
            let eye = Point3::new(0.0, 0.0, 10.0);
            let (pixel, _) = Camera::looking_at(eye, target, intrinsics).project(&target).unwrap();
            assert!((pixel - Point2::new(50.0, 50.0)).norm() < 1e-6, "{target} at {pixel}");
        }
    }

    #[test]
    fn impossible_cameras_are_refused() {
        assert!(Intrinsics::from_fov(0, 480, 1.0).is_err());
        assert!(Intrinsics::from_fov(64, 64, f64::NAN).is_err());
        assert!(Intrinsics::from_fov(64, 64, 3.2).is_err());
    }
}
