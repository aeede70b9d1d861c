//! The broad phase: which outlines may lie near a box.
//!
//! A uniform grid wrapped round a torus: a cell's slot is its column and row modulo a power of two. The bounds of what
//! lies in a cell stand beside each other in blocks, cut off at the edges of the cell and told in parts of it, a byte each,
//! so that a question reads few lines of memory and looks only at outlines whose bounds it touches.

use simworld_core::geometry::Point2;

use super::{least, most};

/// Width of a part of a cell, as its inverse, 1/m: a power of two, so that no rounding moves anything.
const PARTS_PER_METRE: f64 = 8.0;
/// Parts along one side of a cell. They are counted from one.
const PARTS: i64 = 252;
/// Where what begins in a cell before begins.
const BEFORE: u8 = 0;
/// Where what ends in a cell beyond ends.
const BEYOND: u8 = 253;
/// Where nothing begins.
const NOWHERE: u8 = u8::MAX;
/// Width of a grid cell, m: about two houses.
const CELL: f64 = PARTS as f64 / PARTS_PER_METRE;
/// The cell in the middle, counted from far away, and the most parts of a cell that something lies from it: beyond, all is
/// taken to be there.
const MIDDLE: i64 = 1 << 48;
const FARTHEST: f64 = (1_i64 << 55) as f64;
/// No block, and no outline.
const NONE: u32 = u32::MAX;
/// An outline as large as so many cells, or as long, is not filed.
const MOST_CELLS: f64 = 4096.0;
/// Slots along one side of an empty grid, as a power of two.
const FIRST_BITS: u32 = 5;
/// Slots along one side of the largest grid, as a power of two.
const MOST_BITS: u32 = 14;
/// Outlines in one block.
const ROOM: usize = 7;

/// The least and the greatest corner of a box along the axes.
pub(super) type Bounds = (Point2, Point2);

/// The part of a box that lies in one cell: the parts in which it begins and ends, by axis.
#[derive(Clone, Copy)]
struct Window {
    low: [u8; 2],
    high: [u8; 2],
}

/// Eight bytes, the first one the lowest.
type Lanes = u64;
/// The highest bit of each byte, and a byte for each.
const TOPS: Lanes = 0x80 * EACH;
const EACH: Lanes = 0x0101_0101_0101_0101;

/// Sets the highest bit of each byte that is no less than its like; what the others are says nothing.
#[inline]
const fn no_less(a: Lanes, b: Lanes) -> Lanes {
    // Without their highest bits no byte borrows from the next.
    let rest = (a | TOPS) - (b & !TOPS);
    (a & !b) | (!(a ^ b) & rest)
}

/// Sets the highest bit of each byte that is not zero; what the others are says nothing.
#[inline]
const fn not_zero(a: Lanes) -> Lanes {
    a | ((a & !TOPS) + !TOPS)
}

/// Seven outlines of one slot, and the block that goes on. Bounds are compared all at a time, so each number stands beside
/// its like, a byte of eight; the eighth is nowhere. They stand before all else, for mostly nothing else is read.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
struct Block {
    low: [Lanes; 2],
    high: [Lanes; 2],
    next: u32,
    items: [u32; ROOM],
}

impl Block {
    /// A block with its first outline.
    fn before(next: u32, item: u32, window: Window) -> Self {
        let (low, high) = ([Lanes::from(NOWHERE) * EACH; 2], [Lanes::from(BEFORE) * EACH; 2]);
        let mut block = Self { low, high, next, items: [NONE; ROOM] };
        block.put_at(0, item, window);
        block
    }

    fn is_full(&self) -> bool {
        self.items[ROOM - 1] != NONE
    }

    fn put(&mut self, item: u32, window: Window) {
        // The first that is nowhere, without a branch: how many there are, nothing foretells.
        let nowhere = !not_zero(!self.low[0]) & TOPS;
        self.put_at((nowhere.trailing_zeros() as usize / 8).min(ROOM - 1), item, window);
    }

    /// Puts an outline where there is none.
    #[inline]
    fn put_at(&mut self, place: usize, item: u32, window: Window) {
        self.items[place] = item;
        // What is nowhere begins at the highest number and ends at zero: only what differs from that is set.
        for axis in 0..2 {
            self.low[axis] ^= Lanes::from(window.low[axis] ^ NOWHERE) << (8 * place);
            self.high[axis] |= Lanes::from(window.high[axis]) << (8 * place);
        }
    }

    /// Which of its outlines are not apart from a box, and were not seen in a cell before: where both go on from there,
    /// they were. The highest bit of a byte each, the first one the lowest.
    #[inline]
    fn touching(&self, window: Window) -> u64 {
        let mut touches = TOPS;
        for axis in 0..2 {
            let own = self.low[axis];
            let (low, high) = (Lanes::from(window.low[axis]) * EACH, Lanes::from(window.high[axis]) * EACH);
            touches &= no_less(high, own) & no_less(self.high[axis], low) & not_zero(own | low);
        }
        touches
    }
}

/// Outlines by the cells that their bounds touch.
#[derive(Clone, Debug)]
pub(super) struct Slots {
    /// The first block of each slot.
    heads: Vec<u32>,
    blocks: Vec<Block>,
    /// Outlines too large for the grid.
    large: Vec<u32>,
    /// Slots with a block.
    used: usize,
    bits: u32,
}

impl Slots {
    /// Empty, for about so many outlines.
    pub(super) fn with_capacity(outlines: usize) -> Self {
        let bits = bits_for(outlines);
        // Half a block for each outline is too few for many tiles.
        let (heads, blocks) = (vec![NONE; 1 << (2 * bits)], Vec::with_capacity(outlines / 4 * 3));
        Self { heads, blocks, large: Vec::new(), used: 0, bits }
    }

