//! Ways for walkers alone are those of the map: cut off where roads lie and buildings stand, joined to sidewalks, walked by
//! routes, and saved with the city.
#![cfg(feature = "osm")]

use crate::osm_common::{Sketch, all_real};
use simworld_citygen::occupancy::overlap;
use simworld_citygen::osm::PlaceOptions;
use simworld_citygen::{City, CityConfig};
use simworld_core::geometry::{Point2, Vector2, bounds};
use simworld_core::id::{RoadId, WaypointId};
use simworld_core::net::{
    RoadNetwork, Route, RouteScratch, WaypointConfig, WaypointGraph, WaypointKind, polyline,
};
use simworld_core::seed::Seed;

pub(crate) const SIDE: [(&str, &str); 1] = [("highway", "residential")];
pub(crate) const FOOT: [(&str, &str); 1] = [("highway", "footway")];

/// A block of 200 by 120 m about the origin, between streets that go on at its corners. Nodes 2 and 5 lie in the middle of
/// its long sides.
pub(crate) fn block() -> Sketch {
    let nodes = [(-100.0, -60.0), (0.0, -60.0), (100.0, -60.0), (100.0, 60.0), (0.0, 60.0), (-100.0, 60.0)];
    let far = [(-180.0, -60.0), (180.0, -60.0), (180.0, 60.0), (-180.0, 60.0)];
    let mut sketch = Sketch::default();
    for (id, at) in (1..).zip(nodes.into_iter().chain(far)) {
        sketch = sketch.node(id, at, &[]);
    }
    sketch.way(&[7, 1, 2, 3, 8], &SIDE).way(&[10, 6, 5, 4, 9], &SIDE).way(&[1, 6], &SIDE).way(&[3, 4], &SIDE)
}

pub(crate) fn built(sketch: &Sketch) -> City {
    let made = City::from_place(&sketch.place(), &PlaceOptions::default(), &CityConfig::default(), Seed(1));
    made.expect("it has streets").0
}

/// Length of all ways for walkers, m.
fn walked(city: &City) -> f64 {
    city.network.footpaths.iter().map(|way| polyline::length(&way.path)).sum()
}

/// A point about every metre of a line.
pub(crate) fn samples(path: &[Point2]) -> Vec<Point2> {
    let length = polyline::length(path);
    let count = length.ceil().max(1.0);
    (0..=count as u32).map(|index| polyline::at(path, length * f64::from(index) / count).0).collect()
}

pub(crate) fn distance(path: &[Point2], point: &Point2) -> f64 {
    polyline::closest(path, point).map_or(f64::INFINITY, |near| near.distance)
}

/// By the crossings of a ray to the east with a ring.
fn is_inside(ring: &[Point2], point: &Point2) -> bool {
    let next = ring.iter().cycle().skip(1);
    let crosses = |(a, b): &(&Point2, &Point2)| {
        (a.y > point.y) != (b.y > point.y) && point.x < (b.x - a.x) * (point.y - a.y) / (b.y - a.y) + a.x
    };
    ring.iter().zip(next).filter(crosses).count() % 2 == 1
}

/// Whether a point lies in the box round some line, or no more than 30 m beside.
fn is_near((low, high): (Point2, Point2), point: &Point2) -> bool {
    (low.x - 30.0..=high.x + 30.0).contains(&point.x) && (low.y - 30.0..=high.y + 30.0).contains(&point.y)
}

