//! What happened: the facts that dynamics, executors and tasks report, and that logs keep.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::action::ActionKind;
use crate::clock::Tick;
use crate::geometry::{Point3, Vector3};
use crate::id::EntityId;
use crate::scene::FallCause;
use crate::seam::PlanStep;
use crate::value::Value;

/// Something that happened during a step.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Event {
    /// In which step.
    pub tick: Tick,
    /// What.
    pub kind: EventKind,
}

/// The kinds of events.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum EventKind {
    /// Two bodies came to touch.
    Contact {
        /// The one with the lower id.
        a: EntityId,
        /// The other.
        b: EntityId,
        /// Where, world frame.
        point: Point3,
        /// Speed at which they approached along the contact normal, m/s, not negative.
        closing_speed: f64,
        /// Impulse that they exchanged along the normal within the step, N s, not negative; zero where one of them
        /// moves by itself and takes none.
        impulse: f64,
    },
    /// A body could not do what it was told.
    ActionFailed {
        /// The body.
        who: EntityId,
        /// What it was told.
        action: ActionKind,
        /// Why it could not.
        reason: String,
    },
    /// Somebody lost its footing and falls; [`EntityRef::footing`](crate::scene::EntityRef::footing) says how it fares since.
    Fell {
        /// Who.
        who: EntityId,
        /// Why.
        cause: FallCause,
    },
    /// Somebody who had fallen stands again.
    GotUp {
        /// Who.
        who: EntityId,
    },
    /// More was asked of a hand than it holds, and it lost what it had hold of.
    GraspBroke {
        /// Who held on.
        who: EntityId,
        /// What it held.
        thing: EntityId,
        /// What was asked of it, N, as far as the hand gave it.
        force: f64,
    },
    /// Somebody threw something.
    Thrown {
        /// Who.
        who: EntityId,
        /// What flies.
        item: EntityId,
        /// Its velocity, m/s, world frame.
        velocity: Vector3,
    },
    /// A step of a plan was taken up.
    StepBegun {
        /// The agent.
        who: EntityId,
        /// The step, of blocks the innermost.
        step: Box<PlanStep>,
    },
    /// A plan goes on otherwise than it did: by another way, or round something.
    Rerouted {
        /// The agent.
        who: EntityId,
        /// Why.
        reason: String,
    },
    /// A plan was carried out to its end.
    PlanDone {
        /// The agent.
        who: EntityId,
    },
    /// A plan was given up.
    PlanFailed {
        /// The agent.
        who: EntityId,
        /// Why.
        reason: String,
    },
    /// An intent was not understood or not allowed.
    IntentRefused {
        /// The agent.
        who: EntityId,
        /// Why, and what would be accepted.
        reason: String,
    },
    /// Somebody said something.
    Said {
        /// Who.
        who: EntityId,
        /// To whom.
        to: EntityId,
        /// The words.
        words: String,
    },
    /// Somebody waved, pointed, argued or took a photo.
    Gesture {
        /// Who.
        who: EntityId,
        /// What it did.
        gesture: ActionKind,
        /// At whom, if at anybody.
        to: Option<EntityId>,
        /// Where the arm points, radians counter-clockwise from east, if it points.
        #[serde(default)]
        heading: Option<f64>,
    },
    /// Somebody bought something.
    Bought {
        /// Who.
        who: EntityId,
        /// From whom.
        from: EntityId,
        /// What came into its hand.
        item: EntityId,
    },
    /// Something that only a task gives a meaning to.
    Task {
        /// What, as a verb in the past: `order_posted`.
        name: String,
        /// Whom it concerns.
        who: Option<EntityId>,
        /// The facts.
        data: BTreeMap<String, Value>,
    },
}

impl EventKind {
    /// A task event without facts; add them with [`with`](Self::with).
    pub fn task(name: &str, who: Option<EntityId>) -> Self {
        Self::Task { name: name.to_owned(), who, data: BTreeMap::new() }
    }

    /// With a fact; events other than a task's stay as they are.
    #[must_use]
    pub fn with(mut self, key: &str, value: impl Into<Value>) -> Self {
        if let Self::Task { data, .. } = &mut self {
            data.insert(key.to_owned(), value.into());
        }
        self
    }
}
