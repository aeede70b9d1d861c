//! Buses stand at their stops as long as they should, others pass them or wait; who breaks down is passed, who parks is gone.

use std::collections::BTreeMap;
use std::sync::Arc;

use simworld_core::hash::StateHash;
use simworld_core::id::{LaneId, RoadId};
use simworld_core::net::{CrossSection, LaneDirection, NetworkConfig, RoadNetwork, StreetPlan};
use simworld_core::scene::World;
use simworld_core::seam::Dynamics;
use simworld_core::seed::Seed;
use simworld_traffic::vehicle::VehicleKind;
use simworld_traffic::{
    Closed, Closure, Flow, Leg, Line, Route, Router, Stop, Traffic, TrafficConfig, TrafficDynamics,
    TrafficError, TripEnd,
};

use crate::contacts::assert_apart;

fn crossroads(lanes: u8) -> Arc<RoadNetwork> {
    let mut plan = StreetPlan::crossroads(200.0);
    plan.sections = vec![CrossSection::two_way(lanes, lanes)];
    Arc::new(RoadNetwork::derive(&plan, &NetworkConfig::default()).unwrap())
}

fn across() -> [Leg; 2] {
    [Leg::new(RoadId(0), LaneDirection::Backward), Leg::new(RoadId(2), LaneDirection::Forward)]
}

fn empty() -> TrafficConfig {
    TrafficConfig { vehicles: 0, pedestrians: 0, ..TrafficConfig::default() }
}

#[test]
fn every_bus_stands_at_every_stop() {
    for lanes in [1, 2] {
        let network = crossroads(lanes);
        let [into, out] = across();
        let stops = vec![Stop::new(into, 80.0, 20.0), Stop::new(out, 60.0, 35.0), Stop::new(out, 120.0, 5.0)];
        let line = Line { last: 1000.0, ..Line::new(Route(vec![into, out]), stops.clone(), 120.0) };
        let mut traffic = Traffic::new(Arc::clone(&network), &empty(), Seed(1)).unwrap();
        traffic.add_flow(line.flow()).unwrap();
        let cars =
            Flow { kind: Some(VehicleKind::Car), until: 1000.0, ..Flow::new(line.route.clone(), 200.0) };
        traffic.add_flow(cars).unwrap();
        // How long each bus stood at each stop, s.
        let mut stood: BTreeMap<(u32, usize), f64> = BTreeMap::new();
        let mut buses = 0;
        for step in 0..20_000 {
            traffic.step(0.1);
            assert_apart(&traffic, step);
            let kinds: BTreeMap<u32, VehicleKind> = traffic.vehicles().map(|b| (b.id, b.kind)).collect();
            for (id, track, s, v) in traffic.stations().filter(|at| (at.1 as usize) < network.lanes.len()) {
                let leg = Leg::of(&network, LaneId(track));
                let at = |stop: &Stop| stop.leg == leg && (stop.station - 2.0..=stop.station).contains(&s);
                if let (VehicleKind::Bus, Some(stop)) = (kinds[&id], stops.iter().position(at))
                    && v < 0.1
                {
                    *stood.entry((id, stop)).or_insert(0.0) += 0.1;
                }
            }
            for trip in traffic.ended().iter().filter(|trip| trip.kind == VehicleKind::Bus) {
                for (index, stop) in stops.iter().enumerate() {
                    let time = stood.remove(&(trip.id, index)).unwrap_or(0.0);
                    assert!(time > stop.dwell - 0.3 && time < stop.dwell + 2.0, "{time} s at stop {index}");
                }
                buses += 1;
            }
        }
        let counters = traffic.counters();
        assert_eq!(buses, 9, "{counters:?}");
        assert_eq!((counters.halts, counters.missed_stops), (27, 0), "{counters:?}");
        assert_eq!(traffic.vehicles().count(), 0, "everybody has come through");
        assert_eq!(counters.lane_changes > 0, lanes > 1, "buses at stops are overtaken: {counters:?}");
    }
}

#[test]
fn nobody_leaves_before_the_timetable_says() {
    let [into, out] = across();
    let stop = Stop { not_before: 90.0, ..Stop::new(into, 80.0, 5.0) };
    let line = Line { last: 500.0, ..Line::new(Route(vec![into, out]), vec![stop], 300.0) };
    let mut traffic = Traffic::new(crossroads(1), &empty(), Seed(1)).unwrap();
    traffic.add_flow(line.flow()).unwrap();
    let mut left = Vec::new();
    for _ in 0..6000 {
        let before = traffic.stations().next().map_or(0.0, |at| at.3);
        traffic.step(0.1);
        if let Some((_, _, s, v)) = traffic.stations().next()
            && before == 0.0
            && v > 0.0
            && (s - 80.0).abs() < 3.0
        {
            left.push(traffic.seconds());
        }
    }
    assert_eq!(left.len(), 2, "{left:?}");
    assert!((left[0] - 90.0).abs() < 0.5 && (left[1] - 390.0).abs() < 0.5, "{left:?}");
}

