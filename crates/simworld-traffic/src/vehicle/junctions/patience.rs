//! Patience: who stands too long in a lane that does not lead on takes a way that does; if none does, he leaves the map by one that there is.
//! Who stands far too long at his line, whatever for, turns to where there is room. Where a queue takes up side streets all along, little of
//! what moves at its head comes to those at its end, and each at a line keeps all behind him from going elsewhere.

use simworld_core::id::LaneId;

use super::deadlock::is_due;
use crate::vehicle::clock::Moment;
use crate::vehicle::manager::{NONE, Vehicle, VehicleManager};
use crate::vehicle::tracks::leading::way_off;
use crate::vehicle::tracks::{Track, Tracks};
use crate::{Counters, Leg, Route, TrafficConfig};

/// Who stands in a lane that does not lead on for so long looks for another way, s.
pub(in crate::vehicle) const PATIENCE: f64 = 40.0;
/// If a lane beside leads to the end of his route, he leaves the map only after so long, s, and looks for another way once in so many.
const FORBEARANCE: f64 = 10.0 * PATIENCE;
const AGAIN: f64 = 5.0;
/// Who has stood at his line for so long takes another way, s; looked for once in so many.
const FAR_TOO_LONG: f64 = 400.0;
const SELDOM: f64 = 10.0;
/// Nobody makes longer steps, s.
const STEP: f64 = 1.0;

impl VehicleManager {
    /// Those who have stood too long in a lane that does not lead on take a way that does, and their route anew from there.
    pub(in crate::vehicle) fn lose_patience(&mut self, tracks: &Tracks, counters: &mut Counters) {
        let mut stuck = std::mem::take(&mut self.stuck);
        for lane in stuck.drain(..) {
            let Some(stood) = self.queue(tracks, lane).first().map(|first| first.stood) else { continue };
            if (stood - PATIENCE) % AGAIN > STEP {
                continue;
            }
            let mut ways = tracks.network.lanes[lane as usize].outgoing.iter();
            let Some(goal) = self.goal(tracks, lane, 0) else { continue };
            let is_led = ways.clone().any(|way| self.take_way(tracks, lane, 0, way.0))
                || ((stood > FORBEARANCE || !self.is_led_beside(tracks, lane, goal))
                    && ways.any(|way| self.leave_by(tracks, lane, way.0, goal)));
            counters.rerouted += u64::from(is_led);
        }
        self.stuck = stuck;
    }

    /// Those who have stood far too long at their lines take a way that has room, if there is one, and their route anew from there.
    pub(in crate::vehicle) fn turn_off(
        &mut self,
        tracks: &Tracks,
        config: &TrafficConfig,
        at: Moment,
        counters: &mut Counters,
    ) {
        if !is_due(at.step, at.dt, SELDOM) {
            return;
        }
        let mut stuck = std::mem::take(&mut self.stuck);
        let is_stuck = |first: &Vehicle| first.stood > FAR_TOO_LONG && !self.controls.drives(first.id);
        let lanes = self.queues(tracks).filter(|(_, queue)| queue.first().is_some_and(is_stuck));
        stuck.extend(lanes.map(|(lane, _)| lane));
        for lane in stuck.drain(..) {
            counters.rerouted += u64::from(self.turn_elsewhere(tracks, config, lane));
        }
        self.stuck = stuck;
    }

    /// Whether a lane beside leads to a goal: who waits for a gap there may stand beside one who wants to come over as well, who will take
    /// another way and let him in.
    fn is_led_beside(&self, tracks: &Tracks, lane: Track, goal: Leg) -> bool {
        let mut ways = tracks.all_beside(lane).flat_map(|beside| tracks.exits(beside));
        ways.any(|(way, leg)| {
            !self.closures.bars(tracks, *way as usize)
                && self.closures.quickest_but(tracks, *leg, goal, None).is_some()
        })
    }

    /// The last leg of the route of a vehicle of a lane; none if it turns at random.
    pub(in crate::vehicle) fn goal(&self, tracks: &Tracks, lane: Track, rank: usize) -> Option<Leg> {
        let path = self.paths(tracks, lane).get(rank)?;
        self.routes.get(path.route as usize)?.0.last().copied()
    }

