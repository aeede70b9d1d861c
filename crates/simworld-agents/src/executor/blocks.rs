//! Where in a plan an executor is: blocks within blocks, and the guards that end them. Every executor has one of these.

use serde::{Deserialize, Serialize};
use simworld_core::scene::{EntityRef, Scene};
use simworld_core::seam::{Condition, Goal, Plan, PlanStep};

use super::condition;

/// How deep blocks may nest in a plan.
const DEEPEST: u32 = 16;
/// How often a block may be repeated.
const MOST_TIMES: u32 = 1_000_000;

/// A plan under way.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Blocks {
    plan: Plan,
    /// A place for each block that it is in, the outermost first; none when there is nothing to do any more.
    place: Vec<Place>,
    /// Since when it waits for the condition of a guard without steps, in ticks of the list that it stands in.
    guarding: Option<u64>,
}

/// A place in one list of steps.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
struct Place {
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
pub(crate) enum Entered {
    /// A step that is no block.
    Step(PlanStep),
    /// Nothing, until a condition holds.
    Guarding,
    /// Nothing, until the next step of the simulation: a block begins anew.
    Waiting,
    /// Nothing any more.
    End,
}

impl Blocks {
    /// At the beginning of a plan.
    pub(crate) fn new(plan: Plan) -> Self {
        let place = if plan.steps.is_empty() { Vec::new() } else { vec![Place::default()] };
        Self { plan, place, guarding: None }
    }

    /// Whether there is nothing to do any more.
    pub(crate) fn is_over(&self) -> bool {
        self.place.is_empty()
    }

    /// Another step of the simulation: whether a guard has come to hold, so that its block is left, the outermost first. What was
    /// under way in it is to be given up.
    pub(crate) fn tick(&mut self, scene: &dyn Scene, me: &EntityRef<'_>) -> bool {
        for place in &mut self.place {
            place.ticks += 1;
        }
        for depth in 1..self.place.len() {
            let elapsed = self.place[depth].ticks as f64 * scene.clock().dt();
            let Some(PlanStep::Until { condition, .. }) = self.block_at(depth) else { continue };
            if condition::holds(condition, scene, me, elapsed) {
                self.place.truncate(depth);
                self.move_on();
                return true;
            }
        }
        false
    }

    /// Goes into blocks until there is something to do; and whether that is another step than the one it was at.
    pub(crate) fn enter(&mut self, scene: &dyn Scene, me: &EntityRef<'_>) -> (Entered, bool) {
        let mut is_new = false;
        loop {
            let Some(step) = self.current() else { return (Entered::End, is_new) };
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
                    let now = self.place.last().map_or(0, |place| place.ticks);
                    let since = self.guarding.unwrap_or(now);
                    let elapsed = (now - since) as f64 * scene.clock().dt();
                    if condition::holds(condition, scene, me, elapsed) {
                        None
                    } else if steps.is_empty() {
                        self.guarding = Some(since);
                        return (Entered::Guarding, is_new);
                    } else {
                        Some(Place::default())
                    }
                }
                plain => return (Entered::Step(plain.clone()), is_new),
            };
            is_new = true;
            if let Some(place) = inner {
                self.guarding = None;
                self.place.push(place);
            } else if self.move_on() {
                return (Entered::Waiting, is_new);
            }
        }
    }

    /// The block in which the place at that depth lies.
    fn block_at(&self, depth: usize) -> Option<&PlanStep> {
        let mut steps = &self.plan.steps[..];
        let mut block = None;
        for (at, place) in self.place.iter().enumerate().take(depth) {
            block = steps.get(place.step);
            steps = inner(block?, self.place.get(at + 1)?);
        }
        block
    }

    /// The step under way, block or not.
    pub(crate) fn current(&self) -> Option<&PlanStep> {
        let mut steps = &self.plan.steps[..];
        let mut current = None;
        for (at, place) in self.place.iter().enumerate() {
            current = Some(steps.get(place.step)?);
            if let (Some(step), Some(next)) = (current, self.place.get(at + 1)) {
                steps = inner(step, next);
            }
        }
        current
    }

    /// On to the next step, out of the blocks that end with this one; whether one of them begins anew.
    pub(crate) fn move_on(&mut self) -> bool {
        self.guarding = None;
        loop {
            let depth = self.place.len();
            let Some(place) = self.place.last_mut() else { return false };
            place.step += 1;
            if self.current().is_some() {
                return false;
            }
            // The list is at its end: the block around it is done, or goes round once more.
            let (is_until, times) = match self.block_at(depth - 1) {
                Some(PlanStep::Until { .. }) => (true, 0),
                Some(PlanStep::Repeat { times, .. }) => (false, *times),
                _ => (false, 0),
            };
            let Some(place) = self.place.last_mut() else { return false };
            place.rounds += 1;
            if is_until || place.rounds < times {
                place.step = 0;
                return true;
            }
            self.place.pop();
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
        Condition::Near { within, .. }
        | Condition::FreeNear { within, .. }
        | Condition::Together { within, .. } => within.is_finite(),
        Condition::Elapsed(seconds) => seconds.is_finite(),
        Condition::Not(inner) => depth < DEEPEST && is_sound(inner, depth + 1),
        Condition::All(inner) | Condition::Any(inner) => {
            depth < DEEPEST && inner.iter().all(|inner| is_sound(inner, depth + 1))
        }
        _ => true,
    }
}
