//! How a humanoid takes part in a physics world.

use rapier3d_f64::prelude::{ColliderBuilder, PhysicsWorld, RigidBodyBuilder, RigidBodyHandle};
use simworld_core::event::EventKind;
use simworld_core::geometry::{Twist, Vector2};
use simworld_core::id::EntityId;
use simworld_core::scene::{CROUCHED, FOOTING, Footing, Role, Scene, World, WorldError};
use simworld_core::seam::BodyState;
use simworld_core::value::Value;

use super::gait::NEVER;
use super::ragdoll::{Ragdoll, dressed};
use super::{Gait, Humanoid, Pace, Posture, Recovery};
use crate::body::{BodyContext, Bonds, PhysicsBody, Surroundings};
use crate::convert::{from_pose, to_pose};
use crate::dynamics::LONGEST_JOINTED_SUBSTEP;
use crate::shape::walker_mark;

impl PhysicsBody for Humanoid {
    fn attach(&mut self, id: EntityId, physics: &mut PhysicsWorld) -> RigidBodyHandle {
        let (solid, body_from_solid) = self.collider();
        let frame = RigidBodyBuilder::kinematic_position_based().pose(to_pose(&self.state.pose));
        let collider = dressed(ColliderBuilder::new(solid))
            .position(body_from_solid)
            .mass(self.mass)
            .user_data(walker_mark(id));
        physics.insert(frame, collider).0
    }

    fn parts(&self) -> &[RigidBodyHandle] {
        self.motion.recovery.limbs().map_or(&[], Ragdoll::limbs)
    }

    fn longest_substep(&self) -> f64 {
        if self.is_limp() { LONGEST_JOINTED_SUBSTEP } else { f64::INFINITY }
    }

    fn bind(&mut self, bonds: Bonds) {
        (self.plan.load, self.plan.hung) = (bonds.load, 0.0);
        self.assume(match (bonds.carried, bonds.scooter) {
            (Some(Role::Seated), _) => Posture::Seated,
            (Some(_), _) => Posture::Aboard,
            (None, Some(_)) if self.footing() == Footing::Upright => Posture::Riding,
            (None, _) => Posture::Standing,
        });
    }

    fn can_hold(&self) -> bool {
        self.footing() == Footing::Upright && self.motion.posture == Posture::Standing
    }

    fn can_roam(&self) -> bool {
        self.can_stroll()
    }

    fn roam(&mut self, around: &Surroundings<'_>, dt: f64) {
        if !std::mem::replace(&mut self.plan.strolls, true) {
            self.plan.told = NEVER;
        }
        self.stroll(around, dt);
    }

    fn sense(&mut self, around: &Surroundings<'_>, dt: f64) {
        self.stop_strolling();
        if self.is_limp() {
            self.look_for_ground(around);
        } else {
            self.look_around(around, dt);
        }
    }

    fn drive(&mut self, context: &mut BodyContext<'_>, dt: f64) {
        if self.is_limp() {
            self.recover(context, dt);
            return;
        }
        if let Some(cause) = self.plan.upset.take() {
            self.fall(cause, context.physics, context.rigid);
            return;
        }
        self.change_stature(context);
        let displacement = self.step_on(context);
        self.push(context, dt);
        self.slow_down(displacement.xy(), dt);
        self.recover(context, dt);
    }

    fn settle(&mut self, state: &BodyState) {
        self.state = *state;
        self.motion.feet = state.pose.translation.vector.into();
        if let Some(pose) = self.seen_rising(&state.pose) {
            self.state.pose = pose;
        }
    }

    fn gather(&mut self, physics: &mut PhysicsWorld, rigid: RigidBodyHandle) {
        if self.motion.recovery == Recovery::Upright {
            return;
        }
        let stand = simworld_core::geometry::pose_facing(
            from_pose(physics.bodies[rigid].position()).translation.vector.into(),
            self.motion.yaw,
        );
        self.stand_up(&stand, physics, rigid);
        self.plan.got_up = true;
    }

    fn place(&mut self, state: &BodyState) {
        self.stand_at(&state.pose);
        self.state.twist = Twist::ZERO;
        self.motion.grounded = false;
        self.motion.fall_speed = 0.0;
        self.motion.support = None;
        self.motion.balance.momentum = Vector2::zeros();
        self.motion.pace = Pace::default();
        self.motion.gait = Gait::default();
    }

    fn report(&mut self, id: EntityId, world: &mut World) -> Result<(), WorldError> {
        if self.has_told() {
            return Ok(());
        }
        let footing = self.footing();
        if world.entity(id).is_some_and(|entity| entity.footing() != footing) {
            world.set_attribute(id, FOOTING, footing.to_attribute())?;
        }
        let crouched = self.is_crouched();
        if world.entity(id).is_some_and(|entity| entity.is_crouched() != crouched) {
            world.set_attribute(id, CROUCHED, crouched.then_some(Value::Bool(true)))?;
        }
        if let Some(joints) = self.joints() {
            world.set_joints(id, joints)?;
        }
        if let Some(cause) = self.plan.fell.take() {
            world.emit(EventKind::Fell { who: id, cause });
        }
        if std::mem::take(&mut self.plan.got_up) {
            world.emit(EventKind::GotUp { who: id });
        }
        Ok(())
    }
}
