//! The two-level waypoint graph of the paper: coarse waypoints at junctions, fine ones interpolated along sidewalks
//! and lanes; and shortest paths over both.

mod build;
#[cfg(feature = "hierarchy")]
mod hierarchy;
mod route;
#[cfg(feature = "petgraph")]
mod visit;

use serde::{Deserialize, Serialize};

use super::{NetworkError, RoadNetwork};
use crate::geometry::Point2;
use crate::grid::PointGrid;
use crate::id::{CrossingId, IntersectionId, LaneId, PlazaId, WaypointId};
#[cfg(feature = "hierarchy")]
pub use hierarchy::RouteHierarchy;
pub use route::{Route, RouteScratch};

/// What a waypoint stands on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum WaypointKind {
    /// The middle of an intersection (coarse level).
    Intersection(IntersectionId),
    /// A sidewalk, or the walkway round a corner.
    Sidewalk,
    /// One kerb of a crossing.
    Kerb(CrossingId),
    /// A lane, or a way across an intersection that begins at its end.
    Lane(LaneId),
    /// A way for walkers alone.
    Footpath,
    /// The middle of a way across a plaza: an edge that begins or ends there lies on the plaza.
    Plaza(PlazaId),
}

/// A place one can be at.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Waypoint {
    /// Where, m.
    pub position: Point2,
    /// On what.
    pub kind: WaypointKind,
}

/// A way from one waypoint to another.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct WaypointEdge {
    /// Where it leads.
    pub to: WaypointId,
    /// Length, m.
    pub length: f64,
    /// The crossing it uses, if it crosses a road.
    pub crossing: Option<CrossingId>,
    /// Width of the walkway, lane or road that it follows, m; in single precision, where it takes no room.
    pub width: f32,
}

/// How fine the fine level is.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct WaypointConfig {
    /// Greatest distance between fine waypoints along a way, m, in [0.5, 1000].
    pub step: f64,
    /// Lateral offset of the waypoints between the ends of a sidewalk, away from the road, m, in [-20, 20].
    pub offset: f64,
}

impl Default for WaypointConfig {
    fn default() -> Self {
        Self { step: 10.0, offset: 0.0 }
    }
}

impl WaypointConfig {
    /// Checks both fields against their ranges.
    ///
    /// # Errors
    /// The first field out of range; NaN always is.
    pub fn validate(&self) -> Result<(), NetworkError> {
        let checks = [
            ("step", self.step, 0.5, 1000.0, "0.5 to 1000 m"),
            ("offset", self.offset, -20.0, 20.0, "-20 to 20 m"),
        ];
        for (field, value, low, high, allowed) in checks {
            if !(low..=high).contains(&value) {
                return Err(NetworkError::Config { field, value, allowed });
            }
        }
        Ok(())
    }
}

/// A graph of waypoints on which routes are found.
///
/// ```
/// use simworld_core::geometry::Point2;
/// use simworld_core::net::*;
/// let network = RoadNetwork::derive(&StreetPlan::grid(3, 3, 100.0), &NetworkConfig::default())?;
/// let walks = WaypointGraph::walkable(&network, &WaypointConfig::default())?;
/// let from = walks.nearest(Point2::new(50.0, 5.0)).unwrap();
/// let to = walks.nearest(Point2::new(150.0, 195.0)).unwrap();
/// let (mut scratch, mut route) = (RouteScratch::default(), Route::default());
/// assert!(walks.route(from, to, &mut scratch, &mut route));
/// assert!(route.length > 250.0 && route.length < 400.0);
/// # Ok::<(), NetworkError>(())
/// ```
#[derive(Clone, Debug, Default)]
pub struct WaypointGraph {
    waypoints: Vec<Waypoint>,
    /// The edges of waypoint i are `edges[starts[i]..starts[i + 1]]`.
    starts: Vec<u32>,
    edges: Vec<WaypointEdge>,
    grid: PointGrid,
    /// Of each waypoint above the ground, m; none where all are on it.
    heights: Vec<f64>,
}

