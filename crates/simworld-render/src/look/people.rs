//! People: what they wear, from their seed or from what they are called, and their parts in their posture.

use simworld_core::geometry::{Pose, Vector3};
use simworld_core::limbs::Side;
use simworld_core::scene::{EntityRef, Scene};

use super::afar::stance_of;
use super::posture::{Posture, pitch, posture_of};
use super::{Detail, Look, Part, pick};
use crate::mesh::MeshId;
use crate::mesh::people::{Hair, NECK, SHANK, THIGH, UPPER_ARM};

type Color = [f32; 3];

/// Shirts, dresses and coats.
pub(super) const CLOTHES: [Color; 12] = [
    [0.55, 0.06, 0.05],
    [0.04, 0.12, 0.4],
    [0.75, 0.72, 0.66],
    [0.05, 0.25, 0.12],
    [0.7, 0.42, 0.05],
    [0.06, 0.06, 0.07],
    [0.3, 0.05, 0.22],
    [0.12, 0.38, 0.5],
    [0.4, 0.4, 0.42],
    [0.72, 0.25, 0.16],
    [0.62, 0.34, 0.36],
    [0.24, 0.2, 0.12],
];
/// Trousers and skirts.
const TROUSERS: [Color; 7] = [
    [0.03, 0.05, 0.12],
    [0.02, 0.02, 0.025],
    [0.2, 0.15, 0.09],
    [0.09, 0.13, 0.22],
    [0.12, 0.12, 0.13],
    [0.32, 0.27, 0.2],
    [0.06, 0.09, 0.17],
];
const SHOES: [Color; 5] =
    [[0.02, 0.02, 0.022], [0.1, 0.05, 0.025], [0.6, 0.6, 0.58], [0.04, 0.05, 0.1], [0.3, 0.05, 0.04]];
const SKIN: [Color; 6] = [
    [0.72, 0.47, 0.35],
    [0.62, 0.38, 0.26],
    [0.5, 0.29, 0.18],
    [0.34, 0.18, 0.1],
    [0.19, 0.09, 0.05],
    [0.09, 0.045, 0.028],
];
const HAIR: [Color; 7] = [
    [0.012, 0.009, 0.008],
    [0.03, 0.017, 0.01],
    [0.07, 0.035, 0.018],
    [0.16, 0.08, 0.035],
    [0.4, 0.26, 0.11],
    [0.22, 0.07, 0.025],
    [0.42, 0.41, 0.4],
];

/// What hangs on a body besides limbs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
struct Extras {
    hat: Option<MeshId>,
    tails: Option<MeshId>,
    bag: Option<MeshId>,
}

/// The looks of one person.
#[derive(Clone, Copy, Debug)]
pub(super) struct Figure {
    height: f64,
    girth: f64,
    seed: f32,
    hair: Hair,
    skin: Color,
    hair_color: Color,
    shirt: Color,
    legs: Color,
    shoes: Color,
    hat_color: Color,
    bag_color: Color,
    bare_arms: bool,
    bare_shanks: bool,
    extras: Extras,
}

