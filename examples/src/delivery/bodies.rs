//! Bodies of couriers: under physics near the middle of the city, points beyond.
//!
//! Who has which body follows from where it is, so a replay and a run that goes on have the same at the same steps.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use simworld_core::action::Action;
use simworld_core::command::Command;
use simworld_core::hash::StateHasher;
use simworld_core::id::EntityId;
use simworld_core::kinematic::KinematicBody;
use simworld_core::scene::{Scene, World};
use simworld_core::seam::{BodyState, Dynamics, DynamicsError, Embodiment};
use simworld_physics::{HumanoidConfig, PhysicsConfig, PhysicsDynamics, PhysicsError};

/// How much farther than the radius a body goes before it becomes a point, as a factor: none flickers at the rim.
const RIM: f64 = 1.1;
/// The fastest a point goes, m/s: above the limit of scooters, so that a told speed is never cut.
const FASTEST: f64 = 15.0;

/// Moves couriers, each by the body that its place calls for.
pub(super) struct CourierBodies {
    physics: PhysicsDynamics,
    /// From the middle of the city, m.
    radius: f64,
    /// Everybody, with the point that it is; `None` of a body under physics.
    couriers: BTreeMap<EntityId, Courier>,
}

struct Courier {
    point: Option<KinematicBody>,
    /// The speed that it was told last, m/s.
    told: f64,
    /// Whether its new body has yet to be told so.
    retell: bool,
}

/// What a snapshot holds of a courier: the bytes of the point, the speed, and whether it is yet to be told.
#[derive(Serialize, Deserialize)]
struct Saved {
    id: EntityId,
    point: Option<Vec<u8>>,
    told: f64,
    retell: bool,
}

impl CourierBodies {
    /// Bodies for these, physical within `radius` of the origin, m.
    ///
    /// # Errors
    /// The physics refuses its settings or a body.
    pub(super) fn new(
        world: &World,
        couriers: &[EntityId],
        config: PhysicsConfig,
        radius: f64,
    ) -> Result<Self, PhysicsError> {
        let mut bodies = Self { physics: PhysicsDynamics::new(config)?, radius, couriers: BTreeMap::new() };
        for id in couriers {
            let Some(entity) = world.entity(*id) else { return Err(PhysicsError::Missing { id: *id }) };
            let near = entity.planar().coords.norm() <= radius;
            if near {
                bodies.physics.add_humanoid(world, *id, HumanoidConfig::default())?;
            }
            let point = (!near).then(|| KinematicBody::with_max_speed(*entity.pose, FASTEST));
            bodies.couriers.insert(*id, Courier { point, told: 0.0, retell: false });
        }
        Ok(bodies)
    }

    /// How many are under physics now.
    pub(super) fn physical(&self) -> u32 {
        self.couriers.values().filter(|courier| courier.point.is_none()).count() as u32
    }

    /// Gives each the body of its place; a new one is told in the next step what the old one was.
    fn exchange(&mut self, world: &mut World) -> Result<(), DynamicsError> {
        for (id, courier) in &mut self.couriers {
            let Some(entity) = world.entity(*id) else { continue };
            let distance = entity.planar().coords.norm();
            let pose = *entity.pose;
            if courier.point.is_some() && distance <= self.radius {
                courier.point = None;
                courier.retell = true;
                let given = self.physics.add_humanoid(world, *id, HumanoidConfig::default());
                given.map_err(|error| DynamicsError::Other(error.to_string()))?;
            } else if courier.point.is_none() && distance > self.radius * RIM {
                let taken = self.physics.remove(*id);
                taken.map_err(|error| DynamicsError::Other(error.to_string()))?;
                courier.point = Some(KinematicBody::with_max_speed(pose, FASTEST));
                courier.retell = true;
            }
        }
        Ok(())
    }

    /// Notes what couriers are told; tells new bodies, unless they are told something else anyway.
    fn take_actions(&mut self, world: &mut World) {
        let mut again: Vec<(EntityId, f64)> = Vec::new();
        for courier in self.couriers.iter_mut().filter(|courier| courier.1.retell) {
            courier.1.retell = false;
            again.push((*courier.0, courier.1.told));
        }
        for (who, action) in world.actuations() {
            let Some(courier) = self.couriers.get_mut(who) else { continue };
            again.retain(|(other, _)| other != who);
            match action {
                Action::MoveForward { speed } | Action::ChangeSpeed { speed } => courier.told = *speed,
                Action::Stop => courier.told = 0.0,
                _ => {}
            }
        }
        for (who, speed) in again {
            // A body that cannot move now, because it sits, has nothing to be told.
            let _ = world.apply(&Command::Actuate { who, action: Action::MoveForward { speed } });
        }
        for (who, action) in world.actuations() {
            if let Some(point) = self.couriers.get_mut(who).and_then(|courier| courier.point.as_mut()) {
                // What a point cannot do, the world does.
                let _ = point.apply(action);
            }
        }
    }

