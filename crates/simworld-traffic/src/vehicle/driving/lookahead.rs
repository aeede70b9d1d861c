//! What lies ahead of a driver: the leader, the stop line, the turn, people on the strip, something in the way.

mod passing;
mod plain;

use simworld_core::ops::{greater, lesser};

use super::following::{Ahead, Leader};
use super::idm::Driver;
use super::lane_change::{CHANGE_ROOM, STEEPNESS, clear};
use super::otherwise::Otherwise;
use crate::vehicle::foreign::strangers::{self, on_track};
use crate::vehicle::junctions::junction::horizon;
use crate::vehicle::junctions::precedence::{HURRY, Precedence};
use crate::vehicle::manager::{EXIT, NONE, STANDING, Vehicle};
use crate::vehicle::part::Part;
use crate::vehicle::queues::ghosts::{Ghost, first_block, first_ghost};
use crate::vehicle::scene::{Scene, Sight};
use crate::vehicle::tracks::layout::Measure;
use crate::vehicle::tracks::{Obstacle, Track, Tracks};
use crate::vehicle::{Idm, Way};

/// Where a vehicle stops before a line, m.
pub(in crate::vehicle) const BEFORE_LINE: f64 = 0.5;
/// No vehicle is longer, m: an articulated bus, or a truck with its trailer.
const LONGEST: f64 = 20.0;
/// Who is slower than this does not go on past a body that leaves less than this beside it, m/s and m.
const CRAWLS: f64 = 3.0;
const TO_SIDE: f64 = 0.2;
/// No farther before the end of its lane one waits whose lane does not lead on, m: with room for three changes.
const CHANGES: f64 = 3.0 * CHANGE_ROOM + 1.0;
/// In a lock that only all together undo one stands so near to who is ahead, m, and goes no faster there, m/s.
const CLOSE: f64 = 0.8;
const CLOSES_AT: f64 = 2.0;

/// A track as its drivers see it.
pub(in crate::vehicle) struct Lane<'a> {
    part: &'a Part,
    scene: &'a Scene<'a>,
    track: Track,
    /// The connection that it is, if it is one.
    way: Option<usize>,
    /// Its number in the part.
    local: usize,
    /// Its length, m.
    end: f64,
    /// The speeds that the law and its bends allow, m/s.
    limit: f64,
    bend: f64,
    /// Bodies that have not quite left it, from back to front.
    ghosts: &'a [Ghost],
    /// Whether those on it, or on the lane behind a way, close up.
    closes_up: bool,
}

impl<'a> Lane<'a> {
    #[inline]
    pub(in crate::vehicle) fn new(
        part: &'a Part,
        scene: &'a Scene<'a>,
        local: usize,
        ghosts: &'a [Ghost],
    ) -> Self {
        let tracks = scene.tracks;
        let layout = part.layout(tracks);
        let track = layout.tracks[local];
        let Measure { length: end, limit, bend } = layout.measures[local];
        let way = tracks.connection(track);
        let closes_up = !scene.passes.is_empty()
            && scene.tail(way.map_or(track, |way| tracks.lane_after(way))).closes_up();
        Self { part, scene, track, way, local, end, limit, bend, ghosts, closes_up }
    }

    /// The number in the part of the lane itself, or of that from which a way leads.
    fn before_line(&self) -> usize {
        let layout = self.part.layout(self.scene.tracks);
        self.local.checked_sub(layout.lanes).map_or(self.local, |way| layout.from[way] as usize)
    }
}

/// The accelerations of the vehicles of a track, front to back, m/s².
pub(in crate::vehicle) fn accelerations(lane: &Lane<'_>, queue: &[Vehicle], accelerations: &mut Vec<f64>) {
    let mut leader = None;
    if lane.is_plain() {
        accelerations.extend(queue.iter().map(|vehicle| {
            let leader = leader.replace(vehicle);
            lane.follow_on(vehicle, leader).unwrap_or_else(|| acceleration(lane, vehicle, leader))
        }));
    } else {
        accelerations
            .extend(queue.iter().map(|vehicle| acceleration(lane, vehicle, leader.replace(vehicle))));
    }
}

