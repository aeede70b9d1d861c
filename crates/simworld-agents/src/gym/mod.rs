//! Around Gym environments: wrappers, and many environments stepped together.
//!
//! Wrappers are environments around an environment, and go together in any order that their spaces allow:
//!
//! ```
//! use simworld_agents::gym::EnvExt;
//! use simworld_core::seam::{Env, EnvError, Info, Options, Space, SpaceValue, Transition};
//! use simworld_core::seed::Seed;
//!
//! /// A walker on a line, who is rewarded for being far east.
//! struct Line(f64);
//!
//! impl Env for Line {
//!     type Observation = SpaceValue;
//!     type Action = SpaceValue;
//!     fn reset(&mut self, _: Option<Seed>, options: &Options) -> Result<(SpaceValue, Info), EnvError> {
//!         EnvError::refuse_unknown(options, &[])?;
//!         self.0 = 0.0;
//!         Ok((SpaceValue::Box(vec![0.0]), Info::new()))
//!     }
//!     fn step(&mut self, action: &SpaceValue) -> Result<Transition<SpaceValue>, EnvError> {
//!         let refused = |source| EnvError::NotInSpace { what: "action", source };
//!         self.spaces().1.check(action).map_err(refused)?;
//!         self.0 += action.as_box().map_or(0.0, |step| step[0]);
//!         let (observation, info) = (SpaceValue::Box(vec![self.0]), Info::new());
//!         Ok(Transition { observation, reward: self.0, terminated: false, truncated: false, info })
//!     }
//!     fn spaces(&self) -> (Space, Space) {
//!         (Space::bounded(f64::NEG_INFINITY, f64::INFINITY, vec![1]), Space::bounded(-2.0, 2.0, vec![1]))
//!     }
//! }
//!
//! let mut env = Line(0.0).rescale_action(-1.0, 1.0)?.frame_stack(3)?.time_limit(2)?;
//! env.reset(Some(Seed(1)), &Options::new())?;
//! let step = env.step(&SpaceValue::Box(vec![0.5]))?;
//! assert_eq!(step.observation, SpaceValue::Box(vec![0.0, 0.0, 1.0]));
//! assert!(!step.truncated && env.step(&SpaceValue::Box(vec![0.5]))?.truncated);
//! # Ok::<(), EnvError>(())
//! ```
//!
//! What a wrapper keeps within an episode ends with the episode. What lasts longer and has to do with results are the
//! running moments of the normalisers: they are plain data for serde, to be read and set. [`ParallelEnvExt`] offers the same
//! for environments of several agents, each of whom then has frames and moments of its own.
//!
//! [`VectorEnv`] steps many environments together, on several threads if asked.

mod action;
mod flatten;
mod moments;
mod normalise;
mod observing;
mod record;
mod reward;
mod stack;
mod time_limit;
mod vector;

use std::io::Write;

pub use action::{Acting, ActionMap, ClipAction, FlattenAction, ParallelActing, RescaleAction};
pub use flatten::FlattenObservation;
pub use moments::{Learning, RunningMoments};
pub use normalise::NormaliseObservation;
pub use observing::{ObservationMap, Observing, ParallelObserving};
pub use record::{Detail, EpisodeSummary, Line, Record};
pub use reward::NormaliseReward;
use simworld_core::seam::{Env, EnvError, ParallelEnv, SpaceValue};
pub use stack::FrameStack;
pub use time_limit::TimeLimit;
pub use vector::{
    Boundary, ParallelVectorEnv, ParallelVectorStep, VectorConfig, VectorEnv, VectorError, VectorTransition,
};

/// Wrappers around environments of one agent.
pub trait EnvExt: Env + Sized {
    /// Truncates episodes after so many steps.
    ///
    /// # Errors
    /// A limit of 0.
    fn time_limit(self, steps: u64) -> Result<TimeLimit<Self>, EnvError> {
        TimeLimit::new(self, steps)
    }

    /// Keeps statistics of episodes, and writes lines of JSON to `out`.
    fn record<W: Write>(self, out: W, detail: Detail) -> Record<Self, W> {
        Record::new(self, out, detail)
    }

    /// Divides rewards by the standard deviation of their running return, discounted by `gamma` in [0, 1).
    ///
    /// # Errors
    /// A discount out of range.
    fn normalise_reward(self, gamma: f64) -> Result<NormaliseReward<Self>, EnvError> {
        NormaliseReward::new(self, gamma)
    }

