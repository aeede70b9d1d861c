//! Hands hold what their strength says, and no more.
#![allow(clippy::unwrap_used)]

use crate::common::{PERSON, Stage, at};
use nalgebra::UnitQuaternion;
use simworld_core::action::{Action, StepDirection};
use simworld_core::environment::Environment;
use simworld_core::event::EventKind;
use simworld_core::geometry::{Point3, Pose, Twist, Vector3, pose_facing};
use simworld_core::id::EntityId;
use simworld_core::ops;
use simworld_core::scene::{EntityDesc, EntityKind, Scene, Shape};
use simworld_physics::robot::{Base, JointDescription, JointKind, LinkDescription, RobotDescription};
use simworld_physics::{Grip, Humanoid, HumanoidConfig, PhysicsError, Robot, RobotConfig, Turning};

const GRAVITY: f64 = 9.81;

/// A box of 0.2 m in the air before a person, who has hold of its upper side.
fn hanging(mass: f64, grip: Grip) -> (Stage, EntityId, EntityId) {
    let mut stage = Stage::new();
    let who = stage.person(at(0.0, 0.0, 0.0));
    let pose = pose_facing(Point3::new(0.6, 0.0, 0.8), 0.0);
    let desc = EntityDesc::new(EntityKind::Prop, pose, Shape::cuboid(0.2, 0.2, 0.2)).weighing(mass);
    let thing = stage.world.spawn(desc).unwrap();
    stage.physics.add_rigid(&stage.world, thing).unwrap();
    stage.physics.grasp(&stage.world, who, thing, Some(Point3::new(0.6, 0.0, 1.0)), grip).unwrap();
    (stage, who, thing)
}

fn broke(stage: &Stage) -> Option<f64> {
    stage.events.iter().find_map(|event| match event {
        EventKind::GraspBroke { force, .. } => Some(*force),
        _ => None,
    })
}

#[test]
fn a_hand_holds_what_weighs_less_than_its_strength_and_loses_what_weighs_more() {
    for strength in [20.0, 402.0, 5000.0] {
        let grip = Grip { strength, ..Grip::default() };
        for (share, holds) in [(0.5, true), (0.97, true), (1.03, false), (3.0, false)] {
            let mass = share * strength / GRAVITY;
            let (mut stage, who, thing) = hanging(mass, grip);
            stage.run(30);
            let held: Vec<_> = stage.physics.grasped(who).collect();
            if holds {
                assert_eq!(broke(&stage), None, "{share} of {strength} N");
                let [(held, force)] = held[..] else { panic!("{share} of {strength} N: {held:?}") };
                assert_eq!(held, thing);
                let weight = mass * GRAVITY;
                assert!((force - weight).abs() < 0.01 * weight, "{force} N of {weight} N");
                // The spring has given way by its share of what it may.
                let sunk = 0.8 - stage.position(thing).z;
                assert!((sunk - share * grip.give).abs() < 0.01, "{share}: {sunk} m");
            } else {
                let force = broke(&stage).unwrap_or_else(|| panic!("{share} of {strength} N held"));
                assert!(held.is_empty() && force > strength && force < 1.5 * strength, "{force} N");
                assert!(stage.position(thing).z < 0.01, "it lies: {}", stage.position(thing));
            }
        }
    }
}

#[test]
fn what_is_held_goes_where_the_hand_goes_until_it_is_let_go() {
    let (mut stage, who, thing) = hanging(5.0, Grip::default());
    stage.tell(who, Action::MoveForward { speed: 1.0 });
    stage.run(40);
    let ahead = stage.position(thing) - stage.position(who);
    assert!(stage.position(who).x > 3.0, "{}", stage.position(who));
    assert!((ahead.x - 0.6).abs() < 0.1 && ahead.y.abs() < 0.05 && ahead.z > 0.7, "{ahead}");
    stage.tell(who, Action::Rotate { angle: std::f64::consts::FRAC_PI_2 });
    stage.tell(who, Action::Stop);
    stage.run(2);
    stage.tell(who, Action::Rotate { angle: std::f64::consts::FRAC_PI_2 });
    stage.run(40);
    let aside = stage.position(thing) - stage.position(who);
    // It swings below the hand.
    assert!((aside.y - 0.6).abs() < 0.2 && aside.x.abs() < 0.2 && aside.z > 0.7, "{aside}");
    assert_eq!(stage.physics.let_go(who), 1);
    stage.run(20);
    assert!(stage.position(thing).z < 0.11, "{}", stage.position(thing));
    assert_eq!(broke(&stage), None);
    assert_eq!(stage.physics.let_go(who), 0);
}

