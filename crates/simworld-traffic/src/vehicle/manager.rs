//! The vehicle manager: where vehicles are, how they accelerate, and how they pass from track to track.
//!
//! Vehicles stand front to back in one queue a track, so that a leader is the entry before. A step computes all
//! accelerations from the frozen state, then moves everybody; only occupied tracks are visited.

use std::collections::VecDeque;

use serde::{Deserialize, Serialize};
use simworld_core::hash::StateHasher;
use simworld_core::net::Aspect;
use simworld_core::seed::Stream;

use super::deadlock::Waits;
use super::entry::route_way;
use super::idm::advance;
use super::junction;
use super::lane_change::Ghost;
use super::lookahead;
use super::tracks::{Track, Tracks};
use super::types::{TypeIndex, VehicleType, is_long};
use crate::{Counters, Route, TrafficConfig, Trip, TripEnd};

/// No connection.
pub(crate) const NONE: u32 = u32::MAX;
/// No connection: the vehicle leaves the network at the end of its lane.
pub(crate) const EXIT: u32 = u32::MAX - 1;
/// A vehicle slower than this stands, m/s.
pub(crate) const STANDING: f64 = 0.1;
/// Standing longer than this is counted, s.
const LONG: f64 = 180.0;

/// One vehicle, as far as a step needs it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Vehicle {
    /// Its front, m along its track.
    pub(crate) s: f64,
    /// Speed, m/s.
    pub(crate) v: f64,
    /// Time it has stood, s.
    pub(crate) stood: f64,
    pub(crate) id: u32,
    /// The connection it wants at the end of its lane, or is on.
    pub(crate) next: u32,
    /// The connection it has been granted and not yet cleared.
    pub(crate) holding: u32,
    /// Its type: a row of the table.
    pub(crate) row: TypeIndex,
    /// Length, m, as in the table.
    pub(crate) length: f32,
    /// The speed that its driver chooses, as a share of the limit.
    pub(crate) factor: f32,
    /// How far its body is to the left of its lane while it changes, m.
    pub(crate) shift: f64,
}

impl Vehicle {
    /// One at rest at a station, with no way on yet.
    pub(super) fn new(kind: &VehicleType, row: TypeIndex, factor: f32, id: u32, s: f64) -> Self {
        Self {
            s,
            v: 0.0,
            stood: 0.0,
            id,
            next: NONE,
            holding: NONE,
            row,
            length: kind.length as f32,
            factor,
            shift: 0.0,
        }
    }

    /// Length, m.
    #[inline]
    pub(crate) fn length(&self) -> f64 {
        f64::from(self.length)
    }

    /// Whether its ends swing out of its lane in a turn.
    #[inline]
    pub(crate) fn is_long(&self) -> bool {
        is_long(self.length())
    }
}

/// What a vehicle was, apart from its motion.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Path {
    pub(crate) track: Track,
    /// The track it came from, where its rear may still be.
    pub(crate) before: Track,
    /// Decisions made so far: the index of its next draw.
    decisions: u64,
    /// Its route, or none if it turns at random.
    pub(super) route: u32,
    /// The leg of the route that it is on.
    pub(super) leg: u32,
    pub(super) scheduled: f64,
    pub(super) entered: f64,
    /// Distance and free travel time of the tracks that it has left, m and s.
    pub(super) driven: f64,
    pub(super) free_time: f64,
}

impl Path {
    pub(super) fn new(track: Track, route: u32, scheduled: f64, entered: f64) -> Self {
        Self {
            track,
            before: track,
            decisions: 0,
            route,
            leg: 0,
            scheduled,
            entered,
            driven: 0.0,
            free_time: 0.0,
        }
    }
}

/// What drivers see of people and signals.
pub(crate) struct Sight<'a> {
    pub(crate) aspects: &'a [Aspect],
    /// How long each group has shown its aspect, s.
    pub(crate) shown: &'a [f64],
    /// People on each crossing.
    pub(crate) walkers: &'a [u32],
    /// People at the kerb of each crossing who may walk.
    pub(crate) waiting: &'a [u32],
    /// Foreign bodies on tracks: track and station of their near side, sorted.
    pub(crate) obstacles: &'a [(Track, f64)],
}

