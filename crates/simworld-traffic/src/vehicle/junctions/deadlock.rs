//! Locks: rings of lanes whose first vehicles wait for those of the next; and how they are undone.
//!
//! A lane whose first vehicle has stood for long and finds no room behind the junction waits for that lane; so it does if one
//! who stands there has his rear across its way, if it stands behind one who has [left](super::leavers) it for that lane but for his rear, or the permit of a [cluster](super::clusters) that it needs, if one who
//! changes lanes stands before it in both, if it has leave to follow those who stand on that lane, and if the room there is kept for
//! another. Every lane waits for one at most, so that rings are found by following. A ring is
//! undone by those of its first vehicles that have another way with room, which they take; if none has, all of them may enter
//! their junctions at once without room behind and without a permit: as all go, each makes the room of the one behind it.
//! Behind those who may, everybody closes up, so that rears come out of junctions in which nobody else could go. Nobody jumps, and all other
//! rules of crossing hold.

use simworld_core::net::Workers;

use super::clusters::{Wish, awaited};
use super::junction::{PATIENT, is_room};
use super::leavers::FAR;
use crate::vehicle::clock::Moment;
use crate::vehicle::driving::lane_change::{old_lane, stretch};
use crate::vehicle::manager::{EXIT, NONE, STANDING, Vehicle, VehicleManager};
use crate::vehicle::queues::path::Path;
use crate::vehicle::queues::tail::Tail;
use crate::vehicle::threads::{Sweep, each};
use crate::vehicle::tracks::{Track, Tracks, Way};
use crate::{Counters, TrafficConfig};

/// Who has stood for so long may be in a lock, s. Whatever the signals show: where each of a ring waits for room behind a lane
/// that stands, nobody goes.
pub(super) const LOCKED: f64 = 12.0;
/// Who stands farther than this from its line stands behind something, m.
pub(super) const SHORT: f64 = 3.0;
/// Locks are looked for so often, s.
const EVERY: f64 = 1.0;

/// Which lane waits for which, and what was seen of it: memory of the search, kept from one to the next.
#[derive(Clone, Debug, Default, PartialEq)]
pub(in crate::vehicle) struct Waits {
    /// Lane, the lane that it waits for, and the search that met it; by lane.
    edges: Vec<(Track, Track, u32)>,
    /// Those found in each part.
    found: Vec<Vec<(Track, Track, u32)>>,
}

impl Waits {
    fn of(&self, lane: Track) -> Option<usize> {
        self.edges.binary_search_by_key(&lane, |edge| edge.0).ok()
    }

    /// A lane of the ring to which the waiting from an edge leads, if no search has met that ring before.
    fn ring_from(&mut self, start: usize) -> Option<Track> {
        let search = start as u32 + 1;
        let mut at = start;
        while self.edges[at].2 == 0 {
            self.edges[at].2 = search;
            at = self.of(self.edges[at].1)?;
        }
        (self.edges[at].2 == search).then_some(self.edges[at].0)
    }

    /// The lane for which one of a ring waits.
    fn after(&self, lane: Track) -> Track {
        self.of(lane).map_or(lane, |index| self.edges[index].1)
    }
}

/// Whether a stretch of time that comes again and again, s, ends with a step of `dt` s. Times are reckoned from the number of steps: with those that a step is added to or
/// taken from, rounding passes over whole rows of seconds.
pub(in crate::vehicle) fn is_due(step: u64, dt: f64, every: f64) -> bool {
    let count = |step: u64| (step as f64 * dt / every).floor();
    count(step) != count(step + 1)
}

impl VehicleManager {
    /// Finds the locks there are, once a second, and undoes them.
    pub(in crate::vehicle) fn unlock(
        &mut self,
        tracks: &Tracks,
        config: &TrafficConfig,
        at: Moment,
        counters: &mut Counters,
        workers: &dyn Workers,
    ) {
        if !is_due(at.step, at.dt, EVERY) {
            return;
        }
        let mut waits = std::mem::take(&mut self.waits);
        let Waits { edges, found } = &mut waits;
        found.resize_with(self.parts.len(), Vec::new);
        let this = &*self;
        each(workers, Sweep::of(at.step, 3), found, |part, found| {
            let waits = this.queues_of(tracks, part).filter_map(|(lane, queue)| {
                let target = this.waits_behind(tracks, config, lane, queue.first()?)?;
                Some((lane, target))
            });
            found.extend(waits.chain(this.left_behind(tracks, part)).map(|(lane, target)| (lane, target, 0)));
        });
        edges.clear();
        edges.extend(found.iter_mut().flat_map(|found| found.drain(..)));
        edges.sort_unstable();
        waits.edges.dedup_by_key(|edge| edge.0);
        for start in 0..waits.edges.len() {
            if let Some(ring) = waits.ring_from(start) {
                counters.locks += 1;
                self.undo(tracks, config, &waits, ring, counters);
            }
        }
        self.waits = waits;
    }

