//! Throwing: what a hand held flies.

use simworld_core::geometry::{Pose, Twist, Vector3};
use simworld_core::id::EntityId;
use simworld_core::scene::{Role, Scene, World};

use crate::error::check_range;
use crate::{PhysicsDynamics, PhysicsError};

/// So far from the thrower's own form the thing leaves the hand, m.
const CLEAR: f64 = 0.05;

impl PhysicsDynamics {
    /// Throws what somebody holds in the hand or with both arms, with a velocity relative to the thrower, m/s, world frame, of at
    /// most 60 m/s. From then on the thing is a free rigid body, which can be picked up again. It leaves the hand at its height, beside the
    /// thrower's form, in the direction of the throw.
    ///
    /// No command says this, so it is no part of a recording: who replays a run calls it again, between the same steps.
    ///
    /// # Errors
    /// An unknown entity, one that holds nothing, or a velocity out of range.
    pub fn throw(
        &mut self,
        world: &mut World,
        who: EntityId,
        velocity: Vector3,
    ) -> Result<EntityId, PhysicsError> {
        let speed = velocity.norm();
        check_range("throw", "velocity", speed, 0.0..=60.0, "at most 60 m/s")?;
        let thrower = world.entity(who).ok_or(PhysicsError::Missing { id: who })?;
        let held = [Role::Held, Role::Carried].into_iter().find_map(|role| world.attached(who, role));
        let id = held.ok_or(PhysicsError::EmptyHanded { id: who })?;
        let thing = world.entity(id).ok_or(PhysicsError::Missing { id })?;
        let sizes = [thrower.info.shape.size(), thing.info.shape.size()];
        let clear = CLEAR + 0.5 * (sizes[0].xy().norm() + sizes[1].norm());
        let middle = thrower.pose.translation.vector;
        let heading = thrower.pose.rotation * Vector3::x();
        let ahead = Vector3::new(velocity.x, velocity.y, 0.0).try_normalize(1e-6).unwrap_or(heading);
        let place = thing.pose.translation.vector;
        let out = (place - middle).dot(&ahead).max(clear);
        let place = Vector3::new(middle.x + ahead.x * out, middle.y + ahead.y * out, place.z);
        let pose = Pose::from_parts(place.into(), thing.pose.rotation);
        let twist = Twist { linear: thrower.twist.linear + velocity, angular: Vector3::zeros() };
        world.reset(id, pose, twist, None)?;
        if self.body(id).is_none() {
            self.add_rigid(world, id)?;
        }
        Ok(id)
    }
}
