//! A part that fails ends the episode with its error; the state stays whole.

use crate::episode_common::{ConeHunt, Speaker, agent, field, hunt, script, words};
use simworld_agents::episode::{Agent, Episode, EpisodeError, EpisodeSnapshot};
use simworld_agents::language::GrammarPlanner;
use simworld_core::action::Action;
use simworld_core::command::Command;
use simworld_core::event::EventKind;
use simworld_core::hash::StateHash;
use simworld_core::id::EntityId;
use simworld_core::scene::Scene;
use simworld_core::seam::{Executor, ExecutorError, Plan, Progress};
use simworld_core::seed::Seed;

/// Steps until it fails; returns the error.
fn run_into_fault(episode: &mut Episode<ConeHunt>) -> EpisodeError {
    for _ in 0..100 {
        if let Err(error) = episode.step() {
            return error;
        }
    }
    panic!("nothing failed");
}

/// Nothing but the error is lost: the episode can be looked at and saved.
fn check_halted(episode: &mut Episode<ConeHunt>) -> EpisodeSnapshot {
    assert!(episode.is_over());
    assert!(matches!(episode.step(), Err(EpisodeError::Over)));
    assert!(episode.simulation().world().entity(episode.agents()[0]).is_some());
    episode.save().expect("a failed episode can be saved")
}

/// What was saved can be taken up with healthy parts.
fn check_intact(episode: &mut Episode<ConeHunt>) {
    let snapshot = check_halted(episode);
    let mut mended = hunt(ConeHunt::default(), script(), Seed(2)).expect("the hunt begins");
    mended.restore(snapshot).expect("its snapshot fits");
    mended.step().expect("a healthy part goes on");
}

#[test]
fn a_failing_mind_leaves_the_last_finished_step() {
    let mind = Speaker { fails_at: Some(20), ..script() };
    let mut episode = hunt(ConeHunt::default(), mind, Seed(2)).expect("the hunt begins");
    for _ in 0..20 {
        episode.step().expect("nothing fails yet");
    }
    let before = episode.digest();
    let error = episode.step().expect_err("the mind fails").to_string();
    assert!(error.contains("nothing comes to mind"), "{error}");
    assert_eq!(episode.digest(), before);
    check_intact(&mut episode);
}

#[test]
fn a_failing_task_ends_the_episode() {
    let task = ConeHunt { fails_at: Some(20), ..ConeHunt::default() };
    let mut episode = hunt(task, script(), Seed(2)).expect("the hunt begins");
    let error = run_into_fault(&mut episode);
    assert!(matches!(error, EpisodeError::Task(_)), "{error}");
    assert_eq!(episode.simulation().world().clock().tick().0, 19, "the step was not finished");
    check_intact(&mut episode);
}

#[test]
fn an_impossible_command_of_the_task_ends_the_episode() {
    let task = ConeHunt { errs_at: Some(7), ..ConeHunt::default() };
    let mut episode = hunt(task, script(), Seed(2)).expect("the hunt begins");
    let error = run_into_fault(&mut episode);
    assert!(matches!(error, EpisodeError::TaskCommand(_)), "{error}");
    check_intact(&mut episode);
}

/// Cannot go on after so many steps.
struct Tired(u32);

impl Executor for Tired {
    fn start(&mut self, _: Plan, _: &dyn Scene, _: EntityId) -> Result<(), ExecutorError> {
        Ok(())
    }

    fn advance(
        &mut self,
        _: &dyn Scene,
        _: EntityId,
        _: &mut Vec<Action>,
    ) -> Result<Progress, ExecutorError> {
        self.0 = self.0.checked_sub(1).ok_or_else(|| ExecutorError::Backend("too tired".into()))?;
        Ok(Progress::Running)
    }
}

#[test]
fn a_failing_executor_ends_the_episode() {
    let (simulation, ids) = field();
    let tired = Agent {
        id: ids[0],
        mind: Box::new(Speaker::default()),
        planner: Box::new(GrammarPlanner::default()),
        executor: Box::new(Tired(9)),
    };
    let agents = vec![tired, agent(ids[1], Speaker::default())];
    let mut episode =
        Episode::new(simulation, ConeHunt::default(), agents, Seed(2)).expect("the hunt begins");
    let error = run_into_fault(&mut episode);
    assert!(matches!(error, EpisodeError::Executor(_)), "{error}");
    check_halted(&mut episode);
}

#[test]
fn an_agent_without_a_body_or_with_anothers_is_refused() {
    let nobody = EntityId::new(77, 0);
    for ids in [[nobody, nobody], [EntityId::new(1, 0), EntityId::new(1, 0)]] {
        let (simulation, _) = field();
        let agents = ids.iter().map(|id| agent(*id, Speaker::default())).collect();
        let refused = Episode::new(simulation, ConeHunt::default(), agents, Seed(2)).map(|_| ());
        assert!(matches!(refused, Err(EpisodeError::Agent { .. })), "{refused:?}");
    }
}

#[test]
fn who_is_taken_out_of_the_world_leaves_the_others_playing() {
    let lines = (0..50).map(|tick| (tick, words("go to (9, 9)"))).collect();
    let mut episode =
        hunt(ConeHunt::default(), Speaker { lines, fails_at: None }, Seed(2)).expect("it begins");
    let (first, second) = (episode.agents()[0], episode.agents()[1]);
    for _ in 0..5 {
        episode.step().expect("nothing fails");
    }
    episode.submit(Command::Remove { id: first });
    episode.submit(Command::Intend { who: EntityId::new(77, 0), intent: words("go to (9, 9)") });
    let before = episode.simulation().world().entity(second).expect("it lives").planar();
    let mut refused = 0;
    for _ in 0..20 {
        episode.step().expect("nothing fails");
        let is_refusal = |kind: &EventKind| matches!(kind, EventKind::IntentRefused { .. });
        refused += episode.events().iter().filter(|event| is_refusal(&event.kind)).count();
    }
    let after = episode.simulation().world().entity(second).expect("it lives").planar();
    assert!((after - before).norm() > 1.0, "the second walker stands still");
    assert_eq!(refused, 2, "the stranger's intent, and the one that the removed agent had just said");
}
