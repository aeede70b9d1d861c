//! The vehicle manager: all vehicles, in parts that threads work on, and what the parts share.
//!
//! A step has three phases, and all threads end one before any begins the next:
//!
//! 1. *Arrange*: those who change lanes move over, others begin to; each part shows the last vehicle of each of its lanes.
//! 2. *Drive*: leave to cross is taken back and granted, accelerations are computed from the frozen state, everybody moves;
//!    who passes into the next road is handed over; claims on crossings are counted.
//! 3. *Settle*: those handed over join their lanes and claim what they have not cleared, junctions that were cleared become free.
//!
//! A part writes its own vehicles only. Of other parts it sees what they show, and the sums in [`Junctions`], which nobody reads
//! in the phase in which others add to them. Who goes out on the oncoming lane is decided [before](super::driving::passing). The result is the same on any number of threads. Parts far from all interest go in
//! one step of several ([`Clock`](super::clock::Clock)).

use serde::{Deserialize, Serialize};
use simworld_core::id::CrossingId;
use simworld_core::net::Workers;
use simworld_core::seed::Stream;

use super::clock::Moment;
use super::driving::idm::Driver;
use super::driving::passing::Passings;
use super::driving::sirens::Sirens;
use super::foreign::controls::{Controls, hasty};
use super::junctions::clusters::{Permit, Wish};
use super::junctions::deadlock::Waits;
use super::junctions::junction::Junctions;
use super::junctions::trailing::Trail;
use super::part::{Part, Transfer};
use super::queues::path::Path;
use super::queues::slabs::Slabs;
use super::queues::storage::Storage;
use super::queues::tail::Tail;
use super::queues::tally::Tally;
use super::scene::{Scene, Sight};
use super::threads::{Sweep, each};
use super::tracks::closures::Closures;
use super::tracks::{Track, Tracks};
use super::trips::delays::Delays;
use super::trips::detours::Detours;
use super::trips::halts::Halts;
use super::trips::reroute::Rounds;
use super::types::{TypeIndex, VehicleType, is_long};
use crate::{Counters, Leg, Route, TrafficConfig, Trip};

/// No connection, no track, no route.
pub(crate) const NONE: u32 = u32::MAX;
/// No connection: the vehicle leaves the network at the end of its lane.
pub(crate) const EXIT: u32 = u32::MAX - 1;
/// A vehicle slower than this stands, m/s.
pub(crate) const STANDING: f64 = 0.1;

/// One vehicle, as far as a step needs it: a line of the cache, and no more than one.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[repr(align(64))]
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
    /// Its place in the order of leave of the part.
    pub(crate) granted: u32,
    /// Its type: a row of the table.
    pub(crate) row: TypeIndex,
    /// Length, m, as in the table.
    pub(crate) length: f32,
    /// The speed that its driver chooses, as a share of the limit.
    pub(crate) factor: f32,
    /// The station on its lane at which it is to halt, m; infinite if it is not.
    pub(crate) halt: f32,
    /// How far its body is to the left of its lane while it changes, m.
    pub(crate) shift: f32,
    /// Its acceleration in the last step, m/s²: kept between decisions by those who decide less often.
    pub(crate) acceleration: f32,
}

const _: () = assert!(size_of::<Vehicle>() == 64);

