//! An episode as a parallel Gym environment: agents act by intents in words or calls.

use std::collections::BTreeMap;

use simworld_core::command::Command;
use simworld_core::id::EntityId;
use simworld_core::intent::Intent;
use simworld_core::seam::{EnvError, Observer, ParallelEnv, ParallelStep, Space, Task, Transition};
use simworld_core::seed::Seed;

use super::{Episode, EpisodeError};

/// The longest sentence an agent may say.
const LONGEST_SENTENCE: usize = 2000;

/// Makes an episode for a seed.
type Build<T> = Box<dyn FnMut(Seed) -> Result<Episode<T>, EpisodeError>>;

/// A parallel environment over episodes that a closure builds, one a reset. The episode's own minds do nothing
/// unless the closure gives them something to do; actions come from the caller.
pub struct GymEpisode<T: Task, O: Observer> {
    build: Build<T>,
    observer: O,
    episode: Option<Episode<T>>,
    seed: Seed,
}

impl<T: Task, O: Observer<Observation: Default>> GymEpisode<T, O> {
    /// An environment whose episodes come from `build` and whose agents perceive by `observer`.
    pub fn new(observer: O, build: impl FnMut(Seed) -> Result<Episode<T>, EpisodeError> + 'static) -> Self {
        Self { build: Box::new(build), observer, episode: None, seed: Seed(0) }
    }

    /// The episode under way.
    pub fn episode(&self) -> Option<&Episode<T>> {
        self.episode.as_ref()
    }

    fn observe_all(&mut self) -> Result<BTreeMap<EntityId, O::Observation>, EnvError> {
        let episode = self.episode.as_ref().ok_or(EnvError::NotReset)?;
        let mut all = BTreeMap::new();
        for id in episode.agents() {
            let mut observation = O::Observation::default();
            let observed = self.observer.observe(episode.simulation().world(), *id, &mut observation);
            observed.map_err(|error| EnvError::Simulation(error.to_string()))?;
            all.insert(*id, observation);
        }
        Ok(all)
    }
}

impl<T: Task, O: Observer<Observation: Default>> ParallelEnv for GymEpisode<T, O> {
    type Observation = O::Observation;
    type Action = Intent;

    fn reset(&mut self, seed: Option<Seed>) -> Result<BTreeMap<EntityId, Self::Observation>, EnvError> {
        // Without a seed every episode differs from the last, and all follow from the first.
        self.seed = seed.unwrap_or_else(|| self.seed.stream("gym/next").seed());
        let episode = (self.build)(self.seed).map_err(|error| EnvError::Simulation(error.to_string()))?;
        self.episode = Some(episode);
        self.observe_all()
    }

    fn step(
        &mut self,
        actions: &BTreeMap<EntityId, Intent>,
    ) -> Result<ParallelStep<Self::Observation>, EnvError> {
        let episode = self.episode.as_mut().ok_or(EnvError::NotReset)?;
        if episode.is_over() {
            return Err(EnvError::NotReset);
        }
        for (who, intent) in actions {
            episode.submit(Command::Intend { who: *who, intent: intent.clone() });
        }
        let outcome = episode.step().map_err(|error| EnvError::Simulation(error.to_string()))?.clone();
        let ids = episode.agents().to_vec();
        let mut observations = self.observe_all()?;
        let transition = |(index, id): (usize, &EntityId)| {
            let observation = observations.remove(id)?;
            let reward = outcome.rewards.get(index).copied().unwrap_or(0.0);
            let (terminated, truncated) = (outcome.terminated, outcome.truncated);
            Some((*id, Transition { observation, reward, terminated, truncated, info: BTreeMap::new() }))
        };
        Ok(ids.iter().enumerate().filter_map(transition).collect())
    }

    fn spaces(&self, _agent: EntityId) -> (Space, Space) {
        let observations = self.observer.space().unwrap_or(Space::Text { max_length: usize::MAX });
        (observations, Space::Text { max_length: LONGEST_SENTENCE })
    }
}
