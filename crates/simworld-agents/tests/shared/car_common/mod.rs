//! A car without slip, for the tests that steer by pedals and wheel.
#![allow(unreachable_pub, reason = "shared by several test crates")]

use simworld_core::action::{Action, ActionSet};
use simworld_core::geometry::{Pose, Twist, Vector3, direction, pose_facing, yaw_of};
use simworld_core::ops::tan;
use simworld_core::seam::{BodyState, Embodiment, EmbodimentError};

/// A car without slip: pedal and brake change its speed, the front wheels its heading.
pub struct Bicycle {
    state: BodyState,
    speed: f64,
    pedal: f64,
    brake: f64,
    wheels: f64,
}

impl Bicycle {
    pub fn at(pose: Pose) -> Self {
        let state = BodyState { pose, twist: Twist::ZERO };
        Self { state, speed: 0.0, pedal: 0.0, brake: 0.0, wheels: 0.0 }
    }
}

impl Embodiment for Bicycle {
    fn supports(&self) -> ActionSet {
        ActionSet::vehicle()
    }

    fn apply(&mut self, action: &Action) -> Result<(), EmbodimentError> {
        match action {
            Action::Throttle { level } => (self.pedal, self.brake) = (*level, 0.0),
            Action::Brake { level } => (self.pedal, self.brake) = (0.0, *level),
            Action::Steer { angle } => self.wheels = *angle,
            Action::Stop => (self.pedal, self.brake) = (0.0, 1.0),
            Action::TakePhoto => {}
            other => return Err(EmbodimentError::unsupported(other.kind(), self.supports())),
        }
        Ok(())
    }

    fn state(&self) -> BodyState {
        self.state
    }

    fn advance(&mut self, dt: f64) {
        let speed = (self.speed + self.pedal * 4.0 * dt - 0.1 * self.speed * dt).min(8.0);
        self.speed = (speed - self.brake * 8.0 * dt).max(0.0);
        let yaw = yaw_of(&self.state.pose);
        let ahead = direction(yaw) * self.speed;
        let place = self.state.pose.translation.vector + Vector3::new(ahead.x, ahead.y, 0.0) * dt;
        let turned = yaw + self.speed * tan(self.wheels) / 2.7 * dt;
        self.state.pose = pose_facing(place.into(), turned);
        self.state.twist.linear = Vector3::new(ahead.x, ahead.y, 0.0);
    }
    fn restore(&mut self, state: &BodyState, _saved: &[u8]) -> bool {
        (self.state, self.speed) = (*state, state.twist.ground_speed());
        true
    }
}
