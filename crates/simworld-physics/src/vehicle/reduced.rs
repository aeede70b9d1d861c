//! A vehicle in reduced detail, and going over between the two.
//!
//! The single track moves in the plane and follows the height of the ground under its axles; nothing stops it. When
//! the detail changes, pose, velocity and yaw rate are those of the other model, and attitude and height close in on
//! those of the new one within fractions of a second.

use nalgebra::{Translation3, UnitQuaternion};
use parry3d_f64::query::Ray;
use rapier3d_f64::prelude::{QueryPipeline, RigidBody, RigidBodyType};
use serde::{Deserialize, Serialize};
use simworld_core::geometry::{Point3, Pose, Twist, Vector3, yaw_of};
use simworld_core::ops;
use simworld_core::seam::BodyState;

use super::physics_body::LONGEST_SUBSTEP;
use super::single_track::{SingleTrackParameters, SingleTrackState};
use super::{Drive, Vehicle, axle_of};
use crate::body::{Detail, Surroundings};
use crate::convert::{to_point, to_vector};
use crate::shape::material_of;
use crate::surface::Conditions;

/// Time in which height and attitude close in on those of the ground, s.
const SETTLING: f64 = 0.15;
/// How far above and below its place the ground is looked for, m.
const REACH: f64 = 1.0;
const AIR: f64 = 1.225;
const GRAVITY: f64 = 9.81;

/// The state of the single track beside pose and velocity.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Track {
    speed: f64,
    slip: f64,
    yaw_rate: f64,
    /// Height of the ground under the front and the rear axle, m.
    ground: [f64; 2],
    grip: f64,
    /// Way that it roams until it looks at the ground again, m.
    until: f64,
}

/// Way between two looks at the ground of who roams, m: less than a wheelbase.
const LOOK: f64 = 2.0;

impl Vehicle {
    /// Finds the ground under the axles.
    pub(super) fn look_at_ground(&mut self, around: &Surroundings<'_>, queries: &QueryPipeline<'_>) {
        let places = [self.parameters.front_axle(), self.parameters.rear_axle()];
        for (ground, x) in self.track.ground.iter_mut().zip(places) {
            let top = self.state.pose * Point3::new(x, 0.0, 0.0) + Vector3::z() * REACH;
            let ray = Ray::new(to_point(&top), to_vector(&-Vector3::z()));
            if let Some((handle, distance)) = queries.cast_ray(&ray, 2.0 * REACH, true) {
                *ground = top.z - distance;
                if let Some(collider) = around.physics.colliders.get(handle) {
                    self.track.grip = around.conditions().road.grip(material_of(collider.user_data));
                }
            }
        }
    }

    /// Moves on by a step out of the engine, along the ground as it finds it now and then.
    pub(super) fn roam_on_track(&mut self, around: &Surroundings<'_>, dt: f64) {
        let substeps = (dt / LONGEST_SUBSTEP - 1e-9).ceil().clamp(1.0, 1000.0);
        let dt = dt / substeps;
        for _ in 0..substeps as u32 {
            self.track.until -= self.track.speed.abs() * dt;
            if self.track.until <= 0.0 {
                self.look_at_ground(around, &around.queries_of_fixed());
                self.track.until = LOOK;
            }
            let before = self.state.pose.translation.z;
            let pose = self.follow_track(around.conditions(), dt);
            let linear = Vector3::z() * ((pose.translation.z - before) / dt);
            self.settle_on_track(&BodyState { pose, twist: Twist { linear, angular: Vector3::zeros() } });
        }
    }

    /// Where it comes to in a substep as a single track.
    pub(super) fn follow_track(&mut self, conditions: &Conditions, dt: f64) -> Pose {
        let grip = self.track.grip.max(0.05);
        let model = SingleTrackParameters::of(&self.parameters, grip);
        let most = model.steering_limit_at(self.track.speed);
        self.follow_controls(self.controls.steering.clamp(-most, most), dt);
        let acceleration = self.acceleration(conditions, grip, dt);
        let center = self.state.pose * Point3::from(self.center_of_mass());
        let before = SingleTrackState {
            x: center.x,
            y: center.y,
            steering: self.controls.wheel_angle,
            speed: self.track.speed,
            yaw: yaw_of(&self.state.pose),
            yaw_rate: self.track.yaw_rate,
            slip: self.track.slip,
        };
        let after = model.step(&before, self.controls.wheel_angle, acceleration, dt);
        (self.track.speed, self.track.slip, self.track.yaw_rate) = (after.speed, after.slip, after.yaw_rate);
        self.pose_on_ground(&after, dt)
    }

    /// Acceleration along the track by engine, brakes and resistances within the grip, m/s²; it never turns the
    /// motion round by braking.
    fn acceleration(&mut self, conditions: &Conditions, grip: f64, dt: f64) -> f64 {
        let throttle = self.engine_throttle();
        let (parameters, speed) = (&self.parameters, self.track.speed);
        let (mass, radius) = (parameters.chassis.mass, parameters.front.wheel_radius);
        let output = parameters.powertrain.step(&mut self.gearbox, throttle, speed / radius, radius, dt);
        let heading = self.state.pose.rotation * Vector3::x();
        let through_air = speed - conditions.wind.dot(&heading);
        let drag = 0.5 * AIR * parameters.chassis.drag_area * through_air * through_air.abs() / mass;
        let rotating = mass + output.inertia / (radius * radius);
        let most = parameters.front.tyre.friction_x * grip * GRAVITY;
        let driving = most * self.driven_share(most / GRAVITY);
        let driven = speed + ((output.torque / radius / rotating).clamp(-driving, driving) - drag) * dt;
        let braking = (self.controls.braking * parameters.brakes.deceleration).min(most)
            + parameters.front.tyre.rolling_resistance * GRAVITY;
        let braked = driven.signum() * (driven.abs() - braking * dt).max(0.0);
        (braked - speed) / dt
    }

