//! From every lot and every building one can walk to every other: the walkable graph is one part, and fronts and doors
//! are at it.

use simworld_citygen::{City, CityConfig};
use simworld_core::geometry::Point2;
use simworld_core::id::WaypointId;
use simworld_core::net::{WaypointConfig, WaypointGraph, polyline};
use simworld_core::seed::Seed;

/// The part of the graph that can be reached from the first waypoint.
fn reached(ways: &WaypointGraph) -> Vec<bool> {
    let mut seen = vec![false; ways.waypoints().len()];
    let mut pending = vec![WaypointId::from_index(0)];
    while let Some(at) = pending.pop() {
        if std::mem::replace(&mut seen[at.index()], true) {
            continue;
        }
        pending.extend(ways.edges(at).iter().map(|edge| edge.to).filter(|to| !seen[to.index()]));
    }
    seen
}

#[test]
fn every_place_can_be_walked_to() {
    let seeds = if std::env::var_os("SIMWORLD_SOAK").is_some() { 500 } else { 12 };
    for seed in 0..seeds {
        let city = City::generate(&CityConfig::with_roads(12 + 4 * (seed % 12) as u32), Seed(seed)).unwrap();
        let config = WaypointConfig::default();
        let ways = WaypointGraph::walkable(&city.network, &config).unwrap();
        let reached = reached(&ways);
        assert!(reached.iter().all(|reached| *reached), "seed {seed}: a sidewalk that nobody can reach");
        for building in &city.buildings {
            let nearest = ways.nearest(building.access).expect("there are waypoints");
            let away = (ways.waypoint(nearest).position - building.access).norm();
            assert!(away < 6.0, "seed {seed}: a door {away} m from any waypoint");
        }
        let land = city.land();
        assert!(land.lots.len() > 30, "seed {seed} has {} lots", land.lots.len());
        for lot in &land.lots {
            let outline = land.outline(lot);
            let middle: Point2 = nalgebra::center(&outline[0], &outline[1]);
            let walk = city.network.sidewalk(lot.road, lot.side).expect("a lot has its front to a sidewalk");
            let road = &city.network.roads[lot.road.index()];
            let corners = [road.from, road.to].map(|end| &city.network.intersections[end.index()].corners);
            let away = corners
                .into_iter()
                .flatten()
                .chain([&walk.path])
                .filter_map(|path| polyline::closest(path, &middle))
                .map(|closest| closest.distance)
                .fold(f64::INFINITY, f64::min);
            // Half the sidewalk, and what a straight front may leave a street that bends to and fro.
            assert!(away < walk.width * 0.5 + 5.0, "seed {seed}: a front {away} m from its sidewalk");
        }
    }
}
