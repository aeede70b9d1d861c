//! One part of the network: its vehicles, and how they move along its tracks and out of it.

use std::hint::black_box;

use serde::{Deserialize, Serialize};

use super::clock::Clock;
use super::driving::idm::advance;
use super::driving::lookahead::{self, Lane};
use super::driving::sirens::passes_red;
use super::foreign::controls::obey;
use super::junctions::clusters::Wish;
use super::junctions::junction::{Request, ticks};
use super::junctions::trailing::Trail;
use super::manager::{EXIT, NONE, STANDING, Vehicle};
use super::queues::claims::Claims;
use super::queues::ghosts::Ghost;
use super::queues::path::Path;
use super::queues::slabs::{Cursor, Slabs};
use super::queues::tail::Tail;
use super::scene::Scene;
use super::tracks::layout::PartLayout;
use super::tracks::meeting::Held;
use super::tracks::{Track, Tracks, Way};
use super::trips::entry::trip;
use crate::{Counters, Trip, TripEnd};

/// Standing longer than this is counted, s.
const LONG: f64 = 180.0;
/// A rear so far into its lane has cleared the junction behind it, m.
pub(super) const CLEARED: f64 = 0.3;
/// No vehicle is so long, m.
const LONGEST: f64 = 60.0;

/// A vehicle that passes to another lane by a junction.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Transfer {
    pub(crate) lane: Track,
    pub(crate) vehicle: Vehicle,
    pub(crate) path: Path,
}

/// What is kept from step to step only to spare the heap, and what a step gives out.
#[derive(Clone, Debug, Default)]
pub(crate) struct Work {
    pub(super) ghosts: Vec<Ghost>,
    /// Lanes that have such, a bit each.
    pub(super) haunted: Vec<u64>,
    pub(super) accelerations: Vec<f64>,
    pub(super) weights: Vec<f64>,
    /// Who is driven by somebody else: the number of the track in the part, and of the vehicle.
    pub(super) steered: Vec<(u32, u32)>,
    pub(super) requests: Vec<Request>,
    /// Lanes behind an intersection whose room is kept for one who has waited too long, and for whom.
    pub(super) reserved: Vec<(Track, u32)>,
    /// Ways at an intersection by which somebody goes who has waited far too long: those that meet them are left to him.
    pub(super) let_in: Vec<u32>,
    /// Whom one who asks for leave would overtake in the order of leave: lane and rank.
    pub(super) overtaken: Vec<(u32, u32)>,
    /// Its ways that somebody holds, while accelerations are computed.
    pub(super) held: Held,
    /// Tracks on which somebody holds a way, a bit each.
    busy: Vec<u64>,
    /// Tracks whose front left them in this step.
    passed: Vec<u32>,
    /// The last vehicle of each lane, and the lanes that were shown to have one, a bit each.
    pub(super) tails: Vec<Tail>,
    shown: Vec<u64>,
    /// Who leaves for the lanes of each part.
    pub(super) handed: Vec<Vec<Transfer>>,
    pub(super) ended: Vec<Trip>,
    /// Ways that are to be cleared in the third phase, by whom.
    cleared: Vec<(u32, bool)>,
    /// Lanes that were left in this step, and the room that is free there, in ticks.
    left: Vec<(Track, u32)>,
    pub(super) counters: Counters,
    /// Who began to trail in this step.
    pub(super) trails: Vec<Trail>,
    /// Who wants to enter a cluster of junctions.
    pub(super) wishes: Vec<Wish>,
    /// Lanes whose first has lost patience.
    pub(super) stuck: Vec<Track>,
    /// Who entered by a pass.
    pub(super) used_passes: Vec<u32>,
}

/// One part of the network, worked on by one thread at a time.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(crate) struct Part {
    number: u32,
    pub(crate) slabs: Slabs,
    /// How often leave was given: the last place in the order.
    pub(super) leaves: u32,
    /// Who is changing lanes: the number of the lane in the part, and of the vehicle.
    pub(super) shifting: Vec<(u32, u32)>,
    /// How it goes by the clock.
    pub(super) clock: Clock,
    #[serde(skip)]
    pub(super) work: Work,
}

impl Part {
    pub(super) fn new(number: usize, slabs: Slabs) -> Self {
        Self { number: number as u32, slabs, ..Self::default() }
    }

    /// Which part it is.
    pub(super) fn number(&self) -> u32 {
        self.number
    }

