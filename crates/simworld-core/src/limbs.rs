//! How somebody holds its limbs: joint angles by name, for whoever draws it.
//!
//! Frame: that of the trunk, x forward, y left, z up. Hips, shoulders and the neck are balls in sockets: a limb is led forward, then
//! aside, then turned about itself, as anatomists say it (International Society of Biomechanics, Wu and others, Journal of
//! Biomechanics 35, 2002, for the hip).

use std::f64::consts::FRAC_PI_2;

use nalgebra::{Quaternion, UnitQuaternion};
use serde::{Deserialize, Serialize};

use crate::geometry::Vector3;
use crate::ops;

/// A rotation.
type Rotation = UnitQuaternion<f64>;

/// Which of two limbs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// At positive y.
    Left,
    /// At negative y.
    Right,
}

impl Side {
    /// Both, the left first.
    pub const BOTH: [Self; 2] = [Self::Left, Self::Right];

    /// 1 on the left, -1 on the right.
    pub const fn sign(self) -> f64 {
        match self {
            Self::Left => 1.0,
            Self::Right => -1.0,
        }
    }
}

/// The angles of a leg, radians, zero while it hangs straight.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct LegAngles {
    /// Thigh forward.
    pub hip_flexion: f64,
    /// Thigh outwards, within ±π/2.
    pub hip_abduction: f64,
    /// Thigh turned about itself, toes outwards.
    pub hip_rotation: f64,
    /// Shank backward from the line of the thigh; never negative.
    pub knee_flexion: f64,
    /// Toes towards the shin from the right angle.
    pub ankle_dorsiflexion: f64,
}

impl LegAngles {
    /// How the thigh is turned from hanging straight, seen from the trunk.
    pub fn trunk_from_thigh(&self, side: Side) -> Rotation {
        ball(-self.hip_flexion, side.sign() * self.hip_abduction, side.sign() * self.hip_rotation)
    }

    /// With the thigh turned so.
    #[must_use]
    pub fn with_thigh(self, side: Side, trunk_from_thigh: &Rotation) -> Self {
        let [forward, aside, about] = ball_angles(trunk_from_thigh);
        let outwards = |angle| side.sign() * angle;
        let (hip_abduction, hip_rotation) = (outwards(aside), outwards(about));
        Self { hip_flexion: -forward, hip_abduction, hip_rotation, ..self }
    }
}

/// The angles of an arm, radians, zero while it hangs straight.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct ArmAngles {
    /// Upper arm forward.
    pub shoulder_flexion: f64,
    /// Upper arm outwards, within ±π/2; what is lifted farther is led forward by more than a right angle.
    pub shoulder_abduction: f64,
    /// Upper arm turned about itself, outwards.
    pub shoulder_rotation: f64,
    /// Forearm forward from the line of the upper arm; never negative.
    pub elbow_flexion: f64,
}

impl ArmAngles {
    /// How the upper arm is turned from hanging straight, seen from the trunk.
    pub fn trunk_from_upper_arm(&self, side: Side) -> Rotation {
        let [aside, about] =
            [self.shoulder_abduction, self.shoulder_rotation].map(|angle| side.sign() * angle);
        ball(-self.shoulder_flexion, aside, about)
    }

    /// With the upper arm turned so.
    #[must_use]
    pub fn with_upper_arm(self, side: Side, trunk_from_upper_arm: &Rotation) -> Self {
        let [forward, aside, about] = ball_angles(trunk_from_upper_arm);
        let outwards = |angle| side.sign() * angle;
        let (shoulder_abduction, shoulder_rotation) = (outwards(aside), outwards(about));
        Self { shoulder_flexion: -forward, shoulder_abduction, shoulder_rotation, ..self }
    }
}

/// The angles of the neck, radians, zero while the head is upright on the trunk.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct NeckAngles {
    /// Chin to the chest.
    pub flexion: f64,
    /// Crown to the left.
    pub tilt: f64,
    /// Face to the left.
    pub turn: f64,
}

impl NeckAngles {
    /// How the head is turned, seen from the trunk.
    pub fn trunk_from_head(&self) -> Rotation {
        ball(self.flexion, -self.tilt, self.turn)
    }

    /// Of a head that is turned so.
    pub fn of(trunk_from_head: &Rotation) -> Self {
        let [flexion, aside, turn] = ball_angles(trunk_from_head);
        Self { flexion, tilt: -aside, turn }
    }
}

/// How a person holds its limbs, seen from the trunk, which the entity's pose places.
///
/// Whoever moves people gives them out by [`World::set_joints`](crate::scene::World::set_joints), once a step; readers ask
/// [`Scene::joints`](crate::scene::Scene::joints). They follow from what else is known and are no part of what is saved.
///
/// A robot dog's fore legs stand here as arms and its hind legs as legs. All its knees bend the way elbows do, so those of the
/// hind legs are negative.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct JointAngles {
    /// The left leg.
    pub left_leg: LegAngles,
    /// The right leg.
    pub right_leg: LegAngles,
    /// The left arm.
    pub left_arm: ArmAngles,
    /// The right arm.
    pub right_arm: ArmAngles,
    /// The neck.
    pub neck: NeckAngles,
    /// How much lower the hips are than those of somebody who stands straight at the pose, m.
    pub hip_drop: f64,
}

