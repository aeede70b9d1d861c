//! Riders who fall: what they rode goes on beside them, without them.

use rapier3d_f64::prelude::{Collider, ColliderHandle, QueryFilter};
use simworld_core::event::EventKind;
use simworld_core::geometry::{Pose, Twist, Vector3, pose_facing, yaw_of};
use simworld_core::id::EntityId;
use simworld_core::scene::{EntityRef, Role, Scene, World};

use crate::PhysicsError;
use crate::convert::to_pose;
use crate::dynamics::PhysicsDynamics;
use crate::shape::{BodyTag, shape_from};

/// Room between a rider and what it rode, m.
const GAP: f64 = 0.05;

impl PhysicsDynamics {
    /// Frees what was ridden by who fell in this step: from now on it is a free body with the velocity that both had.
    pub(crate) fn part_fallen_riders(&mut self, world: &mut World) -> Result<(), PhysicsError> {
        let fell = |event: &EventKind| match event {
            EventKind::Fell { who, .. } if self.position(*who).is_ok() => Some(*who),
            _ => None,
        };
        let fallen: Vec<EntityId> = world.events().iter().filter_map(|event| fell(&event.kind)).collect();
        for rider in fallen {
            let Some(scooter) = world.attached(rider, Role::Ridden) else { continue };
            let (Some(who), Some(what)) = (world.entity(rider), world.entity(scooter)) else { continue };
            let pose = self.beside(&who, &what);
            let twist = Twist { linear: who.twist.linear, angular: Vector3::zeros() };
            world.reset(scooter, pose, twist, None)?;
            if self.body(scooter).is_none() {
                self.add_rigid(world, scooter)?;
                self.mark_adopted(scooter);
            }
        }
        Ok(())
    }

    /// A free place for what somebody rode: to its left, to its right or behind it; to the left if none is free.
    fn beside(&self, rider: &EntityRef<'_>, scooter: &EntityRef<'_>) -> Pose {
        let (own, other) = (rider.info.shape.size() * 0.5, scooter.info.shape.size() * 0.5);
        let (aside, back) = (own.y + other.y + GAP, own.x + other.x + GAP);
        let stand = pose_facing(rider.position(), yaw_of(scooter.pose));
        let lift = Vector3::z() * GAP;
        let place = |offset: Vector3| stand * Pose::translation(offset.x, offset.y, offset.z);
        let wished = [Vector3::y() * aside, -Vector3::y() * aside, -Vector3::x() * back];
        let is_free = |pose: &Pose| {
            let (solid, body_from_solid) = shape_from(&scooter.info.shape);
            let others = |_: ColliderHandle, collider: &Collider| {
                BodyTag::from_user_data(collider.user_data).entity() != Some(rider.id)
            };
            let at = to_pose(pose) * body_from_solid;
            let filter = QueryFilter::new().predicate(&others);
            self.physics.intersect_shape(at, &*solid, filter).next().is_none()
        };
        let mut places = wished.into_iter().map(|offset| place(offset + lift));
        places.find(is_free).unwrap_or_else(|| place(wished[0] + lift))
    }
}
