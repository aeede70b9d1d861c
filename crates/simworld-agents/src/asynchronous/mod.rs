//! The asynchronous driver: each mind in a thread of its own, at its own pace, and a world that waits for none.
//!
//! A mind takes the newest snapshot of the world from a central buffer, thinks as long as it likes, and hands in what it wants.
//! The world steps on meanwhile. At a fixed interval it gathers what was handed in, stamps it with the tick that uses it,
//! and records it; so the recording of an asynchronous run replays in lockstep, without minds, to the same digests:
//! [`Episode::replay_step`].
//!
//! The world never waits for a mind: it looks whether something was handed in, and swaps a pointer for a new snapshot only if
//! somebody wants one and nobody is reading the old pointer at that very moment. What plans and acts for an agent within the world
//! is waited for, as in lockstep: a planner or an executor that asks a model belongs into the mind ([`PlanningMind`](crate::mind::PlanningMind),
//! [`ActingMind`](crate::mind::ActingMind)). What happened while a mind thought it is told in
//! order before it thinks again ([`Mind::notice`]). One that fails or panics is dead, and its body goes on with the plan it has.
//!
//! A thought cannot be ended from outside, for nothing ends a thread but itself: one that never ends keeps its thread and its mind for as
//! long as the process lives. It keeps nothing else. The world does not wait for it, and neither does the end of the run, which waits
//! for [`AsynchronousConfig::patience`] and then lets it go, named in [`Ending::still_thinking`]; what it hands in after that is
//! refused. A mind that asks others should give up by itself: models behind servers
//! have timeouts, and retries a limit of time.
//!
//! Nothing handed in is lost or used twice: each intent ends as [`Fate::Applied`], [`Fate::Late`] or [`Fate::Refused`], with a
//! [`Receipt`].

mod account;
mod buffer;
mod config;
mod life;
mod pacer;

use std::collections::VecDeque;
use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::sync::mpsc::Receiver;
use std::time::Duration;

pub use account::{Accounts, Fate, Receipt};
pub use config::{AsynchronousConfig, AsynchronousError, Pace};
pub use pacer::PaceReport;
use simworld_core::clock::Tick;
use simworld_core::command::Command;
use simworld_core::id::EntityId;
use simworld_core::scene::{Scene, World};
use simworld_core::seam::{Outcome, Task};

use crate::episode::{Episode, EpisodeError};
use crate::mind::Mind;
use account::Books;
use buffer::{Buffer, Happened, Snapshot};
use life::{Life, Message};
use pacer::Pacer;

/// A mind that may think in another thread; `V` is what it knows of the task.
pub type FreeMind<V> = Box<dyn Mind<V> + Send>;

/// What a mind is doing.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum MindState {
    /// It waits for a newer snapshot.
    Waiting,
    /// It thinks about the snapshot of that tick.
    Thinking {
        /// The tick that it saw.
        seen: Tick,
    },
    /// It failed or panicked, and decides nothing any more.
    Dead {
        /// In its own words.
        reason: String,
    },
}

/// How an asynchronous run ended.
#[derive(Clone, Debug, PartialEq)]
pub struct Ending {
    /// The intents of which nobody has asked yet what became of them.
    pub receipts: Vec<Receipt>,
    /// How the ticks kept their time.
    pub pace: PaceReport,
    /// Those that still thought when the patience was over. Their threads end by themselves after the thought;
    /// [`Accounts`] counts what they then hand in as refused.
    pub still_thinking: Vec<EntityId>,
}

