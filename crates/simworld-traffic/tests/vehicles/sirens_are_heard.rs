//! Emergency vehicles with their siren on: others make way, they pass red lights slowly, and nobody touches anybody.

use std::sync::Arc;

use simworld_core::id::LaneId;
use simworld_core::net::{CrossSection, NetworkConfig, RoadNetwork, StreetPlan};
use simworld_core::seed::Seed;
use simworld_traffic::vehicle::{VehicleKind, VehicleType};
use simworld_traffic::{Leg, Route, Router, Traffic, TrafficConfig, TrafficError, TripEnd};

use crate::at_once::at_once;

fn avenues(lanes: u8) -> Arc<RoadNetwork> {
    let mut plan = StreetPlan::grid(5, 5, 150.0);
    plan.sections = vec![CrossSection::two_way(lanes, lanes)];
    Arc::new(RoadNetwork::derive(&plan, &NetworkConfig::default()).expect("a grid is a network"))
}

/// From one corner of the grid to the one across.
fn across(network: &RoadNetwork) -> Route {
    let reach = |lane: usize, end: bool| {
        let lane = &network.lanes[lane];
        let center = network.intersections[if end { lane.to } else { lane.from }.index()].center;
        center.x + center.y
    };
    let lanes = || 0..network.lanes.len();
    let first = lanes().min_by(|a, b| reach(*a, false).total_cmp(&reach(*b, false))).expect("it has lanes");
    let last = lanes().max_by(|a, b| reach(*a, true).total_cmp(&reach(*b, true))).expect("it has lanes");
    let leg = |lane: usize| Leg::of(network, LaneId::from_index(lane));
    Router::new(network).quickest(leg(first), leg(last)).expect("a grid is connected")
}

fn config(vehicles: u32, siren: bool) -> TrafficConfig {
    let mut config = TrafficConfig { vehicles, pedestrians: 60, ..TrafficConfig::default() };
    config.type_mut(VehicleKind::Emergency).expect("it is in the table").siren = siren;
    config
}

/// One of a kind drives across a busy town: its time on the way, s, and the red lights that it passed.
fn time_across(lanes: u8, vehicles: u32, kind: VehicleKind, siren: bool, seed: u64) -> (f64, u64) {
    let network = avenues(lanes);
    let route = across(&network);
    let mut traffic =
        Traffic::new(network, &config(vehicles, siren), Seed(seed)).expect("the settings are in range");
    // Let the town come to its own pace first.
    (0..600).for_each(|_| traffic.step(0.1));
    traffic.insert(route, kind).expect("the route can be driven");
    let mut own = None;
    for _ in 0..12_000 {
        let before = (traffic.counters().reds_by_siren, reds(&traffic, own));
        crate::watching::drive(&mut traffic, 1, |id| siren && Some(id) == own);
        own = own.or_else(|| traffic.entered().first().copied());
        // It is counted whenever it happens, and at no other time.
        let after = traffic.counters().reds_by_siren;
        assert_eq!(after - before.0, u64::from(before.1 && on_way(&traffic, own)), "seed {seed}");
        if let Some(trip) = traffic.ended().iter().find(|trip| Some(trip.id) == own) {
            assert_eq!(trip.end, TripEnd::Arrived);
            let counters = traffic.counters();
            assert_eq!((counters.dilemmas, counters.forced_stops), (0, 0), "{counters:?}");
            return (trip.left - trip.entered, after);
        }
    }
    panic!("it does not arrive: {:?}", traffic.counters());
}

/// Whether a vehicle is on a lane before a red light.
fn reds(traffic: &Traffic, id: Option<u32>) -> bool {
    let network = traffic.network();
    let Some((_, track, ..)) = traffic.stations().find(|vehicle| Some(vehicle.0) == id) else { return false };
    let Some(lane) = network.lanes.get(track as usize) else { return false };
    let is_red = |group: usize| traffic.signals()[group] == simworld_core::net::Aspect::Red;
    lane.outgoing.iter().any(|way| network.connections[way.index()].signal.is_some_and(|g| is_red(g.index())))
}

/// Whether a vehicle is in a junction.
fn on_way(traffic: &Traffic, id: Option<u32>) -> bool {
    let lanes = traffic.network().lanes.len() as u32;
    traffic.stations().any(|(own, track, ..)| Some(own) == id && track >= lanes)
}

#[test]
fn with_a_siren_one_is_sooner_across_a_busy_town() {
    let towns = [(2, 260, 1), (2, 260, 2), (3, 400, 3), (1, 110, 4), (1, 110, 5)];
    let across = at_once(towns, |(lanes, vehicles, seed)| {
        let (with, passed) = time_across(lanes, vehicles, VehicleKind::Emergency, true, seed);
        let (without, none) = time_across(lanes, vehicles, VehicleKind::Emergency, false, seed);
        let (car, _) = time_across(lanes, vehicles, VehicleKind::Car, false, seed);
        println!("{lanes} lanes: {with:.0} s with {passed} reds, {without:.0} s without, car {car:.0} s");
        assert_eq!(none, 0);
        assert!(with < car, "{lanes} lanes: {with} s with a siren, {car} s in a car");
        ([with, without, car], passed)
    });
    let reds: u64 = across.iter().map(|(_, passed)| passed).sum();
    assert!(reds > 3, "it passes red lights: {reds}");
    let sums = [0, 1, 2].map(|kind| across.iter().map(|(times, _)| times[kind]).sum::<f64>());
    assert!(sums[0] < 0.75 * sums[1] && sums[0] < 0.75 * sums[2], "{sums:?}");
}

#[test]
fn sirens_are_for_emergency_vehicles_and_are_saved() {
    let mut table = TrafficConfig { types: vec![VehicleType::default()], ..TrafficConfig::default() };
    table.types[0].siren = true;
    let refused = table.validate().expect_err("a car has no siren");
    assert!(matches!(refused, TrafficError::VehicleType { index: 0, field: "siren", .. }), "{refused}");

    let mut traffic = crate::watching::on_grid(3, &config(20, false), 1);
    let route = across(&traffic.network().clone());
    traffic.insert(route, VehicleKind::Emergency).expect("it can be driven");
    let id = loop {
        traffic.step(0.1);
        if let Some(id) = traffic.entered().first() {
            break *id;
        }
    };
    assert!(traffic.sirens().is_empty());
    assert_eq!(traffic.set_siren(0, true), Err(TrafficError::NoSiren { id: 0 }));
    assert_eq!(traffic.set_siren(12_345, true), Ok(false));
    assert_eq!(traffic.set_siren(id, true), Ok(true));
    assert_eq!(traffic.sirens(), [id]);
    assert_eq!(traffic.set_siren(id, false), Ok(true));
    assert!(traffic.sirens().is_empty());
    assert_eq!(traffic.set_siren(id, true), Ok(true));
    assert!(traffic.remove(id));
    assert!(traffic.sirens().is_empty());
}
