//! How a quadruped takes part in a physics world, on its legs or as a cylinder.

use nalgebra::{Quaternion, UnitQuaternion};
use parry3d_f64::mass_properties::MassProperties;
use parry3d_f64::query::Ray;
use rapier3d_f64::math::Vector;
use rapier3d_f64::prelude::{
    Collider, ColliderHandle, PhysicsWorld, QueryFilter, QueryPipeline, RigidBodyHandle, RigidBodyType,
};
use simworld_core::event::EventKind;
use simworld_core::geometry::{Pose, Twist, Vector3, pose_facing};
use simworld_core::id::EntityId;
use simworld_core::limbs::{ArmAngles, JointAngles, LegAngles, Side};
use simworld_core::ops;
use simworld_core::scene::{FOOTING, Scene, World, WorldError};
use simworld_core::seam::{BodyState, Embodiment};

use super::articulation::{Links, PerJoint};
use super::control::{Field, heading_of};
use super::recovery::Task;
use super::{Quadruped, QuadrupedState};
use crate::body::{BodyContext, Bonds, Detail, PhysicsBody, Surroundings};
use crate::convert::{to_point, to_pose, to_vector};
use crate::joint::JointReading;
use crate::shape::{BodyTag, walker_mark};

/// The length of a substep on legs, s: 200 a second.
const SUBSTEP: f64 = 1.0 / 200.0;
/// In longer ones legs are not put on.
const LONGEST: f64 = 0.0051;
/// How far from the height of the trunk the ground is looked for, m.
const SIGHT: f64 = 1.0;

impl PhysicsBody for Quadruped {
    fn attach(&mut self, id: EntityId, physics: &mut PhysicsWorld) -> RigidBodyHandle {
        self.id = Some(id);
        let rigid = self.cheap.attach(id, physics);
        if self.motion.detail == Detail::Full {
            self.get_on_legs(physics, rigid);
        }
        rigid
    }

    fn parts(&self) -> &[RigidBodyHandle] {
        self.motion.links.as_ref().map_or(&[], Links::bodies)
    }

    fn longest_substep(&self) -> f64 {
        match self.motion.detail {
            Detail::Full => SUBSTEP,
            Detail::Reduced => self.cheap.longest_substep(),
        }
    }

    fn bind(&mut self, bonds: Bonds) {
        self.cheap.bind(bonds);
    }

    fn can_roam(&self) -> bool {
        self.motion.links.is_none() && self.motion.detail == Detail::Reduced && self.cheap.can_roam()
    }

    fn roam(&mut self, around: &Surroundings<'_>, dt: f64) {
        let before = self.state.pose;
        self.cheap.roam(around, dt);
        self.state = self.cheap.state();
        self.stride_from(&before);
    }

    fn sense(&mut self, around: &Surroundings<'_>, dt: f64) {
        self.motion.detail = around.detail();
        let Some(links) = &self.motion.links else { return self.cheap.sense(around, dt) };
        let Some(sensed) = links.sense(around.physics, around.rigid, dt) else { return };
        let own = self.id;
        let is_other = move |_: ColliderHandle, collider: &Collider| {
            BodyTag::from_user_data(collider.user_data).entity() != own
        };
        let filter = QueryFilter::new().predicate(&is_other);
        let physics = around.physics;
        let queries = QueryPipeline { bodies: around.nobody, ..physics.query_pipeline_with_filter(filter) };
        let look = move |place: &Vector3| {
            let ray = Ray::new(to_vector(place), -Vector::Z);
            let (_, hit) = queries.cast_ray_and_get_normal(&ray, SIGHT, true)?;
            (hit.time_of_impact > 0.0 && hit.normal.z > 0.5).then(|| place.z - hit.time_of_impact)
        };
        self.lead_motors(&sensed, &Field { look: &look, gravity: around.config().gravity, dt });
    }