/// An episode whose minds think at their own pace.
///
/// ```
/// use std::time::Duration;
/// use simworld_agents::asynchronous::{AsynchronousConfig, AsynchronousEpisode, FreeMind, Pace};
/// # use simworld_agents::episode::{Agent, Episode};
/// # use simworld_agents::executor::RuleExecutor;
/// # use simworld_agents::language::GrammarPlanner;
/// # use simworld_agents::mind::{Mind, MindError, Silent};
/// # use simworld_core::geometry::{Point3, pose_facing};
/// # use simworld_core::hash::StateHasher;
/// # use simworld_core::id::EntityId;
/// # use simworld_core::intent::Intent;
/// # use simworld_core::kinematic::{KinematicBody, KinematicDynamics};
/// # use simworld_core::scene::{EntityDesc, EntityKind, Scene, Shape, World};
/// # use simworld_core::seam::{Metric, Outcome, Task, TaskContext, TaskError, TaskOutput};
/// # use simworld_core::seed::Seed;
/// # use simworld_core::simulation::Simulation;
/// # #[derive(Clone)]
/// # struct Stroll;
/// # impl Task for Stroll {
/// #     fn reset(&mut self, _: &dyn Scene, _: &[EntityId], _: Seed, _: &mut TaskOutput) -> Result<(), TaskError> { Ok(()) }
/// #     fn step(&mut self, _: &TaskContext<'_>, _: &mut TaskOutput, _: &mut Outcome) -> Result<(), TaskError> { Ok(()) }
/// #     fn metrics(&self) -> Vec<Metric> { Vec::new() }
/// #     fn save(&self) -> Vec<u8> { Vec::new() }
/// #     fn restore(&mut self, _: &[u8]) -> bool { true }
/// #     fn state_hash(&self, _: &mut StateHasher) {}
/// # }
/// # let mut world = World::new();
/// # let pose = pose_facing(Point3::origin(), 0.0);
/// # let walker = world.spawn(EntityDesc::new(EntityKind::Person, pose, Shape::Capsule { radius: 0.25, height: 1.8 }))?;
/// # let mut bodies = KinematicDynamics::new();
/// # bodies.insert(walker, Box::new(KinematicBody::walker(pose)));
/// # let mut simulation = Simulation::new(world);
/// # simulation.add_dynamics("bodies", Box::new(bodies));
/// # let agent = Agent { id: walker, mind: Box::new(Silent) as Box<dyn Mind<Stroll>>,
/// #     planner: Box::new(GrammarPlanner::default()), executor: Box::new(RuleExecutor::straight()) };
/// # let episode = Episode::new(simulation, Stroll, vec![agent], Seed(1))?;
/// /// Thinks for a while, and then wants to go somewhere.
/// struct Slow;
///
/// impl<T> Mind<T> for Slow {
///     fn decide(&mut self, _: &T, scene: &dyn Scene, _: EntityId, out: &mut Vec<Intent>) -> Result<(), MindError> {
///         std::thread::sleep(Duration::from_millis(5));
///         out.push(Intent::Words(format!("go to ({}, 0)", scene.clock().tick().0 + 5)));
///         Ok(())
///     }
/// }
///
/// let minds: Vec<(EntityId, FreeMind<Stroll>)> = vec![(walker, Box::new(Slow))];
/// let config = AsynchronousConfig { pace: Pace::RealTime { factor: 20.0 }, ..AsynchronousConfig::default() };
/// let mut run = AsynchronousEpisode::new(episode, minds, config, Stroll::clone)?;
/// for _ in 0..20 {
///     run.step()?; // 5 ms each: twenty times as fast as life
/// }
/// let (episode, _ending) = run.finish();
/// assert!(!episode.recording().commands.is_empty());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct AsynchronousEpisode<T: Task, V> {
    /// None once it was handed back.
    episode: Option<Episode<T>>,
    /// What minds are told of the task.
    share: Box<dyn Fn(&T) -> V>,
    buffer: Arc<Buffer<V>>,
    lives: Vec<Life>,
    handed_in: Option<Receiver<Message>>,
    books: Books,
    pacer: Pacer,
    /// Steps from one gathering to the next.
    interval: u64,
    max_age: Option<u64>,
    history: VecDeque<Happened>,
    /// The greatest length of the history.
    longest: usize,
    patience: Duration,
}

