//! Squares with something in the middle: people cross them round fountains, lawns and houses.
#![cfg(feature = "osm")]

use crate::osm_common::Sketch;
use crate::ways_for_walkers::{FOOT, assert_beside_roads, assert_reached, block, built, route, samples};
use simworld_citygen::City;
use simworld_citygen::CityConfig;
use simworld_citygen::occupancy::Occupancy;
use simworld_citygen::osm::{OsmId, PlaceOptions, Warning};
use simworld_core::geometry::{Point2, Vector2};
use simworld_core::net::{Footpath, Plaza, polyline};
use simworld_core::scene::{EntityKind, World};
use simworld_core::seed::Seed;

const SQUARE: [(&str, &str); 3] = [("type", "multipolygon"), ("highway", "pedestrian"), ("area", "yes")];

/// A block with the edge of a square, way 1005, that ways lead to from both long sides, and what lies in its middle, way 1006.
fn ways(edge: &[(&str, &str)], hole: &[(&str, &str)]) -> Sketch {
    let mut sketch = block();
    let corners = [(-30.0, -25.0), (0.0, -25.0), (30.0, -25.0), (30.0, 25.0), (0.0, 25.0), (-30.0, 25.0)];
    for (id, at) in (30..).zip(corners) {
        sketch = sketch.node(id, at, &[]);
    }
    for (id, at) in (40..).zip([(-12.0, -8.0), (12.0, -8.0), (12.0, 8.0), (-12.0, 8.0)]) {
        sketch = sketch.node(id, at, &[]);
    }
    sketch = sketch.way(&[30, 31, 32, 33, 34, 35, 30], edge).way(&[40, 41, 42, 43, 40], hole);
    sketch.way(&[2, 31], &FOOT).way(&[5, 34], &FOOT)
}

const MEMBERS: [(i64, &str); 2] = [(1005, "outer"), (1006, "inner")];

/// How near the ways for walkers come to the hole, m; less than nothing within it.
fn beside_the_hole(city: &City) -> f64 {
    let apart = |at: Point2| (at.x.abs() - 12.0).max(at.y.abs() - 8.0);
    let points = city.network.footpaths.iter().flat_map(|way| samples(&way.path));
    points.map(apart).fold(f64::INFINITY, f64::min)
}

fn across(city: &City) -> f64 {
    route(city, Point2::new(0.0, -55.0), Point2::new(0.0, 55.0))
}

#[test]
fn holes_are_not_walked_through() {
    let area = [("highway", "pedestrian"), ("area", "yes")];
    let old = [("type", "multipolygon")];
    let named = [("type", "multipolygon"), ("place", "square")];
    let drawn = [
        // The relation is the square; its edge, or nothing but its name, says so too.
        ways(&[], &[]).relation(7, &MEMBERS, &SQUARE),
        ways(&area, &[]).relation(7, &MEMBERS, &SQUARE),
        ways(&[], &[]).relation(7, &MEMBERS, &named),
        // Its edge is the square, as it was drawn long ago.
        ways(&area, &[]).relation(7, &MEMBERS, &old),
        // Nobody drew a hole, and something stands there.
        ways(&area, &[("amenity", "fountain")]),
        ways(&area, &[("natural", "water")]),
        ways(&area, &[("building", "yes")]),
    ];
    for (index, sketch) in drawn.iter().enumerate() {
        let city = built(sketch);
        let (beside, length) = (beside_the_hole(&city), across(&city));
        assert!(beside > 0.45, "{index}: {beside} m");
        assert!((112.0..140.0).contains(&length), "{index}: {length} m");
        assert_beside_roads(&city.network, "a hole");
        assert_reached(&city.network, "a hole");
        let mut bytes = Vec::new();
        city.write_to(&mut bytes).unwrap();
        assert_eq!(City::from_bytes(&bytes).unwrap(), city);
    }
    // What lies flat is walked over.
    let flat = built(&ways(&area, &[("landuse", "grass")]));
    assert!(beside_the_hole(&flat) < 0.0 && across(&flat) < 112.0);
}

#[test]
fn nobody_crosses_what_is_no_square() {
    let other = [("type", "multipolygon"), ("landuse", "grass")];
    let above = [("type", "multipolygon"), ("highway", "pedestrian"), ("layer", "1")];
    let closed = [("type", "multipolygon"), ("place", "square"), ("access", "private")];
    for tags in [&other[..], &above, &closed] {
        let length = across(&built(&ways(&[], &[]).relation(7, &MEMBERS, tags)));
        assert!(length > 250.0, "{tags:?}: {length} m");
    }
}

