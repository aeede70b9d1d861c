//! The walkers of a city as a crowd.

use std::collections::BTreeMap;

use simworld_core::geometry::{Point2, Vector2};
use simworld_core::net::WaypointGraph;

use super::decide::CROSSING_SPEED;
use super::walkway::Walkway;
use super::{Pedestrian, Plazas, Range, Stage, on_storey, party};
use crate::crowd::{Herd, Look, Person, Wall, Wish};

/// Where those stand who have left, m: nobody is there.
const NOWHERE: f64 = 1e9;

/// The walkers of a city as a crowd.
pub(super) struct Streets<'a> {
    pub(super) walkers: &'a [Pedestrian],
    /// The numbers of those who matter now; all if there are none.
    pub(super) subset: &'a [u32],
    /// Bodies of others.
    pub(super) bodies: &'a [Person],
    pub(super) ways: &'a WaypointGraph,
    pub(super) plazas: &'a Plazas,
    /// How high those stand whom somebody else moves, m, by number.
    pub(super) free: &'a BTreeMap<u32, f64>,
    /// Whether those decide too who do so now and then.
    pub(super) turn: bool,
    /// Time until those decide again, s.
    pub(super) until_turn: f64,
    pub(super) dt: f64,
}

impl Streets<'_> {
    /// How many walkers matter now.
    pub(super) fn movers(&self) -> usize {
        if self.subset.is_empty() { self.walkers.len() } else { self.subset.len() }
    }

    fn walker(&self, index: usize) -> Option<&Pedestrian> {
        if self.subset.is_empty() {
            return self.walkers.get(index);
        }
        self.walkers.get(*self.subset.get(index)? as usize)
    }

    /// A walker as those of its storey see it.
    fn seen(&self, index: usize, walker: &Pedestrian) -> Person {
        let person = walker.person();
        if self.ways.is_level() {
            return person;
        }
        let number = self.subset.get(index).copied().unwrap_or(index as u32);
        let free = self.free.get(&number).filter(|_| walker.stage == Stage::Free);
        on_storey(person, free.copied().unwrap_or_else(|| walker.height(self.ways)), self.ways)
    }

    fn body(&self, index: usize) -> Person {
        index.checked_sub(self.movers()).and_then(|other| self.bodies.get(other)).copied().unwrap_or_default()
    }
}

impl Pedestrian {
    /// Whether it decides in a step.
    pub(super) fn decides(&self, turn: bool) -> bool {
        (turn || self.range == Range::Near) && self.stage != Stage::Free
    }

    fn wish(&self, walkers: &[Pedestrian], aim: Point2, hold: Option<f64>) -> Wish {
        let way = aim - self.position;
        let distance = way.norm();
        let direction = if distance > 1e-9 { way / distance } else { self.direction() };
        let pace = if self.companions > 0 { party::pace(self, walkers, direction) } else { 1.0 };
        let speed = match self.stage {
            Stage::Walking => self.free_speed() * pace,
            Stage::Crossing => (self.free_speed() * pace).max(CROSSING_SPEED),
            Stage::Waiting | Stage::Gone | Stage::Free => 0.0,
        };
        // Who does not decide before then does not go beyond the waypoint.
        let most = hold.map_or(f64::INFINITY, |hold| distance / hold);
        Wish { direction, speed: speed.min(most) }
    }
}

impl Herd for Streets<'_> {
    fn count(&self) -> usize {
        self.movers() + self.bodies.len()
    }

    fn person(&self, index: usize) -> Person {
        match self.walker(index) {
            Some(walker) if walker.is_present() => self.seen(index, walker),
            Some(_) => Person::standing(Point2::new(NOWHERE, NOWHERE), Vector2::x()),
            None => self.body(index),
        }
    }

    fn touch(&self, index: usize) -> u64 {
        let Some(walker) = self.walker(index) else { return 0 };
        let [from, to] = [walker.from, walker.to].map(|id| self.ways.waypoint(id).position.x.to_bits());
        let edge = self.ways.edges(walker.from).first().map_or(0, |edge| u64::from(edge.to.0));
        from ^ to ^ edge ^ walker.position.x.to_bits()
    }

    fn look(&self, index: usize, walls: &mut Vec<Wall>) -> Option<Look> {
        let walker = self.walker(index).filter(|walker| walker.is_present() && walker.decides(self.turn))?;
        let walkway = Walkway::of(walker, self.ways, self.plazas);
        let is_near = walker.range == Range::Near;
        let aim = walkway.aim(walker.position, self.plazas);
        let wish = walker.wish(self.walkers, aim, (!is_near).then_some(self.until_turn));
        if wish.speed > 0.0 {
            walkway.edges(walker.position, self.plazas, walls);
        }
        let hold = if is_near { self.dt } else { self.until_turn };
        Some(Look { person: self.seen(index, walker), wish, hold })
    }

    fn committed(&self, index: usize, time: f64) -> Option<Vector2> {
        match self.walker(index) {
            Some(walker) if walker.decides(self.turn) => None,
            Some(walker) => Some(walker.velocity * self.until_turn),
            None => {
                let body = self.body(index);
                Some(body.direction * (body.speed * time))
            }
        }
    }
}
