//! What lies ahead of a driver: the leader, the stop line, the turn, people on the strip, something in the way.

use super::Idm;
use super::lane_change::{CHANGE_ROOM, first_ghost};
use super::manager::{EXIT, NONE, STANDING, Sight, Vehicle, VehicleManager};
use super::tracks::{Track, Tracks};
use crate::TrafficConfig;

/// Where a vehicle stops before a line, m.
const BEFORE_LINE: f64 = 0.5;

/// The acceleration of a vehicle, m/s².
#[inline]
pub(super) fn acceleration(
    manager: &VehicleManager,
    tracks: &Tracks,
    config: &TrafficConfig,
    sight: &Sight<'_>,
    track: Track,
    vehicle: &Vehicle,
    leader: Option<&Vehicle>,
) -> f64 {
    let kind = config.vehicle_type(vehicle.row);
    let idm = &kind.driver;
    let mut view = View {
        idm,
        s: vehicle.s,
        v: vehicle.v,
        gap: f64::INFINITY,
        pressure: 0.0,
        factor: f64::from(vehicle.factor) * config.conditions.speed,
        free: kind.free_speed(config, vehicle.factor, tracks.speed[track as usize]),
    };
    if let Some(leader) = leader {
        view.follow(leader.s - leader.length() - vehicle.s, leader.v);
    }
    let to_end = tracks.length[track as usize] - vehicle.s;
    match tracks.connection(track) {
        Some(way) => view.across(manager, tracks, sight, way, to_end, vehicle.s, leader.is_none()),
        None if vehicle.next == EXIT => {}
        None if vehicle.next == NONE => view.stop_in(view.before_change(tracks, track, to_end), idm.gap),
        None if vehicle.holding != vehicle.next => view.stop_in(to_end, idm.gap),
        None => view.enter_junction(manager, tracks, sight, vehicle.next as usize, to_end, leader.is_none()),
    }
    if let Some((gap, speed)) = first_ghost(&manager.ghosts, track, vehicle.s) {
        view.follow(gap, speed);
    }
    if vehicle.shift != 0.0
        && let Some((gap, speed)) = manager.ahead_in_old_lane(tracks, track, vehicle)
    {
        view.follow(gap, speed);
    }
    if !sight.obstacles.is_empty() {
        view.beware(sight, track, vehicle.s, idm.gap);
    }
    let mut acceleration = idm.respond(vehicle.v, view.free, view.pressure);
    if vehicle.v < STANDING && view.gap < idm.gap {
        // Standing close is standing: no creeping on rounding.
        acceleration = acceleration.min(0.0);
    }
    acceleration
}

/// How near the nearest thing ahead is, how much what is ahead presses, and the speed that the road allows.
struct View<'a> {
    idm: &'a Idm,
    s: f64,
    v: f64,
    gap: f64,
    pressure: f64,
    /// The driver's share of the limits.
    factor: f64,
    free: f64,
}

