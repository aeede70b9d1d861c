//! Quickest routes between two legs, as the streets are when they are free or as slow as somebody knows them to be.

use simworld_core::net::RoadNetwork;

use super::landmarks::Landmarks;
use super::legs::Legs;
use super::search::Searches;
use super::{Leg, Route};

/// Finds quickest routes by travel time.
#[derive(Clone, Debug)]
pub struct Router {
    legs: Legs,
    searches: Searches,
}

impl Router {
    /// Prepares a network.
    pub fn new(network: &RoadNetwork) -> Self {
        Self { legs: Legs::new(network), searches: Searches::default() }
    }

    /// The quickest route from one leg to another, both included; `None` if there is none.
    pub fn quickest(&self, from: Leg, to: Leg) -> Option<Route> {
        self.quickest_open(from, to, |_| true)
    }

    /// The quickest route on legs that are open, the first apart, on which one is already; `None` if there is none.
    pub fn quickest_open(&self, from: Leg, to: Leg, is_open: impl Fn(Leg) -> bool) -> Option<Route> {
        self.quickest_between(from, to, |_, leg| is_open(leg))
    }

    /// The same where it depends on the leg before whether one can go on to a leg.
    pub(crate) fn quickest_between(
        &self,
        from: Leg,
        to: Leg,
        is_open: impl Fn(Leg, Leg) -> bool,
    ) -> Option<Route> {
        let mut route = Route::default();
        let delay = |before, leg| is_open(before, leg).then_some(0.0);
        let is_found = self.search((from, to, f64::INFINITY), delay, |_| 0.0, &mut route);
        is_found.then_some(route)
    }

    /// The quickest route on what is open from one leg to another, both included, if it takes less than `most`, s, after the first, where
    /// every leg takes so much longer than it does when it is free, s. Landmarks are by the same delays, or have forgotten theirs. It is put
    /// behind what `into` holds; false, and nothing is put there, if there is none.
    pub(crate) fn quickest_delayed(
        &self,
        ends: (Leg, Leg, f64),
        delay: impl Fn(Leg) -> f64,
        is_open: impl Fn(Leg, Leg) -> bool,
        landmarks: &mut Landmarks,
        into: &mut Route,
    ) -> bool {
        landmarks.see(&self.legs, &self.searches, &delay);
        let cost = |before, leg| is_open(before, leg).then(|| delay(leg));
        self.search(ends, cost, |leg| landmarks.least(leg, ends.1), into)
    }

    /// The same by the delay of a leg behind another, none where it is shut, and a time to the goal that no way from a leg is below, s.
    fn search(
        &self,
        (from, to, most): (Leg, Leg, f64),
        delay: impl Fn(Leg, Leg) -> Option<f64>,
        least: impl Fn(Leg) -> f64,
        into: &mut Route,
    ) -> bool {
        let (legs, count) = (&self.legs, self.legs.count());
        if from.index().max(to.index()) >= count {
            return false;
        }
        let cost = |before, (leg, free): (Leg, f64)| Some(free + delay(before, leg)?);
        self.searches.with(count, |search| {
            let is_found = search.run((from, Some(to), most), |leg| legs.after(leg), cost, least);
            if is_found {
                search.way(from, to, &mut into.0);
            }
            is_found
        })
    }

    /// Free travel time of a route after its first leg, s: what [`quickest`](Self::quickest) makes least. `None` if a leg
    /// does not lead on to the next.
    pub fn time(&self, route: &Route) -> Option<f64> {
        self.delayed_time(&route.0, |_| 0.0)
    }

    /// The time from the end of the first of some legs to that of the last, where each takes so much longer than it does when it is free, s.
    /// `None` if one does not lead on to the next.
    pub(crate) fn delayed_time(&self, legs: &[Leg], delay: impl Fn(Leg) -> f64) -> Option<f64> {
        let time = |pair: &[Leg]| Some(self.legs.time(pair[0], pair[1])? + delay(pair[1]));
        legs.windows(2).map(time).sum()
    }

