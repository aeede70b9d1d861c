//! Commands to bodies: driving, walking, sitting, carrying, talking.

use simworld_core::action::{Action, StepDirection};
use simworld_core::clock::Tick;
use simworld_core::command::Command;
use simworld_core::geometry::yaw_of;
use simworld_core::id::EntityId;
use simworld_core::scene::{ARM_REACH, EARSHOT, EntityKind, EntityRef, Role};
use simworld_core::traffic::TrafficOrder;
use simworld_core::value::Value;

use super::answer::{Answered, Failed, Said, success};
use super::command::{Order, Verb};
use super::convert::{metres, planar_in_world, turn_in_world};
use super::desk::{Desk, entity};
use super::errand::way_bytes;
use super::objects;
use crate::remote::engine::Served;

/// The attribute that holds how fast somebody walks when told to, m/s.
const MAX_SPEED: &str = "max_speed";
/// Comfortable walking, m/s.
const WALK: f64 = 1.4;
/// Steering of 1 turns the front wheels so far, rad: 35°, a passenger car's lock.
const LOCK: f64 = 0.611;
/// The gaze goes up and down by this, rad: 15°.
const NOD: f64 = 0.262;
/// Points of a way.
const MOST_POINTS: usize = 10_000;

pub(super) fn answer(desk: &mut Desk, served: &mut Served<'_>, order: &Order<'_>) -> Answered {
    if order.verb == Verb::SetVehicleStates {
        return set_states(desk, served, order.word(1));
    }
    let who = desk.find(served.stage, order.word(0))?;
    match order.verb {
        Verb::SetState => {
            desk.errands.cancel(who);
            set_state(served, who, order.numbers(0))
        }
        Verb::SetMaxSpeed => set_max_speed(served, who, metres(order.numbers::<1>(0)[0])),
        Verb::SetPath => {
            let way = way(order.word(1))?;
            served.room_for(way_bytes(&way))?;
            desk.errands.set_way(who, way);
            served.kept.set_ways(desk.errands.bytes());
            Ok(Said::Done)
        }
        Verb::FollowPath => {
            let body = entity(served, who)?;
            if desk.errands.follow(&body, speed_of(&body)) {
                return Ok(Said::Done);
            }
            Err(Failed::State("it has no path: set one first".to_owned()))
        }
        Verb::TurnRound => turn_round(desk, served, who),
        Verb::CollisionCount => Ok(collisions(desk, who)),
        Verb::EnableController if order.whole(0) == 1 => Ok(Said::Done),
        Verb::EnableController => Err(Failed::Unsupported("a body that does not obey".to_owned())),
        Verb::SitDown
        | Verb::StandUp
        | Verb::PickUp
        | Verb::DropOff
        | Verb::EnterVehicle
        | Verb::ExitVehicle => {
            let done = handle(desk, served, order, who);
            success(done)
        }
        _ => {
            desk.errands.cancel(who);
            let (who, action, seconds) = motion(served, order, who)?;
            tell(served, who, action)?;
            if let Some(seconds) = seconds {
                let clock = served.stage.scene().clock();
                desk.errands.stop_at(who, Tick(clock.tick().0 + clock.ticks_in(seconds)));
            }
            Ok(Said::Done)
        }
    }
}

fn tell(served: &mut Served<'_>, who: EntityId, action: Action) -> Result<(), Failed> {
    served.apply(Command::Actuate { who, action })?;
    Ok(())
}

fn set_state(served: &mut Served<'_>, who: EntityId, [throttle, brake, steering]: [f64; 3]) -> Answered {
    let kind = entity(served, who)?.kind;
    if !kind.is_vehicle() || kind == EntityKind::Scooter {
        return Err(Failed::Unsupported(format!("a state of throttle, brake and steering of a {kind}")));
    }
    tell(served, who, Action::Steer { angle: -steering.clamp(-1.0, 1.0) * LOCK })?;
    let pedal = if brake > 0.0 {
        Action::Brake { level: brake.min(1.0) }
    } else {
        Action::Throttle { level: throttle.clamp(-1.0, 1.0) }
    };
    tell(served, who, pedal)?;
    Ok(Said::Done)
}

