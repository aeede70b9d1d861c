//! Bodies in lanes that are not in their queues: those who have not quite left a lane, what blocks one, and whoever is not of
//! the traffic.

use super::tail::Tail;
use crate::vehicle::driving::lane_change::{old_lane, out, stretch};
use crate::vehicle::manager::{STANDING, Vehicle};
use crate::vehicle::part::Part;
use crate::vehicle::scene::Scene;
use crate::vehicle::tracks::{Obstacle, Track, Way};

/// From so far one sees that one's lane is blocked, m.
pub(in crate::vehicle) const BLOCK_SEEN: f64 = 80.0;

/// A body in a lane that it has not quite left.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Ghost {
    /// The number of the lane in the part.
    pub(in crate::vehicle) lane: u32,
    /// Its rear there, m.
    pub(in crate::vehicle) rear: f64,
    pub(in crate::vehicle) length: f64,
    pub(in crate::vehicle) v: f64,
    /// Whether it stays: a blocked stretch.
    pub(in crate::vehicle) is_fixed: bool,
}

impl Ghost {
    pub(in crate::vehicle) fn of(vehicle: &Vehicle, lane: u32, station: f64) -> Self {
        let length = vehicle.length();
        Self { lane, rear: station - length, length, v: vehicle.v, is_fixed: false }
    }

    /// How those see it who come from the junction behind.
    pub(in crate::vehicle) fn as_tail(&self) -> Tail {
        let Self { rear, length, v, .. } = *self;
        Tail { rear, v, length: length as f32, ..Tail::default() }
    }
}

impl Part {
    /// Lists the blocked stretches of its lanes among the bodies that stand in two lanes.
    pub(in crate::vehicle) fn show_blocks(&mut self, scene: &Scene<'_>) {
        for (lane, from, to) in &scene.closures.blocks {
            if self.layout(scene.tracks).tracks.get(scene.tracks.layout.local(*lane)) == Some(lane) {
                let (lane, length) = (scene.tracks.layout.local(*lane) as u32, to - from);
                self.haunt(Ghost { lane, rear: *from, length, v: 0.0, is_fixed: true });
            }
        }
        // Bodies that are on no lane of the traffic's own are in the way of who changes, and one passes those that stand.
        let bars = scene.sight.obstacles.iter().filter(|body| body.bars(0.0)).copied();
        for Obstacle { track, near, far, v, stands, .. } in bars {
            let place = scene.tracks.layout.place(track);
            if place.part == self.number() && (track as usize) < scene.tracks.lanes {
                let (lane, length) = (place.local, far - near);
                self.haunt(Ghost { lane, rear: near, length, v, is_fixed: stands });
            }
        }
    }

    /// The gap to what blocks the lane of a vehicle: a blocked stretch, or somebody who halts.
    pub(in crate::vehicle) fn block_ahead(&self, local: usize, rank: usize) -> Option<f64> {
        let queue = self.slabs.queue(local);
        let leader = rank.checked_sub(1).map(|rank| &queue[rank]);
        let halts = leader.filter(|leader| leader.halt.is_finite() && leader.v < STANDING);
        let halts = halts.map(|leader| leader.s - leader.length() - queue[rank].s);
        let block = first_block(self.ghosts(local), queue[rank].s).filter(|gap| *gap < BLOCK_SEEN);
        block.into_iter().chain(halts).min_by(f64::total_cmp)
    }

    /// Lists one more body.
    pub(in crate::vehicle) fn haunt(&mut self, ghost: Ghost) {
        let word = ghost.lane as usize / 64;
        if self.work.haunted.len() <= word {
            self.work.haunted.resize(word + 1, 0);
        }
        self.work.haunted[word] |= 1 << (ghost.lane % 64);
        self.work.ghosts.push(ghost);
    }

    /// Forgets all of them.
    pub(in crate::vehicle) fn lay_ghosts(&mut self) {
        self.work.ghosts.clear();
        self.work.haunted.fill(0);
    }

    /// Bodies that have not quite left a lane, and what blocks it, from back to front.
    #[inline]
    pub(in crate::vehicle) fn ghosts(&self, lane: usize) -> &[Ghost] {
        // Most lanes have none, and each who may change lanes asks for those of several.
        let word = self.work.haunted.get(lane / 64).copied().unwrap_or_default();
        if word >> (lane % 64) & 1 == 0 { &[] } else { self.ghosts_of(lane) }
    }

