//! Patience: who stands too long in a lane that does not lead on takes a way that does; if none does, he leaves the map by one that there is.

use simworld_core::id::LaneId;

use super::leading::way_off;
use super::manager::{NONE, Vehicle, VehicleManager};
use super::tracks::{Track, Tracks};
use crate::{Counters, Leg, Route};

/// Who stands in a lane that does not lead on for so long looks for another way, s.
pub(super) const PATIENCE: f64 = 40.0;

impl VehicleManager {
    /// Those who have stood too long in a lane that does not lead on take a way that does, and their route anew from there.
    pub(super) fn lose_patience(&mut self, tracks: &Tracks, counters: &mut Counters) {
        let mut stuck = std::mem::take(&mut self.stuck);
        for lane in stuck.drain(..) {
            let mut ways = tracks.network.lanes[lane as usize].outgoing.iter();
            let Some(goal) = self.goal(tracks, lane, 0) else { continue };
            let is_led = ways.clone().any(|way| self.take_way(tracks, lane, 0, way.0))
                || ways.any(|way| self.leave_by(tracks, lane, way.0, goal));
            counters.rerouted += u64::from(is_led);
        }
        self.stuck = stuck;
    }

    /// The last leg of the route of a vehicle of a lane; none if it turns at random.
    pub(super) fn goal(&self, tracks: &Tracks, lane: Track, rank: usize) -> Option<Leg> {
        let path = self.paths(tracks, lane).get(rank)?;
        self.routes.get(path.route as usize)?.0.last().copied()
    }

    /// Lets a vehicle of a lane take a way from it, and its route anew from there; false if its end cannot be reached so.
    pub(super) fn take_way(&mut self, tracks: &Tracks, lane: Track, rank: usize, way: u32) -> bool {
        if self.closures.bars(tracks, way as usize) {
            return false;
        }
        let mut route = None;
        if let Some(goal) = self.goal(tracks, lane, rank) {
            let after = tracks.lane_after(way as usize);
            let quickest = |avoid| self.closures.quickest_from(tracks, after, goal, avoid);
            // Who came to the wrong lane of a short street would come to it by the same turn again.
            let turn = self.came_by(tracks, lane, rank);
            let Some(rest) = turn.and_then(|turn| quickest(Some(turn))).or_else(|| quickest(None)) else {
                return false;
            };
            route = Some(rest);
        }
        self.go_by(tracks, (lane, rank), way, route);
        true
    }

    /// The leg before the one on which a vehicle of a lane is, with that.
    fn came_by(&self, tracks: &Tracks, lane: Track, rank: usize) -> Option<(Leg, Leg)> {
        let path = self.paths(tracks, lane).get(rank)?;
        let legs = &self.routes.get(path.route as usize)?.0;
        Some((*legs.get((path.leg as usize).checked_sub(1)?)?, *legs.get(path.leg as usize)?))
    }

    /// Lets the first of a lane take a way from which its goal is reached by nothing, and leave where that ends. What is closed is no
    /// matter: it may be opened.
    fn leave_by(&mut self, tracks: &Tracks, lane: Track, way: u32, goal: Leg) -> bool {
        let after = Leg::of(&tracks.network, LaneId(tracks.lane_after(way as usize)));
        let is_open = !self.closures.bars(tracks, way as usize);
        let Some(off) = way_off(tracks, after, goal).filter(|_| is_open) else { return false };
        self.go_by(tracks, (lane, 0), way, Some(off));
        true
    }

    /// Sends a vehicle of a lane by a way from it, and on by a route from there.
    fn go_by(&mut self, tracks: &Tracks, (lane, rank): (Track, usize), way: u32, route: Option<Route>) {
        let route = route.map(|mut rest| {
            rest.0.insert(0, Leg::of(&tracks.network, LaneId(lane)));
            self.add_route(rest)
        });
        let (queue, paths) = self.both_mut(tracks, lane);
        queue[rank].next = way;
        if let Some(route) = route {
            (paths[rank].route, paths[rank].leg) = (route, 0);
        }
    }
}

impl Vehicle {
    /// Whether, first in its lane, it has waited long enough for a gap to a lane that leads on.
    pub(super) fn is_stuck(&self) -> bool {
        self.next == NONE && self.stood >= PATIENCE && self.shift == 0.0 && self.halt.is_infinite()
    }
}
