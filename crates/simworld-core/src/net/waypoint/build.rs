//! Builds the levels of the waypoint graph from a road network.

use std::collections::BTreeMap;

use super::{Waypoint, WaypointConfig, WaypointEdge, WaypointGraph, WaypointKind};
use crate::geometry::{Point2, Vector2};
use crate::grid::PointGrid;
use crate::id::{CrossingId, IntersectionId, LaneId, RoadId, WaypointId};
use crate::net::{RoadNetwork, Side, polyline};

/// Width of a cell of the grid in which the nearest waypoint is looked for, m.
const CELL: f64 = 20.0;
/// An end of a footpath that joins leads on to a sidewalk that is no farther off, m.
const JOINS: f64 = 15.0;
/// Where a height bends so near to a corner of its way, it bends there, m.
const BEND: f64 = 0.01;

/// A graph under construction.
#[derive(Default)]
struct Builder {
    waypoints: Vec<Waypoint>,
    edges: Vec<(WaypointId, WaypointEdge)>,
    /// Of each waypoint above the ground, m; those of the last ones are left out while they are on it.
    heights: Vec<f64>,
}

impl Builder {
    fn add(&mut self, position: Point2, kind: WaypointKind) -> WaypointId {
        self.waypoints.push(Waypoint { position, kind });
        WaypointId::from_index(self.waypoints.len() - 1)
    }

    fn join_one_way(&mut self, from: WaypointId, to: WaypointId, length: f64, width: f64) {
        self.edges.push((from, WaypointEdge { to, length, crossing: None, width: width as f32 }));
    }

    fn join(&mut self, a: WaypointId, b: WaypointId, width: f64, crossing: Option<CrossingId>) {
        let width = width as f32;
        let length = (self.waypoints[a.index()].position - self.waypoints[b.index()].position).norm();
        self.edges.push((a, WaypointEdge { to: b, length, crossing, width }));
        self.edges.push((b, WaypointEdge { to: a, length, crossing, width }));
    }

    /// Adds a waypoint so high above the ground, m.
    fn add_at(&mut self, position: Point2, height: f64, kind: WaypointKind) -> WaypointId {
        let waypoint = self.add(position, kind);
        if height > 0.0 {
            self.heights.resize(waypoint.index(), 0.0);
            self.heights.push(height);
        }
        waypoint
    }

    /// Adds waypoints at these places; returns them in order.
    fn add_all(&mut self, places: &[Point2], kind: WaypointKind) -> Vec<WaypointId> {
        places.iter().map(|place| self.add(*place, kind)).collect()
    }

    fn finish(mut self) -> WaypointGraph {
        self.edges.sort_by_key(|(from, edge)| (*from, edge.to));
        let mut starts = vec![0_u32; self.waypoints.len() + 1];
        for (from, _) in &self.edges {
            starts[from.index() + 1] += 1;
        }
        for index in 1..starts.len() {
            starts[index] += starts[index - 1];
        }
        let grid = PointGrid::new(self.waypoints.iter().map(|waypoint| waypoint.position).collect(), CELL);
        let edges = self.edges.into_iter().map(|(_, edge)| edge).collect();
        if !self.heights.is_empty() {
            self.heights.resize(self.waypoints.len(), 0.0);
        }
        WaypointGraph { waypoints: self.waypoints, starts, edges, grid, heights: self.heights }
    }
}

pub(super) fn coarse(network: &RoadNetwork) -> WaypointGraph {
    let mut builder = Builder::default();
    for (index, intersection) in network.intersections.iter().enumerate() {
        builder.add(intersection.center, WaypointKind::Intersection(IntersectionId::from_index(index)));
    }
    for road in &network.roads {
        let length = polyline::length(&road.centerline);
        let (from, to) = (WaypointId(road.from.0), WaypointId(road.to.0));
        if !road.forward.is_empty() {
            builder.join_one_way(from, to, length, road.width);
        }
        if !road.backward.is_empty() {
            builder.join_one_way(to, from, length, road.width);
        }
    }
    builder.finish()
}

/// Places along a path, its ends and corners included, at most `step` apart.
fn interpolated(path: &[Point2], step: f64) -> Vec<Point2> {
    let mut places: Vec<Point2> = path.first().copied().into_iter().collect();
    for pair in path.windows(2) {
        let piece = pair[1] - pair[0];
        let count = (piece.norm() / step).ceil().max(1.0);
        places.extend((1..=count as u64).map(|index| pair[0] + piece * (index as f64 / count)));
    }
    places
}

/// All but the first and the last.
fn inner<T>(items: &[T]) -> &[T] {
    if items.len() < 2 { &[] } else { &items[1..items.len() - 1] }
}

