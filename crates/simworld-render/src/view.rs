//! What a camera sees, camera-relative.
//!
//! The camera's position is subtracted from every instance in `f64`; everything behind that point is `f32`, so a
//! picture 100 km from the origin is that of the origin. Clip space: reverse z without a far plane, `z_clip = near`
//! and `w_clip` the planar depth, which keeps the precision of a float from the near plane to the horizon.

use nalgebra::{Matrix3, Matrix4};
use simworld_core::camera::{Camera, Intrinsics};
use simworld_core::geometry::{Aabb, Point2, Point3, Vector3};

use crate::RenderError;
use crate::batch::Projection;

/// A checked camera, ready to cull and to project.
#[derive(Clone, Debug)]
pub(crate) struct View {
    pub eye: Point3,
    /// Optical frame from world, rotation only.
    pub optical_from_world: Matrix3<f64>,
    pub intrinsics: Intrinsics,
    pub near: f64,
    pub far: f64,
    pub projection: Projection,
    /// Whether it sees to all sides, as a table of rays does.
    all_round: bool,
    /// Inward normals of the four sides of what is seen, optical frame, and how far inside of each the eye is, m.
    sides: [(Vector3, f64); 4],
}

impl View {
    pub(crate) fn new(camera: &Camera, near: f64, far: f64, limit: u32) -> Result<Self, RenderError> {
        check(camera, limit)?;
        let k = camera.intrinsics;
        let (width, height) = (f64::from(k.width), f64::from(k.height));
        let sides = [
            Vector3::new(k.fx, 0.0, k.cx),
            Vector3::new(-k.fx, 0.0, width - k.cx),
            Vector3::new(0.0, k.fy, k.cy),
            Vector3::new(0.0, -k.fy, height - k.cy),
        ];
        let rotation = camera.world_from_optical.rotation.to_rotation_matrix();
        Ok(Self {
            eye: camera.world_from_optical.translation.vector.into(),
            optical_from_world: rotation.matrix().transpose(),
            intrinsics: k,
            near,
            far,
            projection: Projection::Pinhole,
            all_round: false,
            sides: sides.map(|side| (side.normalize(), 0.0)),
        })
    }

    /// The same camera with another projection.
    pub(crate) fn projected(mut self, projection: Projection) -> Self {
        if projection == Projection::Parallel {
            let k = &self.intrinsics;
            let (width, height) = (f64::from(k.width), f64::from(k.height));
            self.sides = [
                (Vector3::x(), k.cx / k.fx),
                (-Vector3::x(), (width - k.cx) / k.fx),
                (Vector3::y(), k.cy / k.fy),
                (-Vector3::y(), (height - k.cy) / k.fy),
            ];
        }
        Self { projection, ..self }
    }

    /// The same eye, that sees to all sides.
    pub(crate) fn all_round(self) -> Self {
        Self { all_round: true, ..self }
    }

    /// Clip space from camera-relative world axes.
    pub(crate) fn clip_from_relative(&self) -> Matrix4<f64> {
        let k = &self.intrinsics;
        let (width, height) = (f64::from(k.width), f64::from(k.height));
        if self.projection == Projection::Parallel {
            // z is 1 at the near plane and 0 at the far one, as it is for the pinhole near and far.
            let depth = self.far - self.near;
            let scale = Vector3::new(2.0 * k.fx / width, -2.0 * k.fy / height, -1.0 / depth);
            let shift = Vector3::new(2.0 * k.cx / width - 1.0, 1.0 - 2.0 * k.cy / height, self.far / depth);
            let clip = Matrix4::new_translation(&shift) * Matrix4::new_nonuniform_scaling(&scale);
            return clip * self.optical_from_world.to_homogeneous();
        }
        let clip_from_optical = Matrix4::new(
            2.0 * k.fx / width,
            0.0,
            2.0 * k.cx / width - 1.0,
            0.0,
            0.0,
            -2.0 * k.fy / height,
            1.0 - 2.0 * k.cy / height,
            0.0,
            0.0,
            0.0,
            0.0,
            self.near,
            0.0,
            0.0,
            1.0,
            0.0,
        );
        clip_from_optical * self.optical_from_world.to_homogeneous()
    }

