//! The seams: small traits at which the crates, and your own code, meet.
//!
//! | seam | says | required methods |
//! |---|---|---|
//! | [`Scene`](crate::scene::Scene) | what is where | `entity`, `visit`, `environment` |
//! | [`Embodiment`] | a body that takes actions | `supports`, `apply`, `state` |
//! | [`Observer`] | what an agent perceives | `observe` |
//! | [`Planner`] | intent to plan | `plan` |
//! | [`Executor`] | plan to actions, step by step | `start`, `advance` |
//! | [`Task`] | an episode with rewards and metrics | `reset`, `step`, `metrics` |
//!
//! Beside them stand [`Dynamics`], the glue by which traffic and physics move a world, and the Gym contract
//! [`Env`] and [`ParallelEnv`]. All are object-safe; each is also implemented for boxes and mutable references
//! of its implementors, and has a conformance check in the module `testing` (feature `testing`).

mod dynamics;
mod embodiment;
mod executor;
mod gym;
mod observer;
mod plan;
mod planner;
mod task;

pub use dynamics::{Dynamics, DynamicsError};
pub use embodiment::{BodyState, Embodiment, EmbodimentError};
pub use executor::{Executor, ExecutorError, Progress};
pub use gym::{
    Autoreset, Bounds, Env, EnvError, Info, Options, ParallelEnv, ParallelStart, ParallelStep, Space,
    SpaceError, SpaceValue, Transition, hash_info,
};
pub use observer::{ObserveError, Observer};
pub use plan::{Condition, Goal, Plan, PlanStep, Which};
pub use planner::{PlanError, Planner};
pub use task::{Metric, Outcome, Task, TaskContext, TaskError, TaskOutput};
