//! Where in a plan the eyes are: a stack of blocks.

use serde::{Deserialize, Serialize};
use simworld_core::scene::{EntityRef, Scene};
use simworld_core::seam::{Condition, Plan, PlanStep};

use crate::executor::holds;

/// The steps of a block, and which is under way.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct Block {
    steps: Vec<PlanStep>,
    next: usize,
    kind: Kind,
    /// Steps of the simulation since it was come to.
    ticks: u64,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
enum Kind {
    Once,
    /// So many times more after this.
    Repeat(u32),
    Until(Condition),
}

/// What is to be done now.
pub(super) enum Next {
    /// A step that is no block.
    Step(PlanStep),
    /// Nothing, until the next step of the simulation.
    Wait,
    /// Nothing any more.
    End,
}

/// A plan under way.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Agenda {
    blocks: Vec<Block>,
}

impl Agenda {
    pub(super) fn new(plan: Plan) -> Self {
        let mut agenda = Self::default();
        agenda.enter(plan.steps, Kind::Once);
        agenda
    }

    pub(super) fn is_empty(&self) -> bool {
        self.blocks.is_empty()
    }

    fn enter(&mut self, steps: Vec<PlanStep>, kind: Kind) {
        if !steps.is_empty() || matches!(kind, Kind::Until(_)) {
            self.blocks.push(Block { steps, next: 0, kind, ticks: 0 });
        }
    }

    /// Another step of the simulation: whether a guard has come to hold, so that its block is left, the outermost first.
    pub(super) fn tick(&mut self, scene: &dyn Scene, me: &EntityRef<'_>) -> bool {
        let dt = scene.clock().dt();
        let ended = self.blocks.iter_mut().position(|block| {
            block.ticks += 1;
            let elapsed = (block.ticks - 1) as f64 * dt;
            matches!(&block.kind, Kind::Until(condition) if holds(condition, scene, me, elapsed))
        });
        if let Some(depth) = ended {
            self.blocks.truncate(depth);
        }
        ended.is_some()
    }

    /// Goes into blocks until there is a step.
    pub(super) fn next(&mut self, scene: &dyn Scene, me: &EntityRef<'_>) -> Next {
        loop {
            let Some(block) = self.blocks.last_mut() else { return Next::End };
            if block.next >= block.steps.len() {
                match &mut block.kind {
                    Kind::Until(_) => {
                        block.next = 0;
                        return Next::Wait;
                    }
                    Kind::Repeat(left) if *left > 0 => {
                        *left -= 1;
                        block.next = 0;
                    }
                    _ => drop(self.blocks.pop()),
                }
                continue;
            }
            let step = block.steps[block.next].clone();
            match step {
                PlanStep::If { condition, then, otherwise } => {
                    block.next += 1;
                    let chosen = if holds(&condition, scene, me, 0.0) { then } else { otherwise };
                    self.enter(chosen, Kind::Once);
                }
                PlanStep::Repeat { times, steps } => {
                    block.next += 1;
                    if times > 0 {
                        self.enter(steps, Kind::Repeat(times - 1));
                    }
                }
                PlanStep::Until { condition, steps } => {
                    block.next += 1;
                    if !holds(&condition, scene, me, 0.0) {
                        self.enter(steps, Kind::Until(condition));
                    }
                }
                plain => return Next::Step(plain),
            }
        }
    }

    /// The step under way is done.
    pub(super) fn done(&mut self) {
        if let Some(block) = self.blocks.last_mut() {
            block.next += 1;
        }
    }
}
