//! An episode: what is asked of agents, and how they are judged.

use serde::{Deserialize, Serialize};
use thiserror::Error;

use super::Plan;
use crate::command::Command;
use crate::event::{Event, EventKind};
use crate::hash::StateHasher;
use crate::id::EntityId;
use crate::intent::Intent;
use crate::scene::Scene;
use crate::seed::Seed;

/// Why a task cannot go on; the episode ends with it and the state is kept.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum TaskError {
    /// The scene lacks something the task needs.
    #[error("the scene has no {missing}: {hint}")]
    Scene {
        /// What is missing.
        missing: String,
        /// How to mend it.
        hint: String,
    },
    /// A setting out of range.
    #[error("{field} = {value} is out of range: give {allowed}")]
    Config {
        /// The setting, as a path.
        field: String,
        /// Its value.
        value: String,
        /// What is allowed.
        allowed: String,
    },
    /// Anything else, in words.
    #[error("{0}")]
    Other(String),
}

/// What a task sees of a step.
#[derive(Clone, Copy)]
pub struct TaskContext<'a> {
    /// The world as of the last finished step.
    pub scene: &'a dyn Scene,
    /// The agents, in the order they were given at reset.
    pub agents: &'a [EntityId],
    /// What minds want in this step.
    pub intents: &'a [(EntityId, Intent)],
    /// What happened in the last step.
    pub events: &'a [Event],
    /// The entities that the task's commands of the last step made, in the order of the commands.
    pub spawned: &'a [EntityId],
}

/// What a task decides in a step; the caller owns and clears it.
#[derive(Clone, Debug, Default)]
pub struct TaskOutput {
    /// Changes of the world.
    pub commands: Vec<Command>,
    /// Plans for executors to take up.
    pub plans: Vec<(EntityId, Plan)>,
    /// Things that happened.
    pub events: Vec<EventKind>,
}

impl TaskOutput {
    /// Empties it and keeps its memory.
    pub fn clear(&mut self) {
        self.commands.clear();
        self.plans.clear();
        self.events.clear();
    }
}

/// How a step ended; termination and truncation are told apart as in Gymnasium.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Outcome {
    /// The reward of each agent in this step, in the order of agents; shorter means zero for the rest.
    pub rewards: Vec<f64>,
    /// The task reached an end of its own.
    pub terminated: bool,
    /// The time ran out.
    pub truncated: bool,
}

/// One figure of merit.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Metric {
    /// Its name, `snake_case`.
    pub name: String,
    /// Its value.
    pub value: f64,
    /// Its unit, such as `$` or `1`.
    pub unit: String,
}

impl Metric {
    /// A figure of merit.
    pub fn new(name: &str, value: f64, unit: &str) -> Self {
        Self { name: name.to_owned(), value, unit: unit.to_owned() }
    }
}

/// An episode: reset, steps, metrics.
///
/// A task is part of the simulation: given the same scene, intents and events it decides the same, so a replay
/// runs it again rather than its log.
///
/// # Implementing it
///
/// ```
/// use simworld_core::geometry::{Point3, pose_facing};
/// use simworld_core::id::EntityId;
/// use simworld_core::scene::{EntityDesc, EntityKind, Scene, Shape, World};
/// use simworld_core::seed::Seed;
/// use simworld_core::seam::{Metric, Outcome, Task, TaskContext, TaskError, TaskOutput};
///
/// /// Get a hundred metres away from home as fast as you can.
/// #[derive(Default)]
/// struct Run { steps: u32, best: f64 }
///
/// impl Task for Run {
///     fn reset(
///         &mut self, _: &dyn Scene, agents: &[EntityId], _: Seed, _: &mut TaskOutput,
///     ) -> Result<(), TaskError> {
///         if agents.is_empty() { return Err(TaskError::Other("a run needs a runner".into())); }
///         *self = Self::default();
///         Ok(())
///     }
///
///     fn step(
///         &mut self, context: &TaskContext<'_>, _: &mut TaskOutput, outcome: &mut Outcome,
///     ) -> Result<(), TaskError> {
///         self.steps += 1;
///         let before = self.best;
///         for agent in context.agents {
///             if let Some(runner) = context.scene.entity(*agent) {
///                 self.best = self.best.max(runner.planar().coords.norm());
///             }
///         }
///         outcome.rewards.push(self.best - before);
///         outcome.terminated = self.best >= 100.0;
///         outcome.truncated = self.steps >= 1000;
///         Ok(())
///     }
///
///     fn metrics(&self) -> Vec<Metric> { vec![Metric::new("distance", self.best, "m")] }
/// }
///
/// let mut world = World::new();
/// let runner = world.spawn(EntityDesc::new(
///     EntityKind::Person, pose_facing(Point3::origin(), 0.0), Shape::Capsule { radius: 0.25, height: 1.8 }))?;
/// simworld_core::testing::check_task(|| Box::new(Run::default()), &world, &[runner]);
/// # Ok::<(), simworld_core::scene::WorldError>(())
/// ```
pub trait Task {
    /// Starts an episode for these agents: everything random follows from the seed; `out` takes what the task
    /// puts into the world.
    ///
    /// # Errors
    /// The scene or the settings do not allow the task.
    fn reset(
        &mut self,
        scene: &dyn Scene,
        agents: &[EntityId],
        seed: Seed,
        out: &mut TaskOutput,
    ) -> Result<(), TaskError>;

    /// Takes in a step and says what follows. Both outputs come cleared.
    ///
    /// # Errors
    /// The task cannot go on.
    fn step(
        &mut self,
        context: &TaskContext<'_>,
        out: &mut TaskOutput,
        outcome: &mut Outcome,
    ) -> Result<(), TaskError>;

    /// The figures of merit so far.
    fn metrics(&self) -> Vec<Metric>;

    /// The names of the calls this task answers itself; any other intent goes to the agent's planner.
    fn calls(&self) -> &'static [&'static str] {
        &[]
    }

    /// The inner state as bytes for a snapshot; empty by default.
    fn save(&self) -> Vec<u8> {
        Vec::new()
    }

    /// Takes up a saved state; false if the bytes are not this task's.
    fn restore(&mut self, _saved: &[u8]) -> bool {
        true
    }

    /// Feeds inner state that influences the future; nothing by default.
    fn state_hash(&self, _hasher: &mut StateHasher) {}
}

macro_rules! forward_task {
    ($($target:ty),+) => {
        $(impl<T: Task + ?Sized> Task for $target {
            fn reset(
                &mut self,
                scene: &dyn Scene,
                agents: &[EntityId],
                seed: Seed,
                out: &mut TaskOutput,
            ) -> Result<(), TaskError> {
                (**self).reset(scene, agents, seed, out)
            }
            fn step(
                &mut self,
                context: &TaskContext<'_>,
                out: &mut TaskOutput,
                outcome: &mut Outcome,
            ) -> Result<(), TaskError> {
                (**self).step(context, out, outcome)
            }
            fn metrics(&self) -> Vec<Metric> {
                (**self).metrics()
            }
            fn calls(&self) -> &'static [&'static str] {
                (**self).calls()
            }
            fn save(&self) -> Vec<u8> {
                (**self).save()
            }
            fn restore(&mut self, saved: &[u8]) -> bool {
                (**self).restore(saved)
            }
            fn state_hash(&self, hasher: &mut StateHasher) {
                (**self).state_hash(hasher);
            }
        })+
    };
}
forward_task!(Box<T>, &mut T);
