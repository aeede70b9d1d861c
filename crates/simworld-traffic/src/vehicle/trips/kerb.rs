//! The kerb: who departs from a parking place beside a lane, and who ends a trip in one.
//!
//! Who departs waits in the place until those behind need not brake harder than comfortably for it, then stands in the queue of
//! the lane, still in the place, and moves over into the lane as it gets under way. Who parks moves over to the place while
//! it brakes for it. Where the road has no parking strip, or a cycle lane lies between, both happen in the lane.

use simworld_core::net::{DrivingSide, LaneKind, RoadNetwork, polyline};

use super::entry::Place;
use crate::demand::Departure;
use crate::vehicle::driving::lane_change::{CHANGE_ROOM, sideways};
use crate::vehicle::driving::sirens::Sirens;
use crate::vehicle::manager::{NONE, VehicleManager};
use crate::vehicle::tracks::{Track, Tracks};
use crate::{Leg, TrafficConfig};

/// Nobody departs from or parks at a place nearer to the junction ahead than this, m: there is room to get into the lane.
pub(crate) const BEFORE_JUNCTION: f64 = CHANGE_ROOM + 3.0;
/// Who comes out of the junction behind is not in the queue yet: so near to it one lets it pass, m.
const BEHIND_JUNCTION: f64 = 25.0;
/// A place farther from its lane than this is not beside it, m.
const FARTHEST: f64 = 4.0;
/// Room beside somebody in a lane that is being crossed, m.
const BESIDE: f64 = 1.0;

/// How far to the left of each lane the parking strip at its kerb lies, m, negative to the right; 0 where there is none.
pub(in crate::vehicle) fn places(network: &RoadNetwork, beside: &[[Track; 2]]) -> Vec<f32> {
    let mut places = vec![0.0; network.lanes.len()];
    let is_right = network.driving_side == DrivingSide::Right;
    let kerb = usize::from(is_right);
    for road in &network.roads {
        for (lanes, is_forward) in [(&road.forward, true), (&road.backward, false)] {
            let Some(lane) = lanes.last().filter(|lane| beside[lane.index()][kerb] == NONE) else { continue };
            let path = &network.lanes[lane.index()];
            let middle = polyline::at(&path.path, path.length * 0.5).0;
            let Some(own) = polyline::closest(&road.centerline, &middle) else { continue };
            // To the right of those who drive along the centreline is to its right.
            let to_right = is_right == is_forward;
            let strips = road.strips.iter().filter(|strip| strip.kind == LaneKind::Parking);
            let away = strips.map(|strip| (own.lateral - strip.offset) * if to_right { 1.0 } else { -1.0 });
            let nearest = away.filter(|away| (0.0..=FARTHEST).contains(away)).fold(f64::INFINITY, f64::min);
            if nearest.is_finite() {
                places[lane.index()] = if is_right { -nearest as f32 } else { nearest as f32 };
            }
        }
    }
    places
}

impl VehicleManager {
    /// Lets a vehicle depart from the kerb of a leg, its front at a station, if the lane is free for it.
    pub(crate) fn pull_out(
        &mut self,
        tracks: &Tracks,
        config: &TrafficConfig,
        (leg, station): (Leg, f64),
        departure: &Departure,
        now: f64,
    ) -> bool {
        let Some(departure) = &self.open_departure(tracks, departure) else { return false };
        let row = config.vehicle_type(departure.row);
        let factor = Sirens::factor(row, departure.factor, row.siren);
        let departure = &Departure { factor, ..*departure };
        let outermost = tracks
            .lanes_of(leg, row.kind)
            .filter(|lane| !tracks.network.lanes[*lane as usize].kind.eq(&LaneKind::Cycle));
        let Some(lane) = outermost.last() else { return false };
        let s = station.max(row.length + 1.0).min(tracks.length[lane as usize] - 1.0);
        let rear = s - row.length;
        let inbound = self.junctions.inbound(lane) > 0.0;
        let is_blocked = self.closures.has(lane)
            || self
                .closures
                .blocks
                .iter()
                .any(|(at, from, to)| *at == lane && rear < *to && s + row.driver.gap > *from)
            || tracks.beside[lane as usize]
                .iter()
                .any(|beside| self.is_leaving(tracks, *beside, lane, (rear, s)));
        let Some(rank) = self.gap_at(tracks, config, lane, (rear, s + row.driver.gap), inbound) else {
            return false;
        };
        if is_blocked || self.passings.touches(lane) {
            return false;
        }
        let place = Place { lane, s, v: 0.0, rank, shift: tracks.kerb[lane as usize] };
        let id = self.put(tracks, config, departure, place, now);
        if place.shift != 0.0 {
            self.move_in(tracks, lane, id);
        }
        true
    }