impl Figure {
    pub(super) fn new(height: f64, seed: f32, bits: u64) -> Self {
        let chance = |shift: u32, share: u64| (bits >> shift) % 100 < share;
        let child = height < 1.42;
        let feminine = bits >> 7 & 1 == 1;
        let skirt = feminine && chance(9, 32);
        let bare_arms = chance(17, 38);
        let tails = if skirt {
            Some(MeshId::Skirt)
        } else {
            (!bare_arms && !child && chance(23, 24)).then_some(MeshId::Coat)
        };
        let hair = match (feminine, (bits >> 29) % 10) {
            (true, 0..=5) => Hair::Long,
            (true, 6 | 7) => Hair::Bun,
            (false, 0) if !child => Hair::None,
            _ => Hair::Short,
        };
        let hat = match (bits >> 33) % 20 {
            0 | 1 => Some(MeshId::Cap),
            2 if !child => Some(MeshId::Hat),
            _ => None,
        };
        let bag = match (bits >> 37) % 12 {
            0..=2 => Some(MeshId::Backpack),
            3 | 4 => Some(MeshId::ShoulderBag),
            _ => None,
        };
        let build = ((bits >> 41) % 64) as f64 / 64.0;
        let grey = usize::from(chance(47, 16) && !child) * 6;
        let hair_color = if grey > 0 { HAIR[6] } else { HAIR[(bits >> 51) as usize % 6] };
        Self {
            height,
            girth: (0.92 + 0.3 * build * build)
                * if child {
                    1.08
                } else if feminine {
                    0.95
                } else {
                    1.0
                },
            seed,
            hair,
            skin: pick(&SKIN, bits >> 3),
            hair_color,
            shirt: pick(&CLOTHES, bits),
            legs: pick(&TROUSERS, bits >> 16),
            shoes: pick(&SHOES, bits >> 21),
            hat_color: pick(&CLOTHES, bits >> 35),
            bag_color: pick(&CLOTHES, bits >> 39),
            bare_arms,
            bare_shanks: skirt || chance(27, 12),
            extras: Extras { hat, tails, bag },
        }
    }

    /// What people are called says what they wear.
    fn as_called(mut self, name: &str) -> Self {
        let is = |words: &[&str]| words.iter().any(|word| name.contains(word));
        let uniform = |figure: &mut Self, shirt: Color, legs: Color| {
            (figure.shirt, figure.legs) = (shirt, legs);
            (figure.bare_arms, figure.bare_shanks) = (false, false);
            figure.extras = Extras::default();
        };
        if is(&["woman", "girl", "nurse"]) {
            self.hair = if self.seed < 0.6 { Hair::Long } else { Hair::Bun };
        } else if name == "man" || is(&["boy"]) {
            self.hair = Hair::Short;
            self.extras.tails = self.extras.tails.filter(|tails| *tails == MeshId::Coat);
        }
        if is(&["police"]) {
            uniform(&mut self, [0.02, 0.04, 0.12], [0.015, 0.02, 0.05]);
            (self.extras.hat, self.hat_color) = (Some(MeshId::Cap), [0.015, 0.02, 0.05]);
        } else if is(&["firefighter", "construction"]) {
            uniform(&mut self, [0.8, 0.32, 0.02], [0.1, 0.1, 0.11]);
            (self.extras.hat, self.hat_color) = (Some(MeshId::Helmet), [0.8, 0.6, 0.04]);
        } else if is(&["doctor", "nurse", "chef", "paramedic"]) {
            uniform(&mut self, [0.75, 0.76, 0.76], [0.3, 0.36, 0.42]);
            self.extras.tails = is(&["doctor"]).then_some(MeshId::Coat);
            (self.extras.hat, self.hat_color) = (is(&["chef"]).then_some(MeshId::Hat), [0.8; 3]);
        } else if is(&["business", "waiter"]) {
            uniform(&mut self, [0.03, 0.03, 0.04], [0.03, 0.03, 0.04]);
        } else if is(&["courier", "student", "tourist"]) {
            self.extras.bag = Some(MeshId::Backpack);
        } else if is(&["cyclist"]) {
            (self.extras.hat, self.hat_color) = (Some(MeshId::Helmet), [0.7, 0.7, 0.68]);
        } else if is(&["elderly"]) {
            self.hair_color = HAIR[6];
        } else if is(&["jogger"]) {
            (self.bare_arms, self.bare_shanks) = (true, true);
            self.extras = Extras::default();
        }
        self
    }

    /// With a helmet on.
    pub(super) fn helmeted(mut self) -> Self {
        self.extras.hat = Some(MeshId::Helmet);
        self.extras.tails = None;
        self
    }

    pub(super) fn height(&self) -> f64 {
        self.height
    }

    fn look(&self, mesh: MeshId, color: Color, second: Color) -> Look {
        let (h, w) = (self.height as f32, (self.height * self.girth) as f32);
        Look { mesh, scale: [w, w, h], unit: h, color, second, seed: self.seed, state: 0.0, param: 0.0 }
    }

