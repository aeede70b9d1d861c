//! Holding on to things: a grasp is a joint between a hand and a thing, of limited strength, and breaks where more is asked of it.
//!
//! The hand is where it took hold, in the frame of who holds; the thing hangs on it by a spring that gives way as arms and fingers do.
//! Where that gives way by more than it can, the hold breaks: a force that grows slowly breaks it at the strength of the hand. Forces are
//! N, lengths m.

use rapier3d_f64::dynamics::{GenericJointBuilder, JointAxesMask, MotorModel};
use rapier3d_f64::math::Pose as RapierPose;
use rapier3d_f64::prelude::{ImpulseJointHandle, JointAxis, PhysicsWorld, RigidBody, RigidBodyHandle};
use serde::{Deserialize, Serialize};
use simworld_core::event::EventKind;
use simworld_core::geometry::{Point3, Pose, Vector3};
use simworld_core::id::EntityId;
use simworld_core::scene::{Scene, World};

use crate::cart::Cart;
use crate::convert::{from_point, from_pose, from_vector, to_point, to_vector};
use crate::dynamics::{Owned, PhysicsDynamics};
use crate::error::{PhysicsError, check_range};

/// A hand gives no more than this share of what breaks its hold, however suddenly it is asked.
const MOST: f64 = 1.5;
/// Hands are so high over the feet, m, where nothing says where to take hold.
const HAND_HEIGHT: f64 = 1.0;
const LINEAR: [JointAxis; 3] = [JointAxis::LinX, JointAxis::LinY, JointAxis::LinZ];
/// How far a hand that turns a thing gives way before it breaks, radians.
const TWIST: f64 = 0.2;
/// The torque of two hands that push half a metre apart with [`HumanoidConfig::push_force`](crate::HumanoidConfig), N m.
const BOTH_HANDS: f64 = 100.0;

/// How a hand turns what it holds.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Turning {
    /// Not at all: the thing swings freely about the hand.
    #[default]
    Free,
    /// About the vertical, as two hands on a bar do.
    Upright {
        /// The torque at which the hold breaks, N m, 0.01 to 1e4.
        torque: f64,
    },
    /// As a gripper, which lets nothing turn.
    Firm {
        /// The torque at which the hold breaks, N m, 0.01 to 1e4.
        torque: f64,
    },
}

impl Turning {
    /// The axes about which it turns, and its torque, N m.
    fn axes(self) -> (&'static [JointAxis], f64) {
        match self {
            Self::Free => (&[], 0.0),
            Self::Upright { torque } => (&[JointAxis::AngZ], torque),
            Self::Firm { torque } => (&[JointAxis::AngX, JointAxis::AngY, JointAxis::AngZ], torque),
        }
    }
}

/// How a hand holds.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Grip {
    /// Which part of the body holds: 0 is its first rigid body, n the n-th of [`PhysicsBody::parts`](crate::PhysicsBody::parts).
    pub part: usize,
    /// The force at which the hold breaks, N, 1 to 1e5. The stronger hand of adults grips with 51 kg (men) and 31 kg (women) at their
    /// best age (Dodds et al., `PLoS` ONE 9, e113637, 2014): 402 N in the middle.
    pub strength: f64,
    /// How it turns what it holds.
    pub turning: Turning,
    /// How far it gives way before it breaks, m, 0.001 to 0.5: in proportion to the force.
    pub give: f64,
    /// How far it reaches beyond the body, m, 0.01 to 5. An arm is 0.44 of the height (Winter 2009, figure 4.1).
    pub reach: f64,
}

impl Default for Grip {
    fn default() -> Self {
        Self { part: 0, strength: 402.0, turning: Turning::Free, give: 0.1, reach: 0.77 }
    }
}

impl Grip {
    /// Both hands on a bar, such as the handle of a cart: twice the strength, and they turn it.
    pub fn both_hands() -> Self {
        let one = Self::default();
        Self { strength: 2.0 * one.strength, turning: Turning::Upright { torque: BOTH_HANDS }, ..one }
    }

    /// Checks every field.
    ///
    /// # Errors
    /// The first field out of range, with what is allowed.
    pub fn validate(&self) -> Result<(), PhysicsError> {
        let check = |field, value, range, allowed| check_range("Grip", field, value, range, allowed);
        check("strength", self.strength, 1.0..=1e5, "1 to 1e5 N")?;
        if self.turning != Turning::Free {
            check("turning", self.turning.axes().1, 0.01..=1e4, "0.01 to 1e4 N m")?;
        }
        check("give", self.give, 0.001..=0.5, "0.001 to 0.5 m")?;
        check("reach", self.reach, 0.01..=5.0, "0.01 to 5 m")
    }

    /// N/m.
    fn stiffness(&self) -> f64 {
        self.strength / self.give
    }
}