    /// Its tracks.
    #[inline]
    pub(super) fn layout<'a>(&self, tracks: &'a Tracks) -> &'a PartLayout {
        &tracks.layout.parts[self.number as usize]
    }

    /// The first phase: lane changes.
    pub(super) fn arrange(&mut self, scene: &Scene<'_>) {
        if self.clock.is_due() {
            let scene = &self.clock.scene(scene);
            self.shift(scene);
            self.change_lanes(scene);
        } else if !self.clock.is_watched() {
            return;
        }
        self.show_tails(scene.passes, self.layout(scene.tracks).lanes);
        self.show_leavers(scene);
        self.show_ghosts();
        self.show_trails(scene);
    }

    fn show_tails(&mut self, passes: &[u32], lanes: usize) {
        let Work { tails, shown, .. } = &mut self.work;
        if tails.len() != lanes {
            *tails = vec![Tail::default(); lanes];
        }
        shown.resize(lanes.div_ceil(64), 0);
        for (word, shown) in shown.iter_mut().enumerate() {
            // Those that have somebody are shown anew whole.
            let mut left = *shown & !self.slabs.word(word);
            while left != 0 {
                tails[word * 64 + left.trailing_zeros() as usize] = Tail::default();
                left &= left - 1;
            }
            *shown = 0;
        }
        for lane in self.slabs.occupied().take_while(|lane| *lane < lanes) {
            let [first, ..] = self.slabs.queue(lane) else { continue };
            let last = self.slabs.queue(lane).last().unwrap_or(first);
            let closes_up = !passes.is_empty() && passes.binary_search(&first.id).is_ok();
            tails[lane] = Tail::of(last).closing_up(closes_up);
            shown[lane / 64] |= 1 << (lane % 64);
        }
    }

    /// Shows those whose front has left a lane by a junction and whose rear has not, where nobody is behind them.
    fn show_leavers(&mut self, scene: &Scene<'_>) {
        let (tracks, layout) = (scene.tracks, self.layout(scene.tracks));
        let mut at = self.slabs.cursor(layout.lanes);
        while let Some(local) = self.slabs.next(&mut at) {
            let Some(last) = self.slabs.queue(local).last() else { continue };
            let way = layout.tracks[local] as usize - tracks.lanes;
            let Some(leaver) = Tail::of_leaver(tracks, way, last) else { continue };
            let local = tracks.layout.local(tracks.ways[way].from);
            if self.work.tails[local].see_leaver(&leaver) {
                self.work.shown[local / 64] |= 1 << (local % 64);
            }
        }
    }

    /// Shows bodies that have not quite left a lane, where nobody is behind them.
    fn show_ghosts(&mut self) {
        let Work { tails, shown, ghosts, .. } = &mut self.work;
        for ghost in ghosts.iter().filter(|ghost| !ghost.is_fixed) {
            let tail = ghost.as_tail();
            if tail.rear < tails[ghost.lane as usize].rear {
                tails[ghost.lane as usize] = tail;
                shown[ghost.lane as usize / 64] |= 1 << (ghost.lane % 64);
            }
        }
    }

    /// Shows the rears of those whose front may be elsewhere as the ends of their lanes.
    fn show_trails(&mut self, scene: &Scene<'_>) {
        for (lane, tail) in scene.trails.iter().map(Trail::shown) {
            let place = scene.tracks.layout.place(lane);
            if place.part == self.number {
                self.work.tails[place.local as usize] = tail;
                self.work.shown[place.local as usize / 64] |= 1 << (place.local % 64);
            }
        }
    }

    /// The second phase: leave to cross, accelerations, motion.
    pub(super) fn drive(&mut self, scene: &Scene<'_>) {
        self.work.handed.resize_with(scene.tails.len(), Vec::new);
        self.work.handed.iter_mut().for_each(Vec::clear);
        if !self.clock.is_due() {
            return;
        }
        let scene = &self.clock.scene(scene);
        self.rule(scene);
        self.accelerate(scene);
        self.integrate(scene);
        self.pass_on(scene);
        self.claim(scene);
    }

    fn accelerate(&mut self, scene: &Scene<'_>) {
        let mut accelerations = std::mem::take(&mut self.work.accelerations);
        accelerations.clear();
        self.list_steered(scene);
        let layout = self.layout(scene.tracks);
        let lanes = scene.tracks.lanes as Track;
        self.work.held.look(layout, |way| scene.junctions.is_held(way - lanes));
        let mut steered = &self.work.steered[..];
        let mut ghosts = &self.work.ghosts[..];
        for local in self.slabs.occupied() {
            let from = ghosts.iter().position(|ghost| ghost.lane as usize >= local).unwrap_or(ghosts.len());
            let until = from + ghosts[from..].iter().take_while(|ghost| ghost.lane as usize == local).count();
            let own_ghosts = &ghosts[from..until];
            let lane = Lane::new(self, scene, local, own_ghosts);
            ghosts = &ghosts[until..];
            let (queue, first) = (self.slabs.queue(local), accelerations.len());
            lookahead::accelerations(&lane, queue, &mut accelerations);
            if steered.first().is_some_and(|first| first.0 as usize <= local) {
                let count = steered.partition_point(|(track, _)| *track as usize <= local);
                let (here, others) = steered.split_at(count);
                steered = others;
                let hasty = Scene { config: scene.hasty, drivers: scene.hasty_drivers, ..*scene };
                let lane = Lane::new(self, &hasty, local, own_ghosts);
                obey(scene, &lane, queue, here.iter().map(|(_, id)| *id), &mut accelerations[first..]);
            }
        }
        self.work.accelerations = accelerations;
    }

    /// Reads what the first of the lanes of a word of bits will look at: the way on, its signal and the tail behind it, one right after
    /// the other. In a long step far from all interest nobody else has looked at them lately, and processors wait for many such places of
    /// the memory at once.
    pub(super) fn touch_ahead(&self, scene: &Scene<'_>, word: usize) {
        let (tracks, layout) = (scene.tracks, self.layout(scene.tracks));
        let ahead = |local: usize| {
            let way = tracks.ways.get(self.slabs.queue(local).first()?.next as usize)?;
            Some(scene.tail(way.to).granted ^ scene.aspect(way.signal) as u32)
        };
        let lanes = (word * 64..layout.lanes).take(64);
        black_box(lanes.filter_map(ahead).fold(0, |all, seen| all ^ seen));
    }

    fn integrate(&mut self, scene: &Scene<'_>) {
        let dt = scene.at.dt;
        let layout = self.layout(scene.tracks);
        let Work { accelerations, passed, busy, counters, .. } = &mut self.work;
        passed.clear();
        busy.clear();
        busy.resize(layout.tracks.len().div_ceil(64), 0);
        let mut accelerations = &accelerations[..];
        let mut at = Cursor::default();
        while let Some(local) = self.slabs.next(&mut at) {
            let end = layout.measures[local].length;
            let queue = self.slabs.queue_mut(local);
            let (own, rest) = accelerations.split_at(queue.len());
            accelerations = rest;
            counters.updates += queue.len() as u64;
            // Those who decide in every step keep their distance by themselves.
            let (mut ahead, is_long) = (f64::INFINITY, self.clock.is_long());
            let mut somebody_holds = false;
            for (vehicle, acceleration) in queue.iter_mut().zip(own) {
                let (v, way) = advance(vehicle.v, *acceleration, dt);
                let old = vehicle.s;
                vehicle.s += way;
                vehicle.v = v;
                vehicle.acceleration = *acceleration as f32;
                if vehicle.s >= end && local < layout.lanes && !may_pass(vehicle) {
                    // A stop line is never passed without leave, whatever the brakes would say.
                    vehicle.s = end - 1e-6;
                    vehicle.v = 0.0;
                    counters.forced_stops += 1;
                }
                if is_long && vehicle.s > ahead {
                    vehicle.s = ahead.max(old);
                    vehicle.v = 0.0;
                    counters.forced_stops += 1;
                }
                ahead = vehicle.s - vehicle.length();
                somebody_holds |= vehicle.holding != NONE;
                let before = vehicle.stood;
                vehicle.stood = if vehicle.v < STANDING { before + dt } else { 0.0 };
                if before < LONG && vehicle.stood >= LONG {
                    counters.long_waits += 1;
                }
            }
            busy[local / 64] |= u64::from(somebody_holds) << (local % 64);
            if queue.first().is_some_and(|front| front.s >= end) {
                passed.push(local as u32);
            }
        }
    }

    /// Moves vehicles whose front left their track to the next.
    fn pass_on(&mut self, scene: &Scene<'_>) {
        let passed = std::mem::take(&mut self.work.passed);
        let layout = self.layout(scene.tracks);
        for local in passed.iter().map(|local| *local as usize) {
            let (track, end) = (layout.tracks[local], layout.measures[local].length);
            while self.slabs.queue(local).first().is_some_and(|front| front.s >= end) {
                let Some((vehicle, path)) = self.slabs.remove(local, 0) else { break };
                if local < layout.lanes {
                    self.work.left.push((track, ticks(&vehicle, scene.config)));
                }
                if local >= layout.lanes {
                    self.hand_over(scene, track, vehicle, path);
                } else if vehicle.next == EXIT {
                    self.arrive(scene, track, &vehicle, &path);
                } else {
                    self.enter_way(scene, track, vehicle, path);
                }
            }
        }
        self.work.passed = passed;
    }

    fn arrive(&mut self, scene: &Scene<'_>, track: Track, vehicle: &Vehicle, path: &Path) {
        if vehicle.holding != NONE {
            self.work.cleared.push((vehicle.holding, vehicle.is_long()));
        }
        scene.whereabouts.set(vehicle.id as usize, NONE);
        let now = scene.at.now + scene.at.dt;
        // Who left the map since nothing led where he wanted to go has not arrived.
        let is_off = scene.off.binary_search(&path.route).is_ok();
        let end = if is_off { TripEnd::NoWay } else { TripEnd::Arrived };
        self.work.ended.push(trip(scene.tracks, scene.config, track, (vehicle, path), end, now));
        self.work.counters.arrived += u64::from(!is_off);
        self.work.counters.removed += u64::from(is_off);
    }

    /// From a lane onto the way that it holds.
    fn enter_way(&mut self, scene: &Scene<'_>, lane: Track, mut vehicle: Vehicle, mut path: Path) {
        let tracks = scene.tracks;
        self.work.counters.reds_by_siren += u64::from(passes_red(scene, &vehicle, vehicle.next));
        leave_behind(scene, lane, &mut vehicle, &mut path);
        let track = tracks.lanes as Track + vehicle.next;
        let Way { local, length, .. } = tracks.ways[vehicle.next as usize];
        scene.whereabouts.set(vehicle.id as usize, track);
        if vehicle.s >= length {
            // A step longer than the whole way across: on to the lane behind it.
            self.hand_over(scene, track, vehicle, path);
            return;
        }
        self.add(local as usize, vehicle, path);
    }

    /// Puts a vehicle that holds a way at the back of a track.
    fn add(&mut self, local: usize, vehicle: Vehicle, path: Path) {
        self.work.busy[local / 64] |= 1 << (local % 64);
        self.slabs.push(local, vehicle, path);
    }

    /// From a way to the lane behind it, wherever that is kept.
    fn hand_over(&mut self, scene: &Scene<'_>, way: Track, mut vehicle: Vehicle, mut path: Path) {
        leave_behind(scene, way, &mut vehicle, &mut path);
        let Way { to: lane, there, .. } = scene.tracks.ways[way as usize - scene.tracks.lanes];
        self.work.handed[there.part as usize].push(Transfer { lane, vehicle, path });
    }

    /// Those who hold ways claim the crossings that they have not passed, or clear what is behind them.
    fn claim(&mut self, scene: &Scene<'_>) {
        let claims = scene.junctions.claims_of(&self.clock);
        let layout = self.layout(scene.tracks);
        let Self { slabs, work: Work { busy, cleared, .. }, .. } = self;
        for (word, bits) in busy.iter().enumerate() {
            let mut bits = *bits;
            while bits != 0 {
                let local = word * 64 + bits.trailing_zeros() as usize;
                bits &= bits - 1;
                let queue = slabs.queue_mut(local);
                if local < layout.lanes {
                    claims.claim_ahead(scene.tracks, queue, layout.measures[local].length);
                    let behind = queue.iter_mut().rev().take_while(|vehicle| vehicle.s <= LONGEST);
                    cleared.extend(behind.filter_map(|vehicle| clear_behind(scene, claims, vehicle)));
                } else {
                    for vehicle in queue.iter() {
                        claims.claim(scene.tracks, vehicle, vehicle.s);
                    }
                }
            }
        }
    }

    /// The third phase: those handed over join their lanes, junctions are cleared.
    pub(super) fn settle(&mut self, scene: &Scene<'_>) {
        self.receive(scene);
        if !self.clock.is_due() {
            return;
        }
        self.clock.end();
        for (lane, ticks) in self.work.left.drain(..) {
            scene.storage.take_ticks(lane, ticks);
        }
        for (way, is_long) in self.work.cleared.drain(..) {
            scene.junctions.clear_way(way, is_long);
        }
    }

    fn receive(&mut self, scene: &Scene<'_>) {
        let mut weights = std::mem::take(&mut self.work.weights);
        let number = self.number as usize;
        for transfer in scene.handed.iter().filter_map(|from| from.get(number)).flatten() {
            let Transfer { lane, mut vehicle, mut path } = *transfer;
            scene.junctions.arrive(lane, &vehicle, scene.config);
            scene.storage.add(lane, &vehicle, scene.config);
            path.leg += 1;
            vehicle.next = scene.choose(&mut weights, &vehicle, &mut path, lane);
            vehicle.halt = scene.halts.on(scene.tracks, scene.config, &vehicle, lane);
            scene.whereabouts.set(vehicle.id as usize, lane);
            self.line_up(scene, lane, vehicle, path);
        }
        self.work.weights = weights;
    }

    /// Puts one who was handed over into the queue of its lane. After a long step two who came by different ways may be told in
    /// another order than they stand in, and one may have come farther than there is room.
    fn line_up(&mut self, scene: &Scene<'_>, lane: Track, mut vehicle: Vehicle, path: Path) {
        let local = scene.tracks.layout.local(lane);
        let queue = self.slabs.queue(local);
        let rank = queue.len() - queue.iter().rev().take_while(|other| other.s < vehicle.s).count();
        let rear = rank.checked_sub(1).map_or(f64::INFINITY, |ahead| queue[ahead].s - queue[ahead].length());
        if vehicle.s > rear.max(0.0) {
            (vehicle.s, vehicle.v) = (rear.max(0.0), 0.0);
            self.work.counters.forced_stops += 1;
        }
        let claims = scene.junctions.claims_of(&self.clock);
        if self.clock.is_due() {
            self.work.cleared.extend(clear_behind(scene, claims, &mut vehicle));
        } else {
            // Its rear is on the way behind until this part has its turn.
            let length = scene.tracks.ways[vehicle.holding as usize].length;
            claims.claim(scene.tracks, &vehicle, vehicle.s + length);
        }
        self.slabs.insert(local, rank, vehicle, path);
    }

    pub(super) fn fits(&self, layout: &PartLayout) -> bool {
        self.slabs.tracks() == layout.tracks.len()
            && self.clock.is_sound()
            && self.shifting.iter().all(|(lane, _)| (*lane as usize) < layout.lanes)
    }

    pub(super) fn bytes(&self) -> usize {
        let work = &self.work;
        self.slabs.bytes()
            + (work.accelerations.capacity() + work.weights.capacity()) * 8
            + work.tails.capacity() * size_of::<Tail>()
            + work.handed.iter().map(|handed| handed.capacity() * size_of::<Transfer>()).sum::<usize>()
    }
}

