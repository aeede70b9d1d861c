//! The search for the quickest way: A* (Hart, Nilsson and Raphael 1968) over arrays, with memory that is kept from one to the next.

use std::cmp::Ordering;
use std::collections::BinaryHeap;
use std::sync::{Mutex, PoisonError};

use super::Leg;

/// A leg that was reached: when one is at its end, and how soon one can be at the goal by it, s.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Reached {
    bound: f64,
    time: f64,
    leg: Leg,
}

impl Eq for Reached {}

impl Ord for Reached {
    fn cmp(&self, other: &Self) -> Ordering {
        // The heap gives the greatest first.
        other.bound.total_cmp(&self.bound).then(other.leg.cmp(&self.leg))
    }
}

impl PartialOrd for Reached {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

/// What is known of a leg: the search that saw it last, the time to its end, s, and the leg before.
#[derive(Clone, Copy, Debug)]
struct Seen {
    time: f64,
    number: u32,
    by: Leg,
}

/// The memory of searches.
#[derive(Debug, Default)]
pub(super) struct Search {
    seen: Vec<Seen>,
    open: BinaryHeap<Reached>,
    number: u32,
}

impl Search {
    /// Looks from the end of a leg on until it knows the quickest way to another, if that takes less than `most`, s; without a goal, the
    /// quickest ways to all. `after` has what follows a leg, with its time; `cost` what that takes there, s, none where it is shut;
    /// `least` the time from a leg to the goal that no way is below, s. Returns whether the goal was reached.
    pub(super) fn run<'a>(
        &mut self,
        (from, to, most): (Leg, Option<Leg>, f64),
        after: impl Fn(Leg) -> &'a [(Leg, f64)],
        cost: impl Fn(Leg, (Leg, f64)) -> Option<f64>,
        least: impl Fn(Leg) -> f64,
    ) -> bool {
        let bound = least(from);
        if bound < most && self.reach(from, 0.0, from) {
            self.open.push(Reached { bound, time: 0.0, leg: from });
        }
        while let Some(Reached { time, leg, .. }) = self.open.pop() {
            if Some(leg) == to {
                return true;
            }
            if self.time(leg).is_some_and(|sooner| sooner < time) {
                continue; // it was reached sooner since
            }
            for next in after(leg) {
                let Some(cost) = cost(leg, *next) else { continue };
                let (next, time) = (next.0, time + cost);
                let bound = time + least(next);
                if bound < most && self.reach(next, time, leg) {
                    self.open.push(Reached { bound, time, leg: next });
                }
            }
        }
        false
    }

    /// The time to the end of a leg that was reached, s.
    pub(super) fn time(&self, leg: Leg) -> Option<f64> {
        let seen = self.seen[leg.index()];
        (seen.number == self.number).then_some(seen.time)
    }

    /// Appends the way to a leg that was reached, with the leg from which it was looked for.
    pub(super) fn way(&self, from: Leg, to: Leg, into: &mut Vec<Leg>) {
        let begin = into.len();
        let mut leg = to;
        into.push(leg);
        while leg != from {
            leg = self.seen[leg.index()].by;
            into.push(leg);
        }
        into[begin..].reverse();
    }

    /// Forgets what was looked for before, and makes room for so many legs.
    fn begin(&mut self, legs: usize) {
        if self.seen.len() != legs || self.number == u32::MAX {
            self.seen.clear();
            self.seen.resize(legs, Seen { time: 0.0, number: 0, by: Leg::from_index(0) });
            self.number = 0;
        }
        self.number += 1;
        self.open.clear();
    }

    /// Takes down that one is at the end of a leg by another at a time, if that is sooner than was known.
    fn reach(&mut self, leg: Leg, time: f64, by: Leg) -> bool {
        let seen = &mut self.seen[leg.index()];
        let is_sooner = seen.number != self.number || time < seen.time;
        if is_sooner {
            *seen = Seen { time, number: self.number, by };
        }
        is_sooner
    }
}

/// Memory for as many searches as ever went on at once. What is found does not depend on it.
#[derive(Debug, Default)]
pub(super) struct Searches(Mutex<Vec<Search>>);

impl Searches {
    /// Lends memory for so many legs to a search.
    pub(super) fn with<T>(&self, legs: usize, run: impl FnOnce(&mut Search) -> T) -> T {
        // Memory of a search that broke off is as good as any.
        let idle = || self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let mut search = idle().pop().unwrap_or_default();
        search.begin(legs);
        let found = run(&mut search);
        idle().push(search);
        found
    }
}

impl Clone for Searches {
    /// Memory is no state: a clone begins with none.
    fn clone(&self) -> Self {
        Self::default()
    }
}
