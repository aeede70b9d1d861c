//! Giving entities bodies, taking them away, and asking about them.

use std::any::Any;

use rapier3d_f64::prelude::RigidBodyHandle;
use simworld_core::geometry::{Twist, Vector3};
use simworld_core::id::EntityId;
use simworld_core::scene::{Scene, World};
use simworld_core::seam::{BodyState, Embodiment};

use crate::body::{Detail, PhysicsBody};
use crate::convert::from_vector;
use crate::dynamics::{Owned, PhysicsDynamics};
use crate::shape::material_of_entity;
use crate::sync::{Slot, bonds_of};
use crate::{
    Cart, CartConfig, Door, DoorConfig, Humanoid, HumanoidConfig, PhysicsError, Quadruped, QuadrupedConfig,
    Rigid, Robot, RobotConfig, Vehicle, VehicleParameters,
};

impl PhysicsDynamics {
    /// Gives a person's entity a body of its pose and size.
    ///
    /// # Errors
    /// An unknown entity, one that has a body, a shape that is no upright body, or a setting out of range.
    pub fn add_humanoid(
        &mut self,
        world: &World,
        id: EntityId,
        config: HumanoidConfig,
    ) -> Result<(), PhysicsError> {
        let entity = world.entity(id).ok_or(PhysicsError::Missing { id })?;
        self.insert(world, id, Box::new(Humanoid::of(&entity, config)?))
    }

    /// Gives a dog's entity a body of its pose, as wide as the narrower side of its shape and as tall as it is high: it
    /// walks as people do, and does what dogs do.
    ///
    /// # Errors
    /// As [`add_humanoid`](Self::add_humanoid).
    pub fn add_dog(&mut self, world: &World, id: EntityId) -> Result<(), PhysicsError> {
        self.add_humanoid(world, id, HumanoidConfig::dog())
    }

    /// Gives a robot dog's entity a body on legs: twelve motors under the laws of mechanics near what is of interest, and the
    /// cylinder of [`add_dog`](Self::add_dog) elsewhere.
    ///
    /// # Errors
    /// As [`add_humanoid`](Self::add_humanoid).
    pub fn add_quadruped(
        &mut self,
        world: &World,
        id: EntityId,
        config: QuadrupedConfig,
    ) -> Result<(), PhysicsError> {
        let entity = world.entity(id).ok_or(PhysicsError::Missing { id })?;
        self.insert(world, id, Box::new(Quadruped::of(&entity, config)?))
    }

    /// Gives an entity the body of a robot: links on joints with motors, from a description. The robot stands at the pose of the
    /// entity, on the lowest point that it has.
    ///
    /// # Errors
    /// An unknown entity, one that has a body, a description that is no robot, or a setting out of range.
    pub fn add_robot(
        &mut self,
        world: &World,
        id: EntityId,
        config: RobotConfig,
    ) -> Result<(), PhysicsError> {
        let entity = world.entity(id).ok_or(PhysicsError::Missing { id })?;
        let state = BodyState { pose: *entity.pose, twist: *entity.twist };
        self.insert(world, id, Box::new(Robot::new(state, config)?))
    }

    /// Puts a cart's entity on wheels: a box of its pose, size and mass, whose handle is behind.
    ///
    /// # Errors
    /// An unknown entity, one that has a body, a shape without room for wheels, or a setting out of range.
    pub fn add_cart(&mut self, world: &World, id: EntityId, config: CartConfig) -> Result<(), PhysicsError> {
        let entity = world.entity(id).ok_or(PhysicsError::Missing { id })?;
        self.insert(world, id, Box::new(Cart::of(&entity, config)?))
    }

    /// Hangs a door's entity, a closed leaf of its pose, shape and mass, on a hinge.
    ///
    /// # Errors
    /// An unknown entity, one that has a body, a shape that is no leaf, or a setting out of range.
    pub fn add_door(&mut self, world: &World, id: EntityId, config: DoorConfig) -> Result<(), PhysicsError> {
        let entity = world.entity(id).ok_or(PhysicsError::Missing { id })?;
        self.insert(world, id, Box::new(Door::of(&entity, config)?))
    }

    /// Gives a vehicle's entity a body of its pose, velocity, size and mass.
    ///
    /// # Errors
    /// An unknown entity, one that has a body, a shape of another class of vehicles, or a setting out of range.
    pub fn add_vehicle(
        &mut self,
        world: &World,
        id: EntityId,
        parameters: VehicleParameters,
    ) -> Result<(), PhysicsError> {
        let entity = world.entity(id).ok_or(PhysicsError::Missing { id })?;
        self.insert(world, id, Box::new(Vehicle::of(&entity, parameters)?))
    }

