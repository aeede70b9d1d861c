//! A mind that thinks in turns: thought, deed, what came of it (Yao et al., "`ReAct`", 2023).

mod state;

use std::sync::Arc;

use serde_json::Value as Json;
use simworld_core::action::ActionSet;
use simworld_core::event::{Event, EventKind};
use simworld_core::id::EntityId;
use simworld_core::intent::Intent;
use simworld_core::scene::Scene;
use state::State;
pub use state::{Ending, ReactConfig, ReactConfigError, Turn};

use super::known::{Known, ViewConfig, ViewConfigError};
use super::memory::{Memory, Record, RecordKind, RingMemory};
use super::menu::{Menu, WORDS};
use super::mood::{MentalState, Mood};
use super::persona::{Character, Persona};
use super::prompts::{Prompt, PromptError, Prompts, one_line};
use super::reasoner::{ModelReasoner, Question, ReasonError, Reasoner};
use super::schema::{object, one_of, words};
use crate::mind::{Mind, MindError};
use crate::model::ChatModel;
use crate::observer::{Feedback, GpsObserver, SceneGraphObserver, Senses};

/// The name under which a task is told.
const TASK: &str = "task";

type TaskView<T> = dyn Fn(&T, EntityId) -> String + Send;

/// Thinks in turns with a reasoner, and acts by calls that the agent's planner plans.
///
/// A turn comes when its last deed has ended, failed or taken too long, or when somebody speaks to it. What it wants goes out as
/// an intent like any other mind's, so an episode replays without it and without any model.
///
/// Its parts are small traits with defaults: senses, [`Memory`], [`Persona`], [`MentalState`], [`Reasoner`].
pub struct ReactMind<T: ?Sized> {
    goal: String,
    reasoner: Box<dyn Reasoner>,
    prompts: Arc<Prompts>,
    senses: Senses,
    view: ViewConfig,
    memory: Box<dyn Memory>,
    persona: Box<dyn Persona>,
    mood: Box<dyn MentalState>,
    task: Option<Box<TaskView<T>>>,
    config: ReactConfig,
    state: State,
}

/// What a turn came to.
enum Decision {
    Deed(Intent),
    End(Ending),
}

impl<T: ?Sized> ReactMind<T> {
    /// A mind with a goal in words that thinks with this model.
    pub fn new(goal: impl Into<String>, model: Box<dyn ChatModel>) -> Self {
        Self::with_reasoner(goal, Box::new(ModelReasoner::new(model)))
    }

    /// A mind with a goal in words that thinks with any reasoner.
    pub fn with_reasoner(goal: impl Into<String>, reasoner: Box<dyn Reasoner>) -> Self {
        let senses = Senses::new()
            .with("receiver", GpsObserver::exact())
            .with_sense("since then", 1.0, Feedback::default())
            .with("in sight", SceneGraphObserver::new(80.0).with_occlusion());
        Self {
            goal: goal.into(),
            reasoner,
            prompts: Arc::new(Prompts::standard()),
            senses,
            view: ViewConfig::default(),
            memory: Box::new(RingMemory::default()),
            persona: Box::new(Character::default()),
            mood: Box::new(Mood::default()),
            task: None,
            config: ReactConfig::default(),
            state: State::default(),
        }
    }

    /// With other senses.
    #[must_use]
    pub fn with_senses(mut self, senses: Senses) -> Self {
        self.senses = senses;
        self
    }

    /// With another view of the things that it may name.
    ///
    /// # Errors
    /// A setting out of range.
    pub fn with_view(mut self, view: ViewConfig) -> Result<Self, ViewConfigError> {
        view.validate()?;
        self.view = view;
        Ok(self)
    }

    /// With another memory.
    #[must_use]
    pub fn with_memory(mut self, memory: impl Memory + 'static) -> Self {
        self.memory = Box::new(memory);
        self
    }

    /// As somebody.
    #[must_use]
    pub fn with_persona(mut self, persona: impl Persona + 'static) -> Self {
        self.persona = Box::new(persona);
        self
    }

    /// With other feelings.
    #[must_use]
    pub fn with_mental_state(mut self, mood: impl MentalState + 'static) -> Self {
        self.mood = Box::new(mood);
        self
    }

    /// Told how its task stands.
    #[must_use]
    pub fn with_task(mut self, told: impl Fn(&T, EntityId) -> String + Send + 'static) -> Self {
        self.task = Some(Box::new(told));
        self
    }

