//! Who plays: the mind and the persona of each courier.

use std::fmt;

use serde::{Deserialize, Serialize};
use simworld_agents::delivery::{Persona, PolicyKind};
use simworld_core::seed::{Seed, Stream};
use thiserror::Error;

use super::RunConfig;

/// What decides for a courier.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub enum Brain {
    /// A policy.
    Policy(PolicyKind),
    /// A model.
    Model,
}

/// No mind of that name.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("there is no mind {name}: give model, or one of {}", PolicyKind::ALL.map(PolicyKind::as_str).join(", "))]
pub struct BrainError {
    name: String,
}

impl Brain {
    /// Every one, policies in the order of declaration.
    pub fn all() -> impl Iterator<Item = Self> {
        PolicyKind::ALL.into_iter().map(Self::Policy).chain([Self::Model])
    }

    /// The policies alone.
    pub fn policies() -> Vec<Self> {
        PolicyKind::ALL.map(Self::Policy).to_vec()
    }

    /// The name in files and tables.
    pub fn as_str(self) -> &'static str {
        match self {
            Self::Policy(policy) => policy.as_str(),
            Self::Model => "model",
        }
    }
}

impl fmt::Display for Brain {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.as_str())
    }
}

impl std::str::FromStr for Brain {
    type Err = BrainError;

    fn from_str(name: &str) -> Result<Self, BrainError> {
        Self::all().find(|brain| brain.as_str() == name).ok_or_else(|| BrainError { name: name.to_owned() })
    }
}

impl TryFrom<String> for Brain {
    type Error = BrainError;

    fn try_from(name: String) -> Result<Self, BrainError> {
        name.parse()
    }
}

impl From<Brain> for String {
    fn from(brain: Brain) -> Self {
        brain.as_str().to_owned()
    }
}

/// What a courier is like.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Player {
    /// What decides for it.
    pub policy: Brain,
    /// What biases it.
    pub persona: Persona,
}

/// The couriers of a seed, in order: minds and personas are dealt in turn, and personas are drawn where none are given.
pub fn players(config: &RunConfig, seed: Seed) -> Vec<Player> {
    let minds = seed.stream("minds");
    let player = |index: usize| Player {
        policy: config.policies[index % config.policies.len()],
        persona: match config.personas.as_slice() {
            [] => drawn(minds.indexed(index as u64).named("persona")),
            some => some[index % some.len()],
        },
    };
    (0..config.agents as usize).map(player).collect()
}

fn drawn(stream: Stream) -> Persona {
    let mut rng = stream.rng();
    let mut trait_value = || rng.normal_clamped(0.0, 0.4, -1.0, 1.0);
    Persona {
        openness: trait_value(),
        conscientiousness: trait_value(),
        extraversion: trait_value(),
        agreeableness: trait_value(),
        neuroticism: trait_value(),
    }
}
