//! Vehicles that somebody else drives: on their lanes, within what keeps everybody safe, or as free bodies beside them.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use simworld_core::geometry::{Pose, Twist, planar};
use simworld_core::hash::StateHasher;
use simworld_core::id::LaneId;
use simworld_core::seed::Stream;

use crate::takeover::{ControlError, Drive, LaneWish};
use crate::vehicle::driving::lookahead::{Lane, acceleration};
use crate::vehicle::manager::{NONE, Vehicle, VehicleManager};
use crate::vehicle::part::Part;
use crate::vehicle::queues::path::Path;
use crate::vehicle::scene::Scene;
use crate::vehicle::tracks::{Track, Tracks};
use crate::vehicle::{CarFollowing, VehicleKind};
use crate::{Leg, TrafficConfig};

/// What others drive accelerates at most so many times as hard as drivers like to.
const HASTE: f64 = 2.0;
/// It goes at most so many times as fast as its driver would where a law or a bend holds: in bends that is twice the lateral
/// acceleration of the others.
const SPEEDING: f64 = std::f64::consts::SQRT_2;
/// The time gap and the gap at rest below which nobody is let, s and m.
const LEAST_HEADWAY: f64 = 0.5;
const LEAST_GAP: f64 = 1.0;

/// A vehicle that somebody else moves as a body of its own.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct FreeVehicle {
    /// What it was, and will be again; its station is nowhere.
    pub(in crate::vehicle) vehicle: Vehicle,
    pub(in crate::vehicle) path: Path,
    /// The track it was on, for its trip.
    pub(in crate::vehicle) from: Track,
    pub(crate) pose: Pose,
    pub(crate) twist: Twist,
}

impl FreeVehicle {
    pub(crate) fn vehicle(&self) -> &Vehicle {
        &self.vehicle
    }

    /// Puts it somewhere else; its trip is as long as its way over the ground.
    pub(crate) fn move_to(&mut self, pose: Pose, twist: Twist) {
        self.path.add((planar(&pose) - planar(&self.pose)).norm(), 0.0);
        (self.pose, self.twist) = (pose, twist);
    }
}

/// Who is driven by somebody else, and how.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Controls {
    pub(in crate::vehicle) driven: BTreeMap<u32, Drive>,
    pub(in crate::vehicle) free: BTreeMap<u32, FreeVehicle>,
}

impl Controls {
    /// Whether nobody is driven on a lane by somebody else.
    #[inline]
    pub(in crate::vehicle) fn is_empty(&self) -> bool {
        self.driven.is_empty()
    }

    /// Whether somebody else drives a vehicle on its lane.
    #[inline]
    pub(in crate::vehicle) fn drives(&self, id: u32) -> bool {
        !self.is_empty() && self.driven.contains_key(&id)
    }

    /// The first from a number on that somebody else drives on its lane.
    pub(in crate::vehicle) fn next_driven(&self, from: u32) -> Option<u32> {
        self.driven.range(from..).next().map(|(id, _)| *id)
    }

    /// In which lane a vehicle is wanted; none if its own driver drives.
    #[inline]
    pub(in crate::vehicle) fn lane_wish(&self, id: u32) -> Option<LaneWish> {
        if self.is_empty() {
            return None;
        }
        self.driven.get(&id).map(|drive| drive.lane).filter(|wish| *wish != LaneWish::AsDriven)
    }

    /// The leg that who drives a vehicle wants to take.
    #[inline]
    pub(in crate::vehicle) fn next_leg(&self, id: u32) -> Option<Leg> {
        if self.is_empty() { None } else { self.driven.get(&id)?.next }
    }

    pub(in crate::vehicle) fn forget(&mut self, id: u32) {
        self.driven.remove(&id);
        self.free.remove(&id);
    }

    pub(in crate::vehicle) fn fits(
        &self,
        tracks: &Tracks,
        types: usize,
        routes: usize,
        whereabouts: &[u32],
    ) -> bool {
        let is_known = |id: u32| whereabouts.get(id as usize);
        self.driven
            .iter()
            .all(|(id, drive)| is_known(*id).is_some_and(|track| *track != NONE) && drive.validate().is_ok())
            && self.free.iter().all(|(id, free)| {
                let FreeVehicle { vehicle, path, from, pose, twist } = free;
                let numbers = pose.translation.vector.iter().chain(pose.rotation.coords.iter());
                let speeds = twist.linear.iter().chain(twist.angular.iter());
                is_known(*id) == Some(&NONE)
                    && vehicle.id == *id
                    && usize::from(vehicle.row) < types
                    && vehicle.length > 0.0
                    && vehicle.factor > 0.0
                    && (path.route == NONE || (path.route as usize) < routes)
                    && (*from as usize) < tracks.count()
                    && numbers.chain(speeds).all(|number| number.is_finite())
            })
    }

