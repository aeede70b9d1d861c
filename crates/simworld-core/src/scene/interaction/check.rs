//! Preconditions of actions on objects, over any scene.

use std::ops::ControlFlow;

use super::{
    ARM_REACH, CARRY, EARSHOT, InteractionError, LOCKED, MOST_THROWN, PICK_UP, RIDE, SELLS, SIT, Use,
    entering,
};
use crate::action::{Action, ActionKind, ActionSet};
use crate::asset::Affordance;
use crate::id::EntityId;
use crate::scene::{EntityKind, EntityRef, Footing, Role, Scene};
use crate::value::Value;

/// Whether `who` can do the action now; actions that only move the body always can, as far as the world is concerned:
/// bodies answer for them.
///
/// # Errors
/// Why not: what no body of that kind does, what is missing, too far, too heavy, taken, locked, or in the way.
pub fn check_action(scene: &dyn Scene, who: EntityId, action: &Action) -> Result<(), InteractionError> {
    able(scene, who, action.kind())?;
    on_its_feet(scene, who, action.kind())?;
    match action {
        Action::PickUp { item } => take(scene, who, *item, &PICK_UP),
        Action::CarryHeavy { item } => take(scene, who, *item, &CARRY),
        Action::RideScooter { scooter } => take(scene, who, *scooter, &RIDE),
        Action::SitDown { seat } => mount(scene, who, *seat, &SIT),
        Action::EnterCar { car } => mount(scene, who, *car, entering(scene, *car)),
        Action::DropOff => has(scene, who, Role::Held, "drop off", "holding nothing").map(drop),
        Action::PutDownHeavy => has(scene, who, Role::Carried, "put down", "carrying nothing").map(drop),
        Action::GetOffScooter => has(scene, who, Role::Ridden, "get off", "on foot").map(drop),
        Action::StandUp if find(scene, who)?.is_crouched() => Ok(()),
        Action::StandUp => hangs_by(scene, who, Role::Seated, "stand up", "standing"),
        Action::Crouch => crouch(scene, who),
        Action::ExitCar => get_out(scene, who),
        Action::OpenDoor { door } => turn_door(scene, who, *door, true),
        Action::CloseDoor { door } => turn_door(scene, who, *door, false),
        Action::Give { to } => give(scene, who, *to),
        Action::Throw { velocity } => {
            load(scene, who)?;
            in_range(action.kind(), "velocity", velocity.norm(), 0.0..=MOST_THROWN, "at most 60 m/s")
        }
        Action::ThrowTo { to } => throw_to(scene, who, *to),
        Action::Grasp { thing, .. } => grasp(scene, who, *thing),
        Action::Buy { goods, from } => buy(scene, who, goods, *from),
        Action::Converse { with, .. } => address(scene, who, *with, "talk to"),
        Action::Argue { with } => address(scene, who, *with, "argue with"),
        Action::WaveHand { to } => find(scene, *to).map(drop),
        Action::LookUp { angle } | Action::LookDown { angle } => {
            in_range(action.kind(), "angle", *angle, f64::MIN..=f64::MAX, "a finite angle")
        }
        Action::Focus { horizontal_fov } => {
            in_range(action.kind(), "horizontal_fov", *horizontal_fov, 0.01..=3.1, "0.01 to 3.1 rad")
        }
        Action::PointDirection { heading } => {
            in_range(action.kind(), "heading", *heading, f64::MIN..=f64::MAX, "a finite angle")
        }
        _ => Ok(()),
    }
}

/// Whether a body of that kind ever does it. Legs, wheels and pedals are the body's own business.
fn able(scene: &dyn Scene, who: EntityId, action: ActionKind) -> Result<(), InteractionError> {
    use ActionKind::{Brake, ChangeSpeed, MoveForward, Rotate, Steer, Step, Stop, Throttle};
    let kind = find(scene, who)?.kind;
    let moves = ActionSet::of(&[MoveForward, Step, Rotate, ChangeSpeed, Steer, Throttle, Brake, Stop]);
    let can = ActionSet::of_body(kind);
    if can.contains(action) || moves.contains(action) {
        return Ok(());
    }
    let names: Vec<String> = can.iter().map(|kind| kind.to_string()).collect();
    let able = if names.is_empty() { "do nothing by itself".to_owned() } else { names.join(", ") };
    Err(InteractionError::Unable { who, kind, action, able })
}

