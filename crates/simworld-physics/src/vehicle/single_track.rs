//! The single-track model: a vehicle as one wheel in front and one behind, in the plane.
//!
//! Althoff and Würsching, `CommonRoad`: Vehicle Models, 2020, sections 4 (kinematic) and 5 (with slip and load
//! transfer). A million vehicles need no contact with an engine for it; [`step`](SingleTrackParameters::step) is
//! implicit in slip and yaw rate, which are stiff at low speed, and so is stable at any step.

use serde::{Deserialize, Serialize};
use simworld_core::ops::{atan2, cos, sin, tan};

use super::VehicleParameters;

const GRAVITY: f64 = 9.81;

/// The data of a single track.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SingleTrackParameters {
    /// Mass, kg.
    pub mass: f64,
    /// Moment of inertia about the vertical axis, kg m².
    pub yaw_inertia: f64,
    /// From the centre of mass to the front axle, m.
    pub front: f64,
    /// From the centre of mass to the rear axle, m.
    pub rear: f64,
    /// Height of the centre of mass, m.
    pub height: f64,
    /// Friction coefficient.
    pub friction: f64,
    /// Cornering stiffness of the front axle by its load and by friction, 1/rad.
    pub front_stiffness: f64,
    /// The same of the rear axle.
    pub rear_stiffness: f64,
    /// Greatest steering angle, radians.
    pub steering_limit: f64,
    /// Greatest rate of steering, rad/s.
    pub steering_rate: f64,
    /// Greatest acceleration either way, m/s².
    pub acceleration: f64,
    /// Speed above which power limits the acceleration to `acceleration * switching_speed / speed`, m/s.
    pub switching_speed: f64,
    /// Greatest speed forward, m/s.
    pub top_speed: f64,
    /// Greatest speed backward, m/s.
    pub reverse_speed: f64,
}

/// Where a single track is and how it moves: its centre of mass, for the kinematic model its rear axle.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct SingleTrackState {
    /// World frame, m.
    pub x: f64,
    /// World frame, m.
    pub y: f64,
    /// Steering angle, radians, positive to the left.
    pub steering: f64,
    /// Speed, m/s, negative backward.
    pub speed: f64,
    /// Heading, radians.
    pub yaw: f64,
    /// rad/s.
    pub yaw_rate: f64,
    /// Angle from the heading to the velocity, radians.
    pub slip: f64,
}

/// What a driver does.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct SingleTrackInput {
    /// Rate of steering, rad/s.
    pub steering_rate: f64,
    /// Acceleration, m/s².
    pub acceleration: f64,
}

/// Below this speed the model with slip is singular and the kinematic one takes its place, m/s.
const STANDSTILL: f64 = 0.1;

impl SingleTrackParameters {
    /// The single track of a vehicle on a road of a grip (1 is dry asphalt): both wheels of an axle in one, with the
    /// stiffness at rest less what the axle gives.
    pub fn of(vehicle: &VehicleParameters, grip: f64) -> Self {
        let chassis = &vehicle.chassis;
        let weight = chassis.mass * GRAVITY;
        let stiffness = |axle: &super::AxleParameters, share: f64| {
            let wheels = axle.wheels() as f64;
            let load = weight * share;
            let whole = wheels * axle.tyre.cornering_stiffness(load / wheels);
            whole / (1.0 + axle.compliance_steer * whole) / load
        };
        let friction = vehicle.front.tyre.friction_y.min(vehicle.rear.tyre.friction_y) * grip;
        let rear_share = 1.0 - chassis.front_share;
        let radius = vehicle.front.wheel_radius;
        Self {
            mass: chassis.mass,
            yaw_inertia: chassis.mass * chassis.gyration[2] * chassis.gyration[2],
            front: chassis.wheelbase * rear_share,
            rear: chassis.wheelbase * chassis.front_share,
            height: chassis.center_of_mass,
            friction,
            front_stiffness: stiffness(&vehicle.front, chassis.front_share) / friction,
            rear_stiffness: stiffness(&vehicle.rear, rear_share) / friction,
            steering_limit: vehicle.steering.limit,
            steering_rate: vehicle.steering.rate,
            acceleration: vehicle.powertrain.tractive_effort(1.0, radius) / chassis.mass,
            switching_speed: 5.0,
            top_speed: vehicle.powertrain.top_speed,
            reverse_speed: vehicle.powertrain.reverse_speed,
        }
    }

    /// Distance between the axles, m.
    pub fn wheelbase(&self) -> f64 {
        self.front + self.rear
    }

