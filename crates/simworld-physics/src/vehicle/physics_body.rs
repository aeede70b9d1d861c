//! How a vehicle takes part in a physics world, at either level of detail.

use rapier3d_f64::prelude::{PhysicsWorld, RigidBodyBuilder, RigidBodyHandle, RigidBodyType};
use simworld_core::id::EntityId;
use simworld_core::seam::BodyState;

use super::wheel::Wheel;
use super::{Vehicle, axle_of};
use crate::body::{BodyContext, Detail, PhysicsBody, Surroundings};
use crate::convert::{to_pose, to_vector};

/// The longest substep in which springs and tyres keep their accuracy, s.
pub(super) const LONGEST_SUBSTEP: f64 = 1.0 / 60.0;
/// How far the fastest oscillation, yaw on the tyres of a standing vehicle, goes in a substep at most, radians.
const PHASE: f64 = 0.4;
/// A vehicle slower than this for two seconds may sleep, m/s and rad/s.
const SLEEPY: f64 = 0.02;

impl PhysicsBody for Vehicle {
    fn attach(&mut self, id: EntityId, physics: &mut PhysicsWorld) -> RigidBodyHandle {
        let weight = self.parameters.chassis.mass * -physics.gravity.z;
        let front_share = self.parameters.chassis.front_share;
        let middle = self.parameters.center_of_mass_x();
        let count = self.wheels.len() as f64 * 0.5;
        for wheel in &mut self.wheels {
            let share = if wheel.x > middle { front_share } else { 1.0 - front_share };
            wheel.static_load = weight * share / count;
        }
        let frame = RigidBodyBuilder::dynamic()
            .pose(to_pose(&self.state.pose))
            .linvel(to_vector(&self.state.twist.linear))
            .angvel(to_vector(&self.state.twist.angular))
            .additional_mass_properties(self.mass_properties());
        let handle = physics.insert(frame, self.hull(id)).0;
        let rigid = &mut physics.bodies[handle];
        rigid.activation_mut().normalized_linear_threshold = SLEEPY;
        rigid.activation_mut().angular_threshold = SLEEPY;
        if self.detail == Detail::Reduced {
            rigid.set_body_type(RigidBodyType::KinematicPositionBased, true);
        }
        handle
    }

    fn longest_substep(&self) -> f64 {
        match self.detail {
            Detail::Full => LONGEST_SUBSTEP.min(PHASE / self.yaw_frequency()),
            Detail::Reduced => LONGEST_SUBSTEP,
        }
    }

    fn can_roam(&self) -> bool {
        self.detail == Detail::Reduced
    }

    fn roam(&mut self, around: &Surroundings<'_>, dt: f64) {
        self.roam_on_track(around, dt);
    }

    fn sense(&mut self, around: &Surroundings<'_>, _: f64) {
        match around.detail() {
            Detail::Full if self.rests(around.is_sleeping()) => {}
            Detail::Full => self.look_down(around),
            Detail::Reduced => self.look_at_ground(around, &around.queries()),
        }
    }

    fn drive(&mut self, context: &mut BodyContext<'_>, dt: f64) {
        let (detail, conditions) = (context.detail(), *context.conditions());
        let rigid = context.rigid_body();
        if detail != self.detail {
            self.change_detail(rigid, detail);
        }
        match detail {
            Detail::Reduced => {
                let pose = self.follow_track(&conditions, dt);
                rigid.set_next_kinematic_position(to_pose(&pose));
            }
            // Spring impulses on a sleeping chassis would pile up until it wakes.
            Detail::Full if self.rests(rigid.is_sleeping()) => {}
            Detail::Full => {
                if self.controls.throttle != 0.0 {
                    rigid.wake_up(true);
                }
                self.push(rigid, &conditions, dt);
            }
        }
    }

    fn settle(&mut self, state: &BodyState) {
        match self.detail {
            Detail::Full => self.state = *state,
            Detail::Reduced => self.settle_on_track(state),
        }
    }

    fn place(&mut self, state: &BodyState) {
        self.take_state(state);
    }
}

impl Vehicle {
    /// Angular frequency of yaw against the sideways springs of the standing tyres, rad/s.
    fn yaw_frequency(&self) -> f64 {
        let (parameters, middle) = (&self.parameters, self.parameters.center_of_mass_x());
        let spring = |wheel: &Wheel| {
            let tyre = &axle_of(parameters, wheel).tyre;
            let arm = wheel.x - middle;
            tyre.cornering_stiffness(wheel.static_load) / tyre.relaxation_y * arm * arm
        };
        let stiffness: f64 = self.wheels.iter().map(spring).sum();
        let radius = parameters.chassis.gyration[2];
        (stiffness / (parameters.chassis.mass * radius * radius)).sqrt()
    }

    /// Whether it sleeps and nobody has told it to go.
    fn rests(&self, is_sleeping: bool) -> bool {
        is_sleeping && self.controls.throttle == 0.0
    }
}