    fn drive(&mut self, context: &mut BodyContext<'_>, dt: f64) {
        match (context.detail(), self.motion.links.is_some()) {
            (Detail::Reduced, true) => {
                self.gather(context.physics, context.rigid);
                self.cheap.drive(context, dt);
            }
            (Detail::Full, false) if dt <= LONGEST => self.get_on_legs(context.physics, context.rigid),
            (_, false) => self.cheap.drive(context, dt),
            (Detail::Full, true) => {
                let joints = &self.motion.readings.joints;
                let torques = joints.map(|leg| leg.map(|joint| joint.torque));
                if let Some(links) = &self.motion.links {
                    links.mind_stops(context.physics, &self.config.model, joints, dt);
                    links.act(context.physics, context.rigid, &torques);
                }
            }
        }
    }

    fn settle(&mut self, state: &BodyState) {
        if self.motion.links.is_none() {
            let before = self.state.pose;
            self.cheap.settle(state);
            self.state = self.cheap.state();
            return self.stride_from(&before);
        }
        let down = Vector3::new(0.0, 0.0, -self.config.model.standing_height());
        let arm = state.pose.rotation * down;
        let BodyState { pose, twist } = state;
        let place = pose.translation.vector + arm;
        let linear = twist.linear + twist.angular.cross(&arm);
        self.state = BodyState {
            pose: Pose::from_parts(place.into(), pose.rotation),
            twist: Twist { linear, angular: twist.angular },
        };
    }

    fn gather(&mut self, physics: &mut PhysicsWorld, rigid: RigidBodyHandle) {
        let Some(links) = self.motion.links.take() else { return self.cheap.gather(physics, rigid) };
        links.remove(physics);
        self.motion.news.got_up |= std::mem::take(&mut self.motion.is_down);
        self.motion.task = Task::Walk;
        let heading = heading_of(&self.state.pose);
        let pose = pose_facing(self.state.pose.translation.vector.into(), heading);
        let twist = Twist { linear: self.state.twist.linear, angular: Vector3::zeros() };
        self.state = BodyState { pose, twist };
        self.cheap.place(&self.state);
        let body = &mut physics.bodies[rigid];
        body.set_additional_mass_properties(MassProperties::default(), true);
        body.reset_torques(true);
        body.set_body_type(RigidBodyType::KinematicPositionBased, true);
        body.set_linvel(Vector::ZERO, true);
        body.set_angvel(Vector::ZERO, true);
        body.set_position(to_pose(&pose), true);
        body.set_next_kinematic_position(to_pose(&pose));
        if let (Some(first), Some(id)) = (body.colliders().first().copied(), self.id) {
            let (solid, body_from_solid) = self.cheap.collider();
            let collider = &mut physics.colliders[first];
            collider.set_shape(solid);
            collider.set_position_wrt_parent(body_from_solid);
            collider.set_position(to_pose(&pose) * body_from_solid);
            collider.set_mass(self.config.model.mass());
            collider.user_data = walker_mark(id);
        }
    }

    fn place(&mut self, state: &BodyState) {
        self.cheap.place(state);
        self.state = self.cheap.state();
        self.motion.before = Vector3::zeros();
    }

    fn report(&mut self, id: EntityId, world: &mut World) -> Result<(), WorldError> {
        if self.motion.links.is_none() {
            world.set_joints(id, joint_angles(&self.strided()))?;
            return self.cheap.report(id, world);
        }
        let footing = self.footing();
        if world.entity(id).is_some_and(|entity| entity.footing() != footing) {
            world.set_attribute(id, FOOTING, footing.to_attribute())?;
        }
        let angles = self.motion.readings.joints.map(|leg| leg.map(|joint| joint.angle));
        world.set_joints(id, joint_angles(&angles))?;
        if let Some(cause) = self.motion.news.fell.take() {
            world.emit(EventKind::Fell { who: id, cause });
        }
        if std::mem::take(&mut self.motion.news.got_up) {
            world.emit(EventKind::GotUp { who: id });
        }
        Ok(())
    }
}

