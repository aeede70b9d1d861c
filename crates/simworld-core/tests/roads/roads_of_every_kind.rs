//! Traffic on the left, roundabouts, arrows on lanes, heights: what a plan says of them holds in the derived network.

use simworld_core::geometry::{Point2, direction, heading};
use simworld_core::net::*;

fn derived(plan: &StreetPlan) -> RoadNetwork {
    let network = RoadNetwork::derive(plan, &NetworkConfig::default()).unwrap();
    network.check().unwrap();
    network
}

/// What holds on either side: lanes, sidewalks and corners lie where their names say.
fn check_sides(network: &RoadNetwork) {
    let keeps_left = network.driving_side == DrivingSide::Left;
    for road in &network.roads {
        for (lanes, along) in [(&road.forward, 1.0), (&road.backward, -1.0)] {
            for lane in lanes {
                let middle = polyline::at(&network.lanes[lane.index()].path, 10.0).0;
                let lateral = polyline::closest(&road.centerline, &middle).unwrap().lateral * along;
                assert_eq!(lateral > 0.0, keeps_left, "lane {lane} lies {lateral} m to the left");
            }
        }
        for (walk, side) in road.sidewalks.iter().zip([1.0, -1.0]) {
            let walk = &network.sidewalks[walk.unwrap().index()];
            let middle = polyline::at(&walk.path, 10.0).0;
            assert!(polyline::closest(&road.centerline, &middle).unwrap().lateral * side > 0.0);
            assert_eq!(walk.side == Side::Left, side > 0.0);
        }
    }
    for (index, place) in network.intersections.iter().enumerate() {
        let area: f64 = (0..place.outline.len())
            .map(|i| place.outline[i].coords.perp(&place.outline[(i + 1) % place.outline.len()].coords))
            .sum();
        assert!(area > 0.0, "outline {index} goes clockwise");
        let away = |road: &Road| {
            let line = &road.centerline;
            let next = if road.from.index() == index { line[1] } else { line[line.len() - 2] };
            heading(&(next - place.center))
        };
        let headings: Vec<f64> = place.roads.iter().map(|road| away(&network.roads[road.index()])).collect();
        assert!(headings.is_sorted(), "roads of {index} are not counter-clockwise: {headings:?}");
        for (rank, corner) in place.corners.iter().enumerate().filter(|(_, corner)| corner.len() > 1) {
            // It begins to the left of its road, seen from the middle.
            let left = direction(headings[rank] + std::f64::consts::FRAC_PI_2);
            assert!((corner[0] - place.center).dot(&left) > 0.0, "corner {rank} of {index} begins elsewhere");
        }
    }
}

fn crossroads_on(side: DrivingSide) -> RoadNetwork {
    derived(&StreetPlan { driving_side: side, ..StreetPlan::crossroads(100.0) })
}

#[test]
fn traffic_keeps_to_its_side() {
    for side in [DrivingSide::Right, DrivingSide::Left] {
        let mut plan = StreetPlan { driving_side: side, ..StreetPlan::grid(3, 4, 120.0) };
        if side == DrivingSide::Left {
            for section in &mut plan.sections {
                section.lanes.reverse();
                section.reference = section.width() - section.reference;
            }
        }
        check_sides(&derived(&plan));
    }
}

#[test]
fn one_gives_way_when_one_turns_across_oncoming_traffic() {
    for (side, across, along) in
        [(DrivingSide::Right, Turn::Left, Turn::Right), (DrivingSide::Left, Turn::Right, Turn::Left)]
    {
        let mut plan = StreetPlan { driving_side: side, ..StreetPlan::crossroads(100.0) };
        if side == DrivingSide::Left {
            plan.sections[0].lanes.reverse();
        }
        let network = derived(&plan);
        let yielding = |turn: Turn| {
            let ways = network.connections.iter().filter(|way| way.turn == turn);
            ways.map(|way| way.yields_to.len()).sum::<usize>()
        };
        assert!(yielding(across) > yielding(along), "{side:?}");
        let oncoming = |way: &Connection| {
            way.yields_to.iter().any(|other| network.connections[other.index()].turn == Turn::Straight)
        };
        assert!(network.connections.iter().filter(|way| way.turn == across).all(oncoming), "{side:?}");
    }
}

#[test]
fn a_mirrored_city_is_the_mirror_image() {
    let mut plan = StreetPlan { driving_side: DrivingSide::Left, ..StreetPlan::crossroads(100.0) };
    plan.sections[0].lanes.reverse();
    let left = derived(&plan);
    let right = crossroads_on(DrivingSide::Right);
    assert_eq!(left.lanes.len(), right.lanes.len());
    let count =
        |network: &RoadNetwork, turn| network.connections.iter().filter(|way| way.turn == turn).count();
    for (turn, image) in
        [(Turn::Left, Turn::Right), (Turn::Straight, Turn::Straight), (Turn::Right, Turn::Left)]
    {
        assert_eq!(count(&left, turn), count(&right, image));
    }
    let lengths = |network: &RoadNetwork| {
        let mut lengths: Vec<f64> = network.connections.iter().map(|way| way.length).collect();
        lengths.sort_by(f64::total_cmp);
        lengths
    };
    for (a, b) in lengths(&left).iter().zip(lengths(&right)) {
        assert!((a - b).abs() < 1e-9);
    }
}

