//! How long a whole city takes: streets, network, buildings, elements.

use criterion::{Criterion, criterion_group, criterion_main};
use simworld_citygen::{City, CityConfig};
use simworld_core::scene::World;
use simworld_core::seed::Seed;

fn generate(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("generate");
    group.sample_size(10);
    for (name, roads) in [("city_40_roads", 40), ("city_1000_roads", 1000), ("city_10000_roads", 10_000)] {
        let config = CityConfig::with_roads(roads);
        // A new seed each time, so that no one layout decides.
        let mut seed = 0;
        group.bench_function(name, |bencher| {
            bencher.iter(|| {
                seed += 1;
                City::generate(&config, Seed(seed))
            });
        });
    }
    group.finish();
}

fn use_it(criterion: &mut Criterion) {
    let city = City::generate(&CityConfig::default(), Seed(1)).expect("the default configuration is valid");
    criterion.bench_function("populate_40_roads", |bencher| {
        bencher.iter(|| city.populate(&mut World::new()));
    });
    criterion.bench_function("svg_40_roads", |bencher| bencher.iter(|| city.svg()));
}

criterion_group!(benches, generate, use_it);
criterion_main!(benches);
