//! Bonds: what hangs on what, and goes where it goes.

use super::slots::check_pose;
use super::{World, WorldError};
use crate::geometry::{Pose, Twist};
use crate::id::EntityId;
use crate::scene::{Attachment, EntityDesc, EntityRef, Scene};

impl World {
    /// Hangs an entity on a carrier, or frees it with `None`; returns the old bond.
    ///
    /// # Errors
    /// No such entity or carrier, or a carrier that hangs on the entity itself.
    pub fn attach(
        &mut self,
        child: EntityId,
        bond: Option<Attachment>,
    ) -> Result<Option<Attachment>, WorldError> {
        self.check_alive(child)?;
        if let Some(bond) = &bond {
            self.check_bond(child, bond)?;
            check_pose(&(self.poses[bond.parent.index()] * bond.parent_from_body))?;
        }
        let old = self.heads[child.index()].bond.as_deref().copied();
        self.bond(child, bond);
        Ok(old)
    }

    /// Puts a living entity back where it was, with the velocity and the bond it had: the way an undo does it.
    ///
    /// # Errors
    /// No such entity or carrier, numbers out of the world, or a carrier that hangs on the entity itself.
    pub fn reset(
        &mut self,
        id: EntityId,
        pose: Pose,
        twist: Twist,
        bond: Option<Attachment>,
    ) -> Result<(), WorldError> {
        self.check_alive(id)?;
        if let Some(bond) = &bond {
            self.check_bond(id, bond)?;
        }
        self.set_motion(id, pose, twist)?;
        self.set_bond(id.index(), bond);
        Ok(())
    }

    /// Everything that hangs on something else, by ascending slot.
    pub fn bonded(&self) -> impl Iterator<Item = EntityRef<'_>> {
        self.bonded.iter().filter_map(|slot| self.in_slot(*slot as usize))
    }

    /// What hangs on a carrier, with its bonds, by ascending slot.
    pub fn load(&self, carrier: EntityId) -> Vec<(EntityId, Attachment)> {
        let mut load = Vec::new();
        self.visit_attached(carrier, &mut |entity| {
            load.extend(entity.attachment.map(|bond| (entity.id, *bond)));
        });
        load
    }

    /// [Respawns](Self::respawn) an entity together with what hung on it; the load stays where it is.
    ///
    /// # Errors
    /// As [`respawn`](Self::respawn); or a load that does not live, or hangs on something already.
    pub fn respawn_loaded(
        &mut self,
        id: EntityId,
        desc: EntityDesc,
        load: &[(EntityId, Attachment)],
    ) -> Result<(), WorldError> {
        for (child, bond) in load {
            self.check_alive(*child)?;
            check_pose(&bond.parent_from_body)?;
            if self.heads[child.index()].bond.is_some() {
                return Err(WorldError::Bonded { child: *child });
            }
            if desc.attachment.is_some_and(|bond| self.hangs_on(bond.parent, *child)) {
                return Err(WorldError::Cycle { child: *child, parent: id });
            }
        }
        self.respawn(id, desc)?;
        for (child, bond) in load {
            self.set_bond(child.index(), Some(Attachment { parent: id, ..*bond }));
        }
        Ok(())
    }

    /// Whether an entity is the other or hangs on it, directly or through others.
    pub(in crate::scene) fn hangs_on(&self, id: EntityId, carrier: EntityId) -> bool {
        let mut above = Some(id);
        while let Some(ancestor) = above {
            if ancestor == carrier {
                return true;
            }
            above =
                self.heads.get(ancestor.index()).and_then(|head| head.bond.as_ref()).map(|bond| bond.parent);
        }
        false
    }

    fn check_bond(&self, child: EntityId, bond: &Attachment) -> Result<(), WorldError> {
        self.check_alive(bond.parent)?;
        check_pose(&bond.parent_from_body)?;
        let parent = bond.parent;
        if self.hangs_on(parent, child) { Err(WorldError::Cycle { child, parent }) } else { Ok(()) }
    }

    pub(in crate::scene) fn bond(&mut self, child: EntityId, bond: Option<Attachment>) {
        self.set_bond(child.index(), bond);
        if let Some(bond) = bond {
            let pose = self.poses[bond.parent.index()] * bond.parent_from_body;
            self.place(child, pose);
        }
    }

    /// What hangs on others goes where they went; carriers come first, whatever their slots.
    pub(super) fn follow_carriers(&mut self) {
        for index in 0..self.bonded.len() {
            let slot = self.bonded[index] as usize;
            let pose = self.carried_pose(slot);
            let id = EntityId::new(slot as u32, self.heads[slot].generation);
            let carrier = self.heads[slot].bond.as_ref().map(|bond| bond.parent.index());
            let twist = carrier.map_or(Twist::ZERO, |carrier| self.twists[carrier]);
            if pose != self.poses[slot] || twist != self.twists[slot] {
                self.twists[slot] = twist;
                self.place(id, pose);
            }
        }
    }

    fn carried_pose(&self, slot: usize) -> Pose {
        match &self.heads[slot].bond {
            Some(bond) => self.carried_pose(bond.parent.index()) * bond.parent_from_body,
            None => self.poses[slot],
        }
    }

    pub(super) fn set_bond(&mut self, slot: usize, bond: Option<Attachment>) {
        match (&mut self.heads[slot].bond, bond) {
            // In its place: what is held anew in each step allocates nothing.
            (Some(old), Some(bond)) => **old = bond,
            (old, bond) => *old = bond.map(Box::new),
        }
        match (self.bonded.binary_search(&(slot as u32)), bond) {
            (Err(position), Some(_)) => self.bonded.insert(position, slot as u32),
            (Ok(position), None) => {
                self.bonded.remove(position);
            }
            _ => {}
        }
        self.touch(slot);
    }
}