/// Somebody who holds something.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Grasp {
    pub(crate) who: EntityId,
    pub(crate) thing: EntityId,
    grip: Grip,
    joint: ImpulseJointHandle,
    hand: RigidBodyHandle,
    held: RigidBodyHandle,
    /// Where the hand is in the frame of its body, and where it holds in that of the thing; the two are one while nothing is asked.
    frames: [Pose; 2],
    /// Mass of the thing, kg, and what brakes its swinging, N s/m.
    mass: f64,
    damping: f64,
    /// Velocity of the place that is held, a substep ago, m/s.
    before: Vector3,
    /// What the thing asked of the hand in the last substep, N.
    pub(crate) force: f64,
}

/// A grasp as who holds feels it in a substep.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Hold {
    pub(crate) who: EntityId,
    pub(crate) held: RigidBodyHandle,
    /// Where the hand is, world frame.
    pub(crate) hand: Vector3,
    /// From the place that it holds to the hand.
    pub(crate) gap: Vector3,
    /// How far the hand is turned ahead of the thing, radians; zero where it does not turn it.
    pub(crate) twist: f64,
    pub(crate) turns: bool,
    /// Velocity of the place that it holds, m/s, and how it changed since the last substep.
    pub(crate) velocity: Vector3,
    pub(crate) change: Vector3,
    /// kg.
    pub(crate) mass: f64,
    /// The moment of a substep, as a share of it, at which the engine's passes over it look in the mean.
    pub(crate) middle: f64,
    /// N/m and N s/m.
    pub(crate) stiffness: f64,
    pub(crate) damping: f64,
}

/// Everything that is held.
#[derive(Debug, Default)]
pub(crate) struct Grasps {
    /// By ascending holder, then thing.
    pub(crate) list: Vec<Grasp>,
    /// By ascending holder; of this substep.
    pub(crate) holds: Vec<Hold>,
    /// What broke in this step.
    pub(crate) news: Vec<EventKind>,
}

impl PhysicsDynamics {
    /// Lets somebody take hold of a thing with a body of its own that can move: `at` a place, world frame; or else at its handle if it
    /// is a [`Cart`], and at the nearest point that it has. From then on it is pushed and pulled by the hand, and hangs on it, until
    /// [`let_go`](Self::let_go), or until more than the strength of the hand draws it out of that (`GraspBroke`). Who falls, sits down or
    /// is put somewhere else lets go as well.
    ///
    /// Light things are held better by `PickUp`, which makes them a part of who holds them.
    ///
    /// # Errors
    /// An entity that is unknown or has no body here, a setting out of range, or a hold that cannot be: the reason says why.
    pub fn grasp(
        &mut self,
        world: &World,
        who: EntityId,
        thing: EntityId,
        at: Option<Point3>,
        grip: Grip,
    ) -> Result<(), PhysicsError> {
        grip.validate()?;
        for id in [who, thing] {
            if let Some(place) = self.position(id).ok().filter(|place| self.bodies[*place].is_roaming) {
                self.take_back(place);
            }
        }
        let (hand, held) = (self.hand(world, who, &grip)?, self.holdable(world, thing)?);
        let refuse = |reason: &str| PhysicsError::Grasp { who, thing, reason: reason.to_owned() };
        if hand == held || who == thing {
            return Err(refuse("nobody holds himself: give another thing"));
        }
        let known = self.grasps.list.binary_search_by_key(&(who, thing), |grasp| (grasp.who, grasp.thing));
        let Err(place) = known else { return Err(refuse("it does so already: let go first")) };
        let at = at.or_else(|| self.body_as::<Cart>(thing).map(Cart::handle));
        let at = at.unwrap_or_else(|| self.nearest_point(held, self.shoulder(hand)));
        if !at.coords.iter().all(|part| part.is_finite()) {
            return Err(refuse("the place is not finite: give one in the world"));
        }
        let gap = (self.nearest_point(hand, at) - at).norm();
        if gap > grip.reach {
            return Err(refuse(&format!(
                "it is {gap:.2} m away and the reach is {} m: go there",
                grip.reach
            )));
        }
        let grasp = self.join((who, thing), (hand, held), at, grip);
        self.grasps.list.insert(place, grasp);
        Ok(())
    }

    /// Lets somebody let go of everything it holds by [`grasp`](Self::grasp); says how many things that were.
    pub fn let_go(&mut self, who: EntityId) -> usize {
        self.release(|grasp| grasp.who == who)
    }

