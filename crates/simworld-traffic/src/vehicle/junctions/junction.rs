//! Leave to cross: who may enter a junction, and when leave is taken back.
//!
//! A way across is granted to a vehicle only while its [place in the order](super::precedence) among those on ways that meet
//! it is free, nobody with priority would be hindered, nobody is on the strips that it passes over, and there is room
//! behind it. Leave ends when the vehicle's rear is out. Long vehicles share the junction with nobody whose way they meet, or
//! whom they would [touch beside it](crate::vehicle::tracks::beside).

use serde::{Deserialize, Serialize};
use simworld_core::id::CrossingId;
use simworld_core::net::Aspect;

use super::clusters::{TOO_LONG, Wish, awaited};
use super::trailing::{Trail, is_too_short};
use crate::TrafficConfig;
use crate::vehicle::clock::{Clock, Moment};
use crate::vehicle::driving::lookahead::BEFORE_LINE;
use crate::vehicle::driving::sirens::{SEES as SIREN_SEES, may_pass_red};
use crate::vehicle::manager::{EXIT, NONE, STANDING, Vehicle};
use crate::vehicle::part::Part;
use crate::vehicle::queues::claims::Claims;
use crate::vehicle::queues::slabs::Cursor;
use crate::vehicle::queues::storage::Storage;
use crate::vehicle::queues::tail::Tail;
use crate::vehicle::queues::tally::Tally;
use crate::vehicle::scene::Scene;
use crate::vehicle::tracks::{Track, Tracks, Way};

/// Braking that drivers accept to stop at yellow, m/s².
const COMFORTABLE: f64 = 3.0;
/// Others need not wait for one who has leave and has stood before the line for so long, s.
const HESITATES: f64 = 2.0;
/// Yellow that has shown for less time than this leaves enough of it to get under way, s.
const FRESH: f64 = 0.6;
/// A vehicle nearer to its stop line than this stands at it, m.
const AT_LINE: f64 = 1.5;

/// Who has stood at its line for so long has the room behind the junction before all others, s: else those whose green comes when
/// there is some would have it for good.
pub(super) const PATIENT: f64 = 120.0;
/// Drivers come to a stand with a little more than the least gap, and a rear must be out of the junction by some way, m.
const SETTLES: f64 = 0.8;

/// Parts of a metre in which room is counted: what comes and goes adds up to nothing again.
pub(in crate::vehicle) const TICKS: f64 = 1024.0;

/// Who has leave to cross, and who is on the way to each lane and over each crossing. Only the part of an intersection reads
/// and grants leave there in the second phase of a step; in the third everybody takes away what has ended.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(crate) struct Junctions {
    /// Vehicles that hold each connection, and those of them that are long.
    holders: Tally,
    long_holders: Tally,
    /// Room on each lane that vehicles on their way to it will take, in ticks.
    inbound: Tally,
    /// Vehicles that hold a way over each crossing and have not passed it: those of parts that go in every step, and those of
    /// parts that go once a round.
    claims: Claims,
    far_claims: Claims,
}

impl Junctions {
    pub(in crate::vehicle) fn new(tracks: &Tracks) -> Self {
        Self {
            holders: Tally::new(tracks.ways.len()),
            long_holders: Tally::new(tracks.ways.len()),
            inbound: Tally::new(tracks.lanes),
            claims: Claims::new(tracks),
            far_claims: Claims::new(tracks),
        }
    }

    pub(in crate::vehicle) fn fits(&self, tracks: &Tracks) -> bool {
        let ways = tracks.ways.len();
        (self.holders.len(), self.long_holders.len()) == (ways, ways)
            && self.inbound.len() == tracks.lanes
            && self.claims.fits(tracks)
            && self.far_claims.fits(tracks)
    }

    pub(in crate::vehicle) fn bytes(&self) -> usize {
        let tallies = [&self.holders, &self.long_holders, &self.inbound].map(|tally| tally.len() * 4);
        tallies.iter().sum::<usize>() + self.claims.bytes() + self.far_claims.bytes()
    }

