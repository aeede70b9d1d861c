//! Near junctions are one to drivers: opposing streams go at once, nobody touches or runs a red, what is closed inside is closed, and
//! routes over the streets as they are drawn are driven.

use std::collections::BTreeSet;
use std::sync::Arc;

use simworld_core::geometry::Point2;
use simworld_core::id::{ConnectionId, RoadId};
use simworld_core::net::{CrossSection, LaneDirection, NetworkConfig, RoadNetwork, Street, StreetPlan};
use simworld_core::scene::World;
use simworld_core::seed::Seed;
use simworld_traffic::signal::Actuated;
use simworld_traffic::vehicle::VehicleKind;
use simworld_traffic::{Closed, Closure, Flow, Leg, Route, Router, Traffic, TrafficConfig, TrafficDynamics};

use crate::contacts::touching;

/// Streets of the plan by their numbers: those of the carriageways, towards the middle and on, from the south, the piece between the
/// carriageways, and to the north.
const TO_EAST: [u32; 2] = [0, 1];
const TO_WEST: [u32; 2] = [2, 3];
const SOUTH: u32 = 4;
const BETWEEN: u32 = 5;
const NORTH: u32 = 6;

/// Where a street from south to north crosses one with two carriageways, 16 m apart.
fn network() -> Arc<RoadNetwork> {
    let mut plan = StreetPlan::default();
    let one_way = plan.add_section(CrossSection::two_way(2, 0));
    let nodes = [[0, 0], [0, 16], [-200, 0], [200, 0], [-200, 16], [200, 16], [0, -200], [0, 216]];
    plan.nodes.extend(nodes.map(|[x, y]| Point2::new(f64::from(x), f64::from(y))));
    for (from, to) in [(2, 0), (0, 3), (5, 1), (1, 4)] {
        plan.streets.push(Street { section: one_way, ..Street::simple(from, to) });
    }
    plan.streets.extend([(6, 0), (0, 1), (1, 7)].map(|(from, to)| Street::simple(from, to)));
    Arc::new(RoadNetwork::derive(&plan, &NetworkConfig::default()).expect("it is a plan"))
}

fn leg(road: u32, direction: LaneDirection) -> Leg {
    Leg::new(RoadId(road), direction)
}

/// The ways over the street between the carriageways, as they are drawn: to the north and to the south.
fn over_the_middle() -> [Route; 2] {
    use LaneDirection::{Backward, Forward};
    [
        Route([SOUTH, BETWEEN, NORTH].map(|road| leg(road, Forward)).to_vec()),
        Route([NORTH, BETWEEN, SOUTH].map(|road| leg(road, Backward)).to_vec()),
    ]
}

fn along_the_carriageways() -> [Route; 2] {
    [TO_EAST, TO_WEST].map(|roads| Route(roads.map(|road| leg(road, LaneDirection::Forward)).to_vec()))
}

fn empty() -> TrafficConfig {
    TrafficConfig { vehicles: 0, pedestrians: 0, ..TrafficConfig::default() }
}

/// Streams on all four ways, so many vehicles an hour each.
fn busy(config: &TrafficConfig, per_hour: f64) -> Traffic {
    let mut traffic = Traffic::new(network(), config, Seed(1)).expect("the settings are in range");
    traffic.set_policy(Box::new(Actuated::default()));
    for route in over_the_middle().into_iter().chain(along_the_carriageways()) {
        route.validate(&network()).expect("it is a route of the streets as they are drawn");
        let flow = Flow { kind: Some(VehicleKind::Car), ..Flow::new(route, per_hour) };
        traffic.add_flow(flow).expect("it is a route of the traffic");
    }
    traffic
}