/// Who is no farther from a waypoint than this may still be on the way that leads to it, m.
const TURNING: f64 = 1.0;
/// Ways that are so much as near are as near, m.
const SAME: f64 = 1e-6;

impl WaypointGraph {
    /// The coarse level: intersections, joined by roads in the directions in which they may be driven.
    pub fn coarse(network: &RoadNetwork) -> Self {
        build::coarse(network)
    }

    /// The fine level for walkers: sidewalks, the corners that join them, crossings, and ways for walkers alone.
    ///
    /// # Errors
    /// A setting out of range.
    pub fn walkable(network: &RoadNetwork, config: &WaypointConfig) -> Result<Self, NetworkError> {
        config.validate()?;
        Ok(build::walkable(network, config))
    }

    /// The fine level for vehicles: lanes, and the ways across intersections.
    ///
    /// # Errors
    /// A setting out of range.
    pub fn drivable(network: &RoadNetwork, config: &WaypointConfig) -> Result<Self, NetworkError> {
        config.validate()?;
        Ok(build::drivable(network, config))
    }

    /// The waypoints, indexed by [`WaypointId`].
    pub fn waypoints(&self) -> &[Waypoint] {
        &self.waypoints
    }

    /// A waypoint of this graph.
    pub fn waypoint(&self, id: WaypointId) -> &Waypoint {
        &self.waypoints[id.index()]
    }

    /// The ways on from a waypoint of this graph.
    pub fn edges(&self, from: WaypointId) -> &[WaypointEdge] {
        let index = from.index();
        &self.edges[self.starts[index] as usize..self.starts[index + 1] as usize]
    }

    /// The way from one waypoint straight to another, if there is one.
    pub fn edge(&self, from: WaypointId, to: WaypointId) -> Option<&WaypointEdge> {
        self.edges(from).iter().find(|edge| edge.to == to)
    }

    /// Whether all of its waypoints are on the ground.
    pub fn is_level(&self) -> bool {
        self.heights.is_empty()
    }

    /// Height of a waypoint of this graph above the ground, m: more than nothing on footbridges, and on the stairs and ramps
    /// that lead to them (see [`RoadNetwork::footpath_heights`]).
    pub fn height(&self, id: WaypointId) -> f64 {
        self.heights.get(id.index()).copied().unwrap_or(0.0)
    }

    /// Height above the ground at a place beside or on the way from one waypoint straight to another, m. Near either of them it may
    /// be that of another way there, if that is nearer: who turns from one into the next goes up and down evenly, but for sharp
    /// corners that they cut, where it may be a step of stairs.
    pub fn height_between(&self, from: WaypointId, to: WaypointId, at: Point2) -> f64 {
        if self.heights.is_empty() {
            return 0.0;
        }
        let (mut nearest, mut height) = self.beside(from, to, at);
        for (end, other) in [(from, to), (to, from)] {
            if (self.waypoint(end).position - at).norm_squared() > TURNING * TURNING {
                continue;
            }
            for next in self.edges(end).iter().map(|edge| edge.to).filter(|next| *next != other) {
                let (distance, its) = self.beside(end, next, at);
                if distance < nearest - SAME {
                    (nearest, height) = (distance, its);
                }
            }
        }
        height
    }

    /// Distance from the straight way between two waypoints, m, and its height at the nearest place.
    fn beside(&self, from: WaypointId, to: WaypointId, at: Point2) -> (f64, f64) {
        let (a, b) = (self.waypoint(from).position, self.waypoint(to).position);
        let along = b - a;
        let share = ((at - a).dot(&along) / along.norm_squared().max(1e-12)).clamp(0.0, 1.0);
        let (low, high) = (self.height(from), self.height(to));
        ((at - a - along * share).norm(), low + (high - low) * share)
    }

    /// The waypoint nearest to a point, the lower id of two at the same distance; `None` in an empty graph.
    pub fn nearest(&self, point: Point2) -> Option<WaypointId> {
        self.grid.nearest(point).map(WaypointId::from_index)
    }
}
