//! The synchronous driver: minds, task, executors and dynamics in lockstep.
//!
//! A step runs in this order:
//! 1. minds decide on the frozen world; their intents are submitted and recorded;
//! 2. the simulation applies what was submitted;
//! 3. intents that the task answers go to the task, all others to the agent's planner; plans that are ready go to its executor, and actions to its body;
//! 4. the task decides; its commands take effect, its plans go to executors;
//! 5. executors act, one step of their plans each;
//! 6. dynamics move the world, the clock advances, a digest is taken if one is due.
//!
//! Only step 1 is outside the simulation, so a [replay](Episode::replay_step) leaves it out.

mod error;
mod gym;
mod snapshot;

pub use error::EpisodeError;
pub use gym::GymEpisode;
use simworld_core::action::Action;
use simworld_core::clock::Tick;
use simworld_core::command::Command;
use simworld_core::event::{Event, EventKind};
use simworld_core::hash::{StateDigest, StateHash, StateHasher};
use simworld_core::id::EntityId;
use simworld_core::intent::Intent;
use simworld_core::record::Recording;
use simworld_core::scene::Scene;
use simworld_core::seam::{
    Executor, Outcome, Plan, PlanError, Planner, Progress, Task, TaskContext, TaskOutput,
};
use simworld_core::seed::Seed;
use simworld_core::simulation::Simulation;
pub use snapshot::EpisodeSnapshot;

use crate::mind::Mind;

/// One agent: its body in the world, and what decides, plans and acts for it.
pub struct Agent<T: ?Sized> {
    /// Its body.
    pub id: EntityId,
    /// What decides.
    pub mind: Box<dyn Mind<T>>,
    /// What turns its sentences and calls into plans.
    pub planner: Box<dyn Planner>,
    /// What carries out its plans.
    pub executor: Box<dyn Executor>,
}

impl<T: ?Sized> Agent<T> {
    /// The plan of an intent: its own, if it is one already.
    fn planned(&mut self, intent: &Intent, scene: &dyn Scene) -> Result<Plan, PlanError> {
        intent.ready().map_or_else(|| self.planner.plan(intent, scene, self.id), Ok)
    }
}

/// A task being played by agents in a simulation.
pub struct Episode<T: Task> {
    simulation: Simulation,
    task: T,
    agents: Vec<Agent<T>>,
    ids: Vec<EntityId>,
    /// The bodies, ascending, each with its place in the list of agents.
    seats: Vec<(EntityId, usize)>,
    outcome: Outcome,
    failed: bool,
    returns: Vec<f64>,
    trail: Vec<(Tick, StateDigest)>,
    trail_interval: u64,
    /// The events of the last step, for the task.
    seen: Vec<Event>,
    spawned: Vec<EntityId>,
    // Buffers kept from step to step.
    output: TaskOutput,
    wanted: Vec<Intent>,
    decided: Vec<Command>,
    actions: Vec<Action>,
    intents: Vec<(EntityId, Intent)>,
}

impl<T: Task> Episode<T> {
    /// Begins an episode: the task is reset with the seed, and what it puts into the world takes effect.
    ///
    /// # Errors
    /// An agent without a body, or two with the same; the task refuses the scene, or the world refuses what the task
    /// wants in it.
    pub fn new(
        simulation: Simulation,
        task: T,
        agents: Vec<Agent<T>>,
        seed: Seed,
    ) -> Result<Self, EpisodeError> {
        let ids: Vec<EntityId> = agents.iter().map(|agent| agent.id).collect();
        let seats = seats(&ids, simulation.world())?;
        let mut episode = Self {
            returns: vec![0.0; ids.len()],
            simulation,
            task,
            agents,
            ids,
            seats,
            outcome: Outcome::default(),
            failed: false,
            trail: Vec::new(),
            trail_interval: 10,
            seen: Vec::new(),
            spawned: Vec::new(),
            output: TaskOutput::default(),
            wanted: Vec::new(),
            decided: Vec::new(),
            actions: Vec::new(),
            intents: Vec::new(),
        };
        episode.task.reset(episode.simulation.world(), &episode.ids, seed, &mut episode.output)?;
        episode.carry_out_task_output()?;
        Ok(episode)
    }

    /// Takes a digest every that many steps; 1 takes all, 0 none.
    pub fn set_trail_interval(&mut self, steps: u64) {
        self.trail_interval = steps;
    }

    /// One step with minds.
    ///
    /// # Errors
    /// A mind, the task, an executor or the dynamics failed: the episode is over, and its state is as it was when the
    /// fault occurred. If a mind failed, that is the state of the last finished step.
    pub fn step(&mut self) -> Result<&Outcome, EpisodeError> {
        self.check_running()?;
        let stepped = self.ask_minds().and_then(|()| self.step_inside());
        self.conclude(stepped)
    }

