//! How a person holds its body: from the joint angles of whoever moves it, or from what else is known of it.
//!
//! Angles in the frame of the entity: positive pitch leans forward, positive flexion moves a limb forward. Without joint
//! angles the phase of the gait is the way along the heading, so that feet go where the ground goes, whatever the clock says.

use nalgebra::UnitQuaternion;
use simworld_core::geometry::{Pose, Vector3, yaw_of};
use simworld_core::limbs::{ArmAngles, JointAngles, LegAngles, NeckAngles, Side};
use simworld_core::ops;
use simworld_core::scene::{EntityKind, EntityRef, Gesture, Role, Scene};

use crate::mesh::people::{
    ANKLE, FOREARM, HIP, HIP_WIDTH, SHANK, SHOULDER, SHOULDER_WIDTH, THIGH, UPPER_ARM, WAIST,
};

type Rotation = UnitQuaternion<f64>;

/// Slower people stand, m/s.
const WALKING_SPEED: f64 = 0.2;
/// Faster people run: the speed at which grown people change over (Hreljac 1993), m/s.
const RUNNING_SPEED: f64 = 2.1;

/// An arm: how the upper arm hangs on the trunk, and how far the elbow is bent.
#[derive(Clone, Copy, Debug)]
pub(super) struct Arm {
    pub shoulder: Rotation,
    pub elbow: f64,
}

/// How a person is drawn, in its own frame.
#[derive(Clone, Copy, Debug)]
pub(super) struct Posture {
    /// The middle of the hips, m.
    pub hips: Vector3,
    /// How far the trunk leans forward.
    pub lean: f64,
    /// How far the head looks up, beside what the neck does.
    pub gaze: f64,
    pub neck: NeckAngles,
    /// Left, right.
    pub legs: [LegAngles; 2],
    pub arms: [Arm; 2],
}

/// About the axis to the left: what hangs goes backward.
pub(super) fn pitch(angle: f64) -> Rotation {
    Rotation::from_axis_angle(&Vector3::y_axis(), angle)
}

/// 1 in the middle of a window of the cycle and 0 outside, smooth.
fn bump(phase: f64, middle: f64, width: f64) -> f64 {
    let away = (phase - middle).rem_euclid(1.0);
    let away = away.min(1.0 - away) / width;
    let rest = (1.0 - away * away).max(0.0);
    rest * rest
}

impl Posture {
    /// Upright on straight legs.
    fn standing(height: f64, seed: f64) -> Self {
        // Nobody stands like a soldier: the weight is on one leg.
        let ease = 0.05 + 0.06 * seed;
        let leg = |ease: f64| leg(ease * 0.5, ease, 0.0);
        let arm = |side: f64, seed: f64| hang(side, 0.05 * seed, 0.1, 0.18 + 0.1 * seed);
        let legs = if seed < 0.5 { [leg(0.02), leg(ease)] } else { [leg(ease), leg(0.02)] };
        let mut posture = Self {
            hips: Vector3::zeros(),
            lean: 0.0,
            gaze: 0.0,
            neck: NeckAngles::default(),
            legs,
            arms: [arm(1.0, seed), arm(-1.0, 1.0 - seed)],
        };
        posture.stand(height);
        posture
    }

    /// What the angles of its joints say.
    fn jointed(joints: &JointAngles, height: f64) -> Self {
        let arm = |arm: &ArmAngles, side: Side| {
            if arm.shoulder_abduction == 0.0 && arm.shoulder_rotation == 0.0 {
                // Told in the plane of the way alone, it hangs past the hips.
                return hang(side.sign(), arm.shoulder_flexion, 0.08, arm.elbow_flexion);
            }
            Arm { shoulder: arm.trunk_from_upper_arm(side), elbow: arm.elbow_flexion }
        };
        Self {
            hips: Vector3::z() * (HIP * height - joints.hip_drop),
            lean: 0.0,
            gaze: 0.0,
            neck: joints.neck,
            legs: [joints.left_leg, joints.right_leg],
            arms: [arm(&joints.left_arm, Side::Left), arm(&joints.right_arm, Side::Right)],
        }
    }

