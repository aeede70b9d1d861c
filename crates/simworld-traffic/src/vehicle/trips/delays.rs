//! How long the streets take now: what drivers know who have been told, or see it.
//!
//! By Little's law the time that a leg takes is the number of vehicles on it over how many pass in a second, which is the sum of their
//! speeds over its length. Both are averages over some minutes, so that a red light is no jam.

use serde::{Deserialize, Serialize};
use simworld_core::id::LaneId;

use crate::Leg;
use crate::vehicle::manager::VehicleManager;
use crate::vehicle::tracks::Tracks;

/// Vehicles are counted so often, s.
pub(in crate::vehicle) const EVERY: f64 = 5.0;
/// Averages are over about so long, s.
const MEMORY: f64 = 150.0;
/// As many more are taken to drive freely on every leg: of one on which hardly anybody is little is known.
const FREE: f64 = 0.1;

/// What was seen of a leg.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
struct Seen {
    /// How many are on it, and the sum of their speeds, m/s.
    vehicles: f64,
    speeds: f64,
}

/// What was seen of every leg; nothing as long as nobody is on a trip.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(in crate::vehicle) struct Delays {
    seen: Vec<Seen>,
    /// By how much longer than when it is free each leg takes by that, s.
    late: Vec<f64>,
}

impl Delays {
    /// By how much longer a leg takes now than when it is free, s.
    pub(in crate::vehicle) fn of(&self, leg: Leg) -> f64 {
        self.late.get(leg.index()).copied().unwrap_or(0.0)
    }

    /// Whether saved ones are of this network.
    pub(in crate::vehicle) fn fits(&self, tracks: &Tracks) -> bool {
        let is_sound = |seen: &Seen| {
            seen.vehicles.is_finite() && seen.speeds.is_finite() && seen.vehicles >= 0.0 && seen.speeds >= 0.0
        };
        [0, tracks.network.roads.len() * 2].contains(&self.seen.len())
            && self.seen.iter().all(is_sound)
            && self.late.len() == self.seen.len()
            && self.late.iter().all(|late| late.is_finite() && *late >= 0.0)
    }
}

impl Seen {
    /// By how much longer a leg takes than when it is free, s: its length and the speed that is allowed there, m and m/s.
    fn late(&self, length: f64, limit: f64) -> f64 {
        let time = length * (self.vehicles + FREE) / (self.speeds + FREE * limit);
        (time - length / limit).max(0.0)
    }
}

impl VehicleManager {
    /// Counts the vehicles on every leg.
    pub(super) fn see_delays(&mut self, tracks: &Tracks) {
        let Delays { mut seen, mut late } = std::mem::take(&mut self.delays);
        let (network, legs) = (&tracks.network, tracks.network.roads.len() * 2);
        seen.resize(legs, Seen::default());
        late.resize(legs, 0.0);
        let fresh = EVERY / MEMORY;
        for seen in &mut seen {
            seen.vehicles *= 1.0 - fresh;
            seen.speeds *= 1.0 - fresh;
        }
        for (lane, queue) in self.queues(tracks) {
            let seen = &mut seen[Leg::of(network, LaneId(lane)).index()];
            seen.vehicles += queue.len() as f64 * fresh;
            seen.speeds += queue.iter().map(|vehicle| vehicle.v).sum::<f64>() * fresh;
        }
        for (leg, (seen, late)) in seen.iter().zip(&mut late).enumerate() {
            let lane = Leg::from_index(leg).lanes(network).first().map(|lane| &network.lanes[lane.index()]);
            *late = lane.map_or(0.0, |lane| seen.late(lane.length, lane.speed_limit));
        }
        self.delays = Delays { seen, late };
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What is seen of a leg on which so many are at such a speed for so long, s.
    fn seen(from: Seen, vehicles: f64, speed: f64, time: f64) -> Seen {
        let fresh = EVERY / MEMORY;
        (0..(time / EVERY) as usize).fold(from, |seen, _| Seen {
            vehicles: seen.vehicles * (1.0 - fresh) + vehicles * fresh,
            speeds: seen.speeds * (1.0 - fresh) + vehicles * speed * fresh,
        })
    }

    #[test]
    fn a_leg_takes_as_long_as_its_queue() {
        let (length, limit) = (100.0, 13.9);
        let late = |seen: Seen| seen.late(length, limit);
        assert_eq!(late(Seen::default()), 0.0);
        // Ten of whom one leaves every 5 s: 50 s.
        let queue = seen(Seen::default(), 10.0, length / 50.0, 1800.0);
        assert!((late(queue) + length / limit - 50.0).abs() < 5.0, "{}", late(queue));
        // Who comes now and then and drives freely is no reason to think anything else.
        let free = seen(Seen::default(), 0.2, limit, 1800.0);
        assert!(late(free) < 1.0, "{}", late(free));
        // A lane full of those who stand is one to keep off, and soon free again once they are gone.
        let jam = seen(queue, 12.0, 0.0, 900.0);
        assert!(late(jam) > 600.0, "{}", late(jam));
        assert!(late(seen(jam, 1.0, limit, 900.0)) < 10.0);
        assert!(late(seen(jam, 0.0, 0.0, 900.0)) < 20.0);
    }
}