impl Vehicle {
    /// One at rest at a station, with no way on yet.
    pub(super) fn new(kind: &VehicleType, row: TypeIndex, factor: f32, id: u32, s: f64) -> Self {
        let length = kind.length as f32;
        Self { s, id, next: NONE, holding: NONE, row, length, factor, halt: f32::INFINITY, ..Self::default() }
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

/// All vehicles.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(crate) struct VehicleManager {
    pub(super) parts: Vec<Part>,
    pub(super) junctions: Junctions,
    pub(super) storage: Storage,
    pub(super) trails: Vec<Trail>,
    pub(super) permits: Vec<Permit>,
    #[serde(skip)]
    pub(super) wishes: Vec<Wish>,
    /// The track of each vehicle by its number; [`NONE`] for numbers that nobody has.
    pub(super) whereabouts: Tally,
    pub(super) routes: Vec<Route>,
    /// Routes that lead off the map, since nothing leads where their drivers wanted to go: their places in the list, ascending.
    pub(super) off: Vec<u32>,
    /// Those in a lock who may enter their junction without room behind it, ascending.
    pub(super) passes: Vec<u32>,
    /// What is closed.
    pub(crate) closures: Closures,
    /// Where vehicles are to halt.
    pub(super) halts: Halts,
    /// Who is driven by somebody else.
    pub(super) controls: Controls,
    pub(super) rounds: Rounds,
    /// How long the streets take now, and the routes of those who left theirs for it.
    pub(super) delays: Delays,
    pub(super) detours: Detours,
    /// Who has a siren on.
    pub(crate) sirens: Sirens,
    /// Who passes what stands on a lane.
    pub(super) passings: Passings,
    /// Numbers that nobody has any more.
    pub(super) free: Vec<u32>,
    /// Numbers of those who entered in the last step, and the trips that ended in it.
    #[serde(skip)]
    pub(crate) entered: Vec<u32>,
    #[serde(skip)]
    pub(crate) ended: Vec<Trip>,
    /// What binds those whom somebody else drives, under the conditions of now.
    #[serde(skip)]
    hasty: Option<TrafficConfig>,
    /// The drivers of each type, and the same of those.
    #[serde(skip)]
    drivers: [Vec<Driver>; 2],
    #[serde(skip)]
    pub(super) waits: Waits,
    /// Lanes whose first has lost patience.
    #[serde(skip)]
    pub(super) stuck: Vec<Track>,
    #[serde(skip)]
    tails: Vec<Vec<Tail>>,
    #[serde(skip)]
    handed: Vec<Vec<Vec<Transfer>>>,
}

impl VehicleManager {
    pub(crate) fn new(tracks: &Tracks) -> Self {
        let part = |layout: &super::tracks::layout::PartLayout| Slabs::new(layout.tracks.len());
        let slabs = tracks.layout.parts.iter().map(part);
        Self {
            parts: slabs.enumerate().map(|(number, slabs)| Part::new(number, slabs)).collect(),
            junctions: Junctions::new(tracks),
            storage: Storage::new(tracks.lanes),
            ..Self::default()
        }
    }

    /// The way on of a vehicle that comes to a lane between two steps.
    pub(super) fn choose(
        &self,
        (tracks, config): (&Tracks, &TrafficConfig),
        streams: Stream,
        weights: &mut Vec<f64>,
        vehicle: &Vehicle,
        path: &mut Path,
        lane: Track,
    ) -> u32 {
        let nothing = Sight { aspects: &[], shown: &[], walkers: &[], waiting: &[], obstacles: &[] };
        let at = Moment { now: 0.0, dt: 0.0, step: 0 };
        self.scene(tracks, config, nothing, streams, at).choose(weights, vehicle, path, lane)
    }

