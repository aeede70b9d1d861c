//! What every derived network must be: lanes that lead on, paths that join, walkways that reach everywhere, signals that
//! never let two crossing streams go at once.

use std::collections::BTreeSet;

use proptest::prelude::*;
use simworld_core::geometry::{Point2, direction};
use simworld_core::id::{LaneId, RoadId, WaypointId};
use simworld_core::net::{
    Aspect, Control, CrossSection, LaneDirection, LaneKind, LaneSpec, NetworkConfig, NetworkError,
    RoadNetwork, Route, RouteScratch, Side, Street, StreetPlan, Turn, WaypointConfig, WaypointGraph,
    polyline,
};
use simworld_core::ops;

/// A grid with moved nodes and some streets taken out, still connected because the first row and all columns stay.
fn shaken_grid() -> impl Strategy<Value = StreetPlan> {
    (2_usize..5, 2_usize..5)
        .prop_flat_map(|(columns, rows)| {
            let count = columns * rows;
            let shifts = prop::collection::vec((-25.0..25.0_f64, -25.0..25.0_f64), count);
            let kept = prop::collection::vec(any::<bool>(), count * 2);
            (Just((columns, rows)), shifts, kept)
        })
        .prop_map(|((columns, rows), shifts, kept)| {
            let mut plan = StreetPlan::grid(columns, rows, 110.0);
            for (node, (dx, dy)) in plan.nodes.iter_mut().zip(&shifts) {
                *node = Point2::new(node.x + dx, node.y + dy);
            }
            let mut index = 0;
            plan.streets.retain(|street| {
                index += 1;
                street.to != street.from + 1 || street.from < columns || kept[index % kept.len()]
            });
            plan
        })
}

/// A star of streets with at least 30° between them.
fn star() -> impl Strategy<Value = StreetPlan> {
    prop::collection::vec((0.55..1.2_f64, 80.0..160.0_f64, 1_u8..3), 1..6).prop_map(|arms| {
        let mut plan = StreetPlan { nodes: vec![Point2::origin()], ..StreetPlan::default() };
        let mut heading = 0.0;
        for (gap, length, lanes) in arms {
            heading += gap;
            plan.nodes.push(Point2::origin() + direction(heading) * length);
            let to = plan.nodes.len() - 1;
            let section = plan.add_section(CrossSection::two_way(lanes, lanes));
            plan.streets.push(Street { section, ..Street::simple(0, to) });
        }
        plan
    })
}

/// Sections with parking, medians, bus and cycle lanes, and a sidewalk on both sides, one or none.
fn section() -> impl Strategy<Value = CrossSection> {
    use LaneDirection::{Backward, Both, Forward};
    let some = any::<[bool; 7]>();
    (some, 1_usize..4, 1_usize..4, 2.5..4.0_f64).prop_map(|(some, backward, forward, width)| {
        let mut lanes = Vec::new();
        let mut add = |wanted: bool, kind, direction, width| {
            if wanted {
                lanes.push(LaneSpec { kind, direction, width });
            }
        };
        add(some[0], LaneKind::Sidewalk, Both, width);
        add(some[1], LaneKind::Verge, Both, 1.0);
        add(some[2], LaneKind::Parking, Backward, 2.0);
        (0..backward).for_each(|_| add(true, LaneKind::Driving, Backward, width));
        add(some[3], LaneKind::Median, Both, 2.0);
        (0..forward).for_each(|_| add(true, LaneKind::Driving, Forward, width));
        add(some[4], LaneKind::Bus, Forward, 3.5);
        add(some[5], LaneKind::Cycle, Forward, 1.5);
        add(some[6], LaneKind::Sidewalk, Both, 2.0);
        let reference = lanes.iter().map(|lane| lane.width).sum::<f64>() * 0.5;
        CrossSection { lanes, reference }
    })
}

fn check(plan: &StreetPlan) -> Result<(), TestCaseError> {
    let network = RoadNetwork::derive(plan, &NetworkConfig::default()).expect("the plan is sound");
    prop_assert_eq!(network.check(), Ok(()));
    check_paths(&network)?;
    if network.intersections.iter().all(|intersection| intersection.roads.len() == 2) {
        return Ok(()); // a ring: one way round never meets the other, nor the inner walkway the outer one
    }
    check_lanes_reach_all(&network)?;
    check_signals(&network)?;
    check_right_of_way(&network)?;
    check_walks(&network)
}