/// A vehicle that a client brought is driven round by its wheel; another is the traffic's.
fn turn_round(desk: &mut Desk, served: &mut Served<'_>, who: EntityId) -> Answered {
    let body = entity(served, who)?;
    if !body.kind.is_vehicle() {
        return Err(Failed::Unsupported(format!("a U-turn of a {}", body.kind)));
    }
    if desk.names.is_brought(who) {
        let side = served.stage.scene().roads().map(|roads| roads.driving_side).unwrap_or_default();
        desk.errands.turn_round(&body, side);
        return Ok(Said::Done);
    }
    served.apply(Command::Traffic(TrafficOrder::TurnRound { who }))?;
    Ok(Said::Done)
}

/// States of several vehicles; all that can be set are.
fn set_states(desk: &mut Desk, served: &mut Served<'_>, text: &str) -> Answered {
    let mut wrong = Vec::new();
    for state in text.split(';').filter(|state| !state.is_empty()) {
        let mut parts = state.split(',');
        let name = parts.next().unwrap_or_default();
        let numbers: Vec<f64> =
            parts.filter_map(|part| part.parse().ok()).filter(|number: &f64| number.is_finite()).collect();
        let done = match <[f64; 3]>::try_from(numbers) {
            Ok(numbers) => desk.find(served.stage, name).and_then(|who| {
                desk.errands.cancel(who);
                set_state(served, who, numbers)
            }),
            Err(_) => Err(Failed::Value("give name,throttle,brake,steering".to_owned())),
        };
        if let Err(failed) = done {
            wrong.push(format!("{name}: {failed}"));
        }
    }
    if wrong.is_empty() { Ok(Said::Done) } else { Err(Failed::State(wrong.join("; "))) }
}

fn set_max_speed(served: &mut Served<'_>, who: EntityId, speed: f64) -> Answered {
    if !(0.0..=100.0).contains(&speed) {
        return Err(Failed::Value("a speed is 0 to 10000 cm/s".to_owned()));
    }
    objects::set(served, who, MAX_SPEED, Some(Value::Number(speed)))?;
    if entity(served, who)?.twist.ground_speed() > 0.05 {
        tell(served, who, Action::ChangeSpeed { speed })?;
    }
    Ok(Said::Done)
}

fn speed_of(body: &EntityRef<'_>) -> f64 {
    body.info.attributes.get(MAX_SPEED).and_then(Value::as_f64).unwrap_or(WALK)
}

/// What a body is to do, who it is, and for how long if it is to stop by itself.
fn motion(
    served: &Served<'_>,
    order: &Order<'_>,
    who: EntityId,
) -> Result<(EntityId, Action, Option<f64>), Failed> {
    let body = entity(served, who)?;
    let now = |action| Ok((who, action, None));
    match order.verb {
        Verb::MoveForward => now(Action::MoveForward { speed: speed_of(&body) }),
        Verb::Stop => now(Action::Stop),
        Verb::Turn => {
            let [_, angle, way]: [f64; 3] = order.numbers(0);
            // Some clients say the way by the sign, some by the last number, some by both.
            let right = if way < 0.0 { -angle.abs() } else { angle };
            now(Action::Rotate { angle: turn_in_world(right) })
        }
        Verb::StepForward => {
            let [seconds, way]: [f64; 2] = order.numbers(0);
            go(who, &body, speed_of(&body), seconds, way)
        }
        Verb::MoveSpeed => {
            let [speed, seconds, way]: [f64; 3] = order.numbers(0);
            go(who, &body, metres(speed).abs(), seconds, way)
        }
        Verb::LookUp => now(Action::LookUp { angle: NOD }),
        Verb::LookDown => now(Action::LookDown { angle: NOD }),
        Verb::GetOnScooter => {
            let is_free =
                |other: &EntityRef<'_>| other.kind == EntityKind::Scooter && other.attachment.is_none();
            let scooter = near(served, &body, ARM_REACH, "scooter", &is_free)?;
            now(Action::RideScooter { scooter })
        }
        Verb::GetOffScooter => {
            let rider = body.attachment.filter(|bond| bond.role == Role::Ridden).map(|bond| bond.parent);
            Ok((rider.unwrap_or(who), Action::GetOffScooter, None))
        }
        Verb::Discuss | Verb::Argue => {
            let is_other = |other: &EntityRef<'_>| other.kind == EntityKind::Person && other.id != who;
            let with = near(served, &body, EARSHOT, "person", &is_other)?;
            let words = String::new();
            now(if order.verb == Verb::Argue {
                Action::Argue { with }
            } else {
                Action::Converse { with, words }
            })
        }
        Verb::Wave => {
            let to = near(served, &body, EARSHOT, "dog", &|other| other.kind == EntityKind::Dog)?;
            now(Action::WaveHand { to })
        }
        _ => now(Action::PointDirection { heading: yaw_of(body.pose) }),
    }
}

