//! Many environments stepped together.

mod crew;
mod parallel;
mod slot;

use std::num::NonZeroUsize;
use std::sync::Arc;

use crew::{Crew, Make};
pub use parallel::{ParallelVectorEnv, ParallelVectorStep};
use serde::{Deserialize, Serialize};
use simworld_core::seam::{Autoreset, Env, EnvError, Info, Options, Space, Transition};
use simworld_core::seed::Seed;
use slot::Job;
use thiserror::Error;

/// The settings of a [`VectorEnv`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct VectorConfig {
    /// Threads, of which the caller's is one; each has its share of environments for good. No result depends on it.
    pub threads: NonZeroUsize,
    /// What happens when an episode ends.
    pub autoreset: Autoreset,
}

impl Default for VectorConfig {
    fn default() -> Self {
        Self { threads: NonZeroUsize::MIN, autoreset: Autoreset::NextStep }
    }
}

/// Why environments could not be stepped together.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum VectorError {
    /// One of them refused, failed or panicked. The others went on: reset all before the next step.
    #[error("environment {index}: {source}")]
    Env {
        /// Which.
        index: usize,
        /// Why.
        source: EnvError,
    },
    /// Another number of actions or marks than environments.
    #[error("{given} {what} for {count} environments: give one for each")]
    Count {
        /// Of what.
        what: &'static str,
        /// How many were given.
        given: usize,
        /// How many are due.
        count: usize,
    },
    /// Environments whose spaces differ.
    #[error("the spaces of environment {index} differ from those of environment 0: make all of one kind")]
    Spaces {
        /// Which.
        index: usize,
    },
    /// An index that is none.
    #[error("there is no environment {index}: they are numbered from 0 to below {count}")]
    Index {
        /// The index.
        index: usize,
        /// How many there are.
        count: usize,
    },
    /// A thread could not be started.
    #[error("a thread cannot be started: {0}")]
    Thread(#[from] std::io::Error),
}

/// What a step of one of the environments was at the edge of an episode.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Boundary<O> {
    /// A step like any other, the last of its episode included.
    #[default]
    None,
    /// No step at all: the episode before had ended, the action was passed over, and the observation is the first of a new
    /// episode ([`Autoreset::NextStep`]).
    Begun,
    /// The last step of an episode, of which the reward and the ends are; the observation and the info are the first of
    /// the next one ([`Autoreset::SameStep`]).
    Passed {
        /// The last observation of the episode that ended.
        observation: O,
        /// The info of its last step.
        info: Info,
    },
}

/// What came of a step of one of the environments.
#[derive(Clone, Debug, PartialEq)]
pub struct VectorTransition<O> {
    /// What `step` gave; or at the edge of episodes what [`Boundary`] says.
    pub transition: Transition<O>,
    /// Whether an episode began with it.
    pub boundary: Boundary<O>,
}

/// What each environment begins with; nothing where none was asked to.
type Begun<O> = Vec<Option<(O, Info)>>;

/// Many environments of one kind, stepped together and each by itself: what one does is the same on any number of threads.
///
/// Each is made on the thread where it will live, so it need not be [`Send`]. The caller works on a share of its own. Threads end when the vector is dropped, which
/// waits for the step that is under way, if there is one.
///
/// ```
/// # use simworld_core::seam::{Env, EnvError, Info, Options, Space, SpaceValue, Transition};
/// use simworld_agents::gym::{VectorConfig, VectorEnv};
/// use simworld_core::seed::Seed;
/// # struct Dice(simworld_core::seed::StreamRng);
/// # impl Env for Dice {
/// #     type Observation = SpaceValue;
/// #     type Action = SpaceValue;
/// #     fn reset(&mut self, seed: Option<Seed>, _: &Options) -> Result<(SpaceValue, Info), EnvError> {
/// #         if let Some(seed) = seed { self.0 = seed.stream("dice").rng(); }
/// #         Ok((SpaceValue::Discrete(0), Info::new()))
/// #     }
/// #     fn step(&mut self, _: &SpaceValue) -> Result<Transition<SpaceValue>, EnvError> {
/// #         let observation = SpaceValue::Discrete(self.0.below(6) as i64);
/// #         Ok(Transition { observation, reward: 0.0, terminated: false, truncated: false, info: Info::new() })
/// #     }
/// #     fn spaces(&self) -> (Space, Space) { (Space::discrete(6), Space::discrete(1)) }
/// # }
/// # impl Dice { fn new() -> Self { Self(Seed(0).stream("dice").rng()) } }
/// let config = VectorConfig { threads: 2.try_into()?, ..VectorConfig::default() };
/// let mut dice = VectorEnv::new(8, config, |_index| Ok(Dice::new()))?;
/// dice.reset(Some(Seed(1)), &Options::new())?;
/// let thrown = dice.step(vec![SpaceValue::Discrete(0); 8])?;
/// assert!(thrown.iter().any(|one| one.transition.observation != thrown[0].transition.observation));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct VectorEnv<E: Env> {
    crew: Crew<E>,
    config: VectorConfig,
    spaces: (Space, Space),
    options: Options,
    /// Whose episode is over or has not begun.
    over: Vec<bool>,
}

