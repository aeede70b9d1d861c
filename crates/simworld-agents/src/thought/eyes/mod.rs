//! The visual executor: plans carried out by what a camera shows.

mod aim;
mod config;
mod movement;
mod steered;

use std::collections::VecDeque;
use std::sync::Arc;

use aim::Aim;
pub use config::{VisualConfig, VisualConfigError};
use movement::{Deed, Moving};
use serde::{Deserialize, Serialize};
use simworld_core::action::Action;
use simworld_core::hash::StateHasher;
use simworld_core::id::EntityId;
use simworld_core::scene::{EntityRef, Scene};
use simworld_core::seam::{Executor, ExecutorError, Observer, Plan, Progress};
use steered::{able, steered};

use super::prompts::{Prompt, Prompts, one_line};
use super::reasoner::{ModelReasoner, Question, ReasonError, Reasoner};
use super::schema::{any_of, object, words};
use crate::executor::{Blocks, Entered, RuleExecutor};
use crate::model::{ChatModel, Image};
use crate::observer::Frame;

/// Carries out plans by a camera and a vision model, one small movement after another.
///
/// Going somewhere, following and facing are steered by the pictures; the model is told what it looks for, never where that is.
/// Whoever sits in a vehicle drives it: what it is told are pedals and wheel, what it sees is still what is before its own eyes.
/// Everything else of a plan (sitting down, picking up, waiting) is done as the rules do it. That a goal is reached is checked
/// against the world. The model blocks the step in which it is asked; under a recording of its answers a run is deterministic. At its
/// own pace it goes into an [`ActingMind`](crate::mind::ActingMind), and blocks nobody.
pub struct VisualExecutor {
    reasoner: Box<dyn Reasoner>,
    camera: Box<dyn Observer<Observation = Frame> + Send>,
    prompts: Arc<Prompts>,
    config: VisualConfig,
    /// What does single actions and waits.
    hands: RuleExecutor,
    frame: Frame,
    state: State,
}

/// Everything that a snapshot holds, beside the hands.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
struct State {
    blocks: Blocks,
    /// What is looked for, once it is begun.
    aim: Option<Aim>,
    moving: Option<Moving>,
    /// Whether the hands have taken up the step under way.
    in_hand: bool,
    /// The last pictures as PNG files, the oldest first.
    frames: VecDeque<Vec<u8>>,
    /// What was done towards this aim, the oldest first.
    deeds: VecDeque<String>,
    movements: u32,
    claims: u32,
    faults: u32,
}

/// How a step under way stands.
enum Stand {
    Underway,
    Done,
    Lost(String),
}

impl VisualExecutor {
    /// Sees by this camera and asks this model.
    pub fn new(
        model: Box<dyn ChatModel>,
        camera: impl Observer<Observation = Frame> + Send + 'static,
    ) -> Self {
        Self::with_reasoner(Box::new(ModelReasoner::new(model)), camera)
    }

    /// Sees by this camera and asks any reasoner.
    pub fn with_reasoner(
        reasoner: Box<dyn Reasoner>,
        camera: impl Observer<Observation = Frame> + Send + 'static,
    ) -> Self {
        Self {
            reasoner,
            camera: Box::new(camera),
            prompts: Arc::new(Prompts::standard()),
            config: VisualConfig::default(),
            hands: RuleExecutor::straight(),
            frame: Frame::default(),
            state: State::default(),
        }
    }

    /// With other settings.
    ///
    /// # Errors
    /// A setting out of range.
    pub fn with_config(mut self, config: VisualConfig) -> Result<Self, VisualConfigError> {
        config.validate()?;
        self.config = config;
        Ok(self)
    }

    /// With prompts of one's own; give them to the reasoner too.
    #[must_use]
    pub fn with_prompts(mut self, prompts: Arc<Prompts>) -> Self {
        self.prompts = prompts;
        self
    }

    /// What was done towards the aim under way, the oldest first.
    pub fn deeds(&self) -> impl ExactSizeIterator<Item = &str> {
        self.state.deeds.iter().map(String::as_str)
    }

    /// Forgets what belongs to the step under way.
    fn leave_step(&mut self) {
        let blocks = std::mem::take(&mut self.state.blocks);
        let frames = std::mem::take(&mut self.state.frames);
        self.state = State { blocks, frames, claims: self.state.claims, ..State::default() };
    }

