//! The gap before a crossing: when the next vehicle comes to it.

use simworld_core::id::CrossingId;
use simworld_core::net::Aspect;

use crate::vehicle::{Tracks, VehicleManager};

/// Vehicles are looked for within this distance of their stop line, m.
const SIGHT: f64 = 100.0;
/// Braking with which a driver surely stops at red, m/s².
const SURE: f64 = 3.0;
/// Nobody is expected to come more slowly, m/s: who stands now may go at once.
const SLOWEST: f64 = 3.0;

/// The ways that pass over each crossing, with the station at which a vehicle must stop for it, m.
#[derive(Clone, Debug, Default)]
pub(super) struct Gaps(Vec<Vec<(u32, f64)>>);

impl Gaps {
    pub(super) fn new(tracks: &Tracks) -> Self {
        let mut ways = vec![Vec::new(); tracks.network.crossings.len()];
        for way in 0..tracks.network.connections.len() {
            for strip in &tracks.strips[way] {
                ways[strip.crossing as usize].push((way as u32, strip.stop));
            }
        }
        Self(ways)
    }

    /// When the next vehicle comes to a crossing that has no leave to pass it yet, s.
    pub(super) fn time(
        &self,
        tracks: &Tracks,
        vehicles: &VehicleManager,
        aspects: &[Aspect],
        crossing: CrossingId,
    ) -> f64 {
        let mut soonest = f64::INFINITY;
        for (way, stop) in &self.0[crossing.index()] {
            let connection = &tracks.network.connections[*way as usize];
            let is_red = connection.signal.is_some_and(|group| aspects[group.index()] == Aspect::Red);
            let lane = connection.from.index();
            for vehicle in vehicles.queue(tracks, lane as u32) {
                let to_line = tracks.length[lane] - vehicle.s;
                if to_line > SIGHT {
                    break;
                }
                let stops = is_red && vehicle.v * vehicle.v < 2.0 * SURE * to_line.max(0.1);
                if vehicle.next == *way && !stops {
                    soonest = soonest.min((to_line + stop).max(0.0) / vehicle.v.max(SLOWEST));
                    break;
                }
            }
        }
        soonest
    }
}
