//! The two-level waypoint graph of the paper: coarse waypoints at junctions and centrelines, fine ones interpolated
//! along lanes and sidewalks; and shortest paths over both.

use serde::{Deserialize, Serialize};

use super::RoadNetwork;
use crate::geometry::Point2;
use crate::id::{CrossingId, IntersectionId, WaypointId};

/// What a waypoint stands on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum WaypointKind {
    /// The middle of an intersection (coarse level).
    Intersection(IntersectionId),
    /// A sidewalk.
    Sidewalk,
    /// One kerb of a crossing.
    Kerb(CrossingId),
}

/// A place one can be at.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Waypoint {
    /// Where, m.
    pub position: Point2,
    /// On what.
    pub kind: WaypointKind,
}

/// A way from one waypoint to another.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct WaypointEdge {
    /// Where it leads.
    pub to: WaypointId,
    /// Length, m.
    pub length: f64,
    /// The crossing it uses, if it crosses a road.
    pub crossing: Option<CrossingId>,
}

/// How fine the fine level is.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct WaypointConfig {
    /// Distance between fine waypoints along a way, m, in [0.5, 1000].
    pub step: f64,
    /// Lateral offset of the fine waypoints from the middle of the sidewalk, away from the road, m.
    pub offset: f64,
}

impl Default for WaypointConfig {
    fn default() -> Self {
        Self { step: 10.0, offset: 0.0 }
    }
}

/// A graph of waypoints on which routes are found.
#[derive(Clone, Debug, Default)]
pub struct WaypointGraph {
    _waypoints: Vec<Waypoint>,
}

/// A route: where it passes, and how long it is.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Route {
    /// The waypoints passed, first to last.
    pub waypoints: Vec<WaypointId>,
    /// Length from the first waypoint to the last, m.
    pub length: f64,
}

/// The memory of a route search, kept by the caller so that searches after the first allocate nothing.
#[derive(Clone, Debug, Default)]
pub struct RouteScratch {}

impl WaypointGraph {
    /// The coarse level: intersections, joined by roads.
    pub fn coarse(_network: &RoadNetwork) -> Self {
        todo!("in work")
    }

    /// The fine level for walkers: sidewalks, the corners that join them, and crossings.
    pub fn walkable(_network: &RoadNetwork, _config: &WaypointConfig) -> Self {
        todo!("in work")
    }

    /// The waypoints, indexed by [`WaypointId`].
    pub fn waypoints(&self) -> &[Waypoint] {
        &self._waypoints
    }

    /// The ways on from a waypoint.
    pub fn edges(&self, _from: WaypointId) -> &[WaypointEdge] {
        todo!("in work")
    }

    /// The waypoint nearest to a point; `None` in an empty graph.
    pub fn nearest(&self, _point: Point2) -> Option<WaypointId> {
        todo!("in work")
    }

    /// The shortest route (A*, ties by lower waypoint id), written over `route`; false if there is none.
    pub fn route(
        &self,
        _from: WaypointId,
        _to: WaypointId,
        _scratch: &mut RouteScratch,
        _route: &mut Route,
    ) -> bool {
        todo!("in work")
    }
}
