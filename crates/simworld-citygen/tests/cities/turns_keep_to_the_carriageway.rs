//! Nobody who follows a way over a junction drives over a sidewalk, whatever the angles and widths of the streets that meet.

use simworld_citygen::{City, CityConfig, Style};
use simworld_core::geometry::Point2;
use simworld_core::net::{Connection, RoadNetwork, polyline};
use simworld_core::seed::Seed;

/// The middle of a way of cars, and of one of bicycles, stays this far inside of the kerbs, m: half of what goes there. Curves
/// that cut corners were up to 1.3 m beyond them.
const INSIDE: f64 = 0.85;
const CYCLE_INSIDE: f64 = 0.55;

#[test]
fn turns_keep_to_the_carriageway() {
    let mut turns = 0;
    for style in Style::ALL {
        for seed in 0..4 {
            let config = CityConfig { roads: style.roads(120), ..CityConfig::default() };
            let city = City::generate(&config, Seed(seed)).unwrap();
            turns += check(&city.network, &format!("{style:?} {seed}"));
        }
    }
    assert!(turns > 3000, "only {turns} ways were looked at");
}

/// Looks at each way over a junction of three roads or more; says how many there are.
fn check(network: &RoadNetwork, city: &str) -> usize {
    let at_junction = |way: &&Connection| network.intersections[way.intersection.index()].roads.len() >= 3;
    let ways: Vec<&Connection> = network.connections.iter().filter(at_junction).collect();
    for way in &ways {
        let is_driven = network.lanes[way.from.index()].is_driven();
        let inside = if is_driven { INSIDE } else { CYCLE_INSIDE };
        for point in &way.path {
            let room = room(network, way, point);
            assert!(room >= inside, "{city}: {way:?} is {room} m off the kerb at {point}");
        }
    }
    ways.len()
}

/// How far the paved ground reaches round a point of a way: that of the junction, or that of one of its roads, m.
fn room(network: &RoadNetwork, way: &Connection, point: &Point2) -> f64 {
    let place = &network.intersections[way.intersection.index()];
    let kerbs = place.roads.iter().filter_map(|road| {
        let road = &network.roads[road.index()];
        let beside = polyline::closest(&road.centerline, point)?;
        let kerb = if beside.lateral > 0.0 { road.left_kerb } else { road.right_kerb };
        Some(kerb - beside.distance)
    });
    let mut ring = place.outline.clone();
    ring.extend(place.outline.first());
    let edge = polyline::closest(&ring, point).map_or(f64::INFINITY, |edge| edge.distance);
    let junction = if is_inside(&ring, point) { edge } else { -edge };
    kerbs.fold(junction, f64::max)
}

/// By the crossings of a ray to the east with a closed ring.
fn is_inside(ring: &[Point2], point: &Point2) -> bool {
    let crosses = |a: &Point2, b: &Point2| {
        (a.y > point.y) != (b.y > point.y) && point.x < (b.x - a.x) * (point.y - a.y) / (b.y - a.y) + a.x
    };
    ring.windows(2).filter(|pair| crosses(&pair[0], &pair[1])).count() % 2 == 1
}