    /// Whether somebody holds a way.
    #[inline]
    pub(in crate::vehicle) fn is_held(&self, way: u32) -> bool {
        self.holders.get(way as usize) > 0
    }

    /// Whether somebody long holds a way.
    #[inline]
    pub(super) fn has_long(&self, way: u32) -> bool {
        self.long_holders.get(way as usize) > 0
    }

    /// Room on a lane that is promised to vehicles on their way to it, m.
    #[inline]
    pub(in crate::vehicle) fn inbound(&self, lane: Track) -> f64 {
        f64::from(self.inbound.get(lane as usize)) / TICKS
    }

    pub(super) fn grant(&self, tracks: &Tracks, vehicle: &Vehicle, config: &TrafficConfig) {
        let way = vehicle.next as usize;
        self.holders.add(way, 1);
        self.long_holders.add(way, u32::from(vehicle.is_long()));
        self.inbound.add(tracks.lane_after(way) as usize, ticks(vehicle, config));
    }

    /// A vehicle no longer holds a way.
    pub(in crate::vehicle) fn clear_way(&self, way: u32, is_long: bool) {
        self.holders.take(way as usize, 1);
        self.long_holders.take(way as usize, u32::from(is_long));
    }

    /// A vehicle on a way, with its rear where others cannot see it yet, shares the junction with nobody there.
    pub(super) fn share_with_nobody(&self, way: u32) {
        self.long_holders.add(way as usize, 1);
    }

    /// A vehicle is on its lane, or will not come.
    pub(in crate::vehicle) fn arrive(&self, lane: Track, vehicle: &Vehicle, config: &TrafficConfig) {
        self.inbound.take(lane as usize, ticks(vehicle, config));
    }

    /// Forgets the claims that those who go in this step make anew.
    pub(in crate::vehicle) fn forget_claims(&mut self, at: &Moment) {
        self.claims.clear();
        if at.ends_round() {
            self.far_claims.clear();
        }
    }

    /// Vehicles about to pass a crossing.
    pub(in crate::vehicle) fn claims(&self, crossing: CrossingId) -> u32 {
        self.claims.of(crossing) + self.far_claims.of(crossing)
    }

    /// The claim of one whose rear is on a way.
    pub(in crate::vehicle) fn claim_behind(&self, tracks: &Tracks, way: u32, rear: f64) {
        self.claims.claim_behind(tracks, way, rear);
    }

    /// Where the vehicles of a part claim crossings.
    #[inline]
    pub(in crate::vehicle) fn claims_of(&self, clock: &Clock) -> &Claims {
        if clock.is_far() { &self.far_claims } else { &self.claims }
    }
}

/// A vehicle that asks for leave.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Request {
    stood: f64,
    id: u32,
    /// The number of its lane in the part.
    lane: u32,
    rank: u32,
}

impl Part {
    /// Takes leave back and grants it, intersection by intersection.
    pub(in crate::vehicle) fn rule(&mut self, scene: &Scene<'_>) {
        let layout = self.layout(scene.tracks);
        let mut requests = std::mem::take(&mut self.work.requests);
        requests.clear();
        let mut junctions = layout.junctions.iter().map(|lanes| lanes.end as usize);
        let (mut until, mut at, mut word) = (0, Cursor::default(), usize::MAX);
        while let Some(local) = self.slabs.next_at_hand(&mut at).filter(|local| *local < layout.lanes) {
            if self.clock.is_long() && local / 64 != word {
                word = local / 64;
                self.touch_ahead(scene, word);
            }
            if local >= until {
                self.grant(scene, &mut requests);
                until = junctions.find(|end| *end > local).unwrap_or(layout.lanes);
            }
            let (track, end) = (layout.tracks[local], layout.measures[local].length);
            let Some(first) = self.slabs.queue(local).first() else { continue };
            if first.is_stuck() {
                self.work.stuck.push(track);
            }
            if first.minds_no_junction(end) {
                continue; // nor does anybody behind
            }
            self.revoke(scene, local, end);
            self.collect(scene, local, end, &mut requests);
        }
        self.grant(scene, &mut requests);
        self.work.requests = requests;
    }

