//! Quickest routes as the streets are now, for drivers who look for one while they drive.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use simworld_core::geometry::Point2;
use simworld_core::net::RoadNetwork;

use super::{Leg, Route, Router};

/// Every leg with those that follow it, close together in memory, and where it begins and ends: how far it is at least.
#[derive(Clone, Debug, Default)]
pub(super) struct Legs {
    from: Vec<Point2>,
    to: Vec<Point2>,
    /// The highest speed that is allowed anywhere, m/s.
    top: f64,
    /// By leg: which follow it, and the time to their ends when they are free, s.
    next: Vec<(Leg, f64)>,
    /// Where those of each leg begin, and where the last end.
    starts: Vec<u32>,
}

impl Legs {
    /// Of pairs that follow one another, by the first of each.
    pub(super) fn new(network: &RoadNetwork, pairs: &[(Leg, Leg, f64)]) -> Self {
        let count = network.roads.len() * 2;
        let legs = (0..count).map(Leg::from_index);
        let path = |leg: Leg| leg.lanes(network).first().map(|lane| &network.lanes[lane.index()].path[..]);
        let end = |point: Option<&Point2>| point.copied().unwrap_or_default();
        let from = legs.clone().map(|leg| end(path(leg).and_then(<[Point2]>::first))).collect();
        let to = legs.clone().map(|leg| end(path(leg).and_then(<[Point2]>::last))).collect();
        let top = network.lanes.iter().map(|lane| lane.speed_limit).fold(1.0, f64::max);
        let start = |index| pairs.partition_point(|pair| pair.0.index() < index) as u32;
        let next = pairs.iter().map(|pair| (pair.1, pair.2)).collect();
        Self { from, to, top, next, starts: (0..=count).map(start).collect() }
    }

    fn after(&self, leg: Leg) -> &[(Leg, f64)] {
        &self.next[self.starts[leg.index()] as usize..self.starts[leg.index() + 1] as usize]
    }

    /// Time that it takes at least from the end of a leg to the beginning of another, s.
    fn least(&self, from: Leg, to: Leg) -> f64 {
        /// Lanes of a leg lie beside one another: by so much one is nearer than the first of each, m.
        const BESIDE: f64 = 20.0;
        if from == to {
            return 0.0;
        }
        let straight = (self.to[from.index()] - self.from[to.index()]).norm();
        (straight - BESIDE).max(0.0) / self.top
    }
}

/// A leg that was reached, and how soon one can be at the end by it.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Reached {
    bound: f64,
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

/// The memory of searches, kept from one to the next.
#[derive(Clone, Debug, Default)]
pub(crate) struct Search {
    /// By leg: the search that saw it last, the time to its end, s, and the leg before.
    seen: Vec<(u32, f64, Leg)>,
    open: BinaryHeap<Reached>,
    number: u32,
}

impl Search {
    fn begin(&mut self, legs: usize) {
        if self.seen.len() != legs || self.number == u32::MAX {
            self.seen.clear();
            self.seen.resize(legs, (0, 0.0, Leg::from_index(0)));
            self.number = 0;
        }
        self.number += 1;
        self.open.clear();
    }

    /// Takes down that one is at the end of a leg by another at a time, if that is sooner than was known.
    fn reach(&mut self, leg: Leg, time: f64, by: Leg) -> bool {
        let seen = &mut self.seen[leg.index()];
        let is_sooner = seen.0 != self.number || time < seen.1;
        if is_sooner {
            *seen = (self.number, time, by);
        }
        is_sooner
    }

    /// The way to a leg, into a route whose legs before the first are kept.
    fn way(&self, from: Leg, to: Leg, into: &mut Route) {
        let begin = into.0.len();
        let mut leg = to;
        into.0.push(leg);
        while leg != from {
            leg = self.seen[leg.index()].2;
            into.0.push(leg);
        }
        into.0[begin..].reverse();
    }
}

impl Router {
    /// The time from the end of the first of some legs to that of the last, where each takes so much longer than it does when it is free, s.
    /// `None` if one does not lead on to the next.
    pub(crate) fn delayed_time(&self, legs: &[Leg], delay: impl Fn(Leg) -> f64) -> Option<f64> {
        let time = |pair: &[Leg]| {
            let next = self.legs.after(pair[0]).iter().find(|next| next.0 == pair[1])?;
            Some(next.1 + delay(next.0))
        };
        legs.windows(2).map(time).sum()
    }

