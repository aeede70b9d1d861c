//! The slots of the store: how entities are checked, filed and found.

use std::sync::Arc;

use super::{WORLD_LIMIT, World, WorldError};
use crate::geometry::{Aabb, Pose, Twist, Vector3};
use crate::id::EntityId;
use crate::scene::quadtree::Quadtree;
use crate::scene::{EntityDesc, EntityInfo, EntityKind, EntityRef, SELLS, Shape};

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
        let slot = self.free.last().map_or(self.infos.len(), |slot| *slot as usize);
        EntityId::new(slot as u32, self.generations.get(slot).copied().unwrap_or(0))
    }

    pub(super) fn check_alive(&self, id: EntityId) -> Result<(), WorldError> {
        if self.is_alive(id) { Ok(()) } else { Err(WorldError::Missing { id }) }
    }

    pub(super) fn is_alive(&self, id: EntityId) -> bool {
        let slot = id.index();
        slot < self.infos.len() && self.generations[slot] == id.generation() && self.infos[slot].is_some()
    }

    pub(super) fn new_slot(&mut self) -> u32 {
        let slot = u32::try_from(self.infos.len()).expect("a world holds fewer than 2^32 entities");
        self.generations.push(0);
        self.kinds.push(EntityKind::Prop);
        self.poses.push(Pose::identity());
        self.twists.push(Twist::ZERO);
        self.bounds.push(Shape::Sphere { radius: 1.0 }.aabb(&Pose::identity()));
        self.infos.push(None);
        self.bonds.push(None);
        self.digests.add_slot();
        self.journal.add_slot();
        slot
    }

    /// Fills a slot that is not in the free list with a checked recipe.
    pub(super) fn fill(&mut self, slot: u32, desc: EntityDesc) -> EntityId {
        let index = slot as usize;
        let bounds = desc.info.shape.aabb(&desc.pose);
        self.kinds[index] = desc.kind;
        self.poses[index] = desc.pose;
        self.twists[index] = desc.twist;
        let id = EntityId::new(slot, self.generations[index]);
        Arc::make_mut(&mut self.classes).insert(id, desc.kind, &desc.info);
        if is_called(&desc.info) {
            Arc::make_mut(&mut self.names).insert(id, &desc.info);
        }
        self.infos[index] = Some(desc.info);
        self.file(index, bounds);
        self.set_bond(index, desc.attachment);
        self.touch(index);
        self.revision += 1;
        id
    }

    pub(super) fn file(&mut self, slot: usize, bounds: Aabb) {
        self.bounds[slot] = bounds;
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
        for (slot, info) in self.infos.iter().enumerate() {
            if info.is_some() {
                tree.place(slot as u32, &self.bounds[slot]);
            }
        }
        self.tree = tree;
    }

    pub(super) fn touch(&mut self, slot: usize) {
        self.journal.touch(slot);
    }

    pub(super) fn in_slot(&self, slot: usize) -> Option<EntityRef<'_>> {
        let info = self.infos[slot].as_ref()?;
        Some(EntityRef {
            id: EntityId::new(slot as u32, self.generations[slot]),
            kind: self.kinds[slot],
            pose: &self.poses[slot],
            twist: &self.twists[slot],
            bounds: &self.bounds[slot],
            info,
            attachment: self.bonds[slot].as_deref(),
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