/// The first and last waypoint of a sidewalk or lane.
type Ends = (WaypointId, WaypointId);

pub(super) fn walkable(network: &RoadNetwork, config: &WaypointConfig) -> WaypointGraph {
    let mut builder = Builder::default();
    let mut ends: Vec<Ends> = Vec::with_capacity(network.sidewalks.len());
    for sidewalk in &network.sidewalks {
        let path = shifted(&sidewalk.path, sidewalk.side, config.offset);
        let walk = builder.add_all(&interpolated(&path, config.step), WaypointKind::Sidewalk);
        for pair in walk.windows(2) {
            builder.join(pair[0], pair[1], sidewalk.width, None);
        }
        // A sidewalk has at least two points, so its walk is not empty.
        ends.push((walk[0], walk[walk.len() - 1]));
    }
    for (index, _) in network.intersections.iter().enumerate() {
        join_corners(&mut builder, network, IntersectionId::from_index(index), &ends, config.step);
    }
    for (index, _) in network.crossings.iter().enumerate() {
        join_crossing(&mut builder, network, CrossingId::from_index(index), &ends);
    }
    add_footpaths(&mut builder, network, config.step);
    builder.finish()
}

/// Ways for walkers alone: joined where they share an end, and to the nearest sidewalk where one is near an end that joins.
fn add_footpaths(builder: &mut Builder, network: &RoadNetwork, step: f64) {
    if network.footpaths.is_empty() {
        return;
    }
    let walks = PointGrid::new(builder.waypoints.iter().map(|waypoint| waypoint.position).collect(), CELL);
    // The waypoint at each end, and whether it leads to a sidewalk.
    let mut ends: BTreeMap<[u64; 2], (WaypointId, bool)> = BTreeMap::new();
    let heights = network.footpath_heights();
    for (index, footpath) in network.footpaths.iter().enumerate() {
        let profile = heights.profile(index);
        let mut places = interpolated(&with_bends(&footpath.path, profile), step);
        let kind = footpath.plaza.map_or(WaypointKind::Footpath, WaypointKind::Plaza);
        if let ([from, to], true) = (&places[..], footpath.plaza.is_some()) {
            // Those on it are known by its middle.
            places = vec![*from, nalgebra::center(from, to), *to];
        }
        if let (Some(place), Some(end)) = (places.last_mut(), footpath.path.last()) {
            // To the bit, for others know the end by it.
            *place = *end;
        }
        let mut last: Option<WaypointId> = None;
        let mut station = 0.0;
        for (rank, place) in places.iter().enumerate() {
            let is_end = rank == 0 || rank + 1 == places.len();
            let key = [place.x.to_bits(), place.y.to_bits()];
            let known = ends.get(&key).copied().filter(|_| is_end);
            let kind = if is_end { WaypointKind::Footpath } else { kind };
            station += rank.checked_sub(1).map_or(0.0, |before| (place - places[before]).norm());
            let (here, is_joined) =
                known.unwrap_or_else(|| (builder.add_at(*place, heights.at(index, station), kind), false));
            if is_end {
                let joins = !is_joined && footpath.joins[usize::from(rank > 0)];
                ends.insert(key, (here, is_joined || joins));
                let near = walks.nearest(*place).filter(|_| joins).map(WaypointId::from_index);
                let near =
                    near.filter(|near| (builder.waypoints[near.index()].position - place).norm() <= JOINS);
                if let Some(near) = near {
                    builder.join(here, near, footpath.width, None);
                }
            }
            if let Some(last) = last.filter(|last| *last != here) {
                builder.join(last, here, footpath.width, None);
            }
            last = Some(here);
        }
    }
}

/// The path with points where its height bends, so that it is straight between any two.
fn with_bends(path: &[Point2], profile: &[(f64, f64)]) -> Vec<Point2> {
    let mut bent = Vec::with_capacity(path.len() + profile.len());
    let mut station = 0.0;
    let mut bends = profile.iter().map(|(station, _)| *station).peekable();
    for pair in path.windows(2) {
        let piece = pair[1] - pair[0];
        let span = piece.norm();
        bent.push(pair[0]);
        while let Some(bend) = bends.next_if(|bend| *bend < station + span - BEND) {
            if bend > station + BEND {
                bent.push(pair[0] + piece * ((bend - station) / span));
            }
        }
        station += span;
    }
    bent.extend(path.last());
    bent
}

/// The path moved away from the road between its ends, which stay.
fn shifted(path: &[Point2], side: Side, offset: f64) -> Vec<Point2> {
    let (Some(first), Some(last)) = (path.first(), path.last()) else { return Vec::new() };
    if offset == 0.0 {
        return path.to_vec();
    }
    let outwards = if side == Side::Left { offset } else { -offset };
    let mut moved = vec![*first];
    moved.extend(polyline::offset(path, outwards));
    moved.push(*last);
    moved
}

