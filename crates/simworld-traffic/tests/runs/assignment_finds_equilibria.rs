//! Assignment against answers that are known, and estimation against demand that it has to find again.

use proptest::prelude::*;
use simworld_core::net::{NetworkConfig, RoadNetwork, StreetPlan};
use simworld_traffic::assignment::{
    AssignmentError, EquilibriumConfig, EstimateConfig, LegGraph, Link, Pair, equilibrium, estimate,
};

/// Time that rises in a line: `free_time + slope * x`.
fn linear(from: u32, to: u32, free_time: f64, slope: f64) -> Link {
    Link { from, to, free_time, delay: slope, capacity: 1.0, power: 1.0 }
}

/// Braess's network: 0 to 3 by 1 or 2.
fn braess(shortcut: bool) -> Vec<Link> {
    let mut links = vec![
        linear(0, 1, 0.0, 10.0),
        linear(0, 2, 50.0, 1.0),
        linear(1, 3, 50.0, 1.0),
        linear(2, 3, 0.0, 10.0),
    ];
    if shortcut {
        links.push(linear(1, 2, 10.0, 1.0));
    }
    links
}

#[test]
fn a_new_road_makes_everybody_slower_in_braesss_network() {
    let demand = [Pair { from: 0, to: 3, volume: 6.0 }];
    let time = |links: &[Link]| {
        let found = equilibrium(links, &demand, EquilibriumConfig { gap: 1e-10, rounds: 500 }).unwrap();
        let used: Vec<f64> = found.paths[0]
            .iter()
            .map(|path| path.links.iter().map(|link| found.times[*link as usize]).sum())
            .collect();
        assert!(
            used.iter().all(|time| (time - used[0]).abs() < 1e-4),
            "all used paths take equally long: {used:?}"
        );
        (used[0], found)
    };
    // Braess (1968): 83 on two paths of three each; 92 on three paths of two each.
    let (without, found) = time(&braess(false));
    assert!((without - 83.0).abs() < 1e-4 && (found.volumes[0] - 3.0).abs() < 1e-4, "{without}");
    let (with, found) = time(&braess(true));
    assert!(
        (with - 92.0).abs() < 1e-4 && (found.volumes[4] - 2.0).abs() < 1e-4,
        "{with}, {:?}",
        found.volumes
    );
    assert_eq!(found.paths[0].len(), 3);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(40))]

    /// Wardrop's first principle, and conservation, on grids of random links.
    #[test]
    fn nobody_can_do_better_alone(
        times in prop::collection::vec((1.0..50.0_f64, 300.0..1500.0_f64), 40),
        volumes in prop::collection::vec(0.0..800.0_f64, 3),
    ) {
        // A grid of 4 by 4 nodes, one-way east and north, and a way round.
        let mut links = Vec::new();
        for node in 0..16_u32 {
            let (time, capacity) = times[node as usize];
            if node % 4 < 3 { links.push(Link::bpr(node, node + 1, time, capacity)); }
            let (time, capacity) = times[16 + node as usize];
            if node < 12 { links.push(Link::bpr(node, node + 4, time, capacity)); }
        }
        let ends = [(0, 15), (1, 15), (0, 11)];
        let pairs: Vec<Pair> = ends.iter().zip(&volumes).map(|((from, to), volume)| Pair { from: *from, to: *to, volume: *volume }).collect();
        let found = equilibrium(&links, &pairs, EquilibriumConfig::default()).unwrap();
        prop_assert!(found.gap < 1e-4, "gap {} after {}", found.gap, found.rounds);
        // Whoever drives takes no longer than the quickest way at the times of all (Bellman and Ford).
        let (mut spent, mut needed) = (0.0, 0.0);
        for (pair, paths) in pairs.iter().zip(&found.paths) {
            let mut best = [f64::INFINITY; 16];
            best[pair.from as usize] = 0.0;
            for _ in 0..16 {
                for (link, time) in links.iter().zip(&found.times) {
                    best[link.to as usize] = best[link.to as usize].min(best[link.from as usize] + time);
                }
            }
            needed += best[pair.to as usize] * paths.iter().map(|path| path.volume).sum::<f64>();
            let time = |path: &[u32]| path.iter().map(|link| found.times[*link as usize]).sum::<f64>();
            spent += paths.iter().map(|path| path.volume * time(&path.links)).sum::<f64>();
        }
        prop_assert!(spent - needed <= 1e-4 * spent, "{spent} s spent, {needed} s needed");
        let mut volumes = vec![0.0; links.len()];
        for (pair, paths) in pairs.iter().zip(&found.paths) {
            prop_assert!((paths.iter().map(|path| path.volume).sum::<f64>() - pair.volume).abs() < 1e-6);
            for path in paths {
                let mut node = pair.from;
                for link in &path.links {
                    prop_assert_eq!(links[*link as usize].from, node);
                    node = links[*link as usize].to;
                    volumes[*link as usize] += path.volume;
                }
                prop_assert_eq!(node, pair.to);
            }
        }
        for (sum, volume) in volumes.iter().zip(&found.volumes) {
            prop_assert!((sum - volume).abs() < 1e-6);
        }
    }

    /// Counts made from a demand give that demand back where they see enough of it.
    #[test]
    fn demand_is_found_again(
        demand in prop::collection::vec(prop_oneof![Just(0.0), 10.0..900.0_f64], 8),
        shares in prop::collection::vec(0.0..1.0_f64, 8 * 20),
    ) {
        let counts: Vec<f64> =
            shares.chunks(8).map(|row| row.iter().zip(&demand).map(|(share, x)| share * x).sum()).collect();
        let found = estimate(&shares, &counts, &[100.0; 8], EstimateConfig { prior_weight: 1e-9 }).unwrap();
        for (found, wanted) in found.iter().zip(&demand) {
            prop_assert!((found - wanted).abs() < 0.01, "{found} for {wanted}");
        }
    }
}

