//! Who may drive where: riders on cycle lanes, buses on bus lanes, everybody else among everybody; each as fast as it can.

use std::collections::BTreeSet;
use std::sync::Arc;

use simworld_core::id::{ConnectionId, LaneId, RoadId};
use simworld_core::net::{
    CrossSection, LaneDirection, LaneKind, LaneSpec, NetworkConfig, RoadNetwork, StreetPlan,
};
use simworld_core::seed::Seed;
use simworld_traffic::vehicle::VehicleKind;
use simworld_traffic::{Leg, Router, Traffic, TrafficConfig, TrafficError};

use crate::contacts::assert_apart;

fn grid(section: CrossSection) -> Arc<RoadNetwork> {
    let mut plan = StreetPlan::grid(3, 3, 160.0);
    plan.sections[0] = section;
    Arc::new(RoadNetwork::derive(&plan, &NetworkConfig::default()).expect("a grid is a network"))
}

/// Two driving lanes a direction, of which the outer is for buses where `bus` says so.
fn avenue(bus: bool) -> CrossSection {
    let mut section = CrossSection::two_way(2, 2);
    if bus {
        let driving: Vec<usize> =
            (0..section.lanes.len()).filter(|at| section.lanes[*at].kind == LaneKind::Driving).collect();
        for at in [driving[0], driving[driving.len() - 1]] {
            section.lanes[at] = LaneSpec { kind: LaneKind::Bus, ..section.lanes[at] };
        }
    }
    section
}

/// The kind of the lane on which a track is, or to which it leads.
fn lane_kind(network: &RoadNetwork, track: u32) -> LaneKind {
    let lane = match track.checked_sub(network.lanes.len() as u32) {
        None => LaneId(track),
        Some(way) => network.connections[ConnectionId(way).index()].to,
    };
    network.lanes[lane.index()].kind
}

fn kinds(traffic: &Traffic) -> Vec<VehicleKind> {
    let mut kinds: Vec<(u32, VehicleKind)> = traffic.vehicles().map(|body| (body.id, body.kind)).collect();
    kinds.sort_unstable();
    kinds.into_iter().map(|(_, kind)| kind).collect()
}

#[test]
fn riders_ride_on_cycle_lanes_and_nobody_else_does() {
    let network = grid(CrossSection::two_way(1, 1).with_cycle_lanes(1.8));
    let mut config = TrafficConfig { vehicles: 60, pedestrians: 0, ..TrafficConfig::default() };
    config.type_mut(VehicleKind::Bicycle).unwrap().share = 0.3;
    config.type_mut(VehicleKind::Scooter).unwrap().share = 0.2;
    let mut traffic = Traffic::new(Arc::clone(&network), &config, Seed(3)).unwrap();
    let kinds = kinds(&traffic);
    assert!(kinds.iter().filter(|kind| kind.is_rider()).count() > 10);
    let (mut on_cycle_lanes, mut riding) = (0, 0);
    for step in 0..4000 {
        traffic.step(0.1);
        assert_apart(&traffic, step);
        for (id, track, _, v) in traffic.stations() {
            let kind = kinds[id as usize];
            let is_cycle = lane_kind(&network, track) == LaneKind::Cycle;
            assert!(kind.is_rider() || !is_cycle, "a {kind:?} rides on a cycle lane at step {step}");
            assert!(!kind.is_rider() || v < 6.2, "a {kind:?} rides {v} m/s");
            riding += u32::from(kind.is_rider());
            on_cycle_lanes += u32::from(kind.is_rider() && is_cycle);
        }
    }
    assert_eq!(on_cycle_lanes, riding, "all streets have cycle lanes");
    assert!(traffic.counters().crossings > 60 * 400 / 60, "{:?}", traffic.counters());
}

