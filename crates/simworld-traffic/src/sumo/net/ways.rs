//! Connections: their course along the internal lanes, and who gives way to whom.

use std::collections::BTreeMap;

use simworld_core::geometry::Point2;
use simworld_core::id::{ConnectionId, IntersectionId, LaneId};
use simworld_core::net::{NetworkBuilder, Turn};

use super::build::{Build, EdgeKind};
use super::raw::{Connection, Junction, Raw, Request};
use crate::sumo::{SumoError, SumoWarning};

/// Points nearer than this are one, m.
const SAME: f64 = 1e-3;

/// A connection that was built, with what the junction knows of it.
pub(super) struct Way {
    pub(super) id: ConnectionId,
    pub(super) from: LaneId,
    pub(super) to: LaneId,
    pub(super) place: IntersectionId,
    /// Its index among the links of the junction.
    pub(super) link: Option<usize>,
    pub(super) light: Option<(String, usize)>,
}

/// The internal lanes that follow an internal lane: where connections from it lead.
fn successors(raw: &Raw) -> BTreeMap<&str, &str> {
    let is_internal = |connection: &&Connection| connection.from.starts_with(':');
    let next = raw.connections.iter().filter(is_internal).filter_map(|connection| {
        let via = connection.via.as_deref()?;
        Some((connection.from.as_str(), connection.lanes.0, via))
    });
    let mut lanes: BTreeMap<&str, &str> = BTreeMap::new();
    let edges: BTreeMap<&str, usize> =
        raw.edges.iter().enumerate().map(|(index, edge)| (edge.id.as_str(), index)).collect();
    for (edge, lane, via) in next {
        if let Some(lane) = edges.get(edge).and_then(|edge| raw.edges[*edge].lanes.get(lane)) {
            lanes.insert(&lane.id, via);
        }
    }
    lanes
}

/// Builds all connections between lanes for vehicles.
pub(super) fn build(build: &mut Build, raw: &Raw) -> Result<Vec<Way>, SumoError> {
    let next = successors(raw);
    let lanes: BTreeMap<&str, &[Point2]> = raw
        .edges
        .iter()
        .flat_map(|edge| &edge.lanes)
        .map(|lane| (lane.id.as_str(), lane.shape.points.as_slice()))
        .collect();
    let mut links: BTreeMap<&str, usize> = BTreeMap::new();
    // Junctions within others list the internal lanes that cross them, which are links of the one about them.
    for junction in raw.junctions.iter().filter(|junction| junction.kind != "internal") {
        links.extend(junction.internal_lanes.iter().enumerate().map(|(link, lane)| (lane.as_str(), link)));
    }
    let mut ways = Vec::new();
    for connection in &raw.connections {
        let Some((from, to)) = build.ends(raw, connection)? else { continue };
        let course = course(raw, connection, &next, &lanes)?;
        let link = course.iter().find_map(|lane| links.get(lane)).copied();
        let shapes = course.iter().filter_map(|lane| lanes.get(lane).copied());
        let path = joined(&build.builder, from, to, shapes);
        let id = build.builder.add_connection(from, to, turn(connection.direction), path);
        let name = course
            .first()
            .map_or_else(|| format!("{}_{}", connection.from, connection.to), |via| (*via).to_owned());
        build.names.connections.push(name);
        let place = build.builder.network().lanes[from.index()].to;
        ways.push(Way { id, from, to, place, link, light: connection.light.clone() });
    }
    Ok(ways)
}

/// The internal lanes of a connection, one after the other.
fn course<'a>(
    raw: &Raw,
    connection: &'a Connection,
    next: &BTreeMap<&'a str, &'a str>,
    lanes: &BTreeMap<&str, &[Point2]>,
) -> Result<Vec<&'a str>, SumoError> {
    let mut course: Vec<&str> = Vec::new();
    let mut via = connection.via.as_deref();
    while let Some(lane) = via {
        if !lanes.contains_key(lane) {
            return Err(SumoError::Dangling {
                element: "connection",
                id: format!("{} -> {}", connection.from, connection.to),
                what: "internal lane",
                target: lane.to_owned(),
            });
        }
        if course.contains(&lane) || course.len() > raw.edges.len() {
            return Err(SumoError::Circle { lane: format!("{}_{}", connection.from, connection.lanes.0) });
        }
        course.push(lane);
        via = next.get(lane).copied();
    }
    Ok(course)
}

