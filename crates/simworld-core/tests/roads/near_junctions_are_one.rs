//! Near junctions as one: ways from every lane that leads in to every one that leads out, one plan of signals, and people who can
//! still cross everywhere.

use std::collections::{BTreeMap, BTreeSet};

use simworld_core::geometry::Point2;
use simworld_core::id::{LaneId, RoadId};
use simworld_core::net::{
    Control, CrossSection, Joined, NetworkConfig, RoadNetwork, Street, StreetPlan, Turn, polyline,
};
use simworld_core::ops::wrap_angle;

/// Where a street from south to north crosses one with two carriageways so near that the piece between them is a few metres long.
/// The streets: west to the middle and on, east to the middle and on, from the south, the piece, and to the north.
fn dual_carriageway(apart: f64) -> StreetPlan {
    let mut plan = StreetPlan::default();
    let one_way = plan.add_section(CrossSection::two_way(2, 0));
    let nodes = [
        [0.0, 0.0],
        [0.0, apart],
        [-150.0, 0.0],
        [150.0, 0.0],
        [-150.0, apart],
        [150.0, apart],
        [0.0, -150.0],
        [0.0, apart + 150.0],
    ];
    plan.nodes.extend(nodes.map(|[x, y]| Point2::new(x, y)));
    for (from, to) in [(2, 0), (0, 3), (5, 1), (1, 4)] {
        plan.streets.push(Street { section: one_way, ..Street::simple(from, to) });
    }
    plan.streets.extend([(6, 0), (0, 1), (1, 7)].map(|(from, to)| Street::simple(from, to)));
    plan
}

fn joined(plan: &StreetPlan) -> (RoadNetwork, Joined) {
    let network = RoadNetwork::derive(plan, &NetworkConfig::default()).expect("it is a plan");
    let joined = network.join_near(13.0).expect("its junctions are near");
    joined.network.check().expect("it holds together");
    (network, joined)
}

/// The roads that one comes to from each by ways over the roads inside.
fn roads_after(network: &RoadNetwork, inside: &BTreeSet<RoadId>) -> BTreeMap<RoadId, BTreeSet<RoadId>> {
    let road = |lane: LaneId| network.lanes[lane.index()].road;
    let mut after: BTreeMap<RoadId, BTreeSet<RoadId>> = BTreeMap::new();
    for way in &network.connections {
        after.entry(road(way.from)).or_default().insert(road(way.to));
    }
    let own = after.clone();
    for to in after.values_mut() {
        for within in inside.iter().filter(|within| to.remove(*within)).collect::<Vec<_>>() {
            to.extend(own.get(within).into_iter().flatten().filter(|road| !inside.contains(*road)));
        }
    }
    after.retain(|road, _| !inside.contains(road));
    after
}

#[test]
fn opposing_streams_of_a_dual_carriageway_go_at_once() {
    let (network, Joined { network: one, through }) = joined(&dual_carriageway(16.0));
    assert_eq!((network.signals.len(), one.signals.len()), (2, 1));
    let straight: Vec<_> = one
        .connections
        .iter()
        .enumerate()
        .filter(|(index, way)| way.turn == Turn::Straight && !through[*index].is_empty())
        .collect();
    let [(a, south), (_, north)] = straight[..] else { panic!("one way each way: {straight:?}") };
    assert!(!south.conflicts.iter().any(|other| other.index() == straight[1].0), "{a} meets the other");
    let (Some(first), Some(second)) = (south.signal, north.signal) else { panic!("both have lights") };
    let together =
        |phase: &simworld_core::net::Phase| [first, second].iter().all(|group| phase.green.contains(group));
    assert!(one.signals[0].phases.iter().any(together), "they go together");
    // Nobody goes with those who cross them.
    let crosses = one.connections.iter().filter(|way| way.turn == Turn::Straight && way.signal.is_some());
    let crosses = crosses.filter(|way| way.signal != Some(first) && way.signal != Some(second));
    assert!(crosses.clone().count() >= 4, "both carriageways cross");
    for way in crosses {
        let green = one.signals[0].phases.iter().filter(|phase| phase.green.contains(&way.signal.unwrap()));
        assert!(green.clone().count() > 0 && green.into_iter().all(|phase| !phase.green.contains(&first)));
    }
}

