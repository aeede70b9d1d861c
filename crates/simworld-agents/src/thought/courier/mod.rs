//! A courier that thinks with a model, over the calls of the delivery economy.

mod config;
mod menu;

use std::collections::VecDeque;
use std::sync::Arc;

pub use config::{CourierConfig, CourierConfigError, Thinking, Waking};
use menu::{CALLS, CourierMenu};
use serde::{Deserialize, Serialize};
use simworld_core::event::{Event, EventKind};
use simworld_core::id::EntityId;
use simworld_core::intent::Intent;
use simworld_core::scene::Scene;
use simworld_core::seam::Observer;

use super::memory::{Memory, Record, RecordKind, RingMemory};
use super::persona::{Character, Persona};
use super::prompts::{Prompt, Prompts, one_line};
use super::reasoner::{ModelReasoner, Question, ReasonError, Reasoner};
use super::schema::{object, words};
use crate::delivery::{CourierAction, CourierView, DeliveryTask};
use crate::mind::{Mind, MindError};
use crate::model::{ChatModel, Image};
use crate::observer::Frame;

/// The most lines of news that are kept.
const NEWS: usize = 8;
/// How much what happened matters to a memory, and how much what one did.
const NEWS_MATTER: u8 = 4;
const DEEDS_MATTER: u8 = 3;
/// A courier whose decisions come from a model, by a schema of the calls that are possible now: orders as they stand, bids in
/// cents up to the ceiling of each.
pub struct ModelCourier {
    reasoner: Box<dyn Reasoner>,
    prompts: Arc<Prompts>,
    persona: Box<dyn Persona>,
    memory: Box<dyn Memory>,
    camera: Option<Box<dyn Observer<Observation = Frame> + Send>>,
    config: CourierConfig,
    state: State,
}

