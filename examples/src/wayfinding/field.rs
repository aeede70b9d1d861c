//! Where somebody has to find the way: a square of a generated city, laid out in cells.

use std::collections::VecDeque;
use std::ops::ControlFlow;

use simworld_citygen::{City, CityConfig};
use simworld_core::geometry::{Aabb, Point2, Point3, Vector2};
use simworld_core::scene::{Scene, World};
use simworld_core::seed::Seed;

use super::WayfindingError;

/// Cells along a side.
pub(super) const SIDE: usize = 16;
/// Side of a cell, m.
pub(super) const CELL: f64 = 2.5;
/// Room that a body wants around it, m.
const ROOM: f64 = 0.4;
/// Buildings that are looked at for a place to go to.
const CANDIDATES: usize = 60;
/// The share of cells from which the place must be within reach.
const REACHABLE: f64 = 0.35;

/// A square around a building whose door is to be found.
pub struct Field {
    city: City,
    /// Its south-west corner.
    origin: Point2,
    goal: Point2,
    /// The cells from which the door can be reached.
    starts: Vec<usize>,
    /// How many cells something stands in.
    blocked: usize,
}

impl Field {
    /// The square with most in the way, among those around the buildings of a small city, whose door is still within reach
    /// from a third of it.
    ///
    /// # Errors
    /// The city cannot be made, or has no such square.
    pub fn new(seed: Seed) -> Result<Self, WayfindingError> {
        let city = City::generate(&CityConfig::with_roads(12), seed)?;
        let mut world = World::new();
        city.populate(&mut world)?;
        let mut best: Option<(Point2, Point2, Vec<usize>, usize)> = None;
        for building in city.buildings.iter().take(CANDIDATES) {
            let origin = building.center - Vector2::repeat(SIDE as f64 * CELL * 0.5);
            let free: Vec<bool> =
                (0..SIDE * SIDE).map(|cell| is_free(&world, middle(origin, cell))).collect();
            let blocked = free.iter().filter(|free| !**free).count();
            let starts = reachable(&free, origin, building.access);
            let is_enough = starts.len() as f64 >= REACHABLE * free.len() as f64;
            if is_enough && best.as_ref().is_none_or(|best| blocked > best.3) {
                best = Some((origin, building.access, starts, blocked));
            }
        }
        let (origin, goal, starts, blocked) = best.ok_or(WayfindingError::NoField)?;
        Ok(Self { city, origin, goal, starts, blocked })
    }

    /// The city around.
    pub fn city(&self) -> &City {
        &self.city
    }

    /// The place to be found.
    pub fn goal(&self) -> Point2 {
        self.goal
    }

    /// How many cells one can begin in.
    pub fn starts(&self) -> &[usize] {
        &self.starts
    }

    /// How many cells something stands in.
    pub fn blocked(&self) -> usize {
        self.blocked
    }

    /// The middle of a cell.
    pub(super) fn middle(&self, cell: usize) -> Point2 {
        middle(self.origin, cell)
    }

    /// The cell of a place; of one outside, the nearest.
    pub(super) fn cell(&self, at: Point2) -> usize {
        cell(self.origin, at)
    }

    /// What the table would do, cell by cell, north up: arrows, `#` where nobody can begin, `O` at the door.
    pub fn drawing(&self, heading_of: impl Fn(usize) -> usize) -> String {
        const ARROWS: [char; 8] = ['→', '↗', '↑', '↖', '←', '↙', '↓', '↘'];
        let mut text = String::new();
        for row in (0..SIDE).rev() {
            for column in 0..SIDE {
                let cell = row * SIDE + column;
                text.push(match () {
                    () if cell == self.cell(self.goal) => 'O',
                    () if self.starts.contains(&cell) => ARROWS[heading_of(cell) % ARROWS.len()],
                    () => '#',
                });
                text.push(' ');
            }
            text.push('\n');
        }
        text
    }
}

fn middle(origin: Point2, cell: usize) -> Point2 {
    origin + Vector2::new((cell % SIDE) as f64 + 0.5, (cell / SIDE) as f64 + 0.5) * CELL
}

fn cell(origin: Point2, at: Point2) -> usize {
    let rank = |x: f64| (x / CELL).floor().clamp(0.0, (SIDE - 1) as f64) as usize;
    let from = at - origin;
    rank(from.y) * SIDE + rank(from.x)
}

/// Whether a body has room there.
fn is_free(world: &World, at: Point2) -> bool {
    let mut is_free = true;
    let _ = world.visit(&Aabb::column_around(at, ROOM), &mut |entity| {
        let local = entity.pose.inverse_transform_point(&Point3::new(at.x, at.y, 0.5));
        let half = entity.info.shape.size() * 0.5;
        let is_in = local.x.abs() < half.x + ROOM && local.y.abs() < half.y + ROOM;
        is_free = !(is_in && entity.is_solid());
        if is_free { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
    });
    is_free
}

/// The free cells that hang together with the one of the goal, without it.
fn reachable(free: &[bool], origin: Point2, goal: Point2) -> Vec<usize> {
    let first = cell(origin, goal);
    let mut is_seen = vec![false; free.len()];
    let mut queue = VecDeque::from([first]);
    is_seen[first] = true;
    while let Some(cell) = queue.pop_front() {
        let (row, column) = (cell / SIDE, cell % SIDE);
        let beside = [
            (row > 0).then(|| cell - SIDE),
            (row + 1 < SIDE).then(|| cell + SIDE),
            (column > 0).then(|| cell - 1),
            (column + 1 < SIDE).then(|| cell + 1),
        ];
        for next in beside.into_iter().flatten().filter(|next| free[*next]) {
            if !std::mem::replace(&mut is_seen[next], true) {
                queue.push_back(next);
            }
        }
    }
    (0..free.len()).filter(|cell| is_seen[*cell] && *cell != first).collect()
}
