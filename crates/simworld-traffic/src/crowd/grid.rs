//! Who is near whom: people sorted by cell, rebuilt every step without allocating.

use std::ops::Range;

use simworld_core::geometry::Point2;
use simworld_core::net::Workers;

use super::Person;
use crate::parts::in_parts;

/// Cells in a row of a tile, and rows of a tile: two to the power of this. The cells of a tile lie together in memory.
const TILE: u32 = 3;
/// Cells of a tile.
const CELLS: usize = 1 << (2 * TILE);
/// Cells within this many rows and columns are looked through: the width of a cell is this part of the reach. A window of
/// `2 RINGS + 1` fits into a tile, so no two of its cells share a bucket even where tiles do.
const RINGS: i64 = 1;

/// A person as the others see it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
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

/// The cell farthest from the middle.
const FARTHEST: f64 = (1_u64 << 40) as f64;

/// A cell: column and row.
pub(super) type Cell = (i64, i64);

/// A hash grid in which the people of a cell are neighbours in memory, and so are the cells of a tile.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Grid {
    /// The people of bucket i are `seen[starts[i]..starts[i + 1]]`.
    starts: Vec<u32>,
    seen: Vec<Seen>,
    /// Where each of them is found in `seen`; before that, the bucket of each.
    ranks: Vec<u32>,
    per_metre: f64,
}

impl Grid {
    /// Sorts `count` people by place; those of a bucket keep their order, so that sums over them do too.
    ///
    /// Only what needs the order of all is done by one thread: it moves numbers, and looks at nobody.
    pub(super) fn rebuild(
        &mut self,
        workers: &dyn Workers,
        count: usize,
        person: &(impl Fn(usize) -> Person + Sync),
        reach: f64,
    ) {
        self.per_metre = RINGS as f64 / reach;
        let tiles = count.div_ceil(CELLS).next_power_of_two();
        let mut ranks = std::mem::take(&mut self.ranks);
        ranks.resize(count, 0);
        in_parts(workers, &mut ranks, &|_, first, buckets| {
            for (to, index) in buckets.iter_mut().zip(first..) {
                *to = bucket(self.cell(person(index).position), tiles) as u32;
            }
        });
        self.sort(&mut ranks, tiles);
        self.ranks = ranks;
        in_parts(workers, &mut self.seen, &|_, _, seen| {
            for seen in seen {
                *seen = Seen::of(&person(seen.index as usize), seen.index);
            }
        });
    }

    /// Finds the rank of everybody from their bucket, and says who is found at each rank.
    fn sort(&mut self, ranks: &mut [u32], tiles: usize) {
        self.starts.clear();
        self.starts.resize(tiles * CELLS + 1, 0);
        self.seen.resize(ranks.len(), Seen::default());
        for bucket in &*ranks {
            self.starts[*bucket as usize + 1] += 1;
        }
        for index in 1..self.starts.len() {
            self.starts[index] += self.starts[index - 1];
        }
        // Filling moves each start to the start of the next bucket; moving them up by one puts them right.
        for (rank, index) in ranks.iter_mut().zip(0..) {
            let start = &mut self.starts[*rank as usize];
            *rank = *start;
            *start += 1;
            self.seen[*rank as usize].index = index;
        }
        self.starts.copy_within(0..tiles * CELLS, 1);
        self.starts[0] = 0;
    }

    /// Everybody, those of a cell one after the other.
    pub(super) fn seen(&self) -> &[Seen] {
        &self.seen
    }

    /// Where the one of this rank is, m.
    pub(super) fn position(&self, rank: usize) -> Point2 {
        Point2::from(self.seen[rank].at)
    }

    /// Where somebody is found among them.
    pub(super) fn rank(&self, index: usize) -> usize {
        self.ranks[index] as usize
    }

    /// The cells around one, as ranges of [`seen`](Self::seen); some of the people there may be out of reach.
    pub(super) fn around(&self, cell: Cell) -> impl Iterator<Item = Range<usize>> {
        let tiles = self.starts.len() / CELLS;
        let (first, last) = (cell.0 - RINGS, cell.0 + RINGS);
        // Where the next tile begins, if it does before the last column.
        let next = ((first >> TILE) + 1) << TILE;
        let parts = [(first, last.min(next - 1)), (next, last)];
        (cell.1 - RINGS..=cell.1 + RINGS).flat_map(move |row| {
            parts.into_iter().filter(|(first, last)| first <= last).map(move |(first, last)| {
                let begin = bucket((first, row), tiles);
                let end = begin + (last - first) as usize + 1;
                self.starts[begin] as usize..self.starts[end] as usize
            })
        })
    }

    /// Reads what [`around`](Self::around) will of the cells around somebody, and where the first of each row is: processors wait
    /// for many such places of the memory at once. The value means nothing.
    pub(super) fn touch(&self, rank: usize) -> u32 {
        let tiles = self.starts.len() / CELLS;
        let (column, row) = self.cell(self.position(rank));
        (row - RINGS..=row + RINGS).fold(0, |all, row| all ^ self.starts[bucket((column - RINGS, row), tiles)])
    }

    /// The cell of a place.
    pub(super) fn cell(&self, at: Point2) -> Cell {
        (floor(at.x * self.per_metre), floor(at.y * self.per_metre))
    }

    /// Bytes that it takes.
    pub(super) fn bytes(&self) -> usize {
        (self.starts.capacity() + self.ranks.capacity()) * 4
            + self.seen.capacity() * size_of::<Seen>()
    }

    /// The middle of a cell, m.
    pub(super) fn middle(&self, cell: Cell) -> Point2 {
        Point2::new(cell.0 as f64 + 0.5, cell.1 as f64 + 0.5) / self.per_metre
    }
}

/// `f64::floor` as an integer; without a call, which the processors of twenty years ago would need.
fn floor(x: f64) -> i64 {
    // Who is beyond the end of the world is at it: there is always a next cell.
    let x = x.clamp(-FARTHEST, FARTHEST);
    let whole = x as i64;
    whole - i64::from((whole as f64) > x)
}

/// Tiles that share their buckets only cost time: distances are checked.
fn bucket((column, row): Cell, tiles: usize) -> usize {
    const MASK: i64 = (1 << TILE) - 1;
    let mixed = ((column >> TILE) as u64).wrapping_mul(0x9E37_79B9_7F4A_7C15)
        ^ ((row >> TILE) as u64).wrapping_mul(0xC2B2_AE3D_27D4_EB4F);
    let tile = (mixed >> 32) as usize & (tiles - 1);
    tile * CELLS + ((row & MASK) << TILE | column & MASK) as usize
}
