//! Conformance checks of Gym environments, over whole trajectories.

mod parallel;
mod single;

pub use parallel::check_parallel_env;
pub use single::check_env;

use crate::hash::StateDigest;
use crate::seam::SpaceValue;
use crate::seed::Seed;

/// How an environment is checked.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct EnvCheck {
    /// Random actions an episode, at most.
    pub steps: usize,
    /// What a seed decides.
    pub seeds: Seeds,
    /// With how many threads the environment is made; all must do the same. One that uses none takes no notice.
    pub threads: Vec<usize>,
}

/// What a seed decides.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Seeds {
    /// Another seed gives another trajectory under the same actions.
    #[default]
    Matter,
    /// Nothing in the environment is random.
    DecideNothing,
}

impl EnvCheck {
    /// So many steps an episode, where seeds matter, with 1, 2 and 8 threads.
    pub fn new(steps: usize) -> Self {
        Self { steps, seeds: Seeds::Matter, threads: vec![1, 2, 8] }
    }

    /// For an environment in which nothing is random.
    #[must_use]
    pub fn without_chance(mut self) -> Self {
        self.seeds = Seeds::DecideNothing;
        self
    }
}

/// Plays an episode and digests it, step by step.
type Play<'a, E> = &'a dyn Fn(&mut E, Option<Seed>, usize) -> Vec<StateDigest>;

/// What is true of episodes of all environments: they follow from the seed alone.
fn check_episodes<E>(make: &dyn Fn(usize) -> E, play: Play<'_, E>, check: &EnvCheck) {
    let steps = check.steps;
    let mut env = make(1);
    let first = play(&mut env, Some(Seed(1)), steps);
    let unseeded = play(&mut env, None, steps);
    same(&play(&mut env, Some(Seed(1)), steps), &first, "the same seed gives the same trajectory");
    same(&play(&mut env, None, steps), &unseeded, "without a seed an episode follows from the last seed");
    play(&mut env, Some(Seed(3)), steps / 3);
    same(&play(&mut env, Some(Seed(1)), steps), &first, "nothing is left of an episode that was broken off");
    for threads in &check.threads {
        let message = format!("a fresh environment with {threads} threads gives the same trajectory");
        same(&play(&mut make(*threads), Some(Seed(1)), steps), &first, &message);
    }
    if check.seeds == Seeds::Matter {
        assert_ne!(play(&mut env, Some(Seed(2)), steps), first, "another seed gives another trajectory");
        assert_ne!(unseeded, first, "an episode without a seed differs from the one before");
    }
}

/// # Panics
/// With the first step at which two trajectories differ.
fn same(found: &[StateDigest], expected: &[StateDigest], law: &str) {
    let apart = found.iter().zip(expected).position(|(found, expected)| found != expected);
    let apart = apart.or_else(|| (found.len() != expected.len()).then(|| found.len().min(expected.len())));
    match apart {
        None => {}
        Some(0) => panic!("{law}, but the first observation differs"),
        Some(step) => panic!("{law}, but step {step} of {} differs", expected.len() - 1),
    }
}

/// A value of another kind than that one.
fn alien(action: &SpaceValue) -> SpaceValue {
    match action {
        SpaceValue::Text(_) => SpaceValue::Discrete(0),
        _ => SpaceValue::Text("not this".to_owned()),
    }
}

/// In which steps an action is tried that is of another kind than the space.
fn tries_alien(step: usize) -> bool {
    step % 7 == 3
}
