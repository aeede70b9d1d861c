//! Drivers on a trip who know how long the streets take leave those that have become slow; others, buses and whoever is to halt keep to
//! their routes.

use std::sync::Arc;

use simworld_core::geometry::Point2;
use simworld_core::hash::StateHash;
use simworld_core::id::LaneId;
use simworld_core::net::{NetworkConfig, RoadNetwork, StreetPlan};
use simworld_core::scene::World;
use simworld_core::seam::Dynamics;
use simworld_core::seed::Seed;
use simworld_traffic::vehicle::VehicleKind;
use simworld_traffic::{Counters, Flow, Leg, Route, Stop, Traffic, TrafficConfig, TrafficDynamics};

use crate::lent_threads::Threads;

/// Five streets by three, with lights where four meet.
fn network() -> Arc<RoadNetwork> {
    let plan = StreetPlan::grid(5, 3, 150.0);
    Arc::new(RoadNetwork::derive(&plan, &NetworkConfig::default()).expect("a grid is a network"))
}

/// The way over junctions of the grid, by column and row.
fn route(network: &RoadNetwork, junctions: &[(u32, u32)]) -> Route {
    let leg = |ends: &[(u32, u32)]| {
        let at = |(column, row): (u32, u32)| Point2::new(f64::from(column), f64::from(row)) * 150.0;
        let origin = network.intersections[0].center;
        let is = |junction: simworld_core::id::IntersectionId, end| {
            let offset = network.intersections[junction.index()].center - origin;
            (offset - (at(end) - Point2::origin())).norm() < 1.0
        };
        let lane = network.lanes.iter().position(|lane| is(lane.from, ends[0]) && is(lane.to, ends[1]));
        Leg::of(network, LaneId::from_index(lane.expect("a street leads there")))
    };
    Route(junctions.windows(2).map(leg).collect())
}

/// Two flows that want through one street, by which not all of them come.
fn flows(network: &RoadNetwork) -> [Flow; 2] {
    let straight = route(network, &[(0, 1), (1, 1), (2, 1), (3, 1), (4, 1)]);
    let turning = route(network, &[(1, 2), (1, 1), (2, 1), (3, 1), (4, 1)]);
    [Flow::new(straight, 700.0), Flow::new(turning, 700.0)]
}

fn config(informed: f64) -> TrafficConfig {
    TrafficConfig { vehicles: 0, pedestrians: 0, informed, ..TrafficConfig::default() }
}

/// What is counted in half an hour.
fn half_an_hour(informed: f64, change: impl Fn(Flow) -> Flow) -> Counters {
    let network = network();
    let mut traffic = Traffic::new(Arc::clone(&network), &config(informed), Seed(4)).unwrap();
    for flow in flows(&network) {
        traffic.add_flow(change(flow)).unwrap();
    }
    (0..18_000).for_each(|_| traffic.step(0.1));
    traffic.counters()
}

#[test]
fn more_arrive_where_drivers_know_how_long_streets_take() {
    let cars = |flow| Flow { kind: Some(VehicleKind::Car), ..flow };
    let (knowing, not) = (half_an_hour(1.0, cars), half_an_hour(0.0, cars));
    assert!(knowing.detours > 20 && not.detours == 0, "{knowing:?} and {not:?}");
    assert!(knowing.arrived as f64 > 1.1 * not.arrived as f64, "{knowing:?} and {not:?}");
    let some = half_an_hour(0.3, cars);
    assert!(some.detours > 0 && some.arrived > not.arrived, "{some:?} and {not:?}");
}

#[test]
fn buses_and_who_is_to_halt_keep_to_their_routes() {
    let buses = half_an_hour(1.0, |flow| Flow { kind: Some(VehicleKind::Bus), ..flow });
    assert!(buses.detours == 0 && buses.arrived > 50, "{buses:?}");
    let halting = half_an_hour(1.0, |flow| {
        let stops = flow.route.0[3..].iter().map(|leg| Stop::new(*leg, 60.0, 1.0)).collect();
        Flow { kind: Some(VehicleKind::Car), stops, ..flow }
    });
    assert!(halting.detours == 0 && halting.halts > 50, "{halting:?}");
}

#[test]
fn who_leaves_a_street_does_so_on_any_number_of_threads_and_after_a_restore() {
    let make = |threads: usize| {
        let mut world = World::new();
        let network = network();
        world.set_roads(Arc::clone(&network));
        let mut dynamics = TrafficDynamics::new(&mut world, &config(1.0), Seed(9)).unwrap();
        for flow in flows(&network) {
            dynamics.traffic_mut().add_flow(flow).unwrap();
        }
        if threads > 0 {
            dynamics.traffic_mut().set_workers(Box::new(Threads(threads)));
        }
        (world, dynamics)
    };
    let run = |(world, dynamics): &mut (World, TrafficDynamics), steps: u32| {
        (0..steps).for_each(|_| dynamics.step(world, 0.1).unwrap());
        dynamics.traffic().digest()
    };
    let (mut one, mut three) = (make(0), make(3));
    assert_eq!(run(&mut one, 5000), run(&mut three, 5000));
    let saved = one.1.save().unwrap();
    let mut again = (one.0.clone(), make(0).1);
    again.1.restore(&one.0, &saved).unwrap();
    let before = one.1.traffic().counters().detours;
    let digest = run(&mut one, 4000);
    assert_eq!(digest, run(&mut again, 4000));
    assert_eq!(digest, run(&mut three, 4000));
    assert!(one.1.traffic().counters().detours > before && before > 0);
}