#[test]
fn without_counts_the_demand_from_before_stays_and_none_is_negative() {
    let config = EstimateConfig { prior_weight: 0.1 };
    assert_eq!(estimate(&[], &[], &[3.0, 0.0], config).unwrap(), [3.0, 0.0]);
    // The second count is less than what the first one's pair alone sends past it: nobody else is left, none is negative.
    let found =
        estimate(&[1.0, 0.0, 1.0, 1.0], &[100.0, 50.0], &[0.0, 0.0], EstimateConfig { prior_weight: 0.0 })
            .unwrap();
    assert!((found[0] - 75.0).abs() < 1e-9 && found[1] == 0.0, "{found:?}");
    // Two pairs that every count sees alike: their sum is known.
    let found = estimate(&[1.0, 1.0], &[100.0], &[0.0, 0.0], EstimateConfig { prior_weight: 0.0 }).unwrap();
    assert!((found[0] + found[1] - 100.0).abs() < 1e-9, "{found:?}");
}

#[test]
fn a_citys_paths_are_routes_and_counts_on_its_roads_give_its_demand() {
    let network = RoadNetwork::derive(&StreetPlan::grid(4, 4, 150.0), &NetworkConfig::default()).unwrap();
    let graph = LegGraph::new(&network, 900.0);
    let legs: Vec<_> = graph.legs.iter().copied().flatten().collect();
    let ends = [(0, 40), (40, 0), (3, 30), (21, 5), (12, 44)];
    let pairs: Vec<Pair> = ends
        .iter()
        .zip([700.0, 500.0, 900.0, 300.0, 400.0])
        .map(|((from, to), volume)| Pair {
            from: LegGraph::nodes(legs[*from]).0,
            to: LegGraph::nodes(legs[*to]).1,
            volume,
        })
        .collect();
    let found = equilibrium(&graph.links, &pairs, EquilibriumConfig::default()).unwrap();
    assert!(found.gap <= 1e-6, "{}", found.gap);
    for ((from, to), paths) in ends.iter().zip(&found.paths) {
        assert!(!paths.is_empty());
        for path in paths {
            let route = graph.route(path);
            route.validate(&network).unwrap();
            assert_eq!((route.0[0], route.0[route.0.len() - 1]), (legs[*from], legs[*to]));
        }
    }
    let counted: Vec<u32> = legs.iter().map(|leg| graph.link(*leg).unwrap()).collect();
    let counts: Vec<f64> = counted.iter().map(|link| found.volumes[*link as usize]).collect();
    let again =
        estimate(&found.proportions(&counted), &counts, &[500.0; 5], EstimateConfig::default()).unwrap();
    for (again, pair) in again.iter().zip(&pairs) {
        assert!((again / pair.volume - 1.0).abs() < 0.01, "{again} for {}", pair.volume);
    }
}

#[test]
fn what_cannot_be_is_refused() {
    let pair = Pair { from: 0, to: 1, volume: 1.0 };
    let link = Link::bpr(0, 1, 10.0, 0.0);
    let refused = equilibrium(&[link], &[pair], EquilibriumConfig::default()).unwrap_err();
    assert!(matches!(refused, AssignmentError::Link { link: 0, .. }), "{refused}");
    let refused =
        equilibrium(&[], &[Pair { volume: f64::NAN, ..pair }], EquilibriumConfig::default()).unwrap_err();
    assert!(matches!(refused, AssignmentError::Pair { pair: 0, .. }), "{refused}");
    // No way leads there: nobody goes.
    assert!(equilibrium(&[], &[pair], EquilibriumConfig::default()).unwrap().paths[0].is_empty());
    let refused = estimate(&[1.0], &[1.0, 2.0], &[1.0], EstimateConfig::default()).unwrap_err();
    assert!(matches!(refused, AssignmentError::Size { given: 1, wanted: 2, .. }), "{refused}");
    let refused = estimate(&[-1.0], &[1.0], &[1.0], EstimateConfig::default()).unwrap_err();
    assert!(refused.to_string().contains("proportions 0 is -1"), "{refused}");
}
