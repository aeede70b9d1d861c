//! Where the sun's shadow map lies: an orthographic view along the sunlight, around what is near the camera.

use nalgebra::{Matrix3, Matrix4};
use simworld_core::geometry::{Aabb, Vector3};

use crate::view::View;

/// How far towards the sun something may stand and still throw its shadow into the map, m.
const CASTER_DISTANCE: f64 = 300.0;
/// Below this height of the sun (sine of elevation) shadows are as long as streets, and are left out.
const LEAST_HEIGHT: f64 = 0.03;

/// The view of the sun.
#[derive(Clone, Debug)]
pub(crate) struct ShadowView {
    /// Light frame from world, rotation only: x and y across, z from the sun downwards.
    light_from_world: Matrix3<f64>,
    /// Middle of the map, relative to the eye.
    center: Vector3,
    radius: f64,
    towards_sun: Vector3,
    eye: simworld_core::geometry::Point3,
    /// Size of a texel, m.
    pub texel: f64,
}

impl ShadowView {
    /// The map for a view, or none if the sun is too low.
    pub(crate) fn new(view: &View, towards_sun: &Vector3, distance: f64, resolution: u32) -> Option<Self> {
        if resolution == 0 || towards_sun.z < LEAST_HEIGHT {
            return None;
        }
        let z = -towards_sun;
        let helper = if z.z.abs() > 0.99 { Vector3::y() } else { Vector3::z() };
        let x = helper.cross(&z).normalize();
        let y = z.cross(&x);
        let light_from_world = Matrix3::from_rows(&[x.transpose(), y.transpose(), z.transpose()]);
        let radius = distance * 0.6;
        let texel = 2.0 * radius / f64::from(resolution);
        let ahead = view.forward();
        // Snapped to whole texels of the world, so that shadows do not crawl as the camera moves.
        let wanted = light_from_world * (view.eye.coords + ahead * (distance * 0.5));
        let snapped = wanted.map(|coordinate| (coordinate / texel).round() * texel);
        let center = light_from_world.transpose() * snapped - view.eye.coords;
        Some(Self { light_from_world, center, radius, towards_sun: *towards_sun, eye: view.eye, texel })
    }

    /// Clip space of the map from camera-relative world axes: z 0 at the sun's side, 1 below.
    pub(crate) fn clip_from_relative(&self) -> Matrix4<f64> {
        let depth = CASTER_DISTANCE + 2.0 * self.radius;
        let scale = Vector3::new(1.0 / self.radius, 1.0 / self.radius, 1.0 / depth);
        let start = (CASTER_DISTANCE + self.radius) / depth;
        let rotation = Matrix3::from_diagonal(&scale) * self.light_from_world;
        let shift = -(rotation * self.center) + Vector3::new(0.0, 0.0, start);
        let mut clip = rotation.to_homogeneous();
        clip.fixed_view_mut::<3, 1>(0, 3).copy_from(&shift);
        clip
    }

    /// Whether a ball may throw its shadow into the map; its centre is relative to the eye.
    pub(crate) fn reaches(&self, center: &Vector3, radius: f64) -> bool {
        let local = self.light_from_world * (center - self.center);
        let across = self.radius + radius;
        local.x.abs() <= across && local.y.abs() <= across && local.z <= self.radius + radius
    }

    /// A box around everything that may throw its shadow into the map.
    pub(crate) fn region(&self) -> Aabb {
        // Corners of the square map lie farther out than its radius.
        let reach = Vector3::repeat(self.radius * 1.75);
        let near = Aabb::around(self.eye + self.center, reach);
        near.union(&Aabb::around(self.eye + self.center + self.towards_sun * CASTER_DISTANCE, reach))
    }
}
