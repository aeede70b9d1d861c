//! Room on lanes: what the vehicles of a lane take when they stand one behind another.
//!
//! Who follows others into a lane needs to fit there when all have come to a stand, or its rear stays in the junction and
//! nobody crosses there any more. Where the last of the lane is now says little about that: it may still move on, or be about
//! to stop.

use serde::{Deserialize, Serialize};

use super::tally::Tally;
use crate::TrafficConfig;
use crate::vehicle::junctions::junction::{TICKS, ticks};
use crate::vehicle::manager::Vehicle;
use crate::vehicle::tracks::Track;

/// The room that the vehicles of each lane take when they stand, in ticks. A lane's own part changes it, in the first and third
/// phase of a step; the part before it reads it in the second.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
#[serde(transparent)]
pub(crate) struct Storage(Tally);

impl Storage {
    pub(in crate::vehicle) fn new(lanes: usize) -> Self {
        Self(Tally::new(lanes))
    }

    /// A vehicle is on a lane now.
    #[inline]
    pub(in crate::vehicle) fn add(&self, lane: Track, vehicle: &Vehicle, config: &TrafficConfig) {
        self.0.add(lane as usize, ticks(vehicle, config));
    }

    /// A vehicle is on a lane no more.
    #[inline]
    pub(in crate::vehicle) fn take(&self, lane: Track, vehicle: &Vehicle, config: &TrafficConfig) {
        self.take_ticks(lane, ticks(vehicle, config));
    }

    #[inline]
    pub(in crate::vehicle) fn take_ticks(&self, lane: Track, ticks: u32) {
        self.0.take(lane as usize, ticks);
    }

    /// The room that the vehicles of a lane take, m.
    #[inline]
    pub(in crate::vehicle) fn taken(&self, lane: Track) -> f64 {
        f64::from(self.0.get(lane as usize)) / TICKS
    }

    pub(in crate::vehicle) fn len(&self) -> usize {
        self.0.len()
    }

    pub(in crate::vehicle) fn bytes(&self) -> usize {
        self.0.len() * 4
    }
}
