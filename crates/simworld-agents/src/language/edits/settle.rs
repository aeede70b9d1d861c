//! Several things that fit, and nothing that says which: it is asked, or a policy takes one and that is told.

use std::cell::RefCell;

use simworld_core::id::EntityId;
use simworld_core::scene::Scene;
use simworld_core::seam::PlanError;

use super::super::AmbiguityPolicy;
use super::super::clause::Reference;
use super::super::resolve::View;
use super::resolve::Finder;
use super::{Focus, Reading, view_of};
use crate::editing::{Edit, EditError, Stock, Taken, called};

/// A policy, and what it took.
#[derive(Debug)]
pub(super) struct Settling {
    policy: AmbiguityPolicy,
    taken: RefCell<Vec<Taken>>,
}

impl Settling {
    fn note(&self, taken: Taken) {
        let mut all = self.taken.borrow_mut();
        // The same phrase is looked up more than once.
        if !all.contains(&taken) {
            all.push(taken);
        }
    }
}

impl Reading {
    /// The edits that a wish means in the scene as it is: those of its first reading whose things are there. Which is meant of
    /// several is asked first, so that what is clear in another reading is so under every policy; then the policy takes one. The first
    /// wish is asked for in the scene in which the sentence was read, so that what it came to then is what it comes to.
    pub(crate) fn resolve(
        &self,
        index: usize,
        scene: &dyn Scene,
        stock: &Stock,
        focus: &Focus,
        policy: AmbiguityPolicy,
    ) -> Result<(Vec<Edit>, Vec<Taken>), EditError> {
        if index == 0
            && focus.any_of == self.any_of
            && let Some(edits) = self.held.as_ref().and_then(|held| held.edits.clone())
        {
            return Ok((edits, Vec::new()));
        }
        let finder = Finder { scene, stock, focus, view: view_of(scene, focus), settling: None };
        let asked = self.resolve_by(index, &finder);
        if policy == AmbiguityPolicy::Ask || !matches!(asked, Err(EditError::Ambiguous { .. })) {
            return Ok((asked?, Vec::new()));
        }
        let settling = Settling { policy, taken: RefCell::default() };
        let edits = self.resolve_by(index, &Finder { settling: Some(&settling), ..finder })?;
        Ok((edits, settling.taken.into_inner()))
    }

    fn resolve_by(&self, index: usize, finder: &Finder<'_>) -> Result<Vec<Edit>, EditError> {
        let mut refused = None;
        for wish in self.wishes.get(index).into_iter().flatten() {
            match finder.edits(wish) {
                Ok(edits) => return Ok(edits),
                Err(error) => refused = refused.or(Some(error)),
            }
            // What was taken in a reading that came to nothing was not.
            if let Some(settling) = finder.settling {
                settling.taken.borrow_mut().clear();
            }
        }
        let words = self.words.clone();
        Err(refused.unwrap_or(EditError::NotUnderstood {
            words,
            fragment: String::new(),
            hint: super::parse::UNDERSTOOD.to_owned(),
        }))
    }
}

