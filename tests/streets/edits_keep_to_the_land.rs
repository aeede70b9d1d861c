//! What is put into a generated city by words keeps to the use of its land: cars along the kerbs, trees on soil, and furniture beside the
//! streets.

use simworld_agents::editing::{Edit, EditError, Edited, Make, SceneEditor, Stand};
use simworld_citygen::{City, CityConfig};
use simworld_core::geometry::{Point2, yaw_of};
use simworld_core::id::EntityId;
use simworld_core::net::{RoadNetwork, polyline};
use simworld_core::ops::sin_cos;
use simworld_core::scene::{Relation, Scene, World};
use simworld_core::seed::Seed;

/// So many houses are looked at.
const HOUSES: usize = 24;
/// What is parked stands no farther from a kerb, m: a strip for it is 2.2 m wide.
const PARKED: f64 = 1.5;

/// A city, and some of its houses.
fn town() -> (World, Vec<EntityId>) {
    let city = City::generate(&CityConfig::with_roads(60), Seed(4)).expect("any seed makes a city");
    let mut world = World::new();
    let houses = city.populate(&mut world).expect("a city fits into a world").buildings;
    let every = (houses.len() / HOUSES).max(1);
    let houses: Vec<EntityId> = houses.into_iter().step_by(every).take(HOUSES).collect();
    assert_eq!(houses.len(), HOUSES, "the city has houses enough");
    (world, houses)
}

fn add(world: &mut World, asset: &str, relation: Relation, anchor: EntityId) -> Option<Edited> {
    let stands = vec![Stand::To { relation, anchor }];
    let add = Edit::Add { make: Make::of(asset), count: 1, stands };
    match SceneEditor::new(Seed(5)).edit(&[add], world) {
        Ok(edited) => Some(edited),
        Err(EditError::NoRoom { .. }) => None,
        Err(other) => panic!("{asset}: {other}"),
    }
}

/// Where a point lies between the kerbs of a street on the ground: how far from the nearer of them, m, and the heading of the street.
fn on_carriageway(network: &RoadNetwork, point: Point2) -> Option<(f64, f64)> {
    network.roads.iter().filter(|road| road.level == 0).find_map(|road| {
        let near = polyline::closest(&road.centerline, &point)?;
        let inside = near.station > 0.01 && near.station < polyline::length(&road.centerline) - 0.01;
        let room = (road.left_kerb - near.lateral).min(near.lateral + road.right_kerb);
        let (_, along) = polyline::at(&road.centerline, near.station);
        (inside && room > 0.0).then_some((room, along))
    })
}

fn is_on_walk(network: &RoadNetwork, point: Point2) -> bool {
    network.sidewalks.iter().any(|walk| {
        polyline::closest(&walk.path, &point).is_some_and(|near| near.distance < walk.width * 0.5 - 0.01)
    })
}

fn corners(world: &World, thing: EntityId) -> [Point2; 4] {
    world.entity(thing).expect("it was made").obb().footprint()
}

#[test]
fn cars_before_houses_are_parked_along_the_street() {
    let (world, houses) = town();
    let network = world.roads().expect("a city has streets").clone();
    let (mut parked, mut made) = (0, 0);
    for house in houses {
        let mut world = world.clone();
        let Some(edited) = add(&mut world, "sports_car", Relation::InFrontOf, house) else { continue };
        made += 1;
        assert_eq!(edited.astray.is_empty(), edited.answer.is_none(), "what is astray is told");
        if !edited.astray.is_empty() {
            continue;
        }
        parked += 1;
        let car = world.entity(edited.made[0]).expect("it was made");
        let (_, along) = on_carriageway(&network, car.planar()).expect("it stands on a street");
        let (aside, _) = sin_cos(yaw_of(car.pose) - along);
        assert!(aside.abs() < 0.21, "before {house} it stands across the street: {aside}");
        let rooms = corners(&world, edited.made[0]).map(|corner| on_carriageway(&network, corner));
        assert!(rooms.iter().all(Option::is_some), "before {house} a wheel is on the sidewalk: {rooms:?}");
        let least = rooms.iter().flatten().map(|(room, _)| *room).fold(f64::INFINITY, f64::min);
        assert!(least < PARKED, "before {house} it stands {least} m from the kerb");
    }
    assert!(parked * 3 >= made && parked >= 4, "{parked} of {made} are parked along a street");
}

#[test]
fn trees_and_furniture_keep_off_the_streets_and_trees_off_the_sidewalks() {
    let (world, houses) = town();
    let network = world.roads().expect("a city has streets").clone();
    let mut made = 0;
    for (rank, house) in houses.into_iter().enumerate() {
        let asset = ["tree", "bench", "street_lamp", "trash_bin"][rank % 4];
        let mut world = world.clone();
        let Some(edited) = add(&mut world, asset, Relation::Near, house) else { continue };
        made += 1;
        for corner in corners(&world, edited.made[0]) {
            assert_eq!(on_carriageway(&network, corner), None, "{asset} near {house}");
            let walk = is_on_walk(&network, corner);
            assert!(
                asset != "tree" || !walk || !edited.astray.is_empty(),
                "a tree near {house} is on a sidewalk"
            );
        }
    }
    assert!(made * 2 >= HOUSES, "only {made} had room");
}
