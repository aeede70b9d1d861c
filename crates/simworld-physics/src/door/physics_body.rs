//! How a door takes part in a physics world: a leaf on an impulse joint, and fixed while the latch holds it.

use rapier3d_f64::dynamics::RevoluteJointBuilder;
use rapier3d_f64::math::{Pose as RapierPose, Vector};
use rapier3d_f64::prelude::{PhysicsWorld, RigidBodyBuilder, RigidBodyHandle, RigidBodyType, SharedShape};
use simworld_core::asset::Material;
use simworld_core::id::EntityId;
use simworld_core::scene::{OPEN, Scene, World, WorldError};
use simworld_core::seam::BodyState;
use simworld_core::value::Value;

use super::{Door, Hand, Motion};
use crate::body::{BodyContext, PhysicsBody};
use crate::convert::{to_pose, to_vector};
use crate::shape::collider_for;

/// The solid leaf is so much smaller than its frame on every side, m: it clears the ground and what it hangs in.
const GAP: f64 = 0.02;

impl PhysicsBody for Door {
    fn attach(&mut self, id: EntityId, physics: &mut PhysicsWorld) -> RigidBodyHandle {
        self.id = Some(id);
        let leaf = self.leaf();
        let half = self.shape.size() * 0.5;
        let trim = leaf.across * GAP;
        let solid = SharedShape::cuboid(half.x - trim.x, half.y - trim.y, (half.z - GAP).max(GAP));
        let middle = RapierPose::from_translation(Vector::new(0.0, 0.0, half.z));
        let mut collider = collider_for(&self.shape, id, Material::Wood).position(middle).mass(self.mass);
        collider.shape = solid;
        let body = RigidBodyBuilder::dynamic().pose(to_pose(&self.state.pose)).can_sleep(false);
        let rigid = physics.insert(body, collider).0;
        self.hang(physics, rigid);
        rigid
    }

    fn parts(&self) -> &[RigidBodyHandle] {
        &self.motion.post
    }

    fn gather(&mut self, physics: &mut PhysicsWorld, rigid: RigidBodyHandle) {
        for post in std::mem::take(&mut self.motion.post) {
            physics.remove_body(post);
        }
        if let Some(leaf) = physics.bodies.get_mut(rigid) {
            leaf.reset_torques(true);
        }
        self.motion.speed = 0.0;
    }

    fn drive(&mut self, context: &mut BodyContext<'_>, dt: f64) {
        let (physics, rigid) = (&mut *context.physics, context.rigid);
        if self.motion.post.is_empty() {
            self.hang(physics, rigid);
        }
        if self.motion.latched {
            if !self.motion.hand.is_some_and(|hand| hand.to != 0.0) {
                self.motion.hand = None;
                return;
            }
            self.motion.latched = false;
            physics.bodies[rigid].set_body_type(RigidBodyType::Dynamic, true);
        }
        let torque = self.torque(dt);
        if self.latches() {
            return self.fall_shut(physics, rigid);
        }
        if let Some(leaf) = physics.bodies.get_mut(rigid) {
            leaf.reset_torques(true);
            leaf.add_torque(Vector::Z * torque, true);
        }
    }

    fn settle(&mut self, state: &BodyState) {
        self.state = *state;
        self.motion.angle = if self.motion.latched { 0.0 } else { self.angle_of(&state.pose) };
        self.motion.speed = state.twist.angular.z;
    }

    /// Put somewhere else, it hangs there as far open as it is.
    fn place(&mut self, state: &BodyState) {
        self.state = *state;
        let leaf_from_closed = self.pose_at(self.motion.angle).inverse() * self.closed;
        self.closed = state.pose * leaf_from_closed;
    }

    fn report(&mut self, id: EntityId, world: &mut World) -> Result<(), WorldError> {
        let Some(says_open) = world.entity(id).map(|entity| entity.is_open()) else { return Ok(()) };
        if std::mem::take(&mut self.motion.fell_shut) && says_open == self.motion.is_open {
            self.motion.is_open = false;
            return world.set_attribute(id, OPEN, Some(Value::Bool(false))).map(|_| ());
        }
        if says_open != self.motion.is_open {
            let to = if says_open { self.config.open_end() } else { 0.0 };
            self.motion.hand = Some(Hand { to, since: 0.0 });
            self.motion.is_open = says_open;
        }
        Ok(())
    }
}

impl Door {
    /// Hangs the leaf on a post, or on its latch.
    fn hang(&mut self, physics: &mut PhysicsWorld, rigid: RigidBodyHandle) {
        let pose = self.pose_at(self.motion.angle);
        let latched = self.motion.latched;
        let leaf = &mut physics.bodies[rigid];
        leaf.set_position(to_pose(&pose), true);
        leaf.set_body_type(if latched { RigidBodyType::Fixed } else { RigidBodyType::Dynamic }, true);
        let post = physics.insert_body(RigidBodyBuilder::fixed().pose(to_pose(&self.closed)));
        let hinge = to_vector(&self.leaf().hinge());
        let joint = RevoluteJointBuilder::new(Vector::Z)
            .local_anchor1(hinge)
            .local_anchor2(hinge)
            .limits(self.config.swing)
            .contacts_enabled(false);
        physics.insert_impulse_joint(post, rigid, joint);
        self.motion.post = vec![post];
    }

    /// The latch falls in.
    fn fall_shut(&mut self, physics: &mut PhysicsWorld, rigid: RigidBodyHandle) {
        let Motion { angle, speed, latched, hand, fell_shut, .. } = &mut self.motion;
        (*angle, *speed, *latched, *hand, *fell_shut) = (0.0, 0.0, true, None, true);
        if let Some(leaf) = physics.bodies.get_mut(rigid) {
            leaf.reset_torques(true);
            leaf.set_linvel(Vector::ZERO, true);
            leaf.set_angvel(Vector::ZERO, true);
            leaf.set_body_type(RigidBodyType::Fixed, true);
            leaf.set_position(to_pose(&self.closed), true);
        }
    }
}