    /// The step under way, by hand.
    fn handle(
        &mut self,
        step: simworld_core::seam::PlanStep,
        scene: &dyn Scene,
        who: EntityId,
        out: &mut Vec<Action>,
    ) -> Result<Stand, ExecutorError> {
        if !self.state.in_hand {
            self.hands.start(Plan { steps: vec![step] }, scene, who)?;
            self.state.in_hand = true;
        }
        Ok(match self.hands.advance(scene, who, out)? {
            Progress::Running | Progress::Begun { .. } | Progress::Rerouted { .. } => Stand::Underway,
            Progress::Failed { reason } => Stand::Lost(reason),
            Progress::Done | Progress::Idle => Stand::Done,
        })
    }

    /// The step under way, by eye.
    fn steer(
        &mut self,
        scene: &dyn Scene,
        me: &EntityRef<'_>,
        aim: Aim,
        out: &mut Vec<Action>,
    ) -> Result<Stand, ExecutorError> {
        let body = match steered(scene, me) {
            Ok(body) => body,
            Err(reason) => return Ok(Stand::Lost(reason)),
        };
        let Some(told) = aim.describe(scene, &body) else {
            return Ok(Stand::Lost(format!("{aim:?} is gone")));
        };
        let speed = aim.speed().unwrap_or(self.config.speed);
        if let Some(moving) = &mut self.state.moving {
            let Some(outcome) = moving.advance(&body, scene.clock().dt(), speed, out) else {
                return Ok(Stand::Underway);
            };
            self.state.moving = None;
            self.note(outcome);
        }
        if self.state.movements == self.config.most_movements {
            return Ok(Stand::Lost(format!("{told} was not reached in {} movements", self.state.movements)));
        }
        self.state.movements += 1;
        let deed = match self.ask(scene, (me, &body), aim, &told) {
            Ok(deed) => deed,
            Err(error) => return self.bear(&error),
        };
        self.state.faults = 0;
        Ok(match deed {
            Deed::Move(movement) => {
                let mut moving = Moving::new(movement, scene, &body, speed);
                if let Some(outcome) = moving.advance(&body, scene.clock().dt(), speed, out) {
                    self.note(outcome);
                } else {
                    self.state.moving = Some(moving);
                }
                Stand::Underway
            }
            Deed::Done if aim.is_reached(scene, &body) => Stand::Done,
            Deed::Done => self.doubt(&told),
            Deed::GiveUp(why) => Stand::Lost(format!("gave up on {told}: {}", one_line(&why))),
        })
    }

    /// It said that it is there, and the world says that it is not.
    fn doubt(&mut self, told: &str) -> Stand {
        self.note("you said done, and it is not reached".to_owned());
        self.state.claims += 1;
        if self.state.claims > self.config.claims {
            Stand::Lost(format!("{told} is not where it was taken to be"))
        } else {
            Stand::Underway
        }
    }

    /// Shows the model what the camera of whoever is steered sees, and reads one deed of the body that moves.
    fn ask(
        &mut self,
        scene: &dyn Scene,
        (me, body): (&EntityRef<'_>, &EntityRef<'_>),
        aim: Aim,
        told: &str,
    ) -> Result<Deed, ReasonError> {
        let blind = |reason: String| ReasonError::Other(format!("the camera gives no picture: {reason}"));
        self.camera.observe(scene, me.id, &mut self.frame).map_err(|error| blind(error.to_string()))?;
        let file = self.frame.to_png().map_err(|error| blind(error.to_string()))?;
        self.state.frames.push_back(file);
        while self.state.frames.len() > self.config.frames {
            self.state.frames.pop_front();
        }
        let (branches, calls) = movement::offered(able(scene, me, body), aim);
        let system = self.prompts.render(Prompt::Eyes, &[("body", body.kind.as_str()), ("calls", &calls)])?;
        let left = self.config.most_movements - self.state.movements;
        let deeds: Vec<&str> = self.deeds().collect();
        let user = self.prompts.render(
            Prompt::Look,
            &[
                ("aim", told),
                ("deeds", &deeds.join("\n")),
                ("frames", &self.state.frames.len().to_string()),
                ("left", &left.to_string()),
            ],
        )?;
        let images = self.state.frames.iter().map(|file| Image::png(file.clone())).collect();
        let schema = object([("because", words(300)), ("deed", any_of(branches))]);
        let question = Question { system, user, images, name: "movement", schema };
        let answer = self.reasoner.reason(&question, &mut |answer| {
            movement::read(&answer["deed"]).map(drop).ok_or_else(|| "deed cannot be read".to_owned())
        })?;
        movement::read(&answer["deed"])
            .ok_or_else(|| ReasonError::Other("the deed cannot be read".to_owned()))
    }

