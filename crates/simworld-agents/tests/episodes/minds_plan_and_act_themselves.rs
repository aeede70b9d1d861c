//! Minds with a planner or an executor of their own: the world never waits for either, and a replay asks neither.

use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Arc, Mutex};
use std::thread::sleep;
use std::time::Duration;

use crate::episode_common::{ConeHunt, Speaker, field, hunt, words};
use crate::minds_at_their_own_pace::{FIRST, begin, fast, replay};
use simworld_agents::asynchronous::{AsynchronousEpisode, FreeMind};
use simworld_agents::episode::{Agent, Episode};
use simworld_agents::executor::RuleExecutor;
use simworld_agents::language::GrammarPlanner;
use simworld_agents::mind::{ActingMind, Mind, MindError, PlanningMind, Silent};
use simworld_core::action::Action;
use simworld_core::command::Command;
use simworld_core::event::{Event, EventKind};
use simworld_core::geometry::Point2;
use simworld_core::id::EntityId;
use simworld_core::intent::Intent;
use simworld_core::scene::{Role, Scene};
use simworld_core::seam::{Executor, ExecutorError, Plan, PlanError, Planner, Progress};
use simworld_core::seed::Seed;

const SENTENCE: &str = "go to the nearest chair and sit down, wait 1 second, then stand up";

/// Says one thing once everybody is sent to the cone, and keeps what it is told.
#[derive(Clone)]
struct Once {
    wants: Option<Intent>,
    told: Arc<Mutex<Vec<EventKind>>>,
}

impl Once {
    fn wanting(intent: Intent) -> (Self, Arc<Mutex<Vec<EventKind>>>) {
        let told = Arc::default();
        (Self { wants: Some(intent), told: Arc::clone(&told) }, told)
    }
}

impl<T: ?Sized> Mind<T> for Once {
    fn decide(
        &mut self,
        _: &T,
        scene: &dyn Scene,
        _: EntityId,
        out: &mut Vec<Intent>,
    ) -> Result<(), MindError> {
        if scene.clock().tick().0 >= 2 {
            out.extend(self.wants.take());
        }
        Ok(())
    }

    fn notice(&mut self, events: &[Event], _: EntityId) {
        self.told.lock().unwrap().extend(events.iter().map(|event| event.kind.clone()));
    }
}

/// Must not be asked.
struct Nobody;

impl Planner for Nobody {
    fn plan(&mut self, intent: &Intent, _: &dyn Scene, _: EntityId) -> Result<Plan, PlanError> {
        Err(PlanError::Backend(format!("the planner in the world was asked for {intent}")))
    }
}

impl Executor for Nobody {
    fn start(&mut self, _: Plan, _: &dyn Scene, _: EntityId) -> Result<(), ExecutorError> {
        Err(ExecutorError::Backend("the executor in the world was asked".to_owned()))
    }

    fn advance(
        &mut self,
        _: &dyn Scene,
        _: EntityId,
        _: &mut Vec<Action>,
    ) -> Result<Progress, ExecutorError> {
        Ok(Progress::Idle)
    }

    fn cancel(&mut self, _: &mut Vec<Action>) {}
}

/// One walker alone.
fn room(mind: impl Mind<ConeHunt> + 'static, executor: Box<dyn Executor>) -> Episode<ConeHunt> {
    let (simulation, ids) = field();
    let agent = Agent { id: ids[0], mind: Box::new(mind), planner: Box::new(Nobody), executor };
    Episode::new(simulation, ConeHunt::default(), vec![agent], Seed(3)).unwrap()
}

/// Where the agent is after each step, and whether it ever sat.
fn way(episode: &mut Episode<ConeHunt>, steps: usize) -> (Vec<Point2>, bool) {
    let (mut way, mut sat) = (Vec::new(), false);
    for _ in 0..steps {
        if episode.is_over() {
            break;
        }
        episode.step().unwrap();
        let me = episode.simulation().world().entity(episode.agents()[0]).unwrap();
        sat |= me.attachment.is_some_and(|bond| bond.role == Role::Seated);
        way.push(me.planar());
    }
    (way, sat)
}

