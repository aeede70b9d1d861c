//! What a city is, a world made of it holds: all entities in one store, doors, names, signal posts beside the walkers' way.

use simworld_citygen::{City, CityConfig};
use simworld_core::geometry::Point2;
use simworld_core::net::polyline;
use simworld_core::scene::{EntityKind, Scene, World};
use simworld_core::seed::Seed;

#[test]
fn a_city_becomes_a_world() {
    let city = City::generate(&CityConfig::default(), Seed(6)).unwrap();
    let mut world = World::new();
    let entities = city.populate(&mut world).unwrap();
    assert_eq!(world.roads(), Some(&city.network));
    assert_eq!(
        (entities.buildings.len(), entities.elements.len()),
        (city.buildings.len(), city.elements.len())
    );
    for (id, building) in entities.buildings.iter().zip(&city.buildings) {
        let entity = world.entity(*id).expect("it was spawned");
        assert_eq!((entity.info.place, &entity.info.name), (Some(building.place), &building.name));
        assert!(entity.bounds.min.z.abs() < 1e-9, "a building stands on the ground");
    }
    for surface in &entities.surfaces {
        let top = world.entity(*surface).expect("it was spawned").bounds.max.z;
        assert!((-0.05..=1e-9).contains(&top), "people walk at z = 0, not over a step of {top} m");
    }
}

#[test]
fn signal_posts_stand_at_kerbs() {
    let city = City::generate(&CityConfig::default(), Seed(6)).unwrap();
    let mut world = World::new();
    let entities = city.populate(&mut world).unwrap();
    assert!(!entities.signals.is_empty());
    for id in &entities.signals {
        let post = world.entity(*id).expect("it was spawned");
        assert_eq!(post.kind, EntityKind::TrafficSignal);
        let at = Point2::new(post.position().x, post.position().y);
        let distance =
            |path: &Vec<Point2>| polyline::closest(path, &at).map_or(f64::INFINITY, |c| c.distance);
        let to_lane =
            city.network.lanes.iter().map(|lane| distance(&lane.path)).fold(f64::INFINITY, f64::min);
        let to_walk =
            city.network.sidewalks.iter().map(|walk| distance(&walk.path)).fold(f64::INFINITY, f64::min);
        assert!(to_lane > 1.75 + 0.08, "a post stands {to_lane} m from the middle of a lane");
        assert!(to_walk > 0.6, "a post stands {to_walk} m from the middle of a sidewalk");
    }
}

#[test]
fn there_is_room_to_sit_down() {
    let (mut benches, mut chairs) = (0, 0);
    for seed in 0..4 {
        let city = City::generate(&CityConfig::default(), Seed(seed)).unwrap();
        let mut world = World::new();
        city.populate(&mut world).unwrap();
        for seat in world.iter().filter(|entity| entity.kind.is_seat()) {
            let spot = seat.access_point().expect("a seat says where one sits down").xy();
            let reach = seat.info.shape.planar_distance(seat.pose, &spot);
            assert!(reach <= 1.0, "{} is sat down on from {reach:.2} m away", seat.id);
            let body = 0.25;
            let in_the_way = world.nearest(spot, body, &|thing| thing.is_solid());
            assert!(
                in_the_way.is_none(),
                "seed {seed}: {:?} stands at {} {}",
                in_the_way,
                seat.kind,
                seat.id
            );
            *(if seat.kind == EntityKind::Chair { &mut chairs } else { &mut benches }) += 1;
        }
    }
    assert!(benches > 50 && chairs > 20, "{benches} benches, {chairs} chairs");
}
