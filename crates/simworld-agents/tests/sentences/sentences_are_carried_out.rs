//! From a sentence to a body that sits: the paper's example, and the ways in which sentences fail.

use proptest::prelude::*;
use simworld_agents::executor::RuleExecutor;
use simworld_agents::language::GrammarPlanner;
use simworld_agents::observer::{GpsFix, GpsObserver, SceneGraph, SceneGraphObserver};
use simworld_core::action::Action;
use simworld_core::command::Command;
use simworld_core::geometry::{Point3, Pose, pose_facing};
use simworld_core::id::EntityId;
use simworld_core::intent::Intent;
use simworld_core::kinematic::{KinematicBody, KinematicDynamics};
use simworld_core::scene::{EntityDesc, EntityKind, Place, Role, Scene, Shape, World};
use simworld_core::seam::{Executor, Goal, Plan, PlanError, PlanStep, Planner, Progress};
use simworld_core::seed::Seed;
use simworld_core::simulation::Simulation;
use simworld_core::testing;

fn at(x: f64, y: f64) -> Pose {
    pose_facing(Point3::new(x, y, 0.0), 0.0)
}

/// A person, two chairs, a parcel, a museum, a hospital and a café near it, another café far off.
fn square() -> (World, EntityId) {
    let mut world = World::new();
    let person = Shape::Capsule { radius: 0.25, height: 1.8 };
    let me = world.spawn(EntityDesc::new(EntityKind::Person, at(0.0, 0.0), person)).expect("a sound person");
    let mut put = |desc: EntityDesc| world.spawn(desc).expect("a sound entity");
    put(EntityDesc::new(EntityKind::Chair, at(20.0, 0.0), Shape::cuboid(0.5, 0.5, 0.9)));
    put(EntityDesc::new(EntityKind::Chair, at(8.0, 3.0), Shape::cuboid(0.5, 0.5, 0.9)));
    put(EntityDesc::new(EntityKind::Parcel, at(-6.0, 0.0), Shape::cuboid(0.3, 0.3, 0.3)));
    let house = |x, y| EntityDesc::new(EntityKind::Building, at(x, y), Shape::cuboid(10.0, 10.0, 8.0));
    put(house(60.0, 40.0).used_as(Place::Museum).named("Harbour Museum"));
    put(house(60.0, 60.0).used_as(Place::Restaurant).named("Linden Bistro"));
    put(house(-30.0, -20.0).used_as(Place::Restaurant).named("Old Mill Grill"));
    (world, me)
}

fn plan(words: &str) -> Result<Plan, PlanError> {
    let (world, me) = square();
    GrammarPlanner::default().plan(&Intent::Words(words.to_owned()), &world, me)
}

fn goals(words: &str) -> Vec<u64> {
    let steps = plan(words).unwrap_or_else(|error| panic!("{words}: {error}")).steps;
    let goal = |step: &PlanStep| match step {
        PlanStep::Navigate { to: Goal::Entity(id), .. } => Some(u64::from(*id)),
        _ => None,
    };
    steps.iter().filter_map(goal).collect()
}

#[test]
fn things_are_found_as_people_name_them() {
    assert_eq!(goals("go to the nearest chair"), [2]);
    assert_eq!(goals("Please walk to the Harbour Museum, then sit down"), [4, 1], "seen from the museum");
    assert_eq!(goals("go to harbor museum"), [4], "one letter is missing");
    assert_eq!(
        goals("go to the restaurant near the museum"),
        [5],
        "the other one is nearer, but not near the museum"
    );
    assert_eq!(goals("go to the cafe"), [6]);
    assert_eq!(goals("run to #1 and sit down on it"), [1]);
    assert_eq!(goals("pick up the parcel and go to the museum and drop it off"), [3, 4]);
    assert!(matches!(
        plan("go to (10, -3)").unwrap().steps[..],
        [PlanStep::Navigate { to: Goal::Point(point), .. }] if point == Point3::new(10.0, -3.0, 0.0)
    ));
}

