//! Lane changes: MOBIL for those who would be faster beside, and whatever it takes for those whose way leads on from there.
//!
//! MOBIL (Kesting, Treiber and Helbing 2007): change if one's own gain exceeds the threshold and the politeness times what
//! others lose, and nobody behind has to brake harder than is safe. A vehicle enters the queue of its new lane at once and
//! moves over in some seconds; meanwhile it stands in both: those behind it in the old lane see it there, and it minds
//! who is before it in either.

use std::collections::VecDeque;

use serde::{Deserialize, Serialize};

use super::VehicleKind;
use super::manager::{EXIT, NONE, Vehicle, VehicleManager};
use super::tracks::{Track, Tracks};
use crate::{Leg, TrafficConfig};

/// When drivers change lanes.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Mobil {
    /// Weight of what others lose against one's own gain, in [0, 2]; 0 is an egoist.
    pub politeness: f64,
    /// Gain below which one stays, m/s², in [0, 5].
    pub threshold: f64,
    /// Hardest braking to which one forces another, m/s², in [0.5, 8].
    pub safe_braking: f64,
}

impl Default for Mobil {
    /// The values of the model's authors.
    fn default() -> Self {
        Self { politeness: 0.3, threshold: 0.2, safe_braking: 4.0 }
    }
}

/// Sideways speed of a change, m/s, and its bound as a share of the speed ahead.
const SIDEWAYS: f64 = 1.2;
const STEEPNESS: f64 = 0.25;
/// With less than this to its new lane's middle a body is out of its old lane, m.
const OUT: f64 = 0.5;
/// Everybody looks beside once in so many steps.
const EVERY: u64 = 5;
/// Nobody changes nearer to the junction behind, whose drivers look at whole lanes, m.
const CLEAR: f64 = 12.0;
/// A change of lanes takes so much of the road even at a walk, m: four metres aside at the greatest steepness.
pub(super) const CHANGE_ROOM: f64 = 4.0 / STEEPNESS + 1.0;
/// One begins no change for speed that would not be done this long before the stop line, s.
const BEFORE_LINE: f64 = 5.0;
/// What a lane of one's own is worth, m/s²: buses keep to bus lanes, riders to cycle lanes and else to the right.
const OWN_LANE: f64 = 2.0;
/// Who stands in a lane that does not lead on for so long looks for another way, s.
const PATIENCE: f64 = 40.0;

/// A body in a lane that it has not quite left.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Ghost {
    lane: Track,
    /// Its rear there, m.
    rear: f64,
    length: f64,
    v: f64,
}

/// Who is before and behind a place in a lane.
struct Neighbours {
    ahead: Option<(f64, f64)>,
    behind: Option<(f64, f64)>,
    rank: usize,
}

impl VehicleManager {
    /// Moves those over who are changing, and lists where they still are.
    pub(super) fn shift(&mut self, tracks: &Tracks, dt: f64) {
        let mut shifting = std::mem::take(&mut self.shifting);
        self.ghosts.clear();
        shifting.retain(|id| {
            let lane = self.paths[*id as usize].track;
            let Some(vehicle) = self.queues[lane as usize].iter_mut().find(|v| v.id == *id) else {
                return false;
            };
            let step = SIDEWAYS.min(STEEPNESS * vehicle.v) * dt;
            let left = vehicle.shift.abs() - step;
            vehicle.shift = if left <= 0.0 { 0.0 } else { left.copysign(vehicle.shift) };
            if left > OUT
                && let Some(old) = old_lane(tracks, lane, vehicle)
            {
                let station = vehicle.s * tracks.length[old as usize] / tracks.length[lane as usize];
                self.ghosts.push(Ghost::of(vehicle, old, station));
            }
            vehicle.shift != 0.0
        });
        self.shifting = shifting;
        sort(&mut self.ghosts);
    }

    /// Lets those change who want to and may, a fifth of all in each step.
    pub(super) fn change_lanes(&mut self, tracks: &Tracks, config: &TrafficConfig, step: u64) {
        for index in 0..self.active.len() {
            let lane = self.active[index];
            if tracks.beside.get(lane as usize).is_none_or(|beside| *beside == [NONE; 2]) {
                continue;
            }
            let mut rank = 0;
            while let Some(vehicle) = self.queues[lane as usize].get(rank).copied() {
                rank += 1;
                let is_its_turn = (step + u64::from(vehicle.id)).is_multiple_of(EVERY);
                if is_its_turn && may_change(tracks, lane, &vehicle) {
                    // Who leaves makes the next take its rank.
                    rank -= usize::from(self.consider(tracks, config, lane, rank - 1));
                }
            }
        }
        self.active.sort_unstable();
        self.active.dedup();
        let queues = &self.queues;
        self.active.retain(|track| !queues[*track as usize].is_empty());
    }

