//! What several tests of the whole share.

pub mod driving;
mod minded;
pub mod traffic;

use simworld_citygen::City;
use simworld_core::seed::Seed;
use simworld_examples::delivery::{Assembly, RunConfig, assemble, make_city};

/// A small run: a hamlet with a few couriers.
pub fn small(steps: u64) -> RunConfig {
    let mut config = RunConfig {
        seed: 3,
        seeds: 2,
        agents: 8,
        steps,
        vehicles: 16,
        pedestrians: 24,
        frames: 0,
        digest_interval: 5,
        ..RunConfig::default()
    };
    config.city.roads.count = 14;
    // Enough orders that a short run has work to do.
    config.delivery.orders.hunger_rate = 1.0;
    config
}

/// Its city and its first episode.
pub fn assembled(config: &RunConfig) -> (City, Assembly) {
    let (city, _) = make_city(config).expect("the configuration is sound");
    let assembly = assemble(config, &city, Seed(config.seed)).expect("the parts fit");
    (city, assembly)
}
