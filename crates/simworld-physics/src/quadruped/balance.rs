//! How feet on the ground hold the body: which forces, and by which torques.

use nalgebra::{Matrix6, UnitQuaternion, Vector6};
use simworld_core::geometry::Vector3;

use super::QuadrupedState;

/// What the body is to do next, world frame.
#[derive(Clone, Copy, Debug)]
pub(super) struct Aim {
    /// Where the centre of mass is to be and how it is to move, m and m/s.
    pub(super) place: Vector3,
    pub(super) velocity: Vector3,
    /// How the trunk is to be turned, and rad/s.
    pub(super) attitude: UnitQuaternion<f64>,
    pub(super) turning: Vector3,
}

/// How much of the ground's friction a foot counts on.
pub(super) const FRICTION: f64 = 0.6;
/// Stiffness, 1/s², and damping, 1/s, of place (level and upright) and attitude (tilt and heading).
const PLACE: [[f64; 2]; 2] = [[25.0, 9.0], [180.0, 22.0]];
const ATTITUDE: [[f64; 2]; 2] = [[320.0, 26.0], [120.0, 16.0]];
/// The greatest level acceleration asked for, m/s².
const HASTE: f64 = 5.0;
/// Radii of gyration of the whole about x, y and z, m.
const GYRATION: [f64; 3] = [0.10, 0.17, 0.19];
/// What the least squares pay for force and for torque that is not met, against the force of the feet: smaller is stricter.
const LOOSE: [f64; 2] = [2e-3, 1e-4];

/// Force and torque about the centre of mass that bring the body to its aim, N and N m.
fn wrench(aim: &Aim, sensed: &QuadrupedState, mass: f64, gravity: f64) -> Vector6<f64> {
    let (away, slow) = (aim.place - sensed.center, aim.velocity - sensed.linear);
    let [[k, d], [k_up, d_up]] = PLACE;
    let level = (away * k + slow * d).xy();
    let level = level * (HASTE / level.norm().max(HASTE));
    let upward = away.z * k_up + slow.z * d_up;
    let force = Vector3::new(level.x, level.y, (upward + gravity).max(0.2 * gravity)) * mass;
    // In the trunk's frame, where the inertia is that of the axes.
    let turn = sensed.trunk.rotation.inverse();
    let off = (turn * aim.attitude).scaled_axis();
    let slow = turn * (aim.turning - sensed.angular);
    let [[k, d], [k_yaw, d_yaw]] = ATTITUDE;
    let spin = Vector3::new(k * off.x + d * slow.x, k * off.y + d * slow.y, k_yaw * off.z + d_yaw * slow.z);
    let inertia = Vector3::from(GYRATION.map(|radius| mass * radius * radius));
    let torque = sensed.trunk.rotation * spin.component_mul(&inertia);
    Vector6::new(force.x, force.y, force.z, torque.x, torque.y, torque.z)
}

/// Forces on the feet that stand, world frame, N: the least ones that give the wrench nearly, each within the friction of the
/// ground whose slope is `normal`. `feet` are from the centre of mass, with a weight from 0 (in the air) to 1.
fn distribute(wrench: &Vector6<f64>, feet: &[(Vector3, f64); 4], normal: &Vector3) -> [Vector3; 4] {
    let mut weights = feet.map(|(_, weight)| weight);
    let mut forces = [Vector3::zeros(); 4];
    // A foot that would pull is let go, once.
    for _ in 0..2 {
        let mut gram = Matrix6::zeros();
        for (place, weight) in [0, 1, 2, 3].map(|foot| (feet[foot].0, weights[foot])) {
            let cross = place.cross_matrix();
            let mut add = |row: usize, column: usize, block: nalgebra::Matrix3<f64>| {
                let mut view = gram.fixed_view_mut::<3, 3>(row, column);
                view += block * weight;
            };
            add(0, 0, nalgebra::Matrix3::identity());
            add(3, 0, cross);
            add(0, 3, cross.transpose());
            add(3, 3, cross * cross.transpose());
        }
        for row in 0..6 {
            gram[(row, row)] += LOOSE[row / 3];
        }
        let Some(factors) = gram.cholesky() else { return forces };
        let dual = factors.solve(wrench);
        let (push, twist) = (dual.fixed_rows::<3>(0).into_owned(), dual.fixed_rows::<3>(3).into_owned());
        let mut pulled = false;
        for foot in 0..4 {
            // The transpose of `place ×` turns the other way round.
            forces[foot] = (push - feet[foot].0.cross(&twist)) * weights[foot];
            if weights[foot] > 0.0 && forces[foot].dot(normal) < 0.0 {
                weights[foot] = 0.0;
                pulled = true;
            }
        }
        if !pulled {
            break;
        }
    }
    forces.map(|force| within_friction(&force, normal))
}

fn within_friction(force: &Vector3, normal: &Vector3) -> Vector3 {
    let upright = force.dot(normal).max(0.0);
    let along = force - normal * force.dot(normal);
    let length = along.norm();
    let most = FRICTION * upright;
    let along = if length > most { along * (most / length) } else { along };
    normal * upright + along
}

/// Forces of the ground on the feet that bring the body to its aim, world frame, N.
pub(super) fn hold(
    aim: &Aim,
    sensed: &QuadrupedState,
    feet: &[(Vector3, f64); 4],
    normal: &Vector3,
    (mass, gravity): (f64, f64),
) -> [Vector3; 4] {
    distribute(&wrench(aim, sensed, mass, gravity), feet, normal)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square() -> [(Vector3, f64); 4] {
        [(0.2, 0.12), (0.2, -0.12), (-0.2, 0.12), (-0.2, -0.12)].map(|(x, y)| (Vector3::new(x, y, -0.3), 1.0))
    }

    fn of(forces: &[Vector3; 4], feet: &[(Vector3, f64); 4]) -> (Vector3, Vector3) {
        let force = forces.iter().sum();
        let torque = feet.iter().zip(forces).map(|((place, _), force)| place.cross(force)).sum();
        (force, torque)
    }

    #[test]
    fn the_feet_give_what_is_asked() {
        let feet = square();
        let asked = Vector6::new(6.0, -4.0, 125.0, 2.0, -3.0, 1.0);
        let (force, torque) = of(&distribute(&asked, &feet, &Vector3::z()), &feet);
        assert!((force - Vector3::new(6.0, -4.0, 125.0)).norm() < 0.5, "{force}");
        assert!((torque - Vector3::new(2.0, -3.0, 1.0)).norm() < 0.1, "{torque}");
    }

    #[test]
    fn no_foot_pulls_or_slides_and_none_in_the_air_pushes() {
        let mut feet = square();
        feet[1].1 = 0.0;
        let forces = distribute(&Vector6::new(80.0, 0.0, 60.0, 20.0, -30.0, 0.0), &feet, &Vector3::z());
        assert_eq!(forces[1], Vector3::zeros());
        for force in forces {
            assert!(force.z >= 0.0 && force.xy().norm() <= FRICTION * force.z + 1e-9, "{force}");
        }
    }
}
