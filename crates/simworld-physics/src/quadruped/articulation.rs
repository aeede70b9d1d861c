//! The body of a quadruped in the engine: a trunk and twelve links on hinges, as one multibody.
//!
//! The rigid body of the entity becomes the trunk, with its frame in its middle, because the engine turns the root of a
//! multibody about its origin. Motors act as torques on both sides of their joint, so what is applied is what was computed.

use parry3d_f64::mass_properties::MassProperties;
use rapier3d_f64::dynamics::{JointAxesMask, Multibody, RevoluteJointBuilder};
use rapier3d_f64::math::{Pose as RapierPose, Rotation, Vector};
use rapier3d_f64::prelude::{
    ActiveHooks, CoefficientCombineRule, Collider, ColliderBuilder, ColliderHandle, ContactPair, JointAxis,
    PhysicsWorld, RigidBody, RigidBodyBuilder, RigidBodyHandle, RigidBodyType, SharedShape,
};
use serde::{Deserialize, Serialize};
use simworld_core::asset::Material;
use simworld_core::geometry::{Pose, Twist, Vector3};
use simworld_core::id::EntityId;

use super::meeting::{TRUNK, number};
use super::{QuadrupedModel, QuadrupedState};
use crate::convert::{from_pose, from_vector, to_pose, to_vector};
use crate::joint::JointReading;
use crate::shape::{BodyTag, marked, numbered};

/// Radii of thigh and shank as shares of their lengths.
pub(super) const THIGH: f64 = 0.1;
pub(super) const SHANK: f64 = 0.06;
/// The hip has the inertia of a ball of this radius, m.
pub(super) const HIP_BALL: f64 = 0.045;
/// Degrees of freedom of the root of a multibody that stands on nothing.
const ROOT: usize = 6;
/// The engine's stops give way before they hold: they stand this far inside the joints' limits, radians.
const STOP: f64 = 0.06;

/// rad.
const HAIR: f64 = 1e-6;

/// Four legs of three joints each, as [`LEGS`](super::LEGS) has them.
pub(super) type PerJoint = [[f64; 3]; 4];

/// The links of the legs in the engine.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Links {
    /// Hip, thigh and shank of one leg after the other.
    bodies: Vec<RigidBodyHandle>,
    feet: [ColliderHandle; 4],
}

/// Whether the engine asks if thighs and trunk meet.
fn hooks(model: &QuadrupedModel) -> ActiveHooks {
    if model.thighs_are_clear() { ActiveHooks::empty() } else { ActiveHooks::FILTER_CONTACT_PAIRS }
}

fn dressed(solid: ColliderBuilder, (id, number): (EntityId, u16), material: Material) -> ColliderBuilder {
    solid
        .density(0.0)
        .friction(material.friction())
        .friction_combine_rule(CoefficientCombineRule::GeometricMean)
        .user_data(numbered(marked(BodyTag::Entity(id), material), number))
}

/// Moments of inertia of a rod along z.
pub(super) fn rod(mass: f64, length: f64, radius: f64) -> Vector {
    let across = mass * (length * length / 12.0 + radius * radius * 0.25);
    Vector::new(across, across, mass * radius * radius * 0.5)
}

/// A limb that hangs from the middle of its frame, with its mass so far down.
fn limb(mass: f64, length: f64, radius: f64, center: f64) -> MassProperties {
    MassProperties::new(Vector::new(0.0, 0.0, -center * length), mass, rod(mass, length, radius))
}

