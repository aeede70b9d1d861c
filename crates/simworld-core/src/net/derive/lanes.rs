//! Lanes: the driven strips of every cross-section, from stop line to stop line.

use super::NetworkConfig;
use crate::geometry::Point2;
use crate::id::{LaneId, RoadId};
use crate::net::{
    CrossSection, Few, Lane, LaneDirection, LaneKind, LaneSpec, Road, StreetPlan, Strip, polyline,
};

/// The most that is ridden on a cycle lane, m/s: 25 km/h, up to which a motor may help (EN 15194).
const CYCLE_SPEED: f64 = 25.0 / 3.6;

/// Lays the lanes of a road beside the middle of its street, cut off at those stations at both ends; numbers them on.
pub(super) fn lay(
    lanes: &mut Vec<Lane>,
    (id, road): (RoadId, &mut Road),
    (plan, config): (&StreetPlan, &NetworkConfig),
    middle: &[Point2],
    stations: (f64, f64),
) {
    let street = &plan.streets[id.index()];
    let section = plan.section(street);
    let speed_limit = street.speed_limit.unwrap_or_else(|| config.speed_limit(street.class));
    for (offset, spec) in section.strips() {
        let (spec, speed_limit) = match spec.kind {
            LaneKind::Driving | LaneKind::Bus => (spec, speed_limit),
            LaneKind::Cycle => {
                let direction = cycled(offset, spec.direction);
                (LaneSpec { direction, ..spec }, speed_limit.min(CYCLE_SPEED))
            }
            _ => continue,
        };
        let number = LaneId::from_index(lanes.len());
        lanes.push(lane((id, road), number, middle, (offset, spec), speed_limit));
    }
    road.strips.extend(beside_lanes(section, stations));
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

/// How many lanes a street of a cross-section has.
pub(super) fn count(section: &CrossSection) -> usize {
    section.lanes.iter().filter(|spec| spec.kind.is_driven() || spec.kind == LaneKind::Cycle).count()
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

/// A lane of a road, which is told of it, beside a line that runs along the centreline.
fn lane(
    (id, road): (RoadId, &mut Road),
    number: LaneId,
    line: &[Point2],
    (offset, spec): (f64, LaneSpec),
    speed_limit: f64,
) -> Lane {
    let mut path = polyline::offset(line, offset);
    let is_backward = spec.direction == LaneDirection::Backward;
    let list = match (spec.kind, is_backward) {
        (LaneKind::Cycle, _) => &mut road.cycle,
        (_, true) => &mut road.backward,
        (_, false) => &mut road.forward,
    };
    list.push(number);
    if is_backward {
        path.reverse();
    }
    let (from, to) = if is_backward { (road.to, road.from) } else { (road.from, road.to) };
    Lane {
        road: id,
        kind: spec.kind,
        length: polyline::length(&path),
        path,
        width: spec.width,
        speed_limit,
        from,
        to,
        outgoing: Few::new(),
    }
}
