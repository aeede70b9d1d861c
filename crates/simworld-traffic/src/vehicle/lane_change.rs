//! Lane changes: MOBIL for those who would be faster beside, and whatever it takes for those whose way leads on from there.
//!
//! MOBIL (Kesting, Treiber and Helbing 2007): change if one's own gain exceeds the threshold and the politeness times what
//! others lose, and nobody behind has to brake harder than is safe. A vehicle enters the queue of its new lane at once and
//! moves over in some seconds; meanwhile it stands in both: those behind it in the old lane see it there, and it minds
//! who is before it in either.

use serde::{Deserialize, Serialize};
use simworld_core::net::DrivingSide;

use super::VehicleKind;
use super::closures::Closures;
use super::manager::{EXIT, NONE, STANDING, Scene, Vehicle, VehicleManager};
use super::part::{Part, Tail};
use super::patience::PATIENCE;
use super::tracks::{Obstacle, Track, Tracks};
use crate::Leg;
use crate::takeover::LaneWish;

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
pub(super) const STEEPNESS: f64 = 0.25;
/// With less than this to its new lane's middle a body is out of its old lane, m: less where lanes are narrow, so that this
/// wide a body passes.
const OUT: f64 = 0.5;
const PASSES: f64 = 2.0;
/// The drivers of a lane look beside once in so many steps.
const EVERY: u64 = 5;
/// Nobody changes with a rear nearer to the junction behind, m.
const CLEAR: f64 = 12.0;
/// A change of lanes takes so much of the road even at a walk, m: four metres aside at the greatest steepness.
pub(super) const CHANGE_ROOM: f64 = 4.0 / STEEPNESS + 1.0;
/// One begins no change for speed that would not be done this long before the stop line, s.
const BEFORE_LINE: f64 = 5.0;
/// From so far one sees that one's lane is blocked, m.
const BLOCK_SEEN: f64 = 80.0;
/// What a lane of one's own is worth, m/s²: buses keep to bus lanes, riders to cycle lanes and else to the right.
const OWN_LANE: f64 = 2.0;

/// A body in a lane that it has not quite left.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Ghost {
    /// The number of the lane in the part.
    pub(super) lane: u32,
    /// Its rear there, m.
    rear: f64,
    length: f64,
    v: f64,
    /// Whether it stays: a blocked stretch.
    pub(super) is_fixed: bool,
}

impl Ghost {
    /// How those see it who come from the junction behind.
    pub(super) fn as_tail(&self) -> Tail {
        let Self { rear, length, v, .. } = *self;
        Tail { rear, v, length: length as f32, ..Tail::default() }
    }
}

/// Who is before and behind a place in a lane.
struct Neighbours {
    ahead: Option<(f64, f64)>,
    behind: Option<(f64, f64)>,
    rank: usize,
}

impl Part {
    /// Moves those over who are changing, and lists where they still are.
    pub(super) fn shift(&mut self, scene: &Scene<'_>) {
        let mut shifting = std::mem::take(&mut self.shifting);
        self.work.ghosts.clear();
        let layout = self.layout(scene.tracks);
        self.show_blocks(scene);
        shifting.retain(|(local, id)| {
            let lane = layout.tracks[*local as usize];
            let queue = self.slabs.queue_mut(*local as usize);
            let Some(vehicle) = queue.iter_mut().find(|v| v.id == *id) else { return false };
            let step = sideways(vehicle.v) * scene.at.dt;
            let left = f64::from(vehicle.shift.abs()) - step;
            vehicle.shift = if left <= 0.0 { 0.0 } else { (left as f32).copysign(vehicle.shift) };
            if let Some(old) = old_lane(scene.tracks, lane, vehicle)
                && left > out(scene.tracks, lane, old)
            {
                let station = vehicle.s * stretch(scene.tracks, lane, old);
                let old = scene.tracks.layout.local(old) as u32;
                self.work.ghosts.push(Ghost::of(vehicle, old, station));
            }
            vehicle.shift != 0.0
        });
        self.shifting = shifting;
        sort(&mut self.work.ghosts);
    }

