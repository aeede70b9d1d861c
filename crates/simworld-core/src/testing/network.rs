//! Networks that differ in nothing but the numbers of their parts.

use crate::id::{ConnectionId, CrossingId, LaneId, RoadId, SidewalkId};
use crate::net::{Few, Lane, RoadNetwork, SignalGroup, polyline};

/// The network with its lanes, sidewalks, connections, crossings, signals and signal groups numbered road by road and
/// junction by junction: two networks that differ only in those numbers come out the same. Roads and intersections keep
/// theirs.
pub fn numbered_in_order(network: &RoadNetwork) -> RoadNetwork {
    let mut ordered = RoadNetwork {
        roads: network.roads.clone(),
        intersections: network.intersections.clone(),
        names: network.names.clone(),
        driving_side: network.driving_side,
        footpaths: network.footpaths.clone(),
        plazas: network.plazas.clone(),
        ..RoadNetwork::default()
    };
    let lanes = order_lanes(network, &mut ordered);
    order_sidewalks(network, &mut ordered);
    for index in 0..network.intersections.len() {
        let groups = order_signals(network, &mut ordered, index);
        let crossings = order_crossings(network, &mut ordered, index, &groups);
        order_connections(network, &mut ordered, index, &Names { lanes: &lanes, crossings, groups });
    }
    for lane in &mut ordered.lanes {
        lane.outgoing.sort_unstable();
    }
    ordered
}

/// New numbers of what a junction's connections name.
struct Names<'a> {
    lanes: &'a [LaneId],
    crossings: Vec<(CrossingId, CrossingId)>,
    groups: Vec<(SignalGroup, SignalGroup)>,
}

fn renamed<T: Copy + PartialEq>(names: &[(T, T)], name: T) -> T {
    names.iter().find(|(old, _)| *old == name).map_or(name, |(_, new)| *new)
}

/// Road by road, from left to right; gives the new number of each lane.
fn order_lanes(network: &RoadNetwork, ordered: &mut RoadNetwork) -> Vec<LaneId> {
    let mut names = vec![LaneId::default(); network.lanes.len()];
    for road in &mut ordered.roads {
        // How far the middle of a lane lies to the left of the centreline.
        let left = |lane: &LaneId| {
            let lane = &network.lanes[lane.index()];
            let middle = polyline::at(&lane.path, lane.length * 0.5).0;
            let near = polyline::closest(&road.centerline, &middle).map_or(0.0, |near| near.station);
            let (foot, heading) = polyline::at(&road.centerline, near);
            crate::geometry::direction(heading).perp(&(middle - foot))
        };
        let mut across: Vec<(f64, LaneId)> = road.lanes().map(|lane| (left(&lane), lane)).collect();
        across.sort_by(|a, b| b.0.total_cmp(&a.0));
        for (_, lane) in across {
            names[lane.index()] = LaneId::from_index(ordered.lanes.len());
            ordered.lanes.push(Lane { outgoing: Few::new(), ..network.lanes[lane.index()].clone() });
        }
        road.forward
            .iter_mut()
            .chain(&mut road.backward)
            .chain(&mut road.cycle)
            .for_each(|lane| *lane = names[lane.index()]);
    }
    names
}

fn order_sidewalks(network: &RoadNetwork, ordered: &mut RoadNetwork) {
    for road in &mut ordered.roads {
        for sidewalk in road.sidewalks.iter_mut().flatten() {
            let next = SidewalkId::from_index(ordered.sidewalks.len());
            ordered.sidewalks.push(network.sidewalks[sidewalk.index()].clone());
            *sidewalk = next;
        }
    }
}

fn order_signals(
    network: &RoadNetwork,
    ordered: &mut RoadNetwork,
    index: usize,
) -> Vec<(SignalGroup, SignalGroup)> {
    let Some(plan) = network.intersections[index].signals else { return Vec::new() };
    let mut plan = network.signals[plan as usize].clone();
    let first = ordered.signal_groups() as u32;
    let names: Vec<_> = plan.groups.iter().copied().zip((first..).map(SignalGroup)).collect();
    let lists = plan.phases.iter_mut().flat_map(|phase| [&mut phase.green[..], &mut phase.yellow]);
    lists.chain([&mut plan.groups[..]]).flatten().for_each(|group| *group = renamed(&names, *group));
    ordered.intersections[index].signals = Some(ordered.signals.len() as u32);
    ordered.signals.push(plan);
    names
}

fn order_crossings(
    network: &RoadNetwork,
    ordered: &mut RoadNetwork,
    index: usize,
    groups: &[(SignalGroup, SignalGroup)],
) -> Vec<(CrossingId, CrossingId)> {
    let mut names = Vec::new();
    for crossing in &mut ordered.intersections[index].crossings {
        let next = CrossingId::from_index(ordered.crossings.len());
        let mut found = network.crossings[crossing.index()].clone();
        found.signal = found.signal.map(|group| renamed(groups, group));
        ordered.crossings.push(found);
        names.push((*crossing, next));
        *crossing = next;
    }
    names
}

fn order_connections(network: &RoadNetwork, ordered: &mut RoadNetwork, index: usize, names: &Names<'_>) {
    let place = &network.intersections[index];
    let rank = |road: RoadId| place.roads.iter().position(|leg| *leg == road);
    let mut own = place.connections.clone();
    own.sort_by_key(|id| {
        let way = &network.connections[id.index()];
        let leg = rank(network.lanes[way.from.index()].road);
        (leg, names.lanes[way.from.index()], names.lanes[way.to.index()], way.turn)
    });
    let first = ordered.connections.len();
    let renumbered = |list: &[ConnectionId]| {
        let next = |old: &ConnectionId| own.iter().position(|other| other == old);
        let mut list: Few<ConnectionId> =
            list.iter().filter_map(next).map(|rank| ConnectionId::from_index(first + rank)).collect();
        list.sort_unstable();
        list
    };
    for id in &own {
        let mut way = network.connections[id.index()].clone();
        (way.from, way.to) = (names.lanes[way.from.index()], names.lanes[way.to.index()]);
        way.signal = way.signal.map(|group| renamed(&names.groups, group));
        way.crossings.iter_mut().for_each(|crossing| *crossing = renamed(&names.crossings, *crossing));
        way.crossings.sort_unstable();
        (way.conflicts, way.yields_to) = (renumbered(&way.conflicts), renumbered(&way.yields_to));
        ordered.lanes[way.from.index()].outgoing.push(ConnectionId::from_index(ordered.connections.len()));
        ordered.connections.push(way);
    }
    ordered.intersections[index].connections =
        (first..ordered.connections.len()).map(ConnectionId::from_index).collect();
}
