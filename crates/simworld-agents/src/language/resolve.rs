//! References to entities: what a phrase means in a scene, seen from somewhere.

use std::ops::ControlFlow;

use simworld_core::geometry::{Aabb, Point2};
use simworld_core::id::EntityId;
use simworld_core::scene::{EntityKind, EntityRef, Relation, Role, Scene};
use simworld_core::seam::PlanError;

use super::clause::{Choice, Reference, Target};

/// Everything that stands in a relation to a thing is within this gap of it, m (see [`Relation::Near`]).
const RELATED: f64 = 30.0;
/// How many things that fit a description are looked at for something beside them, nearest first.
const MOST_ANCHORS: usize = 256;

/// What the thing is wanted for: it rules out what is in use.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Purpose {
    /// Nothing in particular.
    Any,
    /// To sit on it.
    Seat,
    /// To take it.
    Item,
}

/// A scene as the agent sees it from where it will be at this point of the plan.
#[derive(Clone, Copy)]
pub(super) struct View<'a> {
    pub(super) scene: &'a dyn Scene,
    pub(super) who: EntityId,
    pub(super) from: Point2,
    /// How far one looks, m.
    pub(super) range: f64,
    /// What "it" stands for.
    pub(super) it: Option<EntityId>,
}

impl<'a> View<'a> {
    /// The entity that a phrase means.
    pub(super) fn find(&self, reference: &Reference, purpose: Purpose) -> Result<EntityRef<'a>, PlanError> {
        let candidates = self.candidates(reference, purpose)?;
        let usable = |id: &EntityId| self.scene.entity(*id);
        candidates.iter().find_map(usable).ok_or_else(|| self.not_found(reference, purpose))
    }

    /// All that a phrase may mean, the best first.
    fn candidates(&self, reference: &Reference, purpose: Purpose) -> Result<Vec<EntityId>, PlanError> {
        let mut found = match &reference.relation {
            Some((relation, anchor)) => self.related(reference, *relation, anchor, purpose)?,
            None => self.plain(reference, purpose)?,
        };
        if reference.choice == Choice::Farthest {
            found.reverse();
        }
        Ok(found)
    }

    /// Without regard to relations, the nearest first.
    fn plain(&self, reference: &Reference, purpose: Purpose) -> Result<Vec<EntityId>, PlanError> {
        let mut found: Vec<(f64, EntityId)> = Vec::new();
        let mut keep = |entity: EntityRef<'_>| {
            if entity.id != self.who && self.is_free(&entity, purpose) {
                found.push((self.distance(&entity), entity.id));
            }
        };
        match &reference.target {
            Target::Any(category) => {
                let _ = self.scene.visit(&Aabb::column_around(self.from, self.range), &mut |entity| {
                    if category.holds(&entity) {
                        keep(entity);
                    }
                    ControlFlow::Continue(())
                });
            }
            Target::Named(ids) => ids.iter().filter_map(|id| self.scene.entity(*id)).for_each(keep),
            // What is named outright is meant, in use or not.
            Target::Id(id) => {
                return Ok(self.scene.entity(*id).map(|entity| entity.id).into_iter().collect());
            }
            Target::It => return Ok(vec![self.antecedent(reference)?]),
            Target::There | Target::Here | Target::Point { .. } => {
                let near = "a place was given where a thing is needed".to_owned();
                return Err(PlanError::NotFound { wanted: format!("thing {:?}", reference.text), near });
            }
        }
        found.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        found.retain(|(distance, _)| *distance <= self.range);
        Ok(found.into_iter().map(|(_, id)| id).collect())
    }

    fn antecedent(&self, reference: &Reference) -> Result<EntityId, PlanError> {
        self.it.ok_or_else(|| PlanError::NotFound {
            wanted: format!("thing that {:?} could stand for", reference.text),
            near: "name it first, in the same sentence".to_owned(),
        })
    }

    /// Those that stand in the relation to what the anchor may mean.
    fn related(
        &self,
        reference: &Reference,
        relation: Relation,
        anchor: &Reference,
        purpose: Purpose,
    ) -> Result<Vec<EntityId>, PlanError> {
        let anchors = self.candidates(anchor, Purpose::Any)?;
        let mut found: Vec<(f64, EntityId)> = Vec::new();
        for anchor in anchors.iter().take(MOST_ANCHORS).filter_map(|id| self.scene.entity(*id)) {
            self.beside(reference, relation, &anchor, purpose, &mut found)?;
            // Unless the nearest or farthest is asked for, the first thing with something beside it is meant.
            if reference.choice == Choice::Open && !found.is_empty() {
                break;
            }
        }
        found.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        Ok(found.into_iter().map(|(_, id)| id).collect())
    }

    /// Adds what stands in the relation to one anchor, with a figure by which to choose.
    fn beside(
        &self,
        reference: &Reference,
        relation: Relation,
        anchor: &EntityRef<'_>,
        purpose: Purpose,
        found: &mut Vec<(f64, EntityId)>,
    ) -> Result<(), PlanError> {
        let mut judge = |entity: EntityRef<'_>| {
            let fits = entity.id != self.who && self.is_free(&entity, purpose);
            if fits && relation.holds(&entity, anchor) {
                let rank = match reference.choice {
                    Choice::Open => anchor.info.shape.planar_distance(anchor.pose, &entity.planar()),
                    Choice::Nearest | Choice::Farthest => self.distance(&entity),
                };
                found.push((rank, entity.id));
            }
        };
        if let Target::Any(category) = &reference.target {
            let _ = self.scene.visit(&anchor.bounds.inflated(RELATED), &mut |entity| {
                if category.holds(&entity) {
                    judge(entity);
                }
                ControlFlow::Continue(())
            });
        } else {
            self.plain(reference, purpose)?.iter().filter_map(|id| self.scene.entity(*id)).for_each(judge);
        }
        Ok(())
    }

    fn distance(&self, entity: &EntityRef<'_>) -> f64 {
        entity.info.shape.planar_distance(entity.pose, &self.from)
    }

    fn is_free(&self, entity: &EntityRef<'_>, purpose: Purpose) -> bool {
        match purpose {
            Purpose::Any => true,
            Purpose::Seat => self.scene.attached(entity.id, Role::Seated).is_none_or(|by| by == self.who),
            Purpose::Item => entity.attachment.is_none_or(|bond| bond.parent == self.who),
        }
    }

    /// The answer when nothing fits: whether all are in use, and what there is instead.
    fn not_found(&self, reference: &Reference, purpose: Purpose) -> PlanError {
        let in_use = purpose != Purpose::Any
            && self.candidates(reference, Purpose::Any).is_ok_and(|candidates| !candidates.is_empty());
        let near = if in_use { "all that there are in use".to_owned() } else { self.surroundings() };
        let wanted = match purpose {
            _ if !in_use => reference.text.clone(),
            _ => format!("free {}", reference.text),
        };
        PlanError::NotFound { wanted, near }
    }

    /// What is near, with distances, for answers.
    pub(super) fn surroundings(&self) -> String {
        /// How far, m, and how many things are listed.
        const NEAR: f64 = 100.0;
        const MOST: usize = 4;
        let mut found: Vec<(f64, EntityId)> = Vec::new();
        let reach = NEAR.min(self.range);
        let _ = self.scene.visit(&Aabb::column_around(self.from, reach), &mut |entity| {
            let distance = self.distance(&entity);
            if entity.id != self.who && !is_surface(entity.kind) && distance <= reach {
                found.push((distance, entity.id));
            }
            ControlFlow::Continue(())
        });
        found.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let mut listed: Vec<String> = Vec::new();
        for (distance, id) in found {
            let Some(entity) = self.scene.entity(id) else { continue };
            let label = entity.label();
            if !listed.iter().any(|other| other.starts_with(&format!("{label} "))) {
                listed.push(format!("{label} {id} at {distance:.0} m"));
            }
            if listed.len() == MOST {
                break;
            }
        }
        if listed.is_empty() {
            format!("nothing stands within {reach:.0} m")
        } else {
            format!("near are {}", listed.join(", "))
        }
    }
}

const fn is_surface(kind: EntityKind) -> bool {
    matches!(kind, EntityKind::Ground | EntityKind::Road | EntityKind::Sidewalk | EntityKind::Crosswalk)
}
