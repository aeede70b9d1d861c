//! What is to be done: steps in order, with conditions, repetitions and guards.

use std::cell::Cell;

use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize};

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
        #[serde(deserialize_with = "nested")]
        then: Vec<Self>,
        /// What is done if not.
        #[serde(deserialize_with = "nested")]
        otherwise: Vec<Self>,
    },
    /// Does the steps several times over.
    Repeat {
        /// How often.
        times: u32,
        /// The steps.
        #[serde(deserialize_with = "nested")]
        steps: Vec<Self>,
    },
    /// Does the steps, from the first again after the last, and breaks off as soon as the condition holds. Without
    /// steps one stands and waits for it.
    Until {
        /// The condition, looked at in every step of the simulation.
        condition: Condition,
        /// The steps.
        #[serde(deserialize_with = "nested")]
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
    Not(#[serde(deserialize_with = "nested")] Box<Self>),
    /// All of them.
    All(#[serde(deserialize_with = "nested")] Vec<Self>),
    /// At least one of them.
    Any(#[serde(deserialize_with = "nested")] Vec<Self>),
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

/// How deep blocks and conditions may lie in one another in what is read.
const DEEPEST: u32 = 32;

thread_local! {
    /// How deep what is being read on this thread lies.
    static DEPTH: Cell<u32> = const { Cell::new(0) };
}

/// Reads what lies within a block or a condition. Plans come from networks and files too, and who nests one a million deep
/// would end the process by its stack.
fn nested<'de, D: Deserializer<'de>, T: Deserialize<'de>>(from: D) -> Result<T, D::Error> {
    let depth = DEPTH.get();
    if depth == DEEPEST {
        return Err(D::Error::custom(format!(
            "blocks of a plan lie more than {DEEPEST} deep in one another"
        )));
    }
    DEPTH.set(depth + 1);
    let read = T::deserialize(from);
    DEPTH.set(depth);
    read
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A wait within so many blocks.
    fn deep(blocks: u32) -> Plan {
        let wait = PlanStep::Wait { seconds: 1.0 };
        let step = (0..blocks).fold(wait, |step, _| PlanStep::Repeat { times: 2, steps: vec![step] });
        Plan { steps: vec![step] }
    }

    #[test]
    fn plans_are_read_as_they_were_written_but_for_those_without_an_end() {
        for blocks in [0, 1, 16, DEEPEST] {
            let bytes = postcard::to_stdvec(&deep(blocks)).unwrap();
            assert_eq!(postcard::from_bytes::<Plan>(&bytes).unwrap(), deep(blocks));
            let text = serde_json::to_string(&deep(blocks)).unwrap();
            assert_eq!(serde_json::from_str::<Plan>(&text).unwrap(), deep(blocks));
        }
        let bytes = postcard::to_stdvec(&deep(DEEPEST + 1)).unwrap();
        assert!(postcard::from_bytes::<Plan>(&bytes).is_err());
        // What would fill any stack is a few bytes a block: the tag of `Repeat`, its times, and the one step in it.
        let repeat = &bytes[1..4];
        let endless = [&bytes[..1], &repeat.repeat(1_000_000)].concat();
        assert!(postcard::from_bytes::<Plan>(&endless).is_err());
        assert_eq!(postcard::from_bytes::<Plan>(&postcard::to_stdvec(&deep(3)).unwrap()).unwrap(), deep(3));
    }
}
