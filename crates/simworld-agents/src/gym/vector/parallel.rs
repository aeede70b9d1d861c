//! Many environments of several agents stepped together.

use std::collections::{BTreeMap, BTreeSet};

use simworld_core::id::EntityId;
use simworld_core::seam::{
    Env, EnvError, Info, Options, ParallelEnv, ParallelStart, ParallelStep, Space, Transition,
};
use simworld_core::seed::Seed;

use super::{Boundary, VectorConfig, VectorEnv, VectorError, VectorTransition};

/// What came of a step of one of the environments.
#[derive(Clone, Debug, PartialEq)]
pub struct ParallelVectorStep<O> {
    /// What `step` gave, the last transitions of an episode included. Empty where the step began an episode in place of its own
    /// actions, which were passed over ([`Autoreset::NextStep`](simworld_core::seam::Autoreset::NextStep)).
    pub transitions: ParallelStep<O>,
    /// With what an episode began in this step, if one did: in place of the actions, or behind the last transitions of the one
    /// before ([`Autoreset::SameStep`](simworld_core::seam::Autoreset::SameStep)).
    pub begun: Option<ParallelStart<O>>,
}

/// What an environment of several agents gives: they are told by the first step of an episode, not by the environment.
enum Given<O> {
    Start(ParallelStart<O>),
    Step(ParallelStep<O>),
}

/// An environment of several agents as one of a single agent, who acts for all; its episode is over when everybody's is.
struct Together<E> {
    env: E,
    /// Whose episode goes on.
    present: BTreeSet<EntityId>,
}

impl<E: ParallelEnv> Env for Together<E> {
    type Observation = Given<E::Observation>;
    type Action = BTreeMap<EntityId, E::Action>;

    fn reset(
        &mut self,
        seed: Option<Seed>,
        options: &Options,
    ) -> Result<(Self::Observation, Info), EnvError> {
        let start = self.env.reset(seed, options)?;
        self.present = start.keys().copied().collect();
        Ok((Given::Start(start), Info::new()))
    }

    fn step(&mut self, actions: &Self::Action) -> Result<Transition<Self::Observation>, EnvError> {
        let step = self.env.step(actions)?;
        for (id, transition) in &step {
            if transition.is_last() {
                self.present.remove(id);
            }
        }
        let (terminated, info) = (self.present.is_empty(), Info::new());
        Ok(Transition { observation: Given::Step(step), reward: 0.0, terminated, truncated: false, info })
    }

    /// Agents have spaces each; all that is compared here is that there are none.
    fn spaces(&self) -> (Space, Space) {
        (Space::discrete(1), Space::discrete(1))
    }
}

/// Many environments of several agents, stepped together and each by itself: what one does is the same on any number of
/// threads. What holds for a [`VectorEnv`] holds for it; an episode ends when that of its last agent does.
///
/// ```
/// # use std::collections::BTreeMap;
/// # use simworld_core::id::EntityId;
/// # use simworld_core::seam::{EnvError, Info, Options, ParallelEnv, ParallelStart, ParallelStep, Space, SpaceValue, Transition};
/// use simworld_agents::gym::{ParallelVectorEnv, VectorConfig};
/// use simworld_core::seed::Seed;
/// # /// Two who count up to three.
/// # struct Count(i64);
/// # impl ParallelEnv for Count {
/// #     type Observation = i64;
/// #     type Action = ();
/// #     fn reset(&mut self, _: Option<Seed>, _: &Options) -> Result<ParallelStart<i64>, EnvError> {
/// #         self.0 = 0;
/// #         Ok((0..2).map(|index| (EntityId::new(index, 0), (0, Info::new()))).collect())
/// #     }
/// #     fn step(&mut self, actions: &BTreeMap<EntityId, ()>) -> Result<ParallelStep<i64>, EnvError> {
/// #         self.0 += 1;
/// #         let (observation, terminated) = (self.0, self.0 == 3);
/// #         let one = Transition { observation, reward: 1.0, terminated, truncated: false, info: Info::new() };
/// #         Ok(actions.keys().map(|id| (*id, one.clone())).collect())
/// #     }
/// #     fn spaces(&self, _: EntityId) -> (Space, Space) { (Space::discrete(4), Space::discrete(1)) }
/// # }
/// let config = VectorConfig { threads: 2.try_into()?, ..VectorConfig::default() };
/// let mut games = ParallelVectorEnv::new(4, config, |_index| Ok(Count(0)))?;
/// let begun = games.reset(Some(Seed(1)), &Options::new())?;
/// let actions: Vec<BTreeMap<EntityId, ()>> =
///     begun.iter().map(|start| start.keys().map(|agent| (*agent, ())).collect()).collect();
/// for _ in 0..3 { games.step(actions.clone())?; }
/// let next = games.step(actions)?;
/// assert!(next.iter().all(|game| game.transitions.is_empty() && game.begun.is_some()));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct ParallelVectorEnv<E: ParallelEnv> {
    vector: VectorEnv<Together<E>>,
}

