//! The open land round a town, of which an edit has only that part made anew that it reaches.
//!
//! Lots of open land are fitted along one front after another, longest first, where those before have left room. So what comes out along a
//! front follows from fronts near it that come before, and decides on fronts near it that come after: the one by longer and longer ones, the
//! other by shorter and shorter ones. Lengths lie by chance, so both are few, however large the town is.

use std::collections::{BTreeMap, BTreeSet};

use simworld_core::geometry::bounds;

use super::cells::{Bounds, Cells, inflated};
use crate::City;
use crate::block::{Block, Border, sides_round};
use crate::lot::Strip;
use crate::zoning::Zoning;

/// What stands behind a sidewalk reaches so far from its middle, m.
const BEHIND: f64 = 8.0;
/// What stands along a sidewalk may be in the way of what stands along another that is as near as this, m.
pub(super) const IN_THE_WAY: f64 = 12.0;

/// The faces round some sides of streets, and what is fitted along the fronts of open ones.
pub(super) struct Outskirts {
    /// The faces, in the order in which they are divided.
    pub(super) blocks: Vec<Block>,
    /// The sides round open faces, and round all others.
    pub(super) open: BTreeSet<usize>,
    pub(super) closed: BTreeSet<usize>,
    /// The fronts of open faces in the order in which they get their lots, each with its face.
    pub(super) strips: Vec<(usize, Strip)>,
    lots: Cells,
    by_side: BTreeMap<usize, Vec<usize>>,
    /// The pieces of the sidewalks of open faces: the side of each, and the rectangle round it.
    walks: Vec<(usize, Bounds)>,
    walks_near: Cells,
    walks_of: BTreeMap<usize, Vec<usize>>,
}

impl Outskirts {
    /// Of all faces that some sides bound, which are all round them.
    pub(super) fn of(city: &City, sides: &BTreeSet<usize>) -> Self {
        let network = &*city.network;
        let zoning = Zoning::new(&city.config.zoning, city.provenance.seed);
        let blocks = Block::of_sides(network, sides.iter().copied());
        let is_open = |(_, block): &(usize, &Block)| block.area.is_none();
        let first = |block: &Block| block.borders.iter().find_map(|border| border.side());
        let (mut open, mut strips) = (BTreeSet::new(), Vec::new());
        for (number, block) in blocks.iter().enumerate().filter(is_open) {
            open.extend(sides_round(network, first(block)));
            let fronts = Strip::of_block(block, &zoning, &city.config.lots);
            strips.extend(fronts.into_iter().map(|strip| (number, strip)));
        }
        let mut walks = Vec::new();
        for side in &open {
            let walk = network.roads[side / 2].sidewalks[side % 2];
            let path = walk.map_or(&[][..], |walk| &network.sidewalks[walk.index()].path);
            walks.extend(path.windows(2).filter_map(|piece| Some((*side, bounds(piece)?))));
        }
        let closed = sides - &open;
        let mut all = Self { blocks, open, closed, strips, walks, ..Self::empty() };
        all.file();
        all
    }

    fn empty() -> Self {
        Self {
            blocks: Vec::new(),
            open: BTreeSet::new(),
            closed: BTreeSet::new(),
            strips: Vec::new(),
            lots: Cells::default(),
            by_side: BTreeMap::new(),
            walks: Vec::new(),
            walks_near: Cells::default(),
            walks_of: BTreeMap::new(),
        }
    }

    fn file(&mut self) {
        for (number, (_, strip)) in self.strips.iter().enumerate() {
            self.lots.insert(number, strip.lots);
            self.by_side.entry(strip.side).or_default().push(number);
        }
        for (number, (side, piece)) in self.walks.iter().enumerate() {
            self.walks_near.insert(number, *piece);
            self.walks_of.entry(*side).or_default().push(number);
        }
    }

