//! Who is near whom: people sorted by cell, rebuilt every step without allocating.

use std::ops::Range;

use simworld_core::geometry::{Point2, Vector2};
use simworld_core::net::Workers;

use super::Person;
use crate::parts::in_parts;

/// Cells in a row of a tile, and rows of a tile: two to the power of this. The cells of a tile lie together in memory. A window of
/// three cells fits into a tile, so no two of its cells share a bucket even where tiles do.
const TILE: u32 = 3;
/// Cells of a tile.
const CELLS: usize = 1 << (2 * TILE);
/// There are no more buckets than this, so that their numbers leave a byte free: tens of millions of people share them.
const BUCKETS: usize = 1 << 24;
/// Where people are few a cell is so many times as wide as they see: then most see nothing of the cells beside their own.
const WIDER: f64 = 8.0;
/// People for whom as many as this are in their own wide cell, on the whole, are a crowd.
const CROWD: u64 = 12;

/// A person as the others see it: a half of a line of the cache, and not over two of them.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(align(32))]
pub(super) struct Seen {
    /// Where it is, m.
    pub(super) at: [f64; 2],
    /// Where it walks, of length one.
    pub(super) facing: [f32; 2],
    /// m/s.
    pub(super) speed: f32,
    pub(super) index: u32,
}

impl Seen {
    fn of(person: &Person, index: u32) -> Self {
        Self {
            at: [person.position.x, person.position.y],
            facing: [person.direction.x as f32, person.direction.y as f32],
            speed: person.speed as f32,
            index,
        }
    }
}

/// Cells of a tile, one beside the other: their buckets, and once it is open the ranks of those who are found there.
#[derive(Clone, Copy, Debug)]
pub(super) struct Window {
    begin: u32,
    end: u32,
    mark: u8,
}

impl Window {
    /// The ranks of those who are found there; of those in far tiles as well.
    pub(super) fn ranks(&self) -> Range<usize> {
        self.begin as usize..self.end as usize
    }

    /// The [mark](Grid::marks) of those who are there and not in a far tile.
    pub(super) fn mark(&self) -> u8 {
        self.mark
    }
}

/// The cell farthest from the middle.
const FARTHEST: f64 = (1_u64 << 40) as f64;

/// A cell: column and row.
pub(super) type Cell = (i64, i64);

/// A hash grid in which the people of a cell are neighbours in memory, and so are the cells of a tile.
///
/// Those of a crowd lie in its own order. Where people are few they lie in that of their numbers: they were given by place, and
/// nobody has to be moved.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Grid {
    /// The people of bucket i have the ranks from `starts[i]` to `starts[i + 1]`.
    starts: Vec<u32>,
    /// Everybody, by rank in a crowd, else by number.
    seen: Vec<Seen>,
    /// By rank a number of the tile of each of them, by which those of others that share its buckets are told apart without a look at
    /// them.
    marks: Vec<u8>,
    /// The number of the one of each rank.
    numbers: Vec<u32>,
    /// The rank of each in a crowd; before that, and where few are, the bucket, with the mark in the highest byte.
    ranks: Vec<u32>,
    /// How far one sees, m.
    reach: f64,
    /// Cells a metre.
    per_metre: f64,
    /// Whether cells are as wide as one sees, and no wider.
    is_crowd: bool,
}

impl Grid {
    /// Sorts `count` people by place; those of a bucket keep their order.
    ///
    /// Only what needs the order of all is done by one thread: it moves numbers, and looks at nobody.
    pub(super) fn rebuild(
        &mut self,
        workers: &dyn Workers,
        count: usize,
        person: &(impl Fn(usize) -> Person + Sync),
        reach: f64,
    ) {
        self.reach = reach;
        self.seen.resize(count, Seen::default());
        in_parts(workers, &mut self.seen, &|_, first, seen| {
            for (seen, index) in seen.iter_mut().zip(first..) {
                *seen = Seen::of(&person(index), index as u32);
            }
        });
        for (is_crowd, wider) in [(false, WIDER), (true, 1.0)] {
            (self.is_crowd, self.per_metre) = (is_crowd, 1.0 / (reach * wider));
            if self.count(workers) <= CROWD * count as u64 {
                break;
            }
        }
        self.sort();
        if self.is_crowd {
            self.line_up(workers, person);
        }
    }