    /// The number of slots.
    pub(super) fn len(&self) -> usize {
        self.heads.len()
    }

    /// Whether so many slots are in use that cells begin to share them: more of them would be faster. Many outlines in few
    /// slots are near each other, and stay so.
    pub(super) fn is_full(&self) -> bool {
        2 * self.used > self.heads.len() && self.bits < MOST_BITS
    }

    /// Files an outline in the cells that it touches, or with those that touch too many.
    pub(super) fn file(&mut self, item: u32, cells: Option<&Cells>) {
        let Some(cells) = cells else {
            self.large.push(item);
            return;
        };
        let Self { heads, blocks, used, .. } = self;
        cells.any(self.bits, |slot, window| {
            let head = &mut heads[slot];
            match blocks.get_mut(*head as usize) {
                Some(block) if !block.is_full() => block.put(item, window),
                _ => {
                    *used += usize::from(*head == NONE);
                    blocks.push(Block::before(*head, item, window));
                    *head = blocks.len() as u32 - 1;
                }
            }
            false
        });
    }

    /// Whether a test holds of any outline that may touch a box in some cells, of all there are if they are too many.
    #[inline]
    pub(super) fn any_near<A: Iterator<Item = u32>>(
        &self,
        cells: Option<&Cells>,
        all: impl FnOnce() -> A,
        test: impl Fn(u32) -> bool,
    ) -> bool {
        if self.large.iter().any(|item| test(*item)) {
            return true;
        }
        let Some(cells) = cells else { return all().any(test) };
        cells.any(self.bits, |slot, window| {
            let mut next = self.heads[slot];
            while let Some(block) = self.blocks.get(next as usize) {
                let mut touching = block.touching(window);
                while touching != 0 {
                    let place = touching.trailing_zeros() as usize / 8;
                    if block.items.get(place).is_some_and(|item| test(*item)) {
                        return true;
                    }
                    touching &= touching - 1;
                }
                next = block.next;
            }
            false
        })
    }
}

/// Slots along one side for so many outlines, as a power of two.
fn bits_for(outlines: usize) -> u32 {
    let mut bits = FIRST_BITS;
    while bits < MOST_BITS && 1_usize << (2 * bits) < outlines {
        bits += 1;
    }
    bits
}

/// A place along one axis: the cell, and the part of it.
#[derive(Clone, Copy)]
struct Place {
    /// Counted from far away: nothing is negative.
    cell: u64,
    part: u8,
}

impl Place {
    #[inline]
    fn of(x: f64) -> Self {
        // The floor, without the call into libm that the oldest processors need.
        let parts = least(most(x * PARTS_PER_METRE, -FARTHEST), FARTHEST);
        let towards_zero = parts as i64;
        let floor = towards_zero - i64::from(towards_zero as f64 > parts);
        // What is not negative is divided sooner.
        let counted = (floor + MIDDLE * PARTS) as u64;
        let (cell, part) = (counted / PARTS as u64, counted % PARTS as u64);
        Self { cell, part: part as u8 + 1 }
    }
}

/// The cells that a rectangle touches: the places where it begins and ends, by axis.
pub(super) struct Cells {
    columns: (Place, Place),
    rows: (Place, Place),
}

impl Cells {
    /// `None` if they are too many, or nowhere.
    #[inline]
    pub(super) fn of((low, high): Bounds) -> Option<Self> {
        let (width, height) = (high.x - low.x, high.y - low.y);
        let is_small = width * height <= MOST_CELLS * CELL * CELL && width.max(height) <= MOST_CELLS * CELL;
        is_small.then(|| Self {
            columns: (Place::of(low.x), Place::of(high.x)),
            rows: (Place::of(low.y), Place::of(high.y)),
        })
    }

    /// Whether something holds of the slot of any cell, in a grid of that size, and of what of the rectangle lies in it.
    #[inline]
    fn any(&self, bits: u32, mut holds: impl FnMut(usize, Window) -> bool) -> bool {
        let mask = (1_u64 << bits) - 1;
        let clipped = |(low, high): (Place, Place), cell: u64| {
            let low = if cell == low.cell { low.part } else { BEFORE };
            (low, if cell == high.cell { high.part } else { BEYOND })
        };
        // Up to the one beyond the last: a range that holds its end is walked through more slowly.
        let beyond = [self.rows.1.cell + 1, self.columns.1.cell + 1];
        for row in self.rows.0.cell..beyond[0] {
            let (low_y, high_y) = clipped(self.rows, row);
            let first = (row & mask) << bits;
            for column in self.columns.0.cell..beyond[1] {
                let (low_x, high_x) = clipped(self.columns, column);
                let window = Window { low: [low_x, low_y], high: [high_x, high_y] };
                if holds((first | (column & mask)) as usize, window) {
                    return true;
                }
            }
        }
        false
    }
}

/// The width of the plane after which slots repeat in the smallest grid, m.
#[cfg(test)]
pub(super) fn least_period() -> f64 {
    CELL * f64::from(1 << FIRST_BITS)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bytes_are_compared_each_by_itself() {
        for (a, b) in (0..=u8::MAX).flat_map(|a| (0..=u8::MAX).map(move |b| (a, b))) {
            let mixed =
                |even: u8, odd: u8| Lanes::from_le_bytes([even, odd, even, odd, even, odd, even, odd]);
            let tops = |even: bool, odd: bool| mixed(u8::from(even) << 7, u8::from(odd) << 7);
            assert_eq!(no_less(mixed(a, b), mixed(b, a)) & TOPS, tops(a >= b, b >= a), "{a} and {b}");
            assert_eq!(not_zero(mixed(a, b)) & TOPS, tops(a != 0, b != 0), "{a} and {b}");
        }
    }
}
