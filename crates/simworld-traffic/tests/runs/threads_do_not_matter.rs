//! Traffic takes the same way to the bit on one, two and eight threads, whoever works first.

use std::sync::Arc;

use crate::lent_threads::Threads;
use simworld_core::geometry::Point2;
use simworld_core::hash::{StateDigest, StateHash};
use simworld_core::id::LaneId;
use simworld_core::net::{CrossSection, NetworkConfig, RoadNetwork, StreetPlan, Workers};
use simworld_core::seed::Seed;
use simworld_traffic::vehicle::VehicleKind;
use simworld_traffic::{Interest, Leg, Route, Router, Traffic, TrafficConfig};

/// The last part first.
struct Backwards;

impl Workers for Backwards {
    fn run(&self, parts: usize, work: &(dyn Fn(usize) + Sync)) {
        (0..parts).rev().for_each(work);
    }
}

/// A network of several parts: twelve by twelve junctions, two lanes a direction.
fn network() -> Arc<RoadNetwork> {
    let mut plan = StreetPlan::grid(12, 12, 110.0);
    plan.sections[0] = CrossSection::two_way(2, 2);
    Arc::new(RoadNetwork::derive(&plan, &NetworkConfig::default()).expect("a grid is a network"))
}

/// Short routes from some of the roads, so that vehicles come and go.
fn routes(network: &RoadNetwork) -> Vec<Route> {
    let router = Router::new(network);
    let lanes = (0..network.lanes.len()).step_by(29).map(LaneId::from_index);
    let legs = lanes.map(|lane| Leg::of(network, lane));
    legs.filter_map(|leg| Some(Route(vec![leg, router.after(leg).next()?]))).collect()
}

fn digests(
    workers: Option<Box<dyn Workers + Send + Sync>>,
    interest: Option<Vec<Interest>>,
) -> Vec<StateDigest> {
    let network = network();
    let config = TrafficConfig { vehicles: 1200, pedestrians: 300, ..TrafficConfig::default() };
    let mut traffic =
        Traffic::new(Arc::clone(&network), &config, Seed(8)).expect("the settings are in range");
    traffic.set_interest(interest).expect("the places are sound");
    if let Some(workers) = workers {
        traffic.set_workers(workers);
    }
    for route in routes(&network) {
        traffic.insert(route, VehicleKind::Car).expect("the router's routes can be driven");
    }
    let digests = (0..6).map(|_| {
        (0..100).for_each(|_| traffic.step(0.1));
        traffic.digest()
    });
    let digests = digests.collect();
    let counters = traffic.counters();
    assert!(counters.entered > 5 && counters.arrived > 0, "vehicles come and go: {counters:?}");
    assert!(
        counters.crossings > 500 && counters.lane_changes > 50,
        "they pass from part to part: {counters:?}"
    );
    digests
}

#[test]
fn traffic_is_the_same_on_any_number_of_threads() {
    let corner = Interest { center: Point2::origin(), radius: 400.0 };
    for interest in [None, Some(vec![corner])] {
        let alone = digests(None, interest.clone());
        assert!(alone.windows(2).all(|pair| pair[0] != pair[1]), "traffic moves");
        for threads in [2, 8] {
            assert_eq!(
                alone,
                digests(Some(Box::new(Threads(threads))), interest.clone()),
                "{threads} threads"
            );
        }
        assert_eq!(alone, digests(Some(Box::new(Backwards)), interest), "the last part first");
    }
}
