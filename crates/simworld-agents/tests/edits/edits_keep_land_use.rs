//! What is put somewhere by words stands on ground that is for such things, as far as what was asked for leaves it the choice; where it
//! does not, the answer says so. Judged by coordinates, without anything that the solver asks.

use std::f64::consts::FRAC_PI_2;
use std::sync::Arc;

use simworld_agents::editing::{
    Edit, Edited, Land, Line, Make, Placing, SceneEditor, Sides, Spacing, Stand, faults,
};
use simworld_core::geometry::{Point2, Point3, Vector2, direction, pose_facing, yaw_of};
use simworld_core::id::{EntityId, RoadId};
use simworld_core::net::{CrossSection, NetworkConfig, RoadNetwork, StreetPlan};
use simworld_core::scene::{EntityDesc, EntityKind, Relation, Scene, Shape, World};
use simworld_core::seed::Seed;

use crate::city::City;

/// The kerbs of a street of two lanes lie so far from its middle, and the outer edges of its sidewalks, m.
const KERB: f64 = 3.5;
const WALK: f64 = 6.5;

/// Streets along the axes, 100 m each way; every one of that section.
fn crossroads(section: CrossSection) -> World {
    let mut plan = StreetPlan::crossroads(100.0);
    plan.sections[0] = section;
    let network = RoadNetwork::derive(&plan, &NetworkConfig::default()).unwrap();
    let mut world = World::new();
    world.set_roads(Arc::new(network));
    world
}

/// A house that looks south, so deep and so wide.
fn house(world: &mut World, at: [f64; 2], size: [f64; 2]) -> EntityId {
    let pose = pose_facing(Point3::new(at[0], at[1], 0.0), -FRAC_PI_2);
    let house = EntityDesc::new(EntityKind::Building, pose, Shape::cuboid(size[0], size[1], 9.0));
    world.spawn(house.named("Clinic")).unwrap()
}

fn ground(world: &mut World, area: &str, x: f64) -> EntityId {
    let pose = pose_facing(Point3::new(x, 0.0, -0.03), 0.0);
    let ground = EntityDesc::new(EntityKind::Ground, pose, Shape::cuboid(20.0, 20.0, 0.02));
    world.spawn(ground.with("area", area)).unwrap()
}

/// Adds one of an asset so; what came of it, and what was tried.
fn added(world: &mut World, asset: &str, stand: &Stand, seed: u64) -> (Edited, Placing) {
    let mut editor = SceneEditor::new(Seed(seed));
    let add = Edit::Add { make: Make::of(asset), count: 1, stands: vec![stand.clone()] };
    let edited = editor.edit(&[add], world).unwrap_or_else(|error| panic!("{asset}: {error}"));
    assert!(stand.holds(world, edited.made[0]), "what was asked for comes before the ground");
    assert_eq!(faults(world, edited.made[0]), []);
    (edited, editor.last_placings().last().unwrap().clone())
}

fn to(relation: Relation, anchor: EntityId) -> Stand {
    Stand::To { relation, anchor }
}

/// Where a vehicle stands, which way it looks, and half its width, m.
fn stands(world: &World, thing: EntityId) -> (Point2, Vector2, f64) {
    let thing = world.entity(thing).unwrap();
    (thing.planar(), direction(yaw_of(thing.pose)), thing.info.shape.size().y * 0.5)
}

#[test]
fn a_car_is_parked_at_the_kerb_and_with_the_traffic_where_that_is_next_to_a_house() {
    for seed in 0..5 {
        let mut world = crossroads(CrossSection::two_way(1, 1));
        // Its wall is 3.5 m from the kerb, and 5 m is next to it: most of the places next to it are on the lot.
        let anchor = house(&mut world, [50.0, 15.0], [16.0, 20.0]);
        let (edited, tried) = added(&mut world, "sports_car", &to(Relation::NextTo, anchor), seed);
        let (at, ahead, half) = stands(&world, edited.made[0]);
        assert!((0.0..0.5).contains(&(KERB - at.y - half)), "it is not at the kerb: {at}");
        assert!(ahead.x < -0.98, "north of the middle one drives to the west: {ahead}");
        assert!(at.x > 15.0, "it stands in the junction: {at}");
        assert_eq!((edited.astray, edited.answer), (vec![], None));
        let why = tried.explained().unwrap();
        assert!(
            why.contains("beside the kerb of a street") && why.contains("on open ground beside a street"),
            "{why}"
        );
    }
}

