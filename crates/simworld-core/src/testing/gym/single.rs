//! The check of environments with one agent.

use super::{EnvCheck, alien, check_episodes, tries_alien};
use crate::hash::{StateDigest, StateHash, StateHasher};
use crate::seam::{Env, EnvError, Options, Space, SpaceValue, hash_info};
use crate::seed::Seed;

/// Checks an environment over whole trajectories of random actions, each compared by the digest of all that came of it.
///
/// Nothing works before `reset` or after the end; unknown options, and actions of another kind, are refused and change
/// nothing; spaces are sound and never change, and observations are in theirs; rewards are finite; the same seed gives
/// the same trajectory, in a used environment and in a fresh one, on any number of threads; another seed gives another
/// one; and an episode without a seed follows from the last.
///
/// That a later step does not write into an observation already given need not be checked: it was given away by value.
///
/// # Panics
/// With what is wrong, at the first rule that is broken.
pub fn check_env<E>(make: impl Fn(usize) -> E, check: &EnvCheck)
where
    E: Env<Observation = SpaceValue, Action = SpaceValue>,
{
    let mut early = make(1);
    let spaces = early.spaces();
    assert_eq!(spaces.0.validate(), Ok(()), "the space of observations");
    assert_eq!(spaces.1.validate(), Ok(()), "the space of actions");
    let action = spaces.1.sample(&mut Seed(7).stream("actions").rng());
    assert!(
        matches!(early.step(&action), Err(EnvError::NotReset)),
        "a step before reset is refused with NotReset"
    );
    let unknown = Options::from([("no such option".to_owned(), true.into())]);
    let refused = early.reset(Some(Seed(1)), &unknown);
    assert!(matches!(refused, Err(EnvError::Option { .. })), "an unknown option is refused with Option");
    check_episodes(&make, &|env, seed, steps| trajectory(env, &spaces, seed, steps), check);
}

/// An episode of random actions, checked and digested step by step.
fn trajectory<E>(env: &mut E, spaces: &(Space, Space), seed: Option<Seed>, steps: usize) -> Vec<StateDigest>
where
    E: Env<Observation = SpaceValue, Action = SpaceValue>,
{
    let (seen, info) = env.reset(seed, &Options::new()).expect("it resets");
    assert_eq!(spaces.0.check(&seen), Ok(()), "the first observation");
    let mut hasher = StateHasher::new();
    seen.state_hash(&mut hasher);
    hash_info(&info, &mut hasher);
    let mut trail = vec![hasher.finish()];
    let mut rng = Seed(7).stream("actions").rng();
    for step in 0..steps {
        let action = spaces.1.sample(&mut rng);
        if tries_alien(step) {
            let refused = env.step(&alien(&action));
            let is_refusal = matches!(refused, Err(EnvError::NotInSpace { .. } | EnvError::Action { .. }));
            assert!(is_refusal, "an action of another kind is refused with NotInSpace");
        }
        let transition =
            env.step(&action).unwrap_or_else(|error| panic!("step {step} of its space: {error}"));
        assert_eq!(env.spaces(), *spaces, "the spaces changed at step {step}");
        assert_eq!(spaces.0.check(&transition.observation), Ok(()), "the observation of step {step}");
        assert!(transition.reward.is_finite(), "the reward of step {step}");
        transition.state_hash(&mut hasher);
        trail.push(hasher.finish());
        if transition.is_last() {
            let beyond = env.step(&action);
            assert!(matches!(beyond, Err(EnvError::NotReset)), "it goes on after its end at step {step}");
            break;
        }
    }
    trail
}