impl JointAngles {
    /// Somebody of that height, m, who sits on a chair: its pose is on the seat, half a thigh under the hips.
    pub fn seated(height: f64) -> Self {
        /// How much lower the hips are over a seat than over the ground that one stands on, as a share of the height (Winter 2009: hips
        /// at 0.53).
        const DROP: f64 = 0.53 - 0.055;
        let leg = LegAngles { hip_flexion: FRAC_PI_2, knee_flexion: FRAC_PI_2, ..LegAngles::default() };
        let arm = ArmAngles { shoulder_flexion: 0.3, elbow_flexion: 1.0, ..ArmAngles::default() };
        let hip_drop = DROP * height;
        Self { left_leg: leg, right_leg: leg, left_arm: arm, right_arm: arm, hip_drop, ..Self::default() }
    }

    /// On the way from these angles to others, a share in [0, 1] of it: every limb the shortest way round.
    #[must_use]
    pub fn toward(&self, other: &Self, share: f64) -> Self {
        let mix = |from: f64, to: f64| from + (to - from) * share;
        let leg = |side: Side, from: &LegAngles, to: &LegAngles| {
            let thigh = between(&from.trunk_from_thigh(side), &to.trunk_from_thigh(side), share);
            LegAngles {
                knee_flexion: mix(from.knee_flexion, to.knee_flexion),
                ankle_dorsiflexion: mix(from.ankle_dorsiflexion, to.ankle_dorsiflexion),
                ..LegAngles::default()
            }
            .with_thigh(side, &thigh)
        };
        let arm = |side: Side, from: &ArmAngles, to: &ArmAngles| {
            let upper = between(&from.trunk_from_upper_arm(side), &to.trunk_from_upper_arm(side), share);
            let elbow_flexion = mix(from.elbow_flexion, to.elbow_flexion);
            ArmAngles { elbow_flexion, ..ArmAngles::default() }.with_upper_arm(side, &upper)
        };
        let head = between(&self.neck.trunk_from_head(), &other.neck.trunk_from_head(), share);
        Self {
            left_leg: leg(Side::Left, &self.left_leg, &other.left_leg),
            right_leg: leg(Side::Right, &self.right_leg, &other.right_leg),
            left_arm: arm(Side::Left, &self.left_arm, &other.left_arm),
            right_arm: arm(Side::Right, &self.right_arm, &other.right_arm),
            neck: NeckAngles::of(&head),
            hip_drop: mix(self.hip_drop, other.hip_drop),
        }
    }

