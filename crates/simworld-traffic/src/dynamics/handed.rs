//! Vehicles and walkers that somebody else moves in the world: their bodies follow their entities.

use serde::{Deserialize, Serialize};
use simworld_core::geometry::{Vector2, direction, planar, yaw_of};
use simworld_core::hash::StateHasher;
use simworld_core::id::EntityId;
use simworld_core::scene::{Scene, World};

use super::TrafficDynamics;
use crate::ControlError;

/// A vehicle or a walker, by number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub(super) enum Who {
    Vehicle(u32),
    Walker(u32),
}

impl Who {
    pub(super) fn hash(self, hasher: &mut StateHasher) {
        match self {
            Self::Vehicle(id) => hasher.u64(u64::from(id)),
            Self::Walker(id) => hasher.u64(1 << 32 | u64::from(id)),
        };
    }
}

impl TrafficDynamics {
    /// The vehicle or walker of an entity.
    pub(super) fn who(&self, entity: EntityId) -> Option<Who> {
        let number = |entities: &[EntityId]| entities.iter().position(|own| *own == entity);
        let vehicle =
            number(&self.vehicles).map(|id| id as u32).filter(|id| self.traffic.control(*id).is_some());
        let walker = || {
            let id = number(&self.pedestrians)? as u32;
            self.traffic.walker_control(id).map(|_| Who::Walker(id))
        };
        vehicle.map(Who::Vehicle).or_else(walker)
    }

    /// Hands a vehicle or a walker over to whoever moves its entity: a physics body, an agent, a user. From the next step on the
    /// traffic reads where it is instead of writing it, and the others mind it as they mind others.
    ///
    /// # Errors
    /// No vehicle or walker has that entity, or it is free already.
    pub fn hand_over(&mut self, entity: EntityId) -> Result<(), ControlError> {
        let who = self.who(entity).ok_or(ControlError::NoEntity { entity })?;
        match who {
            Who::Vehicle(id) => self.traffic.free(id).map(|_| ())?,
            Who::Walker(id) => self.traffic.free_walker(id)?,
        }
        self.handed.insert(entity, who);
        Ok(())
    }

    /// Gives a vehicle or a walker back to the traffic: one that was handed over joins the nearest lane or walkway from where
    /// its entity is.
    ///
    /// # Errors
    /// No vehicle or walker has that entity, nobody else moves it, or why it cannot join; it stays as it is then.
    pub fn give_back(&mut self, world: &World, entity: EntityId) -> Result<(), ControlError> {
        self.follow(world);
        match self.who(entity).ok_or(ControlError::NoEntity { entity })? {
            Who::Vehicle(id) => self.traffic.give_back(id)?,
            Who::Walker(id) => self.traffic.give_back_walker(id)?,
        }
        self.handed.remove(&entity);
        Ok(())
    }

    /// Takes up where those are whom somebody else moves.
    pub(super) fn follow(&mut self, world: &World) {
        let traffic = &mut self.traffic;
        self.handed.retain(|id, who| {
            let Some(entity) = world.entity(*id) else { return false };
            let (pose, twist) = (*entity.pose, *entity.twist);
            // What the world holds is finite.
            match who {
                Who::Vehicle(id) => traffic.place(*id, pose, twist).is_ok(),
                Who::Walker(id) => {
                    let velocity = Vector2::new(twist.linear.x, twist.linear.y);
                    traffic.place_walker(*id, planar(&pose), direction(yaw_of(&pose)), velocity).is_ok()
                        && traffic.place_walker_at_height(*id, pose.translation.z).is_ok()
                }
            }
        });
    }

    /// Whether somebody else moves an entity.
    pub(super) fn is_handed(&self, entity: EntityId) -> bool {
        !self.handed.is_empty() && self.handed.contains_key(&entity)
    }

    /// Takes somebody out of the traffic whose entity was taken out of the world, unless the number is another's by now.
    pub(super) fn bury(&mut self, entity: EntityId, who: Who) {
        match who {
            Who::Vehicle(id) if self.vehicles[id as usize] == entity => {
                self.traffic.remove(id);
            }
            Who::Walker(id) if self.pedestrians[id as usize] == entity => {
                self.traffic.remove_walker(id);
            }
            Who::Vehicle(_) | Who::Walker(_) => {}
        }
    }
}