#[test]
fn on_a_street_with_a_strip_for_it_a_car_is_parked_on_that() {
    for seed in 0..5 {
        let mut world = crossroads(CrossSection::two_way(1, 1).with_parking(2.0));
        let anchor = house(&mut world, [50.0, 30.0], [12.0, 12.0]);
        let (edited, _) = added(&mut world, "sports_car", &to(Relation::InFrontOf, anchor), seed);
        let (at, ahead, half) = stands(&world, edited.made[0]);
        // The strips reach from 3.5 m to 5.5 m.
        assert!(at.y.abs() - half >= KERB - 0.25 && at.y.abs() + half <= KERB + 2.0, "{at}");
        assert!(ahead.x.abs() > 0.98, "along it: {ahead}");
        assert_eq!(edited.astray, []);
    }
}

#[test]
fn a_car_that_finds_no_kerb_next_to_a_house_stands_on_its_lot_and_the_answer_says_so() {
    let mut world = crossroads(CrossSection::two_way(1, 1));
    let anchor = house(&mut world, [50.0, 38.0], [12.0, 12.0]);
    let (edited, tried) = added(&mut world, "sports_car", &to(Relation::NextTo, anchor), 3);
    assert!(stands(&world, edited.made[0]).0.y > 25.0);
    let [astray] = &edited.astray[..] else { panic!("{:?}", edited.astray) };
    assert_eq!((astray.land, astray.count), (Land::Lot, 1));
    let said = "the car stands on open ground beside a street, for nothing better was found next to Clinic";
    assert_eq!(edited.answer.as_deref(), Some(said));
    assert!(tried.explained().unwrap().contains("for want of better ground"));

    // Before the house the street is in reach.
    let (edited, _) = added(&mut world, "sports_car", &to(Relation::InFrontOf, anchor), 3);
    let (at, _, half) = stands(&world, edited.made[0]);
    assert!((0.0..0.5).contains(&(KERB - at.y.abs() - half)), "{at}");
    assert_eq!(edited.answer, None);
}

#[test]
fn where_nothing_is_known_of_the_ground_nothing_is_said_of_it_and_a_lawn_is_kept_off() {
    let mut world = World::new();
    let anchor = house(&mut world, [0.0, 40.0], [12.0, 12.0]);
    let (edited, tried) = added(&mut world, "bus", &to(Relation::NextTo, anchor), 3);
    assert_eq!((edited.answer, tried.fit().unwrap().land), (None, Land::Unknown));

    // East of the statue is lawn, and west of it a square; the grounds meet below it.
    let mut world = World::new();
    let lawn = ground(&mut world, "park", 10.0);
    ground(&mut world, "square", -10.0);
    let pose = pose_facing(Point3::new(0.0, 0.0, 0.0), 0.0);
    let statue = EntityDesc::new(EntityKind::Prop, pose, Shape::cuboid(1.0, 1.0, 4.0));
    let statue = world.spawn(statue).unwrap();
    for seed in 0..5 {
        let mut world = world.clone();
        let (edited, _) = added(&mut world, "sports_car", &to(Relation::NextTo, statue), seed);
        let bounds = world.entity(edited.made[0]).unwrap().bounds;
        assert!(bounds.max.x <= 0.0, "it stands on the lawn by {} m", bounds.max.x);
        assert_eq!(edited.answer, None);
    }
    let (edited, _) = added(&mut world, "sports_car", &to(Relation::Inside, lawn), 3);
    assert_eq!(edited.answer, None, "the lawn was asked for");
}

#[test]
fn a_tree_grows_on_soil_and_on_a_square_for_want_of_it_or_because_it_was_asked_for() {
    let mut world = World::new();
    let square = ground(&mut world, "square", 0.0);
    let pose = pose_facing(Point3::new(0.0, 0.0, 0.0), 0.0);
    let fountain = EntityDesc::new(EntityKind::Prop, pose, Shape::cuboid(3.0, 3.0, 2.0)).named("fountain");
    let fountain = world.spawn(fountain).unwrap();
    let is_on_square = |world: &World, thing: EntityId| {
        let at = world.entity(thing).unwrap().planar();
        at.x.abs() < 10.0 && at.y.abs() < 10.0
    };
    for seed in 0..5 {
        let mut world = world.clone();
        let (edited, _) = added(&mut world, "tree", &to(Relation::Near, fountain), seed);
        assert!(!is_on_square(&world, edited.made[0]), "there is other ground near the fountain");
        assert_eq!(edited.answer, None);
    }
    let (edited, tried) = added(&mut world, "tree", &to(Relation::NextTo, fountain), 3);
    assert!(is_on_square(&world, edited.made[0]));
    let said = "the tree stands on paving, for nothing better was found next to fountain";
    assert_eq!(edited.answer.as_deref(), Some(said));
    assert_eq!(tried.fit().unwrap().land, Land::Paving);
    for stand in [to(Relation::Inside, square), Stand::AtEdgeOf { anchor: square }] {
        let (edited, tried) = added(&mut world, "tree", &stand, 3);
        assert_eq!((edited.answer, tried.fit().unwrap().astray), (None, false), "{stand:?}");
    }
}

