//! Keeping the engine's colliders in step with the world's entities, by what changed.
//!
//! A step compares what changed in the world since the last one, and the first one everything, with what the engine has of it; only a
//! difference costs anything more. It sees removals, moves by command, and things picked up, whichever way they came about.

use rapier3d_f64::prelude::{ColliderHandle, RigidBodyHandle};
use serde::{Deserialize, Serialize};
use simworld_core::geometry::{Pose, Twist};
use simworld_core::id::{AssetId, EntityId};
use simworld_core::scene::{EntityRef, Role, Scene, Shape, World};
use simworld_core::seam::BodyState;

use crate::body::Bonds;
use crate::dynamics::PhysicsDynamics;
use crate::mirror::Mirror;
use crate::rigid::mass_of;
use crate::shape::body_from;
use crate::slot_set::SlotSet;

/// What the physics makes of a slot of the world.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(crate) enum Slot {
    /// Nothing: a free slot, or something that is not solid or is carried.
    #[default]
    Vacant,
    /// A fixed solid, with its collider while it is in the engine.
    Fixed { id: EntityId, asset: Option<AssetId>, shape: Shape, pose: Pose, collider: Option<ColliderHandle> },
    /// Something that others move.
    Traffic(Mirror),
    /// A body of this physics.
    Own { id: EntityId },
}

/// What ties an entity to others, for a body that does not know it yet: of several scooters the last by slot.
pub(crate) fn bonds_of(id: EntityId, world: &World) -> Bonds {
    let mut bonds = Bonds::default();
    world.visit_attached(id, &mut |child| {
        if child.attachment.is_some_and(|bond| bond.role == Role::Ridden) {
            bonds.scooter = Some(child.id);
        }
    });
    bonds
}

/// Whether somebody rides a scooter.
fn rides(world: &World, rider: EntityId, scooter: EntityId) -> bool {
    let bond = world.entity(scooter).and_then(|entity| entity.attachment.copied());
    bond.is_some_and(|bond| bond.role == Role::Ridden && bond.parent == rider)
}

impl PhysicsDynamics {
    /// Brings the engine up to date with the world as it stands at the start of a step.
    pub(crate) fn synchronise(&mut self, world: &World) {
        self.lay_ground(world.ground());
        self.near_is_known = false;
        self.look_at_bodies(world);
        self.weigh_loads(world);
        self.moving.clear();
        self.stream(world);
        if self.slots.len() < world.slots() {
            self.slots.resize_with(world.slots(), Slot::default);
        }
        let mut stale = self.stale(world);
        for slot in stale.iter() {
            match world.slot(slot) {
                Some(entity) => self.synchronise_slot(slot, &entity, world),
                None => self.vacate(slot),
            }
        }
        stale.clear();
        self.stale = stale;
        self.seen = Some(world.mark());
        self.follow_world(world);
    }

    /// The slots of which the engine may have something else than the world: what changed, traffic, of which it has only what is near
    /// its bodies, and what was left by bodies that were taken away.
    fn stale(&mut self, world: &World) -> SlotSet {
        let mut stale = std::mem::take(&mut self.stale);
        match self.seen.and_then(|mark| world.touched_since(mark)) {
            // Most of what changes are bodies that the physics moved itself, and those were looked at one by one.
            Some(touched) => touched
                .filter(|slot| !matches!(self.slots.get(*slot), Some(Slot::Own { .. })))
                .for_each(|slot| stale.insert(slot)),
            None => (0..self.slots.len()).for_each(|slot| stale.insert(slot)),
        }
        stale.unite(&self.traffic);
        stale
    }

    /// Notes what the engine has of a slot.
    pub(crate) fn set_slot(&mut self, slot: usize, value: Slot) {
        if matches!(value, Slot::Traffic(_)) {
            self.traffic.insert(slot);
        } else {
            self.traffic.remove(slot);
        }
        self.slots[slot] = value;
    }