/// Nowhere on a carriageway or a junction of the ground, but for bridges and subways, and every end that joins lies on a sidewalk.
pub(crate) fn assert_beside_roads(network: &RoadNetwork, name: &str) {
    /// Where maps and kerbs touch, m.
    const HAIR: f64 = 0.3;
    let roads = network.roads.iter().filter(|road| road.level == 0);
    let roads: Vec<_> = roads.filter_map(|road| Some((road, bounds(&road.centerline)?))).collect();
    let on_ground = |road: &RoadId| network.roads[road.index()].level == 0;
    let places = network.intersections.iter().filter(|place| place.roads.iter().any(on_ground));
    let places: Vec<_> = places.filter_map(|place| Some((place, bounds(&place.outline)?))).collect();
    let on_the_ground = network.footpaths.iter().filter(|way| way.level == 0);
    for point in on_the_ground.flat_map(|way| samples(&way.path)) {
        for (road, _) in roads.iter().filter(|(_, around)| is_near(*around, &point)) {
            let Some(near) = polyline::closest(&road.centerline, &point) else { continue };
            let kerb = if near.lateral > 0.0 { road.left_kerb } else { road.right_kerb };
            // Beyond its ends there are junctions.
            let is_along = near.station > 0.01 && near.station < polyline::length(&road.centerline) - 0.01;
            assert!(!is_along || near.distance > kerb - HAIR, "{name}: {point} lies {near:?} on a road");
        }
        for (place, _) in places.iter().filter(|(_, around)| is_near(*around, &point)) {
            let mut ring = place.outline.clone();
            ring.extend(place.outline.first());
            let is_on_edge = distance(&ring, &point) < HAIR;
            assert!(is_on_edge || !is_inside(&place.outline, &point), "{name}: {point} lies on a junction");
        }
    }
    let joined = network.footpaths.iter().flat_map(|way| {
        let ends = [way.path[0], way.path[way.path.len() - 1]];
        ends.into_iter().zip(way.joins).filter(|(_, joins)| *joins).map(|(end, _)| end)
    });
    for end in joined {
        let to_walk = network.sidewalks.iter().map(|walk| distance(&walk.path, &end));
        let to_walk = to_walk.fold(f64::INFINITY, f64::min);
        assert!(to_walk < 1e-6, "{name}: {end} is {to_walk} m from a sidewalk");
    }
}

/// From every way for walkers one comes to a sidewalk.
pub(crate) fn assert_reached(network: &RoadNetwork, name: &str) {
    let graph = WaypointGraph::walkable(network, &WaypointConfig::default()).unwrap();
    let count = graph.waypoints().len();
    let all = || (0..count).map(WaypointId::from_index);
    let is_path = |id: &WaypointId| graph.waypoint(*id).kind == WaypointKind::Footpath;
    let mut reached: Vec<bool> = all().map(|id| !is_path(&id)).collect();
    let mut open: Vec<WaypointId> = all().filter(|id| !is_path(id)).collect();
    while let Some(id) = open.pop() {
        for edge in graph.edges(id) {
            if !std::mem::replace(&mut reached[edge.to.index()], true) {
                open.push(edge.to);
            }
        }
    }
    let lost = reached.iter().filter(|reached| !**reached).count();
    assert_eq!(lost, 0, "{name}: {lost} places of ways for walkers lead to no sidewalk");
}

/// The length of the way from the sidewalk at one node to that at another, m.
pub(crate) fn route(city: &City, from: Point2, to: Point2) -> f64 {
    let graph = WaypointGraph::walkable(&city.network, &WaypointConfig::default()).unwrap();
    let (from, to) = (graph.nearest(from).unwrap(), graph.nearest(to).unwrap());
    let (mut scratch, mut route) = (RouteScratch::default(), Route::default());
    assert!(graph.route(from, to, &mut scratch, &mut route), "no way");
    route.length
}

#[test]
fn a_path_leads_from_sidewalk_to_sidewalk() {
    let (south, north) = (Point2::new(0.0, -55.0), Point2::new(0.0, 55.0));
    let without = built(&block());
    assert_eq!(without.network.footpaths, []);
    let round = route(&without, south, north);
    let city = built(&block().node(20, (4.0, 0.0), &[]).way(&[2, 20, 5], &FOOT));
    let [way] = city.network.footpaths.as_slice() else { panic!("{:?}", city.network.footpaths) };
    assert_eq!((way.joins, way.width), ([true; 2], 2.0));
    // Of 120 m between the middles of two streets.
    assert!((105.0..116.0).contains(&walked(&city)), "{} m", walked(&city));
    assert!(distance(&way.path, &Point2::new(4.0, 0.0)) < 0.05, "it keeps its course");
    assert_beside_roads(&city.network, "a block");
    assert_reached(&city.network, "a block");
    let through = route(&city, south, north);
    assert!(through < 140.0 && round > 250.0, "{through} m through the block, {round} m round it");
}