/// The acceleration of a vehicle, m/s².
pub(in crate::vehicle) fn acceleration(lane: &Lane<'_>, vehicle: &Vehicle, leader: Option<&Vehicle>) -> f64 {
    let mut view = View::new(lane, vehicle);
    let pass = lane.scene.passings.of(vehicle.id);
    let leader = pass.map_or(leader, |pass| lane.leader_beyond(vehicle, pass));
    if let Some(leader) = leader {
        view.mind_leader(lane, vehicle, leader);
    }
    if vehicle.halt.is_finite() && pass.is_none() {
        view.halt(lane, vehicle);
    }
    let to_end = lane.end - vehicle.s;
    match lane.way {
        Some(way) => view.across(lane, way, to_end, vehicle, leader.is_none()),
        None if vehicle.holding != vehicle.next || vehicle.next == NONE => {
            if minds_end(vehicle, to_end, leader.is_none()) {
                view.stay_on(lane, vehicle, to_end, leader.is_none());
            }
        }
        None => view.enter_junction(lane, vehicle, to_end, leader.is_none()),
    }
    match pass {
        Some(pass) => view.pass(lane, vehicle, pass),
        None => view.mind_bodies(lane, vehicle),
    }
    view.respond(lane, vehicle)
}

/// Whether one without leave to cross minds the end of its lane, or, as the first, who has left it but for his rear: from so far as one
/// minds a line, and whose lane does not lead on from where he would wait before that to change.
#[inline]
fn minds_end(vehicle: &Vehicle, to_end: f64, is_first: bool) -> bool {
    let beyond = if is_first { LONGEST } else { 0.0 };
    to_end <= horizon(vehicle.v) + if vehicle.next == NONE { CHANGES } else { beyond }
}

/// How near the nearest thing ahead is, what is ahead as the model sees it, and the speed that the road allows.
struct View<'a> {
    idm: &'a Idm,
    /// By what its driver measures how he comes nearer.
    closes_by: f64,
    /// One who is not perfect, or drives by another model than the IDM.
    otherwise: Option<Otherwise<'a>>,
    s: f64,
    v: f64,
    gap: f64,
    ahead: Ahead,
    /// The driver's share of the limits.
    factor: f64,
    free: f64,
    /// The speed that bends and what is beyond them allow now.
    bend: f64,
    /// The most that one accelerates, to let somebody go first, m/s².
    most: f64,
    /// Whether one turns in a gap in the stream of others.
    takes_gap: bool,
    /// How much less than the usual gap one keeps to who is ahead, m.
    closer: f64,
}

impl<'a> View<'a> {
    /// An empty road.
    #[inline]
    fn new(lane: &Lane<'a>, vehicle: &Vehicle) -> Self {
        let config = lane.scene.config;
        let Driver { idm, closes_by, is_perfect } = &lane.scene.drivers[usize::from(vehicle.row)];
        let otherwise = || Otherwise::new(lane.scene, config.vehicle_type(vehicle.row), vehicle.id);
        Self {
            idm,
            closes_by: *closes_by,
            otherwise: (!is_perfect).then(otherwise),
            s: vehicle.s,
            v: vehicle.v,
            gap: f64::INFINITY,
            ahead: Ahead::NOTHING,
            factor: f64::from(vehicle.factor) * config.conditions.speed,
            free: idm.free_speed(config, vehicle.factor, lane.limit),
            bend: idm.free_speed(config, vehicle.factor, lane.bend),
            most: f64::INFINITY,
            takes_gap: false,
            closer: if lane.closes_up && vehicle.v < CLOSES_AT { (idm.gap - CLOSE).max(0.0) } else { 0.0 },
        }
    }
}

