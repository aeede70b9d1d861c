//! Single actions and waiting.

use simworld_core::action::Action;
use simworld_core::id::EntityId;
use simworld_core::scene::{Role, Scene};
use simworld_core::seam::Progress;

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
        if matches!(action, Action::Stop) {
            self.state.told_speed = Some(0.0);
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
            | Action::RideScooter { .. }
            | Action::GetOffScooter
            | Action::EnterCar { .. }
            | Action::ExitCar
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
        Action::DropOff => scene.attached(who, Role::Held).is_none(),
        Action::PutDownHeavy => scene.attached(who, Role::Carried).is_none(),
        Action::GetOffScooter => scene.attached(who, Role::Ridden).is_none(),
        Action::SitDown { seat } => i_hang_on(Some(*seat), Role::Seated),
        Action::EnterCar { car } => i_hang_on(Some(*car), Role::Aboard),
        Action::StandUp => !i_hang_on(None, Role::Seated),
        Action::ExitCar => !i_hang_on(None, Role::Aboard),
        _ => true,
    };
    (!done).then(|| format!("{} had no effect: see the event that says why", action.kind()))
}
