//! How vehicles enter the network, follow their routes and leave it.

use crate::demand::Departure;
use crate::vehicle::VehicleKind;
use crate::vehicle::driving::sirens::Sirens;
use crate::vehicle::manager::{EXIT, NONE, Vehicle, VehicleManager};
use crate::vehicle::queues::path::Path;
use crate::vehicle::tracks::closures::Closures;
use crate::vehicle::tracks::{Track, Tracks};
use crate::{Leg, Route, TrafficConfig, Trip, TripEnd};

/// Where a vehicle enters.
#[derive(Clone, Copy, Debug)]
pub(in crate::vehicle) struct Place {
    pub(in crate::vehicle) lane: Track,
    /// Its front, m along the lane, and its speed, m/s.
    pub(in crate::vehicle) s: f64,
    pub(in crate::vehicle) v: f64,
    /// How many are before it in the lane.
    pub(in crate::vehicle) rank: usize,
    /// How far it is to the left of the lane, m.
    pub(in crate::vehicle) shift: f32,
}

impl VehicleManager {
    /// Keeps a route and returns its number.
    pub(crate) fn add_route(&mut self, route: Route) -> u32 {
        self.routes.push(route);
        (self.routes.len() - 1) as u32
    }

    /// Keeps a route in the place of another, and that it leads off the map, if that one did.
    pub(in crate::vehicle) fn add_route_for(&mut self, before: u32, route: Route) -> u32 {
        let route = self.add_route(route);
        if self.off.binary_search(&before).is_ok() {
            self.off.push(route);
        }
        route
    }

    /// The last leg of a route.
    pub(crate) fn last_leg(&self, route: u32) -> Option<Leg> {
        self.routes.get(route as usize)?.0.last().copied()
    }

    pub(crate) fn route_count(&self) -> usize {
        self.routes.len()
    }

    /// Puts a vehicle at the beginning of a leg if there is room; it comes at a speed at which it could stop for those
    /// before it.
    pub(crate) fn enter(
        &mut self,
        tracks: &Tracks,
        config: &TrafficConfig,
        leg: Leg,
        departure: &Departure,
        now: f64,
    ) -> bool {
        let Some(departure) = &self.open_departure(tracks, departure) else { return false };
        let legs = self.routes.get(departure.route as usize).map_or(&[][..], |route| &route.0);
        let row = config.vehicle_type(departure.row);
        let factor = Sirens::factor(row, departure.factor, row.siren);
        let departure = &Departure { factor, ..*departure };
        let (length, idm) = (row.length, &row.driver);
        let leads_on = |lane: &Track| {
            let [_, next, after @ ..] = legs else { return true };
            tracks.way_on(&self.closures, *lane, (*next, after), row.kind).is_some()
        };
        // Where only lanes for others lead on he begins beside them, and changes to one, or goes another way.
        let any_leads_on = tracks.lanes_of(leg, row.kind).any(|lane| leads_on(&lane));
        let room = |lane: Track| {
            let last = self.queue(tracks, lane).last();
            last.map_or(f64::INFINITY, |last| last.s - last.length() - length)
        };
        // As close behind as it would follow: who came closer would come so much slower, and hold up all who follow.
        let is_close = |lane: Track| {
            let last = self.queue(tracks, lane).last();
            last.is_some_and(|last| room(lane) <= idm.gap + idm.headway * last.v)
        };
        let best = tracks
            .lanes_of(leg, row.kind)
            .filter(|lane| !any_leads_on || leads_on(lane))
            .filter(|lane| self.junctions.inbound(*lane) <= 0.0 && tracks.length[*lane as usize] > length)
            .filter(|lane| !is_close(*lane) && !self.closures.has(*lane))
            .filter(|lane| {
                let limit = row.free_speed(config, departure.factor, tracks.speed[*lane as usize]);
                self.passings.leave_room(*lane, length + limit * limit / (2.0 * idm.deceleration))
            })
            // Who comes from beside the street does not take the room for which others have waited too long on it.
            .filter(|lane| !self.is_waited_for(tracks, *lane, |_| true))
            .max_by(|a, b| {
                let suits = |lane: Track| tracks.suits(lane, row.kind);
                suits(*a).cmp(&suits(*b)).then(room(*a).total_cmp(&room(*b))).then(b.cmp(a))
            });
        let Some(lane) = best else { return false };
        let limit = row.free_speed(config, departure.factor, tracks.speed[lane as usize]);
        let speed = self.queue(tracks, lane).last().map_or(limit, |leader| {
            let spare = room(lane) - idm.gap;
            let stopping = (leader.v * leader.v + 2.0 * idm.deceleration * spare).sqrt();
            limit.min(stopping).min(spare / idm.headway)
        });
        let rank = self.queue(tracks, lane).len();
        let place = Place { lane, s: length, v: speed, rank, shift: 0.0 };
        self.put(tracks, config, departure, place, now);
        true
    }

