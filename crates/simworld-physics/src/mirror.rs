//! Things that others move, such as the cars and pedestrians of traffic: solid near a body of this physics, and met
//! by rays everywhere.

use rapier3d_f64::prelude::{RigidBodyBuilder, RigidBodyHandle};
use serde::{Deserialize, Serialize};
use simworld_core::geometry::{Point2, Pose};
use simworld_core::id::EntityId;
use simworld_core::scene::{EntityRef, Scene, Shape, World};

use crate::convert::to_pose;
use crate::dynamics::PhysicsDynamics;
use crate::shape::{collider_for, material_of_entity};
use crate::sync::Slot;

/// How much farther than the mirror radius something stays solid once it is, m: it does not flicker at the rim.
const RIM: f64 = 5.0;
/// A longer way in one step is a jump and sweeps nothing along, m.
const JUMP: f64 = 10.0;

/// The image of an entity that others move.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct Mirror {
    pub(crate) id: EntityId,
    pub(crate) shape: Shape,
    pub(crate) pose: Pose,
    /// Its kinematic body while something of this physics is near.
    pub(crate) rigid: Option<RigidBodyHandle>,
}

/// A way that a mirrored body goes within this step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Moving {
    pub(crate) rigid: RigidBodyHandle,
    from: Pose,
    to: Pose,
}

impl PhysicsDynamics {
    pub(crate) fn synchronise_mirror(&mut self, slot: usize, entity: &EntityRef<'_>, world: &World) {
        self.look_up_near(world);
        let known = match &self.slots[slot] {
            Slot::Traffic(mirror) if mirror.id == entity.id && mirror.shape == entity.info.shape => {
                Some((mirror.pose, mirror.rigid))
            }
            _ => None,
        };
        let Some((pose, rigid)) = known else {
            let stood = match &self.slots[slot] {
                Slot::Fixed { id, pose, .. } if *id == entity.id => Some(*pose),
                _ => None,
            };
            self.vacate(slot);
            let rigid = self.is_near(entity.planar(), 0.0).then(|| self.mirror(entity, world));
            if let (Some(rigid), Some(stood)) = (rigid, stood) {
                // It begins to move from where it stood.
                self.physics.bodies[rigid].set_position(to_pose(&stood), true);
                self.file_body(rigid);
                self.follow(rigid, &stood, entity.pose);
            }
            let (id, shape, pose) = (entity.id, entity.info.shape, *entity.pose);
            self.set_slot(slot, Slot::Traffic(Mirror { id, shape, pose, rigid }));
            return;
        };
        let rigid = match rigid {
            None if self.is_near(entity.planar(), 0.0) => Some(self.mirror(entity, world)),
            Some(rigid) if !self.is_near(entity.planar(), RIM) => {
                self.physics.remove_body(rigid);
                None
            }
            Some(rigid) if pose != *entity.pose => {
                self.follow(rigid, &pose, entity.pose);
                Some(rigid)
            }
            unchanged => unchanged,
        };
        if let Slot::Traffic(mirror) = &mut self.slots[slot] {
            mirror.pose = *entity.pose;
            mirror.rigid = rigid;
        }
    }

    /// Looks up where bodies are, once a step and only where there is traffic.
    fn look_up_near(&mut self, world: &World) {
        if std::mem::replace(&mut self.near_is_known, true) {
            return;
        }
        self.near.clear();
        let solid = self.bodies.iter().filter(|owned| !owned.is_roaming);
        for entity in solid.filter_map(|owned| world.entity(owned.id)) {
            self.near.insert(entity.planar(), entity.planar());
        }
    }

    /// Whether a place in the plane is within the mirror radius, and a margin, of a body of this physics.
    fn is_near(&self, place: Point2, margin: f64) -> bool {
        let reach = self.config.mirror_radius + margin;
        self.near.near(place, reach).any(|body| (body - place).norm_squared() <= reach * reach)
    }

    fn mirror(&mut self, entity: &EntityRef<'_>, world: &World) -> RigidBodyHandle {
        let body = RigidBodyBuilder::kinematic_position_based().pose(to_pose(entity.pose));
        let collider = collider_for(&entity.info.shape, entity.id, material_of_entity(entity, world));
        let rigid = self.physics.insert(body, collider).0;
        self.file_body(rigid);
        rigid
    }

    fn follow(&mut self, rigid: RigidBodyHandle, from: &Pose, to: &Pose) {
        if (to.translation.vector - from.translation.vector).norm() > JUMP {
            self.physics.bodies[rigid].set_position(to_pose(to), true);
            self.file_body(rigid);
        } else {
            self.moving.push(Moving { rigid, from: *from, to: *to });
        }
    }

    /// Sends every mirrored body that moves in this step on to where it is after a share of the step. The engine
    /// takes its velocity from that, so a car that runs into a box strikes it with its speed.
    pub(crate) fn advance_mirrors(&mut self, share: f64) {
        for Moving { rigid, from, to } in &self.moving {
            let pose = if share >= 1.0 { *to } else { from.try_lerp_slerp(to, share, 1e-9).unwrap_or(*to) };
            if let Some(body) = self.physics.bodies.get_mut(*rigid) {
                body.set_next_kinematic_position(to_pose(&pose));
            }
        }
    }
}
