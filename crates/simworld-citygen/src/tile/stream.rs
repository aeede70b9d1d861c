//! The tiles around a moving point.

use std::collections::BTreeMap;
use std::sync::Arc;

use serde::{Deserialize, Serialize};
use simworld_core::geometry::Point2;
use simworld_core::net::StreetPlan;
use simworld_core::scene::World;

use super::{Tile, TileId, TileSource};
use crate::range::check;
use crate::{CityEntities, CityError};

/// What is held around the point.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct StreamConfig {
    /// Tiles nearer than this are held, m, in [0, 20 000].
    pub reach: f64,
    /// Tiles are let go only when they are so much farther than the reach, m, in [0, 20 000], so that who walks to and fro
    /// on an edge makes no tile twice.
    pub slack: f64,
}

impl Default for StreamConfig {
    fn default() -> Self {
        Self { reach: 1000.0, slack: 500.0 }
    }
}

/// What changed when the point moved.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TileChanges {
    /// Tiles that came into reach, row by row from the south-west.
    pub entered: Vec<Arc<Tile>>,
    /// Tiles that were let go, in the same order.
    pub left: Vec<Arc<Tile>>,
}

/// A city without end, of which the tiles around a point are held.
///
/// ```
/// use simworld_citygen::tile::{CityStream, StreamConfig, TileConfig, TileSource};
/// use simworld_core::{geometry::Point2, seed::Seed};
/// let source = TileSource::new(TileConfig::default(), Seed(7))?;
/// let mut stream = CityStream::new(source, StreamConfig { reach: 300.0, slack: 200.0 })?;
/// assert_eq!(stream.move_to(Point2::new(500.0, 500.0))?.entered.len(), 1);
/// let changes = stream.move_to(Point2::new(1550.0, 500.0))?;
/// assert_eq!((changes.entered.len(), changes.left.len(), stream.tiles().count()), (1, 1, 1));
/// # Ok::<(), simworld_citygen::CityError>(())
/// ```
#[derive(Clone, Debug)]
pub struct CityStream {
    source: TileSource,
    config: StreamConfig,
    held: BTreeMap<(i32, i32), Arc<Tile>>,
}

impl CityStream {
    /// Holds nothing until the point is somewhere.
    ///
    /// # Errors
    /// A distance out of range.
    pub fn new(source: TileSource, config: StreamConfig) -> Result<Self, CityError> {
        check(&[
            ("stream.reach", config.reach, 0.0, 2e4, "0 to 20 000 m"),
            ("stream.slack", config.slack, 0.0, 2e4, "0 to 20 000 m"),
        ])?;
        Ok(Self { source, config, held: BTreeMap::new() })
    }

    /// Where its tiles come from.
    pub const fn source(&self) -> &TileSource {
        &self.source
    }

    /// The tiles that are held, row by row from the south-west.
    pub fn tiles(&self) -> impl Iterator<Item = &Arc<Tile>> {
        self.held.values()
    }

    /// Moves the point: makes the tiles that came into reach, on all threads, and lets go those far behind.
    ///
    /// # Errors
    /// A point too far from the origin, or not a number; then nothing changes.
    pub fn move_to(&mut self, point: Point2) -> Result<TileChanges, CityError> {
        let farthest = 2000.0 * self.source.config().lattice.tile_side();
        check(&[
            ("point.x", point.x, -farthest, farthest, "a coordinate within 2000 tiles of the origin"),
            ("point.y", point.y, -farthest, farthest, "a coordinate within 2000 tiles of the origin"),
        ])?;
        let wanted = self.within(point, self.config.reach);
        let missing: Vec<TileId> =
            wanted.into_iter().filter(|id| !self.held.contains_key(&(id.y, id.x))).collect();
        let entered: Vec<Arc<Tile>> = self.source.tiles(&missing)?.into_iter().map(Arc::new).collect();
        let far: Vec<(i32, i32)> = self
            .held
            .iter()
            .filter(|(_, tile)| self.distance(tile.id, point) > self.config.reach + self.config.slack)
            .map(|(key, _)| *key)
            .collect();
        let left = far.iter().filter_map(|key| self.held.remove(key)).collect();
        self.held.extend(entered.iter().map(|tile| ((tile.id.y, tile.id.x), Arc::clone(tile))));
        Ok(TileChanges { entered, left })
    }

    /// The streets of all tiles held, joined, with the main streets round them: what one network is derived from.
    pub fn plan(&self) -> StreetPlan {
        let ids: Vec<TileId> = self.held.values().map(|tile| tile.id).collect();
        self.source.plan_of(&ids)
    }

    /// Tiles whose square is no farther from a point than a distance.
    fn within(&self, point: Point2, distance: f64) -> Vec<TileId> {
        let side = self.source.config().lattice.tile_side();
        let span = |x: f64| (((x - distance) / side).floor() as i32, ((x + distance) / side).floor() as i32);
        let (columns, rows) = (span(point.x), span(point.y));
        let all = (rows.0..=rows.1).flat_map(|y| (columns.0..=columns.1).map(move |x| TileId { x, y }));
        all.filter(|id| self.distance(*id, point) <= distance).collect()
    }

    /// Distance from a point to the square of a tile, m.
    fn distance(&self, id: TileId, point: Point2) -> f64 {
        let (low, high) = self.source.square(id);
        (point - point.sup(&low).inf(&high)).norm()
    }
}

/// A city without end of which the tiles around a point are in a world.
#[derive(Clone, Debug)]
pub struct WorldStream {
    stream: CityStream,
    entities: BTreeMap<TileId, CityEntities>,
}

impl WorldStream {
    /// Puts what a stream holds into a world as it moves. The stream should hold nothing yet.
    pub const fn new(stream: CityStream) -> Self {
        Self { stream, entities: BTreeMap::new() }
    }

    /// The tiles behind it.
    pub const fn stream(&self) -> &CityStream {
        &self.stream
    }

    /// The entities of a tile that is in the world.
    pub fn entities(&self, id: TileId) -> Option<&CityEntities> {
        self.entities.get(&id)
    }

    /// Moves the point: tiles that came into reach enter the world, tiles far behind leave it. The world's roads are its
    /// own: [`CityStream::plan`] gives the streets to derive them from.
    ///
    /// # Errors
    /// A point too far from the origin, or an entity that the world refused.
    pub fn move_to(&mut self, point: Point2, world: &mut World) -> Result<TileChanges, CityError> {
        let changes = self.stream.move_to(point)?;
        for tile in &changes.left {
            if let Some(entities) = self.entities.remove(&tile.id) {
                entities.leave(world);
            }
        }
        for tile in &changes.entered {
            self.entities.insert(tile.id, tile.enter(world)?);
        }
        Ok(changes)
    }
}
