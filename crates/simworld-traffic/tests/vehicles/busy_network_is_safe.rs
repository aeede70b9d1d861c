//! Ten thousand steps of a busy network: nobody touches anybody, nobody runs a red light, nobody is stuck.

use std::sync::Arc;

use simworld_core::geometry::{Obb, Point2, Point3, direction, pose_facing};
use simworld_core::net::{Aspect, CrossSection, DrivingSide, NetworkConfig, RoadNetwork, Street, StreetPlan};
use simworld_core::seed::Seed;
use simworld_traffic::{Body, Traffic, TrafficConfig};

use crate::contacts::assert_apart;

fn grid(columns: usize, vehicles: u32, pedestrians: u32) -> Traffic {
    let plan = StreetPlan::grid(columns, columns, 130.0);
    let network = RoadNetwork::derive(&plan, &NetworkConfig::default()).expect("a grid is a network");
    let config = TrafficConfig { vehicles, pedestrians, ..TrafficConfig::default() };
    Traffic::new(Arc::new(network), &config, Seed(11)).expect("the settings are in range")
}

fn solid(body: &Body) -> Obb {
    body.shape.obb(&body.pose)
}

/// Drives on, and sees to it that nobody touches anybody and nobody enters on red.
fn drive(traffic: &mut Traffic, steps: u32) {
    let network = Arc::clone(traffic.network());
    let lanes = network.lanes.len() as u32;
    let mut before: Vec<(u32, f64)> = vec![(u32::MAX, 0.0); traffic.placed().vehicles as usize];
    let mut bodies = Vec::new();
    for step in 0..steps {
        let aspects = traffic.signals().to_vec();
        traffic.step(0.1);
        for (id, track, station, _) in traffic.stations() {
            let (old, _) = std::mem::replace(&mut before[id as usize], (track, station));
            if track >= lanes && old < lanes {
                let connection = &network.connections[(track - lanes) as usize];
                let red = connection.signal.is_some_and(|group| aspects[group.index()] == Aspect::Red);
                assert!(!red, "vehicle {id} entered on red at step {step}");
            }
        }
        assert_apart(traffic, step as usize);
        bodies.clear();
        bodies.extend(traffic.vehicles());
        for walker in traffic.pedestrians().iter().filter(|walker| walker.crossing().is_some()) {
            let at = pose_facing(Point3::new(walker.position.x, walker.position.y, 0.0), 0.0);
            let person = simworld_core::scene::Shape::Capsule { radius: 0.2, height: 1.8 }.obb(&at);
            let hit = bodies.iter().find(|body| {
                (body.pose.translation.vector - at.translation.vector).norm() < 9.0
                    && body.twist.linear.norm() > 0.1
                    && solid(body).footprints_overlap(&person)
            });
            assert!(hit.is_none(), "a walker on a crossing is hit by {hit:?} at step {step}");
        }
    }
    let counters = traffic.counters();
    assert_eq!(counters.dilemmas, 0, "yellow is long enough for everybody to stop or to pass: {counters:?}");
    assert_eq!(counters.forced_stops, 0, "brakes suffice: {counters:?}");
}

#[test]
fn ten_thousand_steps_without_a_collision_or_a_red_light_violation() {
    let mut traffic = grid(4, 110, 150);
    assert_eq!((traffic.placed().vehicles, traffic.placed().pedestrians), (110, 150));
    drive(&mut traffic, 10_000);
    let counters = traffic.counters();
    assert!(counters.long_waits < 20, "hardly anybody stands for three minutes: {counters:?}");
    // On average everybody crosses an intersection every minute: less would be a jam at this density.
    assert!(counters.crossings > 110 * 1000 / 60, "traffic flows: {counters:?}");
}

#[test]
fn traffic_on_the_left_is_as_safe() {
    let mut plan = StreetPlan { driving_side: DrivingSide::Left, ..StreetPlan::grid(4, 4, 130.0) };
    plan.sections[0].lanes.reverse();
    let network = RoadNetwork::derive(&plan, &NetworkConfig::default()).expect("a grid is a network");
    let config = TrafficConfig { vehicles: 100, pedestrians: 100, ..TrafficConfig::default() };
    let mut traffic = Traffic::new(Arc::new(network), &config, Seed(12)).expect("the settings are in range");
    drive(&mut traffic, 4000);
    let counters = traffic.counters();
    assert!(counters.crossings > 100 * 400 / 60, "traffic flows: {counters:?}");
}

/// A road with a roundabout at either end, and three more arms at each.
fn two_roundabouts() -> StreetPlan {
    let mut plan = StreetPlan::default();
    let ring = plan.add_section(CrossSection::plain(1, 0, 4.5, 0.0));
    let quarter = |index: usize| direction(std::f64::consts::FRAC_PI_2 * index as f64);
    for center in [Point2::new(0.0, 0.0), Point2::new(260.0, 0.0)] {
        let first = plan.nodes.len();
        plan.nodes.extend((0..4).map(|index| center + quarter(index) * 24.0));
        for index in 0..4 {
            let middle = (quarter(index) + quarter(index + 1)).normalize();
            plan.streets.push(Street {
                section: ring,
                roundabout: true,
                via: vec![center + middle * 24.0],
                ..Street::simple(first + index, first + (index + 1) % 4)
            });
        }
    }
    // East of the first to west of the second; the others end in the open.
    plan.streets.push(Street::simple(0, 6));
    for (node, arm) in [(1, 1), (2, 2), (3, 3), (4, 0), (5, 1), (7, 3)] {
        let end = plan.nodes[node] + quarter(arm) * 150.0;
        plan.nodes.push(end);
        plan.streets.push(Street::simple(node, plan.nodes.len() - 1));
    }
    plan
}

#[test]
fn roundabouts_are_safe_and_flow() {
    let network = RoadNetwork::derive(&two_roundabouts(), &NetworkConfig::default()).expect("it is a plan");
    let config = TrafficConfig { vehicles: 30, pedestrians: 20, ..TrafficConfig::default() };
    let mut traffic = Traffic::new(Arc::new(network), &config, Seed(13)).expect("the settings are in range");
    drive(&mut traffic, 6000);
    let counters = traffic.counters();
    assert!(counters.crossings > 30 * 600 / 30, "traffic flows: {counters:?}");
}

#[test]
fn traffic_still_flows_after_a_long_time() {
    let mut traffic = grid(5, 160, 60);
    let mut last = 0;
    for window in 0..5 {
        for _ in 0..2000 {
            traffic.step(0.1);
        }
        let crossings = traffic.counters().crossings;
        assert!(crossings - last > 500, "flow died in window {window}: {:?}", traffic.counters());
        last = crossings;
    }
}

#[test]
fn priority_junctions_are_safe_as_well() {
    let config = NetworkConfig { signals_from_roads: 0, ..NetworkConfig::default() };
    let network = RoadNetwork::derive(&StreetPlan::grid(4, 4, 120.0), &config).unwrap();
    let traffic_config = TrafficConfig { vehicles: 70, pedestrians: 40, ..TrafficConfig::default() };
    let mut traffic = Traffic::new(Arc::new(network), &traffic_config, Seed(5)).unwrap();
    for step in 0..4000 {
        traffic.step(0.1);
        assert_apart(&traffic, step);
    }
    assert!(traffic.counters().crossings > 70 * 400 / 60, "{:?}", traffic.counters());
}
