//! Lots, buildings and street elements a second, on one core, on a grid of crooked streets.
//!
//! The number of streets is 20,000; `SIMWORLD_SOAK=1` takes 145,000 for a million buildings.

use criterion::{BatchSize, Criterion, Throughput, criterion_group, criterion_main};
use simworld_citygen::building;
use simworld_citygen::element::{self, Setting};
use simworld_citygen::lot::Land;
use simworld_citygen::occupancy::Occupancy;
use simworld_citygen::zoning::Zoning;
use simworld_citygen::{BuildingConfig, CityConfig};
use simworld_core::geometry::{Point2, Vector2};
use simworld_core::net::{NetworkConfig, RoadNetwork, Street, StreetPlan};
use simworld_core::seed::Seed;

/// Streets between the nodes of a lattice, each node moved a little.
fn crooked_grid(side: usize) -> StreetPlan {
    let mut plan = StreetPlan::default();
    let mut rng = Seed(1).stream("bench/grid").rng();
    for index in 0..side * side {
        let at = Point2::new((index % side) as f64 * 110.0, (index / side) as f64 * 100.0);
        plan.nodes.push(at + Vector2::new(rng.uniform(-9.0, 9.0), rng.uniform(-9.0, 9.0)));
    }
    for index in 0..side * side {
        if index % side + 1 < side {
            plan.streets.push(Street::simple(index, index + 1));
        }
        if index + side < side * side {
            plan.streets.push(Street::simple(index, index + side));
        }
    }
    plan
}

fn land(criterion: &mut Criterion) {
    let side = if std::env::var_os("SIMWORLD_SOAK").is_some() { 270 } else { 101 };
    let plan = crooked_grid(side);
    let network = RoadNetwork::derive(&plan, &NetworkConfig::default()).expect("the lattice is valid");
    let (config, seed) = (CityConfig::default(), Seed(1));
    let zoning = Zoning::new(&config.zoning, seed);
    let roads = Occupancy::of_roads(&network);
    let land = Land::of_network(&network, &zoning, &config.lots, seed, &roads);
    let build =
        |taken: &mut Occupancy| building::build(&network, &land, &BuildingConfig::default(), seed, taken);
    let mut taken = roads.clone();
    let buildings = build(&mut taken);
    let setting = Setting {
        plan: &plan,
        network: &network,
        zoning: &zoning,
        land: &land,
        buildings: &buildings,
        within: None,
    };
    let furnish = |taken: &mut Occupancy| element::furnish(&setting, &config.elements, seed, taken);
    let elements = furnish(&mut taken.clone()).len();

    let mut group = criterion.benchmark_group("land");
    group.sample_size(10);
    group.throughput(Throughput::Elements(land.lots.len() as u64));
    group.bench_function("lots", |bencher| {
        bencher.iter(|| Land::of_network(&network, &zoning, &config.lots, seed, &roads));
    });
    group.throughput(Throughput::Elements(buildings.len() as u64));
    group.bench_function("buildings", |bencher| {
        bencher.iter_batched_ref(|| roads.clone(), build, BatchSize::PerIteration);
    });
    group.throughput(Throughput::Elements(elements as u64));
    group.bench_function("elements", |bencher| {
        bencher.iter_batched_ref(|| taken.clone(), furnish, BatchSize::PerIteration);
    });
    group.finish();
}

criterion_group!(benches, land);
criterion_main!(benches);
