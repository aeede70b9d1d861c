//! From the parts of a file to a network.

use std::collections::{BTreeMap, BTreeSet};

use simworld_core::geometry::Point2;
use simworld_core::id::{IntersectionId, LaneId, RoadId};
use simworld_core::net::{
    DrivingSide, LaneDirection, LaneKind, NetworkBuilder, NewLane, NewRoad, RoadClass, polyline,
};

use super::pair::{Pair, pairs};
use super::raw::{Edge, Function, Lane, Raw, Usage};
use super::{SumoNet, SumoPrograms, ways};
use crate::sumo::{SumoError, SumoWarning};
use crate::{Leg, NetworkNames};

/// Fastest speed limit, m/s.
const FASTEST: f64 = 200.0;
/// Speeds below this are as good as none, m/s.
const SLOWEST: f64 = 0.1;
/// A length that differs from that of the shape by more than this share is one of its own.
const OWN_LENGTH: f64 = 0.1;

/// What an edge of the file became.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum EdgeKind {
    /// A direction of a road; the index of the edge in the file.
    Road(usize),
    /// A part of a junction.
    OfJunction,
}

/// A network under construction.
pub(super) struct Build {
    pub(super) builder: NetworkBuilder,
    pub(super) names: NetworkNames,
    pub(super) warnings: Vec<SumoWarning>,
    pub(super) edges: BTreeMap<String, EdgeKind>,
    /// Lanes for vehicles by their ids.
    pub(super) lanes: BTreeMap<String, LaneId>,
    /// The roads of edges.
    pub(super) roads: BTreeMap<String, RoadId>,
    /// Of each junction of the file its intersection; none for those within others.
    pub(super) places: Vec<Option<IntersectionId>>,
    pub(super) side: DrivingSide,
    pub(super) programs: SumoPrograms,
}

/// Builds the network of a file.
pub(super) fn build(raw: Raw) -> Result<SumoNet, SumoError> {
    let side = if raw.lefthand { DrivingSide::Left } else { DrivingSide::Right };
    let mut build = Build {
        builder: NetworkBuilder::new(side),
        names: NetworkNames::default(),
        warnings: Vec::new(),
        edges: edge_kinds(&raw)?,
        lanes: BTreeMap::new(),
        roads: BTreeMap::new(),
        places: Vec::new(),
        side,
        programs: SumoPrograms::default(),
    };
    let junctions = build.add_junctions(&raw)?;
    let pairs = pairs(&raw.edges, side);
    if pairs.is_empty() {
        return Err(SumoError::Empty);
    }
    let rings: BTreeSet<&str> = raw.rings.iter().map(String::as_str).collect();
    for pair in pairs {
        build.add_road(&raw, pair, &junctions, &rings)?;
    }
    let ways = ways::build(&mut build, &raw)?;
    build.settle(&raw, &ways);
    let crossings = build.add_crossings(&raw);
    build.add_signals(&raw, &ways, &crossings)?;
    let Build { builder, names, mut warnings, programs, .. } = build;
    let network = builder.finish()?;
    warnings.sort();
    let names = names.indexed();
    let Raw { offset, projection, .. } = raw;
    Ok(SumoNet { network, names, programs, warnings, offset, projection })
}

fn edge_kinds(raw: &Raw) -> Result<BTreeMap<String, EdgeKind>, SumoError> {
    let mut kinds = BTreeMap::new();
    for (index, edge) in raw.edges.iter().enumerate() {
        let kind =
            if edge.function == Function::Normal { EdgeKind::Road(index) } else { EdgeKind::OfJunction };
        if kinds.insert(edge.id.clone(), kind).is_some() {
            return Err(SumoError::Twice { element: "edge", id: edge.id.clone() });
        }
    }
    let mut lanes = BTreeSet::new();
    for lane in raw.edges.iter().flat_map(|edge| &edge.lanes) {
        if !lanes.insert(&lane.id) {
            return Err(SumoError::Twice { element: "lane", id: lane.id.clone() });
        }
    }
    Ok(kinds)
}

