//! What every plan must be, whoever made it.

use simworld_agents::executor::RuleExecutor;
use simworld_core::action::{Action, ActionSet};
use simworld_core::id::EntityId;
use simworld_core::scene::{Scene, World};
use simworld_core::seam::{Executor, Goal, Plan, PlanStep};

/// Every action is one of the body's, every thing is there, and an executor takes the plan.
pub(crate) fn check_plan(plan: &Plan, world: &World, who: EntityId, able: ActionSet) {
    fn visit(steps: &[PlanStep], see: &mut dyn FnMut(&PlanStep)) {
        for step in steps {
            see(step);
            match step {
                PlanStep::If { then, otherwise, .. } => {
                    visit(then, see);
                    visit(otherwise, see);
                }
                PlanStep::Repeat { steps, .. } | PlanStep::Until { steps, .. } => visit(steps, see),
                _ => {}
            }
        }
    }
    assert!(!plan.steps.is_empty(), "an empty plan does nothing in silence");
    visit(&plan.steps, &mut |step| match step {
        PlanStep::Act(action) => {
            assert!(able.contains(action.kind()), "{action:?} is none of this body's");
            let (Action::SitDown { seat: id }
            | Action::PickUp { item: id }
            | Action::CarryHeavy { item: id }
            | Action::Give { to: id }
            | Action::ThrowTo { to: id }
            | Action::Buy { from: id, .. }
            | Action::EnterCar { car: id }
            | Action::RideScooter { scooter: id }
            | Action::OpenDoor { door: id }
            | Action::CloseDoor { door: id }
            | Action::Converse { with: id, .. }
            | Action::Argue { with: id }
            | Action::WaveHand { to: id }) = action
            else {
                return;
            };
            assert!(world.entity(*id).is_some(), "{action:?} is about nothing");
        }
        PlanStep::Navigate { to: Goal::Entity(id), .. } | PlanStep::Follow { whom: id, .. } => {
            assert!(world.entity(*id).is_some() && *id != who, "{step:?} is about nothing");
        }
        _ => {}
    });
    let mut executor = RuleExecutor::straight();
    executor.start(plan.clone(), world, who).expect("an executor takes the plan");
}
