//! Near all interest a part of the network goes in every step, far from it once a round: every half second it comes up to the
//! present in one long step.
//!
//! Whatever happens at an intersection happens within one part, so that those who depend on one another are at one time. A part
//! that waits receives who is handed over to it, and shows its lanes to parts that do not wait; they see it as it was, which is
//! never farther ahead than it is. A part that has been far, and one in which somebody else drives or passes what stands on a
//! lane, comes up to the present at once.

use serde::{Deserialize, Serialize};
use simworld_core::id::IntersectionId;

use super::manager::{NONE, VehicleManager};
use super::scene::Scene;
use super::tracks::{Track, Tracks};

/// Time between two steps of those far from all interest, s: half the time gap that drivers keep.
const FAR_INTERVAL: f64 = 0.5;
/// The drivers of a lane look beside once in so long, s.
const LOOKS_BESIDE: f64 = 0.5;

/// When a step is.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Moment {
    /// Time at its beginning, s since the start.
    pub(crate) now: f64,
    /// Its duration, s.
    pub(crate) dt: f64,
    /// Steps before it.
    pub(crate) step: u64,
}

impl Moment {
    /// Whether those far from all interest move up to the present in this step.
    #[inline]
    pub(super) fn ends_round(&self) -> bool {
        (self.step + 1).is_multiple_of(steps_of(FAR_INTERVAL, self.dt))
    }

    /// The drivers of which lanes look beside in this step, those of one lane after those of another.
    pub(super) fn turn(&self) -> impl Fn(Track) -> bool {
        // Lanes are fewer than 2³¹, and there are no steps as short as that.
        let every = steps_of(LOOKS_BESIDE, self.dt).min(1 << 31);
        let now = self.step % every;
        // Of numbers of 32 bits, multiples alone come out so small (Lemire, Kaser and Kurz 2019): no division for each lane.
        let inverse = (u64::MAX / every).wrapping_add(1);
        move |lane| (now + u64::from(lane)).wrapping_mul(inverse) <= inverse.wrapping_sub(1)
    }

    /// The same end of a step that began so long before it, s.
    #[inline]
    pub(super) fn since(&self, waited: f64) -> Self {
        Self { now: self.now + (self.dt - waited), dt: waited, ..*self }
    }
}

/// Steps of `dt` s in an interval, one at least.
fn steps_of(interval: f64, dt: f64) -> u64 {
    (interval / dt).round().max(1.0) as u64
}

/// Where a part is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum Range {
    /// An interest reaches it.
    #[default]
    Near,
    /// None does, and ways of parts that are near lead into it.
    Border,
    Far,
}

/// What a part does in a step.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum Turn {
    /// It waits, and nobody looks into it.
    #[default]
    Rests,
    /// It waits, and others may look into it.
    IsSeen,
    /// It goes for this step.
    Goes,
    /// It goes for several at once.
    CatchesUp,
}

/// How a part goes by the clock.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Clock {
    /// How long ago it was where it is, with the step of now, s.
    waited: f64,
    #[serde(skip)]
    range: Range,
    #[serde(skip)]
    turn: Turn,
}

impl Clock {
    /// Whether it goes in this step.
    #[inline]
    pub(super) fn is_due(&self) -> bool {
        matches!(self.turn, Turn::Goes | Turn::CatchesUp)
    }

    /// Whether it goes in this step for several at once.
    #[inline]
    pub(super) fn is_long(&self) -> bool {
        self.turn == Turn::CatchesUp
    }

    /// Whether others may look into it in this step although it does not go.
    pub(super) fn is_watched(&self) -> bool {
        self.turn == Turn::IsSeen
    }

    /// Whether it goes once a round.
    pub(super) fn is_far(&self) -> bool {
        self.range != Range::Near
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

    /// Begins a step of `dt` s in which it waits.
    fn wait(&mut self, dt: f64, is_seen: bool) {
        self.waited += dt;
        self.turn = if is_seen { Turn::IsSeen } else { Turn::Rests };
    }

    /// It goes in this step of `dt` s after all.
    fn go(&mut self, dt: f64) {
        self.turn = if self.waited > dt { Turn::CatchesUp } else { Turn::Goes };
    }
}

impl VehicleManager {
    /// Marks the parts of whose intersections all are far from all interest; none is if nobody says what is of interest.
    pub(crate) fn set_far(&mut self, tracks: &Tracks, is_far: impl Fn(IntersectionId) -> bool) {
        let (network, layout) = (&tracks.network, &tracks.layout);
        for (part, layout) in self.parts.iter_mut().zip(&layout.parts) {
            let mut lanes = layout.tracks[..layout.lanes].iter();
            let is_far = lanes.all(|lane| is_far(network.lanes[*lane as usize].to));
            part.clock.range = if is_far { Range::Far } else { Range::Near };
        }
        for way in &network.connections {
            let [from, to] = [way.from, way.to].map(|lane| layout.place(lane.0).part as usize);
            if !self.parts[from].clock.is_far() && self.parts[to].clock.is_far() {
                self.parts[to].clock.range = Range::Border;
            }
        }
    }

    /// Decides who goes in a step.
    pub(super) fn begin_step(&mut self, tracks: &Tracks, at: &Moment) {
        let ends_round = at.ends_round();
        let some_go = !self.controls.driven.is_empty() || self.passings.lanes().next().is_some();
        for clock in self.parts.iter_mut().map(|part| &mut part.clock) {
            clock.wait(at.dt, clock.range == Range::Border || some_go);
            if ends_round || !clock.is_far() {
                clock.go(at.dt);
            }
        }
        for id in self.controls.driven.keys() {
            let track = self.whereabouts.get(*id as usize);
            if track != NONE {
                self.parts[tracks.layout.place(track).part as usize].clock.go(at.dt);
            }
        }
        // Who is out on the oncoming lane and those who come there are at one time.
        for lane in self.passings.lanes() {
            self.parts[tracks.layout.place(lane).part as usize].clock.go(at.dt);
        }
    }
}
