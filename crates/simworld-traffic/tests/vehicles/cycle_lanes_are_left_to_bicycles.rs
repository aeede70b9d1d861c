//! Vehicles on streets with cycle lanes, medians, parking and turning circles: none gets on to a cycle lane, all turn round
//! at dead ends, nobody is led astray by a route.

use std::sync::Arc;

use simworld_core::geometry::Point2;
use simworld_core::id::{ConnectionId, LaneId};
use simworld_core::net::{CrossSection, NetworkConfig, RoadNetwork, Street, StreetPlan, Turn};
use simworld_core::seed::Seed;
use simworld_traffic::{Leg, Router, Traffic, TrafficConfig};

/// A grid of boulevards, with a dead end at each corner of it.
fn boulevards() -> Arc<RoadNetwork> {
    let mut plan = StreetPlan::grid(3, 3, 140.0);
    plan.sections[0] = CrossSection::two_way(1, 1).with_median(2.0).with_cycle_lanes(1.8).with_parking(2.2);
    for (corner, (x, y)) in [(0, (-90.0, -90.0)), (2, (370.0, -90.0)), (8, (370.0, 370.0))] {
        plan.nodes.push(Point2::new(x, y));
        plan.streets.push(Street::simple(corner, plan.nodes.len() - 1));
    }
    plan.make_turning_room();
    let network = RoadNetwork::derive(&plan, &NetworkConfig::default()).expect("the plan is sound");
    let circles = network.intersections.iter().filter(|place| place.turning.is_some());
    assert_eq!(circles.count(), 3);
    Arc::new(network)
}

#[test]
fn no_vehicle_is_ever_on_a_cycle_lane() {
    let network = boulevards();
    let config = TrafficConfig { vehicles: 60, pedestrians: 0, ..TrafficConfig::default() };
    let mut traffic =
        Traffic::new(Arc::clone(&network), &config, Seed(3)).expect("the settings are in range");
    assert_eq!(traffic.placed().vehicles, 60);
    let lanes = network.lanes.len() as u32;
    let mut turned = 0;
    for step in 0..3000 {
        for (id, track, _, _) in traffic.stations() {
            let lane = match track.checked_sub(lanes) {
                None => LaneId(track),
                Some(way) => {
                    let way = &network.connections[ConnectionId(way).index()];
                    turned += u32::from(way.turn == Turn::UTurn);
                    way.to
                }
            };
            assert!(network.lanes[lane.index()].is_driven(), "vehicle {id} at step {step}");
        }
        traffic.step(0.1);
    }
    assert!(turned > 100, "nobody turned round at a dead end");
}

#[test]
fn routes_follow_lanes_for_vehicles() {
    let network = boulevards();
    let router = Router::new(&network);
    let legs: Vec<Leg> = network
        .roads
        .iter()
        .flat_map(|road| [&road.forward, &road.backward])
        .map(|lanes| Leg::of(&network, lanes[0]))
        .collect();
    for from in &legs {
        for to in &legs {
            let route = router.quickest(*from, *to).expect("all streets meet");
            route.validate(&network).expect("one can drive it");
        }
    }
}
