//! Walkers of a traffic: sent, added and taken out while it runs.

use simworld_core::geometry::Point2;
use simworld_core::id::WaypointId;
use simworld_core::net::{Route, RouteScratch, WaypointGraph};

use super::Traffic;
use super::outline::outline;
use crate::pedestrian::{AtDestination, Entry, Walk};
use crate::{Foreign, TrafficError};

impl Traffic {
    /// Where people walk: sidewalks, the corners that join them, and crossings.
    pub fn walkways(&self) -> &WaypointGraph {
        &self.ways
    }

    /// How high a walker stands above the ground, m: more than nothing on footbridges and on the stairs and ramps that lead to them;
    /// who is a free body, as high as somebody else says. Nothing if nobody has the number.
    pub fn walker_height(&self, id: u32) -> f64 {
        let pedestrians = &self.state.pedestrians;
        let on_way = || pedestrians.walkers.get(id as usize).map(|walker| walker.height(&self.ways));
        pedestrians.free_height(id).or_else(on_way).unwrap_or(0.0)
    }

    /// Lets somebody enter at the waypoint nearest to a place, and returns their number; see [`pedestrians`](Self::pedestrians).
    ///
    /// With a destination they take the shortest way to the waypoint nearest to it, and leave there; without one they walk
    /// wherever their way leads. Their age, sex and speed are drawn as those of everybody.
    ///
    /// ```
    /// # use std::sync::Arc;
    /// # use simworld_core::geometry::Point2;
    /// # use simworld_core::net::{NetworkConfig, RoadNetwork, StreetPlan};
    /// # use simworld_core::seed::Seed;
    /// # use simworld_traffic::{Traffic, TrafficConfig};
    /// # let network = RoadNetwork::derive(&StreetPlan::grid(3, 3, 80.0), &NetworkConfig::default())?;
    /// let config = TrafficConfig { vehicles: 0, pedestrians: 0, ..TrafficConfig::default() };
    /// let mut traffic = Traffic::new(Arc::new(network), &config, Seed(1))?;
    /// let walker = traffic.add_walker(Point2::new(20.0, 5.0), Some(Point2::new(60.0, 5.0)))?;
    /// while traffic.walks().is_empty() { traffic.step(0.1); }
    /// assert_eq!(traffic.walks()[0].id, walker);
    /// assert!(traffic.seconds() > 10.0 && traffic.seconds() < 80.0);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// No walkways, no way to the destination, or somebody who stands where they would enter.
    pub fn add_walker(&mut self, at: Point2, to: Option<Point2>) -> Result<u32, TrafficError> {
        let refused = |reason| TrafficError::Walk { reason };
        let from = self.ways.nearest(at).filter(|_| at.x.is_finite() && at.y.is_finite());
        let from = from.ok_or(refused("nobody walks near its beginning: give a place near a sidewalk"))?;
        let path = to.map(|to| self.walking_path(from, to)).transpose()?;
        let next = if let Some(path) = &path {
            path.get(1).copied().unwrap_or(from)
        } else {
            let sidewalk = self.ways.edges(from).iter().find(|edge| edge.crossing.is_none());
            sidewalk.ok_or(refused("no way leads on from its beginning: give a place near a sidewalk"))?.to
        };
        let position = self.ways.waypoint(from).position;
        let entry = Entry { position, from, to: next };
        let stream = self.streams.named("walkers").indexed(self.state.counters.walkers_entered);
        let (ways, config) = (&self.ways, &self.config);
        let entered = self.state.pedestrians.enter(&entry, ways, config, stream);
        let id = entered.ok_or(refused("somebody stands where it begins: try again after a step"))?;
        self.state.counters.walkers_entered += 1;
        if let Some(path) = path {
            let rest = if path.len() > 1 { path[1..].to_vec() } else { path };
            self.state.pedestrians.send(id, rest, AtDestination::Leave, self.state.seconds);
        }
        Ok(id)
    }

    /// Whether a way leads on foot from one place to another.
    pub fn can_walk(&self, from: Point2, to: Point2) -> bool {
        let from = self.ways.nearest(from).filter(|_| from.x.is_finite() && from.y.is_finite());
        from.is_some_and(|from| self.walking_path(from, to).is_ok())
    }

    /// Sends a walker to the waypoint nearest to a place, by the shortest way from the waypoint it heads for.
    ///
    /// # Errors
    /// No walker of that number, or no way to the destination.
    pub fn send_walker(&mut self, id: u32, to: Point2, then: AtDestination) -> Result<(), TrafficError> {
        let walker = self.state.pedestrians.walkers.get(id as usize).filter(|walker| walker.is_present());
        let walker = walker.ok_or(TrafficError::Walk { reason: "there is no walker of that number" })?;
        let path = self.walking_path(walker.way().1, to)?;
        self.state.pedestrians.send(id, path, then, self.state.seconds);
        Ok(())
    }

    /// Takes a walker out, wherever it is; false if there is none of that number.
    pub fn remove_walker(&mut self, id: u32) -> bool {
        let removed = self.state.pedestrians.remove(id, self.state.seconds);
        self.state.counters.walkers_removed += u64::from(removed);
        removed
    }

    /// The walkers that entered since the last step began.
    pub fn walkers_entered(&self) -> &[u32] {
        &self.state.pedestrians.entered
    }

    /// The walks that ended in the last step, and since then by [`remove_walker`](Self::remove_walker).
    pub fn walks(&self) -> &[Walk] {
        &self.state.pedestrians.ended
    }

    /// Gives walkers things to go round: street furniture, trees, whatever stands on their way. They are no part of what is
    /// saved. What is on no walkway costs time and changes nothing; what is nowhere, or not of this world's size, is left out.
    pub fn set_obstacles(&mut self, obstacles: &[Foreign]) {
        self.bodies.clear();
        for obstacle in obstacles.iter().filter(|body| body.is_sound()) {
            outline(obstacle, self.config.walking.radius, &self.ways, &mut self.bodies);
        }
        self.standing_bodies = self.bodies.len();
    }

    fn walking_path(&self, from: WaypointId, to: Point2) -> Result<Vec<WaypointId>, TrafficError> {
        let refused = |reason| TrafficError::Walk { reason };
        let to = self.ways.nearest(to).filter(|_| to.x.is_finite() && to.y.is_finite());
        let to = to.ok_or(refused("nobody walks near its end: give a place near a sidewalk"))?;
        let nowhere = "no way leads to its end: choose one on the same side of what has no crossing";
        path(&self.ways, from, to).ok_or(refused(nowhere))
    }
}

/// The shortest way from a waypoint to another, both included.
pub(super) fn path(ways: &WaypointGraph, from: WaypointId, to: WaypointId) -> Option<Vec<WaypointId>> {
    let (mut scratch, mut route) = (RouteScratch::default(), Route::default());
    ways.route(from, to, &mut scratch, &mut route).then_some(route.waypoints)
}