/// A square in the middle of the block, to which paths lead from both long sides and from a corner.
fn block_with_a_square(tags: &[(&str, &str)]) -> Sketch {
    let mut sketch = block();
    let corners = [(-20.0, -15.0), (0.0, -15.0), (20.0, -15.0), (20.0, 15.0), (0.0, 15.0), (-20.0, 15.0)];
    for (id, at) in (30..).zip(corners) {
        sketch = sketch.node(id, at, &[]);
    }
    let square = [("highway", "pedestrian"), ("area", "yes")];
    let square: Vec<_> = square.iter().chain(tags).copied().collect();
    sketch
        .way(&[30, 31, 32, 33, 34, 35, 30], &square)
        .way(&[2, 31], &FOOT)
        .way(&[5, 34], &FOOT)
        .way(&[1, 30], &FOOT)
}

#[test]
fn a_square_is_crossed_between_its_entrances() {
    let city = built(&block_with_a_square(&[]));
    assert_beside_roads(&city.network, "a square");
    assert_reached(&city.network, "a square");
    let through = route(&city, Point2::new(0.0, -55.0), Point2::new(0.0, 55.0));
    assert!(through < 130.0, "{through} m across");
    let to_corner = route(&city, Point2::new(0.0, 55.0), Point2::new(-100.0, -55.0));
    assert!(to_corner < 170.0, "{to_corner} m from the north to the corner");
    let widths: Vec<f64> = city.network.footpaths.iter().map(|way| way.width).collect();
    assert!(widths.contains(&3.7), "{widths:?}");
    // Nothing generated stands where they cross.
    let middle = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)].map(|(x, y)| Point2::new(x, y));
    assert!(city.buildings.iter().all(|house| house.ground().iter().all(|piece| !overlap(piece, &middle))));
    assert!(city.elements.iter().all(|element| !overlap(&element.obb().footprint(), &middle)));
    // One above the ground is none, nor one that nobody may enter: its paths end there.
    for tag in [("layer", "1"), ("access", "private")] {
        let closed = built(&block_with_a_square(&[tag]));
        let round = route(&closed, Point2::new(0.0, -55.0), Point2::new(0.0, 55.0));
        assert!(round > 250.0, "{tag:?}: {round} m");
    }
}

#[test]
fn nothing_generated_stands_on_a_path() {
    let city = built(&block().way(&[2, 5], &FOOT));
    assert!(city.buildings.len() > 8 && city.elements.len() > 20);
    for point in city.network.footpaths.iter().flat_map(|way| samples(&way.path)) {
        let corner = |(x, y): (f64, f64)| point + Vector2::new(x, y);
        let square = [(-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5)].map(corner);
        // On the sidewalk at its ends there may be a lamp.
        if point.y.abs() < 50.0 {
            assert!(city.elements.iter().all(|element| !overlap(&element.obb().footprint(), &square)));
        }
        for building in &city.buildings {
            let stands = building.ground().iter().any(|piece| overlap(piece, &square));
            assert!(!stands, "a house at {} stands on the path at {point}", building.center);
        }
    }
}

#[test]
fn a_way_is_cut_off_where_a_road_or_a_building_lies() {
    // Over the southern street without a crossing, and through a building in the middle of the block.
    let mut sketch = block().node(20, (3.0, -100.0), &[]).node(21, (3.0, 45.0), &[]).way(&[20, 21], &FOOT);
    for (id, at) in (30..).zip([(-10.0, -10.0), (16.0, -10.0), (16.0, 10.0), (-10.0, 10.0)]) {
        sketch = sketch.node(id, at, &[]);
    }
    let city = built(&sketch.way(&[30, 31, 32, 33, 30], &[("building", "yes")]));
    assert_beside_roads(&city.network, "a cut way");
    assert_reached(&city.network, "a cut way");
    let house =
        city.buildings.iter().find(|building| building.center.coords.norm() < 15.0).expect("it stands");
    let points: Vec<Point2> = city.network.footpaths.iter().flat_map(|way| samples(&way.path)).collect();
    assert!(points.iter().all(|point| !(point.y.abs() < 9.0 && (point.x - 3.0).abs() < 1.0)), "{house:?}");
    // South of the street, and between it and the house; what lies beyond the house is reached from nowhere.
    assert!(points.iter().any(|point| point.y < -90.0) && points.iter().any(|point| point.y > -20.0));
    assert!(points.iter().all(|point| point.y < 0.0), "{points:?}");
}

