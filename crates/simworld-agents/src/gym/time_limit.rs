//! Episodes that are over after so many steps.

use std::collections::BTreeMap;

use simworld_core::id::EntityId;
use simworld_core::seam::{
    Env, EnvError, Info, Options, ParallelEnv, ParallelStart, ParallelStep, Space, Transition,
};
use simworld_core::seed::Seed;

/// Truncates episodes, of one agent or of several, after so many steps. An end of the task's own in the last step stays one
/// beside it, as in Gymnasium.
#[derive(Clone, Debug)]
pub struct TimeLimit<E> {
    env: E,
    limit: u64,
    /// Steps that are left; none outside of an episode.
    left: u64,
}

impl<E> TimeLimit<E> {
    /// Truncates after so many steps.
    ///
    /// # Errors
    /// A limit of 0.
    pub fn new(env: E, limit: u64) -> Result<Self, EnvError> {
        if limit == 0 {
            let reason = "a limit of 0 steps leaves nothing to do: give 1 or more".to_owned();
            return Err(EnvError::Wrapper { wrapper: "TimeLimit", reason });
        }
        Ok(Self { env, limit, left: 0 })
    }

    /// What is inside.
    pub fn inner(&self) -> &E {
        &self.env
    }
}

impl<E: Env> Env for TimeLimit<E> {
    type Observation = E::Observation;
    type Action = E::Action;

    fn reset(&mut self, seed: Option<Seed>, options: &Options) -> Result<(E::Observation, Info), EnvError> {
        let start = self.env.reset(seed, options)?;
        self.left = self.limit;
        Ok(start)
    }

    fn step(&mut self, action: &E::Action) -> Result<Transition<E::Observation>, EnvError> {
        if self.left == 0 {
            return Err(EnvError::NotReset);
        }
        let mut transition = self.env.step(action)?;
        self.left -= 1;
        transition.truncated |= self.left == 0;
        Ok(transition)
    }

    fn spaces(&self) -> (Space, Space) {
        self.env.spaces()
    }
}

impl<E: ParallelEnv> ParallelEnv for TimeLimit<E> {
    type Observation = E::Observation;
    type Action = E::Action;

    fn reset(
        &mut self,
        seed: Option<Seed>,
        options: &Options,
    ) -> Result<ParallelStart<E::Observation>, EnvError> {
        let start = self.env.reset(seed, options)?;
        self.left = self.limit;
        Ok(start)
    }

    fn step(
        &mut self,
        actions: &BTreeMap<EntityId, E::Action>,
    ) -> Result<ParallelStep<E::Observation>, EnvError> {
        if self.left == 0 {
            return Err(EnvError::NotReset);
        }
        let mut transitions = self.env.step(actions)?;
        self.left -= 1;
        for transition in transitions.values_mut() {
            transition.truncated |= self.left == 0;
        }
        Ok(transitions)
    }

    fn spaces(&self, agent: EntityId) -> (Space, Space) {
        self.env.spaces(agent)
    }
}