    /// One step in which no mind is asked: what was [submitted](Self::submit) takes effect, and nothing else from outside.
    ///
    /// # Errors
    /// As [`step`](Self::step), but for minds.
    pub fn step_without_minds(&mut self) -> Result<&Outcome, EpisodeError> {
        self.check_running()?;
        let stepped = self.step_inside();
        self.conclude(stepped)
    }

    /// One step without minds: what they wanted, and whatever else came from outside, is taken from the recording.
    ///
    /// # Errors
    /// As [`step`](Self::step).
    pub fn replay_step(&mut self, recording: &Recording) -> Result<&Outcome, EpisodeError> {
        self.check_running()?;
        let tick = self.simulation.world().clock().tick();
        for command in recording.commands_at(tick) {
            self.simulation.submit(command.clone());
        }
        self.step_without_minds()
    }

    /// Asks for a change from outside, beside the minds; it takes effect in the next step and is recorded.
    pub fn submit(&mut self, command: Command) {
        self.simulation.submit(command);
    }

    /// Whether the task came to an end, ran out of time, or something failed.
    pub fn is_over(&self) -> bool {
        self.outcome.terminated || self.outcome.truncated || self.failed
    }

    /// How the last step ended.
    pub fn outcome(&self) -> &Outcome {
        &self.outcome
    }

    /// The task.
    pub fn task(&self) -> &T {
        &self.task
    }

    /// The simulation.
    pub fn simulation(&self) -> &Simulation {
        &self.simulation
    }

    /// The agents' bodies, in the order of agents.
    pub fn agents(&self) -> &[EntityId] {
        &self.ids
    }

    /// The sum of each agent's rewards so far.
    pub fn returns(&self) -> &[f64] {
        &self.returns
    }

    /// What happened in the last step.
    pub fn events(&self) -> &[Event] {
        self.simulation.world().events()
    }

    /// The commands from outside and the trail of digests so far.
    pub fn recording(&self) -> Recording {
        Recording { commands: self.simulation.recording().commands.clone(), trail: self.trail.clone() }
    }

    /// The digests so far; the last is that of the last step for which one was due.
    pub fn trail(&self) -> &[(Tick, StateDigest)] {
        &self.trail
    }

    fn check_running(&self) -> Result<(), EpisodeError> {
        if self.is_over() { Err(EpisodeError::Over) } else { Ok(()) }
    }

    fn conclude(&mut self, stepped: Result<(), EpisodeError>) -> Result<&Outcome, EpisodeError> {
        self.failed = stepped.is_err();
        stepped.map(|()| &self.outcome)
    }

    /// All minds decide on the same frozen world; only when all have is anything submitted.
    fn ask_minds(&mut self) -> Result<(), EpisodeError> {
        let world = self.simulation.world();
        self.decided.clear();
        for agent in self.agents.iter_mut().filter(|agent| world.entity(agent.id).is_some()) {
            self.wanted.clear();
            agent.mind.notice(world.events(), agent.id);
            agent.mind.decide(&self.task, world, agent.id, &mut self.wanted)?;
            let intents = self.wanted.drain(..).map(|intent| Command::Intend { who: agent.id, intent });
            self.decided.extend(intents);
        }
        for command in self.decided.drain(..) {
            self.simulation.submit(command);
        }
        Ok(())
    }

    fn step_inside(&mut self) -> Result<(), EpisodeError> {
        self.seen.clear();
        self.seen.extend_from_slice(self.simulation.world().events());
        self.simulation.begin_step();
        self.route_intents();
        self.run_task()?;
        self.run_executors()?;
        self.simulation.finish_step()?;
        let now = self.simulation.world().clock().tick();
        if self.trail_interval > 0 && now.0.is_multiple_of(self.trail_interval) {
            self.trail.push((now, self.digest()));
        }
        Ok(())
    }

    /// Intents that the task does not answer are planned at once.
    fn route_intents(&mut self) {
        self.intents.clear();
        let calls = self.task.calls();
        for (who, intent) in self.simulation.world().intents().to_vec() {
            match intent {
                Intent::Call { ref name, .. } if calls.contains(&name.as_str()) => {
                    self.intents.push((who, intent));
                }
                Intent::Act(actions) if seat(&self.seats, who).is_some() => {
                    for action in actions {
                        actuate(&mut self.simulation, who, action);
                    }
                }
                _ => self.plan(who, &intent),
            }
        }
    }

    fn plan(&mut self, who: EntityId, intent: &Intent) {
        let world = self.simulation.world();
        let reason = match seat(&self.seats, who).map(|seat| &mut self.agents[seat]) {
            Some(agent) => match agent.planned(intent, world) {
                Ok(plan) => agent.executor.start(plan, world, who).err().map(|error| error.to_string()),
                Err(error) => Some(error.to_string()),
            },
            None => Some(format!("{who} is no agent of this episode")),
        };
        if let Some(reason) = reason {
            self.simulation.emit(EventKind::IntentRefused { who, reason });
        }
    }