    /// A departure on a route around what is closed; none if there is no such route now.
    pub(super) fn open_departure(&mut self, tracks: &Tracks, departure: &Departure) -> Option<Departure> {
        if self.closures.is_empty() {
            return Some(*departure);
        }
        let legs = &self.routes.get(departure.route as usize)?.0;
        let (first, last) = (*legs.first()?, *legs.last()?);
        if self.closures.has_leg(tracks, first) {
            return None;
        }
        if !legs.iter().any(|leg| self.closures.has_leg(tracks, *leg)) {
            return Some(*departure);
        }
        let route = self.closures.quickest(tracks, first, last)?;
        // Who leaves the map by the same route wanted to go elsewhere.
        let is_lasting = |index: &u32| self.off.binary_search(index).is_err() && !self.detours.has(*index);
        let is_same = |index: &u32| self.routes[*index as usize] == route && is_lasting(index);
        let known = (0..self.routes.len() as u32).rev().find(is_same);
        let route = known.unwrap_or_else(|| self.add_route(route));
        Some(Departure { route, ..*departure })
    }

    /// Puts a vehicle into a lane, and returns its number.
    pub(in crate::vehicle) fn put(
        &mut self,
        tracks: &Tracks,
        config: &TrafficConfig,
        departure: &Departure,
        Place { lane, s, v, rank, shift }: Place,
        now: f64,
    ) -> u32 {
        let row = config.vehicle_type(departure.row);
        let mut path = Path::new(lane, departure.route, departure.scheduled, now);
        // Its way is not driven up to where its front appears.
        path.add(-s, -s / row.free_speed(config, departure.factor, tracks.speed[lane as usize]));
        let id = if let Some(id) = self.free.pop() {
            self.whereabouts.set(id as usize, lane);
            id
        } else {
            self.whereabouts.push(lane);
            (self.whereabouts.len() - 1) as u32
        };
        let route = self.routes.get(departure.route as usize);
        let next =
            route.map_or(NONE, |route| route_way(tracks, &self.closures, route, &path, lane, row.kind));
        let vehicle = Vehicle::new(row, departure.row, departure.factor, id, s);
        let vehicle = Vehicle { v, next, shift, ..vehicle };
        self.storage.add(lane, &vehicle, config);
        let place = tracks.layout.place(lane);
        self.parts[place.part as usize].slabs.insert(place.local as usize, rank, vehicle, path);
        self.sirens.switch(id, row.siren);
        self.entered.push(id);
        id
    }

    /// Takes a vehicle out, wherever it is; false if there is none of that number.
    pub(crate) fn remove(
        &mut self,
        tracks: &Tracks,
        config: &TrafficConfig,
        id: u32,
        end: TripEnd,
        now: f64,
    ) -> bool {
        // A free body is on no track; its trip ends where it left the last.
        let free = self.controls.free.remove(&id).map(|free| (free.from, free.vehicle, free.path));
        let Some((track, vehicle, path)) = free.or_else(|| self.take_out(tracks, config, id)) else {
            return false;
        };
        self.halts.remove(id);
        self.controls.forget(id);
        self.rounds.forget(id);
        self.detours.forget(id);
        self.sirens.switch(id, false);
        self.free.push(id);
        self.ended.push(trip(tracks, config, track, (&vehicle, &path), end, now));
        true
    }

