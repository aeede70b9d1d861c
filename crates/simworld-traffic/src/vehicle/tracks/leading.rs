//! Which lanes lead on along a route.
//!
//! On a short lane nobody changes to the one beside any more, so that a driver chooses his lane before it by what comes after it. Who still
//! stands where no way leads to the end of his route goes on by the way that there is.

use std::collections::BTreeSet;

use simworld_core::id::LaneId;

use super::closures::Closures;
use super::{Track, Tracks};
use crate::vehicle::VehicleKind;
use crate::vehicle::driving::lane_change::CHANGE_ROOM;
use crate::vehicle::manager::NONE;
use crate::{Leg, Route};

/// On a lane shorter than that nobody changes to the one beside, m: what a change takes, a car, and a little to find a gap. On one shorter
/// than the second nobody can count on it.
const LONG: f64 = CHANGE_ROOM + 8.0;
const SURE: f64 = 60.0;
/// So many short lanes one after another are looked at.
const FAR: usize = 3;

/// How well a lane leads on to the legs after it: it does not, and is too short for a change; it does to the next alone; it is long enough to
/// change to one that does; it does, and is long enough to change for what comes then; it does to all.
const BLIND: u8 = 0;
const NEXT_ALONE: u8 = 1;
const LONG_ENOUGH: u8 = 2;
const AT_ONCE: u8 = 3;
const WELL: u8 = 4;

/// Whether one can count on a change of lanes on a lane of that length.
pub(super) fn is_sure(length: f64) -> bool {
    length >= SURE
}

impl Tracks {
    /// How well a way leads on to the legs `after` the one to which it leads; for who has none, whether one can drive on there.
    pub(super) fn leads_on_to(&self, way: u32, after: &[Leg]) -> u8 {
        self.leads(self.lane_after(way as usize), after, FAR)
    }

    fn leads(&self, lane: Track, after: &[Leg], far: usize) -> u8 {
        let long_enough = self.length[lane as usize] >= LONG;
        let [next, rest @ ..] = after else {
            return if self.leads_on[lane as usize] { WELL } else { LONG_ENOUGH };
        };
        let length = self.length[lane as usize];
        let ways = self.exits(lane).iter().filter(|exit| exit.1 == *next).map(|exit| exit.0);
        if ways.clone().next().is_none() {
            return if long_enough { LONG_ENOUGH } else { BLIND };
        }
        if far == 0 || length >= SURE || rest.is_empty() {
            return WELL;
        }
        let leads = |way: u32| self.leads(self.lane_after(way as usize), rest, far - 1);
        match ways.map(leads).max().unwrap_or(BLIND) {
            WELL => WELL,
            _ if long_enough => AT_ONCE,
            BLIND | NEXT_ALONE => NEXT_ALONE,
            best => best.max(LONG_ENOUGH),
        }
    }

    /// The same in the choice between lanes for what comes later: where one can count on a change there is nothing to choose.
    pub(in crate::vehicle) fn serves(&self, way: u32, after: &[Leg]) -> u8 {
        if self.sure[way as usize] { WELL } else { self.leads_on_to(way, after) }
    }

    /// By how many grades another way may serve better than one, whatever comes after it.
    pub(in crate::vehicle) fn most_better_than(&self, way: u32) -> u8 {
        if self.sure[way as usize] { 0 } else { WELL - BLIND }
    }

    /// The way from a lane on to a leg and those after it. None if it leads to a short lane from which one could not go on, and one can still
    /// change to a lane beside that leads better.
    pub(in crate::vehicle) fn way_on(
        &self,
        closures: &Closures,
        lane: Track,
        (leg, after): (Leg, &[Leg]),
        kind: VehicleKind,
    ) -> Option<u32> {
        let well = |way: &u32| self.leads_on_to(*way, after) >= LONG_ENOUGH;
        let way = self.way_to(closures, lane, leg, after, kind)?;
        let better =
            |beside: Track| self.way_to(closures, beside, leg, after, kind).is_some_and(|way| well(&way));
        let stays = well(&way)
            || self.length[lane as usize] < LONG
            || !self.all_beside(lane).any(|beside| self.may_use(beside, kind) && better(beside));
        stays.then_some(way)
    }

    /// All lanes that lead the same way beside a lane, on its left and on its right.
    pub(in crate::vehicle) fn all_beside(&self, lane: Track) -> impl Iterator<Item = Track> + '_ {
        [0, 1].into_iter().flat_map(move |side| self.beside_on(lane, side))
    }

    /// Those on one side of it, the nearest first.
    pub(in crate::vehicle) fn beside_on(&self, lane: Track, side: usize) -> impl Iterator<Item = Track> + '_ {
        let next = move |from: &Track| Some(self.beside[*from as usize][side]).filter(|lane| *lane != NONE);
        std::iter::successors(next(&lane), next)
    }
}

impl Closures {
    /// The quickest route around what is closed from a lane: if it is too short for a change, by a way from this very lane. It does not lead
    /// from one leg to another that are to be avoided.
    pub(in crate::vehicle) fn quickest_from(
        &self,
        tracks: &Tracks,
        lane: Track,
        goal: Leg,
        avoid: Option<(Leg, Leg)>,
    ) -> Option<Route> {
        let here = Leg::of(&tracks.network, LaneId(lane));
        if here == goal || tracks.length[lane as usize] >= LONG {
            return self.quickest_but(tracks, here, goal, avoid);
        }
        let is_open =
            |exit: &&(u32, Leg)| !self.bars(tracks, exit.0 as usize) && avoid != Some((here, exit.1));
        let ways = tracks.exits(lane).iter().filter(is_open);
        let routes = ways.filter_map(|(_, after)| self.quickest_but(tracks, *after, goal, avoid));
        let with_time = routes.filter_map(|route| Some((tracks.router.time(&route)?, route)));
        let mut best = with_time.min_by(|a, b| a.0.total_cmp(&b.0))?.1;
        best.0.insert(0, here);
        Some(best)
    }
}