/// All vehicles.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct VehicleManager {
    /// Front to back, one queue a track.
    pub(crate) queues: Vec<VecDeque<Vehicle>>,
    /// Tracks with vehicles, ascending.
    pub(crate) active: Vec<Track>,
    pub(crate) paths: Vec<Path>,
    /// Vehicles that hold each connection.
    pub(crate) holders: Vec<u32>,
    /// Those of them that are long.
    pub(crate) long_holders: Vec<u32>,
    /// Room on each lane that vehicles on their way to it will take, m.
    pub(crate) inbound: Vec<f64>,
    /// Vehicles that hold a way over each crossing and have not passed it.
    pub(crate) claims: Vec<u32>,
    pub(super) routes: Vec<Route>,
    /// Who is changing lanes, and where they still are.
    pub(super) shifting: Vec<u32>,
    pub(super) ghosts: Vec<Ghost>,
    pub(super) changes: u64,
    /// Those in a lock who may enter their junction without room behind it, ascending.
    pub(super) passes: Vec<u32>,
    /// Numbers that nobody has any more.
    pub(super) free: Vec<u32>,
    /// Numbers of those who entered in the last step, and the trips that ended in it.
    #[serde(skip)]
    pub(crate) entered: Vec<u32>,
    #[serde(skip)]
    pub(crate) ended: Vec<Trip>,
    #[serde(skip)]
    pub(super) waits: Waits,
    #[serde(skip)]
    accelerations: Vec<f64>,
    #[serde(skip)]
    weights: Vec<f64>,
    #[serde(skip)]
    pub(crate) requests: Vec<junction::Request>,
}

impl VehicleManager {
    pub(crate) fn new(tracks: &Tracks) -> Self {
        Self {
            queues: vec![VecDeque::new(); tracks.count()],
            holders: vec![0; tracks.count() - tracks.lanes],
            long_holders: vec![0; tracks.count() - tracks.lanes],
            inbound: vec![0.0; tracks.lanes],
            claims: vec![0; tracks.network.crossings.len()],
            ..Self::default()
        }
    }

    /// The way on from a lane: that of the route, or one drawn at random.
    pub(super) fn choose(
        &mut self,
        tracks: &Tracks,
        config: &TrafficConfig,
        streams: Stream,
        vehicle: &Vehicle,
        lane: Track,
    ) -> u32 {
        let kind = config.vehicle_type(vehicle.row).kind;
        let path = &mut self.paths[vehicle.id as usize];
        if let Some(route) = self.routes.get(path.route as usize) {
            return route_way(tracks, route, path, lane, kind);
        }
        path.decisions += 1;
        let mut rng = streams.indexed(u64::from(vehicle.id)).indexed(path.decisions).rng();
        let ways = tracks.ways(lane, kind, &config.turns, &mut self.weights);
        // If every way has weight zero, the first is as good as any.
        let index = rng.weighted(&self.weights).unwrap_or(0);
        ways.get(index).map_or(NONE, |way| way.0)
    }

    /// One step of all vehicles.
    pub(crate) fn step(
        &mut self,
        tracks: &Tracks,
        config: &TrafficConfig,
        streams: Stream,
        sight: &Sight<'_>,
        (now, dt): (f64, f64),
        counters: &mut Counters,
    ) {
        self.shift(tracks, dt);
        self.change_lanes(tracks, config, (now / dt) as u64);
        self.lose_patience(tracks, counters);
        counters.lane_changes = self.changes;
        self.unlock(tracks, config, (now, dt), counters);
        junction::revoke(self, tracks, config, sight, counters);
        junction::grant(self, tracks, config, sight, counters);
        self.accelerate(tracks, config, sight);
        self.integrate(tracks, dt, counters);
        self.pass_on(tracks, config, streams, now + dt, counters);
        self.count_claims(tracks);
    }

