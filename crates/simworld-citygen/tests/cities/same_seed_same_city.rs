//! The same configuration and seed give the same city, bit for bit; another seed gives another.

use simworld_citygen::{City, CityConfig};
use simworld_core::hash::{StateDigest, StateHash};
use simworld_core::scene::World;
use simworld_core::seed::Seed;

fn digest(config: &CityConfig, seed: u64) -> StateDigest {
    let mut world = World::new();
    let city = City::generate(config, Seed(seed)).expect("the settings are in range");
    city.populate(&mut world).expect("a world takes its city");
    world.finish_step();
    world.digest()
}

#[test]
fn same_seed_same_city() {
    let config = CityConfig::default();
    assert_eq!(digest(&config, 4), digest(&config, 4));
    assert_ne!(digest(&config, 4), digest(&config, 5));
}

#[test]
fn one_more_bench_moves_no_house() {
    let mut config = CityConfig::default();
    let before = City::generate(&config, Seed(4)).unwrap();
    config.elements.furniture *= 2.0;
    let after = City::generate(&config, Seed(4)).unwrap();
    assert_eq!(before.buildings, after.buildings);
    assert_ne!(before.elements.len(), after.elements.len());
}
