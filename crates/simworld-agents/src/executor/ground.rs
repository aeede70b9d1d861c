//! Ways over open ground, where no walkway leads: round houses, out of courtyards, past what stands on a lawn.
//!
//! The ground is looked at in square cells. A search goes from cell to free cell until it comes to one of the places that
//! are looked for; carriageways cost more than other ground. The cells passed become the few points between which one
//! walks straight.

use std::cmp::Reverse;
use std::collections::BinaryHeap;
use std::ops::ControlFlow;

use simworld_core::geometry::{Aabb, Point2, Vector2};
use simworld_core::scene::{EntityKind, EntityRef, Scene};

/// Width of a cell where the ground is small, m.
const CELL: f64 = 0.4;
/// Cells each way at most: on larger ground they are wider.
const MOST_CELLS: f64 = 800.0;
/// How far beyond the two places one looks for a way round, m: first near by, then round whole rows of houses.
pub(super) const MARGINS: [f64; 2] = [40.0, 160.0];
/// Places farther apart than this have walkways between them, m.
const FARTHEST: f64 = 400.0;
/// Gap kept to whatever is solid, m: more than the 0.02 m of bodies under physics.
const GAP: f64 = 0.05;
/// Houses and whatever is longer than this are walls; other things are walked round as one comes to them, m.
const WALL: f64 = 10.0;
/// What ends lower above one's feet is stepped over, m.
const SILL: f64 = 0.25;
/// Who is faster than this will be elsewhere, m/s.
const MOVES: f64 = 0.1;
/// Costs of a step to a neighbouring cell, straight and aslant, and how many times as much it costs on a carriageway.
const STRAIGHT: u32 = 10;
const ASLANT: u32 = 14;
const ROAD: u32 = 4;
/// Nobody walks where it is steeper, rise over run: 40°, a little less than what bodies climb.
const STEEPEST: f64 = 0.84;
/// A place in a wall is looked for so far beside it, m.
const BESIDE: f64 = 1.5;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Cell {
    Free,
    Road,
    Solid,
}

/// The ground round two places.
pub(super) struct Ground {
    low: Point2,
    cell: f64,
    columns: usize,
    rows: usize,
    cells: Vec<Cell>,
}

/// Half the width that a body needs, m.
fn reach_of(me: &EntityRef<'_>) -> f64 {
    let size = me.info.shape.size();
    size.x.min(size.y) * 0.5 + GAP
}

/// Whether a thing stands where somebody would walk, now and for a while.
fn stands(me: &EntityRef<'_>, other: &EntityRef<'_>) -> bool {
    let feet = me.bounds.min.z;
    other.id != me.id
        && other.attachment.is_none()
        && other.is_solid()
        && !(other.kind.is_mobile() && other.twist.ground_speed() > MOVES)
        && other.bounds.max.z > feet + SILL
        && other.bounds.min.z < me.bounds.max.z
}

/// Whether nobody can walk at a place, whatever stands there: in the water, on a cliff, beyond the edge of the land.
fn is_impassable(scene: &dyn Scene, at: Point2) -> bool {
    scene.ground().is_some_and(|land| !land.holds(at) || land.is_wet(at) || land.slope(at) > STEEPEST)
}