/// Hands, seats, vehicles and doors want somebody who stands; looking, talking and letting go do not.
fn on_its_feet(scene: &dyn Scene, who: EntityId, action: ActionKind) -> Result<(), InteractionError> {
    use ActionKind::{
        Buy, CarryHeavy, CloseDoor, Crouch, EnterCar, Give, Grasp, OpenDoor, PickUp, RideScooter, SitDown,
        StandUp, Throw, ThrowTo,
    };
    let needs_feet = ActionSet::of(&[
        PickUp,
        CarryHeavy,
        RideScooter,
        SitDown,
        StandUp,
        Crouch,
        EnterCar,
        OpenDoor,
        CloseDoor,
        Give,
        Buy,
        Throw,
        ThrowTo,
        Grasp,
    ]);
    let footing = find(scene, who)?.footing();
    if footing == Footing::Upright || !needs_feet.contains(action) {
        return Ok(());
    }
    let state = match footing {
        Footing::Rising => "getting up",
        _ => "lying on the ground",
    };
    Err(InteractionError::Busy { who, verb: "use hands and feet", state })
}

fn in_range(
    action: ActionKind,
    field: &'static str,
    value: f64,
    range: std::ops::RangeInclusive<f64>,
    allowed: &'static str,
) -> Result<(), InteractionError> {
    if range.contains(&value) {
        Ok(())
    } else {
        Err(InteractionError::Argument { action, field, value, allowed })
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

/// The object can be used so and is within reach.
fn reachable(
    scene: &dyn Scene,
    who: EntityId,
    object: EntityId,
    wanted: &Use,
) -> Result<(), InteractionError> {
    let (actor, target) = (find(scene, who)?, find(scene, object)?);
    if !target.affordances(scene).contains(wanted.affordance) {
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
    if let Some(mass) = object.mass(scene).filter(|mass| *mass > wanted.limit) {
        let (label, limit, verb) = (object.label().to_owned(), wanted.limit, wanted.verb);
        return Err(InteractionError::TooHeavy { id: item, label, mass, limit, verb });
    }
    if let Some(state) = hindered(scene, who, wanted.role) {
        return Err(InteractionError::Busy { who, verb: wanted.verb, state });
    }
    not_carrying(scene, who, item, wanted.verb)
}

/// What keeps the actor from taking something in that role: a hand holds one thing, a heavy one takes both arms, and
/// who sits cannot lift or ride.
fn hindered(scene: &dyn Scene, who: EntityId, role: Role) -> Option<&'static str> {
    let has = |role| scene.attached(who, role).is_some();
    let sits = scene.entity(who).is_some_and(|actor| actor.attachment.is_some());
    match role {
        _ if has(Role::Carried) => Some("it carries something with both arms"),
        Role::Held if has(Role::Held) => Some("its hand is full"),
        Role::Carried if has(Role::Held) => Some("one of its hands is full"),
        Role::Carried if has(Role::Ridden) => Some("it rides"),
        Role::Ridden if has(Role::Ridden) => Some("it rides already"),
        Role::Carried | Role::Ridden if sits => Some("it sits: get up first"),
        _ => None,
    }
}

/// The actor could come to hang on the object.
fn mount(scene: &dyn Scene, who: EntityId, object: EntityId, wanted: &Use) -> Result<(), InteractionError> {
    reachable(scene, who, object, wanted)?;
    if find(scene, who)?.attachment.is_some() {
        return Err(InteractionError::Busy { who, verb: wanted.verb, state: "it sits already" });
    }
    if scene.attached(who, Role::Ridden).is_some() {
        return Err(InteractionError::Busy { who, verb: wanted.verb, state: "it rides: get off first" });
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

/// Nobody crouches but on its own feet.
fn crouch(scene: &dyn Scene, who: EntityId) -> Result<(), InteractionError> {
    let actor = find(scene, who)?;
    let state = match actor.attachment.map(|bond| bond.role) {
        Some(Role::Seated) => "sitting",
        Some(_) => "in a vehicle",
        None if scene.attached(who, Role::Ridden).is_some() => "riding",
        None if actor.is_crouched() => "crouching",
        None => return Ok(()),
    };
    Err(InteractionError::Busy { who, verb: "crouch", state })
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

/// A door of its own, something with a lid, or a building that is entered at its access point.
fn turn_door(scene: &dyn Scene, who: EntityId, door: EntityId, open: bool) -> Result<(), InteractionError> {
    let (actor, target) = (find(scene, who)?, find(scene, door)?);
    let opens = target.affordances(scene).contains(Affordance::Open)
        && (target.kind != EntityKind::Building || target.info.access.is_some());
    if !opens {
        let verb = if open { "open" } else { "close" };
        return Err(InteractionError::WrongKind { kind: target.kind, verb });
    }
    within_reach(&actor, &target)?;
    free_hand(scene, who, if open { "open" } else { "close" })?;
    let state = match (open, target.is_open()) {
        (true, true) => "open already",
        (false, false) => "closed already",
        (true, false) if is_set(&target, LOCKED) => "locked",
        (false, true) if stands_in(scene, &target) => "blocked: somebody or something stands in it",
        _ => return Ok(()),
    };
    Err(InteractionError::State { id: door, label: target.label().to_owned(), state })
}

/// A heavy thing takes both arms.
fn free_hand(scene: &dyn Scene, who: EntityId, verb: &'static str) -> Result<(), InteractionError> {
    let state = "carrying something with both arms";
    scene.attached(who, Role::Carried).map_or(Ok(()), |_| Err(InteractionError::Busy { who, verb, state }))
}

/// Whether anything but walls stands where the leaf of a door would be.
fn stands_in(scene: &dyn Scene, door: &EntityRef<'_>) -> bool {
    let leaf = door.obb();
    door.kind == EntityKind::Door
        && scene
            .visit(door.bounds, &mut |other| {
                let is_wall = matches!(other.kind, EntityKind::Building | EntityKind::Door);
                let stands = other.is_solid() && !is_wall && other.attachment.is_none();
                if stands && other.obb().footprints_overlap(&leaf) {
                    return ControlFlow::Break(());
                }
                ControlFlow::Continue(())
            })
            .is_break()
}

fn give(scene: &dyn Scene, who: EntityId, to: EntityId) -> Result<(), InteractionError> {
    has(scene, who, Role::Held, "give", "holding nothing")?;
    let (actor, target) = (find(scene, who)?, find(scene, to)?);
    if to == who || !matches!(target.kind, EntityKind::Person | EntityKind::Robot) {
        return Err(InteractionError::WrongKind { kind: target.kind, verb: "be given something" });
    }
    within_reach(&actor, &target)?;
    free_hand(scene, to, "take it")?;
    if scene.attached(to, Role::Held).is_some() {
        return Err(InteractionError::Busy { who: to, verb: "take it", state: "holding something" });
    }
    Ok(())
}

/// What the actor could throw.
fn load(scene: &dyn Scene, who: EntityId) -> Result<EntityId, InteractionError> {
    has(scene, who, Role::Held, "throw", "holding nothing")
        .or_else(|nothing| scene.attached(who, Role::Carried).ok_or(nothing))
}

/// Nobody throws a thing at itself, nor at what it carries.
fn throw_to(scene: &dyn Scene, who: EntityId, to: EntityId) -> Result<(), InteractionError> {
    let item = load(scene, who)?;
    let target = find(scene, to)?;
    if to == item || hangs_on(scene, to, who) || hangs_on(scene, who, to) {
        return Err(InteractionError::WrongKind { kind: target.kind, verb: "be thrown at by who is on it" });
    }
    Ok(())
}

/// What stands free can be taken hold of; whether it can move is known to the body alone.
fn grasp(scene: &dyn Scene, who: EntityId, thing: EntityId) -> Result<(), InteractionError> {
    let (actor, target) = (find(scene, who)?, find(scene, thing)?);
    if let Some(bond) = target.attachment {
        return Err(taken(&target, bond.parent));
    }
    if thing == who || hangs_on(scene, who, thing) {
        return Err(InteractionError::WrongKind { kind: target.kind, verb: "be held by who is on it" });
    }
    within_reach(&actor, &target)?;
    free_hand(scene, who, "take hold")
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
    free_hand(scene, who, "buy")?;
    if scene.attached(who, Role::Held).is_some() {
        return Err(InteractionError::Busy { who, verb: "buy", state: "its hand is full" });
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
