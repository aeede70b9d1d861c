//! The body of a robot in the engine: its parts on joints, as one multibody.
//!
//! The rigid body of the entity becomes the first part, with its frame in the centre of mass, because the engine turns the
//! root of a multibody about its origin. Motors act as torques or forces on both sides of their joint, so that what is
//! applied is what was computed.

use parry3d_f64::mass_properties::MassProperties;
use rapier3d_f64::dynamics::{GenericJointBuilder, JointAxesMask, Multibody, MultibodyLinkId};
use rapier3d_f64::math::{DVector, Matrix, Pose as RapierPose};
use rapier3d_f64::prelude::{
    ActiveHooks, CoefficientCombineRule, ColliderBuilder, JointAxis, PhysicsWorld, RigidBodyBuilder,
    RigidBodyHandle, RigidBodyType,
};
use serde::{Deserialize, Serialize};
use simworld_core::geometry::{Pose, Twist, Vector3};
use simworld_core::id::EntityId;

use super::description::{Base, RobotDescription};
use super::meeting::Meeting;
use super::solids::solid;
use super::tree::{Hinge, Lump, Part, Tree};
use crate::convert::{from_pose, from_vector, to_pose, to_vector};
use crate::shape::{BodyTag, marked, numbered};

/// The engine's stops give way before they hold: they stand so far inside the ends of a joint, rad or m.
const STOP: f64 = 1e-3;
/// rad or m.
const HAIR: f64 = 1e-9;

/// The parts in the engine beside the first.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Links {
    bodies: Vec<RigidBodyHandle>,
}

/// What a robot feels of itself, joint by joint.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Sensed {
    /// rad or m.
    pub(super) positions: Vec<f64>,
    /// rad/s or m/s.
    pub(super) speeds: Vec<f64>,
    /// The inertia that each joint feels with all others free, kg m² or kg.
    pub(super) inertias: Vec<f64>,
    /// The torques or forces that hold up what each joint carries, N m or N.
    pub(super) loads: Vec<f64>,
}

/// How a new articulation stands and moves.
pub(super) struct Start<'a> {
    /// Where the frame of the first part stands.
    pub(super) world_from_root: Pose,
    /// How that moves.
    pub(super) twist: Twist,
    /// The positions of the joints.
    pub(super) positions: &'a [f64],
}

/// A robot as its articulation sees it.
#[derive(Clone, Copy)]
pub(super) struct Plan<'a> {
    pub(super) id: EntityId,
    pub(super) description: &'a RobotDescription,
    pub(super) tree: &'a Tree,
    pub(super) meeting: &'a Meeting,
}

fn mass_properties(lump: &Lump, center: &Vector3) -> MassProperties {
    let column = |at: usize| to_vector(&lump.inertia.column(at).into_owned());
    let inertia = Matrix::from_cols(column(0), column(1), column(2));
    MassProperties::with_inertia_matrix(to_vector(&(lump.center - center)), lump.mass, inertia)
}

/// The rotation that takes x to a direction of length 1.
fn towards(axis: &Vector3) -> nalgebra::UnitQuaternion<f64> {
    let half = Vector3::x() + axis;
    if half.norm_squared() < 1e-12 {
        // Half a turn about z.
        return nalgebra::UnitQuaternion::new_unchecked(nalgebra::Quaternion::new(0.0, 0.0, 0.0, 1.0));
    }
    let quaternion = nalgebra::Quaternion::from_parts(1.0 + axis.x, Vector3::x().cross(axis));
    nalgebra::UnitQuaternion::new_normalize(quaternion)
}

/// The frame of the engine's body of a part in the frame of the part.
pub(super) fn part_from_body(tree: &Tree, part: usize) -> Pose {
    let place = if part == 0 { tree.parts[0].lump.center } else { Vector3::zeros() };
    Pose::from_parts(place.into(), nalgebra::UnitQuaternion::identity())
}

