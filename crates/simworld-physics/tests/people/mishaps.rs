//! What befalls people beside tripping on foot: riders who fall, landings, loads, and what a fall takes along.

use crate::common::{PERSON, Stage, at};
use simworld_core::action::Action;
use simworld_core::environment::Environment;
use simworld_core::event::EventKind;
use simworld_core::geometry::{Point3, pose_facing};
use simworld_core::id::EntityId;
use simworld_core::scene::{EntityDesc, EntityKind, FallCause, Footing, Scene, Shape};
use simworld_physics::{Humanoid, PhysicsConfig};

fn causes(stage: &Stage, who: EntityId) -> Vec<FallCause> {
    let of = |event: &EventKind| match event {
        EventKind::Fell { who: fallen, cause } if *fallen == who => Some(*cause),
        _ => None,
    };
    stage.events.iter().filter_map(of).collect()
}

/// Somebody on a scooter, and the scooter.
fn rider(stage: &mut Stage) -> [EntityId; 2] {
    let person = stage.person(at(0.0, 0.0, 0.0));
    let scooter = stage.spawn(EntityKind::Scooter, at(0.8, 0.0, 0.0), Shape::cuboid(1.1, 0.5, 1.2));
    stage.tell(person, Action::RideScooter { scooter });
    stage.step();
    [person, scooter]
}

#[test]
fn a_rider_who_meets_a_kerb_of_forty_centimetres_falls_and_the_scooter_goes_on_alone() {
    let mut stage = Stage::new();
    stage.building(40.0, 0.0, (10.0, 8.0, 0.4));
    let [person, scooter] = rider(&mut stage);
    stage.tell(person, Action::MoveForward { speed: 6.0 });
    for _ in 0..100 {
        stage.step();
        if !causes(&stage, person).is_empty() {
            break;
        }
    }
    assert_eq!(causes(&stage, person), [FallCause::Tripped]);
    assert!(stage.position(person).x > 33.0, "{}", stage.position(person));
    let parted = stage.position(scooter);
    assert!(stage.world.entity(scooter).unwrap().attachment.is_none());
    assert!((parted - stage.position(person)).norm() < 1.5, "beside the rider: {parted}");
    stage.run(100);
    let [who, what] = [person, scooter].map(|id| stage.world.entity(id).unwrap());
    assert_eq!(who.footing(), Footing::Upright, "and is on its feet again");
    assert!(what.twist.linear.norm() < 0.05 && what.position().z > -0.05, "it lies still: {what:?}");
    let stood = who.position();
    stage.tell(person, Action::MoveForward { speed: 1.2 });
    stage.tell(person, Action::Rotate { angle: 3.0 });
    stage.run(40);
    let gone = (stage.position(person) - stood).norm();
    assert!(gone > 1.0, "and walks: {gone} m");
    assert_eq!(causes(&stage, person).len(), 1, "on its own feet it does not fall again");
}

#[test]
fn a_rider_keeps_up_on_low_kerbs_and_in_turns_and_slips_where_it_brakes_on_ice() {
    let mut stage = Stage::new();
    stage.building(40.0, 0.0, (10.0, 80.0, 0.12));
    let [person, _] = rider(&mut stage);
    stage.tell(person, Action::MoveForward { speed: 6.0 });
    stage.run(75);
    stage.tell(person, Action::Rotate { angle: 2.0 });
    stage.run(30);
    assert_eq!(causes(&stage, person), []);
    let mut environment = Environment::default();
    (environment.weather.rain, environment.weather.temperature) = (1.0, -3.0);
    stage.world.set_environment(environment).unwrap();
    stage.tell(person, Action::ChangeSpeed { speed: 0.0 });
    stage.run(20);
    assert_eq!(causes(&stage, person), [FallCause::Slipped]);
}

#[test]
fn from_a_metre_one_lands_on_the_feet_and_from_three_one_falls() {
    for (height, expected) in [(1.0, vec![]), (1.2, vec![]), (3.0, vec![FallCause::Landed])] {
        let mut stage = Stage::new();
        let person = stage.person(pose_facing(Point3::new(0.0, 0.0, height), 0.0));
        stage.run(100);
        assert_eq!(causes(&stage, person), expected, "from {height} m");
        let entity = stage.world.entity(person).unwrap();
        assert_eq!(entity.footing(), Footing::Upright);
        assert!(entity.position().z.abs() < 0.01, "it stands on the ground: {}", entity.position());
    }
}