#[test]
fn failures_say_what_and_what_instead() {
    let error = plan("go to the zoo").unwrap_err().to_string();
    assert!(error.contains("no zoo here") && error.contains("chair"), "{error}");
    let error = plan("juggle fire").unwrap_err().to_string();
    assert!(error.contains("juggle fire") && error.contains("sit down"), "{error}");
    let (world, me) = square();
    let error = GrammarPlanner::default().plan(&Intent::call("fly"), &world, me).unwrap_err().to_string();
    assert!(error.contains("fly") && error.contains("navigate"), "{error}");
}

#[test]
fn the_seams_are_kept() {
    let (world, me) = square();
    let understood = [Intent::Words("go to the nearest chair and sit down".into()), Intent::call("stop")];
    testing::check_planner(|| Box::new(GrammarPlanner::default()), &world, me, &understood);
    let wait = Plan { steps: vec![PlanStep::Wait { seconds: 1.0 }, PlanStep::Act(Action::Stop)] };
    testing::check_executor(|| Box::new(RuleExecutor::straight()), &world, me, &wait, 20);
    testing::check_observer(|| Box::new(GpsObserver::new(1.0, 0.1, Seed(1))), &world, me, GpsFix::default);
    testing::check_observer(|| Box::new(SceneGraphObserver::new(50.0)), &world, me, SceneGraph::default);
}

#[test]
fn a_prompt_keeps_its_budget() {
    let (world, me) = square();
    let mut graph = SceneGraph::default();
    simworld_core::seam::Observer::observe(&mut SceneGraphObserver::new(100.0), &world, me, &mut graph)
        .unwrap();
    assert_eq!(graph.sightings[0].kind, EntityKind::Parcel);
    for budget in [0, 30, 100, 1000] {
        assert!(graph.to_text(budget).chars().count() <= budget);
    }
    assert!(graph.to_text(1000).contains("Harbour Museum"));
}

/// The paper's example: "go to the nearest chair and sit down".
#[test]
fn a_body_goes_to_the_nearest_chair_and_sits_down() {
    let (world, me) = square();
    let words = Intent::Words("go to the nearest chair and sit down".into());
    let plan = GrammarPlanner::default().plan(&words, &world, me).unwrap();
    let mut bodies = KinematicDynamics::new();
    bodies.insert(me, Box::new(KinematicBody::walker(at(0.0, 0.0))));
    let mut simulation = Simulation::new(world);
    simulation.add_dynamics("bodies", Box::new(bodies));
    let mut executor = RuleExecutor::straight();
    executor.start(plan, simulation.world(), me).unwrap();
    let mut actions = Vec::new();
    let done = (0..200).any(|_| {
        actions.clear();
        let progress = executor.advance(simulation.world(), me, &mut actions).unwrap();
        for action in actions.drain(..) {
            simulation.submit(Command::Actuate { who: me, action });
        }
        simulation.step().unwrap();
        assert!(!matches!(progress, Progress::Failed { .. }), "{progress:?}");
        progress == Progress::Done
    });
    assert!(done, "still under way after 20 s");
    let bond = simulation.world().entity(me).unwrap().attachment.copied().expect("it sits");
    assert_eq!((u64::from(bond.parent), bond.role), (2, Role::Seated));
}

proptest! {
    #[test]
    fn no_sentence_panics(words in ".{0,80}") {
        let _ = plan(&words);
    }

    #[test]
    fn no_mangled_sentence_panics(cut in 0_usize..60, insert in "[a-z(),.# ]{0,6}") {
        let sentence = "please go to the cafe next to the harbour museum and then sit down on #2";
        let cut = cut.min(sentence.len());
        let _ = plan(&format!("{}{insert}{}", &sentence[..cut], &sentence[cut..]));
    }
}
