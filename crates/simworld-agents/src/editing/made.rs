//! What edits that are carried out together call a thing that one of them makes: nobody knows its id before.

use simworld_core::id::EntityId;

use super::edit::{Edit, Stand};
use super::error::EditError;

/// The slot that stands for the first thing that is made; no world has so many. The last slot of all is nobody's.
const FIRST: u32 = u32::MAX - 1;
/// So many things that are made may be spoken of.
const MOST: u32 = 1000;

/// Which of the things that are made an id stands for, counted from zero.
pub(crate) fn nth_made(id: EntityId) -> Option<usize> {
    let nth = (FIRST as usize).checked_sub(id.index())?;
    (id.generation() == u32::MAX && nth < MOST as usize).then_some(nth)
}

impl Edit {
    /// Stands, among edits that are carried out together, for a thing that those before make: the first is 0, and a row or an
    /// edit that adds several has as many as there were places for.
    ///
    /// ```
    /// use simworld_agents::editing::{Edit, Make, SceneEditor, Stand};
    /// use simworld_core::scene::{Relation, World};
    /// use simworld_core::seed::Seed;
    /// let mut world = World::new();
    /// let next = Stand::To { relation: Relation::NextTo, anchor: Edit::made(0) };
    /// let edits = [
    ///     Edit::Add { make: Make::of("table"), count: 1, stands: Vec::new() },
    ///     Edit::Add { make: Make::of("chair"), count: 2, stands: vec![next] },
    /// ];
    /// let done = SceneEditor::new(Seed(7)).edit(&edits, &mut world)?;
    /// assert_eq!(done.made.len(), 3);
    /// # Ok::<(), simworld_agents::editing::EditError>(())
    /// ```
    pub const fn made(nth: u32) -> EntityId {
        EntityId::new(FIRST.saturating_sub(nth), u32::MAX)
    }

    /// With the ids of what was made in the place of what stands for them.
    ///
    /// # Errors
    /// Fewer were made.
    pub fn with_made(&self, made: &[EntityId]) -> Result<Self, EditError> {
        let mut edit = self.clone();
        let mut missing = None;
        edit.each_id(&mut |id| {
            if let Some(nth) = nth_made(*id) {
                match made.get(nth) {
                    Some(known) => *id = *known,
                    None => missing = Some(nth),
                }
            }
        });
        match missing {
            Some(nth) => Err(EditError::NotFound {
                wanted: format!("new thing {}", nth + 1),
                near: format!("{} were made by then", made.len()),
            }),
            None => Ok(edit),
        }
    }

    /// Shows every id of a thing in it.
    fn each_id(&mut self, change: &mut dyn FnMut(&mut EntityId)) {
        match self {
            Self::Add { stands, .. } => show(stands, change),
            Self::Row { line, .. } => line.anchors_mut().for_each(change),
            Self::Remove { things }
            | Self::Rotate { things, .. }
            | Self::Paint { things, .. }
            | Self::Scale { things, .. }
            | Self::Count { things, .. }
            | Self::List { things } => things.iter_mut().for_each(change),
            Self::Move { things, stands } => {
                things.iter_mut().for_each(&mut *change);
                show(stands, change);
            }
            Self::Face { things, towards } => {
                things.iter_mut().for_each(&mut *change);
                change(towards);
            }
            Self::Swap { one, other } => {
                change(one);
                change(other);
            }
            Self::Copy { thing, stands, .. } => {
                change(thing);
                show(stands, change);
            }
            Self::Name { thing, .. } | Self::Describe { thing } => change(thing),
            Self::SetEnvironment(_) | Self::SetPassage { .. } | Self::Leave { .. } => {}
        }
    }
}

fn show(stands: &mut [Stand], change: &mut dyn FnMut(&mut EntityId)) {
    stands.iter_mut().flat_map(Stand::anchors_mut).for_each(change);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_stands_for_a_new_thing_becomes_its_id() {
        let ids = [EntityId::new(4, 0), EntityId::new(9, 2)];
        let swap = Edit::Swap { one: Edit::made(1), other: EntityId::new(1, 0) };
        let known = Edit::Swap { one: ids[1], other: EntityId::new(1, 0) };
        assert_eq!(swap.with_made(&ids), Ok(known.clone()));
        assert_eq!(known.with_made(&[]), Ok(known));
        assert!(matches!(swap.with_made(&ids[..1]), Err(EditError::NotFound { .. })));
        let nobody = Edit::Describe { thing: EntityId::new(u32::MAX, u32::MAX) };
        assert_eq!(nobody.with_made(&ids), Ok(nobody));
    }
}
