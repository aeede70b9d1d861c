//! Lots: blocks divided into pieces of land that each have a front to a street, and the greens between them.

mod config;
mod corner;
mod divide;
mod opposite;
mod ribbon;
mod slabs;
mod strips;

pub use config::{LotConfig, LotSize, LotStyle};
use rayon::prelude::*;
use simworld_core::geometry::{Point2, Vector2};
use simworld_core::id::RoadId;
use simworld_core::net::{RoadNetwork, Side};
use simworld_core::seed::{Seed, Stream};

use crate::block::{Block, Border, Ring};
use crate::key::stream_at;
use crate::occupancy::Occupancy;
use crate::zoning::{Zone, Zoning};
use divide::Divider;
pub(crate) use strips::Strip;

/// Blocks that one thread divides at once.
const CHUNK: usize = 64;
/// Places in the streams of lots are told to a tenth of a metre, 1/m.
const PER_METRE: f64 = 10.0;

/// A piece of land with a front to a street; convex.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lot {
    /// Its corners and borders in [`Land`]: the first, and how many.
    start: u32,
    count: u32,
    /// The block it is a part of, an index into [`Land::blocks`].
    pub block: u32,
    /// What it is used for.
    pub zone: Zone,
    /// How densely people live there, in [0, 1].
    pub density: f64,
    /// Area, m².
    pub area: f64,
    /// The road at its front.
    pub road: RoadId,
    /// The side of that road.
    pub side: Side,
}

/// Why a piece of land is not built on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum GreenKind {
    /// A park.
    Park,
    /// The inside of a block, behind its lots.
    Courtyard,
    /// A corner too small or too narrow for a lot.
    Leftover,
}

/// A piece of land without a building.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Green {
    start: u32,
    count: u32,
    /// The block it is a part of, an index into [`Land::blocks`].
    pub block: u32,
    /// The sidewalk that what grows there belongs to: in open land that at its front, else the first round its block.
    pub along: Border,
    /// Why it is green.
    pub kind: GreenKind,
    /// Area, m².
    pub area: f64,
}

/// All land between the streets: blocks, lots and greens.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Land {
    /// The blocks.
    pub blocks: Vec<Block>,
    /// The lots: those of closed blocks, block by block, then those of open ones.
    pub lots: Vec<Lot>,
    /// The greens, in the same order.
    pub greens: Vec<Green>,
    /// Length of the edges of blocks along sidewalks where buildings may stand, m.
    pub frontage: f64,
    corners: Vec<Point2>,
    borders: Vec<Border>,
}

impl Land {
    /// Divides the land between the streets of a network. `taken` is what no lot of an open block may touch: the land
    /// of the roads.
    pub fn of_network(
        network: &RoadNetwork,
        zoning: &Zoning,
        config: &LotConfig,
        seed: Seed,
        taken: &Occupancy,
    ) -> Self {
        Self::of_blocks(Block::of_network(network), zoning, config, seed, taken)
    }

    /// Divides the land between the streets of a network; and the land of the roads, which is found meanwhile.
    pub fn beside_roads(
        network: &RoadNetwork,
        zoning: &Zoning,
        config: &LotConfig,
        seed: Seed,
    ) -> (Self, Occupancy) {
        let (taken, blocks) = rayon::join(|| Occupancy::of_roads(network), || Block::of_network(network));
        (Self::of_blocks(blocks, zoning, config, seed, &taken), taken)
    }

    /// Divides some blocks of a network. `taken` is what no lot of an open block may touch: the land of the roads.
    pub(crate) fn of_blocks(
        blocks: Vec<Block>,
        zoning: &Zoning,
        config: &LotConfig,
        seed: Seed,
        taken: &Occupancy,
    ) -> Self {
        Self::of_fronts(blocks, zoning, config, seed, (taken, &|_, _| true))
    }