impl Finder<'_> {
    /// The same, as the scene is looked at with another focus.
    pub(super) fn looking_with<'b>(&'b self, focus: &'b Focus, view: View<'b>) -> Finder<'b> {
        Finder { scene: self.scene, stock: self.stock, focus, view, settling: self.settling }
    }

    /// So many of those that fit, where nothing says which: those that the policy takes, or a question.
    pub(super) fn some_of(
        &self,
        reference: &Reference,
        found: &[EntityId],
        count: usize,
    ) -> Result<Vec<EntityId>, EditError> {
        let settling = self.settling.filter(|settling| settling.policy != AmbiguityPolicy::Ask);
        let Some(settling) = settling else { return Err(self.ambiguous(reference, found)) };
        let mut ranked = found.to_vec();
        ranked.sort_unstable();
        if settling.policy == AmbiguityPolicy::Nearest {
            // Of equally near ones the first.
            ranked.sort_by(|a, b| self.distance_to(*a).total_cmp(&self.distance_to(*b)));
        }
        ranked.truncate(count);
        for thing in &ranked {
            settling.note(Taken {
                wanted: reference.text.clone(),
                thing: *thing,
                label: self.label(*thing),
                of: found.len(),
                policy: settling.policy,
            });
        }
        Ok(ranked)
    }

    /// One of those of which each is as much the most of something as the others.
    pub(super) fn one_of_shared(
        &self,
        reference: &Reference,
        refused: PlanError,
    ) -> Result<EntityId, EditError> {
        match (refused, self.settling) {
            (PlanError::Ambiguous { candidates, .. }, Some(_)) if !candidates.is_empty() => {
                let found: Vec<EntityId> = candidates.into_iter().map(|(id, _)| id).collect();
                Ok(self.some_of(reference, &found, 1)?[0])
            }
            (refused, _) => Err(refused.into()),
        }
    }

    /// One of the two in the middle of a row of an even number.
    pub(super) fn one_of_the_middle(
        &self,
        reference: &Reference,
        all: &[EntityId],
    ) -> Result<Vec<EntityId>, EditError> {
        let half = all.len() / 2;
        match (all.get(half.saturating_sub(1)..=half), self.settling) {
            (Some(both), Some(_)) => self.some_of(reference, both, 1),
            _ => Err(self.ambiguous(reference, all)),
        }
    }

    pub(super) fn ambiguous(&self, reference: &Reference, found: &[EntityId]) -> EditError {
        let candidates = found.iter().map(|id| (*id, self.label(*id))).collect();
        EditError::Ambiguous { wanted: reference.text.clone(), candidates }
    }

    fn label(&self, id: EntityId) -> String {
        self.scene.entity(id).map_or_else(|| id.to_string(), |entity| called(self.scene, &entity))
    }

    /// From where the scene is looked at, m.
    fn distance_to(&self, id: EntityId) -> f64 {
        self.scene.entity(id).map_or(f64::INFINITY, |entity| self.view.distance(&entity))
    }
}

#[cfg(test)]
mod tests {
    use simworld_core::asset::Catalogue;
    use simworld_core::geometry::{Point2, Point3, pose_facing};
    use simworld_core::scene::{EntityDesc, EntityKind, Shape, World};

    use super::super::read;
    use super::*;

    fn two_benches() -> World {
        let mut world = World::new();
        for x in [5.0, 9.0] {
            let pose = pose_facing(Point3::new(x, 0.0, 0.0), 0.0);
            let bench = EntityDesc::new(EntityKind::Bench, pose, Shape::cuboid(0.6, 1.8, 0.85));
            world.spawn(bench).unwrap();
        }
        world
    }

    fn focus() -> Focus {
        Focus {
            from: Point2::origin(),
            who: None,
            it: None,
            beside: None,
            made: Vec::new(),
            place: None,
            left: Vec::new(),
            roads: Vec::new(),
            streets: std::sync::Arc::default(),
            any_of: false,
        }
    }

    #[test]
    fn what_was_found_while_a_sentence_was_read_is_what_it_comes_to() {
        let (world, stock, focus) = (two_benches(), Stock::new(Catalogue::standard()), focus());
        let said = |words: &str| read(words, &world, &stock, &focus).unwrap();
        let comes_to =
            |reading: &Reading| reading.resolve(0, &world, &stock, &focus, AmbiguityPolicy::Nearest).unwrap();
        for words in ["paint the nearest bench red, please", "remove the nearest bench, and make it night"] {
            let reading = said(words);
            assert!(reading.held.as_ref().is_some_and(|held| held.edits.is_some()), "{words}");
            let anew = Reading { held: None, ..reading.clone() };
            assert_eq!(comes_to(&reading), comes_to(&anew), "{words}");
        }
        // Where several fit it is there, and which it is waits for the policy.
        let open = said("paint the bench red, please");
        assert!(open.held.as_ref().is_some_and(|held| held.edits.is_none()));
        assert_eq!(comes_to(&open).1.len(), 1);
        // In a scene that was read otherwise it is worked out anew.
        let other = Focus { any_of: true, ..focus.clone() };
        let reading = said("paint the nearest bench red, please");
        assert!(reading.resolve(0, &World::new(), &stock, &other, AmbiguityPolicy::Ask).is_err());
    }
}