/// Four arms round a ring of that radius.
fn roundabout(radius: f64) -> StreetPlan {
    let mut plan = StreetPlan::default();
    let ring = plan.add_section(CrossSection::plain(1, 0, 4.5, 0.0));
    let corner = |quarter: usize| direction(std::f64::consts::FRAC_PI_2 * quarter as f64);
    for quarter in 0..4 {
        plan.nodes.push(Point2::origin() + corner(quarter) * radius);
    }
    for quarter in 0..4 {
        let middle = corner(quarter) + corner(quarter + 1);
        plan.streets.push(Street {
            section: ring,
            roundabout: true,
            via: vec![Point2::origin() + middle.normalize() * radius],
            ..Street::simple(quarter, (quarter + 1) % 4)
        });
    }
    for quarter in 0..4 {
        plan.nodes.push(Point2::origin() + corner(quarter) * (radius + 120.0));
        plan.streets.push(Street::simple(quarter, 4 + quarter));
    }
    plan
}

#[test]
fn who_is_in_a_roundabout_goes_first() {
    let network = derived(&roundabout(24.0));
    let in_ring =
        |lane: simworld_core::id::LaneId| network.roads[network.lanes[lane.index()].road.index()].roundabout;
    let mut entries = 0;
    for (index, way) in network.connections.iter().enumerate().filter(|(_, way)| !in_ring(way.from)) {
        if !in_ring(way.to) {
            continue;
        }
        entries += 1;
        let rivals = network.connections.iter().enumerate().filter(|(other, rival)| {
            rival.intersection == way.intersection && *other != index && rival.to == way.to
        });
        for (other, rival) in rivals {
            assert!(in_ring(rival.from));
            assert!(way.yields_to.iter().any(|to| to.index() == other), "an entry gives way to nobody");
            assert!(rival.yields_to.is_empty(), "the ring waits");
        }
        assert_eq!((way.turn, way.yields_to.len()), (Turn::Right, 1));
    }
    assert_eq!(entries, 4);
    assert!(network.signals.is_empty(), "there are signals in a roundabout");
    assert!(network.crossings.iter().all(|crossing| !network.roads[crossing.road.index()].roundabout));
    assert_eq!(network.crossings.len(), 4, "people cross the arms");
}

#[test]
fn arrows_say_which_lane_turns_where() {
    let mut plan = StreetPlan::crossroads(100.0);
    let wide = plan.add_section(CrossSection::two_way(1, 3));
    plan.streets[0].section = wide;
    // The arm leads away from the junction, so its lanes against the centreline arrive there.
    let arrow = |turns: &[Turn]| TurnSet::of(turns);
    plan.streets[0].turns.backward = vec![
        arrow(&[Turn::Left]),
        arrow(&[Turn::Left, Turn::Straight]),
        arrow(&[Turn::Straight, Turn::Right]),
    ];
    let network = derived(&plan);
    let lanes = &network.roads[0].backward;
    let turns = |rank: usize| {
        let ways = network.lanes[lanes[rank].index()].outgoing.iter();
        let mut turns: Vec<Turn> = ways.map(|way| network.connections[way.index()].turn).collect();
        turns.sort_unstable();
        turns.dedup();
        turns
    };
    // One lane leaves on the left, so one of the two that turn there may use it.
    assert_eq!(turns(0), [Turn::Left]);
    assert_eq!(turns(1), [Turn::Straight]);
    assert_eq!(turns(2), [Turn::Straight, Turn::Right]);
    plan.streets[0].turns.backward.pop();
    let error = RoadNetwork::derive(&plan, &NetworkConfig::default()).unwrap_err().to_string();
    assert!(error.contains("2 arrows on 3 lanes"), "{error}");
}

#[test]
fn roads_rise_from_node_to_node() {
    let mut plan = StreetPlan::crossroads(100.0);
    plan.elevations = vec![2.0, 8.0, 2.0, 2.0, -1.0];
    let network = derived(&plan);
    let road = simworld_core::id::RoadId(0);
    assert_eq!([0.0, 50.0, 100.0, 500.0].map(|at| network.height(road, at)), [2.0, 5.0, 8.0, 8.0]);
    plan.elevations.pop();
    assert!(RoadNetwork::derive(&plan, &NetworkConfig::default()).is_err());
    plan.elevations.push(f64::NAN);
    let error = RoadNetwork::derive(&plan, &NetworkConfig::default()).unwrap_err().to_string();
    assert!(error.contains("node 4"), "{error}");
}

#[test]
fn arrows_that_no_street_answers_are_left_out() {
    // A T: from the west one may turn, but its arrow points straight on.
    let nodes = [(0.0, 0.0), (-120.0, 0.0), (0.0, 120.0), (0.0, -120.0)];
    let mut plan = StreetPlan {
        nodes: nodes.into_iter().map(|(x, y)| Point2::new(x, y)).collect(),
        streets: vec![Street::simple(1, 0), Street::simple(0, 2), Street::simple(0, 3)],
        ..StreetPlan::default()
    };
    let ways = |plan: &StreetPlan| {
        let network = RoadNetwork::derive(plan, &NetworkConfig::default()).expect("a T is built");
        let lane = network.roads[0].forward[0];
        let turns =
            network.lanes[lane.index()].outgoing.iter().map(|way| network.connections[way.index()].turn);
        turns.collect::<Vec<Turn>>()
    };
    let plain = ways(&plan);
    plan.streets[0].turns.forward = vec![TurnSet::of(&[Turn::Straight])];
    assert_eq!(ways(&plan), plain, "better without the arrow than back the way one came");
    plan.streets[0].turns.forward = vec![TurnSet::of(&[Turn::Left])];
    assert_eq!(ways(&plan), [Turn::Left]);
}
