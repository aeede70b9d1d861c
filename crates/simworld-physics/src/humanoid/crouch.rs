//! Crouching: lower and slower, under what is too low to walk upright.

use parry3d_f64::shape::Cylinder;
use rapier3d_f64::math::{Pose as RapierPose, Vector};
use serde::{Deserialize, Serialize};
use simworld_core::geometry::pose_facing;

use super::{Humanoid, Posture};
use crate::body::{BodyContext, Surroundings};
use crate::convert::to_pose;
use crate::shape::upright;

/// Height of who crouches as a share of that of who stands: hips and knees bent by about a right angle.
pub(super) const LOW: f64 = 0.7;
/// Nobody is faster who crouches, m/s: chosen, about three quarters of the speed of walking.
const FASTEST: f64 = 1.0;

/// Whether somebody crouches.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub(super) struct Crouch {
    /// Whether it was told to.
    wanted: bool,
    /// Whether it does.
    pub(super) is_low: bool,
}

impl Crouch {
    /// Whether it does or is about to.
    pub(super) fn is_any(self) -> bool {
        self.wanted || self.is_low
    }
}

impl Humanoid {
    /// Tells it to crouch, as `Action::Crouch` does, or to stand up straight again, as `StandUp` does, which it does where there is room
    /// above it. Others see it (`EntityRef::is_crouched`). Who crouches on its feet is 0.7 times
    /// as high and goes no faster than 1 m/s; the shape of its entity stays what it was. It is a part of saved states.
    pub fn crouch(&mut self, low: bool) {
        self.motion.crouch.wanted = low;
    }

    /// Whether it crouches now.
    pub fn is_crouched(&self) -> bool {
        self.motion.crouch.is_low
    }

    /// How high it is as it stands or crouches, m.
    pub(super) fn stature(&self) -> f64 {
        if self.motion.crouch.is_low { LOW * self.height } else { self.height }
    }

    /// A speed on foot, held back by crouching, m/s.
    pub(super) fn speed_under(&self, wish: f64) -> f64 {
        if self.motion.crouch.is_low { wish.min(FASTEST) } else { wish }
    }

    /// Makes up its mind whether to go down or up in this substep.
    pub(super) fn mind_the_head(&mut self, around: &Surroundings<'_>) {
        let wanted = self.motion.crouch.wanted && self.motion.posture == Posture::Standing;
        let changes = wanted != self.motion.crouch.is_low && (wanted || self.has_room_above(around));
        self.plan.goes_low = changes.then_some(wanted);
    }

    /// Whether nothing is where its head would be.
    fn has_room_above(&self, around: &Surroundings<'_>) -> bool {
        let (low, high) = (self.stature(), self.height);
        let solid = Cylinder::new((high - low) * 0.5, self.radius);
        let middle = RapierPose::from_parts(Vector::new(0.0, 0.0, (high + low) * 0.5), upright());
        let place = to_pose(&pose_facing(self.feet(), self.motion.yaw)) * middle;
        around.queries().intersect_shape(place, &solid).next().is_none()
    }

    /// Takes the form of who crouches or stands, if it made up its mind to.
    pub(super) fn change_stature(&mut self, context: &mut BodyContext<'_>) {
        let Some(low) = self.plan.goes_low.take() else { return };
        self.motion.crouch.is_low = low;
        let (solid, body_from_solid) = self.collider();
        let first = context.physics.bodies.get(context.rigid).and_then(|rigid| rigid.colliders().first());
        if let Some(collider) = first.copied().and_then(|first| context.physics.colliders.get_mut(first)) {
            collider.set_shape(solid);
            collider.set_position_wrt_parent(body_from_solid);
        }
    }
}
