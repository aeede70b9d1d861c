//! The assets from which the entities of a city are made.

use simworld_core::asset::{Asset, Catalogue};
use simworld_core::id::AssetId;
use simworld_core::scene::{EntityKind, Scene, Shape, World, WorldError};

use crate::building::{Archetype, STOREY};

/// The assets of a city, as its entities ask for them.
pub(super) struct Assets {
    standard: Catalogue,
    /// By the kind of building, in the order in which they were asked for.
    buildings: Vec<(&'static str, AssetId)>,
    /// By the kind of element; none of a kind that has no ordinary asset.
    kinds: Vec<(EntityKind, Option<AssetId>)>,
}

impl Assets {
    pub(super) fn new() -> Self {
        Self { standard: Catalogue::standard(), buildings: Vec::new(), kinds: Vec::new() }
    }

    pub(super) fn of_building(
        &mut self,
        kind: &'static Archetype,
        world: &mut World,
    ) -> Result<AssetId, WorldError> {
        if let Some((_, id)) = self.buildings.iter().find(|(name, _)| *name == kind.name) {
            return Ok(*id);
        }
        let id = present_or_new(asset_of(kind), world)?;
        self.buildings.push((kind.name, id));
        Ok(id)
    }

    pub(super) fn of_kind(
        &mut self,
        kind: EntityKind,
        world: &mut World,
    ) -> Result<Option<AssetId>, WorldError> {
        if let Some((_, id)) = self.kinds.iter().find(|(known, _)| *known == kind) {
            return Ok(*id);
        }
        let asset = self.standard.find(kind.as_str()).and_then(|id| self.standard.get(id)).cloned();
        let id = asset.map(|asset| present_or_new(asset, world)).transpose()?;
        self.kinds.push((kind, id));
        Ok(id)
    }
}

fn present_or_new(asset: Asset, world: &mut World) -> Result<AssetId, WorldError> {
    match world.assets().and_then(|assets| assets.find(&asset.name)) {
        Some(id) => Ok(id),
        None => Ok(world.add_asset(asset)?),
    }
}

/// A kind of building as an asset of its middle size.
fn asset_of(kind: &Archetype) -> Asset {
    let middle = |(low, high): (f64, f64)| 0.5 * (low + high);
    let storeys = 0.5 * f64::from(kind.storeys.0 + kind.storeys.1);
    let collider = Shape::cuboid(middle(kind.depth), middle(kind.width), storeys * STOREY);
    Asset {
        place: Some(kind.place),
        color: Some(kind.color),
        source: "simworld, procedural".to_owned(),
        ..Asset::new(kind.name, EntityKind::Building, collider)
    }
}