    /// The world direction of the optical axis.
    pub(crate) fn forward(&self) -> Vector3 {
        self.optical_from_world.row(2).transpose()
    }

    /// Inward normals of the four sides of what is seen, optical frame, and how far inside of each the eye is, m.
    pub(crate) const fn sides(&self) -> [(Vector3, f64); 4] {
        self.sides
    }

    /// Whether a ball may be on the picture; its centre is camera-relative.
    pub(crate) fn sees(&self, center: &Vector3, radius: f64, min_pixels: f64) -> bool {
        let distance = center.norm();
        if distance - radius > self.far {
            return false;
        }
        if self.pixels(radius, distance.max(radius)) < min_pixels {
            return false;
        }
        let optical = self.optical_from_world * center;
        optical.z + radius >= self.near && self.is_between(&optical, radius)
    }

    /// Whether a ball may hold balls of at most that radius that are on the picture; its centre is camera-relative. By the [slack](slack) of a
    /// sieve some that hold none count too.
    pub(crate) fn sees_some(&self, center: &Vector3, radius: f64, largest: f64, min_pixels: f64) -> bool {
        let slack = slack(center.norm(), radius);
        let nearest = (center.norm() - radius - largest - slack).max(largest).max(1e-9);
        self.pixels(largest, nearest) * 1.002 >= min_pixels && self.sees(center, radius + slack, 0.0)
    }

    /// Pixels across a ball at that distance.
    pub(crate) fn pixels(&self, radius: f64, distance: f64) -> f64 {
        let focal = self.intrinsics.fx.max(self.intrinsics.fy);
        match self.projection {
            Projection::Pinhole => 2.0 * radius * focal / distance.max(1e-9),
            Projection::Parallel => 2.0 * radius * focal,
        }
    }

    /// Whether a ball of the optical frame touches what lies between the four sides.
    fn is_between(&self, center: &Vector3, radius: f64) -> bool {
        self.sides.iter().all(|(normal, inside)| normal.dot(center) + inside >= -radius)
    }

    /// A box around everything on the picture as far as `far`.
    pub(crate) fn region(&self) -> Aabb {
        let reach = Aabb::around(self.eye, Vector3::repeat(self.far));
        if self.all_round {
            return reach;
        }
        let k = &self.intrinsics;
        let (width, height) = (f64::from(k.width), f64::from(k.height));
        let mut region = Aabb::around(self.eye, Vector3::zeros());
        for (u, v) in [(0.0, 0.0), (width, 0.0), (0.0, height), (width, height)] {
            // Parallel rays do not spread: their corners at the eye and at the far end are all there is.
            let depths = match self.projection {
                Projection::Pinhole => [self.far; 2],
                Projection::Parallel => [0.0, self.far],
            };
            for depth in depths {
                let corner = match self.projection {
                    Projection::Pinhole => k.unproject(&Point2::new(u, v), depth),
                    Projection::Parallel => Point3::new((u - k.cx) / k.fx, (v - k.cy) / k.fy, depth),
                };
                let corner = self.eye + self.optical_from_world.transpose() * corner.coords;
                region = region.union(&Aabb { min: corner, max: corner });
            }
        }
        Aabb { min: region.min.sup(&reach.min), max: region.max.inf(&reach.max) }
    }
}

/// How far beside what is seen a ball may be, m, that a [`Sieve`](crate::sieve::Sieve) lets through: one of those in a ball of that radius, so far away.
pub(crate) fn slack(distance: f64, radius: f64) -> f64 {
    0.25 + 1e-3 * (distance + 2.0 * radius)
}