fn intents(episode: &Episode<ConeHunt>) -> Vec<Intent> {
    let recording = episode.recording();
    let intent = |command: &simworld_core::record::Stamped| match &command.command {
        Command::Intend { intent, .. } => Some(intent.clone()),
        _ => None,
    };
    recording.commands.iter().filter_map(intent).collect()
}

#[test]
fn a_sentence_goes_out_as_its_plan_and_what_cannot_be_planned_is_told_to_the_mind() {
    let (mind, told) = Once::wanting(words(SENTENCE));
    let mut episode =
        room(PlanningMind::new(mind, GrammarPlanner::default()), Box::new(RuleExecutor::straight()));
    let (_, sat) = way(&mut episode, 200);
    assert!(sat, "the plan was carried out: {:?}", told.lock().unwrap());
    let [Intent::Plan(plan)] = &intents(&episode)[..] else { panic!("{:?}", intents(&episode)) };
    assert_eq!(plan.steps.len(), 4);

    let (mind, told) = Once::wanting(words("go to the nearest zoo"));
    let mut episode =
        room(PlanningMind::new(mind, GrammarPlanner::default()), Box::new(RuleExecutor::straight()));
    way(&mut episode, 5);
    let told = told.lock().unwrap();
    let refusals: Vec<&String> = told
        .iter()
        .filter_map(
            |kind| if let EventKind::IntentRefused { reason, .. } = kind { Some(reason) } else { None },
        )
        .collect();
    assert!(matches!(refusals[..], [reason] if reason.contains("zoo")), "{told:?}");
    assert!(intents(&episode).is_empty());
}

#[test]
fn calls_of_the_task_go_out_as_they_are() {
    let (mind, _) = Once::wanting(Intent::call("cheer"));
    let mind = PlanningMind::new(mind, Nobody).leaving(&["cheer"]);
    let mut episode = hunt(ConeHunt::default(), mind, Seed(3)).unwrap();
    way(&mut episode, 5);
    assert_eq!(episode.task().cheers, 1);
}

#[test]
fn who_acts_from_within_does_the_same_as_the_executor_in_the_world() {
    let planned = || {
        let (mind, told) = Once::wanting(words(SENTENCE));
        (PlanningMind::new(mind, GrammarPlanner::default()), told)
    };
    let (in_world, _) = planned();
    let (within, told) = planned();
    let (expected, sat) = way(&mut room(in_world, Box::new(RuleExecutor::straight())), 200);
    let mut episode = room(ActingMind::new(within, RuleExecutor::straight()), Box::new(Nobody));
    let (found, also_sat) = way(&mut episode, 200);
    assert!(sat && also_sat, "{:?}", told.lock().unwrap());
    let apart = expected.iter().zip(&found).map(|(a, b)| (a - b).norm()).fold(0.0, f64::max);
    assert!(apart < 0.5, "a step or so apart at the most, {apart} m");
    assert!(intents(&episode).iter().all(|intent| matches!(intent, Intent::Act(_))));
    let told = told.lock().unwrap();
    let begun = told.iter().filter(|kind| matches!(kind, EventKind::StepBegun { .. })).count();
    let done = told.iter().filter(|kind| matches!(kind, EventKind::PlanDone { .. })).count();
    assert_eq!((begun, done), (4, 1), "{told:?}");
}

/// Asks somebody outside, and takes the time that it takes.
struct Slow<I> {
    inner: I,
    asked: Sender<()>,
    may_go: Receiver<()>,
}

fn slow<I>(inner: I) -> (Slow<I>, Receiver<()>, Sender<()>) {
    let ((asked, is_asked), (go, may_go)) = (channel(), channel());
    (Slow { inner, asked, may_go }, is_asked, go)
}

impl<I> Slow<I> {
    fn ask(&self) {
        let _ = self.asked.send(());
        let _ = self.may_go.recv();
    }
}