#[test]
fn a_row_of_trees_along_a_street_grows_behind_the_sidewalk() {
    let mut world = crossroads(CrossSection::two_way(1, 1));
    let line = Line::Road { roads: vec![RoadId::from_index(0)], sides: Sides::Either };
    let row = Edit::Row { make: Make::of("tree"), line, spacing: Spacing::Count(4) };
    let edited = SceneEditor::new(Seed(3)).edit(&[row], &mut world).unwrap();
    assert_eq!((edited.made.len(), &edited.astray[..]), (4, &[][..]));
    for tree in edited.made {
        let at = world.entity(tree).unwrap().planar();
        assert!(at.y.abs() > WALK && at.y.abs() < KERB + 6.0, "{at}");
    }
}

#[test]
fn furniture_stands_beside_the_street_and_leaves_walkers_their_width() {
    for asset in ["bench", "trash_bin", "street_lamp", "table"] {
        for seed in 0..12 {
            let mut world = crossroads(CrossSection::two_way(1, 1));
            let anchor = house(&mut world, [55.0, 13.0], [12.0, 12.0]);
            let (edited, _) = added(&mut world, asset, &to(Relation::Near, anchor), seed);
            let bounds = world.entity(edited.made[0]).unwrap().bounds;
            let (low, high) = if bounds.min.y >= 0.0 {
                (bounds.min.y, bounds.max.y)
            } else {
                (-bounds.max.y, -bounds.min.y)
            };
            assert!(low >= KERB, "{asset} stands in the street: {low} m from its middle");
            let left = (low - KERB).max(WALK - high);
            assert!(low >= WALK || left >= 1.5, "{asset} leaves {left} m of the sidewalk");
            assert_eq!(edited.astray, []);
        }
    }
}

/// What a sentence did in the quarter.
fn said(words: &str) -> (World, Edited) {
    let city = City::read("quarter");
    let mut world = city.world;
    let mut editor = SceneEditor::new(Seed(7)).looking_as(city.me, &world);
    let edited = editor.say(words, &mut world).unwrap_or_else(|error| panic!("{words}: {error}"));
    (world, edited)
}

#[test]
fn what_is_said_of_the_quarter_keeps_to_the_use_of_its_land() {
    // Oak Street, at y = 0, runs before the museum.
    let (world, edited) = said("park a taxi in front of the museum");
    let (at, ahead, half) = stands(&world, edited.made[0]);
    assert!((0.0..0.5).contains(&(KERB - at.y.abs() - half)) && ahead.x.abs() > 0.98, "{at}, {ahead}");
    assert_eq!(edited.answer, None);

    for (words, land) in [
        ("park a taxi next to the museum", Some(Land::Lot)),
        ("plant an oak next to the fountain", Some(Land::Paving)),
        ("plant an oak in the middle of Market Square", None),
        ("plant an oak in Market Square", None),
        ("plant an oak in Rose Park", None),
        ("put a bench in Market Square", None),
    ] {
        let (_, edited) = said(words);
        assert_eq!(edited.astray.first().map(|astray| astray.land), land, "{words}");
        let is_told =
            edited.answer.as_deref().is_some_and(|answer| answer.contains("nothing better was found"));
        assert_eq!(is_told, land.is_some(), "{words}: {:?}", edited.answer);
    }
}

#[test]
fn what_was_asked_is_answered_before_that() {
    let mut world = crossroads(CrossSection::two_way(1, 1));
    let clinic = house(&mut world, [50.0, 40.0], [12.0, 12.0]);
    let edits = [
        Edit::Add { make: Make::of("sports_car"), count: 2, stands: vec![to(Relation::NextTo, clinic)] },
        Edit::Count { what: "clinic".to_owned(), things: vec![clinic] },
    ];
    let edited = SceneEditor::new(Seed(3)).edit(&edits, &mut world).unwrap();
    let said = "1 clinic; 2 of kind car stand on open ground beside a street, for nothing better was found next to Clinic";
    assert_eq!(edited.answer.as_deref(), Some(said));
}
