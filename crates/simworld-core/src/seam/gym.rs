//! The Gym contract: environments, spaces, and what a step returns.
//!
//! The semantics are those of Gymnasium 1.x and `PettingZoo`'s parallel environments: termination and truncation
//! are told apart, an agent once gone is not revived within an episode, and the spaces never change.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::id::EntityId;
use crate::seed::{Seed, StreamRng};
use crate::value::Value;

/// A set of observations or actions.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum Space {
    /// The integers 0..n.
    Discrete {
        /// Their number.
        n: u64,
    },
    /// Arrays of numbers within bounds.
    Box {
        /// Least value of each entry.
        low: f64,
        /// Greatest value of each entry.
        high: f64,
        /// Length of each axis.
        shape: Vec<usize>,
    },
    /// Arrays of zeros and ones.
    MultiBinary {
        /// Their length.
        n: usize,
    },
    /// Words.
    Text {
        /// The greatest number of characters.
        max_length: usize,
    },
    /// Named parts.
    Dict(BTreeMap<String, Space>),
}

/// A member of a [`Space`].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum SpaceValue {
    /// Of a discrete space.
    Discrete(u64),
    /// Of a box, row-major.
    Box(Vec<f64>),
    /// Of a multi-binary space.
    MultiBinary(Vec<bool>),
    /// Of a text space.
    Text(String),
    /// Of a dictionary.
    Dict(BTreeMap<String, SpaceValue>),
}

/// Why a value is not in a space.
#[derive(Clone, Debug, PartialEq, Error)]
#[error("{path}: {reason}")]
pub struct SpaceError {
    /// Where, as a path of dictionary keys.
    pub path: String,
    /// What is wrong.
    pub reason: String,
}

impl Space {
    /// Checks that a value is in the space.
    ///
    /// ```
    /// use simworld_core::seam::{Space, SpaceValue};
    /// let steering = Space::Box { low: -1.0, high: 1.0, shape: vec![1] };
    /// assert!(steering.check(&SpaceValue::Box(vec![0.3])).is_ok());
    /// assert!(steering.check(&SpaceValue::Box(vec![f64::NAN])).is_err());
    /// ```
    ///
    /// # Errors
    /// The first place where it is not.
    pub fn check(&self, value: &SpaceValue) -> Result<(), SpaceError> {
        self.check_at("value", value)
    }

    fn check_at(&self, path: &str, value: &SpaceValue) -> Result<(), SpaceError> {
        let wrong = |reason: String| Err(SpaceError { path: path.to_owned(), reason });
        match (self, value) {
            (Self::Discrete { n }, SpaceValue::Discrete(index)) => {
                if index < n {
                    Ok(())
                } else {
                    wrong(format!("{index} is not below {n}"))
                }
            }
            (Self::Box { low, high, shape }, SpaceValue::Box(entries)) => {
                let length: usize = shape.iter().product();
                if entries.len() != length {
                    return wrong(format!(
                        "{} entries where the shape {shape:?} has {length}",
                        entries.len()
                    ));
                }
                match entries.iter().position(|entry| !(*low..=*high).contains(entry)) {
                    Some(index) => {
                        wrong(format!("entry {index} = {} is not in [{low}, {high}]", entries[index]))
                    }
                    None => Ok(()),
                }
            }
            (Self::MultiBinary { n }, SpaceValue::MultiBinary(bits)) => {
                if bits.len() == *n {
                    Ok(())
                } else {
                    wrong(format!("{} bits where {n} are due", bits.len()))
                }
            }
            (Self::Text { max_length }, SpaceValue::Text(text)) => {
                let length = text.chars().count();
                if length <= *max_length {
                    Ok(())
                } else {
                    wrong(format!("{length} characters, at most {max_length}"))
                }
            }
            (Self::Dict(spaces), SpaceValue::Dict(values)) => {
                if let Some(key) = values.keys().find(|key| !spaces.contains_key(*key)) {
                    return wrong(format!("unknown key {key}"));
                }
                for (key, space) in spaces {
                    let at = format!("{path}.{key}");
                    match values.get(key) {
                        Some(value) => space.check_at(&at, value)?,
                        None => return Err(SpaceError { path: at, reason: "is missing".to_owned() }),
                    }
                }
                Ok(())
            }
            _ => wrong("is of another kind than the space".to_owned()),
        }
    }