    /// Takes the bodies of removed entities out of the engine, and notes what was done to the others in the world.
    fn look_at_bodies(&mut self, world: &World) {
        let (physics, slots, stale, displaced) =
            (&mut self.physics, &mut self.slots, &mut self.stale, &mut self.displaced);
        let roster = &mut self.roster;
        let is_first = self.seen.is_none();
        let mut place = 0;
        displaced.clear();
        self.bodies.retain_mut(|owned| {
            let Some(entity) = world.entity(owned.id) else {
                owned.body.gather(physics, owned.rigid);
                physics.remove_body(owned.rigid);
                slots[owned.id.index()] = Slot::Vacant;
                stale.insert(owned.id.index());
                roster.is_stale = true;
                return false;
            };
            if owned.bonds.scooter.is_some_and(|scooter| !rides(world, owned.id, scooter)) {
                owned.bonds = bonds_of(owned.id, world);
            }
            owned.bonds.load = 0.0;
            let before = owned.bonds.carried;
            owned.bonds.carried = entity.attachment.map(|bond| bond.role);
            if owned.bonds.carried.is_some() {
                stale.insert(owned.id.index());
            }
            let is_tied = before.is_some() || owned.bonds.carried.is_some();
            if is_first || is_tied || *entity.pose != owned.written {
                displaced.push(place);
            }
            place += 1;
            true
        });
    }

    /// Tells bodies what the things weigh that they have in the hand or in both arms.
    fn weigh_loads(&mut self, world: &World) {
        for thing in world.bonded() {
            let bond = thing.attachment.filter(|bond| matches!(bond.role, Role::Held | Role::Carried));
            if let Some(place) = bond.and_then(|bond| self.position(bond.parent).ok()) {
                self.bodies[place].bonds.load += mass_of(&thing);
            }
        }
    }

    fn synchronise_slot(&mut self, slot: usize, entity: &EntityRef<'_>, world: &World) {
        if let Some(bond) = entity.attachment {
            if bond.role == Role::Ridden
                && let Ok(rider) = self.position(bond.parent)
            {
                let scooter = &mut self.bodies[rider].bonds.scooter;
                // Of several the last by slot, whichever was touched.
                let last = scooter.filter(|other| other.index() > slot);
                *scooter = last.or(Some(entity.id));
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

    /// Makes a solid thing a fixed one, in the place of what was in the slot: a collider, unless it is far from where solids are wanted.
    fn fix(&mut self, slot: usize, entity: &EntityRef<'_>, world: &World) {
        self.vacate(slot);
        let mut is_wanted = true;
        if self.districts.is_some() {
            let (bounds, model) = (entity.info.shape.aabb(entity.pose), self.solids.of(entity, world));
            if let Some(districts) = &mut self.districts {
                districts.file(slot, &bounds, model);
                is_wanted = districts.holds(&bounds);
            }
        }
        let collider = is_wanted.then(|| self.harden(entity, world));
        let (id, asset, shape, pose) = (entity.id, entity.info.asset, entity.info.shape, *entity.pose);
        self.set_slot(slot, Slot::Fixed { id, asset, shape, pose, collider });
    }

    /// Takes out of the engine what others than the bodies have in a slot.
    pub(crate) fn vacate(&mut self, slot: usize) {
        match &self.slots[slot] {
            Slot::Vacant | Slot::Own { .. } => return,
            Slot::Fixed { shape, pose, collider, .. } => {
                if let Some(districts) = &mut self.districts {
                    districts.unfile(slot, &shape.aabb(pose));
                }
                if let Some(collider) = collider {
                    self.physics.remove_collider(*collider);
                }
            }
            Slot::Traffic(mirror) => {
                if let Some(rigid) = mirror.rigid {
                    self.physics.remove_body(rigid);
                }
            }
        }
        self.set_slot(slot, Slot::Vacant);
    }

    /// Lets bodies follow what was done to them in the world: moves by command, seats taken and left.
    fn follow_world(&mut self, world: &World) {
        let displaced = std::mem::take(&mut self.displaced);
        for index in displaced.iter().copied() {
            let owned = &self.bodies[index];
            let Some(entity) = world.entity(owned.id) else { continue };
            let is_carried = owned.bonds.carried.is_some();
            if is_carried && owned.is_roaming {
                self.take_back(index);
            }
            let owned = &self.bodies[index];
            let was_carried = !owned.is_roaming && !self.is_solid(owned.rigid);
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
        self.displaced = displaced;
    }

    fn is_solid(&self, rigid: RigidBodyHandle) -> bool {
        self.physics.bodies[rigid].is_enabled()
    }

    /// A body on a seat is out of the engine for as long as it sits, and one that roams while it does.
    pub(crate) fn set_solid(&mut self, rigid: RigidBodyHandle, solid: bool) {
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