#[test]
fn a_square_without_a_closed_edge_is_told() {
    let open = ways(&[], &[]).way(&[30, 31, 32], &[]).relation(7, &[(1009, "outer")], &SQUARE);
    let (_, warnings): (City, Vec<Warning>) =
        City::from_place(&open.place(), &PlaceOptions::default(), &CityConfig::default(), Seed(1)).unwrap();
    let [warning] = &warnings[..] else { panic!("{warnings:?}") };
    assert_eq!(warning.element, Some(OsmId::Relation(7)));
}

#[test]
fn an_edge_of_several_ways_and_a_way_to_its_hole() {
    // The edge in two halves, and a way from the square's corner to a door in the hole.
    let mut sketch = ways(&[], &[]).way(&[30, 31, 32, 33], &[]).way(&[33, 34, 35, 30], &[]);
    sketch = sketch.node(50, (25.0, 0.0), &[]).way(&[33, 50, 42], &FOOT);
    let city = built(&sketch.relation(7, &[(1009, "outer"), (1010, "outer"), (1006, "inner")], &SQUARE));
    assert!((112.0..140.0).contains(&across(&city)));
    let to_the_hole = route(&city, Point2::new(0.0, -55.0), Point2::new(12.0, 8.0) + Vector2::new(0.1, 0.1));
    assert!(to_the_hole < 110.0, "{to_the_hole} m");
}

/// The only plaza of a city.
fn plaza(city: &City) -> &Plaza {
    let [plaza] = city.network.plazas.as_slice() else { panic!("{:?}", city.network.plazas) };
    plaza
}

/// How much of a plaza is paved in a world, m²: the walks whose middle lies on it.
fn paved_over(city: &City, plaza: &Plaza) -> f64 {
    let mut world = World::new();
    city.populate(&mut world).unwrap();
    let walks = world.iter().filter(|entity| entity.kind == EntityKind::Sidewalk);
    let on_it = walks.filter(|walk| plaza.contains(walk.pose.translation.vector.xy().into()));
    on_it.map(|walk| walk.info.shape.size().x * walk.info.shape.size().y).sum()
}

#[test]
fn the_open_part_of_a_square_is_a_plaza() {
    let area = [("highway", "pedestrian"), ("area", "yes")];
    // 60 m by 50 m, with 24 m by 16 m in its middle, or not.
    for (hole, expected) in [
        (&[][..], 3000.0),
        (&[("building", "yes")], 3000.0 - 384.0),
        (&[("amenity", "fountain")], 3000.0 - 384.0),
    ] {
        let city = built(&ways(&area, hole));
        let plaza = plaza(&city);
        assert!((plaza.area() - expected).abs() < 1.0, "{hole:?}: {} m²", plaza.area());
        assert_eq!(plaza.contains(Point2::new(0.0, 0.0)), hole.is_empty());
        assert!(plaza.contains(Point2::new(-29.0, -24.0)) && !plaza.contains(Point2::new(-31.0, 0.0)));
        // Ways across it know it, those to it do not.
        let middle = |way: &Footpath| polyline::at(&way.path, polyline::length(&way.path) * 0.5).0;
        let (across, others): (Vec<&Footpath>, Vec<_>) =
            city.network.footpaths.iter().partition(|way| way.plaza.is_some());
        assert!(!across.is_empty() && across.iter().all(|way| plaza.contains(middle(way))));
        assert!(paved_over(&city, plaza) > 0.98 * expected, "{} m² are paved", paved_over(&city, plaza));
        assert!(others.len() >= 2 && !others.iter().any(|way| plaza.contains(middle(way))));
    }
}

#[test]
fn what_is_driven_on_is_no_part_of_a_plaza() {
    // Far over the streets to the south and to the north, as squares are often drawn.
    let mut sketch = block();
    for (id, at) in (30..).zip([(-30.0, -80.0), (30.0, -80.0), (30.0, 80.0), (-30.0, 80.0)]) {
        sketch = sketch.node(id, at, &[]);
    }
    let area = [("highway", "pedestrian"), ("area", "yes")];
    let city = built(&sketch.way(&[30, 31, 32, 33, 30], &area).way(&[2, 31], &FOOT).way(&[5, 33], &FOOT));
    let taken = Occupancy::of_roads(&city.network);
    let sides =
        city.network.plazas.iter().flat_map(Plaza::sides).filter(|[from, to]| (to - from).norm() > 0.5);
    for [from, to] in sides {
        let left = Vector2::new(from.y - to.y, to.x - from.x).normalize();
        let inner = nalgebra::center(&from, &to) + left * 0.05;
        let near = [(-0.01, -0.01), (0.01, -0.01), (0.01, 0.01), (-0.01, 0.01)];
        assert!(taken.is_free(&near.map(|(x, y)| inner + Vector2::new(x, y))), "{inner} lies on a street");
    }
    assert!(city.network.plazas.iter().any(|plaza| plaza.area() > 2000.0), "{:?}", city.network.plazas);
}