impl<I: Planner> Planner for Slow<I> {
    fn plan(&mut self, intent: &Intent, scene: &dyn Scene, who: EntityId) -> Result<Plan, PlanError> {
        self.ask();
        self.inner.plan(intent, scene, who)
    }
}

impl<I: Executor> Executor for Slow<I> {
    fn start(&mut self, plan: Plan, scene: &dyn Scene, who: EntityId) -> Result<(), ExecutorError> {
        self.inner.start(plan, scene, who)
    }

    fn advance(
        &mut self,
        scene: &dyn Scene,
        who: EntityId,
        out: &mut Vec<Action>,
    ) -> Result<Progress, ExecutorError> {
        self.ask();
        self.inner.advance(scene, who, out)
    }
}

/// Steps until the slow one is asked, then a hundred times while it thinks; and lets it go.
fn outlast(
    run: &mut AsynchronousEpisode<ConeHunt, ConeHunt>,
    is_asked: &Receiver<()>,
    go: &Sender<()>,
) -> u64 {
    while is_asked.try_recv().is_err() {
        run.step().unwrap();
        sleep(Duration::from_millis(1));
    }
    let asked = run.episode().simulation().world().clock().tick().0;
    for _ in 0..100 {
        run.step().unwrap(); // would stand still for good here
    }
    go.send(()).unwrap();
    asked
}

/// Steps until what the mind wants has come, and gives the tick that used it.
fn used(run: &mut AsynchronousEpisode<ConeHunt, ConeHunt>) -> u64 {
    loop {
        run.step().unwrap();
        if let Some(receipt) = run.take_receipts().pop() {
            assert!(
                matches!(receipt.fate, simworld_agents::asynchronous::Fate::Applied { .. }),
                "{receipt:?}"
            );
            return run.episode().simulation().world().clock().tick().0;
        }
        sleep(Duration::from_millis(1));
    }
}

#[test]
fn the_world_does_not_wait_for_a_planner_nor_for_an_executor() {
    let (planner, is_asked, go) = slow(GrammarPlanner::default());
    let mind: FreeMind<ConeHunt> =
        Box::new(PlanningMind::new(Once::wanting(words("go to (5, 5)")).0, planner));
    let mut run = begin(1, fast(), vec![(FIRST, mind)]);
    let asked = outlast(&mut run, &is_asked, &go);
    assert!(used(&mut run) >= asked + 100);
    drop(go);
    let (episode, _) = run.finish();
    replay(1, &episode);

    let (executor, is_asked, go) = slow(RuleExecutor::straight());
    let wants = Intent::Plan(Plan::navigate(simworld_core::seam::Goal::Entity(EntityId::new(0, 0)), 1.0));
    let mind: FreeMind<ConeHunt> = Box::new(ActingMind::new(Once::wanting(wants).0, executor));
    let mut run = begin(1, fast(), vec![(FIRST, mind)]);
    let asked = outlast(&mut run, &is_asked, &go);
    assert!(used(&mut run) >= asked + 100);
    drop(go);
    let (episode, _) = run.finish();
    replay(1, &episode);
}

#[test]
fn what_a_mind_has_under_way_is_saved_with_it() {
    let acting = || {
        let mind = PlanningMind::new(Once::wanting(words(SENTENCE)).0, GrammarPlanner::default());
        ActingMind::new(mind, RuleExecutor::straight())
    };
    let mut whole = room(acting(), Box::new(Nobody));
    let (expected, sat) = way(&mut whole, 200);
    assert!(sat);
    let mut first = room(acting(), Box::new(Nobody));
    way(&mut first, 30);
    let saved = first.save().unwrap();
    // Its words are said already.
    let silent = ActingMind::new(PlanningMind::new(Speaker::default(), Nobody), RuleExecutor::straight());
    let mut second = room(silent, Box::new(Nobody));
    second.restore(saved).unwrap();
    let (found, _) = way(&mut second, 170);
    assert_eq!(expected[30..], found);
    let mut mind = ActingMind::new(Silent, RuleExecutor::straight());
    assert!(!Mind::<ConeHunt>::restore(&mut mind, &[7, 7, 7]));
}