    fn accelerate(&mut self, tracks: &Tracks, config: &TrafficConfig, sight: &Sight<'_>) {
        self.accelerations.clear();
        let mut accelerations = std::mem::take(&mut self.accelerations);
        for track in &self.active {
            let queue = &self.queues[*track as usize];
            let mut leader: Option<&Vehicle> = None;
            for vehicle in queue {
                accelerations
                    .push(lookahead::acceleration(self, tracks, config, sight, *track, vehicle, leader));
                leader = Some(vehicle);
            }
        }
        self.accelerations = accelerations;
    }

    fn integrate(&mut self, tracks: &Tracks, dt: f64, counters: &mut Counters) {
        let mut next = 0;
        for track in &self.active {
            let is_lane = (*track as usize) < tracks.lanes;
            let end = tracks.length[*track as usize];
            for vehicle in &mut self.queues[*track as usize] {
                let (v, way) = advance(vehicle.v, self.accelerations[next], dt);
                next += 1;
                counters.updates += 1;
                vehicle.s += way;
                vehicle.v = v;
                if is_lane && vehicle.holding == NONE && vehicle.next != EXIT && vehicle.s >= end {
                    // A stop line is never passed without leave, whatever the brakes would say.
                    vehicle.s = end - 1e-6;
                    vehicle.v = 0.0;
                    counters.forced_stops += 1;
                }
                let before = vehicle.stood;
                vehicle.stood = if vehicle.v < STANDING { before + dt } else { 0.0 };
                if before < LONG && vehicle.stood >= LONG {
                    counters.long_waits += 1;
                }
            }
        }
    }

    /// Moves vehicles whose front left their track to the next, and frees what their rear has cleared.
    fn pass_on(
        &mut self,
        tracks: &Tracks,
        config: &TrafficConfig,
        streams: Stream,
        now: f64,
        counters: &mut Counters,
    ) {
        let occupied = self.active.len();
        for index in 0..occupied {
            let track = self.active[index];
            while let Some(front) = self.queues[track as usize].front().copied() {
                if front.s < tracks.length[track as usize] {
                    break;
                }
                self.queues[track as usize].pop_front();
                if front.next == EXIT && tracks.connection(track).is_none() {
                    self.leave(tracks, config, track, &front, TripEnd::Arrived, now);
                    counters.arrived += 1;
                } else {
                    self.move_on(tracks, config, streams, track, front);
                }
            }
            if (track as usize) < tracks.lanes {
                self.release_cleared(track);
            }
        }
        self.active.sort_unstable();
        self.active.dedup();
        let queues = &self.queues;
        self.active.retain(|track| !queues[*track as usize].is_empty());
    }

    fn move_on(
        &mut self,
        tracks: &Tracks,
        config: &TrafficConfig,
        streams: Stream,
        from: Track,
        mut vehicle: Vehicle,
    ) {
        vehicle.s -= tracks.length[from as usize];
        let path = &mut self.paths[vehicle.id as usize];
        path.driven += tracks.length[from as usize];
        let row = config.vehicle_type(vehicle.row);
        path.free_time += tracks.length[from as usize]
            / row.free_speed(config, vehicle.factor, tracks.speed[from as usize]);
        let to = match tracks.connection(from) {
            Some(connection) => {
                let lane = tracks.lane_after(connection);
                self.inbound[lane as usize] -= room_for(&vehicle, config);
                path.leg += 1;
                vehicle.next = self.choose(tracks, config, streams, &vehicle, lane);
                lane
            }
            None => tracks.lanes as Track + vehicle.next,
        };
        let path = &mut self.paths[vehicle.id as usize];
        path.before = from;
        path.track = to;
        if vehicle.s >= tracks.length[to as usize] && tracks.connection(to).is_some() {
            // A step longer than the whole way across: on to the lane behind it.
            self.move_on(tracks, config, streams, to, vehicle);
            return;
        }
        self.queues[to as usize].push_back(vehicle);
        self.active.push(to);
    }

