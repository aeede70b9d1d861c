//! What is told to a quadruped's joints and body, and what is read from them.

use nalgebra::UnitQuaternion;
use serde::{Deserialize, Serialize};
use simworld_core::geometry::{Pose, Vector3};

use crate::joint::JointReading;

/// How a quadruped is to go, all in its own frame: x forward, y left, z up.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Command {
    /// Speed forward, backward if negative, m/s.
    pub forward: f64,
    /// Speed to the left, m/s.
    pub lateral: f64,
    /// Rate of turning to the left, rad/s.
    pub turning: f64,
    /// How far the nose is to point above the ground's slope, radians, -0.4 to 0.4.
    pub pitch: f64,
    /// How much lower than standing the trunk is to be carried, m, 0 to 0.12.
    pub crouch: f64,
}

impl Command {
    /// The nearest one that a body of such speeds (forward, aside, turning) carries out; what is no number is 0.
    pub(super) fn within(self, [forward, lateral, turning]: [f64; 3]) -> Self {
        let held =
            |value: f64, low: f64, high: f64| if value.is_nan() { 0.0 } else { value.clamp(low, high) };
        Self {
            forward: held(self.forward, -forward, forward),
            lateral: held(self.lateral, -lateral, lateral),
            turning: held(self.turning, -turning, turning),
            pitch: held(self.pitch, -0.4, 0.4),
            crouch: held(self.crouch, 0.0, 0.12),
        }
    }
}

/// What an inertial measuring unit in the middle of the trunk reads.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ImuReading {
    /// How the trunk is turned in the world.
    pub orientation: UnitQuaternion<f64>,
    /// Angular velocity, trunk frame, rad/s.
    pub angular_velocity: Vector3,
    /// Acceleration less that of free fall, trunk frame, m/s²: at rest gravity upwards. It is the mean over a substep.
    pub acceleration: Vector3,
}

impl Default for ImuReading {
    fn default() -> Self {
        let (angular_velocity, acceleration) = (Vector3::zeros(), Vector3::zeros());
        Self { orientation: UnitQuaternion::identity(), angular_velocity, acceleration }
    }
}

/// What can be read from a quadruped on its legs, as of the start of the last substep. Legs come as in
/// [`LEGS`](super::LEGS), the joints of each as abduction, thigh and knee.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Readings {
    /// Joints and motors.
    pub joints: [[JointReading; 3]; 4],
    /// Force of the ground on each foot, N; zero in the air.
    pub feet: [f64; 4],
    /// The inertial measuring unit.
    pub imu: ImuReading,
}

/// What a quadruped feels of its own body: all that its [control](super::QuadrupedControl) needs of it. Legs come as in
/// [`LEGS`](super::LEGS), the joints of each as abduction, thigh and knee.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct QuadrupedState {
    /// The middle of the trunk in the world: x forward, y left, z up.
    pub trunk: Pose,
    /// Velocity of the middle of the trunk, world frame, m/s.
    pub linear: Vector3,
    /// Angular velocity of the trunk, world frame, rad/s.
    pub angular: Vector3,
    /// The centre of mass of the whole, world frame, m; [`QuadrupedModel::center_of_mass`](super::QuadrupedModel::center_of_mass)
    /// reckons it from the joints.
    pub center: Vector3,
    /// Angles of the joints, radians.
    pub angles: [[f64; 3]; 4],
    /// Speeds of the joints, rad/s.
    pub speeds: [[f64; 3]; 4],
    /// With how much force the ground holds each foot, N.
    pub loads: [f64; 4],
}

impl QuadrupedState {
    /// Whether every number of it is finite.
    pub fn is_finite(&self) -> bool {
        let Self { trunk, linear, angular, center, angles, speeds, loads } = self;
        let turn = &trunk.rotation.coords;
        let body = trunk.translation.vector.iter().chain(turn).chain(linear).chain(angular).chain(center);
        let joints = angles.as_flattened().iter().chain(speeds.as_flattened());
        body.chain(joints).chain(loads).all(|number| number.is_finite())
    }
}