    /// Share of the weight on the driven wheels when they drive as hard as friction lets them.
    fn driven_share(&self, friction: f64) -> f64 {
        let chassis = &self.parameters.chassis;
        let transfer = friction * chassis.center_of_mass / chassis.wheelbase;
        match self.parameters.powertrain.drive {
            Drive::Front => chassis.front_share / (1.0 + transfer),
            Drive::Rear => ((1.0 - chassis.front_share) / (1.0 - transfer).max(0.1)).min(1.0),
            Drive::All => 1.0,
        }
    }

    /// The pose of the body frame for a state of the track.
    fn pose_on_ground(&self, track: &SingleTrackState, dt: f64) -> Pose {
        let [front, rear] = self.track.ground;
        let share = dt / (SETTLING + dt);
        let (roll, pitch, _) = self.state.pose.rotation.euler_angles();
        let lean = match &self.parameters.balance {
            Some(rider) => {
                ops::atan2(track.speed * track.yaw_rate, GRAVITY).clamp(-rider.lean_limit, rider.lean_limit)
            }
            None => 0.0,
        };
        let slope = ops::atan2(rear - front, self.parameters.chassis.wheelbase);
        let (roll, pitch) = (roll + (-lean - roll) * share, pitch + (slope - pitch) * share);
        let rotation = UnitQuaternion::from_euler_angles(roll, pitch, track.yaw);
        let center = rotation * self.center_of_mass();
        let level = (front + rear) * 0.5;
        let height = self.state.pose.translation.z;
        let height = height + (level - height) * share;
        let place = Vector3::new(track.x - center.x, track.y - center.y, height);
        Pose::from_parts(Translation3::from(place), rotation)
    }

    /// The state after a substep as a single track: the pose that was reached and the velocity of the model.
    pub(super) fn settle_on_track(&mut self, state: &BodyState) {
        let yaw = yaw_of(&state.pose);
        let (sin, cos) = ops::sin_cos(yaw + self.track.slip);
        let angular = Vector3::z() * self.track.yaw_rate;
        let arm = state.pose.rotation * self.center_of_mass();
        let climb = state.twist.linear.z;
        let center = Vector3::new(cos, sin, 0.0) * self.track.speed + Vector3::z() * climb;
        self.state =
            BodyState { pose: state.pose, twist: Twist { linear: center - angular.cross(&arm), angular } };
    }

    /// Goes over to the other level of detail.
    pub(super) fn change_detail(&mut self, rigid: &mut RigidBody, detail: Detail) {
        self.detail = detail;
        let arm = self.state.pose.rotation * self.center_of_mass();
        let Twist { linear, angular } = self.state.twist;
        let center = linear + angular.cross(&arm);
        match detail {
            Detail::Reduced => {
                let (ahead, left) = self.axes();
                let (along, across) = (center.dot(&ahead), center.dot(&left));
                self.track.speed = ops::hypot(along, across) * along.signum();
                self.track.slip =
                    if along.abs() < 0.1 { 0.0 } else { ops::atan2(across, along.abs()) * along.signum() };
                self.track.yaw_rate = angular.z;
                self.track.until = 0.0;
                rigid.set_body_type(RigidBodyType::KinematicPositionBased, true);
            }
            Detail::Full => {
                rigid.set_body_type(RigidBodyType::Dynamic, true);
                rigid.set_linvel(to_vector(&center), true);
                rigid.set_angvel(to_vector(&angular), true);
                self.roll_freely();
                self.deflect_tyres();
            }
        }
    }

    /// Heading and left in the plane.
    fn axes(&self) -> (Vector3, Vector3) {
        let (sin, cos) = ops::sin_cos(yaw_of(&self.state.pose));
        (Vector3::new(cos, sin, 0.0), Vector3::new(-sin, cos, 0.0))
    }

    /// Gives the tyres the deflection that belongs to the slip angles of the motion, so that they carry at once.
    fn deflect_tyres(&mut self) {
        let (ahead, left) = self.axes();
        let Twist { linear, angular } = self.state.twist;
        let (parameters, angle) = (&self.parameters, self.controls.wheel_angle);
        for wheel in &mut self.wheels {
            let over_ground =
                linear + angular.cross(&(self.state.pose.rotation * Vector3::new(wheel.x, wheel.y, 0.0)));
            let (along, across) = (over_ground.dot(&ahead), over_ground.dot(&left));
            let steer = if wheel.x > parameters.center_of_mass_x() { angle } else { 0.0 };
            if along.abs() > 1.0 {
                let slip = ops::atan2(across, along.abs()) - steer * along.signum();
                wheel.deflection[1] =
                    axle_of(parameters, wheel).tyre.relaxation_y * ops::tan(slip.clamp(-0.5, 0.5));
            }
        }
    }
}
