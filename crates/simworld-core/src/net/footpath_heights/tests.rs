use proptest::prelude::*;

use super::*;
use crate::geometry::Point2;
use crate::net::{Footpath, NetworkConfig, Street, StreetPlan, WaypointConfig, WaypointGraph};

/// A way of two or more points, m, on a level.
fn way(level: i8, joins: [bool; 2], path: &[(f64, f64)]) -> Footpath {
    let path = path.iter().map(|(x, y)| Point2::new(*x, *y)).collect();
    Footpath { path, width: 2.0, joins, level, ..Footpath::default() }
}

/// A crossroads whose carriageways reach 3.5 m to either side of the axes, with ways for walkers.
fn with(ways: Vec<Footpath>) -> RoadNetwork {
    let plan = StreetPlan::crossroads(100.0);
    let mut network = RoadNetwork::derive(&plan, &NetworkConfig::default()).unwrap();
    network.footpaths = ways;
    network.check().unwrap();
    network
}

fn grades(profile: &[(f64, f64)]) -> Vec<f64> {
    profile.windows(2).map(|pair| (pair[1].1 - pair[0].1) / (pair[1].0 - pair[0].0)).collect()
}

fn assert_near(found: &[f64], expected: &[f64]) {
    let is_near =
        found.len() == expected.len() && found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-6);
    assert!(is_near, "{found:?} for {expected:?}");
}

#[test]
fn ways_on_the_ground_and_below_stay_there() {
    for level in [0, -1] {
        let network = with(vec![way(level, [true; 2], &[(50.0, -90.0), (50.0, 90.0)])]);
        let heights = network.footpath_heights();
        assert!(heights.is_level() && heights.profile(0).is_empty());
        assert_eq!((heights.at(0, 90.0), heights.raised().count()), (0.0, 0));
        let graph = WaypointGraph::walkable(&network, &WaypointConfig::default()).unwrap();
        assert!(
            (0..graph.waypoints().len())
                .all(|index| graph.height(crate::id::WaypointId(index as u32)) == 0.0)
        );
    }
}

#[test]
fn where_there_is_room_it_is_a_ramp_and_elsewhere_stairs() {
    // From the edge of the carriageway, and half a metre that it is not looked at so closely, 76 m to one end and 26 m to the other.
    let network = with(vec![way(1, [true; 2], &[(50.0, -80.0), (50.0, 30.0)])]);
    let heights = network.footpath_heights();
    let profile = heights.profile(0);
    assert_near(&grades(profile), &[RAMP_GRADE, 0.0, -STAIRS_GRADE]);
    assert_near(&[profile[0].1, profile[1].1, profile[3].1], &[0.0, FOOTBRIDGE_STOREY, 0.0]);
    let steps = Footpath { steps: true, ..network.footpaths[0].clone() };
    let heights = with(vec![steps]).footpath_heights();
    assert_near(&grades(heights.profile(0)), &[STAIRS_GRADE, 0.0, -STAIRS_GRADE]);
    // Where nothing is below, a short bridge needs no stairs.
    let heights = with(vec![way(1, [true; 2], &[(20.0, 20.0), (32.0, 20.0)])]).footpath_heights();
    assert_near(&grades(heights.profile(0)), &[RAMP_GRADE, -RAMP_GRADE]);
}

#[test]
fn what_stairs_are_short_of_is_done_by_the_ways_that_lead_there() {
    // 4 m and some from the carriageway to the end of the bridge: 2 m of height, and ways on the ground on both sides.
    let bridge = way(1, [false; 2], &[(50.0, -8.0), (50.0, 8.0)]);
    let south = way(0, [false, true], &[(50.0, -8.0), (50.0, -40.0)]);
    let north = [
        way(0, [false; 2], &[(50.0, 8.0), (50.0, 11.0)]),
        way(0, [false, true], &[(50.0, 11.0), (50.0, 60.0)]),
    ];
    let [north, beyond] = north;
    let heights = with(vec![bridge, south, north, beyond]).footpath_heights();
    let end = heights.at(0, 0.0);
    assert!((3.0..4.0).contains(&end), "the bridge ends {end} m high");
    for (one, next) in [((0, 0.0), (1, 0.0)), ((0, 16.0), (2, 0.0)), ((2, 3.0), (3, 0.0))] {
        assert_near(&[heights.at(one.0, one.1)], &[heights.at(next.0, next.1)]);
    }
    assert_near(&grades(heights.profile(1)), &[-STAIRS_GRADE, 0.0]);
    assert_near(&grades(heights.profile(2)), &[-STAIRS_GRADE]);
    assert_near(&grades(heights.profile(3)), &[-STAIRS_GRADE, 0.0]);
    assert_eq!((heights.at(1, 32.0), heights.at(3, 49.0)), (0.0, 0.0));
}

#[test]
fn stairs_are_steeper_where_nothing_else_is_left() {
    let network = with(vec![way(1, [true; 2], &[(50.0, -8.0), (50.0, 60.0)])]);
    let heights = network.footpath_heights();
    let steepest = grades(heights.profile(0)).into_iter().fold(0.0, f64::max);
    assert!((1.0..1.6).contains(&steepest), "{steepest}");
    assert_eq!((heights.at(0, 0.0), heights.at(0, 68.0)), (0.0, 0.0));
    assert_near(&[heights.at(0, 4.5)], &[FOOTBRIDGE_STOREY]);
}