impl View<'_> {
    /// The acceleration, m/s².
    #[inline]
    fn respond(&self, lane: &Lane<'_>, vehicle: &Vehicle) -> f64 {
        let mut acceleration = lesser(self.follow_model(lane, vehicle), self.most);
        if self.takes_gap {
            acceleration = acceleration.max((acceleration * HURRY).min(self.idm.acceleration * HURRY));
        }
        // Standing close is standing: no creeping on rounding.
        let stands_close = vehicle.v < STANDING && self.gap < self.idm.gap;
        if stands_close { acceleration.min(0.0) } else { acceleration }
    }

    /// What the model of the driver asks for. One slows down for a bend as if alone, and follows as on a straight road: who wants
    /// no more than the speed that he has would keep twice the gap, and hardly anybody would come round.
    #[inline]
    fn follow_model(&self, lane: &Lane<'_>, vehicle: &Vehicle) -> f64 {
        let allowed = (self.free, self.bend);
        let Some(otherwise) = &self.otherwise else {
            return self.ahead.respond_by_idm(self.idm, self.v, allowed);
        };
        let is_crossing = vehicle.holding != NONE && vehicle.v > STANDING;
        let is_pressed = lane.way.is_some() || vehicle.shift != 0.0 || is_crossing;
        otherwise.respond(lane.scene, vehicle, &self.ahead, allowed, self.gap, is_pressed)
    }

    /// Whoever is next ahead in the queue.
    #[inline]
    fn mind_leader(&mut self, lane: &Lane<'_>, vehicle: &Vehicle, leader: &Vehicle) {
        let gap = leader.s - leader.length() - vehicle.s;
        let (speed, acceleration) = (leader.v, f64::from(leader.acceleration));
        self.see(Leader { gap: gap + self.closer, speed, acceleration });
        if leader.halt.is_finite() && leader.v < STANDING {
            // Far enough behind that one can pass it on the lane beside.
            let idm_gap = self.idm.gap;
            self.stop_in(self.before_change(lane, vehicle, gap - idm_gap), idm_gap);
        }
        if leader.halt.is_finite() {
            self.mind_breakdown(lane, vehicle, leader);
        }
    }

    /// Stops where it is to halt, or far enough before that it can still come to the kerb.
    fn halt(&mut self, lane: &Lane<'_>, vehicle: &Vehicle) {
        let to_halt = f64::from(vehicle.halt) - vehicle.s;
        let outermost = lane.scene.tracks.outermost.get(lane.track as usize);
        let is_at_kerb = outermost.is_none_or(|is_outer| *is_outer);
        let distance = if is_at_kerb { to_halt } else { self.before_change(lane, vehicle, to_halt) };
        self.stop_in(distance, self.idm.gap);
    }

    /// Bodies ahead that are in no queue of one's own.
    #[inline]
    fn mind_bodies(&mut self, lane: &Lane<'_>, vehicle: &Vehicle) {
        if !lane.ghosts.is_empty()
            && let Some((gap, speed)) = first_ghost(lane.ghosts, vehicle.s)
        {
            self.follow(gap, speed);
            if let Some(gap) = first_block(lane.ghosts, vehicle.s) {
                // Early enough that one can still pass on the lane beside.
                let idm_gap = self.idm.gap;
                self.stop_in(self.before_change(lane, vehicle, gap - idm_gap), idm_gap);
                self.mind_block(lane, vehicle);
            }
        }
        if !lane.scene.passings.is_empty() {
            self.mind_passings(lane, vehicle);
        }
        if vehicle.shift != 0.0
            && let Some((gap, speed)) = lane.part.ahead_in_old_lane(lane.scene, lane.track, vehicle)
        {
            self.follow(gap, speed);
        }
        if !lane.scene.sight.obstacles.is_empty() {
            let half_width = lane.scene.config.vehicle_type(vehicle.row).width * 0.5;
            self.beware(&lane.scene.sight, lane.track, half_width);
        }
    }

    #[inline]
    fn see(&mut self, leader: Leader) {
        self.gap = lesser(leader.gap, self.gap);
        match &self.otherwise {
            None => {
                let Leader { gap, speed, .. } = leader;
                self.ahead.press(self.idm.pressure_by(self.closes_by, self.v, gap, speed));
            }
            Some(otherwise) => otherwise.see(&mut self.ahead, self.v, leader),
        }
    }

    /// Somebody whose acceleration one does not see, or something that stands.
    #[inline]
    fn follow(&mut self, gap: f64, speed: f64) {
        self.see(Leader { gap, speed, acceleration: f64::NEG_INFINITY });
    }

    /// Must stand before a line so far ahead.
    fn stop_in(&mut self, distance: f64, gap: f64) {
        // The model keeps its gap to a leader at rest, but a line may be driven up to.
        self.follow(distance + gap - BEFORE_LINE, 0.0);
    }

    /// Where one who must change lanes waits for a gap: so far from the end of its lane that a change still has room, if it can
    /// still stop there.
    fn before_change(&self, lane: &Lane<'_>, vehicle: &Vehicle, to_end: f64) -> f64 {
        self.before_changes(lane, vehicle, to_end, 1).unwrap_or(to_end)
    }

    /// The same for one whose lane does not lead on: with room for as many changes as it needs, or else for as many as there is.
    fn before_lanes(&self, lane: &Lane<'_>, vehicle: &Vehicle, to_end: f64) -> f64 {
        let needed = lane.part.changes_needed(lane.scene, lane.track, vehicle);
        let mut fewer = (1..=needed).rev();
        fewer.find_map(|changes| self.before_changes(lane, vehicle, to_end, changes)).unwrap_or(to_end)
    }

    fn before_changes(&self, lane: &Lane<'_>, vehicle: &Vehicle, to_end: f64, changes: usize) -> Option<f64> {
        let early = to_end - CHANGE_ROOM * changes as f64 - 1.0;
        // Where one may not change there is nothing to wait for.
        if vehicle.s + early - vehicle.length() < clear(lane.end, vehicle) {
            return None;
        }
        // Harder than comfortably, so that who has begun to brake for it does not think better of it half way.
        let stopping = self.v * self.v / self.idm.emergency_deceleration;
        let beside = lane.scene.tracks.beside.get(lane.track as usize);
        let has_neighbour = beside.is_some_and(|beside| *beside != [NONE; 2]);
        (has_neighbour && early > stopping).then_some(early)
    }

    /// Must have a speed so far ahead, braking comfortably.
    fn slow_to(&mut self, speed: f64, distance: f64) {
        let square = speed * speed + 2.0 * self.idm.deceleration * greater(distance, 0.0);
        // Hardly ever: most are far from there, or slow.
        if square < self.bend * self.bend {
            self.bend = lesser(greater(square.sqrt(), 0.5), self.bend);
        }
    }

    /// On a lane without leave to cross: its end, and those who have left it but for their rear.
    fn stay_on(&mut self, lane: &Lane<'_>, vehicle: &Vehicle, to_end: f64, is_first: bool) {
        let is_near = to_end <= horizon(vehicle.v);
        match vehicle.next {
            EXIT => {}
            // Who stands between two lanes would never come out of there: first it comes into its own.
            NONE if vehicle.shift != 0.0 => {
                let early = self.before_lanes(lane, vehicle, to_end);
                let way = f64::from(vehicle.shift.abs()) / STEEPNESS + 1.0;
                self.stop_in(early.max(way).min(to_end), self.idm.gap);
            }
            NONE => self.stop_in(self.before_lanes(lane, vehicle, to_end), self.idm.gap),
            _ if is_near => self.stop_in(to_end, self.idm.gap),
            _ => {}
        }
        // A rear may be as far before the line as a vehicle is long.
        let is_far = !is_first || to_end > horizon(vehicle.v) + LONGEST;
        if is_far || !lane.part.work.held.leads_from(lane.local) {
            return;
        }
        for (rear, v) in lane.part.leavers(lane.scene, lane.track) {
            self.follow(to_end + rear + self.closer, v);
        }
    }

    /// On a lane with leave to cross: what is on the way, and behind it.
    fn enter_junction(&mut self, lane: &Lane<'_>, vehicle: &Vehicle, to_line: f64, is_first: bool) {
        let (tracks, way) = (lane.scene.tracks, vehicle.next as usize);
        let track = tracks.lanes + way;
        let Way { local, length, speed, .. } = tracks.ways[way];
        self.slow_to(self.factor * speed, to_line);
        self.mind_people(tracks, &lane.scene.sight, way, to_line);
        self.mind_older(lane, vehicle, way, -to_line);
        if !is_first {
            return;
        }
        self.let_part(lane, way, -to_line);
        match lane.part.slabs.queue(local as usize).last() {
            Some(leader) => self.follow(to_line + leader.s - leader.length(), leader.v),
            None => self.after_way(lane.scene, way, to_line + length),
        }
        if let Some(obstacle) = first_obstacle(&lane.scene.sight, track as Track, 0.0, 0.0) {
            self.follow(to_line + obstacle.near, obstacle.v);
        }
    }

    /// On the way across.
    fn across(&mut self, lane: &Lane<'_>, way: usize, to_end: f64, vehicle: &Vehicle, is_first: bool) {
        self.mind_people(lane.scene.tracks, &lane.scene.sight, way, -vehicle.s);
        self.mind_older(lane, vehicle, way, vehicle.s);
        self.let_part(lane, way, vehicle.s);
        if is_first {
            self.after_way(lane.scene, way, to_end);
        }
    }

    /// Lets those go first whose leave is older, and strangers; `at` is where one is on the way, negative before it.
    fn mind_older(&mut self, lane: &Lane<'_>, vehicle: &Vehicle, way: usize, at: f64) {
        let gap = self.idm.gap;
        self.takes_gap = lane.scene.tracks.ways[way].turns_by_gaps;
        if let Some(distance) = strangers::meets(lane.scene, vehicle, (way, at)) {
            self.stop_in(distance, gap);
        }
        lane.part.mind_older(lane.scene, vehicle, (way, at), |precedence| match precedence {
            Precedence::Stop { distance } => self.stop_in(distance, gap),
            Precedence::Slow { acceleration } => self.most = self.most.min(acceleration),
            Precedence::Follow { gap, speed } => self.follow(gap, speed),
        });
    }

    /// Stays behind those who left the same lane for another way until their rear is out of one's own; `at` is where one is
    /// on the way, negative before it.
    fn let_part(&mut self, lane: &Lane<'_>, way: usize, at: f64) {
        // He holds his own way himself.
        if !lane.part.work.held.parts_from(lane.before_line()) {
            return;
        }
        for (sibling, clear) in &lane.scene.tracks.siblings[way] {
            if !lane.scene.junctions.is_held(*sibling) {
                continue;
            }
            for (front, rear, v) in lane.part.on_way(lane.scene, *sibling) {
                if front > at && rear < *clear {
                    self.follow(rear - at + self.closer, v);
                }
            }
        }
    }

    /// The lane behind a junction: its last vehicle, and its end, where one may have to stop.
    fn after_way(&mut self, scene: &Scene<'_>, way: usize, to_lane: f64) {
        let Way { to: lane, there, .. } = scene.tracks.ways[way];
        let last = scene.tail_at(there);
        if !last.is_none() {
            self.follow(to_lane + last.rear + self.closer, last.v);
        }
        if let Some(obstacle) = first_obstacle(&scene.sight, lane, 0.0, 0.0) {
            self.follow(to_lane + obstacle.near, obstacle.v);
        }
        self.slow_to(0.0, to_lane + scene.tracks.length[lane as usize]);
    }

    /// Stops before strips with people on them; `offset` is the distance to the beginning of the way, negative on it.
    fn mind_people(&mut self, tracks: &Tracks, sight: &Sight<'_>, way: usize, offset: f64) {
        if !tracks.ways[way].has_strips {
            return;
        }
        for strip in &tracks.strips[way] {
            let distance = offset + strip.stop;
            // Whoever is on the strip already drives on and clears it.
            if sight.walkers[strip.crossing as usize] > 0 && distance > -0.2 {
                self.follow(distance.max(0.05) + 1.5, 0.0);
            }
        }
    }

    /// Stops behind foreign bodies on the track.
    fn beware(&mut self, sight: &Sight<'_>, track: Track, half_width: f64) {
        if let Some(obstacle) = first_obstacle(sight, track, self.s, half_width) {
            // Nearer to what stands than to what may move.
            let closer = if obstacle.v > STANDING { 0.0 } else { self.idm.gap * 0.5 };
            self.follow(obstacle.near - self.s + closer, obstacle.v);
        }
        // Nor does one who stands or crawls go on past a body that has swung into its way beside it.
        let is_beside = |body: &&Obstacle| (body.near..body.far).contains(&self.s);
        let mut beside = on_track(sight, track).iter().filter(is_beside);
        if self.v < CRAWLS && beside.any(|body| body.aside < half_width + TO_SIDE) {
            self.follow(0.0, 0.0);
        }
    }
}

/// The first body on a track whose near side is beyond a station, and that a vehicle of half that width would not pass.
fn first_obstacle<'a>(sight: &Sight<'a>, track: Track, beyond: f64, half_width: f64) -> Option<&'a Obstacle> {
    on_track(sight, track).iter().find(|obstacle| obstacle.near >= beyond && obstacle.bars(half_width))
}
