//! Roads: deriving a network, building its waypoints, and routes across the city.

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use simworld_core::id::WaypointId;
use simworld_core::net::{
    NetworkConfig, RoadNetwork, Route, RouteScratch, StreetPlan, WaypointConfig, WaypointGraph,
};
use simworld_core::seed::Seed;

fn bench(criterion: &mut Criterion) {
    let plan = StreetPlan::grid(20, 20, 150.0);
    let config = NetworkConfig::default();
    criterion.bench_function("derive a grid of 400 crossroads", |b| {
        b.iter(|| black_box(RoadNetwork::derive(&plan, &config).expect("a grid is sound")));
    });
    let network = RoadNetwork::derive(&plan, &config).expect("a grid is sound");
    let waypoints = WaypointConfig::default();
    criterion.bench_function("its walkable waypoints, 10 m apart", |b| {
        b.iter(|| black_box(WaypointGraph::walkable(&network, &waypoints).expect("the defaults are sound")));
    });
    let walks = WaypointGraph::walkable(&network, &waypoints).expect("the defaults are sound");
    let coarse = WaypointGraph::coarse(&network);
    for (name, graph) in [("a walk across the city", &walks), ("a coarse route across the city", &coarse)] {
        let mut rng = Seed(3).stream("bench/routes").rng();
        let (mut scratch, mut route) = (RouteScratch::default(), Route::default());
        criterion.bench_function(name, |b| {
            b.iter(|| {
                let mut draw = || WaypointId::from_index(rng.below(graph.waypoints().len()));
                let (from, to) = (draw(), draw());
                black_box(graph.route(from, to, &mut scratch, &mut route))
            });
        });
    }
}

criterion_group!(benches, bench);
criterion_main!(benches);
