//! Conformance checks: what every implementor of a seam must hold to. Each panics with a sentence that says what
//! does not hold; call them from a test of your own.

mod gym;
mod network;

use std::collections::BTreeSet;
use std::fmt::{Debug, Write};
use std::ops::ControlFlow;

use crate::action::{Action, ActionKind};
use crate::geometry::{Aabb, Point2};
use crate::hash::{StateHash, StateHasher};
use crate::id::EntityId;
use crate::intent::Intent;
use crate::scene::{NameIndex, Scene, World};
use crate::seam::{
    Dynamics, Embodiment, Executor, Observer, Outcome, Plan, PlanStep, Planner, Progress, Task, TaskContext,
    TaskOutput,
};
use crate::seed::Seed;

pub use gym::{EnvCheck, Seeds, check_env, check_parallel_env};
pub use network::numbered_in_order;

/// Everything, in the plane.
fn everywhere() -> Aabb {
    Aabb::column_around(Point2::origin(), 1e9)
}

fn ids(scene: &dyn Scene, region: &Aabb) -> Vec<EntityId> {
    let mut found = Vec::new();
    let _ = scene.visit(region, &mut |entity| {
        found.push(entity.id);
        ControlFlow::Continue(())
    });
    found
}

/// A scene visits each entity once, in the same order every time, exactly those that touch the region, breaks off
/// when asked, and agrees with itself.
pub fn check_scene(scene: &dyn Scene) {
    let all = ids(scene, &everywhere());
    assert_eq!(all, ids(scene, &everywhere()), "two visits of the same state differ in order");
    let distinct: BTreeSet<EntityId> = all.iter().copied().collect();
    assert_eq!(distinct.len(), all.len(), "an entity was visited twice");
    for id in &all {
        let entity = scene.entity(*id).unwrap_or_else(|| panic!("{id} is visited but not found by its id"));
        assert_eq!(entity.id, *id, "entity({id}) answers with another id");
        let around = entity.bounds.inflated(0.5);
        let near = ids(scene, &around);
        assert!(near.contains(id), "{id} is not visited in a region around it");
        for other in near {
            let touches = scene.entity(other).is_some_and(|other| other.bounds.intersects(&around));
            assert!(touches, "{other} is visited in a region that it does not touch");
        }
        let nearest = scene.nearest(entity.planar(), 1.0, &|other| other.id == *id);
        assert_eq!(nearest.map(|found| found.id), Some(*id), "{id} is not the nearest to itself");
    }
    let mut visited = 0;
    let _ = scene.visit(&everywhere(), &mut |_| {
        visited += 1;
        ControlFlow::Break(())
    });
    assert!(visited <= 1, "the visit went on after the visitor broke it off");
    assert!(scene.entity(EntityId::new(u32::MAX, u32::MAX)).is_none(), "an id nobody has is found");
    assert_eq!(scene.environment().validate(), Ok(()));
    if let Some(names) = scene.names() {
        let mut scanned = NameIndex::default();
        for entity in all.iter().filter_map(|id| scene.entity(*id)) {
            scanned.insert(entity.id, entity.info);
        }
        assert_eq!(names, &scanned, "the index of names differs from what its entities are called");
    }
}

/// Dynamics do the same twice, go on after save and restore as if nothing had been, and refuse foreign bytes with
/// an error instead of a panic.
pub fn check_dynamics(world: &World, make: impl Fn() -> Box<dyn Dynamics>) {
    let digest = |world: &World, dynamics: &dyn Dynamics| {
        let mut hasher = StateHasher::new();
        world.state_hash(&mut hasher);
        dynamics.state_hash(&mut hasher);
        hasher.finish()
    };
    let run = |world: &mut World, dynamics: &mut dyn Dynamics, steps: usize| {
        let dt = world.clock().dt();
        for _ in 0..steps {
            world.begin_step();
            dynamics.step(world, dt).unwrap_or_else(|error| panic!("a step failed: {error}"));
            world.finish_step();
        }
    };
    let (mut straight_world, mut straight) = (world.clone(), make());
    run(&mut straight_world, &mut *straight, 40);
    let expected = digest(&straight_world, &*straight);

    let (mut again_world, mut again) = (world.clone(), make());
    run(&mut again_world, &mut *again, 40);
    assert_eq!(digest(&again_world, &*again), expected, "the same steps led to another state");

    let (mut halted_world, mut halted) = (world.clone(), make());
    run(&mut halted_world, &mut *halted, 17);
    let (world_saved, saved) = (halted_world.snapshot(), halted.save().expect("a healthy part can be saved"));
    let mut resumed_world = World::restore(world_saved).expect("a snapshot restores");
    let mut resumed = make();
    resumed.restore(&resumed_world, &saved).expect("what was saved can be restored");
    run(&mut resumed_world, &mut *resumed, 23);
    assert_eq!(digest(&resumed_world, &*resumed), expected, "save, restore and go on is not a straight run");

    for cut in [1, saved.len() / 2] {
        // Either outcome is allowed for bytes that happen to be readable; a panic is not.
        let _ = make().restore(world, &saved[..saved.len().saturating_sub(cut)]);
        let _ = make().restore(world, &vec![0xff; cut]);
    }
}

