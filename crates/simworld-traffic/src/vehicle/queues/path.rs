//! What a vehicle was, apart from its motion: what of it a step hardly needs.

use serde::{Deserialize, Serialize};

use crate::vehicle::tracks::Track;

/// What a vehicle was, apart from its motion.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Path {
    /// The track it came from, where its rear may still be.
    pub(crate) before: Track,
    /// Its route, or none if it turns at random.
    pub(in crate::vehicle) route: u32,
    /// The leg of the route that it is on.
    pub(in crate::vehicle) leg: u32,
    /// Decisions made so far: the index of its next draw.
    pub(in crate::vehicle) decisions: u32,
    pub(in crate::vehicle) scheduled: f64,
    pub(in crate::vehicle) entered: f64,
    /// Distance and free travel time of the tracks that it has left, m and s: to a millimetre and a millisecond over ten kilometres
    /// and some hours.
    driven: f32,
    free_time: f32,
}

impl Path {
    pub(in crate::vehicle) fn new(track: Track, route: u32, scheduled: f64, entered: f64) -> Self {
        Self { before: track, route, scheduled, entered, ..Self::default() }
    }

    /// Adds a distance to what it has driven, m, and the time that it takes at free speed, s; both may be negative.
    pub(in crate::vehicle) fn add(&mut self, distance: f64, free_time: f64) {
        self.driven = (f64::from(self.driven) + distance) as f32;
        self.free_time = (f64::from(self.free_time) + free_time) as f32;
    }

    /// The length of the tracks that it has left, m.
    pub(in crate::vehicle) fn driven(&self) -> f64 {
        f64::from(self.driven)
    }

    /// How long these take at free speed, s.
    pub(in crate::vehicle) fn free_time(&self) -> f64 {
        f64::from(self.free_time)
    }
}
