//! What is to be done: steps in order, with conditions, repetitions and guards.

use serde::{Deserialize, Serialize};

use crate::action::Action;
use crate::geometry::Point3;
use crate::id::EntityId;
use crate::net::Aspect;
use crate::scene::{EntityKind, EntityRef, Place};

/// Where a navigation ends.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum Goal {
    /// At a point, world frame.
    Point(Point3),
    /// At the access point of an entity, wherever it is by then.
    Entity(EntityId),
}

/// One step of a plan: an action of the level above primitives, or a block of steps.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum PlanStep {
    /// Goes somewhere.
    Navigate {
        /// Where to.
        to: Goal,
        /// Distance in the plane at which one has arrived, m.
        within: f64,
        /// Speed wanted, m/s; `None` leaves it to the body.
        speed: Option<f64>,
    },
    /// Does one primitive action.
    Act(Action),
    /// Stands and waits.
    Wait {
        /// How long, s.
        seconds: f64,
    },
    /// Goes after somebody and never ends by itself: put it into an [`Until`](Self::Until), or stop it.
    Follow {
        /// Whom.
        whom: EntityId,
        /// The gap kept, m.
        gap: f64,
        /// The highest speed, m/s; `None` leaves it to the body.
        speed: Option<f64>,
    },
    /// Turns on the spot to look at something.
    Face {
        /// At what.
        to: Goal,
    },
    /// Stretches an arm towards something, wherever one stands by then.
    Point {
        /// At what.
        at: Goal,
    },
    /// Does one thing or another, as the condition holds when the step is come to.
    If {
        /// The condition.
        condition: Condition,
        /// What is done if it holds.
        then: Vec<Self>,
        /// What is done if not.
        otherwise: Vec<Self>,
    },
    /// Does the steps several times over.
    Repeat {
        /// How often.
        times: u32,
        /// The steps.
        steps: Vec<Self>,
    },
    /// Does the steps, from the first again after the last, and breaks off as soon as the condition holds. Without
    /// steps one stands and waits for it.
    Until {
        /// The condition, looked at in every step of the simulation.
        condition: Condition,
        /// The steps.
        steps: Vec<Self>,
    },
}

/// One thing, or any of a class.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum Which {
    /// This one.
    Entity(EntityId),
    /// Anything of one of these kinds, or used so.
    Any {
        /// The kinds.
        kinds: Vec<EntityKind>,
        /// The use.
        place: Option<Place>,
    },
}

impl Which {
    /// Whether an entity is meant.
    pub fn holds(&self, entity: &EntityRef<'_>) -> bool {
        match self {
            Self::Entity(id) => entity.id == *id,
            Self::Any { kinds, place } => {
                kinds.contains(&entity.kind) || place.is_some_and(|place| entity.info.place == Some(place))
            }
        }
    }
}

/// Something that holds or does not, as the agent finds the world.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum Condition {
    /// A traffic light shows this.
    Signal {
        /// The post, whose attribute `signal_group` says what it shows.
        light: EntityId,
        /// What it shows.
        shows: Aspect,
    },
    /// The agent sees it: before it, near enough, and nothing in between.
    Sees(Which),
    /// It is near the agent.
    Near {
        /// What.
        what: Which,
        /// How near its footprint or access point is, m.
        within: f64,
    },
    /// A free one is near the agent: nobody sits on it, has it or is in it.
    FreeNear {
        /// What.
        what: Which,
        /// How near, m.
        within: f64,
    },
    /// Somebody uses it: sits on it, has it or is in it.
    InUse(EntityId),
    /// A door is open.
    Open(EntityId),
    /// The agent has it in its hand or arms; `None` is anything.
    Holds(Option<EntityId>),
    /// The agent sits.
    Seated,
    /// It rains.
    Raining,
    /// It snows.
    Snowing,
    /// The sun is down.
    Dark,
    /// So much time has passed since the step was come to, s.
    Elapsed(f64),
    /// The contrary.
    Not(Box<Self>),
    /// All of them.
    All(Vec<Self>),
    /// At least one of them.
    Any(Vec<Self>),
    /// Two others are near one another: "Anna is near the bin".
    Together {
        /// One of them.
        one: EntityId,
        /// The other.
        other: EntityId,
        /// The widest gap between their footprints, in the plane, m.
        within: f64,
    },
}

/// What is to be done, in order.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Plan {
    /// The steps.
    pub steps: Vec<PlanStep>,
}

impl Plan {
    /// A plan of one navigation.
    pub fn navigate(to: Goal, within: f64) -> Self {
        Self { steps: vec![PlanStep::Navigate { to, within, speed: None }] }
    }

    /// With another action at the end.
    #[must_use]
    pub fn then(mut self, action: Action) -> Self {
        self.steps.push(PlanStep::Act(action));
        self
    }
}
