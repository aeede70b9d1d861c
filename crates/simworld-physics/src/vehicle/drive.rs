//! How a vehicle moves through a physics world: chassis, wheels, forces.
//!
//! Wheel forces scale with the chassis mass in rapier's controller, so springs are given by the natural frequency
//! of the ride: four springs of stiffness k per kilogram give ω² = 4 k and a static deflection g / (4 k).

use parry3d_f64::mass_properties::MassProperties;
use rapier3d_f64::control::{DynamicRayCastVehicleController, WheelTuning};
use rapier3d_f64::math::{Pose as RapierPose, Vector};
use rapier3d_f64::prelude::{ColliderBuilder, PhysicsWorld, RigidBodyBuilder, RigidBodyHandle, SharedShape};
use simworld_core::geometry::Vector3;
use simworld_core::id::EntityId;
use simworld_core::seam::BodyState;

use super::Vehicle;
use crate::body::{BodyContext, PhysicsBody};
use crate::convert::{to_pose, to_vector};
use crate::shape::BodyTag;

/// Stiffness of one spring per kilogram of chassis, 1/s²: a ride at 1.7 Hz.
const STIFFNESS: f64 = 28.0;
/// Damping of one spring per kilogram of chassis, 1/s: 0.5 of the critical √k in compression, more in rebound.
const COMPRESSION: f64 = 2.6;
const REBOUND: f64 = 3.4;
/// Unloaded length of a spring, m.
const REST_LENGTH: f64 = 0.3;
/// How far a spring gives, m.
const TRAVEL: f64 = 0.25;
/// Rapier charges driving and braking forces to the friction limit at one half.
const LONGITUDINAL_SHARE: f64 = 0.5;

impl Vehicle {
    fn mass_properties(&self) -> MassProperties {
        let (mass, s) = (self.config.mass, self.size);
        let twelfth = mass / 12.0;
        let inertia = Vector::new(
            twelfth * (s.y * s.y + s.z * s.z),
            twelfth * (s.x * s.x + s.z * s.z),
            twelfth * (s.x * s.x + s.y * s.y),
        );
        MassProperties::new(Vector::new(0.0, 0.0, self.config.center_of_mass), mass, inertia)
    }

    /// Four wheels, front left, front right, rear left, rear right, whose rays end on the ground when the body
    /// stands at z = 0 under `gravity`.
    fn mount_wheels(&self, chassis: RigidBodyHandle, gravity: f64) -> DynamicRayCastVehicleController {
        let config = &self.config;
        let tuning = WheelTuning {
            suspension_stiffness: STIFFNESS,
            suspension_compression: COMPRESSION,
            suspension_damping: REBOUND,
            max_suspension_travel: TRAVEL,
            side_friction_stiffness: 1.0,
            friction_slip: config.grip,
            max_suspension_force: config.mass * 50.0,
        };
        let mut wheels = DynamicRayCastVehicleController::new(chassis);
        wheels.index_up_axis = 2;
        wheels.index_forward_axis = 0;
        let deflection = gravity / (4.0 * STIFFNESS);
        let hub = config.wheel_radius + REST_LENGTH - deflection;
        let (x, y) = (self.size.x * config.wheelbase_share * 0.5, self.size.y * 0.42);
        for (x, y) in [(x, y), (x, -y), (-x, y), (-x, -y)] {
            wheels.add_wheel(
                Vector::new(x, y, hub),
                Vector::new(0.0, 0.0, -1.0),
                Vector::new(0.0, -1.0, 0.0),
                REST_LENGTH,
                config.wheel_radius,
                &tuning,
            );
        }
        wheels
    }

    /// The force at the driven wheels, N, at a speed along the vehicle, m/s.
    fn engine_force(&self, speed: f64) -> f64 {
        let (throttle, config) = (self.controls.throttle, &self.config);
        let too_fast =
            if throttle > 0.0 { speed >= config.top_speed } else { -speed >= config.reverse_speed };
        if too_fast { 0.0 } else { throttle * config.drive_force.min(config.power / speed.abs().max(1.0)) }
    }