    fn consider(&mut self, tracks: &Tracks, config: &TrafficConfig, lane: Track, rank: usize) -> bool {
        let vehicle = self.queues[lane as usize][rank];
        let must = vehicle.next == NONE;
        let to_end = tracks.length[lane as usize] - vehicle.s;
        if !must && to_end < BEFORE_LINE * vehicle.v + 10.0 {
            return false;
        }
        let kind = config.vehicle_type(vehicle.row).kind;
        let wanted = self.next_leg(tracks, &vehicle);
        let mut best: Option<(f64, Track, u32, usize)> = None;
        let sides = tracks.beside[lane as usize].into_iter();
        for target in sides.filter(|target| *target != NONE && tracks.may_use(*target, kind)) {
            // A lane on the way to one that leads on is a step towards it.
            let towards = |leg| (must && leads_towards(tracks, lane, target, leg, kind)).then_some(NONE);
            let way = if vehicle.next == EXIT {
                Some(EXIT)
            } else {
                wanted.and_then(|leg| tracks.way_to(target, leg, kind).or_else(|| towards(leg)))
            };
            let Some(way) = way else { continue };
            if let Some((gain, place)) = self.gain(tracks, config, lane, rank, target, must)
                && best.is_none_or(|best| gain > best.0)
            {
                best = Some((gain, target, way, place));
            }
        }
        let Some((_, target, way, place)) = best else { return false };
        self.move_over(tracks, lane, rank, target, way, place);
        true
    }

    /// The leg to which a vehicle wants to go from its lane.
    fn next_leg(&self, tracks: &Tracks, vehicle: &Vehicle) -> Option<Leg> {
        let path = &self.paths[vehicle.id as usize];
        if let Some(route) = self.routes.get(path.route as usize) {
            return route.0.get(path.leg as usize + 1).copied();
        }
        let way = tracks.network.connections.get(vehicle.next as usize)?;
        Some(Leg::of(&tracks.network, way.to))
    }

    /// The advantage of a lane, m/s², and the place in its queue; `None` if it is not safe or not worth it.
    fn gain(
        &self,
        tracks: &Tracks,
        config: &TrafficConfig,
        lane: Track,
        rank: usize,
        target: Track,
        must: bool,
    ) -> Option<(f64, usize)> {
        let mobil = &config.mobil;
        let queue = &self.queues[lane as usize];
        let vehicle = queue[rank];
        let row = config.vehicle_type(vehicle.row);
        let idm = &row.driver;
        let length = vehicle.length();
        let scale = tracks.length[target as usize] / tracks.length[lane as usize];
        let s = vehicle.s * scale;
        if s >= tracks.length[target as usize] - 1.0 || (s - length) < 0.5 {
            return None;
        }
        let there = self.neighbours(target, s, length);
        let free = |lane: Track| row.free_speed(config, vehicle.factor, tracks.speed[lane as usize]);
        let ahead = there.ahead.map_or(f64::INFINITY, |(rear, _)| rear - s);
        let behind = there.behind.map_or(f64::INFINITY, |(front, _)| s - length - front);
        let least = if vehicle.v < 1.0 { 0.5 } else { idm.gap * 0.5 };
        if ahead < least || behind < least {
            return None;
        }
        // Who has leave to cross is not cut off: the junction waits for it.
        let follower = self.queues[target as usize].get(there.rank);
        if follower.is_some_and(|follower| follower.holding != NONE && follower.holding == follower.next) {
            return None;
        }
        // Whoever comes out of the junction behind has not joined the queue yet.
        if there.behind.is_none() && self.inbound[target as usize] > 0.0 && s - length < 25.0 {
            return None;
        }
        let mine = idm.acceleration(vehicle.v, free(target), ahead, there.ahead.map_or(0.0, |a| a.1));
        let follower = follower.map(|other| {
            let row = config.vehicle_type(other.row);
            let free = row.free_speed(config, other.factor, tracks.speed[target as usize]);
            let alone = there.ahead.map_or(f64::INFINITY, |(rear, _)| rear - (s - length - behind));
            let before = row.driver.acceleration(other.v, free, alone, there.ahead.map_or(0.0, |a| a.1));
            (before, row.driver.acceleration(other.v, free, behind, vehicle.v))
        });
        let safe = -mobil.safe_braking;
        if mine < safe || follower.is_some_and(|(_, after)| after < safe) {
            return None;
        }
        if must {
            return Some((1e3 + mine, there.rank));
        }
        let (now, left_behind) = staying(config, tracks, queue, rank, lane);
        let own = f64::from(tracks.suits(target, row.kind) - tracks.suits(lane, row.kind)) * OWN_LANE;
        let loss = follower.map_or(0.0, |(before, after)| before - after);
        let gain = mine - now + own + mobil.politeness * (left_behind - loss);
        (gain > mobil.threshold).then_some((gain, there.rank))
    }

