//! The body of somebody who falls: ten limbs on joints that give way.
//!
//! The trunk takes the place of the upright body's collider on the same rigid body, so its frame stays the entity's: the
//! origin is where the soles would be. The other nine limbs are rigid bodies beside it. Masses are shares of the body's
//! mass, lengths shares of its height (Winter, Biomechanics and Motor Control of Human Movement, 2009, table 4.1 and
//! figure 4.1, after Dempster 1955 and Drillis and Contini 1966); forearm and hand are one limb, and so are shank and
//! foot. Joints end where those of adults do (Norkin and White, Measurement of Joint Motion, 2016), rounded. Limbs meet one
//! another, their own and those of others, but for those that a joint holds together where they overlap.

use nalgebra::UnitQuaternion;
use rapier3d_f64::dynamics::{MotorModel, RevoluteJointBuilder, SphericalJointBuilder};
use rapier3d_f64::math::{Pose as RapierPose, Rotation, Vector};
use rapier3d_f64::prelude::{
    CoefficientCombineRule, Collider, ColliderBuilder, GenericJoint, JointAxis, PhysicsWorld,
    RigidBodyBuilder, RigidBodyHandle, SharedShape,
};
use serde::{Deserialize, Serialize};
use simworld_core::asset::Material;
use simworld_core::limbs::{ArmAngles, JointAngles, LegAngles, NeckAngles, Side};
use simworld_core::ops;

use crate::convert::from_pose;

/// What clothes are made of: it decides how far somebody slides.
const CLOTHES: Material = Material::Fabric;
/// Share of the mass that the trunk has.
const TRUNK_MASS: f64 = 0.497;
/// Heights of the hips and the shoulders as shares of the body's.
const HIP: f64 = 0.530;
const SHOULDER: f64 = 0.818;
/// Half the depth and half the width of the trunk as shares of the height.
const TRUNK: [f64; 2] = [0.055, 0.085];
/// What muscles and tissue take from the motion of a joint, as a share of what is beyond it: N m s/rad for each kg of
/// the body's mass. An arm that swings comes to rest within a second.
const DAMPING: f64 = 0.05;

/// How a joint may turn about the axes of the upright body, x forward, y left, z up: from, to, radians.
enum Freedom {
    /// Like a ball in its socket.
    Ball([[f64; 2]; 3]),
    /// About y alone.
    Hinge([f64; 2]),
}

/// One limb in the upright body; lengths as shares of the height.
struct Limb {
    /// The limb that it hangs on, as an index in the list; else the trunk.
    parent: Option<usize>,
    mass: f64,
    radius: f64,
    /// How far to the left of the middle.
    left: f64,
    /// Heights of its lower and its upper end.
    span: [f64; 2],
    /// Height of the joint that it hangs by.
    joint: f64,
    freedom: Freedom,
}

const fn degrees(from: f64, to: f64) -> [f64; 2] {
    [from.to_radians(), to.to_radians()]
}

/// Turning of a hanging limb about x, inwards and outwards, on the left (1) or the right side (-1).
const fn sideways(side: f64, inwards: f64, outwards: f64) -> [f64; 2] {
    if side > 0.0 { degrees(-inwards, outwards) } else { degrees(-outwards, inwards) }
}

/// Upper arm, forearm, thigh and shank of a side, whose first has that index in the list.
const fn side_of(side: f64, first: usize) -> [Limb; 4] {
    let (arm, leg) = (0.129 * side, 0.052 * side);
    let shoulder = [sideways(side, 30.0, 120.0), degrees(-160.0, 50.0), degrees(-60.0, 60.0)];
    let hip = [sideways(side, 25.0, 45.0), degrees(-120.0, 20.0), degrees(-40.0, 40.0)];
    [
        Limb {
            parent: None,
            mass: 0.028,
            radius: 0.026,
            left: arm,
            span: [0.630, SHOULDER],
            joint: SHOULDER,
            freedom: Freedom::Ball(shoulder),
        },
        Limb {
            parent: Some(first),
            mass: 0.022,
            radius: 0.022,
            left: arm,
            span: [0.400, 0.630],
            joint: 0.630,
            freedom: Freedom::Hinge(degrees(-145.0, 0.0)),
        },
        Limb {
            parent: None,
            mass: 0.100,
            radius: 0.042,
            left: leg,
            span: [0.285, HIP],
            joint: HIP,
            freedom: Freedom::Ball(hip),
        },
        Limb {
            parent: Some(first + 2),
            mass: 0.061,
            radius: 0.030,
            left: leg,
            span: [0.0, 0.285],
            joint: 0.285,
            freedom: Freedom::Hinge(degrees(0.0, 140.0)),
        },
    ]
}

