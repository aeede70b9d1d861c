//! The environment: traffic whose signals are told what to do.

use std::collections::BTreeMap;
use std::sync::Arc;
use std::sync::atomic::{AtomicU32, Ordering};

use simworld_core::id::{EntityId, IntersectionId};
use simworld_core::net::RoadNetwork;
use simworld_core::seam::{
    EnvError, Info, Options, ParallelEnv, ParallelStart, ParallelStep, Space, SpaceError, SpaceValue,
    Transition,
};
use simworld_core::seed::Seed;
use simworld_core::value::Value;

use super::junction::{JunctionState, Watch};
use super::{DensityAndQueue, SignalEnvConfig, SignalObserver, SignalReward, WaitingTimeReward};
use crate::signal::{JunctionView, SignalPolicy};
use crate::{Traffic, TrafficError};

/// Signalised junctions as agents.
///
/// The agent of a junction is `EntityId::new(plan, 0)`, with the index of its plan in
/// [`RoadNetwork::signals`]; [`agents`](Self::agents) lists them. An action is the stage to show next, a discrete number; the
/// controller lets it come through the clearance, yellow and all-red of the plan, and while it does so actions are kept for
/// later. A junction without an action keeps its stage. Episodes are never terminated; they are truncated when their time
/// is over.
pub struct SignalEnv {
    network: Arc<RoadNetwork>,
    config: SignalEnvConfig,
    observer: Box<dyn SignalObserver + Send>,
    reward: Box<dyn SignalReward + Send>,
    wishes: Arc<Wishes>,
    watch: Watch,
    traffic: Option<Traffic>,
    seed: Seed,
}

/// The stage that every agent wants, by plan.
struct Wishes {
    junctions: Vec<IntersectionId>,
    stages: Vec<AtomicU32>,
}

/// No wish: the stage goes on.
const STAY: u32 = u32::MAX;

/// Carries out what the agents want.
struct Obedient {
    wishes: Arc<Wishes>,
    min_green: f64,
    max_green: f64,
}

impl SignalPolicy for Obedient {
    fn watches(&self) -> bool {
        false
    }

    fn next_stage(&mut self, junction: &JunctionView<'_>) -> usize {
        let plan = self.wishes.junctions.iter().position(|own| *own == junction.plan.intersection);
        let wish = plan.map_or(STAY, |plan| self.wishes.stages[plan].load(Ordering::Relaxed));
        if junction.elapsed + 1e-6 < self.min_green {
            return junction.current;
        }
        match wish as usize {
            stage if stage < junction.stages.len() && stage != junction.current => stage,
            _ if junction.elapsed >= self.max_green => junction.successor(),
            _ => junction.current,
        }
    }
}

impl SignalEnv {
    /// The signals of a network; an episode begins with [`reset`](ParallelEnv::reset).
    ///
    /// # Errors
    /// A setting out of range, or a flow whose route cannot be driven.
    pub fn new(network: Arc<RoadNetwork>, config: SignalEnvConfig) -> Result<Self, TrafficError> {
        config.validate()?;
        let junctions: Vec<IntersectionId> = network.signals.iter().map(|plan| plan.intersection).collect();
        let stages = junctions.iter().map(|_| AtomicU32::new(STAY)).collect();
        let mut env = Self {
            watch: Watch::new(&network),
            network,
            config,
            observer: Box::new(DensityAndQueue),
            reward: Box::new(WaitingTimeReward::default()),
            wishes: Arc::new(Wishes { junctions, stages }),
            traffic: None,
            seed: Seed(0),
        };
        // The number of stages, and with it the spaces, is known before the first episode.
        let traffic = env.build(Seed(0))?;
        env.watch.look(&traffic, env.config.min_green);
        Ok(env)
    }

    /// With another observation than sumo-rl's.
    #[must_use]
    pub fn with_observer(mut self, observer: impl SignalObserver + Send + 'static) -> Self {
        self.observer = Box::new(observer);
        self
    }

    /// With another reward than the difference of waiting times.
    #[must_use]
    pub fn with_reward(mut self, reward: impl SignalReward + Send + 'static) -> Self {
        self.reward = Box::new(reward);
        self
    }

