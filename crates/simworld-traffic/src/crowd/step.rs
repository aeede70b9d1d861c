//! One step of a crowd: everybody decides from the state at its start.

use std::hint::black_box;
use std::mem::take;
use std::ops::Range;
use std::sync::{Mutex, PoisonError};

use simworld_core::geometry::Vector2;
use simworld_core::net::Workers;

use super::grid::{Grid, Window};
use super::model::{Bound, Rules, safe};
use super::nearby::{Around, Me, Nearby};
use super::{AnticipationVelocity, Herd, Look, REACH, Steering, Wall};
use crate::parts::{PARTS, in_parts};

/// What somebody decided.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Decision {
    /// m/s.
    pub(crate) velocity: Vector2,
    /// Where one looks; zero for who did not decide.
    pub(crate) facing: [f32; 2],
}

impl Decision {
    /// Where one looks, of length one.
    pub(crate) fn direction(&self) -> Vector2 {
        let [x, y] = self.facing.map(f64::from);
        Vector2::new(x, y)
    }
}

/// So many are looked up one right after the other: what they want lies all over the memory, which answers several at once.
const BLOCK: usize = 32;

/// What a thread needs for the people of a part.
#[derive(Debug, Default)]
struct Scratch {
    around: Around,
    near: Nearby,
    looks: Vec<Option<Look>>,
    /// The walls near those of a block, the windows into which they look, and where those of each end.
    walls: Vec<Wall>,
    windows: Vec<Window>,
    ends: Vec<[usize; 2]>,
    bounds: Vec<Bound>,
}

/// Moves people; keeps nothing from step to step but memory.
#[derive(Debug, Default)]
pub struct Crowd {
    grid: Grid,
    /// In the order of the grid if it is a crowd, else in that of the people.
    decisions: Vec<Decision>,
    scratch: Vec<Mutex<Scratch>>,
}

/// Memory is not worth a copy.
impl Clone for Crowd {
    fn clone(&self) -> Self {
        Self::default()
    }
}

/// All crowds are equal: they keep no state.
impl PartialEq for Crowd {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

impl Crowd {
    /// Lets everybody of a herd decide who does so now.
    pub(crate) fn decide(
        &mut self,
        workers: &dyn Workers,
        (model, steering): (&AnticipationVelocity, Steering),
        herd: &impl Herd,
    ) {
        let Self { grid, decisions, scratch } = self;
        grid.rebuild(workers, herd.count(), &|index| herd.person(index), REACH);
        scratch.resize_with(PARTS, || Mutex::new(Scratch::roomy()));
        decisions.resize(herd.count(), Decision::default());
        let rules = Rules::new(model, steering);
        in_parts(workers, decisions, &|part, first, decisions| {
            let mut scratch = scratch[part].lock().unwrap_or_else(PoisonError::into_inner);
            scratch.around.forget();
            for (block, decisions) in decisions.chunks_mut(BLOCK).enumerate() {
                scratch.decide(&rules, grid, herd, first + block * BLOCK, decisions);
            }
        });
    }

    /// Bytes that it takes for people; what threads need for themselves grows with the threads' parts, not with the people.
    pub(crate) fn bytes(&self) -> usize {
        self.grid.bytes() + self.decisions.capacity() * size_of::<Decision>()
    }

    /// What the last call of [`decide`](Self::decide) made of somebody, if they decided.
    pub(crate) fn decision(&self, index: usize) -> Option<&Decision> {
        Some(&self.decisions[self.grid.place_of(index)]).filter(|decision| decision.facing != [0.0; 2])
    }
}

impl Scratch {
    /// With room for as many as are seldom so close at once, so that it need not grow.
    fn roomy() -> Self {
        let (near, walls) = (Nearby::roomy(64), Vec::with_capacity(16 * BLOCK));
        let (looks, ends) = (Vec::with_capacity(BLOCK), Vec::with_capacity(BLOCK));
        // Of three cells in a row those of two tiles are two windows.
        let (windows, bounds) = (Vec::with_capacity(6 * BLOCK), Vec::with_capacity(48));
        Self { near, looks, walls, windows, ends, bounds, ..Self::default() }
    }