    /// Lets those change who want to and may; a fifth of the lanes in each step.
    pub(super) fn change_lanes(&mut self, scene: &Scene<'_>) {
        let layout = self.layout(scene.tracks);
        let mut from = 0;
        while let Some(local) = self.slabs.occupied_from(from).filter(|local| *local < layout.lanes) {
            from = local + 1;
            let lane = layout.tracks[local];
            let is_its_turn = (scene.at.step + u64::from(lane)).is_multiple_of(EVERY);
            if !is_its_turn || scene.tracks.beside[lane as usize] == [NONE; 2] {
                continue;
            }
            let mut rank = 0;
            while let Some(vehicle) = self.slabs.queue(local).get(rank) {
                rank += 1;
                if may_change(scene.tracks, lane, vehicle) {
                    // Who leaves makes the next take its rank.
                    rank -= usize::from(self.consider(scene, lane, rank - 1));
                }
            }
        }
    }

    fn consider(&mut self, scene: &Scene<'_>, lane: Track, rank: usize) -> bool {
        let tracks = scene.tracks;
        let local = tracks.layout.local(lane);
        let vehicle = self.slabs.queue(local)[rank];
        // Who is before a blocked stretch leaves the lane as well, but where he goes is as it was.
        let lost = vehicle.next == NONE;
        let asked = scene.controls.lane_wish(vehicle.id);
        if asked == Some(LaneWish::Keep) {
            return false;
        }
        let block = self.block_ahead(local, rank);
        if block.is_some_and(|gap| gap < CHANGE_ROOM - 4.0) || stays_at_kerb(tracks, lane, &vehicle) {
            return false; // too near to get round it, or where it is to stand
        }
        let makes_way = scene.sirens.is_heard(lane, vehicle.s) && !scene.sirens.is_on(vehicle.id);
        // Nobody halts where he would bar a lane for all, if he can help it.
        let to_kerb =
            vehicle.halt.is_finite() && !tracks.outermost[lane as usize] && !lost && block.is_none();
        let must = lost || block.is_some() || makes_way || asked.is_some() || to_kerb;
        let kerb_is_left = tracks.network.driving_side == DrivingSide::Left;
        let to_end = tracks.length[lane as usize] - vehicle.s;
        if !must && to_end < BEFORE_LINE * vehicle.v + 10.0 {
            return false;
        }
        let kind = scene.config.vehicle_type(vehicle.row).kind;
        let path = &self.slabs.paths(local)[rank];
        let own = || VehicleManager::next_leg(tracks, scene.routes, &vehicle, path);
        let wanted = scene.controls.next_leg(vehicle.id).or_else(own);
        let after = scene.routes.get(path.route as usize);
        let after = after.and_then(|route| route.0.get(path.leg as usize + 2)).copied();
        let mut best: Option<(f64, Track, u32, usize)> = None;
        let sides = tracks.beside[lane as usize].into_iter();
        // Where only a lane for others leads on, one takes it rather than stand for good.
        let may_use =
            |target: Track| tracks.may_use(target, kind) || (lost && vehicle.stood > PATIENCE * 0.5);
        for target in sides.filter(|target| *target != NONE && may_use(*target)) {
            let is_left = tracks.beside[lane as usize][0] == target;
            let is_wrong = asked.is_some_and(|wish| is_left != (wish == LaneWish::Left));
            if is_wrong || (to_kerb && asked.is_none() && is_left != kerb_is_left) {
                continue;
            }
            let blocked = first_block(self.ghosts(tracks.layout.local(target)), vehicle.s);
            if scene.closures.has(target) || blocked.is_some_and(|gap| gap < BLOCK_SEEN) {
                continue;
            }
            // Nobody gets before a siren, but for who has to be there.
            if !lost && scene.sirens.is_heard(target, vehicle.s) && !scene.sirens.is_on(vehicle.id) {
                continue;
            }
            // A lane on the way to one that leads on is a step towards it.
            let towards = |leg| {
                (lost && leads_towards(tracks, scene.closures, lane, target, leg, kind)).then_some(NONE)
            };
            let way = if vehicle.next == EXIT {
                Some(EXIT)
            } else {
                wanted.and_then(|leg| {
                    tracks.way_to(scene.closures, target, leg, after, kind).or_else(|| towards(leg))
                })
            };
            // Who drives it may leave the lane of its route.
            let Some(way) = way.or(asked.map(|_| NONE)) else { continue };
            if let Some((gain, place)) = self.gain(scene, lane, rank, target, must)
                && best.is_none_or(|best| gain > best.0)
            {
                best = Some((gain, target, way, place));
            }
        }
        let Some((_, target, way, place)) = best else { return false };
        self.move_over(scene, lane, rank, target, way, place);
        true
    }