    /// Divides some blocks of a network, and along open ones those fronts alone that are asked for by the block and its edge. What
    /// is fitted there depends on longer fronts near by, so these have to be asked for as well.
    pub(crate) fn of_fronts(
        blocks: Vec<Block>,
        zoning: &Zoning,
        config: &LotConfig,
        seed: Seed,
        (taken, is_fitted): (&Occupancy, &(dyn Fn(usize, usize) -> bool + Sync)),
    ) -> Self {
        let streams = seed.stream("citygen/lots");
        // The lots of open blocks are fitted one after another, which takes long: meanwhile the closed ones are divided.
        let (mut parts, (open, fronts)) = rayon::join(
            || Self::of_closed(&blocks, zoning, config, streams),
            || Self::of_open(&blocks, zoning, config, streams, (taken, is_fitted)),
        );
        if !open.corners.is_empty() {
            parts.push(open);
        }
        let mut land = Self::joined(parts);
        land.frontage = fronts.into_iter().fold(land.frontage, |sum, front| sum + front);
        land.blocks = blocks;
        land
    }

    /// Divides the closed ones of some blocks, those of each part by themselves.
    fn of_closed(blocks: &[Block], zoning: &Zoning, config: &LotConfig, streams: Stream) -> Vec<Self> {
        let numbered: Vec<(u32, &Block)> = (0..).zip(blocks).collect();
        // Closed blocks are functions of themselves, so they are divided on all threads.
        numbered
            .par_chunks(CHUNK)
            .map(|chunk| {
                let mut part = Self::for_blocks(chunk.len());
                for (index, block) in chunk.iter().filter(|(_, block)| block.area.is_some()) {
                    Divider::new(&mut part, (*index, block), zoning, config, streams).divide(block.ring());
                }
                part
            })
            .collect()
    }

    /// With room for what that many blocks mostly are divided into.
    fn for_blocks(count: usize) -> Self {
        let lots = 20 * count;
        Self {
            lots: Vec::with_capacity(lots),
            greens: Vec::with_capacity(2 * count),
            corners: Vec::with_capacity(5 * lots),
            borders: Vec::with_capacity(5 * lots),
            ..Self::default()
        }
    }

    /// Lines the open ones of some blocks with lots; and says how long each front is, m.
    fn of_open(
        blocks: &[Block],
        zoning: &Zoning,
        config: &LotConfig,
        streams: Stream,
        (taken, is_fitted): (&Occupancy, &(dyn Fn(usize, usize) -> bool + Sync)),
    ) -> (Self, Vec<f64>) {
        let (mut land, mut ribbons, mut fronts) = (Self::default(), Occupancy::default(), Vec::new());
        for (index, block) in (0..).zip(blocks).filter(|(_, block)| block.area.is_none()) {
            let mut divider = Divider::new(&mut land, (index, block), zoning, config, streams);
            let is_fitted = |edge| is_fitted(index as usize, edge);
            let around = ribbon::Land { streams, taken, is_fitted: &is_fitted };
            fronts.append(&mut ribbon::line(&mut divider, block, &around, &mut ribbons));
        }
        (land, fronts)
    }

    /// Gives every border the number that it has in a part of the network, or none; `renumbered` says it.
    pub(crate) fn in_part(mut self, renumbered: impl Fn(Border) -> Border) -> Self {
        let blocks = self.blocks.iter_mut().flat_map(|block| &mut block.borders);
        for border in
            blocks.chain(&mut self.borders).chain(self.greens.iter_mut().map(|green| &mut green.along))
        {
            *border = renumbered(*border);
        }
        for lot in &mut self.lots {
            if let Some((road, side)) = renumbered(Border::street(lot.road, lot.side)).as_street() {
                (lot.road, lot.side) = (road, side);
            }
        }
        self
    }

    /// The greens and their blocks alone: all that is asked for once buildings stand, and a fraction of the memory.
    pub(crate) fn greens_alone(self) -> Self {
        let mut land = Self { frontage: self.frontage, ..Self::default() };
        for green in &self.greens {
            let outline = self.green_outline(green);
            land.greens.push(Green { start: land.corners.len() as u32, ..*green });
            land.corners.extend_from_slice(outline);
        }
        land.blocks = self.blocks;
        land
    }