impl Plan<'_> {
    /// The rigid body of the first part, with its solids, without the others.
    pub(super) fn root(&self, world_from_root: &Pose, physics: &mut PhysicsWorld) -> RigidBodyHandle {
        let kind = match self.description.base {
            Base::Free => RigidBodyType::Dynamic,
            Base::Fixed => RigidBodyType::Fixed,
        };
        let part = &self.tree.parts[0];
        let pose = to_pose(&(world_from_root * part_from_body(self.tree, 0)));
        let properties = mass_properties(&part.lump, &part.lump.center);
        let rigid = RigidBodyBuilder::new(kind).pose(pose).additional_mass_properties(properties);
        let rigid = physics.insert_body(rigid.can_sleep(false));
        self.dress(part, 0, rigid, physics);
        rigid
    }

    /// Gives a rigid body the solids of its part.
    fn dress(&self, part: &Part, index: usize, rigid: RigidBodyHandle, physics: &mut PhysicsWorld) {
        let body_from_part = part_from_body(self.tree, index).inverse();
        let hooks =
            if self.meeting.is_asked { ActiveHooks::FILTER_CONTACT_PAIRS } else { ActiveHooks::empty() };
        for (link, place, part_from_solid) in &part.solids {
            let data = &self.description.links[*link].solids[*place];
            let Some((shape, form_from_shape)) = solid(&data.form) else { continue };
            let collider = ColliderBuilder::new(shape)
                .position(to_pose(&(body_from_part * part_from_solid)) * form_from_shape)
                .density(0.0)
                .friction(data.material.friction())
                .friction_combine_rule(CoefficientCombineRule::GeometricMean)
                .restitution(data.material.restitution())
                .active_hooks(hooks)
                .user_data(numbered(
                    marked(BodyTag::Entity(self.id), data.material),
                    self.meeting.number(*link, *place),
                ));
            physics.insert_collider(collider, Some(rigid));
        }
        physics.bodies[rigid].recompute_mass_properties_from_colliders(&physics.colliders);
    }

    /// Hangs the other parts on the first, which stands and moves as `start` says.
    pub(super) fn build(
        &self,
        physics: &mut PhysicsWorld,
        root: RigidBodyHandle,
        start: &Start<'_>,
    ) -> Links {
        let world_from_body = start.world_from_root * part_from_body(self.tree, 0);
        physics.bodies[root].set_position(to_pose(&world_from_body), true);
        let mut bodies = vec![root];
        for (part, hinge) in self.tree.hinges() {
            let body = self.hang(part, hinge, bodies[hinge.parent], physics);
            bodies.push(body);
        }
        bodies.remove(0);
        let links = Links { bodies };
        if self.description.base == Base::Free {
            let arm = start.world_from_root.rotation * self.tree.parts[0].lump.center;
            let linear = start.twist.linear + start.twist.angular.cross(&arm);
            let rigid = &mut physics.bodies[root];
            rigid.set_linvel(to_vector(&linear), true);
            rigid.set_angvel(to_vector(&start.twist.angular), true);
        }
        links.set_up(physics, self, start);
        links
    }

    fn hang(
        &self,
        part: usize,
        hinge: &Hinge,
        parent: RigidBodyHandle,
        physics: &mut PhysicsWorld,
    ) -> RigidBodyHandle {
        let parent_from_joint = part_from_body(self.tree, hinge.parent).inverse() * hinge.parent_from_joint;
        let pose = *physics.bodies[parent].position() * to_pose(&parent_from_joint);
        let data = &self.tree.parts[part];
        let properties = mass_properties(&data.lump, &Vector3::zeros());
        let rigid = RigidBodyBuilder::dynamic().pose(pose).additional_mass_properties(properties);
        let rigid = physics.insert_body(rigid.can_sleep(false));
        self.dress(data, part, rigid, physics);
        let along = Pose::from_parts(Vector3::zeros().into(), towards(&hinge.axis));
        let locked = if hinge.slides {
            JointAxesMask::LOCKED_PRISMATIC_AXES
        } else {
            JointAxesMask::LOCKED_REVOLUTE_AXES
        };
        let joint = GenericJointBuilder::new(locked)
            .local_frame1(to_pose(&(parent_from_joint * along)))
            .local_frame2(to_pose(&along))
            .contacts_enabled(self.meeting.meets_parent[part]);
        physics.insert_multibody_joint(parent, rigid, joint);
        rigid
    }
}

impl Links {
    /// Takes the parts off.
    pub(super) fn remove(self, physics: &mut PhysicsWorld) {
        for body in self.bodies.into_iter().rev() {
            physics.remove_body(body);
        }
    }

    /// The rigid bodies beside the first.
    pub(super) fn bodies(&self) -> &[RigidBodyHandle] {
        &self.bodies
    }

    /// Where the engine has its multibody; none if it has one part.
    fn link(&self, physics: &PhysicsWorld) -> Option<MultibodyLinkId> {
        physics.multibody_joints.rigid_body_link(*self.bodies.first()?).copied()
    }

