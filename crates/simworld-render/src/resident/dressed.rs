//! Entities as they are dressed, each by one of several threads, before their instances have numbers.

use simworld_core::geometry::Pose;
use simworld_core::id::EntityId;
use simworld_core::scene::{EntityKind, EntityRef, Scene};

use super::bounds::ball_of;
use super::wardrobe::Wardrobe;
use super::{Ball, Instance, NONE};
use crate::classes::class_of;
use crate::demand::Demand;
use crate::look::{Detail, Look, Looks, comes_in_levels};
use crate::mesh::{Drawn, ModelId};

/// One instance of an entity before it has a number.
pub(crate) struct Part {
    pub mesh: Drawn,
    /// World from part.
    pub pose: Pose,
    pub look: Look,
    /// At which levels of detail it is drawn, as [`crate::look::Detail::bit`]s.
    pub details: u8,
}

/// What entities are dressed from.
pub(super) struct Tailor<'a> {
    pub looks: &'a Looks,
    pub scene: &'a dyn Scene,
    pub demand: &'a Demand,
    /// By slot, the first instance of who was there, and who that was.
    pub heads: &'a [u32],
    pub names: &'a [EntityId],
    pub wardrobe: &'a Wardrobe,
    /// Whether nothing changed of whom it dresses.
    pub again: bool,
}

impl Tailor<'_> {
    /// The levels of detail at which somebody is dressed, if it is dressed as it is seen: who comes is dressed in full, and stays so until it moves.
    fn levels(&self, slot: u32, entity: &EntityRef<'_>, ball: &Ball) -> Option<u8> {
        let place = slot as usize;
        let is_known = self.heads.get(place).is_some_and(|head| *head != NONE)
            && self.names.get(place) == Some(&entity.id);
        if !is_known || !comes_in_levels(entity, self.scene) {
            return None;
        }
        let kept = if self.again { self.wardrobe.levels(slot) } else { 0 };
        Some(self.demand.levels(ball) | kept)
    }
}

/// What a thread dressed.
#[derive(Default)]
pub(super) struct Dressed {
    pub parts: Vec<(Part, Instance)>,
    pub bodies: Vec<Body>,
    /// Those of one entity.
    own: Vec<Part>,
}

/// What is in a slot, and how many parts it has.
pub(super) struct Body {
    pub slot: u32,
    pub parts: usize,
    pub there: Option<There>,
    /// The levels of detail that these are of, if it is dressed as it is seen; none of who is dressed in full.
    pub levels: Option<u8>,
}

/// Who is seen in a slot.
pub(super) struct There {
    pub id: EntityId,
    pub kind: EntityKind,
    pub ball: Ball,
    pub is_restless: bool,
}

impl Dressed {
    pub(super) fn add(&mut self, tailor: &Tailor<'_>, slot: u32, id: Option<EntityId>) {
        let scene = tailor.scene;
        let Some(entity) = id.and_then(|id| scene.entity(id)).filter(EntityRef::is_visible) else {
            return self.bodies.push(Body { slot, parts: 0, there: None, levels: None });
        };
        let ball = ball_of(&entity, scene);
        let levels = tailor.levels(slot, &entity, &ball);
        self.own.clear();
        if levels != Some(0) {
            tailor.looks.dress(&entity, scene, levels.unwrap_or(Detail::EVERY), &mut self.own);
        }
        let plays = |part: &Part| matches!(part.mesh, Drawn::Model(ModelId { pose: Some(_), .. }));
        let is_restless = entity.gesture().is_some() || self.own.iter().any(plays);
        let class = class_of(entity.kind);
        let with_instance = |part: Part| {
            let instance = Instance::new(&part.pose, &part.look, entity.id, class);
            (part, instance)
        };
        let parts = self.own.len();
        self.parts.extend(self.own.drain(..).map(with_instance));
        let there = There { id: entity.id, kind: entity.kind, ball, is_restless };
        self.bodies.push(Body { slot, parts, there: Some(there), levels });
    }
}