    /// Lets a vehicle of a lane take a way from it, and its route anew from there; false if its end cannot be reached so.
    pub(in crate::vehicle) fn take_way(
        &mut self,
        tracks: &Tracks,
        lane: Track,
        rank: usize,
        way: u32,
    ) -> bool {
        if self.closures.bars(tracks, way as usize) {
            return false;
        }
        let mut route = None;
        if let Some(goal) = self.goal(tracks, lane, rank) {
            let after = tracks.lane_after(way as usize);
            let quickest = |avoid| self.closures.quickest_from(tracks, after, goal, avoid);
            // Who came to the wrong lane of a short street would come to it by the same turn again.
            let turn = self.came_by(tracks, lane, rank);
            let Some(rest) = turn.and_then(|turn| quickest(Some(turn))).or_else(|| quickest(None)) else {
                return false;
            };
            route = Some(rest);
        }
        self.go_by(tracks, (lane, rank), way, route);
        true
    }

    /// The leg before the one on which a vehicle of a lane is, with that.
    fn came_by(&self, tracks: &Tracks, lane: Track, rank: usize) -> Option<(Leg, Leg)> {
        let path = self.paths(tracks, lane).get(rank)?;
        let legs = &self.routes.get(path.route as usize)?.0;
        Some((*legs.get((path.leg as usize).checked_sub(1)?)?, *legs.get(path.leg as usize)?))
    }

    /// Lets the first of a lane take a way from which its goal is reached by nothing, and leave where that ends, without having
    /// arrived. What is closed is no matter: it may be opened.
    fn leave_by(&mut self, tracks: &Tracks, lane: Track, way: u32, goal: Leg) -> bool {
        if self.closures.bars(tracks, way as usize) {
            return false;
        }
        let after = Leg::of(&tracks.network, LaneId(tracks.lane_after(way as usize)));
        let Some(off) = way_off(tracks, after, goal) else { return false };
        self.go_by(tracks, (lane, 0), way, Some(off));
        let route = self.paths(tracks, lane)[0].route;
        if self.off.last() != Some(&route) {
            self.off.push(route);
        }
        true
    }

    /// Sends a vehicle of a lane by a way from it, and on by a route from there.
    fn go_by(&mut self, tracks: &Tracks, (lane, rank): (Track, usize), way: u32, route: Option<Route>) {
        let before = self.paths(tracks, lane)[rank].route;
        let route = route.map(|mut rest| {
            rest.0.insert(0, Leg::of(&tracks.network, LaneId(lane)));
            self.add_route_for(before, rest)
        });
        let (queue, paths) = self.both_mut(tracks, lane);
        queue[rank].next = way;
        if let Some(route) = route {
            (paths[rank].route, paths[rank].leg) = (route, 0);
        }
    }
}