fn check_paths(network: &RoadNetwork) -> Result<(), TestCaseError> {
    for lane in &network.lanes {
        prop_assert!(!lane.outgoing.is_empty(), "a lane leads nowhere");
        prop_assert!((lane.length - polyline::length(&lane.path)).abs() < 1e-9);
    }
    for connection in &network.connections {
        let (from, to) = (&network.lanes[connection.from.index()], &network.lanes[connection.to.index()]);
        let (end, heading) = polyline::at(&from.path, from.length);
        prop_assert!((connection.path[0] - end).norm() < 1e-6, "a gap before the junction");
        prop_assert!(
            (connection.path[connection.path.len() - 1] - to.path[0]).norm() < 1e-6,
            "a gap after it"
        );
        let (_, leaving) = polyline::at(&connection.path, 0.0);
        if connection.turn != Turn::UTurn {
            prop_assert!(ops::wrap_angle(leaving - heading).abs() < 0.35, "a kink at the stop line");
        }
        prop_assert_eq!(from.to, connection.intersection);
        prop_assert_eq!(to.from, connection.intersection);
    }
    Ok(())
}

/// From any lane, changing lanes within a road, one can drive to every other, and to no lane for bicycles.
fn check_lanes_reach_all(network: &RoadNetwork) -> Result<(), TestCaseError> {
    let mut reached = BTreeSet::new();
    let driven = |lane: &LaneId| network.lanes[lane.index()].is_driven();
    let all = (0..network.lanes.len()).map(LaneId::from_index).filter(driven);
    let mut open: Vec<LaneId> = all.clone().take(1).collect();
    while let Some(lane) = open.pop() {
        if !reached.insert(lane) {
            continue;
        }
        let road = &network.roads[network.lanes[lane.index()].road.index()];
        let siblings = if road.forward.contains(&lane) { &road.forward } else { &road.backward };
        open.extend(siblings);
        let ways = &network.lanes[lane.index()].outgoing;
        open.extend(ways.iter().map(|way| network.connections[way.index()].to));
    }
    prop_assert!(reached.iter().all(driven), "a vehicle gets on to a cycle lane");
    prop_assert_eq!(reached.len(), all.count(), "some lanes cannot be reached");
    Ok(())
}

fn check_signals(network: &RoadNetwork) -> Result<(), TestCaseError> {
    let mut groups = 0;
    for plan in &network.signals {
        for group in &plan.groups {
            prop_assert_eq!(group.index(), groups, "groups are numbered densely");
            groups += 1;
        }
        let intersection = &network.intersections[plan.intersection.index()];
        for phase in &plan.phases {
            prop_assert!(phase.duration > 0.0);
            let goes = |id: &simworld_core::id::ConnectionId| {
                network.connections[id.index()]
                    .signal
                    .is_some_and(|group| phase.aspect(group) == Aspect::Green)
            };
            for a in intersection.connections.iter().filter(|id| goes(id)) {
                let connection = &network.connections[a.index()];
                for b in connection.conflicts.iter().filter(|id| goes(id)) {
                    let settled = connection.yields_to.contains(b)
                        || network.connections[b.index()].yields_to.contains(a);
                    prop_assert!(settled, "two crossing streams go at once and nobody gives way");
                }
            }
        }
        for connection in &intersection.connections {
            let group = network.connections[connection.index()].signal.expect("signals govern every way");
            let green = plan.phases.iter().any(|phase| phase.aspect(group) == Aspect::Green);
            prop_assert!(green, "a stream never gets green");
        }
    }
    prop_assert_eq!(groups, network.signal_groups());
    Ok(())
}

fn check_right_of_way(network: &RoadNetwork) -> Result<(), TestCaseError> {
    for (index, connection) in network.connections.iter().enumerate() {
        for other in &connection.conflicts {
            let back = &network.connections[other.index()];
            prop_assert!(
                back.conflicts.iter().any(|id| id.index() == index),
                "a conflict is known to one only"
            );
            let mutual =
                connection.yields_to.contains(other) && back.yields_to.iter().any(|id| id.index() == index);
            prop_assert!(!mutual, "two give way to each other");
        }
    }
    Ok(())
}

