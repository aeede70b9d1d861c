//! Reading the store: the seams `Scene` and `RayCast`.

use std::ops::ControlFlow;
use std::sync::Arc;

use super::{Mark, World};
use crate::asset::Catalogue;
use crate::clock::Clock;
use crate::environment::Environment;
use crate::geometry::{Aabb, Ray};
use crate::ground::Ground;
use crate::id::EntityId;
use crate::limbs::JointAngles;
use crate::links::{KeptLinks, Links};
use crate::net::{Aspect, RoadNetwork};
use crate::scene::{ClassIndex, EntityRef, NameIndex, RayCast, RayHit, Scene, Stride};
use crate::traffic::RoadLeg;

/// So many boxes are asked for together.
const TOGETHER: usize = 64;

impl World {
    /// Visits what touches the region and may be at least `min_extent` m wide: the level of detail of a distant
    /// view, found without looking at the small things.
    pub fn visit_coarse(
        &self,
        region: &Aabb,
        min_extent: f64,
        visitor: &mut dyn FnMut(EntityRef<'_>) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        let mut some = [0; TOGETHER];
        let mut count = 0;
        self.tree.visit(region, min_extent, &mut |slot| {
            some[count] = slot;
            count += 1;
            if count == TOGETHER {
                self.visit_near(&mut some[..std::mem::take(&mut count)], region, visitor)
            } else {
                ControlFlow::Continue(())
            }
        })?;
        self.visit_near(&mut some[..count], region, visitor)
    }

    /// Visits those of some slots that touch the region. Nothing hangs on what the boxes are until all were asked for, so that
    /// their memory is waited for together.
    fn visit_near(
        &self,
        some: &mut [u32],
        region: &Aabb,
        visitor: &mut dyn FnMut(EntityRef<'_>) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        let mut near = 0;
        for at in 0..some.len() {
            let slot = some[at];
            some[near] = slot;
            near += usize::from(meets(&self.heads[slot as usize].bounds, region));
        }
        some[..near].iter().filter_map(|slot| self.in_slot(*slot as usize)).try_for_each(visitor)
    }
}

/// Whether two boxes touch.
#[allow(
    clippy::needless_bitwise_bool,
    reason = "a branch would wait for the memory of one box before it asks for the next"
)]
fn meets(one: &Aabb, other: &Aabb) -> bool {
    let along = |axis: usize| (one.min[axis] <= other.max[axis]) & (other.min[axis] <= one.max[axis]);
    along(0) & along(1) & along(2)
}

impl Scene for World {
    fn entity(&self, id: EntityId) -> Option<EntityRef<'_>> {
        if self.is_alive(id) { self.in_slot(id.index()) } else { None }
    }

    fn visit(
        &self,
        region: &Aabb,
        visitor: &mut dyn FnMut(EntityRef<'_>) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        self.visit_coarse(region, 0.0, visitor)
    }

    fn environment(&self) -> &Environment {
        &self.environment
    }

    fn clock(&self) -> Clock {
        self.clock
    }

    fn roads(&self) -> Option<&Arc<RoadNetwork>> {
        self.roads.as_ref()
    }

    fn ground(&self) -> Option<&Arc<Ground>> {
        self.ground.as_ref()
    }

    fn assets(&self) -> Option<&Arc<Catalogue>> {
        Some(&self.assets)
    }

    fn signals(&self) -> &[Aspect] {
        &self.signals
    }

    fn is_closed(&self, leg: RoadLeg) -> bool {
        self.closed.contains(&leg)
    }

    fn joints(&self, id: EntityId) -> Option<&JointAngles> {
        self.joints.get(&id)
    }

    fn links(&self, id: EntityId) -> Option<Links<'_>> {
        self.links.get(&id).map(KeptLinks::view)
    }

    fn stride(&self, id: EntityId) -> Option<&Stride> {
        self.strides.get(&id)?.as_ref()
    }

    fn names(&self) -> Option<&NameIndex> {
        Some(&self.names)
    }

    fn classes(&self) -> Option<&ClassIndex> {
        Some(&self.classes)
    }

    fn mark(&self) -> Option<Mark> {
        Some(Self::mark(self))
    }

    fn visit_changes(&self, since: Mark, visitor: &mut dyn FnMut(usize, Option<EntityRef<'_>>)) -> bool {
        let Some(changed) = self.changed_since(since) else { return false };
        changed.for_each(|slot| visitor(slot, self.slot(slot)));
        true
    }

    fn visit_attached(&self, parent: EntityId, visitor: &mut dyn FnMut(EntityRef<'_>)) {
        for slot in &self.bonded {
            if self.heads[*slot as usize].bond.as_ref().is_some_and(|bond| bond.parent == parent)
                && let Some(entity) = self.in_slot(*slot as usize)
            {
                visitor(entity);
            }
        }
    }
}

impl RayCast for World {
    /// Meets the oriented boxes around the solids; exact for boxes, from outside for round shapes.
    fn cast_ray(&self, ray: &Ray, max_distance: f64, filter: &dyn Fn(EntityId) -> bool) -> Option<RayHit> {
        let swept = Aabb::new(ray.origin, ray.at(max_distance));
        let mut best: Option<RayHit> = None;
        let _ = self.visit(&swept, &mut |entity| {
            if entity.is_solid() && filter(entity.id) {
                let hit = crate::scene::ray::meet_box(ray, &entity.obb())
                    .filter(|(distance, _)| *distance <= max_distance);
                if let Some((distance, normal)) = hit {
                    let hit = RayHit { entity: entity.id, distance, normal };
                    if best.is_none_or(|b| (distance, entity.id) < (b.distance, b.entity)) {
                        best = Some(hit);
                    }
                }
            }
            ControlFlow::Continue(())
        });
        best
    }
}
