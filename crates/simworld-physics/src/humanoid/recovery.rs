//! Falling, lying and getting up: a small state machine beside the laws of mechanics.
//!
//! Upright, until the balance is lost; then falling, with limbs on joints, until all of it rests; then down; then rising, on
//! a free place beside, with the room of somebody who stands, from which the body is seen to come up.

use parry3d_f64::query::Ray;
use rapier3d_f64::math::Vector;
use rapier3d_f64::prelude::{
    Collider, ColliderHandle, PhysicsWorld, QueryFilter, RigidBodyHandle, RigidBodyType,
};
use serde::{Deserialize, Serialize};
use simworld_core::geometry::{Point3, Pose, Vector2, Vector3, pose_facing};
use simworld_core::limbs::{JointAngles, LegAngles};
use simworld_core::ops;
use simworld_core::scene::{FallCause, Footing};

use super::Humanoid;
use super::balance::CENTER;
use super::gait::{SHANK, THIGH};
use super::ragdoll::Ragdoll;
use super::walk::SKIN;
use crate::body::BodyContext;
use crate::convert::{from_vector, to_pose, to_vector};
use crate::shape::is_walker;

/// Slower than this a body rests, m/s: of the trunk, and of the limbs three times as fast.
const RESTING: f64 = 0.2;
/// Time for which it has to rest, s, and while its limbs do not.
const REST: f64 = 0.4;
const STILL: f64 = 3.0;
/// Time that one lies before one gets up, s.
const LYING: f64 = 1.0;
/// Time that getting up takes, s: healthy young adults take 2 to 3 s from lying on the back.
const RISING: f64 = 2.5;
/// Who has fallen goes on no faster than people walk, m/s (Weidmann 1993).
const WALK: f64 = 1.34;
/// Hip and knee of who is half-way up, beyond those on the way from lying to standing, radians.
const CROUCH: [f64; 2] = [1.0, 1.9];
/// How far around the middle of the body a place to stand is looked for, m.
const PLACES: [f64; 4] = [0.0, 0.3, 0.6, 1.0];
/// How long to wait before looking for a place again, s.
const PATIENCE: f64 = 0.5;

/// How somebody fares since it fell.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) enum Recovery {
    #[default]
    Upright,
    /// With limbs on joints; at rest for so long, s.
    Falling { limbs: Ragdoll, resting: f64 },
    /// Lying for so long, s.
    Down { limbs: Ragdoll, lying: f64 },
    /// Getting up for so long, s, from where it lay as seen from where it stands, and from how its limbs lay.
    Rising { since: f64, stand_from_lying: Pose, limbs: Box<JointAngles> },
}

impl Recovery {
    pub(super) fn footing(&self) -> Footing {
        match self {
            Self::Upright => Footing::Upright,
            Self::Falling { .. } => Footing::Falling,
            Self::Down { .. } => Footing::Down,
            Self::Rising { .. } => Footing::Rising,
        }
    }

    /// The limbs beside the trunk.
    pub(super) fn limbs(&self) -> Option<&Ragdoll> {
        match self {
            Self::Falling { limbs, .. } | Self::Down { limbs, .. } => Some(limbs),
            Self::Upright | Self::Rising { .. } => None,
        }
    }
}

impl Humanoid {
    /// Whether it is a body of limbs.
    pub(super) fn is_limp(&self) -> bool {
        self.motion.recovery.limbs().is_some()
    }

    /// Loses its footing: from now on it is a body of limbs with the velocity of its centre of mass.
    pub(super) fn fall(&mut self, cause: FallCause, physics: &mut PhysicsWorld, trunk: RigidBodyHandle) {
        let momentum = self.motion.balance.momentum;
        // Who lands too hard is stopped by the ground, at the price of the legs, and crumples where it stands.
        let (sink, way) = match cause {
            FallCause::Landed => (0.0, self.plan.way),
            _ => (self.motion.fall_speed, Vector3::zeros()),
        };
        let velocity = Vector::new(momentum.x, momentum.y, -sink);
        let rigid = &mut physics.bodies[trunk];
        let feet = from_vector(rigid.translation()) + way;
        let pose = pose_facing(feet.into(), self.motion.yaw);
        rigid.set_body_type(RigidBodyType::Dynamic, true);
        rigid.set_position(to_pose(&pose), true);
        rigid.set_linvel(velocity, true);
        rigid.set_angvel(Vector::ZERO, true);
        let limbs = Ragdoll::of(physics, trunk, self.build());
        self.motion.recovery = Recovery::Falling { limbs, resting: 0.0 };
        self.motion.support = None;
        self.motion.step_left = Vector3::zeros();
        self.motion.balance.is_careful |= cause == FallCause::Slipped;
        self.plan.fell = Some(cause);
    }

