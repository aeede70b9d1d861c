//! The rule-based executor: plans become primitive actions on the waypoint graph.
//!
//! Navigation takes the shortest way over sidewalks and crossings, starts to cross only on walk, passes people on the
//! right, and looks for another way when it gets stuck. An action on an object counts as done when the world shows its
//! effect.

mod act;
mod avoid;
mod crossing;
mod navigate;

use std::sync::Arc;

use navigate::{Arrival, Navigation};
use serde::{Deserialize, Serialize};
use simworld_core::action::Action;
use simworld_core::hash::StateHasher;
use simworld_core::id::EntityId;
use simworld_core::net::{Route, RouteScratch, WaypointGraph};
use simworld_core::scene::Scene;
use simworld_core::seam::{Executor, ExecutorError, Plan, PlanStep, Progress};

/// How a rule-based executor behaves.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct ExecutorConfig {
    /// Walking speed where a plan names none, m/s.
    pub speed: f64,
    /// How far it looks ahead for people and obstacles, m.
    pub look_ahead: f64,
    /// Time without progress after which it counts as stuck, s.
    pub patience: f64,
    /// Ways tried when stuck before it gives up.
    pub attempts: u32,
}

impl Default for ExecutorConfig {
    fn default() -> Self {
        Self { speed: 1.4, look_ahead: 2.0, patience: 3.0, attempts: 12 }
    }
}

/// Carries out plans by rules; one for each agent.
#[derive(Clone, Debug)]
pub struct RuleExecutor {
    config: ExecutorConfig,
    /// The ways there are; `None` goes straight.
    ways: Option<Arc<WaypointGraph>>,
    state: State,
    scratch: RouteScratch,
    route: Route,
}

/// Everything that a snapshot holds.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
struct State {
    plan: Plan,
    /// The step under way.
    step: usize,
    stage: Stage,
    /// What the body was told last.
    told_speed: f64,
}

/// How far the step under way has come.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
enum Stage {
    /// Not begun.
    #[default]
    Fresh,
    /// On the way.
    Navigating(Navigation),
    /// The action was told; its effect is looked for in the next step.
    Acted,
    /// Waiting, with the number of steps left.
    Waiting(u64),
}

impl RuleExecutor {
    /// An executor on a walkable graph, shared between agents.
    pub fn new(ways: Arc<WaypointGraph>) -> Self {
        Self::with_config(Some(ways), ExecutorConfig::default())
    }

    /// An executor that goes straight to its goals: for open ground.
    pub fn straight() -> Self {
        Self::with_config(None, ExecutorConfig::default())
    }

    /// An executor with settings of one's own.
    pub fn with_config(ways: Option<Arc<WaypointGraph>>, config: ExecutorConfig) -> Self {
        Self {
            config,
            ways,
            state: State::default(),
            scratch: RouteScratch::default(),
            route: Route::default(),
        }
    }

    /// Whether it has nothing to do.
    pub fn is_idle(&self) -> bool {
        self.state.step >= self.state.plan.steps.len()
    }

    fn next_step(&mut self) -> Progress {
        self.state.step += 1;
        self.state.stage = Stage::Fresh;
        if self.is_idle() { Progress::Done } else { Progress::Running }
    }

    fn fail(&mut self, reason: String, out: &mut Vec<Action>) -> Progress {
        self.cancel(out);
        Progress::Failed { reason }
    }

    fn tell_speed(&mut self, speed: f64, out: &mut Vec<Action>) {
        if speed == self.state.told_speed {
            return;
        }
        self.state.told_speed = speed;
        out.push(if speed > 0.0 { Action::MoveForward { speed } } else { Action::Stop });
    }
}

impl Executor for RuleExecutor {
    fn start(&mut self, plan: Plan, scene: &dyn Scene, who: EntityId) -> Result<(), ExecutorError> {
        if scene.entity(who).is_none() {
            return Err(ExecutorError::Missing { id: who });
        }
        if let Some(step) = plan.steps.iter().find(|step| !is_known(step)) {
            return Err(ExecutorError::Unsupported { step: format!("{step:?}") });
        }
        // What the body was told last stays true: it goes on moving until the new plan says otherwise.
        self.state = State { plan, told_speed: self.state.told_speed, ..State::default() };
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
        Ok(match self.state.plan.steps[self.state.step].clone() {
            PlanStep::Navigate { to, within, speed } => {
                let wanted = speed.unwrap_or(self.config.speed);
                match self.navigate(scene, &me, &to, within, wanted, out) {
                    Arrival::Underway => Progress::Running,
                    Arrival::There => {
                        self.tell_speed(0.0, out);
                        self.next_step()
                    }
                    Arrival::Lost(reason) => self.fail(reason, out),
                }
            }
            PlanStep::Act(action) => self.act(scene, who, action, out),
            PlanStep::Wait { seconds } => self.wait(scene, seconds, out),
            other => self.fail(format!("cannot carry out {other:?}"), out),
        })
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
        hasher.u64(self.state.step as u64).u64(self.state.plan.steps.len() as u64).f64(self.state.told_speed);
        match &self.state.stage {
            Stage::Fresh => hasher.u64(0),
            Stage::Navigating(navigation) => navigation.state_hash(hasher.u64(1)),
            Stage::Acted => hasher.u64(2),
            Stage::Waiting(left) => hasher.u64(3).u64(*left),
        };
    }
}

fn is_known(step: &PlanStep) -> bool {
    matches!(step, PlanStep::Navigate { .. } | PlanStep::Act(_) | PlanStep::Wait { .. })
}