#[test]
fn who_sits_falls_or_is_moved_away_lets_go() {
    let (mut stage, who, _) = hanging(5.0, Grip::default());
    stage.world.set_motion(who, at(30.0, 0.0, 0.0), Twist::ZERO).unwrap();
    stage.run(1);
    assert_eq!(stage.physics.grasped(who).count(), 0);

    let (mut stage, who, thing) = hanging(5.0, Grip::default());
    stage.world.remove(thing).unwrap();
    stage.run(1);
    assert_eq!(stage.physics.grasped(who).count(), 0);

    let (mut stage, who, thing) = hanging(5.0, Grip::default());
    stage.ball(Point3::new(-3.0, 0.0, 1.2), Vector3::new(12.0, 0.0, 1.0), 30.0);
    stage.run(10);
    assert!(stage.events.iter().any(|event| matches!(event, EventKind::Fell { .. })), "{:?}", stage.events);
    assert_eq!(stage.physics.grasped(who).count(), 0);
    let error = stage.physics.grasp(&stage.world, who, thing, None, Grip::default()).unwrap_err();
    assert!(error.to_string().contains("stand up"), "{error}");
}

#[test]
fn who_pulls_on_what_does_not_move_stays_there() {
    // 500 kg of concrete on asphalt rub with far more than somebody pulls, and less than his grip.
    let mut stage = Stage::new();
    let who = stage.person(at(0.0, 0.0, std::f64::consts::PI));
    let desc =
        EntityDesc::new(EntityKind::Prop, at(-0.9, 0.0, 0.0), Shape::cuboid(0.8, 0.8, 1.2)).weighing(500.0);
    let block = stage.world.spawn(desc).unwrap();
    stage.physics.add_rigid(&stage.world, block).unwrap();
    stage.physics.grasp(&stage.world, who, block, None, Grip::default()).unwrap();
    stage
        .world
        .actuate(
            who,
            Action::Step { direction: simworld_core::action::StepDirection::Backward, distance: 2.0 },
        )
        .unwrap();
    let mut hardest: f64 = 0.0;
    for _ in 0..40 {
        stage.step();
        hardest = stage.physics.grasped(who).map(|(_, force)| force).fold(hardest, f64::max);
    }
    assert!(broke(&stage).is_none(), "{:?}", stage.events);
    assert!((stage.position(block).x + 0.9).abs() < 0.01, "{}", stage.position(block));
    assert!(stage.position(who).x < 0.12, "no farther than the arms: {}", stage.position(who));
    assert!((150.0..260.0).contains(&hardest), "with 200 N at most: {hardest}");
}

#[test]
fn who_pushes_hard_on_ice_slips() {
    let falls = |temperature: f64| {
        let mut stage = Stage::new();
        let mut environment = Environment::default();
        (environment.weather.rain, environment.weather.temperature) = (1.0, temperature);
        stage.world.set_environment(environment).unwrap();
        let who = stage.person(at(0.0, 0.0, 0.0));
        let desc = EntityDesc::new(EntityKind::Prop, at(0.9, 0.0, 0.0), Shape::cuboid(0.8, 0.8, 1.2))
            .weighing(3000.0);
        let block = stage.world.spawn(desc).unwrap();
        stage.physics.add_rigid(&stage.world, block).unwrap();
        stage.physics.grasp(&stage.world, who, block, None, Grip::default()).unwrap();
        // So slowly that walking itself asks little of the ice.
        stage.tell(who, Action::MoveForward { speed: 0.2 });
        stage.run(30);
        stage.events.iter().any(|event| matches!(event, EventKind::Fell { .. }))
    };
    assert!(falls(-3.0) && !falls(10.0));
}