    /// The lane whose first vehicle keeps the first of another from going on, if it has stood for long: for want of room there, since
    /// somebody who stands there has his rear in the way or the permit, or stands in both lanes.
    fn waits_behind(
        &self,
        tracks: &Tracks,
        config: &TrafficConfig,
        lane: Track,
        first: &Vehicle,
    ) -> Option<Track> {
        if first.stood <= LOCKED {
            return None; // nobody who has just come is in a lock
        }
        let follows = || self.follows_onto(tracks, lane, first);
        if let Some(after) = self.behind_a_leaver(tracks, lane, first).or_else(follows) {
            return Some(after);
        }
        if let Some(old) = self.has_half_changed(tracks, lane, first) {
            return Some(old);
        }
        if !has_long_waited(first) {
            return None;
        }
        let half_changed = || self.who_changes_before(tracks, lane, first);
        let rear = || self.rear_in_the_way(tracks, first);
        let permit = || self.holder_of_permit(tracks, first);
        self.waits_for(tracks, config, first).or_else(half_changed).or_else(rear).or_else(permit)
    }

    /// The lane on to which the first of another has leave to follow others, as on a bend, and has long stood behind them; or one on to
    /// which those stand who are in the way there.
    fn follows_onto(&self, tracks: &Tracks, lane: Track, first: &Vehicle) -> Option<Track> {
        let stands = has_leave(first) && !first.halt.is_finite() && first.stood > LOCKED;
        let front = first.s - tracks.length[lane as usize];
        stands.then(|| self.held_up_by(tracks, first.next, front, FAR))
    }

    /// The lane that the first of another has not quite left, if it has long stood there behind somebody who stands in that; or the one to
    /// which somebody changes from that who stands before it.
    fn has_half_changed(&self, tracks: &Tracks, lane: Track, first: &Vehicle) -> Option<Track> {
        let stands = first.shift != 0.0 && !first.halt.is_finite() && first.stood > LOCKED;
        let old = old_lane(tracks, lane, first).filter(|_| stands)?;
        let front = first.s * stretch(tracks, lane, old);
        let is_behind = self.queue(tracks, old).iter().any(|ahead| ahead.s > front && ahead.v < STANDING);
        if is_behind {
            Some(old)
        } else {
            self.who_leaves_before(tracks, old, front).find(|beside| *beside != lane)
        }
    }

    /// The lane beside on which somebody stands who has not quite left this one, before its first.
    fn who_changes_before(&self, tracks: &Tracks, lane: Track, first: &Vehicle) -> Option<Track> {
        let end = tracks.length[lane as usize];
        (end - first.s > SHORT).then(|| self.who_leaves_before(tracks, lane, first.s).next()).flatten()
    }

