//! Lanes: the driven strips of every cross-section, from stop line to stop line.

use super::NetworkConfig;
use super::legs::Leg;
use crate::geometry::Point2;
use crate::id::{LaneId, RoadId};
use crate::net::{Lane, LaneDirection, LaneSpec, RoadNetwork, StreetPlan, polyline};

/// Cuts both ends off every centreline and lays the lanes beside what is left.
pub(super) fn add(network: &mut RoadNetwork, plan: &StreetPlan, legs: &[Vec<Leg>], config: &NetworkConfig) {
    let mut stops = vec![(0.0, 0.0); network.roads.len()];
    for leg in legs.iter().flatten() {
        let (start, end) = &mut stops[leg.street];
        *if leg.at_start { start } else { end } = leg.stop;
    }
    for (index, (street, (start, end))) in plan.streets.iter().zip(stops).enumerate() {
        let centerline = &network.roads[index].centerline;
        let middle = polyline::slice(centerline, start, polyline::length(centerline) - end);
        let speed_limit = street.speed_limit.unwrap_or_else(|| config.speed_limit(street.class));
        for (offset, spec) in plan.section(street).strips().filter(|(_, spec)| spec.kind.is_driven()) {
            lay(network, RoadId::from_index(index), &middle, offset, spec, speed_limit);
        }
        let road = &mut network.roads[index];
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
    let (from, to) = if spec.direction == LaneDirection::Backward {
        path.reverse();
        owner.backward.push(id);
        (owner.to, owner.from)
    } else {
        owner.forward.push(id);
        (owner.from, owner.to)
    };
    network.lanes.push(Lane {
        road,
        kind: spec.kind,
        length: polyline::length(&path),
        path,
        width: spec.width,
        speed_limit,
        from,
        to,
        outgoing: Vec::new(),
    });
}