    /// What it does while it is not upright; the limbs do the rest.
    pub(super) fn recover(&mut self, context: &mut BodyContext<'_>, dt: f64) {
        let (physics, trunk) = (&mut *context.physics, context.rigid);
        self.plan.limp = self.motion.recovery.limbs().map(|limbs| limbs.angles(physics, trunk));
        self.come_up(physics, trunk);
        match std::mem::take(&mut self.motion.recovery) {
            Recovery::Falling { limbs, resting } => {
                let resting = match ease(physics, trunk, &limbs) {
                    Ease::All => resting + dt,
                    // Nobody's limbs go on swinging: who lies takes hold of them.
                    Ease::Trunk => resting + dt * (REST / STILL),
                    Ease::None => 0.0,
                };
                self.motion.recovery = if resting < REST {
                    Recovery::Falling { limbs, resting }
                } else {
                    Recovery::Down { limbs, lying: 0.0 }
                };
            }
            Recovery::Down { limbs, lying } if lying + dt < LYING => {
                // What strikes who lies sends it tumbling again.
                self.motion.recovery = if ease(physics, trunk, &limbs) == Ease::None {
                    Recovery::Falling { limbs, resting: 0.0 }
                } else {
                    Recovery::Down { limbs, lying: lying + dt }
                };
            }
            Recovery::Down { limbs, .. } => match self.place_to_stand(&limbs, physics, trunk) {
                Some(stand) => self.rise(limbs, &stand, physics, trunk),
                None => self.motion.recovery = Recovery::Down { limbs, lying: LYING - PATIENCE },
            },
            Recovery::Rising { since, .. } if since + dt >= RISING => {
                self.motion.wanted_speed = self.motion.wanted_speed.min(WALK);
                self.plan.got_up = true;
            }
            Recovery::Rising { since, stand_from_lying, limbs } => {
                self.motion.recovery = Recovery::Rising { since: since + dt, stand_from_lying, limbs };
            }
            Recovery::Upright => {}
        }
    }

    /// Takes the room of somebody who stands there, and begins to get up.
    fn rise(&mut self, limbs: Ragdoll, stand: &Pose, physics: &mut PhysicsWorld, trunk: RigidBodyHandle) {
        let stand_from_lying = stand.inverse() * self.state.pose;
        self.motion.recovery = Recovery::Down { limbs, lying: 0.0 };
        self.stand_up(stand, physics, trunk);
        let limbs = Box::new(self.plan.limp.unwrap_or_default());
        self.motion.recovery = Recovery::Rising { since: 0.0, stand_from_lying, limbs };
    }

    /// Is upright again at once, at a pose.
    pub(super) fn stand_up(&mut self, stand: &Pose, physics: &mut PhysicsWorld, trunk: RigidBodyHandle) {
        if let Recovery::Falling { mut limbs, .. } | Recovery::Down { mut limbs, .. } =
            std::mem::take(&mut self.motion.recovery)
        {
            limbs.remove(physics);
        }
        let (solid, body_from_solid) = self.collider();
        let rigid = &mut physics.bodies[trunk];
        rigid.set_body_type(RigidBodyType::KinematicPositionBased, true);
        rigid.set_linvel(Vector::ZERO, true);
        rigid.set_angvel(Vector::ZERO, true);
        rigid.set_position(to_pose(stand), true);
        rigid.set_next_kinematic_position(to_pose(stand));
        if let Some(first) = rigid.colliders().first().copied() {
            let collider = &mut physics.colliders[first];
            collider.set_shape(solid);
            collider.set_position_wrt_parent(body_from_solid);
            collider.set_position(to_pose(stand) * body_from_solid);
        }
        self.motion.balance.momentum = Vector2::zeros();
        self.motion.fall_speed = 0.0;
        self.motion.grounded = true;
    }

