//! Routes by a contraction hierarchy (Geisberger and others 2008): a graph is prepared once, and every route after that
//! takes microseconds, however long it is.
//!
//! Waypoints along a way have one way on each, so the hierarchy stands on the key waypoints alone, where ways part or end,
//! and on the chains between them.

mod chains;
#[cfg(test)]
mod tests;

use std::sync::Arc;

use super::{Route, WaypointGraph};
use crate::id::WaypointId;
use crate::net::{Hierarchy, HierarchyScratch};
use chains::Chains;

/// A waypoint graph prepared for routes. The routes are as short as those of [`WaypointGraph::route`], to within 0.05 mm an
/// edge.
///
/// ```
/// use simworld_core::id::WaypointId;
/// use simworld_core::net::*;
/// let network = RoadNetwork::derive(&StreetPlan::grid(4, 4, 100.0), &NetworkConfig::default())?;
/// let hierarchy = RouteHierarchy::new(WaypointGraph::walkable(&network, &WaypointConfig::default())?);
/// let (mut scratch, mut route) = (HierarchyScratch::default(), Route::default());
/// assert!(hierarchy.route(WaypointId(3), WaypointId(70), &mut scratch, &mut route));
/// assert_eq!((route.waypoints.first(), route.waypoints.last()), (Some(&WaypointId(3)), Some(&WaypointId(70))));
/// # Ok::<(), NetworkError>(())
/// ```
#[derive(Clone, Debug)]
pub struct RouteHierarchy {
    graph: Arc<WaypointGraph>,
    chains: Chains,
    keys: Hierarchy,
}

impl RouteHierarchy {
    /// Prepares a graph. The same graph gives the same hierarchy; 100 000 waypoints take some seconds.
    pub fn new(graph: impl Into<Arc<WaypointGraph>>) -> Self {
        let graph = graph.into();
        let mut chains = Chains::of(&graph);
        let links = chains.link_keys();
        let keys = Hierarchy::new(chains.keys(), &links);
        Self { graph, chains, keys }
    }

    /// The graph that was prepared.
    pub fn graph(&self) -> &Arc<WaypointGraph> {
        &self.graph
    }

    /// The shortest route, written over `route`; false if there is none.
    pub fn route(
        &self,
        from: WaypointId,
        to: WaypointId,
        scratch: &mut HierarchyScratch,
        route: &mut Route,
    ) -> bool {
        route.waypoints.clear();
        route.length = 0.0;
        let count = self.graph.waypoints().len();
        if from.index() >= count || to.index() >= count {
            return false;
        }
        if from == to {
            route.waypoints.push(from);
            return true;
        }
        let (exits, entries) = (self.chains.exits(from), self.chains.entries(to));
        let over = self.keys.shortest(exits.keys(), entries.keys(), scratch);
        match (self.chains.along_one(from, to), over) {
            (None, None) => return false,
            (Some((weight, place, end)), over) if over.is_none_or(|over| weight <= over.weight) => {
                self.chains.follow(place, end, route);
            }
            (_, Some(over)) => {
                // Out of the chain of its beginning, from key to key, into the chain of its end.
                self.chains.follow_out(exits.place(over.start), route);
                scratch.edges().iter().for_each(|link| self.chains.follow_link(*link, route));
                self.chains.follow_in(entries.place(over.end), route);
            }
            (Some(_), None) => {}
        }
        true
    }
}