impl<E> ParallelVectorEnv<E>
where
    E: ParallelEnv + 'static,
    E::Observation: Send + 'static,
    E::Action: Send + 'static,
{
    /// So many environments; `make` is called once for each, with its index.
    ///
    /// # Errors
    /// One cannot be made, or a thread cannot be started.
    pub fn new(
        count: usize,
        config: VectorConfig,
        make: impl Fn(usize) -> Result<E, EnvError> + Send + Sync + 'static,
    ) -> Result<Self, VectorError> {
        let together = move |index| Ok(Together { env: make(index)?, present: BTreeSet::new() });
        Ok(Self { vector: VectorEnv::new(count, config, together)? })
    }

    /// How many environments there are.
    pub fn len(&self) -> usize {
        self.vector.len()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.vector.is_empty()
    }

    /// The spaces of observations and actions of an agent of one of the environments.
    ///
    /// # Errors
    /// There is no environment of that index, it is gone since it panicked, or it panicked now.
    pub fn spaces(&mut self, index: usize, agent: EntityId) -> Result<(Space, Space), VectorError> {
        self.visit(index, move |env| env.spaces(agent))
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
    ) -> Result<Vec<ParallelStart<E::Observation>>, VectorError> {
        Ok(self.vector.reset(seed, options)?.into_iter().filter_map(|(given, _)| given.start()).collect())
    }

    /// Begins an episode in those that are marked; the others, for which there is no answer, go on.
    ///
    /// # Errors
    /// The first environment that cannot, or another number of marks.
    pub fn reset_marked(
        &mut self,
        marks: &[bool],
        seed: Option<Seed>,
    ) -> Result<Vec<Option<ParallelStart<E::Observation>>>, VectorError> {
        let begun = self.vector.reset_marked(marks, seed)?;
        Ok(begun.into_iter().map(|begun| begun.and_then(|(given, _)| given.start())).collect())
    }

    /// The actions of the agents of each.
    ///
    /// # Errors
    /// Another number of maps of actions; an environment whose episode is over and that nobody reset; or the first that fails.
    pub fn step(
        &mut self,
        actions: Vec<BTreeMap<EntityId, E::Action>>,
    ) -> Result<Vec<ParallelVectorStep<E::Observation>>, VectorError> {
        Ok(self.vector.step(actions)?.into_iter().map(ParallelVectorStep::of).collect())
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
        self.vector.visit(index, |together| look(&mut together.env))
    }
}

impl<O> Given<O> {
    fn start(self) -> Option<ParallelStart<O>> {
        if let Self::Start(start) = self { Some(start) } else { None }
    }
}

impl<O> ParallelVectorStep<O> {
    fn of(step: VectorTransition<Given<O>>) -> Self {
        let VectorTransition { transition, boundary } = step;
        let last = match boundary {
            Boundary::Passed { observation: Given::Step(last), .. } => Some(last),
            _ => None,
        };
        match transition.observation {
            Given::Step(transitions) => Self { transitions, begun: None },
            Given::Start(start) => Self { transitions: last.unwrap_or_default(), begun: Some(start) },
        }
    }
}
