//! What stands on a thing goes where the thing goes, or is set down; what is turned, resized or swapped runs into nothing and stands where
//! it may; rows beside a thing on a roof stand on the roof. All of it is taken back to the bit.

use std::f64::consts::FRAC_PI_2;
use std::sync::Arc;

use simworld_agents::editing::{
    Difference, Edit, EditError, Edited, Line, Make, SceneEditor, Spacing, Stand, faults,
};
use simworld_core::geometry::{Point2, Point3, pose_facing, yaw_of};
use simworld_core::ground::{Cover, Ground, GroundData};
use simworld_core::hash::{StateDigest, StateHash};
use simworld_core::id::EntityId;
use simworld_core::net::{NetworkConfig, RoadNetwork, StreetPlan};
use simworld_core::scene::{EntityDesc, EntityKind, Relation, Scene, Shape, World};
use simworld_core::seed::Seed;

fn digest(world: &World) -> StateDigest {
    let mut world = world.clone();
    world.begin_step();
    world.finish_step();
    world.digest()
}

pub(crate) fn put(world: &mut World, kind: EntityKind, name: &str, size: [f64; 3], at: [f64; 3]) -> EntityId {
    let pose = pose_facing(Point3::new(at[0], at[1], at[2]), 0.0);
    let desc = EntityDesc::new(kind, pose, Shape::cuboid(size[0], size[1], size[2]));
    world.spawn(desc.named(name)).expect("a box")
}

pub(crate) fn prop(world: &mut World, name: &str, size: [f64; 3], at: [f64; 3]) -> EntityId {
    put(world, EntityKind::Prop, name, size, at)
}

fn at(world: &World, thing: EntityId) -> Point3 {
    world.entity(thing).expect("it is there").position()
}

pub(crate) fn assert_at(world: &World, thing: EntityId, x: f64, y: f64, z: f64) {
    let is = at(world, thing);
    assert!((is - Point3::new(x, y, z)).norm() < 1e-6, "{is} is not ({x}, {y}, {z})");
}

/// A plain on which stones lie, far from all else: they say where the ground is.
pub(crate) fn plain() -> World {
    let mut world = World::new();
    for x in [0.0, 5.0, 10.0, 15.0, 20.0] {
        prop(&mut world, "stone", [0.5, 0.5, 0.5], [x, -30.0, 0.0]);
    }
    world
}

/// A table a metre wide and 0.8 m high with a tray on it, 0.3 m to the east, and a cup on the tray.
struct Laid {
    world: World,
    table: EntityId,
    tray: EntityId,
    cup: EntityId,
}

fn laid() -> Laid {
    let mut world = plain();
    let table = put(&mut world, EntityKind::Table, "table", [1.0, 1.0, 0.8], [0.0, 0.0, 0.0]);
    let tray = prop(&mut world, "tray", [0.3, 0.3, 0.1], [0.3, 0.0, 0.8]);
    let cup = prop(&mut world, "cup", [0.1, 0.1, 0.1], [0.3, 0.05, 0.9]);
    Laid { world, table, tray, cup }
}

/// Carries an edit out, and sees that it stands well and can be taken back and done again to the bit.
pub(crate) fn done(world: &mut World, edit: Edit) -> Edited {
    let (start, before) = (world.clone(), digest(world));
    let mut editor = SceneEditor::new(Seed(3));
    let edited = editor.edit(&[edit], world).unwrap_or_else(|error| panic!("{error}"));
    let changed = Difference::between(&start, world);
    for thing in changed.added.iter().chain(&changed.moved).chain(&changed.altered) {
        assert_eq!(faults(world, *thing), [], "{thing}");
    }
    let after = digest(world);
    editor.undo(world).expect("nothing else changed the world");
    assert_eq!(digest(world), before, "it is taken back");
    editor.redo(world).expect("nothing else changed the world");
    assert_eq!(digest(world), after, "it is done again");
    edited
}

/// Why an edit is refused; it changes nothing.
pub(crate) fn refused(world: &mut World, edit: Edit) -> String {
    let before = digest(world);
    let refused = SceneEditor::new(Seed(3)).edit(&[edit], world).expect_err("it is impossible");
    assert!(matches!(refused, EditError::Impossible { .. }), "{refused}");
    assert_eq!(digest(world), before, "what is refused changes nothing");
    refused.to_string()
}

pub(crate) fn moved_to(thing: EntityId, x: f64, y: f64) -> Edit {
    Edit::Move { things: vec![thing], stands: vec![Stand::At { point: Point2::new(x, y) }] }
}

