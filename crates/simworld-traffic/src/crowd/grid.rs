//! Who is near whom: people sorted by cell, rebuilt every step without allocating.

use simworld_core::geometry::Point2;

use super::Person;

/// Cells beside one another in a row that lie together in memory: two to the power of this.
const RUN: u32 = 3;

/// Cells within this many rows and columns are looked through: the width of a cell is this part of the reach.
const RINGS: i64 = 2;

/// A person as the others see it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Seen {
    pub(super) person: Person,
    pub(super) index: u32,
}

/// A hash grid in which the people of a cell are neighbours in memory, and so are the cells of a row.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Grid {
    /// The people of bucket i are `seen[starts[i]..starts[i + 1]]`.
    starts: Vec<u32>,
    seen: Vec<Seen>,
    buckets: Vec<u32>,
    per_metre: f64,
}

impl Grid {
    /// Sorts the people; those of a bucket keep their order, so sums over them do too.
    pub(super) fn rebuild(&mut self, people: impl Iterator<Item = Person> + Clone, reach: f64) {
        self.per_metre = RINGS as f64 / reach;
        let count = people.clone().count();
        let size = (count * 2).next_power_of_two().max(1 << (RUN + 1));
        self.starts.clear();
        self.starts.resize(size + 1, 0);
        self.buckets.clear();
        for person in people.clone() {
            let bucket = bucket(self.cell(person.position.x), self.cell(person.position.y), size);
            self.starts[bucket + 1] += 1;
            self.buckets.push(bucket as u32);
        }
        for index in 1..self.starts.len() {
            self.starts[index] += self.starts[index - 1];
        }
        let nobody = Person::default();
        self.seen.clear();
        self.seen.resize(count, Seen { person: nobody, index: 0 });
        // Filling moves each start to the start of the next bucket; counting them down from the back puts them right.
        for (index, person) in people.enumerate() {
            let start = &mut self.starts[self.buckets[index] as usize];
            self.seen[*start as usize] = Seen { person, index: index as u32 };
            *start += 1;
        }
        self.starts.copy_within(0..size, 1);
        self.starts[0] = 0;
    }

    /// Everybody, those of a cell one after the other.
    pub(super) fn seen(&self) -> &[Seen] {
        &self.seen
    }

    /// The people in the cells around a place, in slices; some may be farther than the reach.
    pub(super) fn around(&self, at: Point2) -> impl Iterator<Item = &[Seen]> {
        let (column, row) = (self.cell(at.x), self.cell(at.y));
        let (first, last) = (column - RINGS, column + RINGS);
        // Where the next run begins, if it does before the last column.
        let next = ((first >> RUN) + 1) << RUN;
        let parts = [(first, last.min(next - 1)), (next, last)];
        let size = self.starts.len() - 1;
        (row - RINGS..=row + RINGS).flat_map(move |row| {
            parts.into_iter().filter(|(first, last)| first <= last).map(move |(first, last)| {
                let begin = bucket(first, row, size);
                let end = begin + (last - first) as usize + 1;
                &self.seen[self.starts[begin] as usize..self.starts[end] as usize]
            })
        })
    }

    fn cell(&self, x: f64) -> i64 {
        (x * self.per_metre).floor() as i64
    }
}

/// Cells that share a bucket only cost time: distances are checked.
fn bucket(column: i64, row: i64, size: usize) -> usize {
    let mixed = ((column >> RUN) as u64).wrapping_mul(0x9E37_79B9_7F4A_7C15)
        ^ (row as u64).wrapping_mul(0xC2B2_AE3D_27D4_EB4F);
    let run = (mixed >> 32) as usize & ((size >> RUN) - 1);
    run << RUN | (column as usize & ((1 << RUN) - 1))
}