const HEAD: Limb = Limb {
    parent: None,
    mass: 0.081,
    radius: 0.065,
    left: 0.0,
    span: [0.870, 1.0],
    joint: 0.850,
    freedom: Freedom::Ball([degrees(-40.0, 40.0), degrees(-55.0, 45.0), degrees(-70.0, 70.0)]),
};

/// Every limb but the trunk, parents before children.
const LIMBS: [Limb; 9] = {
    let [a, b, c, d] = side_of(1.0, 1);
    let [e, f, g, h] = side_of(-1.0, 5);
    [HEAD, a, b, c, d, e, f, g, h]
};

/// How tall and heavy somebody is, m and kg.
#[derive(Clone, Copy, Debug)]
pub(super) struct Build {
    pub(super) height: f64,
    pub(super) mass: f64,
}

/// The limbs of somebody who falls, beside the trunk.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Ragdoll {
    limbs: Vec<RigidBodyHandle>,
}

impl Ragdoll {
    /// The rigid bodies of the limbs beside the trunk.
    pub(super) fn limbs(&self) -> &[RigidBodyHandle] {
        &self.limbs
    }

    /// Makes a trunk of an upright body's collider and hangs the limbs on it, all of them upright and with the velocity of
    /// the trunk, which is dynamic already.
    pub(super) fn of(physics: &mut PhysicsWorld, trunk: RigidBodyHandle, build: Build) -> Self {
        let Build { height, mass } = build;
        let rigid = &physics.bodies[trunk];
        let (pose, velocity) = (*rigid.position(), rigid.linvel());
        let mark = rigid.colliders().first().map(|first| {
            let collider = &mut physics.colliders[*first];
            take_form_of_trunk(collider, build);
            collider.user_data
        });
        physics.bodies[trunk].recompute_mass_properties_from_colliders(&physics.colliders);
        let mut limbs: Vec<RigidBodyHandle> = Vec::with_capacity(LIMBS.len());
        for limb in &LIMBS {
            let frame = RigidBodyBuilder::dynamic().pose(pose).linvel(velocity).can_sleep(true);
            let solid = limb.solid(height, mass).user_data(mark.unwrap_or_default());
            let handle = physics.insert(frame, solid).0;
            physics.bodies[handle].recompute_mass_properties_from_colliders(&physics.colliders);
            let parent = limb.parent.map_or(trunk, |index| limbs[index]);
            physics.insert_impulse_joint(parent, handle, limb.joint(build));
            limbs.push(handle);
        }
        Self { limbs }
    }

    /// How the limbs lie, seen from what they hang on.
    pub(super) fn angles(&self, physics: &PhysicsWorld, trunk: RigidBodyHandle) -> JointAngles {
        let turned = |limb: usize| {
            let parent = LIMBS[limb].parent.map_or(trunk, |index| self.limbs[index]);
            let (parent, child) = (physics.bodies.get(parent), physics.bodies.get(self.limbs[limb]));
            let (Some(parent), Some(child)) = (parent, child) else { return UnitQuaternion::identity() };
            from_pose(parent.position()).rotation.inverse() * from_pose(child.position()).rotation
        };
        // Of a hinge: backwards about the axis to the left, of a hanging limb.
        let bent = |limb: usize| {
            let between = turned(limb);
            2.0 * ops::atan2(between.j * between.w.signum(), between.w.abs())
        };
        let arm = |side: Side, first: usize| {
            let elbow_flexion = (-bent(first + 1)).max(0.0);
            ArmAngles { elbow_flexion, ..ArmAngles::default() }.with_upper_arm(side, &turned(first))
        };
        let leg = |side: Side, first: usize| {
            let knee_flexion = bent(first + 1).max(0.0);
            LegAngles { knee_flexion, ..LegAngles::default() }.with_thigh(side, &turned(first))
        };
        JointAngles {
            left_arm: arm(Side::Left, 1),
            left_leg: leg(Side::Left, 3),
            right_arm: arm(Side::Right, 5),
            right_leg: leg(Side::Right, 7),
            neck: NeckAngles::of(&turned(0)),
            hip_drop: 0.0,
        }
    }