/// A body accepts every kind it supports or says why not, refuses every other, stays finite and goes on after a
/// refusal.
pub fn check_embodiment(make: impl Fn() -> Box<dyn Embodiment>) {
    let someone = EntityId::new(0, 0);
    for kind in ActionKind::ALL {
        let mut body = make();
        let before = body.state();
        let result = body.apply(&sample_action(*kind, someone));
        if body.supports().contains(*kind) {
            if let Err(error) = &result {
                assert!(!error.to_string().is_empty(), "a refusal says nothing");
            }
        } else {
            assert!(result.is_err(), "{kind} is not supported, and yet it was taken");
            assert_eq!(body.state(), before, "a refused {kind} moved the body");
        }
        for _ in 0..20 {
            body.advance(0.1);
            let state = body.state();
            let finite =
                state.pose.translation.vector.iter().chain(state.twist.linear.iter()).all(|x| x.is_finite());
            assert!(finite, "{kind} made the state infinite");
        }
    }
    let mut body = make();
    for wild in [f64::NAN, f64::INFINITY, -1e300, 1e300] {
        for action in [
            Action::MoveForward { speed: wild },
            Action::Rotate { angle: wild },
            Action::ChangeSpeed { speed: wild },
            Action::Throttle { level: wild },
            Action::Brake { level: wild },
            Action::Steer { angle: wild },
        ] {
            let _ = body.apply(&action);
            body.advance(0.1);
            assert!(
                body.state().pose.translation.vector.iter().all(|x| x.is_finite()),
                "{action:?} blew up the body"
            );
        }
    }
}

/// An action of that kind with mild arguments; entities it needs are `someone`.
pub fn sample_action(kind: ActionKind, someone: EntityId) -> Action {
    use crate::action::StepDirection::Forward;
    match kind {
        ActionKind::MoveForward => Action::MoveForward { speed: 1.0 },
        ActionKind::Step => Action::Step { direction: Forward, distance: 0.5 },
        ActionKind::Rotate => Action::Rotate { angle: 0.3 },
        ActionKind::ChangeSpeed => Action::ChangeSpeed { speed: 1.2 },
        ActionKind::Steer => Action::Steer { angle: 0.1 },
        ActionKind::Throttle => Action::Throttle { level: 0.3 },
        ActionKind::Brake => Action::Brake { level: 0.3 },
        ActionKind::Stop => Action::Stop,
        ActionKind::PickUp => Action::PickUp { item: someone },
        ActionKind::DropOff => Action::DropOff,
        ActionKind::CarryHeavy => Action::CarryHeavy { item: someone },
        ActionKind::PutDownHeavy => Action::PutDownHeavy,
        ActionKind::SitDown => Action::SitDown { seat: someone },
        ActionKind::StandUp => Action::StandUp,
        ActionKind::OpenDoor => Action::OpenDoor { door: someone },
        ActionKind::EnterCar => Action::EnterCar { car: someone },
        ActionKind::ExitCar => Action::ExitCar,
        ActionKind::RideScooter => Action::RideScooter { scooter: someone },
        ActionKind::GetOffScooter => Action::GetOffScooter,
        ActionKind::LookUp => Action::LookUp { angle: 0.2 },
        ActionKind::LookDown => Action::LookDown { angle: 0.2 },
        ActionKind::Focus => Action::Focus { horizontal_fov: 1.0 },
        ActionKind::TakePhoto => Action::TakePhoto,
        ActionKind::Converse => Action::Converse { with: someone, words: "hello".to_owned() },
        ActionKind::PointDirection => Action::PointDirection { heading: 0.5 },
        ActionKind::WaveHand => Action::WaveHand { to: someone },
        ActionKind::Argue => Action::Argue { with: someone },
        ActionKind::CloseDoor => Action::CloseDoor { door: someone },
        ActionKind::Give => Action::Give { to: someone },
        ActionKind::Throw => Action::Throw { velocity: crate::geometry::Vector3::new(3.0, 0.0, 2.0) },
        ActionKind::ThrowTo => Action::ThrowTo { to: someone },
        ActionKind::Grasp => Action::Grasp { thing: someone, both_hands: false },
        ActionKind::LetGo => Action::LetGo,
        ActionKind::Crouch => Action::Crouch,
        ActionKind::Buy => Action::Buy { goods: "tea".to_owned(), from: someone },
    }
}