pub(crate) fn scaled(thing: EntityId, factor: f64) -> Edit {
    Edit::Scale { things: vec![thing], factor }
}

fn turned(thing: EntityId, angle: f64) -> Edit {
    Edit::Rotate { things: vec![thing], angle }
}

pub(crate) fn removed(things: &[EntityId]) -> Edit {
    Edit::Remove { things: things.to_vec() }
}

#[test]
fn what_stands_on_a_thing_goes_where_it_is_put() {
    let Laid { mut world, table, tray, cup } = laid();
    let edited = done(&mut world, moved_to(table, 10.0, 4.0));
    assert_at(&world, table, 10.0, 4.0, 0.0);
    assert_at(&world, tray, 10.3, 4.0, 0.8);
    assert_at(&world, cup, 10.3, 4.05, 0.9);
    assert_eq!(edited.answer, None);
    // Who takes the tray away from it takes the cup, and leaves the table.
    done(&mut world, moved_to(tray, 20.0, 4.0));
    assert_at(&world, cup, 20.0, 4.05, 0.1);
    assert_at(&world, table, 10.0, 4.0, 0.0);
}

#[test]
fn a_place_where_what_stands_on_it_would_run_into_something_is_none() {
    let mut world = plain();
    let table = put(&mut world, EntityKind::Table, "table", [1.0, 1.0, 0.8], [0.0, 0.0, 0.0]);
    prop(&mut world, "board", [3.0, 0.3, 0.05], [0.0, 0.0, 0.8]);
    // The table has room beside this post, and the board on it has none.
    let post = prop(&mut world, "post", [0.3, 0.3, 3.0], [11.3, 4.0, 0.0]);
    let refused = SceneEditor::new(Seed(3)).edit(&[moved_to(table, 10.0, 4.0)], &mut world);
    let Err(EditError::NoRoom { why, .. }) = refused else { panic!("{refused:?}") };
    assert!(why.contains("post"), "{why}");
    world.remove(post).expect("it is there");
    done(&mut world, moved_to(table, 10.0, 4.0));
}

#[test]
fn nothing_is_put_beside_what_stands_on_it() {
    let Laid { mut world, table, cup, .. } = laid();
    let stands = vec![Stand::To { relation: Relation::NextTo, anchor: cup }];
    let why = refused(&mut world, Edit::Move { things: vec![table], stands });
    assert!(why.contains("cup stands on it"), "{why}");
}

#[test]
fn what_stands_on_a_thing_turns_with_it() {
    let Laid { mut world, table, tray, cup } = laid();
    done(&mut world, turned(table, FRAC_PI_2));
    assert_at(&world, tray, 0.0, 0.3, 0.8);
    assert_at(&world, cup, -0.05, 0.3, 0.9);
    let yaw = yaw_of(world.entity(tray).expect("it is there").pose);
    assert!((yaw - FRAC_PI_2).abs() < 1e-9, "{yaw}");
}

#[test]
fn what_stands_on_a_thing_is_set_down_when_that_is_taken_away() {
    let Laid { mut world, table, tray, cup } = laid();
    let edited = done(&mut world, removed(&[table]));
    assert_at(&world, tray, 0.3, 0.0, 0.0);
    assert_at(&world, cup, 0.3, 0.05, 0.1);
    let told = edited.answer.expect("it says so");
    assert!(told.contains("tray") && told.contains("was set down on the ground"), "{told}");

    let Laid { mut world, table, tray, cup } = laid();
    let told = done(&mut world, removed(&[tray])).answer.expect("it says so");
    assert_at(&world, cup, 0.3, 0.05, 0.8);
    assert!(told.contains("was set down on table"), "{told}");
    assert_at(&world, table, 0.0, 0.0, 0.0);

    // What goes too is not set down, but what stands on that is, past both.
    let Laid { mut world, table, tray, cup } = laid();
    done(&mut world, removed(&[table, tray]));
    assert_at(&world, cup, 0.3, 0.05, 0.0);
    let Laid { mut world, table, tray, cup } = laid();
    assert_eq!(done(&mut world, removed(&[cup, table, tray])).answer, None);
    assert!([cup, table, tray].iter().all(|thing| world.entity(*thing).is_none()));
}

