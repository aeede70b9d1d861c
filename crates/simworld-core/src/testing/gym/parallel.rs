//! The check of environments with several agents.

use std::collections::BTreeMap;

use super::{EnvCheck, alien, check_episodes, tries_alien};
use crate::hash::{StateDigest, StateHash, StateHasher};
use crate::id::EntityId;
use crate::seam::{EnvError, Options, ParallelEnv, Space, SpaceValue, hash_info};
use crate::seed::Seed;

/// Checks an environment of several agents as [`check_env`](super::check_env) does one of a single agent. Besides, everybody who is there
/// and nobody else has a transition in each step; whoever had its last is not revived, and its actions are refused.
///
/// # Panics
/// With what is wrong, at the first rule that is broken.
pub fn check_parallel_env<E>(make: impl Fn(usize) -> E, check: &EnvCheck)
where
    E: ParallelEnv<Observation = SpaceValue, Action = SpaceValue>,
{
    let mut early = make(1);
    let refused = early.step(&BTreeMap::new());
    assert!(matches!(refused, Err(EnvError::NotReset)), "a step before reset is refused with NotReset");
    let unknown = Options::from([("no such option".to_owned(), true.into())]);
    let refused = early.reset(Some(Seed(1)), &unknown);
    assert!(matches!(refused, Err(EnvError::Option { .. })), "an unknown option is refused with Option");
    check_episodes(&make, &|env, seed, steps| trajectory(env, seed, steps), check);
}

type Spaces = BTreeMap<EntityId, (Space, Space)>;

/// An episode of random actions of everybody, checked and digested step by step.
fn trajectory<E>(env: &mut E, seed: Option<Seed>, steps: usize) -> Vec<StateDigest>
where
    E: ParallelEnv<Observation = SpaceValue, Action = SpaceValue>,
{
    let start = env.reset(seed, &Options::new()).expect("it resets");
    let spaces: Spaces = start.keys().map(|id| (*id, env.spaces(*id))).collect();
    let mut hasher = StateHasher::new();
    for (id, (seen, info)) in &start {
        assert_eq!(spaces[id].0.validate(), Ok(()), "the space of observations of {id}");
        assert_eq!(spaces[id].1.validate(), Ok(()), "the space of actions of {id}");
        assert_eq!(spaces[id].0.check(seen), Ok(()), "the first observation of {id}");
        seen.state_hash(hasher.u64((*id).into()));
        hash_info(info, &mut hasher);
    }
    let mut trail = vec![hasher.finish()];
    let mut rng = Seed(7).stream("actions").rng();
    let mut agents: Vec<EntityId> = start.keys().copied().collect();
    for step in 0..steps {
        if agents.is_empty() {
            let beyond = env.step(&BTreeMap::new());
            assert!(matches!(beyond, Err(EnvError::NotReset)), "nobody is left, yet it goes on");
            break;
        }
        let actions: BTreeMap<_, _> = agents.iter().map(|id| (*id, spaces[id].1.sample(&mut rng))).collect();
        check_refusals(env, &agents, &spaces, &actions, step);
        let transitions =
            env.step(&actions).unwrap_or_else(|error| panic!("step {step} of its spaces: {error}"));
        let acted: Vec<EntityId> = transitions.keys().copied().collect();
        assert_eq!(acted, agents, "at step {step} those who have a transition are not those who are there");
        for (id, transition) in &transitions {
            assert_eq!(env.spaces(*id), spaces[id], "the spaces of {id} changed");
            assert_eq!(spaces[id].0.check(&transition.observation), Ok(()), "{id} at step {step}");
            assert!(transition.reward.is_finite(), "the reward of {id} at step {step}");
            transition.state_hash(hasher.u64((*id).into()));
        }
        trail.push(hasher.finish());
        agents.retain(|id| !transitions[id].is_last());
    }
    trail
}

/// Actions of those who are gone, and actions of another kind, change nothing.
fn check_refusals<E>(
    env: &mut E,
    agents: &[EntityId],
    spaces: &Spaces,
    actions: &BTreeMap<EntityId, SpaceValue>,
    step: usize,
) where
    E: ParallelEnv<Observation = SpaceValue, Action = SpaceValue>,
{
    if !tries_alien(step) {
        return;
    }
    let mut wrong = actions.clone();
    if let Some(last) = wrong.values_mut().next_back() {
        *last = alien(last);
    }
    let refused = env.step(&wrong);
    assert!(
        matches!(refused, Err(EnvError::Action { .. })),
        "an action of another kind is refused with Action"
    );
    if let Some(gone) = spaces.keys().find(|id| !agents.contains(id)) {
        let mut more = actions.clone();
        more.insert(*gone, spaces[gone].1.sample(&mut Seed(8).stream("actions").rng()));
        let refused = env.step(&more);
        assert!(
            matches!(refused, Err(EnvError::Action { .. })),
            "the action of {gone}, who is gone, is refused"
        );
    }
}
