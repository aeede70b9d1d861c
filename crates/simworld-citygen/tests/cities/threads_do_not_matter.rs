//! A city is the same, bit for bit, on one thread, on two and on eight.

use rayon::ThreadPoolBuilder;
use simworld_citygen::{City, CityConfig};
use simworld_core::seed::Seed;

#[test]
fn threads_do_not_matter() {
    for (streets, seed) in [(30, 1), (700, 2)] {
        let config = CityConfig::with_roads(streets);
        let on = |threads: usize| {
            let pool = ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| {
                let city = City::generate(&config, Seed(seed)).unwrap();
                let land = city.land();
                (city, land)
            })
        };
        let one = on(1);
        assert!(one.0.buildings.len() > 100);
        for threads in [2, 8] {
            assert!(on(threads) == one, "{streets} streets on {threads} threads are another city");
        }
    }
}