    /// A random member, uniform where the bounds are finite; text is drawn from lower-case letters.
    pub fn sample(&self, rng: &mut StreamRng) -> SpaceValue {
        match self {
            Self::Discrete { n } => SpaceValue::Discrete(rng.below(*n as usize) as u64),
            Self::Box { low, high, shape } => {
                let (low, high) = (low.max(-1e6), high.min(1e6));
                SpaceValue::Box((0..shape.iter().product()).map(|_| rng.uniform(low, high)).collect())
            }
            Self::MultiBinary { n } => SpaceValue::MultiBinary((0..*n).map(|_| rng.chance(0.5)).collect()),
            Self::Text { max_length } => {
                let length = rng.below((*max_length).min(32) + 1);
                SpaceValue::Text((0..length).map(|_| char::from(b'a' + rng.below(26) as u8)).collect())
            }
            Self::Dict(spaces) => {
                SpaceValue::Dict(spaces.iter().map(|(key, space)| (key.clone(), space.sample(rng))).collect())
            }
        }
    }
}

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
    /// The simulation behind the environment failed.
    #[error("{0}")]
    Simulation(String),
}

/// What `step` returns to one agent.
#[derive(Clone, Debug, PartialEq)]
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
    pub info: BTreeMap<String, Value>,
}

/// What vectorised environments do when an episode ends.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Autoreset {
    /// The next step resets and ignores its action (Gymnasium's default).
    #[default]
    NextStep,
    /// The same step resets; the final observation is carried in the info.
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
    /// The simulation cannot be built.
    fn reset(&mut self, seed: Option<Seed>) -> Result<Self::Observation, EnvError>;

    /// Does something and perceives what came of it.
    ///
    /// # Errors
    /// No episode is under way, the action is not in its space, or the simulation failed.
    fn step(&mut self, action: &Self::Action) -> Result<Transition<Self::Observation>, EnvError>;

    /// The spaces of observations and actions; the same on every call.
    fn spaces(&self) -> (Space, Space);
}

/// What a parallel `step` returns: one transition for every agent that acted.
pub type ParallelStep<O> = BTreeMap<EntityId, Transition<O>>;

/// An environment in which several agents act at once.
pub trait ParallelEnv {
    /// What an agent perceives.
    type Observation;
    /// What an agent does.
    type Action;

    /// Starts an episode and says what each agent perceives.
    ///
    /// # Errors
    /// The simulation cannot be built.
    fn reset(&mut self, seed: Option<Seed>) -> Result<BTreeMap<EntityId, Self::Observation>, EnvError>;

    /// Everybody acts; an agent without an action does nothing.
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

#[cfg(test)]
mod tests {
    use super::*;

    fn street() -> Space {
        Space::Dict(BTreeMap::from([
            ("gear".to_owned(), Space::Discrete { n: 5 }),
            ("pedals".to_owned(), Space::Box { low: -1.0, high: 1.0, shape: vec![2, 1] }),
            ("horn".to_owned(), Space::MultiBinary { n: 1 }),
            ("shout".to_owned(), Space::Text { max_length: 12 }),
        ]))
    }

    #[test]
    fn samples_are_members() {
        let mut rng = Seed(5).stream("spaces").rng();
        for _ in 0..200 {
            assert_eq!(street().check(&street().sample(&mut rng)), Ok(()));
        }
    }

    #[test]
    fn strangers_are_named_with_their_place() {
        let mut rng = Seed(5).stream("spaces").rng();
        let SpaceValue::Dict(mut parts) = street().sample(&mut rng) else { panic!("a dict samples a dict") };
        parts.insert("gear".to_owned(), SpaceValue::Discrete(5));
        let error = street().check(&SpaceValue::Dict(parts)).unwrap_err();
        assert_eq!(error.path, "value.gear");
        assert!(error.reason.contains("not below 5"));
    }
}
