//! Balls in a loose grid: what may touch a volume is found without looking at everything.
//!
//! A ball is filed by its size class and its centre. Cells of a class are wide beside its balls, so a cell far away, or one
//! whose balls are all too small to be seen, is passed over whole. World frame, metres.

use std::collections::BTreeMap;

use simworld_core::geometry::{Point3, Vector3};

/// Largest radius and width of a cell of the least class, m.
const LEAST: (f64, f64) = (1.5, 12.0);
/// From class to class radii grow by this.
const GROWTH: f64 = 4.0;
/// The last class takes balls of any size.
const CLASSES: i32 = 16;

/// A ball in the world.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Ball {
    pub center: Point3,
    pub radius: f64,
}

#[derive(Clone, Debug)]
struct Cell {
    /// West and south border of the cell, and its width.
    corner: [f64; 2],
    width: f64,
    /// Heights that its balls ever reached.
    low: f64,
    high: f64,
    /// The largest ball it ever held.
    largest: f64,
    members: Vec<u32>,
}

/// Balls by the numbers that the caller gives them.
#[derive(Clone, Debug, Default)]
pub(crate) struct Grid {
    numbers: BTreeMap<Key, u32>,
    cells: Vec<Cell>,
    balls: Vec<Ball>,
    /// Cell and position in it; the cell is `u32::MAX` for numbers that are not in.
    homes: Vec<(u32, u32)>,
    /// The cell that was looked up last: instances of one entity are filed one after the other, in one place.
    last: Option<(Key, u32)>,
}

/// Class, and place west to east and south to north in cells of that class.
type Key = (i32, i64, i64);

const NOWHERE: (u32, u32) = (u32::MAX, 0);

impl Grid {
    pub(crate) fn clear(&mut self) {
        *self = Self::default();
    }

    /// The ball of that number.
    pub(crate) fn ball(&self, number: u32) -> &Ball {
        &self.balls[number as usize]
    }

    /// Files a ball, or files it anew after it moved.
    pub(crate) fn place(&mut self, number: u32, ball: Ball) {
        let index = number as usize;
        if index >= self.homes.len() {
            self.homes.resize(index + 1, NOWHERE);
            self.balls.resize(index + 1, ball);
        }
        self.balls[index] = ball;
        let key = key_of(&ball);
        let home = match self.last {
            Some((known, home)) if known == key => home,
            _ => self.home_of(key),
        };
        self.last = Some((key, home));
        if self.homes[index].0 != home {
            self.remove(number);
            let members = &mut self.cells[home as usize].members;
            self.homes[index] = (home, members.len() as u32);
            members.push(number);
        }
        let cell = &mut self.cells[home as usize];
        cell.low = cell.low.min(ball.center.z - ball.radius);
        cell.high = cell.high.max(ball.center.z + ball.radius);
        cell.largest = cell.largest.max(ball.radius);
    }

    /// The cell of a key, a new one if there is none yet.
    fn home_of(&mut self, key: Key) -> u32 {
        *self.numbers.entry(key).or_insert_with(|| {
            let width = LEAST.1 * growth(key.0);
            let corner = [key.1 as f64 * width, key.2 as f64 * width];
            let (low, high) = (f64::INFINITY, f64::NEG_INFINITY);
            self.cells.push(Cell { corner, width, low, high, largest: 0.0, members: Vec::new() });
            self.cells.len() as u32 - 1
        })
    }

    /// Takes a ball out; nothing happens if it is not in.
    pub(crate) fn remove(&mut self, number: u32) {
        let Some(home) = self.homes.get_mut(number as usize) else { return };
        let (cell, position) = std::mem::replace(home, NOWHERE);
        let Some(cell) = self.cells.get_mut(cell as usize) else { return };
        cell.members.swap_remove(position as usize);
        if let Some(moved) = cell.members.get(position as usize) {
            self.homes[*moved as usize].1 = position;
        }
    }

    /// Visits the members of every cell that passes: asked are the ball around everything in it and the largest radius there. The
    /// order depends on what was filed before.
    pub(crate) fn visit(
        &self,
        mut passes: impl FnMut(&Ball, f64) -> bool,
        mut visitor: impl FnMut(u32, &Ball),
    ) {
        for cell in &self.cells {
            if cell.members.is_empty() {
                continue;
            }
            let half = Vector3::new(cell.width * 0.5, cell.width * 0.5, (cell.high - cell.low) * 0.5);
            let center = Point3::new(cell.corner[0] + half.x, cell.corner[1] + half.y, cell.low + half.z);
            let reach = half + Vector3::new(cell.largest, cell.largest, 0.0);
            if passes(&Ball { center, radius: reach.norm() }, cell.largest) {
                for member in &cell.members {
                    visitor(*member, &self.balls[*member as usize]);
                }
            }
        }
    }
}

fn growth(class: i32) -> f64 {
    (0..class).fold(1.0, |factor, _| factor * GROWTH)
}

fn key_of(ball: &Ball) -> Key {
    let mut class = 0;
    while class < CLASSES && ball.radius > LEAST.0 * growth(class) {
        class += 1;
    }
    let width = LEAST.1 * growth(class);
    (class, (ball.center.x / width).floor() as i64, (ball.center.y / width).floor() as i64)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn touching(grid: &Grid, probe: &Ball) -> Vec<u32> {
        let mut found = Vec::new();
        let near = |a: &Ball| (a.center - probe.center).norm() <= a.radius + probe.radius;
        grid.visit(
            |cell, _| near(cell),
            |number, ball| {
                if near(ball) {
                    found.push(number);
                }
            },
        );
        found.sort_unstable();
        found
    }

    proptest! {
        /// Whatever was moved and removed before.
        #[test]
        fn what_touches_is_found(
            balls in prop::collection::vec((-900.0..900.0f64, -900.0..900.0f64, -9.0..90.0f64, 0.1..200.0f64), 1..60),
            moves in prop::collection::vec((0..60usize, -900.0..900.0f64, 0.1..20.0f64, any::<bool>()), 0..60),
            probe in (-900.0..900.0f64, -900.0..900.0f64, 0.1..300.0f64),
        ) {
            let mut grid = Grid::default();
            let ball = |(x, y, z, radius)| Ball { center: Point3::new(x, y, z), radius };
            let mut truth: Vec<Option<Ball>> = balls.into_iter().map(|numbers| Some(ball(numbers))).collect();
            for (number, ball) in (0..).zip(&truth) {
                grid.place(number, ball.expect("it is there at first"));
            }
            for (number, x, radius, stays) in moves {
                let number = number % truth.len();
                truth[number] = stays.then(|| ball((x, -x, 3.0, radius)));
                match truth[number] {
                    Some(ball) => grid.place(number as u32, ball),
                    None => grid.remove(number as u32),
                }
            }
            let probe = ball((probe.0, probe.1, 2.0, probe.2));
            let near = |a: &Ball| (a.center - probe.center).norm() <= a.radius + probe.radius;
            let expected: Vec<u32> =
                (0..).zip(&truth).filter(|(_, ball)| ball.as_ref().is_some_and(near)).map(|(number, _)| number).collect();
            prop_assert_eq!(touching(&grid, &probe), expected);
        }
    }
}