/// The path from the end of a lane along internal lanes to the beginning of another; `None` without internal lanes.
fn joined<'a>(
    builder: &NetworkBuilder,
    from: LaneId,
    to: LaneId,
    shapes: impl Iterator<Item = &'a [Point2]>,
) -> Option<Vec<Point2>> {
    let [entry, exit] = [from, to].map(|lane| &builder.network().lanes[lane.index()].path);
    let (start, end) = (entry.last()?, exit.first()?);
    let mut path = vec![*start];
    let mut count = 0;
    for point in shapes.flatten() {
        count += 1;
        if path.last().is_none_or(|last| (last - point).norm() > SAME) {
            path.push(*point);
        }
    }
    if path.len() < 2 || path.last().is_some_and(|last| (last - end).norm() > SAME) {
        path.push(*end);
    }
    (count > 0).then_some(path)
}

fn turn(direction: u8) -> Turn {
    match direction {
        b'r' | b'R' => Turn::Right,
        b'l' | b'L' => Turn::Left,
        b't' | b'T' => Turn::UTurn,
        _ => Turn::Straight,
    }
}

impl Build {
    /// The lanes that a connection joins; `None` if it is none for vehicles.
    fn ends(&self, raw: &Raw, connection: &Connection) -> Result<Option<(LaneId, LaneId)>, SumoError> {
        let id = || format!("{} -> {}", connection.from, connection.to);
        let dangling =
            |target: String, what| Err(SumoError::Dangling { element: "connection", id: id(), what, target });
        let mut found = [None; 2];
        let ends = [(&connection.from, connection.lanes.0), (&connection.to, connection.lanes.1)];
        for (end, (edge, lane)) in found.iter_mut().zip(ends) {
            match self.edges.get(edge.as_str()) {
                None => return dangling(edge.clone(), "edge"),
                Some(EdgeKind::OfJunction) => return Ok(None),
                Some(EdgeKind::Road(index)) => {
                    let Some(raw_lane) = raw.edges[*index].lanes.get(lane) else {
                        return dangling(format!("{edge}_{lane}"), "lane");
                    };
                    *end = self.lanes.get(&raw_lane.id).copied();
                }
            }
        }
        let [Some(from), Some(to)] = found else { return Ok(None) };
        let lanes = &self.builder.network().lanes;
        if lanes[from.index()].to != lanes[to.index()].from {
            return dangling(connection.to.clone(), "an edge of another junction,");
        }
        Ok(Some((from, to)))
    }

    /// Takes over the right-of-way requests of every junction.
    pub(super) fn settle(&mut self, raw: &Raw, ways: &[Way]) {
        let mut at: Vec<Vec<&Way>> = vec![Vec::new(); self.builder.network().intersections.len()];
        for way in ways {
            at[way.place.index()].push(way);
        }
        for (index, junction) in raw.junctions.iter().enumerate() {
            let Some(place) = self.places[index] else { continue };
            let own = &at[place.index()];
            let requests: BTreeMap<usize, &Request> =
                junction.requests.iter().map(|request| (request.index, request)).collect();
            let known = own.iter().all(|way| way.link.is_some_and(|link| requests.contains_key(&link)));
            if own.is_empty() || !known {
                self.warn_of_requests(junction, own.len());
                continue;
            }
            self.builder.settle(place);
            for (rank, a) in own.iter().enumerate() {
                for b in &own[rank + 1..] {
                    self.meet(&requests, a, b);
                }
            }
        }
    }

    fn warn_of_requests(&mut self, junction: &Junction, ways: usize) {
        if ways > 1 {
            let reason = "has no right-of-way requests: who gives way was worked out from shapes and turns";
            self.warnings.push(SumoWarning::new("junction", &junction.id, reason));
        }
    }

    fn meet(&mut self, requests: &BTreeMap<usize, &Request>, a: &Way, b: &Way) {
        // From one lane it is one file of vehicles.
        let (Some(first), Some(second)) = (a.link, b.link) else { return };
        if a.from == b.from {
            return;
        }
        let (own, other) = (requests[&first], requests[&second]);
        let yields = (Request::has(&own.response, second), Request::has(&other.response, first));
        let foes = Request::has(&own.foes, second) || Request::has(&other.foes, first);
        if !(foes || yields.0 || yields.1 || a.to == b.to) {
            return;
        }
        let gives_way = match yields {
            (true, false) => Some(a.id),
            // Both give way where all must stop: here the later link does.
            (_, true) => Some(b.id),
            (false, false) => None,
        };
        self.builder.add_conflict(a.id, b.id, gives_way);
    }
}