    /// All that some parts of the land hold, in their order. It is as much as can be carried, so two threads carry it.
    fn joined(mut parts: Vec<Self>) -> Self {
        if parts.len() < 2 {
            return parts.pop().unwrap_or_default();
        }
        let corners: Vec<Vec<Point2>> =
            parts.iter_mut().map(|part| std::mem::take(&mut part.corners)).collect();
        let mut starts = Vec::with_capacity(parts.len());
        let count = corners.iter().fold(0, |start, part| {
            starts.push(start as u32);
            start + part.len()
        });
        let (corners, mut land) = rayon::join(
            || in_one(corners, count),
            || {
                let sum = |counted: fn(&Self) -> usize| parts.iter().map(counted).sum();
                let mut land = Self {
                    lots: Vec::with_capacity(sum(|part| part.lots.len())),
                    greens: Vec::with_capacity(sum(|part| part.greens.len())),
                    borders: Vec::with_capacity(count),
                    ..Self::default()
                };
                for (mut part, shift) in parts.into_iter().zip(starts) {
                    land.borders.append(&mut part.borders);
                    land.lots
                        .extend(part.lots.into_iter().map(|lot| Lot { start: lot.start + shift, ..lot }));
                    let moved = |green: Green| Green { start: green.start + shift, ..green };
                    land.greens.extend(part.greens.into_iter().map(moved));
                    land.frontage += part.frontage;
                }
                land
            },
        );
        land.corners = corners;
        land
    }

    /// Divides one closed block by itself; an open one has no lots.
    ///
    /// ```
    /// use simworld_citygen::block::{Block, Border};
    /// use simworld_citygen::lot::{Land, LotConfig};
    /// use simworld_citygen::zoning::{Zoning, ZoningConfig};
    /// use simworld_core::{geometry::Point2, id::RoadId, net::Side, seed::Seed};
    /// let corners = [(0.0, 0.0), (90.0, 0.0), (90.0, 80.0), (0.0, 80.0)].map(|(x, y)| Point2::new(x, y));
    /// let streets = (0..4).map(|road| Border::street(RoadId::from_index(road), Side::Left)).collect();
    /// let block = Block::closed(corners.to_vec(), streets).expect("a rectangle is simple");
    /// let zoning = Zoning::new(&ZoningConfig::default(), Seed(1));
    /// let land = Land::of_block(block, &zoning, &LotConfig::default(), Seed(1));
    /// let area: f64 = land.lots.iter().map(|lot| lot.area).chain(land.greens.iter().map(|green| green.area)).sum();
    /// assert!((area - 90.0 * 80.0).abs() < 1e-6);
    /// ```
    pub fn of_block(block: Block, zoning: &Zoning, config: &LotConfig, seed: Seed) -> Self {
        let mut land = Self::default();
        if block.area.is_some() {
            let streams = seed.stream("citygen/lots");
            Divider::new(&mut land, (0, &block), zoning, config, streams).divide(block.ring());
        }
        land.blocks.push(block);
        land
    }

    /// The corners of a lot, counter-clockwise; its front leads from the first to the second.
    pub fn outline(&self, lot: &Lot) -> &[Point2] {
        &self.corners[lot.start as usize..(lot.start + lot.count) as usize]
    }

    /// What lies beyond each edge of a lot, the front first.
    pub fn borders(&self, lot: &Lot) -> &[Border] {
        &self.borders[lot.start as usize..(lot.start + lot.count) as usize]
    }

    /// The corners of a green, counter-clockwise.
    pub fn green_outline(&self, green: &Green) -> &[Point2] {
        &self.corners[green.start as usize..(green.start + green.count) as usize]
    }

    fn store(&mut self, ring: &Ring, first: usize) -> (u32, u32) {
        let start = self.corners.len() as u32;
        let (corners, borders) = (ring.corners.split_at(first), ring.borders.split_at(first));
        for (corners, borders) in [(corners.1, borders.1), (corners.0, borders.0)] {
            self.corners.extend_from_slice(corners);
            self.borders.extend_from_slice(borders);
        }
        (start, ring.len() as u32)
    }
}

/// So many things of some parts, in their order.
fn in_one<T>(parts: Vec<Vec<T>>, count: usize) -> Vec<T> {
    let mut all = Vec::with_capacity(count);
    for mut part in parts {
        all.append(&mut part);
    }
    all
}

/// The stream of a block is a function of where it lies, so that a change elsewhere in the city changes no lot here.
fn stream_of(block: &Block, streams: Stream) -> Stream {
    let low =
        block.outline.iter().fold(Vector2::repeat(f64::INFINITY), |low, corner| low.inf(&corner.coords));
    stream_at(low.into(), PER_METRE, streams)
}