/// Everything that a snapshot holds.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
struct State {
    /// When it thinks next at the latest, and at the earliest, s.
    due: f64,
    rested: f64,
    /// The notices that it has thought about, and how many of its bids it knows the end of.
    seen: u64,
    results: u64,
    news: VecDeque<String>,
    faults: u32,
    /// What is decided and not done yet, and when it will be, s.
    decided: Option<(f64, Intent)>,
    /// Why it thinks no more: what it may spend on its model is spent.
    spent: Option<String>,
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
        let (memory, config) = (Box::new(RingMemory::default()), CourierConfig::default());
        Self { reasoner, prompts, persona, memory, camera: None, config, state: State::default() }
    }

    /// As somebody: a [`Character`], or the traits of the couriers without a model.
    #[must_use]
    pub fn with_persona(mut self, persona: impl Persona + 'static) -> Self {
        self.persona = Box::new(persona);
        self
    }

    /// With other settings.
    ///
    /// # Errors
    /// A setting out of range.
    pub fn with_config(mut self, config: CourierConfig) -> Result<Self, CourierConfigError> {
        config.validate()?;
        self.config = config;
        Ok(self)
    }

    /// With a memory of one's own; how much of it comes to mind is a setting.
    #[must_use]
    pub fn with_memory(mut self, memory: impl Memory + 'static) -> Self {
        self.memory = Box::new(memory);
        self
    }

    /// Shows the model what a camera sees at each thought.
    #[must_use]
    pub fn with_camera(mut self, camera: impl Observer<Observation = Frame> + Send + 'static) -> Self {
        self.camera = Some(Box::new(camera));
        self
    }

    /// With prompts of one's own; give them to the reasoner too.
    #[must_use]
    pub fn with_prompts(mut self, prompts: Arc<Prompts>) -> Self {
        self.prompts = prompts;
        self
    }

    /// Why it thinks no more, once what it may spend on its model is spent. What it carries by then it keeps.
    pub fn out_of_budget(&self) -> Option<&str> {
        self.state.spent.as_deref()
    }

    /// What comes to mind of what happened before, a line each.
    fn recollections(&mut self, about: &str, now: f64) -> String {
        let records = self.memory.recall(about, now, self.config.memories);
        records.iter().map(|record| one_line(&record.text)).collect::<Vec<_>>().join("\n")
    }

    /// What the camera shows, if it has one.
    fn sight(&mut self, scene: &dyn Scene, who: EntityId) -> Result<Vec<Image>, ReasonError> {
        let Some(camera) = &mut self.camera else { return Ok(Vec::new()) };
        let blind = |reason: String| ReasonError::Other(format!("the camera gives no picture: {reason}"));
        let mut frame = Frame::default();
        camera.observe(scene, who, &mut frame).map_err(|error| blind(error.to_string()))?;
        let file = frame.to_png().map_err(|error| blind(error.to_string()))?;
        Ok(vec![Image::png(file)])
    }

    fn think(
        &mut self,
        task: &DeliveryTask,
        scene: &dyn Scene,
        who: EntityId,
        menu: &CourierMenu<'_>,
    ) -> Result<CourierAction, ReasonError> {
        let now = scene.clock().seconds();
        let news: Vec<&str> = self.state.news.iter().map(String::as_str).collect();
        let (orders, news) = (task.orders(), news.join("\n"));
        let (oneself, held) = (menu.oneself(), menu.held(orders, scene));
        let (open, offers) = (menu.open(orders, scene), menu.offers(orders, scene));
        let memories = self.recollections(&[held.as_str(), &open, &news].join("\n"), now);
        let images = self.sight(scene, who)?;
        let persona = self.persona.describe();
        let ask = |system: Prompt, thought: &str| -> Result<(String, String), ReasonError> {
            let user = [
                ("oneself", oneself.as_str()),
                ("held", &held),
                ("open", &open),
                ("offers", &offers),
                ("news", &news),
                ("memories", &memories),
                ("thought", thought),
            ];
            let system = self.prompts.render(system, &[("calls", CALLS), ("persona", &persona)])?;
            Ok((system, self.prompts.render(Prompt::Shift, &user)?))
        };
        let mut thought = String::new();
        if self.config.thinking == Thinking::ReasonThenAct {
            let (system, user) = ask(Prompt::Consider, "")?;
            let schema = object([("thought", words(600))]);
            let question = Question { system, user, images: images.clone(), name: "thought", schema };
            let answer = self.reasoner.reason(&question, &mut |_| Ok(()))?;
            thought = one_line(answer["thought"].as_str().unwrap_or_default());
        }
        let (system, user) = ask(Prompt::Courier, &thought)?;
        let question = Question { system, user, images, name: "call", schema: menu.schema() };
        let mut action = None;
        let answer = self.reasoner.reason(&question, &mut |answer| {
            action = Some(CourierMenu::read(&answer["deed"]).ok_or("deed cannot be read")?);
            Ok(())
        })?;
        let action = action
            .ok_or_else(|| ReasonError::Other("the reasoner did not have its answer checked".to_owned()))?;
        self.remember(now, action, answer["because"].as_str().unwrap_or_default());
        Ok(action)
    }

    /// Keeps what was learnt since the last decision, and what was decided.
    fn remember(&mut self, now: f64, action: CourierAction, because: &str) {
        if self.config.memories == 0 {
            return;
        }
        for line in self.state.news.drain(..) {
            self.memory.remember(Record::new(now, RecordKind::Saw, line, NEWS_MATTER));
        }
        if action != CourierAction::DoNothing {
            let deed = format!("at {now:.0} s: {}, because {}", Intent::from(action), one_line(because));
            self.memory.remember(Record::new(now, RecordKind::Did, deed, DEEDS_MATTER));
        }
    }

    /// How many answers a decision takes.
    fn questions(&self) -> f64 {
        match self.config.thinking {
            Thinking::Once => 1.0,
            Thinking::ReasonThenAct => 2.0,
        }
    }

    /// Sets when it thinks next after a thought that took so many requests.
    fn rest(&mut self, now: f64, requests: u64) {
        let longer = (requests as f64 / self.questions()).max(1.0);
        self.state.rested = now + self.config.pause * longer;
        self.state.due = now + (self.config.interval).max(self.config.pause * longer);
    }

    /// An answer that cannot be used costs the turn, and the courier is told; a model that fails is borne for a while. Who has nothing
    /// left to spend thinks no more, and the others go on.
    fn bear(&mut self, who: EntityId, error: &ReasonError) -> Result<(), MindError> {
        if error.is_out_of_budget() {
            self.state.spent = Some(error.to_string());
            return Ok(());
        }
        let borne = match error {
            ReasonError::Answer { fault, .. } => {
                self.hear(&format!("refused: {fault}"));
                true
            }
            ReasonError::Model(error) => {
                self.state.faults += 1;
                error.is_passing() && self.state.faults < self.config.patience
            }
            _ => false,
        };
        if borne { Ok(()) } else { Err(MindError { who, reason: error.to_string() }) }
    }

    /// Which of its bids have lost since it last thought; of those that won it is told by what happened.
    fn hear_of_bids(&mut self, view: &CourierView<'_>) {
        let (results, known) = view.results_since(self.state.results);
        self.state.results = known;
        for result in results.iter().filter(|result| !result.won) {
            self.hear(&format!("your bid of {} cents for order {} lost", result.price.0, result.order));
        }
    }

    fn hear(&mut self, line: &str) {
        self.state.news.push_back(one_line(line));
        if self.state.news.len() > NEWS {
            self.state.news.pop_front();
        }
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
        if let Some((due, intent)) = self.state.decided.take() {
            // Half a step is nothing: times are sums of steps.
            if now + 0.5 * scene.clock().dt() < due {
                self.state.decided = Some((due, intent));
                return Ok(());
            }
            out.push(intent);
        }
        if self.state.spent.is_some() {
            return Ok(());
        }
        let rested = self.state.rested;
        let woken = view.wakes(&mut self.state.seen, &mut self.state.due, || rested);
        if !woken && self.config.waking == Waking::Events {
            return Ok(());
        }
        let before = self.reasoner.requests();
        self.hear_of_bids(&view);
        let latency = self.config.latency * self.questions();
        let thought = self.think(task, scene, who, &CourierMenu::new(view, latency));
        self.rest(now, self.reasoner.requests() - before);
        match thought {
            Ok(action) => {
                self.state.faults = 0;
                self.state.news.clear();
                if latency > 0.0 {
                    self.state.decided = Some((now + latency, action.into()));
                } else {
                    out.push(action.into());
                }
                Ok(())
            }
            Err(error) => self.bear(who, &error),
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
            self.hear(&line);
        }
    }

    fn save(&self) -> Vec<u8> {
        // Plain data, which postcard always takes.
        postcard::to_stdvec(&(&self.state, self.memory.save())).expect("plain data serialises")
    }

    fn restore(&mut self, saved: &[u8]) -> bool {
        match postcard::from_bytes::<(State, Vec<u8>)>(saved) {
            Ok((state, memories)) => {
                self.state = state;
                self.memory.restore(&memories)
            }
            Err(_) => false,
        }
    }
}