#[test]
fn it_is_said_in_words_and_taken_back_in_one_step() {
    let Laid { mut world, table, tray, .. } = laid();
    let before = digest(&world);
    let mut editor = SceneEditor::new(Seed(3));
    let edited = editor.say("remove the table", &mut world).unwrap();
    assert!(edited.answer.is_some_and(|told| told.contains("was set down on the ground")));
    assert!(world.entity(table).is_none());
    assert_at(&world, tray, 0.3, 0.0, 0.0);
    assert_eq!(editor.undo(&mut world), Ok(Some("remove the table".to_owned())));
    assert_eq!(digest(&world), before);
}

#[test]
fn a_board_on_two_tables_stays_up_on_that_which_is_below_its_middle() {
    let board = || {
        let mut world = plain();
        let one = put(&mut world, EntityKind::Table, "one", [1.0, 1.0, 0.8], [0.0, 0.0, 0.0]);
        let other = put(&mut world, EntityKind::Table, "other", [1.0, 1.0, 0.8], [1.2, 0.0, 0.0]);
        let board = prop(&mut world, "board", [1.6, 0.3, 0.05], [0.8, 0.0, 0.8]);
        (world, one, other, board)
    };
    let (mut world, one, _, plank) = board();
    assert_eq!(done(&mut world, removed(&[one])).answer, None);
    assert_at(&world, plank, 0.8, 0.0, 0.8);
    let (mut world, _, other, _) = board();
    let why = refused(&mut world, removed(&[other]));
    assert!(why.contains("board would slip off one"), "{why}");
    let (mut world, one, other, plank) = board();
    done(&mut world, removed(&[one, other]));
    assert_at(&world, plank, 0.8, 0.0, 0.0);
}

#[test]
fn what_stands_on_a_thing_stands_on_its_new_top() {
    let Laid { mut world, table, tray, cup } = laid();
    done(&mut world, scaled(table, 2.0));
    assert_at(&world, tray, 0.3, 0.0, 1.6);
    assert_at(&world, cup, 0.3, 0.05, 1.7);
    done(&mut world, scaled(table, 0.5));
    assert_at(&world, tray, 0.3, 0.0, 0.8);

    // What has its middle beyond the smaller top, and nothing of it above, is set down beside it.
    let Laid { mut world, table, tray, cup } = laid();
    let told = done(&mut world, scaled(table, 0.2)).answer.expect("it says so");
    assert_at(&world, tray, 0.3, 0.0, 0.0);
    assert_at(&world, cup, 0.3, 0.05, 0.1);
    assert!(told.contains("tray"), "{told}");

    // And what would slip off it forbids that.
    let Laid { mut world, table, .. } = laid();
    let why = refused(&mut world, scaled(table, 0.5));
    assert!(why.contains("tray would slip off table"), "{why}");
}

#[test]
fn what_grows_lifts_nothing_into_what_is_above() {
    let Laid { mut world, table, .. } = laid();
    put(&mut world, EntityKind::Prop, "beam", [4.0, 4.0, 0.1], [0.0, 0.0, 1.7]);
    let why = refused(&mut world, scaled(table, 2.0));
    assert!(why.contains("beam is in the way"), "{why}");
}

#[test]
fn what_is_on_a_thing_keeps_to_it_when_it_turns_grows_or_is_swapped() {
    let mut world = plain();
    put(&mut world, EntityKind::Table, "shelf", [2.0, 0.4, 0.8], [0.0, 0.0, 0.0]);
    let book = prop(&mut world, "book", [0.6, 0.2, 0.1], [0.0, 0.0, 0.8]);
    let crate_ = prop(&mut world, "crate", [1.0, 1.0, 1.0], [6.0, 0.0, 0.0]);
    for edit in [turned(book, FRAC_PI_2), scaled(book, 3.0), Edit::Swap { one: book, other: crate_ }] {
        let why = refused(&mut world, edit);
        assert!(why.contains("shelf does not hold all of it"), "{why}");
    }
    done(&mut world, scaled(book, 1.5));
}

#[test]
fn what_changes_places_takes_along_what_stands_on_it() {
    let Laid { mut world, table, tray, cup } = laid();
    let stone = prop(&mut world, "stone", [0.8, 0.8, 0.5], [10.0, 0.0, 0.0]);
    let ball = prop(&mut world, "ball", [0.2, 0.2, 0.2], [10.0, 0.2, 0.5]);
    done(&mut world, Edit::Swap { one: table, other: stone });
    assert_at(&world, table, 10.0, 0.0, 0.0);
    assert_at(&world, cup, 10.3, 0.05, 0.9);
    assert_at(&world, ball, 0.0, 0.2, 0.5);
    let why = refused(&mut world, Edit::Swap { one: table, other: tray });
    assert!(why.contains("tray stands on table"), "{why}");
}

