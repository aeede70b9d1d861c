//! Segments a second of street growth, with junctions, classes and bows, and of their planar graph, at three sizes.

use std::hint::black_box;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use simworld_citygen::graph::{NodeId, StreetGraph};
use simworld_citygen::{Style, growth};
use simworld_core::geometry::Point2;
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

/// The planar graph of grown streets, built whole, and a street taken out and put back.
fn graph(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("graph");
    group.sample_size(10);
    for count in [10_000, 100_000, 1_000_000] {
        let plan = growth::grow(&Style::Mixed.roads(count), Seed(3));
        group.throughput(Throughput::Elements(plan.streets.len() as u64));
        group.bench_function(BenchmarkId::new("build", count), |bencher| {
            bencher.iter(|| StreetGraph::of(black_box(&plan)).map(|graph| graph.faces().count()));
        });
        let mut graph = StreetGraph::of(&plan).expect("grown streets are planar");
        let node = NodeId(plan.nodes.len() as u32 / 2);
        let at = graph.position(node).expect("nodes keep their numbers");
        group.throughput(Throughput::Elements(2));
        group.bench_function(BenchmarkId::new("move_node_and_back", count), |bencher| {
            bencher.iter(|| {
                let there = graph.move_node(node, Point2::new(at.x + 1.0, at.y));
                (there, graph.move_node(node, at))
            });
        });
    }
    group.finish();
}

criterion_group!(benches, grow, graph);
criterion_main!(benches);
