//! How a cart takes part in a physics world: a chassis on four wheels, each on an impulse joint.

use rapier3d_f64::dynamics::{GenericJointBuilder, JointAxesMask, MotorModel};
use rapier3d_f64::math::{Pose as RapierPose, Vector};
use rapier3d_f64::prelude::{
    ColliderBuilder, JointAxis, PhysicsWorld, RigidBodyBuilder, RigidBodyHandle, SharedShape,
};
use simworld_core::asset::Material;
use simworld_core::geometry::Vector3;
use simworld_core::id::EntityId;
use simworld_core::scene::Shape;
use simworld_core::seam::BodyState;

use super::{Cart, Castors, WHEELS};
use crate::body::{BodyContext, PhysicsBody, Surroundings};
use crate::convert::{to_pose, to_vector};
use crate::dynamics::LONGEST_JOINTED_SUBSTEP;
use crate::shape::{collider_for, on_wheels};

/// Bearings take up their friction at this speed, rad/s; slower they creep.
const CREEP: f64 = 0.02;
/// The way a bearing's friction counts on, N m s/rad at least: a bearing without friction turns freely.
const SMOOTH: f64 = 1e-9;

impl PhysicsBody for Cart {
    fn attach(&mut self, id: EntityId, physics: &mut PhysicsWorld) -> RigidBodyHandle {
        self.id = Some(id);
        let clearance = 2.0 * self.config.wheel_radius;
        let half = self.size * 0.5;
        let rise = (self.size.z - clearance) * 0.5;
        let middle = RapierPose::from_translation(Vector::new(0.0, 0.0, clearance + rise));
        let shape = Shape::cuboid(self.size.x, self.size.y, self.size.z);
        let mut collider =
            collider_for(&shape, id, Material::Metal).position(middle).mass(self.mass * (1.0 - WHEELS));
        collider.shape = SharedShape::cuboid(half.x, half.y, rise);
        collider.user_data = on_wheels(collider.user_data);
        let body = RigidBodyBuilder::dynamic()
            .pose(to_pose(&self.state.pose))
            .linvel(to_vector(&self.state.twist.linear))
            .angvel(to_vector(&self.state.twist.angular));
        let rigid = physics.insert(body, collider).0;
        self.put_on_wheels(physics, rigid);
        rigid
    }

    fn parts(&self) -> &[RigidBodyHandle] {
        &self.wheels
    }

    fn gather(&mut self, physics: &mut PhysicsWorld, _: RigidBodyHandle) {
        for wheel in std::mem::take(&mut self.wheels) {
            physics.remove_body(wheel);
        }
    }

    fn longest_substep(&self) -> f64 {
        if self.rests { f64::INFINITY } else { LONGEST_JOINTED_SUBSTEP }
    }

    fn sense(&mut self, around: &Surroundings<'_>, _: f64) {
        self.rests = around.is_sleeping();
    }

    fn drive(&mut self, context: &mut BodyContext<'_>, _: f64) {
        if self.wheels.is_empty() {
            let rigid = context.rigid;
            self.put_on_wheels(context.physics, rigid);
        }
    }

    fn settle(&mut self, state: &BodyState) {
        self.state = *state;
    }
}

impl Cart {
    /// Puts wheels under the chassis, which roll as fast as it goes.
    fn put_on_wheels(&mut self, physics: &mut PhysicsWorld, rigid: RigidBodyHandle) {
        let Some(id) = self.id else { return };
        let frame = *physics.bodies[rigid].position();
        let radius = self.config.wheel_radius;
        let velocity = self.state.twist.linear;
        let spin = (self.state.pose.rotation * Vector3::z()).cross(&velocity) / radius;
        for (index, axle) in self.axles().iter().enumerate() {
            let place = RapierPose::from_parts(frame * to_vector(axle), frame.rotation);
            let body =
                RigidBodyBuilder::dynamic().pose(place).linvel(to_vector(&velocity)).angvel(to_vector(&spin));
            let shape = Shape::Sphere { radius };
            let tyre: ColliderBuilder = collider_for(&shape, id, Material::Rubber)
                .position(RapierPose::IDENTITY)
                .mass(0.25 * WHEELS * self.mass);
            let tyre = ColliderBuilder { user_data: on_wheels(tyre.user_data), ..tyre };
            let wheel = physics.insert(body, tyre).0;
            physics.bodies[wheel].recompute_mass_properties_from_colliders(&physics.colliders);
            let is_front = index < 2;
            let swivels = match self.config.castors {
                Castors::Front => is_front,
                Castors::All => true,
                Castors::None => false,
            };
            physics.insert_impulse_joint(rigid, wheel, self.bearing(axle, swivels));
            self.wheels.push(wheel);
        }
    }

    /// The joint of a wheel: it turns about its axle, or whichever way it is led, against the friction of its share of the weight.
    fn bearing(&self, axle: &Vector3, swivels: bool) -> rapier3d_f64::dynamics::GenericJoint {
        const WEIGHT: f64 = 9.81;
        let torque = 0.25 * self.config.rolling_resistance * self.mass * WEIGHT * self.config.wheel_radius;
        let (locked, axes): (_, &[JointAxis]) = if swivels {
            (JointAxesMask::LIN_AXES, &[JointAxis::AngX, JointAxis::AngY, JointAxis::AngZ])
        } else {
            // About the first axis of the joint, which is laid along the axle.
            (JointAxesMask::LOCKED_REVOLUTE_AXES, &[JointAxis::AngX])
        };
        let mut joint = GenericJointBuilder::new(locked)
            .local_axis1(Vector::Y)
            .local_axis2(Vector::Y)
            .local_anchor1(to_vector(axle))
            .contacts_enabled(false);
        for axis in axes {
            joint = joint
                .motor_model(*axis, MotorModel::ForceBased)
                .motor_velocity(*axis, 0.0, (torque / CREEP).max(SMOOTH))
                .motor_max_force(*axis, torque);
        }
        joint.build()
    }
}
