//! What one person sees of the others, worked out in blocks of single precision that processors do several at a time.
//!
//! Places are taken relative to the middle of a cell, so that they are exact to a ten-millionth of a metre wherever the
//! crowd is. Sums are taken in double precision, in which sums of so few single numbers are exact: who is counted first
//! does not matter. Whether bodies touch is worked out in double precision elsewhere.

#![expect(
    clippy::needless_bitwise_bool,
    reason = "a branch less: such tests are made for several people at once"
)]

use std::f32::consts::LOG2_E;

use simworld_core::geometry::{Point2, Vector2};

use super::exp::exp2;
use super::grid::{Cell, Grid};
use super::model::Rules;
use super::{Person, Wish};

/// Distance over which the wish to step back falls to 1/e, m.
const TOUCH: f32 = 0.05;

/// The people in the cells around one cell.
#[derive(Clone, Debug, Default)]
pub(super) struct Around {
    cell: Option<Cell>,
    count: usize,
    /// Places relative to the middle of the cell, m.
    x: Vec<f32>,
    y: Vec<f32>,
    /// Their ranks in the grid.
    ranks: Vec<u32>,
}

impl Around {
    /// Nothing is known of any cell.
    pub(super) fn forget(&mut self) {
        self.cell = None;
    }

    /// Looks around the place of the one of a rank; in a crowd not again for those of one cell, one after the other.
    pub(super) fn look(&mut self, grid: &Grid, at: Point2, rank: usize) {
        let (cell, is_crowd) = (grid.cell(at), grid.is_crowd());
        if is_crowd && self.cell == Some(cell) {
            return;
        }
        // Elsewhere there is seldom anybody else, and whoever looks need not be looked up.
        let is_seen = |other: usize| is_crowd | (other != rank);
        self.cell = Some(cell);
        self.count = 0;
        let middle = grid.middle(cell);
        for (ranks, mark) in grid.around(at) {
            self.make_room(ranks.len());
            for (rank, _) in ranks
                .clone()
                .zip(grid.marks(ranks))
                .filter(|(rank, other)| (**other == mark) & is_seen(*rank))
            {
                let seen = &grid.seen()[rank];
                self.x[self.count] = (seen.at[0] - middle.x) as f32;
                self.y[self.count] = (seen.at[1] - middle.y) as f32;
                self.ranks[self.count] = rank as u32;
                self.count += 1;
            }
        }
    }

    /// Makes room for so many more.
    fn make_room(&mut self, more: usize) {
        let end = self.count + more;
        if end > self.x.len() {
            self.x.resize(2 * end, 0.0);
            self.y.resize(2 * end, 0.0);
            self.ranks.resize(2 * end, 0);
        }
    }
}

/// Somebody who looks around.
#[derive(Clone, Copy, Debug)]
pub(super) struct Me {
    /// Rank in the grid.
    pub(super) rank: usize,
    pub(super) person: Person,
    pub(super) wish: Wish,
}

/// Those who matter to somebody, in blocks.
#[derive(Clone, Debug, Default)]
pub(super) struct Nearby {
    matter: Vec<u32>,
    chosen: Vec<u32>,
    /// Offsets, m.
    x: Vec<f32>,
    y: Vec<f32>,
    /// Distance, m; infinite for who is out of view.
    distance: Vec<f32>,
    facing: [Vec<f32>; 2],
    speed: Vec<f32>,
    aside: Vec<f32>,
    /// Ranks of those who could be run into before the next decision, wherever they are.
    pub(super) close: Vec<u32>,
}

/// A pair of single numbers.
type Pair = [f32; 2];

fn single(vector: Vector2) -> Pair {
    [vector.x as f32, vector.y as f32]
}

impl Nearby {
    /// With room for so many who matter, half of them close.
    pub(super) fn roomy(count: usize) -> Self {
        let room = || Vec::with_capacity(count);
        let (x, y, distance, speed, aside) = (room(), room(), room(), room(), room());
        let facing = [room(), room()];
        Self { x, y, distance, facing, speed, aside, close: Vec::with_capacity(count / 2), ..Self::default() }
    }

    /// Finds who matters to somebody: who is within reach and in view, or so close that one could run into them.
    pub(super) fn find(&mut self, rules: &Rules, grid: &Grid, around: &Around, me: &Me) {
        let middle = around.cell.map_or(me.person.position, |cell| grid.middle(cell));
        let [own_x, own_y] = single(me.person.position - middle);
        let (wish, ahead) = (single(me.wish.direction), single(me.person.direction));
        let close = rules.close(me.wish.speed) as f32;
        let (reach, near) = ((rules.reach * rules.reach) as f32, close * close);
        let count = around.count;
        if self.matter.len() < count {
            self.matter.resize(2 * count, 0);
            self.chosen.resize(2 * count, 0);
        }
        let places = around.x[..count].iter().zip(&around.y[..count]);
        for (matters, (x, y)) in self.matter[..count].iter_mut().zip(places) {
            let (x, y) = (x - own_x, y - own_y);
            let square = x * x + y * y;
            let in_view = (wish[0] * x + wish[1] * y >= 0.0) | (ahead[0] * x + ahead[1] * y >= 0.0);
            *matters = u32::from(((square <= reach) & in_view) | (square <= near));
        }
        let mut chosen = 0;
        let ranks = &around.ranks[..count];
        for ((matters, rank), place) in self.matter[..count].iter().zip(ranks).zip(0..) {
            self.chosen[chosen] = place;
            chosen += (*matters & u32::from(*rank != me.rank as u32)) as usize;
        }
        self.take(grid, around, chosen, [own_x, own_y], near);
        if !grid.is_crowd() {
            // In the order in which those of a crowd are found: whom one heeds first makes a difference.
            self.close.sort_unstable_by_key(|rank| {
                let (column, row) = grid.cell(grid.position(*rank as usize));
                (row, column, *rank)
            });
        }
    }