impl Quadruped {
    /// Puts legs under its rigid body, which stands on them from now on.
    fn get_on_legs(&mut self, physics: &mut PhysicsWorld, rigid: RigidBodyHandle) {
        let Some(id) = self.id else { return };
        let heading = heading_of(&self.state.pose);
        let pose = pose_facing(self.state.pose.translation.vector.into(), heading);
        let fastest = self.config.speeds[0];
        let linear = self.state.twist.linear;
        let linear = linear * (fastest / linear.norm().max(fastest));
        let twist = Twist { linear, angular: Vector3::zeros() };
        let angles = self.standing_on_ground(physics, &pose);
        let links = Links::build(physics, rigid, id, (&self.config.model, &angles), (&pose, &twist));
        self.state = BodyState { pose, twist };
        self.motion.links = Some(links);
        self.motion.is_fresh = true;
        self.motion.task = Task::Walk;
        self.motion.before = linear;
    }

    /// The angles at which the legs of a body at a pose reach the ground under its hips, as far as they do.
    fn standing_on_ground(&self, physics: &PhysicsWorld, pose: &Pose) -> PerJoint {
        let model = &self.config.model;
        let (standing, own) = (model.standing_height(), self.id);
        let is_other = move |_: ColliderHandle, collider: &Collider| {
            BodyTag::from_user_data(collider.user_data).entity() != own
        };
        let filter = QueryFilter::new().predicate(&is_other);
        std::array::from_fn(|leg| {
            let geometry = model.leg(leg);
            let hip = nalgebra::Point3::new(geometry.hip.x, geometry.hip.y + geometry.offset, standing);
            let ray = Ray::new(to_point(&(pose * hip)), -Vector::Z);
            let met = physics.cast_ray_and_get_normal(&ray, SIGHT, true, filter);
            let height = met.map_or(standing, |(_, hit)| hit.time_of_impact);
            let mut angles = model.standing(leg, height);
            for (joint, angle) in angles.iter_mut().enumerate() {
                let [low, high] = model.limits_of(leg, joint);
                *angle = angle.clamp(low, high);
            }
            angles
        })
    }

    /// Notes what can be read of it.
    pub(super) fn read(&mut self, sensed: &QuadrupedState, torques: &PerJoint, gravity: f64, dt: f64) {
        let readings = &mut self.motion.readings;
        readings.joints = std::array::from_fn(|leg| {
            std::array::from_fn(|joint| JointReading {
                angle: sensed.angles[leg][joint],
                speed: sensed.speeds[leg][joint],
                torque: torques[leg][joint],
            })
        });
        readings.feet = sensed.loads;
        let back = sensed.trunk.rotation.inverse();
        let acceleration = (sensed.linear - self.motion.before) / dt + Vector3::z() * gravity;
        readings.imu.orientation = sensed.trunk.rotation;
        readings.imu.angular_velocity = back * sensed.angular;
        readings.imu.acceleration = back * acceleration;
        self.motion.before = sensed.linear;
    }
}

/// How the legs are for whoever draws them: the fore legs as arms, the hind legs as legs.
fn joint_angles([front_left, front_right, rear_left, rear_right]: &PerJoint) -> JointAngles {
    // The first joint turns about x all that hangs on it, the second about y.
    let turned = |first: f64, thigh: f64| {
        let turn = |axis: Vector3, angle: f64| {
            let (sin, cos) = ops::sin_cos(0.5 * angle);
            UnitQuaternion::new_unchecked(Quaternion::from_parts(cos, axis * sin))
        };
        turn(Vector3::x(), first) * turn(Vector3::y(), thigh)
    };
    let arm = |side: Side, [first, thigh, knee]: &[f64; 3]| {
        ArmAngles { elbow_flexion: -knee, ..ArmAngles::default() }
            .with_upper_arm(side, &turned(*first, *thigh))
    };
    let leg = |side: Side, [first, thigh, knee]: &[f64; 3]| {
        LegAngles { knee_flexion: *knee, ..LegAngles::default() }.with_thigh(side, &turned(*first, *thigh))
    };
    JointAngles {
        left_arm: arm(Side::Left, front_left),
        right_arm: arm(Side::Right, front_right),
        left_leg: leg(Side::Left, rear_left),
        right_leg: leg(Side::Right, rear_right),
        ..JointAngles::default()
    }
}