    /// Its parts, from the frame in which the posture is told.
    pub(super) fn emit(&self, posture: &Posture, frame: &Pose, detail: Detail, parts: &mut Vec<Part>) {
        let h = self.height;
        let fine = detail == Detail::Near;
        let mut put = |mesh: MeshId, place: Pose, color: Color, second: Color| {
            let mesh = if fine { mesh } else { mesh.coarse() };
            parts.push(Part { look: self.look(mesh, color, second), place: frame * place });
        };
        let [pelvis, chest] = posture.trunk(h);
        put(MeshId::Pelvis, pelvis, self.legs, self.legs);
        put(MeshId::Chest, chest, self.shirt, self.shirt);
        let held = Pose::from_parts(Vector3::zeros().into(), posture.neck.trunk_from_head());
        let neck = chest * at(Vector3::z() * (NECK * h)) * held * turn(-posture.lean - posture.gaze);
        put(head_of(self.hair), neck, self.skin, self.hair_color);
        for (side, leg) in Side::BOTH.into_iter().zip(&posture.legs) {
            let hip = posture.hip(side.sign(), h);
            let thigh = Pose::from_parts(hip.into(), leg.trunk_from_thigh(side));
            let knee = thigh * at(Vector3::z() * (-THIGH * h)) * turn(leg.knee_flexion);
            let ankle = knee * at(Vector3::z() * (-SHANK * h)) * turn(-leg.ankle_dorsiflexion);
            let shank = if self.bare_shanks { self.skin } else { self.legs };
            put(MeshId::Thigh, thigh, self.legs, self.legs);
            put(MeshId::Shank, knee, shank, shank);
            put(MeshId::Foot, ankle, self.shoes, [0.5; 3]);
        }
        let sleeve = if self.bare_arms { self.skin } else { self.shirt };
        for (side, arm) in [1.0, -1.0].into_iter().zip(&posture.arms) {
            let mut shoulder = Posture::shoulder(side, h);
            shoulder.y *= self.girth;
            let upper = chest * Pose::from_parts(shoulder.into(), arm.shoulder);
            let elbow = upper * at(Vector3::z() * (-UPPER_ARM * h)) * turn(-arm.elbow);
            put(MeshId::UpperArm, upper, self.shirt, self.shirt);
            put(MeshId::Forearm, elbow, sleeve, self.skin);
        }
        if let Some(tails) = self.extras.tails {
            let color = if tails == MeshId::Coat { self.shirt } else { self.legs };
            put(tails, pelvis, color, color);
        }
        if let Some(hat) = self.extras.hat {
            put(hat, neck, self.hat_color, self.hat_color);
        }
        if let Some(bag) = self.extras.bag {
            put(bag, chest, self.bag_color, self.bag_color.map(|channel| channel * 0.5));
        }
    }

    /// As one mesh, for who is a few pixels high.
    pub(super) fn emit_far(&self, mesh: MeshId, place: Pose, parts: &mut Vec<Part>) {
        parts.push(Part { look: self.look(mesh, self.shirt, self.legs), place });
    }
}

fn at(offset: Vector3) -> Pose {
    Pose::from_parts(offset.into(), nalgebra::UnitQuaternion::identity())
}

fn turn(angle: f64) -> Pose {
    Pose::from_parts(Vector3::zeros().into(), pitch(angle))
}

fn head_of(hair: Hair) -> MeshId {
    match hair {
        Hair::Short => MeshId::HeadShort,
        Hair::Long => MeshId::HeadLong,
        Hair::Bun => MeshId::HeadBun,
        Hair::None => MeshId::HeadBald,
    }
}

/// A person as it is drawn at that detail.
pub(super) fn dress(
    entity: &EntityRef<'_>,
    scene: &dyn Scene,
    look: &Look,
    bits: u64,
    detail: Detail,
    parts: &mut Vec<Part>,
) {
    let height = f64::from(look.scale[2]);
    let mut figure = Figure::new(height, look.seed, bits);
    if let Some(name) = super::asset_name(entity, scene) {
        figure = figure.as_called(name);
    }
    if let Some(color) = super::own_color(entity, scene) {
        figure.shirt = color;
    }
    let seed = f64::from(look.seed);
    if detail == Detail::Far
        && let Some(mesh) = stance_of(entity, scene, height, seed)
    {
        return figure.emit_far(mesh, Pose::identity(), parts);
    }
    let posture = posture_of(entity, scene, height, seed);
    // Who lies, crouches, climbs is seen to do so from afar too, by the parts of the level before.
    figure.emit(&posture, &Pose::identity(), detail, parts);
}

