//! What people do with things: each action does what it says, and is refused with a reason where it cannot.
#![allow(clippy::unwrap_used, reason = "a helper of tests")]

mod common;

use common::small_world;
use simworld_core::action::Action;
use simworld_core::geometry::{Point3, Twist, pose_facing};
use simworld_core::id::EntityId;
use simworld_core::scene::{EntityDesc, EntityKind, InteractionError, Role, Scene, Shape, World};

const PERSON: EntityId = EntityId::new(0, 0);
const CHAIR: EntityId = EntityId::new(1, 0);
const PARCEL: EntityId = EntityId::new(2, 0);
const SCOOTER: EntityId = EntityId::new(3, 0);
const CAR: EntityId = EntityId::new(4, 0);

fn second_person(world: &mut World) -> EntityId {
    let shape = Shape::Capsule { radius: 0.25, height: 1.8 };
    let pose = pose_facing(Point3::new(0.5, 0.5, 0.0), 0.0);
    world.spawn(EntityDesc::new(EntityKind::Person, pose, shape)).unwrap()
}

fn walk_to(world: &mut World, who: EntityId, x: f64) {
    world.set_motion(who, pose_facing(Point3::new(x, 0.0, 0.0), 0.0), Twist::ZERO).unwrap();
    world.finish_step();
}

#[test]
fn a_parcel_goes_where_its_carrier_goes_and_stays_where_it_is_dropped() {
    let mut world = small_world();
    world.actuate(PERSON, Action::PickUp { item: PARCEL }).unwrap();
    assert_eq!(world.attached(PERSON, Role::Held), Some(PARCEL));
    walk_to(&mut world, PERSON, 50.0);
    assert!((world.entity(PARCEL).unwrap().position().x - 50.0).abs() < 1.0);
    world.actuate(PERSON, Action::DropOff).unwrap();
    walk_to(&mut world, PERSON, 90.0);
    let parcel = world.entity(PARCEL).unwrap();
    assert!((parcel.position().x - 50.0).abs() < 1.0 && parcel.position().z == 0.0);
    assert!(world.actuate(PERSON, Action::DropOff).is_err(), "dropped twice");
}

#[test]
fn what_is_out_of_reach_stays() {
    let mut world = small_world();
    walk_to(&mut world, PERSON, -10.0);
    let refused = world.actuate(PERSON, Action::PickUp { item: PARCEL }).unwrap_err();
    let InteractionError::OutOfReach { distance, .. } = refused else { panic!("{refused}") };
    assert!((distance - 10.65).abs() < 1e-9, "the parcel begins at x = 0.65");
}

#[test]
fn what_somebody_has_is_taken() {
    let mut world = small_world();
    let other = second_person(&mut world);
    for action in [
        Action::PickUp { item: PARCEL },
        Action::SitDown { seat: CHAIR },
        Action::RideScooter { scooter: SCOOTER },
    ] {
        world.actuate(PERSON, action.clone()).unwrap();
        let refused = world.actuate(other, action.clone()).unwrap_err();
        assert!(matches!(refused, InteractionError::Taken { by: PERSON, .. }), "{action:?}: {refused}");
    }
}

#[test]
fn things_are_used_for_what_they_are() {
    let mut world = small_world();
    for action in [
        Action::PickUp { item: CAR },
        Action::SitDown { seat: PARCEL },
        Action::RideScooter { scooter: CHAIR },
        Action::EnterCar { car: SCOOTER },
    ] {
        let refused = world.actuate(PERSON, action.clone()).unwrap_err();
        assert!(matches!(refused, InteractionError::WrongKind { .. }), "{action:?}: {refused}");
    }
}

#[test]
fn one_sits_down_and_gets_up() {
    let mut world = small_world();
    world.actuate(PERSON, Action::SitDown { seat: CHAIR }).unwrap();
    assert_eq!(world.entity(PERSON).unwrap().attachment.map(|bond| bond.parent), Some(CHAIR));
    assert!(world.actuate(PERSON, Action::EnterCar { car: CAR }).is_err(), "in two seats at once");
    world.actuate(PERSON, Action::StandUp).unwrap();
    assert!(world.entity(PERSON).unwrap().attachment.is_none());
    assert!(world.actuate(PERSON, Action::StandUp).is_err(), "got up twice");
}

#[test]
fn a_car_carries_its_driver() {
    let mut world = small_world();
    world.actuate(PERSON, Action::EnterCar { car: CAR }).unwrap();
    walk_to(&mut world, CAR, 200.0);
    assert!((world.entity(PERSON).unwrap().position().x - 200.0).abs() < 2.0);
    world.actuate(PERSON, Action::ExitCar).unwrap();
    let (person, car) = (world.entity(PERSON).unwrap(), world.entity(CAR).unwrap());
    assert!(!person.obb().footprints_overlap(&car.obb()), "the driver stands in the car");
}

#[test]
fn a_scooter_goes_with_its_rider() {
    let mut world = small_world();
    world.actuate(PERSON, Action::RideScooter { scooter: SCOOTER }).unwrap();
    walk_to(&mut world, PERSON, 30.0);
    assert!((world.entity(SCOOTER).unwrap().position().x - 30.0).abs() < 1e-9);
    world.actuate(PERSON, Action::GetOffScooter).unwrap();
    assert!(world.entity(SCOOTER).unwrap().attachment.is_none());
}

#[test]
fn nobody_carries_what_carries_him() {
    let mut sitting = small_world();
    sitting.actuate(PERSON, Action::SitDown { seat: CHAIR }).unwrap();
    assert!(sitting.actuate(PERSON, Action::CarryHeavy { item: CHAIR }).is_err());
    let mut carrying = small_world();
    carrying.actuate(PERSON, Action::CarryHeavy { item: CHAIR }).unwrap();
    assert!(carrying.actuate(PERSON, Action::SitDown { seat: CHAIR }).is_err());
    sitting.finish_step();
    carrying.finish_step();
}
