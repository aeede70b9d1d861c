//! The Gym contract: environments, spaces, and what a step returns.
//!
//! The semantics are those of Gymnasium 1.x and `PettingZoo`'s parallel environments: `reset` takes a seed and options and
//! gives an observation with its info; termination and truncation are told apart; an agent once gone is not revived
//! within an episode; and the spaces never change.

mod check;
mod flat;
mod sample;
mod space;
#[cfg(test)]
mod tests;
mod written;

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
pub use space::{Bounds, Space, SpaceError, SpaceValue};
use thiserror::Error;

use crate::hash::{StateHash, StateHasher};
use crate::id::EntityId;
use crate::seed::Seed;
use crate::value::Value;

/// What an episode is asked to be like, by name; which names there are, each environment says.
pub type Options = BTreeMap<String, Value>;

/// What is told beside an observation, by name; nothing that a policy may decide on.
pub type Info = BTreeMap<String, Value>;

/// Why an environment refused a call.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum EnvError {
    /// `step` before `reset`, or after the end of an episode.
    #[error("the episode is over or has not begun: call reset first")]
    NotReset,
    /// An action outside its space.
    #[error("the action of {who} is not in its space: {source}")]
    Action {
        /// The agent.
        who: EntityId,
        /// What is wrong.
        source: SpaceError,
    },
    /// A value that is not in its space, where there is but one agent.
    #[error("the {what} is not in its space: {source}")]
    NotInSpace {
        /// Which value: `action`, or `observation`.
        what: &'static str,
        /// What is wrong.
        source: SpaceError,
    },
    /// An option of `reset` that there is not, or that cannot be had.
    #[error("option {name}: {reason}")]
    Option {
        /// Its name.
        name: String,
        /// What is wrong, and what is allowed.
        reason: String,
    },
    /// A wrapper that cannot do its work: the space is none that it is for, or a setting is out of range.
    #[error("{wrapper}: {reason}")]
    Wrapper {
        /// Which wrapper.
        wrapper: &'static str,
        /// Why not, and what would do.
        reason: String,
    },
    /// The simulation behind the environment failed.
    #[error("{0}")]
    Simulation(String),
}

impl EnvError {
    /// Refuses options that are not among the known ones, so that a slip of spelling is not passed over.
    ///
    /// # Errors
    /// The first that is unknown.
    pub fn refuse_unknown(options: &Options, known: &[&str]) -> Result<(), Self> {
        let Some(name) = options.keys().find(|name| !known.contains(&name.as_str())) else { return Ok(()) };
        let all =
            if known.is_empty() { "there are none".to_owned() } else { format!("give {}", known.join(", ")) };
        Err(Self::Option {
            name: name.clone(),
            reason: format!("this environment knows no such option: {all}"),
        })
    }
}

/// What `step` returns to one agent.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Transition<O> {
    /// What is perceived after the step.
    pub observation: O,
    /// The reward of the step.
    pub reward: f64,
    /// The task reached an end of its own.
    pub terminated: bool,
    /// The time ran out.
    pub truncated: bool,
    /// Anything else, by name.
    pub info: Info,
}

impl<O> Transition<O> {
    /// Whether the agent's episode ended with it.
    pub fn is_last(&self) -> bool {
        self.terminated || self.truncated
    }

    /// The same with another observation.
    pub fn map<P>(self, map: impl FnOnce(O) -> P) -> Transition<P> {
        let Self { observation, reward, terminated, truncated, info } = self;
        Transition { observation: map(observation), reward, terminated, truncated, info }
    }
}

impl StateHash for Transition<SpaceValue> {
    fn state_hash(&self, hasher: &mut StateHasher) {
        self.observation.state_hash(hasher);
        hasher.f64(self.reward).u64(u64::from(self.terminated)).u64(u64::from(self.truncated));
        hash_info(&self.info, hasher);
    }
}

