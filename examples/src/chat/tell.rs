//! Plans in words, for people who watch.

use simworld_core::action::Action;
use simworld_core::id::EntityId;
use simworld_core::scene::{Scene, World};
use simworld_core::seam::{Goal, PlanStep};

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
        PlanStep::If { condition, .. } => format!("if {condition:?}"),
        PlanStep::Repeat { times, .. } => format!("{times} times:"),
        PlanStep::Until { condition, steps } if steps.is_empty() => format!("wait until {condition:?}"),
        PlanStep::Until { condition, .. } => format!("until {condition:?}:"),
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
