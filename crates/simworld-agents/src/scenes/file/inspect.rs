//! How things of a file stand when they are where it says: in each other, in the air, or as they should.

use std::collections::BTreeMap;
use std::ops::ControlFlow;

use simworld_core::geometry::{Aabb, Point2, yaw_of};
use simworld_core::ground::Ground;
use simworld_core::id::EntityId;
use simworld_core::scene::{EntityKind, EntityRef, Scene, World};

use super::error::{Fault, Problems};
use super::items::{Item, Supports};
use super::overlap::depth;
use super::scene::SceneFile;
use crate::editing::{SUPPORT_GAP, has_flat_top, is_surface, land_under};

/// Things that share less than this touch, m.
const TOUCH: f64 = 2e-3;
/// Of what one thing shares space with so much is told.
const MOST_SHARED: usize = 8;

/// The things of a file in a world.
pub(super) struct Standing<'a> {
    pub(super) scene: &'a SceneFile,
    pub(super) world: &'a World,
    pub(super) items: &'a [Item<'a>],
    pub(super) supports: &'a Supports,
    /// One a thing.
    pub(super) ids: &'a [EntityId],
    /// Which thing an entity is.
    pub(super) ranks: BTreeMap<EntityId, usize>,
}

impl Standing<'_> {
    /// Everything that is wrong with how they stand, thing by thing. Of two that share space it is told at the later one.
    pub(super) fn inspect(&self) -> Problems {
        let mut problems = Problems::default();
        for (index, item) in self.items.iter().enumerate() {
            let Some(thing) = self.world.entity(self.ids[index]) else { continue };
            let held = self.supports.under[index].and_then(|under| self.on_top(&thing, under));
            let held = held.or_else(|| self.support(&thing));
            let faults = held.into_iter().chain(self.shared(index, &thing));
            for fault in faults {
                problems.push(item.place(self.scene), fault);
            }
        }
        problems
    }

    /// What is wrong with how a thing stands on the one that is named.
    fn on_top(&self, thing: &EntityRef<'_>, under: usize) -> Option<Fault> {
        let below = self.world.entity(self.ids[under])?;
        let support = self.items[under].label_for_others();
        if !has_flat_top(below.kind) {
            return Some(Fault::NoTop { support });
        }
        let by = below.info.shape.planar_distance(below.pose, &thing.planar());
        (by > 0.0).then_some(Fault::Beside { support, by })
    }

    /// What is wrong with what holds a thing up.
    fn support(&self, thing: &EntityRef<'_>) -> Option<Fault> {
        let land = self.world.ground().filter(|land| land.holds(thing.planar()));
        let mut best: Option<(f64, Option<EntityId>)> = land.map(|land| (land_gap(land, thing), None));
        let (base, middle) = (thing.position().z, thing.planar());
        let column = Aabb::column(thing.bounds.min.xy(), thing.bounds.max.xy());
        let _ = self.world.visit(&column, &mut |other| {
            let gap = base - other.bounds.max.z;
            if other.id == thing.id || best.is_some_and(|(least, _)| gap.abs() >= least.abs()) {
                return ControlFlow::Continue(());
            }
            let holds = if is_surface(other.kind) {
                // The land has a body to be seen by, which is as high as its highest hill.
                let is_land = land.is_some()
                    && other.kind == EntityKind::Ground
                    && !other.info.attributes.contains_key("area");
                !is_land && is_under(&other, middle)
            } else {
                // What reaches higher is shared space, and told of as that.
                gap >= -SUPPORT_GAP
                    && has_flat_top(other.kind)
                    && thing.obb().footprints_overlap(&other.obb())
            };
            if holds {
                best = Some((gap, Some(other.id)));
            }
            ControlFlow::Continue(())
        });
        let Some((gap, what)) = best else { return Some(Fault::NoGround) };
        let told = || what.map_or_else(|| "the land".to_owned(), |id| self.label(id));
        match gap {
            gap if gap > SUPPORT_GAP => Some(Fault::Hangs { below: told(), gap }),
            gap if gap < -SUPPORT_GAP => Some(Fault::Sunk { into: told(), depth: -gap }),
            _ => None,
        }
    }

    /// What else is where a thing is; of the file's things those before it.
    fn shared(&self, index: usize, thing: &EntityRef<'_>) -> Vec<Fault> {
        let mut faults = Vec::new();
        let _ = self.world.visit(thing.bounds, &mut |other| {
            // Itself, too.
            let is_later = self.ranks.get(&other.id).is_some_and(|rank| *rank >= index);
            if is_surface(other.kind) || is_later {
                return ControlFlow::Continue(());
            }
            let depth = depth(thing, &other);
            if depth > TOUCH {
                faults.push(Fault::Penetrates { other: self.label(other.id), depth });
            }
            if faults.len() < MOST_SHARED { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
        });
        faults
    }

    /// What a thing is called: by its row if it has one, else as the scene calls it.
    fn label(&self, id: EntityId) -> String {
        match self.ranks.get(&id) {
            Some(rank) => self.items[*rank].label_for_others(),
            None => self.world.entity(id).map_or_else(String::new, |thing| match thing.kind {
                EntityKind::Ground if thing.info.name.is_none() => "the ground".to_owned(),
                _ => format!("{} ({id})", thing.label()),
            }),
        }
    }
}

/// Whether a point of the plane is on the footprint of a thing.
fn is_under(other: &EntityRef<'_>, middle: Point2) -> bool {
    other.info.shape.planar_distance(other.pose, &middle) == 0.0
}

/// How far a thing is above the land at the worst of its corners, m; below zero it is sunk in.
fn land_gap(land: &Ground, thing: &EntityRef<'_>) -> f64 {
    let (low, high) = land_under(land, thing.kind, thing.info.shape, thing.planar(), yaw_of(thing.pose));
    let base = thing.position().z;
    let (hangs, sunk) = (base - low, base - high);
    if hangs.abs() >= sunk.abs() { hangs } else { sunk }
}
