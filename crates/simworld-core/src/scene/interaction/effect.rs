//! What actions on objects change in the world.

use super::{CARRY, ENTER, InteractionError, OPEN, PICK_UP, RIDE, SIT, Use, check::has, check_action};
use crate::action::{Action, ActionKind};
use crate::event::EventKind;
use crate::geometry::{Point3, Pose, Vector3, pose_facing, yaw_of};
use crate::id::EntityId;
use crate::scene::{Attachment, EntityDesc, EntityKind, Role, Scene, Shape, World};
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
            Action::RideScooter { scooter } => self.hang(*scooter, who, &RIDE, RIDE.offset),
            Action::SitDown { seat } => {
                let height =
                    self.entity(*seat).map_or(0.0, |seat| (seat.info.shape.size().z * 0.5).min(0.45));
                self.hang(who, *seat, &SIT, SIT.offset + Vector3::z() * height);
            }
            Action::EnterCar { car } => self.hang(who, *car, &ENTER, ENTER.offset),
            Action::DropOff => self.put_down(has(self, who, Role::Held, "", "")?, who),
            Action::PutDownHeavy => self.put_down(has(self, who, Role::Carried, "", "")?, who),
            Action::GetOffScooter => self.put_down(has(self, who, Role::Ridden, "", "")?, who),
            Action::StandUp | Action::ExitCar => self.dismount(who),
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
            Action::Argue { with } => self.gesture(who, action.kind(), Some(*with)),
            Action::WaveHand { to } => self.gesture(who, action.kind(), Some(*to)),
            Action::PointDirection { .. } | Action::TakePhoto => self.gesture(who, action.kind(), None),
            _ => {}
        }
        Ok(())
    }

    fn hang(&mut self, child: EntityId, parent: EntityId, wanted: &Use, offset: Point3) {
        let parent_from_body = Pose::from_parts(offset.into(), nalgebra::UnitQuaternion::identity());
        self.bond(child, Some(Attachment { parent, role: wanted.role, parent_from_body }));
    }

    /// What hangs on the actor comes to stand on the ground before it.
    fn put_down(&mut self, item: EntityId, who: EntityId) {
        self.bond(item, None);
        let Some(actor) = self.entity(who) else { return };
        let ground = Point3::new(0.6, 0.0, 0.0);
        let pose = pose_facing(actor.pose * ground, yaw_of(actor.pose));
        self.place(item, pose);
    }

    /// The actor leaves what it hangs on and stands beside it, at its access point if it has one.
    fn dismount(&mut self, who: EntityId) {
        let bond = self.entity(who).and_then(|actor| actor.attachment.copied());
        let Some(carrier) = bond.and_then(|bond| self.entity(bond.parent)) else { return };
        let beside = Point3::new(0.0, carrier.info.shape.size().y * 0.5 + 0.5, 0.0);
        let spot = carrier.info.access.unwrap_or_else(|| carrier.pose * beside);
        let pose = pose_facing(spot, yaw_of(carrier.pose));
        self.bond(who, None);
        self.place(who, pose);
    }

    fn set_door(&mut self, door: EntityId, open: bool) {
        // The door was found a moment ago.
        let _ = self.set_attribute(door, OPEN, Some(Value::Bool(open)));
    }

    /// What was bought comes into the buyer's hand, in a bag of its own.
    fn hand_over(&mut self, who: EntityId, goods: &str, from: EntityId) {
        let Some(pose) = self.entity(who).map(|buyer| *buyer.pose) else { return };
        let bag = EntityDesc::new(EntityKind::Parcel, pose, Shape::cuboid(0.2, 0.15, 0.2)).named(goods);
        let Ok(item) = self.spawn(bag) else { return };
        self.hang(item, who, &PICK_UP, PICK_UP.offset);
        self.emit(EventKind::Bought { who, from, item });
    }

    fn gesture(&mut self, who: EntityId, gesture: ActionKind, to: Option<EntityId>) {
        self.emit(EventKind::Gesture { who, gesture, to });
    }
}
