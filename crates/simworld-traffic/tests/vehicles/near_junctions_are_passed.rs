//! Junctions nearer to one another than a vehicle is long: whoever waits between them stands in both, and still goes on.

use std::sync::Arc;

use simworld_core::geometry::Point2;
use simworld_core::net::{NetworkConfig, RoadNetwork, Street, StreetPlan};
use simworld_core::seed::Seed;
use simworld_traffic::signal::Actuated;
use simworld_traffic::{Traffic, TrafficConfig};

use crate::contacts::touching;

/// Two parallel streets so near that the pieces of the cross streets between them are a few metres long, and dead ends of a few
/// metres.
fn plan(apart: f64) -> StreetPlan {
    let mut plan = StreetPlan::default();
    for row in [0.0, apart] {
        plan.nodes.extend((0..5).map(|column| Point2::new(130.0 * f64::from(column), row)));
    }
    for row in [0, 5] {
        plan.streets.extend((row..row + 4).map(|node| Street::simple(node, node + 1)));
    }
    plan.streets.extend((0..5).map(|node| Street::simple(node, node + 5)));
    for (node, y) in [(1, -120.0), (3, -120.0), (6, apart + 120.0), (8, apart + 120.0)] {
        plan.nodes.push(Point2::new(plan.nodes[node].x, y));
        plan.streets.push(Street::simple(node, plan.nodes.len() - 1));
    }
    plan.nodes.push(Point2::new(260.0, -17.0));
    plan.streets.push(Street::simple(2, plan.nodes.len() - 1));
    plan
}

#[test]
fn nobody_stands_for_good_between_junctions_near_one_another() {
    let network = RoadNetwork::derive(&plan(16.0), &NetworkConfig::default()).expect("it is a plan");
    let short = network.lanes.iter().filter(|lane| lane.length < 6.0).count();
    assert!(short > 6, "lanes shorter than a car and its gap: {short}");
    let network = Arc::new(network);
    // Joined, and each by itself with a permit for all.
    for (seed, join_nearer) in (0..3).flat_map(|seed| [(seed, 13.0), (seed, 0.0)]) {
        let config = TrafficConfig { vehicles: 26, pedestrians: 10, join_nearer, ..TrafficConfig::default() };
        let mut traffic =
            Traffic::new(Arc::clone(&network), &config, Seed(seed)).expect("the settings are in range");
        traffic.set_policy(Box::new(Actuated::default()));
        let mut last = 0;
        for quarter in 0..4 {
            for step in 0..9000 {
                traffic.step(0.1);
                if step % 5 == 0 {
                    assert_eq!(
                        touching(&traffic),
                        [],
                        "at {} s with seed {seed}, joined below {join_nearer} m",
                        traffic.seconds()
                    );
                }
            }
            let crossings = traffic.counters().crossings;
            // Each crosses a junction every two minutes at least.
            assert!(
                crossings - last > 26 * 7,
                "quarter {quarter} of seed {seed}, joined below {join_nearer} m: {:?}",
                traffic.counters()
            );
            last = crossings;
        }
    }
}