#[cfg(test)]
mod tests {
    use simworld_core::geometry::{Point3, pose_facing};
    use simworld_core::limbs::{ArmAngles, JointAngles, LegAngles, NeckAngles};
    use simworld_core::scene::{EntityDesc, EntityKind, Shape, World};

    use super::*;
    use crate::look::{Looks, resident};

    /// Feet, hands and head are where the angles of all joints put them, whatever they are.
    #[test]
    fn limbs_are_where_their_joints_put_them() {
        let h = 1.75;
        let mut world = World::new();
        let pose = pose_facing(Point3::new(2.0, 1.0, 0.3), 0.4);
        let id = world
            .spawn(EntityDesc::new(EntityKind::Person, pose, Shape::Capsule { radius: 0.25, height: h }))
            .unwrap();
        let leg = LegAngles {
            hip_flexion: 0.4,
            hip_abduction: 0.5,
            hip_rotation: 0.3,
            knee_flexion: 0.9,
            ..LegAngles::default()
        };
        let arm = ArmAngles {
            shoulder_flexion: 1.0,
            shoulder_abduction: 0.7,
            shoulder_rotation: -0.4,
            elbow_flexion: 1.2,
        };
        let neck = NeckAngles { flexion: 0.5, tilt: 0.2, turn: 0.6 };
        let joints =
            JointAngles { left_leg: leg, right_leg: leg, left_arm: arm, right_arm: arm, neck, hip_drop: 0.1 };
        world.set_joints(id, joints).unwrap();
        let mut parts = Vec::new();
        Looks::default().dress(&world.entity(id).unwrap(), &world, Detail::EVERY, &mut parts);
        let of = |mesh: MeshId| -> Vec<&resident::Part> {
            parts.iter().filter(|part| part.look.mesh == mesh).collect()
        };
        let hips = Vector3::z() * (crate::mesh::people::HIP * h - 0.1);
        for (side, (foot, forearm)) in
            Side::BOTH.into_iter().zip(of(MeshId::Foot).iter().zip(of(MeshId::Forearm)))
        {
            let hip = hips + Vector3::y() * (crate::mesh::people::HIP_WIDTH * h * side.sign());
            let thigh = leg.trunk_from_thigh(side);
            let down = -Vector3::z() * h;
            let ankle = hip + thigh * down * THIGH + thigh * pitch(leg.knee_flexion) * down * SHANK;
            let seen = foot.pose.translation.vector;
            assert!((seen - (pose * Point3::from(ankle)).coords).norm() < 1e-9, "{side:?} foot");
            let shoulder = Posture::shoulder(side.sign(), h);
            let chest = hips + Vector3::z() * (crate::mesh::people::WAIST * h);
            let elbow = chest + shoulder + arm.trunk_from_upper_arm(side) * down * UPPER_ARM;
            let seen = forearm.pose.translation.vector;
            // Broad people have broad shoulders.
            assert!((seen - (pose * Point3::from(elbow)).coords).norm() < 0.06, "{side:?} elbow");
            let bent = forearm
                .pose
                .rotation
                .angle_to(&(pose.rotation * arm.trunk_from_upper_arm(side) * pitch(-arm.elbow_flexion)));
            assert!(bent < 1e-6, "{side:?} forearm");
        }
        let heads = [MeshId::HeadShort, MeshId::HeadLong, MeshId::HeadBun, MeshId::HeadBald];
        let head = parts.iter().find(|part| heads.contains(&part.look.mesh)).expect("a head");
        assert!(head.pose.rotation.angle_to(&(pose.rotation * neck.trunk_from_head())) < 1e-6);
    }
}
