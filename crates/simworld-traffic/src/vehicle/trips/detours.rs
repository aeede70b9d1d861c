//! Drivers on a trip think their way over: who loses much time ahead, by what is known of the streets now, takes another way that is clearly quicker.
//!
//! They are content with what is good enough (Mahmassani and Jayakrishnan 1991): they change only for a fifth of the time that is left, and
//! for a minute at least.

use serde::{Deserialize, Serialize};
use simworld_core::seed::Stream;

use super::delays;
use crate::route::Landmarks;
use crate::vehicle::VehicleKind;
use crate::vehicle::clock::Moment;
use crate::vehicle::junctions::deadlock::is_due;
use crate::vehicle::manager::VehicleManager;
use crate::vehicle::tracks::closures::is_committed;
use crate::vehicle::tracks::{Track, Tracks};
use crate::{Counters, Leg, Route, TrafficConfig};

/// Everybody thinks once in so long, s.
const EVERY: u64 = 120;
/// What another way must gain, as a share of the time that is left, and at least, s.
const GAIN: f64 = 0.2;
const LEAST: f64 = 60.0;

/// The routes of those who left theirs.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(in crate::vehicle) struct Detours {
    /// By number of the vehicle: the place of its route in the list of routes. Nobody else has it.
    own: Vec<(u32, u32)>,
    /// All such places, ascending, and those that nobody has any more.
    places: Vec<u32>,
    free: Vec<u32>,
    /// How far it is at least, by the delays of now.
    #[serde(skip)]
    landmarks: Landmarks,
    #[serde(skip)]
    found: Route,
}

impl Detours {
    /// Whether a place in the list of routes is that of somebody who left his.
    pub(in crate::vehicle) fn has(&self, place: u32) -> bool {
        self.places.binary_search(&place).is_ok()
    }

    pub(in crate::vehicle) fn forget(&mut self, id: u32) {
        if let Ok(index) = self.own.binary_search_by_key(&id, |own| own.0) {
            self.free.push(self.own.remove(index).1);
        }
    }

    pub(in crate::vehicle) fn fits(&self, numbers: usize, routes: usize) -> bool {
        self.own.is_sorted_by_key(|own| own.0)
            && self.own.iter().all(|(id, place)| (*id as usize) < numbers && self.has(*place))
            && self.free.iter().all(|place| self.has(*place))
            && self.places.is_sorted()
            && self.places.last().is_none_or(|place| (*place as usize) < routes)
    }
}

impl VehicleManager {
    /// Lets those think their way over whose turn it is.
    pub(in crate::vehicle) fn think_over(
        &mut self,
        tracks: &Tracks,
        config: &TrafficConfig,
        streams: Stream,
        at: Moment,
        counters: &mut Counters,
    ) {
        if config.informed <= 0.0 || self.routes.is_empty() {
            return;
        }
        if is_due(at.step, at.dt, delays::EVERY) {
            self.see_delays(tracks);
            self.detours.landmarks.forget();
        }
        if !is_due(at.step, at.dt, 1.0) {
            return;
        }
        let second = ((at.step + 1) as f64 * at.dt).floor() as u64;
        let turn = (second % EVERY) as usize;
        let drawn = streams.named("informed");
        for id in (turn..self.numbers()).step_by(EVERY as usize).map(|id| id as u32) {
            let is_informed =
                || config.informed >= 1.0 || drawn.indexed(u64::from(id)).rng().unit() < config.informed;
            if let Some((track, rank)) = self.may_turn_off(tracks, config, id)
                && is_informed()
                && self.find_detour(tracks, (track, rank), id)
            {
                self.redirect((tracks, config), streams, track, rank);
                counters.detours += 1;
            }
        }
    }

    /// Where one is who goes by a route of his own and may leave it: no bus, nobody who halts on the way or is driven from outside.
    fn may_turn_off(&self, tracks: &Tracks, config: &TrafficConfig, id: u32) -> Option<(Track, usize)> {
        let (track, vehicle, path) = self.find(tracks, id)?;
        let is_bound = config.vehicle_type(vehicle.row).kind == VehicleKind::Bus
            || (path.route as usize) >= self.routes.len()
            || self.off.binary_search(&path.route).is_ok()
            || self.halts.has(id)
            || self.controls.drives(id)
            || self.rounds.has(id);
        let rank = || self.queue(tracks, track).iter().position(|other| other.id == id);
        if is_bound { None } else { Some((track, rank()?)) }
    }

