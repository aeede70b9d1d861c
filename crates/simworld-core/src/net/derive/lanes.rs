//! Lanes: the driven strips of every cross-section, from stop line to stop line.

use super::NetworkConfig;
use super::legs::Legs;
use crate::geometry::Point2;
use crate::id::{LaneId, RoadId};
use crate::net::polyline::Measured;
use crate::net::{
    CrossSection, Few, Lane, LaneDirection, LaneKind, LaneSpec, RoadNetwork, StreetPlan, Strip, polyline,
};

/// The most that is ridden on a cycle lane, m/s: 25 km/h, up to which a motor may help (EN 15194).
const CYCLE_SPEED: f64 = 25.0 / 3.6;

/// Cuts both ends off every centreline and lays the lanes beside what is left.
pub(super) fn add(network: &mut RoadNetwork, plan: &StreetPlan, legs: &Legs, config: &NetworkConfig) {
    let mut stops = vec![(0.0, 0.0); network.roads.len()];
    for leg in legs.all() {
        let (start, end) = &mut stops[leg.street];
        *if leg.at_start { start } else { end } = leg.stop;
    }
    let mut middle = Vec::new();
    for (index, (street, (start, end))) in plan.streets.iter().zip(stops).enumerate() {
        let centerline = Measured::new(&network.roads[index].centerline);
        let stations = (start, centerline.length() - end);
        centerline.slice_into(stations.0, stations.1, &mut middle);
        let speed_limit = street.speed_limit.unwrap_or_else(|| config.speed_limit(street.class));
        for (offset, spec) in plan.section(street).strips() {
            match spec.kind {
                LaneKind::Driving | LaneKind::Bus => {
                    lay(network, RoadId::from_index(index), &middle, offset, spec, speed_limit);
                }
                LaneKind::Cycle => {
                    let spec = LaneSpec { direction: cycled(offset, spec.direction), ..spec };
                    let speed_limit = speed_limit.min(CYCLE_SPEED);
                    lay(network, RoadId::from_index(index), &middle, offset, spec, speed_limit);
                }
                _ => {}
            }
        }
        let road = &mut network.roads[index];
        road.strips.extend(beside_lanes(plan.section(street), stations));
        // Strips run from left to right; the innermost lane of each direction is the one next to the other.
        let forward_is_right = match (road.forward.first(), road.backward.first()) {
            (Some(forward), Some(backward)) => forward > backward,
            _ => true,
        };
        if forward_is_right {
            road.backward.reverse();
        } else {
            road.forward.reverse();
        }
    }
}

/// What of a cross-section is neither driven by motor vehicles nor walked on.
fn beside_lanes(section: &CrossSection, stations: (f64, f64)) -> impl Iterator<Item = Strip> + '_ {
    let is_meant = |(_, spec): &(f64, LaneSpec)| !spec.kind.is_driven() && spec.kind != LaneKind::Sidewalk;
    section.strips().filter(is_meant).map(move |(offset, spec)| Strip {
        kind: spec.kind,
        direction: spec.direction,
        offset,
        width: spec.width,
        stations: (stations.0, stations.1.max(stations.0)),
    })
}

/// The way bicycles go on a strip: those on one that goes either way keep right.
fn cycled(offset: f64, direction: LaneDirection) -> LaneDirection {
    match direction {
        LaneDirection::Both if offset > 0.0 => LaneDirection::Backward,
        LaneDirection::Both => LaneDirection::Forward,
        one_way => one_way,
    }
}

/// Lays one lane beside a line that runs along the centreline.
fn lay(
    network: &mut RoadNetwork,
    road: RoadId,
    line: &[Point2],
    offset: f64,
    spec: LaneSpec,
    speed_limit: f64,
) {
    let id = LaneId::from_index(network.lanes.len());
    let owner = &mut network.roads[road.index()];
    let mut path = polyline::offset(line, offset);
    let is_backward = spec.direction == LaneDirection::Backward;
    let list = match (spec.kind, is_backward) {
        (LaneKind::Cycle, _) => &mut owner.cycle,
        (_, true) => &mut owner.backward,
        (_, false) => &mut owner.forward,
    };
    list.push(id);
    if is_backward {
        path.reverse();
    }
    let (from, to) = if is_backward { (owner.to, owner.from) } else { (owner.from, owner.to) };
    network.lanes.push(Lane {
        road,
        kind: spec.kind,
        length: polyline::length(&path),
        path,
        width: spec.width,
        speed_limit,
        from,
        to,
        outgoing: Few::new(),
    });
}
