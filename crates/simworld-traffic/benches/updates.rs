//! Vehicle and pedestrian updates per second on one core: on a grid with 7 to 8 vehicles per lane-kilometre, and in a crowd
//! of 10 000 between walls at one per m².

use std::sync::Arc;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use simworld_core::net::{NetworkConfig, RoadNetwork, StreetPlan};
use simworld_core::seed::Seed;
use simworld_traffic::validation::halls::Halls;
use simworld_traffic::{Traffic, TrafficConfig};

/// Traffic after its first minute, when it has left its starting places.
fn running(columns: usize, vehicles: u32, pedestrians: u32) -> Traffic {
    let plan = StreetPlan::grid(columns, columns, 200.0);
    let network = RoadNetwork::derive(&plan, &NetworkConfig::default()).expect("a grid is a network");
    let config = TrafficConfig { vehicles, pedestrians, ..TrafficConfig::default() };
    let mut traffic = Traffic::new(Arc::new(network), &config, Seed(1)).expect("the settings are in range");
    assert_eq!((traffic.placed().vehicles, traffic.placed().pedestrians), (vehicles, pedestrians));
    for _ in 0..600 {
        traffic.step(0.1);
    }
    traffic
}

fn updates(c: &mut Criterion) {
    let mut group = c.benchmark_group("updates");
    for (name, columns, vehicles, pedestrians) in [
        ("1k vehicles", 13, 1_000, 0),
        ("10k vehicles", 42, 10_000, 0),
        ("10k pedestrians", 19, 0, 10_000),
        ("10k vehicles, 10k pedestrians", 42, 10_000, 10_000),
    ] {
        let mut traffic = running(columns, vehicles, pedestrians);
        group.throughput(Throughput::Elements(u64::from(vehicles + pedestrians)));
        group.bench_function(name, |bencher| bencher.iter(|| traffic.step(0.1)));
    }
    group.finish();
}

/// Ten thousand people between walls.
fn crowd(c: &mut Criterion) {
    let mut halls = Halls::new(1);
    let mut step = || halls.step(0.1);
    for _ in 0..600 {
        step();
    }
    let mut group = c.benchmark_group("crowd");
    group.throughput(Throughput::Elements(10_000));
    group.bench_function("10k pedestrians between walls, 1 per m²", |bencher| bencher.iter(&mut step));
    group.finish();
}

criterion_group!(benches, updates, crowd);
criterion_main!(benches);
