//! What actions on objects change in the world.

use std::f64::consts::FRAC_PI_2;

use super::{
    CARRY, FIELD_OF_VIEW, GAZE, InteractionError, OPEN, PICK_UP, RIDE, SIT, Use, check::has, check_action,
    entering, room,
};
use crate::action::{Action, ActionKind};
use crate::event::EventKind;
use crate::geometry::{Point3, Pose, Vector3, pose_facing, yaw_of};
use crate::id::EntityId;
use crate::ops::wrap_angle;
use crate::scene::{Attachment, CROUCHED, EntityDesc, EntityKind, EntityRef, Role, Scene, Shape, World};
use crate::value::Value;

impl World {
    /// Carries out an action on an object. Actions that only move the body are none of the world's business
    /// and succeed without effect.
    pub(in crate::scene) fn interact(
        &mut self,
        who: EntityId,
        action: &Action,
    ) -> Result<(), InteractionError> {
        check_action(self, who, action)?;
        match action {
            Action::PickUp { item } => self.hang(*item, who, &PICK_UP, PICK_UP.offset),
            Action::CarryHeavy { item } => self.hang(*item, who, &CARRY, CARRY.offset),
            Action::RideScooter { scooter } => {
                self.straighten(who);
                self.hang(*scooter, who, &RIDE, RIDE.offset);
            }
            Action::Crouch => self.note(who, CROUCHED, Value::Bool(true)),
            Action::SitDown { seat } => {
                self.straighten(who);
                let height =
                    self.entity(*seat).map_or(0.0, |seat| (seat.info.shape.size().z * 0.5).min(0.45));
                self.hang(who, *seat, &SIT, SIT.offset + Vector3::z() * height);
            }
            Action::EnterCar { car } => {
                let seat = entering(self, *car);
                self.straighten(who);
                self.hang(who, *car, seat, seat.offset);
            }
            Action::DropOff => self.put_down(has(self, who, Role::Held, "", "")?, who),
            Action::PutDownHeavy => self.put_down(has(self, who, Role::Carried, "", "")?, who),
            Action::GetOffScooter => self.put_down(has(self, who, Role::Ridden, "", "")?, who),
            Action::StandUp | Action::ExitCar => {
                self.straighten(who);
                self.dismount(who);
            }
            Action::OpenDoor { door } => self.set_door(*door, true),
            Action::CloseDoor { door } => self.set_door(*door, false),
            Action::Give { to } => {
                let item = has(self, who, Role::Held, "", "")?;
                self.hang(item, *to, &PICK_UP, PICK_UP.offset);
            }
            Action::Buy { goods, from } => self.hand_over(who, goods, *from),
            Action::Converse { with, words } => {
                self.emit(EventKind::Said { who, to: *with, words: words.clone() });
            }
            Action::Argue { with: to } | Action::WaveHand { to } => {
                self.gesture(who, action.kind(), Some(*to), None);
            }
            Action::PointDirection { heading } => {
                self.gesture(who, action.kind(), None, Some(wrap_angle(*heading)));
            }
            Action::TakePhoto => self.gesture(who, action.kind(), None, None),
            Action::LookUp { angle } => self.look(who, *angle),
            Action::LookDown { angle } => self.look(who, -*angle),
            Action::Focus { horizontal_fov } => self.note(who, FIELD_OF_VIEW, Value::Number(*horizontal_fov)),
            _ => {}
        }
        Ok(())
    }

    fn hang(&mut self, child: EntityId, parent: EntityId, wanted: &Use, offset: Point3) {
        let parent_from_body = Pose::from_parts(offset.into(), nalgebra::UnitQuaternion::identity());
        self.bond(child, Some(Attachment { parent, role: wanted.role, parent_from_body }));
    }

    /// What hangs on the actor comes to stand on the ground before it, or else where there is room beside it.
    fn put_down(&mut self, item: EntityId, who: EntityId) {
        self.bond(item, None);
        let (Some(actor), Some(thing)) = (self.entity(who), self.entity(item)) else { return };
        let half = |entity: &EntityRef<'_>| entity.info.shape.size().x * 0.5;
        let before = Point3::new((half(&actor) + half(&thing) + 0.1).max(0.6), 0.0, 0.0);
        let spot = room::beside(self, item, &actor, actor.pose * before);
        let pose = pose_facing(spot, yaw_of(actor.pose));
        self.place(item, pose);
    }

    /// The actor leaves what it hangs on and stands at its access point, before a seat or at the driver's door of a
    /// vehicle; or else where there is room beside it.
    fn dismount(&mut self, who: EntityId) {
        let bond = self.entity(who).and_then(|actor| actor.attachment.copied());
        let Some(carrier) = bond.and_then(|bond| self.entity(bond.parent)) else { return };
        let size = carrier.info.shape.size();
        let beside = if bond.is_some_and(|bond| bond.role == Role::Seated) {
            Point3::new(size.x * 0.5 + 0.5, 0.0, 0.0)
        } else {
            Point3::new(0.0, size.y * 0.5 + 0.5, 0.0)
        };
        let wished = carrier.access_point().unwrap_or_else(|| carrier.pose * beside);
        let pose = pose_facing(room::beside(self, who, &carrier, wished), yaw_of(carrier.pose));
        self.bond(who, None);
        self.place(who, pose);
    }

    /// Whoever sits, rides or stands no longer crouches.
    fn straighten(&mut self, who: EntityId) {
        if self.entity(who).is_some_and(|actor| actor.is_crouched()) {
            let _ = self.set_attribute(who, CROUCHED, None);
        }
    }

    fn set_door(&mut self, door: EntityId, open: bool) {
        self.note(door, OPEN, Value::Bool(open));
    }

    fn look(&mut self, who: EntityId, up: f64) {
        let gaze = self.entity(who).map_or(0.0, |actor| actor.gaze());
        self.note(who, GAZE, Value::Number((gaze + up).clamp(-FRAC_PI_2, FRAC_PI_2)));
    }

    /// Sets an attribute of somebody or something that was found a moment ago.
    fn note(&mut self, id: EntityId, key: &str, value: Value) {
        let _ = self.set_attribute(id, key, Some(value));
    }

    /// What was bought comes into the buyer's hand, in a bag of its own.
    fn hand_over(&mut self, who: EntityId, goods: &str, from: EntityId) {
        let Some(pose) = self.entity(who).map(|buyer| *buyer.pose) else { return };
        let bag = EntityDesc::new(EntityKind::Parcel, pose, Shape::cuboid(0.2, 0.15, 0.2)).named(goods);
        let Ok(item) = self.spawn(bag) else { return };
        self.hang(item, who, &PICK_UP, PICK_UP.offset);
        self.emit(EventKind::Bought { who, from, item });
    }

    fn gesture(&mut self, who: EntityId, gesture: ActionKind, to: Option<EntityId>, heading: Option<f64>) {
        self.emit(EventKind::Gesture { who, gesture, to, heading });
    }
}
