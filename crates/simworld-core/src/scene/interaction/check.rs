//! Preconditions of actions on objects, over any scene.

use super::{
    ARM_REACH, CARRY, EARSHOT, ENTER, InteractionError, LOCKED, OPEN, PICK_UP, RIDE, SELLS, SIT, Use,
};
use crate::action::Action;
use crate::id::EntityId;
use crate::scene::{EntityKind, EntityRef, Role, Scene};
use crate::value::Value;

/// Whether `who` can do the action now; actions that only move the body always can.
///
/// # Errors
/// Why not: what is missing, too far, taken, locked, or in the way.
pub fn check_action(scene: &dyn Scene, who: EntityId, action: &Action) -> Result<(), InteractionError> {
    match action {
        Action::PickUp { item } => take(scene, who, *item, &PICK_UP),
        Action::CarryHeavy { item } => take(scene, who, *item, &CARRY),
        Action::RideScooter { scooter } => take(scene, who, *scooter, &RIDE),
        Action::SitDown { seat } => mount(scene, who, *seat, &SIT),
        Action::EnterCar { car } => mount(scene, who, *car, &ENTER),
        Action::DropOff => has(scene, who, Role::Held, "drop off", "holding nothing").map(drop),
        Action::PutDownHeavy => has(scene, who, Role::Carried, "put down", "carrying nothing").map(drop),
        Action::GetOffScooter => has(scene, who, Role::Ridden, "get off", "on foot").map(drop),
        Action::StandUp => hangs_by(scene, who, Role::Seated, "stand up", "standing"),
        Action::ExitCar => get_out(scene, who),
        Action::OpenDoor { door } => turn_door(scene, who, *door, true),
        Action::CloseDoor { door } => turn_door(scene, who, *door, false),
        Action::Give { to } => give(scene, who, *to),
        Action::Buy { goods, from } => buy(scene, who, goods, *from),
        Action::Converse { with, .. } => address(scene, who, *with, "talk to"),
        Action::Argue { with } => address(scene, who, *with, "argue with"),
        Action::WaveHand { to } => find(scene, *to).and_then(|_| find(scene, who)).map(drop),
        _ => find(scene, who).map(drop),
    }
}

fn find(scene: &dyn Scene, id: EntityId) -> Result<EntityRef<'_>, InteractionError> {
    scene.entity(id).ok_or(InteractionError::Missing { id })
}

/// How far the actor is from the object's footprint or access point, m.
fn distance(actor: &EntityRef<'_>, target: &EntityRef<'_>) -> f64 {
    let from = actor.planar();
    let to_access = (target.access().xy() - from).norm();
    target.info.shape.planar_distance(target.pose, &from).min(to_access)
}

fn within_reach(actor: &EntityRef<'_>, target: &EntityRef<'_>) -> Result<(), InteractionError> {
    let distance = distance(actor, target);
    if distance > ARM_REACH {
        let label = target.label().to_owned();
        return Err(InteractionError::OutOfReach { id: target.id, label, distance });
    }
    Ok(())
}

/// The object is of a fitting kind and within reach.
fn reachable(
    scene: &dyn Scene,
    who: EntityId,
    object: EntityId,
    wanted: &Use,
) -> Result<(), InteractionError> {
    let (actor, target) = (find(scene, who)?, find(scene, object)?);
    if !(wanted.fits)(target.kind) {
        return Err(InteractionError::WrongKind { kind: target.kind, verb: wanted.verb });
    }
    within_reach(&actor, &target)
}

fn taken(object: &EntityRef<'_>, by: EntityId) -> InteractionError {
    InteractionError::Taken { id: object.id, label: object.label().to_owned(), by }
}

/// The object could come to hang on the actor.
fn take(scene: &dyn Scene, who: EntityId, item: EntityId, wanted: &Use) -> Result<(), InteractionError> {
    reachable(scene, who, item, wanted)?;
    let object = find(scene, item)?;
    if let Some(bond) = object.attachment {
        return Err(taken(&object, bond.parent));
    }
    if scene.attached(who, wanted.role).is_some() {
        let state = "its hands are full, or it rides already";
        return Err(InteractionError::Busy { who, verb: wanted.verb, state });
    }
    not_carrying(scene, who, item, wanted.verb)
}

/// The actor could come to hang on the object.
fn mount(scene: &dyn Scene, who: EntityId, object: EntityId, wanted: &Use) -> Result<(), InteractionError> {
    reachable(scene, who, object, wanted)?;
    if find(scene, who)?.attachment.is_some() {
        return Err(InteractionError::Busy { who, verb: wanted.verb, state: "it sits or rides already" });
    }
    if let Some(by) = scene.attached(object, wanted.role) {
        return Err(taken(&find(scene, object)?, by));
    }
    not_carrying(scene, who, object, wanted.verb)
}

/// Nobody lifts the chair he sits on, nor sits down on the chair he carries.
fn not_carrying(
    scene: &dyn Scene,
    who: EntityId,
    object: EntityId,
    verb: &'static str,
) -> Result<(), InteractionError> {
    if hangs_on(scene, who, object) || hangs_on(scene, object, who) {
        return Err(InteractionError::Busy { who, verb, state: "one of the two carries the other" });
    }
    Ok(())
}