    /// Takes leave back from those who can still stop for a signal that changed; counts those who cannot.
    fn revoke(&mut self, scene: &Scene<'_>, local: usize, end: f64) {
        // Nobody behind one who lost leave keeps it; nobody behind one who hesitates is before him in the order.
        let (mut is_barred, mut hesitates) = (false, false);
        for vehicle in self.slabs.queue_mut(local) {
            if vehicle.holding == NONE || vehicle.holding != vehicle.next {
                if vehicle.holding == NONE && vehicle.next != EXIT {
                    break; // nobody behind has leave either
                }
                continue;
            }
            hesitates |= vehicle.stood > HESITATES;
            if hesitates {
                self.leaves = self.leaves.wrapping_add(1);
                vehicle.granted = self.leaves;
            }
            let way = &scene.tracks.ways[vehicle.holding as usize];
            let distance = end - vehicle.s;
            let needed = vehicle.v * vehicle.v / (2.0 * distance.max(0.01));
            let aspect = scene.aspect(way.signal);
            let siren = scene.sirens.is_on(vehicle.id);
            let gone = is_barred
                || match aspect {
                    Aspect::Green => false,
                    _ if siren && distance < SIREN_SEES => false,
                    Aspect::Yellow => {
                        needed <= at_yellow(scene.config, vehicle)
                            && !(way.crosses_oncoming && distance < AT_LINE)
                    }
                    Aspect::Red => {
                        needed <= scene.config.vehicle_type(vehicle.row).driver.emergency_deceleration
                    }
                };
            if gone {
                is_barred = true;
                scene.junctions.clear_way(vehicle.holding, vehicle.is_long());
                scene.junctions.arrive(way.to, vehicle, scene.config);
                vehicle.holding = NONE;
                // Until it decides: what brings it to a stand at the line.
                vehicle.acceleration = vehicle.acceleration.min(-needed as f32);
            } else if aspect == Aspect::Red && !siren {
                self.work.counters.dilemmas += 1;
            }
        }
    }

    /// The vehicles of a lane that are near enough to its end to ask.
    fn collect(&mut self, scene: &Scene<'_>, local: usize, end: f64, requests: &mut Vec<Request>) {
        let queue = self.slabs.queue(local);
        for (rank, vehicle) in queue.iter().enumerate() {
            let distance = end - vehicle.s;
            if distance > horizon(vehicle.v) || vehicle.next == NONE || vehicle.halt.is_finite() {
                break;
            }
            if vehicle.next == EXIT {
                continue;
            }
            if vehicle.holding != vehicle.next && waits_at_red(scene, vehicle) {
                break; // nor is it the turn of those behind
            }
            if vehicle.holding == NONE {
                let Vehicle { stood, id, .. } = *vehicle;
                requests.push(Request { stood, id, lane: local as u32, rank: rank as u32 });
            } else if vehicle.holding != vehicle.next {
                if is_too_short(end, vehicle) {
                    let Vehicle { stood, id, .. } = *vehicle;
                    requests.push(Request { stood, id, lane: local as u32, rank: rank as u32 });
                }
                break; // its rear is still in the junction behind it
            }
        }
    }

