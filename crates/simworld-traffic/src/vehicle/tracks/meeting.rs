//! Which ways meet each way, a bit each: who wants those of them that somebody holds asks for all of them at once.

use std::iter;

use super::Track;
use super::conflicts::Conflict;
use super::layout::{Layout, PartLayout};

/// The ways that meet one: from a number among the ways of its part on, a bit each, as many as it has conflicts, in the same order.
/// None where they are too far from one another, as in very wide junctions: there one asks for each of them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Meeting {
    first: u32,
    ways: u64,
}

impl Meeting {
    pub(super) fn new(layout: &Layout, lanes: usize, way: usize, conflicts: &[Conflict]) -> Self {
        let place = |way: u32| layout.place(lanes as Track + way);
        let part = place(way as u32).part;
        let lanes_here = layout.parts[part as usize].lanes as u32;
        let Some(first) = conflicts.first().map(|first| place(first.way).local) else {
            return Self::default();
        };
        let mut ways = 0_u64;
        for other in conflicts.iter().map(|conflict| place(conflict.way)) {
            let rank = other.local.checked_sub(first).filter(|rank| *rank < 64 && other.part == part);
            match rank.map(|rank| 1 << rank) {
                Some(bit) if bit > ways => ways |= bit,
                _ => return Self::default(),
            }
        }
        Self { first: first - lanes_here, ways }
    }

    /// Whether somebody may hold one of them.
    #[inline]
    pub(super) fn is_met(self, held: &Held) -> bool {
        self.ways == 0 || self.ways & held.from(self.first) != 0
    }

    /// Those conflicts of a way, which are `all` that it has, whose ways somebody holds.
    #[inline]
    pub(super) fn held<'a>(
        self,
        all: &'a [Conflict],
        held: &Held,
        is_held: impl Fn(u32) -> bool,
    ) -> impl Iterator<Item = &'a Conflict> {
        let Self { first, ways } = self;
        let mut left = ways & held.from(first);
        let at_once = iter::from_fn(move || {
            let lowest = left & left.wrapping_neg();
            left ^= lowest;
            (lowest != 0).then(|| &all[(ways & (lowest - 1)).count_ones() as usize])
        });
        let one_by_one = if ways == 0 { all } else { &[] };
        at_once.chain(one_by_one.iter().filter(move |conflict| is_held(conflict.way)))
    }
}

/// Ways that somebody holds, of those of a part, and the lanes from which one or several of them lead, a bit each.
#[derive(Clone, Debug, Default)]
pub(crate) struct Held {
    ways: Vec<u64>,
    one: Vec<u64>,
    several: Vec<u64>,
}

impl Held {
    /// Looks which of the ways of a part somebody holds.
    pub(in crate::vehicle) fn look(&mut self, layout: &PartLayout, is_held: impl Fn(Track) -> bool) {
        let word =
            |ways: &[Track]| ways.iter().rev().fold(0, |word: u64, way| word << 1 | u64::from(is_held(*way)));
        self.ways.clear();
        self.ways.extend(layout.tracks[layout.lanes..].chunks(64).map(word));
        for lanes in [&mut self.one, &mut self.several] {
            lanes.clear();
            lanes.resize(layout.lanes.div_ceil(64), 0);
        }
        for (held, from) in self.ways.iter().zip(layout.from.chunks(64)) {
            let mut bits = *held;
            while bits != 0 {
                let lane = from[bits.trailing_zeros() as usize] as usize;
                bits &= bits - 1;
                self.several[lane / 64] |= self.one[lane / 64] & 1 << (lane % 64);
                self.one[lane / 64] |= 1 << (lane % 64);
            }
        }
        // So that 64 ways can be asked for from each of them on.
        self.ways.push(0);
    }

    /// Whether somebody holds a way from a lane, by its number in the part.
    #[inline]
    pub(in crate::vehicle) fn leads_from(&self, lane: usize) -> bool {
        self.one[lane / 64] >> (lane % 64) & 1 == 1
    }

    /// Whether several ways from a lane are held.
    #[inline]
    pub(in crate::vehicle) fn parts_from(&self, lane: usize) -> bool {
        self.several[lane / 64] >> (lane % 64) & 1 == 1
    }

    /// Those of 64 ways, from a number on.
    #[inline]
    fn from(&self, first: u32) -> u64 {
        let (word, shift) = (first as usize / 64, first % 64);
        match self.ways.get(word..word + 2) {
            Some([low, high]) => low >> shift | high << 1 << (63 - shift),
            _ => 0,
        }
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use simworld_core::net::{CrossSection, NetworkConfig, RoadNetwork, StreetPlan};

    use super::*;
    use crate::TrafficConfig;
    use crate::vehicle::tracks::Tracks;

    #[test]
    fn conflicts_with_ways_that_are_held_are_found_at_once() {
        let mut plan = StreetPlan::grid(6, 5, 120.0);
        plan.sections[0] = CrossSection::two_way(2, 2);
        let network = RoadNetwork::derive(&plan, &NetworkConfig::default()).expect("a grid is a network");
        let tracks = Tracks::new(Arc::new(network), &TrafficConfig::default());
        let (lanes, mut held, mut found) = (tracks.lanes as Track, Held::default(), 0);
        for every in [1, 2, 3, 7] {
            let is_held = |way: u32| way.is_multiple_of(every);
            for layout in &tracks.layout.parts {
                held.look(layout, |track| is_held(track - lanes));
                for (local, lane) in layout.tracks[..layout.lanes].iter().enumerate() {
                    let count = tracks.exits(*lane).iter().filter(|(way, _)| is_held(*way)).count();
                    assert_eq!((held.leads_from(local), held.parts_from(local)), (count > 0, count > 1));
                }
                for way in layout.tracks[layout.lanes..].iter().map(|track| (track - lanes) as usize) {
                    let all = &tracks.conflicts[way];
                    let expected: Vec<&Conflict> = all.iter().filter(|other| is_held(other.way)).collect();
                    let at_once = tracks.ways[way].meeting.held(all, &held, |_| false);
                    assert_eq!(at_once.collect::<Vec<_>>(), expected, "{way}");
                    found += expected.len();
                    let one_by_one = Meeting::default().held(all, &held, is_held);
                    assert!(one_by_one.eq(expected), "{way} one by one");
                }
            }
        }
        assert!(found > 1000, "{found}");
    }
}