#[test]
fn two_that_would_run_into_each_other_do_not_change_places() {
    let mut world = plain();
    let lorry = put(&mut world, EntityKind::Truck, "lorry", [8.0, 2.5, 3.0], [0.0, 0.0, 0.0]);
    let post = prop(&mut world, "post", [0.3, 0.3, 3.0], [4.5, 0.0, 0.0]);
    // At the post the lorry would reach from 0.5 to 8.5, and at the lorry's place the post is clear of it: they may.
    done(&mut world, Edit::Swap { one: lorry, other: post });
    let mut world = plain();
    let one = put(&mut world, EntityKind::Truck, "one", [8.0, 2.5, 3.0], [0.0, 0.0, 0.0]);
    let pose = pose_facing(Point3::new(5.5, 0.0, 0.0), FRAC_PI_2);
    let other = EntityDesc::new(EntityKind::Truck, pose, Shape::cuboid(9.0, 2.5, 3.0));
    let other = world.spawn(other.named("other")).expect("a lorry");
    // Each is turned as the other was: 4.5 m and 1.25 m from middles that are 5.5 m apart.
    let why = refused(&mut world, Edit::Swap { one, other });
    assert!(why.contains("too near to each other"), "{why}");
}

/// A crossroads: its eastern arm has kerbs at 3.5 m and sidewalks up to 6.5 m.
fn streets() -> World {
    let network = RoadNetwork::derive(&StreetPlan::crossroads(100.0), &NetworkConfig::default());
    let mut world = plain();
    world.set_roads(Arc::new(network.expect("it is sound")));
    world
}

fn bench(world: &mut World, x: f64, y: f64, yaw: f64) -> EntityId {
    let pose = pose_facing(Point3::new(x, y, 0.0), yaw);
    let bench = EntityDesc::new(EntityKind::Bench, pose, Shape::cuboid(0.6, 1.8, 0.85));
    world.spawn(bench).expect("a bench")
}

#[test]
fn what_turns_or_grows_leaves_room_to_walk() {
    let mut world = streets();
    let along = bench(&mut world, 60.0, 5.5, FRAC_PI_2);
    for edit in [turned(along, FRAC_PI_2), scaled(along, 2.0)] {
        let why = refused(&mut world, edit);
        assert!(why.contains("too little of the sidewalk would be left"), "{why}");
    }
    done(&mut world, turned(along, 2.0 * FRAC_PI_2));
    done(&mut world, scaled(along, 1.3));
    // What stood in the way of walkers before is not the fault of who turns it.
    let across = bench(&mut world, 70.0, 5.5, 0.0);
    done(&mut world, turned(across, 2.0 * FRAC_PI_2));
    done(&mut world, turned(across, FRAC_PI_2));
}

#[test]
fn nothing_changes_places_with_a_car_on_a_lane() {
    let mut world = streets();
    let car = put(&mut world, EntityKind::Car, "car", [4.4, 1.8, 1.5], [60.0, -1.75, 0.0]);
    let seat = bench(&mut world, 60.0, 30.0, 0.0);
    let why = refused(&mut world, Edit::Swap { one: car, other: seat });
    assert!(why.contains("a carriageway is for traffic"), "{why}");
    // Two that stand on a lane may.
    let van = put(&mut world, EntityKind::Truck, "van", [6.0, 2.2, 2.5], [80.0, -1.75, 0.0]);
    done(&mut world, Edit::Swap { one: car, other: van });
}

#[test]
fn doors_stay_free() {
    let mut world = plain();
    let house = |world: &mut World, name: &str, x: f64, y: f64| {
        let pose = pose_facing(Point3::new(x, y, 0.0), 0.0);
        let house = EntityDesc::new(EntityKind::Building, pose, Shape::cuboid(10.0, 10.0, 6.0)).named(name);
        world.spawn(house.accessed_at(Point3::new(x + 5.5, y, 0.0))).expect("a house")
    };
    let south = house(&mut world, "South", 0.0, 0.0);
    house(&mut world, "North", 0.0, 11.0);
    let why = refused(&mut world, turned(south, FRAC_PI_2));
    assert!(why.contains("North would stand before its door"), "{why}");
    done(&mut world, turned(south, -FRAC_PI_2));
    done(&mut world, turned(south, FRAC_PI_2));
    let seat = bench(&mut world, 6.7, 0.0, 0.0);
    let why = refused(&mut world, scaled(seat, 2.0));
    assert!(why.contains("the door of South would be blocked"), "{why}");
}

