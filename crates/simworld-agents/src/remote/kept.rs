//! What clients leave behind in names and attributes of things, counted so that it can be bounded.

use std::collections::BTreeMap;

use simworld_core::alteration::Alteration;
use simworld_core::command::{Applied, Command};
use simworld_core::id::EntityId;
use simworld_core::scene::{EntityDesc, Scene};
use simworld_core::value::Value;

/// What an attribute takes beside its key and its text, bytes.
const ENTRY: usize = 64;

/// Bytes that clients left in things that are there, and in ways.
#[derive(Default)]
pub(super) struct Kept {
    sizes: BTreeMap<EntityId, usize>,
    in_things: usize,
    in_ways: usize,
}

/// What a command will leave, and in what, if that is there already.
pub(super) struct Note {
    id: Option<EntityId>,
    more: usize,
}

impl Note {
    /// What to remember of a command until it has taken effect; nothing of those that leave nothing.
    pub(super) fn of(command: &Command) -> Option<Self> {
        let id = match command {
            Command::Spawn(_) => None,
            Command::Respawn { id, .. }
            | Command::Remove { id }
            | Command::SetAttribute { id, .. }
            | Command::Alter { id, .. } => Some(*id),
            _ => return None,
        };
        Some(Self { id, more: brought_by(command) })
    }
}

impl Kept {
    pub(super) fn total(&self) -> usize {
        self.in_things.saturating_add(self.in_ways)
    }

    /// Forgets what was left in things that are gone.
    pub(super) fn forget_gone(&mut self, scene: &dyn Scene) {
        self.sizes.retain(|id, _| scene.entity(*id).is_some());
        self.in_things = self.sizes.values().sum();
    }

    /// Ways take so much now.
    pub(super) fn set_ways(&mut self, bytes: usize) {
        self.in_ways = bytes;
    }

    /// Takes note of a command that took effect.
    pub(super) fn count(&mut self, note: &Note, applied: &Applied) {
        let Some(id) = note.id.or(applied.spawned) else { return };
        let old = self.sizes.get(&id).copied().unwrap_or_default();
        let new = match &applied.undo {
            // What is gone leaves nothing.
            Some(Command::Respawn { .. }) => 0,
            undo => (old + note.more).saturating_sub(undo.as_ref().map_or(0, brought_by)),
        };
        self.in_things = self.in_things - old + new;
        if new == 0 {
            self.sizes.remove(&id);
        } else {
            self.sizes.insert(id, new);
        }
    }
}

/// Bytes that a command leaves in a thing.
pub(super) fn brought_by(command: &Command) -> usize {
    match command {
        Command::Spawn(desc) | Command::Respawn { desc, .. } => size_of_desc(desc),
        Command::SetAttribute { key, value: Some(value), .. } => size_of_entry(key, value),
        Command::Alter { alteration: Alteration::Name(Some(name)), .. } => name.len(),
        _ => 0,
    }
}

fn size_of_desc(desc: &EntityDesc) -> usize {
    let entries = desc.info.attributes.iter().map(|(key, value)| size_of_entry(key, value));
    desc.info.name.as_ref().map_or(0, String::len) + entries.sum::<usize>()
}

fn size_of_entry(key: &str, value: &Value) -> usize {
    ENTRY + key.len() + value.as_str().map_or(0, str::len)
}