    /// Finds the bucket of everybody, and how many are in each, two places after its own. Returns the sum over all of how many are in
    /// their own.
    fn count(&mut self, workers: &dyn Workers) -> u64 {
        let Self { starts, seen, ranks, per_metre, is_crowd, .. } = self;
        let cells = if *is_crowd { seen.len() } else { seen.len() / 2 };
        let tiles = cells.div_ceil(CELLS).next_power_of_two().min(BUCKETS / CELLS);
        ranks.resize(seen.len(), 0);
        in_parts(workers, ranks, &|_, first, buckets| {
            for (to, seen) in buckets.iter_mut().zip(&seen[first..]) {
                let cell = cell(Point2::from(seen.at), *per_metre);
                *to = bucket(cell, tiles) as u32 | u32::from(mark_of(cell)) << BUCKETS.ilog2();
            }
        });
        starts.clear();
        starts.resize(tiles * CELLS + 2, 0);
        let mut in_own_bucket = 0;
        for bucket in ranks {
            let count = &mut starts[*bucket as usize % BUCKETS + 2];
            // One more, and one more for each of those before: squares are sums of odd numbers.
            in_own_bucket += 2 * u64::from(*count) + 1;
            *count += 1;
        }
        in_own_bucket
    }

    /// Finds who has each rank, by the buckets of all.
    fn sort(&mut self) {
        let Self { starts, numbers, marks, ranks, .. } = self;
        numbers.resize(ranks.len(), 0);
        marks.resize(ranks.len(), 0);
        let mut sum = 0;
        for start in starts.iter_mut() {
            sum += *start;
            *start = sum;
        }
        // Filling moves each start to that of the next bucket, which is its place.
        for (bucket, number) in ranks.iter().zip(0..) {
            let start = &mut starts[*bucket as usize % BUCKETS + 1];
            numbers[*start as usize] = number;
            marks[*start as usize] = (bucket >> BUCKETS.ilog2()) as u8;
            *start += 1;
        }
    }

    /// Puts those of a crowd in its order.
    fn line_up(&mut self, workers: &dyn Workers, person: &(impl Fn(usize) -> Person + Sync)) {
        let Self { seen, numbers, ranks, .. } = self;
        for (number, rank) in numbers.iter().zip(0..) {
            ranks[*number as usize] = rank;
        }
        in_parts(workers, seen, &|_, first, seen| {
            for (seen, number) in seen.iter_mut().zip(&numbers[first..]) {
                *seen = Seen::of(&person(*number as usize), *number);
            }
        });
    }

    /// Whether so many are together that those of a cell should be taken one after the other: they have the same around them.
    pub(super) fn is_crowd(&self) -> bool {
        self.is_crowd
    }

    /// Everybody: in a crowd those of a cell one after the other, else in the order of their numbers.
    pub(super) fn seen(&self) -> &[Seen] {
        &self.seen
    }

    /// Where the one of this place among them is, m.
    pub(super) fn position(&self, place: usize) -> Point2 {
        Point2::from(self.seen[place].at)
    }

    /// The place among them of the one of a rank.
    pub(super) fn place(&self, rank: usize) -> usize {
        if self.is_crowd { rank } else { self.numbers[rank] as usize }
    }

    /// The place among them of the one of a number.
    pub(super) fn place_of(&self, index: usize) -> usize {
        if self.is_crowd { self.ranks[index] as usize } else { index }
    }

    /// The marks of those of these ranks.
    pub(super) fn marks(&self, ranks: Range<usize>) -> &[u8] {
        &self.marks[ranks]
    }

    /// The cells around a place that one may see from there, or, in a crowd, from anywhere in its cell. Some of them may be out of
    /// reach.
    pub(super) fn around(&self, at: Point2) -> impl Iterator<Item = Window> {
        let tiles = self.starts.len() / CELLS;
        let [low, high] = self.window(at);
        // Where the next tile begins, if it does before the last column.
        let next = ((low.0 >> TILE) + 1) << TILE;
        let parts = [(low.0, high.0.min(next - 1)), (next, high.0)];
        (low.1..=high.1).flat_map(move |row| {
            parts.into_iter().filter(|(first, last)| first <= last).map(move |(first, last)| {
                let begin = bucket((first, row), tiles) as u32;
                Window { begin, end: begin + (last - first) as u32 + 1, mark: mark_of((first, row)) }
            })
        })
    }

    /// Finds out which ranks those of a window have.
    pub(super) fn open(&self, window: &mut Window) {
        window.begin = self.starts[window.begin as usize];
        window.end = self.starts[window.end as usize];
    }

    /// Reads what whoever looks into an open window looks at first: for many one right after the other, so that processors wait for many
    /// such places of the memory at once. The value means nothing.
    pub(super) fn touch(&self, window: &Window) -> u32 {
        let first = window.begin as usize;
        self.numbers.get(first).copied().unwrap_or_default()
            ^ self.marks.get(first).copied().map_or(0, u32::from)
    }

