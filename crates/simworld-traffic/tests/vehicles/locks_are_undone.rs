//! Rings of full lanes that wait for one another are found and undone, without anybody jumping or touching.

use std::sync::Arc;

use simworld_core::geometry::Point2;
use simworld_core::id::RoadId;
use simworld_core::net::{CrossSection, LaneDirection, NetworkConfig, RoadNetwork, Street, StreetPlan};
use simworld_core::seed::Seed;
use simworld_traffic::vehicle::VehicleKind;
use simworld_traffic::{Leg, Route, Traffic, TrafficConfig};

use crate::at_once::at_once;
use crate::contacts::assert_apart;

/// One step: nobody touches anybody, and nobody goes farther than its speed takes it.
fn step(traffic: &mut Traffic, before: &mut Vec<Option<Point2>>, at: usize) {
    traffic.step(0.1);
    for body in traffic.vehicles() {
        let here = Point2::new(body.pose.translation.x, body.pose.translation.y);
        let index = body.id as usize;
        before.resize(before.len().max(index + 1), None);
        if let Some(last) = before[index].replace(here) {
            let way = (here - last).norm();
            assert!(way < 2.5, "{body:?} jumped {way} m at step {at}");
        }
    }
    for trip in traffic.ended() {
        before[trip.id as usize] = None;
    }
    assert_apart(traffic, at);
}

/// A loop of four one-way streets that four others join: those who are on it can only go on.
fn loop_of_streets() -> StreetPlan {
    let corner = |x: f64, y: f64| Point2::new(x, y);
    let mut plan = StreetPlan {
        nodes: vec![corner(0.0, 0.0), corner(70.0, 0.0), corner(70.0, 70.0), corner(0.0, 70.0)],
        ..StreetPlan::default()
    };
    let one_way = plan.add_section(CrossSection::plain(1, 0, 3.5, 0.0));
    let add = |plan: &mut StreetPlan, from, to| {
        plan.streets.push(Street { section: one_way, ..Street::simple(from, to) });
    };
    for index in 0..4 {
        add(&mut plan, index, (index + 1) % 4);
    }
    // In from the west or east, out to the south or north.
    for (index, (x, y)) in [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)].into_iter().enumerate() {
        let here = plan.nodes[index];
        plan.nodes.extend([corner(here.x + 90.0 * x, here.y), corner(here.x, here.y + 90.0 * y)]);
        add(&mut plan, 4 + 2 * index, index);
        add(&mut plan, index, 5 + 2 * index);
    }
    plan
}

#[test]
fn a_ring_that_nobody_can_leave_turns_on() {
    let config = NetworkConfig { signals_from_roads: 0, ..NetworkConfig::default() };
    let network = Arc::new(RoadNetwork::derive(&loop_of_streets(), &config).unwrap());
    let config = TrafficConfig { vehicles: 0, pedestrians: 0, ..TrafficConfig::default() };
    let mut traffic = Traffic::new(network, &config, Seed(2)).unwrap();
    let leg = |road: usize| Leg::new(RoadId(road as u32), LaneDirection::Forward);
    let mut sent = 0;
    // In at every corner, three quarters round and out again: all wait for room before they can leave.
    for _ in 0..30 {
        for corner in 0..4 {
            let round = (0..3).map(|quarter| leg((corner + quarter) % 4));
            let (into, out) = (leg(4 + 2 * corner), leg(5 + 2 * ((corner + 3) % 4)));
            let route = Route(std::iter::once(into).chain(round).chain([out]).collect());
            traffic.insert(route, VehicleKind::Car).unwrap();
            sent += 1;
        }
    }
    let mut before = Vec::new();
    for at in 0..20_000 {
        step(&mut traffic, &mut before, at);
    }
    let counters = traffic.counters();
    assert_eq!(counters.arrived, sent, "{counters:?}");
    assert!(counters.locks > 0 && counters.passes > 0, "the ring was to lock: {counters:?}");
}

#[test]
fn a_full_grid_never_stops_for_good() {
    let plan = StreetPlan::grid(4, 4, 110.0);
    let network = Arc::new(RoadNetwork::derive(&plan, &NetworkConfig::default()).unwrap());
    let kilometres = network.lanes.iter().map(|lane| lane.length).sum::<f64>() / 1000.0;
    let soak = std::env::var_os("SIMWORLD_SOAK").is_some();
    let seeds = 0..if soak { 20 } else { 2 };
    at_once(seeds.flat_map(|seed| [(seed, 44.0), (seed, 55.0)]), |(seed, density)| {
        let vehicles = (density * kilometres) as u32;
        let config = TrafficConfig { vehicles, pedestrians: 0, ..TrafficConfig::default() };
        let mut traffic = Traffic::new(Arc::clone(&network), &config, Seed(seed)).unwrap();
        assert_eq!(traffic.placed().vehicles, vehicles);
        let (mut before, mut last) = (Vec::new(), 0);
        for window in 0..4 {
            for at in 0..if soak { 5000 } else { 2500 } {
                step(&mut traffic, &mut before, at);
            }
            let crossings = traffic.counters().crossings;
            assert!(crossings > last + 200, "window {window}, {density}/km: {:?}", traffic.counters());
            last = crossings;
        }
    });
}