    fn drag(&self, velocity: &Vector3) -> Vector3 {
        velocity * (-self.config.drag * velocity.norm())
    }

    fn turn_wheels(&mut self, dt: f64) {
        let most = self.config.steering_rate * dt;
        let controls = &mut self.controls;
        controls.wheel_angle += (controls.steering - controls.wheel_angle).clamp(-most, most);
    }
}

impl PhysicsBody for Vehicle {
    fn attach(&mut self, id: EntityId, physics: &mut PhysicsWorld) -> RigidBodyHandle {
        let (half, clearance) = (self.size * 0.5, self.config.clearance);
        let half_height = (self.size.z - clearance) * 0.5;
        let frame = RigidBodyBuilder::dynamic()
            .pose(to_pose(&self.state.pose))
            .linvel(to_vector(&self.state.twist.linear))
            .angvel(to_vector(&self.state.twist.angular))
            .additional_mass_properties(self.mass_properties());
        let chassis = ColliderBuilder::new(SharedShape::cuboid(half.x, half.y, half_height))
            .position(RapierPose::from_translation(Vector::new(0.0, 0.0, clearance + half_height)))
            .density(0.0)
            .friction(0.3)
            .user_data(BodyTag::Entity(id).to_user_data());
        let handle = physics.insert(frame, chassis).0;
        self.wheels = Some(self.mount_wheels(handle, -physics.gravity.z));
        handle
    }

    fn drive(&mut self, context: &mut BodyContext<'_>, dt: f64) {
        self.turn_wheels(dt);
        let velocity = self.state.twist.linear;
        let speed = velocity.dot(&(self.state.pose.rotation * Vector3::x()));
        let chassis = context.rigid_body();
        if self.controls.throttle != 0.0 {
            chassis.wake_up(true);
        } else if chassis.is_sleeping() {
            // Spring impulses on a sleeping chassis would pile up until it wakes.
            return;
        }
        chassis.apply_impulse(to_vector(&(self.drag(&velocity) * dt)), false);
        let force = self.engine_force(speed);
        let weight = self.config.mass * 9.81;
        let brake = self.controls.brake * self.config.braking * self.config.mass;
        // The tyre limit also bounds the brakes; rapier would allow twice the grip along the wheel.
        let brake = brake.min(self.config.grip * weight) + self.config.rolling_resistance * weight;
        let Some(wheels) = self.wheels.as_mut() else { return };
        let limit = self.config.grip * weight * LONGITUDINAL_SHARE;
        for (index, wheel) in wheels.wheels_mut().iter_mut().enumerate() {
            let is_front = index < 2;
            wheel.steering = if is_front { self.controls.wheel_angle } else { 0.0 };
            wheel.engine_force = if is_front { (force * 0.5).clamp(-limit * 0.5, limit * 0.5) } else { 0.0 };
            wheel.brake = brake * 0.25 * dt;
        }
        wheels.update_vehicle(dt, context.queries_mut());
    }

    fn settle(&mut self, state: &BodyState) {
        self.state = *state;
    }
}

#[cfg(test)]
mod tests {
    use simworld_core::geometry::Pose;

    use super::*;
    use crate::VehicleConfig;

    #[test]
    fn power_limits_the_force_at_speed() {
        let mut car = Vehicle::new(Pose::identity(), VehicleConfig::default()).unwrap();
        car.controls.throttle = 1.0;
        assert_eq!(car.engine_force(0.0), 5000.0);
        assert!((car.engine_force(30.0) - 95e3 / 30.0).abs() < 1e-9);
        assert_eq!(car.engine_force(50.0), 0.0);
        assert!((car.drag(&Vector3::new(30.0, 0.0, 0.0)).x + 360.0).abs() < 1e-9);
    }
}