    /// The nearest free place to stand, beside where the body lies.
    fn place_to_stand(
        &self,
        limbs: &Ragdoll,
        physics: &PhysicsWorld,
        trunk: RigidBodyHandle,
    ) -> Option<Pose> {
        let others = |_: ColliderHandle, collider: &Collider| {
            collider.parent().is_none_or(|parent| parent != trunk && !limbs.limbs().contains(&parent))
        };
        let filter = QueryFilter::new().predicate(&others);
        let middle = from_vector(physics.bodies[trunk].center_of_mass());
        let (solid, body_from_solid) = self.collider();
        let ring = PLACES.iter().flat_map(|radius| {
            (0..if *radius == 0.0 { 1 } else { 8 }).map(move |turn| {
                let (sin, cos) = ops::sin_cos(f64::from(turn) * std::f64::consts::FRAC_PI_4);
                Vector2::new(cos, sin) * *radius
            })
        });
        for offset in ring {
            let above = middle + Vector3::new(offset.x, offset.y, self.radius);
            let down = Ray::new(to_vector(&above), -Vector::Z);
            let Some((met, hit)) =
                physics.cast_ray_and_get_normal(&down, 2.0 * CENTER * self.height, true, filter)
            else {
                continue;
            };
            let on_somebody = is_walker(physics.colliders[met].user_data);
            if hit.normal.z < 0.1 || hit.time_of_impact <= 0.0 || on_somebody {
                continue;
            }
            // On a slope the rim of the body stands higher than its middle.
            let slope = (1.0 - hit.normal.z * hit.normal.z).max(0.0).sqrt() / hit.normal.z;
            let height = above.z - hit.time_of_impact + slope * self.radius + SKIN * 0.5;
            let pose = pose_facing(Point3::new(above.x, above.y, height), self.motion.yaw);
            let place = to_pose(&pose) * body_from_solid;
            if physics.intersect_shape(place, &*solid, filter).next().is_none() {
                return Some(pose);
            }
        }
        None
    }

    /// The pose that is seen of somebody who gets up and stands at a pose.
    pub(super) fn seen_rising(&self, stand: &Pose) -> Option<Pose> {
        let Recovery::Rising { since, stand_from_lying, .. } = &self.motion.recovery else { return None };
        let share = risen(*since);
        let from = stand * stand_from_lying;
        // The middle of the body comes up on a straight line; the feet find their place under it.
        let middle = Point3::new(0.0, 0.0, CENTER * self.height);
        let rotation = from.rotation.try_slerp(&stand.rotation, share, 1e-9).unwrap_or(stand.rotation);
        let place = (from * middle).coords.lerp(&(stand * middle).coords, share);
        Some(Pose::from_parts((place - rotation * middle.coords).into(), rotation))
    }

    /// How the limbs of who gets up are held: from how they lay to those of who stands, through a crouch, with the feet where
    /// they will stand.
    pub(super) fn rising_joints(&self) -> Option<JointAngles> {
        let Recovery::Rising { since, limbs, .. } = &self.motion.recovery else { return None };
        let share = risen(*since);
        let mut joints = limbs.toward(&JointAngles::default(), share);
        let crouch = 4.0 * share * (1.0 - share);
        for leg in [&mut joints.left_leg, &mut joints.right_leg] {
            leg.hip_flexion += CROUCH[0] * crouch;
            leg.knee_flexion = (leg.knee_flexion + CROUCH[1] * crouch).min(leg.knee_flexion.max(CROUCH[1]));
        }
        let length = |leg: &LegAngles| {
            THIGH * ops::cos(leg.hip_flexion) + SHANK * ops::cos(leg.hip_flexion - leg.knee_flexion)
        };
        let longest = length(&joints.left_leg).max(length(&joints.right_leg));
        joints.hip_drop = share * (THIGH + SHANK - longest) * self.height;
        Some(joints)
    }
}

/// The share of its way up that somebody has come, who has been getting up for so long, s; slow at both ends.
fn risen(since: f64) -> f64 {
    let share = (since / RISING).clamp(0.0, 1.0);
    share * share * (3.0 - 2.0 * share)
}

/// What of somebody hardly moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Ease {
    All,
    /// Not all of its limbs.
    Trunk,
    None,
}

fn ease(physics: &PhysicsWorld, trunk: RigidBodyHandle, limbs: &Ragdoll) -> Ease {
    let slow = |handle: RigidBodyHandle, limit: f64| {
        physics.bodies.get(handle).is_none_or(|rigid| rigid.linvel().length() < limit)
    };
    if !slow(trunk, RESTING) {
        Ease::None
    } else if limbs.limbs().iter().all(|limb| slow(*limb, 3.0 * RESTING)) {
        Ease::All
    } else {
        Ease::Trunk
    }
}