    /// Every pair of legs that follow one another, ascending, with the time that the second takes, s.
    #[cfg(feature = "hierarchy")]
    pub(super) fn pairs(&self) -> impl Iterator<Item = (Leg, Leg, f64)> {
        let legs = (0..self.legs.count()).map(Leg::from_index);
        legs.flat_map(|leg| self.legs.after(leg).iter().map(move |(next, time)| (leg, *next, *time)))
    }

    /// The legs that follow one, ascending.
    pub fn after(&self, leg: Leg) -> impl Iterator<Item = Leg> {
        self.legs.after(leg).iter().map(|next| next.0)
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

    fn legs(network: &RoadNetwork) -> impl Iterator<Item = Leg> + Clone {
        (0..network.roads.len() * 2).map(Leg::from_index)
    }

    /// The times to the ends of all legs from that of one, by going over all pairs until nothing is sooner any more (Bellman and Ford).
    fn times(router: &Router, from: Leg, delay: impl Fn(Leg) -> f64) -> Vec<f64> {
        let mut times = vec![f64::INFINITY; router.legs.count()];
        times[from.index()] = 0.0;
        let all = || (0..router.legs.count()).map(Leg::from_index);
        loop {
            let mut is_done = true;
            for (leg, (next, free)) in
                all().flat_map(|leg| router.legs.after(leg).iter().map(move |next| (leg, next)))
            {
                let time = times[leg.index()] + free + delay(*next);
                if time < times[next.index()] {
                    (times[next.index()], is_done) = (time, false);
                }
            }
            if is_done {
                return times;
            }
        }
    }

    #[test]
    fn no_route_is_quicker() {
        let network = grid();
        let router = Router::new(&network);
        let slow =
            |leg: Leg| if leg.index().is_multiple_of(3) { 7.0 * (leg.index() % 5) as f64 } else { 0.0 };
        let mut landmarks = Landmarks::default();
        for from in legs(&network) {
            let [free, slowed] = [times(&router, from, |_| 0.0), times(&router, from, slow)];
            for to in legs(&network).step_by(7) {
                let known = router.quickest(from, to);
                let time = known.as_ref().map(|route| router.time(route).expect("it leads on"));
                assert!(
                    (time.unwrap_or(f64::INFINITY) - free[to.index()]).abs() < 1e-9
                        || time.is_none() && free[to.index()].is_infinite()
                );
                let mut found = Route::default();
                let most = slowed[to.index()] + 1e-6;
                assert_eq!(
                    router.quickest_delayed((from, to, most), slow, |_, _| true, &mut landmarks, &mut found),
                    time.is_some()
                );
                if time.is_some() {
                    let own = router.delayed_time(&found.0, slow).expect("it leads on");
                    assert!((own - slowed[to.index()]).abs() < 1e-9, "{found:?}");
                    let less = (from, to, slowed[to.index()] - 1e-6);
                    assert!(!router.quickest_delayed(less, slow, |_, _| true, &mut landmarks, &mut found));
                }
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
        let mut round = Route(vec![from]);
        let delay = |leg| if leg == slow { 600.0 } else { 0.0 };
        let mut landmarks = Landmarks::default();
        assert!(router.quickest_delayed(ends, delay, |_, _| true, &mut landmarks, &mut round));
        assert_eq!(round.0[..2], [from, from], "what was there stays");
        assert!(!round.0.contains(&slow) && round.0.last() == Some(&to));
        let open = router.quickest_open(from, to, |leg| leg != slow).expect("a grid has other ways");
        assert!(!open.0.contains(&slow));
        let mut none = Route::default();
        assert!(!router.quickest_delayed(ends, delay, |before, _| before != from, &mut landmarks, &mut none));
        assert_eq!(none.0, []);
    }
}
