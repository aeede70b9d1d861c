//! How the rider of a two-wheeler keeps it upright: by steering into the fall, and by shifting the weight.
//!
//! A point mass m at height h over the line of the wheels obeys h λ'' = g λ - v² δ / L + τ / (m h) for small lean λ,
//! steering δ and wheelbase L. Steering δ* + k (λ - λ*) + k' λ' with k = 2 g L / v² makes that a damped spring around
//! the lean λ* of the turn. Its first answer to a turn is to steer the other way, as riders do.

use simworld_core::ops;

use super::parameters::BalanceParameters;

/// Below this speed the rider steers as told and puts a foot down, m/s.
const WALKING: f64 = 1.2;
/// How much more a foot on the ground holds than a shifted weight.
const FOOT: f64 = 5.0;
const GRAVITY: f64 = 9.81;

/// What the rider perceives.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Lean {
    /// Radians, positive to the left.
    pub(crate) angle: f64,
    /// Its rate, rad/s.
    pub(crate) rate: f64,
    /// Speed along the vehicle, m/s.
    pub(crate) speed: f64,
}

/// What the rider does.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Answer {
    /// Angle of the front wheel, radians, positive to the left.
    pub(crate) steering: f64,
    /// Torque that leans to the left, N m.
    pub(crate) torque: f64,
}

impl BalanceParameters {
    /// Keeps balance for a steering angle that the rider was told; none once it has fallen.
    pub(crate) fn keep(&self, told: f64, wheelbase: f64, lean: Lean) -> Option<Answer> {
        if lean.angle.abs() > self.fall {
            return None;
        }
        let Lean { angle, rate, speed } = lean;
        let square = speed * speed;
        let most = ops::atan2(GRAVITY * wheelbase * ops::tan(self.lean_limit), square.max(1e-6));
        let told = told.clamp(-most, most);
        let wanted = ops::atan2(square * ops::tan(told) / wheelbase, GRAVITY);
        let rolling = ((speed.abs() - WALKING) / WALKING).clamp(0.0, 1.0);
        let gain = 2.0 * GRAVITY * wheelbase / square.max(WALKING * WALKING);
        let steering = told + rolling * gain * ((angle - wanted) + 0.35 * rate);
        let limit = self.torque * if rolling < 1.0 { FOOT } else { 1.0 };
        let torque = (self.stiffness * (wanted - angle) - self.damping * rate).clamp(-limit, limit);
        Some(Answer { steering, torque })
    }
}

#[cfg(test)]
mod tests {
    use super::super::VehicleClass;
    use super::*;

    #[test]
    fn a_turn_begins_by_steering_the_other_way_and_a_fallen_rider_does_nothing() {
        let rider = VehicleClass::Scooter.parameters().balance.unwrap();
        let upright = Lean { angle: 0.0, rate: 0.0, speed: 6.0 };
        let answer = rider.keep(0.05, 0.9, upright).unwrap();
        assert!(answer.steering < 0.0 && answer.torque > 0.0, "{answer:?}");
        let balanced = ops::atan2(36.0 * ops::tan(0.05) / 0.9, GRAVITY);
        let answer = rider.keep(0.05, 0.9, Lean { angle: balanced, ..upright }).unwrap();
        assert!((answer.steering - 0.05).abs() < 1e-12 && answer.torque.abs() < 1e-9, "{answer:?}");
        assert_eq!(rider.keep(0.0, 0.9, Lean { angle: 1.3, ..upright }), None);
    }
}