#[test]
fn ways_lead_from_every_lane_to_all_roads_to_which_the_single_ones_lead() {
    for apart in [15.0, 16.0, 19.0] {
        let (network, Joined { network: one, through }) = joined(&dual_carriageway(apart));
        let inside = BTreeSet::from([RoadId(5)]);
        assert_eq!(roads_after(&network, &inside), roads_after(&one, &BTreeSet::new()));
        for lane in network.lanes.iter().zip(&one.lanes).filter(|(lane, _)| !inside.contains(&lane.road)) {
            assert_eq!(lane.0.outgoing.is_empty(), lane.1.outgoing.is_empty());
        }
        for (way, through) in one.connections.iter().zip(&through) {
            let [from, to] = [way.from, way.to].map(|lane| &one.lanes[lane.index()].path);
            let (start, end) = (way.path[0], way.path[way.path.len() - 1]);
            assert!((from[from.len() - 1] - start).norm() < 1e-2 && (to[0] - end).norm() < 1e-2);
            assert_eq!(
                (one.lanes[way.from.index()].to, one.lanes[way.to.index()].from),
                (way.intersection, way.intersection)
            );
            for lane in through {
                let middle = polyline::at(&network.lanes[lane.index()].path, 1.0).0;
                assert!(
                    polyline::closest(&way.path, &middle).unwrap().distance < 2.0,
                    "it leads over the lane"
                );
            }
            // No corners: a metre on a circle of a metre and a half.
            for three in way.path.windows(3) {
                let heading = |a: Point2, b: Point2| simworld_core::geometry::heading(&(b - a));
                let bend = wrap_angle(heading(three[1], three[2]) - heading(three[0], three[1])).abs();
                assert!(through.is_empty() || bend < 0.7, "a corner of {bend} in {:?}", way.path);
            }
        }
    }
}

#[test]
fn who_would_touch_is_in_conflict() {
    let (_, Joined { network: one, .. }) = joined(&dual_carriageway(16.0));
    let mut met = 0;
    for (index, a) in one.connections.iter().enumerate() {
        for (other, b) in one.connections.iter().enumerate().skip(index + 1) {
            if a.from == b.from || a.intersection != b.intersection {
                continue;
            }
            let known = a.conflicts.iter().any(|id| id.index() == other);
            assert_eq!(known, b.conflicts.iter().any(|id| id.index() == index));
            let nearest = a.path.iter().map(|point| polyline::closest(&b.path, point).unwrap().distance);
            assert!(known || nearest.fold(f64::INFINITY, f64::min) > 1.9, "{index} and {other} touch");
            met += usize::from(known);
        }
    }
    assert!(met > 20, "{met} meetings");
}

#[test]
fn people_cross_everywhere_and_not_before_who_goes_straight_on() {
    let (network, Joined { network: one, .. }) = joined(&dual_carriageway(16.0));
    assert_eq!((&network.sidewalks, network.crossings.len()), (&one.sidewalks, one.crossings.len()));
    let corners = |network: &RoadNetwork| -> Vec<_> {
        network.intersections.iter().map(|place| (place.corners.clone(), place.crossings.clone())).collect()
    };
    assert_eq!(corners(&network), corners(&one));
    let plan = &one.signals[0];
    for (index, crossing) in one.crossings.iter().enumerate() {
        let group = crossing.signal.expect("all have lights");
        let walks: Vec<_> = plan.phases.iter().filter(|phase| phase.green.contains(&group)).collect();
        assert!(!walks.is_empty(), "nobody ever walks over crossing {index}");
        let over = one.connections.iter().filter(|way| way.crossings.iter().any(|id| id.index() == index));
        for way in over.filter(|way| way.turn == Turn::Straight) {
            let signal = way.signal.expect("all have lights");
            assert!(walks.iter().all(|phase| !phase.green.contains(&signal)), "crossing {index}");
        }
    }
    let groups: BTreeSet<_> = network.signals.iter().flat_map(|plan| &plan.groups).collect();
    assert_eq!(groups, plan.groups.iter().collect());
}

