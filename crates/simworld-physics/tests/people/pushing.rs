//! People push what is light, make room for who pushes, and are carried by what they stand on.
#![allow(clippy::unwrap_used)]

use crate::common::{PERSON, Stage, at};
use simworld_core::action::Action;
use simworld_core::environment::Environment;
use simworld_core::event::EventKind;
use simworld_core::geometry::{Point3, Twist, Vector3, pose_facing, yaw_of};
use simworld_core::id::EntityId;
use simworld_core::scene::{EntityDesc, EntityKind, MATERIAL, Scene, Shape};
use simworld_physics::VehicleClass;

fn crate_of(stage: &mut Stage, mass: f64) -> EntityId {
    let desc = EntityDesc::new(EntityKind::Prop, at(2.0, 0.0, 0.0), Shape::cuboid(0.8, 0.8, 0.8));
    let id = stage.world.spawn(desc.weighing(mass).with(MATERIAL, "wood")).unwrap();
    stage.physics.add_rigid(&stage.world, id).unwrap();
    id
}

fn fell(stage: &Stage) -> bool {
    stage.events.iter().any(|event| matches!(event, EventKind::Fell { .. }))
}

#[test]
fn a_light_crate_is_pushed_along_and_a_heavy_one_stays() {
    // Wood on asphalt rubs with 0.53: 200 N move up to 38 kg.
    for (mass, moves) in [(10.0, true), (30.0, true), (60.0, false), (200.0, false)] {
        let mut stage = Stage::new();
        let crate_ = crate_of(&mut stage, mass);
        let walker = stage.person(at(0.0, 0.0, 0.0));
        stage.tell(walker, Action::MoveForward { speed: 1.0 });
        stage.run(80);
        let (pushed, there) = (stage.position(crate_), stage.position(walker));
        assert!(there.x < pushed.x - 0.4 - 0.25 + 0.01, "{mass} kg: {there} behind {pushed}");
        assert!(pushed.y.abs() < 0.1 && pushed.z.abs() < 0.01, "{mass} kg stands as it stood: {pushed}");
        if moves {
            assert!(pushed.x > 4.0, "{mass} kg: {pushed}");
        } else {
            assert!((pushed.x - 2.0).abs() < 0.01, "{mass} kg: {pushed}");
        }
    }
}

#[test]
fn what_is_pushed_goes_no_faster_than_who_pushes() {
    let mut stage = Stage::new();
    let crate_ = crate_of(&mut stage, 5.0);
    let walker = stage.person(at(0.0, 0.0, 0.0));
    stage.tell(walker, Action::MoveForward { speed: 1.0 });
    for _ in 0..60 {
        stage.step();
        assert!(stage.velocity(crate_).x < 1.1, "{}", stage.velocity(crate_));
    }
    stage.tell(walker, Action::Stop);
    stage.run(20);
    assert!(stage.velocity(crate_).norm() < 0.01, "let alone, it stops");
}

#[test]
fn a_crate_that_is_too_heavy_on_asphalt_is_pushed_on_ice() {
    let mut stage = Stage::new();
    let mut environment = Environment::default();
    (environment.weather.rain, environment.weather.temperature) = (1.0, -3.0);
    stage.world.set_environment(environment).unwrap();
    let crate_ = crate_of(&mut stage, 60.0);
    let walker = stage.person(at(0.0, 0.0, 0.0));
    stage.tell(walker, Action::MoveForward { speed: 0.5 });
    stage.run(100);
    assert!(stage.position(crate_).x > 3.0, "{}", stage.position(crate_));
    assert!(!fell(&stage));
}

#[test]
fn nobody_pushes_a_parked_car_away() {
    let mut stage = Stage::new();
    let car = stage.spawn(EntityKind::Car, at(4.0, 0.0, 0.0), Shape::cuboid(4.3, 1.8, 1.5));
    stage.physics.add_vehicle(&stage.world, car, VehicleClass::Sedan.parameters()).unwrap();
    let walker = stage.person(at(0.0, 0.0, 0.0));
    stage.tell(walker, Action::MoveForward { speed: 1.0 });
    stage.run(100);
    assert!((stage.position(car).x - 4.0).abs() < 0.05, "{}", stage.position(car));
}

#[test]
fn who_stands_makes_room_for_who_walks_and_who_walks_holds_his_own() {
    let mut stage = Stage::new();
    let (walker, stander) = (stage.person(at(0.0, 0.0, 0.0)), stage.person(at(2.0, 0.0, 0.0)));
    stage.tell(walker, Action::MoveForward { speed: 1.0 });
    stage.run(80);
    let (behind, before) = (stage.position(walker), stage.position(stander));
    assert!(behind.x > 5.0 && behind.y.abs() < 0.3, "{behind}");
    assert!(before.x > 2.05 && before.x < 3.5 && before.y.abs() > 0.2, "aside: {before}");
    let mut stage = Stage::new();
    let (a, b) = (stage.person(at(-2.0, 0.0, 0.0)), stage.person(at(2.0, 0.0, std::f64::consts::PI)));
    for who in [a, b] {
        stage.tell(who, Action::MoveForward { speed: 1.0 });
    }
    stage.run(30);
    assert!(
        stage.position(a).x > -0.5 && stage.position(a).x < 0.0,
        "neither gives way: {}",
        stage.position(a)
    );
    assert!(
        stage.position(b).x < 0.5 && stage.position(b).x > 0.0,
        "neither gives way: {}",
        stage.position(b)
    );
    assert!(!fell(&stage));
}

