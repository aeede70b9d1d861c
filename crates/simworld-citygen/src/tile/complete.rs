//! A complete tile: streets, lanes, lots, buildings and elements.

use std::sync::Arc;

use simworld_core::geometry::Point2;
use simworld_core::net::{RoadNetwork, StreetPlan};
use simworld_core::scene::World;
use simworld_core::seed::Seed;

use super::draft::Draft;
use super::{TileId, TileSource};
use crate::block::Block;
use crate::building::{self, Building};
use crate::element::{self, Element, Extent, Setting};
use crate::lot::Land;
use crate::occupancy::Occupancy;
use crate::populate::{Parts, Scope};
use crate::terrain::{Ground, Terrain, TerrainConfig};
use crate::zoning::Zoning;
use crate::{CityEntities, CityError};

/// A tile and all that stands on it: a function of the source and its id.
#[derive(Clone, Debug, PartialEq)]
pub struct Tile {
    /// Which it is.
    pub id: TileId,
    /// Its streets, and those of its neighbours that meet its outline.
    pub plan: StreetPlan,
    /// What of the streets is its own: the first [`Extent::streets`] of the plan and the land on the sides marked.
    pub extent: Extent,
    /// Lanes, crossings and all else that follows from the plan; along the outline the same as its neighbours'.
    pub network: Arc<RoadNetwork>,
    /// Its buildings.
    pub buildings: Vec<Building>,
    /// Its street elements.
    pub elements: Vec<Element>,
    /// Its square, the least and the greatest corner, m.
    square: (Point2, Point2),
}

impl Tile {
    /// Makes a tile.
    pub(super) fn of(source: &TileSource, id: TileId) -> Result<Self, CityError> {
        let (config, seed) = (&source.config().city, source.seed());
        let Draft { plan, own, sides, .. } = Draft::of(source, id);
        let extent = Extent { streets: own, sides };
        let network = RoadNetwork::derive(&plan, &config.network)?;
        // What lies beyond the outline of the tile is nobody's here: nothing is built there, and what is built here does not
        // reach there.
        let mut taken = Occupancy::of_roads_where(&network, |road| extent.has_any_side(road));
        let zoning = Zoning::new(&config.zoning, seed);
        let blocks = Block::of_sides(&network, extent.numbered_sides());
        let land = Land::of_blocks(blocks, &zoning, &config.lots, seed, &taken);
        // Places and names are drawn tile by tile.
        let own_seed = seed.stream("citygen/tiles").indexed(id.x as u64).indexed(id.y as u64).seed();
        let buildings = building::build(&network, &land, &config.buildings, own_seed, &mut taken);
        let setting = Setting {
            plan: &plan,
            network: &network,
            zoning: &zoning,
            land: &land,
            buildings: &buildings,
            within: Some(&extent),
        };
        let elements = element::furnish(&setting, &config.elements, seed, &mut taken);
        Ok(Self {
            id,
            plan,
            extent,
            network: Arc::new(network),
            buildings,
            elements,
            square: source.square(id),
        })
    }

    /// Puts the tile into a world: its ground, streets, buildings and elements as entities. The roads of the world stay as
    /// they are; [`CityEntities::leave`] takes the tile out again.
    ///
    /// # Errors
    /// The world refused an entity.
    pub fn enter(&self, world: &mut World) -> Result<CityEntities, CityError> {
        // Tiles are level: their streets have no heights.
        let land = Terrain::new(&TerrainConfig::default(), Seed(0));
        let heights = Ground::new(&self.network, &land);
        let parts = Parts {
            heights: &heights,
            network: &self.network,
            buildings: &self.buildings,
            elements: &self.elements,
            scope: Scope::Tile(&self.extent),
            ground: Some(self.square),
            rows: None,
            margin: 0.0,
        };
        Ok(parts.spawn(world)?)
    }
}