/// An arm of a metre on a stand 1 m high, with a motor of 200 N m.
fn arm(stage: &mut Stage) -> EntityId {
    let arm = LinkDescription::new("arm").with_mass(2.0, Vector3::new(0.5, 0.0, 0.0), [0.01, 0.2, 0.2]);
    let joint = JointDescription::new("shoulder", JointKind::Revolute, ["stand", "arm"]);
    let joint = joint.about(-Vector3::y()).within([-1.0, 1.0]).with_motor(200.0, 0.01);
    let links = vec![LinkDescription::new("stand"), arm];
    let description = RobotDescription {
        name: "arm".into(),
        base: Base::Fixed,
        links,
        joints: vec![joint],
        ..RobotDescription::default()
    };
    let pose = pose_facing(Point3::new(0.0, 0.0, 1.0), 0.0);
    let id = stage.spawn(EntityKind::Robot, pose, Shape::cuboid(0.2, 0.2, 0.2));
    stage.physics.add_robot(&stage.world, id, RobotConfig::from(description)).unwrap();
    id
}

#[test]
fn the_gripper_of_a_robot_lifts_a_thing_and_keeps_it_as_it_was() {
    let mut stage = Stage::new();
    let robot = arm(&mut stage);
    let lead = |stage: &mut Stage, angle: f64, steps: usize| {
        for _ in 0..steps {
            let body: &mut Robot = stage.physics.body_as_mut(robot).unwrap();
            let servo = body.servo(0, angle, 2.0);
            body.command(0, servo).unwrap();
            stage.step();
        }
    };
    lead(&mut stage, 0.0, 30);
    let tip = Point3::new(1.0, 0.0, 1.0);
    let pose = Pose::from_parts(Vector3::new(1.0, 0.0, 0.9).into(), UnitQuaternion::identity());
    let desc = EntityDesc::new(EntityKind::Prop, pose, Shape::cuboid(0.2, 0.1, 0.1)).weighing(2.0);
    let thing = stage.world.spawn(desc).unwrap();
    stage.physics.add_rigid(&stage.world, thing).unwrap();
    let grip =
        Grip { part: 1, strength: 200.0, turning: Turning::Firm { torque: 20.0 }, give: 0.01, reach: 1.5 };
    stage.physics.grasp(&stage.world, robot, thing, Some(tip), grip).unwrap();
    let start = stage.physics.body_as::<Robot>(robot).unwrap().reading(0).unwrap().angle;
    for step in 1..=20 {
        lead(&mut stage, 0.025 * f64::from(step), 2);
    }
    lead(&mut stage, 0.5, 20);
    assert!(broke(&stage).is_none(), "{:?}", stage.events);
    let angle = stage.physics.body_as::<Robot>(robot).unwrap().reading(0).unwrap().angle;
    let entity = stage.world.entity(thing).unwrap();
    let (rise, arm) = (entity.position().z - 0.9, ops::sin(angle) - ops::sin(start));
    assert!(angle > 0.2 && (rise - arm).abs() < 0.05, "from {start} to {angle} rad it is {rise} m up");
    // It turns with the gripper, and has given way by no more than that may.
    let ahead = entity.pose.rotation * Vector3::x();
    let tilt = ops::atan2(ahead.z, ahead.x);
    assert!((tilt - (angle - start)).abs() < 0.2, "{tilt} rad in a gripper at {angle} rad from {start}");
    stage.physics.let_go(robot);
    stage.run(20);
    assert!(stage.position(thing).z < 0.01, "{}", stage.position(thing));
}

