//! What hands are told: actions that the physics carries out on things, and no body alone.

use simworld_core::action::Action;
use simworld_core::event::EventKind;
use simworld_core::id::EntityId;
use simworld_core::scene::World;

use crate::dynamics::PhysicsDynamics;
use crate::{Grip, PhysicsError};

impl PhysicsDynamics {
    /// Throws what this step's actions say, before the world is looked at: what flies is free by then.
    pub(crate) fn throw_as_told(&mut self, world: &mut World) {
        let told = self.told(world, |action| matches!(action, Action::Throw { .. } | Action::ThrowTo { .. }));
        for (who, action) in told {
            let done = match &action {
                Action::Throw { velocity } => self.throw(world, who, *velocity).map(drop),
                Action::ThrowTo { to } => self.throw_to(world, who, *to).map(drop),
                _ => Ok(()),
            };
            self.note_failure(who, &action, done);
        }
    }

    /// Takes hold and lets go as this step's actions say.
    pub(crate) fn grasp_as_told(&mut self, world: &World) {
        let told = self.told(world, |action| matches!(action, Action::Grasp { .. } | Action::LetGo));
        for (who, action) in told {
            let done = match &action {
                Action::Grasp { thing, both_hands } => {
                    let grip = if *both_hands { Grip::both_hands() } else { Grip::default() };
                    self.grasp(world, who, *thing, None, grip)
                }
                _ if self.let_go(who) == 0 => Err(PhysicsError::NoGrasp { id: who }),
                _ => Ok(()),
            };
            self.note_failure(who, &action, done);
        }
    }

    /// What bodies of this physics that can do such a thing were told, in order.
    fn told(&self, world: &World, is_meant: impl Fn(&Action) -> bool) -> Vec<(EntityId, Action)> {
        let can = |who: EntityId, action: &Action| {
            self.body(who).is_some_and(|body| body.supports().contains(action.kind()))
        };
        let actions = world.actuations().iter();
        actions.filter(|(who, action)| is_meant(action) && can(*who, action)).cloned().collect()
    }

    fn note_failure(&mut self, who: EntityId, action: &Action, done: Result<(), PhysicsError>) {
        if let Err(error) = done {
            let (action, reason) = (action.kind(), error.to_string());
            self.failures.push(EventKind::ActionFailed { who, action, reason });
        }
    }
}
