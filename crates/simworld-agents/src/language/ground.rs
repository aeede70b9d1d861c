//! Grounding: from a phrase to the entity or the place it means.

use std::ops::ControlFlow;

use simworld_core::geometry::{Aabb, Point2, Point3};
use simworld_core::id::EntityId;
use simworld_core::scene::{EntityRef, Relation, Scene};
use simworld_core::seam::PlanError;

use super::lexicon::{Meaning, meaning};
use super::phrase::Phrase;

/// How far things are looked for, m.
const SIGHT: f64 = 5000.0;
/// How many near things an error names.
const NAMED: usize = 3;

/// What a phrase means.
pub(super) enum Grounding {
    Point(Point3),
    Entity(EntityId),
}

/// The nearest entity that the phrase describes and that `fits`; of two as near the lower id.
pub(super) fn ground(
    phrase: &Phrase,
    scene: &dyn Scene,
    who: EntityId,
    fits: &dyn Fn(&EntityRef<'_>) -> bool,
) -> Result<Grounding, PlanError> {
    let me = scene.entity(who).ok_or(PlanError::Missing { id: who })?;
    match phrase {
        Phrase::Point(point) => Ok(Grounding::Point(*point)),
        Phrase::Id(id) => match scene.entity(*id) {
            Some(entity) if fits(&entity) => Ok(Grounding::Entity(*id)),
            Some(entity) => {
                Err(not_found(&format!("such use of {} {id}", entity.label()), scene, who, me.planar()))
            }
            None => Err(not_found(&format!("entity {id}"), scene, who, me.planar())),
        },
        Phrase::Thing { words, beside } => {
            let anchor = match beside {
                Some((relation, phrase)) => match ground(phrase, scene, who, &|_| true)? {
                    Grounding::Entity(id) => Some((*relation, id)),
                    Grounding::Point(_) => return Err(not_found(words, scene, who, me.planar())),
                },
                None => None,
            };
            let wanted = Wanted { words, meaning: meaning(words), anchor, who };
            let found = wanted.nearest(scene, me.planar(), fits);
            found.map(Grounding::Entity).ok_or_else(|| not_found(words, scene, who, me.planar()))
        }
    }
}

struct Wanted<'a> {
    words: &'a str,
    meaning: Option<Meaning>,
    anchor: Option<(Relation, EntityId)>,
    who: EntityId,
}

impl Wanted<'_> {
    fn nearest(
        &self,
        scene: &dyn Scene,
        from: Point2,
        fits: &dyn Fn(&EntityRef<'_>) -> bool,
    ) -> Option<EntityId> {
        let mut best: Option<((u32, f64), EntityId)> = None;
        let _ = scene.visit(&Aabb::column_around(from, SIGHT), &mut |entity| {
            if entity.id != self.who
                && fits(&entity)
                && self.stands_right(scene, &entity)
                && let Some(doubt) = self.doubt(&entity)
            {
                let rank = (doubt, (entity.access().xy() - from).norm());
                if best.is_none_or(|(least, id)| (rank, entity.id) < (least, id)) {
                    best = Some((rank, entity.id));
                }
            }
            ControlFlow::Continue(())
        });
        best.map(|(_, id)| id)
    }

    /// How unsure it is that the entity is meant, 0 for certain; `None` if it is not.
    fn doubt(&self, entity: &EntityRef<'_>) -> Option<u32> {
        if self.words.is_empty() {
            return Some(0); // any that fits
        }
        let name = entity.info.name.as_deref().map(str::to_lowercase);
        if name.as_deref() == Some(self.words) || self.meaning.is_some_and(|meaning| meaning.fits(entity)) {
            return Some(0);
        }
        // A typo in every six letters or so.
        let typos = strsim::osa_distance(name.as_deref()?, self.words);
        (self.words.len() >= 5 && typos <= self.words.len() / 6 + 1).then_some(typos as u32)
    }

    fn stands_right(&self, scene: &dyn Scene, entity: &EntityRef<'_>) -> bool {
        self.anchor.is_none_or(|(relation, id)| {
            scene.entity(id).is_some_and(|anchor| relation.holds(entity, &anchor))
        })
    }
}

/// The error for a thing that is not there, with what is near instead.
fn not_found(wanted: &str, scene: &dyn Scene, who: EntityId, from: Point2) -> PlanError {
    let mut near: Vec<(f64, EntityId, String)> = Vec::new();
    let _ = scene.visit(&Aabb::column_around(from, 100.0), &mut |entity| {
        if entity.id != who
            && (entity.info.name.is_some() || entity.info.place.is_some() || entity.kind.is_seat())
        {
            near.push(((entity.access().xy() - from).norm(), entity.id, entity.label().to_owned()));
        }
        ControlFlow::Continue(())
    });
    near.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    let named: Vec<String> = near
        .iter()
        .take(NAMED)
        .map(|(distance, id, label)| format!("{label} {id} at {distance:.0} m"))
        .collect();
    let near = if named.is_empty() { "nothing with a name is near".to_owned() } else { named.join(", ") };
    let wanted = if wanted.is_empty() { "such thing".to_owned() } else { wanted.chars().take(80).collect() };
    PlanError::NotFound { wanted, near }
}