/// Moves for a time: forward at a speed, otherwise by a step of that length. Whoever has legs of its own takes steps.
fn go(
    who: EntityId,
    body: &EntityRef<'_>,
    speed: f64,
    seconds: f64,
    way: f64,
) -> Result<(EntityId, Action, Option<f64>), Failed> {
    if !(0.0..=3600.0).contains(&seconds) {
        return Err(Failed::Value("a duration is 0 to 3600 s".to_owned()));
    }
    let direction = match way as i64 {
        0 => StepDirection::Forward,
        1 => StepDirection::Backward,
        2 => StepDirection::Left,
        3 => StepDirection::Right,
        _ => return Err(Failed::Value("a direction is 0, 1, 2 or 3".to_owned())),
    };
    if direction == StepDirection::Forward && body.kind != EntityKind::Person {
        return Ok((who, Action::MoveForward { speed }, Some(seconds)));
    }
    Ok((who, Action::Step { direction, distance: speed * seconds }, None))
}

/// The nearest thing that will do, within a distance.
fn near(
    served: &Served<'_>,
    body: &EntityRef<'_>,
    distance: f64,
    what: &str,
    fits: &dyn Fn(&EntityRef<'_>) -> bool,
) -> Result<EntityId, Failed> {
    let found = served.stage.scene().nearest(body.planar(), distance, fits).map(|entity| entity.id);
    found.ok_or_else(|| Failed::State(format!("there is no {what} within {distance} m")))
}

/// Actions on things, of which the client wants to know whether they succeeded.
fn handle(desk: &mut Desk, served: &mut Served<'_>, order: &Order<'_>, who: EntityId) -> Result<(), Failed> {
    desk.errands.cancel(who);
    let other = match order.words.get(1) {
        Some(name) => Some(desk.find(served.stage, name)?),
        None => None,
    };
    let scene = served.stage.scene();
    let body = entity(served, who)?;
    let action = match (order.verb, other) {
        (Verb::PickUp, Some(item)) if entity(served, item)?.kind == EntityKind::Parcel => {
            Action::PickUp { item }
        }
        (Verb::PickUp, Some(item)) => Action::CarryHeavy { item },
        (Verb::EnterVehicle, Some(car)) => Action::EnterCar { car },
        (Verb::ExitVehicle, _) => Action::ExitCar,
        (Verb::DropOff, _) if scene.attached(who, Role::Held).is_none() => Action::PutDownHeavy,
        (Verb::DropOff, _) => Action::DropOff,
        (Verb::StandUp, _) => Action::StandUp,
        _ => {
            let is_free =
                |seat: &EntityRef<'_>| seat.kind.is_seat() && scene.attached(seat.id, Role::Seated).is_none();
            Action::SitDown { seat: near(served, &body, ARM_REACH, "free seat", &is_free)? }
        }
    };
    tell(served, who, action)
}

fn way(text: &str) -> Result<Vec<simworld_core::geometry::Point2>, Failed> {
    let point = |pair: &str| {
        let (x, y) = pair.split_once(',')?;
        let (x, y): (f64, f64) = (x.trim().parse().ok()?, y.trim().parse().ok()?);
        (x.is_finite() && y.is_finite()).then(|| planar_in_world(x, y))
    };
    let points: Option<Vec<_>> = text.split(';').filter(|pair| !pair.is_empty()).map(point).collect();
    match points.filter(|points| (1..=MOST_POINTS).contains(&points.len())) {
        Some(points) => Ok(points),
        None => Err(Failed::Value("a path reads 100,100;200,200, with at most 10000 points".to_owned())),
    }
}

fn collisions(desk: &Desk, who: EntityId) -> Said {
    let touches = desk.tally.of(who);
    let counts = serde_json::json!({
        "HumanCollision": touches.humans,
        "ObjectCollision": touches.objects,
        "BuildingCollision": touches.buildings,
        "VehicleCollision": touches.vehicles,
    });
    Said::Text(counts.to_string())
}
