//! What an episode tells of a plan: each step that is taken up, its end, and why it was given up.

use crate::episode_common::{ConeHunt, Speaker, hunt, words};
use simworld_core::action::ActionKind;
use simworld_core::command::Command;
use simworld_core::event::EventKind;
use simworld_core::id::EntityId;
use simworld_core::intent::Intent;
use simworld_core::scene::{EntityKind, Scene};
use simworld_core::seam::{Goal, Plan, PlanStep};
use simworld_core::seed::Seed;

/// What is told of the plans of the first walker, who says this at the first ticks.
fn told(lines: Vec<(u64, Intent)>, steps: usize, meddle_at: Option<usize>) -> Vec<EventKind> {
    let mut episode =
        hunt(ConeHunt::default(), Speaker { lines, fails_at: None }, Seed(3)).expect("the hunt begins");
    let me = episode.agents()[0];
    let mut told = Vec::new();
    for step in 0..steps {
        if episode.is_over() {
            break;
        }
        if meddle_at == Some(step) {
            let chairs = |id: &EntityId| {
                episode.simulation().world().entity(*id).is_some_and(|e| e.kind == EntityKind::Chair)
            };
            let id = (0..9).map(|index| EntityId::new(index, 0)).find(chairs).expect("there is a chair");
            episode.submit(Command::Remove { id });
        }
        episode.step().expect("nothing fails");
        let of_plans = episode.events().iter().filter(|event| match &event.kind {
            EventKind::StepBegun { who, .. }
            | EventKind::Rerouted { who, .. }
            | EventKind::PlanDone { who }
            | EventKind::PlanFailed { who, .. } => *who == me,
            _ => false,
        });
        told.extend(of_plans.map(|event| event.kind.clone()));
    }
    told
}

/// A step in a word.
fn word(step: &PlanStep) -> String {
    match step {
        PlanStep::Navigate { to: Goal::Point(_), .. } => "to a point".to_owned(),
        PlanStep::Navigate { .. } => "to a thing".to_owned(),
        PlanStep::Wait { .. } => "wait".to_owned(),
        PlanStep::Act(action) => action.kind().to_string(),
        other => format!("{other:?}"),
    }
}

fn begun(told: &[EventKind]) -> Vec<String> {
    let step = |kind: &EventKind| match kind {
        EventKind::StepBegun { step, .. } => Some(word(step)),
        _ => None,
    };
    told.iter().filter_map(step).collect()
}

#[test]
fn each_step_is_told_once_when_it_is_taken_up_and_then_the_end() {
    let told = told(
        vec![(2, words("go to the nearest chair and sit down, wait 2 seconds, then stand up"))],
        300,
        None,
    );
    let (sit, stand) = (ActionKind::SitDown.to_string(), ActionKind::StandUp.to_string());
    // The hunt sends everybody to its cone first, which is given up for what was said.
    assert_eq!(begun(&told), ["to a thing", "to a thing", &sit, "wait", &stand]);
    assert!(matches!(told.last(), Some(EventKind::PlanDone { .. })), "{told:?}");
    assert_eq!(told.len(), 6, "nothing else: {told:?}");
}

#[test]
fn rounds_of_a_repetition_are_told_each() {
    let told = told(vec![(2, words("go to (2, 2) and then to (2, 4), three times"))], 400, None);
    assert_eq!(begun(&told)[1..], ["to a point"; 6]);
}

#[test]
fn a_plan_that_is_given_up_is_told_with_its_reason_and_once() {
    let told = told(vec![(2, words("go to the nearest chair and sit down"))], 60, Some(10));
    let reasons: Vec<&String> = told
        .iter()
        .filter_map(|kind| if let EventKind::PlanFailed { reason, .. } = kind { Some(reason) } else { None })
        .collect();
    let [reason] = reasons[..] else { panic!("{told:?}") };
    assert!(reason.contains("gone"), "{reason}");
    assert!(matches!(told.last(), Some(EventKind::PlanFailed { .. })), "nothing comes behind it: {told:?}");
}

#[test]
fn a_plan_that_is_ready_is_carried_out_as_it_is_and_recorded() {
    let plan = Plan {
        steps: vec![
            PlanStep::Wait { seconds: 0.5 },
            PlanStep::Navigate { to: Goal::Entity(EntityId::new(0, 0)), within: 1.0, speed: None },
        ],
    };
    let mind = Speaker { lines: vec![(2, Intent::Plan(plan))], fails_at: None };
    let mut first = hunt(ConeHunt::default(), mind, Seed(3)).expect("the hunt begins");
    for _ in 0..150 {
        first.step().expect("nothing fails");
    }
    let world = first.simulation().world();
    let place = |id| world.entity(id).expect("it is there").planar();
    assert!((place(first.agents()[0]) - place(EntityId::new(0, 0))).norm() < 1.5, "it stands at the chair");
    let mut again = hunt(ConeHunt::default(), Speaker::default(), Seed(3)).expect("the hunt begins");
    let recording = first.recording();
    for _ in 0..150 {
        again.replay_step(&recording).expect("nobody is asked");
    }
    assert_eq!(first.trail(), again.trail());
}

#[test]
fn what_no_executor_can_do_is_refused_and_only_agents_act() {
    let wild = Plan { steps: vec![PlanStep::Wait { seconds: f64::NAN }] };
    let mind = Speaker { lines: vec![(2, Intent::Plan(wild))], fails_at: None };
    let mut episode = hunt(ConeHunt::default(), mind, Seed(3)).expect("the hunt begins");
    let chair = EntityId::new(0, 0);
    let act = Intent::Act(vec![simworld_core::action::Action::Stop]);
    episode.submit(Command::Intend { who: chair, intent: act });
    let mut refused = Vec::new();
    for _ in 0..5 {
        episode.step().expect("nothing fails");
        refused.extend(episode.events().iter().filter_map(|event| match &event.kind {
            EventKind::IntentRefused { who, reason } => Some((*who, reason.clone())),
            _ => None,
        }));
    }
    let of_me = refused.iter().find(|(who, _)| *who == episode.agents()[0]).expect("it is told");
    assert!(of_me.1.contains("cannot carry out"), "{}", of_me.1);
    let of_chair = refused.iter().find(|(who, _)| *who == chair).expect("it is told");
    assert!(of_chair.1.contains("no agent"), "{}", of_chair.1);
}