    /// Moves points in the plane; where the ground is not flat they keep to it.
    fn move_points(&mut self, world: &mut World, dt: f64) -> Result<(), DynamicsError> {
        let ground = world.ground().cloned();
        for (id, courier) in &mut self.couriers {
            let (Some(point), Some(entity)) = (&mut courier.point, world.entity(*id)) else { continue };
            if entity.attachment.is_some() {
                continue; // its carrier moves it
            }
            point.advance(dt);
            let BodyState { mut pose, mut twist } = point.state();
            if let Some(ground) = &ground {
                let rise = ground.height(pose.translation.vector.xy().into()) - pose.translation.vector.z;
                pose.translation.vector.z += rise;
                twist.linear.z = rise / dt;
            }
            world.set_motion(*id, pose, twist)?;
        }
        Ok(())
    }

    /// Points that were moved from outside go on from where they were put.
    fn follow(&mut self, world: &World) {
        for (id, courier) in &mut self.couriers {
            let (Some(point), Some(entity)) = (&mut courier.point, world.entity(*id)) else { continue };
            let found = BodyState { pose: *entity.pose, twist: *entity.twist };
            if found != point.state() {
                let saved = point.save();
                point.restore(&found, &saved);
            }
        }
    }
}

impl Dynamics for CourierBodies {
    fn step(&mut self, world: &mut World, dt: f64) -> Result<(), DynamicsError> {
        self.couriers.retain(|id, _| world.entity(*id).is_some());
        self.follow(world);
        self.take_actions(world);
        self.move_points(world, dt)?;
        self.physics.step(world, dt)?;
        self.exchange(world)
    }

    fn save(&self) -> Result<Vec<u8>, DynamicsError> {
        let saved = |(id, courier): (&EntityId, &Courier)| Saved {
            id: *id,
            point: courier.point.as_ref().map(Embodiment::save),
            told: courier.told,
            retell: courier.retell,
        };
        let couriers: Vec<Saved> = self.couriers.iter().map(saved).collect();
        postcard::to_stdvec(&(couriers, self.physics.save()?))
            .map_err(|error| DynamicsError::Saved(error.to_string()))
    }

    fn restore(&mut self, world: &World, saved: &[u8]) -> Result<(), DynamicsError> {
        let refused = |error: &dyn std::fmt::Display| DynamicsError::Saved(error.to_string());
        let (couriers, physics): (Vec<Saved>, Vec<u8>) =
            postcard::from_bytes(saved).map_err(|error| refused(&error))?;
        let had: Vec<EntityId> = self.physics.bodies().collect();
        for id in had {
            self.physics.remove(id).map_err(|error| refused(&error))?;
        }
        self.couriers.clear();
        for Saved { id, point, told, retell } in couriers {
            let entity = world.entity(id).ok_or_else(|| refused(&format!("{id} is not in the world")))?;
            let state = BodyState { pose: *entity.pose, twist: *entity.twist };
            if point.is_none() {
                let given = self.physics.add_humanoid(world, id, HumanoidConfig::default());
                given.map_err(|error| refused(&error))?;
            }
            let point = point.map(|bytes| (KinematicBody::with_max_speed(state.pose, FASTEST), bytes));
            let taken_up = |(mut point, bytes): (KinematicBody, Vec<u8>)| {
                point
                    .restore(&state, &bytes)
                    .then_some(point)
                    .ok_or_else(|| refused(&"a body of another kind"))
            };
            let point = point.map(taken_up).transpose()?;
            self.couriers.insert(id, Courier { point, told, retell });
        }
        self.physics.restore(world, &physics)
    }

    fn state_hash(&self, hasher: &mut StateHasher) {
        self.physics.state_hash(hasher);
        for (id, courier) in &self.couriers {
            hasher.u64((*id).into()).f64(courier.told).u64(u64::from(courier.retell));
            if let Some(point) = &courier.point {
                hasher.bytes(&point.save());
            }
        }
    }
}
