//! The planner that asks a model, and the planner that asks two others in turn.

use std::sync::Arc;

use simworld_core::action::ActionSet;
use simworld_core::id::EntityId;
use simworld_core::intent::Intent;
use simworld_core::scene::Scene;
use simworld_core::seam::{Plan, PlanError, Planner};

use super::known::{Known, ViewConfig, ViewConfigError};
use super::menu::Menu;
use super::prompts::{Prompt, Prompts};
use super::reasoner::{ModelReasoner, Question, ReasonError, Reasoner};
use crate::language::plan_orders;
use crate::model::ChatModel;

/// How deep blocks nest in a model's plan where nothing else is said.
const DEPTH: u32 = 2;
/// The deepest that they may.
const DEEPEST: u32 = 6;

/// Makes plans by a language model, over the same actions as the grammar and by the same rules: the model names calls and things
/// in view, and what they need (going there, getting up first) is worked out as for a sentence.
///
/// ```
/// use simworld_agents::model::Scripted;
/// use simworld_agents::thought::ModelPlanner;
/// use simworld_core::action::Action;
/// use simworld_core::geometry::{Point3, pose_facing};
/// use simworld_core::intent::Intent;
/// use simworld_core::scene::{EntityDesc, EntityKind, Shape, World};
/// use simworld_core::seam::{PlanStep, Planner};
///
/// let mut world = World::new();
/// let at = |x| pose_facing(Point3::new(x, 0.0, 0.0), 0.0);
/// let person = Shape::Capsule { radius: 0.25, height: 1.8 };
/// let me = world.spawn(EntityDesc::new(EntityKind::Person, at(0.0), person))?;
/// let chair = world.spawn(EntityDesc::new(EntityKind::Chair, at(9.0), Shape::cuboid(0.5, 0.5, 0.9)))?;
///
/// let answer = r##"{"aim": "rest", "cannot": "", "steps": [{"act": "sit_down", "seat": "#1"}]}"##;
/// let mut planner = ModelPlanner::new(Box::new(Scripted::texts([answer])));
/// let plan = planner.plan(&Intent::Words("take the weight off your feet".into()), &world, me)?;
/// assert!(matches!(plan.steps[0], PlanStep::Navigate { .. }));
/// assert_eq!(plan.steps[1], PlanStep::Act(Action::SitDown { seat: chair }));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct ModelPlanner {
    reasoner: Box<dyn Reasoner>,
    prompts: Arc<Prompts>,
    view: ViewConfig,
    depth: u32,
}

impl ModelPlanner {
    /// Asks this model with the prompts that come with the crate.
    pub fn new(model: Box<dyn ChatModel>) -> Self {
        Self::with_prompts(model, Arc::new(Prompts::standard()))
    }

    /// Asks this model with prompts of one's own.
    pub fn with_prompts(model: Box<dyn ChatModel>, prompts: Arc<Prompts>) -> Self {
        let reasoner = ModelReasoner::new(model).with_prompts(Arc::clone(&prompts));
        Self::with_reasoner(Box::new(reasoner), prompts)
    }

    /// Asks any reasoner.
    pub fn with_reasoner(reasoner: Box<dyn Reasoner>, prompts: Arc<Prompts>) -> Self {
        Self { reasoner, prompts, view: ViewConfig::default(), depth: DEPTH }
    }

    /// Looks around like this.
    ///
    /// # Errors
    /// A setting out of range.
    pub fn with_view(mut self, view: ViewConfig) -> Result<Self, ViewConfigError> {
        view.validate()?;
        self.view = view;
        Ok(self)
    }

    /// With blocks (if, repeat, until) nested that deep, 0 to 6; 2 unless said otherwise.
    #[must_use]
    pub fn with_depth(mut self, depth: u32) -> Self {
        self.depth = depth.min(DEEPEST);
        self
    }
}

