//! On open ground: around what stands in the way, up to what is looked for, and an end when there is no way.

use crate::executor_common::{Walk, at, person, thing, to};
use proptest::prelude::*;
use simworld_agents::executor::{ExecutorConfig, RuleExecutor};
use simworld_core::action::Action;
use simworld_core::geometry::Point3;
use simworld_core::id::EntityId;
use simworld_core::scene::{EntityDesc, EntityKind, Scene, Shape, World};
use simworld_core::seam::{Executor, ExecutorError, Goal, Plan, PlanStep, Progress};

/// Half a body, m: nearer than this to a footprint is a collision.
const BODY: f64 = 0.25;

fn walk_past(kind: EntityKind, shape: Shape, x: f64, y: f64) -> f64 {
    let mut world = World::new();
    let me = person(&mut world, 0.0, 0.0);
    let obstacle = thing(&mut world, kind, x, y, shape);
    let mut walk = Walk::new(world, me, RuleExecutor::straight(), to(20.0, 0.0));
    let mut least = f64::INFINITY;
    assert_eq!(walk.finish(400, |walk| least = least.min(walk.gap(obstacle))), Progress::Done);
    assert!((walk.here() - Point3::new(20.0, 0.0, 0.0).xy()).norm() <= 0.6);
    least
}

#[test]
fn a_bench_a_tree_and_a_car_are_walked_round() {
    for (kind, shape) in [
        (EntityKind::Bench, Shape::cuboid(0.6, 1.8, 0.8)),
        (EntityKind::Tree, Shape::Cylinder { radius: 0.3, height: 6.0 }),
        (EntityKind::Car, Shape::cuboid(1.8, 4.5, 1.5)),
        (EntityKind::Car, Shape::cuboid(4.5, 1.8, 1.5)),
    ] {
        let least = walk_past(kind, shape, 10.0, 0.2);
        assert!(least > BODY, "{kind} {shape:?} was passed at {least} m");
        assert!(least < 1.5, "{kind} was given a berth of {least} m");
    }
}

proptest! {
    #[test]
    fn nothing_in_the_way_is_walked_through(x in 3.0..17.0_f64, y in -3.0..3.0_f64, across in 0.3..5.0_f64) {
        let least = walk_past(EntityKind::Prop, Shape::cuboid(0.5, across, 1.0), x, y);
        prop_assert!(least > BODY, "passed at {least} m");
    }
}

#[test]
fn people_who_meet_keep_right() {
    let mut world = World::new();
    let me = person(&mut world, 0.0, 0.0);
    let other = person(&mut world, 10.0, 0.0);
    let mut walk = Walk::new(world, me, RuleExecutor::straight(), to(20.0, 0.0));
    let (mut least, mut side) = (f64::INFINITY, 0.0_f64);
    walk.finish(400, |walk| {
        least = least.min(walk.gap(other));
        side = if (walk.here().x - 10.0).abs() < 0.2 { walk.here().y } else { side };
    });
    assert!(least > BODY && side < -0.5, "passed at {least} m, {side} m to the left");
}

#[test]
fn the_thing_one_goes_to_is_no_obstacle() {
    for (kind, shape) in [
        (EntityKind::Chair, Shape::cuboid(0.5, 0.5, 0.9)),
        (EntityKind::Bus, Shape::cuboid(12.0, 2.5, 3.0)),
        (EntityKind::Building, Shape::cuboid(30.0, 20.0, 9.0)),
    ] {
        let mut world = World::new();
        let me = person(&mut world, 0.0, 0.0);
        let goal = thing(&mut world, kind, 40.0, 3.0, shape);
        let plan = Plan::navigate(Goal::Entity(goal), 1.0);
        let mut walk = Walk::new(world, me, RuleExecutor::straight(), plan);
        assert_eq!(
            walk.finish(400, |walk| assert!(walk.gap(goal) > 0.5, "walked into the {kind}")),
            Progress::Done
        );
        assert!(walk.gap(goal) <= 1.0, "stands {} m from the {kind}", walk.gap(goal));
    }
}

