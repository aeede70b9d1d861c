//! Which segments lie in which squares of the land.
//!
//! Eight by eight squares are a patch, and there are patches where streets came only: most of the land is empty still. Each
//! square has room for seven numbers in place; what it has no room for goes on in blocks of their own. Nothing is ever
//! taken out: a number may be told of a square that its segment has left, so whoever asks looks at the segment.

use std::ops::Range;

use simworld_core::geometry::Point2;
use simworld_core::ops::{greater, lesser};

/// Numbers in one block.
const ROOM: usize = 7;
/// What the last place of a block counts the block that goes on in; what is below is how many numbers stand in it.
const NEXT: u32 = ROOM as u32 + 1;

/// A block: numbers, and behind them how many, and the block that goes on if there is one.
type Block = [u32; ROOM + 1];

/// The numbers in a block.
fn numbers(block: &Block) -> &[u32] {
    &block[..(block[ROOM] % NEXT) as usize]
}

/// The block that goes on from one, or 0 if none does: the first block goes on from no other.
fn next(block: &Block) -> usize {
    (block[ROOM] / NEXT) as usize
}

/// A box along the axes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bounds {
    pub(super) low: Point2,
    pub(super) high: Point2,
}

impl Bounds {
    /// The box round two points, grown by a margin, m.
    pub(super) fn around(a: Point2, b: Point2, margin: f64) -> Self {
        let low = Point2::new(lesser(a.x, b.x) - margin, lesser(a.y, b.y) - margin);
        let high = Point2::new(greater(a.x, b.x) + margin, greater(a.y, b.y) + margin);
        Self { low, high }
    }

    /// Whether the box round two points touches it.
    pub(super) fn touches(&self, a: Point2, b: Point2) -> bool {
        let x = (greater(a.x, b.x) >= self.low.x) & (lesser(a.x, b.x) <= self.high.x);
        let y = (greater(a.y, b.y) >= self.low.y) & (lesser(a.y, b.y) <= self.high.y);
        x & y
    }

    pub(super) fn holds(&self, point: Point2) -> bool {
        self.touches(point, point)
    }
}

/// Where the squares of the land lie.
#[derive(Clone, Copy, Debug)]
struct Grid {
    low: Point2,
    cell: f64,
    per_metre: f64,
    columns: usize,
}

/// Squares of the land and what lies in them.
#[derive(Clone, Debug)]
pub(super) struct Cells {
    grid: Grid,
    /// Patches in a row of them.
    patches_wide: usize,
    /// The first block of each patch; where no street came yet, that of the first one, in which nothing is ever entered.
    patches: Vec<u32>,
    blocks: Vec<Block>,
}

/// A patch is two to this power squares wide.
const PATCH_BITS: usize = 3;
/// Squares in a patch.
const PATCH: usize = 1 << (2 * PATCH_BITS);
/// No number.
const EMPTY: Block = [0; ROOM + 1];

impl Grid {
    fn column(&self, x: f64) -> usize {
        self.index(x - self.low.x)
    }

    fn row(&self, y: f64) -> usize {
        self.index(y - self.low.y)
    }

    /// Beyond the land the outermost squares go on without end.
    fn index(&self, metres: f64) -> usize {
        // The cast cuts fractions off, and takes what is below zero as zero.
        ((metres * self.per_metre) as u32 as usize).min(self.columns - 1)
    }

    /// The columns and rows that a box touches.
    fn squares(&self, bounds: &Bounds) -> [Range<usize>; 2] {
        let columns = self.column(bounds.low.x)..self.column(bounds.high.x) + 1;
        [columns, self.row(bounds.low.y)..self.row(bounds.high.y) + 1]
    }

    /// The columns that a line touches, row by row from its lower end: calls with the row and the first and last column
    /// until it is told to stop.
    fn along(&self, a: Point2, b: Point2, mut visit: impl FnMut(usize, usize, usize) -> bool) {
        let (a, b) = if a.y <= b.y { (a, b) } else { (b, a) };
        let (first, last) = (self.row(a.y), self.row(b.y));
        let slope = (b.x - a.x) / (b.y - a.y);
        let mut x = a.x;
        for row in first..=last {
            let top = self.low.y + (row + 1) as f64 * self.cell;
            // Beyond the outermost row there is no other.
            let next = if row == last { b.x } else { a.x + (top - a.y) * slope };
            // A hair to both sides, far above rounding.
            let (west, east) = (lesser(x, next) - SLACK, greater(x, next) + SLACK);
            if !visit(row, self.column(west), self.column(east)) {
                return;
            }
            x = next;
        }
    }
}

