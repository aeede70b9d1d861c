//! Plans in words, for people who watch.

use simworld_core::action::Action;
use simworld_core::id::EntityId;
use simworld_core::scene::{Scene, World};
use simworld_core::seam::{Condition, Goal, PlanStep, Which};

/// The steps, a line each, numbered; blocks are indented.
pub fn steps_in_words(world: &World, steps: &[PlanStep]) -> Vec<String> {
    let mut lines = Vec::new();
    for (index, step) in steps.iter().enumerate() {
        lines.push(format!("{}. {}", index + 1, step_in_words(world, step)));
        let inner: Vec<&[PlanStep]> = match step {
            PlanStep::If { then, otherwise, .. } => vec![then, otherwise],
            PlanStep::Repeat { steps, .. } | PlanStep::Until { steps, .. } => vec![steps],
            _ => Vec::new(),
        };
        for steps in inner {
            lines.extend(steps_in_words(world, steps).into_iter().map(|line| format!("   {line}")));
        }
    }
    lines
}

/// One step in words; of a block its head.
pub fn step_in_words(world: &World, step: &PlanStep) -> String {
    let place = |goal: &Goal| match goal {
        Goal::Point(point) => format!("({:.0}, {:.0})", point.x, point.y),
        Goal::Entity(id) => name(world, *id),
        other => format!("{other:?}"),
    };
    match step {
        PlanStep::Navigate { to, speed, .. } => {
            let pace = speed.map(|speed| format!(" at {speed:.1} m/s")).unwrap_or_default();
            format!("go to {}{pace}", place(to))
        }
        PlanStep::Follow { whom, .. } => format!("follow {}", name(world, *whom)),
        PlanStep::Face { to } => format!("turn to {}", place(to)),
        PlanStep::Point { at } => format!("point at {}", place(at)),
        PlanStep::Wait { seconds } => format!("wait {seconds} s"),
        PlanStep::Act(action) => action_in_words(world, action),
        PlanStep::If { condition, .. } => format!("if {}:", condition_in_words(world, condition)),
        PlanStep::Repeat { times, .. } => format!("{times} times:"),
        PlanStep::Until { condition, steps } if steps.is_empty() => {
            format!("wait until {}", condition_in_words(world, condition))
        }
        PlanStep::Until { condition, .. } => format!("until {}:", condition_in_words(world, condition)),
        other => format!("{other:?}"),
    }
}

/// What is looked at, in words.
fn condition_in_words(world: &World, condition: &Condition) -> String {
    let which = |which: &Which| match which {
        Which::Entity(id) => name(world, *id),
        Which::Any { kinds, place } => {
            let kinds = kinds.iter().map(ToString::to_string);
            let places = place.iter().map(ToString::to_string);
            kinds.chain(places).collect::<Vec<_>>().join(" or ")
        }
        other => format!("{other:?}"),
    };
    let all = |parts: &[Condition], joint: &str| {
        parts.iter().map(|part| condition_in_words(world, part)).collect::<Vec<_>>().join(joint)
    };
    match condition {
        Condition::Signal { light, shows } => {
            format!("{} is {}", name(world, *light), format!("{shows:?}").to_lowercase())
        }
        Condition::Sees(what) => format!("{} is in sight", which(what)),
        Condition::Near { what, within } => format!("{} is within {within} m", which(what)),
        Condition::FreeNear { what, within } => format!("{} is free within {within} m", which(what)),
        Condition::InUse(id) => format!("{} is taken", name(world, *id)),
        Condition::Open(id) => format!("{} is open", name(world, *id)),
        Condition::Holds(Some(id)) => format!("{} is in hand", name(world, *id)),
        Condition::Holds(None) => "anything is in hand".to_owned(),
        Condition::Seated => "seated".to_owned(),
        Condition::Raining => "it rains".to_owned(),
        Condition::Snowing => "it snows".to_owned(),
        Condition::Dark => "it is dark".to_owned(),
        Condition::Elapsed(seconds) => format!("{seconds} s have passed"),
        Condition::Not(inner) => format!("not: {}", condition_in_words(world, inner)),
        Condition::All(parts) => all(parts, " and "),
        Condition::Any(parts) => all(parts, " or "),
        Condition::Together { one, other, within } => {
            format!("{} and {} are within {within} m", name(world, *one), name(world, *other))
        }
        other => format!("{other:?}"),
    }
}

fn action_in_words(world: &World, action: &Action) -> String {
    let object = match action {
        Action::PickUp { item: id }
        | Action::CarryHeavy { item: id }
        | Action::SitDown { seat: id }
        | Action::OpenDoor { door: id }
        | Action::CloseDoor { door: id }
        | Action::EnterCar { car: id }
        | Action::RideScooter { scooter: id }
        | Action::WaveHand { to: id }
        | Action::Argue { with: id }
        | Action::Give { to: id }
        | Action::ThrowTo { to: id }
        | Action::Grasp { thing: id, .. }
        | Action::Converse { with: id, .. }
        | Action::Buy { from: id, .. } => Some(*id),
        _ => None,
    };
    let words = match action {
        Action::Converse { words, .. } => format!("say {words:?} to"),
        Action::Buy { goods, .. } => format!("buy {goods} from"),
        other => other.kind().to_string(),
    };
    object.map_or(words.clone(), |id| format!("{words} {}", name(world, id)))
}

fn name(world: &World, id: EntityId) -> String {
    world.entity(id).map_or_else(|| id.to_string(), |entity| format!("{} {id}", entity.label()))
}