/// Whether a vehicle at the end of its lane may go on.
fn may_pass(vehicle: &Vehicle) -> bool {
    vehicle.next == EXIT || (vehicle.next != NONE && vehicle.holding == vehicle.next)
}

/// Counts a track that a vehicle has left.
fn leave_behind(scene: &Scene<'_>, track: Track, vehicle: &mut Vehicle, path: &mut Path) {
    let (length, speed) = (scene.tracks.length[track as usize], scene.tracks.speed[track as usize]);
    vehicle.s -= length;
    let row = scene.config.vehicle_type(vehicle.row);
    path.add(length, length / row.free_speed(scene.config, vehicle.factor, speed));
    path.before = track;
}

/// The way behind one at the beginning of a lane, if its rear has left that and it gives it free now; until then it claims the
/// crossings there.
fn clear_behind(scene: &Scene<'_>, claims: &Claims, vehicle: &mut Vehicle) -> Option<(u32, bool)> {
    if vehicle.holding == NONE || vehicle.holding == vehicle.next {
        return None;
    }
    if vehicle.s - vehicle.length() > CLEARED || is_free_behind(scene, vehicle) {
        let cleared = (vehicle.holding, vehicle.is_long());
        vehicle.holding = NONE;
        return Some(cleared);
    }
    let length = scene.tracks.ways[vehicle.holding as usize].length;
    claims.claim(scene.tracks, vehicle, vehicle.s + length);
    None
}

/// Whether a vehicle may go on although its rear is still on the way behind: its lane is too short for it ever to clear that,
/// and nobody meets it there. On such lanes, as between the junctions of imported maps, everybody would stand for good.
fn is_free_behind(scene: &Scene<'_>, vehicle: &Vehicle) -> bool {
    let tracks = scene.tracks;
    let way = vehicle.holding as usize;
    let is_short = tracks.length[tracks.lane_after(way) as usize] <= vehicle.length() + CLEARED;
    let crossings = || &tracks.network.connections[way].crossings;
    is_short && tracks.conflicts[way].is_empty() && crossings().is_empty()
}
