//! Saving and taking up the whole physics, bit for bit, and its hash.
//!
//! The saved form is a mark, a digest of the rest, and the rest: settings, the engine with its colliders, warm
//! starts and search tree, and the bodies. The digest turns away damaged bytes before anything is built from them.

use rapier3d_f64::prelude::{ColliderHandle, PhysicsWorld, RigidBodyHandle};
use serde::{Deserialize, Serialize};
use simworld_core::geometry::{Point3, Pose, Twist};
use simworld_core::hash::{StateHash, StateHasher};
use simworld_core::id::EntityId;
use simworld_core::scene::{Scene, World};
use simworld_core::seam::{BodyState, Embodiment};

use crate::body::{Bonds, Detail};
use crate::convert::{from_pose, from_vector};
use crate::dynamics::{Owned, PhysicsDynamics};
use crate::grasp::{Grasp, Grasps};
use crate::humanoid::Shove;
use crate::roam::Roamers;
use crate::slot_set::SlotSet;
use crate::stream::Cell;
use crate::surface::Conditions;
use crate::sync::Slot;
use crate::{PhysicsConfig, PhysicsError};

/// The mark of this crate's saved state and its version.
const MARK: [u8; 8] = *b"swphys09";

/// What is written, by reference.
#[derive(Serialize)]
struct Written<'a> {
    config: &'a PhysicsConfig,
    physics: &'a PhysicsWorld,
    ground: ColliderHandle,
    surface: Option<u64>,
    slots: &'a [Slot],
    loaded: Option<&'a [(Cell, u32)]>,
    touching: &'a [(EntityId, EntityId)],
    conditions: Conditions,
    interest: &'a [Point3],
    shoves: &'a [Shove],
    grasps: &'a [Grasp],
    bodies: Vec<SavedBody>,
}

/// What is read back.
#[derive(Deserialize)]
struct Read {
    config: PhysicsConfig,
    physics: PhysicsWorld,
    ground: ColliderHandle,
    /// The digest of the surface that the ground is.
    surface: Option<u64>,
    slots: Vec<Slot>,
    /// The cells whose solids are in the engine, if not all are.
    loaded: Option<Vec<(Cell, u32)>>,
    touching: Vec<(EntityId, EntityId)>,
    conditions: Conditions,
    interest: Vec<Point3>,
    shoves: Vec<Shove>,
    grasps: Vec<Grasp>,
    bodies: Vec<SavedBody>,
}

#[derive(Serialize, Deserialize)]
struct SavedBody {
    id: EntityId,
    rigid: RigidBodyHandle,
    written: Pose,
    detail: Detail,
    is_adopted: bool,
    is_roaming: bool,
    pose: Pose,
    twist: Twist,
    inner: Vec<u8>,
}

fn saved_error(reason: impl Into<String>) -> PhysicsError {
    PhysicsError::Saved { reason: reason.into() }
}

fn digest(bytes: &[u8]) -> [u8; 8] {
    StateHasher::new().bytes(bytes).finish().0.to_le_bytes()
}

impl PhysicsDynamics {
    pub(crate) fn to_bytes(&self) -> Result<Vec<u8>, PhysicsError> {
        let save = |owned: &Owned| {
            let BodyState { pose, twist } = owned.body.state();
            let Owned { id, rigid, written, detail, is_adopted, is_roaming, .. } = *owned;
            SavedBody {
                id,
                rigid,
                written,
                detail,
                is_adopted,
                is_roaming,
                pose,
                twist,
                inner: owned.body.save(),
            }
        };
        let written = Written {
            config: &self.config,
            physics: &self.physics,
            ground: self.ground,
            surface: self.surface_digest(),
            slots: &self.slots,
            loaded: self.districts.as_ref().map(|districts| &*districts.loaded),
            touching: &self.contacts.touching,
            conditions: self.conditions,
            interest: &self.interest,
            shoves: &self.shoves,
            grasps: &self.grasps.list,
            bodies: self.bodies.iter().map(save).collect(),
        };
        let rest = postcard::to_allocvec(&written).map_err(|error| saved_error(error.to_string()))?;
        Ok([&MARK, &digest(&rest), &rest[..]].concat())
    }

