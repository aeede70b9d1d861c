//! What the motor of a joint is told, and what is read from it.

use serde::{Deserialize, Serialize};

/// What the motor of one joint is told: a torque of `stiffness` times the angle and `damping` times the speed that is
/// missing, and `torque`, within what the motor gives. A joint that slides has metres in place of radians and newtons in
/// place of newton metres.
///
/// Gains beyond what a substep bears are carried out as far as it does: a stiffer joint would swing within a substep.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct JointCommand {
    /// Angle to go to, radians.
    pub angle: f64,
    /// Speed to have, rad/s.
    pub speed: f64,
    /// N m/rad, 0 or more; for a [`Quadruped`](crate::Quadruped) up to 200.
    pub stiffness: f64,
    /// N m s/rad, 0 or more; for a [`Quadruped`](crate::Quadruped) up to 3.
    pub damping: f64,
    /// N m.
    pub torque: f64,
}

impl JointCommand {
    /// The torque that it asks for at an angle and a speed, N m, with the greatest stiffness and damping that are
    /// carried out.
    pub(crate) fn torque_at(&self, angle: f64, speed: f64, [stiffness, damping]: [f64; 2]) -> f64 {
        self.stiffness.clamp(0.0, stiffness) * (self.angle - angle)
            + self.damping.clamp(0.0, damping) * (self.speed - speed)
            + self.torque
    }

    /// Whether every part of it is a finite number.
    pub(crate) fn is_finite(&self) -> bool {
        [self.angle, self.speed, self.stiffness, self.damping, self.torque]
            .iter()
            .all(|part| part.is_finite())
    }
}

/// How one joint is and what its motor does; a joint that slides has metres and newtons.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct JointReading {
    /// Angle, radians.
    pub angle: f64,
    /// Speed, rad/s.
    pub speed: f64,
    /// Torque of the motor, N m: exactly what acts in the engine.
    pub torque: f64,
}
