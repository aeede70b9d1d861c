//! A mind that plans for itself.

use simworld_core::event::{Event, EventKind};
use simworld_core::id::EntityId;
use simworld_core::intent::Intent;
use simworld_core::scene::Scene;
use simworld_core::seam::Planner;

use super::{Mind, MindError};

/// A mind with a planner of its own: what it wants is planned where it thinks, and goes out as [`Intent::Plan`].
///
/// At its own pace ([`asynchronous`](crate::asynchronous)) the world so never waits for a planner that asks a model; and the plan
/// is what is recorded, so that a replay asks neither. What cannot be planned is told to the mind as
/// [`EventKind::IntentRefused`], before it decides the next time, and to nobody else.
pub struct PlanningMind<M, P> {
    mind: M,
    planner: P,
    /// Calls that the task answers itself.
    calls: &'static [&'static str],
    /// What was refused and is not told yet.
    refused: Vec<Event>,
    wanted: Vec<Intent>,
}

impl<M, P: Planner> PlanningMind<M, P> {
    /// A mind, and what plans what it wants.
    pub fn new(mind: M, planner: P) -> Self {
        Self { mind, planner, calls: &[], refused: Vec::new(), wanted: Vec::new() }
    }

    /// Leaves calls of these names as they are: those that the task answers ([`Task::calls`](simworld_core::seam::Task::calls)).
    #[must_use]
    pub fn leaving(mut self, calls: &'static [&'static str]) -> Self {
        self.calls = calls;
        self
    }

    /// The mind within.
    pub fn mind(&self) -> &M {
        &self.mind
    }
}

impl<T: ?Sized, M: Mind<T>, P: Planner> Mind<T> for PlanningMind<M, P> {
    fn decide(
        &mut self,
        task: &T,
        scene: &dyn Scene,
        who: EntityId,
        out: &mut Vec<Intent>,
    ) -> Result<(), MindError> {
        if !self.refused.is_empty() {
            self.mind.notice(&self.refused, who);
            self.refused.clear();
        }
        self.wanted.clear();
        self.mind.decide(task, scene, who, &mut self.wanted)?;
        for intent in self.wanted.drain(..) {
            if matches!(&intent, Intent::Call { name, .. } if self.calls.contains(&name.as_str())) {
                out.push(intent);
                continue;
            }
            match self.planner.plan(&intent, scene, who) {
                Ok(plan) => out.push(Intent::Plan(plan)),
                Err(error) => {
                    let kind = EventKind::IntentRefused { who, reason: error.to_string() };
                    self.refused.push(Event { tick: scene.clock().tick(), kind });
                }
            }
        }
        Ok(())
    }

    fn notice(&mut self, events: &[Event], who: EntityId) {
        self.mind.notice(events, who);
    }

    fn save(&self) -> Vec<u8> {
        // Plain data, which postcard always takes.
        postcard::to_stdvec(&(&self.refused, self.mind.save())).expect("plain data serialises")
    }

    fn restore(&mut self, saved: &[u8]) -> bool {
        let Ok((refused, mind)) = postcard::from_bytes::<(Vec<Event>, Vec<u8>)>(saved) else { return false };
        self.refused = refused;
        self.mind.restore(&mind)
    }
}
