//! Small environments in which chance plays a part, for the tests of wrappers and of many environments.

use std::collections::BTreeMap;

use simworld_core::hash::{StateDigest, StateHash, StateHasher};
use simworld_core::id::EntityId;
use simworld_core::seam::{
    Env, EnvError, Info, Options, ParallelEnv, ParallelStart, ParallelStep, Space, SpaceError, SpaceValue,
    Transition,
};
use simworld_core::seed::{Seed, StreamRng};

/// Somebody who drifts along a line and pushes; at home beyond ±8.
pub(crate) struct Drift {
    rng: StreamRng,
    seed: Seed,
    pub(crate) x: f64,
    v: f64,
    is_over: bool,
    /// The push in which it panics.
    panics_at: Option<f64>,
}

impl Drift {
    pub(crate) fn new() -> Self {
        let rng = Seed(0).stream("drift").rng();
        Self { rng, seed: Seed(0), x: 0.0, v: 0.0, is_over: true, panics_at: None }
    }

    pub(crate) fn that_panics_at(push: Option<f64>) -> Self {
        Self { panics_at: push, ..Self::new() }
    }

    fn begin(&mut self, seed: Option<Seed>, start: f64) -> SpaceValue {
        self.seed = seed.unwrap_or_else(|| self.seed.stream("gym/next").seed());
        self.rng = self.seed.stream("drift").rng();
        (self.x, self.v, self.is_over) = (start + self.rng.uniform(-1.0, 1.0), 0.0, false);
        self.seen()
    }

    fn seen(&self) -> SpaceValue {
        SpaceValue::Box(vec![self.x, self.v])
    }

    fn act(&mut self, push: f64) -> Transition<SpaceValue> {
        assert!(self.panics_at != Some(push), "pushed over the edge");
        self.v += 0.5 * push + self.rng.normal(0.0, 0.3);
        self.x += self.v;
        self.is_over = self.x.abs() > 8.0;
        let (reward, terminated, info) = (3.0 - self.x.abs(), self.is_over, Info::new());
        Transition { observation: self.seen(), reward, terminated, truncated: false, info }
    }

    fn own_spaces() -> (Space, Space) {
        let far = vec![f64::INFINITY; 2];
        (
            Space::bounded(far.iter().map(|x| -x).collect::<Vec<_>>(), far, vec![2]),
            Space::bounded(-2.0, 3.0, vec![1]),
        )
    }

    fn push_of(action: &SpaceValue) -> Result<f64, SpaceError> {
        Self::own_spaces().1.check(action)?;
        Ok(action.as_box().map_or(0.0, |push| push[0]))
    }
}

impl Env for Drift {
    type Observation = SpaceValue;
    type Action = SpaceValue;

    /// The option `start` shifts the start.
    fn reset(&mut self, seed: Option<Seed>, options: &Options) -> Result<(SpaceValue, Info), EnvError> {
        EnvError::refuse_unknown(options, &["start"])?;
        let start = options.get("start").and_then(simworld_core::value::Value::as_f64).unwrap_or(0.0);
        Ok((self.begin(seed, start), Info::from([("start".to_owned(), start.into())])))
    }

    fn step(&mut self, action: &SpaceValue) -> Result<Transition<SpaceValue>, EnvError> {
        if self.is_over {
            return Err(EnvError::NotReset);
        }
        let push = Self::push_of(action).map_err(|source| EnvError::NotInSpace { what: "action", source })?;
        Ok(self.act(push))
    }

    fn spaces(&self) -> (Space, Space) {
        Self::own_spaces()
    }
}

/// Three who drift, each by itself.
pub(crate) struct Drifts {
    all: Vec<Drift>,
}

impl Drifts {
    pub(crate) fn new() -> Self {
        Self { all: (0..3).map(|_| Drift::new()).collect() }
    }
}

impl ParallelEnv for Drifts {
    type Observation = SpaceValue;
    type Action = SpaceValue;

    fn reset(
        &mut self,
        seed: Option<Seed>,
        options: &Options,
    ) -> Result<ParallelStart<SpaceValue>, EnvError> {
        EnvError::refuse_unknown(options, &[])?;
        let begin = |(index, one): (usize, &mut Drift)| {
            let own = seed.map(|seed| seed.stream("drifts").indexed(index as u64).seed());
            (EntityId::new(index as u32, 0), (one.begin(own, 0.0), Info::new()))
        };
        Ok(self.all.iter_mut().enumerate().map(begin).collect())
    }

    fn step(
        &mut self,
        actions: &BTreeMap<EntityId, SpaceValue>,
    ) -> Result<ParallelStep<SpaceValue>, EnvError> {
        if self.all.iter().all(|one| one.is_over) {
            return Err(EnvError::NotReset);
        }
        let mut pushes = [0.0; 3];
        for (id, action) in actions {
            let gone = || SpaceError { path: id.to_string(), reason: "is gone".to_owned() };
            let is_there = self.all.get(id.index()).is_some_and(|one| !one.is_over);
            let push = if is_there { Drift::push_of(action) } else { Err(gone()) };
            pushes[id.index()] = push.map_err(|source| EnvError::Action { who: *id, source })?;
        }
        let present = self.all.iter_mut().enumerate().filter(|(_, one)| !one.is_over);
        Ok(present.map(|(index, one)| (EntityId::new(index as u32, 0), one.act(pushes[index]))).collect())
    }

    fn spaces(&self, _: EntityId) -> (Space, Space) {
        Drift::own_spaces()
    }
}

/// The digest of everything that many environments gave over so many steps.
pub(crate) fn digest<'a>(values: impl IntoIterator<Item = &'a Transition<SpaceValue>>) -> StateDigest {
    let mut hasher = StateHasher::new();
    for value in values {
        value.state_hash(&mut hasher);
    }
    hasher.finish()
}