impl Planner for ModelPlanner {
    fn plan(&mut self, intent: &Intent, scene: &dyn Scene, who: EntityId) -> Result<Plan, PlanError> {
        if let Some(plan) = intent.ready() {
            return Ok(plan);
        }
        let me = scene.entity(who).ok_or(PlanError::Missing { id: who })?;
        let known = Known::look(scene, who, &self.view).ok_or(PlanError::Missing { id: who })?;
        let menu = Menu::new(ActionSet::of_body(me.kind), &known);
        let request = match intent {
            Intent::Words(words) => words.clone(),
            call => call.to_string(),
        };
        let written = |prompt, values: &[(&str, &str)]| {
            self.prompts.render(prompt, values).map_err(|error| PlanError::Backend(error.to_string()))
        };
        let (things, places) = (known.things_text(), known.places_text());
        let system = [("body", me.kind.as_str()), ("calls", &menu.described())];
        let user =
            [("oneself", &*known.oneself), ("things", &things), ("places", &places), ("request", &request)];
        let question = Question {
            system: written(Prompt::Planner, &system)?,
            user: written(Prompt::Plan, &user)?,
            images: Vec::new(),
            name: "plan",
            schema: menu.plan_schema(self.depth),
        };
        let mut outcome = None;
        let reasoned = self.reasoner.reason(&question, &mut |answer| {
            outcome = Some(understood(answer, &menu, intent, scene, who)?);
            Ok(())
        });
        match (reasoned, outcome) {
            (Ok(_), Some(outcome)) => outcome,
            (Ok(_), None) => {
                Err(PlanError::Backend("the reasoner did not have its answer checked".to_owned()))
            }
            (Err(ReasonError::Answer { fault, answer }), _) => Err(PlanError::Answer { fault, answer }),
            (Err(error), _) => Err(PlanError::Backend(error.to_string())),
        }
    }
}

/// The plan, or the model's word that there is none; a fault is worth another try.
fn understood(
    answer: &serde_json::Value,
    menu: &Menu<'_>,
    intent: &Intent,
    scene: &dyn Scene,
    who: EntityId,
) -> Result<Result<Plan, PlanError>, String> {
    let orders = menu.orders(&answer["steps"])?;
    let cannot = answer["cannot"].as_str().unwrap_or_default().trim();
    match (orders.is_empty(), cannot.is_empty()) {
        (true, true) => {
            Err("it has no steps: give steps, or say in \"cannot\" why there are none".to_owned())
        }
        (false, false) => Err("it has steps, and says that there can be none: give either".to_owned()),
        (true, false) => Ok(Err(PlanError::NotUnderstood {
            words: intent.to_string(),
            fragment: String::new(),
            hint: cannot.to_owned(),
        })),
        (false, true) => {
            let plan = plan_orders(&orders, scene, who).map_err(|error| error.to_string())?;
            if plan.steps.is_empty() {
                return Err("nothing is left to do of these steps: they are so already".to_owned());
            }
            Ok(Ok(plan))
        }
    }
}

/// Which of two planners answered.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Answered {
    /// The first.
    First,
    /// The second, since the first did not understand.
    Second,
}

/// Asks one planner and, if it does not understand or its mind fails, another: the grammar and then a model, or the reverse.
///
/// What the first understands and refuses (nothing of the kind is there, this body cannot) stays refused.
pub struct Fallback {
    first: Box<dyn Planner>,
    second: Box<dyn Planner>,
    answered: Option<Answered>,
}

impl Fallback {
    /// Asks `first`, then `second`.
    pub fn new(first: Box<dyn Planner>, second: Box<dyn Planner>) -> Self {
        Self { first, second, answered: None }
    }

    /// Which of them gave the last plan or refusal; `None` before the first.
    pub fn answered(&self) -> Option<Answered> {
        self.answered
    }
}

/// Whether another planner may do better.
const fn is_open(error: &PlanError) -> bool {
    matches!(error, PlanError::NotUnderstood { .. } | PlanError::Answer { .. } | PlanError::Backend(_))
}

impl Planner for Fallback {
    fn plan(&mut self, intent: &Intent, scene: &dyn Scene, who: EntityId) -> Result<Plan, PlanError> {
        self.answered = Some(Answered::First);
        let first = match self.first.plan(intent, scene, who) {
            Err(error) if is_open(&error) => error,
            settled => return settled,
        };
        self.answered = Some(Answered::Second);
        self.second.plan(intent, scene, who).map_err(|second| match second {
            PlanError::Answer { .. } | PlanError::Backend(_) => {
                PlanError::Backend(format!("{first}; then: {second}"))
            }
            understood => understood,
        })
    }
}
