//! People lose their footing where people do, fall as bodies do, and get up.
#![allow(clippy::unwrap_used)]

use crate::common::{PERSON, Stage, at, ramp};
use simworld_core::action::Action;
use simworld_core::environment::Environment;
use simworld_core::event::EventKind;
use simworld_core::geometry::{Twist, Vector3};
use simworld_core::id::EntityId;
use simworld_core::ops;
use simworld_core::scene::{EntityDesc, EntityKind, FallCause, Footing, MATERIAL, Scene, Shape};
use simworld_physics::{HumanoidConfig, PhysicsConfig, Surefootedness, VehicleClass};

fn footing(stage: &Stage, who: EntityId) -> Footing {
    stage.world.entity(who).unwrap().footing()
}

fn falls(stage: &Stage, who: EntityId) -> Vec<FallCause> {
    let of = |event: &EventKind| match event {
        EventKind::Fell { who: fallen, cause } if *fallen == who => Some(*cause),
        _ => None,
    };
    stage.events.iter().filter_map(of).collect()
}

fn got_up(stage: &Stage, who: EntityId) -> bool {
    stage.events.contains(&EventKind::GotUp { who })
}

/// Ice on the ground, and on everything else.
fn freeze(stage: &mut Stage) {
    let mut environment = Environment::default();
    (environment.weather.rain, environment.weather.temperature) = (1.0, -3.0);
    stage.world.set_environment(environment).unwrap();
}

/// How upright the body is: the cosine of its tilt.
fn uprightness(stage: &Stage, who: EntityId) -> f64 {
    (stage.world.entity(who).unwrap().pose.rotation * Vector3::z()).z
}

#[test]
fn who_runs_into_a_kerb_of_forty_centimetres_trips_falls_and_gets_up() {
    let mut stage = Stage::new();
    stage.building(12.0, 0.0, (10.0, 8.0, 0.4));
    let runner = stage.person(at(0.0, 0.0, 0.0));
    stage.tell(runner, Action::MoveForward { speed: 2.5 });
    stage.run(24);
    assert_eq!(footing(&stage, runner), Footing::Upright, "6 m on the way to the kerb at 7 m");
    stage.run(8);
    assert_eq!(falls(&stage, runner), [FallCause::Tripped]);
    assert_eq!(footing(&stage, runner), Footing::Falling);
    let mut seen = vec![Footing::Falling];
    let mut lowest = 1.0f64;
    for _ in 0..150 {
        stage.step();
        let now = footing(&stage, runner);
        lowest = lowest.min(uprightness(&stage, runner));
        if seen.last() != Some(&now) {
            seen.push(now);
        }
        if now == Footing::Upright {
            break;
        }
    }
    assert_eq!(seen, [Footing::Falling, Footing::Down, Footing::Rising, Footing::Upright]);
    assert!(lowest < 0.5, "it lay: {lowest}");
    assert!(got_up(&stage, runner));
    assert!((uprightness(&stage, runner) - 1.0).abs() < 1e-6);
    let stood = stage.position(runner);
    stage.tell(runner, Action::Rotate { angle: std::f64::consts::PI });
    stage.run(10);
    stage.tell(runner, Action::MoveForward { speed: 1.0 });
    stage.run(20);
    assert!(stage.position(runner).x < stood.x - 1.0, "and walks on: {}", stage.position(runner));
}

#[test]
fn who_walks_into_the_kerb_stops() {
    let mut stage = Stage::new();
    stage.building(12.0, 0.0, (10.0, 8.0, 0.4));
    let walker = stage.person(at(4.0, 0.0, 0.0));
    stage.tell(walker, Action::MoveForward { speed: 1.34 });
    stage.run(60);
    let there = stage.position(walker);
    assert!(there.x > 6.7 && there.x < 6.76 && there.z.abs() < 0.01, "{there}");
    assert_eq!(falls(&stage, walker), []);
}

#[test]
fn who_runs_into_a_wall_is_stopped_and_stays_up_and_so_does_who_begins_to_run_at_the_kerb() {
    let mut stage = Stage::new();
    stage.building(12.0, 0.0, (10.0, 8.0, 3.0));
    let runner = stage.person(at(0.0, 0.0, 0.0));
    stage.tell(runner, Action::MoveForward { speed: 2.5 });
    stage.building(12.0, 20.0, (10.0, 8.0, 0.4));
    let beginner = stage.person(at(6.7, 20.0, 0.0));
    stage.tell(beginner, Action::MoveForward { speed: 2.5 });
    stage.run(60);
    assert_eq!((falls(&stage, runner), falls(&stage, beginner)), (vec![], vec![]));
}