    /// The quickest route from one leg to another, both included, if it takes less than `most`, s, after the first; every leg takes so much
    /// longer than it does when it is free, s. It is put behind what `into` holds. False, and nothing is put there, if there is none.
    pub(crate) fn quickest_delayed(
        &self,
        (from, to, most): (Leg, Leg, f64),
        delay: impl Fn(Leg) -> f64,
        is_open: impl Fn(Leg, Leg) -> bool,
        search: &mut Search,
        into: &mut Route,
    ) -> bool {
        let (legs, count) = (&self.legs, self.graph.node_count());
        if from.index() >= count || to.index() >= count {
            return false;
        }
        search.begin(count);
        search.reach(from, 0.0, from);
        let bound = legs.least(from, to);
        if bound < most {
            search.open.push(Reached { bound, leg: from });
        }
        while let Some(Reached { bound, leg }) = search.open.pop() {
            if leg == to {
                search.way(from, to, into);
                return true;
            }
            let time = search.seen[leg.index()].1;
            if bound > time + legs.least(leg, to) {
                continue; // it was reached sooner since
            }
            for (next, free) in legs.after(leg) {
                let time = time + free + delay(*next);
                let bound = time + legs.least(*next, to);
                if bound < most && is_open(leg, *next) && search.reach(*next, time, leg) {
                    search.open.push(Reached { bound, leg: *next });
                }
            }
        }
        false
    }
}

#[cfg(test)]
mod tests {
    use simworld_core::net::{NetworkConfig, StreetPlan};

    use super::*;

    fn grid() -> RoadNetwork {
        let plan = StreetPlan::grid(6, 5, 90.0);
        RoadNetwork::derive(&plan, &NetworkConfig::default()).expect("it is a plan")
    }

    #[test]
    fn without_delays_it_is_the_quickest_route() {
        let network = grid();
        let router = Router::new(&network);
        let mut search = Search::default();
        let legs: Vec<Leg> = (0..network.roads.len() * 2).map(Leg::from_index).collect();
        for (from, to) in legs.iter().flat_map(|from| legs.iter().step_by(7).map(|to| (*from, *to))) {
            let mut found = Route::default();
            let known = router.quickest(from, to);
            let is_found = router.quickest_delayed(
                (from, to, f64::INFINITY),
                |_| 0.0,
                |_, _| true,
                &mut search,
                &mut found,
            );
            assert_eq!(is_found, known.is_some());
            if let Some(known) = known {
                let time = |route: &Route| router.time(route).expect("it leads on");
                assert!((time(&found) - time(&known)).abs() < 1e-9, "{found:?} for {known:?}");
                assert!(
                    router
                        .delayed_time(&found.0, |_| 0.0)
                        .is_some_and(|own| (own - time(&known)).abs() < 1e-9)
                );
                let less = (from, to, time(&known) - 1e-6);
                assert!(!router.quickest_delayed(less, |_| 0.0, |_, _| true, &mut search, &mut found));
            }
        }
    }

    #[test]
    fn it_goes_round_what_is_slow_and_keeps_off_what_is_shut() {
        let network = grid();
        let router = Router::new(&network);
        let (from, to) = (Leg::from_index(0), Leg::from_index(network.roads.len() * 2 - 2));
        let ends = (from, to, f64::INFINITY);
        let known = router.quickest(from, to).expect("a grid is connected");
        let slow = known.0[known.0.len() / 2];
        let mut search = Search::default();
        let mut round = Route(vec![from]);
        let delay = |leg: Leg| if leg == slow { 600.0 } else { 0.0 };
        assert!(router.quickest_delayed(ends, delay, |_, _| true, &mut search, &mut round));
        assert_eq!(round.0[..2], [from, from], "what was there stays");
        assert!(!round.0.contains(&slow) && round.0.last() == Some(&to));
        let mut none = Route::default();
        assert!(!router.quickest_delayed(ends, delay, |leg, _| leg != from, &mut search, &mut none));
        assert_eq!(none.0, []);
    }
}
