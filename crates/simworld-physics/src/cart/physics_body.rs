//! How a cart takes part in a physics world: one rigid body of a box on four balls.
//!
//! A wheel that turns freely passes on nothing but what its bearing holds against it, and at an edge the force square to the tyre: that
//! of a ball without friction. What the bearings hold, and what keeps a wheel that does not swivel from going sideways, is added
//! by hand, as shares of the load that the engine found on each wheel.

use rapier3d_f64::math::{Pose as RapierPose, Vector};
use rapier3d_f64::prelude::{
    ColliderHandle, ContactPair, PhysicsWorld, RigidBody, RigidBodyBuilder, RigidBodyHandle, SharedShape,
};
use simworld_core::asset::Material;
use simworld_core::geometry::Vector3;
use simworld_core::id::EntityId;
use simworld_core::scene::Shape;
use simworld_core::seam::BodyState;

use super::{Cart, Castors};
use crate::body::{BodyContext, PhysicsBody, Surroundings};
use crate::convert::{to_pose, to_vector};
use crate::shape::{collider_for, on_wheels};

/// The longest substep in which wheels keep to the ground, s.
const LONGEST_ROLLING_SUBSTEP: f64 = 1.0 / 60.0;

impl PhysicsBody for Cart {
    fn attach(&mut self, id: EntityId, physics: &mut PhysicsWorld) -> RigidBodyHandle {
        let radius = self.config.wheel_radius;
        let half = self.size * 0.5;
        let rise = half.z - radius;
        let shape = Shape::cuboid(self.size.x, self.size.y, self.size.z);
        let mut chassis = collider_for(&shape, id, Material::Metal)
            .position(RapierPose::from_translation(Vector::new(0.0, 0.0, 2.0 * radius + rise)))
            .mass(self.mass);
        chassis.shape = SharedShape::cuboid(half.x, half.y, rise);
        chassis.user_data = on_wheels(chassis.user_data);
        let body = RigidBodyBuilder::dynamic()
            .pose(to_pose(&self.state.pose))
            .linvel(to_vector(&self.state.twist.linear))
            .angvel(to_vector(&self.state.twist.angular));
        let rigid = physics.insert(body, chassis).0;
        for axle in self.axles() {
            let place = RapierPose::from_translation(to_vector(&axle));
            let mut tyre = collider_for(&Shape::Sphere { radius }, id, Material::Rubber)
                .position(place)
                .density(0.0)
                // The mean with whatever it stands on is none as well.
                .friction(0.0)
                .restitution(0.0);
            tyre.user_data = on_wheels(tyre.user_data);
            physics.insert_collider(tyre, Some(rigid));
        }
        rigid
    }

    fn longest_substep(&self) -> f64 {
        if self.rests { f64::INFINITY } else { LONGEST_ROLLING_SUBSTEP }
    }

    fn sense(&mut self, around: &Surroundings<'_>, dt: f64) {
        self.rests = around.is_sleeping();
        let wheels = around.physics.bodies.get(around.rigid).map_or(&[][..], |rigid| rigid.colliders());
        for (load, wheel) in self.loads.iter_mut().zip(wheels.iter().skip(1)) {
            *load = load_on(around.physics, *wheel, dt);
        }
    }

    fn drive(&mut self, context: &mut BodyContext<'_>, dt: f64) {
        if self.rests {
            return;
        }
        let grip = context.conditions.road.friction(Material::Rubber);
        let weight = self.loads.iter().sum::<f64>().max(1e-9);
        for (index, axle) in self.axles().iter().enumerate() {
            let load = self.loads[index];
            let is_fixed = match self.config.castors {
                Castors::Front => index >= 2,
                Castors::All => false,
                Castors::None => true,
            };
            self.roll(context, axle, [load / weight, load * self.config.rolling_resistance], dt);
            if is_fixed {
                self.keep_to_its_way(context, axle, load * grip, dt);
            }
        }
    }

    fn settle(&mut self, state: &BodyState) {
        self.state = *state;
    }
}

/// With how much force a wheel was pressed in the last substep of `dt` s, N.
fn load_on(physics: &PhysicsWorld, wheel: ColliderHandle, dt: f64) -> f64 {
    let pairs = physics.contact_pairs_with(wheel).filter(|pair| pair.has_any_active_contact());
    pairs.map(ContactPair::total_impulse_magnitude).sum::<f64>() / dt
}

impl Cart {
    /// The place under a wheel where it stands, and what its velocity will be by the weight of the cart, if nothing holds it.
    fn tread(&self, rigid: &RigidBody, axle: &Vector3, fall: f64) -> (Vector, Vector) {
        let place = *rigid.position() * to_vector(&(axle - Vector3::z() * self.config.wheel_radius));
        (place, rigid.velocity_at_point(place) - Vector::Z * fall)
    }

    /// Takes from a wheel, which bears a share of the weight, what it would roll in the coming substep, with no more than a force.
    fn roll(&self, context: &mut BodyContext<'_>, axle: &Vector3, [share, most]: [f64; 2], dt: f64) {
        let fall = context.config.gravity * dt;
        let rigid = context.rigid_body();
        let (place, velocity) = self.tread(rigid, axle, fall);
        let up = *rigid.rotation() * Vector::Z;
        let along = velocity - up * velocity.dot(up);
        let wanted = along.length() * rigid.mass() * share;
        if wanted > 0.0 {
            let impulse = along * (-wanted.min(most * dt) / along.length());
            rigid.apply_impulse_at_point(impulse, place, false);
        }
    }

    /// Takes from one of two wheels on an axle what it would go sideways, with no more than a force.
    fn keep_to_its_way(&self, context: &mut BodyContext<'_>, axle: &Vector3, most: f64, dt: f64) {
        let fall = context.config.gravity * dt;
        let rigid = context.rigid_body();
        let (place, velocity) = self.tread(rigid, axle, fall);
        let [ahead, aside, up] = [Vector::X, Vector::Y, Vector::Z].map(|axis| *rigid.rotation() * axis);
        let arm = (place - rigid.center_of_mass()).dot(ahead);
        let turning = (rigid.mass_properties().effective_world_inv_inertia * up).dot(up);
        // The mass that it feels, as the cart turns about the vertical alone: the ground holds it upright.
        let mass = 1.0 / (1.0 / rigid.mass().max(1e-9) + arm * arm * turning);
        let impulse = (-0.5 * mass * velocity.dot(aside)).clamp(-most * dt, most * dt);
        rigid.apply_impulse_at_point(aside * impulse, place, false);
    }
}
