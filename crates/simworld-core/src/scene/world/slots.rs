//! The slots of the store: how entities are checked, filed and found.

use std::sync::Arc;

use super::{WORLD_LIMIT, World, WorldError};
use crate::geometry::{Aabb, Pose, Twist, Vector3};
use crate::id::EntityId;
use crate::scene::quadtree::Quadtree;
use crate::scene::{Attachment, EntityDesc, EntityInfo, EntityKind, EntityRef, SELLS, Shape};

/// What is asked of everything around before anything else of it is read: one line of memory a slot.
#[derive(Clone, Debug)]
#[repr(align(64))]
pub(super) struct Head {
    pub(super) bounds: Aabb,
    /// Few things hang on others: their bonds are kept elsewhere.
    pub(super) bond: Option<Box<Attachment>>,
    pub(super) generation: u32,
    /// `None` in free slots.
    pub(super) kind: Option<EntityKind>,
}

const _: () = assert!(size_of::<Head>() == 64, "the head of a slot fills one line of memory");

/// What free slots are made of.
pub(super) const fn nothing() -> EntityInfo {
    EntityInfo::of(Shape::Sphere { radius: 1.0 })
}

impl World {
    pub(super) fn check(&self, id: EntityId, desc: &EntityDesc) -> Result<(), WorldError> {
        check_pose(&desc.pose)?;
        check_twist(id, &desc.twist)?;
        desc.info.shape.validate()?;
        if let Some(asset) = desc.info.asset.filter(|asset| self.assets.get(*asset).is_none()) {
            return Err(WorldError::Asset { asset, count: self.assets.len() });
        }
        if let Some(bond) = &desc.attachment {
            self.check_alive(bond.parent)?;
            check_pose(&bond.parent_from_body)?;
        }
        Ok(())
    }

    /// The id that the next spawn gives.
    pub(super) fn next_id(&self) -> EntityId {
        let slot = self.free.last().map_or(self.heads.len(), |slot| *slot as usize);
        EntityId::new(slot as u32, self.heads.get(slot).map_or(0, |head| head.generation))
    }

    pub(super) fn check_alive(&self, id: EntityId) -> Result<(), WorldError> {
        if self.is_alive(id) { Ok(()) } else { Err(WorldError::Missing { id }) }
    }

    pub(super) fn is_alive(&self, id: EntityId) -> bool {
        let head = self.heads.get(id.index());
        head.is_some_and(|head| head.generation == id.generation() && head.kind.is_some())
    }

    pub(super) fn new_slot(&mut self) -> u32 {
        let slot = u32::try_from(self.heads.len()).expect("a world holds fewer than 2^32 entities");
        let (pose, info) = (Pose::identity(), nothing());
        self.heads.push(Head { bounds: info.shape.aabb(&pose), bond: None, generation: 0, kind: None });
        self.poses.push(pose);
        self.twists.push(Twist::ZERO);
        self.infos.push(info);
        self.digests.add_slot();
        self.journal.add_slot();
        slot
    }

    /// Fills a slot that is not in the free list with a checked recipe.
    pub(super) fn fill(&mut self, slot: u32, desc: EntityDesc) -> EntityId {
        let index = slot as usize;
        let bounds = desc.info.shape.aabb(&desc.pose);
        self.heads[index].kind = Some(desc.kind);
        self.poses[index] = desc.pose;
        self.twists[index] = desc.twist;
        let id = EntityId::new(slot, self.heads[index].generation);
        Arc::make_mut(&mut self.classes).insert(id, desc.kind, &desc.info);
        if is_called(&desc.info) {
            Arc::make_mut(&mut self.names).insert(id, &desc.info);
        }
        self.keep_stride(id, desc.info.asset);
        self.infos[index] = desc.info;
        self.file(index, bounds);
        self.set_bond(index, desc.attachment);
        self.touch(index);
        self.revision += 1;
        id
    }

    pub(super) fn file(&mut self, slot: usize, bounds: Aabb) {
        self.heads[slot].bounds = bounds;
        if !self.tree.holds(&bounds) {
            self.grow_tree(&bounds);
        }
        self.tree.place(slot as u32, &bounds);
    }

    /// Doubles the tree until it holds the box, and files everything anew.
    pub(super) fn grow_tree(&mut self, bounds: &Aabb) {
        let mut width = self.tree.width();
        let mut tree = Quadtree::with_width(width);
        while !tree.holds(bounds) {
            width *= 2.0;
            tree = Quadtree::with_width(width);
        }
        for (slot, head) in self.heads.iter().enumerate().filter(|(_, head)| head.kind.is_some()) {
            tree.place(slot as u32, &head.bounds);
        }
        self.tree = tree;
    }

    pub(super) fn touch(&mut self, slot: usize) {
        self.journal.touch(slot);
    }

    pub(super) fn in_slot(&self, slot: usize) -> Option<EntityRef<'_>> {
        let head = &self.heads[slot];
        Some(EntityRef {
            id: EntityId::new(slot as u32, head.generation),
            kind: head.kind?,
            pose: &self.poses[slot],
            twist: &self.twists[slot],
            bounds: &head.bounds,
            info: &self.infos[slot],
            attachment: head.bond.as_deref(),
        })
    }
}

/// Whether the index of names has anything to say of it.
pub(super) fn is_called(info: &EntityInfo) -> bool {
    info.name.is_some() || info.attributes.contains_key(SELLS)
}

/// Whether two motions are the same by their bits, as digests tell them apart.
pub(super) fn is_same_motion(one: (&Pose, &Twist), other: (&Pose, &Twist)) -> bool {
    let bits = |(pose, twist): (&Pose, &Twist)| {
        let (at, turn) = (&pose.translation.vector, &pose.rotation.coords);
        let (linear, angular) = (&twist.linear, &twist.angular);
        [
            [at.x, at.y, at.z, 0.0].map(f64::to_bits),
            [turn.x, turn.y, turn.z, turn.w].map(f64::to_bits),
            [linear.x, linear.y, linear.z, 0.0].map(f64::to_bits),
            [angular.x, angular.y, angular.z, 0.0].map(f64::to_bits),
        ]
    };
    bits(one) == bits(other)
}

pub(super) fn check_twist(id: EntityId, twist: &Twist) -> Result<(), WorldError> {
    let is_finite = |part: &Vector3| part.x.is_finite() && part.y.is_finite() && part.z.is_finite();
    if is_finite(&twist.linear) && is_finite(&twist.angular) { Ok(()) } else { Err(WorldError::Twist { id }) }
}

pub(super) fn check_pose(pose: &Pose) -> Result<(), WorldError> {
    let at = pose.translation.vector;
    if !(at.x.abs() <= WORLD_LIMIT && at.y.abs() <= WORLD_LIMIT && at.z.abs() <= WORLD_LIMIT) {
        return Err(WorldError::Pose { x: at.x, y: at.y, z: at.z });
    }
    let norm = pose.rotation.coords.norm();
    // Single-precision engines normalise to about 1e-7; NaN fails the comparison.
    if (norm - 1.0).abs() <= 1e-3 { Ok(()) } else { Err(WorldError::Rotation { norm }) }
}
