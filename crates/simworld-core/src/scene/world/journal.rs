//! What changed lately, by slot: whoever keeps something in step with the world looks at that, and not at everything.

use std::sync::atomic::{AtomicU64, Ordering};

use super::World;

/// Worlds made so far in this process.
static WORLDS: AtomicU64 = AtomicU64::new(0);

/// Tells one world from all others of this process, copies of it too: it is no part of their state.
#[derive(Debug, PartialEq, Eq)]
struct Identity(u64);

impl Default for Identity {
    fn default() -> Self {
        Self(WORLDS.fetch_add(1, Ordering::Relaxed))
    }
}

impl Clone for Identity {
    fn clone(&self) -> Self {
        Self::default()
    }
}

/// When somebody looked at a world; see [`World::mark`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Mark {
    world: u64,
    step: u64,
}

/// The slots that changed in this step and in the one before, and when each changed last.
#[derive(Clone, Debug, Default)]
pub(super) struct Journal {
    identity: Identity,
    /// Steps that were finished.
    step: u64,
    touched: Vec<u32>,
    /// By slot, the number of the step in which it changed last, counted from one.
    stamps: Vec<u64>,
    before: Vec<u32>,
}

impl Journal {
    pub(super) fn add_slot(&mut self) {
        self.stamps.push(0);
    }

    pub(super) fn touch(&mut self, slot: usize) {
        if self.stamps[slot] != self.step + 1 {
            self.stamps[slot] = self.step + 1;
            self.touched.push(slot as u32);
        }
    }

    /// Turns the page at the end of a step.
    pub(super) fn turn(&mut self) {
        self.step += 1;
        std::mem::swap(&mut self.touched, &mut self.before);
        self.touched.clear();
    }

    /// What has changed in this step.
    pub(super) fn now(&self) -> &[u32] {
        &self.touched
    }

    /// What changed in the step that was finished last.
    pub(super) fn last(&self) -> &[u32] {
        &self.before
    }
}

impl World {
    /// Now, for a later [`touched_since`](Self::touched_since).
    pub fn mark(&self) -> Mark {
        Mark { world: self.journal.identity.0, step: self.journal.step }
    }

    /// The slots in which anything may have changed since a mark: an entity came, went, moved, was altered or attached. Some may come
    /// twice, and some may have changed a little earlier. `None` if the mark is of another world, or older than the last finished step:
    /// then look at [all](Self::iter).
    ///
    /// ```
    /// use simworld_core::geometry::{Point3, pose_facing};
    /// use simworld_core::scene::{EntityDesc, EntityKind, Shape, World};
    /// let mut world = World::new();
    /// let pose = pose_facing(Point3::origin(), 0.0);
    /// let bench = world.spawn(EntityDesc::new(EntityKind::Bench, pose, Shape::cuboid(0.6, 1.8, 0.8)))?;
    /// world.finish_step();
    /// world.finish_step();
    /// let mark = world.mark();
    /// assert_eq!(world.touched_since(mark).unwrap().count(), 0);
    /// world.set_attribute(bench, "wet", Some(true.into()))?;
    /// world.finish_step();
    /// assert_eq!(world.touched_since(mark).unwrap().collect::<Vec<_>>(), [bench.index()]);
    /// world.finish_step();
    /// assert!(world.touched_since(mark).is_none());
    /// # Ok::<(), simworld_core::scene::WorldError>(())
    /// ```
    pub fn touched_since(&self, mark: Mark) -> Option<impl Iterator<Item = usize> + '_> {
        let Journal { identity, step, touched, before, .. } = &self.journal;
        if mark.world != identity.0 || mark.step + 1 < *step {
            return None;
        }
        let before = if mark.step < *step { before.as_slice() } else { &[] };
        Some(before.iter().chain(touched).map(|slot| *slot as usize))
    }

    /// As [`touched_since`](Self::touched_since), for marks of any age: an older one costs a look at the stamp of every slot.
    /// `None` only if the mark is of another world.
    ///
    /// ```
    /// use simworld_core::geometry::{Point3, pose_facing};
    /// use simworld_core::scene::{EntityDesc, EntityKind, Shape, World};
    /// let mut world = World::new();
    /// let pose = pose_facing(Point3::origin(), 0.0);
    /// let bench = || EntityDesc::new(EntityKind::Bench, pose, Shape::cuboid(0.6, 1.8, 0.8));
    /// world.spawn(bench())?;
    /// world.finish_step();
    /// let mark = world.mark();
    /// let second = world.spawn(bench())?;
    /// (0..5).for_each(|_| world.finish_step());
    /// assert_eq!(world.changed_since(mark).unwrap().collect::<Vec<_>>(), [second.index()]);
    /// assert!(World::new().changed_since(mark).is_none());
    /// # Ok::<(), simworld_core::scene::WorldError>(())
    /// ```
    pub fn changed_since(&self, mark: Mark) -> Option<impl Iterator<Item = usize> + '_> {
        let journal = &self.journal;
        if mark.world != journal.identity.0 {
            return None;
        }
        let recent = self.touched_since(mark);
        let stamps: &[u64] = if recent.is_some() { &[] } else { &journal.stamps };
        let older = stamps.iter().enumerate().filter(move |(_, stamp)| **stamp > mark.step);
        Some(recent.into_iter().flatten().chain(older.map(|(slot, _)| slot)))
    }
}
