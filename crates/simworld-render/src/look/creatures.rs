//! Dogs and robot dogs: a trunk on four legs of two segments.

use nalgebra::UnitQuaternion;
use simworld_core::geometry::{Pose, Vector3};
use simworld_core::limbs::{ArmAngles, LegAngles, Side};
use simworld_core::ops;
use simworld_core::scene::{EntityRef, Scene};

use super::posture::pitch;
use super::{Detail, Look, Part, pick, way};
use crate::mesh::MeshId;
use crate::mesh::creatures::FAR_STRIDE;

/// Thigh and shank, in heights of the body.
const SEGMENT: f64 = 0.34;

/// How the legs of a robot stand that stands: thigh and shank as far from upright, radians. Its trunk is always so high over the origin of its
/// entity, which moves with it.
const STANCE: f64 = 0.876;
/// A robot whose longest leg reaches a smaller share than this of what it stands on lies or crouches.
const LOW: f64 = 0.75;

/// One leg: how the thigh is turned from hanging straight, and the knee, which bends backward if negative.
#[derive(Clone, Copy)]
struct Leg {
    thigh: UnitQuaternion<f64>,
    knee: f64,
}

impl Leg {
    /// With the thigh so far forward.
    fn forward(hip: f64, knee: f64) -> Self {
        Self { thigh: pitch(-hip), knee }
    }

    /// From the hip to the paw, in heights.
    fn paw(&self) -> Vector3 {
        let down = -Vector3::z() * SEGMENT;
        self.thigh * (down + pitch(self.knee) * down)
    }
}

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
    let legs = legs_of(entity, scene, length, height);
    let reach = legs.iter().map(|leg| height * (0.03 - leg.paw().z)).fold(0.0, f64::max);
    let standing = height * (0.03 + 2.0 * SEGMENT * ops::cos(STANCE));
    let told = scene.joints(entity.id).is_some();
    if detail == Detail::Far && (!told || reach > LOW * standing) {
        parts.push(Part { look: Look { mesh: afar(&legs), unit: 1.0, ..body }, place: Pose::identity() });
        return;
    }
    // Whose joints are told has its trunk where its pose says, and else it stands on its longest leg.
    let drop = if told { standing } else { reach };
    let (trunk, thigh, shank) = if robot {
        (MeshId::RobotTrunk, MeshId::RobotThigh, MeshId::RobotShank)
    } else {
        (MeshId::DogTrunk, MeshId::DogThigh, MeshId::DogShank)
    };
    let at = |x: f64, y: f64, z: f64| Pose::from_parts(Vector3::new(x, y, z).into(), pitch(0.0));
    let turned = |rotation| Pose::from_parts(Vector3::zeros().into(), rotation);
    parts.push(Part { look: Look { mesh: trunk, ..body }, place: at(0.0, 0.0, drop) });
    let spots = [[0.3, 0.42], [0.3, -0.42], [-0.32, 0.42], [-0.32, -0.42]];
    for ([x, y], leg) in spots.into_iter().zip(legs) {
        let side = if robot { y } else { y * 0.6 };
        let upper = at(x * length, side * width, drop) * turned(leg.thigh);
        let lower = upper * at(0.0, 0.0, -SEGMENT * height) * turned(pitch(leg.knee));
        parts.push(Part { look: Look { mesh: thigh, ..body }, place: upper });
        parts.push(Part { look: Look { mesh: shank, ..body }, place: lower });
    }
}

/// The dog of a few pixels whose paws are nearest to those of these legs.
fn afar([fore_left, fore_right, hind_left, hind_right]: &[Leg; 4]) -> MeshId {
    let ahead = |leg: &Leg| leg.paw().x;
    let trot = ahead(fore_left) + ahead(hind_right) - ahead(fore_right) - ahead(hind_left);
    match (2.0 * trot / (4.0 * FAR_STRIDE)).round() as i32 {
        ..=-2 => MeshId::DogFarRight,
        -1 => MeshId::DogRight,
        0 => MeshId::Dog,
        1 => MeshId::DogLeft,
        2.. => MeshId::DogFarLeft,
    }
}

/// Fore left, fore right, hind left, hind right.
fn legs_of(entity: &EntityRef<'_>, scene: &dyn Scene, length: f64, height: f64) -> [Leg; 4] {
    if let Some(joints) = scene.joints(entity.id) {
        let arm =
            |side, arm: &ArmAngles| Leg { thigh: arm.trunk_from_upper_arm(side), knee: -arm.elbow_flexion };
        let leg = |side, leg: &LegAngles| Leg { thigh: leg.trunk_from_thigh(side), knee: leg.knee_flexion };
        return [
            arm(Side::Left, &joints.left_arm),
            arm(Side::Right, &joints.right_arm),
            leg(Side::Left, &joints.left_leg),
            leg(Side::Right, &joints.right_leg),
        ];
    }
    let speed = entity.twist.ground_speed();
    let swing = if speed < 0.1 { 0.0 } else { (0.2 + 0.15 * speed).min(0.55) };
    let phase = std::f64::consts::TAU * way(entity) / (length.max(height) * 1.1);
    // Diagonal legs go together, as in a trot.
    [0.0, 0.5, 0.5, 0.0].map(|shift| {
        let angle = phase + std::f64::consts::TAU * shift;
        let lift = if swing > 0.0 { 0.5 * (-ops::sin(angle)).max(0.0) } else { 0.0 };
        Leg::forward(-0.35 + swing * ops::cos(angle), -0.75 - lift)
    })
}