impl Cells {
    /// Empty squares of `cell` m that cover `reach` m to all sides of a point.
    pub(super) fn around(middle: Point2, reach: f64, cell: f64) -> Self {
        let columns = (2.0 * reach / cell).ceil() as usize + 1;
        let low = Point2::new(middle.x - reach, middle.y - reach);
        let patches_wide = (columns >> PATCH_BITS) + 1;
        let patches = vec![0; patches_wide * patches_wide];
        // Room for all: the system hands out the pages of those that are used, no others.
        let mut blocks = Vec::with_capacity((patches.len() + 1) * PATCH);
        blocks.resize(PATCH, EMPTY);
        let grid = Grid { low, cell, per_metre: 1.0 / cell, columns };
        Self { grid, patches_wide, patches, blocks }
    }

    /// The block of a square.
    fn square(&self, row: usize, column: usize) -> &Block {
        &self.blocks[self.patches[self.patch(row, column)] as usize + within_patch(row, column)]
    }

    /// The patch in which a square lies.
    fn patch(&self, row: usize, column: usize) -> usize {
        (row >> PATCH_BITS) * self.patches_wide + (column >> PATCH_BITS)
    }

    /// The number of the block of a square in which something is to be entered: its patch is made if there is none.
    fn square_to_fill(&mut self, row: usize, column: usize) -> usize {
        let patch = self.patch(row, column);
        if self.patches[patch] == 0 {
            self.patches[patch] = self.blocks.len() as u32;
            self.blocks.resize(self.blocks.len() + PATCH, EMPTY);
        }
        self.patches[patch] as usize + within_patch(row, column)
    }

    fn visit_block<'a>(&'a self, mut block: &'a Block, visit: &mut impl FnMut(u32)) {
        loop {
            for number in numbers(block) {
                visit(*number);
            }
            if next(block) == 0 {
                return;
            }
            block = &self.blocks[next(block)];
        }
    }

    /// Whether a test holds of every number in the squares that a line touches; it may be asked of one more than once.
    pub(super) fn all_along(&self, a: Point2, b: Point2, mut test: impl FnMut(u32) -> bool) -> bool {
        let mut holds = true;
        self.grid.along(a, b, |row, first, last| {
            for column in first..=last {
                self.visit_block(self.square(row, column), &mut |number| holds = holds && test(number));
            }
            holds
        });
        holds
    }

    /// Enters a number in the squares that a line touches.
    pub(super) fn file(&mut self, number: u32, a: Point2, b: Point2) {
        let grid = self.grid;
        grid.along(a, b, |row, first, last| {
            for column in first..=last {
                let block = self.square_to_fill(row, column);
                enter(&mut self.blocks, block, number);
            }
            true
        });
    }
}

/// What questions about squares are answered in; kept from one to the next.
#[derive(Clone, Debug)]
pub(super) struct Asked {
    told: Box<[u64; TOLD]>,
    question: u32,
    /// What stands in the squares, as often as it does; behind it what was read along with it.
    found: Vec<u32>,
    /// The blocks in which squares go on; behind them what was written along with them.
    more: Vec<usize>,
}

/// Which numbers were an answer to a question already.
#[derive(Debug)]
pub(super) struct Told<'a> {
    /// For numbers of the same lowest bits, the last one that was told, and the question it was an answer to.
    told: &'a mut [u64; TOLD],
    question: u32,
}

/// A power of two, several times the numbers in one answer.
const TOLD: usize = 256;

impl Default for Asked {
    fn default() -> Self {
        Self { told: Box::new([0; TOLD]), question: 0, found: Vec::new(), more: Vec::new() }
    }
}

impl Told<'_> {
    /// Whether a number was no answer yet; then it is one. One that shares its lowest bits with another may be new twice.
    pub(super) fn is_new(&mut self, number: u32) -> bool {
        let told = &mut self.told[number as usize % TOLD];
        let tells = u64::from(self.question) << 32 | u64::from(number);
        std::mem::replace(told, tells) != tells
    }
}

