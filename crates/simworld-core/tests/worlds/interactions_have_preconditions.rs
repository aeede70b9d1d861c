//! What people do with things: each action does what it says, and is refused with a reason where it cannot.

use crate::common::small_world;
use simworld_core::action::Action;
use simworld_core::asset::{Affordance, AffordanceSet, Asset};
use simworld_core::command::Command;
use simworld_core::geometry::{Point3, Twist, pose_facing};
use simworld_core::hash::StateHash;
use simworld_core::id::EntityId;
use simworld_core::scene::{EntityDesc, EntityKind, HAND_LIMIT, InteractionError, Role, Scene, Shape, World};

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
        if matches!(action, Action::SitDown { .. }) {
            world.actuate(PERSON, Action::StandUp).unwrap();
        }
    }
}

#[test]
fn hands_and_arms_hold_no_more_than_they_can() {
    let mut world = small_world();
    let mut put = |kind, mass: f64| {
        let pose = pose_facing(Point3::new(0.8, 0.4, 0.0), 0.0);
        world.spawn(EntityDesc::new(kind, pose, Shape::cuboid(0.4, 0.4, 0.4)).weighing(mass)).unwrap()
    };
    let (light, heavy, safe) =
        (put(EntityKind::Parcel, 14.0), put(EntityKind::Parcel, 24.0), put(EntityKind::Prop, 26.0));
    let refused = world.actuate(PERSON, Action::PickUp { item: heavy }).unwrap_err();
    assert!(matches!(refused, InteractionError::TooHeavy { limit: HAND_LIMIT, .. }), "{refused}");
    let refused = world.actuate(PERSON, Action::CarryHeavy { item: safe }).unwrap_err();
    assert_eq!(
        refused.to_string(),
        format!("prop {safe} weighs 26 kg and 25 kg is what one can carry at most")
    );
    world.actuate(PERSON, Action::CarryHeavy { item: heavy }).unwrap();
    for (action, what) in [
        (Action::PickUp { item: light }, "took a second thing"),
        (Action::RideScooter { scooter: SCOOTER }, "rode without a hand"),
    ] {
        let refused = world.actuate(PERSON, action).expect_err(what);
        assert!(matches!(refused, InteractionError::Busy { .. }), "{refused}");
    }
    world.actuate(PERSON, Action::PutDownHeavy).unwrap();
    world.actuate(PERSON, Action::PickUp { item: light }).unwrap();
    let refused = world.actuate(PERSON, Action::CarryHeavy { item: heavy });
    assert!(refused.is_err(), "both arms are wanted");
}

#[test]
fn who_stands_can_crouch_until_it_stands_up_sits_or_rides() {
    let mut world = small_world();
    let is_crouched = |world: &World| world.entity(PERSON).unwrap().is_crouched();
    assert!(!is_crouched(&world));
    world.actuate(PERSON, Action::Crouch).unwrap();
    assert!(is_crouched(&world));
    let refused = world.actuate(PERSON, Action::Crouch).unwrap_err().to_string();
    assert!(refused.contains("crouching"), "{refused}");
    world.actuate(PERSON, Action::StandUp).unwrap();
    assert!(!is_crouched(&world) && world.actuate(PERSON, Action::StandUp).is_err(), "it stands");
    world.actuate(PERSON, Action::Crouch).unwrap();
    world.actuate(PERSON, Action::SitDown { seat: CHAIR }).unwrap();
    assert!(!is_crouched(&world));
    let refused = world.actuate(PERSON, Action::Crouch).unwrap_err().to_string();
    assert!(refused.contains("sitting"), "{refused}");
}