impl<T: Task, V: Send + Sync + 'static> AsynchronousEpisode<T, V> {
    /// Gives each of the agents named a mind in a thread of its own, which begins to think at once. The episode's own minds are
    /// not asked any more. `share` makes what minds know of the task; for a task that can be cloned, its `clone`.
    ///
    /// # Errors
    /// A setting out of range, a mind for nobody or a second one for the same, or a thread that cannot be started.
    pub fn new(
        episode: Episode<T>,
        minds: Vec<(EntityId, FreeMind<V>)>,
        config: AsynchronousConfig,
        share: impl Fn(&T) -> V + 'static,
    ) -> Result<Self, AsynchronousError> {
        config.validate()?;
        let clock = episode.simulation().world().clock();
        let in_steps = |seconds: f64| (seconds / clock.dt()).round() as u64;
        let world = episode.simulation().world().clone();
        let history = VecDeque::from_iter(happened(&world));
        let first = Snapshot { notes: share(episode.task()), world, history: history.clone() };
        let buffer = Arc::new(Buffer::new(first));
        let (hand_in, handed_in) = std::sync::mpsc::channel();
        let books = Books::new(minds.len());
        let mut run = Self {
            episode: Some(episode),
            share: Box::new(share),
            buffer,
            lives: Vec::with_capacity(minds.len()),
            handed_in: Some(handed_in),
            books,
            pacer: Pacer::new(config.pace, clock),
            interval: in_steps(config.gather).max(1),
            max_age: config.max_age.map(in_steps),
            history,
            longest: config.history,
            patience: config.patience,
        };
        for (who, mind) in minds {
            run.check_agent(who)?;
            let index = run.lives.len();
            let (buffer, accounts) = (Arc::clone(&run.buffer), run.books.accounts());
            run.lives.push(Life::begin(index, who, mind, buffer, hand_in.clone(), accounts)?);
        }
        Ok(run)
    }

    fn check_agent(&self, who: EntityId) -> Result<(), AsynchronousError> {
        let is_agent = self.episode.as_ref().is_some_and(|episode| episode.agents().contains(&who));
        let reason = if !is_agent {
            "it is no agent of the episode"
        } else if self.lives.iter().any(|life| life.who == who) {
            "it has one already"
        } else {
            return Ok(());
        };
        Err(AsynchronousError::Mind { who, reason })
    }

    /// One step of the world: waits for its time, gathers if it is time for that, steps, and shows the new state to those who
    /// wait for one.
    ///
    /// # Errors
    /// As [`Episode::step`], but never because of a mind.
    pub fn step(&mut self) -> Result<&Outcome, EpisodeError> {
        let episode = self.episode.as_ref().ok_or(EpisodeError::Over)?;
        if episode.is_over() {
            return Err(EpisodeError::Over);
        }
        self.pacer.wait();
        self.gather();
        let episode = self.episode.as_mut().ok_or(EpisodeError::Over)?;
        episode.step_without_minds()?;
        self.publish();
        // it was there a moment ago
        self.episode.as_ref().map(Episode::outcome).ok_or(EpisodeError::Over)
    }

    /// Asks for a change from outside, beside the minds; it takes effect in the next step and is recorded.
    pub fn submit(&mut self, command: Command) {
        if let Some(episode) = &mut self.episode {
            episode.submit(command);
        }
    }

    /// Takes what minds have handed in, if this is a step for that.
    fn gather(&mut self) {
        let (Some(episode), Some(handed_in)) = (&mut self.episode, &self.handed_in) else { return };
        let now = episode.simulation().world().clock().tick();
        if !now.0.is_multiple_of(self.interval) {
            return;
        }
        while let Ok(message) = handed_in.try_recv() {
            let (index, seen, intents) = match message {
                Message::Wants { index, seen, intents } => (index, seen, intents),
                Message::Died { index, reason } => {
                    self.lives[index].death = Some(reason);
                    continue;
                }
            };
            let who = self.lives[index].who;
            let age = now.0.saturating_sub(seen.0);
            for intent in intents {
                let fate = if episode.simulation().world().entity(who).is_none() {
                    Fate::Refused { reason: "its body is in the world no more" }
                } else if self.max_age.is_some_and(|most| age > most) {
                    Fate::Late { tick: now }
                } else {
                    episode.submit(Command::Intend { who, intent });
                    Fate::Applied { tick: now }
                };
                self.books.enter(index, who, seen, fate);
            }
        }
    }

    /// Shows the state after the step to those who wait for one; nobody else makes it worth the copy.
    fn publish(&mut self) {
        let Some(episode) = &self.episode else { return };
        self.history.extend(happened(episode.simulation().world()));
        while self.history.len() > self.longest {
            self.history.pop_front();
        }
        if self.lives.iter().any(Life::is_waiting) {
            let world = episode.simulation().world().clone();
            let notes = (self.share)(episode.task());
            let snapshot = Snapshot { notes, world, history: self.history.clone() };
            if self.buffer.offer(snapshot) {
                self.lives.iter().for_each(Life::wake);
            }
        }
    }

    /// The episode.
    ///
    /// # Panics
    /// Never: it is handed back only by [`finish`](Self::finish), which takes the run.
    pub fn episode(&self) -> &Episode<T> {
        self.episode.as_ref().expect("the episode is there until the run is taken")
    }

    /// What each mind is doing.
    pub fn minds(&self) -> impl Iterator<Item = (EntityId, MindState)> + '_ {
        self.lives.iter().map(|life| (life.who, life.state()))
    }

    /// What became of intents since the last time somebody asked.
    pub fn take_receipts(&mut self) -> Vec<Receipt> {
        self.books.take()
    }

    /// How many intents had which fate; it goes on to count when the run is over.
    pub fn accounts(&self) -> Arc<Accounts> {
        self.books.accounts()
    }

    /// How the ticks kept their time.
    pub fn pace(&self) -> &PaceReport {
        self.pacer.report()
    }

    /// Ends the run: minds are told to stop, and waited for as long as the patience lasts. What was handed in and not gathered is refused.
    pub fn finish(mut self) -> (Episode<T>, Ending) {
        let still_thinking = self.close();
        let ending =
            Ending { receipts: self.books.take(), pace: self.pacer.report().clone(), still_thinking };
        let episode = self.episode.take().expect("the episode is there until the run is taken");
        (episode, ending)
    }
}

