//! Quickest routes over a town of 1764 junctions: preparing them, and finding the way.

#![allow(clippy::disallowed_methods, reason = "a bench says how long preparing takes")]

use std::hint::black_box;
use std::time::Instant;

use criterion::{Criterion, criterion_group, criterion_main};
use simworld_core::id::RoadId;
use simworld_core::net::{LaneDirection, NetworkConfig, RoadNetwork, StreetPlan};
use simworld_core::seed::Seed;
use simworld_traffic::{Leg, LegHierarchy, LegScratch, Router};

fn routes(criterion: &mut Criterion) {
    let plan = StreetPlan::grid(42, 42, 200.0);
    let network = RoadNetwork::derive(&plan, &NetworkConfig::default()).expect("a grid is a network");
    let legs = network.roads.len() * 2;
    let begun = Instant::now();
    let router = Router::new(&network);
    println!("{legs} legs in a router after {:.2?}", begun.elapsed());
    let begun = Instant::now();
    let hierarchy = LegHierarchy::new(&network);
    println!("{legs} legs prepared in {:.2?}", begun.elapsed());
    let mut rng = Seed(3).stream("bench/routes").rng();
    let mut draw = move || {
        let road = RoadId(rng.below(legs / 2) as u32);
        let directions = [LaneDirection::Forward, LaneDirection::Backward];
        Leg::new(road, directions[rng.below(2)])
    };
    let mut scratch = LegScratch::default();
    criterion.bench_function(&format!("a route over {legs} legs, by the hierarchy"), |b| {
        b.iter(|| black_box(hierarchy.quickest(draw(), draw(), &mut scratch)));
    });
    criterion.bench_function(&format!("a route over {legs} legs, by Dijkstra"), |b| {
        b.iter(|| black_box(router.quickest(draw(), draw())));
    });
}

criterion_group!(benches, routes);
criterion_main!(benches);
