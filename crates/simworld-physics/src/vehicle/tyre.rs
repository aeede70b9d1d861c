//! The forces of a rubber tyre: the Magic Formula with load dependence, and combined slip by normalised slips.
//!
//! Pacejka, Tire and Vehicle Dynamics, 3rd edition, 2012: the Magic Formula is its equation 4.6, cornering stiffness
//! over load 4.E25 without camber, the similarity method for combined slip section 4.2. Frame of the contact patch:
//! x along the wheel, y to its left, z along the normal of the road.

use serde::{Deserialize, Serialize};
use simworld_core::ops;

use super::parameters::Check;
use crate::error::PhysicsError;

/// The data of a tyre, in the normalised form of the Magic Formula. The defaults are the ADAMS tyre of the vehicle
/// models of `CommonRoad` (Althoff and Würsching 2020, table 7), with the dependence of friction on load that it leaves
/// out.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct TyreParameters {
    /// Load for which the other figures hold, N, 10 to 2e5.
    pub nominal_load: f64,
    /// Peak friction along the wheel at that load on dry asphalt, 0.1 to 3 (`p_dx1`).
    pub friction_x: f64,
    /// Peak friction across the wheel at that load on dry asphalt, 0.1 to 3 (`p_dy1`).
    pub friction_y: f64,
    /// Loss of peak friction when the load doubles, as a share, 0 to 0.5 (`-p_dx2`, `-p_dy2`).
    pub load_sensitivity: f64,
    /// Slip stiffness along the wheel as a multiple of the load, per unit of slip, 1 to 100 (`p_kx1`).
    pub stiffness_x: f64,
    /// Cornering stiffness at the nominal load as a multiple of it, 1/rad, 1 to 100 (about `-p_ky1`).
    pub stiffness_y: f64,
    /// Load at which the cornering stiffness is greatest, as a multiple of the nominal load, 1 to 100 (`p_ky2`). From
    /// 10 on the stiffness is all but proportional to the load.
    pub stiffness_peak: f64,
    /// Shape factor along the wheel, 1 to 2 (`p_cx1`): how much force is left when the wheel slides.
    pub shape_x: f64,
    /// Shape factor across the wheel, 1 to 2 (`p_cy1`).
    pub shape_y: f64,
    /// Relaxation length along the wheel, m, 0.01 to 2: the way after which slip has become force.
    pub relaxation_x: f64,
    /// Relaxation length across the wheel, m, 0.01 to 2.
    pub relaxation_y: f64,
    /// Rolling resistance as a share of the load, 0 to 0.1.
    pub rolling_resistance: f64,
}

impl Default for TyreParameters {
    fn default() -> Self {
        Self {
            nominal_load: 4000.0,
            friction_x: 1.1739,
            friction_y: 1.0489,
            load_sensitivity: 0.1,
            stiffness_x: 22.303,
            stiffness_y: 21.92,
            stiffness_peak: 3.0,
            shape_x: 1.6411,
            shape_y: 1.3507,
            relaxation_x: 0.15,
            relaxation_y: 0.45,
            rolling_resistance: 0.011,
        }
    }
}

/// A force in the contact patch, N.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PatchForce {
    /// Along the wheel.
    pub x: f64,
    /// To the left of the wheel.
    pub y: f64,
}

impl TyreParameters {
    pub(crate) fn validate(&self, check: &Check) -> Result<(), PhysicsError> {
        check.range("tyre.nominal_load", self.nominal_load, 10.0..=2e5, "10 to 2e5 N")?;
        check.range("tyre.friction_x", self.friction_x, 0.1..=3.0, "0.1 to 3")?;
        check.range("tyre.friction_y", self.friction_y, 0.1..=3.0, "0.1 to 3")?;
        check.range("tyre.load_sensitivity", self.load_sensitivity, 0.0..=0.5, "0 to 0.5")?;
        check.range("tyre.stiffness_x", self.stiffness_x, 1.0..=100.0, "1 to 100")?;
        check.range("tyre.stiffness_y", self.stiffness_y, 1.0..=100.0, "1 to 100 1/rad")?;
        check.range("tyre.stiffness_peak", self.stiffness_peak, 1.0..=100.0, "1 to 100")?;
        check.range("tyre.shape_x", self.shape_x, 1.0..=2.0, "1 to 2")?;
        check.range("tyre.shape_y", self.shape_y, 1.0..=2.0, "1 to 2")?;
        check.range("tyre.relaxation_x", self.relaxation_x, 0.01..=2.0, "0.01 to 2 m")?;
        check.range("tyre.relaxation_y", self.relaxation_y, 0.01..=2.0, "0.01 to 2 m")?;
        check.range("tyre.rolling_resistance", self.rolling_resistance, 0.0..=0.1, "0 to 0.1")
    }

    /// Share of the peak friction at a load, N: less than 1 above the nominal load.
    fn load_factor(&self, load: f64) -> f64 {
        (1.0 - self.load_sensitivity * (load / self.nominal_load - 1.0)).clamp(0.4, 1.2)
    }

    /// Greatest force along the wheel, N, at a load, N, on a surface of a grip (1 is dry asphalt).
    pub fn peak_x(&self, load: f64, grip: f64) -> f64 {
        self.friction_x * self.load_factor(load) * grip * load
    }

