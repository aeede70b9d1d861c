//! Whom the movements move: the body of whoever is steered, or the vehicle that it drives.

use simworld_core::action::{ActionKind, ActionSet};
use simworld_core::scene::{EntityRef, Role, Scene};

/// The body that moves: one's own, or that of the vehicle in which one sits, for who sits in it drives it.
///
/// # Errors
/// It hangs on something that nobody drives, in words that say what to do about it.
pub(super) fn steered<'a>(scene: &'a dyn Scene, me: &EntityRef<'a>) -> Result<EntityRef<'a>, String> {
    let Some(bond) = me.attachment else { return Ok(*me) };
    // What is itself carried goes where its carrier goes, whoever has the pedals.
    let is_driven = |carrier: &EntityRef<'_>| {
        let able = ActionSet::of_body(carrier.kind);
        bond.role == Role::Aboard && able.contains(ActionKind::Throttle) && carrier.attachment.is_none()
    };
    let vehicle = scene.entity(bond.parent).filter(is_driven);
    vehicle.ok_or_else(|| format!("cannot move off {}: get up or out first", bond.parent))
}

/// What one can be told who moves that body: a driver has the pedals and the wheel of the vehicle and its own head, and a rider
/// takes no steps.
pub(super) fn able(scene: &dyn Scene, me: &EntityRef<'_>, body: &EntityRef<'_>) -> ActionSet {
    let own = ActionSet::of_body(me.kind);
    if me.id == body.id {
        return if rides(scene, me) { own.without(&[ActionKind::Step]) } else { own };
    }
    let head = own.iter().filter(|kind| matches!(kind, ActionKind::LookUp | ActionKind::LookDown));
    let kinds: Vec<ActionKind> = ActionSet::of_body(body.kind).iter().chain(head).collect();
    ActionSet::of(&kinds)
}

/// Whether somebody stands on a scooter, which rolls on when it is told to stop.
pub(super) fn rides(scene: &dyn Scene, me: &EntityRef<'_>) -> bool {
    scene.attached(me.id, Role::Ridden).is_some()
}