/// Feeds an info, so that trajectories can be compared whole.
pub fn hash_info(info: &Info, hasher: &mut StateHasher) {
    hasher.u64(info.len() as u64);
    for (name, value) in info {
        value.state_hash(hasher.str(name));
    }
}

/// What vectorised environments do when an episode ends.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Autoreset {
    /// The next step resets and ignores its action (Gymnasium's default).
    #[default]
    NextStep,
    /// The same step resets; the final observation is carried beside the first one of the new episode.
    SameStep,
    /// Nobody resets but the caller.
    Disabled,
}

/// An environment with one agent.
pub trait Env {
    /// What is perceived.
    type Observation;
    /// What is done.
    type Action;

    /// Starts an episode; with a seed it is the same every time, without one the seed follows from the last.
    ///
    /// # Errors
    /// An option that is not known or out of range, or a simulation that cannot be built.
    fn reset(&mut self, seed: Option<Seed>, options: &Options)
    -> Result<(Self::Observation, Info), EnvError>;

    /// Does something and perceives what came of it.
    ///
    /// # Errors
    /// No episode is under way, the action is not in its space, or the simulation failed.
    fn step(&mut self, action: &Self::Action) -> Result<Transition<Self::Observation>, EnvError>;

    /// The spaces of observations and actions; the same on every call.
    fn spaces(&self) -> (Space, Space);
}

/// What a parallel `reset` returns: what each agent perceives, and its info.
pub type ParallelStart<O> = BTreeMap<EntityId, (O, Info)>;

/// What a parallel `step` returns: one transition for every agent that acted.
pub type ParallelStep<O> = BTreeMap<EntityId, Transition<O>>;

/// An environment in which several agents act at once.
pub trait ParallelEnv {
    /// What an agent perceives.
    type Observation;
    /// What an agent does.
    type Action;

    /// Starts an episode and says what each agent perceives; the keys are the agents. With a seed it is the same every
    /// time, without one the seed follows from the last.
    ///
    /// # Errors
    /// An option that is not known or out of range, or a simulation that cannot be built.
    fn reset(
        &mut self,
        seed: Option<Seed>,
        options: &Options,
    ) -> Result<ParallelStart<Self::Observation>, EnvError>;

    /// Everybody acts; an agent without an action does nothing. An agent whose transition was its last is gone until the
    /// next reset: it is in no later step, and an action of it is refused.
    ///
    /// # Errors
    /// No episode is under way, an action is not in its space, or the simulation failed.
    fn step(
        &mut self,
        actions: &BTreeMap<EntityId, Self::Action>,
    ) -> Result<ParallelStep<Self::Observation>, EnvError>;

    /// The spaces of observations and actions of an agent; the same on every call.
    fn spaces(&self, agent: EntityId) -> (Space, Space);
}

macro_rules! forward_env {
    ($($target:ty),+) => {
        $(impl<E: Env + ?Sized> Env for $target {
            type Observation = E::Observation;
            type Action = E::Action;

            fn reset(&mut self, seed: Option<Seed>, options: &Options) -> Result<(E::Observation, Info), EnvError> {
                (**self).reset(seed, options)
            }
            fn step(&mut self, action: &E::Action) -> Result<Transition<E::Observation>, EnvError> {
                (**self).step(action)
            }
            fn spaces(&self) -> (Space, Space) {
                (**self).spaces()
            }
        }

        impl<E: ParallelEnv + ?Sized> ParallelEnv for $target {
            type Observation = E::Observation;
            type Action = E::Action;

            fn reset(&mut self, seed: Option<Seed>, options: &Options) -> Result<ParallelStart<E::Observation>, EnvError> {
                (**self).reset(seed, options)
            }
            fn step(&mut self, actions: &BTreeMap<EntityId, E::Action>) -> Result<ParallelStep<E::Observation>, EnvError> {
                (**self).step(actions)
            }
            fn spaces(&self, agent: EntityId) -> (Space, Space) {
                (**self).spaces(agent)
            }
        })+
    };
}
forward_env!(Box<E>, &mut E);