    /// Grants leave at one intersection, to those who have stood longest first.
    fn grant(&mut self, scene: &Scene<'_>, requests: &mut Vec<Request>) {
        // Within a lane the first in line asks first, whoever has stood longer.
        requests.sort_unstable_by(|a, b| {
            b.stood.total_cmp(&a.stood).then(a.rank.cmp(&b.rank)).then(a.id.cmp(&b.id))
        });
        self.reserve(scene, requests);
        let mut overtaken = std::mem::take(&mut self.work.overtaken);
        for request in requests.drain(..) {
            let (lane, rank) = (request.lane as usize, request.rank as usize);
            let queue = self.slabs.queue(lane);
            let vehicle = queue[rank];
            // Who leaves the network at the end of the lane needs no leave, and hides nobody who does.
            let before = queue[..rank].iter().rev().find(|before| before.next != EXIT);
            if before.is_some_and(|before| before.holding != before.next || before.next == NONE) {
                continue; // one's turn comes after those before
            }
            if vehicle.stood > TOO_LONG && rank == 0 {
                let wish = wants_permit(scene, &vehicle);
                self.work.wishes.extend(wish.filter(|wish| wish.comes_early(scene.tracks)));
            }
            let track = self.layout(scene.tracks).tracks[lane];
            let is_free = self.leaves_room_to_the_patient(scene, &vehicle) && self.lets_in(scene, &vehicle);
            if is_free && may_enter(self, scene, (track, rank), &vehicle, &mut overtaken) {
                if let Some(wish) = wants_permit(scene, &vehicle).filter(|_| !may_pass(scene, &vehicle)) {
                    self.work.wishes.push(wish);
                    continue;
                }
                if vehicle.holding != NONE {
                    let path = &self.slabs.paths(lane)[rank];
                    self.work.trails.push(Trail::new(&vehicle, path, track));
                }
                self.leaves = self.leaves.wrapping_add(1);
                let granted = &mut self.slabs.queue_mut(lane)[rank];
                (granted.holding, granted.granted) = (vehicle.next, self.leaves);
                self.put_last(&mut overtaken);
                scene.junctions.grant(scene.tracks, &vehicle, scene.config);
                self.work.counters.crossings += 1;
                if may_pass(scene, &vehicle) {
                    self.work.used_passes.push(vehicle.id);
                }
            } else if is_free && rank == 0 {
                self.ask_courtesy(scene, &vehicle, scene.tracks.length[track as usize] - vehicle.s);
            }
        }
        self.work.overtaken = overtaken;
    }

    /// Keeps the room behind an intersection for those who have stood longest at their lines, if it was too long; requests come
    /// with the longest first.
    fn reserve(&mut self, scene: &Scene<'_>, requests: &[Request]) {
        self.work.reserved.clear();
        self.work.let_in.clear();
        let patient = requests.iter().take_while(|request| request.stood > PATIENT);
        for request in patient.filter(|request| request.rank == 0) {
            let next = self.slabs.queue(request.lane as usize)[0].next as usize;
            let lane = scene.tracks.lane_after(next);
            if !self.work.reserved.iter().any(|(other, _)| *other == lane) {
                self.work.reserved.push((lane, request.id));
            }
        }
    }

    /// Whether the room that a vehicle would take is kept for nobody else. Who stands between near junctions goes first: the other
    /// may wait for him to be out of there.
    fn leaves_room_to_the_patient(&self, scene: &Scene<'_>, vehicle: &Vehicle) -> bool {
        let Scene { tracks, .. } = scene;
        let way = vehicle.next as usize;
        let is_for_others = |(lane, id): &(Track, u32)| *lane == tracks.lane_after(way) && *id != vehicle.id;
        !self.work.reserved.iter().any(is_for_others)
            || tracks.clusters.of(tracks, tracks.ways[way].from, vehicle).is_some()
            || may_pass(scene, vehicle)
    }
}

/// Drivers ask for leave within this distance of the stop line, m: enough to stop at 2 m/s² after a second and a half. Before
/// that they do not mind the line.
#[inline]
pub(in crate::vehicle) fn horizon(v: f64) -> f64 {
    8.0 + v * 1.5 + v * v / 4.0
}

impl Vehicle {
    /// Whether one of a lane with that end has no leave to lose, and is too far from there to ask for it.
    fn minds_no_junction(&self, end: f64) -> bool {
        self.holding == NONE && self.next != EXIT && end - self.s > horizon(self.v)
    }
}

