//! How fast a city is saved, loaded, drawn and exported; with `SIMWORLD_SOAK=1`, a city of a million buildings.

use std::hint::black_box;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use simworld_citygen::{City, CityConfig};
use simworld_core::seed::Seed;

/// Street segments of a city, and times it is measured.
fn sizes() -> Vec<u32> {
    if std::env::var_os("SIMWORLD_SOAK").is_some() {
        vec![300, 3000, 30_000, 130_000]
    } else {
        vec![300, 3000]
    }
}

fn saved(city: &City) -> Vec<u8> {
    let mut bytes = Vec::new();
    city.write_to(&mut bytes).expect("memory takes all");
    bytes
}

fn files(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("files");
    group.sample_size(10);
    for roads in sizes() {
        let city = City::generate(&CityConfig::with_roads(roads), Seed(7)).expect("defaults are valid");
        let bytes = saved(&city);
        let buildings = city.buildings.len();
        group.throughput(Throughput::Elements(buildings as u64));
        group.bench_function(BenchmarkId::new("save", buildings), |bencher| {
            bencher.iter(|| saved(&city).len());
        });
        group.bench_function(BenchmarkId::new("load", buildings), |bencher| {
            bencher.iter(|| City::from_bytes(black_box(&bytes)).expect("it was just saved"));
        });
        group.bench_function(BenchmarkId::new("svg", buildings), |bencher| bencher.iter(|| city.svg().len()));
        group.bench_function(BenchmarkId::new("glb", buildings), |bencher| {
            bencher.iter(|| city.write_glb(&mut std::io::sink()).expect("a sink takes all"));
        });
        group.bench_function(BenchmarkId::new("sumo", buildings), |bencher| {
            bencher.iter(|| city.write_sumo(&mut std::io::sink()).expect("a sink takes all"));
        });
        group.bench_function(BenchmarkId::new("opendrive", buildings), |bencher| {
            bencher.iter(|| city.write_opendrive(&mut std::io::sink()).expect("a sink takes all"));
        });
    }
    group.finish();
}

criterion_group!(benches, files);
criterion_main!(benches);
