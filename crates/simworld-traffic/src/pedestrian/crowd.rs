//! Who is near whom: a hash grid of linked cells, rebuilt every step without allocating.

use simworld_core::geometry::{Point2, direction};
use simworld_core::ops;

const NONE: u32 = u32::MAX;
/// Width of a cell, m: one looks no farther.
const CELL: f64 = 2.0;
/// People nearer than this ahead stop one, m.
const CLOSE: f64 = 0.45;
/// People farther than this ahead do not matter, m.
const FAR: f64 = 1.4;
/// Half the width of the way that one needs, m.
const HALF_WIDTH: f64 = 0.4;

/// What a walker sees of those ahead.
pub(super) struct Ahead {
    /// Share of the free speed that they leave, in [0.1, 1].
    pub(super) freedom: f64,
    /// Whether the nearest comes towards one.
    pub(super) oncoming: bool,
}

#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Crowd {
    people: Vec<(Point2, f64)>,
    heads: Vec<u32>,
    next: Vec<u32>,
}

impl Crowd {
    pub(super) fn rebuild(&mut self, people: impl Iterator<Item = (Point2, f64)>) {
        self.people.clear();
        self.people.extend(people);
        let buckets = (self.people.len() * 2).next_power_of_two().max(16);
        self.heads.clear();
        self.heads.resize(buckets, NONE);
        self.next.clear();
        for (index, (position, _)) in self.people.iter().enumerate() {
            let bucket = bucket(cell(position.x), cell(position.y), buckets);
            self.next.push(self.heads[bucket]);
            self.heads[bucket] = index as u32;
        }
    }

    pub(super) fn ahead_of(&self, me: usize, position: Point2, heading: f64) -> Ahead {
        let forward = direction(heading);
        let mut nearest: Option<(f64, u32)> = None;
        let (column, row) = (cell(position.x), cell(position.y));
        for (dx, dy) in (-1..=1).flat_map(|dx| (-1..=1).map(move |dy| (dx, dy))) {
            let mut index = self.heads[bucket(column + dx, row + dy, self.heads.len())];
            while index != NONE {
                let offset = self.people[index as usize].0 - position;
                let (ahead, aside) = (offset.dot(&forward), forward.perp(&offset));
                let in_the_way = ahead > 0.0 && ahead < FAR && aside.abs() < HALF_WIDTH;
                if in_the_way && index as usize != me && nearest.is_none_or(|best| (ahead, index) < best) {
                    nearest = Some((ahead, index));
                }
                index = self.next[index as usize];
            }
        }
        match nearest {
            None => Ahead { freedom: 1.0, oncoming: false },
            Some((distance, other)) => {
                let opposed = ops::cos(self.people[other as usize].1 - heading) < -0.3;
                let freedom = ((distance - CLOSE) / (FAR - CLOSE)).clamp(0.1, 1.0);
                Ahead { freedom: if opposed { freedom.max(0.5) } else { freedom }, oncoming: opposed }
            }
        }
    }
}

fn cell(x: f64) -> i64 {
    (x / CELL).floor() as i64
}

/// Cells that share a bucket only cost time: distances are checked.
fn bucket(column: i64, row: i64, buckets: usize) -> usize {
    let mixed = (column as u64).wrapping_mul(0x9E37_79B9_7F4A_7C15)
        ^ (row as u64).wrapping_mul(0xC2B2_AE3D_27D4_EB4F);
    (mixed >> 32) as usize & (buckets - 1)
}