    /// The advantage of a lane, m/s², and the place in its queue; `None` if it is not safe or not worth it.
    fn gain(
        &self,
        scene: &Scene<'_>,
        lane: Track,
        rank: usize,
        target: Track,
        must: bool,
    ) -> Option<(f64, usize)> {
        let Scene { tracks, config, .. } = scene;
        let mobil = &config.mobil;
        let queue = self.slabs.queue(tracks.layout.local(lane));
        let vehicle = queue[rank];
        let row = config.vehicle_type(vehicle.row);
        let idm = &row.driver;
        let length = vehicle.length();
        let s = vehicle.s * stretch(tracks, lane, target);
        if s >= tracks.length[target as usize] - 1.0 || (s - length) < 0.5 {
            return None;
        }
        let there = self.neighbours(tracks.layout.local(target), s, length);
        let free = |lane: Track| row.free_speed(config, vehicle.factor, tracks.speed[lane as usize]);
        let ahead = there.ahead.map_or(f64::INFINITY, |(rear, _)| rear - s);
        let behind = there.behind.map_or(f64::INFINITY, |(front, _)| s - length - front);
        let least = if vehicle.v < 1.0 { 0.5 } else { idm.gap * 0.5 };
        if ahead < least || behind < least {
            return None;
        }
        // Who has leave to cross is not cut off: the junction waits for it.
        let follower = self.slabs.queue(tracks.layout.local(target)).get(there.rank);
        if follower.is_some_and(|follower| follower.holding != NONE && follower.holding == follower.next) {
            return None;
        }
        // Whoever comes out of the junction behind has not joined the queue yet.
        if there.behind.is_none() && scene.junctions.inbound(target) > 0.0 && s - length < 25.0 {
            return None;
        }
        let dt = scene.at.dt;
        let leader_speed = there.ahead.map_or(0.0, |a| a.1);
        let mine = row.drive(vehicle.v, free(target), (ahead, leader_speed), dt);
        let follower = follower.map(|other| {
            let row = config.vehicle_type(other.row);
            let free = row.free_speed(config, other.factor, tracks.speed[target as usize]);
            let alone = there.ahead.map_or(f64::INFINITY, |(rear, _)| rear - (s - length - behind));
            let before = row.drive(other.v, free, (alone, leader_speed), dt);
            (before, row.drive(other.v, free, (behind, vehicle.v), dt))
        });
        let safe = -mobil.safe_braking;
        if mine < safe || follower.is_some_and(|(_, after)| after < safe) {
            return None;
        }
        if must {
            return Some((1e3 + mine, there.rank));
        }
        // With a siren every gain is worth it, and what others lose is nothing.
        let siren = scene.sirens.is_on(vehicle.id);
        let (politeness, threshold) = if siren { (0.0, 0.0) } else { (mobil.politeness, mobil.threshold) };
        let (now, left_behind) = staying(scene, queue, rank, lane);
        let suits = |lane: Track| {
            let stops_there = vehicle.halt.is_finite() && tracks.outermost[lane as usize];
            tracks.suits(lane, row.kind) + 2 * i8::from(stops_there)
        };
        let own = f64::from(suits(target) - suits(lane)) * OWN_LANE;
        let loss = follower.map_or(0.0, |(before, after)| before - after);
        let gain = mine - now + own + politeness * (left_behind - loss);
        (gain > threshold).then_some((gain, there.rank))
    }

    /// Those around a place in a lane, bodies that are changing out of it included.
    fn neighbours(&self, lane: usize, s: f64, length: f64) -> Neighbours {
        let queue = self.slabs.queue(lane);
        let rank = queue.partition_point(|other| other.s >= s);
        let mut ahead = rank.checked_sub(1).map(|rank| (queue[rank].s - queue[rank].length(), queue[rank].v));
        let behind = queue.get(rank).map(|other| (other.s, other.v));
        // One that is beside the place counts as ahead, with a gap that forbids the change.
        for ghost in self.ghosts(lane) {
            let beside = ghost.rear + ghost.length > s - length - 1.0;
            if beside && ahead.is_none_or(|ahead| ghost.rear < ahead.0) {
                ahead = Some((ghost.rear, ghost.v));
            }
        }
        Neighbours { ahead, behind, rank }
    }