#[test]
fn who_gets_up_or_puts_down_finds_room() {
    let mut world = World::new();
    let mut put = |kind, x: f64, y: f64, shape| {
        world.spawn(EntityDesc::new(kind, pose_facing(Point3::new(x, y, 0.0), 0.0), shape)).unwrap()
    };
    let person = Shape::Capsule { radius: 0.25, height: 1.8 };
    let me = put(EntityKind::Person, 0.0, 1.0, person);
    let chair = put(EntityKind::Chair, 0.0, 0.0, Shape::cuboid(0.5, 0.5, 0.9));
    // A table before it, a wall behind it, and somebody on its left.
    put(EntityKind::Table, 0.75, 0.0, Shape::cuboid(0.8, 0.8, 0.75));
    put(EntityKind::Building, -2.4, 0.0, Shape::cuboid(4.0, 9.0, 6.0));
    let crate_ = put(EntityKind::Prop, 0.4, 1.0, Shape::cuboid(0.6, 0.6, 0.6));
    world.actuate(me, Action::SitDown { seat: chair }).unwrap();
    let other = world.spawn(EntityDesc::new(
        EntityKind::Person,
        pose_facing(Point3::new(0.0, 0.7, 0.0), 0.0),
        person,
    ));
    world.actuate(me, Action::StandUp).unwrap();
    let is_free = |world: &World, id: EntityId, reach: f64| {
        let spot = world.entity(id).unwrap().planar();
        world.nearest(spot, reach, &|thing| thing.id != id && thing.is_solid()).map(|thing| thing.id)
    };
    assert_eq!(is_free(&world, me, 0.25), None, "{}", world.entity(me).unwrap().position());
    assert!(world.entity(me).unwrap().planar().x > -0.4, "through the wall");
    assert!(other.is_ok());
    world.actuate(me, Action::CarryHeavy { item: crate_ }).unwrap();
    // Face to the wall.
    let (at, facing) = (Point3::new(-0.05, -1.5, 0.0), std::f64::consts::PI);
    world.set_motion(me, pose_facing(at, facing), Twist::ZERO).unwrap();
    world.actuate(me, Action::PutDownHeavy).unwrap();
    assert_eq!(is_free(&world, crate_, 0.3), None, "{}", world.entity(crate_).unwrap().position());
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
fn an_asset_says_what_it_is_for() {
    use Affordance::{Carry, Open, Sit};
    let mut world = small_world();
    let mut put = |name: &str, kind, can: &[Affordance]| {
        let shape = Shape::cuboid(0.4, 0.4, 0.4);
        let asset = Asset { affordances: Some(AffordanceSet::of(can)), ..Asset::new(name, kind, shape) };
        let id = world.add_asset(asset.clone()).unwrap();
        world.spawn(asset.at(id, pose_facing(Point3::new(0.8, 0.8, 0.0), 0.0)).weighing(10.0)).unwrap()
    };
    let rock = put("rock", EntityKind::Prop, &[Sit]);
    let chest = put("chest", EntityKind::Prop, &[Open, Carry]);
    let display = put("display", EntityKind::Chair, &[]);
    let refused = |world: &mut World, action| {
        let error = world.actuate(PERSON, action).unwrap_err();
        assert!(matches!(error, InteractionError::WrongKind { .. }), "{error}");
    };
    refused(&mut world, Action::CarryHeavy { item: rock });
    refused(&mut world, Action::OpenDoor { door: rock });
    refused(&mut world, Action::SitDown { seat: chest });
    refused(&mut world, Action::SitDown { seat: display });
    world.actuate(PERSON, Action::SitDown { seat: rock }).unwrap();
    world.actuate(PERSON, Action::StandUp).unwrap();
    assert!(world.entity(PERSON).unwrap().attachment.is_none());
    walk_to(&mut world, PERSON, 0.0);
    world.actuate(PERSON, Action::OpenDoor { door: chest }).unwrap();
    assert!(world.entity(chest).unwrap().is_open());
    world.actuate(PERSON, Action::CloseDoor { door: chest }).unwrap();
    world.actuate(PERSON, Action::CarryHeavy { item: chest }).unwrap();
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

#[test]
fn a_seat_that_was_moved_and_turned_is_left_where_its_front_is_now() {
    let mut world = World::new();
    let shape = Shape::Capsule { radius: 0.25, height: 1.8 };
    let near = pose_facing(Point3::new(30.6, 20.0, 0.0), 0.0);
    let me = world.spawn(EntityDesc::new(EntityKind::Person, near, shape)).unwrap();
    let bench =
        EntityDesc::new(EntityKind::Bench, pose_facing(Point3::origin(), 0.0), Shape::cuboid(0.6, 1.8, 0.8))
            .accessed_at(Point3::new(0.9, 0.0, 0.0));
    let bench = world.spawn(bench).unwrap();
    let digest = world.digest();
    let north = pose_facing(Point3::new(30.0, 20.0, 0.0), std::f64::consts::FRAC_PI_2);
    let moved = world.apply(&Command::Move { id: bench, pose: north }).unwrap();
    let before_it = Point3::new(30.0, 20.9, 0.0);
    assert!((world.entity(bench).unwrap().access() - before_it).norm() < 1e-9);
    world.actuate(me, Action::SitDown { seat: bench }).unwrap();
    world.actuate(me, Action::StandUp).unwrap();
    assert!((world.entity(me).unwrap().position() - before_it).norm() < 1e-9);

    world.apply(&Command::Move { id: me, pose: near }).unwrap();
    world.apply(&moved.undo.unwrap()).unwrap();
    assert_eq!(world.digest(), digest, "taking it back is exact");
}
