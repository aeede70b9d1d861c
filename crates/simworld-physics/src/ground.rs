//! The ground of a physics: level at z = 0 and wide, or the surface of its world as a height field.
//!
//! Parry's height fields have y up, rows along z and cut their cells from row to row: turned upright, with the rows from the
//! north, the cut is that of core's [`Ground`], so that a ray meets the very triangles that everybody else knows.

use std::sync::Arc;

use parry3d_f64::query::Ray as RapierRay;
use parry3d_f64::shape::HeightFieldFlags;
use parry3d_f64::utils::Array2;
use rapier3d_f64::math::{Pose as RapierPose, Vector};
use rapier3d_f64::prelude::{CoefficientCombineRule, Collider, ColliderBuilder, QueryFilter, SharedShape};
use simworld_core::geometry::{Point2, Ray};
use simworld_core::ground::{Ground, GroundData};
use simworld_core::hash::StateHash;

use crate::PhysicsConfig;
use crate::convert::{to_point, to_vector};
use crate::dynamics::PhysicsDynamics;
use crate::shape::{BodyTag, marked, upright};

/// Thickness of level ground, m: no body falls through it in a step.
const GROUND_THICKNESS: f64 = 100.0;

/// The collider of level ground.
pub(crate) fn level(config: &PhysicsConfig) -> Collider {
    let (reach, depth) = (config.ground_half_extent, GROUND_THICKNESS * 0.5);
    let below = RapierPose::from_translation(Vector::new(0.0, 0.0, -depth));
    made_of(ColliderBuilder::cuboid(reach, reach, depth).position(below), config).build()
}

/// The collider of a surface.
fn hilly(ground: &Ground, config: &PhysicsConfig) -> Collider {
    let GroundData { spacing, columns, rows, heights, .. } = ground.data();
    let (columns, rows) = (*columns as usize, *rows as usize);
    // Column by column, and in each from the north.
    let column = |column: usize| (0..rows).rev().map(move |row| f64::from(heights[row * columns + column]));
    let heights = Array2::new(rows, columns, (0..columns).flat_map(column).collect());
    let scale = Vector::new((columns - 1) as f64 * spacing, 1.0, (rows - 1) as f64 * spacing);
    let field = SharedShape::heightfield_with_flags(heights, scale, HeightFieldFlags::FIX_INTERNAL_EDGES);
    let (low, high) = ground.extent();
    let middle = (low.coords + high.coords) * 0.5;
    let pose = RapierPose::from_parts(Vector::new(middle.x, middle.y, 0.0), upright());
    made_of(ColliderBuilder::new(field).position(pose), config).build()
}

fn made_of(collider: ColliderBuilder, config: &PhysicsConfig) -> ColliderBuilder {
    collider
        .friction(config.ground.friction())
        .friction_combine_rule(CoefficientCombineRule::GeometricMean)
        .restitution(config.ground.restitution())
        .user_data(marked(BodyTag::Ground, config.ground))
}

impl PhysicsDynamics {
    /// Takes up the ground of the world if it is another one than before.
    pub(crate) fn lay_ground(&mut self, ground: Option<&Arc<Ground>>) {
        match (&self.surface, ground) {
            (None, None) => return,
            (Some(own), Some(new)) if Arc::ptr_eq(own, new) => return,
            (Some(own), Some(new)) if own == new => {
                self.surface = Some(Arc::clone(new));
                return;
            }
            _ => {}
        }
        self.physics.remove_collider(self.ground);
        let collider = ground.map_or_else(|| level(&self.config), |ground| hilly(ground, &self.config));
        self.ground = self.physics.insert_collider(collider, None);
        self.surface = ground.cloned();
        self.file(self.ground);
    }

    /// What tells one ground from another in a saved state.
    pub(crate) fn surface_digest(&self) -> Option<u64> {
        self.surface.as_ref().map(|ground| ground.digest().0)
    }

    /// How far along a ray the ground is, if the ray meets it within `max_distance` m: what bodies stand on as of the last
    /// step. Things on the ground are no hindrance.
    pub fn cast_at_ground(&self, ray: &Ray, max_distance: f64) -> Option<f64> {
        let is_ground =
            |_, collider: &Collider| BodyTag::from_user_data(collider.user_data) == BodyTag::Ground;
        let line = RapierRay::new(to_point(&ray.origin), to_vector(&ray.direction));
        let filter = QueryFilter::new().predicate(&is_ground);
        let (_, hit) = self.physics.cast_ray_and_get_normal(&line, max_distance, true, filter)?;
        Some(hit.time_of_impact)
    }
}

/// The height of a surface at a place, m; none beyond its edge, where bodies fall.
pub(crate) fn height_at(surface: &Ground, place: Point2) -> Option<f64> {
    surface.holds(place).then(|| surface.height(place))
}
