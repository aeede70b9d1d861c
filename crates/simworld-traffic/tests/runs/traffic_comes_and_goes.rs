//! Flows in a world: an entity for everybody who is there and none for who has left; a saved flow goes on as it was.

use std::sync::Arc;

use simworld_core::geometry::{Point2, planar};
use simworld_core::hash::StateHash;
use simworld_core::id::RoadId;
use simworld_core::net::{LaneDirection, NetworkConfig, RoadNetwork, StreetPlan};
use simworld_core::scene::{Scene, World};
use simworld_core::seam::Dynamics;
use simworld_core::seed::Seed;
use simworld_traffic::vehicle::VehicleKind;
use simworld_traffic::{Arrivals, Flow, Leg, Route, Traffic, TrafficConfig, TrafficDynamics, TrafficError};

fn crossroads() -> Arc<RoadNetwork> {
    Arc::new(
        RoadNetwork::derive(&StreetPlan::crossroads(120.0), &NetworkConfig::default())
            .expect("a crossroads is a network"),
    )
}

/// Straight over from one arm to the opposite one.
fn across(arm: u32) -> Route {
    let inwards = Leg::new(RoadId(arm), LaneDirection::Backward);
    Route(vec![inwards, Leg::new(RoadId((arm + 2) % 4), LaneDirection::Forward)])
}

fn empty() -> TrafficConfig {
    TrafficConfig { vehicles: 0, pedestrians: 0, ..TrafficConfig::default() }
}

#[test]
fn entities_come_and_go_with_their_vehicles() {
    let mut world = World::new();
    world.set_roads(crossroads());
    let mut dynamics = TrafficDynamics::new(&mut world, &empty(), Seed(1)).unwrap();
    for arm in 0..4 {
        dynamics.traffic_mut().add_flow(Flow::new(across(arm), 300.0)).unwrap();
    }
    let mut most = 0;
    for step in 0..6000 {
        if step == 3000 {
            let id = dynamics.traffic().vehicles().next().unwrap().id;
            assert!(dynamics.traffic_mut().remove(id));
        }
        dynamics.step(&mut world, 0.1).unwrap();
        assert_eq!(world.len(), dynamics.traffic().vehicles().count(), "at step {step}");
        for body in dynamics.traffic().vehicles() {
            let entity = world.entity(dynamics.vehicles()[body.id as usize]).unwrap();
            let there: Point2 = planar(&body.pose);
            assert!((entity.planar() - there).norm() < 1e-9);
        }
        most = most.max(world.len());
    }
    let counters = dynamics.traffic().counters();
    assert!(most > 8 && counters.arrived > 120, "{most} at once, {counters:?}");
    assert_eq!(counters.removed, 1);
}

#[test]
fn a_saved_flow_goes_on_as_it_was() {
    let make = || {
        let mut world = World::new();
        world.set_roads(crossroads());
        let mut dynamics = TrafficDynamics::new(&mut world, &empty(), Seed(6)).unwrap();
        dynamics.traffic_mut().add_flow(Flow::new(across(0), 400.0)).unwrap();
        let uniform = Flow { arrivals: Arrivals::Uniform, ..Flow::new(across(1), 250.0) };
        dynamics.traffic_mut().add_flow(uniform).unwrap();
        (world, dynamics)
    };
    let (mut world, mut dynamics) = make();
    for _ in 0..1111 {
        dynamics.step(&mut world, 0.1).unwrap();
    }
    let saved = dynamics.save().unwrap();
    let mut copy = world.clone();
    let mut resumed = make().1;
    resumed.restore(&copy, &saved).unwrap();
    for _ in 0..1111 {
        dynamics.step(&mut world, 0.1).unwrap();
        resumed.step(&mut copy, 0.1).unwrap();
        assert_eq!(dynamics.traffic().digest(), resumed.traffic().digest());
    }
    assert_eq!(world.digest(), copy.digest());
}

#[test]
fn flows_come_as_often_as_they_should() {
    for (arrivals, tolerance) in [(Arrivals::Uniform, 2), (Arrivals::Poisson, 60)] {
        let mut traffic = Traffic::new(crossroads(), &empty(), Seed(4)).unwrap();
        traffic.add_flow(Flow { arrivals, ..Flow::new(across(2), 360.0) }).unwrap();
        for _ in 0..36_000 {
            traffic.step(0.1);
        }
        let came = traffic.counters().entered + traffic.outside() as u64;
        assert!(came.abs_diff(360) <= tolerance, "{came} in an hour, {arrivals:?}");
        assert!(traffic.counters().arrived + 20 > traffic.counters().entered);
    }
}

#[test]
fn what_cannot_be_driven_is_refused() {
    let mut traffic = Traffic::new(crossroads(), &empty(), Seed(4)).unwrap();
    let inwards = Leg::new(RoadId(0), LaneDirection::Backward);
    let broken = Route(vec![inwards, Leg::new(RoadId(3), LaneDirection::Backward)]);
    let error = traffic.add_flow(Flow::new(broken, 100.0)).unwrap_err();
    assert!(matches!(error, TrafficError::Route { leg: 0, .. }), "{error}");
    assert!(traffic.add_flow(Flow::new(Route(Vec::new()), 100.0)).is_err());
    let nowhere = Route(vec![Leg::new(RoadId(99), LaneDirection::Forward)]);
    assert!(traffic.insert(nowhere, VehicleKind::Car).is_err());
    for per_hour in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e9] {
        let error = traffic.add_flow(Flow::new(across(0), per_hour)).unwrap_err();
        assert!(matches!(error, TrafficError::Config { field: "per_hour", .. }), "{error}");
    }
    // More than the road holds waits outside, and is told.
    traffic.add_flow(Flow { arrivals: Arrivals::Uniform, ..Flow::new(across(0), 9000.0) }).unwrap();
    for _ in 0..6000 {
        traffic.step(0.1);
    }
    assert!(traffic.outside() > 800, "{}", traffic.outside());
}