    /// Those around a place in a lane, bodies that are changing out of it included.
    fn neighbours(&self, lane: Track, s: f64, length: f64) -> Neighbours {
        let queue = &self.queues[lane as usize];
        let rank = queue.partition_point(|other| other.s >= s);
        let mut ahead = rank.checked_sub(1).map(|rank| (queue[rank].s - queue[rank].length(), queue[rank].v));
        let behind = queue.get(rank).map(|other| (other.s, other.v));
        let from = self.ghosts.partition_point(|ghost| ghost.lane < lane);
        // One that is beside the place counts as ahead, with a gap that forbids the change.
        for ghost in self.ghosts[from..].iter().take_while(|ghost| ghost.lane == lane) {
            let beside = ghost.rear + ghost.length > s - length - 1.0;
            if beside && ahead.is_none_or(|ahead| ghost.rear < ahead.0) {
                ahead = Some((ghost.rear, ghost.v));
            }
        }
        Neighbours { ahead, behind, rank }
    }

    fn move_over(
        &mut self,
        tracks: &Tracks,
        lane: Track,
        rank: usize,
        target: Track,
        way: u32,
        place: usize,
    ) {
        let Some(mut vehicle) = self.queues[lane as usize].remove(rank) else { return };
        vehicle.s *= tracks.length[target as usize] / tracks.length[lane as usize];
        vehicle.next = way;
        let to_left = tracks.beside[lane as usize][0] == target;
        let apart = tracks.apart(lane, target);
        // It still stands in its old lane: to the right of the new one if it goes left.
        vehicle.shift = if to_left { -apart } else { apart };
        self.paths[vehicle.id as usize].track = target;
        self.paths[vehicle.id as usize].before = target;
        let station = vehicle.s * tracks.length[lane as usize] / tracks.length[target as usize];
        self.ghosts.push(Ghost::of(&vehicle, lane, station));
        sort(&mut self.ghosts);
        self.shifting.push(vehicle.id);
        self.queues[target as usize].insert(place, vehicle);
        self.active.push(target);
        self.changes += 1;
    }

    /// The body before a place in a lane that is being left, for whoever is still in it: its rear and speed.
    pub(super) fn ahead_in_old_lane(
        &self,
        tracks: &Tracks,
        lane: Track,
        vehicle: &Vehicle,
    ) -> Option<(f64, f64)> {
        if vehicle.shift.abs() <= OUT {
            return None;
        }
        let old = old_lane(tracks, lane, vehicle)?;
        let s = vehicle.s * tracks.length[old as usize] / tracks.length[lane as usize];
        let queue = &self.queues[old as usize];
        let leader = queue.partition_point(|other| other.s >= s).checked_sub(1).map(|rank| &queue[rank]);
        let leader = leader.map(|leader| (leader.s - leader.length() - s, leader.v));
        // Another may be on its way out of the same lane.
        let ghost = first_ghost(&self.ghosts, old, s);
        [leader, ghost].into_iter().flatten().min_by(|a, b| a.0.total_cmp(&b.0))
    }

    /// Those who have stood too long in a lane that does not lead on take a way that does, and their route anew from there.
    pub(super) fn lose_patience(&mut self, tracks: &Tracks, counters: &mut crate::Counters) {
        for index in 0..self.active.len() {
            let lane = self.active[index];
            if lane as usize >= tracks.lanes {
                break; // lanes come first
            }
            let Some(vehicle) = self.queues[lane as usize].front() else { continue };
            if vehicle.next != NONE || vehicle.stood < PATIENCE || vehicle.shift != 0.0 {
                continue;
            }
            let id = vehicle.id;
            let mut ways = tracks.network.lanes[lane as usize].outgoing.iter();
            if self.goal(id).is_some() && ways.any(|way| self.take_way(tracks, lane, 0, way.0)) {
                counters.rerouted += 1;
            }
        }
    }

    /// The last leg of the route of a vehicle; none if it turns at random.
    pub(super) fn goal(&self, id: u32) -> Option<Leg> {
        let route = self.paths[id as usize].route;
        self.routes.get(route as usize)?.0.last().copied()
    }

