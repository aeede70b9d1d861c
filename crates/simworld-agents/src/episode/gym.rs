//! An episode as a parallel Gym environment: agents act by intents in words or calls.

use std::collections::BTreeMap;

use simworld_core::command::Command;
use simworld_core::id::EntityId;
use simworld_core::intent::Intent;
use simworld_core::scene::Scene;
use simworld_core::seam::{
    EnvError, Info, Observer, Options, ParallelEnv, ParallelStart, ParallelStep, Space, SpaceError,
    SpaceValue, Task, Transition,
};
use simworld_core::seed::Seed;

use super::{Episode, EpisodeError};

/// The longest sentence an agent may say.
const LONGEST_SENTENCE: usize = 2000;

/// Makes an episode for a seed.
type Build<T> = Box<dyn FnMut(Seed) -> Result<Episode<T>, EpisodeError>>;

/// A parallel environment over episodes that a closure builds, one a reset; options there are none. The episode's own minds
/// do nothing unless the closure gives them something to do; actions come from the caller. Who left the world is gone
/// until the next reset, also if its body comes back, and its actions are refused.
pub struct GymEpisode<T: Task, O: Observer> {
    build: Build<T>,
    observer: O,
    episode: Option<Episode<T>>,
    /// Those whose episode goes on.
    present: Vec<EntityId>,
    seed: Seed,
}

impl<T: Task, O: Observer<Observation: Default>> GymEpisode<T, O> {
    /// An environment whose episodes come from `build` and whose agents perceive by `observer`.
    pub fn new(observer: O, build: impl FnMut(Seed) -> Result<Episode<T>, EpisodeError> + 'static) -> Self {
        Self { build: Box::new(build), observer, episode: None, present: Vec::new(), seed: Seed(0) }
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
        for id in self.present.iter().filter(|id| world.entity(**id).is_some()) {
            let mut observation = O::Observation::default();
            let observed = self.observer.observe(world, *id, &mut observation);
            observed.map_err(|error| EnvError::Simulation(error.to_string()))?;
            all.insert(*id, observation);
        }
        Ok(all)
    }
}

/// An action of a stranger, or one that is too long, is refused before anything happens.
fn check_actions(present: &[EntityId], actions: &BTreeMap<EntityId, Intent>) -> Result<(), EnvError> {
    for (who, intent) in actions {
        let refused = |reason: &str| Err(SpaceError { path: who.to_string(), reason: reason.to_owned() });
        let within = |text: String| action_space().check(&SpaceValue::Text(text));
        let checked = match intent {
            _ if !present.contains(who) => refused("is no agent of this episode, or no more"),
            Intent::Words(words) => within(words.clone()),
            Intent::Call { .. } => within(intent.to_string()),
            Intent::Plan(_) | Intent::Act(_) => refused("wants what is no text: give words or a call"),
        };
        checked.map_err(|source| EnvError::Action { who: *who, source })?;
    }
    Ok(())
}

const fn action_space() -> Space {
    Space::Text { max_length: LONGEST_SENTENCE }
}

impl<T: Task, O: Observer<Observation: Default>> ParallelEnv for GymEpisode<T, O> {
    type Observation = O::Observation;
    type Action = Intent;

    fn reset(
        &mut self,
        seed: Option<Seed>,
        options: &Options,
    ) -> Result<ParallelStart<Self::Observation>, EnvError> {
        EnvError::refuse_unknown(options, &[])?;
        // Without a seed every episode differs from the last, and all follow from the first.
        self.seed = seed.unwrap_or_else(|| self.seed.stream("gym/next").seed());
        let episode = (self.build)(self.seed).map_err(|error| EnvError::Simulation(error.to_string()))?;
        self.present = episode.agents().to_vec();
        self.episode = Some(episode);
        let seen = self.observe_all()?;
        self.present.retain(|id| seen.contains_key(id));
        Ok(seen.into_iter().map(|(id, seen)| (id, (seen, Info::new()))).collect())
    }

    fn step(
        &mut self,
        actions: &BTreeMap<EntityId, Intent>,
    ) -> Result<ParallelStep<Self::Observation>, EnvError> {
        let Some(episode) = self.episode.as_mut().filter(|episode| !episode.is_over()) else {
            return Err(EnvError::NotReset);
        };
        // Nobody is left, although the task would go on.
        if self.present.is_empty() {
            return Err(EnvError::NotReset);
        }
        check_actions(&self.present, actions)?;
        for (who, intent) in actions {
            episode.submit(Command::Intend { who: *who, intent: intent.clone() });
        }
        let outcome = episode.step().map_err(|error| EnvError::Simulation(error.to_string()))?.clone();
        let rewards: BTreeMap<EntityId, f64> =
            episode.agents().iter().copied().zip(outcome.rewards.iter().copied()).collect();
        let mut observations = self.observe_all()?;
        let transition = |id: &EntityId| {
            let seen = observations.remove(id);
            // Who left the world in this step is told so once, and perceives nothing; then it is gone for good.
            let terminated = outcome.terminated || seen.is_none();
            let (observation, truncated) = (seen.unwrap_or_default(), outcome.truncated);
            let reward = rewards.get(id).copied().unwrap_or(0.0);
            (*id, Transition { observation, reward, terminated, truncated, info: Info::new() })
        };
        let transitions: ParallelStep<Self::Observation> = self.present.iter().map(transition).collect();
        self.present.retain(|id| !transitions[id].is_last());
        Ok(transitions)
    }

    fn spaces(&self, _agent: EntityId) -> (Space, Space) {
        let observations = self.observer.space().unwrap_or(Space::Text { max_length: usize::MAX });
        (observations, action_space())
    }
}
