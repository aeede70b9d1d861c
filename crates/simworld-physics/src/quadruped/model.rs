//! What a quadruped is made of, as data.

use serde::{Deserialize, Serialize};
use simworld_core::geometry::Vector3;

use super::kinematics::Leg;
use crate::error::{PhysicsError, check_range};

/// Lengths, masses and motors of a quadruped with four equal legs of three motors each.
///
/// The default is a small research robot like the Unitree Go1: thigh and shank 0.213 m, hips 0.08 m wide, 13 kg, motors of
/// 24 N m and at the knees 36 N m (its data sheet says 23.7 and 35.55), stops as its makers publish them, rounded; masses
/// and inertias are ours and of its order.
///
/// Joints are counted from the trunk: abduction about x, thigh about y, knee about y (trunk frame: x forward, y left, z up).
/// At zero a leg hangs straight; a positive thigh swings back, and knees bend to negative angles.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct QuadrupedModel {
    /// Mass of the trunk with what it carries, kg, 1 to 60.
    pub trunk_mass: f64,
    /// Moments of inertia of the trunk about x, y and z through its middle, kg m², 1e-4 to 10.
    pub trunk_inertia: [f64; 3],
    /// Half the length of the trunk, which is met as a capsule along x, m, 0.05 to 1.
    pub trunk_half_length: f64,
    /// Radius of that capsule, m, 0.03 to 0.3.
    pub trunk_radius: f64,
    /// The first joints from the middle of the trunk, forward and aside, m, 0.02 to 1.
    pub hip: [f64; 2],
    /// From the first joint to the plane of the leg, m, 0 to 0.3.
    pub hip_offset: f64,
    /// Length of the thigh, m, 0.05 to 0.6.
    pub thigh: f64,
    /// Length of the shank to the middle of the foot, m, 0.05 to 0.6.
    pub shank: f64,
    /// Radius of the foot, a ball of rubber, m, 0.005 to 0.1.
    pub foot_radius: f64,
    /// Mass of the hip, the thigh and the shank with its foot, kg, 0.01 to 10.
    pub leg_masses: [f64; 3],
    /// How far down the thigh and the shank their centres of mass are, as shares of their lengths, 0 to 1. The motors of
    /// hip and knee sit at the upper end.
    pub leg_centers: [f64; 2],
    /// The greatest torque of the motors at abduction, thigh and knee, N m, 0 to 500.
    pub torques: [f64; 3],
    /// Inertia of a motor as its joint feels it, kg m², 1e-4 to 1.
    pub armature: f64,
    /// Viscous friction of a joint, N m s/rad, 0 to 5.
    pub damping: f64,
    /// Where the joints end, from and to, radians, -7 to 7. The abduction is that of the left legs, positive when they
    /// swing out to the left; that of the right legs is its mirror image.
    pub limits: [[f64; 2]; 3],
}

impl Default for QuadrupedModel {
    fn default() -> Self {
        Self {
            trunk_mass: 6.0,
            trunk_inertia: [0.02, 0.07, 0.08],
            trunk_half_length: 0.26,
            trunk_radius: 0.07,
            hip: [0.19, 0.047],
            hip_offset: 0.08,
            thigh: 0.213,
            shank: 0.213,
            foot_radius: 0.02,
            leg_masses: [0.55, 0.9, 0.22],
            leg_centers: [0.15, 0.45],
            torques: [24.0, 24.0, 36.0],
            armature: 0.01,
            damping: 0.05,
            limits: [[-0.86, 0.86], [-0.69, 4.5], [-2.82, -0.89]],
        }
    }
}