    pub(in crate::vehicle) fn state_hash(&self, hasher: &mut StateHasher) {
        for (id, drive) in &self.driven {
            hasher.u64(u64::from(*id)).f64(drive.acceleration).u64(drive.lane as u64);
            hasher.u64(drive.next.map_or(u64::MAX, |leg| leg.index() as u64));
        }
        for (id, free) in &self.free {
            hasher.u64(u64::from(*id));
            let FreeVehicle { pose, twist, .. } = free;
            let numbers = pose.translation.vector.iter().chain(pose.rotation.coords.iter());
            for number in numbers.chain(twist.linear.iter()).chain(twist.angular.iter()) {
                hasher.f64(*number);
            }
        }
    }
}

/// The settings under which drivers would drive as hard as is safe: what others may ask of a vehicle is bound by them.
pub(crate) fn hasty(config: &TrafficConfig) -> TrafficConfig {
    let mut config = config.clone();
    for row in &mut config.types {
        // The one of the models that answers to everything ahead at once without a draw, and eyes that miss nothing.
        (row.model, row.perception) = (CarFollowing::Idm, None);
        let driver = &mut row.driver;
        driver.desired_speed *= SPEEDING;
        driver.headway = driver.headway.min(LEAST_HEADWAY);
        driver.gap = driver.gap.min(LEAST_GAP);
        driver.acceleration *= HASTE;
        driver.deceleration = driver.deceleration.max(driver.emergency_deceleration * 0.5);
    }
    config
}

/// The accelerations of those of a track whom somebody else drives, m/s²: what is asked, within what they can and may. The
/// lane is one of hasty drivers; `ids` are those of its vehicles.
pub(in crate::vehicle) fn obey(
    scene: &Scene<'_>,
    lane: &Lane<'_>,
    queue: &[Vehicle],
    ids: impl Iterator<Item = u32>,
    accelerations: &mut [f64],
) {
    for id in ids {
        let (Some(rank), Some(drive)) =
            (queue.iter().position(|vehicle| vehicle.id == id), scene.controls.driven.get(&id))
        else {
            continue;
        };
        let vehicle = &queue[rank];
        let driver = &scene.hasty.vehicle_type(vehicle.row).driver;
        let hurried = Vehicle { factor: vehicle.factor * SPEEDING as f32, ..*vehicle };
        // People, lines, bends and whoever is ahead bind the fastest that is safe.
        let leader = rank.checked_sub(1).map(|ahead| &queue[ahead]);
        let most = acceleration(lane, &hurried, leader);
        accelerations[rank] = drive.acceleration.max(-driver.emergency_deceleration).min(most);
    }
}

impl Part {
    /// Lists who of its vehicles is driven by somebody else, by the number of the track in the part.
    pub(in crate::vehicle) fn list_steered(&mut self, scene: &Scene<'_>) {
        self.work.steered.clear();
        for id in scene.controls.driven.keys() {
            let track = scene.whereabouts.get(*id as usize);
            // Nobody passes to another part in the phase in which this is asked.
            let place = (track != NONE).then(|| scene.tracks.layout.place(track));
            if let Some(place) = place.filter(|place| place.part == self.number()) {
                self.work.steered.push((place.local, *id));
            }
        }
        self.work.steered.sort_unstable();
    }
}

impl VehicleManager {
    /// How somebody else drives a vehicle.
    pub(crate) fn driven(&self, id: u32) -> Option<&Drive> {
        self.controls.driven.get(&id)
    }

    /// A vehicle that is a free body.
    pub(crate) fn free_body(&self, id: u32) -> Option<&FreeVehicle> {
        self.controls.free.get(&id)
    }

    pub(crate) fn free_body_mut(&mut self, id: u32) -> Option<&mut FreeVehicle> {
        self.controls.free.get_mut(&id)
    }

    /// The vehicles that are free bodies, by number.
    pub(crate) fn free_bodies(&self) -> impl Iterator<Item = (u32, &FreeVehicle)> {
        self.controls.free.iter().map(|(id, free)| (*id, free))
    }

    /// Drives a vehicle so from the next step on.
    pub(crate) fn drive(
        &mut self,
        tracks: &Tracks,
        config: &TrafficConfig,
        id: u32,
        drive: Drive,
    ) -> Result<(), ControlError> {
        drive.validate()?;
        if self.controls.free.contains_key(&id) {
            let (wanted, mend) = ("on a lane", "give it back first");
            return Err(ControlError::NotSo { what: "vehicle", id, wanted, mend });
        }
        let (track, vehicle, _) =
            self.find(tracks, id).ok_or(ControlError::Nobody { what: "vehicle", id })?;
        if let Some(next) = drive.next {
            let kind = config.vehicle_type(vehicle.row).kind;
            self.check_turn(tracks, track, next, kind).map_err(|reason| ControlError::Turn { id, reason })?;
        }
        self.controls.driven.insert(id, drive);
        Ok(())
    }

