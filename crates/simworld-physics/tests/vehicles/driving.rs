//! A car accelerates, brakes, stops and steers.
#![allow(clippy::unwrap_used)]

use crate::common::{Stage, at};
use simworld_core::action::Action;
use simworld_core::geometry::yaw_of;
use simworld_core::id::EntityId;
use simworld_core::scene::{EntityKind, Scene, Shape};
use simworld_physics::{PhysicsConfig, VehicleClass};

fn parked(substeps: u32) -> (Stage, EntityId) {
    let mut stage = Stage::with(PhysicsConfig { substeps, ..PhysicsConfig::default() });
    let car = stage.spawn(EntityKind::Car, at(0.0, 0.0, 0.0), Shape::cuboid(4.3, 1.8, 1.5));
    stage.physics.add_vehicle(&stage.world, car, VehicleClass::Sedan.parameters()).unwrap();
    (stage, car)
}

#[test]
fn a_parked_car_stands_on_its_wheels() {
    for substeps in [2, 6] {
        let (mut stage, car) = parked(substeps);
        stage.run(50);
        let there = stage.position(car);
        assert!(there.coords.norm() < 0.03, "{substeps} substeps: {there}");
    }
}

#[test]
fn a_car_accelerates_brakes_and_stops() {
    for substeps in [2, 6] {
        let (mut stage, car) = parked(substeps);
        stage.run(10);
        stage.tell(car, Action::Throttle { level: 1.0 });
        stage.run(30);
        let speed = stage.velocity(car).x;
        // First gear gives 8.2 kN to 1392 kg until 11.7 m/s: 5.9 m/s² less slip and drag, then second 4.5 kN.
        assert!(speed > 11.5 && speed < 14.5, "{substeps} substeps: {speed} m/s");
        stage.tell(car, Action::Brake { level: 1.0 });
        let start = stage.position(car).x;
        stage.run(40);
        assert!(stage.velocity(car).norm() < 0.05, "{substeps} substeps: {}", stage.velocity(car));
        let distance = stage.position(car).x - start;
        let ideal = speed * speed / (2.0 * 10.0); // about 1 g on good tyres
        assert!(distance > 0.8 * ideal && distance < 1.5 * ideal, "{substeps}: {distance} m, {ideal} m");
        let up = stage.world.entity(car).unwrap().pose.rotation * simworld_core::geometry::Vector3::z();
        assert!(up.z > 0.99, "it did not somersault");
        let stopped = stage.position(car);
        stage.run(20);
        assert!((stage.position(car) - stopped).norm() < 0.02, "it stays where it stopped");
    }
}

#[test]
fn positive_steering_turns_left() {
    let (mut stage, car) = parked(6);
    stage.tell(car, Action::Throttle { level: 0.4 });
    stage.run(20);
    stage.tell(car, Action::Throttle { level: 0.0 });
    stage.tell(car, Action::Steer { angle: 0.2 });
    stage.run(15);
    let entity = stage.world.entity(car).unwrap();
    assert!(yaw_of(entity.pose) > 0.2, "{}", yaw_of(entity.pose));
    assert!(entity.position().y > 0.3, "{}", entity.position());
    // The radius of the bicycle model: wheelbase / tan(angle) = 2.58 / 0.203 = 12.7 m.
    let radius = entity.twist.ground_speed() / entity.twist.angular.z;
    assert!(radius > 9.0 && radius < 19.0, "{radius}");
}

#[test]
fn reverse_goes_backward_and_slowly() {
    let (mut stage, car) = parked(2);
    stage.run(30);
    stage.tell(car, Action::Throttle { level: -0.5 });
    stage.run(60);
    let speed = stage.velocity(car).x;
    assert!(speed < -3.0 && speed > -5.5, "{speed}");
}

#[test]
fn a_wall_stops_a_car_and_the_blow_is_reported() {
    let (mut stage, car) = parked(6);
    stage.building(15.0, 0.0, (2.0, 20.0, 5.0));
    stage.tell(car, Action::Throttle { level: 1.0 });
    stage.run(60);
    let x = stage.position(car).x;
    assert!(x + 2.15 < 14.05, "{x}");
    assert!(!stage.contacts.is_empty());
}