/// Whether a vehicle would ask in vain, and has not stood for so long that anybody does anything about it.
fn waits_at_red(scene: &Scene<'_>, vehicle: &Vehicle) -> bool {
    let signal = scene.tracks.signals[vehicle.next as usize];
    vehicle.stood <= TOO_LONG && scene.aspect(signal) == Aspect::Red && !scene.sirens.is_on(vehicle.id)
}

fn may_enter(
    part: &Part,
    scene: &Scene<'_>,
    (lane, rank): (Track, usize),
    vehicle: &Vehicle,
    overtaken: &mut Vec<(u32, u32)>,
) -> bool {
    let Scene { tracks, sight, junctions, .. } = scene;
    let way = vehicle.next as usize;
    let distance = tracks.length[lane as usize] - vehicle.s;
    let siren = scene.sirens.is_on(vehicle.id);
    vehicle.shift == 0.0
        && (signal_allows(scene, way, vehicle, distance) || (siren && may_pass_red(scene, vehicle, distance)))
        && (siren || !scene.sirens.keep_free(tracks, way))
        && (siren || !tracks.ways[way].stops || has_stopped(vehicle, &tracks.ways[way], distance))
        && (!tracks.ways[way].is_tight || has_tight_ways_free(scene, way, vehicle))
        && !(vehicle.is_long() && tracks.narrow[way].iter().any(|other| junctions.has_long(*other)))
        && (!tracks.ways[way].has_strips
            || tracks.strips[way].iter().all(|strip| {
                sight.walkers[strip.crossing as usize] == 0
                    && (siren || sight.waiting[strip.crossing as usize] == 0)
            }))
        && ((has_room(scene, way, vehicle) && !lets_out(scene, vehicle)) || may_pass(scene, vehicle))
        && part.finds_gap(scene, vehicle, (distance, rank), overtaken)
}

/// Whether nobody is on the ways near a way whom a vehicle would touch there, as the long touch everybody and everybody the long.
fn has_tight_ways_free(scene: &Scene<'_>, way: usize, vehicle: &Vehicle) -> bool {
    let Junctions { holders, long_holders, .. } = scene.junctions;
    let held = if vehicle.is_long() { holders } else { long_holders };
    scene.tracks.tight[way].iter().all(|other| held.get(*other as usize) == 0)
}

/// Whether a vehicle has obeyed a stop sign: hardly anybody stands quite still there, least who turns round the corner.
fn has_stopped(vehicle: &Vehicle, way: &Way, distance: f64) -> bool {
    /// Speed of those who roll past a stop sign, m/s, and where they have it, m: straight on, across, and round the corner.
    const ROLLS: [(f64, f64); 3] = [(1.7, 1.8), (2.3, 2.4), (2.5, 2.7)];
    let (speed, before) = ROLLS[if way.crosses_oncoming { 1 } else { 2 * usize::from(way.turns_by_gaps) }];
    vehicle.v < speed && distance < before
}

pub(super) fn signal_allows(scene: &Scene<'_>, way: usize, vehicle: &Vehicle, distance: f64) -> bool {
    let Scene { tracks, sight, config, .. } = scene;
    let Way { signal, crosses_oncoming, .. } = tracks.ways[way];
    if signal == NONE {
        return true;
    }
    match sight.aspects[signal as usize] {
        Aspect::Green => true,
        Aspect::Red => false,
        Aspect::Yellow => {
            // Too late to stop; or a turn across oncoming traffic that waited through the whole green for its gap.
            let needed = vehicle.v * vehicle.v / (2.0 * distance.max(0.01));
            needed > at_yellow(config, vehicle)
                || (crosses_oncoming
                    && distance < AT_LINE
                    && vehicle.stood > 5.0
                    && sight.shown[signal as usize] < FRESH)
        }
    }
}

/// The braking that a driver accepts to stop at yellow, m/s²: less on a slippery road.
fn at_yellow(config: &TrafficConfig, vehicle: &Vehicle) -> f64 {
    COMFORTABLE.min(config.vehicle_type(vehicle.row).driver.emergency_deceleration * 0.6)
}