    /// At that speed, so far along the way.
    fn striding(height: f64, speed: f64, way: f64) -> Self {
        let running = speed > RUNNING_SPEED;
        let stride = height * if running { 1.35 } else { 0.82 };
        let swing = if running { 0.62 } else { (0.16 + 0.2 * speed).min(0.46) };
        let phase = (way / stride).rem_euclid(1.0);
        let leg = |phase: f64| {
            let cosine = ops::cos(std::f64::consts::TAU * phase);
            let (bent, lifted) = if running { (0.45, 1.25) } else { (0.1, 0.95) };
            leg(
                swing * cosine + if running { 0.2 } else { 0.06 },
                bent * 0.5 + bent * bump(phase, 0.14, 0.16) + lifted * bump(phase, 0.72, 0.26),
                0.12 * bump(phase, 0.95, 0.12) - 0.4 * bump(phase, 0.58, 0.14),
            )
        };
        let arm = |phase: f64, side: f64| {
            let cosine = ops::cos(std::f64::consts::TAU * phase);
            let elbow = if running { 1.5 } else { 0.3 - 0.15 * cosine };
            hang(side, -0.75 * swing * cosine + if running { -0.1 } else { 0.0 }, 0.09, elbow)
        };
        let mut posture = Self {
            hips: Vector3::zeros(),
            lean: if running { 0.14 } else { 0.03 },
            gaze: 0.0,
            neck: NeckAngles::default(),
            legs: [leg(phase), leg(phase + 0.5)],
            arms: [arm(phase, 1.0), arm(phase + 0.5, -1.0)],
        };
        posture.stand(height);
        if running {
            // Twice in a stride both feet are off the ground.
            posture.hips.z += 0.03 * height * (0.5 - 0.5 * ops::cos(2.0 * std::f64::consts::TAU * phase));
        }
        posture
    }

    /// On a seat at the origin, thighs level.
    fn sitting(height: f64, seed: f64) -> Self {
        let leg = |spread: f64| leg(1.48, 1.42 + spread, 0.0);
        Self {
            hips: Vector3::new(0.0, 0.0, 0.055 * height),
            lean: -0.06 + 0.2 * seed * seed,
            gaze: 0.0,
            neck: NeckAngles::default(),
            legs: [leg(0.1 * seed), leg(-0.25 * seed)],
            arms: [hang(1.0, 0.45, 0.12, 0.75), hang(-1.0, 0.4, 0.12, 0.8)],
        }
    }

    /// In the seat of a vehicle: legs ahead, hands at the wheel.
    fn driving(height: f64) -> Self {
        Self {
            lean: -0.22,
            legs: [leg(1.3, 0.65, 0.0); 2],
            arms: [hang(1.0, 1.05, 0.0, 0.5), hang(-1.0, 1.05, 0.0, 0.5)],
            ..Self::sitting(height, 0.0)
        }
    }

    /// On a saddle, hands at the bar: hips, feet and hands are where the vehicle has them.
    pub(super) fn mounted(
        height: f64,
        hips: Vector3,
        feet: [Vector3; 2],
        hands: [Vector3; 2],
        lean: f64,
    ) -> Self {
        let mut posture = Self { hips, lean, ..Self::sitting(height, 0.0) };
        for (k, foot) in feet.into_iter().enumerate() {
            posture.legs[k] = step_on(&(foot - hips), height);
        }
        posture.reach(0, &hands[0], height);
        posture.reach(1, &hands[1], height);
        posture.gaze = lean * 0.7;
        posture
    }

    /// Puts the hips where the lower foot stands on the ground.
    fn stand(&mut self, height: f64) {
        let reach = |leg: &LegAngles| {
            let shank = leg.hip_flexion - leg.knee_flexion;
            let foot = shank + leg.ankle_dorsiflexion;
            // The heel or the ball of the foot touches the ground, whichever is lower.
            let sole = ANKLE * ops::cos(foot) + (0.04 * ops::sin(foot)).max(-0.085 * ops::sin(foot));
            height * (THIGH * ops::cos(leg.hip_flexion) + SHANK * ops::cos(shank) + sole)
        };
        self.hips.z = reach(&self.legs[0]).max(reach(&self.legs[1]));
    }

    /// From the entity to the hips, and to the waist, over which the trunk leans.
    pub(super) fn trunk(&self, height: f64) -> [Pose; 2] {
        let pelvis = Pose::from_parts(self.hips.into(), pitch(self.lean * 0.5));
        let chest =
            pelvis * Pose::from_parts((Vector3::z() * (WAIST * height)).into(), pitch(self.lean * 0.5));
        [pelvis, chest]
    }

    /// Where an arm hangs on the chest.
    pub(super) fn shoulder(side: f64, height: f64) -> Vector3 {
        Vector3::new(-0.004, SHOULDER_WIDTH * side, SHOULDER) * height
    }

    /// Where a leg hangs, seen from the entity.
    pub(super) fn hip(&self, side: f64, height: f64) -> Vector3 {
        self.hips + Vector3::new(0.0, HIP_WIDTH * side * height, 0.0)
    }

