//! Where in a plan the executor is: blocks within blocks, and the guards that end them.

use serde::{Deserialize, Serialize};
use simworld_core::action::Action;
use simworld_core::scene::{EntityRef, Scene};
use simworld_core::seam::{Condition, Goal, PlanStep};

use super::{RuleExecutor, Stage, condition};

/// How deep blocks may nest in a plan.
const DEEPEST: u32 = 16;
/// How often a block may be repeated.
const MOST_TIMES: u32 = 1_000_000;

/// A place in one list of steps.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Place {
    /// The step under way.
    step: usize,
    /// Whether the steps are those of an `otherwise`.
    otherwise: bool,
    /// How often the block that the steps belong to was done to its end.
    rounds: u32,
    /// The time since the block was come to, in steps of the simulation.
    ticks: u64,
}

/// What there is to do now.
pub(super) enum Entered {
    /// A step that is no block.
    Step(PlanStep),
    /// Nothing, until a condition holds or the next step of the simulation.
    Waiting,
    /// Nothing any more.
    End,
}

impl RuleExecutor {
    /// Looks at the guards of the blocks that it is in, and goes into blocks until there is something to do.
    pub(super) fn enter(&mut self, scene: &dyn Scene, me: &EntityRef<'_>, out: &mut Vec<Action>) -> Entered {
        for place in &mut self.state.place {
            place.ticks += 1;
        }
        self.break_off(scene, me, out);
        loop {
            let Some(step) = self.current() else { return Entered::End };
            let inner = match step {
                PlanStep::If { condition, then, otherwise } => {
                    let holds = condition::holds(condition, scene, me, 0.0);
                    let chosen = if holds { then } else { otherwise };
                    (!chosen.is_empty()).then_some(Place { otherwise: !holds, ..Place::default() })
                }
                PlanStep::Repeat { times, steps } => {
                    (*times > 0 && !steps.is_empty()).then_some(Place::default())
                }
                PlanStep::Until { condition, steps } => {
                    let waited = self.state.place.last().map_or(0, |place| place.ticks);
                    let begun = matches!(self.state.stage, Stage::Guarding(_));
                    let since = if let Stage::Guarding(since) = self.state.stage { since } else { waited };
                    let elapsed = (waited - since) as f64 * scene.clock().dt();
                    if condition::holds(condition, scene, me, elapsed) {
                        None
                    } else if steps.is_empty() {
                        if !begun {
                            self.state.stage = Stage::Guarding(waited);
                        }
                        self.tell_speed(0.0, out);
                        return Entered::Waiting;
                    } else {
                        Some(Place::default())
                    }
                }
                plain => return Entered::Step(plain.clone()),
            };
            self.state.stage = Stage::Fresh;
            if let Some(place) = inner {
                self.state.place.push(place);
            } else if self.move_on() {
                return Entered::Waiting; // begun anew: in the next step of the simulation
            }
        }
    }

    /// Leaves the outermost block whose condition has come to hold.
    fn break_off(&mut self, scene: &dyn Scene, me: &EntityRef<'_>, out: &mut Vec<Action>) {
        for depth in 1..self.state.place.len() {
            let elapsed = self.state.place[depth].ticks as f64 * scene.clock().dt();
            let Some(PlanStep::Until { condition, .. }) = self.block_at(depth) else { continue };
            if condition::holds(condition, scene, me, elapsed) {
                self.state.place.truncate(depth);
                self.state.stage = Stage::Fresh;
                self.state.told_speed = None;
                self.tell_speed(0.0, out);
                self.move_on();
                return;
            }
        }
    }

    /// The block in which the place at that depth lies.
    fn block_at(&self, depth: usize) -> Option<&PlanStep> {
        let mut steps = &self.state.plan.steps[..];
        let mut block = None;
        for (at, place) in self.state.place.iter().enumerate().take(depth) {
            block = steps.get(place.step);
            steps = inner(block?, self.state.place.get(at + 1)?);
        }
        block
    }

    /// The step under way, block or not.
    pub(super) fn current(&self) -> Option<&PlanStep> {
        let mut steps = &self.state.plan.steps[..];
        let mut current = None;
        for (at, place) in self.state.place.iter().enumerate() {
            current = Some(steps.get(place.step)?);
            if let (Some(step), Some(next)) = (current, self.state.place.get(at + 1)) {
                steps = inner(step, next);
            }
        }
        current
    }

    /// On to the next step, out of the blocks that end with this one; whether one of them began anew.
    pub(super) fn move_on(&mut self) -> bool {
        loop {
            let depth = self.state.place.len();
            let Some(place) = self.state.place.last_mut() else { return false };
            place.step += 1;
            if self.current().is_some() {
                return false;
            }
            // The list is at its end: the block around it is done, or goes round once more.
            let around = self.block_at(depth - 1).cloned();
            let Some(place) = self.state.place.last_mut() else { return false };
            place.rounds += 1;
            let again = match around {
                Some(PlanStep::Until { .. }) => true,
                Some(PlanStep::Repeat { times, .. }) => place.rounds < times,
                _ => false,
            };
            if again {
                place.step = 0;
                return true;
            }
            self.state.place.pop();
        }
    }
}

/// The steps of a block that a place lies in.
fn inner<'a>(block: &'a PlanStep, place: &Place) -> &'a [PlanStep] {
    match block {
        PlanStep::If { otherwise, .. } if place.otherwise => otherwise,
        PlanStep::If { then: steps, .. } | PlanStep::Repeat { steps, .. } | PlanStep::Until { steps, .. } => {
            steps
        }
        _ => &[],
    }
}

/// Whether the step is of a known kind, and its numbers are ones that an execution can come to the end of.
pub(super) fn can_be_done(step: &PlanStep, depth: u32) -> bool {
    let all = |steps: &[PlanStep]| depth < DEEPEST && steps.iter().all(|step| can_be_done(step, depth + 1));
    let is_place = |goal: &Goal| match goal {
        Goal::Point(point) => point.iter().all(|number| number.is_finite()),
        Goal::Entity(_) => true,
        _ => false,
    };
    let is_speed = |speed: &Option<f64>| speed.is_none_or(|speed| speed.is_finite() && speed > 0.0);
    match step {
        PlanStep::Navigate { to, within, speed } => {
            is_place(to) && within.is_finite() && *within >= 0.0 && is_speed(speed)
        }
        PlanStep::Follow { gap, speed, .. } => gap.is_finite() && *gap >= 0.0 && is_speed(speed),
        PlanStep::Face { to } | PlanStep::Point { at: to } => is_place(to),
        PlanStep::Act(_) => true,
        PlanStep::Wait { seconds } => seconds.is_finite() && *seconds >= 0.0,
        PlanStep::If { condition, then, otherwise } => is_sound(condition, 0) && all(then) && all(otherwise),
        PlanStep::Repeat { times, steps } => *times <= MOST_TIMES && all(steps),
        PlanStep::Until { condition, steps } => is_sound(condition, 0) && all(steps),
        _ => false,
    }
}

fn is_sound(condition: &Condition, depth: u32) -> bool {
    match condition {
        Condition::Near { within, .. } | Condition::FreeNear { within, .. } => within.is_finite(),
        Condition::Elapsed(seconds) => seconds.is_finite(),
        Condition::Not(inner) => depth < DEEPEST && is_sound(inner, depth + 1),
        Condition::All(inner) | Condition::Any(inner) => {
            depth < DEEPEST && inner.iter().all(|inner| is_sound(inner, depth + 1))
        }
        _ => true,
    }
}
