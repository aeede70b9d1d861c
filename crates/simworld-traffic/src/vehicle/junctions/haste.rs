//! Haste: who has stood long at his line for want of a gap takes shorter ones, at last any before which those with priority need but ease
//! off.
//!
//! Beside a stream without the gaps that he first asks for one would stand for good, and with him whoever is behind. Drivers accept shorter gaps the
//! longer they have waited (Pollatschek, Polus and Livneh, Transportation Research B 36, 2002), and SUMO's drivers have an impatience that grows so.
//! He still goes only before those who can stop for him at their lines without effort, so nobody is ever in danger.

/// Who has stood for so long, s, begins to be in haste, and is in full haste after so long.
const CALM_FOR: f64 = 60.0;
const AFTER: f64 = 180.0;
/// Time by which one in full haste delays those with priority more than others do, s.
const DELAYS: f64 = 3.0;

/// How much in haste one is, from 0 to 1.
#[derive(Clone, Copy, Debug)]
pub(super) struct Haste(f64);

impl Haste {
    pub(super) const NONE: Self = Self(0.0);

    /// Of one who has stood at his line for so long, s.
    pub(super) fn of(stood: f64) -> Self {
        Self(((stood - CALM_FOR) / (AFTER - CALM_FOR)).clamp(0.0, 1.0))
    }

    /// What becomes of a critical gap, s.
    pub(super) fn shortens(self, critical: f64) -> f64 {
        critical * (1.0 - self.0)
    }

    /// By how much more one delays those with priority, at most, s.
    pub(super) fn delays(self) -> f64 {
        DELAYS * self.0
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use simworld_core::id::LaneId;
    use simworld_core::net::{Alone, NetworkConfig, RoadNetwork, StreetPlan, Turn};
    use simworld_core::seed::Seed;

    use super::*;
    use crate::vehicle::clock::Moment;
    use crate::vehicle::manager::{Vehicle, VehicleManager};
    use crate::vehicle::queues::path::Path;
    use crate::vehicle::scene::Sight;
    use crate::vehicle::tracks::Tracks;
    use crate::{Counters, Leg, Route, TrafficConfig};

    /// The step at which the stream has come to the crossing.
    const BEGINS: u32 = 300;

    /// What comes of a car that waits beside a stream.
    struct Wait {
        /// When it goes, s, if it does in 200 s.
        goes: Option<f64>,
        counters: Counters,
        /// The hardest braking of the stream by 20 s after that, m/s².
        braking: f32,
    }

    /// A crossing without lights where a car has stood at its line for so long, s, beside a stream that has priority, of one in so many tenths
    /// of a second.
    fn waits(stood: f64, every: u32) -> Wait {
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
        let mut wait = Wait { goes: None, counters: Counters::default(), braking: 0.0 };
        for step in 0..BEGINS + 2000 {
            if step == BEGINS {
                put(&mut vehicles, own, line, 0.0, stood);
            }
            let lane = tracks.ways[stream].from;
            let has_room = vehicles.queue(&tracks, lane).last().is_none_or(|last| last.s > 25.0);
            if step % every == 0 && has_room {
                put(&mut vehicles, stream, 5.0, 8.0, 0.0);
            }
            let at = Moment { now: f64::from(step) * 0.1, dt: 0.1, step: u64::from(step) };
            vehicles.step(&tracks, &config, Seed(1).stream("cars"), sight, at, &mut wait.counters, &Alone);
            let comers = vehicles.queue(&tracks, lane).iter().map(|comer| -comer.acceleration);
            wait.braking = comers.fold(wait.braking, f32::max);
            let waited = at.now - f64::from(BEGINS) * 0.1;
            if step > BEGINS && vehicles.queue(&tracks, before).is_empty() {
                wait.goes = wait.goes.or(Some(waited));
            }
            // Who has priority comes down to his speed behind him.
            if wait.goes.is_some_and(|goes| waited > goes + 20.0) {
                break;
            }
        }
        wait
    }

    #[test]
    fn who_has_waited_long_takes_gaps_that_he_did_not_take_at_first() {
        // One in two seconds and in two and a half: less than the gaps that the manual asks for.
        for every in [20, 25] {
            let wait = waits(0.0, every);
            let goes = wait.goes.expect("his haste grows");
            assert!((CALM_FOR..AFTER).contains(&goes), "he goes after {goes} s");
            assert!(wait.counters.crossings > 30, "the stream goes: {:?}", wait.counters);
            let goes = waits(AFTER, every).goes.expect("there are gaps for one in full haste");
            assert!(goes < 30.0, "he goes after {goes} s");
        }
    }

    #[test]
    fn nobody_brakes_hard_for_one_in_haste() {
        for every in 15..40 {
            let wait = waits(AFTER, every);
            assert_eq!(wait.counters.forced_stops, 0);
            assert!(wait.braking < 2.5, "one in {every} tenths of a second brakes by {} m/s²", wait.braking);
        }
    }
}
