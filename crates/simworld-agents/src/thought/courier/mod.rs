//! A courier that thinks with a model, over the calls of the delivery economy.

mod menu;

use std::collections::VecDeque;
use std::sync::Arc;

use menu::{CALLS, CourierMenu};
use serde::{Deserialize, Serialize};
use simworld_core::event::{Event, EventKind};
use simworld_core::id::EntityId;
use simworld_core::intent::Intent;
use simworld_core::scene::Scene;

use super::persona::{Character, Persona};
use super::prompts::{Prompt, Prompts, one_line};
use super::reasoner::{ModelReasoner, Question, ReasonError, Reasoner};
use crate::delivery::{CourierAction, DeliveryTask};
use crate::mind::{Mind, MindError};
use crate::model::ChatModel;

/// Longest time between two thoughts, s: that of the couriers without a model.
const INTERVAL: f64 = 5.0;
/// Shortest, s: news that come sooner are thought of together.
const PAUSE: f64 = 1.0;
/// The most lines of news that are kept.
const NEWS: usize = 8;
/// Answers in a row that cannot be used before the mind fails.
const FAULTS: u32 = 3;

/// A courier whose decisions come from a model, by a schema of the calls that are possible now: orders as they stand, bids in
/// cents up to the ceiling of each.
pub struct ModelCourier {
    reasoner: Box<dyn Reasoner>,
    prompts: Arc<Prompts>,
    persona: Box<dyn Persona>,
    interval: f64,
    state: State,
}

/// Everything that a snapshot holds.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
struct State {
    /// When it thinks next at the latest, and at the earliest, s.
    due: f64,
    rested: f64,
    /// The notices that it has thought about.
    seen: u64,
    news: VecDeque<String>,
    faults: u32,
}

impl ModelCourier {
    /// A courier that thinks with this model, at least every 5 s and whenever something concerns it.
    pub fn new(model: Box<dyn ChatModel>) -> Self {
        Self::with_reasoner(Box::new(ModelReasoner::new(model)))
    }

    /// A courier that thinks with any reasoner.
    pub fn with_reasoner(reasoner: Box<dyn Reasoner>) -> Self {
        let prompts = Arc::new(Prompts::standard());
        let persona = Box::new(Character::default());
        Self { reasoner, prompts, persona, interval: INTERVAL, state: State::default() }
    }

    /// As somebody: a [`Character`], or the traits of the couriers without a model.
    #[must_use]
    pub fn with_persona(mut self, persona: impl Persona + 'static) -> Self {
        self.persona = Box::new(persona);
        self
    }

    /// Thinks at least that often, s, 1 to 3600; what is outside is brought inside.
    #[must_use]
    pub fn with_interval(mut self, seconds: f64) -> Self {
        self.interval = if seconds.is_nan() { INTERVAL } else { seconds.clamp(PAUSE, 3600.0) };
        self
    }

    /// With prompts of one's own; give them to the reasoner too.
    #[must_use]
    pub fn with_prompts(mut self, prompts: Arc<Prompts>) -> Self {
        self.prompts = prompts;
        self
    }

    fn think(
        &mut self,
        task: &DeliveryTask,
        scene: &dyn Scene,
        menu: &CourierMenu<'_>,
    ) -> Result<CourierAction, ReasonError> {
        let news: Vec<&str> = self.state.news.iter().map(String::as_str).collect();
        let orders = task.orders();
        let system = self
            .prompts
            .render(Prompt::Courier, &[("calls", CALLS), ("persona", &self.persona.describe())])?;
        let user = self.prompts.render(
            Prompt::Shift,
            &[
                ("oneself", &menu.oneself()),
                ("held", &menu.held(orders, scene)),
                ("open", &menu.open(orders, scene)),
                ("offers", &menu.offers(orders, scene)),
                ("news", &news.join("\n")),
            ],
        )?;
        let question = Question { system, user, images: Vec::new(), name: "call", schema: menu.schema() };
        let mut action = None;
        self.reasoner.reason(&question, &mut |answer| {
            action = Some(CourierMenu::read(&answer["deed"]).ok_or("deed cannot be read")?);
            Ok(())
        })?;
        action.ok_or_else(|| ReasonError::Other("the reasoner did not have its answer checked".to_owned()))
    }
}

impl Mind<DeliveryTask> for ModelCourier {
    fn decide(
        &mut self,
        task: &DeliveryTask,
        scene: &dyn Scene,
        who: EntityId,
        out: &mut Vec<Intent>,
    ) -> Result<(), MindError> {
        let Some(view) = task.view(who) else {
            return Err(MindError { who, reason: "it is no courier of this task".to_owned() });
        };
        let now = view.now();
        let rested = self.state.rested;
        if !view.wakes(&mut self.state.seen, &mut self.state.due, || rested) {
            return Ok(());
        }
        self.state.due = now + self.interval;
        self.state.rested = now + PAUSE;
        match self.think(task, scene, &CourierMenu::new(view)) {
            Ok(action) => {
                self.state.faults = 0;
                self.state.news.clear();
                out.push(action.into());
                Ok(())
            }
            Err(error) => {
                self.state.faults += 1;
                let passing = match &error {
                    ReasonError::Answer { .. } => true,
                    ReasonError::Model(error) => error.is_passing(),
                    _ => false,
                };
                let bears = passing && self.state.faults < FAULTS;
                if bears { Ok(()) } else { Err(MindError { who, reason: error.to_string() }) }
            }
        }
    }

    fn notice(&mut self, events: &[Event], who: EntityId) {
        for event in events {
            let line = match &event.kind {
                EventKind::IntentRefused { who: actor, reason } if *actor == who => {
                    format!("refused: {reason}")
                }
                EventKind::PlanFailed { who: actor, reason } if *actor == who => format!("failed: {reason}"),
                EventKind::Said { who: speaker, to, words } if *to == who => {
                    format!("{speaker} said {words:?}")
                }
                EventKind::Task { name, who: actor, data } if *actor == Some(who) => {
                    let facts: Vec<String> =
                        data.iter().map(|(key, value)| format!("{key} {value}")).collect();
                    format!("{} {}", name.replace('_', " "), facts.join(", "))
                }
                _ => continue,
            };
            self.state.news.push_back(one_line(&line));
            if self.state.news.len() > NEWS {
                self.state.news.pop_front();
            }
        }
    }

    fn save(&self) -> Vec<u8> {
        // Plain data, which postcard always takes.
        postcard::to_stdvec(&self.state).expect("plain data serialises")
    }

    fn restore(&mut self, saved: &[u8]) -> bool {
        match postcard::from_bytes(saved) {
            Ok(state) => {
                self.state = state;
                true
            }
            Err(_) => false,
        }
    }
}
