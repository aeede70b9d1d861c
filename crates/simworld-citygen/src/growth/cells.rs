//! Which segments lie in which squares of the land.
//!
//! The squares lie in rows, each with room for seven numbers in place, so that a question reads memory in order; what a
//! square has no room for goes on in blocks behind the last square. Nothing is ever taken out: a number may be told of a
//! square that its segment has left, so whoever asks looks at the segment.

use std::ops::RangeInclusive;

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

/// The block that goes on from one, or 0 if none does: the first square goes on from no other.
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

/// Squares of the land and what lies in them.
#[derive(Clone, Debug)]
pub(super) struct Cells {
    low: Point2,
    cell: f64,
    per_metre: f64,
    columns: usize,
    blocks: Vec<Block>,
}

impl Cells {
    /// Empty squares of `cell` m that cover `reach` m to all sides of a point.
    pub(super) fn around(middle: Point2, reach: f64, cell: f64) -> Self {
        let columns = (2.0 * reach / cell).ceil() as usize + 1;
        let low = Point2::new(middle.x - reach, middle.y - reach);
        // Zeros: the system hands out the pages of land where streets come, no others.
        let blocks = vec![[0; ROOM + 1]; columns * columns];
        Self { low, cell, per_metre: 1.0 / cell, columns, blocks }
    }

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
    fn squares(&self, bounds: &Bounds) -> [RangeInclusive<usize>; 2] {
        let columns = self.column(bounds.low.x)..=self.column(bounds.high.x);
        [columns, self.row(bounds.low.y)..=self.row(bounds.high.y)]
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

    /// Whether a test holds of every number in the squares that a line touches; it may be asked of one more than once.
    pub(super) fn all_along(&self, a: Point2, b: Point2, mut test: impl FnMut(u32) -> bool) -> bool {
        let mut holds = true;
        self.along(a, b, |row, first, last| {
            let start = row * self.columns;
            for block in &self.blocks[start + first..=start + last] {
                self.visit_block(block, &mut |number| holds = holds && test(number));
            }
            holds
        });
        holds
    }

    /// Enters a number in the squares that a line touches.
    pub(super) fn file(&mut self, number: u32, a: Point2, b: Point2) {
        // The blocks are taken out, so that rows can be walked while they grow.
        let mut blocks = std::mem::take(&mut self.blocks);
        self.along(a, b, |row, first, last| {
            let start = row * self.columns;
            (start + first..=start + last).for_each(|cell| enter(&mut blocks, cell, number));
            true
        });
        self.blocks = blocks;
    }
}

/// The numbers that were an answer to a question.
#[derive(Clone, Debug)]
pub(super) struct Asked {
    /// For numbers of the same lowest bits, the last one that was told, and the question it was an answer to.
    told: Vec<u64>,
    question: u32,
    /// What stands in the squares, as often as it does; behind it what was read along with it.
    found: Vec<u32>,
    numbers: Vec<u32>,
}

/// A power of two, several times the numbers in one answer.
const TOLD: usize = 256;

impl Default for Asked {
    fn default() -> Self {
        Self { told: vec![0; TOLD], question: 0, found: Vec::new(), numbers: Vec::new() }
    }
}

impl Asked {
    /// The numbers in the squares that a box touches. One that shares its lowest bits with another may be told twice.
    pub(super) fn ask(&mut self, cells: &Cells, bounds: &Bounds) -> &[u32] {
        let found = self.find(cells, bounds);
        if self.numbers.len() < found {
            self.numbers.resize(found, 0);
        }
        self.question = self.question.wrapping_add(1);
        let question = u64::from(self.question) << 32;
        let mut count = 0;
        for number in &self.found[..found] {
            // Whether it is new decides nothing but where the next one is written.
            self.numbers[count] = *number;
            let told = &mut self.told[*number as usize % TOLD];
            let tells = question | u64::from(*number);
            count += usize::from(*told != tells);
            *told = tells;
        }
        &self.numbers[..count]
    }

    /// Puts together what stands in the squares that a box touches, and returns how much it is.
    fn find(&mut self, cells: &Cells, bounds: &Bounds) -> usize {
        let [columns, rows] = cells.squares(bounds);
        let (wide, high) = (columns.end() + 1 - columns.start(), rows.end() + 1 - rows.start());
        if self.found.len() < (wide * high + 1) * ROOM {
            self.found.resize((wide * high + 1) * ROOM, 0);
        }
        // All squares are read before anything is decided by what is in them: no read waits for another.
        let (mut count, mut more) = (0, 0);
        for row in rows.clone() {
            let start = row * cells.columns + columns.start();
            for square in &cells.blocks[start..start + wide] {
                self.found[count..count + ROOM].copy_from_slice(&square[..ROOM]);
                count += numbers(square).len();
                more |= next(square);
            }
        }
        if more == 0 { count } else { self.find_more(cells, [columns, rows], count) }
    }

    /// Goes on with what the squares have no room for.
    fn find_more(
        &mut self,
        cells: &Cells,
        [columns, rows]: [RangeInclusive<usize>; 2],
        mut count: usize,
    ) -> usize {
        for row in rows {
            let row = row * cells.columns;
            for square in &cells.blocks[row + columns.start()..=row + columns.end()] {
                let mut block = square;
                while next(block) != 0 {
                    block = &cells.blocks[next(block)];
                    self.found.truncate(count);
                    self.found.extend_from_slice(numbers(block));
                    count = self.found.len();
                }
            }
        }
        count
    }
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
            blocks.push([0; ROOM + 1]);
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
                let found = asked.ask(&cells, &Bounds::around(on, on, 0.0));
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