/// The way off the map from a leg from which no route leads to a goal, whatever is open: the fewest legs to one that leads nowhere, at whose
/// end one leaves. None if the goal can be reached, or if nothing ends there.
pub(in crate::vehicle) fn way_off(tracks: &Tracks, from: Leg, goal: Leg) -> Option<Route> {
    if tracks.router.quickest(from, goal).is_some() {
        return None;
    }
    // Each leg with the place in the list of the one before it.
    let (mut found, mut seen) = (vec![(from, 0)], BTreeSet::from([from]));
    let mut at = 0;
    while let Some((leg, _)) = found.get(at).copied() {
        let mut after = tracks.router.after(leg).peekable();
        if after.peek().is_none() {
            let mut legs = vec![leg];
            while at > 0 {
                at = found[at].1;
                legs.push(found[at].0);
            }
            legs.reverse();
            return Some(Route(legs));
        }
        found.extend(after.filter(|leg| seen.insert(*leg)).map(|leg| (leg, at)));
        at += 1;
    }
    None
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use simworld_core::geometry::Point2;
    use simworld_core::id::RoadId;
    use simworld_core::net::{CrossSection, LaneDirection, NetworkConfig, RoadNetwork, Street, StreetPlan};

    use super::*;
    use crate::TrafficConfig;

    fn tracks(plan: &StreetPlan) -> Tracks {
        let network = RoadNetwork::derive(plan, &NetworkConfig::default()).expect("it is a plan");
        Tracks::new(Arc::new(network), &TrafficConfig::default())
    }

    fn leg(road: u32) -> Leg {
        Leg::new(RoadId(road), LaneDirection::Forward)
    }

    /// A street of two lanes, a short one of two after it, and from the end of that one street straight on and one to the left.
    fn short_before_a_fork(long: f64, short: f64) -> Tracks {
        let mut plan = StreetPlan::default();
        let [one, two] = [1, 2].map(|lanes| plan.add_section(CrossSection::two_way(lanes, 0)));
        let fork = long + short;
        let nodes = [[0.0, 0.0], [long, 0.0], [fork, 0.0], [fork + 100.0, 0.0], [fork, 100.0]];
        plan.nodes.extend(nodes.map(|[x, y]| Point2::new(x, y)));
        for (from, to, section) in [(0, 1, two), (1, 2, two), (2, 3, one), (2, 4, one)] {
            plan.streets.push(Street { section, ..Street::simple(from, to) });
        }
        tracks(&plan)
    }

    #[test]
    fn one_chooses_the_lane_before_a_short_street_by_what_comes_after_it() {
        let ways_on = |short: f64| {
            let tracks = short_before_a_fork(100.0, short);
            let lanes = leg(0).lanes(&tracks.network).to_vec();
            let none = Closures::default();
            let way = |lane: &LaneId, after: u32| {
                tracks.way_on(&none, lane.0, (leg(1), &[leg(after)]), VehicleKind::Car).is_some()
            };
            // Shorter ones are inside of a joined junction.
            let length =
                leg(1).lanes(&tracks.network).first().map_or(0.0, |lane| tracks.length[lane.index()]);
            (length, [2, 3].map(|after| lanes.iter().map(|lane| way(lane, after)).collect::<Vec<_>>()))
        };
        let is_short = |(length, _): &(f64, _)| (14.0..LONG).contains(length);
        let (_, [straight_on, left]) =
            (20..60).map(|short| ways_on(f64::from(short))).find(is_short).expect("one is as short");
        assert_eq!(left, [true, false], "only the left lane leads to the left");
        assert!(straight_on[1], "the right one leads straight on");
        let (length, either) = ways_on(120.0);
        assert!(length > SURE && either == [vec![true; 2], vec![true; 2]], "there is time to change");
    }

    #[test]
    fn the_same_turn_is_not_taken_again() {
        let tracks = tracks(&StreetPlan::grid(3, 3, 100.0));
        let closures = Closures::default();
        let all = (0..tracks.network.roads.len() as u32).map(leg);
        let (from, to, route) = all
            .clone()
            .flat_map(|from| all.clone().map(move |to| (from, to)))
            .find_map(|(from, to)| {
                Some((from, to, closures.quickest(&tracks, from, to)?)).filter(|way| way.2.0.len() > 3)
            })
            .expect("some are far apart");
        let turn = (route.0[1], route.0[2]);
        let other = closures.quickest_but(&tracks, from, to, Some(turn)).expect("a grid has other ways");
        assert!(other.0.windows(2).all(|pair| (pair[0], pair[1]) != turn));
        assert_eq!((other.0[0], other.0.last()), (from, Some(&to)));
    }

    #[test]
    fn who_can_reach_his_goal_by_nothing_leaves_the_map() {
        let mut plan = StreetPlan::grid(2, 2, 100.0);
        let out = plan.add_section(CrossSection::two_way(1, 0));
        let (first, end) = (plan.streets.len() as u32, plan.nodes.len());
        plan.nodes.extend([Point2::new(-100.0, 0.0), Point2::new(-200.0, 0.0)]);
        for (from, to) in [(0, end), (end, end + 1)] {
            plan.streets.push(Street { section: out, ..Street::simple(from, to) });
        }
        let tracks = tracks(&plan);
        assert_eq!(way_off(&tracks, leg(first), leg(0)), Some(Route(vec![leg(first), leg(first + 1)])));
        let round = Leg::new(RoadId(0), LaneDirection::Backward);
        assert_eq!(way_off(&tracks, leg(1), round), None, "from the grid it is reached");
    }
}