/// The wish of one who would enter a short lane between junctions and has no permit.
fn wants_permit(scene: &Scene<'_>, vehicle: &Vehicle) -> Option<Wish> {
    let cluster = scene.tracks.clusters.entered_by(scene.tracks, vehicle.next, vehicle)?;
    let has_permit = scene.permits.iter().any(|permit| permit.is_for(vehicle.id, cluster));
    (!has_permit).then(|| Wish::new(cluster, vehicle))
}

/// Whether one who has the permit of a cluster lets those out first who were let in after it; in a ring there is room for all of them.
fn lets_out(scene: &Scene<'_>, vehicle: &Vehicle) -> bool {
    let clusters = &scene.tracks.clusters;
    let entered = clusters.entered_by(scene.tracks, vehicle.next, vehicle);
    entered.filter(|cluster| clusters.places(*cluster).is_none()).is_some_and(|cluster| {
        let has_permit = scene.permits.iter().any(|permit| permit.is_for(vehicle.id, cluster));
        has_permit && awaited(scene.permits, cluster, vehicle.id).next().is_some()
    })
}

/// Whether a vehicle may enter without room behind the junction, because it is in a lock.
pub(in crate::vehicle) fn may_pass(scene: &Scene<'_>, vehicle: &Vehicle) -> bool {
    scene.passes.binary_search(&vehicle.id).is_ok()
}

/// Whether the lane behind the junction has room, so that the junction is not blocked.
pub(super) fn has_room(scene: &Scene<'_>, way: usize, vehicle: &Vehicle) -> bool {
    let tracks = scene.tracks;
    let lane = tracks.lane_after(way);
    if tracks.is_alone(way) && !tracks.clusters.has(lane) {
        return true;
    }
    // Who is in a roundabout follows those before while they move, through the places where others enter: its lanes are too short
    // for the room of two.
    let last = scene.tail(lane);
    let goes_round = tracks.is_in_ring(lane) && tracks.is_in_ring(tracks.ways[way].from);
    if goes_round && (last.is_none() || last.v > STANDING) {
        return true;
    }
    is_room(scene.tracks, scene.config, (scene.junctions, scene.storage), (lane, last), vehicle)
}

/// Whether a lane with such a last vehicle has room for another.
pub(super) fn is_room(
    tracks: &Tracks,
    config: &TrafficConfig,
    (junctions, storage): (&Junctions, &Storage),
    (lane, last): (Track, &Tail),
    vehicle: &Vehicle,
) -> bool {
    let (inbound, room) = (junctions.inbound(lane), f64::from(ticks(vehicle, config)) / TICKS + SETTLES);
    // The first stands at the line, without a gap.
    let length = tracks.length[lane as usize] + config.vehicle_type(vehicle.row).driver.gap - BEFORE_LINE;
    if last.is_none() {
        // An empty lane takes one vehicle even if it is longer than the lane.
        return inbound <= 0.0 || inbound + room <= length;
    }
    // What moves will have moved on by the time one gets there.
    let moves = if last.v > STANDING { last.v * 2.0 } else { 0.0 };
    // Who has to stand on the bend behind the lane takes the end of it.
    let gap = config.vehicle_type(vehicle.row).driver.gap;
    let over = if last.over() > 0.0 { last.over() + gap } else { 0.0 };
    // Unless all of them fit there when they stand, one's rear may stay in the junction; in a roundabout who goes first does not
    // stand, and its lanes are too short for two.
    let fits = || tracks.is_in_ring(lane) || storage.taken(lane) + over + inbound + room <= length;
    last.rear - inbound >= room || (last.rear + moves - inbound >= room && fits())
}

/// Room on a lane that a vehicle takes when it stands, in ticks.
pub(in crate::vehicle) fn ticks(vehicle: &Vehicle, config: &TrafficConfig) -> u32 {
    ((vehicle.length() + config.vehicle_type(vehicle.row).driver.gap) * TICKS).ceil() as u32
}