impl QuadrupedModel {
    /// Checks every field.
    ///
    /// # Errors
    /// The first field out of range, with what is allowed.
    pub fn validate(&self) -> Result<(), PhysicsError> {
        let check =
            |field, value, range, allowed| check_range("QuadrupedModel", field, value, range, allowed);
        check("trunk_mass", self.trunk_mass, 1.0..=60.0, "1 to 60 kg")?;
        for inertia in self.trunk_inertia {
            check("trunk_inertia", inertia, 1e-4..=10.0, "1e-4 to 10 kg m²")?;
        }
        check("trunk_half_length", self.trunk_half_length, 0.05..=1.0, "0.05 to 1 m")?;
        check("trunk_radius", self.trunk_radius, 0.03..=0.3, "0.03 to 0.3 m")?;
        for place in self.hip {
            check("hip", place, 0.02..=1.0, "0.02 to 1 m")?;
        }
        check("hip_offset", self.hip_offset, 0.0..=0.3, "0 to 0.3 m")?;
        check("thigh", self.thigh, 0.05..=0.6, "0.05 to 0.6 m")?;
        check("shank", self.shank, 0.05..=0.6, "0.05 to 0.6 m")?;
        check("foot_radius", self.foot_radius, 0.005..=0.1, "0.005 to 0.1 m")?;
        for mass in self.leg_masses {
            check("leg_masses", mass, 0.01..=10.0, "0.01 to 10 kg")?;
        }
        for share in self.leg_centers {
            check("leg_centers", share, 0.0..=1.0, "0 to 1")?;
        }
        for torque in self.torques {
            check("torques", torque, 0.0..=500.0, "0 to 500 N m")?;
        }
        check("armature", self.armature, 1e-4..=1.0, "1e-4 to 1 kg m²")?;
        check("damping", self.damping, 0.0..=5.0, "0 to 5 N m s/rad")?;
        for [low, high] in self.limits {
            check("limits", low, -7.0..=7.0, "-7 to 7 rad")?;
            check("limits", high, low..=7.0, "no less than the lower end, and up to 7 rad")?;
        }
        Ok(())
    }

    /// The mass of the whole, kg.
    pub fn mass(&self) -> f64 {
        self.trunk_mass + 4.0 * self.leg_masses.iter().sum::<f64>()
    }

    /// Height of the middle of the trunk over the soles when it stands, m: two thirds of the length of its legs.
    pub fn standing_height(&self) -> f64 {
        (self.thigh + self.shank) * 0.64 + self.foot_radius
    }

    /// The angles of the joints of a body that stands on level ground, radians; legs as in [`LEGS`](super::LEGS).
    pub fn standing_angles(&self) -> [[f64; 3]; 4] {
        std::array::from_fn(|leg| self.standing(leg, self.standing_height()))
    }

    /// The centre of mass of the whole, m, in the frame of the middle of the trunk, with the joints at such angles, radians; legs as in
    /// [`LEGS`](super::LEGS).
    pub fn center_of_mass(&self, angles: &[[f64; 3]; 4]) -> Vector3 {
        let limbs = (0..4).flat_map(|leg| {
            let centers = self.leg(leg).centers(&angles[leg], self.leg_centers);
            centers.into_iter().zip(self.leg_masses).map(|(center, mass)| center * mass)
        });
        limbs.sum::<Vector3>() / self.mass()
    }

    /// Where a joint of a leg ends, from and to, radians; legs as in [`LEGS`](super::LEGS).
    pub fn limits_of(&self, leg: usize, joint: usize) -> [f64; 2] {
        let [low, high] = self.limits[joint];
        if joint == 0 && leg % 2 == 1 { [-high, -low] } else { [low, high] }
    }

    /// One leg: front left, front right, rear left, rear right.
    pub(super) fn leg(&self, leg: usize) -> Leg {
        let (ahead, left) =
            (if leg < 2 { 1.0 } else { -1.0 }, if leg.is_multiple_of(2) { 1.0 } else { -1.0 });
        Leg {
            hip: Vector3::new(ahead * self.hip[0], left * self.hip[1], 0.0),
            offset: left * self.hip_offset,
            thigh: self.thigh,
            shank: self.shank,
        }
    }

    /// The angles at which a leg stands with the trunk so high over the soles, m.
    pub(super) fn standing(&self, leg: usize, height: f64) -> [f64; 3] {
        let leg = self.leg(leg);
        leg.reach(&(leg.hip + Vector3::new(0.0, leg.offset, self.foot_radius - height)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_default_is_the_robot_it_says() {
        let model = QuadrupedModel::default();
        model.validate().unwrap();
        assert!((12.0..=13.0).contains(&model.mass()), "{}", model.mass());
        for leg in 0..4 {
            let q = model.standing(leg, model.standing_height());
            for (joint, angle) in q.into_iter().enumerate() {
                let [low, high] = model.limits_of(leg, joint);
                assert!((low..=high).contains(&angle), "leg {leg}, joint {joint}: {angle}");
            }
        }
    }

    #[test]
    fn absurd_data_is_refused_by_name() {
        let absurd = QuadrupedModel { thigh: f64::NAN, ..QuadrupedModel::default() };
        assert!(absurd.validate().unwrap_err().to_string().contains("thigh"));
        let crossed = QuadrupedModel { limits: [[0.5, -0.5]; 3], ..QuadrupedModel::default() };
        assert!(crossed.validate().unwrap_err().to_string().contains("limits"));
    }
}
