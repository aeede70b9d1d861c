//! Under the `petgraph` feature, petgraph's own searches run on the waypoint graph and find routes of the same
//! length.
#![cfg(feature = "petgraph")]

use petgraph::algo::{astar, dijkstra};
use petgraph::visit::{Dfs, EdgeRef, NodeIndexable};
use simworld_core::id::WaypointId;
use simworld_core::net::{
    NetworkConfig, RoadNetwork, Route, RouteScratch, StreetPlan, WaypointConfig, WaypointGraph,
};

fn check(graph: &WaypointGraph) {
    let (mut scratch, mut route) = (RouteScratch::default(), Route::default());
    let count = graph.waypoints().len();
    for from in (0..count).step_by(37).map(WaypointId::from_index) {
        let lengths = dijkstra(graph, from, None, |edge| *edge.weight());
        for to in (0..count).step_by(5).map(WaypointId::from_index) {
            let found = graph.route(from, to, &mut scratch, &mut route);
            assert_eq!(found, lengths.contains_key(&to), "{from} to {to}");
            if found {
                assert!((route.length - lengths[&to]).abs() < 1e-6, "{from} to {to}: {}", route.length);
            }
        }
        let to = WaypointId::from_index(count - 1);
        let goal = graph.waypoint(to).position;
        let theirs = astar(
            graph,
            from,
            |at| at == to,
            |edge| *edge.weight(),
            |at| (graph.waypoint(at).position - goal).norm(),
        );
        let ours = graph.route(from, to, &mut scratch, &mut route).then_some(route.length);
        match (theirs, ours) {
            (Some((theirs, _)), Some(ours)) => assert!((theirs - ours).abs() < 1e-6),
            (theirs, ours) => assert_eq!(theirs.is_some(), ours.is_some()),
        }
    }
}

#[test]
fn routes_are_as_short_as_theirs() {
    let network = RoadNetwork::derive(&StreetPlan::grid(4, 3, 110.0), &NetworkConfig::default()).unwrap();
    let config = WaypointConfig::default();
    check(&WaypointGraph::coarse(&network));
    check(&WaypointGraph::walkable(&network, &config).unwrap());
    check(&WaypointGraph::drivable(&network, &config).unwrap());
}

#[test]
fn their_traversals_reach_everything() {
    let network = RoadNetwork::derive(&StreetPlan::crossroads(90.0), &NetworkConfig::default()).unwrap();
    let walks = WaypointGraph::walkable(&network, &WaypointConfig::default()).unwrap();
    let mut search = Dfs::new(&walks, WaypointId(0));
    let mut reached = 0;
    while search.next(&walks).is_some() {
        reached += 1;
    }
    assert_eq!(reached, walks.waypoints().len());
    assert_eq!(NodeIndexable::node_bound(&&walks), reached);
    let longest = petgraph::visit::IntoEdgeReferences::edge_references(&walks)
        .map(|edge| *edge.weight())
        .fold(0.0, f64::max);
    assert!(longest <= 16.0, "{longest}");
}