    /// What somebody holds by [`grasp`](Self::grasp), by ascending id, with the force that it asked of the hand at last, N.
    pub fn grasped(&self, who: EntityId) -> impl Iterator<Item = (EntityId, f64)> + '_ {
        let own = self.grasps.list.iter().filter(move |grasp| grasp.who == who);
        own.map(|grasp| (grasp.thing, grasp.force))
    }

    /// Ends the grasps that are meant.
    pub(crate) fn release(&mut self, is_meant: impl Fn(&Grasp) -> bool) -> usize {
        let (physics, before) = (&mut self.physics, self.grasps.list.len());
        self.grasps.list.retain(|grasp| {
            let ends = is_meant(grasp);
            if ends {
                physics.remove_impulse_joint(grasp.joint);
            }
            !ends
        });
        before - self.grasps.list.len()
    }

    fn owned(&self, world: &World, id: EntityId) -> Result<&Owned, PhysicsError> {
        world.entity(id).ok_or(PhysicsError::Missing { id })?;
        self.position(id).map(|place| &self.bodies[place]).map_err(|_| PhysicsError::Bodiless { id })
    }

    /// The part of a body that is to hold.
    fn hand(&self, world: &World, who: EntityId, grip: &Grip) -> Result<RigidBodyHandle, PhysicsError> {
        let owned = self.owned(world, who)?;
        let refuse = |reason: &str| PhysicsError::Grasp { who, thing: who, reason: reason.to_owned() };
        if !can_hold(owned) {
            return Err(refuse("nobody holds on who does not stand on its feet: let it stand up"));
        }
        match grip.part.checked_sub(1) {
            None => Ok(owned.rigid),
            Some(part) => owned.body.parts().get(part).copied().ok_or_else(|| refuse("it has no such part")),
        }
    }

    /// The rigid body of a thing that can be held.
    fn holdable(&self, world: &World, thing: EntityId) -> Result<RigidBodyHandle, PhysicsError> {
        let owned = self.owned(world, thing)?;
        let can_move = self.physics.bodies.get(owned.rigid).is_some_and(RigidBody::is_dynamic);
        if !can_move
            || owned.bonds.carried.is_some()
            || world.entity(thing).is_some_and(|it| it.attachment.is_some())
        {
            let reason = "it is no free thing that can move: give one that is added by add_rigid or add_cart"
                .to_owned();
            return Err(PhysicsError::Grasp { who: thing, thing, reason });
        }
        Ok(owned.rigid)
    }

    /// Where hands come from.
    fn shoulder(&self, hand: RigidBodyHandle) -> Point3 {
        let origin = from_point(self.physics.bodies[hand].translation());
        if self.physics.bodies[hand].is_dynamic() { origin } else { origin + Vector3::z() * HAND_HEIGHT }
    }

    /// The point of a rigid body's colliders that is nearest to a place; its origin if it has none.
    fn nearest_point(&self, rigid: RigidBodyHandle, to: Point3) -> Point3 {
        let body = &self.physics.bodies[rigid];
        let place = to_point(&to);
        let colliders = body.colliders().iter().filter_map(|handle| self.physics.colliders.get(*handle));
        let points = colliders.map(|solid| solid.shape().project_point(solid.position(), place, true).point);
        let nearest =
            points.min_by(|a, b| (*a - place).length_squared().total_cmp(&(*b - place).length_squared()));
        from_point(nearest.unwrap_or(body.translation()))
    }

    /// Makes the joint.
    fn join(
        &mut self,
        (who, thing): (EntityId, EntityId),
        (hand, held): (RigidBodyHandle, RigidBodyHandle),
        at: Point3,
        grip: Grip,
    ) -> Grasp {
        let at = to_point(&at);
        let frame = |body: &RigidBody| body.position().inverse() * RapierPose::from_translation(at);
        let frames = [hand, held].map(|handle| frame(&self.physics.bodies[handle]));
        let mass = self.mass_of(thing).max(1e-6);
        // Neither swings nor creeps: the thing alone would be damped critically.
        let damping = 2.0 * (grip.stiffness() * mass).sqrt();
        let mut joint = GenericJointBuilder::new(JointAxesMask::empty())
            .local_frame1(frames[0])
            .local_frame2(frames[1])
            .contacts_enabled(true);
        for axis in LINEAR {
            joint = joint
                .motor_model(axis, MotorModel::ForceBased)
                .motor_position(axis, 0.0, grip.stiffness(), damping)
                .motor_max_force(axis, MOST * grip.strength);
        }
        let (axes, torque) = grip.turning.axes();
        for axis in axes {
            let stiffness = torque / TWIST;
            joint = joint
                .motor_model(*axis, MotorModel::ForceBased)
                .motor_position(*axis, 0.0, stiffness, 0.1 * stiffness)
                .motor_max_force(*axis, MOST * torque);
        }
        let joint = self.physics.insert_impulse_joint(hand, held, joint.build());
        let before = from_vector(self.physics.bodies[held].velocity_at_point(at));
        let frames = frames.map(|frame| from_pose(&frame));
        Grasp { who, thing, grip, joint, hand, held, frames, mass, damping, before, force: 0.0 }
    }

    /// The mass of all of a body, kg.
    fn mass_of(&self, id: EntityId) -> f64 {
        let Ok(place) = self.position(id) else { return 0.0 };
        let owned = &self.bodies[place];
        let parts = std::iter::once(&owned.rigid).chain(owned.body.parts());
        parts.filter_map(|handle| self.physics.bodies.get(*handle)).map(RigidBody::mass).sum()
    }

    /// Lets go of what cannot be held any longer, and notes for each who holds how that feels, before anybody moves.
    pub(crate) fn feel_grasps(&mut self) {
        if self.grasps.list.is_empty() {
            self.grasps.holds.clear();
            return;
        }
        let gone: Vec<_> = self
            .grasps
            .list
            .iter()
            .filter(|grasp| !self.still_holds(grasp))
            .map(|grasp| grasp.joint)
            .collect();
        self.release(|grasp| gone.contains(&grasp.joint));
        let passes = self.physics.integration_parameters.num_solver_iterations as f64;
        let middle = 0.5 * (passes + 1.0) / passes;
        let Grasps { list, holds, .. } = &mut self.grasps;
        holds.clear();
        for grasp in list {
            // A thing at rest has to feel the hand that goes on.
            self.physics.bodies[grasp.held].wake_up(true);
            let [hand, held] = grasp.in_world(&self.physics);
            let velocity =
                self.physics.bodies[grasp.held].velocity_at_point(to_vector(&held.translation.vector));
            let velocity = from_vector(velocity);
            let turned = (held.rotation.inverse() * hand.rotation).scaled_axis();
            let change = velocity - grasp.before;
            grasp.before = velocity;
            holds.push(Hold {
                who: grasp.who,
                held: grasp.held,
                hand: hand.translation.vector,
                gap: hand.translation.vector - held.translation.vector,
                turns: grasp.grip.turning != Turning::Free,
                twist: if grasp.grip.turning == Turning::Free { 0.0 } else { turned.z },
                velocity,
                change,
                mass: grasp.mass,
                middle,
                stiffness: grasp.grip.stiffness(),
                damping: grasp.damping,
            });
        }
    }

    fn still_holds(&self, grasp: &Grasp) -> bool {
        let owned = |id| self.position(id).ok().map(|place| &self.bodies[place]);
        let (Some(holder), Some(thing)) = (owned(grasp.who), owned(grasp.thing)) else { return false };
        let is_there = holder.rigid == grasp.hand || holder.body.parts().contains(&grasp.hand);
        let rigid = self.physics.bodies.get(grasp.held);
        let is_free = rigid.is_some_and(|rigid| rigid.is_dynamic() && rigid.is_enabled());
        is_there && can_hold(holder) && thing.rigid == grasp.held && thing.bonds.carried.is_none() && is_free
    }

    /// Reads what the things asked of the hands in a substep of `dt` s, and breaks what was drawn out of them.
    pub(crate) fn strain_grasps(&mut self, dt: f64) {
        let share = dt / self.physics.integration_parameters.num_solver_iterations as f64;
        let mut broken = Vec::new();
        for grasp in &mut self.grasps.list {
            let Some(joint) = self.physics.impulse_joints.get(grasp.joint) else { continue };
            let impulses = LINEAR.map(|axis| joint.data.motor(axis).map_or(0.0, |motor| motor.impulse));
            grasp.force = Vector3::from(impulses).norm() / share;
            let [hand, held] = grasp.in_world(&self.physics);
            let gap = (hand.translation.vector - held.translation.vector).norm();
            let turned = held.rotation.inverse() * hand.rotation;
            let twist = match grasp.grip.turning {
                Turning::Free => 0.0,
                Turning::Upright { .. } => turned.scaled_axis().z.abs(),
                Turning::Firm { .. } => turned.angle(),
            };
            if gap > grasp.grip.give || twist > TWIST {
                broken.push(grasp.joint);
                let (who, thing, force) = (grasp.who, grasp.thing, gap * grasp.grip.stiffness());
                self.grasps.news.push(EventKind::GraspBroke { who, thing, force });
            }
        }
        if !broken.is_empty() {
            self.release(|grasp| broken.contains(&grasp.joint));
        }
    }

    /// Tells what broke in this step.
    pub(crate) fn report_grasps(&mut self, world: &mut World) {
        for event in self.grasps.news.drain(..) {
            world.emit(event);
        }
    }
}

fn can_hold(owned: &Owned) -> bool {
    owned.bonds.carried.is_none() && owned.body.can_hold()
}

impl Grasp {
    /// Where the hand and the place that it holds are.
    fn in_world(&self, physics: &PhysicsWorld) -> [Pose; 2] {
        [(self.hand, &self.frames[0]), (self.held, &self.frames[1])]
            .map(|(body, frame)| from_pose(physics.bodies[body].position()) * frame)
    }
}