    /// Takes up a saved state. The entities must have bodies of the same kinds here; bodies that the saved state
    /// does not know are dropped, and those that the physics made by itself are made again. On an error nothing but those and their inner
    /// state may have changed.
    pub(crate) fn take_up(&mut self, world: &World, saved: &[u8]) -> Result<(), PhysicsError> {
        let rest = saved.strip_prefix(&MARK).ok_or_else(|| saved_error("it is not this crate's"))?;
        let (sum, rest) = rest.split_at_checked(8).ok_or_else(|| saved_error("it is cut short"))?;
        if sum != digest(rest) {
            return Err(saved_error("it is damaged"));
        }
        let read: Read = postcard::from_bytes(rest).map_err(|error| saved_error(error.to_string()))?;
        if read.config != self.config {
            return Err(saved_error("it was saved with other settings: make the physics with the same"));
        }
        let surface = world.ground().filter(|ground| Some(ground.digest().0) == read.surface);
        if read.surface.is_some() && surface.is_none() {
            return Err(saved_error(
                "the world has another ground: restore the world that it was saved with",
            ));
        }
        for body in &read.bodies {
            let id = body.id;
            if world.entity(id).is_none() {
                return Err(PhysicsError::Missing { id });
            }
            if body.is_adopted && self.position(id).is_err() {
                self.add_rigid(world, id)?;
            }
            let place = self.position(id).map_err(|_| PhysicsError::Bodiless { id })?;
            let state = BodyState { pose: body.pose, twist: body.twist };
            if !self.bodies[place].body.restore(&state, &body.inner) {
                return Err(saved_error(format!("the body of {id} is of another kind")));
            }
        }
        self.bodies.retain(|owned| read.bodies.binary_search_by_key(&owned.id, |body| body.id).is_ok());
        for (owned, body) in self.bodies.iter_mut().zip(&read.bodies) {
            owned.rigid = body.rigid;
            owned.written = body.written;
            owned.before = body.twist;
            owned.bonds = Bonds::default();
            (owned.detail, owned.is_roaming) = (body.detail, body.is_roaming);
            owned.is_adopted = body.is_adopted;
        }
        self.roster.is_stale = true;
        self.physics = read.physics;
        self.roamers = Roamers::default();
        (self.ground, self.surface) = (read.ground, surface.cloned());
        self.slots = read.slots;
        self.districts = None;
        if let Some(loaded) = read.loaded {
            self.survey(loaded, world);
        }
        (self.traffic, self.stale, self.seen) = (SlotSet::default(), SlotSet::default(), None);
        let is_traffic = |slot: &usize| matches!(self.slots[*slot], Slot::Traffic(_));
        (0..self.slots.len()).filter(is_traffic).for_each(|slot| self.traffic.insert(slot));
        self.contacts.touching = read.touching;
        self.contacts.forget_colliders();
        self.conditions = read.conditions;
        (self.interest, self.detail_varies) = (read.interest, true);
        self.shoves = read.shoves;
        self.grasps = Grasps { list: read.grasps, ..Grasps::default() };
        Ok(())
    }

    /// Feeds what influences the future and is not in the world: the bodies, their rigid bodies, the contacts of
    /// the solver with their warm starts.
    pub(crate) fn hash_state(&self, hasher: &mut StateHasher) {
        hasher.u64(self.bodies.len() as u64);
        for owned in &self.bodies {
            let inner = owned.body.save();
            hasher.u64(owned.id.into()).u64(inner.len() as u64).bytes(&inner);
            if owned.is_roaming {
                hasher.pose(&owned.body.state().pose).vector(&owned.body.state().twist.linear);
                continue; // what the engine has of it is where it went off
            }
            for handle in std::iter::once(&owned.rigid).chain(owned.body.parts()) {
                let Some(rigid) = self.physics.bodies.get(*handle) else { continue };
                hasher.pose(&from_pose(rigid.position()));
                hasher.vector(&from_vector(rigid.linvel())).vector(&from_vector(rigid.angvel()));
                hasher.u64(u64::from(rigid.is_sleeping())).f64(rigid.activation().time_since_can_sleep);
            }
        }
        for pair in self.physics.contact_pairs() {
            for point in pair.manifolds().iter().flat_map(|manifold| &manifold.points) {
                hasher.f64(point.dist).f64(point.data.impulse);
            }
        }
        hasher.u64(self.interest.len() as u64);
        for point in &self.interest {
            hasher.point(point);
        }
        for shove in &self.shoves {
            hasher.u64(shove.whom.into()).f64(shove.velocity.x).f64(shove.velocity.y);
        }
        hasher.u64(self.grasps.list.len() as u64);
        for grasp in &self.grasps.list {
            hasher.u64(grasp.who.into()).u64(grasp.thing.into()).f64(grasp.force);
        }
        if let Some(districts) = &self.districts {
            hasher.u64(districts.loaded.len() as u64);
            for ((x, y), idle) in &districts.loaded {
                hasher.u64(*x as u64).u64(*y as u64).u64(u64::from(*idle));
            }
        }
        hasher.u64(self.contacts.touching.len() as u64);
        for (a, b) in &self.contacts.touching {
            hasher.u64((*a).into()).u64((*b).into());
        }
    }
}

impl StateHash for PhysicsDynamics {
    /// As [`Dynamics::state_hash`](simworld_core::seam::Dynamics::state_hash).
    fn state_hash(&self, hasher: &mut StateHasher) {
        self.hash_state(hasher);
    }
}
