//! Why one who drives does not arrive.

use serde::{Deserialize, Serialize};
use simworld_core::geometry::Point2;
use simworld_core::id::EntityId;
use simworld_core::scene::{EntityRef, Scene};
use simworld_core::seam::Goal;
use thiserror::Error;

/// Why a drive was given up: the reason of the [`PlanFailed`](simworld_core::event::EventKind::PlanFailed) that reports it, typed.
#[derive(Clone, Debug, PartialEq, Error, Serialize, Deserialize)]
#[non_exhaustive]
pub enum CannotArrive {
    /// What one was to drive to is not there any more.
    #[error("{goal:?} is gone: name another destination")]
    GoalGone {
        /// The goal.
        goal: Goal,
    },
    /// No lanes lead from here to there.
    #[error("no lanes lead from ({:.0}, {:.0}) to ({:.0}, {:.0}): get out here, or go elsewhere", from.x, from.y, to.x, to.y)]
    NoWay {
        /// Where the vehicle is.
        from: Point2,
        /// Where it was to be.
        to: Point2,
    },
    /// Streets are closed, and without them no lanes lead there.
    #[error(
        "no way from ({:.0}, {:.0}) to ({:.0}, {:.0}) while {closed} directions of streets are closed: open one of them, or get out here",
        from.x, from.y, to.x, to.y
    )]
    Closed {
        /// Where the vehicle is.
        from: Point2,
        /// Where it was to be.
        to: Point2,
        /// How many directions of roads are closed in this world.
        closed: usize,
    },
    /// Something stands in the way, with no way round it, past it, or back.
    #[error("stuck at ({:.1}, {:.1}) behind {label} {by}: wait until it is gone, or go another way", at.x, at.y)]
    Blocked {
        /// Where the vehicle is.
        at: Point2,
        /// By what.
        by: EntityId,
        /// What that is called.
        label: String,
    },
    /// The vehicle does not move, for no reason that can be seen.
    #[error("stuck at ({:.1}, {:.1}): the vehicle does not move as it is told to", at.x, at.y)]
    Stuck {
        /// Where it is.
        at: Point2,
    },
    /// A line at which there was never a gap, and no other way.
    #[error("no gap for {waited:.0} s at ({:.1}, {:.1}): the junction ahead does not clear", at.x, at.y)]
    NoGap {
        /// Where the vehicle is.
        at: Point2,
        /// How long it has stood there, s.
        waited: f64,
    },
}

impl CannotArrive {
    /// That nothing goes on, behind what there is.
    pub(super) fn stuck(scene: &dyn Scene, at: Point2, by: Option<EntityId>) -> Self {
        let label = |other: EntityRef<'_>| other.label().to_owned();
        match by.and_then(|id| Some((id, label(scene.entity(id)?)))) {
            Some((by, label)) => Self::Blocked { at, by, label },
            None => Self::Stuck { at },
        }
    }
}