#[test]
fn a_door_is_where_one_goes_in() {
    let mut world = World::new();
    let me = person(&mut world, 0.0, 0.0);
    let door = Point3::new(30.0, -12.0, 0.0);
    let house = EntityDesc::new(EntityKind::Building, at(30.0, 0.0), Shape::cuboid(20.0, 20.0, 9.0))
        .accessed_at(door);
    let house = world.spawn(house).expect("a sound house");
    let mut walk = Walk::new(world, me, RuleExecutor::straight(), Plan::navigate(Goal::Entity(house), 1.0));
    walk.finish(400, |_| ());
    assert!((walk.here() - door.xy()).norm() <= 1.0);
}

#[test]
fn who_moves_on_is_followed() {
    let mut world = World::new();
    let me = person(&mut world, 0.0, 0.0);
    let friend = person(&mut world, 20.0, 0.0);
    let mut walk = Walk::new(world, me, RuleExecutor::straight(), Plan::navigate(Goal::Entity(friend), 1.5));
    for step in 0..600 {
        let progress = walk.step();
        if progress == Progress::Done {
            assert!(walk.gap(friend) <= 1.6 && step > 150, "step {step}");
            return;
        }
        let pose = at(20.0, (0.06 * f64::from(step)).min(25.0));
        let moved = simworld_core::command::Command::Move { id: friend, pose };
        walk.simulation.submit(moved);
    }
    panic!("never caught up");
}

#[test]
fn few_words_are_enough() {
    let mut world = World::new();
    let me = person(&mut world, 0.0, 0.0);
    let mut walk = Walk::new(world, me, RuleExecutor::straight(), to(30.0, 40.0));
    let mut told = 0;
    walk.finish(600, |walk| told += walk.told.len());
    assert!(told <= 12, "{told} actions for a straight walk");
}

#[test]
fn a_plan_says_how_fast() {
    let seconds = |speed| {
        let mut world = World::new();
        let me = person(&mut world, 0.0, 0.0);
        let goal = Goal::Point(Point3::new(30.0, 0.0, 0.0));
        let plan = Plan { steps: vec![PlanStep::Navigate { to: goal, within: 0.5, speed }] };
        let mut walk = Walk::new(world, me, RuleExecutor::straight(), plan);
        walk.finish(900, |_| ());
        walk.simulation.world().clock().seconds()
    };
    assert!((seconds(Some(2.0)) - 15.0).abs() < 1.0);
    assert!((seconds(Some(1.0)) - 30.0).abs() < 1.0);
    assert!((seconds(None) - 30.0 / ExecutorConfig::default().speed).abs() < 1.0);
}

#[test]
fn one_told_to_stop_by_somebody_else_goes_on() {
    let mut world = World::new();
    let me = person(&mut world, 0.0, 0.0);
    let mut walk = Walk::new(world, me, RuleExecutor::straight(), to(20.0, 0.0));
    for _ in 0..50 {
        walk.step();
    }
    walk.simulation.submit(simworld_core::command::Command::Actuate { who: me, action: Action::Stop });
    assert_eq!(walk.finish(400, |_| ()), Progress::Done);
}

/// A body that nobody moves: every way is blocked.
#[test]
fn where_there_is_no_way_it_gives_up_and_says_where() {
    let mut world = World::new();
    let me = person(&mut world, 3.0, 4.0);
    let config = ExecutorConfig { patience: 1.0, attempts: 3, ..ExecutorConfig::default() };
    let mut executor = RuleExecutor::with_config(None, config).expect("settings in range");
    executor.start(to(20.0, 0.0), &world, me).expect("a sound plan");
    for step in 0..100 {
        let mut told = Vec::new();
        match executor.advance(&world, me, &mut told).expect("it works") {
            Progress::Running | Progress::Begun { .. } | Progress::Rerouted { .. } => {}
            Progress::Failed { reason } => {
                assert!(reason.contains("stuck at (3.0, 4.0)") && step > 35, "{reason} after {step}");
                assert_eq!(told, [Action::Stop]);
                assert_eq!(executor.advance(&world, me, &mut told), Ok(Progress::Idle));
                return;
            }
            other => panic!("{other:?} without a step"),
        }
        world.begin_step();
        world.finish_step();
    }
    panic!("it never gives up");
}

