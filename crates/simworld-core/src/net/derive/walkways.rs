//! Where people walk: sidewalks along the roads, walkways round the corners, crossings over the legs.

use super::NetworkConfig;
use super::hammerhead;
use super::kerbs;
use super::legs::{self, Leg, Legs};
use super::workers::{self, Workers};
use crate::geometry::Point2;
use crate::id::{CrossingId, IntersectionId, RoadId};
use crate::net::{Crossing, LaneKind, RoadNetwork, Side, Sidewalk, StreetPlan, polyline};

/// Adds the corners between sidewalks, and the crossings that join them.
pub(super) fn add(
    network: &mut RoadNetwork,
    plan: &StreetPlan,
    legs: &Legs,
    config: &NetworkConfig,
    workers: &dyn Workers,
) {
    for (node, legs) in legs.by_node().enumerate() {
        let id = IntersectionId::from_index(node);
        for leg in legs.iter().filter(|_| legs.len() >= 3) {
            // Nobody crosses the ring of a roundabout.
            if joins_two_sidewalks(network, leg) && !plan.streets[leg.street].roundabout {
                add_crossing(network, id, leg, config);
            }
        }
    }
    let corners = workers::each(workers, legs.nodes(), |node| corners(network, &legs[node]));
    for (place, corners) in network.intersections.iter_mut().zip(corners) {
        place.corners = corners;
    }
}

fn joins_two_sidewalks(network: &RoadNetwork, leg: &Leg) -> bool {
    network.roads[leg.street].sidewalks.iter().all(Option::is_some)
}

/// The sidewalks that the cross-section of a street has on its left and on its right, beside the middle of the street.
pub(super) fn sidewalks(plan: &StreetPlan, road: RoadId, middle: &[Point2]) -> [Option<Sidewalk>; 2] {
    let section = plan.section(&plan.streets[road.index()]);
    let strips = || section.strips().filter(|(_, spec)| spec.kind == LaneKind::Sidewalk);
    let kerb = section.kerbs().0;
    // The outermost on either side; one that lies between the kerbs is no sidewalk of either.
    let left = strips().next().filter(|(offset, _)| *offset > kerb);
    let right = strips().last().filter(|(offset, _)| *offset < -section.kerbs().1);
    [(Side::Left, left), (Side::Right, right)].map(|(side, strip)| {
        let (offset, spec) = strip?;
        Some(Sidewalk { road, side, path: polyline::offset(middle, offset), width: spec.width })
    })
}

fn add_crossing(network: &mut RoadNetwork, intersection: IntersectionId, leg: &Leg, config: &NetworkConfig) {
    let id = CrossingId::from_index(network.crossings.len());
    network.crossings.push(Crossing {
        intersection,
        road: RoadId::from_index(leg.street),
        start: leg.point(leg.walk, leg.left),
        end: leg.point(leg.walk, -leg.right),
        width: config.crossing_width,
        signal: None,
    });
    network.intersections[intersection.index()].crossings.push(id);
}

/// The end, at this junction, of the sidewalk on the left or right of a leg, seen leaving, and how far its middle lies
/// from the kerb, m.
fn sidewalk_end(network: &RoadNetwork, leg: &Leg, side: Side) -> Option<(Point2, f64)> {
    let seen_along = match (leg.at_start, side) {
        (true, side) => side,
        (false, Side::Left) => Side::Right,
        (false, Side::Right) => Side::Left,
    };
    let path = &network.sidewalk(RoadId::from_index(leg.street), seen_along)?.path;
    let end = if leg.at_start { *path.first()? } else { *path.last()? };
    let ahead = leg.direction();
    let from_centerline = ahead.perp(&(end - leg.node)).abs();
    let kerb = if side == Side::Left { leg.left } else { leg.right };
    Some((end, (from_centerline - kerb).max(0.0)))
}

/// The walkway from each leg's left sidewalk to the next leg's right one; without points where one is missing.
fn corners(network: &RoadNetwork, legs: &[Leg]) -> Vec<Vec<Point2>> {
    let between = |index: usize| -> Option<Vec<Point2>> {
        let (leg, next) = (&legs[index], &legs[(index + 1) % legs.len()]);
        let (start, left_margin) = sidewalk_end(network, leg, Side::Left)?;
        let (end, right_margin) = sidewalk_end(network, next, Side::Right)?;
        let mut walkway = Vec::with_capacity(3);
        walkway.push(start);
        if legs.len() == 1 {
            // Round the back of a dead end.
            if leg.turning > 0.0 {
                let around = kerbs::walk_round_bulb(leg, left_margin.min(right_margin));
                walkway.extend(&around[1..around.len().saturating_sub(1).max(1)]);
                walkway.push(end);
                return Some(walkway);
            }
            if leg.hammerhead {
                hammerhead::walk_round(leg, left_margin.min(right_margin), &mut walkway);
                walkway.push(end);
                return Some(walkway);
            }
            walkway.push(leg.point(-left_margin, leg.left + left_margin));
            walkway.push(leg.point(-right_margin, -leg.right - right_margin));
        } else {
            // Sidewalks that would meet beyond their own ends go over into one another straight.
            let within =
                |met: &Point2, leg: &Leg| (met - leg.node).dot(&leg.direction()) <= leg.walk.max(leg.reach);
            let met = legs::corner(leg, next, (left_margin, right_margin));
            walkway.extend(met.filter(|met| within(met, leg) && within(met, next)));
        }
        walkway.push(end);
        Some(walkway)
    };
    (0..legs.len()).map(|index| between(index).unwrap_or_default()).collect()
}
