//! Courtesy: who has stood far too long at his line for want of a gap is let in.
//!
//! Beside a stream without gaps one would stand for good. Those of it who have no leave yet leave the next turn to who has stood for ten minutes
//! and could go but for them, for a while: those who have leave clear the junction meanwhile, the others come to their lines, and who
//! stands at his line hinders nobody.

use super::junction::{has_room, may_pass, signal_allows};
use crate::vehicle::manager::{NONE, Vehicle};
use crate::vehicle::part::Part;
use crate::vehicle::scene::Scene;
use crate::vehicle::tracks::Tracks;

/// Who has stood for so long at his line is let in, s: for so long, and once in so many. Ways over wide junctions take half a minute. Where
/// it is done sooner, the room behind narrow junctions goes to those, and others wait for longer than they did.
const OVERDUE: f64 = 600.0;
const FOR: f64 = 60.0;
const EVERY: f64 = 180.0;

impl Part {
    /// Takes note of the first of a lane, who did not get leave, if he is to be let in now: he has stood too long, and could go but for
    /// those whose ways meet his own.
    pub(super) fn ask_courtesy(&mut self, scene: &Scene<'_>, vehicle: &Vehicle, distance: f64) {
        let overdue = vehicle.stood - OVERDUE;
        let way = vehicle.next as usize;
        let is_let_in = overdue >= 0.0
            && overdue % EVERY < FOR
            && vehicle.holding == NONE
            && vehicle.shift == 0.0
            && signal_allows(scene, way, vehicle, distance)
            && has_room(scene, way, vehicle);
        if is_let_in {
            self.work.let_in.push(vehicle.next);
        }
    }

    /// Whether a vehicle would not go before one who is let in. Who stands between near junctions goes first, and so does who is in a
    /// lock or has a siren on.
    pub(in crate::vehicle) fn lets_in(&self, scene: &Scene<'_>, vehicle: &Vehicle) -> bool {
        let Scene { tracks, .. } = scene;
        let way = vehicle.next;
        self.work.let_in.iter().all(|other| !meet(tracks, *other, way))
            || vehicle.holding != NONE
            || tracks.clusters.of(tracks, tracks.ways[way as usize].from, vehicle).is_some()
            || may_pass(scene, vehicle)
            || scene.sirens.is_on(vehicle.id)
    }
}

/// Whether two ways meet, for whoever goes there.
fn meet(tracks: &Tracks, one: u32, other: u32) -> bool {
    let way = one as usize;
    tracks.conflicts[way].iter().any(|conflict| conflict.way == other)
        || tracks.tight[way].contains(&other)
        || tracks.narrow[way].contains(&other)
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use simworld_core::id::LaneId;
    use simworld_core::net::{Alone, NetworkConfig, RoadNetwork, StreetPlan, Turn};
    use simworld_core::seed::Seed;

    use super::*;
    use crate::vehicle::clock::Moment;
    use crate::vehicle::manager::VehicleManager;
    use crate::vehicle::queues::path::Path;
    use crate::vehicle::scene::Sight;
    use crate::{Counters, Leg, Route, TrafficConfig};

    /// The step at which the stream has come to the crossing.
    const BEGINS: u32 = 300;

    /// A crossing without lights where a car has stood at its line for so long, s, beside a stream of one in 2.5 s that has priority. When
    /// it goes, s, if it does in 150 s, and what was counted by then.
    fn goes_after(stood: f64) -> (Option<f64>, Counters) {
        let config = NetworkConfig { signals_from_roads: 0, ..NetworkConfig::default() };
        let network = RoadNetwork::derive(&StreetPlan::crossroads(150.0), &config).expect("it is a plan");
        let config = TrafficConfig::default();
        let tracks = Tracks::new(Arc::new(network), &config);
        let mut vehicles = VehicleManager::new(&tracks);
        let is_straight = |way: usize| tracks.network.connections[way].turn == Turn::Straight;
        let mut pairs = (0..tracks.ways.len()).flat_map(|way| {
            tracks.conflicts[way].iter().map(move |other| (way, other.way as usize, other.yields))
        });
        let pair = pairs.find(|(own, other, yields)| *yields && is_straight(*own) && is_straight(*other));
        let (own, stream, _) = pair.expect("one street has priority");
        let put = |vehicles: &mut VehicleManager, way: usize, s: f64, v: f64, stood: f64| {
            let lane = tracks.ways[way].from;
            let legs = [lane, tracks.lane_after(way)].map(|lane| Leg::of(&tracks.network, LaneId(lane)));
            let route = vehicles.add_route(Route(legs.to_vec()));
            let id = vehicles.numbers() as u32;
            let car = Vehicle::new(config.vehicle_type(0), 0, 1.0, id, s);
            let car = Vehicle { v, stood, next: way as u32, ..car };
            vehicles.whereabouts.push(lane);
            vehicles.storage.add(lane, &car, &config);
            vehicles.push(&tracks, lane, car, Path::new(lane, route, 0.0, 0.0));
        };
        let before = tracks.ways[own].from;
        let line = tracks.length[before as usize] - 0.5;
        let zeros = vec![0; tracks.network.crossings.len()];
        let sight = Sight { aspects: &[], shown: &[], walkers: &zeros, waiting: &zeros, obstacles: &[] };
        let mut counters = Counters::default();
        for step in 0..BEGINS + 1500 {
            if step == BEGINS {
                put(&mut vehicles, own, line, 0.0, stood);
            }
            let lane = tracks.ways[stream].from;
            let has_room = vehicles.queue(&tracks, lane).last().is_none_or(|last| last.s > 25.0);
            if step % 25 == 0 && has_room {
                put(&mut vehicles, stream, 5.0, 8.0, 0.0);
            }
            let at = Moment { now: f64::from(step) * 0.1, dt: 0.1, step: u64::from(step) };
            vehicles.step(&tracks, &config, Seed(1).stream("cars"), sight, at, &mut counters, &Alone);
            if step > BEGINS && vehicles.queue(&tracks, before).is_empty() {
                return (Some(at.now - f64::from(BEGINS) * 0.1), counters);
            }
        }
        (None, counters)
    }

    #[test]
    fn who_has_stood_too_long_beside_a_stream_without_gaps_is_let_in() {
        let (waits, counters) = goes_after(OVERDUE - 300.0);
        assert_eq!(waits, None, "there are no gaps");
        assert!(counters.crossings > 50, "the stream goes: {counters:?}");
        let (goes, counters) = goes_after(OVERDUE - 40.0);
        let goes = goes.expect("he is let in");
        assert!((40.0..40.0 + FOR).contains(&goes), "he goes after {goes} s");
        assert_eq!(counters.forced_stops, 0);
    }
}
