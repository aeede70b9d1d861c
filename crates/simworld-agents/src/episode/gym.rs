//! An episode as a parallel Gym environment: agents act by intents in words or calls.

use std::collections::BTreeMap;

use simworld_core::command::Command;
use simworld_core::id::EntityId;
use simworld_core::intent::Intent;
use simworld_core::scene::Scene;
use simworld_core::seam::{
    EnvError, Observer, ParallelEnv, ParallelStep, Space, SpaceError, SpaceValue, Task, Transition,
};
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

    /// What everybody perceives who is still in the world.
    fn observe_all(&mut self) -> Result<BTreeMap<EntityId, O::Observation>, EnvError> {
        let episode = self.episode.as_ref().ok_or(EnvError::NotReset)?;
        let world = episode.simulation().world();
        let mut all = BTreeMap::new();
        for id in episode.agents().iter().filter(|id| world.entity(**id).is_some()) {
            let mut observation = O::Observation::default();
            let observed = self.observer.observe(world, *id, &mut observation);
            observed.map_err(|error| EnvError::Simulation(error.to_string()))?;
            all.insert(*id, observation);
        }
        Ok(all)
    }

    /// An action of a stranger, or one that is too long, is refused before anything happens.
    fn check_actions(&self, actions: &BTreeMap<EntityId, Intent>) -> Result<(), EnvError> {
        let episode = self.episode.as_ref().ok_or(EnvError::NotReset)?;
        for (who, intent) in actions {
            let text = match intent {
                Intent::Words(words) => words.clone(),
                Intent::Call { .. } => intent.to_string(),
            };
            let checked = if episode.agents().contains(who) {
                action_space().check(&SpaceValue::Text(text))
            } else {
                Err(SpaceError { path: who.to_string(), reason: "is no agent of this episode".to_owned() })
            };
            checked.map_err(|source| EnvError::Action { who: *who, source })?;
        }
        Ok(())
    }
}

const fn action_space() -> Space {
    Space::Text { max_length: LONGEST_SENTENCE }
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
        self.check_actions(actions)?;
        let episode = self.episode.as_mut().ok_or(EnvError::NotReset)?;
        if episode.is_over() {
            return Err(EnvError::NotReset);
        }
        let acted: Vec<bool> =
            episode.agents().iter().map(|id| episode.simulation().world().entity(*id).is_some()).collect();
        for (who, intent) in actions {
            episode.submit(Command::Intend { who: *who, intent: intent.clone() });
        }
        let outcome = episode.step().map_err(|error| EnvError::Simulation(error.to_string()))?.clone();
        let ids = episode.agents().to_vec();
        let mut observations = self.observe_all()?;
        let transition = |(index, id): (usize, &EntityId)| {
            let seen = observations.remove(id);
            // Who left the world in this step is told so once, and perceives nothing; then it is gone for good.
            let terminated = outcome.terminated || seen.is_none();
            let (observation, truncated) = (seen.unwrap_or_default(), outcome.truncated);
            let reward = outcome.rewards.get(index).copied().unwrap_or(0.0);
            (*id, Transition { observation, reward, terminated, truncated, info: BTreeMap::new() })
        };
        let present = ids.iter().enumerate().filter(|(index, _)| acted[*index]);
        Ok(present.map(transition).collect())
    }

    fn spaces(&self, _agent: EntityId) -> (Space, Space) {
        let observations = self.observer.space().unwrap_or(Space::Text { max_length: usize::MAX });
        (observations, action_space())
    }
}