#[test]
fn a_breakdown_is_passed_or_waited_for() {
    for lanes in [1, 2] {
        let config = TrafficConfig { pass_obstacles: false, ..empty() };
        let mut traffic = Traffic::new(crossroads(lanes), &config, Seed(1)).unwrap();
        let route = Route(across().to_vec());
        traffic.add_flow(Flow { until: 300.0, ..Flow::new(route, 400.0) }).unwrap();
        while traffic.stations().next().is_none_or(|at| at.2 < 60.0) {
            traffic.step(0.1);
        }
        let first = traffic.stations().next().unwrap().0;
        assert!(traffic.halt(first, 400.0).unwrap());
        assert!(!traffic.halt(9999, 1.0).unwrap() && traffic.halt(first, f64::NAN).is_err());
        for step in 0..3500 {
            traffic.step(0.1);
            assert_apart(&traffic, step);
        }
        let arrived = traffic.counters().arrived;
        assert_eq!(arrived > 0, lanes > 1, "{:?}", traffic.counters());
        (0..6000).for_each(|_| traffic.step(0.1));
        let counters = traffic.counters();
        assert_eq!((counters.arrived, traffic.outside()), (counters.entered, 0), "{counters:?}");
    }
}

#[test]
fn who_parks_is_gone_from_the_kerb() {
    let mut traffic = Traffic::new(crossroads(2), &empty(), Seed(1)).unwrap();
    let [into, out] = across();
    traffic.insert(Route(vec![into, out]), VehicleKind::Car).unwrap();
    (0..20).for_each(|_| traffic.step(0.1));
    let id = traffic.stations().next().unwrap().0;
    assert!(traffic.park(id, out, 1e6, 10.0).is_err());
    assert!(traffic.park(id, out, 100.0, 10.0).unwrap());
    let mut last = None;
    for _ in 0..3000 {
        last = traffic.stations().next().or(last);
        traffic.step(0.1);
        if let Some(trip) = traffic.ended().first() {
            assert_eq!(trip.end, TripEnd::Parked);
        }
    }
    let (_, track, s, _) = last.unwrap();
    assert_eq!(Leg::of(traffic.network(), LaneId(track)), out);
    assert_eq!(track, out.lanes(traffic.network())[1].0, "at the kerb");
    assert!((s - 100.0).abs() < 2.0 && traffic.counters().removed == 1);
}

#[test]
fn stops_that_cannot_be_made_are_refused_or_given_up() {
    let network = crossroads(1);
    let [into, out] = across();
    let mut traffic = Traffic::new(Arc::clone(&network), &empty(), Seed(1)).unwrap();
    for stops in [
        vec![Stop::new(Leg::new(RoadId(1), LaneDirection::Forward), 50.0, 10.0)],
        vec![Stop::new(out, 50.0, 10.0), Stop::new(into, 50.0, 10.0)],
        vec![Stop::new(out, 50.0, 10.0), Stop::new(out, 40.0, 10.0)],
        vec![Stop::new(out, 5000.0, 10.0)],
        vec![Stop::new(out, 50.0, f64::NAN)],
    ] {
        let line = Line::new(Route(vec![into, out]), stops, 60.0);
        assert!(matches!(traffic.add_flow(line.flow()), Err(TrafficError::Stop { .. })));
    }
    // A stop on a road that is closed meanwhile is missed, and the rest of the line goes on.
    let mut plan = StreetPlan::grid(3, 3, 150.0);
    plan.sections = vec![CrossSection::two_way(1, 1)];
    let network = Arc::new(RoadNetwork::derive(&plan, &NetworkConfig::default()).unwrap());
    let router = Router::new(&network);
    let legs = (0..network.roads.len() as u32).map(|road| Leg::new(RoadId(road), LaneDirection::Forward));
    let legs: Vec<Leg> = legs.collect();
    let routes = legs.iter().flat_map(|a| legs.iter().filter_map(|b| router.quickest(*a, *b)));
    let route = routes.max_by_key(|route| route.0.len()).unwrap();
    let (middle, last) = (route.0[route.0.len() / 2], route.0[route.0.len() - 1]);
    let mut traffic = Traffic::new(network, &empty(), Seed(1)).unwrap();
    let stops = vec![Stop::new(middle, 40.0, 10.0), Stop::new(last, 40.0, 10.0)];
    traffic.add_flow(Line { last: 10.0, ..Line::new(route, stops, 60.0) }.flow()).unwrap();
    (0..50).for_each(|_| traffic.step(0.1));
    traffic.close(Closure::new(Closed::Leg(middle))).unwrap();
    (0..6000).for_each(|_| traffic.step(0.1));
    let counters = traffic.counters();
    assert_eq!((counters.halts, counters.missed_stops, counters.arrived), (1, 1, 1), "{counters:?}");
}

#[test]
fn a_saved_line_goes_on_as_it_was() {
    let make = || {
        let mut world = World::new();
        world.set_roads(crossroads(2));
        let mut dynamics = TrafficDynamics::new(&mut world, &empty(), Seed(6)).unwrap();
        let [into, out] = across();
        let stops = vec![Stop::new(into, 80.0, 20.0), Stop::new(out, 60.0, 25.0)];
        let line = Line::new(Route(vec![into, out]), stops, 60.0);
        dynamics.traffic_mut().add_flow(line.flow()).unwrap();
        dynamics
            .traffic_mut()
            .close(Closure { from: 60.0, until: 150.0, ..Closure::new(Closed::Leg(out)) })
            .unwrap();
        (world, dynamics)
    };
    let (mut world, mut dynamics) = make();
    (0..700).for_each(|_| dynamics.step(&mut world, 0.1).unwrap());
    let saved = dynamics.save().unwrap();
    let mut copy = world.clone();
    let mut resumed = make().1;
    resumed.restore(&copy, &saved).unwrap();
    for _ in 0..2000 {
        dynamics.step(&mut world, 0.1).unwrap();
        resumed.step(&mut copy, 0.1).unwrap();
        assert_eq!(dynamics.traffic().digest(), resumed.traffic().digest());
    }
    assert!(dynamics.traffic().counters().halts > 5);
}
