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
use super::grid::{Cell, Grid, Window};
use super::model::Rules;
use super::{Person, Wish};

/// Distance over which the wish to step back falls to 1/e, m.
const TOUCH: f32 = 0.05;

/// So many are worked on at once, in a block. The last block is filled up with nobody: loops over whole blocks have no rest, which would
/// take as long as a block for each.
const LANES: usize = 4;
/// The lanes of a block that the bits of a number stand for, in order.
const LANES_OF: [[u32; LANES]; 1 << LANES] = lanes_of();

const fn lanes_of() -> [[u32; LANES]; 1 << LANES] {
    let mut lanes_of = [[0; LANES]; 1 << LANES];
    let mut bits: usize = 0;
    while bits < lanes_of.len() {
        let (mut lane, mut count) = (0, 0);
        while lane < LANES {
            if bits >> lane & 1 == 1 {
                lanes_of[bits][count] = lane as u32;
                count += 1;
            }
            lane += 1;
        }
        bits += 1;
    }
    lanes_of
}

/// Whole blocks of values.
fn blocks<T>(values: &[T]) -> impl Iterator<Item = &[T; LANES]> {
    values.as_chunks().0.iter()
}

/// The people in the cells around one cell.
#[derive(Clone, Debug, Default)]
pub(super) struct Around {
    cell: Option<Cell>,
    count: usize,
    /// Places relative to the middle of the cell, m, in whole blocks.
    x: Vec<f32>,
    y: Vec<f32>,
    /// Their places among all in the grid.
    places: Vec<u32>,
}

impl Around {
    /// Nothing is known of any cell.
    pub(super) fn forget(&mut self) {
        self.cell = None;
    }

    /// Looks into windows around somebody, who has a place among all; in a crowd into all cells around theirs, and not again for those
    /// of one cell, one after the other.
    pub(super) fn look(&mut self, grid: &Grid, at: Point2, place: usize, windows: &[Window]) {
        let cell = grid.cell(at);
        if grid.is_crowd() && self.cell == Some(cell) {
            return;
        }
        self.cell = Some(cell);
        self.count = 0;
        let middle = grid.middle(cell);
        if grid.is_crowd() {
            for mut window in grid.around(at) {
                grid.open(&mut window);
                self.look_into(grid, middle, &window, Some);
            }
        } else {
            // There is seldom anybody else, and whoever looks need not be looked up.
            let other = |rank| Some(grid.place(rank)).filter(|other| *other != place);
            for window in windows {
                self.look_into(grid, middle, window, other);
            }
        }
        // The last block is filled up with nobody, out of sight.
        self.make_room(LANES);
        self.x[self.count..self.count + LANES].fill(f32::INFINITY);
    }

    /// Looks into an open window: at those whose ranks have places that matter.
    fn look_into(
        &mut self,
        grid: &Grid,
        middle: Point2,
        window: &Window,
        place: impl Fn(usize) -> Option<usize>,
    ) {
        let ranks = window.ranks();
        self.make_room(ranks.len());
        for (own, rank) in grid.marks(ranks.clone()).iter().zip(ranks) {
            // Who is elsewhere is not looked at.
            let here = if *own == window.mark() { place(rank) } else { None };
            if let Some(place) = here {
                let seen = &grid.seen()[place];
                self.x[self.count] = (seen.at[0] - middle.x) as f32;
                self.y[self.count] = (seen.at[1] - middle.y) as f32;
                self.places[self.count] = place as u32;
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
            self.places.resize(2 * end, 0);
        }
    }
}

/// Somebody who looks around.
#[derive(Clone, Copy, Debug)]
pub(super) struct Me {
    /// Place among all in the grid.
    pub(super) place: usize,
    pub(super) person: Person,
    pub(super) wish: Wish,
}

/// Some of those who matter to somebody.
#[derive(Clone, Copy, Debug, Default)]
struct Block {
    /// Offsets, m; not numbers where nobody is.
    x: Lanes,
    y: Lanes,
    facing_x: Lanes,
    facing_y: Lanes,
    speed: Lanes,
    /// Distance, m; infinite for who is out of view.
    distance: Lanes,
    /// How strongly they turn one aside.
    aside: Lanes,
}

/// Those who matter to somebody.
#[derive(Clone, Debug, Default)]
pub(super) struct Nearby {
    /// One for those of all around who matter, else zero.
    matter: Vec<u32>,
    /// Where those who matter are among those around.
    chosen: Vec<u32>,
    /// How many they are.
    count: usize,
    blocks: Vec<Block>,
    /// Places of those who could be run into before the next decision, wherever they are.
    pub(super) close: Vec<u32>,
}

/// A pair of single numbers.
type Pair = [f32; 2];
/// A number of each in a block.
type Lanes = [f32; LANES];

fn single(vector: Vector2) -> Pair {
    [vector.x as f32, vector.y as f32]
}

impl Nearby {
    /// With room for so many who matter, half of them close.
    pub(super) fn roomy(count: usize) -> Self {
        let (blocks, close) = (Vec::with_capacity(count / LANES), Vec::with_capacity(count / 2));
        Self { blocks, close, ..Self::default() }
    }

    /// Finds who matters to somebody: who is within reach and in view, or so close that one could run into them.
    pub(super) fn find(&mut self, rules: &Rules, grid: &Grid, around: &Around, me: &Me) {
        if around.count == 0 {
            // As for most where few are.
            self.count = 0;
            self.blocks.clear();
            self.close.clear();
            return;
        }
        let middle = around.cell.map_or(me.person.position, |cell| grid.middle(cell));
        let own = single(me.person.position - middle);
        let close = rules.close(me.wish.speed) as f32;
        let near = close * close;
        self.choose(rules, around, me, own, near);
        self.take(grid, around, own, near);
        if !grid.is_crowd() {
            // In the order in which those of a crowd are found: whom one heeds first makes a difference.
            self.close.sort_unstable_by_key(|place| {
                let (column, row) = grid.cell(grid.position(*place as usize));
                (row, column, *place)
            });
        }
    }