    /// Lets a vehicle that is beside the middle of its lane move over into it.
    pub(super) fn move_in(&mut self, tracks: &Tracks, lane: Track, id: u32) {
        let place = tracks.layout.place(lane);
        let shifting = &mut self.parts[place.part as usize].shifting;
        if !shifting.contains(&(place.local, id)) {
            shifting.push((place.local, id));
        }
    }

    /// The rank in a lane of a vehicle that would stand there from one station to another, if that hinders nobody.
    fn gap_at(
        &self,
        tracks: &Tracks,
        config: &TrafficConfig,
        lane: Track,
        (rear, front): (f64, f64),
        inbound: bool,
    ) -> Option<usize> {
        let queue = self.queue(tracks, lane);
        let rank = queue.partition_point(|other| other.s >= rear);
        let is_free = rank.checked_sub(1).is_none_or(|ahead| queue[ahead].s - queue[ahead].length() > front);
        let lets_in = queue.get(rank).map_or(!inbound || rear > BEHIND_JUNCTION, |behind| {
            let row = config.vehicle_type(behind.row);
            let free = row.free_speed(config, behind.factor, tracks.speed[lane as usize]);
            // Not even somebody by another model or with errors: what the IDM asks for.
            let gap = rear - behind.s;
            gap > row.driver.gap
                && row.driver.acceleration(behind.v, free, gap, 0.0) > -row.driver.deceleration
        });
        (is_free && lets_in).then_some(rank)
    }

    /// Whether somebody in the lane beside has not quite left a stretch of another.
    fn is_leaving(&self, tracks: &Tracks, beside: Track, lane: Track, (rear, front): (f64, f64)) -> bool {
        if beside == NONE {
            return false;
        }
        let stretch = tracks.length[beside as usize] / tracks.length[lane as usize];
        let (rear, front) = ((rear - BESIDE) * stretch, (front + BESIDE) * stretch);
        let is_left = tracks.beside[beside as usize][0] == lane;
        let leaves = |shift: f32| if is_left { shift > 0.0 } else { shift < 0.0 };
        self.queue(tracks, beside)
            .iter()
            .any(|other| leaves(other.shift) && other.s > rear && other.s - other.length() < front)
    }

    /// Moves those over who are about to park.
    pub(in crate::vehicle) fn pull_in(&mut self, tracks: &Tracks, dt: f64) {
        let mut from = 0;
        while let Some(id) = self.halts.next_parking(from) {
            self.pull_one_in(tracks, id, dt);
            from = id + 1;
        }
    }

    fn pull_one_in(&mut self, tracks: &Tracks, id: u32, dt: f64) {
        let Some((track, vehicle, _)) = self.find(tracks, id) else { return };
        if self.passings.of(id).is_some() {
            return; // first it comes back into its lane
        }
        let Some(target) = tracks.kerb.get(track as usize).copied().filter(|target| *target != 0.0) else {
            return;
        };
        let to_halt = f64::from(vehicle.halt) - vehicle.s;
        let (reach, shift) = (f64::from(target.abs()), f64::from(vehicle.shift.abs()));
        // Only from within its lane, and so late that it is there when it stands.
        let is_between = vehicle.shift != 0.0 && vehicle.shift.signum() != target.signum();
        if is_between || to_halt > CHANGE_ROOM * reach / FARTHEST {
            return;
        }
        let moved = (shift + sideways(vehicle.v) * dt).min(reach) as f32;
        let (queue, _) = self.both_mut(tracks, track);
        if let Some(vehicle) = queue.iter_mut().find(|vehicle| vehicle.id == id) {
            vehicle.shift = moved.copysign(target);
        }
    }
}