    fn move_over(
        &mut self,
        scene: &Scene<'_>,
        lane: Track,
        rank: usize,
        target: Track,
        way: u32,
        place: usize,
    ) {
        let tracks = scene.tracks;
        let (from, to) = (tracks.layout.local(lane), tracks.layout.local(target));
        let Some((mut vehicle, mut path)) = self.slabs.remove(from, rank) else { return };
        let station = vehicle.s;
        vehicle.s *= stretch(tracks, lane, target);
        vehicle.halt *= stretch(tracks, lane, target) as f32;
        vehicle.next = way;
        let to_left = tracks.beside[lane as usize][0] == target;
        let apart = tracks.apart(lane, target) as f32;
        // It still stands in its old lane: to the right of the new one if it goes left.
        vehicle.shift = if to_left { -apart } else { apart };
        path.before = target;
        scene.storage.take(lane, &vehicle, scene.config);
        scene.storage.add(target, &vehicle, scene.config);
        scene.whereabouts.set(vehicle.id as usize, target);
        self.work.ghosts.push(Ghost::of(&vehicle, from as u32, station));
        sort(&mut self.work.ghosts);
        self.shifting.push((to as u32, vehicle.id));
        self.slabs.insert(to, place, vehicle, path);
        self.work.counters.lane_changes += 1;
    }

    /// Lists the blocked stretches of its lanes among the bodies that stand in two lanes.
    fn show_blocks(&mut self, scene: &Scene<'_>) {
        for (lane, from, to) in &scene.closures.blocks {
            if self.layout(scene.tracks).tracks.get(scene.tracks.layout.local(*lane)) == Some(lane) {
                let (lane, length) = (scene.tracks.layout.local(*lane) as u32, to - from);
                self.work.ghosts.push(Ghost { lane, rear: *from, length, v: 0.0, is_fixed: true });
            }
        }
        // Bodies that are on no lane of the traffic's own are in the way of who changes, and one passes those that stand.
        for Obstacle { track, near, far, v, stands } in scene.sight.obstacles.iter().copied() {
            let place = scene.tracks.layout.place(track);
            if place.part == self.number() && (track as usize) < scene.tracks.lanes {
                let (lane, length) = (place.local, far - near);
                self.work.ghosts.push(Ghost { lane, rear: near, length, v, is_fixed: stands });
            }
        }
    }

    /// The gap to what blocks the lane of a vehicle: a blocked stretch, or somebody who halts.
    fn block_ahead(&self, local: usize, rank: usize) -> Option<f64> {
        let queue = self.slabs.queue(local);
        let leader = rank.checked_sub(1).map(|rank| &queue[rank]);
        let halts = leader.filter(|leader| leader.halt.is_finite() && leader.v < STANDING);
        let halts = halts.map(|leader| leader.s - leader.length() - queue[rank].s);
        let block = first_block(self.ghosts(local), queue[rank].s).filter(|gap| *gap < BLOCK_SEEN);
        block.into_iter().chain(halts).min_by(f64::total_cmp)
    }

    /// Bodies that have not quite left a lane, and what blocks it, from back to front.
    fn ghosts(&self, lane: usize) -> &[Ghost] {
        let ghosts = &self.work.ghosts;
        let from = ghosts.partition_point(|ghost| (ghost.lane as usize) < lane);
        let count = ghosts[from..].iter().take_while(|ghost| ghost.lane as usize == lane).count();
        &ghosts[from..from + count]
    }

    /// The body before a place in a lane that is being left, for whoever is still in it: its rear and speed.
    pub(super) fn ahead_in_old_lane(
        &self,
        tracks: &Tracks,
        lane: Track,
        vehicle: &Vehicle,
    ) -> Option<(f64, f64)> {
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
        let (end, leavers) = (tracks.length[track as usize], self.leavers(tracks, track));
        let leaver = leavers.map(|(rear, v)| (end - s + rear, v)).filter(|(gap, _)| *gap > -vehicle.length());
        [leader, ghost].into_iter().flatten().chain(leaver).min_by(|a, b| a.0.total_cmp(&b.0))
    }

    /// Those whose front has left a lane by a junction and whose rear has not: where that is, from the end of the lane, m and
    /// negative; and their speeds.
    fn leavers(&self, tracks: &Tracks, lane: Track) -> impl Iterator<Item = (f64, f64)> {
        tracks.network.lanes[lane as usize].outgoing.iter().filter_map(|way| {
            let track = tracks.lanes as Track + way.0;
            let last = self.slabs.queue(tracks.layout.local(track)).last()?;
            let rear = last.s - last.length();
            (rear < 0.0).then_some((rear, last.v))
        })
    }
}