/// Whether a wall or water lies on the straight way between two places.
pub(super) fn is_blocked(scene: &dyn Scene, me: &EntityRef<'_>, from: Point2, to: Point2) -> bool {
    let (reach, way) = (reach_of(me), to - from);
    let region = Aabb::column(from.inf(&to), from.sup(&to)).inflated(reach);
    let pieces = (way.norm() / CELL).ceil().max(1.0);
    let along = |piece: u32| from + way * (f64::from(piece) / pieces);
    if scene.ground().is_some() && (0..=pieces as u32).any(|piece| is_impassable(scene, along(piece))) {
        return true;
    }
    let visited = scene.visit(&region, &mut |other| {
        let size = other.info.shape.size();
        let is_wall = other.kind == EntityKind::Building || size.x.max(size.y) > WALL;
        let meets = || {
            (0..=pieces as u32).any(|piece| {
                let at = along(piece);
                other.info.shape.planar_distance(other.pose, &at) < reach
            })
        };
        if is_wall && stands(me, &other) && meets() {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    });
    visited.is_break()
}

impl Ground {
    /// The ground round two places and so many metres beyond; `None` where they are too far apart.
    pub(super) fn between(
        scene: &dyn Scene,
        me: &EntityRef<'_>,
        (a, b): (Point2, Point2),
        margin: f64,
    ) -> Option<Self> {
        if (b - a).norm() > FARTHEST {
            return None;
        }
        let margin = Vector2::repeat(margin);
        let (low, high) = (a.inf(&b) - margin, a.sup(&b) + margin);
        let extent = high - low;
        let cell = CELL.max(extent.max() / MOST_CELLS);
        let count = |length: f64| (length / cell).ceil() as usize + 1;
        let (columns, rows) = (count(extent.x), count(extent.y));
        let mut ground = Self { low, cell, columns, rows, cells: vec![Cell::Free; columns * rows] };
        let reach = reach_of(me);
        let _ = scene.visit(&Aabb::column(low, high), &mut |other| {
            if other.kind == EntityKind::Road {
                ground.mark(&other, 0.0, Cell::Road);
            } else if stands(me, &other) {
                ground.mark(&other, reach, Cell::Solid);
            }
            ControlFlow::Continue(())
        });
        if scene.ground().is_some() {
            for at in 0..ground.cells.len() {
                if is_impassable(scene, ground.middle(at)) {
                    ground.cells[at] = Cell::Solid;
                }
            }
        }
        Some(ground)
    }

    /// Marks the cells within `reach` m of a thing.
    fn mark(&mut self, thing: &EntityRef<'_>, reach: f64, as_what: Cell) {
        let (low, high) = (thing.bounds.min.xy(), thing.bounds.max.xy());
        let index = |x: f64, count: usize| (x / self.cell).clamp(0.0, count as f64 - 1.0) as usize;
        let (from, to) = (low - self.low, high - self.low);
        let columns = index(from.x - reach, self.columns)..=index(to.x + reach + self.cell, self.columns);
        let rows = index(from.y - reach, self.rows)..=index(to.y + reach + self.cell, self.rows);
        for row in rows {
            for column in columns.clone() {
                let at = row * self.columns + column;
                let distance = thing.info.shape.planar_distance(thing.pose, &self.middle(at));
                if self.cells[at] != Cell::Solid && distance <= reach {
                    self.cells[at] = as_what;
                }
            }
        }
    }

    fn middle(&self, at: usize) -> Point2 {
        let (column, row) = (at % self.columns, at / self.columns);
        self.low + Vector2::new(column as f64, row as f64) * self.cell
    }

    fn at(&self, place: Point2) -> Option<usize> {
        let local = (place - self.low) / self.cell;
        let (column, row) = (local.x.round(), local.y.round());
        let is_in = |x: f64, count: usize| (0.0..count as f64).contains(&x);
        (is_in(column, self.columns) && is_in(row, self.rows))
            .then(|| row as usize * self.columns + column as usize)
    }

    /// Whether a place is on this ground.
    pub(super) fn holds(&self, place: Point2) -> bool {
        self.at(place).is_some()
    }

    /// Whether nothing stands at a place.
    pub(super) fn is_free(&self, place: Point2) -> bool {
        self.at(place).is_some_and(|at| self.cells[at] != Cell::Solid)
    }

    /// The cell of a place, or the nearest that is free if something stands there.
    fn free_at(&self, place: Point2) -> Option<usize> {
        let at = self.at(place)?;
        if self.cells[at] != Cell::Solid {
            return Some(at);
        }
        let reach = (BESIDE / self.cell).ceil() as i64;
        let (column, row) = ((at % self.columns) as i64, (at / self.columns) as i64);
        let around = (-reach..=reach).flat_map(|dy| (-reach..=reach).map(move |dx| (column + dx, row + dy)));
        let inside =
            around.filter(|(x, y)| (0..self.columns as i64).contains(x) && (0..self.rows as i64).contains(y));
        let free = inside.map(|(x, y)| y as usize * self.columns + x as usize);
        let free = free.filter(|cell| self.cells[*cell] != Cell::Solid);
        free.min_by(|a, b| {
            let distance = |cell: usize| (self.middle(cell) - place).norm_squared();
            distance(*a).total_cmp(&distance(*b)).then(a.cmp(b))
        })
    }

    /// The neighbours of a cell and what the step to each costs; none aslant past a corner.
    fn steps(&self, at: usize) -> impl Iterator<Item = (usize, u32)> + '_ {
        let (column, row) = ((at % self.columns) as i64, (at / self.columns) as i64);
        let cell = move |dx: i64, dy: i64| {
            let (x, y) = (column + dx, row + dy);
            let is_in = (0..self.columns as i64).contains(&x) && (0..self.rows as i64).contains(&y);
            let at = is_in.then(|| y as usize * self.columns + x as usize)?;
            (self.cells[at] != Cell::Solid).then_some(at)
        };
        let ways = [(1, 0), (0, 1), (-1, 0), (0, -1), (1, 1), (-1, 1), (-1, -1), (1, -1)];
        ways.into_iter().filter_map(move |(dx, dy)| {
            let to = cell(dx, dy)?;
            let length = if dx == 0 || dy == 0 {
                STRAIGHT
            } else {
                cell(dx, 0)?;
                cell(0, dy)?;
                ASLANT
            };
            Some((to, if self.cells[to] == Cell::Road { length * ROAD } else { length }))
        })
    }

    /// The way to whichever of some places is come to first: which, and the points to pass, that place the last. `None` if
    /// there is no way to any of them on this ground.
    pub(super) fn way(&self, from: Point2, places: &[Point2]) -> Option<(usize, Vec<Point2>)> {
        let start = self.free_at(from)?;
        let mut wanted: Vec<(usize, usize)> = places
            .iter()
            .enumerate()
            .filter_map(|(index, place)| Some((self.free_at(*place)?, index)))
            .collect();
        wanted.sort_unstable();
        let mut costs = vec![u32::MAX; self.cells.len()];
        let mut before = vec![usize::MAX; self.cells.len()];
        let mut open = BinaryHeap::from([Reverse((0, start))]);
        costs[start] = 0;
        while let Some(Reverse((cost, at))) = open.pop() {
            if cost > costs[at] {
                continue;
            }
            let found = wanted.partition_point(|(cell, _)| *cell < at);
            if let Some((_, index)) = wanted.get(found).filter(|(cell, _)| *cell == at) {
                return Some((*index, self.points(at, &before, places[*index])));
            }
            for (to, step) in self.steps(at) {
                if cost + step < costs[to] {
                    costs[to] = cost + step;
                    before[to] = at;
                    open.push(Reverse((cost + step, to)));
                }
            }
        }
        None
    }

    /// The points between which one walks straight along the cells to `end`.
    fn points(&self, end: usize, before: &[usize], place: Point2) -> Vec<Point2> {
        let mut cells = vec![end];
        while let Some(previous) = cells.last().map(|at| before[*at]).filter(|at| *at != usize::MAX) {
            cells.push(previous);
        }
        cells.reverse();
        let mut points = Vec::new();
        let mut from = 0;
        while from + 1 < cells.len() {
            let seen = (from + 2..cells.len()).take_while(|to| self.is_straight(&cells[from..=*to])).last();
            from = seen.unwrap_or(from + 1);
            points.push(self.middle(cells[from]));
        }
        // The last cell is the place's own, or the nearest to it.
        points.pop();
        points.push(place);
        points
    }

    /// Whether one may walk straight past the cells of a way: over nothing solid, and over no carriageway that they avoid.
    fn is_straight(&self, cells: &[usize]) -> bool {
        let [first, .., last] = cells else { return true };
        let (from, to) = (self.middle(*first), self.middle(*last));
        let pieces = ((to - from).norm() / (self.cell * 0.5)).ceil().max(1.0);
        let by_road = cells.iter().any(|at| self.cells[*at] == Cell::Road);
        (0..=pieces as u32).all(|piece| {
            let place = from + (to - from) * (f64::from(piece) / pieces);
            self.at(place).is_some_and(|at| match self.cells[at] {
                Cell::Free => true,
                Cell::Road => by_road,
                Cell::Solid => false,
            })
        })
    }
}
