//! The rule-based executor: plans become primitive actions on the waypoint graph.
//!
//! Navigation takes the shortest way over sidewalks and crossings, starts to cross only on walk, passes people on the
//! right, and looks for another way when it gets stuck. Vehicles keep to lanes, limits and lights (see `drive`). An action on an object counts as done when the world shows its
//! effect. Conditions, repetitions and guards are looked at in every step.

mod act;
mod avoid;
mod blocks;
mod condition;
mod crossing;
mod drive;
mod ground;
mod navigate;
mod sight;

use std::sync::Arc;

pub(crate) use blocks::{Blocks, Entered};
pub use drive::CannotArrive;
use drive::{Driving, vehicle_of};
use navigate::{Arrival, Navigation};
use serde::{Deserialize, Serialize};
pub(crate) use sight::sees;
pub(crate) use sight::{crosses, eyes, hides, looked_at};
use simworld_core::action::Action;
use simworld_core::hash::StateHasher;
use simworld_core::id::EntityId;
use simworld_core::net::WaypointGraph;
use simworld_core::scene::{EntityRef, Scene};
use simworld_core::seam::{Executor, ExecutorError, Goal, Plan, PlanStep, Progress};
use thiserror::Error;

/// How a rule-based executor behaves.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct ExecutorConfig {
    /// Walking speed where a plan names none, m/s, 0.1 to 20.
    pub speed: f64,
    /// How far it looks ahead for people and obstacles, m, 0 to 50; 0 turns avoidance off.
    pub look_ahead: f64,
    /// Time without progress after which it counts as stuck, s, 0.5 to 600.
    pub patience: f64,
    /// Ways tried when stuck before it gives up, 0 to 1000.
    pub attempts: u32,
    /// Time at one kerb after which it gives up, s, 1 to 86 400: longer than any red, so that only a crossing that
    /// never clears exhausts it.
    pub kerb_patience: f64,
}

impl Default for ExecutorConfig {
    fn default() -> Self {
        Self { speed: 1.4, look_ahead: 2.0, patience: 3.0, attempts: 12, kerb_patience: 300.0 }
    }
}

/// A setting that no executor can work with.
#[derive(Clone, Debug, PartialEq, Error)]
#[error("{field} = {value} is out of range: give {allowed}")]
pub struct ExecutorConfigError {
    /// The setting.
    pub field: &'static str,
    /// Its value.
    pub value: f64,
    /// What is allowed.
    pub allowed: &'static str,
}

impl ExecutorConfig {
    /// Checks every field against its range; NaN is in none.
    ///
    /// # Errors
    /// The first field out of range.
    pub fn validate(&self) -> Result<(), ExecutorConfigError> {
        let checks = [
            ("speed", self.speed, 0.1..=20.0, "0.1 to 20 m/s"),
            ("look_ahead", self.look_ahead, 0.0..=50.0, "0 to 50 m"),
            ("patience", self.patience, 0.5..=600.0, "0.5 to 600 s"),
            ("attempts", f64::from(self.attempts), 0.0..=1000.0, "0 to 1000"),
            ("kerb_patience", self.kerb_patience, 1.0..=86_400.0, "1 to 86 400 s"),
        ];
        for (field, value, range, allowed) in checks {
            if !range.contains(&value) {
                return Err(ExecutorConfigError { field, value, allowed });
            }
        }
        Ok(())
    }
}

/// Carries out plans by rules; one for each agent.
#[derive(Clone, Debug)]
pub struct RuleExecutor {
    config: ExecutorConfig,
    /// The ways there are; `None` goes straight.
    ways: Option<Arc<WaypointGraph>>,
    state: State,
    /// Why it goes on otherwise than before, told in the step in which that is so.
    rerouted: Option<&'static str>,
}

/// Everything that a snapshot holds.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
struct State {
    /// Where it is in its plan.
    blocks: Blocks,
    stage: Stage,
    /// The speed the body was told last, m/s; unknown after anybody else may have told it something.
    told_speed: Option<f64>,
    /// Why the last drive was given up.
    trouble: Option<CannotArrive>,
}

/// How far the step under way has come.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
enum Stage {
    /// Not begun.
    #[default]
    Fresh,
    /// On the way.
    Navigating(Navigation),
    /// On the way in a vehicle.
    Driving(Box<Driving>),
    /// The action was told; its effect is looked for in the next step.
    Acted,
    /// Waiting, with the number of steps left.
    Waiting(u64),
    /// Beside whom it follows.
    Beside,
}

impl RuleExecutor {
    /// An executor on a walkable graph, shared between agents.
    pub fn new(ways: Arc<WaypointGraph>) -> Self {
        Self::made_of(Some(ways), ExecutorConfig::default())
    }

    /// An executor that goes straight to its goals: for open ground.
    pub fn straight() -> Self {
        Self::made_of(None, ExecutorConfig::default())
    }

    /// An executor with settings of one's own, on a walkable graph or, without one, straight to its goals.
    ///
    /// # Errors
    /// A setting out of range.
    pub fn with_config(
        ways: Option<Arc<WaypointGraph>>,
        config: ExecutorConfig,
    ) -> Result<Self, ExecutorConfigError> {
        config.validate()?;
        Ok(Self::made_of(ways, config))
    }

    fn made_of(ways: Option<Arc<WaypointGraph>>, config: ExecutorConfig) -> Self {
        Self { config, ways, state: State::default(), rerouted: None }
    }

    /// The step of the plan under way; of blocks the innermost.
    pub fn under_way(&self) -> Option<&PlanStep> {
        self.state.blocks.current()
    }

    /// Whether it has nothing to do.
    pub fn is_idle(&self) -> bool {
        self.state.blocks.is_over()
    }