impl Build {
    fn add_junctions<'a>(&mut self, raw: &'a Raw) -> Result<BTreeMap<&'a str, IntersectionId>, SumoError> {
        let mut junctions = BTreeMap::new();
        for junction in &raw.junctions {
            // Where a vehicle waits within a junction is a part of a way here.
            if junction.kind == "internal" {
                self.places.push(None);
                continue;
            }
            let outline = junction.outline.points.clone();
            let place = self.builder.add_intersection(junction.center, junction.height, outline);
            if matches!(junction.kind.as_str(), "priority_stop" | "allway_stop") {
                self.builder.set_stop(place);
            }
            if junctions.insert(junction.id.as_str(), place).is_some() {
                return Err(SumoError::Twice { element: "junction", id: junction.id.clone() });
            }
            self.places.push(Some(place));
            self.names.junctions.push(junction.id.clone());
        }
        Ok(junctions)
    }

    fn add_road(
        &mut self,
        raw: &Raw,
        pair: Pair,
        junctions: &BTreeMap<&str, IntersectionId>,
        rings: &BTreeSet<&str>,
    ) -> Result<(), SumoError> {
        let edge = &raw.edges[pair.along];
        let end = |id: &str| {
            junctions.get(id).copied().ok_or_else(|| SumoError::Dangling {
                element: "edge",
                id: edge.id.clone(),
                what: "junction",
                target: id.to_owned(),
            })
        };
        let ends = (end(&edge.from)?, end(&edge.to)?);
        let places = &self.builder.network().intersections;
        let (centerline, profile) =
            centerline(edge, places[ends.0.index()].center, places[ends.1.index()].center);
        let road = self.builder.add_road(NewRoad {
            class: class(edge),
            ends,
            centerline,
            name: edge.name.clone(),
            profile,
            roundabout: rings.contains(edge.id.as_str()),
        });
        let back = pair.against.map(|index| &raw.edges[index]);
        self.names.edges.resize((road.index() + 1) * 2, String::new());
        for (direction, edge) in [(LaneDirection::Forward, Some(edge)), (LaneDirection::Backward, back)] {
            let Some(edge) = edge else { continue };
            self.names.edges[Leg::new(road, direction).index()].clone_from(&edge.id);
            self.roads.insert(edge.id.clone(), road);
            self.add_lanes(edge, road, direction)?;
        }
        self.add_cycle_lanes(edge, back, road)
    }

    /// The lanes for motor vehicles of an edge, from the middle outwards, and its sidewalk.
    fn add_lanes(&mut self, edge: &Edge, road: RoadId, direction: LaneDirection) -> Result<(), SumoError> {
        for lane in edge.lanes.iter().rev() {
            match lane.usage {
                Usage::Cars => self.add_lane(lane, LaneKind::Driving, road, direction)?,
                Usage::Buses => self.add_lane(lane, LaneKind::Bus, road, direction)?,
                Usage::People => self.add_walk(edge, lane, road, direction),
                Usage::Bicycles => {}
                Usage::Others => {
                    let reason = "is for none of cars, buses, bicycles and people: it was left out";
                    self.warnings.push(SumoWarning::new("lane", &lane.id, reason));
                }
            }
        }
        Ok(())
    }

    /// Those for bicycles, from left to right along the centreline.
    fn add_cycle_lanes(&mut self, edge: &Edge, back: Option<&Edge>, road: RoadId) -> Result<(), SumoError> {
        let against =
            back.into_iter().flat_map(|edge| &edge.lanes).map(|lane| (lane, LaneDirection::Backward));
        let along = edge.lanes.iter().rev().map(|lane| (lane, LaneDirection::Forward));
        let cycle = |lane: &(&Lane, LaneDirection)| lane.0.usage == Usage::Bicycles;
        let mut lanes: Vec<(&Lane, LaneDirection)> = against.chain(along).filter(cycle).collect();
        if self.side == DrivingSide::Left {
            lanes.reverse();
        }
        lanes.into_iter().try_for_each(|(lane, way)| self.add_lane(lane, LaneKind::Cycle, road, way))
    }

    fn add_lane(
        &mut self,
        lane: &Lane,
        kind: LaneKind,
        road: RoadId,
        direction: LaneDirection,
    ) -> Result<(), SumoError> {
        let path = lane.shape.points.clone();
        let length = polyline::length(&path);
        let refused = |attribute, reason: &'static str| {
            let (element, id) = ("lane".to_owned(), lane.id.clone());
            Err(SumoError::Attribute { element, id, attribute, reason: reason.into() })
        };
        if length < 0.01 {
            return refused("shape", "has no length: give points that are apart");
        }
        if !(0.1..=100.0).contains(&lane.width) {
            return refused("width", "is out of range: give 0.1 to 100 m");
        }
        if (lane.length - length).abs() > OWN_LENGTH * length.max(1.0) {
            let reason = format!("is {} m long, its shape {length:.2} m: the shape counts", lane.length);
            self.warnings.push(SumoWarning::new("lane", &lane.id, reason));
        }
        let speed_limit = lane.speed.clamp(SLOWEST, FASTEST);
        if speed_limit != lane.speed {
            let reason = format!("has a speed of {} m/s: it was made {speed_limit}", lane.speed);
            self.warnings.push(SumoWarning::new("lane", &lane.id, reason));
        }
        let id =
            self.builder.add_lane(road, NewLane { kind, direction, path, width: lane.width, speed_limit });
        self.lanes.insert(lane.id.clone(), id);
        self.names.lanes.push(lane.id.clone());
        Ok(())
    }
}

/// The middle of a road from junction to junction, with the heights on its way.
fn centerline(edge: &Edge, from: Point2, to: Point2) -> (Vec<Point2>, Vec<(f64, f64)>) {
    let mut points = edge.shape.points.clone();
    let mut profile = Vec::new();
    if points.len() > 2 && edge.shape.heights.iter().any(|height| *height != 0.0) {
        let mut station = 0.0;
        for (pair, height) in points.windows(2).zip(&edge.shape.heights[1..]) {
            station += (pair[1] - pair[0]).norm();
            profile.push((station, *height));
        }
        // The ends have the heights of the junctions.
        profile.pop();
        profile.dedup_by(|a, b| a.0 <= b.0);
    }
    if points.len() < 2 {
        points = vec![from, to];
    }
    if polyline::length(&points) < 0.01 {
        points = edge.lanes.first().map_or(points, |lane| lane.shape.points.clone());
        profile.clear();
    }
    (points, profile)
}

/// The rank of a road: by the type of its edge, which netconvert takes over from OpenStreetMap, or else by its priority.
fn class(edge: &Edge) -> RoadClass {
    let is = |names: &[&str]| names.iter().any(|name| edge.kind.contains(name));
    match () {
        () if is(&["motorway", "trunk"]) => RoadClass::Highway,
        () if is(&["primary", "secondary", "tertiary"]) => RoadClass::Arterial,
        () if !edge.kind.is_empty() => RoadClass::Local,
        () if edge.priority >= 13.0 => RoadClass::Highway,
        () if edge.priority >= 7.0 => RoadClass::Arterial,
        () => RoadClass::Local,
    }
}