/// The waypoint at which a road's sidewalk ends at an intersection; sides are seen from the intersection.
fn walk_end(
    network: &RoadNetwork,
    at: IntersectionId,
    road: RoadId,
    side: Side,
    ends: &[Ends],
) -> Option<WaypointId> {
    let road = &network.roads[road.index()];
    let at_start = road.from == at;
    let on_left = (side == Side::Left) == at_start;
    let sidewalk = road.sidewalks[usize::from(!on_left)]?;
    let (first, last) = ends.get(sidewalk.index())?;
    Some(if at_start { *first } else { *last })
}

fn join_corners(builder: &mut Builder, network: &RoadNetwork, at: IntersectionId, ends: &[Ends], step: f64) {
    let intersection = &network.intersections[at.index()];
    for (index, corner) in intersection.corners.iter().enumerate() {
        let (road, next) =
            (intersection.roads[index], intersection.roads[(index + 1) % intersection.roads.len()]);
        let from = walk_end(network, at, road, Side::Left, ends);
        let to = walk_end(network, at, next, Side::Right, ends);
        let (Some(from), Some(to)) = (from, to) else { continue };
        let width = narrower(network, road, next);
        let mut last = from;
        // The ends of the walkway are the ends of the sidewalks, which are waypoints already.
        for place in inner(&interpolated(corner, step)) {
            let waypoint = builder.add(*place, WaypointKind::Sidewalk);
            builder.join(last, waypoint, width, None);
            last = waypoint;
        }
        builder.join(last, to, width, None);
    }
}

/// Width of the narrowest sidewalk of two roads, m.
fn narrower(network: &RoadNetwork, a: RoadId, b: RoadId) -> f64 {
    let sidewalks = [a, b].into_iter().flat_map(|road| network.roads[road.index()].sidewalks);
    let widths = sidewalks.flatten().map(|id| network.sidewalks[id.index()].width);
    widths.fold(f64::INFINITY, f64::min)
}

fn join_crossing(builder: &mut Builder, network: &RoadNetwork, id: CrossingId, ends: &[Ends]) {
    let crossing = &network.crossings[id.index()];
    let left = walk_end(network, crossing.intersection, crossing.road, Side::Left, ends);
    let right = walk_end(network, crossing.intersection, crossing.road, Side::Right, ends);
    let (Some(left), Some(right)) = (left, right) else { return };
    let start = builder.add(crossing.start, WaypointKind::Kerb(id));
    let end = builder.add(crossing.end, WaypointKind::Kerb(id));
    builder.join(left, start, crossing.width, None);
    builder.join(start, end, crossing.width, Some(id));
    builder.join(end, right, crossing.width, None);
}

pub(super) fn drivable(network: &RoadNetwork, config: &WaypointConfig) -> WaypointGraph {
    let mut builder = Builder::default();
    // Of lanes for bicycles none.
    let mut ends: Vec<Option<Ends>> = vec![None; network.lanes.len()];
    for (index, lane) in network.lanes.iter().enumerate().filter(|(_, lane)| lane.is_driven()) {
        let offset = polyline::offset(&lane.path, -config.offset);
        let kind = WaypointKind::Lane(LaneId::from_index(index));
        let way = builder.add_all(&interpolated(&offset, config.step), kind);
        drive(&mut builder, &way, lane.width);
        // A lane has at least two points, so its way is not empty.
        ends[index] = Some((way[0], way[way.len() - 1]));
    }
    for connection in &network.connections {
        let (Some(from), Some(to)) = (ends[connection.from.index()], ends[connection.to.index()]) else {
            continue;
        };
        let kind = WaypointKind::Lane(connection.from);
        let way = builder.add_all(inner(&coarsened(&connection.path, config.step)), kind);
        let whole: Vec<WaypointId> = [from.1].into_iter().chain(way).chain([to.0]).collect();
        drive(&mut builder, &whole, network.lanes[connection.from.index()].width);
    }
    builder.finish()
}

/// A finely sampled path with points about `step` apart, ends included.
fn coarsened(path: &[Point2], step: f64) -> Vec<Point2> {
    let length = polyline::length(path);
    let count = (length / step).ceil().max(2.0);
    (0..=count as u64).map(|index| polyline::at(path, length * index as f64 / count).0).collect()
}

fn drive(builder: &mut Builder, way: &[WaypointId], width: f64) {
    for pair in way.windows(2) {
        let apart: Vector2 =
            builder.waypoints[pair[1].index()].position - builder.waypoints[pair[0].index()].position;
        builder.join_one_way(pair[0], pair[1], apart.norm(), width);
    }
}