    /// Vehicles at the beginning of a lane whose rear has left the junction give it free.
    fn release_cleared(&mut self, lane: Track) {
        for vehicle in self.queues[lane as usize].iter_mut().rev() {
            if vehicle.s > 60.0 {
                break;
            }
            let still_before = vehicle.holding == NONE || vehicle.holding == vehicle.next;
            if !still_before && vehicle.s - vehicle.length() > 0.3 {
                self.holders[vehicle.holding as usize] -= 1;
                self.long_holders[vehicle.holding as usize] -= u32::from(vehicle.is_long());
                vehicle.holding = NONE;
            }
        }
    }

    fn count_claims(&mut self, tracks: &Tracks) {
        self.claims.fill(0);
        for track in &self.active {
            for vehicle in &self.queues[*track as usize] {
                if vehicle.holding == NONE {
                    continue;
                }
                let way = vehicle.holding as usize;
                let rear = position_on_way(tracks, *track, vehicle, way) - vehicle.length();
                for strip in &tracks.strips[way] {
                    if rear < strip.end {
                        self.claims[strip.crossing as usize] += 1;
                    }
                }
            }
        }
    }

    /// Every vehicle with its track, track by track, front to back.
    pub(crate) fn iter(&self) -> impl Iterator<Item = (Track, &Vehicle)> {
        self.active
            .iter()
            .flat_map(|track| self.queues[*track as usize].iter().map(move |vehicle| (*track, vehicle)))
    }

    /// Whether a saved state is one of this network.
    pub(crate) fn fits(&self, tracks: &Tracks, types: usize) -> bool {
        let ways = tracks.count() - tracks.lanes;
        let is_way = |way: u32| way >= EXIT || (way as usize) < ways;
        let is_route = |route: u32| route == NONE || (route as usize) < self.routes.len();
        let count = self.paths.len();
        self.queues.len() == tracks.count()
            && self.holders.len() == ways
            && self.long_holders.len() == ways
            && self.inbound.len() == tracks.lanes
            && self.claims.len() == tracks.network.crossings.len()
            && self.active.iter().all(|track| (*track as usize) < tracks.count())
            && self
                .paths
                .iter()
                .all(|p| (p.track.max(p.before) as usize) < tracks.count() && is_route(p.route))
            && self.routes.iter().all(|route| route.validate(&tracks.network).is_ok())
            && self.shifting.iter().all(|id| (*id as usize) < count)
            && self.free.iter().all(|id| (*id as usize) < count)
            && self.passes.is_sorted()
            && self.queues.iter().flatten().all(|v| {
                (v.id as usize) < count
                    && usize::from(v.row) < types
                    && v.length > 0.0
                    && v.factor > 0.0
                    && is_way(v.next)
                    && is_way(v.holding)
                    && v.s.is_finite()
                    && v.shift.is_finite()
                    && v.v.is_finite()
            })
    }

    pub(crate) fn state_hash(&self, hasher: &mut StateHasher) {
        for track in &self.active {
            hasher.u64(u64::from(*track));
            for vehicle in &self.queues[*track as usize] {
                hasher.u64(u64::from(vehicle.id)).f64(vehicle.s).f64(vehicle.v).f64(vehicle.stood);
                hasher.u64(u64::from(vehicle.next)).u64(u64::from(vehicle.holding)).f64(vehicle.shift);
            }
        }
    }
}

/// The front of a vehicle in metres along the way that it holds: negative before it, beyond its length behind it.
pub(crate) fn position_on_way(tracks: &Tracks, track: Track, vehicle: &Vehicle, way: usize) -> f64 {
    match tracks.connection(track) {
        Some(_) => vehicle.s,
        None if vehicle.next as usize == way => vehicle.s - tracks.length[track as usize],
        None => vehicle.s + tracks.length[tracks.lanes + way],
    }
}

/// Room on a lane that a vehicle takes when it stands, m.
pub(crate) fn room_for(vehicle: &Vehicle, config: &TrafficConfig) -> f64 {
    // In parts of a power of two: what comes and goes adds up to nothing again, to the bit.
    ((vehicle.length() + config.vehicle_type(vehicle.row).driver.gap) * 1024.0).ceil() / 1024.0
}
