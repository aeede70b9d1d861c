//! A step of an episode: minds, task, executors and bodies in order, with everything that happens told.

use crate::episode_common::{ConeHunt, Speaker, hunt, script, words};
use simworld_core::action::ActionKind;
use simworld_core::event::EventKind;
use simworld_core::scene::{Role, Scene};
use simworld_core::seed::Seed;

#[test]
fn the_hunt_is_played_to_its_end() {
    let mut episode = hunt(ConeHunt::default(), script(), Seed(3)).expect("the hunt begins");
    let cone_put_up = |event: &simworld_core::event::Event| matches!(&event.kind, EventKind::Task { name, .. } if name == "cone_put_up");
    assert!(episode.events().iter().any(cone_put_up));
    let (mut sat, mut refused, mut done) = (false, 0, 0);
    while !episode.is_over() {
        episode.step().expect("nothing fails");
        let world = episode.simulation().world();
        let me = world.entity(episode.agents()[0]).expect("it lives");
        sat |= me.attachment.is_some_and(|bond| bond.role == Role::Seated);
        refused += count(episode.events(), |kind| matches!(kind, EventKind::IntentRefused { .. }));
        done += count(episode.events(), |kind| matches!(kind, EventKind::PlanDone { .. }));
        assert!(episode.task().steps < 2000, "the hunt goes on for ever");
    }
    assert!(sat, "the sentence was not carried out");
    assert_eq!(refused, 1, "nonsense is refused, once, and the call to the task is not");
    // The first walker's way to the cone was given up for the chair; the task sees a step's events in the next.
    assert_eq!((episode.task().plans_done, done), (2, 2));
    assert_eq!(episode.task().cheers, 1);
    assert!(episode.returns()[0] >= 10.0 && episode.returns()[1] > 0.0, "{:?}", episode.returns());
    assert!(episode.step().is_err(), "an episode that is over is not stepped");
}

fn count(events: &[simworld_core::event::Event], is: impl Fn(&EventKind) -> bool) -> u64 {
    events.iter().filter(|event| is(&event.kind)).count() as u64
}

#[test]
fn an_action_that_changes_nothing_is_told_with_its_reason_and_the_plan_is_done() {
    let mind = Speaker { lines: vec![(2, words("stand up"))], fails_at: None };
    let mut episode = hunt(ConeHunt::default(), mind, Seed(3)).expect("the hunt begins");
    let (mut failed_action, mut failed_plan) = (None, None);
    for _ in 0..6 {
        episode.step().expect("nothing fails");
        for event in episode.events() {
            match &event.kind {
                EventKind::ActionFailed { action: ActionKind::StandUp, reason, .. } => {
                    failed_action = Some(reason.clone());
                }
                EventKind::PlanFailed { reason, .. } => failed_plan = Some(reason.clone()),
                _ => {}
            }
        }
    }
    // Whoever stands already cannot stand up; the action is refused, and the posture is the wanted one.
    assert!(failed_action.expect("the refusal is told").contains("standing"));
    assert_eq!(failed_plan, None, "one who stands has done what was asked");
}

#[test]
fn a_new_order_takes_the_place_of_the_old() {
    let lines = vec![(2, words("go to (0, 50)")), (12, words("stop"))];
    let mut episode =
        hunt(ConeHunt::default(), Speaker { lines, fails_at: None }, Seed(3)).expect("it begins");
    let at = |episode: &simworld_agents::episode::Episode<ConeHunt>| {
        episode.simulation().world().entity(episode.agents()[0]).expect("it lives").planar()
    };
    for _ in 0..13 {
        episode.step().expect("nothing fails");
    }
    let halted = at(&episode);
    assert!(halted.y > 0.5, "it went north: {halted}");
    for _ in 0..10 {
        episode.step().expect("nothing fails");
    }
    assert_eq!(at(&episode), halted);
}
