//! How long a complete square kilometre takes, cold: streets, lanes, lots, buildings, elements; and on two threads.

use std::time::Instant;

use criterion::{Criterion, criterion_group, criterion_main};
use rayon::ThreadPoolBuilder;
use simworld_citygen::Style;
use simworld_citygen::tile::{Tile, TileConfig, TileId, TileSource};
use simworld_core::seed::Seed;

fn source(style: Style) -> TileSource {
    TileSource::new(TileConfig::of_style(style), Seed(7)).expect("styles are valid")
}

fn cold(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("tile");
    group.sample_size(20);
    let pool = ThreadPoolBuilder::new().num_threads(1).build().expect("one thread can be had");
    for style in Style::ALL {
        let source = source(style);
        // A new tile each time, so that no one layout decides.
        let mut x = 0;
        group.bench_function(format!("{style}_1_km2_one_core"), |bencher| {
            pool.install(|| {
                bencher.iter(|| {
                    x = (x + 1) % 2000;
                    source.tile(TileId::new(x, 3))
                });
            });
        });
    }
    group.finish();
}

/// Prints how much faster two threads are, after checking that they make the same tiles.
#[allow(clippy::disallowed_methods, reason = "a bench looks at the clock")]
fn threads(_: &mut Criterion) {
    let source = source(Style::Mixed);
    let ids: Vec<TileId> = (0..64).map(|index| TileId::new(index % 8, index / 8)).collect();
    let mut times = Vec::new();
    let mut made: Vec<Vec<Tile>> = Vec::new();
    for count in [1, 2] {
        let pool = ThreadPoolBuilder::new().num_threads(count).build().expect("two threads can be had");
        let mut best = f64::INFINITY;
        for _ in 0..3 {
            let start = Instant::now();
            let tiles = pool.install(|| source.tiles(&ids)).expect("the tiles are near");
            best = best.min(start.elapsed().as_secs_f64());
            made.truncate(count - 1);
            made.push(tiles);
        }
        times.push(best);
    }
    assert!(made[0] == made[1], "threads matter");
    println!(
        "64 tiles: {:.1} ms a tile on one thread, {:.1} ms on two: {:.2} times as fast, the same bits",
        times[0] / 64.0 * 1e3,
        times[1] / 64.0 * 1e3,
        times[0] / times[1]
    );
}

criterion_group!(benches, cold, threads);
criterion_main!(benches);
