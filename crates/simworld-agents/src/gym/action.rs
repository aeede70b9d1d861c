//! Environments whose actions pass through a map: clipped, rescaled, or taken as plain vectors.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use simworld_core::id::EntityId;
use simworld_core::seam::{
    Env, EnvError, Info, Options, ParallelEnv, ParallelStart, ParallelStep, Space, SpaceError, SpaceValue,
    Transition,
};
use simworld_core::seed::Seed;

use super::flatten::flat;
use super::observing::boxed;

/// Makes of actions those that the environment takes.
pub trait ActionMap {
    /// The space of what goes in, when the environment takes this.
    ///
    /// # Errors
    /// A space that the map is not for.
    fn space(&self, inner: &Space) -> Result<Space, EnvError>;

    /// The action that the environment takes; the one given is in the map's space.
    ///
    /// # Errors
    /// It stands for none.
    fn act(&self, inner: &Space, action: &SpaceValue) -> Result<SpaceValue, SpaceError>;
}

/// Takes any numbers, and moves each to the nearest bound.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct ClipAction;

impl ActionMap for ClipAction {
    fn space(&self, inner: &Space) -> Result<Space, EnvError> {
        let (_, _, shape) = boxed(inner, "ClipAction")?;
        Ok(Space::bounded(f64::NEG_INFINITY, f64::INFINITY, shape.to_vec()))
    }

    fn act(&self, inner: &Space, action: &SpaceValue) -> Result<SpaceValue, SpaceError> {
        Ok(each(inner, action, |entry, low, high| entry.max(low).min(high)))
    }
}

/// Takes numbers in [low, high], and stretches them to the bounds.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct RescaleAction {
    /// What becomes the lower bound.
    pub low: f64,
    /// What becomes the upper bound.
    pub high: f64,
}

impl ActionMap for RescaleAction {
    fn space(&self, inner: &Space) -> Result<Space, EnvError> {
        let (low, high, shape) = boxed(inner, "RescaleAction")?;
        let refused = |reason: String| EnvError::Wrapper { wrapper: "RescaleAction", reason };
        if !(self.low < self.high && (self.high - self.low).is_finite()) {
            return Err(refused(format!("[{}, {}] is no range: give low < high", self.low, self.high)));
        }
        let is_finite = |index: usize| {
            let width = low.at(index).zip(high.at(index)).map_or(f64::NAN, |(low, high)| high - low);
            width.is_finite()
        };
        match (0..shape.iter().product()).find(|index| !is_finite(*index)) {
            Some(index) => {
                Err(refused(format!("entry {index} has no finite bounds to stretch to: clip it instead")))
            }
            None => Ok(Space::bounded(self.low, self.high, shape.to_vec())),
        }
    }

    fn act(&self, inner: &Space, action: &SpaceValue) -> Result<SpaceValue, SpaceError> {
        let part = |entry: f64| (entry - self.low) / (self.high - self.low);
        // clamped, because the last bit may fall beyond the bound
        Ok(each(inner, action, |entry, low, high| (low + (high - low) * part(entry)).max(low).min(high)))
    }
}

/// Takes plain vectors, by [`Space::unflatten`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct FlattenAction;

impl ActionMap for FlattenAction {
    fn space(&self, inner: &Space) -> Result<Space, EnvError> {
        flat("FlattenAction", inner)
    }

    fn act(&self, inner: &Space, action: &SpaceValue) -> Result<SpaceValue, SpaceError> {
        inner.unflatten(action.as_box().unwrap_or(&[]))
    }
}

/// Maps the entries of a box with their bounds.
fn each(inner: &Space, action: &SpaceValue, map: impl Fn(f64, f64, f64) -> f64) -> SpaceValue {
    let (Space::Box { low, high, .. }, SpaceValue::Box(entries)) = (inner, action) else {
        return action.clone();
    };
    let bound = |bound: Option<f64>, none: f64| bound.unwrap_or(none);
    let entry = |(index, entry): (usize, &f64)| {
        map(*entry, bound(low.at(index), f64::NEG_INFINITY), bound(high.at(index), f64::INFINITY))
    };
    SpaceValue::Box(entries.iter().enumerate().map(entry).collect())
}