#[test]
fn bridges_that_meet_are_as_high_there() {
    // A bridge of the second level that goes on from one of the first, and a third that branches off.
    let ways = vec![
        way(1, [true, false], &[(50.0, -80.0), (50.0, 40.0)]),
        way(2, [false; 2], &[(50.0, 40.0), (-50.0, 40.0)]),
        way(1, [false, true], &[(50.0, 40.0), (90.0, 40.0)]),
        way(2, [false, true], &[(-50.0, 40.0), (-50.0, -90.0)]),
    ];
    let heights = with(ways).footpath_heights();
    let meeting = heights.at(0, 120.0);
    assert!(meeting > 3.0, "{meeting}");
    assert_near(&[heights.at(1, 0.0), heights.at(2, 0.0)], &[meeting; 2]);
    assert_near(&[heights.at(1, 100.0)], &[heights.at(3, 0.0)]);
    assert!(heights.at(1, 50.0) > FOOTBRIDGE_STOREY, "{:?}", heights.profile(1));
}

#[test]
fn a_bridge_over_a_bridge_is_above_it() {
    let nodes = [(-200.0, 0.0), (200.0, 0.0), (-60.0, -90.0), (-60.0, 90.0)].map(|(x, y)| Point2::new(x, y));
    let profile = vec![(150.0, 7.0), (250.0, 7.0)].into();
    let over = Street { level: 1, profile, ..Street::simple(0, 1) };
    let plan = StreetPlan {
        nodes: nodes.to_vec(),
        streets: vec![over, Street::simple(2, 3)],
        ..StreetPlan::default()
    };
    let mut network = RoadNetwork::derive(&plan, &NetworkConfig::default()).unwrap();
    network.footpaths = vec![
        way(2, [false; 2], &[(0.0, -90.0), (0.0, 90.0)]),
        way(0, [false; 2], &[(0.0, 90.0), (0.0, 120.0)]),
        way(0, [false; 2], &[(0.0, -90.0), (0.0, -120.0)]),
        way(1, [true, false], &[(20.0, 6.0), (20.0, 60.0)]),
        way(0, [false; 2], &[(20.0, 60.0), (20.0, 90.0)]),
    ];
    let heights = network.footpath_heights();
    assert_near(&[heights.at(0, 90.0)], &[7.0 + FOOTBRIDGE_STOREY]);
    // One that begins at the sidewalk of the bridge begins as high.
    assert_near(&[heights.at(3, 0.0), heights.at(3, 54.0)], &[7.0, 0.0]);
}

#[test]
fn waypoints_have_the_height_of_their_way() {
    let network = with(vec![way(1, [true; 2], &[(50.0, -80.0), (50.0, 30.0)])]);
    let heights = network.footpath_heights();
    let graph = WaypointGraph::walkable(&network, &WaypointConfig::default()).unwrap();
    let at = |y: f64| graph.nearest(Point2::new(50.0, y)).unwrap();
    let (mut from, mut last, mut walked) = (at(-80.0), 0.0, 0.0);
    // Walked from end to end beside the middle, the next waypoint from half a metre before each on.
    let mut path: Vec<_> =
        graph.waypoints().iter().enumerate().filter(|(_, it)| it.position.x == 50.0).collect();
    path.sort_by(|a, b| a.1.position.y.total_cmp(&b.1.position.y));
    for (index, to) in path[1..].iter().map(|(index, it)| (*index, it.position)) {
        let to_id = crate::id::WaypointId::from_index(index);
        while walked < to.y + 80.0 - 0.5 {
            let height = graph.height_between(from, to_id, Point2::new(50.4, walked - 80.0));
            assert!((height - heights.at(0, walked)).abs() < 1e-9, "{height} at {walked}");
            assert!((height - last).abs() <= 0.1 * STAIRS_GRADE + 1e-9, "a step at {walked}");
            (last, walked) = (height, walked + 0.1);
        }
        from = to_id;
    }
    assert!(walked > 109.0);
}

/// The ends of ways lie off the carriageways, which the importers of maps see to.
fn place() -> impl Strategy<Value = (f64, f64)> {
    let side = || prop_oneof![-95.0..-8.0, 8.0..95.0];
    (side(), side())
}

proptest! {
    /// Bridges anywhere, on any level, with ways that lead on or without: room below, no steps, and the ground where they join it.
    #[test]
    fn one_passes_below_everywhere(
        ends in prop::collection::vec(place(), 4..9),
        levels in prop::collection::vec(0_i8..3, 8),
        joins in prop::array::uniform2(any::<bool>()),
        steps in any::<bool>(),
    ) {
        let last = ends.len() - 2;
        let ways = ends.windows(2).zip(&levels).enumerate().map(|(rank, (pair, level))| {
            let joins = [rank == 0 && joins[0], rank == last && joins[1]];
            // On the ground nobody crosses a street.
            let level = if pair[0].0 * pair[1].0 < 0.0 || pair[0].1 * pair[1].1 < 0.0 { (*level).max(1) } else { *level };
            Footpath { steps: steps && level > 0, ..way(level, joins, pair) }
        });
        let network = with(ways.collect());
        let heights = network.footpath_heights();
        let lengths: Vec<f64> = (0..=last).map(|way| length(&network, way)).collect();
        for (way, footpath) in network.footpaths.iter().enumerate() {
            for step in 0..=400 {
                let station = lengths[way] * f64::from(step) / 400.0;
                let (at, height) = (polyline::at(&footpath.path, station).0, heights.at(way, station));
                let is_over = at.x.abs().min(at.y.abs()) < 3.5;
                prop_assert!(!is_over || height >= FOOTBRIDGE_STOREY - 1e-5, "{height} m of way {way} at {at}");
                prop_assert!((0.0..40.0).contains(&height));
            }
            prop_assert!(way == 0 || (heights.at(way, 0.0) - heights.at(way - 1, lengths[way - 1])).abs() < 1e-6);
        }
        prop_assert!(!joins[0] || heights.at(0, 0.0) == 0.0);
        prop_assert!(!joins[1] || heights.at(last, lengths[last]) == 0.0);
    }
}