    /// The angles by name, radians.
    pub fn named(&self) -> [(&'static str, f64); 21] {
        let Self { left_leg, right_leg, left_arm, right_arm, neck, .. } = self;
        [
            ("left hip", left_leg.hip_flexion),
            ("left hip abduction", left_leg.hip_abduction),
            ("left hip rotation", left_leg.hip_rotation),
            ("left knee", left_leg.knee_flexion),
            ("left ankle", left_leg.ankle_dorsiflexion),
            ("right hip", right_leg.hip_flexion),
            ("right hip abduction", right_leg.hip_abduction),
            ("right hip rotation", right_leg.hip_rotation),
            ("right knee", right_leg.knee_flexion),
            ("right ankle", right_leg.ankle_dorsiflexion),
            ("left shoulder", left_arm.shoulder_flexion),
            ("left shoulder abduction", left_arm.shoulder_abduction),
            ("left shoulder rotation", left_arm.shoulder_rotation),
            ("left elbow", left_arm.elbow_flexion),
            ("right shoulder", right_arm.shoulder_flexion),
            ("right shoulder abduction", right_arm.shoulder_abduction),
            ("right shoulder rotation", right_arm.shoulder_rotation),
            ("right elbow", right_arm.elbow_flexion),
            ("neck", neck.flexion),
            ("neck tilt", neck.tilt),
            ("neck turn", neck.turn),
        ]
    }
}

/// A turn about an axis of the trunk by an angle, radians.
fn turn(axis: &Vector3, angle: f64) -> Rotation {
    let (sin, cos) = ops::sin_cos(0.5 * angle);
    Rotation::new_unchecked(Quaternion::from_parts(cos, axis * sin))
}

/// A share of the shortest way from one rotation to another: along the chord, which is the same way at a little other pace.
fn between(from: &Rotation, to: &Rotation, share: f64) -> Rotation {
    let (a, b) = (from.coords, to.coords);
    let b = if a.dot(&b) < 0.0 { -b } else { b };
    let mixed = a + (b - a) * share;
    // Opposite rotations have no shortest way; then the chord goes through nothing.
    if mixed.norm() < 1e-6 { *to } else { Rotation::new_normalize(Quaternion::from(mixed)) }
}

/// Led forward, then aside, then turned about itself: Ry · Rx · Rz.
fn ball(about_y: f64, about_x: f64, about_z: f64) -> Rotation {
    turn(&Vector3::y(), about_y) * turn(&Vector3::x(), about_x) * turn(&Vector3::z(), about_z)
}

/// The angles about y, x and z that [`ball`] makes that rotation of; the one about x is within ±π/2.
fn ball_angles(rotation: &Rotation) -> [f64; 3] {
    let m = rotation.to_rotation_matrix();
    let about_x = ops::asin((-m[(1, 2)]).clamp(-1.0, 1.0));
    if m[(1, 0)].abs().max(m[(1, 1)].abs()) < 1e-9 {
        // Straight aside the other two are about one axis: all of it is given to the first.
        return [ops::atan2(-m[(2, 0)], m[(0, 0)]), about_x, 0.0];
    }
    [ops::atan2(m[(0, 2)], m[(2, 2)]), about_x, ops::atan2(m[(1, 0)], m[(1, 1)])]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::seed::Seed;

    fn apart(a: &Rotation, b: &Rotation) -> f64 {
        // Near 1 the angle of a quaternion is lost in the rounding; the chord of what it turns is not.
        [Vector3::x(), Vector3::y(), Vector3::z()].iter().map(|v| (a * v - b * v).norm()).fold(0.0, f64::max)
    }

    #[test]
    fn any_rotation_of_a_limb_is_told_exactly() {
        let mut rng = Seed(3).stream("test/limbs").rng();
        for _ in 0..2000 {
            let coords = [0; 4].map(|_| rng.normal(0.0, 1.0));
            let [w, x, y, z] = coords;
            let rotation = Rotation::from_quaternion(Quaternion::new(w, x, y, z));
            for side in Side::BOTH {
                let leg = LegAngles::default().with_thigh(side, &rotation);
                assert!(apart(&leg.trunk_from_thigh(side), &rotation) < 1e-9, "{leg:?}");
                let arm = ArmAngles::default().with_upper_arm(side, &rotation);
                assert!(apart(&arm.trunk_from_upper_arm(side), &rotation) < 1e-9, "{arm:?}");
            }
            assert!(apart(&NeckAngles::of(&rotation).trunk_from_head(), &rotation) < 1e-9);
        }
        let aside = turn(&Vector3::x(), FRAC_PI_2);
        let arm = ArmAngles::default().with_upper_arm(Side::Left, &aside);
        assert!(apart(&arm.trunk_from_upper_arm(Side::Left), &aside) < 1e-7, "straight aside: {arm:?}");
    }

    #[test]
    fn who_changes_its_stance_comes_from_one_to_the_other() {
        let flat =
            LegAngles { hip_flexion: 0.1, hip_abduction: 0.6, hip_rotation: -0.3, ..LegAngles::default() };
        let lies = JointAngles { left_leg: flat, hip_drop: 0.4, ..JointAngles::default() };
        let stands = JointAngles::default();
        let apart = |a: &JointAngles, b: &JointAngles| {
            let all = a.named().into_iter().zip(b.named()).map(|((_, a), (_, b))| (a - b).abs());
            all.fold((a.hip_drop - b.hip_drop).abs(), f64::max)
        };
        assert!(apart(&lies.toward(&stands, 0.0), &lies) < 1e-12);
        assert!(apart(&lies.toward(&stands, 1.0), &stands) < 1e-12);
        let half = lies.toward(&stands, 0.5);
        assert!((half.left_leg.hip_abduction - 0.3).abs() < 0.05 && (half.hip_drop - 0.2).abs() < 1e-12);
    }

    #[test]
    fn limbs_go_where_their_angles_say() {
        let down = -Vector3::z();
        let hangs = |leg: LegAngles, side| leg.trunk_from_thigh(side) * down;
        let forward = LegAngles { hip_flexion: 0.5, ..LegAngles::default() };
        assert!(hangs(forward, Side::Left).x > 0.4 && hangs(forward, Side::Right).x > 0.4);
        let outwards = LegAngles { hip_abduction: 0.5, ..LegAngles::default() };
        assert!(hangs(outwards, Side::Left).y > 0.4 && hangs(outwards, Side::Right).y < -0.4);
        let toes = LegAngles { hip_rotation: 0.5, ..LegAngles::default() };
        let ahead = |side| toes.trunk_from_thigh(side) * Vector3::x();
        assert!(ahead(Side::Left).y > 0.4 && ahead(Side::Right).y < -0.4, "toes outwards");
        let crown = |neck: NeckAngles| neck.trunk_from_head() * Vector3::z();
        assert!(crown(NeckAngles { flexion: 0.5, ..NeckAngles::default() }).x > 0.4);
        assert!(crown(NeckAngles { tilt: 0.5, ..NeckAngles::default() }).y > 0.4);
    }
}