#[test]
fn who_sits_or_whose_goal_is_gone_is_told_at_once() {
    let mut world = World::new();
    let me = person(&mut world, 0.0, 0.0);
    let bench = thing(&mut world, EntityKind::Bench, 1.0, 0.0, Shape::cuboid(0.6, 1.8, 0.8));
    world.actuate(me, Action::SitDown { seat: bench }).expect("it is free");
    let mut executor = RuleExecutor::straight();
    let mut fail = |world: &World, plan: Plan| {
        executor.start(plan, world, me).expect("a sound plan");
        match executor.advance(world, me, &mut Vec::new()) {
            Ok(Progress::Failed { reason }) => reason,
            other => panic!("{other:?}"),
        }
    };
    assert!(fail(&world, to(20.0, 0.0)).contains("get up"));
    let nobody = Goal::Entity(EntityId::new(50, 0));
    assert!(fail(&world, Plan::navigate(nobody, 1.0)).contains("gone"));
}

#[test]
fn impossible_plans_and_settings_are_refused() {
    let mut world = World::new();
    let me = person(&mut world, 0.0, 0.0);
    let mut executor = RuleExecutor::straight();
    executor.start(to(5.0, 0.0), &world, me).expect("a sound plan");
    let goal = Goal::Point(Point3::new(1.0, 0.0, 0.0));
    for step in [
        PlanStep::Navigate { to: Goal::Point(Point3::new(f64::NAN, 0.0, 0.0)), within: 1.0, speed: None },
        PlanStep::Navigate { to: goal, within: f64::NAN, speed: None },
        PlanStep::Navigate { to: goal, within: 1.0, speed: Some(0.0) },
        PlanStep::Wait { seconds: f64::INFINITY },
    ] {
        let refused = executor.start(Plan { steps: vec![step.clone()] }, &world, me);
        assert!(matches!(refused, Err(ExecutorError::Unsupported { .. })), "{step:?} was taken");
    }
    assert!(!executor.is_idle(), "the plan under way goes on");
    let set = |change: fn(&mut ExecutorConfig)| {
        let mut config = ExecutorConfig::default();
        change(&mut config);
        RuleExecutor::with_config(None, config).map(|_| ()).expect_err("out of range").field
    };
    assert_eq!(set(|config| config.speed = f64::NAN), "speed");
    assert_eq!(set(|config| config.look_ahead = -1.0), "look_ahead");
    assert_eq!(set(|config| config.patience = 0.0), "patience");
    assert_eq!(set(|config| config.attempts = 5000), "attempts");
    assert_eq!(set(|config| config.kerb_patience = f64::INFINITY), "kerb_patience");
}

#[test]
fn a_saved_walk_goes_on_bit_for_bit() {
    let start = || {
        let mut world = World::new();
        let me = person(&mut world, 0.0, 0.0);
        thing(&mut world, EntityKind::Bench, 8.0, 0.1, Shape::cuboid(0.6, 1.8, 0.8));
        let plan = Plan { steps: vec![PlanStep::Wait { seconds: 1.0 }, to(20.0, 0.0).steps[0].clone()] };
        Walk::new(world, me, RuleExecutor::straight(), plan)
    };
    let digest = |executor: &RuleExecutor| {
        let mut hasher = simworld_core::hash::StateHasher::new();
        executor.state_hash(&mut hasher);
        hasher.finish()
    };
    let (mut straight, mut resumed) = (start(), start());
    for step in 0..250 {
        if [3, 40, 70].contains(&step) {
            let saved = resumed.executor.save();
            resumed.executor = RuleExecutor::straight();
            assert!(resumed.executor.restore(&saved));
        }
        assert_eq!(straight.step(), resumed.step());
        assert_eq!(straight.here(), resumed.here());
        assert_eq!(digest(&straight.executor), digest(&resumed.executor));
    }
    assert!(straight.here().x > 19.0);
    let saved = straight.executor.save();
    assert!(!RuleExecutor::straight().restore(&[0xff; 3]));
    assert!(RuleExecutor::straight().restore(&saved));
}
