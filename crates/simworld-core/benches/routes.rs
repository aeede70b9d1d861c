//! Routes over a town of 100 000 waypoints: preparing it, and finding the way.

#![allow(clippy::disallowed_methods, reason = "a bench says how long preparing takes")]

use std::hint::black_box;
use std::time::Instant;

use criterion::{Criterion, criterion_group, criterion_main};
use simworld_core::id::WaypointId;
use simworld_core::net::{
    HierarchyScratch, NetworkConfig, RoadNetwork, Route, RouteHierarchy, RouteScratch, StreetPlan,
    WaypointConfig, WaypointGraph,
};
use simworld_core::seed::Seed;

fn bench(criterion: &mut Criterion) {
    let plan = StreetPlan::grid(36, 36, 150.0);
    let network = RoadNetwork::derive(&plan, &NetworkConfig::default()).expect("a grid is sound");
    let config = WaypointConfig::default();
    for (name, graph) in [
        ("walk", WaypointGraph::walkable(&network, &config).expect("the defaults are sound")),
        ("drive", WaypointGraph::drivable(&network, &config).expect("the defaults are sound")),
    ] {
        let begun = Instant::now();
        let hierarchy = RouteHierarchy::new(graph);
        let count = hierarchy.graph().waypoints().len();
        println!("{name}: {count} waypoints prepared in {:.2?}", begun.elapsed());
        let mut route = Route::default();
        let mut rng = Seed(3).stream("bench/routes").rng();
        let mut draw = move || WaypointId::from_index(rng.below(count));
        let mut scratch = HierarchyScratch::default();
        criterion.bench_function(&format!("a {name} over {count} waypoints, by the hierarchy"), |b| {
            b.iter(|| black_box(hierarchy.route(draw(), draw(), &mut scratch, &mut route)));
        });
        let mut scratch = RouteScratch::default();
        criterion.bench_function(&format!("a {name} over {count} waypoints, by A*"), |b| {
            b.iter(|| black_box(hierarchy.graph().route(draw(), draw(), &mut scratch, &mut route)));
        });
    }
}

criterion_group!(benches, bench);
criterion_main!(benches);
