//! Actions on objects: their preconditions and what they change.
//!
//! Locomotion belongs to bodies; taking, giving, sitting and riding belong to the world, because they are facts
//! that everybody sees. Each rule checks its precondition and then makes or breaks one bond.

use thiserror::Error;

use super::{Attachment, EntityKind, EntityRef, Role, Scene, World};
use crate::action::Action;
use crate::geometry::{Point3, Pose, pose_facing, yaw_of};
use crate::id::EntityId;

/// How far a person reaches, m, measured in the plane to the object's footprint or access point.
pub const ARM_REACH: f64 = 2.0;

/// Why an action on an object is impossible.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum InteractionError {
    /// The actor or the object does not exist.
    #[error("there is no entity {id}: it was removed, or never spawned")]
    Missing {
        /// The unknown id.
        id: EntityId,
    },
    /// The object is too far away.
    #[error("{label} {id} is {distance:.1} m away and the reach is {ARM_REACH} m: go there first")]
    OutOfReach {
        /// The object.
        id: EntityId,
        /// What it is called.
        label: String,
        /// Distance, m.
        distance: f64,
    },
    /// The object is not of a kind that can be used so.
    #[error("a {kind} cannot be used to {verb}")]
    WrongKind {
        /// The object's kind.
        kind: EntityKind,
        /// The attempted use.
        verb: &'static str,
    },
    /// Somebody else uses the object.
    #[error("{label} {id} is taken by {by}")]
    Taken {
        /// The object.
        id: EntityId,
        /// What it is called.
        label: String,
        /// Who has it.
        by: EntityId,
    },
    /// The actor already does something that excludes the action.
    #[error("{who} cannot {verb} while {state}")]
    Busy {
        /// The actor.
        who: EntityId,
        /// The attempted action.
        verb: &'static str,
        /// What is in the way.
        state: &'static str,
    },
}

/// The use of an object that an action stands for.
struct Use {
    verb: &'static str,
    role: Role,
    fits: fn(EntityKind) -> bool,
    /// Where the child sits in the parent's body frame.
    offset: Point3,
}

impl World {
    /// Carries out an action on an object. Actions that only move the body are none of the world's business
    /// and succeed without effect.
    pub(super) fn interact(&mut self, who: EntityId, action: &Action) -> Result<(), InteractionError> {
        match action {
            Action::PickUp { item } => self.take(
                who,
                *item,
                &Use {
                    verb: "pick up",
                    role: Role::Held,
                    fits: |kind| kind == EntityKind::Parcel,
                    offset: Point3::new(0.35, -0.25, 0.9),
                },
            ),
            Action::CarryHeavy { item } => self.take(
                who,
                *item,
                &Use {
                    verb: "carry",
                    role: Role::Carried,
                    fits: |kind| {
                        matches!(
                            kind,
                            EntityKind::Parcel | EntityKind::Chair | EntityKind::Cone | EntityKind::Prop
                        )
                    },
                    offset: Point3::new(0.5, 0.0, 0.8),
                },
            ),
            Action::DropOff => self.put_down(who, Role::Held, "drop off", "holding nothing"),
            Action::PutDownHeavy => self.put_down(who, Role::Carried, "put down", "carrying nothing"),
            Action::SitDown { seat } => self.mount(
                who,
                *seat,
                &Use { verb: "sit", role: Role::Seated, fits: EntityKind::is_seat, offset: Point3::origin() },
            ),
            Action::RideScooter { scooter } => self.take(
                who,
                *scooter,
                &Use {
                    verb: "ride",
                    role: Role::Ridden,
                    fits: |kind| kind == EntityKind::Scooter,
                    offset: Point3::origin(),
                },
            ),
            Action::EnterCar { car } => self.mount(
                who,
                *car,
                &Use {
                    verb: "enter",
                    role: Role::Aboard,
                    fits: |kind| matches!(kind, EntityKind::Car | EntityKind::Truck | EntityKind::Bus),
                    offset: Point3::new(0.2, 0.4, 0.3),
                },
            ),
            Action::StandUp => self.dismount(who, Role::Seated, "stand up", "standing"),
            Action::GetOffScooter => self.put_down(who, Role::Ridden, "get off", "on foot"),
            Action::ExitCar => self.dismount(who, Role::Aboard, "get out", "not in a vehicle"),
            _ => self.find(who).map(|_| ()),
        }
    }