    /// The first and the last of the cells around a place.
    fn window(&self, at: Point2) -> [Cell; 2] {
        if self.is_crowd {
            let (column, row) = cell(at, self.per_metre);
            return [(column - 1, row - 1), (column + 1, row + 1)];
        }
        let reach = Vector2::repeat(self.reach);
        [cell(at - reach, self.per_metre), cell(at + reach, self.per_metre)]
    }

    /// The cell, as wide as one sees, in which a place lies.
    pub(super) fn cell(&self, at: Point2) -> Cell {
        cell(at, self.cells_seen())
    }

    /// The middle of such a cell, m.
    pub(super) fn middle(&self, cell: Cell) -> Point2 {
        Point2::new(cell.0 as f64 + 0.5, cell.1 as f64 + 0.5) / self.cells_seen()
    }

    /// Cells a metre that are as wide as one sees.
    fn cells_seen(&self) -> f64 {
        1.0 / self.reach
    }

    /// Bytes that it takes.
    pub(super) fn bytes(&self) -> usize {
        (self.starts.capacity() + self.numbers.capacity() + self.ranks.capacity()) * 4
            + self.marks.capacity()
            + self.seen.capacity() * size_of::<Seen>()
    }
}

fn cell(at: Point2, per_metre: f64) -> Cell {
    (floor(at.x * per_metre), floor(at.y * per_metre))
}

/// `f64::floor` as an integer; without a call, which the processors of twenty years ago would need.
fn floor(x: f64) -> i64 {
    // Who is beyond the end of the world is at it: there is always a next cell.
    let x = x.clamp(-FARTHEST, FARTHEST);
    let whole = x as i64;
    whole - i64::from((whole as f64) > x)
}

/// The bucket of a cell. Tiles that share their buckets only cost time: distances are checked.
fn bucket((column, row): Cell, tiles: usize) -> usize {
    const MASK: i64 = (1 << TILE) - 1;
    let tile = (mixed((column, row)) >> 32) as usize & (tiles - 1);
    tile * CELLS + ((row & MASK) << TILE | column & MASK) as usize
}

/// The mark of a cell's tile: bits by which tiles do not share buckets.
fn mark_of(cell: Cell) -> u8 {
    (mixed(cell) >> 24) as u8
}

fn mixed((column, row): Cell) -> u64 {
    ((column >> TILE) as u64).wrapping_mul(0x9E37_79B9_7F4A_7C15)
        ^ ((row >> TILE) as u64).wrapping_mul(0xC2B2_AE3D_27D4_EB4F)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use simworld_core::net::Alone;

    use super::*;

    /// How far one sees, m.
    const REACH: f64 = 3.0;

    /// Everybody within reach is found, once, wherever they are and however close together; and where nobody is, hardly anybody.
    fn finds_all(places: &[Point2], is_crowd: bool) {
        let person = |index: usize| Person::standing(places[index], Vector2::x());
        let mut grid = Grid::default();
        grid.rebuild(&Alone, places.len(), &person, REACH);
        assert_eq!(grid.is_crowd(), is_crowd);
        let mut in_vain = 0;
        for at in places {
            let ranks = grid.around(*at).flat_map(|mut window| {
                grid.open(&mut window);
                let here = grid.marks(window.ranks()).iter().map(move |own| *own == window.mark());
                window.ranks().zip(here).filter(|(_, here)| *here)
            });
            let mut found: Vec<u32> = ranks.map(|(rank, _)| grid.seen()[grid.place(rank)].index).collect();
            let looked_at = found.len();
            found.retain(|index| (places[*index as usize] - at).norm() <= REACH);
            in_vain += looked_at - found.len();
            found.sort_unstable();
            let near = |index: &u32| (places[*index as usize] - at).norm() <= REACH;
            let expected: Vec<u32> = (0..places.len() as u32).filter(near).collect();
            assert_eq!(found, expected, "around {at}");
        }
        assert!(is_crowd || in_vain < places.len(), "{in_vain} looked at in vain");
    }

    proptest! {
        #[test]
        fn a_crowd_is_found(places in prop::collection::vec(prop::array::uniform2(-12.0..12.0), 150..400)) {
            let places: Vec<Point2> = places.into_iter().map(Point2::from).collect();
            finds_all(&places, true);
        }

        #[test]
        fn few_are_found(
            places in prop::collection::vec(prop::array::uniform2(-4000.0..4000.0), 2..300),
            beside in prop::array::uniform2(-2.0..2.0),
        ) {
            let alone = places.into_iter().map(Point2::from);
            let places: Vec<Point2> = alone.flat_map(|at| [at, at + Vector2::from(beside)]).collect();
            finds_all(&places, false);
        }
    }
}