impl Asked {
    /// The numbers in the squares that a box touches, as often as they stand there, and what tells which are new.
    pub(super) fn ask(&mut self, cells: &Cells, bounds: &Bounds) -> (&[u32], Told<'_>) {
        let found = self.find(cells, bounds);
        self.question = self.question.wrapping_add(1);
        (&self.found[..found], Told { told: &mut self.told, question: self.question })
    }

    /// Puts together what stands in the squares that a box touches, and returns how much it is.
    fn find(&mut self, cells: &Cells, bounds: &Bounds) -> usize {
        let [columns, rows] = cells.grid.squares(bounds);
        let (wide, high) = (columns.len(), rows.len());
        self.make_room((wide * high + 1) * ROOM);
        if self.more.len() < wide * high {
            self.more.resize(wide * high, 0);
        }
        // All squares are read before anything is decided by what is in them: no read waits for another.
        let (mut count, mut unfinished) = (0, 0);
        // In one loop: how many rows and columns there are cannot be foretold.
        let (mut row, mut column) = (rows.start, columns.start);
        for _ in 0..wide * high {
            let square = cells.square(row, column);
            self.found[count..count + ROOM].copy_from_slice(&square[..ROOM]);
            count += numbers(square).len();
            self.more[unfinished] = next(square);
            unfinished += usize::from(next(square) != 0);
            column += 1;
            let is_row_done = column == columns.end;
            column = if is_row_done { columns.start } else { column };
            row += usize::from(is_row_done);
        }
        for place in 0..unfinished {
            count = self.go_on(cells, self.more[place], count);
        }
        count
    }

    /// Goes on with what a square has no room for, from a block on.
    fn go_on(&mut self, cells: &Cells, mut block: usize, mut count: usize) -> usize {
        while block != 0 {
            self.make_room(count + ROOM);
            let more = &cells.blocks[block];
            self.found[count..count + ROOM].copy_from_slice(&more[..ROOM]);
            count += numbers(more).len();
            block = next(more);
        }
        count
    }

    fn make_room(&mut self, room: usize) {
        if self.found.len() < room {
            self.found.resize(room, 0);
        }
    }
}

/// Where a square stands within its patch.
fn within_patch(row: usize, column: usize) -> usize {
    const LAST: usize = (1 << PATCH_BITS) - 1;
    (row & LAST) << PATCH_BITS | column & LAST
}

/// Lines are taken to be wider than they are by so much to both sides, m.
const SLACK: f64 = 1e-3;

/// Enters a number in a block, or in what goes on from it.
fn enter(blocks: &mut Vec<Block>, mut block: usize, number: u32) {
    loop {
        let new = blocks.len() as u32;
        let this = &mut blocks[block];
        let count = numbers(this).len();
        if count < ROOM {
            this[count] = number;
            this[ROOM] += 1;
            return;
        }
        if next(this) == 0 {
            this[ROOM] += NEXT * new;
            blocks.push(EMPTY);
        }
        block = next(&blocks[block]);
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use simworld_core::seed::Seed;

    use super::*;

    #[test]
    fn lines_are_found_wherever_they_go() {
        let mut rng = Seed(1).stream("cells").rng();
        let mut point = || Point2::new(rng.uniform(-130.0, 170.0), rng.uniform(-130.0, 150.0));
        let mut cells = Cells::around(Point2::new(20.0, 10.0), 100.0, 9.0);
        let lines: Vec<_> = (0..600).map(|_| (point(), point())).collect();
        for (number, (a, b)) in (0..).zip(&lines) {
            cells.file(number, *a, *b);
        }
        let mut asked = Asked::default();
        for (number, (a, b)) in (0..).zip(&lines) {
            for share in 0..=50 {
                let on = a + (b - a) * (f64::from(share) / 50.0);
                let (found, _) = asked.ask(&cells, &Bounds::around(on, on, 0.0));
                assert!(found.contains(&number), "{number} at {on}");
            }
        }
        // Lines that cross share a square.
        for (a, b) in &lines {
            let mut found = BTreeSet::new();
            cells.all_along(*a, *b, |number| {
                found.insert(number);
                true
            });
            for (number, (c, d)) in (0..).zip(&lines) {
                let crosses = simworld_core::net::polyline::crossing(*a, *b, *c, *d).is_some();
                assert!(!crosses || found.contains(&number), "{number}");
            }
        }
    }
}
