//! How somebody whose model moves has come to what it does: how far it has gone, and which clip it has left.

use serde::{Deserialize, Serialize};

use crate::asset::{ClipMoment, MIX_SECONDS, RigPose};
use crate::clock::{Clock, Tick};
use crate::geometry::{Point3, Vector3};

/// What a scene remembers of somebody whose model has clips, from step to step: it says how the model is shown, and nothing else in a world follows from it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Stride {
    /// How far it has come over the ground since somebody keeps account of it, m; what it goes backwards is taken off.
    pub way: f64,
    /// Where it was at the end of the last step.
    at: Point3,
    /// At which moment of its clip it was then; none at rest.
    shown: Option<ClipMoment>,
    /// What it has left for that, if it still shows.
    left: Option<Left>,
}

/// A clip that was left.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
struct Left {
    /// At which moment; none at rest. There it stays while the next one takes over.
    moment: Option<ClipMoment>,
    /// In which tick.
    tick: Tick,
}

impl Stride {
    /// That of somebody who is seen for the first time, there and at that moment.
    pub(super) const fn new(at: Point3, shown: Option<ClipMoment>) -> Self {
        Self { way: 0.0, at, shown, left: None }
    }

    /// Whether its numbers are some.
    pub(super) fn is_sound(&self) -> bool {
        self.way.is_finite() && self.at.iter().all(|coordinate| coordinate.is_finite())
    }

    /// Goes on to where it is now, ahead or backwards of where it looks.
    pub(super) fn go(&mut self, at: Point3, ahead: &Vector3) {
        let step = at - self.at;
        let far = step.xy().norm();
        self.way += if step.dot(ahead) < 0.0 { -far } else { far };
        self.at = at;
    }

    /// Goes on to the moment that it shows now, at the end of a step; true if that is of another clip than before.
    pub(super) fn show(&mut self, now: Option<ClipMoment>, clock: &Clock) -> bool {
        let before = Tick(clock.tick().0.saturating_sub(1));
        let changes = clip_of(now) != clip_of(self.shown);
        if changes {
            // Of two that it was between, it goes on from the one of which more was seen.
            let old = self.left.filter(|left| since(left.tick, before, clock) < 0.5 * MIX_SECONDS);
            let moment = old.map_or(self.shown, |left| left.moment);
            self.left = Some(Left { moment, tick: before });
        } else if self.left.is_some_and(|left| since(left.tick, clock.tick(), clock) >= MIX_SECONDS - 1e-9) {
            self.left = None;
        }
        self.shown = now;
        changes
    }

    /// How it is shown when it is at that moment. Where that is of another clip than in the last step, it is as it was: the change begins with the next one.
    pub(super) fn pose(&self, now: Option<ClipMoment>, clock: &Clock) -> RigPose {
        let to = if clip_of(now) == clip_of(self.shown) { now } else { self.shown };
        self.left.map_or(RigPose::at(to), |left| {
            RigPose::between(left.moment, to, since(left.tick, clock.tick(), clock))
        })
    }
}

fn clip_of(moment: Option<ClipMoment>) -> Option<u32> {
    moment.map(|moment| moment.clip)
}

/// Seconds from one tick to another.
fn since(from: Tick, to: Tick, clock: &Clock) -> f64 {
    to.0.saturating_sub(from.0) as f64 * clock.dt()
}