    /// The input within the limits of steering, power and speed.
    pub fn limited(&self, state: &SingleTrackState, input: &SingleTrackInput) -> SingleTrackInput {
        let (angle, rate) = (state.steering, input.steering_rate);
        let at_stop =
            (angle <= -self.steering_limit && rate <= 0.0) || (angle >= self.steering_limit && rate >= 0.0);
        let steering_rate = if at_stop { 0.0 } else { rate.clamp(-self.steering_rate, self.steering_rate) };
        let (speed, wish) = (state.speed, input.acceleration);
        let most = if speed > self.switching_speed {
            self.acceleration * self.switching_speed / speed
        } else {
            self.acceleration
        };
        let at_limit =
            (speed <= -self.reverse_speed && wish <= 0.0) || (speed >= self.top_speed && wish >= 0.0);
        let acceleration = if at_limit { 0.0 } else { wish.clamp(-self.acceleration, most) };
        SingleTrackInput { steering_rate, acceleration }
    }

    /// The rate of change of every field by the kinematic model, whose point is the rear axle: wheels roll where they
    /// point. Yaw rate and slip have no rate of their own in it.
    pub fn kinematic_rate(&self, state: &SingleTrackState, input: &SingleTrackInput) -> SingleTrackState {
        let input = self.limited(state, input);
        SingleTrackState {
            x: state.speed * cos(state.yaw),
            y: state.speed * sin(state.yaw),
            steering: input.steering_rate,
            speed: input.acceleration,
            yaw: state.speed / self.wheelbase() * tan(state.steering),
            yaw_rate: 0.0,
            slip: 0.0,
        }
    }

    /// The rate of change of every field by the model with slip and load transfer, at 0.1 m/s or more either way.
    pub fn rate(&self, state: &SingleTrackState, input: &SingleTrackInput) -> SingleTrackState {
        let input = self.limited(state, input);
        let [yaw, slip] = self.lateral(state.speed, input.acceleration);
        SingleTrackState {
            x: state.speed * cos(state.slip + state.yaw),
            y: state.speed * sin(state.slip + state.yaw),
            steering: input.steering_rate,
            speed: input.acceleration,
            yaw: state.yaw_rate,
            yaw_rate: yaw[0] * state.yaw_rate + yaw[1] * state.slip + yaw[2] * state.steering,
            slip: slip[0] * state.yaw_rate + slip[1] * state.slip + slip[2] * state.steering,
        }
    }

    /// Rates of yaw rate and slip by yaw rate, slip and steering.
    fn lateral(&self, speed: f64, acceleration: f64) -> [[f64; 3]; 2] {
        let Self { mass, yaw_inertia, front, rear, height, friction, .. } = *self;
        let length = self.wheelbase();
        // Cornering stiffness of the axles per unit of mass by length, with the load that the acceleration moves.
        let c_front = self.front_stiffness * (GRAVITY * rear - acceleration * height);
        let c_rear = self.rear_stiffness * (GRAVITY * front + acceleration * height);
        let turn = friction * mass / (yaw_inertia * length);
        let drift = friction / (speed * length);
        [
            [
                -turn / speed * (front * front * c_front + rear * rear * c_rear),
                turn * (rear * c_rear - front * c_front),
                turn * front * c_front,
            ],
            [
                drift / speed * (c_rear * rear - c_front * front) - 1.0,
                -drift * (c_rear + c_front),
                drift * c_front,
            ],
        ]
    }

    /// Steering angle beyond which the lateral acceleration would be more than friction gives, radians.
    pub fn steering_limit_at(&self, speed: f64) -> f64 {
        let grip = 0.85 * self.friction * GRAVITY;
        atan2(grip * self.wheelbase(), (speed * speed).max(1e-9)).min(self.steering_limit)
    }

    /// One step of `dt` s with the steering angle and acceleration given as they are: semi-implicit, with slip and
    /// yaw rate solved together at the end of the step.
    #[must_use]
    pub fn step(
        &self,
        state: &SingleTrackState,
        steering: f64,
        acceleration: f64,
        dt: f64,
    ) -> SingleTrackState {
        let speed = state.speed + acceleration * dt;
        let (yaw_rate, slip) = if speed.abs() < STANDSTILL {
            let slip = atan2(tan(steering) * self.rear, self.wheelbase());
            (speed * cos(slip) * tan(steering) / self.wheelbase(), slip)
        } else {
            let [yaw, slip] = self.lateral(speed, acceleration);
            // (1 - dt A) z' = z + dt b δ
            let (a, b) = (1.0 - dt * yaw[0], -dt * yaw[1]);
            let (c, d) = (-dt * slip[0], 1.0 - dt * slip[1]);
            let (p, q) = (state.yaw_rate + dt * yaw[2] * steering, state.slip + dt * slip[2] * steering);
            let determinant = a * d - b * c;
            ((p * d - b * q) / determinant, (a * q - c * p) / determinant)
        };
        let yaw = state.yaw + yaw_rate * dt;
        let course = slip + (state.yaw + yaw) * 0.5;
        SingleTrackState {
            x: state.x + speed * cos(course) * dt,
            y: state.y + speed * sin(course) * dt,
            steering,
            speed,
            yaw,
            yaw_rate,
            slip,
        }
    }
}