impl Links {
    /// Makes a trunk of the entity's rigid body and hangs the legs on it. The entity keeps its pose and velocity, and the legs
    /// stand as `angles` say.
    pub(super) fn build(
        physics: &mut PhysicsWorld,
        trunk: RigidBodyHandle,
        id: EntityId,
        (model, angles): (&QuadrupedModel, &PerJoint),
        (pose, twist): (&Pose, &Twist),
    ) -> Self {
        make_trunk(physics, trunk, id, model, pose);
        let mut bodies = Vec::with_capacity(12);
        let mut feet = [ColliderHandle::invalid(); 4];
        for (leg, foot) in feet.iter_mut().enumerate() {
            *foot = hang_leg(physics, trunk, id, (model, leg), &mut bodies);
        }
        let links = Self { bodies, feet };
        let Some(multibody) = links.multibody_mut(physics) else { return links };
        multibody.set_self_contacts_enabled(true);
        let mut displacement = [0.0; ROOT + 12];
        displacement[ROOT..].copy_from_slice(angles.as_flattened());
        for dof in 0..ROOT + 12 {
            let is_joint = dof >= ROOT;
            multibody.damping_mut()[dof] = if is_joint { model.damping } else { 0.0 };
            multibody.armature_mut()[dof] = if is_joint { model.armature } else { 0.0 };
        }
        let middle = pose.rotation * Vector3::z() * model.standing_height();
        let linear = twist.linear + twist.angular.cross(&middle);
        let velocity = [linear.as_slice(), twist.angular.as_slice()].concat();
        multibody.generalized_velocity_mut().as_mut_slice()[..ROOT].copy_from_slice(&velocity);
        multibody.apply_displacements(&displacement);
        links.lay_out(physics);
        links
    }

    /// Puts the links where the angles of the joints say.
    fn lay_out(&self, physics: &mut PhysicsWorld) {
        let Some(link) = physics.multibody_joints.rigid_body_link(self.bodies[0]).copied() else { return };
        let PhysicsWorld { multibody_joints, bodies, .. } = physics;
        if let Some(multibody) = multibody_joints.get_multibody_mut(link.multibody) {
            multibody.forward_kinematics(bodies, true);
            multibody.update_rigid_bodies(bodies, true);
        }
    }

    /// Takes the legs off.
    pub(super) fn remove(self, physics: &mut PhysicsWorld) {
        for link in self.bodies.into_iter().rev() {
            physics.remove_body(link);
        }
    }

    /// The rigid bodies beside the trunk.
    pub(super) fn bodies(&self) -> &[RigidBodyHandle] {
        &self.bodies
    }