#[test]
fn what_is_held_is_saved_and_goes_on_to_the_bit() {
    use simworld_core::hash::{StateHash, StateHasher};
    use simworld_core::seam::Dynamics;
    let digest = |stage: &Stage| {
        let mut hasher = StateHasher::new();
        stage.world.state_hash(&mut hasher);
        StateHash::state_hash(&stage.physics, &mut hasher);
        hasher.finish()
    };
    for at_step in [1, 7, 15] {
        let (mut stage, who, thing) = hanging(8.0, Grip::default());
        stage.tell(who, Action::MoveForward { speed: 1.3 });
        stage.run(at_step);
        let (world, saved) = (stage.world.clone(), stage.physics.save().unwrap());
        let mut other = Stage::new();
        other.world = world;
        other.physics.add_humanoid(&other.world, who, simworld_physics::HumanoidConfig::default()).unwrap();
        other.physics.add_rigid(&other.world, thing).unwrap();
        other.physics.restore(&other.world, &saved).unwrap();
        for _ in 0..20 {
            stage.step();
            other.step();
            assert_eq!(digest(&stage), digest(&other), "saved after {at_step} steps");
        }
        assert_eq!(other.physics.grasped(who).count(), 1);
    }
}

#[test]
fn holds_that_cannot_be_are_refused_with_the_reason() {
    let (mut stage, who, thing) = hanging(5.0, Grip::default());
    let wall = stage.building(5.0, 0.0, (1.0, 1.0, 1.0));
    let far = stage.ball(Point3::new(9.0, 0.0, 0.1), Vector3::zeros(), 1.0);
    let nobody = EntityId::new(77, 0);
    let idle = stage.spawn(EntityKind::Person, at(1.0, 3.0, 0.0), PERSON);
    stage.run(1);
    let mut refusal = |who, thing, at, grip| {
        stage.physics.grasp(&stage.world, who, thing, at, grip).unwrap_err().to_string()
    };
    let usual = Grip::default();
    assert!(refusal(who, thing, None, usual).contains("does so already"));
    assert!(refusal(who, far, None, usual).contains("reach"));
    assert!(refusal(who, wall, None, usual).contains("no body"));
    assert!(refusal(who, who, None, usual).contains("no free thing"));
    assert!(refusal(idle, thing, None, usual).contains("no body"));
    assert!(refusal(nobody, thing, None, usual).contains("there is no entity"));
    assert!(refusal(who, far, Some(Point3::new(f64::NAN, 0.0, 0.0)), usual).contains("not finite"));
    assert!(refusal(who, far, Some(Point3::new(1e300, 0.0, 0.0)), usual).contains("reach"));
    assert!(refusal(who, far, None, Grip { part: 3, ..usual }).contains("no such part"));
    for wild in [f64::NAN, f64::INFINITY, -1.0, 1e300] {
        for grip in [
            Grip { strength: wild, ..usual },
            Grip { turning: Turning::Firm { torque: wild }, ..usual },
            Grip { give: wild, ..usual },
            Grip { reach: wild, ..usual },
        ] {
            let error = stage.physics.grasp(&stage.world, who, far, None, grip).unwrap_err();
            assert!(matches!(error, PhysicsError::Config { config: "Grip", .. }), "{error}");
        }
    }
    stage.run(20);
    assert!(stage.position(thing).coords.norm().is_finite());
}

fn load(stage: &Stage, who: EntityId) -> f64 {
    stage.physics.body_as::<Humanoid>(who).unwrap().load()
}

#[test]
fn what_hangs_on_a_hand_slows_down_as_what_is_carried_does_and_what_stands_does_not() {
    let grip = Grip::both_hands();
    let (mut stage, who, _) = hanging(25.0, grip);
    stage.tell(who, Action::MoveForward { speed: 2.5 });
    stage.run(60);
    assert!((load(&stage, who) - 25.0).abs() < 0.5, "{} kg hang on it", load(&stage, who));
    let hung = stage.velocity(who).norm();
    let mut stage = Stage::new();
    let who = stage.person(at(0.0, 0.0, 0.0));
    let thing = EntityDesc::new(EntityKind::Parcel, at(0.6, 0.0, 0.0), Shape::cuboid(0.2, 0.2, 0.2));
    let item = stage.world.spawn(thing.weighing(25.0)).unwrap();
    stage.tell(who, Action::CarryHeavy { item });
    stage.tell(who, Action::MoveForward { speed: 2.5 });
    stage.run(60);
    let carried = stage.velocity(who).norm();
    assert!(carried < 2.3 && (hung / carried - 1.0).abs() < 0.02, "{hung} m/s, and {carried} if carried");
    let mut stage = Stage::new();
    let who = stage.person(at(0.0, 0.0, 0.0));
    let desc = EntityDesc::new(EntityKind::Prop, at(0.6, 0.0, 0.0), Shape::cuboid(0.4, 0.4, 1.0));
    let thing = stage.world.spawn(desc.weighing(25.0)).unwrap();
    stage.physics.add_rigid(&stage.world, thing).unwrap();
    stage.physics.grasp(&stage.world, who, thing, Some(Point3::new(0.5, 0.0, 1.0)), grip).unwrap();
    stage.run(20);
    assert!(load(&stage, who) < 0.5, "it stands by itself: {} kg", load(&stage, who));
}