fn check_walks(network: &RoadNetwork) -> Result<(), TestCaseError> {
    let walks =
        WaypointGraph::walkable(network, &WaypointConfig::default()).expect("the defaults are in range");
    let (mut scratch, mut route) = (RouteScratch::default(), Route::default());
    for to in 0..walks.waypoints().len() {
        let to = WaypointId::from_index(to);
        prop_assert!(walks.route(WaypointId(0), to, &mut scratch, &mut route), "a walkway is cut off");
        let straight = (walks.waypoint(to).position - walks.waypoint(WaypointId(0)).position).norm();
        prop_assert!(route.length >= straight - 1e-9);
    }
    let coarse = WaypointGraph::coarse(network);
    for to in 0..coarse.waypoints().len() {
        prop_assert!(coarse.route(WaypointId(0), WaypointId::from_index(to), &mut scratch, &mut route));
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn shaken_grids_hold_together(plan in shaken_grid()) {
        check(&plan)?;
    }

    #[test]
    fn stars_hold_together(plan in star()) {
        check(&plan)?;
    }

    #[test]
    fn every_strip_has_its_place(sections in prop::collection::vec(section(), 4)) {
        let mut plan = StreetPlan::crossroads(150.0);
        for (street, section) in sections.iter().enumerate() {
            plan.streets[street].section = plan.add_section(section.clone());
        }
        let network = RoadNetwork::derive(&plan, &NetworkConfig::default()).expect("the plan is sound");
        check_paths(&network)?;
        check_lanes_reach_all(&network)?;
        check_signals(&network)?;
        check_right_of_way(&network)?;
        for (index, (road, section)) in network.roads.iter().zip(&sections).enumerate() {
            let id = RoadId::from_index(index);
            prop_assert_eq!((road.forward.len(), road.backward.len()), section.driven());
            let walks = section.lanes.iter().filter(|lane| lane.kind == LaneKind::Sidewalk).count();
            prop_assert_eq!(road.sidewalks.iter().flatten().count(), walks);
            for side in [Side::Left, Side::Right] {
                if let Some(sidewalk) = network.sidewalk(id, side) {
                    prop_assert_eq!((sidewalk.road, sidewalk.side), (id, side));
                }
            }
            let crossed = network.crossings.iter().any(|crossing| crossing.road == id);
            prop_assert_eq!(crossed, walks == 2, "a crossing joins two sidewalks");
            // Traffic keeps right, and the lanes of a road lie between its kerbs.
            for (lanes, sign) in [(&road.forward, 1.0), (&road.backward, -1.0)] {
                let offsets: Vec<f64> = lanes
                    .iter()
                    .map(|lane| {
                        let lane = &network.lanes[lane.index()];
                        let middle = polyline::at(&lane.path, lane.length * 0.5).0;
                        polyline::closest(&road.centerline, &middle).unwrap().lateral
                    })
                    .collect();
                prop_assert!(offsets.windows(2).all(|pair| (pair[0] - pair[1]) * sign > 1.0), "{offsets:?}");
                prop_assert!(offsets.iter().all(|o| *o < road.left_kerb && -*o < road.right_kerb));
            }
        }
    }

    #[test]
    fn no_plan_makes_it_panic(
        nodes in prop::collection::vec((any::<f64>(), any::<f64>()), 0..6),
        streets in prop::collection::vec((0_usize..8, 0_usize..8, any::<u8>(), any::<u8>()), 0..8),
        lane_width in any::<f64>(),
        reference in any::<f64>(),
    ) {
        let mut plan = StreetPlan {
            nodes: nodes.into_iter().map(|(x, y)| Point2::new(x, y)).collect(),
            ..StreetPlan::default()
        };
        for (from, to, forward, backward) in streets {
            let mut section = CrossSection::plain(forward % 10, backward % 10, lane_width, 2.0);
            section.reference = reference;
            let section = plan.add_section(section);
            plan.streets.push(Street { section, ..Street::simple(from, to) });
        }
        let _ = RoadNetwork::derive(&plan, &NetworkConfig { green: lane_width, ..NetworkConfig::default() });
        let _ = RoadNetwork::derive(&plan, &NetworkConfig::default());
    }
}

#[test]
fn faults_are_named() {
    let mut plan = StreetPlan::crossroads(100.0);
    plan.streets.push(Street::simple(0, 9));
    let error = RoadNetwork::derive(&plan, &NetworkConfig::default()).unwrap_err();
    assert!(matches!(error, NetworkError::Street { street: 4, .. }), "{error}");
    let short = StreetPlan::crossroads(5.0);
    let error = RoadNetwork::derive(&short, &NetworkConfig::default()).unwrap_err();
    assert!(error.to_string().contains("5.0 m long"), "{error}");
}

#[test]
fn signals_can_be_turned_off() {
    let config = NetworkConfig { signals_from_roads: 0, ..NetworkConfig::default() };
    let network = RoadNetwork::derive(&StreetPlan::crossroads(80.0), &config).unwrap();
    assert_eq!(network.intersections[0].control, Control::Priority);
    assert!(network.signals.is_empty() && network.connections.iter().all(|c| c.signal.is_none()));
    assert!(network.connections.iter().any(|c| !c.yields_to.is_empty()));
}