impl View<'_> {
    #[inline]
    fn follow(&mut self, gap: f64, speed: f64) {
        self.gap = self.gap.min(gap);
        self.pressure = self.pressure.max(self.idm.pressure(self.v, gap, speed));
    }

    /// Must stand before a line so far ahead.
    fn stop_in(&mut self, distance: f64, gap: f64) {
        // The model keeps its gap to a leader at rest, but a line may be driven up to.
        self.follow(distance + gap - BEFORE_LINE, 0.0);
    }

    /// Where one who must change lanes waits for a gap: so far from the end of its lane that a change still has room, if it can
    /// still stop there.
    fn before_change(&self, tracks: &Tracks, lane: Track, to_end: f64) -> f64 {
        let early = to_end - CHANGE_ROOM - 1.0;
        let stopping = self.v * self.v / (2.0 * self.idm.deceleration);
        let has_neighbour = tracks.beside[lane as usize] != [NONE; 2];
        if has_neighbour && early > stopping { early } else { to_end }
    }

    /// Must have a speed so far ahead, braking comfortably.
    fn slow_to(&mut self, speed: f64, distance: f64) {
        let allowed = (speed * speed + 2.0 * self.idm.deceleration * distance.max(0.0)).sqrt();
        self.free = self.free.min(allowed.max(0.5));
    }

    /// On a lane with leave to cross: what is on the way, and behind it.
    fn enter_junction(
        &mut self,
        manager: &VehicleManager,
        tracks: &Tracks,
        sight: &Sight<'_>,
        way: usize,
        to_line: f64,
        is_first: bool,
    ) {
        let track = tracks.lanes + way;
        self.slow_to(self.factor * tracks.speed[track], to_line);
        self.mind_people(tracks, sight, way, to_line);
        if !is_first {
            return;
        }
        self.let_part(manager, tracks, way, -to_line);
        match manager.queues[track].back() {
            Some(leader) => self.follow(to_line + leader.s - leader.length(), leader.v),
            None => self.after_way(manager, tracks, way, to_line + tracks.length[track]),
        }
        if let Some(station) = first_obstacle(sight, track as Track, 0.0) {
            self.follow(to_line + station, 0.0);
        }
    }

    /// On the way across.
    #[expect(clippy::too_many_arguments, reason = "all of it is one driver's view of one junction")]
    fn across(
        &mut self,
        manager: &VehicleManager,
        tracks: &Tracks,
        sight: &Sight<'_>,
        way: usize,
        to_end: f64,
        s: f64,
        is_first: bool,
    ) {
        self.mind_people(tracks, sight, way, -s);
        self.let_part(manager, tracks, way, s);
        if is_first {
            self.after_way(manager, tracks, way, to_end);
        }
    }

    /// Stays behind those who left the same lane for another way until their rear is out of one's own; `at` is where one is
    /// on the way, negative before it.
    fn let_part(&mut self, manager: &VehicleManager, tracks: &Tracks, way: usize, at: f64) {
        for (sibling, clear) in &tracks.siblings[way] {
            if manager.holders[*sibling as usize] == 0 {
                continue;
            }
            let sibling = *sibling as usize;
            let length = tracks.length[tracks.lanes + sibling];
            let lane = tracks.lane_after(sibling) as usize;
            let on_way = manager.queues[tracks.lanes + sibling].iter().rev().map(|other| (other, other.s));
            let behind = manager.queues[lane].iter().rev().filter(|other| other.holding as usize == sibling);
            let all = on_way.chain(behind.map(|other| (other, other.s + length)));
            for (other, front) in all {
                let rear = front - other.length();
                if front > at && rear < *clear {
                    self.follow(rear - at, other.v);
                }
            }
        }
    }

    /// The lane behind a junction: its last vehicle, and its end, where one may have to stop.
    fn after_way(&mut self, manager: &VehicleManager, tracks: &Tracks, way: usize, to_lane: f64) {
        let lane = tracks.lane_after(way) as usize;
        if let Some(leader) = manager.queues[lane].back() {
            self.follow(to_lane + leader.s - leader.length(), leader.v);
        }
        self.slow_to(0.0, to_lane + tracks.length[lane]);
    }

    /// Stops before strips with people on them; `offset` is the distance to the beginning of the way, negative on it.
    fn mind_people(&mut self, tracks: &Tracks, sight: &Sight<'_>, way: usize, offset: f64) {
        for strip in &tracks.strips[way] {
            let distance = offset + strip.stop;
            // Whoever is on the strip already drives on and clears it.
            if sight.walkers[strip.crossing as usize] > 0 && distance > -0.2 {
                self.follow(distance.max(0.05) + 1.5, 0.0);
            }
        }
    }

    /// Stops behind foreign bodies on the track.
    fn beware(&mut self, sight: &Sight<'_>, track: Track, s: f64, gap: f64) {
        if let Some(station) = first_obstacle(sight, track, s) {
            self.follow(station - self.s + gap * 0.5, 0.0);
        }
    }
}

/// The first foreign body on a track beyond a station.
fn first_obstacle(sight: &Sight<'_>, track: Track, beyond: f64) -> Option<f64> {
    let start = sight.obstacles.partition_point(|(at, station)| (*at, *station) < (track, beyond));
    sight.obstacles.get(start).filter(|(at, _)| *at == track).map(|(_, station)| *station)
}