    fn multibody<'a>(&self, physics: &'a PhysicsWorld) -> Option<&'a Multibody> {
        let link = physics.multibody_joints.rigid_body_link(*self.bodies.first()?)?;
        physics.multibody_joints.get_multibody(link.multibody)
    }

    fn multibody_mut<'a>(&self, physics: &'a mut PhysicsWorld) -> Option<&'a mut Multibody> {
        let link = *physics.multibody_joints.rigid_body_link(*self.bodies.first()?)?;
        physics.multibody_joints.get_multibody_mut(link.multibody)
    }

    /// What the body feels of itself; `dt` s is the substep in which the loads on the feet arose.
    pub(super) fn sense(
        &self,
        physics: &PhysicsWorld,
        trunk: RigidBodyHandle,
        dt: f64,
    ) -> Option<QuadrupedState> {
        let multibody = self.multibody(physics)?;
        let velocity = multibody.generalized_velocity();
        let (mut angles, mut speeds) = ([[0.0; 3]; 4], [[0.0; 3]; 4]);
        for place in 0..12 {
            let (leg, joint) = (place / 3, place % 3);
            angles[leg][joint] = multibody.link(place + 1)?.joint().coords()[3];
            speeds[leg][joint] = velocity[ROOT + place];
        }
        let root = physics.bodies.get(trunk)?;
        let whose = |handle| {
            physics
                .colliders
                .get(handle)
                .map(|collider: &Collider| BodyTag::from_user_data(collider.user_data))
        };
        // A foot that meets another leg does not stand.
        let loads = self.feet.map(|foot| {
            let of_others = |pair: &&ContactPair| whose(pair.collider1) != whose(pair.collider2);
            let pairs = physics.contact_pairs_with(foot).filter(of_others);
            pairs.map(ContactPair::total_impulse_magnitude).sum::<f64>() / dt
        });
        Some(QuadrupedState {
            trunk: from_pose(root.position()),
            linear: from_vector(root.linvel()),
            angular: from_vector(root.angvel()),
            center: self.center(physics, root),
            angles,
            speeds,
            loads,
        })
    }

    fn center(&self, physics: &PhysicsWorld, trunk: &RigidBody) -> Vector3 {
        let links = self.bodies.iter().filter_map(|link| physics.bodies.get(*link));
        let (sum, mass) = links.chain([trunk]).fold((Vector3::zeros(), 0.0), |(sum, mass), rigid| {
            (sum + from_vector(rigid.center_of_mass()) * rigid.mass(), mass + rigid.mass())
        });
        sum / mass
    }

    /// Puts in the stops that joints will reach in the coming substep of `dt` s, with these speeds and torques. The engine stops
    /// nothing before it is through, so a joint that would go through is stopped where it is; and each stop costs it a
    /// solution of the whole body's equations, whether it holds or not.
    pub(super) fn mind_stops(
        &self,
        physics: &mut PhysicsWorld,
        model: &QuadrupedModel,
        joints: &[[JointReading; 3]; 4],
        dt: f64,
    ) {
        let Some(multibody) = self.multibody_mut(physics) else { return };
        for (place, joint) in joints.as_flattened().iter().enumerate() {
            let Some(link) = multibody.link_mut(place + 1) else { return };
            let [low, high] = model.limits_of(place / 3, place % 3);
            let stop = STOP.min((high - low) * 0.5);
            let (low, high) = (low + stop, high - stop);
            let speed = joint.speed + joint.torque / model.armature * dt;
            let next = joint.angle + speed * dt;
            // It holds what lies beyond it, so it is put a hair's breadth beyond the joint.
            let stops = [
                if next < low { low.max(joint.angle + HAIR) } else { low },
                if next > high { high.min(joint.angle - HAIR) } else { high },
            ];
            link.joint.data.set_limits(JointAxis::AngX, stops);
            link.joint.data.limit_axes.set(JointAxesMask::ANG_X, next < low || next > high);
        }
    }

    /// Lets the motors act for the coming substep, with torques in N m.
    pub(super) fn act(&self, physics: &mut PhysicsWorld, trunk: RigidBodyHandle, torques: &PerJoint) {
        let bodies = &mut physics.bodies;
        let Some(root) = bodies.get(trunk) else { return };
        let forward = *root.rotation() * Vector::X;
        let mut on_trunk = Vector::ZERO;
        for (leg, [abduction, thigh, knee]) in torques.iter().enumerate() {
            let [hip, upper, lower] = [0, 1, 2].map(|joint| self.bodies[3 * leg + joint]);
            let Some(rigid) = bodies.get(hip) else { return };
            let across = *rigid.rotation() * Vector::Y;
            on_trunk -= forward * *abduction;
            for (link, torque) in [
                (hip, forward * *abduction - across * *thigh),
                (upper, across * (*thigh - *knee)),
                (lower, across * *knee),
            ] {
                if let Some(rigid) = bodies.get_mut(link) {
                    rigid.reset_torques(true);
                    rigid.add_torque(torque, true);
                }
            }
        }
        if let Some(rigid) = bodies.get_mut(trunk) {
            rigid.reset_torques(true);
            rigid.add_torque(on_trunk, true);
        }
    }
}

/// Gives the entity's rigid body the form, the mass and the frame of a trunk.
fn make_trunk(
    physics: &mut PhysicsWorld,
    trunk: RigidBodyHandle,
    id: EntityId,
    model: &QuadrupedModel,
    pose: &Pose,
) {
    let middle = RapierPose::from_translation(Vector::new(0.0, 0.0, model.standing_height()));
    let inertia = model.trunk_inertia;
    let properties =
        MassProperties::new(Vector::ZERO, model.trunk_mass, Vector::new(inertia[0], inertia[1], inertia[2]));
    let rigid = &mut physics.bodies[trunk];
    rigid.set_body_type(RigidBodyType::Dynamic, true);
    rigid.set_position(to_pose(pose) * middle, true);
    rigid.set_linvel(Vector::ZERO, true);
    rigid.set_angvel(Vector::ZERO, true);
    rigid.activation_mut().normalized_linear_threshold = -1.0;
    rigid.set_additional_mass_properties(properties, true);
    if let Some(first) = rigid.colliders().first().copied() {
        let half = (model.trunk_half_length - model.trunk_radius).max(0.0);
        let turned = Rotation::from_axis_angle(Vector::Y, std::f64::consts::FRAC_PI_2);
        let collider = &mut physics.colliders[first];
        collider.set_shape(SharedShape::capsule_z(half, model.trunk_radius));
        collider.set_position_wrt_parent(RapierPose::from_parts(Vector::ZERO, turned));
        collider.set_mass(0.0);
        collider.set_friction(Material::Plastic.friction());
        collider.set_active_hooks(hooks(model));
        collider.user_data = numbered(marked(BodyTag::Entity(id), Material::Plastic), TRUNK);
    }
    physics.bodies[trunk].recompute_mass_properties_from_colliders(&physics.colliders);
}