#[test]
fn who_is_put_where_somebody_stands_comes_out_and_stays_up() {
    let mut stage = Stage::new();
    let (first, second) = (stage.person(at(0.0, 0.0, 0.0)), stage.person(at(0.1, 0.05, 0.0)));
    stage.tell(second, Action::MoveForward { speed: 1.2 });
    stage.run(30);
    assert_eq!((falls(&stage, first), falls(&stage, second)), (vec![], vec![]));
    assert!(stage.position(second).x > 2.0);
}

#[test]
fn who_is_unfailing_never_falls() {
    let mut stage = Stage::new();
    stage.building(12.0, 0.0, (10.0, 8.0, 0.4));
    freeze(&mut stage);
    let id = stage.spawn(EntityKind::Person, at(0.0, 0.0, 0.0), PERSON);
    let config = HumanoidConfig { balance: Surefootedness::Unfailing, ..HumanoidConfig::default() };
    stage.physics.add_humanoid(&stage.world, id, config).unwrap();
    stage.tell(id, Action::MoveForward { speed: 2.5 });
    stage.run(60);
    assert_eq!(falls(&stage, id), []);
    assert!(stage.position(id).x > 6.7);
}

#[test]
fn on_ice_one_slips_by_what_one_asks_of_it() {
    for (speed, slips) in [(0.4, false), (1.34, true), (2.5, true)] {
        let mut stage = Stage::new();
        freeze(&mut stage);
        let walker = stage.person(at(0.0, 0.0, 0.0));
        stage.run(5);
        assert_eq!(falls(&stage, walker), [], "who stands on level ice stands");
        stage.tell(walker, Action::MoveForward { speed });
        stage.run(30);
        let found = falls(&stage, walker);
        assert_eq!(found, if slips { vec![FallCause::Slipped] } else { vec![] }, "{speed} m/s");
    }
    // On dry ground the same people start and stop as they like.
    let mut stage = Stage::new();
    let walker = stage.person(at(0.0, 0.0, 0.0));
    for _ in 0..5 {
        stage.tell(walker, Action::MoveForward { speed: 2.5 });
        stage.run(10);
        stage.tell(walker, Action::Rotate { angle: 3.0 });
        stage.run(10);
        stage.tell(walker, Action::Stop);
        stage.run(5);
    }
    assert_eq!(falls(&stage, walker), []);
}

#[test]
fn who_has_slipped_goes_carefully_and_arrives() {
    let mut stage = Stage::new();
    freeze(&mut stage);
    let walker = stage.person(at(0.0, 0.0, 0.0));
    stage.tell(walker, Action::MoveForward { speed: 1.34 });
    stage.run(200);
    assert_eq!(falls(&stage, walker), [FallCause::Slipped], "once");
    assert!(stage.position(walker).x > 5.0, "{}", stage.position(walker));
    assert!((stage.velocity(walker).x - 1.34).abs() < 0.01);
}

#[test]
fn who_falls_on_an_icy_slope_slides_down_by_the_formula() {
    for degrees in [20f64, 25.0] {
        let mut stage = Stage::new();
        let slope = degrees.to_radians();
        let (sin, cos) = ops::sin_cos(slope);
        let (mut pose, _) = ramp(0.0, slope);
        // A hundred metres of it, and clothes of fabric on ice.
        let (length, thickness) = (100.0, 4.0);
        let edge = pose.rotation * Vector3::new(-length / 2.0, 0.0, thickness);
        pose.translation.vector = -edge;
        let desc = EntityDesc::new(EntityKind::Building, pose, Shape::cuboid(length, 40.0, thickness));
        stage.world.spawn(desc.with(MATERIAL, "ice")).unwrap();
        let height = 80.0 * sin;
        let mut start = at(80.0 * cos, 0.0, 0.0);
        start.translation.z = height + 0.25 * (sin / cos) + 0.03;
        let person = stage.person(start);
        stage.run(15);
        assert_eq!(falls(&stage, person), [FallCause::Slipped], "{degrees}°");
        // Once it lies, it gains speed by g (sin θ - μ cos θ): both are rubbed, so μ is their geometric mean.
        stage.run(15);
        let along = |stage: &Stage| {
            let momentum = stage.physics.momentum(person).unwrap() / 75.0;
            -(momentum.x * cos + momentum.z * sin)
        };
        let before = along(&stage);
        stage.run(10);
        let gained = along(&stage) - before;
        let friction = (0.05f64 * 0.5).sqrt();
        let expected = 9.81 * (sin - friction * cos);
        assert_eq!(footing(&stage, person), Footing::Falling);
        assert!((gained / expected - 1.0).abs() < 0.1, "{degrees}°: {gained} m/s in 1 s, not {expected}");
    }
}