    pub(super) fn scene<'a>(
        &'a self,
        tracks: &'a Tracks,
        config: &'a TrafficConfig,
        sight: Sight<'a>,
        streams: Stream,
        at: Moment,
    ) -> Scene<'a> {
        Scene {
            tracks,
            config,
            sight,
            streams,
            at,
            routes: &self.routes,
            off: &self.off,
            junctions: &self.junctions,
            storage: &self.storage,
            trails: &self.trails,
            permits: &self.permits,
            whereabouts: &self.whereabouts,
            tails: &self.tails,
            passes: &self.passes,
            closures: &self.closures,
            halts: &self.halts,
            controls: &self.controls,
            hasty: self.hasty.as_ref().unwrap_or(config),
            drivers: &self.drivers[0],
            hasty_drivers: &self.drivers[1],
            sirens: &self.sirens,
            passings: &self.passings,
            handed: &self.handed,
        }
    }

    /// The vehicles of a track, front to back.
    pub(crate) fn queue(&self, tracks: &Tracks, track: Track) -> &[Vehicle] {
        let place = tracks.layout.place(track);
        self.parts[place.part as usize].slabs.queue(place.local as usize)
    }

    /// The vehicles of a track and what they were, to change them.
    pub(super) fn both_mut(&mut self, tracks: &Tracks, track: Track) -> (&mut [Vehicle], &mut [Path]) {
        let place = tracks.layout.place(track);
        self.parts[place.part as usize].slabs.both_mut(place.local as usize)
    }

    /// What the vehicles of a track were, front to back.
    pub(super) fn paths(&self, tracks: &Tracks, track: Track) -> &[Path] {
        let place = tracks.layout.place(track);
        self.parts[place.part as usize].slabs.paths(place.local as usize)
    }

    /// A vehicle by its number, with its track.
    pub(crate) fn find<'a>(&'a self, tracks: &Tracks, id: u32) -> Option<(Track, &'a Vehicle, &'a Path)> {
        let known = (id as usize) < self.numbers();
        let track = known.then(|| self.whereabouts.get(id as usize)).filter(|track| *track != NONE)?;
        let place = tracks.layout.place(track);
        let slabs = &self.parts[place.part as usize].slabs;
        let rank = slabs.queue(place.local as usize).iter().position(|vehicle| vehicle.id == id)?;
        Some((track, &slabs.queue(place.local as usize)[rank], &slabs.paths(place.local as usize)[rank]))
    }

    pub(super) fn push(&mut self, tracks: &Tracks, track: Track, vehicle: Vehicle, path: Path) {
        let place = tracks.layout.place(track);
        self.parts[place.part as usize].slabs.push(place.local as usize, vehicle, path);
    }

    /// How many numbers vehicles have.
    pub(crate) fn numbers(&self) -> usize {
        self.whereabouts.len()
    }

    /// Vehicles about to pass a crossing.
    pub(crate) fn claims(&self, crossing: CrossingId) -> u32 {
        self.junctions.claims(crossing)
    }

    /// One step of all vehicles.
    #[expect(clippy::too_many_arguments, reason = "a step sees all of the traffic")]
    pub(crate) fn step(
        &mut self,
        tracks: &Tracks,
        config: &TrafficConfig,
        streams: Stream,
        sight: Sight<'_>,
        at: Moment,
        counters: &mut Counters,
        workers: &dyn Workers,
    ) {
        self.unlock(tracks, config, at, counters, workers);
        self.turn_off(tracks, config, at, counters);
        self.think_over(tracks, config, streams, at, counters);
        self.steer(tracks, config, streams);
        self.come_round(tracks, config, streams);
        self.mind_haste(config);
        self.hear_sirens(tracks);
        self.begin_step(tracks, &at);
        self.tails.resize_with(self.parts.len(), Vec::new);
        self.handed.resize_with(self.parts.len(), Vec::new);
        let mut parts = std::mem::take(&mut self.parts);
        let scene = self.scene(tracks, config, sight, streams, at);
        each(workers, Sweep::of(at.step, 0), &mut parts, |_, part| part.arrange(&scene));
        for (part, tails) in parts.iter_mut().zip(&mut self.tails) {
            std::mem::swap(&mut part.work.tails, tails);
        }
        self.junctions.forget_claims(&at);
        let scene = self.scene(tracks, config, sight, streams, at);
        each(workers, Sweep::of(at.step, 1), &mut parts, |_, part| part.drive(&scene));
        for ((part, tails), handed) in parts.iter_mut().zip(&mut self.tails).zip(&mut self.handed) {
            std::mem::swap(&mut part.work.tails, tails);
            std::mem::swap(&mut part.work.handed, handed);
        }
        let scene = self.scene(tracks, config, sight, streams, at);
        each(workers, Sweep::of(at.step, 2), &mut parts, |_, part| part.settle(&scene));
        for (part, handed) in parts.iter_mut().zip(&mut self.handed) {
            std::mem::swap(&mut part.work.handed, handed);
        }
        self.parts = parts;
        self.give_permits(tracks, config, at.dt);
        self.sum_up(tracks, counters);
        self.serve_halts(tracks, config, at.now + at.dt, counters);
        self.pull_in(tracks, at.dt);
    }

    /// Takes up the conditions, for those whom somebody else drives if there are any.
    fn mind_haste(&mut self, config: &TrafficConfig) {
        let is_known = self.hasty.as_ref().is_some_and(|hasty| hasty.conditions == config.conditions);
        if !self.controls.is_empty() && !is_known {
            self.hasty = Some(hasty(config));
        }
        let settings = [config, self.hasty.as_ref().unwrap_or(config)];
        for (known, config) in self.drivers.iter_mut().zip(settings) {
            known.clear();
            known.extend(config.types.iter().map(Driver::of));
        }
    }

    /// Takes together what the parts counted, whose trips ended, and who lost patience.
    fn sum_up(&mut self, tracks: &Tracks, counters: &mut Counters) {
        let begin = self.ended.len();
        let mut parts = std::mem::take(&mut self.parts);
        for part in &mut parts {
            counters.absorb(&std::mem::take(&mut part.work.counters));
            self.ended.append(&mut part.work.ended);
            self.stuck.append(&mut part.work.stuck);
            let passes = &mut self.passes;
            part.work.used_passes.drain(..).for_each(|id| passes.retain(|pass| *pass != id));
        }
        self.parts = parts;
        self.follow_trails(tracks);
        self.lose_patience(tracks, counters);
        // By number: parts are no matter of those who watch.
        self.ended[begin..].sort_by_key(|trip| trip.id);
        for trip in &self.ended[begin..] {
            self.halts.remove(trip.id);
            self.controls.forget(trip.id);
            self.rounds.forget(trip.id);
            self.detours.forget(trip.id);
            self.sirens.switch(trip.id, false);
            self.free.push(trip.id);
        }
    }

    /// Every vehicle with its track, track by track, front to back.
    pub(crate) fn iter<'a>(
        &'a self,
        tracks: &'a Tracks,
    ) -> impl Iterator<Item = (Track, &'a Vehicle, &'a Path)> {
        self.parts.iter().zip(&tracks.layout.parts).flat_map(|(part, layout)| {
            part.slabs.occupied().flat_map(move |local| {
                let pairs = part.slabs.queue(local).iter().zip(part.slabs.paths(local));
                pairs.map(move |(vehicle, path)| (layout.tracks[local], vehicle, path))
            })
        })
    }

    /// The lanes that have vehicles, and these.
    pub(crate) fn queues<'a>(&'a self, tracks: &'a Tracks) -> impl Iterator<Item = (Track, &'a [Vehicle])> {
        (0..self.parts.len()).flat_map(|part| self.queues_of(tracks, part))
    }

    /// The lanes of a part that have vehicles, and these.
    pub(super) fn queues_of<'a>(
        &'a self,
        tracks: &'a Tracks,
        part: usize,
    ) -> impl Iterator<Item = (Track, &'a [Vehicle])> {
        let (slabs, layout) = (&self.parts[part].slabs, &tracks.layout.parts[part]);
        let lanes = slabs.occupied().take_while(|local| *local < layout.lanes);
        lanes.map(|local| (layout.tracks[local], slabs.queue(local)))
    }

    /// The leg to which a vehicle wants to go from its lane.
    pub(super) fn next_leg(
        tracks: &Tracks,
        routes: &[Route],
        (lane, vehicle): (Track, &Vehicle),
        path: &Path,
    ) -> Option<Leg> {
        if let Some(route) = routes.get(path.route as usize) {
            return route.0.get(path.leg as usize + 1).copied();
        }
        // Looked up with the lane, beside what its neighbours look up.
        tracks.exits(lane).iter().find(|(way, _)| *way == vehicle.next).map(|(_, leg)| *leg)
    }

    /// Bytes that the vehicles take, hot and cold, with all that is kept for a step.
    pub(crate) fn bytes(&self) -> usize {
        let parts: usize = self.parts.iter().map(Part::bytes).sum();
        let tails: usize = self.tails.iter().map(|tails| tails.capacity() * size_of::<Tail>()).sum();
        parts + tails + self.whereabouts.len() * 4 + self.junctions.bytes() + self.storage.bytes()
    }
}
