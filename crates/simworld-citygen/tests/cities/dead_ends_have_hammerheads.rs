//! What stands on the lots keeps off the T of a dead end, a world has it as a road, and a saved city keeps it.

use simworld_citygen::{City, CityConfig};
use simworld_core::geometry::{Obb, Point2, Point3, Vector3, heading, pose_facing};
use simworld_core::net::{Street, StreetPlan};
use simworld_core::scene::{EntityKind, World};
use simworld_core::seed::Seed;

/// A square of streets, with a dead end in the middle that stops short of the far side.
fn square() -> City {
    let nodes = [(0.0, 0.0), (240.0, 0.0), (240.0, 200.0), (0.0, 200.0), (120.0, 0.0), (120.0, 188.0)];
    let streets = [(0, 4), (4, 1), (1, 2), (2, 3), (3, 0), (4, 5)];
    let mut plan = StreetPlan {
        nodes: nodes.map(|(x, y)| Point2::new(x, y)).to_vec(),
        streets: streets.map(|(from, to)| Street::simple(from, to)).to_vec(),
        ..StreetPlan::default()
    };
    plan.make_turning_room();
    City::from_plan(plan, &CityConfig::default(), Seed(5)).expect("a square can be built")
}

/// The box of the head, without its flares.
fn head(city: &City) -> Obb {
    let heads: Vec<_> = city.network.intersections.iter().filter_map(|place| place.hammerhead).collect();
    let [head] = heads[..] else { panic!("{} hammerheads", heads.len()) };
    let along = head.tips[1] - head.tips[0];
    let middle = nalgebra::center(&head.tips[0], &head.tips[1]);
    Obb {
        pose: pose_facing(Point3::new(middle.x, middle.y, 0.0), heading(&along)),
        half_extents: Vector3::new(along.norm() * 0.5, head.width * 0.5, 1.0),
    }
}

#[test]
fn lots_leave_the_head_free() {
    let city = square();
    let head = head(&city);
    assert!(city.buildings.len() > 10 && city.elements.len() > 20);
    for building in &city.buildings {
        assert!(building.solids().all(|solid| !solid.footprints_overlap(&head)), "{:?}", building.center);
    }
    for element in &city.elements {
        assert!(!element.obb().footprints_overlap(&head), "{:?} at {}", element.kind, element.position);
    }
    assert_eq!(city.report().overlaps, 0);
}

#[test]
fn a_world_has_the_arms_as_road() {
    let city = square();
    let mut world = World::new();
    city.populate(&mut world).expect("a world takes a city");
    let paved = |at: Point2| {
        let mut roads = world.iter().filter(|entity| entity.kind == EntityKind::Road);
        roads.any(|road| road.info.shape.planar_distance(road.pose, &at) < 1e-6)
    };
    // Half a metre before either tip; the street itself is 3.5 m wide to either side.
    for x in [120.0 - 9.1, 120.0 + 9.1] {
        assert!(paved(Point2::new(x, 188.0 - 3.05)), "{x}");
        assert!(!paved(Point2::new(x, 170.0)), "{x}");
    }
}

#[test]
fn a_saved_city_keeps_it() {
    let city = square();
    let mut bytes = Vec::new();
    city.write_to(&mut bytes).expect("memory takes all");
    let loaded = City::from_bytes(&bytes).expect("it was just written");
    assert_eq!(loaded.plan.streets[5].hammerhead, [false, true]);
    assert_eq!(loaded, city);
}
