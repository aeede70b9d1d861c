//! Entities by what they are, what they are used as and what they are made of: what "the cafés" are, without a look at everything.

use std::collections::{BTreeMap, BTreeSet};

use super::{EntityInfo, EntityKind, Place};
use crate::id::{AssetId, EntityId};

/// Entities by kind and by use. A [`World`](super::World) keeps it as things come and go; it follows from them alone, so it is no part
/// of a snapshot.
///
/// ```
/// use simworld_core::geometry::Pose;
/// use simworld_core::scene::{EntityDesc, EntityKind, Place, Scene, Shape, World};
/// let mut world = World::new();
/// let house = EntityDesc::new(EntityKind::Building, Pose::identity(), Shape::cuboid(9.0, 9.0, 6.0));
/// let id = world.spawn(house.used_as(Place::Museum))?;
/// let classes = world.classes().unwrap();
/// assert!(classes.of_kind(EntityKind::Building).eq([id]) && classes.of_place(Place::Museum).eq([id]));
/// assert_eq!(classes.of_kind(EntityKind::Tree).count(), 0);
/// # Ok::<(), simworld_core::scene::WorldError>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ClassIndex {
    kinds: BTreeMap<EntityKind, BTreeSet<EntityId>>,
    places: BTreeMap<Place, BTreeSet<EntityId>>,
    /// How many are made of an asset; who they are the kinds tell.
    assets: BTreeMap<AssetId, u32>,
}

impl ClassIndex {
    pub(crate) fn insert(&mut self, id: EntityId, kind: EntityKind, info: &EntityInfo) {
        self.kinds.entry(kind).or_default().insert(id);
        if let Some(place) = info.place {
            self.places.entry(place).or_default().insert(id);
        }
        if let Some(asset) = info.asset {
            *self.assets.entry(asset).or_default() += 1;
        }
    }

    pub(crate) fn remove(&mut self, id: EntityId, kind: EntityKind, info: &EntityInfo) {
        if let Some(of_kind) = self.kinds.get_mut(&kind) {
            of_kind.remove(&id);
        }
        if let Some(of_place) = info.place.and_then(|place| self.places.get_mut(&place)) {
            of_place.remove(&id);
        }
        if let Some(asset) = info.asset
            && let Some(count) = self.assets.get_mut(&asset)
        {
            *count -= 1;
            if *count == 0 {
                self.assets.remove(&asset);
            }
        }
    }

    /// Those of a kind, ascending.
    pub fn of_kind(&self, kind: EntityKind) -> impl Iterator<Item = EntityId> {
        self.kinds.get(&kind).into_iter().flatten().copied()
    }

    /// How many are made of an asset of the scene's catalogue.
    pub fn count_of(&self, asset: AssetId) -> usize {
        self.assets.get(&asset).map_or(0, |count| *count as usize)
    }

    /// Those that are used so, ascending.
    pub fn of_place(&self, place: Place) -> impl Iterator<Item = EntityId> {
        self.places.get(&place).into_iter().flatten().copied()
    }
}
