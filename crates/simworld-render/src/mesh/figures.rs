//! Whole people of few triangles, for who is a few pixels high: the rough parts of a body in one posture.

use nalgebra::UnitQuaternion;
use simworld_core::geometry::{Pose, Vector3};
use simworld_core::ops;

use super::MeshId;
use super::builder::{Builder, Material};
use super::people::{
    FOREARM, Grain, HIP, HIP_WIDTH, Hair, NECK, SHANK, SHOULDER, SHOULDER_WIDTH, THIGH, UPPER_ARM, WAIST,
    chest, foot, forearm, head, pelvis, shank, thigh, upper_arm,
};

/// How the limbs of a person are held.
#[derive(Clone, Copy)]
pub(crate) enum Stance {
    Standing,
    /// In a stride: by how much of it the left foot is ahead of the right one.
    Walking(f64),
    /// Legs bent; the origin is on the seat.
    Sitting,
}

/// Lengths as shares of the height, angles in radians, the left limb first.
struct Held {
    /// Of the hips over the origin.
    hips: f64,
    /// Thighs forward, shanks back.
    legs: [[f64; 2]; 2],
    /// Upper arms forward.
    arms: [f64; 2],
    elbow: f64,
}

/// Hips, ankles and hands of somebody, the left ones first, in heights; frame of its entity.
pub(crate) type Ends = [[Vector3; 2]; 3];

impl Stance {
    /// Each with the mesh of somebody who holds its limbs so.
    pub(crate) const ALL: [(Self, MeshId); 6] = [
        (Self::Standing, MeshId::Standing),
        (Self::Walking(1.0), MeshId::Walking),
        (Self::Walking(0.5), MeshId::WalkingLeft),
        (Self::Walking(-0.5), MeshId::WalkingRight),
        (Self::Walking(-1.0), MeshId::WalkingFarRight),
        (Self::Sitting, MeshId::Sitting),
    ];

    fn held(self) -> Held {
        match self {
            Self::Standing => Held { hips: HIP, legs: [[0.03, 0.06]; 2], arms: [0.03; 2], elbow: 0.2 },
            Self::Walking(ahead) => {
                let leg = |ahead: f64| {
                    let bent = if ahead > 0.0 { 0.12 } else { 0.3 };
                    [0.05 + 0.37 * ahead, bent * ahead.abs()]
                };
                Held {
                    hips: HIP - 0.02 * ahead * ahead,
                    legs: [leg(ahead), leg(-ahead)],
                    arms: [-0.35 * ahead, 0.35 * ahead],
                    elbow: 0.35,
                }
            }
            Self::Sitting => Held { hips: 0.055, legs: [[1.48, 1.45]; 2], arms: [0.45; 2], elbow: 0.8 },
        }
    }

    /// Where the hips, the ankles and the hands are, the left ones first, in heights.
    pub(crate) fn ends(self) -> Ends {
        let Held { hips, legs, arms, elbow } = self.held();
        let hang = |[x, y, z]: [f64; 3], upper: f64, lengths: [f64; 2], lower: f64| {
            let along = |f: fn(f64) -> f64| lengths[0] * f(upper) + lengths[1] * f(lower);
            Vector3::new(x + along(ops::sin), y, z - along(ops::cos))
        };
        let sides = [1.0, -1.0];
        let foot = |k: usize| {
            let [thigh, knee] = legs[k];
            hang([0.0, HIP_WIDTH * sides[k], hips], thigh, [THIGH, SHANK], thigh - knee)
        };
        let hand = |k: usize| {
            let shoulder = [0.0, SHOULDER_WIDTH * sides[k], hips + WAIST + SHOULDER];
            hang(shoulder, arms[k], [UPPER_ARM, FOREARM], arms[k] + elbow)
        };
        [[Vector3::z() * hips; 2], [foot(0), foot(1)], [hand(0), hand(1)]]
    }
}

/// A part at an offset, its limb turned forward.
fn place(parent: &Pose, offset: [f64; 3], forward: f64) -> Pose {
    let turn = UnitQuaternion::from_axis_angle(&Vector3::y_axis(), -forward);
    parent * Pose::from_parts(Vector3::from(offset).into(), turn)
}

pub(crate) fn person(stance: Stance) -> Builder {
    let mut mesh = Builder::new([1.0; 3], 1.0);
    let grain = Grain::Rough;
    let Held { hips, legs: held, arms, elbow } = stance.held();
    let hips = place(&Pose::identity(), [0.0, 0.0, hips], 0.0);
    let waist = place(&hips, [0.0, 0.0, WAIST], 0.0);
    let body = |_| Material::Body;
    let legs = |_| Material::Second;
    let skin = |_| Material::Skin;
    mesh.append(&pelvis(grain), &hips, &legs);
    mesh.append(&chest(grain), &waist, &body);
    let neck = place(&waist, [0.0, 0.0, NECK], 0.0);
    let of_head =
        |material| if material == Material::Second as u32 { Material::Hair } else { Material::Skin };
    mesh.append(&head(grain, Hair::Short), &neck, &of_head);
    for (k, side) in [1.0, -1.0].into_iter().enumerate() {
        let hip = place(&hips, [0.0, HIP_WIDTH * side, 0.0], held[k][0]);
        let knee = place(&hip, [0.0, 0.0, -THIGH], -held[k][1]);
        mesh.append(&thigh(grain), &hip, &legs);
        mesh.append(&shank(grain), &knee, &legs);
        mesh.append(&foot(grain), &place(&knee, [0.0, 0.0, -SHANK], 0.0), &|_| Material::Dark);
        let shoulder = place(&waist, [0.0, SHOULDER_WIDTH * side, SHOULDER], arms[k]);
        mesh.append(&upper_arm(grain), &shoulder, &body);
        mesh.append(&forearm(grain), &place(&shoulder, [0.0, 0.0, -UPPER_ARM], elbow), &skin);
    }
    mesh
}
