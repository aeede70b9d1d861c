//! Plans as lines of text: "go chair, sit chair".

use simworld_core::action::{Action, StepDirection};
use simworld_core::id::EntityId;
use simworld_core::net::Aspect;
use simworld_core::seam::{Condition, Goal, Plan, PlanError, PlanStep, Which};

use super::city::City;

/// The plan in the notation of the tables.
pub(crate) fn show(plan: &Plan, city: &City) -> String {
    steps(&plan.steps, city)
}

/// What kind of answer it is.
pub(crate) fn kind_of(error: &PlanError) -> &'static str {
    match error {
        PlanError::NotUnderstood { .. } => "not understood",
        PlanError::NotFound { .. } => "not found",
        PlanError::Ambiguous { .. } => "ambiguous",
        PlanError::Unable { .. } => "unable",
        PlanError::Call { .. } => "call",
        _ => "other",
    }
}

fn steps(steps: &[PlanStep], city: &City) -> String {
    steps.iter().map(|one| step(one, city)).collect::<Vec<_>>().join(", ")
}

fn goal(goal: &Goal, city: &City) -> String {
    match goal {
        Goal::Entity(id) => city.key(*id),
        Goal::Point(point) => format!("({}, {})", tenths(point.x), tenths(point.y)),
        other => format!("{other:?}"),
    }
}

/// With one decimal; what is a little below zero is zero.
fn tenths(coordinate: f64) -> String {
    let text = format!("{coordinate:.1}");
    if text == "-0.0" { "0.0".to_owned() } else { text }
}

fn step(step: &PlanStep, city: &City) -> String {
    let block = |inner: &[PlanStep]| format!("{{ {} }}", steps(inner, city));
    match step {
        PlanStep::Navigate { to, speed, .. } => {
            let speed = speed.map(|speed| format!(" at {speed}")).unwrap_or_default();
            format!("go {}{speed}", goal(to, city))
        }
        PlanStep::Act(action) => act(action, city),
        PlanStep::Wait { seconds } => format!("wait {seconds}"),
        PlanStep::Follow { whom, .. } => format!("follow {}", city.key(*whom)),
        PlanStep::Face { to } => format!("face {}", goal(to, city)),
        PlanStep::Point { at } => format!("point {}", goal(at, city)),
        PlanStep::If { condition: when, then, otherwise } => {
            let other =
                if otherwise.is_empty() { String::new() } else { format!(" else {}", block(otherwise)) };
            format!("if {} {}{other}", condition(when, city), block(then))
        }
        PlanStep::Repeat { times, steps } => format!("repeat {times} {}", block(steps)),
        PlanStep::Until { condition: when, steps } if steps.is_empty() => {
            format!("wait until {}", condition(when, city))
        }
        PlanStep::Until { condition: when, steps } => {
            format!("until {} {}", condition(when, city), block(steps))
        }
        other => format!("{other:?}"),
    }
}

fn act(action: &Action, city: &City) -> String {
    let key = |id: &EntityId| city.key(*id);
    match action {
        Action::SitDown { seat } => format!("sit {}", key(seat)),
        Action::PickUp { item } => format!("take {}", key(item)),
        Action::CarryHeavy { item } => format!("carry {}", key(item)),
        Action::DropOff => "drop".into(),
        Action::PutDownHeavy => "put".into(),
        Action::RideScooter { scooter } => format!("ride {}", key(scooter)),
        Action::GetOffScooter => "off".into(),
        Action::EnterCar { car } => format!("enter {}", key(car)),
        Action::ExitCar => "exit".into(),
        Action::StandUp => "stand".into(),
        Action::Crouch => "crouch".into(),
        Action::WaveHand { to } => format!("wave {}", key(to)),
        Action::Argue { with } => format!("argue {}", key(with)),
        Action::Give { to } => format!("give {}", key(to)),
        Action::ThrowTo { to } => format!("throw {}", key(to)),
        Action::OpenDoor { door } => format!("open {}", key(door)),
        Action::CloseDoor { door } => format!("close {}", key(door)),
        Action::Buy { goods, .. } => format!("buy {goods}"),
        Action::Converse { with, words } => format!("say {} '{words}'", key(with)),
        Action::Rotate { angle } => format!("turn {:.0}", angle.to_degrees()),
        Action::Step { direction, distance } => {
            let way = match direction {
                StepDirection::Forward => "forward",
                StepDirection::Backward => "backward",
                StepDirection::Left => "left",
                StepDirection::Right => "right",
            };
            format!("step {way} {distance}")
        }
        Action::MoveForward { .. } => "forward".into(),
        Action::ChangeSpeed { speed } => format!("speed {speed}"),
        Action::TakePhoto => "photo".into(),
        Action::LookUp { .. } => "look up".into(),
        Action::LookDown { .. } => "look down".into(),
        other => other.kind().to_string(),
    }
}

fn which(which: &Which, city: &City) -> String {
    match which {
        Which::Entity(id) => city.key(*id),
        Which::Any { kinds, place } => {
            let names: Vec<&str> = kinds.iter().map(|kind| kind.as_str()).collect();
            format!("a {}", place.map_or_else(|| names.join("/"), |place| place.as_str().to_owned()))
        }
        other => format!("{other:?}"),
    }
}

fn condition(when: &Condition, city: &City) -> String {
    match when {
        Condition::Signal { light, shows } => {
            let shows = match shows {
                Aspect::Green => "green",
                Aspect::Yellow => "yellow",
                Aspect::Red => "red",
            };
            format!("{} {shows}", city.key(*light))
        }
        Condition::Sees(what) => format!("see {}", which(what, city)),
        Condition::Near { what, .. } => format!("near {}", which(what, city)),
        Condition::FreeNear { what, .. } => format!("exists {}", which(what, city)),
        Condition::InUse(id) => format!("taken {}", city.key(*id)),
        Condition::Open(id) => format!("open {}", city.key(*id)),
        Condition::Holds(None) => "holding".into(),
        Condition::Holds(Some(id)) => format!("holding {}", city.key(*id)),
        Condition::Seated => "seated".into(),
        Condition::Raining => "raining".into(),
        Condition::Snowing => "snowing".into(),
        Condition::Dark => "dark".into(),
        Condition::Elapsed(seconds) => format!("elapsed {seconds}"),
        Condition::Together { one, other, .. } => format!("{} near {}", city.key(*one), city.key(*other)),
        Condition::Not(inner) => format!("not {}", condition(inner, city)),
        Condition::All(all) => all.iter().map(|one| condition(one, city)).collect::<Vec<_>>().join(" and "),
        Condition::Any(none) if none.is_empty() => "never".into(),
        Condition::Any(any) => any.iter().map(|one| condition(one, city)).collect::<Vec<_>>().join(" or "),
        other => format!("{other:?}"),
    }
}
