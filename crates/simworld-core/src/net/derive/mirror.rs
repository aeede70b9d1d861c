//! Traffic on the left: the mirror image of a plan is derived with traffic on the right, and mirrored back. So every
//! rule is written once.

use super::StreetPlan;
use crate::geometry::{Point2, heading};
use crate::id::RoadId;
use crate::net::{
    DrivingSide, Intersection, LaneWays, Road, RoadNetwork, Side, Street, Turn, TurnLanes, TurnSet, polyline,
};

fn flip(point: &mut Point2) {
    point.y = -point.y;
}

/// The plan seen in a mirror, with traffic on the other side.
pub(super) fn plan(plan: &StreetPlan) -> StreetPlan {
    let mut image = plan.clone();
    image.driving_side = match plan.driving_side {
        DrivingSide::Right => DrivingSide::Left,
        DrivingSide::Left => DrivingSide::Right,
    };
    image.nodes.iter_mut().for_each(flip);
    for section in &mut image.sections {
        section.reference = section.width() - section.reference;
        section.lanes.reverse();
    }
    for street in &mut image.streets {
        street.via.iter_mut().for_each(flip);
        mirror_turns(street);
    }
    image
}

fn mirror_turns(street: &mut Street) {
    let mirrored = |turns: &[TurnSet]| turns.iter().rev().map(|turn| turn.mirrored()).collect();
    // Lanes are counted from the middle, where a mirror changes nothing.
    let ways = |ways: &[LaneWays]| {
        ways.iter().map(|ways| LaneWays { heading: -ways.heading, ..ways.clone() }).collect()
    };
    let TurnLanes { forward, backward, forward_ways, backward_ways } = &*street.turns;
    street.turns = TurnLanes {
        forward: mirrored(forward),
        backward: mirrored(backward),
        forward_ways: ways(forward_ways),
        backward_ways: ways(backward_ways),
    }
    .into();
}

/// The network of a mirrored plan, as it is.
pub(super) fn network(mut network: RoadNetwork) -> RoadNetwork {
    network.driving_side = DrivingSide::Left;
    for road in &mut network.roads {
        road.centerline.iter_mut().for_each(flip);
        std::mem::swap(&mut road.left_kerb, &mut road.right_kerb);
        road.sidewalks.swap(0, 1);
        road.cycle.reverse();
        road.strips.reverse();
        road.strips.iter_mut().for_each(|strip| strip.offset = -strip.offset);
    }
    network.lanes.iter_mut().flat_map(|lane| &mut lane.path).for_each(flip);
    for connection in &mut network.connections {
        connection.path.iter_mut().for_each(flip);
        connection.turn = match connection.turn {
            Turn::Left => Turn::Right,
            Turn::Right => Turn::Left,
            other => other,
        };
    }
    for sidewalk in &mut network.sidewalks {
        sidewalk.path.iter_mut().for_each(flip);
        sidewalk.side = if sidewalk.side == Side::Left { Side::Right } else { Side::Left };
    }
    for crossing in &mut network.crossings {
        flip(&mut crossing.start);
        flip(&mut crossing.end);
        std::mem::swap(&mut crossing.start, &mut crossing.end);
    }
    let RoadNetwork { roads, intersections, .. } = &mut network;
    for (index, place) in intersections.iter_mut().enumerate() {
        turn_over(index, place, roads);
    }
    network
}

/// An intersection of a mirrored network, as it is; its roads are so already.
fn turn_over(index: usize, intersection: &mut Intersection, roads: &[Road]) {
    flip(&mut intersection.center);
    intersection.turning.iter_mut().for_each(|circle| flip(&mut circle.center));
    intersection.hammerhead.iter_mut().flat_map(|head| &mut head.tips).for_each(flip);
    intersection.outline.iter_mut().for_each(flip);
    let mut kerbs: Vec<Vec<Point2>> =
        (0..intersection.kerbs.len()).map(|rank| polyline::reversed(intersection.kerb(rank))).collect();
    kerbs.reverse();
    // Counter-clockwise again; what was the corner after a road is the one before it.
    intersection.roads.reverse();
    intersection.corners.iter_mut().flatten().for_each(flip);
    intersection.corners.iter_mut().for_each(|corner| corner.reverse());
    intersection.corners.reverse();
    if !intersection.corners.is_empty() {
        intersection.corners.rotate_left(1);
    }
    if !kerbs.is_empty() {
        kerbs.rotate_left(1);
    }
    // Straight to the west is the last direction on either side of the mirror.
    let center = intersection.center;
    let leaving = |road: &RoadId| {
        let road = &roads[road.index()];
        let line = &road.centerline;
        let next = if road.from.index() == index { line[1] } else { line[line.len() - 2] };
        heading(&(next - center))
    };
    if !intersection.roads.is_sorted_by(|a, b| leaving(a) <= leaving(b)) {
        intersection.roads.rotate_left(1);
        intersection.corners.rotate_left(1);
        kerbs.rotate_left(1);
    }
    if !kerbs.is_empty() {
        let mut start = 0;
        for (place, kerb) in intersection.kerbs.iter_mut().zip(&kerbs) {
            *place = start;
            start += kerb.len() as u32;
        }
        intersection.outline = kerbs.concat();
    }
}
