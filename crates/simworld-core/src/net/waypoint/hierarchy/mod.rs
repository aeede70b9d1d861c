//! Routes by a contraction hierarchy (Geisberger and others 2008): a graph is prepared once, and every route after that
//! takes microseconds, however long it is.
//!
//! Waypoints along a way have one way on each, so the hierarchy stands on the key waypoints alone, where ways part or end,
//! and on the chains between them.

mod chains;
#[cfg(test)]
mod tests;

use std::sync::Arc;

use fast_paths::{FastGraph, InputGraph, PathCalculator};

use super::{Route, WaypointGraph};
use crate::id::WaypointId;
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
    keys: FastGraph,
}

/// The memory of searches in a hierarchy, kept by the caller.
#[derive(Default)]
pub struct HierarchyScratch {
    /// With the number of key waypoints for which it was made.
    calculator: Option<(usize, PathCalculator)>,
}

impl std::fmt::Debug for HierarchyScratch {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let keys = self.calculator.as_ref().map(|(keys, _)| keys);
        f.debug_struct("HierarchyScratch").field("keys", &keys).finish_non_exhaustive()
    }
}

impl HierarchyScratch {
    fn calculator(&mut self, keys: usize) -> &mut PathCalculator {
        let known = self.calculator.take().filter(|(made_for, _)| *made_for == keys);
        &mut self.calculator.insert(known.unwrap_or_else(|| (keys, PathCalculator::new(keys)))).1
    }
}

impl RouteHierarchy {
    /// Prepares a graph. The same graph gives the same hierarchy; 100 000 waypoints take some seconds.
    pub fn new(graph: impl Into<Arc<WaypointGraph>>) -> Self {
        let graph = graph.into();
        let chains = Chains::of(&graph);
        let mut input = InputGraph::new();
        for (from, to, weight) in chains.links() {
            input.add_edge(from, to, weight);
        }
        input.freeze();
        let keys = fast_paths::prepare(&input);
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
        let over = self.over_keys(from, to, scratch);
        match (self.chains.along_one(from, to), over) {
            (None, None) => return false,
            (Some((weight, place, end)), over) if over.as_ref().is_none_or(|over| weight <= over.0) => {
                self.chains.follow(place, end, route);
            }
            (_, over) => self.unpack(from, to, &over.map_or_else(Vec::new, |(_, keys)| keys), route),
        }
        true
    }

    /// The shortest way that passes a key waypoint: its weight, and the keys.
    fn over_keys(
        &self,
        from: WaypointId,
        to: WaypointId,
        scratch: &mut HierarchyScratch,
    ) -> Option<(usize, Vec<usize>)> {
        let (mut starts, mut ends) = (self.chains.exits(from), self.chains.entries(to));
        // Keys that no link touches are unknown to the hierarchy; one may still lead from a chain back into it.
        let pairs = starts.iter().flat_map(|start| ends.iter().map(move |end| (start, end)));
        let one =
            pairs.filter(|(start, end)| start.0 == end.0).map(|(start, end)| (start.1 + end.1, start.0));
        let over_one = one.min().map(|(weight, key)| (weight, vec![key]));
        let known = self.keys.get_num_nodes();
        starts.retain(|(key, _)| *key < known);
        ends.retain(|(key, _)| *key < known);
        if starts.is_empty() || ends.is_empty() {
            return over_one;
        }
        let found =
            scratch.calculator(known).calc_path_multiple_sources_and_targets(&self.keys, starts, ends);
        let over_many = found.map(|path| (path.get_weight(), path.get_nodes().clone()));
        [over_many, over_one].into_iter().flatten().min_by_key(|(weight, _)| *weight)
    }

    /// Writes the way over some keys: out of the chain of its beginning, from key to key, into the chain of its end.
    fn unpack(&self, from: WaypointId, to: WaypointId, keys: &[usize], route: &mut Route) {
        let (Some(first), Some(last)) = (keys.first(), keys.last()) else { return };
        if let Some((place, end)) = self.chains.exit_to(from, *first) {
            self.chains.follow(place, end, route);
        }
        for pair in keys.windows(2) {
            if let Some((place, end)) = self.chains.link(pair[0], pair[1]) {
                self.chains.follow(place, end, route);
            }
        }
        if let Some((place, end)) = self.chains.entry_from(to, *last) {
            self.chains.follow(place, end, route);
        }
        if route.waypoints.is_empty() {
            route.waypoints.push(from);
        }
    }
}