    fn take(&mut self, grid: &Grid, around: &Around, count: usize, own: Pair, near: f32) {
        let [facing_x, facing_y] = &mut self.facing;
        for field in [&mut self.x, &mut self.y, facing_x, facing_y, &mut self.speed] {
            field.resize(count, 0.0);
        }
        let fields = self.x.iter_mut().zip(&mut self.y).zip(facing_x).zip(facing_y).zip(&mut self.speed);
        self.close.clear();
        for (((((to_x, to_y), facing_x), facing_y), speed), place) in fields.zip(&self.chosen) {
            let place = *place as usize;
            let rank = around.ranks[place];
            let seen = &grid.seen()[rank as usize];
            let (x, y) = (around.x[place] - own[0], around.y[place] - own[1]);
            if x * x + y * y <= near {
                self.close.push(rank);
            }
            (*to_x, *to_y) = (x, y);
            [*facing_x, *facing_y] = seen.facing;
            *speed = seen.speed;
        }
    }

    /// How strongly those in view turn one aside, to the left of one's wish; negative is to the right. Takes note of who is
    /// in view, before all else.
    pub(super) fn aside(&mut self, rules: &Rules, me: &Me) -> f64 {
        let model = &rules.model;
        let wish = single(me.wish.direction);
        let wanted = single(me.wish.direction * me.wish.speed);
        let moving = single(me.person.direction * me.person.speed);
        let anticipation = model.anticipation as f32;
        let (contact, wide) = (rules.contact as f32, rules.wide as f32);
        let (strength, slope) = (model.strength as f32, -LOG2_E / model.range as f32);
        let ahead = single(me.person.direction);
        let count = self.x.len();
        self.aside.resize(count, 0.0);
        self.distance.resize(count, 0.0);
        let (x, y, distances) = (&self.x[..count], &self.y[..count], &mut self.distance[..count]);
        let (facing_x, facing_y) = (&self.facing[0][..count], &self.facing[1][..count]);
        let speed = &self.speed[..count];
        for (to, aside) in self.aside[..count].iter_mut().enumerate() {
            let in_view =
                (wish[0] * x[to] + wish[1] * y[to] >= 0.0) | (ahead[0] * x[to] + ahead[1] * y[to] >= 0.0);
            let distance = (x[to] * x[to] + y[to] * y[to]).sqrt();
            distances[to] = if in_view { distance } else { f32::INFINITY };
            let along = wish[0] * facing_x[to] + wish[1] * facing_y[to];
            // Towards those who walk one's own way one anticipates the speed one wants.
            let own_x = if along > 0.0 { wanted[0] } else { moving[0] };
            let own_y = if along > 0.0 { wanted[1] } else { moving[1] };
            let (their_x, their_y) = (facing_x[to] * speed[to], facing_y[to] * speed[to]);
            let apart = if distance > 1e-6 { distance } else { 1e-6 };
            let closing = ((own_x - their_x) * x[to] + (own_y - their_y) * y[to]) / apart * anticipation;
            let gap = apart - contact - closing;
            let gap = if gap > 0.0 { gap } else { 0.0 };
            let share = exp2(if gap < wide { gap } else { wide } * slope);
            let share = if (gap <= wide) & in_view { share } else { 0.0 };
            let push = strength * (1.5 - 0.5 * along) * share;
            // Away from where they will be; to the right of those who come straight on.
            let (then_x, then_y) = (x[to] + their_x * anticipation, y[to] + their_y * anticipation);
            let on_left = wish[0] * then_y - wish[1] * then_x >= 0.0;
            *aside = if on_left { -push } else { push };
        }
        self.aside.iter().map(|aside| f64::from(*aside)).sum()
    }

    /// How who stands steps back from those in view who touch.
    pub(super) fn giving_way(&self, rules: &Rules) -> Vector2 {
        let mut back = Vector2::zeros();
        for ((x, y), distance) in self.x.iter().zip(&self.y).zip(&self.distance) {
            let touching = (distance - rules.contact as f32).max(0.0) * (LOG2_E / TOUCH);
            if touching < 24.0 && *distance > 0.0 {
                let share = rules.model.giving_way as f32 * exp2(-touching) / distance;
                back -= Vector2::new(f64::from(x * share), f64::from(y * share));
            }
        }
        back
    }

    /// The distance to the nearest of those in view whom one would walk into in a direction, m.
    pub(super) fn ahead(&self, rules: &Rules, direction: Vector2) -> f32 {
        let [ahead_x, ahead_y] = single(direction);
        let contact = rules.contact as f32;
        let mut nearest = [f32::INFINITY; 4];
        let mut blocks =
            self.x.chunks_exact(4).zip(self.y.chunks_exact(4)).zip(self.distance.chunks_exact(4));
        let nearer = |least: f32, x: f32, y: f32, distance: f32| {
            let in_the_way =
                (ahead_x * x + ahead_y * y > 0.0) & ((ahead_x * y - ahead_y * x).abs() <= contact);
            if in_the_way & (distance < least) { distance } else { least }
        };
        for ((x, y), distance) in &mut blocks {
            for lane in 0..4 {
                nearest[lane] = nearer(nearest[lane], x[lane], y[lane], distance[lane]);
            }
        }
        let whole = self.x.len() / 4 * 4;
        let mut least = nearest.into_iter().fold(f32::INFINITY, f32::min);
        for to in whole..self.x.len() {
            least = nearer(least, self.x[to], self.y[to], self.distance[to]);
        }
        least
    }
}