    /// Gives one another route if his has become slow and another is much quicker.
    fn find_detour(&mut self, tracks: &Tracks, (track, rank): (Track, usize), id: u32) -> bool {
        let (vehicle, path) = (self.queue(tracks, track)[rank], self.paths(tracks, track)[rank]);
        let legs = self.routes[path.route as usize].0.get(path.leg as usize..).unwrap_or_default();
        let ahead = usize::from(is_committed(tracks, track, &vehicle));
        let (Some(here), Some(rest)) = (legs.get(ahead).copied(), legs.get(ahead + 1..)) else {
            return false;
        };
        let Some(goal) = rest.last().copied().filter(|goal| *goal != here) else { return false };
        let delay = |leg: Leg| self.delays.of(leg);
        let lost: f64 = rest.iter().map(|leg| delay(*leg)).sum();
        let Some(time) = tracks.router.delayed_time(&legs[ahead..], delay) else { return false };
        let gain = LEAST.max(GAIN * time);
        if lost <= gain {
            return false;
        }
        let mut detours = std::mem::take(&mut self.detours);
        let Detours { landmarks, found, .. } = &mut detours;
        found.0.clear();
        found.0.extend_from_slice(&legs[..ahead]);
        let exits = if ahead == 0 { tracks.exits(track) } else { &[] };
        let leads_on = |leg: Leg| exits.iter().any(|exit| exit.1 == leg);
        let is_open = |before: Leg, leg: Leg| {
            (ahead > 0 || before != here || leads_on(leg)) && self.closures.leads_on(tracks, before, leg)
        };
        let ends = (here, goal, time - gain);
        let is_better = tracks.router.quickest_delayed(ends, delay, is_open, landmarks, found);
        if is_better {
            let place = self.keep_detour(&mut detours, id, path.route);
            let (_, paths) = self.both_mut(tracks, track);
            (paths[rank].route, paths[rank].leg) = (place, 0);
        }
        self.detours = detours;
        is_better
    }

    /// Keeps the route that was found for a vehicle, in the place of the last one that was, and returns its place.
    fn keep_detour(&mut self, detours: &mut Detours, id: u32, before: u32) -> u32 {
        let Detours { own, places, free, found, .. } = detours;
        let known = own.binary_search_by_key(&id, |own| own.0);
        let place = match known {
            Ok(index) => own[index].1,
            Err(_) => free.pop().unwrap_or_else(|| {
                places.push(self.routes.len() as u32);
                self.add_route(Route::default())
            }),
        };
        debug_assert!(place != before || known.is_ok(), "nobody else has that place");
        self.routes[place as usize].0.clone_from(&found.0);
        if let Err(index) = known {
            own.insert(index, (id, place));
        }
        place
    }
}

#[cfg(test)]
mod tests {
    use simworld_core::net::{NetworkConfig, RoadNetwork, StreetPlan};

    use super::*;

    #[test]
    fn routes_take_the_places_of_those_that_nobody_has_any_more() {
        let plan = StreetPlan::grid(3, 3, 100.0);
        let network = RoadNetwork::derive(&plan, &NetworkConfig::default()).expect("it is a plan");
        let tracks = Tracks::new(std::sync::Arc::new(network), &TrafficConfig::default());
        let mut vehicles = VehicleManager::new(&tracks);
        let given = vehicles.add_route(Route(vec![Leg::from_index(0)]));
        let mut detours = Detours::default();
        let mut keep = |detours: &mut Detours, id: u32, leg: usize| {
            detours.found = Route(vec![Leg::from_index(leg)]);
            let place = vehicles.keep_detour(detours, id, given);
            assert_eq!(vehicles.routes[place as usize], detours.found);
            assert_eq!(vehicles.routes[given as usize].0, [Leg::from_index(0)], "others drive by that");
            place
        };
        let (first, second) = (keep(&mut detours, 7, 1), keep(&mut detours, 3, 2));
        assert_eq!([first, second], [given + 1, given + 2]);
        assert_eq!(keep(&mut detours, 7, 3), first);
        detours.forget(7);
        detours.forget(7);
        assert_eq!(keep(&mut detours, 9, 4), first);
        assert_eq!(keep(&mut detours, 7, 5), given + 3);
        assert!(detours.fits(10, 4) && !detours.fits(9, 4) && !detours.fits(10, 3));
        assert!(detours.has(first) && !detours.has(given));
    }
}
