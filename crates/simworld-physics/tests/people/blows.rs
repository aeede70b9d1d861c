//! Blows: who runs into whom, how hard, and that momentum is kept.
#![allow(clippy::unwrap_used)]

use crate::common::{Stage, at};
use simworld_core::event::EventKind;
use simworld_core::geometry::{Point3, Twist, Vector3, pose_facing};
use simworld_core::id::EntityId;
use simworld_core::scene::{EntityDesc, EntityKind, Shape};
use simworld_physics::{PhysicsConfig, VehicleClass};

fn car(stage: &mut Stage, x: f64, speed: f64, mass: f64) -> EntityId {
    let shape = Shape::cuboid(4.3, 1.8, 1.5);
    let mut desc = EntityDesc::new(EntityKind::Car, at(x, 0.0, 0.0), shape).weighing(mass);
    desc.twist = Twist { linear: Vector3::x() * speed, angular: Vector3::zeros() };
    let id = stage.world.spawn(desc).unwrap();
    stage.physics.add_vehicle(&stage.world, id, VehicleClass::Sedan.parameters()).unwrap();
    id
}

fn impulses(stage: &Stage, pair: (EntityId, EntityId)) -> Vec<(f64, f64)> {
    let of_pair = stage.contacts.iter().filter_map(|event| match event {
        EventKind::Contact { a, b, closing_speed, impulse, .. } if (*a, *b) == pair => {
            Some((*closing_speed, *impulse))
        }
        _ => None,
    });
    of_pair.collect()
}

/// A person of 75 kg as a free body, knocked by 1500 kg at 10 m/s: what the one loses the other gains, and the event
/// says how much.
#[test]
fn a_car_of_1500_kg_gives_a_person_the_momentum_that_it_loses() {
    // Without gravity, springs and tyres carry nothing: only the blow acts.
    let mut stage = Stage::with(PhysicsConfig { gravity: 0.0, substeps: 12, ..PhysicsConfig::default() });
    let car = car(&mut stage, -3.0, 10.0, 1500.0);
    let middle = 0.54 - 0.875; // the middle of the person at the height of the car's centre of mass
    let person = Shape::Capsule { radius: 0.25, height: 1.75 };
    let pose = pose_facing(Point3::new(0.0, 0.0, middle + 1.0), 0.0);
    let desc = EntityDesc::new(EntityKind::Person, pose, person).weighing(75.0);
    let person = stage.world.spawn(desc).unwrap();
    stage.physics.add_rigid(&stage.world, person).unwrap();
    let momentum = |stage: &Stage| {
        let state = stage.physics.state(person).unwrap();
        let arm = state.pose.rotation * Vector3::z() * 0.875;
        let struck = (state.twist.linear + state.twist.angular.cross(&arm)).x;
        (1500.0 * stage.velocity(car).x, 75.0 * struck)
    };
    let before = momentum(&stage);
    assert!((before.0 - 15_000.0).abs() < 1e-9 && before.1 == 0.0);
    for _ in 0..3 {
        stage.step();
    }
    let after = momentum(&stage);
    let (lost, gained) = (before.0 - after.0, after.1);
    assert!(gained > 600.0, "knocked away: {gained} N s");
    // The drag of the air takes 40 N for 0.3 s from the car.
    assert!((lost - gained).abs() < 0.03 * gained + 15.0, "{lost} N s lost and {gained} gained");
    let blows = impulses(&stage, (car, person));
    assert_eq!(blows.len(), 1, "{blows:?}");
    let (speed, impulse) = blows[0];
    assert!((speed - 10.0).abs() < 0.1, "{speed} m/s");
    assert!((impulse / gained - 1.0).abs() < 0.1, "the event says {impulse} N s, gained {gained}");
}

#[test]
fn a_car_that_runs_into_a_standing_one_shares_its_momentum_and_a_wall_takes_all() {
    let mut stage = Stage::with(PhysicsConfig { substeps: 12, ..PhysicsConfig::default() });
    let (striking, struck) = (car(&mut stage, -6.0, 12.0, 1200.0), car(&mut stage, 0.0, 0.0, 1800.0));
    stage.run(3);
    let (a, b) = (stage.velocity(striking).x, stage.velocity(struck).x);
    let total = 1200.0 * a + 1800.0 * b;
    // 1200 * 12 = 14 400 N s, less what rolling and air take in 0.3 s.
    assert!((total / 14_400.0 - 1.0).abs() < 0.03, "{total} N s");
    assert!(b > 4.5 && b >= a - 0.1, "the struck car is pushed on: {a} and {b} m/s");
    let blows = impulses(&stage, (striking, struck));
    assert!((blows[0].1 / (1800.0 * b) - 1.0).abs() < 0.1, "{blows:?}, {b} m/s");

    let mut stage = Stage::with(PhysicsConfig { substeps: 12, ..PhysicsConfig::default() });
    let wall = stage.building(6.0, 0.0, (2.0, 20.0, 5.0));
    let striking = car(&mut stage, 0.0, 12.0, 1200.0);
    stage.run(5);
    assert!(stage.velocity(striking).x < 1.5, "{}", stage.velocity(striking));
    let blows = impulses(&stage, (wall, striking));
    assert!(blows[0].1 > 0.9 * 14_000.0 && blows[0].1 < 1.25 * 14_400.0, "{blows:?}");
}