    /// Takes the limbs out of the engine.
    pub(super) fn remove(&mut self, physics: &mut PhysicsWorld) {
        for limb in self.limbs.drain(..) {
            physics.remove_body(limb);
        }
    }
}

/// What collides of somebody, upright or not, is dressed.
pub(super) fn dressed(solid: ColliderBuilder) -> ColliderBuilder {
    solid
        .friction(CLOTHES.friction())
        .friction_combine_rule(CoefficientCombineRule::GeometricMean)
        .restitution(CLOTHES.restitution())
}

fn take_form_of_trunk(collider: &mut Collider, build: Build) {
    let Build { height, mass } = build;
    let half = Vector::new(TRUNK[0], TRUNK[1], (SHOULDER - HIP) * 0.5) * height;
    collider.set_shape(SharedShape::cuboid(half.x, half.y, half.z));
    let middle = Vector::new(0.0, 0.0, (SHOULDER + HIP) * 0.5 * height);
    collider.set_position_wrt_parent(RapierPose::from_translation(middle));
    collider.set_mass(mass * TRUNK_MASS);
}

impl Limb {
    /// Its collider in the frame of the upright body.
    fn solid(&self, height: f64, mass: f64) -> ColliderBuilder {
        let [low, high] = self.span.map(|end| end * height);
        let radius = self.radius * height;
        let middle = Vector::new(0.0, self.left * height, (low + high) * 0.5);
        let solid = SharedShape::capsule_z(((high - low) * 0.5 - radius).max(0.0), radius);
        dressed(ColliderBuilder::new(solid))
            .position(RapierPose::from_translation(middle))
            .mass(self.mass * mass)
    }

    /// Whether it meets what it hangs on: only arms do, which hang beside the trunk. Other limbs begin within what they hang on,
    /// and bend as far as their joints let them.
    const fn meets_parent(&self) -> bool {
        self.parent.is_none() && self.left.abs() - self.radius > TRUNK[1]
    }

