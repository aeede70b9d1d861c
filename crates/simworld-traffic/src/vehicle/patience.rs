//! Patience: who stands too long in a lane that does not lead on takes a way that does.

use simworld_core::id::LaneId;

use super::manager::{NONE, Vehicle, VehicleManager};
use super::tracks::{Track, Tracks};
use crate::{Counters, Leg};

/// Who stands in a lane that does not lead on for so long looks for another way, s.
pub(super) const PATIENCE: f64 = 40.0;

impl VehicleManager {
    /// Those who have stood too long in a lane that does not lead on take a way that does, and their route anew from there.
    pub(super) fn lose_patience(&mut self, tracks: &Tracks, counters: &mut Counters) {
        let mut stuck = std::mem::take(&mut self.stuck);
        for lane in stuck.drain(..) {
            let mut ways = tracks.network.lanes[lane as usize].outgoing.iter();
            let has_goal = self.goal(tracks, lane, 0).is_some();
            if has_goal && ways.any(|way| self.take_way(tracks, lane, 0, way.0)) {
                counters.rerouted += 1;
            }
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
            let after = Leg::of(&tracks.network, tracks.network.connections[way as usize].to);
            let Some(mut rest) = self.closures.quickest(tracks, after, goal) else { return false };
            rest.0.insert(0, Leg::of(&tracks.network, LaneId(lane)));
            route = Some(self.add_route(rest));
        }
        let (queue, paths) = self.both_mut(tracks, lane);
        queue[rank].next = way;
        if let Some(route) = route {
            (paths[rank].route, paths[rank].leg) = (route, 0);
        }
        true
    }
}

impl Vehicle {
    /// Whether, first in its lane, it has waited long enough for a gap to a lane that leads on.
    pub(super) fn is_stuck(&self) -> bool {
        self.next == NONE && self.stood >= PATIENCE && self.shift == 0.0 && self.halt.is_infinite()
    }
}
