//! Shortest routes: A* with the straight line as heuristic.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use serde::{Deserialize, Serialize};

use super::WaypointGraph;
use crate::id::WaypointId;

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
pub struct RouteScratch {
    /// The search in which an entry was written last; older entries count as unknown.
    search: Vec<u32>,
    current: u32,
    distance: Vec<f64>,
    previous: Vec<u32>,
    open: BinaryHeap<Candidate>,
}

/// An entry of the open list; the greatest is taken first, so the order is turned round.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Candidate {
    estimate: f64,
    distance: f64,
    waypoint: u32,
}

impl Eq for Candidate {}

impl PartialOrd for Candidate {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Candidate {
    fn cmp(&self, other: &Self) -> Ordering {
        other.estimate.total_cmp(&self.estimate).then(other.waypoint.cmp(&self.waypoint))
    }
}

impl RouteScratch {
    /// Forgets the last search without touching its memory.
    fn begin(&mut self, waypoints: usize) {
        if self.search.len() < waypoints || self.current == u32::MAX {
            self.search.clear();
            self.search.resize(waypoints, 0);
            self.distance.resize(waypoints, f64::INFINITY);
            self.previous.resize(waypoints, u32::MAX);
            self.current = 0;
        }
        self.current += 1;
        self.open.clear();
    }

    fn distance(&self, waypoint: usize) -> f64 {
        if self.search[waypoint] == self.current { self.distance[waypoint] } else { f64::INFINITY }
    }

    fn reach(&mut self, waypoint: usize, distance: f64, previous: u32) {
        self.search[waypoint] = self.current;
        self.distance[waypoint] = distance;
        self.previous[waypoint] = previous;
    }
}

impl WaypointGraph {
    /// The shortest route (A*; of equal estimates the lower waypoint id goes first), written over `route`; false if
    /// there is none.
    pub fn route(
        &self,
        from: WaypointId,
        to: WaypointId,
        scratch: &mut RouteScratch,
        route: &mut Route,
    ) -> bool {
        self.route_avoiding(from, to, &[], scratch, route)
    }

    /// The shortest [`route`](Self::route) that comes to none of these waypoints; beginning at one is no matter.
    pub fn route_avoiding(
        &self,
        from: WaypointId,
        to: WaypointId,
        shut: &[WaypointId],
        scratch: &mut RouteScratch,
        route: &mut Route,
    ) -> bool {
        route.waypoints.clear();
        route.length = 0.0;
        let count = self.waypoints.len();
        if from.index() >= count || to.index() >= count {
            return false;
        }
        let goal = self.waypoints[to.index()].position;
        let estimate = |waypoint: usize| (self.waypoints[waypoint].position - goal).norm();
        scratch.begin(count);
        scratch.reach(from.index(), 0.0, u32::MAX);
        scratch.open.push(Candidate { estimate: estimate(from.index()), distance: 0.0, waypoint: from.0 });
        while let Some(best) = scratch.open.pop() {
            let here = best.waypoint as usize;
            if here == to.index() {
                trace(to, scratch, route);
                return true;
            }
            if best.distance > scratch.distance(here) {
                continue; // a shorter way here was found since
            }
            for edge in self.edges(WaypointId(best.waypoint)) {
                let (next, distance) = (edge.to.index(), best.distance + edge.length);
                if distance < scratch.distance(next) && !shut.contains(&edge.to) {
                    scratch.reach(next, distance, best.waypoint);
                    let estimate = distance + estimate(next);
                    scratch.open.push(Candidate { estimate, distance, waypoint: edge.to.0 });
                }
            }
        }
        false
    }
}

/// Writes the way back from the goal, turned round.
fn trace(to: WaypointId, scratch: &RouteScratch, route: &mut Route) {
    route.length = scratch.distance(to.index());
    let mut at = to.0;
    while at != u32::MAX {
        route.waypoints.push(WaypointId(at));
        at = scratch.previous[at as usize];
    }
    route.waypoints.reverse();
}
