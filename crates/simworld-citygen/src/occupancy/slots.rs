//! The broad phase: which outlines may lie near a box.
//!
//! A uniform grid wrapped round a torus: a cell's slot is its column and row modulo a power of two. The bounds of what
//! lies in a cell stand beside each other in blocks, as single numbers rounded outwards, so that a question reads few
//! lines of memory and looks only at outlines whose bounds it touches.

use simworld_core::geometry::Point2;

/// Width of a grid cell, m: about two houses.
const CELL: f64 = 32.0;
/// No block.
const NONE: u32 = u32::MAX;
/// An outline as large as so many cells, or as long, is not filed.
const MOST_CELLS: f64 = 4096.0;
/// Slots along one side of an empty grid, as a power of two.
const FIRST_BITS: u32 = 5;
/// Slots along one side of the largest grid, as a power of two.
const MOST_BITS: u32 = 14;
/// Outlines in one block.
const ROOM: usize = 4;

/// The least and the greatest corner of a box along the axes.
pub(super) type Bounds = (Point2, Point2);

/// Four outlines of one slot, and the block that goes on. Bounds are in single precision, rounded outwards: what is apart
/// here is apart. They are compared four at a time, so each number stands beside its like.
#[derive(Clone, Copy, Debug)]
struct Block {
    low: [[f32; ROOM]; 2],
    high: [[f32; ROOM]; 2],
    items: [u32; ROOM],
    next: u32,
}

impl Block {
    /// A block without outlines: what is nowhere touches nothing.
    const fn before(next: u32) -> Self {
        let (low, high) = ([[f32::INFINITY; ROOM]; 2], [[f32::NEG_INFINITY; ROOM]; 2]);
        Self { low, high, items: [NONE; ROOM], next }
    }

    /// Which of its outlines are not apart from a box.
    fn touching(&self, low: [f32; 2], high: [f32; 2]) -> [bool; ROOM] {
        let mut touches = [true; ROOM];
        for axis in 0..2 {
            for (place, touches) in touches.iter_mut().enumerate() {
                *touches &= self.low[axis][place] < high[axis];
                *touches &= low[axis] < self.high[axis][place];
            }
        }
        touches
    }
}

/// Bounds in single precision, rounded outwards.
fn rough((low, high): Bounds) -> [[f32; 2]; 2] {
    [
        [low.x, low.y].map(|number| (number as f32).next_down()),
        [high.x, high.y].map(|number| (number as f32).next_up()),
    ]
}

/// Outlines by the cells that their bounds touch.
#[derive(Clone, Debug)]
pub(super) struct Slots {
    /// The first block of each slot.
    heads: Vec<u32>,
    blocks: Vec<Block>,
    /// Outlines too large for the grid.
    large: Vec<u32>,
    filed: usize,
    bits: u32,
}

impl Slots {
    /// Empty, for about so many outlines.
    pub(super) fn with_capacity(outlines: usize) -> Self {
        let bits = bits_for(outlines);
        let (heads, blocks) = (vec![NONE; 1 << (2 * bits)], Vec::with_capacity(outlines / 2));
        Self { heads, blocks, large: Vec::new(), filed: 0, bits }
    }

    /// Whether it has too few slots for so many outlines.
    pub(super) fn is_small_for(&self, outlines: usize) -> bool {
        bits_for(outlines) > self.bits
    }

    /// The number of slots.
    pub(super) fn len(&self) -> usize {
        self.heads.len()
    }

    /// Whether its slots are so full that more of them would be faster.
    pub(super) fn is_full(&self) -> bool {
        self.filed > 2 * self.heads.len() && self.bits < MOST_BITS
    }

    /// Files an outline.
    pub(super) fn file(&mut self, item: u32, bounds: Bounds) {
        let Some(cells) = Cells::of(bounds) else {
            self.large.push(item);
            return;
        };
        let [low, high] = rough(bounds);
        for slot in cells.slots(self.bits) {
            let head = self.heads[slot];
            let is_full = self.blocks.get(head as usize).is_none_or(|block| block.items[ROOM - 1] != NONE);
            if is_full {
                self.heads[slot] = self.blocks.len() as u32;
                self.blocks.push(Block::before(head));
            }
            let block = &mut self.blocks[self.heads[slot] as usize];
            let place = block.items.iter().take_while(|item| **item != NONE).count();
            block.items[place] = item;
            for axis in 0..2 {
                (block.low[axis][place], block.high[axis][place]) = (low[axis], high[axis]);
            }
            self.filed += 1;
        }
    }

    /// Whether a test holds of any outline that may touch a box, of `count` in all; it may be asked of one more than once.
    #[inline]
    pub(super) fn any_near(&self, bounds: Bounds, count: usize, test: impl Fn(u32) -> bool) -> bool {
        if self.large.iter().any(|item| test(*item)) {
            return true;
        }
        let Some(cells) = Cells::of(bounds) else { return (0..count as u32).any(test) };
        let [low, high] = rough(bounds);
        for slot in cells.slots(self.bits) {
            let mut next = self.heads[slot];
            while let Some(block) = self.blocks.get(next as usize) {
                let touching = block.touching(low, high);
                if touching != [false; ROOM]
                    && block.items.iter().zip(touching).any(|(item, touches)| touches && test(*item))
                {
                    return true;
                }
                next = block.next;
            }
        }
        false
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

/// The cells that a rectangle touches.
struct Cells {
    columns: (i64, i64),
    rows: (i64, i64),
}

impl Cells {
    /// `None` if they are too many, or nowhere.
    #[inline]
    fn of((low, high): Bounds) -> Option<Self> {
        let (width, height) = (high.x - low.x, high.y - low.y);
        let is_small = width * height <= MOST_CELLS * CELL * CELL && width.max(height) <= MOST_CELLS * CELL;
        if !is_small {
            return None;
        }
        // The floor, without the call into libm that the oldest processors need.
        let index = |x: f64| {
            let cell = x * (1.0 / CELL);
            let towards_zero = cell as i64;
            towards_zero - i64::from(towards_zero as f64 > cell)
        };
        Some(Self { columns: (index(low.x), index(high.x)), rows: (index(low.y), index(high.y)) })
    }

    /// Their slots in a grid of that size.
    #[inline]
    fn slots(&self, bits: u32) -> impl Iterator<Item = usize> + use<> {
        let mask = (1_i64 << bits) - 1;
        let (columns, rows) = (self.columns, self.rows);
        (rows.0..=rows.1).flat_map(move |row| {
            (columns.0..=columns.1).map(move |column| (((row & mask) << bits) | (column & mask)) as usize)
        })
    }
}

/// The width of the plane after which slots repeat in the smallest grid, m.
#[cfg(test)]
pub(super) fn least_period() -> f64 {
    CELL * f64::from(1 << FIRST_BITS)
}
