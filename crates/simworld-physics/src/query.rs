//! Questions to the physics: what does a ray meet, what lies within a shape.

use parry3d_f64::query::{Ray as RapierRay, intersection_test};
use rapier3d_f64::prelude::{Collider, ColliderHandle, QueryFilter, SharedShape};
use simworld_core::geometry::{Aabb, Pose, Ray, Vector3};
use simworld_core::id::EntityId;
use simworld_core::scene::{RayCast, RayHit, Shape};

use crate::convert::{from_vector, to_point, to_pose, to_vector};
use crate::dynamics::PhysicsDynamics;
use crate::mirror::Mirror;
use crate::shape::{BodyTag, shape_from};
use crate::sync::Slot;

impl PhysicsDynamics {
    /// Everything solid that shares a point with a shape at a pose, by ascending id; the ground is not meant.
    ///
    /// It answers with the state after the last step.
    pub fn overlapping(&self, shape: &Shape, pose: &Pose, out: &mut Vec<EntityId>) {
        out.clear();
        let (solid, body_from_solid) = shape_from(shape);
        let world_from_solid = to_pose(pose) * body_from_solid;
        let found = self.physics.intersect_shape(world_from_solid, &*solid, QueryFilter::new());
        out.extend(found.filter_map(|(_, met)| BodyTag::from_user_data(met.user_data).entity()));
        let bounds = shape.aabb(pose);
        for mirror in self.distant().filter(|mirror| mirror.bounds().intersects(&bounds)) {
            let (other, place) = mirror.solid();
            let world_from_other = to_pose(&mirror.pose) * place;
            if intersection_test(&world_from_solid, &*solid, &world_from_other, &*other)
                .is_ok_and(|test| test.intersecting)
            {
                out.push(mirror.id);
            }
        }
        self.away_overlapping(shape, pose, out);
        let near = solid.compute_aabb(&world_from_solid);
        for roamer in self.roamers_in(&near) {
            if intersection_test(&world_from_solid, &*solid, &roamer.pose, &*roamer.solid)
                .is_ok_and(|test| test.intersecting)
            {
                out.push(roamer.id);
            }
        }
        out.sort_unstable();
        out.dedup();
    }

    /// Traffic that is too far from every body to have a collider.
    fn distant(&self) -> impl Iterator<Item = &Mirror> {
        self.traffic.iter().filter_map(|slot| match &self.slots[slot] {
            Slot::Traffic(mirror) if mirror.rigid.is_none() => Some(mirror),
            _ => None,
        })
    }

    /// The first distant traffic, or body that roams, on the ray.
    fn cast_at_distant(
        &self,
        ray: &Ray,
        max_distance: f64,
        filter: &dyn Fn(EntityId) -> bool,
    ) -> Option<RayHit> {
        let line = RapierRay::new(to_point(&ray.origin), to_vector(&ray.direction));
        let swept = Aabb::new(ray.origin, ray.at(max_distance));
        let roaming = self.cast_at_roamers(&line, max_distance, filter);
        let mut best = roaming.map(|(entity, distance, normal)| RayHit { entity, distance, normal });
        for mirror in self.distant().filter(|mirror| mirror.bounds().intersects(&swept)) {
            let reach = best.map_or(max_distance, |hit| hit.distance);
            let (solid, place) = mirror.solid();
            let pose = to_pose(&mirror.pose) * place;
            if let Some(hit) = solid.cast_ray_and_get_normal(&pose, &line, reach, true)
                && best.is_none_or(|best| hit.time_of_impact < best.distance)
                && filter(mirror.id)
            {
                let (entity, distance) = (mirror.id, hit.time_of_impact);
                best = Some(RayHit { entity, distance, normal: from_vector(hit.normal) });
            }
        }
        best
    }
}

impl Mirror {
    fn solid(&self) -> (SharedShape, rapier3d_f64::math::Pose) {
        shape_from(&self.shape)
    }

    fn bounds(&self) -> Aabb {
        self.shape.aabb(&self.pose)
    }
}

impl RayCast for PhysicsDynamics {
    /// Meets the exact solids of all entities as of the last step; the ground does not stop a ray.
    ///
    /// From inside a solid the distance is zero and the normal points against the ray.
    fn cast_ray(&self, ray: &Ray, max_distance: f64, filter: &dyn Fn(EntityId) -> bool) -> Option<RayHit> {
        let wanted = |_: ColliderHandle, collider: &Collider| {
            BodyTag::from_user_data(collider.user_data).entity().is_some_and(filter)
        };
        let line = RapierRay::new(to_point(&ray.origin), to_vector(&ray.direction));
        let near = self
            .physics
            .cast_ray_and_get_normal(&line, max_distance, true, QueryFilter::new().predicate(&wanted))
            .and_then(|(handle, hit)| {
                let entity = BodyTag::from_user_data(self.physics.colliders[handle].user_data).entity()?;
                Some(RayHit { entity, distance: hit.time_of_impact, normal: from_vector(hit.normal) })
            });
        let reach = near.map_or(max_distance, |hit| hit.distance);
        let near = self.cast_at_away(ray, reach, filter).or(near);
        let reach = near.map_or(max_distance, |hit| hit.distance);
        let first = self.cast_at_distant(ray, reach, filter).or(near)?;
        let inside = first.normal == Vector3::zeros();
        Some(RayHit { normal: if inside { -ray.direction } else { first.normal }, ..first })
    }
}