    fn find(&self, id: EntityId) -> Result<EntityRef<'_>, InteractionError> {
        self.entity(id).ok_or(InteractionError::Missing { id })
    }

    /// Checks that `object` is of a fitting kind, free and within reach of `who`.
    fn reachable(&self, who: EntityId, object: EntityId, wanted: &Use) -> Result<(), InteractionError> {
        let (actor, target) = (self.find(who)?, self.find(object)?);
        if !(wanted.fits)(target.kind) {
            return Err(InteractionError::WrongKind { kind: target.kind, verb: wanted.verb });
        }
        let from = actor.planar();
        let to_access = (target.access().xy() - from).norm();
        let distance = target.info.shape.planar_distance(target.pose, &from).min(to_access);
        if distance > ARM_REACH {
            return Err(InteractionError::OutOfReach {
                id: object,
                label: target.label().to_owned(),
                distance,
            });
        }
        Ok(())
    }

    fn taken(&self, object: EntityId, by: EntityId) -> InteractionError {
        let label = self.entity(object).map(|entity| entity.label().to_owned()).unwrap_or_default();
        InteractionError::Taken { id: object, label, by }
    }

    /// The object comes to hang on the actor.
    fn take(&mut self, who: EntityId, item: EntityId, wanted: &Use) -> Result<(), InteractionError> {
        self.reachable(who, item, wanted)?;
        if let Some(bond) = self.find(item)?.attachment {
            let by = bond.parent;
            return Err(self.taken(item, by));
        }
        if self.attached(who, wanted.role).is_some() {
            return Err(InteractionError::Busy {
                who,
                verb: wanted.verb,
                state: "its hands are full, or it rides already",
            });
        }
        self.check_not_carrying(who, item, wanted.verb)?;
        let parent_from_body = Pose::from_parts(wanted.offset.into(), nalgebra::UnitQuaternion::identity());
        self.bond(item, Some(Attachment { parent: who, role: wanted.role, parent_from_body }));
        Ok(())
    }

    /// Nobody lifts the chair he sits on, nor sits down on the chair he carries.
    fn check_not_carrying(
        &self,
        who: EntityId,
        object: EntityId,
        verb: &'static str,
    ) -> Result<(), InteractionError> {
        if self.hangs_on(who, object) || self.hangs_on(object, who) {
            return Err(InteractionError::Busy { who, verb, state: "one of the two carries the other" });
        }
        Ok(())
    }

    /// What hangs on the actor in that role comes to stand on the ground before it.
    fn put_down(
        &mut self,
        who: EntityId,
        role: Role,
        verb: &'static str,
        state: &'static str,
    ) -> Result<(), InteractionError> {
        self.find(who)?;
        let item = self.attached(who, role).ok_or(InteractionError::Busy { who, verb, state })?;
        self.bond(item, None);
        let actor = self.find(who)?;
        let ground = Point3::new(0.6, 0.0, 0.0);
        let pose = pose_facing(actor.pose * ground, yaw_of(actor.pose));
        self.place(item, pose);
        Ok(())
    }

    /// The actor comes to hang on the object.
    fn mount(&mut self, who: EntityId, object: EntityId, wanted: &Use) -> Result<(), InteractionError> {
        self.reachable(who, object, wanted)?;
        if self.find(who)?.attachment.is_some() {
            return Err(InteractionError::Busy { who, verb: wanted.verb, state: "it sits or rides already" });
        }
        if let Some(by) = self.attached(object, wanted.role) {
            return Err(self.taken(object, by));
        }
        self.check_not_carrying(who, object, wanted.verb)?;
        let seat = self.find(object)?;
        let height =
            if wanted.role == Role::Seated { (seat.info.shape.size().z * 0.5).min(0.45) } else { 0.0 };
        let offset = wanted.offset + nalgebra::Vector3::z() * height;
        let parent_from_body = Pose::from_parts(offset.into(), nalgebra::UnitQuaternion::identity());
        self.bond(who, Some(Attachment { parent: object, role: wanted.role, parent_from_body }));
        Ok(())
    }

    /// The actor leaves what it hangs on and stands beside it, at its access point if it has one.
    fn dismount(
        &mut self,
        who: EntityId,
        role: Role,
        verb: &'static str,
        state: &'static str,
    ) -> Result<(), InteractionError> {
        let bond = self.find(who)?.attachment.copied().filter(|bond| bond.role == role);
        let bond = bond.ok_or(InteractionError::Busy { who, verb, state })?;
        let carrier = self.find(bond.parent)?;
        let beside = Point3::new(0.0, carrier.info.shape.size().y * 0.5 + 0.5, 0.0);
        let spot = carrier.info.access.unwrap_or_else(|| carrier.pose * beside);
        let pose = pose_facing(spot, yaw_of(carrier.pose));
        self.bond(who, None);
        self.place(who, pose);
        Ok(())
    }
}
