//! Environments whose observations pass through a map.

use std::collections::BTreeMap;

use simworld_core::id::EntityId;
use simworld_core::seam::{
    Bounds, Env, EnvError, Info, Options, ParallelEnv, ParallelStart, ParallelStep, Space, SpaceValue,
    Transition,
};
use simworld_core::seed::Seed;

/// Makes other observations of observations; it may remember those before.
pub trait ObservationMap: Clone {
    /// The space of what comes out, when this goes in.
    ///
    /// # Errors
    /// A space that the map is not for.
    fn space(&self, inner: &Space) -> Result<Space, EnvError>;

    /// The first observation of an episode.
    ///
    /// # Errors
    /// An observation that is not in its space.
    fn begin(&mut self, inner: &Space, seen: SpaceValue) -> Result<SpaceValue, EnvError>;

    /// A later one.
    ///
    /// # Errors
    /// An observation that is not in its space.
    fn next(&mut self, inner: &Space, seen: SpaceValue) -> Result<SpaceValue, EnvError>;
}

/// An environment of one agent, whose observations pass through a map.
#[derive(Clone, Debug)]
pub struct Observing<E, M> {
    env: E,
    map: M,
    inner: Space,
    outer: Space,
}

impl<E: Env<Observation = SpaceValue>, M: ObservationMap> Observing<E, M> {
    /// Passes observations through the map.
    ///
    /// # Errors
    /// A space that the map is not for.
    pub fn new(env: E, map: M) -> Result<Self, EnvError> {
        let (inner, _) = env.spaces();
        let outer = map.space(&inner)?;
        Ok(Self { env, map, inner, outer })
    }

    /// The map and what it remembers.
    pub fn map(&self) -> &M {
        &self.map
    }

    /// The same, to be set: to moments that were saved, say.
    pub fn map_mut(&mut self) -> &mut M {
        &mut self.map
    }

    /// What is inside.
    pub fn inner(&self) -> &E {
        &self.env
    }
}

impl<E: Env<Observation = SpaceValue>, M: ObservationMap> Env for Observing<E, M> {
    type Observation = SpaceValue;
    type Action = E::Action;

    fn reset(&mut self, seed: Option<Seed>, options: &Options) -> Result<(SpaceValue, Info), EnvError> {
        let (seen, info) = self.env.reset(seed, options)?;
        Ok((self.map.begin(&self.inner, seen)?, info))
    }

    fn step(&mut self, action: &E::Action) -> Result<Transition<SpaceValue>, EnvError> {
        let mut transition = self.env.step(action)?;
        transition.observation = self.map.next(&self.inner, transition.observation)?;
        Ok(transition)
    }

    fn spaces(&self) -> (Space, Space) {
        (self.outer.clone(), self.env.spaces().1)
    }
}

/// An environment of several agents; what each observes passes through a map of its own, which lasts from episode to episode.
#[derive(Clone, Debug)]
pub struct ParallelObserving<E, M> {
    env: E,
    blank: M,
    maps: BTreeMap<EntityId, M>,
}

impl<E: ParallelEnv<Observation = SpaceValue>, M: ObservationMap> ParallelObserving<E, M> {
    /// Passes observations through copies of the map.
    pub fn new(env: E, map: M) -> Self {
        Self { env, blank: map, maps: BTreeMap::new() }
    }

    /// The map of each agent and what it remembers.
    pub fn maps(&self) -> &BTreeMap<EntityId, M> {
        &self.maps
    }

    /// The same, to be set.
    pub fn maps_mut(&mut self) -> &mut BTreeMap<EntityId, M> {
        &mut self.maps
    }

    /// What is inside.
    pub fn inner(&self) -> &E {
        &self.env
    }
}

impl<E: ParallelEnv<Observation = SpaceValue>, M: ObservationMap> ParallelEnv for ParallelObserving<E, M> {
    type Observation = SpaceValue;
    type Action = E::Action;

    fn reset(
        &mut self,
        seed: Option<Seed>,
        options: &Options,
    ) -> Result<ParallelStart<SpaceValue>, EnvError> {
        let start = self.env.reset(seed, options)?;
        let begin = |(id, (seen, info)): (EntityId, (SpaceValue, Info))| {
            let (inner, _) = self.env.spaces(id);
            let map = self.maps.entry(id).or_insert_with(|| self.blank.clone());
            map.space(&inner)?;
            Ok((id, (map.begin(&inner, seen)?, info)))
        };
        start.into_iter().map(begin).collect()
    }

    fn step(
        &mut self,
        actions: &BTreeMap<EntityId, E::Action>,
    ) -> Result<ParallelStep<SpaceValue>, EnvError> {
        let mut transitions = self.env.step(actions)?;
        for (id, transition) in &mut transitions {
            let (inner, _) = self.env.spaces(*id);
            let Some(map) = self.maps.get_mut(id) else { return Err(EnvError::NotReset) };
            let seen = std::mem::replace(&mut transition.observation, SpaceValue::Discrete(0));
            transition.observation = map.next(&inner, seen)?;
        }
        Ok(transitions)
    }

    /// A space that the map is not for stays as it is; `reset` says so with an error.
    fn spaces(&self, agent: EntityId) -> (Space, Space) {
        let (inner, actions) = self.env.spaces(agent);
        (self.blank.space(&inner).unwrap_or(inner), actions)
    }
}

/// The bounds and the shape of a box.
pub(super) fn boxed<'a>(
    space: &'a Space,
    wrapper: &'static str,
) -> Result<(&'a Bounds, &'a Bounds, &'a [usize]), EnvError> {
    match space {
        Space::Box { low, high, shape } => Ok((low, high, shape)),
        _ => Err(EnvError::Wrapper { wrapper, reason: "the space is no box: flatten it first".to_owned() }),
    }
}