#[test]
fn nobody_is_pushed_into_a_wall() {
    let mut stage = Stage::new();
    stage.building(3.5, 0.0, (1.0, 10.0, 3.0));
    let (walker, stander) = (stage.person(at(0.0, 0.0, 0.0)), stage.person(at(2.4, 0.0, 0.0)));
    stage.tell(walker, Action::MoveForward { speed: 1.5 });
    stage.run(80);
    assert!(stage.position(stander).x < 2.75, "{}", stage.position(stander));
    assert!((stage.position(stander) - stage.position(walker)).norm() > 0.499);
}

/// Moves something by a velocity, m/s, for so many steps.
fn carry(stage: &mut Stage, id: EntityId, velocity: Vector3, steps: usize) {
    for _ in 0..steps {
        let mut pose = *stage.world.entity(id).unwrap().pose;
        pose.translation.vector += velocity * 0.1;
        stage.world.set_motion(id, pose, Twist { linear: velocity, angular: Vector3::zeros() }).unwrap();
        stage.step();
    }
}

#[test]
fn a_lift_carries_who_stands_on_it_up_and_down() {
    let mut stage = Stage::new();
    let lift = stage.spawn(EntityKind::Prop, at(0.0, 0.0, 0.0), Shape::cuboid(3.0, 3.0, 0.2));
    let person = stage.person(pose_facing(Point3::new(0.3, -0.4, 0.2), 0.0));
    stage.run(3);
    for speed in [0.5, 1.0, -1.0, -0.5] {
        carry(&mut stage, lift, Vector3::z() * speed, 30);
        let (floor, there) = (stage.position(lift).z + 0.2, stage.position(person));
        assert!((there.z - floor).abs() < 0.06, "at {speed} m/s: {there} on {floor}");
        assert!((there.x - 0.3).abs() < 0.01 && (there.y + 0.4).abs() < 0.01, "{there}");
    }
    carry(&mut stage, lift, Vector3::zeros(), 5);
    let (floor, there) = (stage.position(lift).z + 0.2, stage.position(person));
    assert!((there.z - floor).abs() < 1e-3, "{there} on {floor}");
    assert!(!fell(&stage));
}

#[test]
fn a_truck_carries_who_stands_on_its_bed_and_who_walks_there_walks_on_it() {
    let mut stage = Stage::new();
    let truck = stage.spawn(EntityKind::Truck, at(0.0, 0.0, 0.0), Shape::cuboid(9.0, 2.4, 1.0));
    let (stander, walker) = (
        stage.person(pose_facing(Point3::new(-2.0, 0.0, 1.0), 0.0)),
        stage.person(pose_facing(Point3::new(-1.0, 0.6, 1.0), 0.0)),
    );
    stage.run(3);
    let mut speed = 0.0;
    while speed < 8.0 {
        speed += 0.1;
        carry(&mut stage, truck, Vector3::x() * speed, 1);
    }
    stage.tell(walker, Action::MoveForward { speed: 0.5 });
    carry(&mut stage, truck, Vector3::x() * speed, 40);
    stage.tell(walker, Action::Stop);
    while speed > 1e-9 {
        speed -= 0.1;
        carry(&mut stage, truck, Vector3::x() * speed, 1);
    }
    stage.run(5);
    let on_truck = |who| stage.position(who) - stage.position(truck);
    assert!(!fell(&stage), "at 1 m/s² everybody stays up");
    assert!((on_truck(stander) - Vector3::new(-2.0, 0.0, 1.0)).norm() < 0.05, "{}", on_truck(stander));
    assert!((on_truck(walker) - Vector3::new(1.0, 0.6, 1.0)).norm() < 0.1, "{}", on_truck(walker));
}

#[test]
fn who_stands_on_a_truck_that_stops_dead_falls() {
    let mut stage = Stage::new();
    let truck = stage.spawn(EntityKind::Truck, at(0.0, 0.0, 0.0), Shape::cuboid(9.0, 2.4, 1.0));
    let _stander = stage.person(pose_facing(Point3::new(-2.0, 0.0, 1.0), 0.0));
    stage.run(3);
    let mut speed = 0.0;
    while speed < 8.0 {
        speed += 0.1;
        carry(&mut stage, truck, Vector3::x() * speed, 1);
    }
    assert!(!fell(&stage));
    carry(&mut stage, truck, Vector3::zeros(), 5);
    assert!(fell(&stage));
}

#[test]
fn a_turntable_turns_who_stands_on_it() {
    let mut stage = Stage::new();
    let table =
        stage.spawn(EntityKind::Prop, at(0.0, 0.0, 0.0), Shape::Cylinder { radius: 3.0, height: 0.2 });
    let person = stage.spawn(EntityKind::Person, pose_facing(Point3::new(1.0, 0.0, 0.2), 0.0), PERSON);
    stage.physics.add_humanoid(&stage.world, person, simworld_physics::HumanoidConfig::default()).unwrap();
    stage.run(3);
    let rate = 0.5;
    for step in 1..=40 {
        let twist = Twist { linear: Vector3::zeros(), angular: Vector3::z() * rate };
        stage.world.set_motion(table, at(0.0, 0.0, rate * 0.1 * f64::from(step)), twist).unwrap();
        stage.step();
    }
    let pose = stage.world.entity(person).unwrap().pose;
    assert!((yaw_of(pose) - 2.0).abs() < 0.06, "{}", yaw_of(pose));
    let there = stage.position(person);
    assert!((there.coords.xy().norm() - 1.0).abs() < 0.05, "{there}");
    assert!((simworld_core::ops::atan2(there.y, there.x) - 2.0).abs() < 0.08, "{there}");
}
