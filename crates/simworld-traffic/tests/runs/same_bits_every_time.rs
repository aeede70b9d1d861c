//! Traffic is the same on every run, goes on after a snapshot as if nothing had been, and refuses damaged ones.

use std::sync::Arc;

use proptest::prelude::*;
use simworld_core::hash::StateHash;
use simworld_core::net::{NetworkConfig, RoadNetwork, StreetPlan};
use simworld_core::scene::World;
use simworld_core::seed::Seed;
use simworld_traffic::{Traffic, TrafficConfig, TrafficDynamics, TrafficError};

fn network() -> Arc<RoadNetwork> {
    Arc::new(
        RoadNetwork::derive(&StreetPlan::grid(3, 4, 115.0), &NetworkConfig::default())
            .expect("a grid is a network"),
    )
}

#[test]
fn same_seed_same_bits() {
    let run = |seed| {
        let mut traffic = Traffic::new(network(), &TrafficConfig::default(), Seed(seed)).unwrap();
        for _ in 0..1500 {
            traffic.step(0.1);
        }
        traffic.digest()
    };
    assert_eq!(run(1), run(1));
    assert_ne!(run(1), run(2));
}

#[test]
fn it_conforms_to_the_seam() {
    let mut world = World::new();
    world.set_roads(network());
    let bare = world.clone();
    TrafficDynamics::new(&mut world, &TrafficConfig::default(), Seed(3)).unwrap();
    simworld_core::testing::check_dynamics(&world, || {
        // The entities are those of the world already; made on a copy, the traffic has the same ids.
        let mut copy = bare.clone();
        Box::new(TrafficDynamics::new(&mut copy, &TrafficConfig::default(), Seed(3)).unwrap())
    });
}

#[test]
fn a_world_without_roads_is_refused() {
    let made = TrafficDynamics::new(&mut World::new(), &TrafficConfig::default(), Seed(3));
    assert_eq!(made.err(), Some(TrafficError::NoRoads));
}

#[test]
fn what_finds_no_room_is_reported() {
    let config = TrafficConfig { vehicles: 100_000, pedestrians: 10, ..TrafficConfig::default() };
    let traffic = Traffic::new(network(), &config, Seed(3)).unwrap();
    let placed = traffic.placed();
    assert!(placed.vehicles > 50 && placed.vehicles < 100_000, "{placed:?}");
    assert_eq!(traffic.vehicles().count(), placed.vehicles as usize);
}

proptest! {
    #[test]
    fn arbitrary_settings_are_used_or_refused(
        headway in any::<f64>(), gap in any::<f64>(), share in any::<f64>(), turns in any::<[f64; 3]>(), speed in any::<f64>(),
    ) {
        let mut config = TrafficConfig { vehicles: 5, pedestrians: 5, turns, walking_speed: speed, ..TrafficConfig::default() };
        config.types[0].driver.headway = headway;
        config.types[0].driver.gap = gap;
        config.types[1].share = share;
        if let Ok(mut traffic) = Traffic::new(network(), &config, Seed(1)) {
            traffic.step(0.1);
        }
    }
}