#[test]
fn a_steep_slope_holds_dry_and_not_wet() {
    for (rain, slips) in [(0.0, false), (5.0, true)] {
        let mut stage = Stage::new();
        let (pose, shape) = ramp(0.0, 42f64.to_radians());
        stage.spawn(EntityKind::Building, pose, shape);
        let mut start = at(4.0, 0.0, 0.0);
        start.translation.z = 4.25 * ops::tan(42f64.to_radians()) + 0.03;
        let person = stage.person(start);
        let mut environment = Environment::default();
        environment.weather.rain = rain;
        stage.world.set_environment(environment).unwrap();
        stage.run(20);
        let found = falls(&stage, person);
        assert_eq!(found.first().copied(), slips.then_some(FallCause::Slipped), "rain of {rain} mm/h");
    }
}

#[test]
fn a_car_of_1500_kg_knocks_somebody_over_and_gives_the_momentum_that_it_loses() {
    let mut stage = Stage::new();
    let shape = Shape::cuboid(4.3, 1.8, 1.5);
    let mut desc = EntityDesc::new(EntityKind::Car, at(-4.0, 0.0, 0.0), shape).weighing(1500.0);
    desc.twist = Twist { linear: Vector3::x() * 10.0, angular: Vector3::zeros() };
    let car = stage.world.spawn(desc).unwrap();
    stage.physics.add_vehicle(&stage.world, car, VehicleClass::Sedan.parameters()).unwrap();
    let person = stage.person(at(0.0, 0.0, 0.0));
    stage.run(1);
    let before = stage.physics.momentum(car).unwrap().x;
    assert_eq!(falls(&stage, person), [], "a metre away");
    let mut steps = 0;
    while falls(&stage, person).is_empty() && steps < 10 {
        stage.run(1);
        steps += 1;
    }
    assert_eq!(falls(&stage, person), [FallCause::Struck]);
    let (lost, gained) =
        (before - stage.physics.momentum(car).unwrap().x, stage.physics.momentum(person).unwrap().x);
    // A plastic impact gives the person the speed that both have after it, as far as it is caught by its middle.
    let plastic = 75.0 * 10.0 * 1500.0 / 1575.0;
    assert!(gained > 0.5 * plastic && gained < 1.3 * plastic, "{gained} N s of {plastic}");
    // Meanwhile the ground and the air take some 250 N from the car, and the ground up to 400 N from the person.
    let others = 0.1 * f64::from(steps) * 650.0;
    assert!((lost - gained).abs() < 0.05 * gained + others, "{lost} N s lost and {gained} gained");
    stage.run(20);
    assert_ne!(footing(&stage, person), Footing::Upright);
    stage.run(200);
    assert!(got_up(&stage, person), "{:?}", footing(&stage, person));
}

#[test]
fn traffic_that_runs_into_somebody_knocks_it_over_and_slow_traffic_pushes_it_aside() {
    for (speed, struck) in [(1.0, false), (8.0, true)] {
        let mut stage = Stage::new();
        let car = stage.spawn(EntityKind::Car, at(-6.0, 0.0, 0.0), Shape::cuboid(4.3, 1.8, 1.5));
        let person = stage.person(at(0.0, 0.0, 0.0));
        for step in 1..=(80.0 / speed) as i32 {
            let pose = at(-6.0 + 0.1 * speed * f64::from(step), 0.0, 0.0);
            let twist = Twist { linear: Vector3::x() * speed, angular: Vector3::zeros() };
            stage.world.set_motion(car, pose, twist).unwrap();
            stage.step();
        }
        let expected = if struck { vec![FallCause::Struck] } else { vec![] };
        assert_eq!(falls(&stage, person), expected, "{speed} m/s");
        assert!(stage.position(person).x > 1.0, "{}", stage.position(person));
    }
}

