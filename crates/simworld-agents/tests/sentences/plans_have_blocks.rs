//! Conditions, repetitions and guards are carried out as they are written.

use crate::executor_common::{Walk, at, person, thing};
use simworld_agents::executor::RuleExecutor;
use simworld_core::action::Action;
use simworld_core::command::Command;
use simworld_core::environment::Environment;
use simworld_core::geometry::Point3;
use simworld_core::id::EntityId;
use simworld_core::scene::{EntityDesc, EntityKind, Scene, Shape, World};
use simworld_core::seam::{Condition, Executor, Goal, Plan, PlanStep, Progress, Which};

fn forward() -> PlanStep {
    PlanStep::Act(Action::MoveForward { speed: 1.0 })
}

fn walk(world: World, me: EntityId, steps: Vec<PlanStep>) -> Walk {
    Walk::new(world, me, RuleExecutor::straight(), Plan { steps })
}

fn photos(told: &[Action]) -> usize {
    told.iter().filter(|action| **action == Action::TakePhoto).count()
}

#[test]
fn what_is_repeated_is_done_so_often() {
    let mut world = World::new();
    let me = person(&mut world, 0.0, 0.0);
    let photo = PlanStep::Act(Action::TakePhoto);
    let twice = PlanStep::Repeat { times: 2, steps: vec![photo.clone(), PlanStep::Wait { seconds: 0.3 }] };
    let mut walk = walk(world, me, vec![PlanStep::Repeat { times: 3, steps: vec![twice, photo] }]);
    let mut taken = 0;
    assert_eq!(walk.finish(200, |walk| taken += photos(&walk.told)), Progress::Done);
    assert_eq!(taken, 9, "three times two and one");
}

#[test]
fn a_condition_chooses_what_is_done() {
    for (rain, expected) in [(0.0, 0), (3.0, 1)] {
        let mut world = World::new();
        let me = person(&mut world, 0.0, 0.0);
        let mut environment = Environment::default();
        environment.weather.rain = rain;
        world.set_environment(environment).unwrap();
        let photo = vec![PlanStep::Act(Action::TakePhoto)];
        let steps = vec![
            PlanStep::If { condition: Condition::Raining, then: photo, otherwise: Vec::new() },
            PlanStep::Wait { seconds: 0.2 },
        ];
        let mut walk = walk(world, me, steps);
        let mut taken = 0;
        assert_eq!(walk.finish(50, |walk| taken += photos(&walk.told)), Progress::Done);
        assert_eq!(taken, expected);
    }
}

#[test]
fn one_walks_on_until_the_bench_is_in_sight_and_then_stands() {
    let mut world = World::new();
    let me = person(&mut world, 0.0, 0.0);
    // A house hides the bench until one is past its corner.
    thing(&mut world, EntityKind::Building, 12.0, 8.0, Shape::cuboid(16.0, 10.0, 6.0));
    let bench = thing(&mut world, EntityKind::Bench, 30.0, 14.0, Shape::cuboid(0.6, 1.8, 0.8));
    let seen = Condition::Sees(Which::Entity(bench));
    let mut walk = walk(world, me, vec![PlanStep::Until { condition: seen, steps: vec![forward()] }]);
    assert_eq!(walk.finish(400, |_| ()), Progress::Done);
    let x = walk.here().x;
    assert!(x > 5.0 && x < 30.0, "saw it from x = {x}");
    let stood = walk.here();
    for _ in 0..10 {
        walk.step();
    }
    assert!((walk.here() - stood).norm() < 0.2, "walks on after it saw the bench");
}

#[test]
fn a_guard_breaks_off_what_it_guards_at_once() {
    let mut world = World::new();
    let me = person(&mut world, 0.0, 0.0);
    let far = PlanStep::Navigate { to: Goal::Point(Point3::new(1000.0, 0.0, 0.0)), within: 0.5, speed: None };
    let steps = vec![
        PlanStep::Until { condition: Condition::Elapsed(3.0), steps: vec![far] },
        PlanStep::Act(Action::TakePhoto),
    ];
    let mut walk = walk(world, me, steps);
    let mut ticks = 0;
    assert_eq!(walk.finish(100, |_| ticks += 1), Progress::Done);
    assert!((29..=33).contains(&ticks), "{ticks} steps of 0.1 s for 3 s");
}

#[test]
fn one_waits_for_a_condition() {
    let mut world = World::new();
    let me = person(&mut world, 0.0, 0.0);
    let dark = PlanStep::Until { condition: Condition::Dark, steps: Vec::new() };
    let mut walk = walk(world, me, vec![dark]);
    for _ in 0..30 {
        assert!(walk.step().goes_on(), "it is day");
    }
    let mut night = Environment::default();
    night.sun.elevation = -0.3;
    walk.simulation.submit(Command::SetEnvironment(night));
    assert_eq!(walk.finish(3, |_| ()), Progress::Done);
}