/// Land that rises to the north by so much a metre.
fn slope(rise: f64) -> World {
    let heights = (0..11 * 11).map(|index| ((f64::from(index / 11) * 10.0 - 50.0) * rise) as f32);
    let ground = Ground::new(GroundData {
        origin: Point2::new(-50.0, -50.0),
        spacing: 10.0,
        columns: 11,
        rows: 11,
        heights: heights.collect(),
        covers: vec![Cover::Grass; 11 * 11],
        water: None,
    });
    let mut world = World::new();
    world.set_ground(Arc::new(ground.expect("a plane is sound")));
    world
}

/// A bench that lies with its length along a height of such land, on the higher of its sides.
fn level(world: &mut World, rise: f64, y: f64) -> EntityId {
    let pose = pose_facing(Point3::new(3.0, y, (y + 0.3) * rise), FRAC_PI_2);
    let bench = EntityDesc::new(EntityKind::Bench, pose, Shape::cuboid(0.6, 1.8, 0.85));
    world.spawn(bench).expect("a bench")
}

#[test]
fn what_is_turned_resized_or_swapped_stands_on_the_land() {
    let mut world = slope(0.02);
    let seat = level(&mut world, 0.02, 20.0);
    done(&mut world, turned(seat, FRAC_PI_2));
    let is = at(&world, seat).z;
    assert!((is - 20.9 * 0.02).abs() < 1e-4, "on the higher of its ends: {is}");
    done(&mut world, scaled(seat, 0.5));
    let is = at(&world, seat).z;
    assert!((is - 20.45 * 0.02).abs() < 1e-4, "half as long it stands lower: {is}");
    let higher = level(&mut world, 0.02, 40.0);
    done(&mut world, Edit::Swap { one: seat, other: higher });
    let is = at(&world, seat).z;
    assert!((is - 40.15 * 0.02).abs() < 1e-4, "a bench of 30 cm on a place for 60: {is}");

    let mut world = slope(0.05);
    let seat = level(&mut world, 0.05, 20.0);
    let why = refused(&mut world, turned(seat, FRAC_PI_2));
    assert!(why.contains("the land is too steep there"), "{why}");
    done(&mut world, turned(seat, 2.0 * FRAC_PI_2));
}

/// A flat roof of 20 m by 20 m, 6 m up, with a tank on it.
fn roof(size: [f64; 3], x: f64) -> (World, EntityId) {
    let mut world = plain();
    put(&mut world, EntityKind::Building, "house", [20.0, 20.0, 6.0], [0.0, 0.0, 0.0]);
    let tank = prop(&mut world, "tank", size, [x, 0.0, 6.0]);
    (world, tank)
}

fn row(line: Line, count: u32) -> Edit {
    Edit::Row { make: Make::of("bench"), line, spacing: Spacing::Count(count) }
}

#[test]
fn a_row_beside_a_thing_on_a_roof_stands_on_the_roof() {
    let (mut world, tank) = roof([4.0, 4.0, 2.0], 0.0);
    let made = done(&mut world, row(Line::Around { anchor: tank }, 6)).made;
    assert!(made.len() == 6 && made.iter().all(|seat| (at(&world, *seat).z - 6.0).abs() < 1e-9));

    // East of this one the roof ends, so that they stand on its western side.
    let (mut world, tank) = roof([2.0, 8.0, 2.0], 8.9);
    let made = done(&mut world, row(Line::Along { anchor: tank }, 3)).made;
    let is_west = |seat: &EntityId| at(&world, *seat).x < 7.9 && (at(&world, *seat).z - 6.0).abs() < 1e-9;
    assert!(made.len() == 3 && made.iter().all(is_west));
}

#[test]
fn a_row_that_the_roof_does_not_hold_is_refused() {
    let (mut world, tank) = roof([4.0, 4.0, 2.0], 7.5);
    let before = digest(&world);
    let ring = row(Line::Around { anchor: tank }, 8);
    let refused = SceneEditor::new(Seed(3)).edit(&[ring], &mut world);
    let Err(EditError::NoRoom { why, .. }) = refused else { panic!("{refused:?}") };
    assert!(why.contains("it would not stand safely"), "{why}");
    assert_eq!(digest(&world), before);
    // Beside a thing on the ground it stands on the ground, as before.
    let stone = world.iter().find(|thing| thing.planar().y < -25.0).expect("it is there").id;
    let made = done(&mut world, row(Line::Around { anchor: stone }, 4)).made;
    assert!(made.len() == 4 && made.iter().all(|seat| at(&world, *seat).z == 0.0));
}
