//! After a warm-up a step of vehicles asks the heap for nothing, and a vehicle takes little memory.

use std::sync::Arc;

use crate::counting::allocations;
use simworld_core::id::LaneId;
use simworld_core::net::{CrossSection, NetworkConfig, RoadNetwork, StreetPlan};
use simworld_core::seed::Seed;
use simworld_traffic::{Closed, Closure, Traffic, TrafficConfig};

/// A grid of so many junctions each way at seven vehicles a kilometre of lane.
fn grid(columns: usize) -> Traffic {
    let mut plan = StreetPlan::grid(columns, columns, 200.0);
    plan.sections[0] = CrossSection::two_way(2, 2);
    let network = RoadNetwork::derive(&plan, &NetworkConfig::default()).expect("a grid is a network");
    let config = TrafficConfig {
        vehicles: (columns * (columns - 1) * 23 / 2) as u32,
        pedestrians: 0,
        ..TrafficConfig::default()
    };
    Traffic::new(Arc::new(network), &config, Seed(5)).expect("the settings are in range")
}

#[test]
fn steps_of_vehicles_allocate_nothing_after_a_warm_up() {
    let mut traffic = grid(8);
    // Long enough for the longest queues before red to have been seen.
    for _ in 0..6000 {
        traffic.step(0.1);
    }
    let before = traffic.counters();
    let allocations = allocations(&mut || (0..1000).for_each(|_| traffic.step(0.1)));
    let counters = traffic.counters();
    assert!(counters.crossings > before.crossings + 500, "traffic flows: {counters:?}");
    assert!(counters.lane_changes > before.lane_changes + 20, "lanes are changed: {counters:?}");
    // A rare longest queue may still want a longer slab: that is not every step.
    assert!(allocations <= 3, "{allocations} allocations in a thousand steps");
}

#[test]
fn who_passes_works_over_the_oncoming_lane_asks_nothing_of_the_heap() {
    let network = RoadNetwork::derive(&StreetPlan::grid(5, 5, 200.0), &NetworkConfig::default());
    let network = Arc::new(network.expect("a grid is a network"));
    let config = TrafficConfig { vehicles: 90, pedestrians: 0, ..TrafficConfig::default() };
    let mut traffic =
        Traffic::new(Arc::clone(&network), &config, Seed(5)).expect("the settings are in range");
    for lane in (0..network.lanes.len()).step_by(9).map(LaneId::from_index) {
        let works = Closed::Stretch(lane, 40.0, 50.0);
        traffic.close(Closure::new(works)).expect("the lanes are long enough");
    }
    (0..6000).for_each(|_| traffic.step(0.1));
    let before = traffic.counters();
    let allocations = allocations(&mut || (0..1000).for_each(|_| traffic.step(0.1)));
    let counters = traffic.counters();
    assert!(counters.obstacles_passed > before.obstacles_passed + 5, "they pass the works: {counters:?}");
    // Queues behind works grow and shrink, and a longer slab is wanted now and then: that is not every step.
    assert!(allocations <= 10, "{allocations} allocations in a thousand steps");
}

#[test]
fn a_vehicle_takes_less_than_a_quarter_of_a_kilobyte() {
    let mut traffic = grid(20);
    for _ in 0..600 {
        traffic.step(0.1);
    }
    let each = traffic.vehicle_bytes() / traffic.placed().vehicles as usize;
    assert!(each <= 256, "{each} bytes a vehicle");
}