/// How quickly a vehicle moves aside at a speed, m/s.
pub(super) fn sideways(v: f64) -> f64 {
    SIDEWAYS.min(STEEPNESS * v)
}

/// How much longer one lane is than another beside it: stations along them are in proportion.
fn stretch(tracks: &Tracks, from: Track, to: Track) -> f64 {
    tracks.length[to as usize] / tracks.length[from as usize]
}

/// How far from the junction behind a rear must be for a change, m; less on lanes that would leave no room for it.
pub(super) fn clear(lane: f64, vehicle: &Vehicle) -> f64 {
    (lane - vehicle.length() - CHANGE_ROOM - 2.5).clamp(1.0, CLEAR)
}

/// Whole in its lane, with no leave to cross, clear of the junction behind and not yet at the line before it.
fn may_change(tracks: &Tracks, lane: Track, vehicle: &Vehicle) -> bool {
    vehicle.shift == 0.0
        && vehicle.holding == NONE
        && vehicle.s - vehicle.length() > clear(tracks.length[lane as usize], vehicle)
        && tracks.length[lane as usize] - vehicle.s > CHANGE_ROOM
}

/// The acceleration of a vehicle that stays in its lane, and what the one behind it gains if it leaves, m/s².
fn staying(scene: &Scene<'_>, queue: &[Vehicle], rank: usize, lane: Track) -> (f64, f64) {
    let Scene { tracks, config, at, .. } = scene;
    let vehicle = &queue[rank];
    let limit = tracks.speed[lane as usize];
    let drive = |other: &Vehicle, gap: f64, leader: f64| {
        let row = config.vehicle_type(other.row);
        row.drive(other.v, row.free_speed(config, other.factor, limit), (gap, leader), at.dt)
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

/// How near to the middle of its new lane a body must be to be out of the old one, m.
fn out(tracks: &Tracks, lane: Track, old: Track) -> f64 {
    (tracks.apart(lane, old) - PASSES).clamp(0.0, OUT)
}

/// The lane that a vehicle has not quite left.
fn old_lane(tracks: &Tracks, lane: Track, vehicle: &Vehicle) -> Option<Track> {
    let [left, right] = tracks.beside[lane as usize];
    let old = if vehicle.shift > 0.0 { left } else { right };
    (old != NONE).then_some(old)
}

/// Whether a lane that leads to a leg lies beyond `target`, seen from `lane`.
fn leads_towards(
    tracks: &Tracks,
    closures: &Closures,
    lane: Track,
    target: Track,
    leg: Leg,
    kind: VehicleKind,
) -> bool {
    let side = usize::from(tracks.beside[lane as usize][1] == target);
    let mut next = tracks.beside[target as usize][side];
    while next != NONE {
        if tracks.way_to(closures, next, leg, None, kind).is_some() {
            return true;
        }
        next = tracks.beside[next as usize][side];
    }
    false
}

/// Whether a vehicle is where it is to halt, or there in a moment.
fn stays_at_kerb(tracks: &Tracks, lane: Track, vehicle: &Vehicle) -> bool {
    let is_near = f64::from(vehicle.halt) - vehicle.s < CHANGE_ROOM;
    vehicle.halt.is_finite() && (tracks.outermost[lane as usize] || is_near)
}

/// The gap to the first blocked stretch ahead.
pub(super) fn first_block(ghosts: &[Ghost], s: f64) -> Option<f64> {
    let start = ghosts.partition_point(|ghost| ghost.rear < s);
    ghosts[start..].iter().find(|ghost| ghost.is_fixed).map(|ghost| ghost.rear - s)
}

/// The gap to the first body ahead that is leaving a lane, and its speed.
pub(super) fn first_ghost(ghosts: &[Ghost], s: f64) -> Option<(f64, f64)> {
    // One whose rear is behind one's own front is beside or behind: it minds whoever is before it.
    let start = ghosts.partition_point(|ghost| ghost.rear < s);
    ghosts.get(start).map(|ghost| (ghost.rear - s, ghost.v))
}

impl Ghost {
    fn of(vehicle: &Vehicle, lane: u32, station: f64) -> Self {
        let length = vehicle.length();
        Self { lane, rear: station - length, length, v: vehicle.v, is_fixed: false }
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