#[test]
fn only_ways_for_walkers_are_built() {
    let with = |tags: &[(&str, &str)]| built(&block().way(&[2, 5], tags)).network.footpaths.len();
    for highway in ["footway", "path", "pedestrian", "steps"] {
        assert_eq!(with(&[("highway", highway)]), 1, "{highway}");
    }
    assert_eq!(with(&[("highway", "footway"), ("access", "private"), ("foot", "yes")]), 1);
    let left_out = [
        ("footway", "sidewalk"),
        ("footway", "crossing"),
        ("area", "yes"),
        ("indoor", "yes"),
        ("access", "private"),
        ("foot", "no"),
    ];
    for tag in left_out {
        assert_eq!(with(&[("highway", "footway"), tag]), 0, "{tag:?}");
    }
    let wide = built(&block().way(&[2, 5], &[("highway", "path"), ("width", "3")]));
    assert_eq!(wide.network.footpaths[0].width, 3.0);
}

#[test]
fn what_follows_a_street_or_leads_nowhere_is_left_out() {
    // Along the southern street, and in the middle of the block.
    let beside = block().node(20, (-80.0, -54.0), &[]).node(21, (80.0, -54.0), &[]).way(&[20, 21], &FOOT);
    assert_eq!(built(&beside).network.footpaths, []);
    let alone = block().node(20, (-40.0, 0.0), &[]).node(21, (40.0, 5.0), &[]).way(&[20, 21], &FOOT);
    assert_eq!(built(&alone).network.footpaths, []);
    // It is there once a way leads to it.
    let joined = built(&alone.way(&[2, 20], &FOOT));
    assert_eq!(joined.network.footpaths.len(), 2);
    assert_reached(&joined.network, "a way with a branch");
    // A way that meets the one along the street goes on to the street's own sidewalk.
    let city = built(&beside.node(22, (-80.0, 0.0), &[]).way(&[20, 22], &FOOT));
    assert!(!city.network.footpaths.is_empty());
    assert_beside_roads(&city.network, "a way from a sidewalk");
    assert_reached(&city.network, "a way from a sidewalk");
}

#[test]
fn a_saved_city_keeps_them() {
    let city = built(&block().way(&[2, 5], &FOOT));
    assert_eq!(city.network.footpaths.len(), 1);
    let mut bytes = Vec::new();
    city.write_to(&mut bytes).unwrap();
    assert_eq!(City::from_bytes(&bytes).unwrap(), city);
}

#[test]
fn ways_of_real_places_lie_beside_their_roads() {
    let mut total = 0.0;
    for (file, place) in all_real() {
        let (city, _) = City::from_place(&place, &PlaceOptions::default(), &CityConfig::default(), Seed(1))
            .unwrap_or_else(|error| panic!("{file}: {error}"));
        assert_eq!(city.network.check(), Ok(()), "{file}");
        assert_beside_roads(&city.network, file);
        assert_reached(&city.network, file);
        total += walked(&city);
        // The widest are pedestrian streets of the tags.
        assert!(city.network.footpaths.iter().all(|way| (0.8..=12.0).contains(&way.width)), "{file}");
        if ["monaco.osm.gz", "helsinki.osm.pbf", "neukolln.osm.gz"].contains(&file) {
            assert!(walked(&city) > 500.0, "{file}: {} m of ways", walked(&city));
        }
    }
    println!("{total:.0} m of ways for walkers");
}
