//! Whole people of few triangles, for who is a few pixels high: the rough parts of a body in one posture.

use nalgebra::UnitQuaternion;
use simworld_core::geometry::{Pose, Vector3};

use super::builder::{Builder, Material};
use super::people::{
    Grain, HIP, HIP_WIDTH, Hair, NECK, SHANK, SHOULDER, SHOULDER_WIDTH, THIGH, UPPER_ARM, WAIST, chest, foot,
    forearm, head, pelvis, shank, thigh, upper_arm,
};

/// How the limbs of a person are held.
#[derive(Clone, Copy)]
pub(crate) enum Stance {
    Standing,
    /// In the middle of a stride.
    Walking,
    /// Legs bent; the origin is on the seat.
    Sitting,
}

/// A part at an offset, its limb turned forward.
fn place(parent: &Pose, offset: [f64; 3], forward: f64) -> Pose {
    let turn = UnitQuaternion::from_axis_angle(&Vector3::y_axis(), -forward);
    parent * Pose::from_parts(Vector3::from(offset).into(), turn)
}

pub(crate) fn person(stance: Stance) -> Builder {
    let mut mesh = Builder::new([1.0; 3], 1.0);
    let grain = Grain::Rough;
    let (hips, flexion, knees, arms, elbow) = match stance {
        Stance::Standing => (HIP, [0.03, 0.03], [0.06, 0.06], [0.03, 0.03], 0.2),
        Stance::Walking => (0.51, [0.42, -0.32], [0.12, 0.3], [-0.35, 0.35], 0.35),
        Stance::Sitting => (0.055, [1.48, 1.48], [1.45, 1.45], [0.45, 0.45], 0.8),
    };
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
        let hip = place(&hips, [0.0, HIP_WIDTH * side, 0.0], flexion[k]);
        let knee = place(&hip, [0.0, 0.0, -THIGH], -knees[k]);
        mesh.append(&thigh(grain), &hip, &legs);
        mesh.append(&shank(grain), &knee, &legs);
        mesh.append(&foot(grain), &place(&knee, [0.0, 0.0, -SHANK], 0.0), &|_| Material::Dark);
        let shoulder = place(&waist, [0.0, SHOULDER_WIDTH * side, SHOULDER], arms[k]);
        mesh.append(&upper_arm(grain), &shoulder, &body);
        mesh.append(&forearm(grain), &place(&shoulder, [0.0, 0.0, -UPPER_ARM], elbow), &skin);
    }
    mesh
}
