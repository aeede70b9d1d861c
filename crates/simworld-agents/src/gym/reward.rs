//! Rewards over the spread of returns.

use std::collections::BTreeMap;

use simworld_core::id::EntityId;
use simworld_core::seam::{
    Env, EnvError, Info, Options, ParallelEnv, ParallelStart, ParallelStep, Space, Transition,
};
use simworld_core::seed::Seed;

use super::{Learning, RunningMoments};

/// Divides rewards by the standard deviation of the running return, as Gymnasium does; of several agents each has a return of
/// its own, and all share the moments. Save the moments with the policy if it goes on to learn.
#[derive(Clone, Debug)]
pub struct NormaliseReward<E> {
    env: E,
    gamma: f64,
    moments: RunningMoments,
    learning: Learning,
    returns: BTreeMap<EntityId, f64>,
}

/// The key of the only agent.
const ONLY: EntityId = EntityId::new(0, 0);

impl<E> NormaliseReward<E> {
    /// Discounts returns by `gamma`, in [0, 1).
    ///
    /// # Errors
    /// A discount out of range.
    pub fn new(env: E, gamma: f64) -> Result<Self, EnvError> {
        if !(0.0..1.0).contains(&gamma) {
            let reason = format!("gamma = {gamma} is out of range: give 0 to less than 1");
            return Err(EnvError::Wrapper { wrapper: "NormaliseReward", reason });
        }
        let (moments, returns) = (RunningMoments::default(), BTreeMap::new());
        Ok(Self { env, gamma, moments, learning: Learning::Goes, returns })
    }

    /// The moments of returns.
    pub fn moments(&self) -> &RunningMoments {
        &self.moments
    }

    /// Goes on from moments that were saved.
    pub fn set_moments(&mut self, moments: RunningMoments) {
        self.moments = moments;
    }

    /// Whether moments go on to follow.
    pub fn set_learning(&mut self, learning: Learning) {
        self.learning = learning;
    }

    /// What is inside.
    pub fn inner(&self) -> &E {
        &self.env
    }

    fn normalise<O>(&mut self, who: EntityId, transition: &mut Transition<O>) {
        let sum = self.returns.entry(who).or_insert(0.0);
        *sum = *sum * self.gamma + transition.reward;
        if self.learning == Learning::Goes {
            self.moments.see(&[*sum]);
        }
        transition.reward /= self.moments.deviation(0);
    }
}

impl<E: Env> Env for NormaliseReward<E> {
    type Observation = E::Observation;
    type Action = E::Action;

    fn reset(&mut self, seed: Option<Seed>, options: &Options) -> Result<(E::Observation, Info), EnvError> {
        let start = self.env.reset(seed, options)?;
        self.returns.clear();
        Ok(start)
    }

    fn step(&mut self, action: &E::Action) -> Result<Transition<E::Observation>, EnvError> {
        let mut transition = self.env.step(action)?;
        self.normalise(ONLY, &mut transition);
        Ok(transition)
    }

    fn spaces(&self) -> (Space, Space) {
        self.env.spaces()
    }
}

impl<E: ParallelEnv> ParallelEnv for NormaliseReward<E> {
    type Observation = E::Observation;
    type Action = E::Action;

    fn reset(
        &mut self,
        seed: Option<Seed>,
        options: &Options,
    ) -> Result<ParallelStart<E::Observation>, EnvError> {
        let start = self.env.reset(seed, options)?;
        self.returns.clear();
        Ok(start)
    }

    fn step(
        &mut self,
        actions: &BTreeMap<EntityId, E::Action>,
    ) -> Result<ParallelStep<E::Observation>, EnvError> {
        let mut transitions = self.env.step(actions)?;
        for (id, transition) in &mut transitions {
            self.normalise(*id, transition);
        }
        Ok(transitions)
    }

    fn spaces(&self, agent: EntityId) -> (Space, Space) {
        self.env.spaces(agent)
    }
}
