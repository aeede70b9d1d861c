//! From what a joint is told to the torque of its motor.

use serde::{Deserialize, Serialize};

use super::description::JointDescription;
use crate::joint::JointCommand;

/// How much of the speed that is missing may be made good in one substep by damping, and of the angle by stiffness. With
/// an explicit step 2 and 4 are the ends of stability for one joint; joints that share their links lower them.
const BORNE: [f64; 2] = [0.3, 0.2];
/// In the last share of its greatest speed a motor loses its torque.
const FADING: f64 = 0.1;

/// What the motor of a joint can do.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Motor {
    effort: f64,
    velocity: f64,
}

impl Motor {
    pub(super) fn of(joint: &JointDescription) -> Self {
        let unlimited = 1e9;
        Self { effort: joint.effort.unwrap_or(unlimited), velocity: joint.velocity.unwrap_or(f64::MAX) }
    }

    /// The torque that a command leads to, with a load that is carried beside it, at an angle and a speed; `inertia` is what
    /// the joint feels of all that hangs together.
    pub(super) fn torque(
        &self,
        command: &JointCommand,
        load: f64,
        [angle, speed]: [f64; 2],
        inertia: f64,
        dt: f64,
    ) -> f64 {
        let gains = [BORNE[1] * inertia / (dt * dt), BORNE[0] * inertia / dt];
        let command = JointCommand { speed: command.speed.clamp(-self.velocity, self.velocity), ..*command };
        let asked = command.torque_at(angle, speed, gains) + load;
        let given = if asked.is_finite() { asked.clamp(-self.effort, self.effort) } else { 0.0 };
        if given * speed > 0.0 {
            given * ((self.velocity - speed.abs()) / (FADING * self.velocity)).clamp(0.0, 1.0)
        } else {
            given
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::robot::{JointDescription, JointKind};

    #[test]
    fn a_motor_gives_no_more_than_it_has() {
        let joint = JointDescription::new("j", JointKind::Continuous, ["a", "b"]).with_motor(5.0, 0.0);
        let motor = Motor::of(&JointDescription { velocity: Some(10.0), ..joint });
        let push = |torque| JointCommand { torque, ..JointCommand::default() };
        assert_eq!(motor.torque(&push(100.0), 0.0, [0.0, 0.0], 1.0, 0.01), 5.0);
        assert_eq!(motor.torque(&push(-3.0), -9.0, [0.0, 0.0], 1.0, 0.01), -5.0);
        assert_eq!(motor.torque(&push(5.0), 0.0, [0.0, 11.0], 1.0, 0.01), 0.0); // too fast to drive it on
        assert_eq!(motor.torque(&push(-5.0), 0.0, [0.0, 11.0], 1.0, 0.01), -5.0); // it may brake
        assert_eq!(motor.torque(&push(f64::NAN), 0.0, [0.0, 0.0], 1.0, 0.01), 0.0);
    }

    #[test]
    fn gains_are_taken_as_far_as_a_substep_bears_them() {
        let motor = Motor::of(&JointDescription::new("j", JointKind::Continuous, ["a", "b"]));
        let stiff = JointCommand { angle: 1.0, stiffness: 1e9, ..JointCommand::default() };
        // 0.2 * 1 kg m² / (0.01 s)² = 2000 N m/rad
        assert!((motor.torque(&stiff, 0.0, [0.0, 0.0], 1.0, 0.01) - 2000.0).abs() < 1e-9);
    }
}
