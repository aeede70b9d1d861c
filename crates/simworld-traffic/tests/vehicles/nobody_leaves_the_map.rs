//! Who turns at random keeps off streets that only lead off the map: there he would stand at the end for good.

use std::collections::BTreeSet;
use std::sync::Arc;

use simworld_core::geometry::Point2;
use simworld_core::net::{CrossSection, NetworkConfig, RoadNetwork, Street, StreetPlan};
use simworld_core::seed::Seed;
use simworld_traffic::{Traffic, TrafficConfig};

/// A grid of two-way streets, with two one-way streets, of one and of two lanes, that go out from its middle, one after the other.
fn with_a_way_out() -> (RoadNetwork, BTreeSet<u32>) {
    let mut plan = StreetPlan::grid(3, 3, 150.0);
    let middle = plan.nodes[4];
    let way_out = [1, 2].map(|lanes| plan.add_section(CrossSection::two_way(lanes, 0)));
    let (first, second) = (plan.nodes.len(), plan.nodes.len() + 1);
    plan.nodes.extend([[60.0, 60.0], [250.0, 250.0]].map(|[x, y]| Point2::new(middle.x + x, middle.y + y)));
    let streets = plan.streets.len() as u32;
    for (section, (from, to)) in way_out.into_iter().zip([(4, first), (first, second)]) {
        plan.streets.push(Street { section, level: 1, ..Street::simple(from, to) });
    }
    let network = RoadNetwork::derive(&plan, &NetworkConfig::default()).expect("the plan is sound");
    (network, BTreeSet::from([streets, streets + 1]))
}

#[test]
fn who_turns_at_random_does_not_take_the_way_out() {
    let (network, out) = with_a_way_out();
    let network = Arc::new(network);
    let is_out = |lane: u32| out.contains(&network.lanes[lane as usize].road.0);
    assert!((0..network.lanes.len() as u32).any(is_out), "the way out is part of the network");
    let config = TrafficConfig { vehicles: 60, pedestrians: 0, ..TrafficConfig::default() };
    let mut traffic =
        Traffic::new(Arc::clone(&network), &config, Seed(3)).expect("the settings are in range");
    assert_eq!(traffic.placed().vehicles, 60);
    for step in 0..6000 {
        traffic.step(0.1);
        let lanes = traffic.stations().filter(|(_, track, ..)| (*track as usize) < network.lanes.len());
        let gone: Vec<u32> = lanes.filter(|(_, track, ..)| is_out(*track)).map(|(id, ..)| id).collect();
        assert!(gone.is_empty(), "after {step} steps {gone:?} are on the way out");
    }
    assert!(traffic.counters().crossings > 500, "{:?}", traffic.counters());
}
