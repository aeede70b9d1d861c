//! Closures: roads and lanes that nobody may enter for a while, and stretches of lanes that are blocked.

use serde::{Deserialize, Serialize};
use simworld_core::id::LaneId;

use crate::Leg;

/// What is closed.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Closed {
    /// All lanes of one direction of a road. Nobody enters it; who is on it drives on and out.
    Leg(Leg),
    /// One lane. Nobody enters it, from a junction or from beside.
    Lane(LaneId),
    /// A stretch of a lane, from and to, m along it: works, or a load on the road. Drivers pass it on a lane beside, or stand
    /// before it.
    Stretch(LaneId, f64, f64),
}

/// Something closed for a while.
///
/// ```
/// use simworld_core::id::LaneId;
/// use simworld_traffic::{Closed, Closure};
/// let works = Closure { until: 3600.0, ..Closure::new(Closed::Stretch(LaneId(4), 20.0, 60.0)) };
/// assert!(works.is_active(0.0) && !works.is_active(3600.0));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Closure {
    /// What is closed.
    pub what: Closed,
    /// From when, s after the start of the traffic.
    pub from: f64,
    /// Until when, s; infinite for good.
    pub until: f64,
}

impl Closure {
    /// Closed at once and for good.
    pub const fn new(what: Closed) -> Self {
        Self { what, from: 0.0, until: f64::INFINITY }
    }

    /// Whether it is closed at a time, s.
    pub fn is_active(&self, now: f64) -> bool {
        self.from <= now && now < self.until
    }
}

/// What drivers do whose way is closed and who find no other.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum NoWay {
    /// They wait until there is one.
    #[default]
    Wait,
    /// They end their trip where they stand, as [`TripEnd::NoWay`](crate::TripEnd::NoWay).
    Leave,
}
