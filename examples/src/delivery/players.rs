//! Who plays: the policy and the persona of each courier.

use serde::{Deserialize, Serialize};
use simworld_agents::delivery::{Persona, PolicyKind};
use simworld_core::seed::{Seed, Stream};

use super::RunConfig;

/// What a courier is like.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Player {
    /// How it bids.
    pub policy: PolicyKind,
    /// What biases it.
    pub persona: Persona,
}

/// The couriers of a seed, in order: policies and personas are dealt in turn, and personas are drawn where none are given.
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