    /// Lets a vehicle of a lane take a way from it, and its route anew from there; false if its end cannot be reached so.
    pub(super) fn take_way(&mut self, tracks: &Tracks, lane: Track, rank: usize, way: u32) -> bool {
        let id = self.queues[lane as usize][rank].id;
        if let Some(goal) = self.goal(id) {
            let after = Leg::of(&tracks.network, tracks.network.connections[way as usize].to);
            let Some(mut rest) = tracks.router.quickest(after, goal) else { return false };
            rest.0.insert(0, Leg::of(&tracks.network, simworld_core::id::LaneId(lane)));
            let path = &mut self.paths[id as usize];
            path.route = self.routes.len() as u32;
            path.leg = 0;
            self.routes.push(rest);
        }
        self.queues[lane as usize][rank].next = way;
        true
    }
}

/// Whole in its lane, with no leave to cross, clear of the junction behind and not yet at the line before it.
fn may_change(tracks: &Tracks, lane: Track, vehicle: &Vehicle) -> bool {
    vehicle.shift == 0.0
        && vehicle.holding == NONE
        && vehicle.s - vehicle.length() > CLEAR
        && tracks.length[lane as usize] - vehicle.s > CHANGE_ROOM
}

/// The acceleration of a vehicle that stays in its lane, and what the one behind it gains if it leaves, m/s².
fn staying(
    config: &TrafficConfig,
    tracks: &Tracks,
    queue: &VecDeque<Vehicle>,
    rank: usize,
    lane: Track,
) -> (f64, f64) {
    let vehicle = &queue[rank];
    let limit = tracks.speed[lane as usize];
    let drive = |other: &Vehicle, gap: f64, leader: f64| {
        let row = config.vehicle_type(other.row);
        row.driver.acceleration(other.v, row.free_speed(config, other.factor, limit), gap, leader)
    };
    let leader = rank.checked_sub(1).map(|rank| &queue[rank]);
    let gap = |s: f64| leader.map_or(f64::INFINITY, |leader| leader.s - leader.length() - s);
    let speed = leader.map_or(0.0, |leader| leader.v);
    let now = drive(vehicle, gap(vehicle.s), speed);
    let gain = queue.get(rank + 1).map_or(0.0, |other| {
        let near = vehicle.s - vehicle.length() - other.s;
        drive(other, gap(other.s), speed) - drive(other, near, vehicle.v)
    });
    (now, gain)
}

/// The lane that a vehicle has not quite left.
fn old_lane(tracks: &Tracks, lane: Track, vehicle: &Vehicle) -> Option<Track> {
    let [left, right] = tracks.beside[lane as usize];
    let old = if vehicle.shift > 0.0 { left } else { right };
    (old != NONE).then_some(old)
}

/// Whether a lane that leads to a leg lies beyond `target`, seen from `lane`.
fn leads_towards(tracks: &Tracks, lane: Track, target: Track, leg: Leg, kind: VehicleKind) -> bool {
    let side = usize::from(tracks.beside[lane as usize][1] == target);
    let mut next = tracks.beside[target as usize][side];
    while next != NONE {
        if tracks.way_to(next, leg, kind).is_some() {
            return true;
        }
        next = tracks.beside[next as usize][side];
    }
    false
}

/// The gap to the first body ahead that is leaving a lane, and its speed.
pub(super) fn first_ghost(ghosts: &[Ghost], lane: Track, s: f64) -> Option<(f64, f64)> {
    // One whose rear is behind one's own front is beside or behind: it minds whoever is before it.
    let start = ghosts.partition_point(|ghost| (ghost.lane, ghost.rear) < (lane, s));
    ghosts.get(start).filter(|ghost| ghost.lane == lane).map(|ghost| (ghost.rear - s, ghost.v))
}

impl Ghost {
    fn of(vehicle: &Vehicle, lane: Track, station: f64) -> Self {
        let length = vehicle.length();
        Self { lane, rear: station - length, length, v: vehicle.v }
    }
}

fn sort(ghosts: &mut [Ghost]) {
    ghosts.sort_by(|a, b| a.lane.cmp(&b.lane).then(a.rear.total_cmp(&b.rear)));
}

#[cfg(test)]
mod tests {
    use super::super::Idm;
    use super::*;

    #[test]
    fn the_defaults_never_ask_for_harder_braking_than_tyres_give() {
        let mobil = Mobil::default();
        assert!(mobil.safe_braking < super::super::HARDEST_BRAKING);
        let idm = Idm::default();
        // A gap of the model's own headway is safe, half a car length at speed is not.
        assert!(idm.acceleration(10.0, 13.9, 12.0, 10.0) > -mobil.safe_braking);
        assert!(idm.acceleration(10.0, 13.9, 2.0, 10.0) < -mobil.safe_braking);
    }
}