    /// Greatest force across the wheel, N.
    pub fn peak_y(&self, load: f64, grip: f64) -> f64 {
        self.friction_y * self.load_factor(load) * grip * load
    }

    /// Force per unit of slip along the wheel at small slip, N.
    pub fn slip_stiffness(&self, load: f64) -> f64 {
        self.stiffness_x * load
    }

    /// Force per unit of slip angle at small angles, N/rad. The formula's sin(2 atan(u)) is 2 u / (1 + u²).
    pub fn cornering_stiffness(&self, load: f64) -> f64 {
        let curve = |u: f64| 2.0 * u / (1.0 + u * u);
        let at_nominal = curve(1.0 / self.stiffness_peak);
        let scale = self.stiffness_y * self.nominal_load / at_nominal;
        scale * curve(load / (self.stiffness_peak * self.nominal_load))
    }

    /// The force for a slip: `slip` is (ω R - v) / v, positive when driving, and `tangent` is the tangent of the slip
    /// angle, positive when the wheel drifts to its left, whose force points to the right.
    ///
    /// Each slip is normalised by its stiffness and peak; their root of squares enters the formula, and the force
    /// splits as they do. So it stays within the ellipse of the two peaks, on it when the tyre slides.
    ///
    /// By hand: a load of 4000 N and 0.01 rad give 21.92 * 4000 * 0.01 = 877 N, less 1 % for the curve.
    pub fn force(&self, load: f64, grip: f64, slip: f64, tangent: f64) -> PatchForce {
        let (peak_x, peak_y) = (self.peak_x(load, grip), self.peak_y(load, grip));
        if peak_x <= 0.0 || peak_y <= 0.0 {
            return PatchForce::default();
        }
        let x = self.slip_stiffness(load) * slip / peak_x;
        let y = -self.cornering_stiffness(load) * tangent / peak_y;
        let square = x * x + y * y;
        if square < 1e-18 {
            return PatchForce { x: x * peak_x, y: y * peak_y };
        }
        let total = square.sqrt();
        let shape = (self.shape_x * x * x + self.shape_y * y * y) / square;
        let share = ops::sin(shape * libm_atan(total / shape)) / total;
        PatchForce { x: peak_x * share * x, y: peak_y * share * y }
    }

    /// Slip along the wheel at which the force is greatest: where C atan(s / C) is a right angle.
    pub fn slip_of_peak(&self, load: f64, grip: f64) -> f64 {
        let angle = std::f64::consts::FRAC_PI_2 / self.shape_x;
        let normalised = self.shape_x * ops::tan(angle);
        normalised * self.peak_x(load, grip) / self.slip_stiffness(load)
    }
}

/// Arctangent in (-π/2, π/2).
fn libm_atan(x: f64) -> f64 {
    ops::atan2(x, 1.0)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn small_slips_give_the_stiffness_and_large_ones_slide() {
        let tyre = TyreParameters::default();
        let force = tyre.force(4000.0, 1.0, 0.0, 0.001);
        assert!((force.y + 21.92 * 4.0).abs() < 0.1 && force.x == 0.0, "{force:?}");
        let force = tyre.force(4000.0, 1.0, 0.001, 0.0);
        assert!((force.x - 22.303 * 4.0).abs() < 0.1 && force.y == 0.0, "{force:?}");
        let peak = tyre.force(4000.0, 1.0, tyre.slip_of_peak(4000.0, 1.0), 0.0).x;
        assert!((peak - tyre.peak_x(4000.0, 1.0)).abs() < 1e-6, "{peak}");
        let locked = tyre.force(4000.0, 1.0, -1.0, 0.0).x;
        assert!(
            locked < -0.6 * peak && locked > -0.95 * peak,
            "a locked wheel brakes less: {locked} of {peak}"
        );
    }

    #[test]
    fn twice_the_load_is_less_than_twice_the_force() {
        let tyre = TyreParameters::default();
        assert!(tyre.peak_y(8000.0, 1.0) < 1.95 * tyre.peak_y(4000.0, 1.0));
        assert!(tyre.cornering_stiffness(8000.0) < 1.95 * tyre.cornering_stiffness(4000.0));
        assert_eq!(tyre.force(0.0, 1.0, 0.3, 0.3), PatchForce::default());
    }

    proptest! {
        #[test]
        fn force_opposes_slip_and_stays_in_the_ellipse(
            load in 1.0..2e4f64, grip in 0.02..1.2f64, slip in -1.0..3.0f64, tangent in -3.0..3.0f64,
        ) {
            let tyre = TyreParameters::default();
            let force = tyre.force(load, grip, slip, tangent);
            prop_assert!(force.x * slip >= 0.0 && force.y * tangent <= 0.0, "{force:?}");
            let (x, y) = (force.x / tyre.peak_x(load, grip), force.y / tyre.peak_y(load, grip));
            prop_assert!(x * x + y * y <= 1.0 + 1e-9, "{force:?}");
            // Less of the same where there is slip both ways.
            let pure = tyre.force(load, grip, 0.0, tangent);
            let small = tangent.abs() * tyre.cornering_stiffness(load) < 0.5 * tyre.peak_y(load, grip);
            prop_assert!(!small || force.y.abs() <= pure.y.abs() + 1e-9, "{force:?} {pure:?}");
        }
    }
}
