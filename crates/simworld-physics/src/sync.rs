//! Keeping the engine's colliders in step with the world's entities, by what changed.
//!
//! One pass over the slots a step compares each entity with what the engine has of it; only a difference costs
//! anything more. The pass sees removals, moves by command, and things picked up, whichever way they came about.

use rapier3d_f64::prelude::{ColliderHandle, RigidBodyHandle};
use serde::{Deserialize, Serialize};
use simworld_core::geometry::{Pose, Twist, planar};
use simworld_core::id::{AssetId, EntityId};
use simworld_core::scene::{EntityRef, Role, Scene, Shape, World};
use simworld_core::seam::BodyState;

use crate::body::Bonds;
use crate::convert::to_pose;
use crate::dynamics::PhysicsDynamics;
use crate::mirror::Mirror;
use crate::shape::body_from;

/// What the physics makes of a slot of the world.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(crate) enum Slot {
    /// Nothing: a free slot, or something that is not solid or is carried.
    #[default]
    Vacant,
    /// A fixed collider.
    Fixed { id: EntityId, asset: Option<AssetId>, shape: Shape, pose: Pose, collider: ColliderHandle },
    /// Something that others move.
    Traffic(Mirror),
    /// A body of this physics.
    Own { id: EntityId },
}

impl PhysicsDynamics {
    /// Brings the engine up to date with the world as it stands at the start of a step.
    pub(crate) fn synchronise(&mut self, world: &World) {
        self.lay_ground(world.ground());
        self.drop_orphans(world);
        self.near.clear();
        for owned in &mut self.bodies {
            owned.bonds = Bonds::default();
            if let Some(entity) = world.entity(owned.id) {
                let here = planar(entity.pose);
                self.near.insert(here, here);
                owned.bonds.carried = entity.attachment.map(|bond| bond.role);
            }
        }
        self.moving.clear();
        if self.slots.len() < world.slots() {
            self.slots.resize_with(world.slots(), Slot::default);
        }
        let mut next = 0;
        for entity in world.iter() {
            let slot = entity.id.index();
            (next..slot).for_each(|vacant| self.vacate(vacant));
            next = slot + 1;
            self.synchronise_slot(slot, &entity, world);
        }
        (next..self.slots.len()).for_each(|vacant| self.vacate(vacant));
        self.follow_world(world);
    }

    /// Takes the bodies of removed entities out of the engine.
    fn drop_orphans(&mut self, world: &World) {
        let (physics, slots) = (&mut self.physics, &mut self.slots);
        self.bodies.retain_mut(|owned| {
            let lives = world.entity(owned.id).is_some();
            if !lives {
                owned.body.gather(physics, owned.rigid);
                physics.remove_body(owned.rigid);
                slots[owned.id.index()] = Slot::Vacant;
            }
            lives
        });
    }

    fn synchronise_slot(&mut self, slot: usize, entity: &EntityRef<'_>, world: &World) {
        if let Some(bond) = entity.attachment {
            if bond.role == Role::Ridden
                && let Ok(rider) = self.position(bond.parent)
            {
                self.bodies[rider].bonds.scooter = Some(entity.id);
            }
            self.vacate(slot);
            return;
        }
        match &self.slots[slot] {
            Slot::Own { .. } => {}
            _ if !entity.is_solid() => self.vacate(slot),
            // What somebody moves, such as a lift, carries who stands on it.
            _ if entity.kind.is_mobile() || *entity.twist != Twist::ZERO => {
                self.synchronise_mirror(slot, entity, world);
            }
            Slot::Fixed { id, asset, shape, pose, .. }
                if *id == entity.id
                    && *asset == entity.info.asset
                    && pose == entity.pose
                    && *shape == entity.info.shape => {}
            _ => self.fix(slot, entity, world),
        }
    }

    /// Makes a solid thing a fixed collider, in the place of what was in the slot.
    fn fix(&mut self, slot: usize, entity: &EntityRef<'_>, world: &World) {
        self.vacate(slot);
        let collider = self.solids.collider(entity, world);
        let world_from_solid = to_pose(entity.pose) * collider.position;
        let collider = collider.position(world_from_solid);
        let collider = self.physics.insert_collider(collider, None);
        self.file(collider);
        let (id, asset, shape, pose) = (entity.id, entity.info.asset, entity.info.shape, *entity.pose);
        self.slots[slot] = Slot::Fixed { id, asset, shape, pose, collider };
    }

    /// Takes out of the engine what others than the bodies have in a slot.
    pub(crate) fn vacate(&mut self, slot: usize) {
        match &self.slots[slot] {
            Slot::Vacant | Slot::Own { .. } => return,
            Slot::Fixed { collider, .. } => {
                self.physics.remove_collider(*collider);
            }
            Slot::Traffic(mirror) => {
                if let Some(rigid) = mirror.rigid {
                    self.physics.remove_body(rigid);
                }
            }
        }
        self.slots[slot] = Slot::Vacant;
    }

    /// Lets bodies follow what was done to them in the world: moves by command, seats taken and left.
    fn follow_world(&mut self, world: &World) {
        for index in 0..self.bodies.len() {
            let owned = &self.bodies[index];
            let Some(entity) = world.entity(owned.id) else { continue };
            let is_carried = owned.bonds.carried.is_some();
            let was_carried = !self.is_solid(owned.rigid);
            if is_carried != was_carried {
                let rigid = owned.rigid;
                self.bodies[index].body.gather(&mut self.physics, rigid);
                self.set_solid(rigid, !is_carried);
            }
            if *entity.pose != self.bodies[index].written {
                self.place(index, &BodyState { pose: *entity.pose, twist: *entity.twist });
                // A tilted pose is righted by some bodies; what the world says is what was seen.
                self.bodies[index].written = *entity.pose;
            }
        }
    }

    fn is_solid(&self, rigid: RigidBodyHandle) -> bool {
        self.physics.bodies[rigid].is_enabled()
    }

    /// A body on a seat is out of the engine for as long as it sits.
    fn set_solid(&mut self, rigid: RigidBodyHandle, solid: bool) {
        self.physics.bodies[rigid].set_enabled(solid);
        for handle in self.physics.bodies[rigid].colliders().to_vec() {
            if let Some(collider) = self.physics.colliders.get_mut(handle) {
                collider.set_enabled(solid);
            }
        }
        if solid {
            self.file_body(rigid);
        }
    }

    /// Lets queries see a new or displaced collider before the engine's next step.
    pub(crate) fn file(&mut self, handle: ColliderHandle) {
        if let Some(collider) = self.physics.colliders.get(handle).filter(|collider| collider.is_enabled()) {
            let parameters = &self.physics.integration_parameters;
            self.physics.broad_phase.set_aabb(parameters, handle, collider.compute_aabb());
        }
    }

    /// Lets queries see a new or displaced body before the engine's next step.
    pub(crate) fn file_body(&mut self, rigid: RigidBodyHandle) {
        let pose = *self.physics.bodies[rigid].position();
        for handle in self.physics.bodies[rigid].colliders().to_vec() {
            if let Some(collider) = self.physics.colliders.get_mut(handle) {
                collider.set_position(pose * body_from(collider));
            }
            self.file(handle);
        }
    }
}
