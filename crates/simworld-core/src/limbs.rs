//! How somebody holds its limbs: joint angles by name, for whoever draws it.

use std::f64::consts::FRAC_PI_2;

/// The angles of a leg, radians, zero while it hangs straight.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LegAngles {
    /// Thigh forward.
    pub hip_flexion: f64,
    /// Shank backward from the line of the thigh; never negative.
    pub knee_flexion: f64,
    /// Toes towards the shin from the right angle.
    pub ankle_dorsiflexion: f64,
}

/// The angles of an arm, radians, zero while it hangs straight.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ArmAngles {
    /// Upper arm forward.
    pub shoulder_flexion: f64,
    /// Forearm forward from the line of the upper arm; never negative.
    pub elbow_flexion: f64,
}

/// How a person holds its limbs, seen from the trunk, which the entity's pose places: angles in the plane of its x and z
/// axes.
///
/// Whoever moves people gives them out by [`World::set_joints`](crate::scene::World::set_joints), once a step; readers ask
/// [`Scene::joints`](crate::scene::Scene::joints). They follow from what else is known and are no part of what is saved.
///
/// A robot dog's fore legs stand here as arms and its hind legs as legs. All its knees bend the way elbows do, so those of the
/// hind legs are negative.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct JointAngles {
    /// The left leg.
    pub left_leg: LegAngles,
    /// The right leg.
    pub right_leg: LegAngles,
    /// The left arm.
    pub left_arm: ArmAngles,
    /// The right arm.
    pub right_arm: ArmAngles,
    /// How much lower the hips are than those of somebody who stands straight at the pose, m.
    pub hip_drop: f64,
}

impl JointAngles {
    /// Somebody who sits on a chair.
    pub fn seated() -> Self {
        let leg = LegAngles { hip_flexion: FRAC_PI_2, knee_flexion: FRAC_PI_2, ankle_dorsiflexion: 0.0 };
        let arm = ArmAngles { shoulder_flexion: 0.3, elbow_flexion: 1.0 };
        Self { left_leg: leg, right_leg: leg, left_arm: arm, right_arm: arm, hip_drop: 0.0 }
    }

    /// The angles by name, radians.
    pub fn named(&self) -> [(&'static str, f64); 10] {
        let Self { left_leg, right_leg, left_arm, right_arm, .. } = self;
        [
            ("left hip", left_leg.hip_flexion),
            ("left knee", left_leg.knee_flexion),
            ("left ankle", left_leg.ankle_dorsiflexion),
            ("right hip", right_leg.hip_flexion),
            ("right knee", right_leg.knee_flexion),
            ("right ankle", right_leg.ankle_dorsiflexion),
            ("left shoulder", left_arm.shoulder_flexion),
            ("left elbow", left_arm.elbow_flexion),
            ("right shoulder", right_arm.shoulder_flexion),
            ("right elbow", right_arm.elbow_flexion),
        ]
    }
}