    /// The joint that it hangs by; both frames are those of the upright body.
    fn joint(&self, build: Build) -> GenericJoint {
        let anchor = Vector::new(0.0, self.left, self.joint) * build.height;
        // The damping goes with what hangs on the joint: a forearm is stopped by less than a leg.
        let damping = DAMPING * build.mass * (self.mass / 0.1).min(1.0);
        match &self.freedom {
            Freedom::Ball(limits) => {
                // The engine measures the turn about each axis as if it were the only one, which is good for turns that are far from
                // half of one: so they are measured from the middle of the bend. From the hanging limb, legs that were bent and
                // spread went on swinging for good.
                let middle = 0.5 * (limits[1][0] + limits[1][1]);
                let frame = RapierPose::from_parts(anchor, Rotation::from_scaled_axis(Vector::Y * middle));
                let bend = limits[1].map(|limit| limit - middle);
                let mut joint = SphericalJointBuilder::new()
                    .local_frame1(frame)
                    .local_anchor2(anchor)
                    .contacts_enabled(self.meets_parent());
                for (axis, limits) in
                    [(JointAxis::AngX, limits[0]), (JointAxis::AngY, bend), (JointAxis::AngZ, limits[2])]
                {
                    joint = joint
                        .limits(axis, limits)
                        .motor_model(axis, MotorModel::ForceBased)
                        .motor_velocity(axis, 0.0, damping);
                }
                joint.into()
            }
            Freedom::Hinge(limits) => RevoluteJointBuilder::new(Vector::Y)
                .local_anchor1(anchor)
                .local_anchor2(anchor)
                .contacts_enabled(false)
                .limits(*limits)
                .motor_model(MotorModel::ForceBased)
                .motor_velocity(0.0, damping)
                .into(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_limbs_weigh_what_the_body_weighs_and_reach_from_the_soles_to_the_crown() {
        let mass: f64 = LIMBS.iter().map(|limb| limb.mass).sum();
        assert!((mass + TRUNK_MASS - 1.0).abs() < 1e-12, "{mass}");
        let low = LIMBS.iter().map(|limb| limb.span[0]).fold(f64::INFINITY, f64::min);
        let high = LIMBS.iter().map(|limb| limb.span[1]).fold(0.0, f64::max);
        assert_eq!((low, high), (0.0, 1.0));
    }

    #[test]
    fn limbs_stand_beside_the_trunk_and_not_in_it() {
        for limb in LIMBS.iter().filter(|limb| limb.span[1] > HIP && limb.left != 0.0) {
            assert!(limb.left.abs() - limb.radius > TRUNK[1], "{}", limb.left);
        }
    }

    #[test]
    fn joints_bend_as_those_of_people() {
        // About y, to the left, a hanging limb swings back by a positive angle.
        for limb in &LIMBS {
            if let Freedom::Hinge([from, to]) = limb.freedom {
                let knee = limb.joint < HIP;
                assert!(if knee { from == 0.0 && to > 2.0 } else { to == 0.0 && from < -2.0 });
            }
        }
    }

    /// Angles that are told put every limb where the engine has it.
    #[test]
    fn angles_are_those_of_the_limbs() {
        let build = Build { height: 1.75, mass: 75.0 };
        let mut physics = PhysicsWorld::new();
        physics.gravity = Vector::new(0.0, 0.0, -9.81);
        physics.insert(RigidBodyBuilder::fixed(), ColliderBuilder::cuboid(50.0, 50.0, 0.5));
        let frame = RigidBodyBuilder::dynamic().translation(Vector::new(0.0, 0.0, 1.0));
        let trunk = physics.insert(frame, ColliderBuilder::capsule_z(0.6, 0.2)).0;
        let limbs = Ragdoll::of(&mut physics, trunk, build);
        physics.bodies[trunk].set_angvel(Vector::new(2.0, 4.0, 1.0), true);
        let (mut aside, mut about) = (0.0_f64, 0.0_f64);
        for _ in 0..240 {
            physics.step();
            let angles = limbs.angles(&physics, trunk);
            let rotation = |handle: RigidBodyHandle| from_pose(physics.bodies[handle].position()).rotation;
            let of_trunk = rotation(trunk);
            let told = [
                (0, angles.neck.trunk_from_head()),
                (1, angles.left_arm.trunk_from_upper_arm(Side::Left)),
                (3, angles.left_leg.trunk_from_thigh(Side::Left)),
                (5, angles.right_arm.trunk_from_upper_arm(Side::Right)),
                (7, angles.right_leg.trunk_from_thigh(Side::Right)),
            ];
            for (limb, trunk_from_limb) in told {
                let off = (of_trunk * trunk_from_limb).angle_to(&rotation(limbs.limbs[limb]));
                assert!(off < 1e-6, "limb {limb}: {off}");
            }
            aside = aside.max(angles.left_leg.hip_abduction.abs());
            about = about.max(angles.right_arm.shoulder_rotation.abs());
        }
        assert!(aside > 0.1 && about > 0.05, "it sprawled: {aside}, {about}");
    }

    /// In bodies of so much mass and height, whose engine takes substeps as the physics does.
    fn fallen(physics: &mut PhysicsWorld, place: Vector, build: Build) -> Vec<RigidBodyHandle> {
        physics.integration_parameters.dt = crate::dynamics::LONGEST_JOINTED_SUBSTEP;
        let frame = RigidBodyBuilder::dynamic().translation(place);
        let trunk = physics.insert(frame, ColliderBuilder::capsule_z(0.6, 0.2)).0;
        let limbs = Ragdoll::of(physics, trunk, build);
        std::iter::once(trunk).chain(limbs.limbs).collect()
    }

    /// How far the first of these bodies are within the others at most, m, below 0 if they are apart; those are left out that a joint
    /// holds together where they overlap.
    fn depth(physics: &PhysicsWorld, one: &[RigidBodyHandle], other: &[RigidBodyHandle]) -> f64 {
        let solid = |handle: RigidBodyHandle| &physics.colliders[physics.bodies[handle].colliders()[0]];
        let mut deepest = f64::NEG_INFINITY;
        for (at, a) in one.iter().enumerate() {
            for (place, b) in other.iter().enumerate() {
                let hangs = |child: usize, parent: usize| {
                    child > 0
                        && LIMBS[child - 1].parent.map_or(0, |limb| limb + 1) == parent
                        && !LIMBS[child - 1].meets_parent()
                };
                if one == other && (at == place || hangs(at, place) || hangs(place, at)) {
                    continue;
                }
                let (a, b) = (solid(*a), solid(*b));
                let found =
                    parry3d_f64::query::contact(a.position(), a.shape(), b.position(), b.shape(), 0.1);
                deepest = deepest.max(found.unwrap().map_or(-0.1, |found| -found.dist));
            }
        }
        deepest
    }

    const BUILD: Build = Build { height: 1.75, mass: 75.0 };

    #[test]
    fn arms_alone_meet_what_they_hang_on() {
        let meet: Vec<usize> = (0..LIMBS.len()).filter(|limb| LIMBS[*limb].meets_parent()).collect();
        assert_eq!(meet, [1, 5]);
        let mut physics = PhysicsWorld::new();
        let bodies = fallen(&mut physics, Vector::ZERO, BUILD);
        physics.step();
        assert!(depth(&physics, &bodies, &bodies) < 0.0, "upright none is within another");
    }

    /// Turned inwards, an arm comes to rest with the forearm at the thigh and the trunk, and a thigh at the other one, short of the ends of
    /// their joints.
    #[test]
    fn limbs_stop_at_limbs() {
        for (limb, other, torque) in [(1, 0, 4.0), (3, 8, 30.0)] {
            let mut physics = PhysicsWorld::new();
            let bodies = fallen(&mut physics, Vector::ZERO, BUILD);
            let mut worst = f64::NEG_INFINITY;
            for _ in 0..240 {
                let turning = physics.bodies[bodies[0]].rotation() * -Vector::X * torque;
                for (body, turning) in [(limb + 1, turning), (other, -turning)] {
                    let rigid = &mut physics.bodies[bodies[body]];
                    rigid.reset_torques(true);
                    rigid.add_torque(turning, true);
                }
                physics.step();
                worst = worst.max(depth(&physics, &bodies, &bodies));
            }
            println!("limb {limb}: within another by at most {worst:.4} m");
            assert!((0.0..0.015).contains(&worst), "limb {limb}: {worst} m");
        }
    }

    /// Two who are thrown at one another and fall in a heap.
    #[test]
    fn in_a_heap_limbs_lie_on_limbs() {
        let (mut worst, mut rest) = ([f64::NEG_INFINITY; 2], [f64::NEG_INFINITY; 2]);
        for turn in 0..6 {
            let mut physics = PhysicsWorld::new();
            physics.gravity = Vector::new(0.0, 0.0, -9.81);
            physics.insert(RigidBodyBuilder::fixed(), ColliderBuilder::cuboid(50.0, 50.0, 0.5));
            let heap = [0.0, 0.9].map(|x| fallen(&mut physics, Vector::new(x, 0.05, 0.6), BUILD));
            let (sin, cos) = ops::sin_cos(f64::from(turn));
            for (bodies, way) in heap.iter().zip([1.5, -1.5]) {
                for body in bodies {
                    physics.bodies[*body].set_linvel(Vector::new(way, 0.0, 0.0), true);
                }
                physics.bodies[bodies[0]].set_angvel(Vector::new(4.0 * cos, way, 4.0 * sin), true);
            }
            let depths = |physics: &PhysicsWorld| [0, 1].map(|other| depth(physics, &heap[0], &heap[other]));
            let greater = |one: [f64; 2], other: [f64; 2]| [one[0].max(other[0]), one[1].max(other[1])];
            for _ in 0..480 {
                physics.step();
                worst = greater(worst, depths(&physics));
            }
            rest = greater(rest, depths(&physics));
        }
        println!(
            "within their own limbs and those of others by at most {worst:.3?} m, at rest by {rest:.3?} m"
        );
        // Without it: 0.10 and 0.15 m, at rest 0.08 and 0.14 m.
        assert!(worst[0] < 0.03 && worst[1] < 0.1, "{worst:?}");
        assert!(rest.iter().all(|rest| (0.0..0.025).contains(rest)), "{rest:?}");
    }
}
