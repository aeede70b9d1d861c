//! Segments a second of street growth, with junctions, classes and bows, at three sizes.

use std::hint::black_box;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use simworld_citygen::{Style, growth};
use simworld_core::seed::Seed;

fn grow(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("growth");
    group.sample_size(10);
    for count in [10_000, 100_000, 1_000_000] {
        for style in [Style::Grid, Style::Organic] {
            let roads = style.roads(count);
            group.throughput(Throughput::Elements(u64::from(count)));
            group.bench_function(BenchmarkId::new(style.as_str(), count), |bencher| {
                bencher.iter(|| growth::grow(black_box(&roads), Seed(3)).streets.len());
            });
        }
    }
    group.finish();
}

criterion_group!(benches, grow);
criterion_main!(benches);
