//! Where the sun's shadow map lies: an orthographic view along the sunlight, around what is near the camera.

use nalgebra::{Matrix3, Matrix4};
use simworld_core::geometry::{Aabb, Point3, Vector3};

use crate::view::View;

/// How far towards the sun something may stand and still throw its shadow into the map, m.
const CASTER_DISTANCE: f64 = 300.0;
/// Below this height of the sun (sine of elevation) shadows are as long as streets, and are left out.
const LEAST_HEIGHT: f64 = 0.03;

/// Maps lie on a grid of this share of their side, so that they stay where they are while a camera moves a little.
const STEPS: f64 = 16.0;

/// Which map it is: where it lies in steps of its grid, and the bits of the direction to the sun and of the size of its texels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct ShadowKey([i64; 3], [u64; 4]);

/// The view of the sun.
#[derive(Clone, Debug)]
pub(crate) struct ShadowView {
    pub key: ShadowKey,
    /// Light frame from world, rotation only: x and y across, z from the sun downwards.
    light_from_world: Matrix3<f64>,
    /// Middle of the map in the world.
    pub center: Point3,
    radius: f64,
    towards_sun: Vector3,
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
        // Snapped to many whole texels of the world: shadows do not crawl as the camera moves, and the map is kept.
        let step = texel * (f64::from(resolution) / STEPS).round();
        let wanted = light_from_world * (view.eye.coords + ahead * (distance * 0.5));
        let steps = wanted.map(|coordinate| (coordinate / step).round());
        let center = (light_from_world.transpose() * (steps * step)).into();
        let bits = [towards_sun.x, towards_sun.y, towards_sun.z, texel].map(f64::to_bits);
        let key = ShadowKey(steps.map(|count| count as i64).into(), bits);
        Some(Self { key, light_from_world, center, radius, towards_sun: *towards_sun, texel })
    }

    /// Clip space of the map from world axes relative to an eye: z 0 at the sun's side, 1 below.
    pub(crate) fn clip_from_relative(&self, eye: &Point3) -> Matrix4<f64> {
        let depth = CASTER_DISTANCE + 2.0 * self.radius;
        let scale = Vector3::new(1.0 / self.radius, 1.0 / self.radius, 1.0 / depth);
        let start = (CASTER_DISTANCE + self.radius) / depth;
        let rotation = Matrix3::from_diagonal(&scale) * self.light_from_world;
        let shift = -(rotation * (self.center - eye)) + Vector3::new(0.0, 0.0, start);
        let mut clip = rotation.to_homogeneous();
        clip.fixed_view_mut::<3, 1>(0, 3).copy_from(&shift);
        clip
    }

    /// Inward normals of the sides beyond which nothing throws its shadow into the map, in the world, and how far inside of each its middle is, m.
    pub(crate) fn sides(&self) -> [(Vector3, f64); 5] {
        let axis = |row: usize| -> Vector3 { self.light_from_world.row(row).transpose() };
        let (x, y, z) = (axis(0), axis(1), axis(2));
        [x, -x, y, -y, -z].map(|normal| (normal, self.radius))
    }

    /// Whether a ball may throw its shadow into the map; its centre is in the world.
    pub(crate) fn reaches(&self, center: &Point3, radius: f64) -> bool {
        let local = self.light_from_world * (center - self.center);
        let across = self.radius + radius;
        local.x.abs() <= across && local.y.abs() <= across && local.z <= self.radius + radius
    }

    /// A box around everything that may throw its shadow into the map.
    pub(crate) fn region(&self) -> Aabb {
        // Corners of the square map lie farther out than its radius.
        let reach = Vector3::repeat(self.radius * 1.75);
        let near = Aabb::around(self.center, reach);
        near.union(&Aabb::around(self.center + self.towards_sun * CASTER_DISTANCE, reach))
    }
}