#[test]
fn what_is_not_near_stays_as_it_is() {
    let grid = RoadNetwork::derive(&StreetPlan::grid(4, 3, 120.0), &NetworkConfig::default()).unwrap();
    assert_eq!(grid.join_near(13.0), None);
    let (network, Joined { network: one, .. }) = joined(&dual_carriageway(16.0));
    assert_eq!(network.join_near(0.0), None);
    assert_eq!(one.join_near(13.0), None, "joined once, it is joined");
    assert_eq!(network.signal_groups(), one.signal_groups());
    let ends = |network: &RoadNetwork| -> Vec<_> {
        let is_end = |place: &&simworld_core::net::Intersection| {
            place.control == Control::None && place.roads.len() == 1
        };
        network.intersections.iter().filter(is_end).map(|place| place.center).collect()
    };
    assert_eq!(ends(&network), ends(&one));
}

/// Three one-way streets round a small triangle, of which the first so many say that they are a roundabout, with a street at every corner.
fn triangle(in_ring: usize) -> RoadNetwork {
    let mut plan = StreetPlan::default();
    let one_way = plan.add_section(CrossSection::two_way(1, 0));
    let corners = [[0.0, 0.0], [16.0, 0.0], [8.0, 14.0]];
    let ends = [[-120.0, -60.0], [140.0, -60.0], [8.0, 160.0]];
    plan.nodes.extend(corners.into_iter().chain(ends).map(|[x, y]| Point2::new(x, y)));
    for corner in 0..3 {
        let roundabout = corner < in_ring;
        let street = Street::simple(corner, (corner + 1) % 3);
        plan.streets.push(Street { section: one_way, roundabout, ..street });
    }
    plan.streets.extend((0..3).map(|corner| Street::simple(corner, corner + 3)));
    RoadNetwork::derive(&plan, &NetworkConfig::default()).expect("it is a plan")
}

#[test]
fn a_single_piece_of_a_roundabout_is_none() {
    for in_ring in [0, 1] {
        let one = triangle(in_ring).join_near(13.0).expect("its junctions are near").network;
        assert!(one.roads[..3].iter().all(|road| road.lanes().next().is_none()), "{in_ring} of three");
    }
    assert_eq!(triangle(3).join_near(13.0), None, "round which one goes by its rule");
}

#[test]
fn the_road_class_decides_who_gives_way_where_there_are_no_lights() {
    let mut plan = dual_carriageway(16.0);
    plan.controls.extend([(0, Control::Priority), (1, Control::Priority)]);
    for street in &mut plan.streets[..4] {
        street.class = simworld_core::net::RoadClass::Arterial;
    }
    let (_, Joined { network: one, .. }) = joined(&plan);
    assert!(
        one.signals.is_empty() && one.intersections.iter().all(|place| place.control != Control::Signals)
    );
    let class = |lane: LaneId| one.roads[one.lanes[lane.index()].road.index()].class;
    let mut gave_way = 0;
    for way in &one.connections {
        for other in way.conflicts.iter().map(|id| (id, &one.connections[id.index()])) {
            let yields = way.yields_to.contains(other.0);
            if class(way.from) < class(other.1.from) {
                assert!(yields, "{way:?} does not give way to {:?}", other.1);
                gave_way += 1;
            }
        }
    }
    assert!(gave_way > 8, "{gave_way}");
}
