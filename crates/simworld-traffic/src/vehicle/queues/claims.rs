//! Vehicles about to pass each crossing, as those on foot see them.

use serde::{Deserialize, Serialize};
use simworld_core::id::CrossingId;

use super::tally::Tally;
use crate::vehicle::manager::{EXIT, NONE, Vehicle};
use crate::vehicle::tracks::Tracks;

/// How many vehicles are about to pass each crossing.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
#[serde(transparent)]
pub(crate) struct Claims(Tally);

impl Claims {
    pub(in crate::vehicle) fn new(tracks: &Tracks) -> Self {
        Self(Tally::new(tracks.network.crossings.len()))
    }

    pub(in crate::vehicle) fn fits(&self, tracks: &Tracks) -> bool {
        self.0.len() == tracks.network.crossings.len()
    }

    pub(in crate::vehicle) fn clear(&mut self) {
        self.0.clear();
    }

    /// Claims the crossings that a vehicle with leave has not passed; `front` is where it is on its way, negative before it.
    pub(in crate::vehicle) fn claim(&self, tracks: &Tracks, vehicle: &Vehicle, front: f64) {
        self.claim_behind(tracks, vehicle.holding, front - vehicle.length());
    }

    /// Those of a lane with leave to cross claim the crossings beyond its end.
    pub(in crate::vehicle) fn claim_ahead(&self, tracks: &Tracks, queue: &[Vehicle], end: f64) {
        for vehicle in queue {
            if vehicle.holding == vehicle.next && vehicle.next != NONE {
                self.claim(tracks, vehicle, vehicle.s - end);
            } else if vehicle.next != EXIT {
                break; // nobody behind has leave either
            }
        }
    }

    /// Claims the crossings on a way beyond a rear.
    pub(in crate::vehicle) fn claim_behind(&self, tracks: &Tracks, way: u32, rear: f64) {
        if !tracks.ways[way as usize].has_strips {
            return;
        }
        for strip in tracks.strips[way as usize].iter().filter(|strip| rear < strip.end) {
            self.0.add(strip.crossing as usize, 1);
        }
    }

    /// How many are about to pass a crossing.
    pub(in crate::vehicle) fn of(&self, crossing: CrossingId) -> u32 {
        self.0.get(crossing.index())
    }

    pub(in crate::vehicle) fn bytes(&self) -> usize {
        self.0.len() * 4
    }
}