    /// Takes a vehicle off its track, which knows nothing of it any more; its number stays its own. With the track.
    pub(in crate::vehicle) fn take_out(
        &mut self,
        tracks: &Tracks,
        config: &TrafficConfig,
        id: u32,
    ) -> Option<(Track, Vehicle, Path)> {
        if id as usize >= self.numbers() || self.whereabouts.get(id as usize) == NONE {
            return None;
        }
        let track = self.whereabouts.get(id as usize);
        let place = tracks.layout.place(track);
        let slabs = &mut self.parts[place.part as usize].slabs;
        let rank = slabs.queue(place.local as usize).iter().position(|vehicle| vehicle.id == id);
        let (vehicle, path) = slabs.remove(place.local as usize, rank?)?;
        if vehicle.holding != NONE {
            self.junctions.clear_way(vehicle.holding, vehicle.is_long());
        }
        if tracks.connection(track).is_none() {
            self.storage.take(track, &vehicle, config);
        }
        // The room that it was to take behind the junction is free again, unless it is there already.
        let before_lane = vehicle.holding != NONE
            && (tracks.connection(track).is_some() || vehicle.holding == vehicle.next);
        if before_lane {
            self.junctions.arrive(tracks.lane_after(vehicle.holding as usize), &vehicle, config);
        }
        self.end_trails(id);
        self.whereabouts.set(id as usize, NONE);
        Some((track, vehicle, path))
    }
}

/// The trip of a vehicle that is on no track any more.
pub(in crate::vehicle) fn trip(
    tracks: &Tracks,
    config: &TrafficConfig,
    track: Track,
    (vehicle, path): (&Vehicle, &Path),
    end: TripEnd,
    now: f64,
) -> Trip {
    let row = config.vehicle_type(vehicle.row);
    let (track, s) = (track as usize, vehicle.s.min(tracks.length[track as usize]));
    // What it drove beyond the end in its last step takes it this long; it left so much earlier.
    let early = (vehicle.s - s) / vehicle.v.max(0.1);
    Trip {
        id: vehicle.id,
        kind: row.kind,
        vehicle_type: usize::from(vehicle.row),
        end,
        scheduled: path.scheduled,
        entered: path.entered,
        left: now - early,
        distance: path.driven() + s,
        free_time: path.free_time() + s / row.free_speed(config, vehicle.factor, tracks.speed[track]),
    }
}

/// The way from a lane to the next leg of a route; out of the network at its end.
pub(in crate::vehicle) fn route_way(
    tracks: &Tracks,
    closures: &Closures,
    route: &Route,
    path: &Path,
    lane: Track,
    kind: VehicleKind,
) -> u32 {
    match route.0.get(path.leg as usize + 1) {
        None => EXIT,
        // A lane that does not lead on is one to leave.
        Some(next) => {
            let after = route.0.get(path.leg as usize + 2..).unwrap_or_default();
            tracks.way_on(closures, lane, (*next, after), kind).unwrap_or(NONE)
        }
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use simworld_core::net::{NetworkConfig, RoadNetwork, StreetPlan};

    use super::*;
    use crate::demand::Kerbs;

    /// Whether a car enters at the beginning of an empty street while another has stood for so long at its line for it.
    fn enters_while_another_waits(stood: f64) -> bool {
        let network = RoadNetwork::derive(&StreetPlan::crossroads(100.0), &NetworkConfig::default());
        let config = TrafficConfig::default();
        let tracks = Tracks::new(Arc::new(network.expect("it is a plan")), &config);
        let mut vehicles = VehicleManager::new(&tracks);
        let leads_out = |way: &usize| tracks.length[tracks.lane_after(*way) as usize] > 50.0;
        let way = (0..tracks.ways.len()).find(leads_out).expect("its arms are long");
        let (before, after) = (tracks.ways[way].from, tracks.lane_after(way));
        let line = tracks.length[before as usize] - 0.5;
        let waits = Vehicle::new(config.vehicle_type(0), 0, 1.0, 0, line);
        let waits = Vehicle { next: way as u32, stood, ..waits };
        vehicles.whereabouts.push(before);
        vehicles.storage.add(before, &waits, &config);
        vehicles.push(&tracks, before, waits, Path::new(before, NONE, 0.0, 0.0));
        let leg = Leg::of(&tracks.network, simworld_core::id::LaneId(after));
        let route = vehicles.add_route(Route(vec![leg]));
        let kerbs = Kerbs::default();
        let departure =
            Departure { route, row: 0, factor: 1.0, source: None, scheduled: 0.0, kerbs, number: 0 };
        vehicles.enter(&tracks, &config, leg, &departure, 0.0)
    }

    #[test]
    fn who_enters_leaves_the_room_to_who_has_waited_too_long_for_it() {
        assert!(enters_while_another_waits(30.0));
        assert!(!enters_while_another_waits(250.0));
    }
}