/// Whether one hangs on the other, however many carriers are between; bonds never form a ring.
fn hangs_on(scene: &dyn Scene, child: EntityId, carrier: EntityId) -> bool {
    let mut above = Some(child);
    while let Some(id) = above {
        if id == carrier {
            return true;
        }
        above = scene.entity(id).and_then(|entity| entity.attachment.map(|bond| bond.parent));
    }
    false
}

/// What hangs on the actor in that role.
pub(super) fn has(
    scene: &dyn Scene,
    who: EntityId,
    role: Role,
    verb: &'static str,
    state: &'static str,
) -> Result<EntityId, InteractionError> {
    find(scene, who)?;
    scene.attached(who, role).ok_or(InteractionError::Busy { who, verb, state })
}

fn hangs_by(
    scene: &dyn Scene,
    who: EntityId,
    role: Role,
    verb: &'static str,
    state: &'static str,
) -> Result<(), InteractionError> {
    let bond = find(scene, who)?.attachment.filter(|bond| bond.role == role);
    bond.map(drop).ok_or(InteractionError::Busy { who, verb, state })
}

/// Nobody gets out of a vehicle that moves.
fn get_out(scene: &dyn Scene, who: EntityId) -> Result<(), InteractionError> {
    /// Faster than this it moves, m/s: a slow walk.
    const MOVING: f64 = 1.0;
    hangs_by(scene, who, Role::Aboard, "get out", "not in a vehicle")?;
    let vehicle = find(scene, who)?.attachment.and_then(|bond| scene.entity(bond.parent));
    match vehicle.filter(|vehicle| vehicle.twist.ground_speed() > MOVING) {
        Some(vehicle) => {
            let (id, label) = (vehicle.id, vehicle.label().to_owned());
            Err(InteractionError::State { id, label, state: "moving: stop it first" })
        }
        None => Ok(()),
    }
}

fn is_set(entity: &EntityRef<'_>, key: &str) -> bool {
    entity.info.attributes.get(key) == Some(&Value::Bool(true))
}

/// A door of its own, or a building that is entered at its access point.
fn turn_door(scene: &dyn Scene, who: EntityId, door: EntityId, open: bool) -> Result<(), InteractionError> {
    let (actor, target) = (find(scene, who)?, find(scene, door)?);
    let is_door = target.kind == EntityKind::Door
        || target.kind == EntityKind::Building && target.info.access.is_some();
    if !is_door {
        let verb = if open { "open" } else { "close" };
        return Err(InteractionError::WrongKind { kind: target.kind, verb });
    }
    within_reach(&actor, &target)?;
    let state = match (open, is_set(&target, OPEN)) {
        (true, true) => "open already",
        (false, false) => "closed already",
        (true, false) if is_set(&target, LOCKED) => "locked",
        _ => return Ok(()),
    };
    Err(InteractionError::State { id: door, label: target.label().to_owned(), state })
}

fn give(scene: &dyn Scene, who: EntityId, to: EntityId) -> Result<(), InteractionError> {
    has(scene, who, Role::Held, "give", "holding nothing")?;
    let (actor, target) = (find(scene, who)?, find(scene, to)?);
    if to == who || !matches!(target.kind, EntityKind::Person | EntityKind::Robot) {
        return Err(InteractionError::WrongKind { kind: target.kind, verb: "be given something" });
    }
    within_reach(&actor, &target)?;
    if scene.attached(to, Role::Held).is_some() {
        return Err(InteractionError::Busy { who: to, verb: "take it", state: "holding something" });
    }
    Ok(())
}

fn buy(scene: &dyn Scene, who: EntityId, goods: &str, from: EntityId) -> Result<(), InteractionError> {
    let (actor, place) = (find(scene, who)?, find(scene, from)?);
    let Some(Value::Text(sells)) = place.info.attributes.get(SELLS) else {
        return Err(InteractionError::WrongKind { kind: place.kind, verb: "buy something" });
    };
    within_reach(&actor, &place)?;
    if !sells.split(',').any(|sold| sold.trim() == goods) {
        let (label, goods, sells) = (place.label().to_owned(), goods.to_owned(), sells.clone());
        return Err(InteractionError::NotSold { id: from, label, goods, sells });
    }
    if scene.attached(who, Role::Held).is_some() {
        return Err(InteractionError::Busy { who, verb: "buy", state: "its hands are full" });
    }
    Ok(())
}

/// Somebody who listens is near enough.
fn address(
    scene: &dyn Scene,
    who: EntityId,
    to: EntityId,
    verb: &'static str,
) -> Result<(), InteractionError> {
    let (actor, target) = (find(scene, who)?, find(scene, to)?);
    if to == who || !matches!(target.kind, EntityKind::Person | EntityKind::Dog | EntityKind::Robot) {
        return Err(InteractionError::WrongKind { kind: target.kind, verb });
    }
    let distance = distance(&actor, &target);
    if distance > EARSHOT {
        return Err(InteractionError::OutOfEarshot { id: to, label: target.label().to_owned(), distance });
    }
    Ok(())
}