    /// Lays the left (0) or right (1) hand on a point of the entity's frame, as far as the arm reaches.
    pub(super) fn reach(&mut self, hand: usize, point: &Vector3, height: f64) {
        let [_, chest] = self.trunk(height);
        let side = [1.0, -1.0][hand];
        let target = chest.inverse() * nalgebra::Point3::from(*point);
        let away = target.coords - Self::shoulder(side, height);
        let (upper, lower) = (UPPER_ARM * height, FOREARM * height);
        let distance = away.norm().clamp((upper - lower).abs() + 1e-3, (upper + lower) * 0.999);
        let cosine = |a: f64, b: f64, opposite: f64| {
            ((a * a + b * b - opposite * opposite) / (2.0 * a * b)).clamp(-1.0, 1.0)
        };
        let elbow = std::f64::consts::PI - ops::acos(cosine(upper, lower, distance));
        let lift = ops::acos(cosine(upper, distance, lower));
        let along = Rotation::rotation_between(&-Vector3::z(), &away).unwrap_or_else(Rotation::identity);
        self.arms[hand] = Arm { shoulder: along * pitch(lift), elbow };
    }
}

/// An arm at its side, forward and outward by so much.
fn hang(side: f64, forward: f64, outward: f64, elbow: f64) -> Arm {
    let aside = Rotation::from_axis_angle(&Vector3::x_axis(), outward * side);
    Arm { shoulder: pitch(-forward) * aside, elbow }
}

/// A leg whose ankle is at a place seen from the hip, in the plane of the body.
fn step_on(ankle: &Vector3, height: f64) -> LegAngles {
    let (thigh, shank) = (THIGH * height, SHANK * height);
    let sole = ankle + Vector3::z() * (ANKLE * height);
    let distance = ops::hypot(sole.x, sole.z).clamp(0.05 * height, (thigh + shank) * 0.999);
    let cosine = (thigh * thigh + shank * shank - distance * distance) / (2.0 * thigh * shank);
    let knee = std::f64::consts::PI - ops::acos(cosine.clamp(-1.0, 1.0));
    let lead = ops::acos(
        ((thigh * thigh + distance * distance - shank * shank) / (2.0 * thigh * distance)).clamp(-1.0, 1.0),
    );
    let hip = ops::atan2(sole.x, -sole.z) + lead;
    leg(hip, knee, knee - hip)
}

/// A leg in the plane of the way.
fn leg(hip_flexion: f64, knee_flexion: f64, ankle_dorsiflexion: f64) -> LegAngles {
    LegAngles { hip_flexion, knee_flexion, ankle_dorsiflexion, ..LegAngles::default() }
}

/// How somebody holds its body now.
pub(super) fn posture_of(entity: &EntityRef<'_>, scene: &dyn Scene, height: f64, seed: f64) -> Posture {
    let mut posture = held(entity, scene, height, seed);
    posture.gaze += entity.gaze().clamp(-0.7, 0.9);
    gesticulate(&mut posture, entity, scene, height);
    let fits = entity.attachment.is_none_or(|bond| bond.role == Role::Seated);
    if fits {
        carry(&mut posture, entity, scene, height);
    }
    posture
}

pub(super) fn held(entity: &EntityRef<'_>, scene: &dyn Scene, height: f64, seed: f64) -> Posture {
    match entity.attachment.map(|bond| (bond.role, scene.entity(bond.parent))) {
        Some((Role::Aboard, Some(vehicle)))
            if matches!(vehicle.kind, EntityKind::Bicycle | EntityKind::Motorcycle) =>
        {
            let mut posture = super::riders::on(vehicle.kind, &vehicle.info.shape, height, 0.0);
            // It is told from where the rider is, which hangs on the vehicle.
            let offset = entity.pose.inverse() * vehicle.pose;
            posture.hips += offset.translation.vector;
            posture
        }
        // Hands and feet are where the vehicle has its wheel and its floor.
        Some((Role::Aboard, _)) => Posture::driving(height),
        bond => match (scene.joints(entity.id), bond) {
            (Some(joints), _) => Posture::jointed(joints, height),
            (None, Some((Role::Seated, _))) => Posture::sitting(height, seed),
            (None, _) => moving(entity, height, seed),
        },
    }
}

fn moving(entity: &EntityRef<'_>, height: f64, seed: f64) -> Posture {
    let speed = entity.twist.ground_speed();
    if speed < WALKING_SPEED {
        return Posture::standing(height, seed);
    }
    Posture::striding(height, speed, super::way(entity) + seed * height)
}

