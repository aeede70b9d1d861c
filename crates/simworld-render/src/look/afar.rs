//! Which whole figure stands for somebody who is a few pixels high, if one does.

use simworld_core::geometry::Vector3;
use simworld_core::limbs::Side;
use simworld_core::scene::{EntityRef, Scene};

use super::posture::{Posture, held};
use crate::mesh::MeshId;
use crate::mesh::figures::{Ends, Stance};
use crate::mesh::people::{FOREARM, SHANK, THIGH, UPPER_ARM};

/// Hips, feet and hands of a figure are no farther than this from those of whom it stands for, in heights. Arms may swing as those of
/// who runs.
const NEAR: [f64; 3] = [0.1, 0.26, 0.4];

/// The figure whose hips, feet and hands are nearest to those of somebody; none if even those are elsewhere, as of who lies or crouches.
/// Gestures and loads are not seen from afar.
pub(super) fn stance_of(entity: &EntityRef<'_>, scene: &dyn Scene, height: f64, seed: f64) -> Option<MeshId> {
    let ends = held(entity, scene, height, seed).ends(height);
    // The greatest distance as a share of what is allowed.
    let apart = |stance: Stance| {
        let pairs = ends.iter().zip(stance.ends()).zip(NEAR);
        let far = |((a, b), near): ((&[Vector3; 2], [Vector3; 2]), f64)| {
            a.iter().zip(b).map(|(a, b)| (a - b).norm() / near).fold(0.0, f64::max)
        };
        pairs.map(far).fold(0.0, f64::max)
    };
    let all = Stance::ALL.iter().map(|(stance, mesh)| (apart(*stance), *mesh));
    let (apart, mesh) = all.min_by(|a, b| a.0.total_cmp(&b.0))?;
    (apart < 1.0).then_some(mesh)
}

impl Posture {
    /// Where the hips, the ankles and the hands are.
    pub(super) fn ends(&self, height: f64) -> Ends {
        let [_, chest] = self.trunk(height);
        let down = -Vector3::z();
        let foot = |k: usize| {
            let (side, leg) = (Side::BOTH[k], &self.legs[k]);
            let thigh = leg.trunk_from_thigh(side);
            let shank = thigh * super::posture::pitch(leg.knee_flexion);
            self.hip(side.sign(), height) / height + thigh * down * THIGH + shank * down * SHANK
        };
        let hand = |k: usize| {
            let (side, arm) = (Side::BOTH[k], &self.arms[k]);
            let forearm = arm.shoulder * super::posture::pitch(-arm.elbow);
            let reach = arm.shoulder * down * UPPER_ARM + forearm * down * FOREARM;
            let at = chest * nalgebra::Point3::from(Self::shoulder(side.sign(), height) + reach * height);
            at.coords / height
        };
        [[self.hips / height; 2], [foot(0), foot(1)], [hand(0), hand(1)]]
    }
}

#[cfg(test)]
mod tests {
    use simworld_core::geometry::{Point3, Pose, Twist, pose_facing};
    use simworld_core::limbs::JointAngles;
    use simworld_core::scene::{EntityDesc, EntityKind, Shape, World};

    use super::*;

    fn stance(speed: f64, way: f64, joints: Option<JointAngles>) -> Option<MeshId> {
        let mut world = World::new();
        let pose: Pose = pose_facing(Point3::new(way, 0.0, 0.0), 0.0);
        let id = world
            .spawn(EntityDesc::new(EntityKind::Person, pose, Shape::Capsule { radius: 0.25, height: 1.8 }))
            .unwrap();
        let twist = Twist { linear: Vector3::x() * speed, angular: Vector3::zeros() };
        world.set_motion(id, pose, twist).unwrap();
        if let Some(joints) = joints {
            world.set_joints(id, joints).unwrap();
        }
        stance_of(&world.entity(id).unwrap(), &world, 1.8, 0.4)
    }

    /// Whoever walks or runs has a figure at every moment of its stride, and each of them in turn.
    #[test]
    fn figures_swing_their_legs_with_the_way() {
        for (speed, least) in [(1.0, 3), (1.4, 4), (2.8, 4)] {
            let seen: Vec<MeshId> =
                (0..100).map(|k| stance(speed, 0.02 * f64::from(k), None).expect("a figure")).collect();
            let mut each = seen.clone();
            each.sort_unstable();
            each.dedup();
            assert!(each.len() >= least && !each.contains(&MeshId::Sitting), "{speed} m/s: {each:?}");
        }
        assert_eq!(stance(0.0, 0.0, None), Some(MeshId::Standing));
        assert_eq!(stance(0.0, 0.0, Some(JointAngles::default())), Some(MeshId::Standing));
        assert_eq!(stance(0.0, 0.0, Some(JointAngles::seated(1.8))), Some(MeshId::Sitting));
    }

    #[test]
    fn nobody_who_crouches_or_has_fallen_is_an_upright_figure() {
        let mut crouched = JointAngles::default();
        for leg in [&mut crouched.left_leg, &mut crouched.right_leg] {
            (leg.hip_flexion, leg.knee_flexion) = (1.3, 2.1);
        }
        crouched.hip_drop = 0.5;
        assert_eq!(stance(0.0, 0.0, Some(crouched)), None);
        let mut sprawling = JointAngles::default();
        sprawling.left_arm.shoulder_abduction = 1.4;
        assert_eq!(stance(0.0, 0.0, Some(sprawling)), None);
    }
}