    fn run_task(&mut self) -> Result<(), EpisodeError> {
        self.output.clear();
        self.outcome.rewards.clear();
        let context = TaskContext {
            scene: self.simulation.world(),
            agents: &self.ids,
            intents: &self.intents,
            events: &self.seen,
            spawned: &self.spawned,
        };
        self.task.step(&context, &mut self.output, &mut self.outcome)?;
        for (sum, reward) in self.returns.iter_mut().zip(&self.outcome.rewards) {
            *sum += reward;
        }
        self.carry_out_task_output()
    }

    fn carry_out_task_output(&mut self) -> Result<(), EpisodeError> {
        let mut output = std::mem::take(&mut self.output);
        self.spawned.clear();
        for event in output.events.drain(..) {
            self.simulation.emit(event);
        }
        for command in output.commands.drain(..) {
            match self.simulation.apply(&command) {
                Ok(applied) => self.spawned.extend(applied.spawned),
                Err(error) => match command {
                    // A body that cannot do something is a fact of the world; anything else is a fault of the task.
                    Command::Actuate { who, action } => {
                        let (action, reason) = (action.kind(), error.to_string());
                        self.simulation.emit(EventKind::ActionFailed { who, action, reason });
                    }
                    _ => return Err(EpisodeError::TaskCommand(error)),
                },
            }
        }
        for (who, plan) in output.plans.drain(..) {
            self.start(who, plan);
        }
        self.output = output;
        Ok(())
    }

    fn start(&mut self, who: EntityId, plan: Plan) {
        let world = self.simulation.world();
        let reason = match seat(&self.seats, who).map(|seat| &mut self.agents[seat]) {
            Some(agent) => agent.executor.start(plan, world, who).err().map(|error| error.to_string()),
            None => Some(format!("{who} is no agent of this episode")),
        };
        if let Some(reason) = reason {
            self.simulation.emit(EventKind::PlanFailed { who, reason });
        }
    }

    fn run_executors(&mut self) -> Result<(), EpisodeError> {
        for agent in &mut self.agents {
            self.actions.clear();
            if self.simulation.world().entity(agent.id).is_none() {
                // Whoever was taken out of the world has nothing left to do; its plan ends in silence with it.
                agent.executor.cancel(&mut self.actions);
                continue;
            }
            let progress = agent.executor.advance(self.simulation.world(), agent.id, &mut self.actions)?;
            let who = agent.id;
            self.actions.drain(..).for_each(|action| actuate(&mut self.simulation, who, action));
            match progress {
                Progress::Idle | Progress::Running => {}
                Progress::Begun { step } => self.simulation.emit(EventKind::StepBegun { who, step }),
                Progress::Rerouted { reason } => self.simulation.emit(EventKind::Rerouted { who, reason }),
                Progress::Done => self.simulation.emit(EventKind::PlanDone { who }),
                Progress::Failed { reason } => self.simulation.emit(EventKind::PlanFailed { who, reason }),
            }
        }
        Ok(())
    }
}

/// Has a body do something; that it cannot is told.
fn actuate(simulation: &mut Simulation, who: EntityId, action: Action) {
    let kind = action.kind();
    if let Err(error) = simulation.apply(&Command::Actuate { who, action }) {
        let reason = error.to_string();
        simulation.emit(EventKind::ActionFailed { who, action: kind, reason });
    }
}

/// Every agent has a body of its own; the bodies in ascending order.
fn seats(ids: &[EntityId], scene: &dyn Scene) -> Result<Vec<(EntityId, usize)>, EpisodeError> {
    if let Some(id) = ids.iter().find(|id| scene.entity(**id).is_none()) {
        let reason = "there is no such entity: spawn its body before the episode";
        return Err(EpisodeError::Agent { id: *id, reason });
    }
    let mut seats: Vec<(EntityId, usize)> = ids.iter().copied().zip(0..).collect();
    seats.sort_unstable();
    match seats.windows(2).find(|pair| pair[0].0 == pair[1].0) {
        Some(pair) => {
            let reason = "it was given twice: one agent a body";
            Err(EpisodeError::Agent { id: pair[0].0, reason })
        }
        None => Ok(seats),
    }
}

fn seat(seats: &[(EntityId, usize)], who: EntityId) -> Option<usize> {
    seats.binary_search_by_key(&who, |seat| seat.0).ok().map(|place| seats[place].1)
}

impl<T: Task> StateHash for Episode<T> {
    /// The simulation, the task and every executor; minds are outside.
    fn state_hash(&self, hasher: &mut StateHasher) {
        self.simulation.state_hash(hasher);
        self.task.state_hash(hasher);
        for agent in &self.agents {
            agent.executor.state_hash(hasher);
        }
    }
}