/// A sense yields the same for the same scene whatever was observed before, and an error for an agent that is not
/// there.
pub fn check_observer<O>(
    make: impl Fn() -> Box<dyn Observer<Observation = O>>,
    scene: &dyn Scene,
    who: EntityId,
    buffer: impl Fn() -> O,
) where
    O: PartialEq + Debug,
{
    let (mut first, mut second) = (buffer(), buffer());
    let mut sense = make();
    sense.observe(scene, who, &mut first).unwrap_or_else(|error| panic!("observing failed: {error}"));
    make().observe(scene, who, &mut second).expect("a fresh sense observes as well");
    assert_eq!(first, second, "two fresh senses perceive differently");
    sense.observe(scene, who, &mut second).expect("a sense observes twice");
    assert_eq!(first, second, "an observation depends on what was observed before");
    let nobody = EntityId::new(u32::MAX, u32::MAX);
    assert!(sense.observe(scene, nobody, &mut second).is_err(), "nobody perceives something");
}

/// A planner understands what it should, the same every time, and answers nonsense with an error that says
/// something.
pub fn check_planner(
    make: impl Fn() -> Box<dyn Planner>,
    scene: &dyn Scene,
    who: EntityId,
    understood: &[Intent],
) {
    for intent in understood {
        let plan = make().plan(intent, scene, who).unwrap_or_else(|error| panic!("{intent} gave: {error}"));
        assert!(!plan.steps.is_empty(), "{intent} gave an empty plan");
        assert_eq!(make().plan(intent, scene, who), Ok(plan), "{intent} gave another plan the second time");
    }
    for nonsense in
        [Intent::Words(String::new()), Intent::Words("\u{0}💥 qwrtz".into()), Intent::call("no_such")]
    {
        match make().plan(&nonsense, scene, who) {
            Ok(plan) => panic!("{nonsense} was planned as {plan:?}"),
            Err(error) => assert!(!error.to_string().is_empty(), "a refusal says nothing"),
        }
    }
}

/// An executor is idle without a plan, takes one up, says when it is done, can be cancelled, and refuses an agent
/// that is not there. `plan` must be one that it finishes within `steps` steps if the scene stands still.
pub fn check_executor(
    make: impl Fn() -> Box<dyn Executor>,
    scene: &dyn Scene,
    who: EntityId,
    plan: &Plan,
    steps: usize,
) {
    let mut actions = Vec::new();
    let mut executor = make();
    assert_eq!(executor.advance(scene, who, &mut actions), Ok(Progress::Idle), "busy without a plan");
    executor.start(plan.clone(), scene, who).unwrap_or_else(|error| panic!("the plan was refused: {error}"));
    let last = (0..steps)
        .map(|_| executor.advance(scene, who, &mut actions).expect("the executor works"))
        .find(|progress| !progress.goes_on());
    assert_eq!(last, Some(Progress::Done), "the plan was not done after {steps} steps");
    assert_eq!(executor.advance(scene, who, &mut Vec::new()), Ok(Progress::Idle), "not idle after its plan");

    executor.start(plan.clone(), scene, who).expect("a plan can be taken up again");
    executor.cancel(&mut actions);
    assert_eq!(executor.advance(scene, who, &mut Vec::new()), Ok(Progress::Idle), "not idle after a cancel");

    let nobody = EntityId::new(u32::MAX, u32::MAX);
    let wait = Plan { steps: vec![PlanStep::Act(Action::Stop)] };
    let refused = make().start(wait, scene, nobody).is_err() || {
        let mut executor = make();
        let _ = executor.start(Plan { steps: vec![PlanStep::Act(Action::Stop)] }, scene, nobody);
        !executor.advance(scene, nobody, &mut actions).is_ok_and(|progress| progress.goes_on())
    };
    assert!(refused, "it acts for nobody");
}

/// A task decides the same for the same seed, keeps its rewards finite, and refuses an episode without agents.
pub fn check_task(make: impl Fn() -> Box<dyn Task>, scene: &dyn Scene, agents: &[EntityId]) {
    let episode = |seed: Seed| {
        let mut task = make();
        let mut out = TaskOutput::default();
        task.reset(scene, agents, seed, &mut out).unwrap_or_else(|error| panic!("reset failed: {error}"));
        let mut trace = format!("{:?}{:?}", out.commands, out.events);
        for _ in 0..30 {
            out.clear();
            let mut outcome = Outcome::default();
            let context = TaskContext { scene, agents, intents: &[], events: &[], spawned: &[] };
            task.step(&context, &mut out, &mut outcome)
                .unwrap_or_else(|error| panic!("a step failed: {error}"));
            assert!(outcome.rewards.iter().all(|reward| reward.is_finite()), "a reward is not finite");
            assert!(outcome.rewards.len() <= agents.len(), "more rewards than agents");
            write!(trace, "{outcome:?}{:?}{:?}{:?}", out.commands, out.plans, out.events)
                .expect("a string takes whatever is written");
            if outcome.terminated || outcome.truncated {
                break;
            }
        }
        assert!(task.metrics().iter().all(|metric| metric.value.is_finite()), "a metric is not finite");
        trace
    };
    assert_eq!(episode(Seed(1)), episode(Seed(1)), "the same seed led to another episode");
    let nobody = make().reset(scene, &[], Seed(1), &mut TaskOutput::default());
    assert!(nobody.is_err(), "an episode without agents was begun");
}
