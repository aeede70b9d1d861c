//! On roads of several lanes drivers change them, touch nobody, and come where their route leads.

use std::collections::BTreeMap;
use std::sync::Arc;

use simworld_core::id::RoadId;
use simworld_core::net::{CrossSection, LaneDirection, NetworkConfig, RoadNetwork, StreetPlan};
use simworld_core::seed::Seed;
use simworld_traffic::vehicle::VehicleKind;
use simworld_traffic::{Flow, Leg, Router, Traffic, TrafficConfig, TripEnd};

use crate::contacts::assert_apart;

fn avenues(columns: usize, rows: usize, lanes: u8) -> Arc<RoadNetwork> {
    let mut plan = StreetPlan::grid(columns, rows, 200.0);
    plan.sections = vec![CrossSection::two_way(lanes, lanes)];
    Arc::new(RoadNetwork::derive(&plan, &NetworkConfig::default()).expect("a grid is a network"))
}

/// Avenues of one to four lanes each way; sampled, and many with `SIMWORLD_SOAK=1`.
#[test]
fn ten_thousand_steps_on_avenues_without_a_collision() {
    let soak = std::env::var_os("SIMWORLD_SOAK").is_some();
    for seed in 0..if soak { 40 } else { 1 } {
        let lanes = [3, 2, 4, 1][seed as usize % 4];
        let vehicles = 50 * u32::from(lanes);
        let mut config = TrafficConfig { vehicles, pedestrians: 60, ..TrafficConfig::default() };
        config.type_mut(VehicleKind::Bus).unwrap().share = 0.08;
        let mut traffic = Traffic::new(avenues(3, 3, lanes), &config, Seed(3 + seed)).unwrap();
        for step in 0..10_000 {
            traffic.step(0.1);
            assert_apart(&traffic, step);
        }
        let counters = traffic.counters();
        assert_eq!(counters.lane_changes > 300, lanes > 1, "{counters:?}");
        assert!(counters.crossings > u64::from(vehicles) * 1000 / 90, "traffic flows: {counters:?}");
        assert_eq!(counters.forced_stops, 0, "seed {seed}: {counters:?}");
    }
}

#[test]
fn whoever_has_a_route_drives_it_to_its_end() {
    let network = avenues(3, 3, 2);
    let router = Router::new(&network);
    let config = TrafficConfig { vehicles: 0, pedestrians: 0, ..TrafficConfig::default() };
    let mut traffic = Traffic::new(Arc::clone(&network), &config, Seed(8)).unwrap();
    let legs: Vec<Leg> = (0..network.roads.len() as u32)
        .flat_map(|road| [LaneDirection::Forward, LaneDirection::Backward].map(|d| Leg::new(RoadId(road), d)))
        .collect();
    let mut lengths = BTreeMap::new();
    for (index, from) in legs.iter().enumerate().step_by(2) {
        let to = legs[(index * 7 + 11) % legs.len()];
        let Some(route) = router.quickest(*from, to).filter(|route| route.0.len() > 2) else { continue };
        lengths.insert(index, route.0.len());
        traffic.add_flow(Flow { until: 1200.0, ..Flow::new(route, 60.0) }).unwrap();
    }
    assert!(lengths.len() > 5);
    let mut arrived = 0;
    for step in 0..16_000 {
        traffic.step(0.1);
        assert_apart(&traffic, step);
        for trip in traffic.ended() {
            assert_eq!(trip.end, TripEnd::Arrived);
            assert!(trip.delay() > -1.0, "faster than free: {trip:?}");
            assert!(trip.distance > 200.0 && trip.left > trip.entered && trip.entered >= trip.scheduled);
            arrived += 1;
        }
        let counters = traffic.counters();
        let present = traffic.vehicles().count() as u64;
        assert_eq!(counters.entered, present + counters.arrived + counters.removed, "nobody is lost");
    }
    let counters = traffic.counters();
    assert_eq!(arrived, counters.arrived);
    assert_eq!(
        (traffic.vehicles().count(), traffic.outside()),
        (0, 0),
        "all have come through: {counters:?}"
    );
    assert!(counters.arrived > 150, "{counters:?}");
    assert!(counters.rerouted * 15 < counters.arrived, "lanes are changed in time: {counters:?}");
}

#[test]
fn whoever_is_taken_out_leaves_nothing_behind() {
    let network = avenues(2, 2, 2);
    let config = TrafficConfig { vehicles: 30, pedestrians: 0, ..TrafficConfig::default() };
    let mut traffic = Traffic::new(network, &config, Seed(5)).unwrap();
    for step in 0..30 {
        for _ in 0..37 {
            traffic.step(0.1);
        }
        let victim = traffic.vehicles().map(|body| body.id).min().unwrap();
        assert!(traffic.remove(victim) && !traffic.remove(victim));
        assert_eq!(traffic.vehicles().count(), 29 - step);
        assert_eq!(traffic.ended().last().unwrap().end, TripEnd::Removed);
    }
    // The junctions are free again: newcomers cross them.
    let router = Router::new(traffic.network());
    let from = Leg::new(RoadId(0), LaneDirection::Forward);
    let next = |leg| router.after(leg).next().unwrap();
    let route = router.quickest(from, next(next(from))).unwrap();
    traffic.insert(route, VehicleKind::Car).unwrap();
    for _ in 0..3000 {
        traffic.step(0.1);
    }
    assert_eq!(traffic.counters().arrived, 1);
}