/// The right arm, or both, by what the attribute `gesture` says.
fn gesticulate(posture: &mut Posture, entity: &EntityRef<'_>, scene: &dyn Scene, height: f64) {
    let Some(gesture) = entity.gesture() else { return };
    let time = scene.clock().seconds();
    let beat = |per_second: f64| ops::sin(std::f64::consts::TAU * per_second * time);
    let at = |x: f64, y: f64, z: f64| Vector3::new(x, y, z) * height;
    match gesture {
        Gesture::Wave => posture.reach(1, &at(0.08, -0.24 - 0.07 * beat(1.6), 1.06), height),
        Gesture::Point => {
            // As far round as an arm goes.
            let aside = entity.pointing().map_or(0.0, |to| ops::wrap_angle(to - yaw_of(entity.pose)));
            let (sin, cos) = ops::sin_cos(aside.clamp(-1.9, 0.9));
            posture.reach(1, &at(0.42 * cos, 0.42 * sin - 0.12, 0.83), height);
        }
        Gesture::Talk => {
            posture.reach(1, &at(0.2, -0.1 - 0.03 * beat(0.9), 0.68 + 0.04 * beat(1.3)), height);
            posture.gaze += 0.05 * beat(0.7);
        }
        Gesture::Argue => {
            posture.reach(0, &at(0.24, 0.2 + 0.03 * beat(1.1), 0.76 + 0.06 * beat(1.9)), height);
            posture.reach(1, &at(0.24, -0.2, 0.76 - 0.06 * beat(1.9)), height);
            posture.lean += 0.1;
        }
        _ => {}
    }
}

/// Hands go to what they hold.
fn carry(posture: &mut Posture, entity: &EntityRef<'_>, scene: &dyn Scene, height: f64) {
    scene.visit_attached(entity.id, &mut |load| {
        let Some(bond) = load.attachment else { return };
        let size = load.info.shape.size();
        let at = bond.parent_from_body.translation.vector;
        match bond.role {
            // By its top, like a bag.
            Role::Held => posture.reach(1, &(at + Vector3::z() * size.z), height),
            Role::Carried => {
                for (hand, side) in [(0, 1.0), (1, -1.0)] {
                    let grip = Vector3::new(-size.x * 0.25, side * size.y * 0.5, size.z * 0.35);
                    posture.reach(hand, &(at + grip), height);
                }
            }
            Role::Ridden => {
                let deck = super::riders::on(load.kind, &load.info.shape, height, 0.0);
                *posture = Posture { gaze: posture.gaze, ..deck };
            }
            _ => {}
        }
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    fn foot(posture: &Posture, leg: &LegAngles, height: f64) -> Vector3 {
        let shank = leg.hip_flexion - leg.knee_flexion;
        posture.hips
            + Vector3::new(
                THIGH * ops::sin(leg.hip_flexion) + SHANK * ops::sin(shank),
                0.0,
                -THIGH * ops::cos(leg.hip_flexion) - SHANK * ops::cos(shank),
            ) * height
    }

    /// A foot of a walker is on the ground at every moment, and none is below it.
    #[test]
    fn walkers_keep_a_foot_on_the_ground() {
        for k in 0..100 {
            let posture = Posture::striding(1.8, 1.4, 0.0173 * f64::from(k));
            let ankles = posture.legs.map(|leg| foot(&posture, &leg, 1.8).z);
            let lowest = ankles[0].min(ankles[1]);
            assert!((0.0..0.15 * 1.8).contains(&lowest), "{lowest}");
            assert!((0.85..1.02).contains(&(posture.hips.z / (HIP * 1.8))), "{}", posture.hips.z);
        }
    }

    /// While a foot bears, it stays where it is: it goes back as fast as the body goes on.
    #[test]
    fn the_leg_that_bears_goes_back() {
        let at = |way: f64| {
            let posture = Posture::striding(1.8, 1.4, way);
            foot(&posture, &posture.legs[0], 1.8).x
        };
        assert!(at(0.0) > 0.2 && at(0.37) < 0.1 && at(0.7) < -0.2, "{} {} {}", at(0.0), at(0.37), at(0.7));
    }

    #[test]
    fn hands_reach_what_is_within_reach() {
        for target in [[0.35, -0.25, 0.9], [0.4, 0.0, 1.3], [0.1, -0.5, 1.6]] {
            let mut posture = Posture::standing(1.75, 0.3);
            let target = Vector3::from(target);
            posture.reach(1, &target, 1.75);
            let [_, chest] = posture.trunk(1.75);
            let arm = posture.arms[1];
            let elbow = arm.shoulder * Vector3::new(0.0, 0.0, -UPPER_ARM * 1.75);
            let hand = elbow + arm.shoulder * (pitch(-arm.elbow) * Vector3::new(0.0, 0.0, -FOREARM * 1.75));
            let hand = chest * nalgebra::Point3::from(Posture::shoulder(-1.0, 1.75) + hand);
            assert!((hand.coords - target).norm() < 0.02, "{} is not {target}", hand.coords);
        }
    }
}