#[cfg(test)]
mod tests {
    use simworld_core::geometry::{Point3, Twist, pose_facing};
    use simworld_core::limbs::JointAngles;
    use simworld_core::scene::{EntityDesc, EntityKind, Shape, World};

    use super::*;
    use crate::look::{Looks, resident};

    fn dog(way: f64, speed: f64, joints: Option<JointAngles>) -> Vec<resident::Part> {
        let mut world = World::new();
        let pose = pose_facing(Point3::new(way, 0.0, 0.0), 0.0);
        let id = world.spawn(EntityDesc::new(EntityKind::Dog, pose, Shape::cuboid(0.7, 0.35, 0.5))).unwrap();
        let twist = Twist { linear: Vector3::x() * speed, angular: Vector3::zeros() };
        world.set_motion(id, pose, twist).unwrap();
        if let Some(joints) = joints {
            world.set_joints(id, joints).unwrap();
        }
        let mut parts = Vec::new();
        Looks::default().dress(&world.entity(id).unwrap(), &world, Detail::EVERY, &mut parts);
        parts
    }

    fn at(parts: &[resident::Part], detail: Detail) -> Vec<&resident::Part> {
        parts.iter().filter(|part| part.details & detail.bit() != 0).collect()
    }

    fn robot(bend: f64, abduction: f64) -> JointAngles {
        let arm = ArmAngles {
            shoulder_flexion: -bend,
            shoulder_abduction: abduction,
            elbow_flexion: 2.0 * bend,
            ..ArmAngles::default()
        };
        let leg = LegAngles {
            hip_flexion: -bend,
            hip_abduction: abduction,
            knee_flexion: -2.0 * bend,
            ..LegAngles::default()
        };
        JointAngles { left_leg: leg, right_leg: leg, left_arm: arm, right_arm: arm, ..JointAngles::default() }
    }

    #[test]
    fn a_dog_of_a_few_pixels_swings_its_legs_with_its_way() {
        let mesh = |way: f64, speed: f64| at(&dog(way, speed, None), Detail::Far)[0].look.mesh;
        let seen: std::collections::BTreeSet<MeshId> =
            (0..60).map(|k| mesh(0.02 * f64::from(k), 1.5)).collect();
        assert!(seen.len() >= 4, "{seen:?}");
        assert!((0..60).all(|k| mesh(0.02 * f64::from(k), 0.0) == MeshId::Dog), "who stands stands");
        let mut trots = robot(STANCE, 0.0);
        trots.left_arm.shoulder_flexion += 0.5;
        trots.right_leg.hip_flexion += 0.5;
        trots.right_arm.shoulder_flexion -= 0.5;
        trots.left_leg.hip_flexion -= 0.5;
        let far = |joints| at(&dog(0.0, 0.0, Some(joints)), Detail::Far)[0].look.mesh;
        assert_eq!((far(robot(STANCE, 0.0)), far(trots)), (MeshId::Dog, MeshId::DogFarLeft));
    }

    #[test]
    fn the_trunk_of_a_robot_is_where_its_pose_says_and_legs_go_aside() {
        let trunk = |parts: &[resident::Part]| at(parts, Detail::Near)[0].pose.translation.z;
        let (stands, lies) = (dog(0.0, 0.0, Some(robot(STANCE, 0.0))), dog(0.0, 0.0, Some(robot(1.4, 0.0))));
        assert!((trunk(&stands) - trunk(&lies)).abs() < 1e-12, "{} and {}", trunk(&stands), trunk(&lies));
        let paw = |parts: &[resident::Part], k: usize| {
            let shank = at(parts, Detail::Near)[2 + 2 * k];
            shank.pose * Point3::new(0.0, 0.0, -SEGMENT * 0.5)
        };
        assert!((paw(&stands, 0).z - 0.03 * 0.5).abs() < 1e-9, "on the ground: {}", paw(&stands, 0));
        let spread = dog(0.0, 0.0, Some(robot(STANCE, 0.4)));
        for (k, side) in [1.0, -1.0, 1.0, -1.0].into_iter().enumerate() {
            let out = side * (paw(&spread, k).y - paw(&stands, k).y);
            assert!(out > 0.05, "leg {k} goes outwards: {out}");
        }
        // Who lies on folded legs is no upright dog, from afar either.
        assert!(at(&lies, Detail::Far).len() > 1 && at(&stands, Detail::Far).len() == 1);
    }
}
