//! What follows from lanes: the lists that lead from one thing to another, kerbs, corners, conflicts.

use super::NetworkBuilder;
use crate::geometry::{Point2, Vector2, direction};
use crate::id::{ConnectionId, CrossingId, IntersectionId, RoadId};
use crate::net::derive::settle;
use crate::net::{Control, NetworkFault, RoadNetwork, Side, polyline};

/// A walkway goes round a corner by the point where its two sidewalks would meet, if that is no farther than this, m.
const FARTHEST_CORNER: f64 = 40.0;

pub(super) fn finish(builder: NetworkBuilder) -> Result<RoadNetwork, NetworkFault> {
    let NetworkBuilder { mut network, mut settled } = builder;
    for way in &mut network.connections {
        for list in [&mut way.conflicts, &mut way.yields_to] {
            list.sort_unstable();
            list.dedup();
        }
    }
    // From here on every reference leads somewhere.
    network.check()?;
    check_connections(&network)?;
    measure_roads(&mut network);
    link(&mut network);
    for place in 0..network.intersections.len() {
        network.intersections[place].corners = corners(&network, IntersectionId::from_index(place));
    }
    settled.sort_unstable();
    for index in 0..network.intersections.len() {
        let place = IntersectionId::from_index(index);
        settle(&mut network, place, settled.binary_search(&place).is_err());
        let is_shared = |way: &ConnectionId| !network.connections[way.index()].conflicts.is_empty();
        let meets = network.intersections[index].connections.iter().any(is_shared);
        let control = &mut network.intersections[index].control;
        if *control == Control::None && meets {
            *control = Control::Priority;
        }
    }
    network.check()?;
    Ok(network)
}

/// A way leads across the one intersection between its lanes.
fn check_connections(network: &RoadNetwork) -> Result<(), NetworkFault> {
    let apart = network.connections.iter().position(|way| {
        let (from, to) = (&network.lanes[way.from.index()], &network.lanes[way.to.index()]);
        from.to != to.from || way.intersection != from.to
    });
    apart.map_or(Ok(()), |index| {
        Err(NetworkFault { what: "connection", index, fault: "joins lanes that do not meet" })
    })
}

/// Kerbs lie where the outermost lanes end.
fn measure_roads(network: &mut RoadNetwork) {
    for road in &mut network.roads {
        let mut kerbs: Option<(f64, f64)> = None;
        for lane in road.forward.iter().chain(&road.backward).chain(&road.cycle) {
            let lane = &network.lanes[lane.index()];
            let middle = polyline::at(&lane.path, lane.length * 0.5).0;
            let Some(near) = polyline::closest(&road.centerline, &middle) else { continue };
            let (left, right) = (near.lateral + lane.width * 0.5, lane.width * 0.5 - near.lateral);
            kerbs = Some(kerbs.map_or((left, right), |(l, r)| (l.max(left), r.max(right))));
        }
        (road.left_kerb, road.right_kerb) = kerbs.unwrap_or((0.0, 0.0));
        road.width = (road.left_kerb + road.right_kerb).max(0.0);
    }
}

fn link(network: &mut RoadNetwork) {
    for (index, way) in network.connections.iter().enumerate() {
        let id = ConnectionId::from_index(index);
        network.lanes[way.from.index()].outgoing.push(id);
        network.intersections[way.intersection.index()].connections.push(id);
    }
    for (index, crossing) in network.crossings.iter().enumerate() {
        network.intersections[crossing.intersection.index()].crossings.push(CrossingId::from_index(index));
    }
    let mut legs: Vec<Vec<(f64, RoadId)>> = vec![Vec::new(); network.intersections.len()];
    for (index, road) in network.roads.iter().enumerate() {
        let id = RoadId::from_index(index);
        let length = polyline::length(&road.centerline);
        // From east, counter-clockwise: a heading in [0, 2 pi).
        let turned = |heading: f64| heading.rem_euclid(std::f64::consts::TAU);
        legs[road.from.index()].push((turned(polyline::at(&road.centerline, 0.0).1), id));
        let back = polyline::at(&road.centerline, length).1 + std::f64::consts::PI;
        legs[road.to.index()].push((turned(back), id));
    }
    for (place, mut legs) in network.intersections.iter_mut().zip(legs) {
        legs.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        place.roads = legs.into_iter().map(|(_, road)| road).collect();
        if area(&place.outline) < 0.0 {
            place.outline.reverse();
        }
        if place.outline.is_empty() {
            place.outline.push(place.center);
        }
    }
}

/// Twice the area within a ring, positive if it runs counter-clockwise, m².
fn area(ring: &[Point2]) -> f64 {
    let next = ring.iter().cycle().skip(1);
    ring.iter().zip(next).map(|(a, b)| a.coords.perp(&b.coords)).sum()
}

/// The walkways round the corners of an intersection; without points where a sidewalk is missing.
fn corners(network: &RoadNetwork, place: IntersectionId) -> Vec<Vec<Point2>> {
    let roads = &network.intersections[place.index()].roads;
    if roads.len() < 2 {
        return Vec::new();
    }
    let between = |rank: usize| -> Option<Vec<Point2>> {
        let (start, out) = walk_end(network, place, roads[rank], Side::Left)?;
        let (end, back) = walk_end(network, place, roads[(rank + 1) % roads.len()], Side::Right)?;
        // Both run on into the junction: where they meet is the corner, inside of a bend or outside.
        let elbow = polyline::meet(start, out, end, back).filter(|point| {
            (point - start).norm().max((point - end).norm()) < FARTHEST_CORNER
                && ((point - start).dot(&out) > 0.0 || (point - end).dot(&back) > 0.0)
        });
        Some([Some(start), elbow, Some(end)].into_iter().flatten().collect())
    };
    (0..roads.len()).map(|rank| between(rank).unwrap_or_default()).collect()
}

/// Where the sidewalk on a side of a road, seen from an intersection, ends there, and which way it would go on.
fn walk_end(
    network: &RoadNetwork,
    place: IntersectionId,
    road: RoadId,
    side: Side,
) -> Option<(Point2, Vector2)> {
    let at_start = network.roads[road.index()].from == place;
    let along = match (side, at_start) {
        (side, true) => side,
        (Side::Left, false) => Side::Right,
        (Side::Right, false) => Side::Left,
    };
    let path = &network.sidewalk(road, along)?.path;
    let (station, onwards) =
        if at_start { (0.0, std::f64::consts::PI) } else { (polyline::length(path), 0.0) };
    let (point, heading) = polyline::at(path, station);
    Some((point, direction(heading + onwards)))
}
