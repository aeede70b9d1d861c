//! How far it is: along the sidewalks of a scene that has roads, and straight in one that has none.

use std::sync::Arc;

use simworld_core::geometry::{Point2, Point3};
use simworld_core::net::{Route, RouteScratch, WaypointConfig, WaypointGraph};
use simworld_core::scene::Scene;
use simworld_core::seam::TaskError;

/// Finds lengths of routes. It holds nothing but what follows from the roads, so it is not saved.
#[derive(Debug, Default)]
pub(super) struct Routes {
    graph: Option<Arc<WaypointGraph>>,
    ready: bool,
    scratch: RouteScratch,
    route: Route,
}

impl Clone for Routes {
    /// Shares the graph; the memory of searches stays behind.
    fn clone(&self) -> Self {
        Self { graph: self.graph.clone(), ready: self.ready, ..Self::default() }
    }
}

impl Routes {
    /// Builds the graph of the scene's roads unless it is there already.
    pub(super) fn prepare(&mut self, scene: &dyn Scene) -> Result<(), TaskError> {
        if !self.ready {
            let walkable = |roads| WaypointGraph::walkable(roads, &WaypointConfig::default());
            let graph = scene.roads().map(|roads| walkable(roads)).transpose();
            self.graph = graph.map_err(|error| TaskError::Other(error.to_string()))?.map(Arc::new);
            self.ready = true;
        }
        Ok(())
    }

    /// Length of the way from `a` to `b`, m; straight where no sidewalk joins them.
    pub(super) fn length(&mut self, a: &Point3, b: &Point3) -> f64 {
        let (a, b) = (a.xy(), b.xy());
        self.along_sidewalks(a, b).unwrap_or_else(|| (b - a).norm())
    }

    fn along_sidewalks(&mut self, a: Point2, b: Point2) -> Option<f64> {
        let graph = self.graph.as_ref()?;
        let (from, to) = (graph.nearest(a)?, graph.nearest(b)?);
        if !graph.route(from, to, &mut self.scratch, &mut self.route) {
            return None;
        }
        let access = (graph.waypoint(from).position - a).norm() + (graph.waypoint(to).position - b).norm();
        Some(access + self.route.length)
    }
}
