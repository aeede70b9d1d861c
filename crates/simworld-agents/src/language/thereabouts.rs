//! Orders to a plan: where "there" leads.

use simworld_core::id::EntityId;
use simworld_core::scene::EntityKind;
use simworld_core::seam::{Goal, PlanError};

use super::clause::{Count, Reference};
use super::draft::{Draft, reach_of};
use super::resolve::Purpose;

impl Draft<'_> {
    /// Later words stand for it: "there" leads to it.
    pub(super) fn speak_of(&mut self, what: &Reference) -> Result<(), PlanError> {
        if what.count != Count::One {
            return self.view.find_all(what, Purpose::Any).map(|_| ());
        }
        let found = self.find(what, Purpose::Any)?;
        // "The bookshop is waiting for the letter, bring it there": the place is where it is brought.
        let leads = found.kind == EntityKind::Building || !self.spoken_of_place;
        if leads {
            self.spoken_of_place = found.kind == EntityKind::Building;
            self.there = Some((Goal::Entity(found.id), reach_of(&found)));
        }
        Ok(())
    }

    /// "There" stands for it from now on.
    pub(super) fn lead_to(&mut self, id: EntityId) {
        self.there = self.view.scene.entity(id).map(|entity| (Goal::Entity(id), reach_of(&entity)));
    }

    pub(super) const fn there_now(&self) -> Option<(Goal, f64)> {
        self.there
    }

    /// "There" leads where it did before something was gone to by the way.
    pub(super) fn leads_there(&mut self, there: Option<(Goal, f64)>) {
        self.there = there.or(self.there);
    }

    /// The thing that "there" stands for.
    pub(super) fn gone_to(&self) -> Option<EntityId> {
        match self.there {
            Some((Goal::Entity(id), _)) => Some(id),
            _ => None,
        }
    }

    /// Whether one will stand there already.
    pub(super) fn stands_there(&self) -> bool {
        const AT_IT: f64 = 1.0;
        self.there.is_none_or(|(goal, _)| {
            let beside = matches!(goal, Goal::Entity(id) if self.beside == Some(id));
            beside || (self.place_of(goal) - self.view.from).norm() < AT_IT
        })
    }
}