#[test]
fn how_two_others_stand_is_a_condition() {
    // The edge of the bin is a quarter of a metre from its middle.
    for (x, expected) in [(12.0, 1), (16.0, 0)] {
        let mut world = World::new();
        let me = person(&mut world, 0.0, 0.0);
        let one = person(&mut world, x, 0.0);
        let other = thing(&mut world, EntityKind::TrashBin, 10.0, 0.0, Shape::cuboid(0.5, 0.5, 0.9));
        let condition = Condition::Together { one, other, within: 5.0 };
        let photo = vec![PlanStep::Act(Action::TakePhoto)];
        let steps = vec![
            PlanStep::If { condition, then: photo, otherwise: Vec::new() },
            PlanStep::Wait { seconds: 0.2 },
        ];
        let mut walk = walk(world, me, steps);
        let mut taken = 0;
        assert_eq!(walk.finish(50, |walk| taken += photos(&walk.told)), Progress::Done);
        assert_eq!(taken, expected, "at {x} m");
    }
}

#[test]
fn one_follows_somebody_who_walks_away() {
    let mut world = World::new();
    let me = person(&mut world, 0.0, 0.0);
    let other = person(&mut world, 5.0, 0.0);
    let follow = PlanStep::Follow { whom: other, gap: 2.0, speed: Some(2.0) };
    let until = PlanStep::Until { condition: Condition::Elapsed(20.0), steps: vec![follow] };
    let mut walk = walk(world, me, vec![until]);
    let mut x = 5.0;
    let mut step = |walk: &mut Walk| {
        x += 0.1;
        walk.simulation.submit(Command::Move { id: other, pose: at(x, 0.0) });
        walk.step()
    };
    for _ in 0..190 {
        assert!(step(&mut walk).goes_on());
    }
    assert!(walk.gap(other) < 3.0, "{} m behind", walk.gap(other));
    assert!(walk.gap(other) > 0.5, "trod on his heels");
}

#[test]
fn one_turns_to_what_one_looks_at() {
    let mut world = World::new();
    let me = person(&mut world, 0.0, 0.0);
    let tree = thing(&mut world, EntityKind::Tree, 0.0, 9.0, Shape::cuboid(0.5, 0.5, 5.0));
    let mut walk = walk(world, me, vec![PlanStep::Face { to: Goal::Entity(tree) }]);
    assert_eq!(walk.finish(40, |_| ()), Progress::Done);
    let yaw = simworld_core::geometry::yaw_of(walk.simulation.world().entity(me).unwrap().pose);
    assert!((yaw - std::f64::consts::FRAC_PI_2).abs() < 0.06, "{yaw}");
}

#[test]
fn blocks_without_end_or_sense_are_refused_or_end() {
    let mut world = World::new();
    let me =
        world.spawn(EntityDesc::new(EntityKind::Person, at(0.0, 0.0), Shape::cuboid(0.5, 0.5, 1.8))).unwrap();
    let endless = |inner: Vec<PlanStep>| PlanStep::Until { condition: Condition::Dark, steps: inner };
    let never = PlanStep::If { condition: Condition::Raining, then: vec![forward()], otherwise: Vec::new() };
    let mut executor = RuleExecutor::straight();
    executor.start(Plan { steps: vec![endless(vec![never])] }, &world, me).unwrap();
    for _ in 0..20 {
        assert_eq!(
            executor.advance(&world, me, &mut Vec::new()),
            Ok(Progress::Running),
            "it waits, and does not hang"
        );
    }
    let deep = (0..40).fold(forward(), |inner, _| endless(vec![inner]));
    assert!(executor.start(Plan { steps: vec![deep] }, &world, me).is_err(), "nested without end");
    let nan = PlanStep::Until { condition: Condition::Elapsed(f64::NAN), steps: Vec::new() };
    assert!(executor.start(Plan { steps: vec![nan] }, &world, me).is_err());
    assert!(world.entity(me).is_some());
}

#[test]
fn a_plan_goes_on_from_where_it_was_saved() {
    let mut world = World::new();
    let me = person(&mut world, 0.0, 0.0);
    let steps = vec![PlanStep::Repeat {
        times: 3,
        steps: vec![PlanStep::Wait { seconds: 0.5 }, PlanStep::Act(Action::TakePhoto)],
    }];
    let mut one = RuleExecutor::straight();
    one.start(Plan { steps }, &world, me).unwrap();
    for _ in 0..8 {
        one.advance(&world, me, &mut Vec::new()).unwrap();
    }
    let mut other = RuleExecutor::straight();
    assert!(other.restore(&one.save()));
    for _ in 0..30 {
        let (mut a, mut b) = (Vec::new(), Vec::new());
        assert_eq!(one.advance(&world, me, &mut a), other.advance(&world, me, &mut b));
        assert_eq!(a, b);
    }
}
