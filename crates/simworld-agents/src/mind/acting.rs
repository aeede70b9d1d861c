//! A mind that carries out plans itself.

use simworld_core::action::Action;
use simworld_core::event::{Event, EventKind};
use simworld_core::id::EntityId;
use simworld_core::intent::Intent;
use simworld_core::scene::Scene;
use simworld_core::seam::{Executor, Plan, Progress};

use super::{Mind, MindError};

/// A mind with an executor of its own: plans that it wants are carried out where it thinks, and what goes out are the actions of its
/// body, as [`Intent::Act`].
///
/// At its own pace ([`asynchronous`](crate::asynchronous)) the world so never waits for an executor that asks a model, such as one
/// that steers by pictures; and the actions are what is recorded. What becomes of a plan is told to the mind as an episode would
/// ([`EventKind::StepBegun`], [`EventKind::PlanDone`] and so on), before it decides the next time, and to nobody else.
pub struct ActingMind<M, E> {
    mind: M,
    executor: E,
    /// Whether a plan is under way.
    acts: bool,
    /// What became of its plans and is not told yet.
    news: Vec<Event>,
    wanted: Vec<Intent>,
    actions: Vec<Action>,
}

impl<M, E: Executor> ActingMind<M, E> {
    /// A mind, and what carries out its plans; intents that are no plans go out as they are.
    pub fn new(mind: M, executor: E) -> Self {
        Self { mind, executor, acts: false, news: Vec::new(), wanted: Vec::new(), actions: Vec::new() }
    }

    /// The mind within.
    pub fn mind(&self) -> &M {
        &self.mind
    }

    fn tell(&mut self, scene: &dyn Scene, kind: EventKind) {
        self.news.push(Event { tick: scene.clock().tick(), kind });
    }

    /// Takes up a plan in place of the one under way.
    fn start(&mut self, plan: Plan, scene: &dyn Scene, who: EntityId) {
        match self.executor.start(plan, scene, who) {
            Ok(()) => self.acts = true,
            Err(error) => self.tell(scene, EventKind::IntentRefused { who, reason: error.to_string() }),
        }
    }

    /// Goes on with the plan under way; its actions are appended.
    fn advance(&mut self, scene: &dyn Scene, who: EntityId) -> Result<(), MindError> {
        let progress = self
            .executor
            .advance(scene, who, &mut self.actions)
            .map_err(|error| MindError { who, reason: error.to_string() })?;
        self.acts = progress.goes_on();
        match progress {
            Progress::Idle | Progress::Running => {}
            Progress::Begun { step } => self.tell(scene, EventKind::StepBegun { who, step }),
            Progress::Rerouted { reason } => self.tell(scene, EventKind::Rerouted { who, reason }),
            Progress::Done => self.tell(scene, EventKind::PlanDone { who }),
            Progress::Failed { reason } => self.tell(scene, EventKind::PlanFailed { who, reason }),
        }
        Ok(())
    }
}

impl<T: ?Sized, M: Mind<T>, E: Executor> Mind<T> for ActingMind<M, E> {
    fn decide(
        &mut self,
        task: &T,
        scene: &dyn Scene,
        who: EntityId,
        out: &mut Vec<Intent>,
    ) -> Result<(), MindError> {
        if !self.news.is_empty() {
            self.mind.notice(&self.news, who);
            self.news.clear();
        }
        self.wanted.clear();
        self.mind.decide(task, scene, who, &mut self.wanted)?;
        for intent in std::mem::take(&mut self.wanted) {
            match intent {
                Intent::Plan(plan) => self.start(plan, scene, who),
                other => out.push(other),
            }
        }
        if self.acts {
            self.advance(scene, who)?;
        }
        if !self.actions.is_empty() {
            out.push(Intent::Act(std::mem::take(&mut self.actions)));
        }
        Ok(())
    }

    fn notice(&mut self, events: &[Event], who: EntityId) {
        self.mind.notice(events, who);
    }

    fn save(&self) -> Vec<u8> {
        let parts = (self.acts, &self.news, self.mind.save(), self.executor.save());
        // Plain data, which postcard always takes.
        postcard::to_stdvec(&parts).expect("plain data serialises")
    }

    fn restore(&mut self, saved: &[u8]) -> bool {
        type Saved = (bool, Vec<Event>, Vec<u8>, Vec<u8>);
        let Ok((acts, news, mind, executor)) = postcard::from_bytes::<Saved>(saved) else {
            return false;
        };
        (self.acts, self.news) = (acts, news);
        self.mind.restore(&mind) && self.executor.restore(&executor)
    }
}