    /// The agents, one a plan with stages.
    pub fn agents(&self) -> impl Iterator<Item = EntityId> + '_ {
        let plans = self.watch.junctions.iter().filter(|junction| junction.stages > 0);
        plans.map(|junction| EntityId::new(junction.plan as u32, 0))
    }

    /// The traffic of the episode; none before the first.
    pub fn traffic(&self) -> Option<&Traffic> {
        self.traffic.as_ref()
    }

    /// A junction, as it was after the last step.
    pub fn junction(&self, agent: EntityId) -> Option<&JunctionState> {
        let junction = self.watch.junctions.get(agent.index())?;
        (agent.generation() == 0 && junction.stages > 0).then_some(junction)
    }

    fn build(&self, seed: Seed) -> Result<Traffic, TrafficError> {
        let mut traffic = Traffic::new(Arc::clone(&self.network), &self.config.traffic, seed)?;
        for flow in &self.config.flows {
            traffic.add_flow(flow.clone())?;
        }
        let max_green = if self.config.enforce_max_green { self.config.max_green } else { f64::INFINITY };
        let wishes = Arc::clone(&self.wishes);
        traffic.set_policy(Box::new(Obedient { wishes, min_green: self.config.min_green, max_green }));
        Ok(traffic)
    }

    /// Takes up the wishes of agents.
    fn take_up(&self, actions: &BTreeMap<EntityId, SpaceValue>) -> Result<(), EnvError> {
        let checked: Result<Vec<(usize, u32)>, EnvError> = actions
            .iter()
            .map(|(who, action)| {
                let refused = |source| EnvError::Action { who: *who, source };
                let unknown = || SpaceError {
                    path: who.to_string(),
                    reason: "is no signalised junction of this network".to_owned(),
                };
                let junction = self.junction(*who).ok_or_else(|| refused(unknown()))?;
                action_space(junction).check(action).map_err(refused)?;
                let SpaceValue::Discrete(stage) = action else { return Ok((junction.plan, STAY)) };
                Ok((junction.plan, *stage as u32))
            })
            .collect();
        // All are checked before the first is taken up.
        for (plan, stage) in checked? {
            self.wishes.stages[plan].store(stage, Ordering::Relaxed);
        }
        Ok(())
    }

    fn transition(&mut self, plan: usize, truncated: bool) -> Transition<SpaceValue> {
        let junction = &self.watch.junctions[plan];
        let info = Info::from([
            ("waited".to_owned(), Value::Number(junction.waited())),
            ("queued".to_owned(), Value::Number(f64::from(junction.queued()))),
            ("average_speed".to_owned(), Value::Number(junction.average_speed())),
        ]);
        Transition {
            observation: self.observer.observe(junction),
            reward: self.reward.reward(junction),
            terminated: false,
            truncated,
            info,
        }
    }
}

fn action_space(junction: &JunctionState) -> Space {
    Space::discrete(junction.stages as u64)
}

impl ParallelEnv for SignalEnv {
    type Observation = SpaceValue;
    type Action = SpaceValue;

    /// There are no options.
    fn reset(
        &mut self,
        seed: Option<Seed>,
        options: &Options,
    ) -> Result<ParallelStart<SpaceValue>, EnvError> {
        EnvError::refuse_unknown(options, &[])?;
        // Without a seed every episode differs from the last, and all follow from the first.
        self.seed = seed.unwrap_or_else(|| self.seed.stream("gym/next").seed());
        for wish in &self.wishes.stages {
            wish.store(STAY, Ordering::Relaxed);
        }
        let traffic = self.build(self.seed).map_err(|error| EnvError::Simulation(error.to_string()))?;
        self.watch = Watch::new(&self.network);
        self.watch.look(&traffic, self.config.min_green);
        self.traffic = Some(traffic);
        self.reward.reset(self.watch.junctions.len());
        let seen = |id: EntityId| Some((id, (self.observer.observe(self.junction(id)?), Info::new())));
        Ok(self.agents().filter_map(seen).collect())
    }

    fn step(
        &mut self,
        actions: &BTreeMap<EntityId, SpaceValue>,
    ) -> Result<ParallelStep<SpaceValue>, EnvError> {
        let SignalEnvConfig { dt, delta_time, seconds, min_green, .. } = self.config;
        if self.traffic.as_ref().is_none_or(|traffic| traffic.seconds() + 1e-6 >= seconds) {
            return Err(EnvError::NotReset);
        }
        self.take_up(actions)?;
        let Some(traffic) = &mut self.traffic else { return Err(EnvError::NotReset) };
        let until = (traffic.seconds() + delta_time).min(seconds);
        while traffic.seconds() + 1e-6 < until {
            traffic.step(dt);
            self.watch.tick(traffic, dt);
        }
        self.watch.look(traffic, min_green);
        let truncated = traffic.seconds() + 1e-6 >= seconds;
        let agents: Vec<EntityId> = self.agents().collect();
        Ok(agents.into_iter().map(|id| (id, self.transition(id.index(), truncated))).collect())
    }

    fn spaces(&self, agent: EntityId) -> (Space, Space) {
        let none = JunctionState::default();
        let junction = self.junction(agent).unwrap_or(&none);
        (self.observer.space(junction), action_space(junction))
    }
}
