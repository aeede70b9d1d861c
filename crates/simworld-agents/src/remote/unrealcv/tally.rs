//! How often things came to touch others, counted from the events of steps.

use std::collections::BTreeMap;

use simworld_core::event::{Event, EventKind};
use simworld_core::id::EntityId;
use simworld_core::scene::{EntityKind, Scene};

/// Beyond so many entries those of who is gone are let go.
const MANY: usize = 4096;

/// Touches of one thing by what was touched.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Touches {
    pub(super) humans: u64,
    pub(super) objects: u64,
    pub(super) buildings: u64,
    pub(super) vehicles: u64,
}

/// Touches of everything.
#[derive(Default)]
pub(super) struct Tally {
    touches: BTreeMap<EntityId, Touches>,
}

impl Tally {
    /// Counts what happened in a step.
    pub(super) fn count(&mut self, scene: &dyn Scene, events: &[Event]) {
        for event in events {
            let EventKind::Contact { a, b, .. } = event.kind else { continue };
            for (own, other) in [(a, b), (b, a)] {
                let Some(touched) = scene.entity(other) else { continue };
                let touches = self.touches.entry(own).or_default();
                *match touched.kind {
                    EntityKind::Person => &mut touches.humans,
                    EntityKind::Building => &mut touches.buildings,
                    kind if kind.is_vehicle() => &mut touches.vehicles,
                    _ => &mut touches.objects,
                } += 1;
            }
        }
        if self.touches.len() > MANY {
            self.touches.retain(|id, _| scene.entity(*id).is_some());
        }
    }

    pub(super) fn of(&self, id: EntityId) -> Touches {
        self.touches.get(&id).copied().unwrap_or_default()
    }
}