impl<E> VectorEnv<E>
where
    E: Env + 'static,
    E::Observation: Send + 'static,
    E::Action: Send + 'static,
{
    /// So many environments; `make` is called once for each, with its index.
    ///
    /// # Errors
    /// One cannot be made or differs in its spaces, or a thread cannot be started.
    pub fn new(
        count: usize,
        config: VectorConfig,
        make: impl Fn(usize) -> Result<E, EnvError> + Send + Sync + 'static,
    ) -> Result<Self, VectorError> {
        let make: Make<E> = Arc::new(make);
        let mut crew = Crew::new(count, config.threads.get(), &make)?;
        let all = (0..count).map(|index| crew.visit(index, |env| env.spaces()));
        let all = all.collect::<Result<Vec<_>, _>>()?;
        let spaces = all.first().cloned().unwrap_or((Space::discrete(1), Space::discrete(1)));
        if let Some(index) = all.iter().position(|other| *other != spaces) {
            return Err(VectorError::Spaces { index });
        }
        Ok(Self { crew, config, spaces, options: Options::new(), over: vec![true; count] })
    }

    /// How many environments there are.
    pub fn len(&self) -> usize {
        self.over.len()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.over.is_empty()
    }

    /// The spaces of observations and actions of each.
    pub fn spaces(&self) -> &(Space, Space) {
        &self.spaces
    }

    /// Begins an episode in all; the seed of each is drawn from this one by its index. The options also hold for the
    /// episodes that begin by themselves.
    ///
    /// # Errors
    /// The first environment that cannot.
    pub fn reset(
        &mut self,
        seed: Option<Seed>,
        options: &Options,
    ) -> Result<Vec<(E::Observation, Info)>, VectorError> {
        self.options = options.clone();
        let all = vec![true; self.len()];
        let begun = self.reset_marked(&all, seed)?;
        Ok(begun.into_iter().flatten().collect())
    }

    /// Begins an episode in those that are marked; the others, for which there is no answer, go on.
    ///
    /// # Errors
    /// The first environment that cannot, or another number of marks.
    pub fn reset_marked(
        &mut self,
        marks: &[bool],
        seed: Option<Seed>,
    ) -> Result<Begun<E::Observation>, VectorError> {
        self.same_count("marks", marks.len())?;
        let own = |index: usize| seed.map(|seed| seed.stream("gym/vector").indexed(index as u64).seed());
        let job = |(index, mark): (usize, &bool)| {
            mark.then(|| Job::Reset { seed: own(index), options: self.options.clone() })
        };
        let jobs = marks.iter().enumerate().map(job).collect();
        let begun = self.crew.work(jobs, &mut self.over)?;
        let start =
            |done: VectorTransition<E::Observation>| (done.transition.observation, done.transition.info);
        Ok(begun.into_iter().map(|done| done.map(start)).collect())
    }

    /// One action in each.
    ///
    /// # Errors
    /// Another number of actions; an environment whose episode is over and that nobody reset; or the first that fails.
    pub fn step(
        &mut self,
        actions: Vec<E::Action>,
    ) -> Result<Vec<VectorTransition<E::Observation>>, VectorError> {
        self.same_count("actions", actions.len())?;
        let autoreset = self.config.autoreset;
        if let Some(index) =
            self.over.iter().position(|over| *over).filter(|_| autoreset == Autoreset::Disabled)
        {
            // found before anybody moves
            return Err(VectorError::Env { index, source: EnvError::NotReset });
        }
        let job = |action| Some(Job::Step { action, autoreset, options: self.options.clone() });
        let jobs = actions.into_iter().map(job).collect();
        Ok(self.crew.work(jobs, &mut self.over)?.into_iter().flatten().collect())
    }

    /// Looks at one of the environments, on its thread: to read statistics or to set moments, say.
    ///
    /// # Errors
    /// There is none of that index, it is gone since it panicked, or `look` panicked.
    pub fn visit<R: Send + 'static>(
        &mut self,
        index: usize,
        look: impl FnOnce(&mut E) -> R + Send + 'static,
    ) -> Result<R, VectorError> {
        let count = self.len();
        if index < count { self.crew.visit(index, look) } else { Err(VectorError::Index { index, count }) }
    }

    fn same_count(&self, what: &'static str, given: usize) -> Result<(), VectorError> {
        let count = self.len();
        if given == count { Ok(()) } else { Err(VectorError::Count { what, given, count }) }
    }
}