/// Hangs one leg on the trunk; its foot is returned.
fn hang_leg(
    physics: &mut PhysicsWorld,
    trunk: RigidBodyHandle,
    id: EntityId,
    (model, leg): (&QuadrupedModel, usize),
    bodies: &mut Vec<RigidBodyHandle>,
) -> ColliderHandle {
    let geometry = model.leg(leg);
    let [hip_mass, thigh_mass, shank_mass] = model.leg_masses;
    let [thigh_center, shank_center] = model.leg_centers;
    let offset = Vector::new(0.0, geometry.offset, 0.0);
    let ball =
        MassProperties::new(offset * 0.5, hip_mass, Vector::splat(0.4 * hip_mass * HIP_BALL * HIP_BALL));
    let (thigh_radius, shank_radius) = (THIGH * geometry.thigh, SHANK * geometry.shank);
    let links = [
        (Vector::X, to_vector(&geometry.hip), ball),
        (Vector::Y, offset, limb(thigh_mass, geometry.thigh, thigh_radius, thigh_center)),
        (
            Vector::Y,
            Vector::new(0.0, 0.0, -geometry.thigh),
            limb(shank_mass, geometry.shank, shank_radius, shank_center),
        ),
    ];
    let mut parent = trunk;
    for (joint, (axis, anchor, properties)) in links.into_iter().enumerate() {
        let pose = *physics.bodies[parent].position() * RapierPose::from_translation(anchor);
        let frame =
            RigidBodyBuilder::dynamic().pose(pose).additional_mass_properties(properties).can_sleep(false);
        let link = physics.insert_body(frame);
        let [low, high] = model.limits_of(leg, joint);
        let stop = STOP.min((high - low) * 0.5);
        let hinge = RevoluteJointBuilder::new(axis)
            .local_anchor1(anchor)
            .local_anchor2(Vector::ZERO)
            .contacts_enabled(false)
            .limits([low + stop, high - stop]);
        physics.insert_multibody_joint(parent, link, hinge);
        bodies.push(link);
        parent = link;
    }
    let (upper, lower) = (bodies[bodies.len() - 2], bodies[bodies.len() - 1]);
    let bone = |length: f64, radius: f64| {
        let middle = RapierPose::from_translation(Vector::new(0.0, 0.0, -length * 0.5));
        ColliderBuilder::capsule_z((length * 0.5 - radius).max(0.0), radius).position(middle)
    };
    let thigh = dressed(bone(geometry.thigh, thigh_radius), (id, number(leg, 1)), Material::Plastic);
    let thigh = thigh.active_hooks(hooks(model));
    physics.insert_collider(thigh, Some(upper));
    let shank = dressed(bone(geometry.shank, shank_radius), (id, number(leg, 2)), Material::Plastic);
    physics.insert_collider(shank, Some(lower));
    let sole = RapierPose::from_translation(Vector::new(0.0, 0.0, -geometry.shank));
    let foot = ColliderBuilder::ball(model.foot_radius).position(sole);
    let foot = physics.insert_collider(dressed(foot, (id, number(leg, 2)), Material::Rubber), Some(lower));
    for link in &bodies[bodies.len() - 3..] {
        physics.bodies[*link].recompute_mass_properties_from_colliders(&physics.colliders);
    }
    foot
}
