//! What lies on several things stays up while its middle is borne, and goes with what is below that; what somebody held falls when they are
//! taken away. All of it is taken back to the bit.

use simworld_agents::editing::{Edit, Stand};
use simworld_core::geometry::{Point2, Point3, pose_facing};
use simworld_core::id::EntityId;
use simworld_core::scene::{Attachment, EntityDesc, EntityKind, Role, Scene, Shape, World};

use crate::edits_carry_their_loads::{assert_at, done, moved_to, plain, prop, put, refused, removed, scaled};

/// A board of 4 m on three tables whose middles are there, its own middle over the origin.
fn on_three(places: [f64; 3]) -> (World, [EntityId; 3], EntityId) {
    let mut world = plain();
    let tables = places.map(|x| put(&mut world, EntityKind::Table, "table", [0.6, 1.0, 0.8], [x, 0.0, 0.0]));
    let board = prop(&mut world, "board", [4.0, 0.3, 0.05], [0.0, 0.0, 0.8]);
    (world, tables, board)
}

#[test]
fn a_board_stays_up_while_its_middle_is_between_what_it_lies_on() {
    // None is below its middle: that beside it may go, and the last on its side may not.
    let (mut world, [west, east, far], board) = on_three([-1.5, 0.8, 1.6]);
    for edit in [moved_to(east, 10.0, 4.0), removed(&[east])] {
        assert_eq!(done(&mut world, edit).answer, None);
        assert_at(&world, board, 0.0, 0.0, 0.8);
    }
    for edit in [moved_to(far, 12.0, 4.0), removed(&[far]), scaled(far, 0.5), moved_to(west, 14.0, 4.0)] {
        let why = refused(&mut world, edit);
        assert!(why.contains("board would slip off table"), "{why}");
    }
    // Where both are put elsewhere it falls past them.
    let point = Point2::new(12.0, 4.0);
    let both = Edit::Move { things: vec![west, far], stands: vec![Stand::Around { point }] };
    let told = done(&mut world, both).answer.expect("it says so");
    assert_at(&world, board, 0.0, 0.0, 0.0);
    assert!(told.contains("was set down on the ground"), "{told}");

    // Of one that sinks below its middle it stays on the two beside it; it goes along with that all the same.
    let (mut world, [_, middle, _], board) = on_three([-1.5, 0.0, 1.5]);
    assert_eq!(done(&mut world, scaled(middle, 0.5)).answer, None);
    assert_at(&world, board, 0.0, 0.0, 0.8);
    let (mut world, [_, middle, _], board) = on_three([-1.5, 0.0, 1.5]);
    assert_eq!(done(&mut world, removed(&[middle])).answer, None);
    assert_at(&world, board, 0.0, 0.0, 0.8);
    let (mut world, [_, middle, _], board) = on_three([-1.5, 0.0, 1.5]);
    done(&mut world, moved_to(middle, 10.0, 4.0));
    assert_at(&world, board, 10.0, 4.0, 0.8);
}

/// Hangs a thing on somebody, so far before and above them.
fn held(world: &mut World, by: EntityId, name: &str, size: [f64; 3], (ahead, up): (f64, f64)) -> EntityId {
    let carrier = *world.entity(by).expect("somebody is there").pose;
    let parent_from_body = pose_facing(Point3::new(ahead, 0.0, up), 0.0);
    let shape = Shape::cuboid(size[0], size[1], size[2]);
    let mut desc = EntityDesc::new(EntityKind::Prop, carrier * parent_from_body, shape).named(name);
    desc.attachment = Some(Attachment { parent: by, role: Role::Held, parent_from_body });
    world.spawn(desc).expect("a box in a hand")
}

/// Somebody with a tray in one hand, on which a cup stands, and a lantern in the other, which is over the tray.
fn waiter(world: &mut World, z: f64) -> [EntityId; 4] {
    let pose = pose_facing(Point3::new(0.0, 0.0, z), 0.0);
    let person = EntityDesc::new(EntityKind::Person, pose, Shape::Capsule { radius: 0.25, height: 1.75 });
    let person = world.spawn(person.named("Ann")).expect("a person");
    let lantern = held(world, person, "lantern", [0.1, 0.1, 0.2], (0.5, 1.5));
    let tray = held(world, person, "tray", [0.4, 0.4, 0.1], (0.5, 1.0));
    let cup = prop(world, "cup", [0.1, 0.1, 0.1], [0.6, 0.1, z + 1.1]);
    [person, lantern, tray, cup]
}

#[test]
fn what_somebody_held_falls_when_they_are_taken_away() {
    let mut world = plain();
    let [person, lantern, tray, cup] = waiter(&mut world, 0.0);
    let edited = done(&mut world, removed(&[person]));
    assert_at(&world, tray, 0.5, 0.0, 0.0);
    assert_at(&world, cup, 0.6, 0.1, 0.1);
    assert_at(&world, lantern, 0.5, 0.0, 0.1);
    assert!(
        [lantern, tray].iter().all(|thing| world.entity(*thing).is_some_and(|it| it.attachment.is_none()))
    );
    let told = edited.answer.expect("it says so");
    assert!(told.contains("tray") && told.contains("was set down on the ground"), "{told}");

    // A table that stands below catches it, and what goes too does not fall.
    let mut world = plain();
    let [person, lantern, tray, cup] = waiter(&mut world, 0.0);
    put(&mut world, EntityKind::Table, "table", [1.0, 1.0, 0.8], [0.9, 0.0, 0.0]);
    let told = done(&mut world, removed(&[person, lantern])).answer.expect("it says so");
    assert!(world.entity(lantern).is_none());
    assert_at(&world, tray, 0.5, 0.0, 0.8);
    assert_at(&world, cup, 0.6, 0.1, 0.9);
    assert!(told.contains("was set down on table"), "{told}");
}

#[test]
fn what_falls_from_somebody_high_up_falls_to_the_ground() {
    let mut world = plain();
    put(&mut world, EntityKind::Ground, "meadow", [100.0, 100.0, 1.0], [0.0, 0.0, -1.0]);
    let [person, lantern, tray, cup] = waiter(&mut world, 20.0);
    done(&mut world, removed(&[person, lantern]));
    assert_at(&world, tray, 0.5, 0.0, 0.0);
    assert_at(&world, cup, 0.6, 0.1, 0.1);
}
