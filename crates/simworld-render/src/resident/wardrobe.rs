//! Who is dressed as it is seen: bodies that moved, and at which levels of detail each of them is as it is now.
//!
//! Thousands of bodies move in every step, and of nearly all of them a few pixels are seen: of each only the levels are dressed, placed and sent that a batch may show.
//! A later batch whose eyes are elsewhere has dressed then what it lacks.

use super::{Ball, NONE};
use crate::demand::Demand;
use crate::threads;

/// Bodies of which it is worth a thread to ask whether they lack anything.
const SHARE: usize = 2048;

/// Bodies by slot.
#[derive(Default)]
pub(super) struct Wardrobe {
    /// By slot, where in the list it stands.
    places: Vec<u32>,
    list: Vec<Clad>,
    round: u64,
}

struct Clad {
    slot: u32,
    /// The levels that are up to date.
    levels: u8,
    ball: Ball,
    /// The batch for which it was dressed last.
    round: u64,
}

impl Wardrobe {
    /// A new batch begins.
    pub(super) fn begin(&mut self) {
        self.round += 1;
    }

    pub(super) fn clear(&mut self) {
        self.places.clear();
        self.list.clear();
    }

    fn find(&self, slot: u32) -> Option<&Clad> {
        self.list.get(*self.places.get(slot as usize)? as usize)
    }

    /// Whether who is in a slot is dressed as it is seen.
    pub(super) fn holds(&self, slot: u32) -> bool {
        self.find(slot).is_some()
    }

    /// The levels that are up to date of who is in a slot, if it is dressed as it is seen.
    pub(super) fn levels(&self, slot: u32) -> u8 {
        self.find(slot).map_or(0, |clad| clad.levels)
    }

    /// Notes how who is in a slot was dressed for this batch, and in which ball it is.
    pub(super) fn put(&mut self, slot: u32, ball: Ball, levels: u8) {
        let index = slot as usize;
        if index >= self.places.len() {
            self.places.resize(index + 1, NONE);
        }
        let clad = Clad { slot, levels, ball, round: self.round };
        if let Some(place) = self.list.get_mut(self.places[index] as usize) {
            *place = clad;
        } else {
            self.places[index] = self.list.len() as u32;
            self.list.push(clad);
        }
    }

    /// Who is in a slot is dressed in full, or nobody is there any more.
    pub(super) fn remove(&mut self, slot: u32) {
        let Some(place) = self.places.get_mut(slot as usize) else { return };
        let index = std::mem::replace(place, NONE) as usize;
        if index >= self.list.len() {
            return;
        }
        self.list.swap_remove(index);
        if let Some(moved) = self.list.get(index) {
            self.places[moved.slot as usize] = index as u32;
        }
    }

    /// Names the slots of who may be seen at a level that is not up to date.
    pub(super) fn lacking(&self, demand: &Demand, name: &mut dyn FnMut(u32)) {
        let lacks = |clad: &Clad| clad.round != self.round && demand.levels(&clad.ball) & !clad.levels != 0;
        let count = threads::worth(self.list.len(), SHARE);
        if count < 2 {
            return self.list.iter().filter(|clad| lacks(clad)).for_each(|clad| name(clad.slot));
        }
        let shares: Vec<&[Clad]> = self.list.chunks(self.list.len().div_ceil(count)).collect();
        let found = threads::each(shares, |share: &[Clad]| -> Vec<u32> {
            share.iter().filter(|clad| lacks(clad)).map(|clad| clad.slot).collect()
        });
        found.into_iter().flatten().for_each(name);
    }
}

#[cfg(test)]
mod tests {
    use simworld_core::geometry::Point3;

    use super::*;

    #[test]
    fn whoever_goes_leaves_the_others_where_they_are() {
        let ball = |x: f64| Ball { center: Point3::new(x, 0.0, 0.0), radius: 1.0 };
        let mut wardrobe = Wardrobe::default();
        for (slot, levels) in [(3, 1), (900, 2), (7, 4)] {
            wardrobe.put(slot, ball(f64::from(slot)), levels);
        }
        wardrobe.remove(3);
        wardrobe.remove(3);
        wardrobe.remove(5000);
        wardrobe.put(900, ball(1.0), 3);
        assert!(!wardrobe.holds(3) && !wardrobe.holds(4) && wardrobe.holds(7) && wardrobe.holds(900));
        assert_eq!([3, 7, 900, 901].map(|slot| wardrobe.levels(slot)), [0, 4, 3, 0]);
        wardrobe.put(3, ball(2.0), 7);
        wardrobe.remove(7);
        assert_eq!([3, 7, 900].map(|slot| wardrobe.levels(slot)), [7, 0, 3]);
    }
}
