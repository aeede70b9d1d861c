//! A city without end, made tile by tile.
//!
//! Growth from one seed has a global order and cannot be cut into tiles. Here the plane is divided coarse to fine: main
//! streets run along a jittered lattice ([`LatticeConfig`]), the gates in them through which streets may lead are fixed
//! first, and the superblock between is filled by the rules of [`growth`] from its gates inwards. Each step
//! draws from a stream named by whole numbers, so a tile is a function of the seed and its [`TileId`] alone: the same
//! alone or beside others, in any order, on any thread; and the streets of neighbours meet exactly at the seam.

mod complete;
mod config;
mod draft;
mod lattice;
mod stream;
mod window;

use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use simworld_core::geometry::Point2;
use simworld_core::net::{Street, StreetPlan};
use simworld_core::seed::{Seed, Stream};

pub use complete::Tile;
pub use config::{LatticeConfig, TileConfig};
pub use stream::{CityStream, StreamConfig, TileChanges, WorldStream};
pub use window::Window;

use crate::growth::{self, Soil, Within};
use crate::{CityError, RoadConfig};
use draft::{Beyond, Drawer};
use lattice::Lattice;

/// A tile: the square from (x, y) to (x + 1, y + 1) times its side, but for the jitter of its main streets.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
pub struct TileId {
    /// Its column, counted to the east, in ±2000.
    pub x: i32,
    /// Its row, counted to the north, in ±2000.
    pub y: i32,
}

/// Coordinates stay within ±1e7 m, as plans demand, whatever the side of a tile.
const FARTHEST: i32 = 2000;

impl TileId {
    /// The tile of a column and a row.
    pub const fn new(x: i32, y: i32) -> Self {
        Self { x, y }
    }

    /// The tile if it is near enough.
    fn checked(self) -> Result<Self, CityError> {
        match [("tile.x", self.x), ("tile.y", self.y)]
            .into_iter()
            .find(|(_, at)| at.unsigned_abs() > FARTHEST.unsigned_abs())
        {
            Some((field, at)) => {
                Err(CityError::Config { field, value: f64::from(at), allowed: "-2000 to 2000" })
            }
            None => Ok(self),
        }
    }
}

/// Makes tiles: a configuration and a seed, and nothing that changes.
#[derive(Clone, Debug)]
pub struct TileSource {
    config: TileConfig,
    seed: Seed,
    lattice: Lattice,
    superblocks: Stream,
}

impl TileSource {
    /// The city of a configuration and a seed.
    ///
    /// # Errors
    /// A setting out of range.
    pub fn new(config: TileConfig, seed: Seed) -> Result<Self, CityError> {
        config.validate()?;
        let lattice = Lattice::new(&config.lattice, seed);
        Ok(Self { config, seed, lattice, superblocks: seed.stream("citygen/superblocks") })
    }

    /// What its tiles are like.
    pub fn config(&self) -> &TileConfig {
        &self.config
    }

    /// Its seed.
    pub const fn seed(&self) -> Seed {
        self.seed
    }

    /// The tile at a point, but for the jitter of the main streets.
    pub fn tile_at(&self, point: Point2) -> TileId {
        let side = self.config.lattice.tile_side();
        TileId { x: (point.x / side).floor() as i32, y: (point.y / side).floor() as i32 }
    }

    /// Makes a tile, complete: the same whenever it is asked for.
    ///
    /// ```
    /// use simworld_citygen::tile::{TileConfig, TileId, TileSource};
    /// use simworld_core::seed::Seed;
    /// let source = TileSource::new(TileConfig::default(), Seed(7))?;
    /// let tile = source.tile(TileId::new(-3, 12))?;
    /// assert!(tile.buildings.len() > 500);
    /// # Ok::<(), simworld_citygen::CityError>(())
    /// ```
    ///
    /// # Errors
    /// A tile too far from the origin, or settings by which its streets cannot be built.
    pub fn tile(&self, id: TileId) -> Result<Tile, CityError> {
        Tile::of(self, id.checked()?)
    }

    /// Makes some tiles, in their order, on all threads of the current pool.
    ///
    /// # Errors
    /// The first tile that cannot be made.
    pub fn tiles(&self, ids: &[TileId]) -> Result<Vec<Tile>, CityError> {
        ids.par_iter().map(|id| self.tile(*id)).collect()
    }

    /// The tiles from one to another, corners of a rectangle: a source of streets.
    ///
    /// # Errors
    /// No tiles, more than 10 000, or tiles too far from the origin.
    pub fn window(&self, south_west: TileId, north_east: TileId) -> Result<Window<'_>, CityError> {
        Window::new(self, south_west, north_east)
    }

    /// The square of a tile, its least and its greatest corner, m.
    pub fn square(&self, id: TileId) -> (Point2, Point2) {
        let side = self.config.lattice.tile_side();
        let corner = |x: i32, y: i32| Point2::new(f64::from(x) * side, f64::from(y) * side);
        (corner(id.x, id.y), corner(id.x + 1, id.y + 1))
    }

    /// The streets of some tiles and the main streets round them, joined.
    pub(crate) fn plan_of(&self, ids: &[TileId]) -> StreetPlan {
        let mut sorted = ids.to_vec();
        sorted.sort_unstable();
        let has = |x: i32, y: i32| sorted.binary_search(&TileId { x, y }).is_ok();
        let mut drawer = Drawer::new(self);
        for id in ids {
            let beyond = Beyond::Seam { north: !has(id.x, id.y + 1), east: !has(id.x + 1, id.y) };
            drawer.tile(self, *id, beyond);
        }
        drawer.plan
    }

    fn lattice(&self) -> &Lattice {
        &self.lattice
    }

    /// The streets within a superblock.
    fn superblock(&self, column: i64, row: i64, soil: &mut Soil) -> Superblock {
        let wall = self.lattice.wall(column, row);
        let own = self.superblocks.indexed(column as u64).indexed(row as u64).seed();
        let within = growth::grow_within(&wall, &self.config.city.roads, soil, own);
        Superblock { within, walls: wall.len() }
    }
}

/// The streets within a superblock.
struct Superblock {
    within: Within,
    /// So many of their nodes, the first ones, lie on the main streets round it.
    walls: usize,
}

impl Superblock {
    /// Whether some of the streets end dead.
    fn has_dead_end(&self, counts: impl Fn(&Street) -> bool) -> bool {
        let Self { within, walls } = self;
        let mut degrees = vec![0_u32; within.nodes.len()];
        for end in within.streets.iter().flat_map(|street| [street.from, street.to]) {
            degrees[end] += 1;
        }
        let is_dead = |end: usize| end >= *walls && degrees[end] == 1;
        within.streets.iter().any(|street| (is_dead(street.from) || is_dead(street.to)) && counts(street))
    }

    /// Gives the dead ends within room to turn. Nothing beyond its wall is near, so that neighbours who look at it see the
    /// same.
    fn make_turning_room(&mut self, roads: &RoadConfig) {
        let (mut plan, sections) = growth::plan_of_sections(roads);
        plan.nodes = std::mem::take(&mut self.within.nodes);
        plan.streets = std::mem::take(&mut self.within.streets);
        let (count, walls) = (plan.streets.len(), self.walls);
        let main = |node: usize| Street { section: sections[1], ..Street::simple(node, (node + 1) % walls) };
        plan.streets.extend((0..walls).map(main));
        plan.make_turning_room();
        plan.streets.truncate(count);
        self.within = Within { nodes: plan.nodes, streets: plan.streets };
    }
}
