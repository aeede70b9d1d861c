//! The ways that bodies have come in the last seconds.

use std::collections::{BTreeMap, VecDeque};

use simworld_core::geometry::Point3;
use simworld_core::id::EntityId;
use simworld_core::scene::World;

/// So many places are kept of each body.
const KEPT: usize = 30;
/// A place is kept every so many steps.
const EVERY: u64 = 4;

/// Where bodies were.
#[derive(Clone, Debug, Default)]
pub(super) struct Trails {
    places: BTreeMap<EntityId, VecDeque<Point3>>,
}

impl Trails {
    /// Notes where everything that moves is after a step.
    pub(super) fn note(&mut self, world: &World, tick: u64) {
        if !tick.is_multiple_of(EVERY) {
            return;
        }
        let mut present = BTreeMap::new();
        for body in world.iter().filter(|body| body.kind.is_mobile()) {
            let mut places = self.places.remove(&body.id).unwrap_or_default();
            places.push_back(body.position());
            if places.len() > KEPT {
                places.pop_front();
            }
            present.insert(body.id, places);
        }
        self.places = present;
    }

    /// Every trail, by id.
    pub(super) fn each(&self) -> impl Iterator<Item = (EntityId, &VecDeque<Point3>)> {
        self.places.iter().map(|(id, places)| (*id, places))
    }
}