#[test]
fn riders_leave_the_cycle_lane_to_turn_across_and_take_it_again() {
    let network = grid(CrossSection::two_way(1, 1).with_cycle_lanes(1.8));
    let config = TrafficConfig { vehicles: 0, pedestrians: 0, ..TrafficConfig::default() };
    let mut traffic = Traffic::new(Arc::clone(&network), &config, Seed(3)).unwrap();
    let router = Router::new(&network);
    let legs: Vec<Leg> = (0..network.roads.len() as u32)
        .flat_map(|road| [LaneDirection::Forward, LaneDirection::Backward].map(|d| Leg::new(RoadId(road), d)))
        .collect();
    let mut sent = 0;
    for (index, from) in legs.iter().enumerate() {
        let to = legs[(index * 5 + 7) % legs.len()];
        if let Some(route) = router.quickest(*from, to).filter(|route| route.0.len() > 2) {
            traffic.insert(route, VehicleKind::Bicycle).unwrap();
            sent += 1;
        }
    }
    let (mut on_cycle, mut among) = (BTreeSet::new(), BTreeSet::new());
    for step in 0..12_000 {
        traffic.step(0.1);
        assert_apart(&traffic, step);
        for (id, track, _, _) in traffic.stations().filter(|at| (at.1 as usize) < network.lanes.len()) {
            match lane_kind(&network, track) {
                LaneKind::Cycle => on_cycle.insert(id),
                _ => among.insert(id),
            };
        }
    }
    let counters = traffic.counters();
    assert_eq!(counters.arrived, sent, "all came where they wanted: {counters:?}");
    assert!(on_cycle.len() * 4 > sent as usize * 3 && !among.is_empty(), "{} of {sent}", on_cycle.len());
}

#[test]
fn riders_keep_right_where_there_is_no_cycle_lane() {
    let network = grid(avenue(false));
    let mut config = TrafficConfig { vehicles: 20, pedestrians: 0, ..TrafficConfig::default() };
    for row in &mut config.types {
        row.share = f64::from(u8::from(row.kind == VehicleKind::Bicycle));
        // They only ever go straight on, so that no turn makes them leave the right lane.
        config.turns = [1.0, 0.0, 0.0];
    }
    let mut traffic = Traffic::new(Arc::clone(&network), &config, Seed(3)).unwrap();
    let outer: BTreeSet<u32> = network
        .roads
        .iter()
        .flat_map(|road| [road.forward.last(), road.backward.last()])
        .flatten()
        .map(|lane| lane.0)
        .collect();
    let (mut right, mut all) = (0, 0);
    for step in 0..3000 {
        traffic.step(0.1);
        for (_, track, _, _) in traffic.stations().filter(|at| (at.1 as usize) < network.lanes.len()) {
            if step > 600 {
                all += 1;
                right += u32::from(outer.contains(&track));
            }
        }
    }
    assert!(f64::from(right) > 0.8 * f64::from(all), "{right} of {all} on the right");
}

#[test]
fn only_buses_drive_on_bus_lanes() {
    let network = grid(avenue(true));
    let mut config = TrafficConfig { vehicles: 70, pedestrians: 0, ..TrafficConfig::default() };
    config.type_mut(VehicleKind::Bus).unwrap().share = 0.3;
    let mut traffic = Traffic::new(Arc::clone(&network), &config, Seed(5)).unwrap();
    let kinds = kinds(&traffic);
    let mut counts = [[0_u32; 2]; 2];
    for step in 0..4000 {
        traffic.step(0.1);
        assert_apart(&traffic, step);
        for (id, track, _, _) in traffic.stations() {
            let on_bus_lane = lane_kind(&network, track) == LaneKind::Bus;
            let is_bus = kinds[id as usize] == VehicleKind::Bus;
            counts[usize::from(is_bus)][usize::from(on_bus_lane)] += 1;
        }
    }
    let [[_, cars_there], [buses_beside, buses_there]] = counts;
    assert_eq!(cars_there, 0, "cars on bus lanes: {counts:?}");
    assert!(buses_there > buses_beside, "buses on their own lane: {counts:?}");
    assert!(traffic.counters().crossings > 70 * 400 / 90, "{:?}", traffic.counters());
}

#[test]
fn a_kind_without_a_type_is_refused() {
    let network = grid(CrossSection::two_way(1, 1));
    let mut config = TrafficConfig { vehicles: 0, pedestrians: 0, ..TrafficConfig::default() };
    config.types.truncate(1);
    let mut traffic = Traffic::new(Arc::clone(&network), &config, Seed(5)).unwrap();
    let from = Leg::of(&network, LaneId(0));
    let route = Router::new(&network).quickest(from, from).unwrap();
    let refused = traffic.insert(route.clone(), VehicleKind::Bus);
    assert_eq!(refused, Err(TrafficError::NoSuchType { kind: VehicleKind::Bus }));
    traffic.insert(route, VehicleKind::Car).unwrap();
    config.types.clear();
    assert!(config.validate().is_err());
}
