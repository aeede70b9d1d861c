//! Single actions and waiting.

use simworld_core::action::Action;
use simworld_core::geometry::{Point2, heading, yaw_of};
use simworld_core::id::EntityId;
use simworld_core::ops::wrap_angle;
use simworld_core::scene::{EntityRef, Role, Scene, check_action};
use simworld_core::seam::{Goal, Progress};

use super::{RuleExecutor, Stage};

impl RuleExecutor {
    /// Tells the action in one step and looks for its effect in the next.
    pub(super) fn act(
        &mut self,
        scene: &dyn Scene,
        who: EntityId,
        action: Action,
        out: &mut Vec<Action>,
    ) -> Progress {
        if self.state.stage == Stage::Acted {
            return match missing_effect(scene, who, &action) {
                None => self.next_step(),
                Some(reason) => self.fail(reason, out),
            };
        }
        // What is so already is told all the same: the body's refusal is an event, and no failure of the plan.
        let is_so = is_visible(&action) && missing_effect(scene, who, &action).is_none();
        if let Err(reason) = check_action(scene, who, &action)
            && !is_so
        {
            return self.fail(reason.to_string(), out);
        }
        match &action {
            Action::Stop => self.state.told_speed = Some(0.0),
            Action::MoveForward { speed } => self.state.told_speed = Some(*speed),
            _ => {}
        }
        let visible = is_visible(&action);
        out.push(action);
        if visible {
            self.state.stage = Stage::Acted;
            Progress::Running
        } else {
            self.next_step()
        }
    }

    /// Turns towards a goal until it is before the agent, or the body will not turn any further.
    pub(super) fn face(
        &mut self,
        scene: &dyn Scene,
        me: &EntityRef<'_>,
        to: Goal,
        out: &mut Vec<Action>,
    ) -> Progress {
        /// Heading errors below this are left alone, radians.
        const FACED: f64 = 0.05;
        let Some(place) = place_of(scene, to) else { return self.fail(format!("{to:?} is gone"), out) };
        self.tell_speed(0.0, out);
        let way = place - me.planar();
        let error = if way.norm() < 1e-6 { 0.0 } else { wrap_angle(heading(&way) - yaw_of(me.pose)) };
        let left = match self.state.stage {
            Stage::Waiting(left) => left,
            _ => scene.clock().ticks_in(self.config.patience),
        };
        if error.abs() <= FACED || left == 0 {
            return self.next_step();
        }
        self.state.stage = Stage::Waiting(left - 1);
        out.push(Action::Rotate { angle: error });
        Progress::Running
    }

    pub(super) fn point(
        &mut self,
        scene: &dyn Scene,
        me: &EntityRef<'_>,
        at: Goal,
        out: &mut Vec<Action>,
    ) -> Progress {
        let Some(place) = place_of(scene, at) else { return self.fail(format!("{at:?} is gone"), out) };
        let way = place - me.planar();
        let towards = if way.norm() < 1e-6 { yaw_of(me.pose) } else { heading(&way) };
        out.push(Action::PointDirection { heading: towards });
        self.next_step()
    }

    pub(super) fn wait(&mut self, scene: &dyn Scene, seconds: f64, out: &mut Vec<Action>) -> Progress {
        self.tell_speed(0.0, out);
        let left = match self.state.stage {
            Stage::Waiting(left) => left,
            _ => scene.clock().ticks_in(seconds.clamp(0.0, 1e9)),
        };
        if left <= 1 {
            return self.next_step();
        }
        self.state.stage = Stage::Waiting(left - 1);
        Progress::Running
    }
}

/// Whether the world shows that the action was done.
fn is_visible(action: &Action) -> bool {
    matches!(
        action,
        Action::PickUp { .. }
            | Action::CarryHeavy { .. }
            | Action::DropOff
            | Action::PutDownHeavy
            | Action::SitDown { .. }
            | Action::StandUp
            | Action::Crouch
            | Action::RideScooter { .. }
            | Action::GetOffScooter
            | Action::EnterCar { .. }
            | Action::ExitCar
            | Action::OpenDoor { .. }
            | Action::CloseDoor { .. }
            | Action::Give { .. }
            | Action::Throw { .. }
            | Action::ThrowTo { .. }
            | Action::Buy { .. }
    )
}

/// Why the world does not show the effect; `None` if it does.
fn missing_effect(scene: &dyn Scene, who: EntityId, action: &Action) -> Option<String> {
    let hangs_on_me = |item: EntityId, role: Role| scene.attached(who, role) == Some(item);
    let i_hang_on = |object: Option<EntityId>, role: Role| {
        let bond = scene.entity(who).and_then(|me| me.attachment.copied()).filter(|bond| bond.role == role);
        bond.is_some_and(|bond| object.is_none_or(|object| bond.parent == object))
    };
    let done = match action {
        Action::PickUp { item } => hangs_on_me(*item, Role::Held),
        Action::CarryHeavy { item } => hangs_on_me(*item, Role::Carried),
        Action::RideScooter { scooter } => hangs_on_me(*scooter, Role::Ridden),
        Action::DropOff | Action::Give { .. } => scene.attached(who, Role::Held).is_none(),
        Action::PutDownHeavy => scene.attached(who, Role::Carried).is_none(),
        Action::Throw { .. } | Action::ThrowTo { .. } => {
            scene.attached(who, Role::Held).is_none() && scene.attached(who, Role::Carried).is_none()
        }
        Action::GetOffScooter => scene.attached(who, Role::Ridden).is_none(),
        Action::SitDown { seat } => i_hang_on(Some(*seat), Role::Seated),
        Action::EnterCar { car } => i_hang_on(Some(*car), Role::Aboard),
        Action::StandUp => !i_hang_on(None, Role::Seated),
        Action::Crouch => scene.entity(who).is_some_and(|me| me.is_crouched()),
        Action::ExitCar => !i_hang_on(None, Role::Aboard),
        Action::Buy { .. } => scene.attached(who, Role::Held).is_some(),
        Action::OpenDoor { door } => is_open(scene, *door),
        Action::CloseDoor { door } => !is_open(scene, *door),
        _ => true,
    };
    (!done).then(|| format!("{} had no effect: see the event that says why", action.kind()))
}

fn is_open(scene: &dyn Scene, door: EntityId) -> bool {
    scene.entity(door).is_some_and(|door| door.is_open())
}

/// Where a goal is by now, in the middle of a thing; `None` if it is gone.
fn place_of(scene: &dyn Scene, goal: Goal) -> Option<Point2> {
    match goal {
        Goal::Point(point) => Some(point.xy()),
        Goal::Entity(id) => scene.entity(id).map(|entity| entity.planar()),
        _ => None,
    }
}
