//! Pushing what is in the way, making room for who pushes, and being carried by what one stands on.
//!
//! Somebody pushes with both hands in line with the middle of a thing, so that nothing turns or tips over, and leaves alone
//! what friction holds against all of the force. Who stands steps back and aside as fast as somebody comes who walks; who
//! walks holds his own.

use parry3d_f64::query::contact;
use parry3d_f64::shape::Shape;
use rapier3d_f64::math::{Pose as RapierPose, Vector};
use rapier3d_f64::prelude::{Collider, ColliderHandle};
use simworld_core::geometry::{Vector2, Vector3};
use simworld_core::id::EntityId;

use super::walk::SKIN;
use super::{Humanoid, Posture};
use crate::body::{BodyContext, Surroundings};
use crate::convert::{from_vector, to_vector};
use crate::shape::{BodyTag, is_on_wheels, is_walker};

/// Beyond this gap one does not touch what one pushes, m.
const TOUCH: f64 = SKIN + 0.03;

/// Something in the way.
#[derive(Clone, Copy, Debug)]
pub(super) struct Push {
    collider: ColliderHandle,
    /// Towards it, in the plane, unit length.
    direction: Vector2,
    /// To the side of the way on which it is, in the plane, unit length.
    aside: Vector2,
    /// The speed at which one would go there, m/s.
    speed: f64,
}

/// A push of one person against another, as the other finds it.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub(crate) struct Shove {
    /// Who is pushed.
    pub(crate) whom: EntityId,
    /// The velocity that it is given, m/s.
    pub(crate) velocity: Vector2,
}

impl Humanoid {
    /// Notes what the way led against, from where it ended.
    pub(super) fn find_pushes(
        &mut self,
        met: &[ColliderHandle],
        wish: &Vector3,
        end: &RapierPose,
        solid: &dyn Shape,
        around: &Surroundings<'_>,
        dt: f64,
    ) {
        for handle in met {
            let Some(other) = around.physics.colliders.get(*handle) else { continue };
            if !is_pushed(other, around)
                || Self::has_hold_of(other.parent(), around)
                || self.plan.pushes.iter().any(|push| push.collider == *handle)
            {
                continue;
            }
            let Ok(Some(touch)) = contact(end, solid, other.position(), other.shape(), TOUCH) else {
                continue;
            };
            let Some(direction) = from_vector(touch.normal1).xy().try_normalize(0.5) else { continue };
            let speed = wish.xy().dot(&direction) / dt;
            let Some(ahead) = wish.xy().try_normalize(1e-9).filter(|_| speed > 0.0) else { continue };
            let left = Vector2::new(-ahead.y, ahead.x);
            let aside = if direction.dot(&left) > 0.0 { left } else { -left };
            self.plan.pushes.push(Push { collider: *handle, direction, aside, speed });
        }
    }

    /// Pushes what it found in the way.
    pub(super) fn push(&mut self, context: &mut BodyContext<'_>, dt: f64) {
        for push in std::mem::take(&mut self.plan.pushes) {
            let Some(collider) = context.physics.colliders.get(push.collider) else { continue };
            if is_walker(collider.user_data) {
                let Some(whom) = BodyTag::from_user_data(collider.user_data).entity() else { continue };
                let way = (push.direction + push.aside) * std::f64::consts::FRAC_1_SQRT_2;
                context.shoves.push(Shove { whom, velocity: way * push.speed });
                continue;
            }
            let friction = if is_on_wheels(collider.user_data) {
                0.0
            } else {
                (collider.friction() * context.conditions.road.friction(context.config.ground)).sqrt()
            };
            let Some(rigid) = collider.parent().and_then(|parent| context.physics.bodies.get_mut(parent))
            else {
                continue;
            };
            let held = friction * rigid.mass() * context.config.gravity;
            if held >= self.config.push_force {
                continue;
            }
            let direction = Vector::new(push.direction.x, push.direction.y, 0.0);
            let short = push.speed - rigid.linvel().dot(direction);
            let impulse = (rigid.mass() * short + held * dt).clamp(0.0, self.config.push_force * dt);
            rigid.apply_impulse(direction * impulse, true);
        }
    }

    /// How far it makes room for who pushes it, m; who walks does not.
    pub(super) fn give_way(&self, around: &Surroundings<'_>, dt: f64) -> Vector3 {
        let walks = self.motion.wanted_speed > 0.0 || self.motion.step_left != Vector3::zeros();
        if walks || self.motion.posture != Posture::Standing || around.shoves.is_empty() {
            return Vector3::zeros();
        }
        let own = around.collider().and_then(|own| BodyTag::from_user_data(own.user_data).entity());
        let pushed = around.shoves.iter().filter(|shove| Some(shove.whom) == own);
        let velocity: Vector2 = pushed.map(|shove| shove.velocity).sum();
        let way = velocity * dt;
        Vector3::new(way.x, way.y, 0.0)
    }

    /// How far what it stands on carries it, m, and turns it, radians.
    pub(super) fn carry(&self, around: &Surroundings<'_>, dt: f64) -> (Vector3, f64) {
        let support = self.motion.support.and_then(|handle| around.physics.colliders.get(handle));
        let rigid = support.and_then(Collider::parent).and_then(|parent| around.physics.bodies.get(parent));
        let Some(rigid) = rigid.filter(|_| self.motion.grounded) else { return (Vector3::zeros(), 0.0) };
        let feet = to_vector(&self.feet().coords);
        (from_vector(rigid.velocity_at_point(feet)) * dt, rigid.angvel().z * dt)
    }
}

/// Whether it is a thing that lies free, or somebody on foot.
fn is_pushed(other: &Collider, around: &Surroundings<'_>) -> bool {
    let rigid = other.parent().and_then(|parent| around.physics.bodies.get(parent));
    rigid.is_some_and(|rigid| rigid.is_dynamic() || is_walker(other.user_data))
}