    /// Whether one may turn to a leg at the end of the one that one is on, or comes to.
    fn check_turn(
        &self,
        tracks: &Tracks,
        track: Track,
        next: Leg,
        kind: VehicleKind,
    ) -> Result<(), &'static str> {
        let lane = tracks.connection(track).map_or(track, |way| tracks.lane_after(way));
        let here = Leg::of(&tracks.network, LaneId(lane));
        let leads = |lane| tracks.way_to(&self.closures, lane, next, &[], kind).is_some();
        if !tracks.lanes_of(here, kind).any(leads) {
            return Err("no open way leads there from its road: give a leg that begins where its road ends");
        }
        Ok(())
    }

    /// Turns those who are driven by others towards the legs that these want; those who are gone are forgotten.
    pub(in crate::vehicle) fn steer(&mut self, tracks: &Tracks, config: &TrafficConfig, streams: Stream) {
        if self.controls.is_empty() {
            return;
        }
        let mut driven = std::mem::take(&mut self.controls.driven);
        driven.retain(|id, drive| {
            let Some((track, vehicle, path)) = self.find(tracks, *id) else { return false };
            let is_committed = vehicle.holding != NONE && vehicle.holding == vehicle.next;
            if tracks.connection(track).is_some() || is_committed {
                return true;
            }
            let (vehicle, path) = (*vehicle, *path);
            if drive.next == Some(Leg::of(&tracks.network, LaneId(track))) {
                drive.next = None;
            }
            self.turn(tracks, config, streams, track, (&vehicle, &path), drive.next);
            true
        });
        self.controls.driven = driven;
    }

    /// Lets a vehicle of a lane head for a leg, or for any if it has lost its way.
    fn turn(
        &mut self,
        tracks: &Tracks,
        config: &TrafficConfig,
        streams: Stream,
        lane: Track,
        (vehicle, path): (&Vehicle, &Path),
        next: Option<Leg>,
    ) {
        let queue = self.queue(tracks, lane);
        let Some(rank) = queue.iter().position(|other| other.id == vehicle.id) else { return };
        let kind = config.vehicle_type(vehicle.row).kind;
        let Some(leg) = next else {
            if vehicle.next == NONE && self.routes.get(path.route as usize).is_none() {
                let mut path = *path;
                let mind = (tracks, config);
                let way = self.choose(mind, streams, &mut Vec::new(), vehicle, &mut path, lane);
                let (queue, paths) = self.both_mut(tracks, lane);
                (queue[rank].next, paths[rank]) = (way, path);
            }
            return;
        };
        let Some(way) = tracks.way_to(&self.closures, lane, leg, &[], kind) else {
            // From this lane nothing leads there: it stands at its end until it is in another.
            self.both_mut(tracks, lane).0[rank].next = NONE;
            return;
        };
        if way != vehicle.next && !self.take_way(tracks, lane, rank, way) {
            // A route whose end cannot be reached that way is given up.
            let (queue, paths) = self.both_mut(tracks, lane);
            queue[rank].next = way;
            paths[rank].route = NONE;
        }
    }

    /// Lifts a vehicle off its track: from now on somebody else moves its body.
    pub(crate) fn lift(
        &mut self,
        tracks: &Tracks,
        config: &TrafficConfig,
        id: u32,
        pose: Pose,
        twist: Twist,
    ) -> bool {
        let Some((from, mut vehicle, mut path)) = self.take_out(tracks, config, id) else { return false };
        self.controls.driven.remove(&id);
        self.halts.remove(id);
        let row = config.vehicle_type(vehicle.row);
        let s = vehicle.s.min(tracks.length[from as usize]);
        path.add(s, s / row.free_speed(config, vehicle.factor, tracks.speed[from as usize]));
        (vehicle.s, vehicle.v, vehicle.stood, vehicle.shift, vehicle.acceleration) =
            (0.0, 0.0, 0.0, 0.0, 0.0);
        (vehicle.next, vehicle.holding, vehicle.halt) = (NONE, NONE, f32::INFINITY);
        self.controls.free.insert(id, FreeVehicle { vehicle, path, from, pose, twist });
        true
    }

    /// Gives a vehicle back to its own driver; false if nobody drove it on a lane.
    pub(crate) fn let_drive(&mut self, id: u32) -> bool {
        self.controls.driven.remove(&id).is_some()
    }
}
