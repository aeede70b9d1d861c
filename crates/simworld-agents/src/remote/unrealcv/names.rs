//! Names of things, as clients of `UnrealCV` know them: one word, the same in capitals or not.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::ControlFlow;

use simworld_core::geometry::{Aabb, Point2};
use simworld_core::id::EntityId;
use simworld_core::net::SignalGroup;
use simworld_core::scene::EntityRef;
use simworld_core::value::Value;

use super::objects::MASK_COLOR;
use crate::remote::Stage;

/// The longest name, bytes.
const LONGEST: usize = 128;

/// Who is called what.
#[derive(Default)]
pub(super) struct Names {
    /// By the name in small letters: the name and whose it is.
    ids: BTreeMap<String, (String, EntityId)>,
    /// The stage's revision for which all names are in the list.
    complete: Option<u64>,
    /// What clients brought into the world.
    brought: BTreeSet<EntityId>,
    /// Colours in pictures of instances that somebody chose, by slot.
    colors: BTreeMap<u32, [u8; 3]>,
    /// Managers of the release, which stand for the engine itself and are no entities.
    /// Each with the signal groups that it took note of.
    managers: BTreeMap<String, BTreeSet<SignalGroup>>,
}

impl Names {
    /// The entity of that name.
    pub(super) fn find(&mut self, stage: &dyn Stage, name: &str) -> Option<EntityId> {
        let key = name.to_ascii_lowercase();
        if let Some((_, id)) = self.ids.get(&key)
            && let Some(entity) = stage.scene().entity(*id)
            && (has_name(&entity, name) || by_number(&entity).eq_ignore_ascii_case(name))
        {
            return Some(*id);
        }
        if self.complete == Some(stage.revision()) {
            return None;
        }
        self.scan(stage);
        self.ids.get(&key).map(|(_, id)| *id)
    }

    /// The name of an entity that is there.
    pub(super) fn name_of(&mut self, stage: &dyn Stage, id: EntityId) -> String {
        let Some(entity) = stage.scene().entity(id) else { return String::new() };
        match own_name(&entity) {
            Some(name) if self.find(stage, &name) == Some(id) => name,
            _ => by_number(&entity),
        }
    }

    /// All names, in the order of the alphabet.
    pub(super) fn all(&mut self, stage: &dyn Stage) -> impl Iterator<Item = &str> {
        if self.complete != Some(stage.revision()) {
            self.scan(stage);
        }
        self.ids.values().map(|(name, _)| name.as_str()).chain(self.managers.keys().map(String::as_str))
    }

    /// Takes note of something that a client brought; `before` is the revision before that.
    pub(super) fn came(&mut self, stage: &dyn Stage, before: u64, id: EntityId) {
        self.brought.insert(id);
        self.is_called(stage, before, id);
    }

    /// Whether a client brought it.
    pub(super) fn is_brought(&self, id: EntityId) -> bool {
        self.brought.contains(&id)
    }

    /// Takes note of what something is called that came or has another name; `before` is the revision before that.
    pub(super) fn is_called(&mut self, stage: &dyn Stage, before: u64, id: EntityId) {
        let Some(entity) = stage.scene().entity(id) else { return };
        let name = own_name(&entity).unwrap_or_else(|| by_number(&entity));
        self.ids.insert(name.to_ascii_lowercase(), (name, id));
        self.still_complete(stage, before);
    }

    /// Takes note of something that went, or changed; `before` is the revision before that.
    pub(super) fn still_complete(&mut self, stage: &dyn Stage, before: u64) {
        if self.complete == Some(before) {
            self.complete = Some(stage.revision());
        }
    }

    /// Forgets a name.
    pub(super) fn forget(&mut self, name: &str) {
        self.ids.remove(&name.to_ascii_lowercase());
    }

    /// What clients brought and is still there, by id.
    pub(super) fn brought(&mut self, stage: &dyn Stage) -> Vec<EntityId> {
        self.brought.retain(|id| stage.scene().entity(*id).is_some());
        self.brought.iter().copied().collect()
    }

    /// Adds a manager; false if there are too many.
    pub(super) fn add_manager(&mut self, name: &str, most: usize) -> bool {
        let has_room = self.managers.len() < most;
        if has_room {
            self.managers.insert(name.to_ascii_lowercase(), BTreeSet::new());
        }
        has_room
    }

    /// Lets a manager take note of a signal group; false if there is no manager of that name.
    pub(super) fn give_signal(&mut self, name: &str, group: SignalGroup) -> bool {
        let groups = self.managers.get_mut(&name.to_ascii_lowercase());
        groups.map(|groups| groups.insert(group)).is_some()
    }

    /// The signal groups that a manager took note of; none if there is no manager of that name.
    pub(super) fn signals_of(&self, name: &str) -> Option<Vec<SignalGroup>> {
        Some(self.managers.get(&name.to_ascii_lowercase())?.iter().copied().collect())
    }

    pub(super) fn is_manager(&self, name: &str) -> bool {
        self.managers.contains_key(&name.to_ascii_lowercase())
    }

    pub(super) fn remove_manager(&mut self, name: &str) -> bool {
        self.managers.remove(&name.to_ascii_lowercase()).is_some()
    }

    pub(super) fn set_color(&mut self, id: EntityId, color: [u8; 3]) {
        self.colors.insert(id.index() as u32, color);
    }

    /// The colour of a slot in pictures of instances: as chosen, or one of its own.
    pub(super) fn color_of(&self, slot: u32) -> [u8; 3] {
        self.colors.get(&slot).copied().unwrap_or_else(|| {
            // Odd factors permute the numbers below 2^24, and only zero becomes zero: every thing has another colour.
            let [r, g, b, _] = (slot + 1).wrapping_mul(0x009E_37B1).to_le_bytes();
            [r, g, b]
        })
    }

    fn scan(&mut self, stage: &dyn Stage) {
        self.ids.clear();
        self.colors.clear();
        let (ids, colors) = (&mut self.ids, &mut self.colors);
        let corner = Point2::new(f64::INFINITY, f64::INFINITY);
        let _ = stage.scene().visit(&Aabb::column(-corner, corner), &mut |entity| {
            let name = own_name(&entity).filter(|name| !ids.contains_key(&name.to_ascii_lowercase()));
            let name = name.unwrap_or_else(|| by_number(&entity));
            ids.insert(name.to_ascii_lowercase(), (name, entity.id));
            if let Some(Value::Integer(color)) = entity.info.attributes.get(MASK_COLOR) {
                let [_, r, g, b] = (*color as u32).to_be_bytes();
                colors.insert(entity.id.index() as u32, [r, g, b]);
            }
            ControlFlow::Continue(())
        });
        self.complete = Some(stage.revision());
    }
}

/// Whether a thing may be called so.
pub(super) fn is_name(name: &str) -> bool {
    (1..=LONGEST).contains(&name.len())
        && !name.contains(|c: char| c.is_whitespace() || c == '/' || c.is_control())
}

/// Its own name, if that is one word.
fn own_name(entity: &EntityRef<'_>) -> Option<String> {
    entity.info.name.as_ref().filter(|name| is_name(name)).cloned()
}

fn has_name(entity: &EntityRef<'_>, name: &str) -> bool {
    entity.info.name.as_deref().is_some_and(|own| own.eq_ignore_ascii_case(name))
}

/// The name of what has none of its own: its kind and its number.
fn by_number(entity: &EntityRef<'_>) -> String {
    match entity.id.generation() {
        0 => format!("{}_{}", entity.kind, entity.id.index()),
        generation => format!("{}_{}_{generation}", entity.kind, entity.id.index()),
    }
}