#[test]
fn opposing_streams_go_at_once_and_more_come_through() {
    let arrived = |config: &TrafficConfig| {
        let mut traffic = busy(config, 500.0);
        let lanes = traffic.network().lanes.len() as u32;
        let mut at_once = 0;
        for step in 0..9000 {
            traffic.step(0.1);
            if step % 5 == 0 {
                assert_eq!(touching(&traffic), [], "at {} s", traffic.seconds());
                let network = traffic.network();
                let ways = traffic.stations().filter_map(|(_, track, ..)| track.checked_sub(lanes));
                let from = ways.map(|way| network.connections[ConnectionId(way).index()].from);
                let roads: BTreeSet<u32> = from.map(|lane| network.lanes[lane.index()].road.0).collect();
                at_once += u32::from(roads.contains(&SOUTH) && roads.contains(&NORTH));
            }
        }
        let counters = traffic.counters();
        assert_eq!(counters.dilemmas, 0, "nobody runs a red");
        assert_eq!(counters.entered, counters.arrived + traffic.vehicles().count() as u64);
        (counters.arrived, at_once)
    };
    let (joined, at_once) = arrived(&empty());
    let (alone, _) = arrived(&TrafficConfig { join_nearer: 0.0, ..empty() });
    assert!(at_once > 100, "in {at_once} half seconds both are in the junction");
    assert!(
        joined > 440 && joined * 10 > alone * 12,
        "{joined} of 500, {alone} where each junction is by itself"
    );
}

#[test]
fn what_is_closed_inside_is_not_driven_over() {
    let mut traffic = busy(&empty(), 300.0);
    let between = [LaneDirection::Forward, LaneDirection::Backward].map(|direction| leg(BETWEEN, direction));
    let closures =
        between.map(|leg| traffic.close(Closure::new(Closed::Leg(leg))).expect("there is such a street"));
    let drawn = network();
    let road = &drawn.roads[BETWEEN as usize];
    let middle = Point2::from((road.centerline[0].coords + road.centerline[1].coords) * 0.5);
    let near = |traffic: &Traffic| {
        let at = |x: f64, y: f64| (x - middle.x).abs() < 4.0 && (y - middle.y).abs() < 1.5;
        traffic.vehicles().filter(|body| at(body.pose.translation.x, body.pose.translation.y)).count()
    };
    for _ in 0..3000 {
        traffic.step(0.1);
        assert_eq!(near(&traffic), 0, "at {} s", traffic.seconds());
    }
    let before = traffic.counters().arrived;
    assert!(before > 20, "the carriageways are open: {before}");
    for closure in closures {
        assert!(traffic.reopen(closure));
    }
    let mut over = 0;
    for _ in 0..3000 {
        traffic.step(0.1);
        over += near(&traffic);
    }
    assert!(over > 20, "{over} times somebody is there when it is open");
}

#[test]
fn saved_and_restored_it_goes_on_the_same() {
    let mut world = World::new();
    world.set_roads(network());
    let bare = world.clone();
    let config = TrafficConfig { vehicles: 20, pedestrians: 10, ..TrafficConfig::default() };
    TrafficDynamics::new(&mut world, &config, Seed(3)).unwrap();
    simworld_core::testing::check_dynamics(&world, || {
        let mut copy = bare.clone();
        Box::new(TrafficDynamics::new(&mut copy, &config, Seed(3)).unwrap())
    });
}

#[test]
fn its_routes_are_those_of_the_streets_as_they_are_drawn() {
    let traffic = Traffic::new(network(), &empty(), Seed(1)).expect("the settings are in range");
    let (own, drawn) = (Router::new(traffic.network()), Router::new(&network()));
    let ends = |road: u32| [LaneDirection::Forward, LaneDirection::Backward].map(|way| leg(road, way));
    let outside = || (0..7).filter(|road| *road != BETWEEN).flat_map(ends);
    for from in outside() {
        for to in outside().filter(|to| *to != from) {
            let mut route = drawn.quickest(from, to).map(|route| route.0);
            if let Some(route) = &mut route {
                route.retain(|leg| leg.road() != RoadId(BETWEEN));
            }
            assert_eq!(own.quickest(from, to).map(|route| route.0), route);
        }
    }
}