    /// Why the last plan failed, if it did on the road: the reason of [`Progress::Failed`], typed. The next plan clears it.
    pub fn cannot_arrive(&self) -> Option<&CannotArrive> {
        self.state.trouble.as_ref()
    }

    /// On foot, or by whatever one is or sits in.
    fn go(
        &mut self,
        scene: &dyn Scene,
        me: &EntityRef<'_>,
        to: Goal,
        within: f64,
        speed: Option<f64>,
        out: &mut Vec<Action>,
    ) -> Arrival {
        match vehicle_of(scene, me) {
            Some(vehicle) => self.drive(scene, me, &vehicle, (to, within), speed, out),
            None => self.navigate(scene, me, to, within, speed.unwrap_or(self.config.speed), out),
        }
    }

    /// Looks at the guards of the blocks that it is in, and goes into blocks until there is something to do.
    fn enter(&mut self, scene: &dyn Scene, me: &EntityRef<'_>, out: &mut Vec<Action>) -> Entered {
        if self.state.blocks.tick(scene, me) {
            self.state.stage = Stage::Fresh;
            self.state.told_speed = None;
            self.tell_speed(0.0, out);
        }
        let (entered, is_new) = self.state.blocks.enter(scene, me);
        if is_new {
            self.state.stage = Stage::Fresh;
        }
        if matches!(entered, Entered::Guarding) {
            self.tell_speed(0.0, out);
        }
        entered
    }

    /// Does what a step asks for now.
    fn take(
        &mut self,
        scene: &dyn Scene,
        me: &EntityRef<'_>,
        step: PlanStep,
        out: &mut Vec<Action>,
    ) -> Progress {
        match step {
            PlanStep::Navigate { to, within, speed } => match self.go(scene, me, to, within, speed, out) {
                Arrival::Underway => Progress::Running,
                Arrival::There => {
                    self.tell_speed(0.0, out);
                    self.next_step()
                }
                Arrival::Lost(reason) => self.fail(reason, out),
            },
            PlanStep::Follow { whom, gap, speed } => {
                match self.go(scene, me, Goal::Entity(whom), gap, speed, out) {
                    Arrival::Underway => Progress::Running,
                    Arrival::There => {
                        self.state.stage = Stage::Beside;
                        self.tell_speed(0.0, out);
                        Progress::Running
                    }
                    Arrival::Lost(reason) => self.fail(reason, out),
                }
            }
            PlanStep::Face { to } => self.face(scene, me, to, out),
            PlanStep::Point { at } => self.point(scene, me, at, out),
            PlanStep::Act(action) => self.act(scene, me.id, action, out),
            PlanStep::Wait { seconds } => self.wait(scene, seconds, out),
            other => self.fail(format!("cannot carry out {other:?}"), out),
        }
    }

    /// Goes on to what comes next.
    fn next_step(&mut self) -> Progress {
        self.state.stage = Stage::Fresh;
        self.state.blocks.move_on();
        if self.is_idle() { Progress::Done } else { Progress::Running }
    }

    /// How far it is, with what is new about it.
    fn told(&mut self, progress: Progress, begun: Option<PlanStep>) -> Progress {
        match (progress, begun, self.rerouted.take()) {
            (Progress::Running, Some(step), _) => Progress::Begun { step: Box::new(step) },
            (Progress::Running, None, Some(reason)) => Progress::Rerouted { reason: reason.to_owned() },
            (progress, ..) => progress,
        }
    }

    fn fail(&mut self, reason: String, out: &mut Vec<Action>) -> Progress {
        let trouble = self.state.trouble.take();
        self.cancel(out);
        self.state.trouble = trouble;
        Progress::Failed { reason }
    }

    fn tell_speed(&mut self, speed: f64, out: &mut Vec<Action>) {
        if self.state.told_speed == Some(speed) {
            return;
        }
        self.state.told_speed = Some(speed);
        out.push(if speed > 0.0 { Action::MoveForward { speed } } else { Action::Stop });
    }
}

impl Executor for RuleExecutor {
    fn start(&mut self, plan: Plan, scene: &dyn Scene, who: EntityId) -> Result<(), ExecutorError> {
        if scene.entity(who).is_none() {
            return Err(ExecutorError::Missing { id: who });
        }
        if let Some(step) = plan.steps.iter().find(|step| !blocks::can_be_done(step, 0)) {
            return Err(ExecutorError::Unsupported { step: format!("{step:?}") });
        }
        self.state = State { blocks: Blocks::new(plan), ..State::default() };
        Ok(())
    }

    fn advance(
        &mut self,
        scene: &dyn Scene,
        who: EntityId,
        out: &mut Vec<Action>,
    ) -> Result<Progress, ExecutorError> {
        if self.is_idle() {
            return Ok(Progress::Idle);
        }
        let me = scene.entity(who).ok_or(ExecutorError::Missing { id: who })?;
        let step = match self.enter(scene, &me, out) {
            Entered::Step(step) => step,
            Entered::Guarding | Entered::Waiting => return Ok(Progress::Running),
            Entered::End => return Ok(Progress::Done),
        };
        let begun = (self.state.stage == Stage::Fresh).then(|| step.clone());
        let progress = self.take(scene, &me, step, out);
        Ok(self.told(progress, begun))
    }

    fn cancel(&mut self, out: &mut Vec<Action>) {
        self.state = State::default();
        out.push(Action::Stop);
    }

    fn save(&self) -> Vec<u8> {
        // The state is plain data, which postcard always takes.
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

    fn state_hash(&self, hasher: &mut StateHasher) {
        // The saved bytes are the whole state.
        hasher.bytes(&self.save());
    }
}