    /// With prompts of one's own; give them to the reasoner too.
    #[must_use]
    pub fn with_prompts(mut self, prompts: Arc<Prompts>) -> Self {
        self.prompts = prompts;
        self
    }

    /// With other settings.
    ///
    /// # Errors
    /// A setting out of range.
    pub fn with_config(mut self, config: ReactConfig) -> Result<Self, ReactConfigError> {
        config.validate()?;
        self.config = config;
        Ok(self)
    }

    /// The last turns, the oldest first.
    pub fn turns(&self) -> impl ExactSizeIterator<Item = &Turn> {
        self.state.log.iter()
    }

    /// Why it stopped; `None` while it thinks.
    pub fn ending(&self) -> Option<&Ending> {
        self.state.ending.as_ref()
    }

    /// Feels and remembers what happened since it did so last.
    fn digest(&mut self, now: f64, who: EntityId) {
        let news = std::mem::take(&mut self.state.news);
        self.mood.feel(&news, who, now - self.state.felt);
        self.state.felt = now;
        for event in &news {
            let (kind, text, importance) = match &event.kind {
                EventKind::Said { who: speaker, words, .. } => {
                    (RecordKind::Heard, format!("{speaker} said {words:?}"), 5)
                }
                EventKind::PlanFailed { reason, .. } | EventKind::IntentRefused { reason, .. } => {
                    (RecordKind::Did, format!("it failed: {reason}"), 6)
                }
                EventKind::ActionFailed { action, reason, .. } => {
                    (RecordKind::Did, format!("{action} failed: {reason}"), 4)
                }
                _ => continue,
            };
            self.memory.remember(Record::new(now, kind, one_line(&text), importance));
        }
    }

    /// The question of a turn.
    fn question(&mut self, now: f64, body: &str, menu: &Menu<'_>) -> Result<Question, PromptError> {
        let messages = self.state.messages();
        let asked = format!("{} {messages}", self.goal);
        let recalled = self.memory.recall(&asked, now, self.config.remembered);
        let memory = |record: &Record| format!("{:.0} s ago: {}", now - record.at, record.text);
        let memories = recalled.iter().map(memory).collect::<Vec<_>>().join("\n");
        let system = self.prompts.render(
            Prompt::Agent,
            &[
                ("body", body),
                ("calls", &menu.described()),
                ("persona", &self.persona.describe()),
                ("goal", &self.goal),
            ],
        )?;
        let left = self.config.most_turns - self.state.turns;
        let user = self.prompts.render(
            Prompt::Turn,
            &[
                ("senses", &self.senses.prompt(self.config.tokens)),
                ("messages", &messages),
                ("memories", &memories),
                ("feelings", &self.mood.describe()),
                ("turns", &self.state.told(self.config.told_turns)),
                ("left", &left.to_string()),
            ],
        )?;
        let finish = object([
            ("act", one_of(["finish"])),
            ("outcome", one_of(["reached", "hopeless"])),
            ("why", words(WORDS)),
        ]);
        let schema = menu.deed_schema(vec![finish]);
        Ok(Question { system, user, images: Vec::new(), name: "turn", schema })
    }

    /// Asks for one deed.
    fn think(
        &mut self,
        scene: &dyn Scene,
        who: EntityId,
        now: f64,
    ) -> Result<(String, Decision), ReasonError> {
        let missing = || ReasonError::Other(format!("there is no entity {who} to think for"));
        let me = scene.entity(who).ok_or_else(missing)?;
        self.senses.perceive(scene, who).map_err(|error| ReasonError::Other(error.to_string()))?;
        let known = Known::look(scene, who, &self.view).ok_or_else(missing)?;
        let menu = Menu::new(ActionSet::of_body(me.kind), &known);
        let question = self.question(now, me.kind.as_str(), &menu)?;
        let mut decision = None;
        let answer = self.reasoner.reason(&question, &mut |answer| {
            decision = Some(decided(&answer["deed"], &menu)?);
            Ok(())
        })?;
        let because = answer["because"].as_str().unwrap_or_default().to_owned();
        let unchecked = || ReasonError::Other("the reasoner did not have its answer checked".to_owned());
        decision.map(|decision| (because, decision)).ok_or_else(unchecked)
    }

