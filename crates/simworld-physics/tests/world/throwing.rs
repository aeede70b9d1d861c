//! What is thrown flies as projectiles do, and is what it was.
#![allow(clippy::unwrap_used)]

use crate::common::{Stage, at};
use simworld_core::action::Action;
use simworld_core::geometry::Vector3;
use simworld_core::id::EntityId;
use simworld_core::ops;
use simworld_core::scene::{EntityDesc, EntityKind, Role, Scene, Shape};
use simworld_physics::PhysicsError;

/// Somebody with a parcel of a kilogram in the hand.
fn with_parcel() -> (Stage, EntityId, EntityId) {
    let mut stage = Stage::new();
    let who = stage.person(at(0.0, 0.0, 0.0));
    let desc = EntityDesc::new(EntityKind::Parcel, at(0.5, 0.0, 0.0), Shape::cuboid(0.2, 0.15, 0.1));
    let parcel = stage.world.spawn(desc.weighing(1.0)).unwrap();
    stage.tell(who, Action::PickUp { item: parcel });
    stage.run(2);
    assert_eq!(stage.world.attached(who, Role::Held), Some(parcel));
    (stage, who, parcel)
}

#[test]
fn what_is_thrown_comes_down_where_the_formula_says() {
    for degrees in [0.0, 30.0, 60.0_f64] {
        let (mut stage, who, parcel) = with_parcel();
        let (sin, cos) = ops::sin_cos(degrees.to_radians());
        let thrown =
            stage.physics.throw(&mut stage.world, who, Vector3::new(9.0 * cos, 0.0, 9.0 * sin)).unwrap();
        assert_eq!(thrown, parcel);
        let from = stage.position(parcel);
        let rise = 9.0 * sin;
        // Down to its own underside on the ground: h + w t - g t² / 2 = 0.
        let time = (rise + (rise * rise + 2.0 * 9.81 * from.z).sqrt()) / 9.81;
        let (mut last, mut passed) = (from, 0.0);
        loop {
            stage.tick(0.01);
            let now = stage.position(parcel);
            if now.z < 0.02 || stage.velocity(parcel).x < 0.9 * 9.0 * cos {
                break;
            }
            (last, passed) = (now, passed + 0.01);
            assert!(passed < 5.0);
        }
        let range = last.x - from.x;
        let formula = 9.0 * cos * time;
        assert!((range - formula).abs() < 0.25, "at {degrees}°: {range} m, not {formula} m");
    }
}

#[test]
fn it_takes_the_velocity_of_who_throws_it_along() {
    let (mut stage, who, parcel) = with_parcel();
    stage.tell(who, Action::MoveForward { speed: 1.4 });
    stage.run(10);
    stage.physics.throw(&mut stage.world, who, Vector3::new(3.0, 0.0, 1.0)).unwrap();
    assert!((stage.velocity(parcel).x - 4.4).abs() < 0.05, "{}", stage.velocity(parcel));
    assert!(stage.world.attached(who, Role::Held).is_none());
}

#[test]
fn it_lies_there_and_is_picked_up_and_thrown_again() {
    let (mut stage, who, parcel) = with_parcel();
    stage.physics.throw(&mut stage.world, who, Vector3::new(1.0, 0.0, 0.0)).unwrap();
    stage.run(50);
    let lies = stage.position(parcel);
    assert!(lies.z < 0.1 && stage.velocity(parcel).norm() < 0.05, "{lies}");
    let walk = lies.x - 0.5;
    stage.tell(who, Action::MoveForward { speed: 1.0 });
    while stage.position(who).x < walk {
        stage.run(1);
    }
    stage.tell(who, Action::Stop);
    stage.run(3);
    stage.tell(who, Action::PickUp { item: parcel });
    stage.run(2);
    assert_eq!(stage.world.attached(who, Role::Held), Some(parcel), "{lies} {}", stage.position(who));
    stage.physics.throw(&mut stage.world, who, Vector3::new(0.0, 4.0, 2.0)).unwrap();
    stage.run(10);
    assert!(stage.position(parcel).y > 1.5, "{}", stage.position(parcel));
}

#[test]
fn who_holds_nothing_throws_nothing() {
    let mut stage = Stage::new();
    let who = stage.person(at(0.0, 0.0, 0.0));
    let error = stage.physics.throw(&mut stage.world, who, Vector3::x()).unwrap_err();
    assert_eq!(error, PhysicsError::EmptyHanded { id: who });
    let (mut stage, who, _) = with_parcel();
    assert!(stage.physics.throw(&mut stage.world, who, Vector3::x() * f64::NAN).is_err());
    assert!(stage.physics.throw(&mut stage.world, who, Vector3::x() * 61.0).is_err());
}
