//! Dogs and robot dogs: a trunk on four legs of two segments.

use simworld_core::geometry::{Pose, Vector3};
use simworld_core::ops;
use simworld_core::scene::{EntityRef, Scene};

use super::posture::pitch;
use super::{Detail, Look, Part, pick, way};
use crate::mesh::MeshId;

/// Thigh and shank, in heights of the body.
const SEGMENT: f64 = 0.34;

/// Hip and knee of one leg: forward is positive, and the knee bends backward.
type Leg = [f64; 2];

/// A dog as it is drawn at that detail.
pub(super) fn dress(
    entity: &EntityRef<'_>,
    scene: &dyn Scene,
    look: &Look,
    bits: u64,
    detail: Detail,
    parts: &mut Vec<Part>,
) {
    let robot = scene.joints(entity.id).is_some()
        || super::asset_name(entity, scene).is_some_and(|name| name.contains("robot"));
    let coat = pick(&[[0.25, 0.14, 0.06], [0.05, 0.04, 0.035], [0.5, 0.38, 0.22], [0.42, 0.4, 0.37]], bits);
    let color = super::own_color(entity, scene).unwrap_or(if robot { [0.7, 0.48, 0.04] } else { coat });
    let second = if robot { [0.03; 3] } else { color.map(|channel| channel * 0.55) };
    let [length, width, height] = look.scale.map(f64::from);
    let body = Look { unit: height as f32, color, second, ..*look };
    if detail == Detail::Far {
        parts.push(Part { look: Look { mesh: MeshId::Dog, unit: 1.0, ..body }, place: Pose::identity() });
        return;
    }
    let legs = legs_of(entity, scene, length, height);
    let drop = legs.iter().map(|leg| reach(leg, height)).fold(0.0, f64::max);
    let (trunk, thigh, shank) = if robot {
        (MeshId::RobotTrunk, MeshId::RobotThigh, MeshId::RobotShank)
    } else {
        (MeshId::DogTrunk, MeshId::DogThigh, MeshId::DogShank)
    };
    let at = |x: f64, y: f64, z: f64| Pose::from_parts(Vector3::new(x, y, z).into(), pitch(0.0));
    let turn = |angle: f64| Pose::from_parts(Vector3::zeros().into(), pitch(angle));
    parts.push(Part { look: Look { mesh: trunk, ..body }, place: at(0.0, 0.0, drop) });
    let spots = [[0.3, 0.42], [0.3, -0.42], [-0.32, 0.42], [-0.32, -0.42]];
    for ([x, y], [hip, knee]) in spots.into_iter().zip(legs) {
        let side = if robot { y } else { y * 0.6 };
        let upper = at(x * length, side * width, drop) * turn(-hip);
        let lower = upper * at(0.0, 0.0, -SEGMENT * height) * turn(knee);
        parts.push(Part { look: Look { mesh: thigh, ..body }, place: upper });
        parts.push(Part { look: Look { mesh: shank, ..body }, place: lower });
    }
}

/// How far below the hip the foot is.
fn reach([hip, knee]: &Leg, height: f64) -> f64 {
    height * (SEGMENT * (ops::cos(*hip) + ops::cos(hip - knee)) + 0.03)
}

/// Fore left, fore right, hind left, hind right.
fn legs_of(entity: &EntityRef<'_>, scene: &dyn Scene, length: f64, height: f64) -> [Leg; 4] {
    if let Some(joints) = scene.joints(entity.id) {
        let arms = [joints.left_arm, joints.right_arm].map(|arm| [arm.shoulder_flexion, -arm.elbow_flexion]);
        let legs = [joints.left_leg, joints.right_leg].map(|leg| [leg.hip_flexion, leg.knee_flexion]);
        return [arms[0], arms[1], legs[0], legs[1]];
    }
    let speed = entity.twist.ground_speed();
    let swing = if speed < 0.1 { 0.0 } else { (0.2 + 0.15 * speed).min(0.55) };
    let phase = std::f64::consts::TAU * way(entity) / (length.max(height) * 1.1);
    // Diagonal legs go together, as in a trot.
    [0.0, 0.5, 0.5, 0.0].map(|shift| {
        let angle = phase + std::f64::consts::TAU * shift;
        let lift = if swing > 0.0 { 0.5 * (-ops::sin(angle)).max(0.0) } else { 0.0 };
        [-0.35 + swing * ops::cos(angle), -0.75 - lift]
    })
}
