//! Routes of the hierarchy are as short as those of Dijkstra's search, on graphs of every shape.

use proptest::prelude::*;

use super::*;
use crate::geometry::Point2;
use crate::grid::PointGrid;
use crate::net::{
    NetworkConfig, RoadNetwork, StreetPlan, Waypoint, WaypointConfig, WaypointEdge, WaypointKind,
};

/// A graph of these edges: from, to, length in millimetres.
fn graph_of(count: usize, edges: &[(usize, usize, u32)]) -> WaypointGraph {
    let at = |index: usize| Point2::new(index as f64, 0.0);
    let waypoints: Vec<Waypoint> =
        (0..count).map(|index| Waypoint { position: at(index), kind: WaypointKind::Sidewalk }).collect();
    let (mut starts, mut all) = (vec![0], Vec::new());
    for from in 0..count {
        let own = edges.iter().filter(|edge| edge.0 == from);
        all.extend(own.map(|(_, to, length)| WaypointEdge {
            to: WaypointId::from_index(*to),
            length: f64::from(*length) * 1e-3,
            crossing: None,
            width: 2.0,
        }));
        starts.push(all.len() as u32);
    }
    let grid = PointGrid::new((0..count).map(at).collect(), 20.0);
    WaypointGraph { waypoints, starts, edges: all, grid, heights: Vec::new() }
}

/// Lengths of the shortest ways between all pairs (Floyd and Warshall 1962).
fn all_lengths(graph: &WaypointGraph) -> Vec<Vec<f64>> {
    let count = graph.waypoints().len();
    let mut lengths = vec![vec![f64::INFINITY; count]; count];
    for (from, row) in lengths.iter_mut().enumerate() {
        row[from] = 0.0;
        for edge in graph.edges(WaypointId::from_index(from)) {
            let known = &mut row[edge.to.index()];
            *known = known.min(edge.length);
        }
    }
    for over in 0..count {
        for from in 0..count {
            for to in 0..count {
                let around = lengths[from][over] + lengths[over][to];
                if around < lengths[from][to] {
                    lengths[from][to] = around;
                }
            }
        }
    }
    lengths
}

/// Every route is as short as can be, and leads over edges that exist.
fn check(graph: WaypointGraph) {
    let lengths = all_lengths(&graph);
    let hierarchy = RouteHierarchy::new(graph);
    let graph = hierarchy.graph();
    let (mut scratch, mut route) = (HierarchyScratch::default(), Route::default());
    for (from, row) in lengths.iter().enumerate() {
        for (to, length) in row.iter().enumerate() {
            let ends = [from, to].map(WaypointId::from_index);
            let found = hierarchy.route(ends[0], ends[1], &mut scratch, &mut route);
            assert_eq!(found, length.is_finite(), "{from} to {to}");
            if !found {
                continue;
            }
            assert_eq!([route.waypoints[0], route.waypoints[route.waypoints.len() - 1]], ends);
            // Zero lengths weigh a tenth of a millimetre, so that ties cost no more than that an edge.
            let slack = 1.1e-4 * (graph.edges.len() as f64 + 1.0);
            assert!((route.length - length).abs() < slack, "{from} to {to}: {route:?}");
            let step = |pair: &[WaypointId]| {
                let ways = graph.edges(pair[0]).iter().filter(|edge| edge.to == pair[1]);
                ways.map(|edge| edge.length).fold(f64::INFINITY, f64::min)
            };
            let walked: f64 = route.waypoints.windows(2).map(step).sum();
            assert!(walked <= route.length + 1e-9, "{from} to {to}: {walked} over {route:?}");
        }
    }
}

proptest! {
    #[test]
    fn routes_are_the_shortest(
        count in 1_usize..24,
        edges in proptest::collection::vec((0_usize..24, 0_usize..24, 0_u32..2000, any::<bool>()), 0..50),
    ) {
        let mut all = Vec::new();
        for (from, to, length, both) in edges {
            all.push((from % count, to % count, length));
            if both {
                all.push((to % count, from % count, length));
            }
        }
        check(graph_of(count, &all));
    }

    #[test]
    fn long_chains_are_followed(
        lengths in proptest::collection::vec(1_u32..2000, 3..40),
        spurs in proptest::collection::vec((0_usize..40, 0_usize..40), 0..4),
        closed in any::<bool>(),
        both in any::<bool>(),
    ) {
        let count = lengths.len() + 1;
        let mut all: Vec<(usize, usize, u32)> =
            lengths.iter().enumerate().map(|(from, length)| (from, from + 1, *length)).collect();
        if closed {
            all.push((count - 1, 0, 700));
        }
        all.extend(spurs.iter().map(|(from, to)| (from % count, to % count, 1500)));
        if both {
            all.extend(all.clone().into_iter().map(|(from, to, length)| (to, from, length)));
        }
        check(graph_of(count, &all));
    }
}

#[test]
fn walks_and_drives_through_a_town_are_the_shortest() {
    let plan = StreetPlan::grid(3, 3, 60.0);
    let network = RoadNetwork::derive(&plan, &NetworkConfig::default()).expect("a grid is sound");
    let config = WaypointConfig::default();
    check(WaypointGraph::walkable(&network, &config).expect("the defaults are sound"));
    check(WaypointGraph::drivable(&network, &config).expect("the defaults are sound"));
    check(WaypointGraph::coarse(&network));
}

#[test]
fn the_same_graph_is_prepared_the_same_way() {
    let plan = StreetPlan::grid(6, 5, 80.0);
    let network = RoadNetwork::derive(&plan, &NetworkConfig::default()).expect("a grid is sound");
    let made = || {
        let graph = WaypointGraph::walkable(&network, &WaypointConfig::default());
        RouteHierarchy::new(graph.expect("the defaults are sound"))
    };
    let (a, b) = (made(), made());
    assert_eq!(a.keys, b.keys);
}

#[test]
fn nobody_comes_from_nowhere() {
    let hierarchy = RouteHierarchy::new(graph_of(2, &[]));
    let (mut scratch, mut route) = (HierarchyScratch::default(), Route::default());
    assert!(!hierarchy.route(WaypointId(0), WaypointId(1), &mut scratch, &mut route));
    assert!(!hierarchy.route(WaypointId(0), WaypointId(9), &mut scratch, &mut route));
    assert!(hierarchy.route(WaypointId(1), WaypointId(1), &mut scratch, &mut route));
    assert_eq!((route.waypoints.as_slice(), route.length), (&[WaypointId(1)][..], 0.0));
}