    /// An answer that cannot be used: another try in the next step, or the end of the plan with a reason, as when the budget is spent. A model that will not
    /// answer at all ends the episode, since a replay could not know that.
    fn bear(&mut self, error: &ReasonError) -> Result<Stand, ExecutorError> {
        let passing = match error {
            ReasonError::Answer { .. } => true,
            ReasonError::Model(error) => error.is_passing(),
            _ => false,
        };
        if error.is_out_of_budget() {
            return Ok(Stand::Lost(error.to_string()));
        }
        if !passing {
            return Err(ExecutorError::Backend(error.to_string()));
        }
        self.state.faults += 1;
        if self.state.faults > self.config.faults {
            return Ok(Stand::Lost(error.to_string()));
        }
        Ok(Stand::Underway)
    }

    fn note(&mut self, deed: String) {
        self.state.deeds.push_back(deed);
        while self.state.deeds.len() > self.config.deeds {
            self.state.deeds.pop_front();
        }
    }
}

impl Executor for VisualExecutor {
    fn start(&mut self, plan: Plan, scene: &dyn Scene, who: EntityId) -> Result<(), ExecutorError> {
        // The hands know which plans can be carried out.
        RuleExecutor::straight().start(plan.clone(), scene, who)?;
        self.hands.cancel(&mut Vec::new());
        self.state = State { blocks: Blocks::new(plan), ..State::default() };
        Ok(())
    }

    fn advance(
        &mut self,
        scene: &dyn Scene,
        who: EntityId,
        out: &mut Vec<Action>,
    ) -> Result<Progress, ExecutorError> {
        if self.state.blocks.is_over() {
            return Ok(Progress::Idle);
        }
        let me = scene.entity(who).ok_or(ExecutorError::Missing { id: who })?;
        if self.state.blocks.tick(scene, &me) {
            self.hands.cancel(out);
            self.leave_step();
        }
        let step = match self.state.blocks.enter(scene, &me).0 {
            Entered::Step(step) => step,
            Entered::Guarding | Entered::Waiting => return Ok(Progress::Running),
            Entered::End => return Ok(Progress::Done),
        };
        let is_new = self.state.aim.is_none() && !self.state.in_hand;
        let begun = is_new.then(|| Box::new(step.clone()));
        let goes_on = begun.map_or(Progress::Running, |step| Progress::Begun { step });
        let aim = self.state.aim.or_else(|| Aim::of(&step));
        let stand = match aim {
            Some(aim) => {
                self.state.aim = Some(aim);
                self.steer(scene, &me, aim, out)?
            }
            None => self.handle(step, scene, who, out)?,
        };
        Ok(match stand {
            Stand::Underway => goes_on,
            Stand::Lost(reason) => {
                self.cancel(out);
                Progress::Failed { reason }
            }
            Stand::Done => {
                if aim.is_some() {
                    out.push(Action::Stop);
                }
                self.leave_step();
                self.state.blocks.move_on();
                if self.state.blocks.is_over() { Progress::Done } else { goes_on }
            }
        })
    }

    fn cancel(&mut self, out: &mut Vec<Action>) {
        self.hands.cancel(&mut Vec::new());
        self.state = State::default();
        out.push(Action::Stop);
    }

    fn save(&self) -> Vec<u8> {
        // Plain data, which postcard always takes.
        postcard::to_stdvec(&(&self.state, self.hands.save())).expect("plain data serialises")
    }

    fn restore(&mut self, saved: &[u8]) -> bool {
        match postcard::from_bytes::<(State, Vec<u8>)>(saved) {
            Ok((state, hands)) => {
                self.state = state;
                self.hands.restore(&hands)
            }
            Err(_) => false,
        }
    }

    fn state_hash(&self, hasher: &mut StateHasher) {
        hasher.bytes(&self.save());
    }
}