fn check(camera: &Camera, limit: u32) -> Result<(), RenderError> {
    let Camera { world_from_optical: pose, intrinsics: k } = camera;
    if !(1..=limit).contains(&k.width) || !(1..=limit).contains(&k.height) {
        return Err(RenderError::Size { width: k.width, height: k.height, limit });
    }
    let [x, y, z] = [pose.translation.x, pose.translation.y, pose.translation.z];
    let turn = pose.rotation.quaternion().norm();
    let checks = [
        ("fx", k.fx, 1e-3, 1e9, "0.001 to 1e9 pixels"),
        ("fy", k.fy, 1e-3, 1e9, "0.001 to 1e9 pixels"),
        ("cx", k.cx, -1e6, 1e6, "pixels within ±1e6"),
        ("cy", k.cy, -1e6, 1e6, "pixels within ±1e6"),
        ("position x", x, -1.3e7, 1.3e7, "metres within ±1.3e7"),
        ("position y", y, -1.3e7, 1.3e7, "metres within ±1.3e7"),
        ("position z", z, -1.3e7, 1.3e7, "metres within ±1.3e7"),
        ("rotation norm", turn, 0.999, 1.001, "a unit quaternion"),
    ];
    for (field, value, low, high, allowed) in checks {
        if !(low..=high).contains(&value) {
            return Err(RenderError::Camera { field, value, allowed });
        }
    }
    Ok(())
}

/// The entries of a matrix as the shaders read them, column by column.
pub(crate) fn columns(matrix: &Matrix4<f64>) -> [[f32; 4]; 4] {
    std::array::from_fn(|column| std::array::from_fn(|row| matrix[(row, column)] as f32))
}

/// A vector and a fourth number as the shaders read them.
pub(crate) fn vec4(vector: &Vector3, w: f64) -> [f32; 4] {
    [vector.x as f32, vector.y as f32, vector.z as f32, w as f32]
}

#[cfg(test)]
mod tests {
    use simworld_core::geometry::{Pose, pose_facing};

    use super::*;

    fn view(pose: &Pose) -> View {
        let intrinsics = Intrinsics { width: 200, height: 100, fx: 90.0, fy: 80.0, cx: 30.0, cy: 70.0 };
        View::new(&Camera::looking_along(pose, intrinsics), 0.1, 500.0, 4096).unwrap()
    }

    #[test]
    fn clip_space_agrees_with_the_pinhole() {
        let view = view(&pose_facing(Point3::new(10.0, -4.0, 2.0), 0.7));
        let relative = Vector3::new(8.0, 6.0, 0.5);
        let clip = view.clip_from_relative() * relative.push(1.0);
        let optical = view.optical_from_world * relative;
        let (pixel, depth) = view.intrinsics.project(&optical.into()).unwrap();
        let (u, v) = ((clip.x / clip.w + 1.0) * 100.0, (1.0 - clip.y / clip.w) * 50.0);
        assert!((u - pixel.x).abs() < 1e-9 && (v - pixel.y).abs() < 1e-9, "{u} {v} {pixel}");
        assert!((clip.w - depth).abs() < 1e-12 && (clip.z - 0.1).abs() < 1e-12);
    }

    #[test]
    fn what_projects_into_the_picture_is_never_culled() {
        let view = view(&pose_facing(Point3::new(1.0, 2.0, 3.0), -2.1));
        let region = view.region();
        for (u, v, depth) in [(0.5, 0.5, 3.0), (199.0, 1.0, 80.0), (100.0, 99.0, 300.0), (0.1, 60.0, 0.2)] {
            let optical = view.intrinsics.unproject(&Point2::new(u, v), depth);
            let relative = view.optical_from_world.transpose() * optical.coords;
            assert!(view.sees(&relative, 1e-6, 0.0), "{u} {v} {depth}");
            assert!(region.contains(&(view.eye + relative)), "{u} {v} {depth}");
        }
        assert!(!view.sees(&(-view.forward() * 10.0), 1.0, 0.0), "behind the camera");
        assert!(!view.sees(&(view.forward() * 600.0), 1.0, 0.0), "beyond far");
        assert!(!view.sees(&(view.forward() * 400.0), 0.05, 0.5), "too small");
    }
}
