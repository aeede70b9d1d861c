//! The conformance check of environments with several agents.

use std::collections::BTreeMap;

use crate::id::EntityId;
use crate::seam::{EnvError, ParallelEnv, ParallelStep, SpaceValue};
use crate::seed::Seed;

/// Checks an environment whose observations and actions are members of spaces, over `steps` random actions of everybody:
/// nothing works before `reset`; observations are in their space, which never changes; the same seed gives the same
/// episode, and an episode without a seed differs from the one before; rewards are finite; nobody acts after the end.
///
/// # Panics
/// With what is wrong, at the first rule that is broken.
pub fn check_parallel_env<E>(make: impl Fn() -> E, steps: usize)
where
    E: ParallelEnv<Observation = SpaceValue, Action = SpaceValue>,
{
    let early = make().step(&BTreeMap::new());
    assert!(matches!(early, Err(EnvError::NotReset)), "a step before reset is refused with NotReset");
    let mut env = make();
    let first = episode(&mut env, Some(Seed(1)), steps);
    let unseeded = episode(&mut env, None, steps);
    assert_eq!(episode(&mut env, Some(Seed(1)), steps), first, "the same seed gives the same episode");
    assert_eq!(
        episode(&mut env, None, steps),
        unseeded,
        "without a seed an episode follows from the last seed"
    );
    assert_eq!(episode(&mut make(), Some(Seed(1)), steps), first, "whichever environment it is");
}

type Episode = (BTreeMap<EntityId, SpaceValue>, Vec<ParallelStep<SpaceValue>>);

/// An episode of random actions, checked step by step.
fn episode<E>(env: &mut E, seed: Option<Seed>, steps: usize) -> Episode
where
    E: ParallelEnv<Observation = SpaceValue, Action = SpaceValue>,
{
    let start = env.reset(seed).expect("it resets");
    let spaces: BTreeMap<EntityId, _> = start.keys().map(|id| (*id, env.spaces(*id))).collect();
    for (id, seen) in &start {
        assert_eq!(spaces[id].0.check(seen), Ok(()), "the first observation of {id}");
    }
    let mut rng = Seed(7).stream("actions").rng();
    let mut agents: Vec<EntityId> = start.keys().copied().collect();
    let mut trail = Vec::new();
    for step in 0..steps {
        if agents.is_empty() {
            assert!(
                matches!(env.step(&BTreeMap::new()), Err(EnvError::NotReset)),
                "nobody is left, yet it goes on"
            );
            break;
        }
        let actions = agents.iter().map(|id| (*id, spaces[id].1.sample(&mut rng))).collect();
        let transitions = env.step(&actions).expect("actions of their space are taken");
        for (id, transition) in &transitions {
            assert!(agents.contains(id), "{id} was gone or never there, at step {step}");
            assert_eq!(env.spaces(*id), spaces[id], "the spaces of {id} changed");
            assert_eq!(spaces[id].0.check(&transition.observation), Ok(()), "{id} at step {step}");
            assert!(transition.reward.is_finite(), "the reward of {id} at step {step}");
        }
        agents.retain(|id| transitions.get(id).is_some_and(|t| !t.terminated && !t.truncated));
        trail.push(transitions);
    }
    (start, trail)
}
