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
/// Where people are few a cell is so many times as wide as they see: then most see nothing of the cells beside their own.
const WIDER: f64 = 8.0;
/// People for whom as many as this are in their own wide cell, on the whole, are a crowd.
const CROWD: u64 = 12;

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
    /// A number of the tile of each of them, by which those of others that share its buckets are told apart without a look at them.
    marks: Vec<u8>,
    /// Where each of them is found in `seen`; before that, the bucket of each.
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
        let mut ranks = std::mem::take(&mut self.ranks);
        ranks.resize(count, 0);
        for (is_crowd, wider) in [(false, WIDER), (true, 1.0)] {
            (self.is_crowd, self.per_metre) = (is_crowd, 1.0 / (reach * wider));
            self.count(workers, &mut ranks, person);
            let in_own_cell: u64 = self.starts.iter().map(|count| u64::from(*count).pow(2)).sum();
            if in_own_cell <= CROWD * count as u64 {
                break;
            }
        }
        self.sort(&mut ranks);
        self.ranks = ranks;
        in_parts(workers, &mut self.seen, &|_, _, seen| {
            for seen in seen {
                *seen = Seen::of(&person(seen.index as usize), seen.index);
            }
        });
        let mut marks = std::mem::take(&mut self.marks);
        marks.resize(count, 0);
        in_parts(workers, &mut marks, &|_, first, marks| {
            for (mark, rank) in marks.iter_mut().zip(first..) {
                *mark = mark_of(cell(self.position(rank), self.per_metre));
            }
        });
        self.marks = marks;
    }

    /// Finds the bucket of everybody, and how many are in each, a place after its own.
    fn count(
        &mut self,
        workers: &dyn Workers,
        buckets: &mut [u32],
        person: &(impl Fn(usize) -> Person + Sync),
    ) {
        let (tiles, per_metre) = (buckets.len().div_ceil(CELLS).next_power_of_two(), self.per_metre);
        in_parts(workers, buckets, &|_, first, buckets| {
            for (to, index) in buckets.iter_mut().zip(first..) {
                *to = bucket(cell(person(index).position, per_metre), tiles) as u32;
            }
        });
        self.starts.clear();
        self.starts.resize(tiles * CELLS + 1, 0);
        for bucket in buckets {
            self.starts[*bucket as usize + 1] += 1;
        }
    }

    /// Finds the rank of everybody from their bucket, and says who is found at each rank.
    fn sort(&mut self, ranks: &mut [u32]) {
        self.seen.resize(ranks.len(), Seen::default());
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
        let buckets = self.starts.len() - 1;
        self.starts.copy_within(0..buckets, 1);
        self.starts[0] = 0;
    }

    /// Whether so many are together that those of a cell should be taken one after the other: they have the same around them.
    pub(super) fn is_crowd(&self) -> bool {
        self.is_crowd
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

    /// The marks of those of these ranks.
    pub(super) fn marks(&self, ranks: Range<usize>) -> &[u8] {
        &self.marks[ranks]
    }

    /// The cells around a place that one may see from there, or, in a crowd, from anywhere in its cell: ranges of
    /// [`seen`](Self::seen), with the [mark](Self::marks) of those who are there and not in a far tile. Some of them may be out of reach.
    pub(super) fn around(&self, at: Point2) -> impl Iterator<Item = (Range<usize>, u8)> {
        let tiles = self.starts.len() / CELLS;
        let [low, high] = self.window(at);
        // Where the next tile begins, if it does before the last column.
        let next = ((low.0 >> TILE) + 1) << TILE;
        let parts = [(low.0, high.0.min(next - 1)), (next, high.0)];
        (low.1..=high.1).flat_map(move |row| {
            parts.into_iter().filter(|(first, last)| first <= last).map(move |(first, last)| {
                let begin = bucket((first, row), tiles);
                let end = begin + (last - first) as usize + 1;
                (self.starts[begin] as usize..self.starts[end] as usize, mark_of((first, row)))
            })
        })
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

    /// Reads what [`around`](Self::around) will of the cells around a place: for many one right after the other, so that processors
    /// wait for many such places of the memory at once. The value means nothing.
    pub(super) fn touch(&self, at: Point2) -> u32 {
        let tiles = self.starts.len() / CELLS;
        let [low, high] = self.window(at);
        (low.1..=high.1).fold(0, |all, row| all ^ self.starts[bucket((low.0, row), tiles)])
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
        (self.starts.capacity() + self.ranks.capacity()) * 4
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
            let ranks = grid.around(*at).flat_map(|(ranks, mark)| {
                let here = grid.marks(ranks.clone()).iter().map(move |own| *own == mark);
                ranks.zip(here).filter(|(_, here)| *here)
            });
            let mut found: Vec<u32> = ranks.map(|(rank, _)| grid.seen()[rank].index).collect();
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
