//! Where people walk: sidewalks along the roads, walkways round the corners, crossings over the legs.

use super::NetworkConfig;
use super::legs::{self, Leg};
use crate::geometry::Point2;
use crate::id::{CrossingId, IntersectionId, RoadId};
use crate::net::{Crossing, RoadNetwork, Side, Sidewalk, polyline};

/// Adds sidewalks, corners and crossings; none if the sidewalk has no width.
pub(super) fn add(network: &mut RoadNetwork, legs: &[Vec<Leg>], config: &NetworkConfig) {
    if config.sidewalk_width <= 0.0 {
        return;
    }
    add_sidewalks(network, legs, config);
    for (node, legs) in legs.iter().enumerate() {
        let id = IntersectionId::from_index(node);
        if legs.len() >= 3 {
            for leg in legs {
                add_crossing(network, id, leg, config);
            }
        }
        network.intersections[node].corners = corners(network, legs, config);
    }
}

fn add_sidewalks(network: &mut RoadNetwork, legs: &[Vec<Leg>], config: &NetworkConfig) {
    let mut ends = vec![(0.0, 0.0, 0.0, 0.0); network.roads.len()];
    for leg in legs.iter().flatten() {
        let (start, end, left, right) = &mut ends[leg.street];
        if leg.at_start {
            (*start, *left, *right) = (leg.walk, leg.left, leg.right);
        } else {
            *end = leg.walk;
        }
    }
    for (index, (start, end, left, right)) in ends.into_iter().enumerate() {
        let centerline = &network.roads[index].centerline;
        let middle = polyline::slice(centerline, start, polyline::length(centerline) - end);
        let half = config.sidewalk_width * 0.5;
        for (side, offset) in [(Side::Left, left + half), (Side::Right, -right - half)] {
            network.sidewalks.push(Sidewalk {
                road: RoadId::from_index(index),
                side,
                path: polyline::offset(&middle, offset),
                width: config.sidewalk_width,
            });
        }
    }
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

/// The end, at this junction, of the sidewalk on the left or right of a leg, seen leaving.
fn sidewalk_end(network: &RoadNetwork, leg: &Leg, side: Side) -> Option<Point2> {
    let seen_along = match (leg.at_start, side) {
        (true, side) => side,
        (false, Side::Left) => Side::Right,
        (false, Side::Right) => Side::Left,
    };
    let path = &network.sidewalk(RoadId::from_index(leg.street), seen_along)?.path;
    if leg.at_start { path.first().copied() } else { path.last().copied() }
}

/// The walkway from each leg's left sidewalk to the next leg's right one.
fn corners(network: &RoadNetwork, legs: &[Leg], config: &NetworkConfig) -> Vec<Vec<Point2>> {
    let half = config.sidewalk_width * 0.5;
    let between = |index: usize| -> Option<Vec<Point2>> {
        let (leg, next) = (&legs[index], &legs[(index + 1) % legs.len()]);
        let mut walkway = vec![sidewalk_end(network, leg, Side::Left)?];
        if legs.len() == 1 {
            // Round the back of a dead end.
            walkway.push(leg.point(-half, leg.left + half));
            walkway.push(leg.point(-half, -leg.right - half));
        } else {
            walkway.extend(legs::corner(leg, next, half));
        }
        walkway.push(sidewalk_end(network, next, Side::Right)?);
        Some(walkway)
    };
    (0..legs.len()).filter_map(between).collect()
}
