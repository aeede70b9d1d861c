//! Ways that a plan knows lane by lane go before arrows and rules, on either side of the road and after changes.

use std::f64::consts::{FRAC_PI_2, PI};

use simworld_core::geometry::Point2;
use simworld_core::net::*;
use simworld_core::rare::Rare;

/// Four arms of two lanes each way; the first one, to the east, knows its ways.
fn plan(side: DrivingSide) -> StreetPlan {
    let mut plan = StreetPlan::crossroads(100.0);
    plan.driving_side = side;
    let mut section = CrossSection::two_way(2, 2);
    if side == DrivingSide::Left {
        section.lanes.reverse();
    }
    let wide = plan.add_section(section);
    plan.streets.iter_mut().for_each(|street| street.section = wide);
    let ways = |heading: f64, lanes: &[(u8, u8)]| LaneWays { heading, lanes: lanes.to_vec() };
    // North by both lanes into both, crosswise; nobody to the west; south from the inner lane alone.
    plan.streets[0].turns.backward_ways =
        vec![ways(FRAC_PI_2, &[(0, 1), (1, 0), (1, 1)]), ways(PI, &[]), ways(-FRAC_PI_2, &[(0, 0)])];
    plan
}

/// The ways from the eastern arm: rank of the lane, number of the street, and rank of the lane there.
fn ways(network: &RoadNetwork) -> Vec<(usize, u32, usize)> {
    let mut found = Vec::new();
    for (rank, lane) in network.roads[0].backward.iter().enumerate() {
        for way in &network.lanes[lane.index()].outgoing {
            let to = network.connections[way.index()].to;
            let road = network.lanes[to.index()].road;
            let lanes = &network.roads[road.index()];
            let lanes = if lanes.forward.contains(&to) { &lanes.forward } else { &lanes.backward };
            found.push((rank, road.0, lanes.iter().position(|lane| *lane == to).unwrap()));
        }
    }
    found.sort_unstable();
    found
}

fn derived(plan: &StreetPlan) -> RoadNetwork {
    let network = RoadNetwork::derive(plan, &NetworkConfig::default()).unwrap();
    network.check().unwrap();
    network
}

const KNOWN: [(usize, u32, usize); 4] = [(0, 1, 1), (0, 3, 0), (1, 1, 0), (1, 1, 1)];

#[test]
fn known_ways_go_before_rules_and_arrows() {
    for side in [DrivingSide::Right, DrivingSide::Left] {
        let mut plan = plan(side);
        assert_eq!(ways(&derived(&plan)), KNOWN, "{side:?}");
        plan.streets[0].turns.backward = vec![TurnSet::of(&[Turn::Straight]); 2];
        assert_eq!(ways(&derived(&plan)), KNOWN, "{side:?}");
    }
}

#[test]
fn the_lanes_of_a_bend_are_linked_as_they_say() {
    let mut plan = plan(DrivingSide::Right);
    plan.streets.truncate(2);
    plan.nodes.truncate(3);
    assert_eq!(ways(&derived(&plan)), [(0, 1, 1), (1, 1, 0), (1, 1, 1)]);
}

#[test]
fn a_new_street_is_left_to_the_rules_and_one_that_went_is_forgotten() {
    let mut plan = plan(DrivingSide::Right);
    let config = NetworkConfig::default();
    let mut network = derived(&plan);
    // A fifth arm to the north-east: who comes from the east turns right into it from the outer lane.
    plan.nodes.push(Point2::new(70.0, 70.0));
    plan.streets.push(Street { section: 1, ..Street::simple(0, 5) });
    network.repair(&plan, &config, &PlanChange::default()).unwrap();
    let mut with_new = KNOWN.to_vec();
    with_new.push((1, 4, 1));
    assert_eq!(ways(&network), with_new);
    assert_eq!(ways(&derived(&plan)), with_new);
    // The southern arm goes; the new street gets its number.
    plan.streets.swap_remove(3);
    let change = PlanChange { streets_removed: vec![3], ..PlanChange::default() };
    network.repair(&plan, &config, &change).unwrap();
    assert_eq!(ways(&network), [(0, 1, 1), (1, 1, 0), (1, 1, 1), (1, 3, 1)]);
}

#[test]
fn ways_that_nobody_can_go_are_no_ways() {
    let mut plan = plan(DrivingSide::Right);
    let plain = {
        let mut plan = plan.clone();
        plan.streets[0].turns = Rare::default();
        ways(&derived(&plan))
    };
    // All forbidden is a mistake, as arrows are that no street answers.
    plan.streets[0].turns.backward_ways.iter_mut().for_each(|ways| ways.lanes.clear());
    assert_eq!(ways(&derived(&plan)), plain);
    for lanes in [vec![(2, 0)], vec![(1, 0), (0, 0)], vec![(0, 0), (0, 0)]] {
        plan.streets[0].turns.backward_ways[0].lanes = lanes;
        let error = plan.validate().unwrap_err().to_string();
        assert!(error.contains("impossible ways"), "{error}");
    }
    plan.streets[0].turns.backward_ways[0] = LaneWays { heading: f64::NAN, lanes: Vec::new() };
    assert!(plan.validate().is_err());
}