/// Checks an action and passes it through a map.
fn translate<M: ActionMap>(
    map: &M,
    inner: &Space,
    outer: &Space,
    action: &SpaceValue,
) -> Result<SpaceValue, SpaceError> {
    outer.check(action)?;
    map.act(inner, action)
}

/// An environment of one agent, whose actions pass through a map.
#[derive(Clone, Debug)]
pub struct Acting<E, M> {
    env: E,
    map: M,
    inner: Space,
    outer: Space,
}

impl<E: Env<Action = SpaceValue>, M: ActionMap> Acting<E, M> {
    /// Passes actions through the map.
    ///
    /// # Errors
    /// A space that the map is not for.
    pub fn new(env: E, map: M) -> Result<Self, EnvError> {
        let (_, inner) = env.spaces();
        let outer = map.space(&inner)?;
        Ok(Self { env, map, inner, outer })
    }

    /// What is inside.
    pub fn inner(&self) -> &E {
        &self.env
    }
}

impl<E: Env<Action = SpaceValue>, M: ActionMap> Env for Acting<E, M> {
    type Observation = E::Observation;
    type Action = SpaceValue;

    fn reset(&mut self, seed: Option<Seed>, options: &Options) -> Result<(E::Observation, Info), EnvError> {
        self.env.reset(seed, options)
    }

    fn step(&mut self, action: &SpaceValue) -> Result<Transition<E::Observation>, EnvError> {
        match translate(&self.map, &self.inner, &self.outer, action) {
            Ok(action) => self.env.step(&action),
            Err(source) => Err(EnvError::NotInSpace { what: "action", source }),
        }
    }

    fn spaces(&self) -> (Space, Space) {
        (self.env.spaces().0, self.outer.clone())
    }
}

/// An environment of several agents, whose actions pass through a map.
#[derive(Clone, Debug)]
pub struct ParallelActing<E, M> {
    env: E,
    map: M,
}

impl<E: ParallelEnv<Action = SpaceValue>, M: ActionMap> ParallelActing<E, M> {
    /// Passes actions through the map.
    pub fn new(env: E, map: M) -> Self {
        Self { env, map }
    }

    /// What is inside.
    pub fn inner(&self) -> &E {
        &self.env
    }
}

impl<E: ParallelEnv<Action = SpaceValue>, M: ActionMap> ParallelEnv for ParallelActing<E, M> {
    type Observation = E::Observation;
    type Action = SpaceValue;

    fn reset(
        &mut self,
        seed: Option<Seed>,
        options: &Options,
    ) -> Result<ParallelStart<E::Observation>, EnvError> {
        let start = self.env.reset(seed, options)?;
        start.keys().try_for_each(|id| self.map.space(&self.env.spaces(*id).1).map(|_| ()))?;
        Ok(start)
    }

    fn step(
        &mut self,
        actions: &BTreeMap<EntityId, SpaceValue>,
    ) -> Result<ParallelStep<E::Observation>, EnvError> {
        let translated = |(id, action): (&EntityId, &SpaceValue)| {
            let (_, inner) = self.env.spaces(*id);
            let outer = self.map.space(&inner)?;
            let action = translate(&self.map, &inner, &outer, action);
            Ok((*id, action.map_err(|source| EnvError::Action { who: *id, source })?))
        };
        let actions = actions.iter().map(translated).collect::<Result<_, EnvError>>()?;
        self.env.step(&actions)
    }

    /// A space that the map is not for stays as it is; `reset` says so with an error.
    fn spaces(&self, agent: EntityId) -> (Space, Space) {
        let (observations, inner) = self.env.spaces(agent);
        (observations, self.map.space(&inner).unwrap_or(inner))
    }
}