impl Vehicle {
    /// Whether, first in its lane, it has waited long enough for a gap to a lane that leads on.
    pub(super) fn is_stuck(&self) -> bool {
        self.next == NONE && self.stood >= PATIENCE && self.shift == 0.0 && self.halt.is_infinite()
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use simworld_core::geometry::Point2;
    use simworld_core::id::RoadId;
    use simworld_core::net::{
        Alone, CrossSection, LaneDirection, NetworkConfig, RoadNetwork, Street, StreetPlan,
    };
    use simworld_core::seed::Seed;

    use super::*;
    use crate::vehicle::clock::Moment;
    use crate::vehicle::manager::EXIT;
    use crate::vehicle::queues::path::Path;
    use crate::vehicle::scene::Sight;
    use crate::{TrafficConfig, TripEnd};

    fn leg(road: u32) -> Leg {
        Leg::new(RoadId(road), LaneDirection::Forward)
    }

    /// A square of streets, and behind it two of one way that lead off the map, of which the first has this number.
    fn with_a_way_off() -> (Tracks, TrafficConfig, u32) {
        let mut plan = StreetPlan::grid(2, 2, 100.0);
        let out = plan.add_section(CrossSection::two_way(1, 0));
        let (first, end) = (plan.streets.len() as u32, plan.nodes.len());
        plan.nodes.extend([Point2::new(-100.0, 0.0), Point2::new(-200.0, 0.0)]);
        for (from, to) in [(0, end), (end, end + 1)] {
            plan.streets.push(Street { section: out, ..Street::simple(from, to) });
        }
        let network = RoadNetwork::derive(&plan, &NetworkConfig::default()).expect("it is a plan");
        let config = TrafficConfig::default();
        (Tracks::new(Arc::new(network), &config), config, first)
    }

    /// How the trip of a car ends that comes to the first street off the map, and the counts; its goal is behind it or at the end of that.
    fn end_of(is_lost: bool) -> (Option<TripEnd>, Counters) {
        let (tracks, config, first) = with_a_way_off();
        let mut vehicles = VehicleManager::new(&tracks);
        let lane = tracks.network.roads[first as usize].forward[0];
        let route = vehicles.add_route(Route(vec![leg(first), leg(first + 1)]));
        let car = Vehicle::new(config.vehicle_type(0), 0, 1.0, 0, 50.0);
        vehicles.whereabouts.push(lane.0);
        vehicles.storage.add(lane.0, &car, &config);
        vehicles.push(&tracks, lane.0, car, Path::new(lane.0, route, 0.0, 0.0));
        let way = tracks.network.lanes[lane.index()].outgoing[0];
        vehicles.go_by(&tracks, (lane.0, 0), way.0, None);
        if is_lost {
            assert!(vehicles.leave_by(&tracks, lane.0, way.0, leg(0)), "nothing leads back");
        }
        let zeros = vec![0; tracks.network.crossings.len()];
        let sight = Sight { aspects: &[], shown: &[], walkers: &zeros, waiting: &zeros, obstacles: &[] };
        let mut counters = Counters::default();
        for step in 0..600 {
            let at = Moment { now: step as f64 * 0.1, dt: 0.1, step };
            vehicles.step(&tracks, &config, Seed(1).stream("cars"), sight, at, &mut counters, &Alone);
            if let [trip] = vehicles.ended[..] {
                return (Some(trip.end), counters);
            }
        }
        (None, counters)
    }

    #[test]
    fn who_leaves_the_map_for_want_of_a_way_has_not_arrived() {
        let (end, counters) = end_of(true);
        assert_eq!((end, counters.arrived, counters.removed), (Some(TripEnd::NoWay), 0, 1));
        let (end, counters) = end_of(false);
        assert_eq!((end, counters.arrived, counters.removed), (Some(TripEnd::Arrived), 1, 0));
    }

    /// A street of two lanes at whose end the left one leads to the left alone and the right one to the right; both ways lead to one street in
    /// the end. Streets by number: the first, to the left and on, to the right and on, and the last.
    fn fork() -> (Tracks, TrafficConfig) {
        let nodes = [[0.0, 0.0], [120.0, 0.0], [120.0, 100.0], [120.0, -100.0], [240.0, 0.0], [340.0, 0.0]];
        let mut plan = StreetPlan::default();
        plan.nodes.extend(nodes.map(|[x, y]| Point2::new(x, y)));
        let [one, two] = [1, 2].map(|lanes| plan.add_section(CrossSection::two_way(lanes, 0)));
        for (from, to, section) in
            [(0, 1, two), (1, 2, one), (2, 4, one), (1, 3, one), (3, 4, one), (4, 5, one)]
        {
            plan.streets.push(Street { section, ..Street::simple(from, to) });
        }
        let without_lights = NetworkConfig { signals_from_roads: 0, ..NetworkConfig::default() };
        let network = RoadNetwork::derive(&plan, &without_lights).expect("it is a plan");
        let config = TrafficConfig::default();
        (Tracks::new(Arc::new(network), &config), config)
    }

    #[test]
    fn who_stands_beside_one_who_wants_to_come_over_as_well_does_not_leave_the_map() {
        let (tracks, config) = fork();
        let mut vehicles = VehicleManager::new(&tracks);
        let lanes = &tracks.network.roads[0].forward;
        let leads_to = |road: u32| {
            let leads = |lane: &&LaneId| tracks.exits(lane.0).iter().all(|(_, to)| *to == leg(road));
            lanes.iter().find(leads).expect("each lane leads to one side").0
        };
        // To the street on the right, from which no way leads back, in the left lane; and beside him to the last one by the left, in the right
        // lane.
        let places = [(leads_to(1), vec![leg(0), leg(3)]), (leads_to(3), [0, 1, 2, 5].map(leg).to_vec())];
        for (id, (lane, route)) in places.into_iter().enumerate() {
            let route = vehicles.add_route(Route(route));
            let s = tracks.length[lane as usize] - 18.4;
            let car = Vehicle::new(config.vehicle_type(0), 0, 1.0, id as u32, s);
            vehicles.whereabouts.push(lane);
            vehicles.storage.add(lane, &car, &config);
            vehicles.push(&tracks, lane, car, Path::new(lane, route, 0.0, 0.0));
        }
        let zeros = vec![0; tracks.network.crossings.len()];
        let sight = Sight { aspects: &[], shown: &[], walkers: &zeros, waiting: &zeros, obstacles: &[] };
        let mut counters = Counters::default();
        for step in 0..1800 {
            let at = Moment { now: step as f64 * 0.1, dt: 0.1, step };
            vehicles.step(&tracks, &config, Seed(1).stream("cars"), sight, at, &mut counters, &Alone);
        }
        assert_eq!((counters.arrived, counters.removed), (2, 0), "{counters:?}");
        assert_eq!(counters.rerouted, 1, "the other takes another way and lets him in");
    }

    /// The way that the first of a lane wants after he has stood for so long, and the one that he wanted.
    fn turns_off(stood: f64, is_full: bool) -> (u32, u32) {
        let network = RoadNetwork::derive(&StreetPlan::grid(3, 3, 100.0), &NetworkConfig::default());
        let config = TrafficConfig::default();
        let tracks = Tracks::new(Arc::new(network.expect("it is a plan")), &config);
        let mut vehicles = VehicleManager::new(&tracks);
        let two = |lane: &Track| tracks.exits(*lane).len() == 2;
        let lane = (0..tracks.lanes as Track).find(two).expect("at a corner of the middle one may choose");
        let mut put = |lane: Track, s: f64, stood: f64, next: u32| {
            let id = vehicles.numbers() as u32;
            let car = Vehicle { stood, next, ..Vehicle::new(config.vehicle_type(0), 0, 1.0, id, s) };
            vehicles.whereabouts.push(lane);
            vehicles.storage.add(lane, &car, &config);
            vehicles.push(&tracks, lane, car, Path::new(lane, NONE, 0.0, 0.0));
        };
        let [wanted, other] = [0, 1].map(|index| tracks.exits(lane)[index].0);
        put(lane, tracks.length[lane as usize] - 0.5, stood, wanted);
        if is_full {
            let length = config.vehicle_type(0).length;
            let after = tracks.lane_after(other as usize);
            let places = (tracks.length[after as usize] / (length + 2.0)) as usize;
            for place in 0..places {
                put(after, tracks.length[after as usize] - 1.0 - (length + 1.9) * place as f64, 5.0, EXIT);
            }
        }
        let mut counters = Counters::default();
        let at = Moment { now: 9.9, dt: 0.1, step: 99 };
        vehicles.turn_off(&tracks, &config, at, &mut counters);
        let next = vehicles.queue(&tracks, lane)[0].next;
        assert_eq!(counters.rerouted, u64::from(next != wanted));
        (next, wanted)
    }

    #[test]
    fn who_stands_far_too_long_at_his_line_turns_to_where_there_is_room() {
        let (next, wanted) = turns_off(FAR_TOO_LONG - 1.0, false);
        assert_eq!(next, wanted, "not yet");
        let (next, wanted) = turns_off(FAR_TOO_LONG + 1.0, false);
        assert_ne!(next, wanted);
        let (next, wanted) = turns_off(FAR_TOO_LONG + 1.0, true);
        assert_eq!(next, wanted, "there is no room elsewhere");
    }

    #[test]
    fn a_route_in_the_place_of_one_off_the_map_leads_off_it_too() {
        let (tracks, _, first) = with_a_way_off();
        let mut vehicles = VehicleManager::new(&tracks);
        let route = || Route(vec![leg(first), leg(first + 1)]);
        let own = vehicles.add_route(route());
        let lost = vehicles.add_route_for(own, route());
        vehicles.off.push(lost);
        let again = vehicles.add_route_for(1, route());
        assert_eq!((own, vehicles.off), (0, vec![1, again]));
    }
}