    /// Lets those of a block decide, from one on: by rank in a crowd, so that those of a cell look around once, else by
    /// number, in which they lie in the memory.
    fn decide(
        &mut self,
        rules: &Rules,
        grid: &Grid,
        herd: &impl Herd,
        first: usize,
        decisions: &mut [Decision],
    ) {
        let places = first..first + decisions.len();
        self.prepare(grid, herd, places.clone());
        let (looks, walls) = (take(&mut self.looks), take(&mut self.walls));
        let (windows, ends) = (take(&mut self.windows), take(&mut self.ends));
        let mut begin = [0, 0];
        for (((decision, place), look), end) in decisions.iter_mut().zip(places).zip(&looks).zip(&ends) {
            let (walls, windows) = (&walls[begin[0]..end[0]], &windows[begin[1]..end[1]]);
            begin = *end;
            *decision = match look {
                Some(look) => self.decide_one(rules, grid, herd, place, look, (walls, windows)),
                None => Decision::default(),
            };
        }
        (self.looks, self.walls, self.windows, self.ends) = (looks, walls, windows, ends);
    }

    /// Finds out what those of a block want and, where people are few, who may be around them.
    fn prepare(&mut self, grid: &Grid, herd: &impl Herd, places: Range<usize>) {
        let Self { looks, walls, windows, ends, .. } = self;
        looks.clear();
        walls.clear();
        windows.clear();
        ends.clear();
        let by_rank = grid.is_crowd();
        let number = |place: usize| if by_rank { grid.seen()[place].index as usize } else { place };
        black_box(places.clone().fold(0, |all, place| all ^ herd.touch(number(place))));
        for place in places {
            let look = herd.look(number(place), walls);
            let looks_around = look.as_ref().filter(|look| !by_rank && look.wish.speed > 0.0);
            windows.extend(looks_around.into_iter().flat_map(|look| grid.around(look.person.position)));
            looks.push(look);
            ends.push([walls.len(), windows.len()]);
        }
        for window in windows.iter_mut() {
            grid.open(window);
        }
        black_box(windows.iter().fold(0, |all, window| all ^ grid.touch(window)));
    }

    fn decide_one(
        &mut self,
        rules: &Rules,
        grid: &Grid,
        herd: &impl Herd,
        place: usize,
        look: &Look,
        (walls, windows): (&[Wall], &[Window]),
    ) -> Decision {
        let Look { person, wish, hold } = *look;
        let facing = |direction: Vector2| [direction.x as f32, direction.y as f32];
        if wish.speed <= 0.0 {
            return Decision { velocity: Vector2::zeros(), facing: facing(person.direction) };
        }
        let rules = rules.holding(hold);
        let me = Me { place, person, wish };
        self.around.look(grid, person.position, place, windows);
        self.near.find(&rules, grid, &self.around, &me);
        let (wanted, direction) = rules.decide(&me, &mut self.near, walls);
        self.bind(&rules, grid, herd, &me, walls, hold);
        Decision { velocity: safe(wanted, &self.bounds, hold), facing: facing(direction) }
    }

    /// What one could run into: walls up to their face; of the gap to who decides now each may use half, and of that to who
    /// does not what they leave.
    fn bind(&mut self, rules: &Rules, grid: &Grid, herd: &impl Herd, me: &Me, walls: &[Wall], hold: f64) {
        self.bounds.clear();
        let wall =
            |wall: &Wall| Bound { toward: wall.toward, room: (wall.distance - rules.model.radius).max(0.0) };
        self.bounds.extend(walls.iter().map(wall));
        for place in &self.near.close {
            let seen = &grid.seen()[*place as usize];
            let offset = grid.position(*place as usize) - me.person.position;
            let distance = offset.norm();
            // Two in the same place, by error, part along their wishes.
            let toward = if distance > 0.0 { offset / distance } else { -me.wish.direction };
            let gap = (distance - rules.contact).max(0.0);
            let room = match herd.committed(seen.index as usize, hold) {
                None => gap * 0.5,
                Some(way) => (gap - (-way.dot(&toward)).max(0.0)).max(0.0),
            };
            self.bounds.push(Bound { toward, room });
        }
    }
}
