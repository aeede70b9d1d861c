//! Routes of the hierarchy take as long as those of Dijkstra's search, whatever leads where.

#![allow(clippy::unwrap_used)]

use proptest::prelude::*;
use simworld_core::id::RoadId;
use simworld_core::net::{LaneDirection, NetworkConfig, RoadNetwork, StreetPlan};
use simworld_core::seed::Seed;
use simworld_traffic::{Leg, LegHierarchy, LegScratch, Router};

/// A grid on which some ways across junctions are closed, lanes differ in speed, and some have no length.
fn network(columns: usize, rows: usize, closed: f64, seed: u64) -> RoadNetwork {
    let plan = StreetPlan::grid(columns, rows, 120.0);
    let mut network = RoadNetwork::derive(&plan, &NetworkConfig::default()).unwrap();
    let mut rng = Seed(seed).stream("test/network").rng();
    network.connections.retain(|_| rng.unit() >= closed);
    for lane in &mut network.lanes {
        lane.speed_limit = 3.0 + 27.0 * rng.unit();
        lane.length *= f64::from(u8::from(rng.unit() > 0.1));
    }
    for connection in &mut network.connections {
        connection.length *= f64::from(u8::from(rng.unit() > 0.1));
    }
    network
}

/// How many pairs of legs a route joins, and how many none does.
fn check(network: &RoadNetwork) -> [usize; 2] {
    let router = Router::new(network);
    let hierarchy = LegHierarchy::new(network);
    let mut scratch = LegScratch::default();
    // Two roads more than there are.
    let legs: Vec<Leg> = (0..network.roads.len() as u32 + 2)
        .flat_map(|road| [LaneDirection::Forward, LaneDirection::Backward].map(|d| Leg::new(RoadId(road), d)))
        .collect();
    let mut counts = [0; 2];
    for from in &legs {
        for to in &legs {
            let expected = router.quickest(*from, *to);
            let found = hierarchy.quickest(*from, *to, &mut scratch);
            assert_eq!(found.is_some(), expected.is_some(), "{from:?} to {to:?}");
            counts[usize::from(found.is_none())] += 1;
            let (Some(found), Some(expected)) = (found, expected) else { continue };
            assert_eq!([found.0[0], found.0[found.0.len() - 1]], [*from, *to]);
            let time = router.time(&found).expect("each leg leads on to the next");
            let best = router.time(&expected).unwrap();
            // What takes no time weighs a microsecond.
            let slack = 1.1e-6 * (legs.len() + 1) as f64;
            assert!((time - best).abs() < slack, "{from:?} to {to:?}: {time} s, not {best} s");
        }
    }
    counts
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn every_route_takes_as_long(
        columns in 1_usize..8,
        rows in 2_usize..8,
        closed in 0.0..0.8,
        seed in any::<u64>(),
    ) {
        check(&network(columns, rows, closed, seed));
    }
}

#[test]
fn a_whole_grid_is_joined_and_a_torn_one_is_not() {
    let [joined, apart] = check(&network(4, 4, 0.0, 1));
    assert!(joined > apart * 4, "{joined} joined, {apart} apart");
    let [joined, apart] = check(&network(4, 4, 0.7, 1));
    assert!(joined > 100 && apart > joined, "{joined} joined, {apart} apart");
}

#[test]
fn without_ways_only_staying_is_left() {
    let network = network(2, 2, 1.1, 1);
    let [joined, _] = check(&network);
    assert_eq!(joined, network.roads.len() * 2);
}

#[test]
fn the_same_network_gives_the_same_routes() {
    let network = network(5, 5, 0.1, 7);
    let routes = || {
        let hierarchy = LegHierarchy::new(&network);
        let mut scratch = LegScratch::default();
        let legs =
            || (0..network.roads.len() as u32).map(|road| Leg::new(RoadId(road), LaneDirection::Forward));
        let mut found = Vec::new();
        for from in legs() {
            found.extend(legs().map(|to| hierarchy.quickest(from, to, &mut scratch)));
        }
        found
    };
    assert_eq!(routes(), routes());
}