    /// Lets an entity fall and tumble as a free rigid body of its pose, velocity, shape and mass; if its asset has a model, it
    /// is met as the hulls of that.
    ///
    /// # Errors
    /// An unknown entity, or one that has a body.
    pub fn add_rigid(&mut self, world: &World, id: EntityId) -> Result<(), PhysicsError> {
        let entity = world.entity(id).ok_or(PhysicsError::Missing { id })?;
        let rigid = Rigid::of(&entity, material_of_entity(&entity, world));
        let rigid = match self.solids.of(&entity, world) {
            Some(solid) => rigid.with_solid(solid),
            None => rigid,
        };
        self.insert(world, id, Box::new(rigid))
    }

    /// Gives an entity a body of any kind.
    ///
    /// # Errors
    /// An unknown entity, or one that has a body.
    pub fn insert(
        &mut self,
        world: &World,
        id: EntityId,
        mut body: Box<dyn PhysicsBody>,
    ) -> Result<(), PhysicsError> {
        let entity = world.entity(id).ok_or(PhysicsError::Missing { id })?;
        let Err(place) = self.position(id) else { return Err(PhysicsError::Occupied { id }) };
        if self.slots.len() <= id.index() {
            self.slots.resize_with(id.index() + 1, Slot::default);
        }
        self.vacate(id.index());
        self.set_slot(id.index(), Slot::Own { id });
        let rigid = body.attach(id, &mut self.physics);
        // Otherwise the engine knows the mass only after its first step, and the body drives before that.
        self.physics.bodies[rigid].recompute_mass_properties_from_colliders(&self.physics.colliders);
        let (written, bonds, before) = (*entity.pose, bonds_of(id, world), Twist::ZERO);
        let (is_roaming, detail) = (false, Detail::Full);
        let is_adopted = false;
        let is_inert = body.is_inert();
        let owned =
            Owned { id, body, rigid, written, bonds, is_inert, is_adopted, is_roaming, before, detail };
        self.bodies.insert(place, owned);
        self.roster.is_stale = true;
        self.file_body(rigid);
        Ok(())
    }

    /// Notes that the physics gave an entity its body by itself.
    pub(crate) fn mark_adopted(&mut self, id: EntityId) {
        if let Ok(place) = self.position(id) {
            self.bodies[place].is_adopted = true;
        }
    }

    /// Takes the body away from an entity, which then stays where it is.
    ///
    /// # Errors
    /// The entity has none.
    pub fn remove(&mut self, id: EntityId) -> Result<(), PhysicsError> {
        let place = self.position(id).map_err(|_| PhysicsError::Bodiless { id })?;
        let mut owned = self.bodies.remove(place);
        self.roster.is_stale = true;
        owned.body.gather(&mut self.physics, owned.rigid);
        self.physics.remove_body(owned.rigid);
        self.set_slot(id.index(), Slot::Vacant);
        self.stale.insert(id.index());
        Ok(())
    }

    /// The entities that have a body here, by ascending id.
    pub fn bodies(&self) -> impl Iterator<Item = EntityId> + '_ {
        self.bodies.iter().map(|owned| owned.id)
    }

    /// The body of an entity, if it has one.
    pub fn body(&self, id: EntityId) -> Option<&dyn PhysicsBody> {
        self.position(id).ok().map(|place| &*self.bodies[place].body)
    }

    /// The body of an entity, if it has one of that type.
    pub fn body_as<B: PhysicsBody>(&self, id: EntityId) -> Option<&B> {
        let body: &dyn Any = self.body(id)?;
        body.downcast_ref()
    }

    /// The body of an entity, if it has one of that type, to be told what no action says. What it is told is a part of saved
    /// states, and no part of the commands that a world records: who replays a run tells it again.
    pub fn body_as_mut<B: PhysicsBody>(&mut self, id: EntityId) -> Option<&mut B> {
        let place = self.position(id).ok()?;
        let body: &mut dyn Any = &mut *self.bodies[place].body;
        body.downcast_mut()
    }

    /// Where the body of an entity is and how it moves, if it has one.
    pub fn state(&self, id: EntityId) -> Option<BodyState> {
        self.body(id).map(Embodiment::state)
    }

    /// The momentum of all of an entity's body, kg m/s, world frame, if it has one.
    pub fn momentum(&self, id: EntityId) -> Option<Vector3> {
        let owned = &self.bodies[self.position(id).ok()?];
        if owned.is_roaming {
            return Some(self.momentum_of_roamer(owned));
        }
        let rigids = std::iter::once(&owned.rigid).chain(owned.body.parts());
        let momentum = |handle: &RigidBodyHandle| {
            let rigid = self.physics.bodies.get(*handle)?;
            Some(from_vector(rigid.linvel()) * rigid.mass())
        };
        Some(rigids.filter_map(momentum).sum())
    }

    pub(crate) fn position(&self, id: EntityId) -> Result<usize, usize> {
        self.bodies.binary_search_by_key(&id, |owned| owned.id)
    }
}