impl<T: Task, V> AsynchronousEpisode<T, V> {
    /// Tells minds to stop, waits for them, and refuses what is left. Says who still thinks.
    fn close(&mut self) -> Vec<EntityId> {
        self.buffer.close();
        self.lives.iter().for_each(Life::wake);
        let deadline = pacer::now() + self.patience;
        while self.lives.iter().any(|life| !life.has_ended()) && pacer::now() < deadline {
            std::thread::sleep(Duration::from_millis(1));
        }
        let still_thinking =
            self.lives.iter().filter(|life| !life.has_ended()).map(|life| life.who).collect();
        self.lives.iter_mut().for_each(Life::join);
        // Dropped at the end of the block: whoever hands in later counts it as refused itself.
        if let Some(handed_in) = self.handed_in.take() {
            while let Ok(message) = handed_in.try_recv() {
                match message {
                    Message::Wants { index, seen, intents } => {
                        let who = self.lives[index].who;
                        for _ in intents {
                            self.books.enter(index, who, seen, Fate::Refused { reason: account::OVER });
                        }
                    }
                    Message::Died { index, reason } => self.lives[index].death = Some(reason),
                }
            }
        }
        still_thinking
    }
}

impl<T: Task, V> Drop for AsynchronousEpisode<T, V> {
    /// Waits for minds as [`finish`](AsynchronousEpisode::finish) does.
    fn drop(&mut self) {
        if !self.buffer.closed.load(Ordering::SeqCst) {
            self.close();
        }
    }
}

/// What happened in the last step, if anything did.
fn happened(world: &World) -> Option<Happened> {
    let events = world.events();
    (!events.is_empty()).then(|| (world.clock().tick(), events.into()))
}