    /// The lanes beside on which somebody stands beyond a station of this one who has not quite left it.
    fn who_leaves_before<'a>(
        &'a self,
        tracks: &'a Tracks,
        lane: Track,
        front: f64,
    ) -> impl Iterator<Item = Track> + 'a {
        let beside = tracks.beside[lane as usize].into_iter().filter(|beside| *beside != NONE);
        beside.filter(move |beside| {
            let ahead = front * stretch(tracks, lane, *beside);
            self.queue(tracks, *beside).iter().any(|v| {
                v.s > ahead && v.v < STANDING && v.shift != 0.0 && old_lane(tracks, *beside, v) == Some(lane)
            })
        })
    }

    /// The lane on which somebody stands whose rear is on a way that meets one's own, or to which somebody stands on such a way.
    fn rear_in_the_way(&self, tracks: &Tracks, first: &Vehicle) -> Option<Track> {
        // The stretch of such a way that is to be free: of one that somebody long holds, or that keeps somebody long from going, all of it.
        let way = first.next as usize;
        let is_shared = |way: u32| !first.is_long() && !self.junctions.has_long(way);
        let conflicts = tracks.conflicts[way].iter().map(|conflict| {
            let until = if is_shared(conflict.way) { conflict.other.passed() } else { f64::INFINITY };
            (conflict.way, until)
        });
        let tight = tracks.tight[way].iter().filter(|way| !is_shared(**way));
        let tight = tight.map(|way| (*way, f64::INFINITY));
        let stands_on = |(way, until): (u32, f64)| {
            if let Some(lane) = self.who_trails_on(tracks, way, until) {
                return Some(lane);
            }
            let lane = tracks.lane_after(way as usize);
            let last = self.queue(tracks, lane).last();
            let is_in_the_way = |last: &Vehicle| {
                let rear = tracks.length[tracks.lanes + way as usize] + last.s - last.length();
                last.v < STANDING && last.holding == way && !has_leave(last) && rear < until
            };
            if last.is_some_and(is_in_the_way) {
                return Some(lane);
            }
            let mut on_way = self.queue(tracks, tracks.lanes as Track + way).iter();
            let stands = on_way.any(|other| other.v < STANDING && other.stood > LOCKED);
            stands.then(|| self.held_up_by(tracks, way, f64::INFINITY, FAR))
        };
        let on_own = || self.who_trails_on(tracks, first.next, f64::INFINITY);
        conflicts.chain(tight).find_map(stands_on).or_else(on_own)
    }

    /// The lane on which somebody stands, or for which, who is longer than the lane behind a way and has his rear on that still, before a station.
    fn who_trails_on(&self, tracks: &Tracks, way: u32, until: f64) -> Option<Track> {
        let length = tracks.length[tracks.lanes + way as usize];
        let trails = self.trails.iter().filter(|trail| trail.is_on(way, until - length));
        trails
            .filter_map(|trail| self.find(tracks, trail.id()))
            .find_map(|found| self.stands_for(tracks, found))
    }

    /// The lane on which somebody has long stood, or for which, if he is on a way.
    fn stands_for(&self, tracks: &Tracks, (track, vehicle, _): (Track, &Vehicle, &Path)) -> Option<Track> {
        let lane = || match tracks.connection(track) {
            Some(way) => self.held_up_by(tracks, way as u32, f64::INFINITY, FAR),
            None => track,
        };
        (vehicle.v < STANDING && vehicle.stood > LOCKED).then(lane)
    }

    /// The lane on which somebody stands, or for which, who has the permit that one needs, or one that was given after one's own.
    fn holder_of_permit(&self, tracks: &Tracks, first: &Vehicle) -> Option<Track> {
        let cluster = tracks.clusters.entered_by(tracks, first.next, first)?;
        let permits = awaited(&self.permits, cluster, first.id);
        let places = tracks.clusters.places(cluster);
        if places.is_some_and(|places| self.has_place(tracks, permits.clone(), first.id, places)) {
            return None;
        }
        let mut holders = permits.filter_map(|permit| self.find(tracks, permit.id()));
        let holder = holders.find_map(|found| self.stands_for(tracks, found));
        let has_own = || self.permits.iter().any(|permit| permit.is_for(first.id, cluster));
        let is_kept_out = || places.is_none() && !has_own();
        holder
            .or_else(|| is_kept_out().then(|| self.kept_out_by(tracks, &Wish::new(cluster, first))).flatten())
    }

    /// The lane for room on which the first of a lane has long waited.
    pub(super) fn waits_for(
        &self,
        tracks: &Tracks,
        config: &TrafficConfig,
        first: &Vehicle,
    ) -> Option<Track> {
        if !has_long_waited(first) {
            return None;
        }
        let after = tracks.lane_after(first.next as usize);
        let last = self.end_of(tracks, after);
        let stands = !last.is_none() && last.v < STANDING;
        if stands && (!self.has_room(tracks, config, first.next, first) || self.is_kept(tracks, first, after))
        {
            return Some(after);
        }
        self.who_has_left(tracks, config, first, after)
    }

    /// Whether the room on a lane is kept for another, who has stood longer for it.
    fn is_kept(&self, tracks: &Tracks, first: &Vehicle, after: Track) -> bool {
        self.is_waited_for(tracks, after, |other| other.id != first.id && other.stood > first.stood)
    }

    /// Whether somebody of whom that is true has stood too long for room on a lane, which is kept for him.
    pub(in crate::vehicle) fn is_waited_for(
        &self,
        tracks: &Tracks,
        after: Track,
        is_one: impl Fn(&Vehicle) -> bool,
    ) -> bool {
        self.who_is_kept_waiting(tracks, after, |_, other| is_one(other)).is_some()
    }

    /// The lane on which somebody of whom that is true has stood too long for room on another.
    pub(super) fn who_is_kept_waiting(
        &self,
        tracks: &Tracks,
        after: Track,
        is_one: impl Fn(Track, &Vehicle) -> bool,
    ) -> Option<Track> {
        let place = tracks.network.lanes[after as usize].from;
        let ways = tracks.network.intersections[place.index()].connections.iter();
        ways.map(|way| (way, &tracks.ways[way.index()])).find_map(|(way, Way { from, to, .. })| {
            let first = self.queue(tracks, *from).first().filter(|_| *to == after)?;
            let waits = first.next == way.0 && !has_leave(first) && first.stood > PATIENT;
            (waits && is_one(*from, first)).then_some(*from)
        })
    }

    /// The lane on which somebody stands who has not quite left the one behind the junction, and takes the room there.
    fn who_has_left(
        &self,
        tracks: &Tracks,
        config: &TrafficConfig,
        first: &Vehicle,
        after: Track,
    ) -> Option<Track> {
        let takes_room = |beside: Track, other: &Vehicle| {
            let ahead = stretch(tracks, beside, after);
            let tail = Tail { rear: other.s * ahead - other.length(), ..Tail::of(other) };
            other.shift != 0.0
                && other.v < STANDING
                && old_lane(tracks, beside, other) == Some(after)
                && !is_room(tracks, config, (&self.junctions, &self.storage), (after, &tail), first)
        };
        let mut beside = tracks.beside[after as usize].into_iter().filter(|beside| *beside != NONE);
        beside.find(|beside| self.queue(tracks, *beside).iter().any(|other| takes_room(*beside, other)))
    }

    /// Whether there is room for a vehicle behind a way.
    fn has_room(&self, tracks: &Tracks, config: &TrafficConfig, way: u32, vehicle: &Vehicle) -> bool {
        let lane = tracks.lane_after(way as usize);
        let last = self.end_of(tracks, lane);
        is_room(tracks, config, (&self.junctions, &self.storage), (lane, &last), vehicle)
    }

    fn undo(
        &mut self,
        tracks: &Tracks,
        config: &TrafficConfig,
        waits: &Waits,
        ring: Track,
        counters: &mut Counters,
    ) {
        let mut lane = ring;
        let mut leave = 0;
        loop {
            leave += u64::from(self.turn_elsewhere(tracks, config, lane));
            lane = waits.after(lane);
            if lane == ring {
                break;
            }
        }
        counters.rerouted += leave;
        if leave > 0 {
            return;
        }
        loop {
            // Who has leave, or comes to the end of its way, needs none.
            let first = self.queue(tracks, lane).first().filter(|first| has_long_waited(first));
            if let Some(first) = first.map(|first| first.id)
                && let Err(place) = self.passes.binary_search(&first)
            {
                self.passes.insert(place, first);
                counters.passes += 1;
            }
            lane = waits.after(lane);
            if lane == ring {
                break;
            }
        }
    }

    /// Lets the first of a lane take another way that has room, if there is one; its route leads to the same end.
    pub(super) fn turn_elsewhere(&mut self, tracks: &Tracks, config: &TrafficConfig, lane: Track) -> bool {
        let Some(first) = self.queue(tracks, lane).first().copied().filter(has_long_waited) else {
            return false;
        };
        let kind = config.vehicle_type(first.row).kind;
        let weight = |way: u32| tracks.weight(way as usize, &config.turns) > 0.0;
        let ways = tracks.network.lanes[lane as usize].outgoing.iter().map(|way| way.0);
        let open = ways.filter(|way| *way != first.next && weight(*way)).find(|way| {
            let other = Vehicle { next: *way, ..first };
            let after = tracks.lane_after(*way as usize);
            tracks.may_use(after, kind)
                && !self.closures.bars(tracks, *way as usize)
                && self.has_room(tracks, config, *way, &other)
                // Else he would be sent hither and thither.
                && self.waits_behind(tracks, config, lane, &other).is_none()
                && self.leads_home(tracks, lane, *way)
        });
        let Some(way) = open else { return false };
        self.take_way(tracks, lane, 0, way)
    }

    /// Whether the first of a lane may come to the end of its route by a way; without a route, whether one can drive on there without
    /// end: he would stand at the end for good.
    fn leads_home(&self, tracks: &Tracks, lane: Track, way: u32) -> bool {
        let after = tracks.lane_after(way as usize);
        match self.goal(tracks, lane, 0) {
            Some(goal) => self.closures.quickest_from(tracks, after, goal, None).is_some(),
            None => tracks.leads_on[after as usize],
        }
    }
}

/// Whether the first of a lane has leave for the way that it wants.
pub(in crate::vehicle) fn has_leave(first: &Vehicle) -> bool {
    first.next < EXIT && first.holding == first.next
}

/// Whether the first of a lane has long stood without leave for the way that it wants.
fn has_long_waited(first: &Vehicle) -> bool {
    first.next < EXIT && first.holding != first.next && !first.halt.is_finite() && first.stood > LOCKED
}

#[cfg(test)]
mod tests;