#[test]
fn who_lies_uses_no_hands_and_is_carried_or_moved_as_anybody() {
    let mut stage = Stage::new();
    freeze(&mut stage);
    let person = stage.person(at(0.0, 0.0, 0.0));
    let chair = stage.spawn(EntityKind::Chair, at(0.5, 0.5, 0.0), Shape::cuboid(0.5, 0.5, 0.9));
    stage.tell(person, Action::MoveForward { speed: 2.0 });
    stage.run(8);
    assert_eq!(footing(&stage, person), Footing::Falling);
    let refused = stage.world.actuate(person, Action::SitDown { seat: chair }).unwrap_err().to_string();
    assert!(refused.contains("lying on the ground"), "{refused}");
    stage.world.set_motion(person, at(30.0, 0.0, 1.0), Twist::ZERO).unwrap();
    stage.run(1);
    let there = stage.position(person);
    assert_eq!(footing(&stage, person), Footing::Upright);
    assert!((there.x - 30.0).abs() < 0.3 && there.z.abs() < 0.05, "put on its feet elsewhere: {there}");
    stage.physics.remove(person).unwrap();
    stage.run(2);
}

#[test]
fn a_fall_is_the_same_after_saving_and_over_threads() {
    let run = |save_at: Option<usize>, parallel_threshold: usize| {
        let mut stage = Stage::with(PhysicsConfig { parallel_threshold, ..PhysicsConfig::default() });
        stage.building(12.0, 0.0, (10.0, 40.0, 0.4));
        let runners: Vec<_> =
            (0..6).map(|i| stage.person(at(f64::from(i) * 0.3, f64::from(i) * 1.2, 0.0))).collect();
        for who in &runners {
            stage.tell(*who, Action::MoveForward { speed: 2.5 });
        }
        let mut trail = Vec::new();
        for step in 0..120 {
            if save_at == Some(step) {
                let saved = simworld_core::seam::Dynamics::save(&stage.physics).unwrap();
                let mut fresh = simworld_physics::PhysicsDynamics::new(PhysicsConfig {
                    parallel_threshold,
                    ..PhysicsConfig::default()
                })
                .unwrap();
                for who in &runners {
                    fresh.add_humanoid(&stage.world, *who, HumanoidConfig::default()).unwrap();
                }
                simworld_core::seam::Dynamics::restore(&mut fresh, &stage.world, &saved).unwrap();
                stage.physics = fresh;
            }
            stage.step();
            let mut hasher = simworld_core::hash::StateHasher::new();
            simworld_core::hash::StateHash::state_hash(&stage.world, &mut hasher);
            simworld_core::hash::StateHash::state_hash(&stage.physics, &mut hasher);
            trail.push(hasher.finish());
        }
        assert!(!falls(&stage, runners[0]).is_empty());
        trail
    };
    let whole = run(None, usize::MAX);
    assert_eq!(run(None, usize::MAX), whole, "again");
    assert_eq!(run(None, 1), whole, "over threads");
    for step in [20, 30, 45, 60, 80] {
        assert_eq!(run(Some(step), usize::MAX), whole, "saved after {step} steps");
    }
}

/// Who goes over what is told at a speed, m/s, from some place short of it until it is well behind.
fn goes_over(build: impl Fn(&mut Stage), end: f64) {
    for speed in [0.8, 1.34, 2.0, 3.0, 4.5] {
        for start in 0..8 {
            let mut stage = Stage::new();
            build(&mut stage);
            let walker = stage.person(at(0.037 * f64::from(start), 0.0, 0.0));
            stage.tell(walker, Action::MoveForward { speed });
            let mut steps = 0;
            while stage.position(walker).x < end {
                stage.step();
                steps += 1;
                let there = stage.position(walker);
                assert!(falls(&stage, walker).is_empty(), "at {speed} m/s, start {start}, {there}");
                assert!(steps < 600, "at {speed} m/s it came to {there}");
            }
        }
    }
}

#[test]
fn nobody_falls_over_kerbs() {
    let kerbs = |stage: &mut Stage| {
        for kerb in 0..3 {
            stage.building(4.0 + 4.0 * f64::from(kerb), 0.0, (1.6, 4.0, 0.12));
        }
    };
    goes_over(kerbs, 15.0);
}

#[test]
fn nobody_falls_on_stairs() {
    let stairs = |stage: &mut Stage| {
        for step in 0..5 {
            let length = 4.2 - 0.6 * f64::from(step);
            stage.building(6.0, 0.0, (length, 4.0, 0.17 * f64::from(step + 1)));
        }
    };
    goes_over(stairs, 11.0);
}

#[test]
fn nobody_falls_at_the_foot_of_a_ramp() {
    let slope = |stage: &mut Stage| {
        let (pose, shape) = ramp(4.0, 0.14);
        stage.spawn(EntityKind::Prop, pose, shape);
    };
    goes_over(slope, 15.0);
}