    /// What lies beyond the edge of a strip and those beside it.
    pub(super) fn borders(&self, (block, strip): &(usize, Strip)) -> [Border; 3] {
        let borders = &self.blocks[*block].borders;
        let count = borders.len();
        [count - 1, 0, 1].map(|step| borders[(strip.edge + step) % count])
    }

    /// The strips whose lots may lie in a rectangle.
    pub(super) fn strips_in(&self, around: Bounds) -> impl Iterator<Item = usize> + '_ {
        let near = self.lots.near(around).into_iter();
        near.filter(move |number| meet(self.strips[*number].1.lots, around))
    }

    /// The sides of open faces whose sidewalks may lie in a rectangle.
    pub(super) fn walks_in(&self, around: Bounds) -> impl Iterator<Item = usize> + '_ {
        let near = self.walks_near.near(around).into_iter().map(|number| self.walks[number]);
        near.filter(move |(_, piece)| meet(*piece, around)).map(|(side, _)| side)
    }

    /// Rectangles round the pieces of the sidewalk of a side.
    fn pieces(&self, side: usize) -> impl Iterator<Item = Bounds> + '_ {
        self.walks_of.get(&side).into_iter().flatten().map(|number| self.walks[*number].1)
    }

    /// The strips along some sides.
    pub(super) fn strips_along<'a>(&'a self, sides: &'a BTreeSet<usize>) -> impl Iterator<Item = usize> + 'a {
        sides.iter().filter_map(|side| self.by_side.get(side)).flatten().copied()
    }

    /// Those strips and all that follow from one another, later ones from earlier ones or the other way round.
    pub(super) fn spread(&self, from: impl IntoIterator<Item = usize>, to_later: bool) -> BTreeSet<usize> {
        closure(from, |strip| {
            let near = self.strips_in(self.strips[strip].1.lots);
            near.filter(move |other| *other != strip && (*other > strip) == to_later)
        })
    }

    /// Those sides of open faces and all whose things behind the sidewalk may follow from one another, later ones from earlier ones or the
    /// other way round.
    pub(super) fn spread_walks(&self, from: &BTreeSet<usize>, to_later: bool) -> BTreeSet<usize> {
        closure(from.iter().copied(), |side| {
            let near = self.pieces(side).flat_map(|piece| self.walks_in(inflated(piece, IN_THE_WAY)));
            near.filter(move |other| *other != side && (*other > side) == to_later)
        })
    }

    /// The sides of open faces at which something may be another thing where the lots of some strips are others: along them, and where they
    /// lie behind the sidewalk.
    pub(super) fn sides_at(&self, strips: &BTreeSet<usize>) -> BTreeSet<usize> {
        let strips = strips.iter().map(|number| &self.strips[*number].1);
        strips.flat_map(|strip| self.walks_in(inflated(strip.lots, BEHIND)).chain([strip.side])).collect()
    }

    /// The strips whose lots may lie behind the sidewalks of some sides.
    pub(super) fn strips_at(&self, sides: &BTreeSet<usize>) -> BTreeSet<usize> {
        let pieces = sides.iter().flat_map(|side| self.pieces(*side));
        let behind = pieces.flat_map(|piece| self.strips_in(inflated(piece, BEHIND)));
        behind.chain(self.strips_along(sides)).collect()
    }
}

/// Whether two rectangles meet.
pub(super) fn meet((low, high): Bounds, other: Bounds) -> bool {
    low.x <= other.1.x && other.0.x <= high.x && low.y <= other.1.y && other.0.y <= high.y
}

/// Some things and all that are reached from them.
fn closure<I: Iterator<Item = usize>>(
    from: impl IntoIterator<Item = usize>,
    next: impl Fn(usize) -> I,
) -> BTreeSet<usize> {
    let mut all: BTreeSet<usize> = from.into_iter().collect();
    let mut open: Vec<usize> = all.iter().copied().collect();
    while let Some(one) = open.pop() {
        open.extend(next(one).filter(|other| all.insert(*other)).collect::<Vec<usize>>());
    }
    all
}