    /// Passes observations through a map.
    ///
    /// # Errors
    /// A space that the map is not for.
    fn observing<M: ObservationMap>(self, map: M) -> Result<Observing<Self, M>, EnvError>
    where
        Self: Env<Observation = SpaceValue>,
    {
        Observing::new(self, map)
    }

    /// Passes actions through a map.
    ///
    /// # Errors
    /// A space that the map is not for.
    fn acting<M: ActionMap>(self, map: M) -> Result<Acting<Self, M>, EnvError>
    where
        Self: Env<Action = SpaceValue>,
    {
        Acting::new(self, map)
    }

    /// Makes observations plain vectors.
    ///
    /// # Errors
    /// Observations without a flat form.
    fn flatten_observation(self) -> Result<Observing<Self, FlattenObservation>, EnvError>
    where
        Self: Env<Observation = SpaceValue>,
    {
        self.observing(FlattenObservation)
    }

    /// Shows the last `frames` observations, the oldest first.
    ///
    /// # Errors
    /// Observations that are no boxes, or no frame.
    fn frame_stack(self, frames: usize) -> Result<Observing<Self, FrameStack>, EnvError>
    where
        Self: Env<Observation = SpaceValue>,
    {
        self.observing(FrameStack::new(frames))
    }

    /// Brings each entry of observations to mean 0 and variance 1, by what was seen so far.
    ///
    /// # Errors
    /// Observations that are no boxes.
    fn normalise_observation(self) -> Result<Observing<Self, NormaliseObservation>, EnvError>
    where
        Self: Env<Observation = SpaceValue>,
    {
        self.observing(NormaliseObservation::default())
    }

    /// Takes actions as plain vectors.
    ///
    /// # Errors
    /// Actions without a flat form.
    fn flatten_action(self) -> Result<Acting<Self, FlattenAction>, EnvError>
    where
        Self: Env<Action = SpaceValue>,
    {
        self.acting(FlattenAction)
    }

    /// Takes any numbers as actions and moves them to the nearest bound.
    ///
    /// # Errors
    /// Actions that are no boxes.
    fn clip_action(self) -> Result<Acting<Self, ClipAction>, EnvError>
    where
        Self: Env<Action = SpaceValue>,
    {
        self.acting(ClipAction)
    }

    /// Takes actions in [low, high] and stretches them to the bounds.
    ///
    /// # Errors
    /// Actions that are no boxes with finite bounds, or bounds out of order.
    fn rescale_action(self, low: f64, high: f64) -> Result<Acting<Self, RescaleAction>, EnvError>
    where
        Self: Env<Action = SpaceValue>,
    {
        self.acting(RescaleAction { low, high })
    }
}

impl<E: Env> EnvExt for E {}

/// Wrappers around environments of several agents.
pub trait ParallelEnvExt: ParallelEnv + Sized {
    /// Truncates episodes of everybody after so many steps.
    ///
    /// # Errors
    /// A limit of 0.
    fn time_limit(self, steps: u64) -> Result<TimeLimit<Self>, EnvError> {
        TimeLimit::new(self, steps)
    }

    /// Keeps statistics of episodes, and writes lines of JSON to `out`.
    fn record<W: Write>(self, out: W, detail: Detail) -> Record<Self, W> {
        Record::new(self, out, detail)
    }

    /// Divides rewards by the standard deviation of running returns, one an agent, discounted by `gamma` in [0, 1).
    ///
    /// # Errors
    /// A discount out of range.
    fn normalise_reward(self, gamma: f64) -> Result<NormaliseReward<Self>, EnvError> {
        NormaliseReward::new(self, gamma)
    }

    /// Passes what each agent observes through a map of its own.
    fn observing<M: ObservationMap>(self, map: M) -> ParallelObserving<Self, M>
    where
        Self: ParallelEnv<Observation = SpaceValue>,
    {
        ParallelObserving::new(self, map)
    }

    /// Passes actions through a map.
    fn acting<M: ActionMap>(self, map: M) -> ParallelActing<Self, M>
    where
        Self: ParallelEnv<Action = SpaceValue>,
    {
        ParallelActing::new(self, map)
    }
}

impl<E: ParallelEnv> ParallelEnvExt for E {}
