//! Saved bytes that are damaged or somebody else's are refused with an error, and the traffic goes on.

use std::sync::Arc;

use proptest::prelude::*;
use simworld_core::net::{NetworkConfig, RoadNetwork, StreetPlan};
use simworld_core::scene::World;
use simworld_core::seam::{Dynamics, DynamicsError};
use simworld_core::seed::Seed;
use simworld_traffic::{TrafficConfig, TrafficDynamics};

/// A small city after three seconds.
fn started(vehicles: u32) -> (World, TrafficDynamics) {
    let network = RoadNetwork::derive(&StreetPlan::grid(2, 2, 60.0), &NetworkConfig::default())
        .expect("a grid is a network");
    let mut world = World::new();
    world.set_roads(Arc::new(network));
    let config = TrafficConfig { vehicles, pedestrians: 5, ..TrafficConfig::default() };
    let mut traffic = TrafficDynamics::new(&mut world, &config, Seed(1)).expect("it has roads");
    (0..30).for_each(|_| traffic.step(&mut world, 0.1).expect("a step succeeds"));
    (world, traffic)
}

fn is_refused(world: &World, traffic: &mut TrafficDynamics, bytes: &[u8]) -> bool {
    matches!(traffic.restore(world, bytes), Err(DynamicsError::Saved(_)))
}

proptest! {
    #[test]
    fn foreign_bytes_are_refused(bytes in prop::collection::vec(any::<u8>(), 0..400)) {
        let (mut world, mut traffic) = started(10);
        prop_assert!(is_refused(&world, &mut traffic, &bytes));
        traffic.step(&mut world, 0.1).unwrap();
    }

    #[test]
    fn a_changed_byte_is_noticed(place in any::<prop::sample::Index>(), change in 1..=u8::MAX) {
        let (mut world, mut traffic) = started(10);
        let mut bytes = traffic.save().unwrap();
        let place = place.index(bytes.len());
        bytes[place] ^= change;
        prop_assert!(is_refused(&world, &mut traffic, &bytes));
        traffic.step(&mut world, 0.1).unwrap();
    }
}

#[test]
fn a_snapshot_of_other_traffic_is_refused() {
    let (_, other) = started(3);
    let (world, mut traffic) = started(10);
    assert!(is_refused(&world, &mut traffic, &other.save().unwrap()));
}