    fn ghosts_of(&self, lane: usize) -> &[Ghost] {
        let ghosts = &self.work.ghosts;
        let from = ghosts.partition_point(|ghost| (ghost.lane as usize) < lane);
        let count = ghosts[from..].iter().take_while(|ghost| ghost.lane as usize == lane).count();
        &ghosts[from..from + count]
    }

    /// The body before a place in a lane that is being left, for whoever is still in it: its rear and speed.
    pub(in crate::vehicle) fn ahead_in_old_lane(
        &self,
        scene: &Scene<'_>,
        lane: Track,
        vehicle: &Vehicle,
    ) -> Option<(f64, f64)> {
        let tracks = scene.tracks;
        let track = old_lane(tracks, lane, vehicle)?;
        if f64::from(vehicle.shift.abs()) <= out(tracks, lane, track) {
            return None;
        }
        let s = vehicle.s * stretch(tracks, lane, track);
        let old = tracks.layout.local(track);
        let queue = self.slabs.queue(old);
        let leader = queue.partition_point(|other| other.s >= s).checked_sub(1).map(|rank| &queue[rank]);
        let leader = leader.map(|leader| (leader.s - leader.length() - s, leader.v));
        // Another may be on its way out of the same lane.
        let ghost = first_ghost(self.ghosts(old), s);
        // Or its front has left the lane and its rear has not.
        let (end, leavers) = (tracks.length[track as usize], self.leavers(scene, track));
        let leaver = leavers.map(|(rear, v)| (end - s + rear, v)).filter(|(gap, _)| *gap > -vehicle.length());
        [leader, ghost].into_iter().flatten().chain(leaver).min_by(|a, b| a.0.total_cmp(&b.0))
    }

    /// Those whose front has left a lane by a junction and whose rear has not, while accelerations are computed: where that is, from the
    /// end of the lane, m and negative; and their speeds.
    pub(in crate::vehicle) fn leavers(
        &self,
        scene: &Scene<'_>,
        lane: Track,
    ) -> impl Iterator<Item = (f64, f64)> {
        // Who is on a way holds it, and mostly nobody does.
        let is_left = self.work.held.leads_from(scene.tracks.layout.local(lane));
        let exits = if is_left { scene.tracks.exits(lane) } else { &[] };
        let ways = exits.iter().map(|(way, _)| *way);
        let held = ways.filter(|way| scene.junctions.is_held(*way));
        let on_ways = held.flat_map(move |way| self.on_way(scene, way));
        on_ways.filter(|other| other.1 < 0.0).map(|(_, rear, v)| (rear, v))
    }

    /// Those who are on a way, or have their rear there: front and rear along the way, m, and speed, m/s.
    pub(in crate::vehicle) fn on_way(
        &self,
        scene: &Scene<'_>,
        way: u32,
    ) -> impl Iterator<Item = (f64, f64, f64)> {
        let tracks = scene.tracks;
        let Way { local, there, length, .. } = tracks.ways[way as usize];
        let on_way = self.slabs.queue(local as usize).iter();
        // Of those behind the way only the last can still have its rear on it.
        let tail = scene.tail_at(there);
        let rear = tail.rear + length;
        let behind = (tail.way == way).then_some((rear + f64::from(tail.length), rear, tail.v));
        on_way.map(|other| (other.s, other.s - other.length(), other.v)).chain(behind)
    }
}

/// The gap to the first blocked stretch ahead.
pub(in crate::vehicle) fn first_block(ghosts: &[Ghost], s: f64) -> Option<f64> {
    let start = ghosts.partition_point(|ghost| ghost.rear < s);
    ghosts[start..].iter().find(|ghost| ghost.is_fixed).map(|ghost| ghost.rear - s)
}

/// The gap to the first body ahead that is leaving a lane, and its speed.
pub(in crate::vehicle) fn first_ghost(ghosts: &[Ghost], s: f64) -> Option<(f64, f64)> {
    // One whose rear is behind one's own front is beside or behind: it minds whoever is before it.
    let start = ghosts.partition_point(|ghost| ghost.rear < s);
    ghosts.get(start).map(|ghost| (ghost.rear - s, ghost.v))
}

/// From back to front, lane by lane.
pub(in crate::vehicle) fn sort(ghosts: &mut [Ghost]) {
    ghosts.sort_by(|a, b| a.lane.cmp(&b.lane).then(a.rear.total_cmp(&b.rear)));
}