    /// Finds where those who matter are among those around.
    fn choose(&mut self, rules: &Rules, around: &Around, me: &Me, [own_x, own_y]: Pair, near: f32) {
        let (wish, ahead) = (single(me.wish.direction), single(me.person.direction));
        let (reach, me) = ((rules.reach * rules.reach) as f32, me.place as u32);
        let room = around.count.next_multiple_of(LANES);
        if self.matter.len() < room {
            self.matter.resize(2 * room, 0);
            self.chosen.resize(2 * room, 0);
        }
        let places = around.x[..room].iter().zip(&around.y[..room]).zip(&around.places[..room]);
        for (matters, ((x, y), place)) in self.matter[..room].iter_mut().zip(places) {
            let (x, y) = (x - own_x, y - own_y);
            let square = x * x + y * y;
            let in_view = (wish[0] * x + wish[1] * y >= 0.0) | (ahead[0] * x + ahead[1] * y >= 0.0);
            *matters = u32::from((((square <= reach) & in_view) | (square <= near)) & (*place != me));
        }
        self.count = 0;
        for (matter, first) in blocks(&self.matter[..room]).zip((0..).step_by(LANES)) {
            let [a, b, c, d] = matter.map(|matters| matters as usize);
            // All lanes are written, those that are meant first: the next block goes over the others.
            let chosen = &mut self.chosen[self.count..self.count + LANES];
            let bits = a | b << 1 | c << 2 | d << 3;
            for (chosen, lane) in chosen.iter_mut().zip(LANES_OF[bits % LANES_OF.len()]) {
                *chosen = first + lane;
            }
            self.count += a + b + c + d;
        }
    }

    fn take(&mut self, grid: &Grid, around: &Around, own: Pair, near: f32) {
        self.close.clear();
        self.blocks.clear();
        for chosen in self.chosen[..self.count].chunks(LANES) {
            let mut block = Block { x: [f32::NAN; LANES], ..Block::default() };
            for (chosen, lane) in chosen.iter().zip(0..LANES) {
                let chosen = *chosen as usize;
                let place = around.places[chosen];
                let seen = &grid.seen()[place as usize];
                let (x, y) = (around.x[chosen] - own[0], around.y[chosen] - own[1]);
                if x * x + y * y <= near {
                    self.close.push(place);
                }
                (block.x[lane], block.y[lane]) = (x, y);
                [block.facing_x[lane], block.facing_y[lane]] = seen.facing;
                block.speed[lane] = seen.speed;
            }
            self.blocks.push(block);
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
        for block in &mut self.blocks {
            for lane in 0..LANES {
                let (x, y) = (block.x[lane], block.y[lane]);
                let (facing_x, facing_y) = (block.facing_x[lane], block.facing_y[lane]);
                let in_view = (wish[0] * x + wish[1] * y >= 0.0) | (ahead[0] * x + ahead[1] * y >= 0.0);
                let distance = (x * x + y * y).sqrt();
                block.distance[lane] = if in_view { distance } else { f32::INFINITY };
                let along = wish[0] * facing_x + wish[1] * facing_y;
                // Towards those who walk one's own way one anticipates the speed one wants.
                let own_x = if along > 0.0 { wanted[0] } else { moving[0] };
                let own_y = if along > 0.0 { wanted[1] } else { moving[1] };
                let (their_x, their_y) = (facing_x * block.speed[lane], facing_y * block.speed[lane]);
                let apart = if distance > 1e-6 { distance } else { 1e-6 };
                let closing = ((own_x - their_x) * x + (own_y - their_y) * y) / apart * anticipation;
                let gap = apart - contact - closing;
                let gap = if gap > 0.0 { gap } else { 0.0 };
                let share = exp2(if gap < wide { gap } else { wide } * slope);
                let share = if (gap <= wide) & in_view { share } else { 0.0 };
                let push = strength * (1.5 - 0.5 * along) * share;
                // Away from where they will be; to the right of those who come straight on.
                let (then_x, then_y) = (x + their_x * anticipation, y + their_y * anticipation);
                let on_left = wish[0] * then_y - wish[1] * then_x >= 0.0;
                block.aside[lane] = if on_left { -push } else { push };
            }
        }
        let asides = self.blocks.iter().flat_map(|block| block.aside);
        asides.take(self.count).map(f64::from).sum()
    }

    /// How who stands steps back from those in view who touch.
    pub(super) fn giving_way(&self, rules: &Rules) -> Vector2 {
        let mut back = Vector2::zeros();
        let lanes = self.blocks.iter().flat_map(|block| block.x.iter().zip(block.y).zip(block.distance));
        for ((x, y), distance) in lanes {
            let touching = (distance - rules.contact as f32).max(0.0) * (LOG2_E / TOUCH);
            if touching < 24.0 && distance > 0.0 {
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
        let mut nearest = [f32::INFINITY; LANES];
        for block in &self.blocks {
            for (lane, nearest) in nearest.iter_mut().enumerate() {
                let (x, y, distance) = (block.x[lane], block.y[lane], block.distance[lane]);
                let in_the_way =
                    (ahead_x * x + ahead_y * y > 0.0) & ((ahead_x * y - ahead_y * x).abs() <= contact);
                let is_nearer = in_the_way & (distance < *nearest);
                *nearest = if is_nearer { distance } else { *nearest };
            }
        }
        nearest.into_iter().fold(f32::INFINITY, f32::min)
    }
}
