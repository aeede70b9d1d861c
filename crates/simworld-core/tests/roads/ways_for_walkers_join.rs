//! Ways for walkers alone meet where they share an end, and lead on to a sidewalk only where they join it.

use simworld_core::geometry::Point2;
use simworld_core::id::WaypointId;
use simworld_core::net::*;

/// The points of a way, m, and whether its ends join sidewalks.
type Way<'a> = (&'a [(f64, f64)], [bool; 2]);

/// A crossroads, whose sidewalks lie 5 m beside the middle of its streets, with ways for walkers north-east of it.
fn graph(ways: &[Way<'_>]) -> WaypointGraph {
    let plan = StreetPlan::crossroads(100.0);
    let mut network = RoadNetwork::derive(&plan, &NetworkConfig::default()).unwrap();
    network.footpaths = ways
        .iter()
        .map(|(path, joins)| Footpath {
            path: path.iter().map(|(x, y)| Point2::new(*x, *y)).collect(),
            width: 2.0,
            joins: *joins,
            ..Footpath::default()
        })
        .collect();
    network.check().unwrap();
    WaypointGraph::walkable(&network, &WaypointConfig::default()).unwrap()
}

/// Whether one comes from the sidewalk of the eastern street to a place.
fn is_reached(graph: &WaypointGraph, (x, y): (f64, f64)) -> bool {
    let from = graph.nearest(Point2::new(90.0, 5.0)).unwrap();
    let to = graph.nearest(Point2::new(x, y)).unwrap();
    assert_eq!(graph.waypoint(to).position, Point2::new(x, y));
    assert_eq!(graph.waypoint(to).kind, WaypointKind::Footpath);
    graph.route(from, to, &mut RouteScratch::default(), &mut Route::default())
}

#[test]
fn an_end_leads_to_a_sidewalk_only_where_it_joins() {
    let way = [(60.0, 8.0), (60.0, 50.0)];
    for (joins, expected) in
        [([true, false], true), ([true; 2], true), ([false; 2], false), ([false, true], false)]
    {
        let graph = graph(&[(&way, joins)]);
        assert_eq!(is_reached(&graph, (60.0, 50.0)), expected, "{joins:?}");
    }
    // The far end has no sidewalk within 15 m, whatever it says.
    let graph = graph(&[(&way, [true; 2])]);
    let far = graph.nearest(Point2::new(60.0, 50.0)).unwrap();
    assert_eq!(graph.edges(far).len(), 1);
}

#[test]
fn shared_ends_are_known_however_they_round() {
    for index in 0..200 {
        let index = f64::from(index);
        let (start, end) = ((60.1 + index * 0.01, 8.3), (58.7 + index * 0.1, 50.0 + index * 0.07));
        let (first, second) = ([start, end], [end, (80.3, 90.9)]);
        assert!(
            is_reached(&graph(&[(&first, [true, false]), (&second, [false; 2])]), (80.3, 90.9)),
            "by {end:?}"
        );
    }
}

#[test]
fn ways_that_share_an_end_lead_on() {
    let (first, second) = ([(60.0, 8.0), (60.0, 50.0)], [(80.0, 70.0), (60.0, 50.0)]);
    let both = graph(&[(&first, [true, false]), (&second, [false; 2])]);
    assert!(is_reached(&both, (80.0, 70.0)));
    // One of those that share an end may join it for all, the later too, and it is joined once.
    let branch = [(60.0, 8.0), (80.0, 20.0)];
    for joins in [[[true, false], [false; 2]], [[false; 2], [true, false]], [[true, false]; 2]] {
        let graph = graph(&[(&first, joins[0]), (&branch, joins[1])]);
        assert!(is_reached(&graph, (60.0, 50.0)) && is_reached(&graph, (80.0, 20.0)), "{joins:?}");
        let shared: WaypointId = graph.nearest(Point2::new(60.0, 8.0)).unwrap();
        assert_eq!(graph.edges(shared).len(), 3, "{joins:?}");
    }
}
