//! Sidewalks and crossings.

use std::collections::BTreeMap;

use simworld_core::geometry::{Point2, Vector2};
use simworld_core::id::{CrossingId, IntersectionId, RoadId};
use simworld_core::net::{DrivingSide, LaneDirection, Side, polyline};

use super::build::Build;
use super::raw::{Edge, Function, Lane, Raw};
use crate::sumo::SumoWarning;

/// A crossing that was built.
pub(super) struct Walk {
    pub(super) id: CrossingId,
    pub(super) place: IntersectionId,
    pub(super) light: Option<(String, usize)>,
}

impl Build {
    /// The outermost lane for people becomes the sidewalk of its side.
    pub(super) fn add_walk(&mut self, edge: &Edge, lane: &Lane, road: RoadId, direction: LaneDirection) {
        let is_outermost = edge.lanes.first().is_some_and(|first| first.id == lane.id);
        if !is_outermost || polyline::length(&lane.shape.points) < 0.01 {
            let reason = "is for people but not the outermost: it was left out";
            self.warnings.push(SumoWarning::new("lane", &lane.id, reason));
            return;
        }
        let along = direction != LaneDirection::Backward;
        let side = match (self.side, along) {
            (DrivingSide::Right, true) | (DrivingSide::Left, false) => Side::Right,
            _ => Side::Left,
        };
        let path = if along { lane.shape.points.clone() } else { polyline::reversed(&lane.shape.points) };
        self.builder.add_sidewalk(road, side, path, lane.width.clamp(0.1, 100.0));
    }

    /// All crossings of roads that are here.
    pub(super) fn add_crossings(&mut self, raw: &Raw) -> Vec<Walk> {
        let mut lights: BTreeMap<&str, &(String, usize)> = BTreeMap::new();
        for connection in &raw.connections {
            if let Some(light) = &connection.light {
                lights.entry(&connection.to).or_insert(light);
            }
        }
        let mut places: BTreeMap<&str, IntersectionId> = BTreeMap::new();
        for (junction, place) in raw.junctions.iter().zip(&self.places) {
            let Some(place) = place else { continue };
            places.extend(junction.internal_lanes.iter().map(|lane| (lane.as_str(), *place)));
        }
        let mut walks = Vec::new();
        for edge in raw.edges.iter().filter(|edge| edge.function == Function::Crossing) {
            let found = edge.lanes.first().and_then(|lane| Some((lane, *places.get(lane.id.as_str())?)));
            let Some((lane, place)) = found else {
                self.warn_of_crossing(edge, "is at no junction: it was left out");
                continue;
            };
            if let Some(id) = self.add_crossing(edge, lane, place) {
                let light = lights.get(edge.id.as_str()).map(|light| (*light).clone());
                walks.push(Walk { id, place, light });
            }
        }
        walks
    }

    fn add_crossing(&mut self, edge: &Edge, lane: &Lane, place: IntersectionId) -> Option<CrossingId> {
        let mut roads: Vec<RoadId> =
            edge.crossed.iter().filter_map(|edge| self.roads.get(edge)).copied().collect();
        roads.sort_unstable();
        roads.dedup();
        if roads.len() > 1 {
            self.warn_of_crossing(edge, "crosses several roads: it leads over the first of them");
        }
        let Some(road) = roads.first().copied() else {
            self.warn_of_crossing(edge, "crosses no road: it was left out");
            return None;
        };
        let (start, end) = (*lane.shape.points.first()?, *lane.shape.points.last()?);
        let out = self.leaving(road, place);
        let is_left = out.perp(&(start - end)) > 0.0;
        let ends = if is_left { (start, end) } else { (end, start) };
        Some(self.builder.add_crossing(place, road, ends, lane.width.clamp(0.1, 100.0)))
    }

    /// The direction in which a road leaves an intersection.
    fn leaving(&self, road: RoadId, place: IntersectionId) -> Vector2 {
        let road = &self.builder.network().roads[road.index()];
        let line = &road.centerline;
        let piece = |a: &Point2, b: &Point2| b - a;
        if road.from == place {
            piece(&line[0], &line[1])
        } else {
            piece(&line[line.len() - 1], &line[line.len() - 2])
        }
    }

    fn warn_of_crossing(&mut self, edge: &Edge, reason: &'static str) {
        self.warnings.push(SumoWarning::new("crossing", &edge.id, reason));
    }
}
