//! Near all interest a part of the network goes in every step, far from it once a round: every half second it comes up to the
//! present in one long step.
//!
//! Whatever happens at an intersection happens within one part, so that those who depend on one another are at one time. A part
//! that waits receives who is handed over to it, and shows its lanes to parts that do not wait; they see it as it was, which is
//! never farther ahead than it is. A part that has been far, and one in which somebody else drives, comes up to the present at
//! once.

use serde::{Deserialize, Serialize};
use simworld_core::id::IntersectionId;

use super::manager::{Moment, NONE, Scene, VehicleManager};
use super::tracks::Tracks;

/// How a part goes by the clock.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Clock {
    /// How long ago it was where it is, with the step of now, s.
    waited: f64,
    #[serde(skip)]
    is_far: bool,
    /// Whether ways of parts that are not far lead into it.
    #[serde(skip)]
    is_at_border: bool,
    #[serde(skip)]
    is_due: bool,
    #[serde(skip)]
    is_long: bool,
    #[serde(skip)]
    is_watched: bool,
}

impl Clock {
    /// Whether it goes in this step.
    #[inline]
    pub(super) fn is_due(&self) -> bool {
        self.is_due
    }

    /// Whether it goes in this step for several at once.
    #[inline]
    pub(super) fn is_long(&self) -> bool {
        self.is_long
    }

    /// Whether others may look into it in this step although it does not go.
    pub(super) fn is_watched(&self) -> bool {
        self.is_watched
    }

    /// Whether it goes once a round.
    pub(super) fn is_far(&self) -> bool {
        self.is_far
    }

    /// What it sees in the step that it goes.
    pub(super) fn scene<'a>(&self, scene: &Scene<'a>) -> Scene<'a> {
        Scene { at: scene.at.since(self.waited), ..*scene }
    }

    /// It is at the present.
    pub(super) fn end(&mut self) {
        self.waited = 0.0;
    }

    /// How long it has waited, s.
    pub(super) fn waited(&self) -> f64 {
        self.waited
    }

    pub(super) fn is_sound(&self) -> bool {
        self.waited.is_finite() && self.waited >= 0.0
    }

    fn begin(&mut self, dt: f64, is_due: bool, is_watched: bool) {
        self.waited += dt;
        (self.is_due, self.is_watched) = (is_due, is_watched);
        self.is_long = is_due && self.waited > dt;
    }
}

impl VehicleManager {
    /// Marks the parts of whose intersections all are far from all interest; none is if nobody says what is of interest.
    pub(crate) fn set_far(&mut self, tracks: &Tracks, is_far: impl Fn(IntersectionId) -> bool) {
        let (network, layout) = (&tracks.network, &tracks.layout);
        for (part, layout) in self.parts.iter_mut().zip(&layout.parts) {
            let mut lanes = layout.tracks[..layout.lanes].iter();
            part.clock.is_far = lanes.all(|lane| is_far(network.lanes[*lane as usize].to));
            part.clock.is_at_border = false;
        }
        for way in &network.connections {
            let [from, to] = [way.from, way.to].map(|lane| layout.place(lane.0).part as usize);
            if !self.parts[from].clock.is_far && self.parts[to].clock.is_far {
                self.parts[to].clock.is_at_border = true;
            }
        }
    }

    /// Decides who goes in a step, and forgets what those who go claimed.
    pub(super) fn begin_step(&mut self, tracks: &Tracks, at: &Moment) {
        let ends_round = at.ends_round();
        let somebody_drives = !self.controls.driven.is_empty();
        for clock in self.parts.iter_mut().map(|part| &mut part.clock) {
            let is_due = ends_round || !clock.is_far;
            clock.begin(at.dt, is_due, clock.is_at_border || somebody_drives);
        }
        for id in self.controls.driven.keys() {
            let track = self.whereabouts.get(*id as usize);
            if track != NONE {
                let clock = &mut self.parts[tracks.layout.place(track).part as usize].clock;
                clock.is_due = true;
                clock.is_long = clock.waited > at.dt;
            }
        }
    }
}
