//! Bodies for what clients bring: people and vehicles under physics, dogs and robots that walk without it.
//!
//! Who has a body follows from the world alone: whatever was brought by its class, unless its attribute `physics` says no, and
//! whatever else has that attribute. So a replay gives the same bodies at the same steps.

use std::collections::BTreeMap;

use simworld_core::event::EventKind;
use simworld_core::hash::StateHasher;
use simworld_core::id::EntityId;
use simworld_core::kinematic::{KinematicBody, KinematicDynamics};
use simworld_core::scene::{EntityKind, EntityRef, Scene, Shape, World};
use simworld_core::seam::{Dynamics, DynamicsError};
use simworld_core::value::Value;
use simworld_physics::{HumanoidConfig, PhysicsConfig, PhysicsDynamics, PhysicsError, VehicleClass};

/// A walking robot's top speed, m/s: that of the robot dog Spot is 1.6, of smaller ones 3.
const ROBOT_SPEED: f64 = 3.0;

/// Gives bodies, and moves them.
pub struct BroughtBodies {
    physics: PhysicsDynamics,
    walkers: KinematicDynamics,
    /// Who has a body, or was refused one, with the shape that it had then.
    known: BTreeMap<EntityId, Shape>,
}

impl BroughtBodies {
    /// Nobody yet.
    ///
    /// # Errors
    /// The physics refuses its settings.
    pub fn new() -> Result<Self, PhysicsError> {
        let physics = PhysicsDynamics::new(PhysicsConfig::default())?;
        Ok(Self { physics, walkers: KinematicDynamics::new(), known: BTreeMap::new() })
    }

    /// Brings the bodies up to date with the world.
    fn adopt(&mut self, world: &mut World) {
        let physics = &mut self.physics;
        self.known.retain(|id, shape| {
            let stays = world.entity(*id).is_some_and(|body| wants_body(&body) && body.info.shape == *shape);
            if !stays {
                // Who has no body is none of the physics' business.
                let _ = physics.remove(*id);
            }
            stays
        });
        let new: Vec<(EntityId, Shape)> = world
            .iter()
            .filter(|entity| wants_body(entity) && !self.known.contains_key(&entity.id))
            .map(|entity| (entity.id, entity.info.shape))
            .collect();
        for (id, shape) in new {
            self.known.insert(id, shape);
            if let Err(error) = self.give(world, id) {
                world.emit(EventKind::task("no_body", Some(id)).with("reason", error.to_string()));
            }
        }
    }

    fn give(&mut self, world: &World, id: EntityId) -> Result<(), PhysicsError> {
        let Some(entity) = world.entity(id) else { return Ok(()) };
        match entity.kind {
            EntityKind::Person => self.physics.add_humanoid(world, id, HumanoidConfig::default()),
            EntityKind::Dog | EntityKind::Robot => {
                self.walkers.insert(id, Box::new(KinematicBody::with_max_speed(*entity.pose, ROBOT_SPEED)));
                Ok(())
            }
            // Its rider moves it.
            EntityKind::Scooter => Ok(()),
            kind if kind.is_vehicle() => self.give_wheels(world, id),
            _ => self.physics.add_rigid(world, id),
        }
    }

    /// The first class of vehicles that is of this size.
    fn give_wheels(&mut self, world: &World, id: EntityId) -> Result<(), PhysicsError> {
        let mut outcome = Ok(());
        for class in VehicleClass::ALL {
            outcome = self.physics.add_vehicle(world, id, class.parameters());
            if !matches!(outcome, Err(PhysicsError::Shape { .. })) {
                break;
            }
        }
        outcome
    }
}

/// Whether an entity is to have a body here.
fn wants_body(entity: &EntityRef<'_>) -> bool {
    let attributes = &entity.info.attributes;
    match attributes.get("physics") {
        Some(wanted) => *wanted == Value::Bool(true),
        None => attributes.contains_key("class") && entity.kind.is_mobile(),
    }
}

impl Dynamics for BroughtBodies {
    fn step(&mut self, world: &mut World, dt: f64) -> Result<(), DynamicsError> {
        self.adopt(world);
        self.walkers.step(world, dt)?;
        self.physics.step(world, dt)
    }

    fn save(&self) -> Result<Vec<u8>, DynamicsError> {
        let parts = (self.physics.save()?, self.walkers.save()?);
        serde_json::to_vec(&parts).map_err(|error| DynamicsError::Saved(error.to_string()))
    }

    fn restore(&mut self, world: &World, saved: &[u8]) -> Result<(), DynamicsError> {
        let parts: (Vec<u8>, Vec<u8>) =
            serde_json::from_slice(saved).map_err(|error| DynamicsError::Saved(error.to_string()))?;
        let wanting: Vec<(EntityId, Shape)> =
            world.iter().filter(wants_body).map(|entity| (entity.id, entity.info.shape)).collect();
        for (id, shape) in wanting {
            if self.known.insert(id, shape).is_none() {
                // Who was refused a body when it came is refused again.
                let _ = self.give(world, id);
            }
        }
        self.physics.restore(world, &parts.0)?;
        self.walkers.restore(world, &parts.1)
    }

    fn state_hash(&self, hasher: &mut StateHasher) {
        self.physics.state_hash(hasher);
        self.walkers.state_hash(hasher);
    }
}