#[test]
fn who_carries_much_runs_slower_and_walks_as_told() {
    let reached = |load: f64, speed: f64| {
        let mut stage = Stage::new();
        let person = stage.person(at(0.0, 0.0, 0.0));
        if load > 0.0 {
            let thing = EntityDesc::new(EntityKind::Parcel, at(0.6, 0.0, 0.0), Shape::cuboid(0.3, 0.3, 0.3));
            let item = stage.world.spawn(thing.weighing(load)).unwrap();
            stage.tell(person, Action::CarryHeavy { item });
            stage.step();
        }
        stage.tell(person, Action::MoveForward { speed });
        stage.run(30);
        let body: &Humanoid = stage.physics.body_as(person).unwrap();
        assert_eq!(body.load(), load, "it feels what it carries");
        stage.velocity(person).norm()
    };
    assert!((reached(0.0, 2.5) - 2.5).abs() < 1e-6);
    assert!((reached(20.0, 1.34) - 1.34).abs() < 1e-6, "no more than walking empty-handed at the top speed");
    let [light, heavy] = [2.0, 20.0].map(|load| reached(load, 2.5));
    assert!(light > 2.3 && light < 2.5, "{light}");
    // What 95 kg cost at that speed is what 75 kg cost at 2.5 m/s: that of a slower run, or of the fastest walk.
    assert!(heavy > 1.8 && heavy < 2.2, "{heavy}");
}

#[test]
fn who_falls_keeps_its_velocity() {
    let mut stage = Stage::with(PhysicsConfig { substeps: 1, ..PhysicsConfig::default() });
    let desc = EntityDesc::new(EntityKind::Person, at(0.0, 0.0, 0.0), PERSON).weighing(80.0);
    let person = stage.world.spawn(desc).unwrap();
    stage.physics.add_humanoid(&stage.world, person, simworld_physics::HumanoidConfig::default()).unwrap();
    stage.tell(person, Action::MoveForward { speed: 2.5 });
    for _ in 0..180 {
        stage.tick(1.0 / 60.0);
    }
    let mut environment = Environment::default();
    (environment.weather.rain, environment.weather.temperature) = (1.0, -3.0);
    stage.world.set_environment(environment).unwrap();
    stage.tell(person, Action::Stop);
    let fell = |stage: &Stage| stage.world.entity(person).unwrap().footing() == Footing::Falling;
    for _ in 0..60 {
        stage.tick(1.0 / 60.0);
        if fell(&stage) {
            break;
        }
    }
    assert!(fell(&stage), "a sudden stop on ice");
    let momentum = stage.physics.momentum(person).unwrap();
    let speed = momentum.x / 80.0;
    assert!(speed > 2.2 && speed < 2.55, "its limbs go on together at what it ran: {speed} m/s");
    assert!(momentum.y.abs() < 1.0, "{momentum}");
}

#[test]
fn who_crouches_goes_under_a_bar_slowly_and_stands_up_behind_it() {
    let reached = |low: bool| {
        let mut stage = Stage::new();
        // Free below 1.35 m.
        let bar = pose_facing(Point3::new(3.0, 0.0, 1.35), 0.0);
        stage.spawn(EntityKind::Building, bar, Shape::cuboid(1.0, 6.0, 1.0));
        let person = stage.person(at(0.0, 0.0, 0.0));
        if low {
            stage.tell(person, Action::Crouch);
        }
        stage.tell(person, Action::MoveForward { speed: 1.34 });
        stage.run(30);
        (stage, person)
    };
    let (stage, upright) = reached(false);
    assert!((stage.position(upright).x - 2.23).abs() < 0.02, "stopped: {}", stage.position(upright));
    let (mut stage, person) = reached(true);
    let under = stage.position(person);
    assert!((under.x - 3.0).abs() < 0.1, "a metre a second: {under}");
    let joints = *stage.world.joints(person).unwrap();
    assert!(joints.left_leg.knee_flexion > 1.0 && joints.hip_drop > 0.4, "on bent knees: {joints:?}");
    stage.tell(person, Action::StandUp);
    stage.step();
    let is_low = |stage: &Stage| {
        let low = stage.physics.body_as::<Humanoid>(person).unwrap().is_crouched();
        assert_eq!(stage.world.entity(person).unwrap().is_crouched(), low, "others see it");
        low
    };
    assert!(is_low(&stage), "the bar is above it");
    stage.run(30);
    assert!(!is_low(&stage) && stage.position(person).x > 5.5, "{}", stage.position(person));
    assert_eq!(causes(&stage, person), []);
}