/// Two who face one another with a box between them, 0.8 m up, that both hold; how hard each of them pushes and pulls, N.
fn two_with_a_box(mass: f64, forces: [f64; 2]) -> (Stage, [EntityId; 2], EntityId) {
    let mut stage = Stage::new();
    let pose = pose_facing(Point3::new(0.0, 0.0, 0.8), 0.0);
    let desc = EntityDesc::new(EntityKind::Prop, pose, Shape::cuboid(0.4, 0.4, 0.2)).weighing(mass);
    let thing = stage.world.spawn(desc).unwrap();
    stage.physics.add_rigid(&stage.world, thing).unwrap();
    let people = [-1.0, 1.0].map(|side| {
        let stands = at(0.7 * side, 0.0, if side < 0.0 { 0.0 } else { std::f64::consts::PI });
        let who = stage.world.spawn(EntityDesc::new(EntityKind::Person, stands, PERSON)).unwrap();
        let push_force = forces[usize::from(side > 0.0)];
        let config = HumanoidConfig { push_force, ..HumanoidConfig::default() };
        stage.physics.add_humanoid(&stage.world, who, config).unwrap();
        let place = Point3::new(0.2 * side, 0.0, 0.9);
        stage.physics.grasp(&stage.world, who, thing, Some(place), Grip::default()).unwrap();
        who
    });
    (stage, people, thing)
}

#[test]
fn a_thing_that_two_hold_weighs_half_on_each() {
    let (mut stage, people, thing) = two_with_a_box(16.0, [200.0; 2]);
    stage.run(30);
    for who in people {
        assert!((load(&stage, who) - 8.0).abs() < 0.2, "{} kg", load(&stage, who));
    }
    // They carry it sideways together.
    for (who, direction) in people.into_iter().zip([StepDirection::Left, StepDirection::Right]) {
        stage.tell(who, Action::Step { direction, distance: 2.0 });
    }
    stage.run(40);
    let there = stage.position(thing);
    assert!((there.y - 2.0).abs() < 0.1 && there.x.abs() < 0.1 && there.z > 0.7, "{there}");
    assert_eq!(broke(&stage), None);
    stage.physics.let_go(people[0]);
    stage.run(40);
    assert!((load(&stage, people[1]) - 16.0).abs() < 0.5, "all of it hangs on who still holds it");
    assert_eq!(load(&stage, people[0]), 0.0);
}

#[test]
fn a_thing_that_two_pull_at_goes_with_the_stronger_and_with_nobody_if_they_are_alike() {
    for (forces, goes) in [([200.0, 200.0], 0.0), ([200.0, 60.0], -1.0), ([60.0, 200.0], 1.0)] {
        let (mut stage, people, thing) = two_with_a_box(5.0, forces);
        for who in people {
            stage.tell(who, Action::Step { direction: StepDirection::Backward, distance: 3.0 });
        }
        stage.run(20);
        let there = stage.position(thing);
        if goes == 0.0 {
            assert!(there.x.abs() < 0.1, "{forces:?}: {there}");
        } else {
            assert!(there.x * goes > 0.5, "{forces:?}: {there}");
        }
        assert_eq!(broke(&stage), None, "{forces:?}");
        for who in people {
            let (_, force) = stage.physics.grasped(who).next().expect("both still hold it");
            // Beside the weight of a half.
            assert!(force > 50.0 && force < 260.0, "{forces:?}: {force} N");
        }
    }
}
