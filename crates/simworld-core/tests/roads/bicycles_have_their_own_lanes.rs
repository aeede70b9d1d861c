//! Cycle lanes are ridden on: they lead across junctions, and nobody but a bicycle gets on to them.

use simworld_core::id::LaneId;
use simworld_core::net::*;

/// Crossroads whose first and third arm, the street from east to west, have cycle lanes.
fn network(side: DrivingSide, everywhere: bool) -> RoadNetwork {
    let mut plan = StreetPlan { driving_side: side, ..StreetPlan::crossroads(100.0) };
    let mut wide = CrossSection::two_way(1, 1).with_cycle_lanes(1.8).with_parking(2.2);
    if side == DrivingSide::Left {
        wide.lanes.reverse();
        plan.sections[0].lanes.reverse();
    }
    let section = plan.add_section(wide);
    for (index, street) in plan.streets.iter_mut().enumerate() {
        if everywhere || index % 2 == 0 {
            street.section = section;
        }
    }
    let network = RoadNetwork::derive(&plan, &NetworkConfig::default()).unwrap();
    network.check().unwrap();
    network
}

fn ways(network: &RoadNetwork, lane: LaneId) -> Vec<(Turn, LaneKind)> {
    let ways = network.lanes[lane.index()].outgoing.iter().map(|way| &network.connections[way.index()]);
    let mut ways: Vec<_> = ways.map(|way| (way.turn, network.lanes[way.to.index()].kind)).collect();
    ways.sort_unstable();
    ways
}

/// The cycle lane of an arm that leads to the junction in the middle.
fn inwards(network: &RoadNetwork, arm: usize) -> LaneId {
    let lanes = &network.roads[arm].cycle;
    assert_eq!(lanes.len(), 2);
    *lanes.iter().find(|lane| network.lanes[lane.index()].to.index() == 0).unwrap()
}

#[test]
fn bicycles_go_straight_on_and_round_the_near_corner() {
    for (side, near) in [(DrivingSide::Right, Turn::Right), (DrivingSide::Left, Turn::Left)] {
        let network = network(side, true);
        let turns = ways(&network, inwards(&network, 0));
        assert_eq!(turns, [(Turn::Straight, LaneKind::Cycle), (near, LaneKind::Cycle)]);
        // Where the other street has none, one goes on among the others.
        let network = self::network(side, false);
        let turns = ways(&network, inwards(&network, 0));
        assert_eq!(turns, [(Turn::Straight, LaneKind::Cycle), (near, LaneKind::Driving)]);
    }
}

#[test]
fn bicycles_ride_on_their_side_and_turn_back_at_dead_ends() {
    let network = network(DrivingSide::Right, true);
    for road in &network.roads {
        for lane in &road.cycle {
            let lane = &network.lanes[lane.index()];
            let lateral = polyline::closest(&road.centerline, &lane.path[0]).unwrap().lateral;
            let along = if lane.from == road.from { 1.0 } else { -1.0 };
            assert!((lateral * along + 3.5 + 0.9).abs() < 1e-6, "{lateral}");
            assert!(lane.speed_limit < 7.0);
        }
        let out = road.cycle.iter().find(|lane| network.lanes[lane.index()].to == road.to).unwrap();
        assert_eq!(ways(&network, *out), [(Turn::UTurn, LaneKind::Cycle)]);
    }
}

#[test]
fn those_who_turn_give_way_to_bicycles_that_go_straight_on() {
    let network = network(DrivingSide::Right, true);
    let is_cycle = |lane: LaneId| !network.lanes[lane.index()].is_driven();
    let mut met = 0;
    for way in network.connections.iter().filter(|way| way.turn == Turn::Right && !is_cycle(way.from)) {
        let rivals = way.conflicts.iter().map(|rival| (rival, &network.connections[rival.index()]));
        for (id, rival) in rivals.filter(|(_, rival)| rival.turn == Turn::Straight && is_cycle(rival.from)) {
            if network.lanes[rival.from.index()].road == network.lanes[way.from.index()].road {
                assert!(way.yields_to.contains(id));
                met += 1;
            }
        }
    }
    assert_eq!(met, 4, "one at each arm");
}

#[test]
fn no_vehicle_gets_on_to_a_cycle_lane() {
    let network = network(DrivingSide::Right, false);
    for way in &network.connections {
        let [from, to] = [way.from, way.to].map(|lane| network.lanes[lane.index()].is_driven());
        assert!(to || !from, "a vehicle is led on to a cycle lane");
    }
    assert!(network.roads.iter().all(|road| {
        road.forward.iter().chain(&road.backward).all(|lane| network.lanes[lane.index()].is_driven())
    }));
    let graph = WaypointGraph::drivable(&network, &WaypointConfig::default()).unwrap();
    let on_cycle_lanes = graph.waypoints().iter().filter(|waypoint| {
        matches!(waypoint.kind, WaypointKind::Lane(lane) if !network.lanes[lane.index()].is_driven())
    });
    assert_eq!(on_cycle_lanes.count(), 0);
}

#[test]
fn strips_lie_side_by_side_from_stop_line_to_stop_line() {
    for side in [DrivingSide::Right, DrivingSide::Left] {
        let network = network(side, true);
        let road = &network.roads[0];
        let kinds: Vec<LaneKind> = road.strips.iter().map(|strip| strip.kind).collect();
        assert_eq!(kinds, [LaneKind::Parking, LaneKind::Cycle, LaneKind::Cycle, LaneKind::Parking]);
        for strip in &road.strips {
            let outline = road.strip_outline(strip);
            let area: f64 = (0..outline.len())
                .map(|index| outline[index].coords.perp(&outline[(index + 1) % outline.len()].coords) * 0.5)
                .sum();
            let length = strip.stations.1 - strip.stations.0;
            assert!(length > 50.0 && (area - length * strip.width).abs() < 1e-6, "{area}");
            let away = polyline::closest(&road.centerline, &outline[0]).unwrap();
            assert!(away.distance < road.left_kerb + 1e-6 && away.lateral * strip.offset > 0.0);
        }
        assert!(road.strips.is_sorted_by(|a, b| a.offset > b.offset), "from left to right");
    }
}