    fn multibody<'a>(&self, physics: &'a PhysicsWorld) -> Option<&'a Multibody> {
        physics.multibody_joints.get_multibody(self.link(physics)?.multibody)
    }

    /// Friction, inertia of motors, springs, positions and velocities.
    fn set_up(&self, physics: &mut PhysicsWorld, plan: &Plan<'_>, start: &Start<'_>) {
        let Some(link) = self.link(physics) else { return };
        let PhysicsWorld { multibody_joints, bodies, .. } = physics;
        let Some(multibody) = multibody_joints.get_multibody_mut(link.multibody) else { return };
        multibody.set_self_contacts_enabled(plan.meeting.is_any);
        // Only now it knows whether its root moves.
        multibody.forward_kinematics(bodies, true);
        multibody.damping_mut().fill(0.0);
        let mut displacement = vec![0.0; multibody.generalized_velocity().len()];
        for (at, (_, hinge)) in plan.tree.hinges().enumerate() {
            let joint = &plan.description.joints[hinge.joint];
            let Some(link) = multibody.link_mut(at + 1) else { return };
            link.joint.set_spring(axis_of(hinge) as usize, joint.spring[0], joint.spring[1]);
            let dof = link.assembly_id();
            displacement[dof] = start.positions[at];
            multibody.damping_mut()[dof] = joint.damping;
            multibody.armature_mut()[dof] = joint.armature;
            multibody.frictions_mut()[dof] = joint.friction;
        }
        multibody.apply_displacements(&displacement);
        if plan.description.base == Base::Free {
            let root = &bodies[multibody.root().rigid_body_handle()];
            let velocity = [root.linvel().to_array(), root.angvel().to_array()].concat();
            multibody.generalized_velocity_mut().as_mut_slice()[..6].copy_from_slice(&velocity);
        }
        multibody.forward_kinematics(bodies, false);
        multibody.update_rigid_bodies(bodies, true);
        multibody.dof_inverse_inertia(bodies);
        // All parts move as one until the joints do something.
        let root = multibody.root().rigid_body_handle();
        let Some((center, linear, angular)) =
            bodies.get(root).map(|root| (root.center_of_mass(), root.linvel(), root.angvel()))
        else {
            return;
        };
        for handle in &self.bodies {
            if let Some(rigid) = bodies.get_mut(*handle) {
                let arm = rigid.center_of_mass() - center;
                rigid.set_linvel(linear + angular.cross(arm), true);
                rigid.set_angvel(angular, true);
            }
        }
    }

    /// Positions and speeds of the joints.
    pub(super) fn joints(&self, physics: &PhysicsWorld, tree: &Tree) -> Option<(Vec<f64>, Vec<f64>)> {
        let multibody = self.multibody(physics)?;
        let velocity = multibody.generalized_velocity();
        let joints = tree.hinges().enumerate().map(|(at, (_, hinge))| {
            let link = multibody.link(at + 1)?;
            Some((link.joint().coords()[axis_of(hinge) as usize], velocity[link.assembly_id()]))
        });
        joints.collect::<Option<Vec<_>>>().map(|joints| joints.into_iter().unzip())
    }

    /// What the robot feels of itself.
    pub(super) fn sense(&self, physics: &PhysicsWorld, tree: &Tree, gravity: f64) -> Option<Sensed> {
        if self.bodies.is_empty() {
            return Some(Sensed::default());
        }
        let multibody = self.multibody(physics)?;
        let (positions, speeds) = self.joints(physics, tree)?;
        let mut inertias = Vec::with_capacity(positions.len());
        let mut unit = DVector::zeros(multibody.generalized_velocity().len());
        for at in 0..positions.len() {
            let dof = multibody.link(at + 1)?.assembly_id();
            unit.fill(0.0);
            unit[dof] = 1.0;
            let solved = multibody.inv_augmented_mass().solve_mut(&mut unit);
            inertias.push(if solved && unit[dof] > 0.0 { 1.0 / unit[dof] } else { 0.0 });
        }
        Some(Sensed { positions, speeds, inertias, loads: self.loads(physics, tree, gravity) })
    }

    fn loads(&self, physics: &PhysicsWorld, tree: &Tree, gravity: f64) -> Vec<f64> {
        let mut carried = vec![(0.0, Vector3::zeros()); tree.parts.len()];
        let mut loads = vec![0.0; self.bodies.len()];
        for (part, hinge) in tree.hinges().collect::<Vec<_>>().into_iter().rev() {
            let Some(rigid) = physics.bodies.get(self.bodies[part - 1]) else { continue };
            let (mass, moment) = (
                carried[part].0 + rigid.mass(),
                carried[part].1 + from_vector(rigid.center_of_mass()) * rigid.mass(),
            );
            carried[hinge.parent].0 += mass;
            carried[hinge.parent].1 += moment;
            let axis = from_vector(*rigid.rotation() * to_vector(&hinge.axis));
            let up = Vector3::z() * gravity;
            loads[part - 1] = if hinge.slides {
                axis.dot(&up) * mass
            } else {
                axis.dot(&(moment - from_vector(rigid.translation()) * mass).cross(&up))
            };
        }
        loads
    }

    /// Where the frames of all parts stand in the world.
    pub(super) fn poses(&self, physics: &PhysicsWorld, root: RigidBodyHandle, tree: &Tree) -> Vec<Pose> {
        let rigids = std::iter::once(&root).chain(&self.bodies);
        let poses = rigids.filter_map(|handle| physics.bodies.get(*handle)).enumerate();
        poses
            .map(|(part, rigid)| from_pose(rigid.position()) * part_from_body(tree, part).inverse())
            .collect()
    }

    /// Puts in the stops that joints will reach in the coming substep of `dt` s. The engine stops nothing before it is through, so
    /// a joint that would go through is stopped where it is; and each stop costs a solution of the equations of the whole
    /// body, whether it holds or not.
    pub(super) fn mind_stops(
        &self,
        physics: &mut PhysicsWorld,
        plan: &Plan<'_>,
        (sensed, torques): (&Sensed, &[f64]),
        dt: f64,
    ) {
        let Some(link) = self.link(physics) else { return };
        let Some(multibody) = physics.multibody_joints.get_multibody_mut(link.multibody) else { return };
        for (at, (_, hinge)) in plan.tree.hinges().enumerate() {
            let Some([low, high]) = plan.description.joints[hinge.joint].ends() else { continue };
            let Some(link) = multibody.link_mut(at + 1) else { return };
            let stop = STOP.min((high - low) * 0.25);
            let (low, high) = (low + stop, high - stop);
            let (position, speed) = (sensed.positions[at], sensed.speeds[at]);
            let pushed = (torques[at] - sensed.loads[at]) / sensed.inertias[at].max(1e-12);
            let next = position + (speed + pushed * dt) * dt;
            // It holds what lies beyond it, so it is put a hair's breadth before the joint.
            let stops = [
                if next < low { low.max(position + HAIR) } else { low },
                if next > high { high.min(position - HAIR) } else { high },
            ];
            let axis = axis_of(hinge);
            link.joint.data.set_limits(axis, stops);
            link.joint.data.limit_axes.set(axis.into(), next < low || next > high);
        }
    }

    /// Lets the motors act for the coming substep, with torques in N m and forces in N.
    pub(super) fn act(
        &self,
        physics: &mut PhysicsWorld,
        root: RigidBodyHandle,
        tree: &Tree,
        torques: &[f64],
    ) {
        let bodies = &mut physics.bodies;
        for handle in std::iter::once(&root).chain(&self.bodies) {
            if let Some(rigid) = bodies.get_mut(*handle) {
                rigid.reset_torques(true);
                rigid.reset_forces(true);
            }
        }
        for ((part, hinge), torque) in tree.hinges().zip(torques) {
            let Some(child) = bodies.get_mut(self.bodies[part - 1]) else { return };
            let push = *child.rotation() * to_vector(&hinge.axis) * *torque;
            let place = child.translation();
            if hinge.slides {
                child.add_force_at_point(push, place, true);
            } else {
                child.add_torque(push, true);
            }
            let parent = if hinge.parent == 0 { root } else { self.bodies[hinge.parent - 1] };
            let Some(parent) = bodies.get_mut(parent) else { return };
            if hinge.slides {
                parent.add_force_at_point(-push, place, true);
            } else {
                parent.add_torque(-push, true);
            }
        }
    }
}

fn axis_of(hinge: &Hinge) -> JointAxis {
    if hinge.slides { JointAxis::LinX } else { JointAxis::AngX }
}

/// The lowest point of a robot with the joints at such positions, in the frame of its first link, m; none without solids.
pub(super) fn lowest(description: &RobotDescription, tree: &Tree, positions: &[f64]) -> Option<f64> {
    let mut least: Option<f64> = None;
    for (part, pose) in tree.parts.iter().zip(tree.poses(positions)) {
        for (link, place, part_from_solid) in &part.solids {
            let data = &description.links[*link].solids[*place];
            let Some((shape, form_from_shape)) = solid(&data.form) else { continue };
            let placed: RapierPose = to_pose(&(pose * part_from_solid)) * form_from_shape;
            let bottom = shape.compute_aabb(&placed).mins.z;
            least = Some(least.map_or(bottom, |least| least.min(bottom)));
        }
    }
    least
}

/// How the frame of the first link moves, from how the engine's body of it does.
pub(super) fn root_twist(tree: &Tree, world_from_body: &Pose, twist: &Twist) -> Twist {
    let arm = -(world_from_body.rotation * tree.parts[0].lump.center);
    Twist { linear: twist.linear + twist.angular.cross(&arm), angular: twist.angular }
}