    /// A turn without a usable answer: a rest, or the end of the mind's patience with its model. Whose budget is spent thinks no more;
    /// the others go on.
    fn bear(&mut self, error: &ReasonError, now: f64, who: EntityId) -> Result<(), MindError> {
        if error.is_out_of_budget() {
            self.state.ending = Some(Ending::OutOfBudget { why: error.to_string() });
            return Ok(());
        }
        let passing = match error {
            ReasonError::Answer { .. } => true,
            ReasonError::Model(error) => error.is_passing(),
            _ => false,
        };
        self.state.faults += 1;
        if !passing || self.state.faults > self.config.faults {
            return Err(MindError { who, reason: error.to_string() });
        }
        let turn = Turn {
            at: now,
            because: String::new(),
            deed: "no usable answer".to_owned(),
            outcome: one_line(&error.to_string()),
        };
        self.log(turn);
        self.state.due = now + self.config.rest;
        Ok(())
    }

    fn log(&mut self, turn: Turn) {
        self.state.log.push_back(turn);
        while self.state.log.len() > self.config.told_turns.max(1) {
            self.state.log.pop_front();
        }
    }

    /// Takes up what a turn came to.
    fn conclude(&mut self, because: String, decision: Decision, now: f64, out: &mut Vec<Intent>) {
        self.state.faults = 0;
        self.state.inbox.clear();
        self.senses.told();
        let deed = match &decision {
            Decision::Deed(intent) => intent.to_string(),
            Decision::End(_) => "finish".to_owned(),
        };
        let did = one_line(&format!("{because} I did {deed}"));
        self.memory.remember(Record::new(now, RecordKind::Did, did, 3));
        if let Some(turn) = self.state.log.back_mut().filter(|turn| turn.outcome.is_empty()) {
            "broken off".clone_into(&mut turn.outcome);
        }
        self.log(Turn { at: now, because, deed, outcome: String::new() });
        match decision {
            Decision::Deed(intent) => {
                self.state.busy_since = Some(now);
                out.push(intent);
            }
            Decision::End(ending) => self.state.ending = Some(ending),
        }
    }
}

/// What a deed that conforms to the schema comes to.
fn decided(deed: &Json, menu: &Menu<'_>) -> Result<Decision, String> {
    if deed["act"] != "finish" {
        return menu.intent(deed).map(Decision::Deed);
    }
    let why = deed["why"].as_str().unwrap_or_default().to_owned();
    let reached = deed["outcome"] == "reached";
    Ok(Decision::End(if reached { Ending::Reached { why } } else { Ending::Hopeless { why } }))
}

impl<T: ?Sized> Mind<T> for ReactMind<T> {
    fn decide(
        &mut self,
        task: &T,
        scene: &dyn Scene,
        who: EntityId,
        out: &mut Vec<Intent>,
    ) -> Result<(), MindError> {
        let now = scene.clock().seconds();
        if !self.state.is_due(now, self.config.patience) {
            return Ok(());
        }
        if self.state.turns >= self.config.most_turns {
            self.state.ending = Some(Ending::OutOfTurns);
            return Ok(());
        }
        self.digest(now, who);
        if let Some(told) = &self.task {
            self.senses.tell(TASK, told(task, who));
        }
        let thought = self.think(scene, who, now);
        self.state.turns += 1;
        match thought {
            Ok((because, decision)) => self.conclude(because, decision, now, out),
            Err(error) => self.bear(&error, now, who)?,
        }
        Ok(())
    }

    fn notice(&mut self, events: &[Event], who: EntityId) {
        self.state.notice(events, who);
        self.senses.notice(events, who);
    }

    fn save(&self) -> Vec<u8> {
        let parts = (&self.state, self.memory.save(), self.mood.save(), self.senses.save());
        // Plain data, which postcard always takes.
        postcard::to_stdvec(&parts).expect("plain data serialises")
    }

    fn restore(&mut self, saved: &[u8]) -> bool {
        let Ok((state, memory, mood, senses)) =
            postcard::from_bytes::<(State, Vec<u8>, Vec<u8>, Vec<Vec<u8>>)>(saved)
        else {
            return false;
        };
        if self.task.is_some() {
            self.senses.tell(TASK, String::new());
        }
        self.state = state;
        self.memory.restore(&memory) && self.mood.restore(&mood) && self.senses.restore(&senses)
    }
}
