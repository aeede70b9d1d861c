//! Closed roads, closed lanes and blocked stretches: nobody enters them, nobody is lost, and traffic goes around.

use std::collections::BTreeMap;
use std::sync::Arc;

use proptest::prelude::*;
use simworld_core::id::{LaneId, RoadId};
use simworld_core::net::{CrossSection, LaneDirection, NetworkConfig, RoadNetwork, StreetPlan};
use simworld_core::seed::Seed;
use simworld_traffic::vehicle::VehicleKind;
use simworld_traffic::{Closed, Closure, Flow, Leg, NoWay, Route, Router, Traffic, TrafficConfig, TripEnd};

use crate::contacts::assert_apart;

fn grid(columns: usize, lanes: u8) -> Arc<RoadNetwork> {
    let mut plan = StreetPlan::grid(columns, columns, 150.0);
    plan.sections = vec![CrossSection::two_way(lanes, lanes)];
    Arc::new(RoadNetwork::derive(&plan, &NetworkConfig::default()).unwrap())
}

fn config(vehicles: u32, no_way: NoWay) -> TrafficConfig {
    TrafficConfig { vehicles, pedestrians: 0, no_way, ..TrafficConfig::default() }
}

fn legs(network: &RoadNetwork) -> Vec<Leg> {
    (0..network.roads.len() as u32)
        .flat_map(|road| [LaneDirection::Forward, LaneDirection::Backward].map(|d| Leg::new(RoadId(road), d)))
        .collect()
}

#[test]
fn trips_go_around_a_closed_road() {
    let network = grid(3, 1);
    let router = Router::new(&network);
    let all = legs(&network);
    // The longest of the quickest routes, so that there is a middle to close.
    let routes = all.iter().flat_map(|a| all.iter().filter_map(|b| router.quickest(*a, *b)));
    let route: Route = routes.max_by_key(|route| route.0.len()).unwrap();
    let closed = route.0[route.0.len() / 2];
    let mut traffic = Traffic::new(Arc::clone(&network), &config(0, NoWay::Wait), Seed(1)).unwrap();
    for _ in 0..10 {
        traffic.insert(route.clone(), VehicleKind::Car).unwrap();
    }
    // They are under way when it is closed.
    (0..100).for_each(|_| traffic.step(0.1));
    let under_way = traffic.vehicles().count() as u64;
    assert!(under_way > 1 && under_way < 10);
    traffic.close(Closure::new(Closed::Leg(closed))).unwrap();
    for step in 0..6000 {
        traffic.step(0.1);
        let is_there =
            |track: u32| (track as usize) < network.lanes.len() && Leg::of(&network, LaneId(track)) == closed;
        assert!(traffic.stations().all(|at| !is_there(at.1)), "somebody is on the closed road at {step}");
    }
    let counters = traffic.counters();
    assert_eq!((counters.arrived, counters.entered), (10, 10), "{counters:?}");
    // The others entered on a route around it.
    assert_eq!(counters.rerouted, under_way, "{counters:?}");
}

#[test]
fn who_turns_at_random_does_not_turn_there() {
    let network = grid(3, 1);
    let mut traffic = Traffic::new(Arc::clone(&network), &config(30, NoWay::Wait), Seed(1)).unwrap();
    let closed = Leg::new(RoadId(3), LaneDirection::Forward);
    let number = traffic.close(Closure { until: 300.0, ..Closure::new(Closed::Leg(closed)) }).unwrap();
    assert_eq!(traffic.closures().count(), 1);
    let on_it = |traffic: &Traffic| {
        let lanes = closed.lanes(&network);
        traffic.stations().filter(|at| lanes.iter().any(|lane| lane.0 == at.1)).count()
    };
    let mut entered_again = false;
    for step in 0..9000 {
        traffic.step(0.1);
        // Those who were on it or had leave to enter it are gone by then.
        assert!(!(1200..3000).contains(&step) || on_it(&traffic) == 0, "step {step}");
        entered_again |= step > 3000 && on_it(&traffic) > 0;
    }
    assert!(entered_again, "it is open again");
    assert!(!traffic.reopen(number), "it is over");
}

/// A street of two crossroads, the way out of which is closed.
#[test]
fn who_finds_no_way_waits_or_leaves_and_says_so() {
    for no_way in [NoWay::Wait, NoWay::Leave] {
        let network =
            Arc::new(RoadNetwork::derive(&StreetPlan::crossroads(120.0), &NetworkConfig::default()).unwrap());
        let into = Leg::new(RoadId(0), LaneDirection::Backward);
        let out = Leg::new(RoadId(2), LaneDirection::Forward);
        let mut traffic = Traffic::new(network, &config(0, no_way), Seed(1)).unwrap();
        for _ in 0..5 {
            traffic.insert(Route(vec![into, out]), VehicleKind::Car).unwrap();
        }
        (0..40).for_each(|_| traffic.step(0.1));
        let under_way = traffic.vehicles().count();
        assert!(under_way > 0 && under_way < 5);
        let number = traffic.close(Closure::new(Closed::Leg(out))).unwrap();
        let mut ends = BTreeMap::new();
        for _ in 0..2000 {
            traffic.step(0.1);
            for trip in traffic.ended() {
                *ends.entry(format!("{:?}", trip.end)).or_insert(0) += 1;
            }
        }
        // Who has not entered yet waits outside.
        assert_eq!(traffic.outside(), 5 - under_way);
        let stay = if no_way == NoWay::Wait { under_way } else { 0 };
        assert_eq!(traffic.vehicles().count(), stay);
        assert_eq!(ends.get("NoWay").copied().unwrap_or(0), under_way - stay, "{ends:?}");
        assert!(traffic.reopen(number));
        (0..2000).for_each(|_| traffic.step(0.1));
        assert_eq!(traffic.counters().arrived as usize, 5 - (under_way - stay));
    }
}

#[test]
fn a_blocked_stretch_is_passed_on_the_lane_beside() {
    let network = grid(2, 2);
    let mut traffic = Traffic::new(Arc::clone(&network), &config(0, NoWay::Wait), Seed(1)).unwrap();
    let road = &network.roads[0];
    let lane = road.forward[1];
    let length = network.lanes[lane.index()].length;
    traffic.close(Closure::new(Closed::Stretch(lane, length * 0.5, length * 0.5 + 12.0))).unwrap();
    let route = Route(vec![Leg::new(RoadId(0), LaneDirection::Forward)]);
    traffic.add_flow(Flow { until: 600.0, ..Flow::new(route, 500.0) }).unwrap();
    for step in 0..9000 {
        traffic.step(0.1);
        assert_apart(&traffic, step);
        for (id, track, s, _) in traffic.stations().filter(|at| at.1 == lane.0) {
            let rear = s - traffic.vehicles().find(|body| body.id == id).unwrap().shape.size().x;
            assert!(
                s < length * 0.5 || rear > length * 0.5 + 12.0,
                "{id} is in the works on {track} at {step}"
            );
        }
    }
    let counters = traffic.counters();
    let left: Vec<_> = traffic.stations().collect();
    assert!(counters.arrived > 60 && left.is_empty(), "{counters:?} {length} {left:?}");
}

#[test]
fn what_cannot_be_closed_is_refused() {
    let mut traffic = Traffic::new(grid(2, 1), &config(0, NoWay::Wait), Seed(1)).unwrap();
    for what in [
        Closed::Leg(Leg::new(RoadId(99), LaneDirection::Forward)),
        Closed::Lane(LaneId(9999)),
        Closed::Stretch(LaneId(0), 5.0, 4.0),
        Closed::Stretch(LaneId(0), 5.0, f64::NAN),
    ] {
        assert!(traffic.close(Closure::new(what)).is_err(), "{what:?}");
    }
    assert!(traffic.close(Closure { from: f64::NAN, ..Closure::new(Closed::Lane(LaneId(0))) }).is_err());
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(12))]

    #[test]
    fn nobody_is_lost_whatever_is_closed(
        closures in prop::collection::vec((any::<prop::sample::Index>(), 0..3, 0.0..120.0_f64, 1.0..200.0_f64), 1..14),
        leave in any::<bool>(),
        seed in 0..100_u64,
    ) {
        let network = grid(3, 2);
        let no_way = if leave { NoWay::Leave } else { NoWay::Wait };
        let mut traffic = Traffic::new(Arc::clone(&network), &config(30, no_way), Seed(seed)).unwrap();
        let placed = u64::from(traffic.placed().vehicles);
        for (index, what, from, lasts) in closures {
            let lane = LaneId(index.index(network.lanes.len()) as u32);
            let what = match what {
                0 => Closed::Lane(lane),
                1 => Closed::Stretch(lane, 30.0, 50.0),
                _ => Closed::Leg(Leg::of(&network, lane)),
            };
            traffic.close(Closure { what, from, until: from + lasts }).unwrap();
        }
        let router = Router::new(&network);
        let all = legs(&network);
        for (index, from) in all.iter().enumerate().step_by(3) {
            if let Some(route) = router.quickest(*from, all[(index * 5 + 11) % all.len()]) {
                traffic.add_flow(Flow { until: 200.0, ..Flow::new(route, 60.0) }).unwrap();
            }
        }
        let (mut arrived, mut without_way) = (0, 0);
        for step in 0..3000 {
            traffic.step(0.1);
            for trip in traffic.ended() {
                arrived += u64::from(trip.end == TripEnd::Arrived);
                without_way += u64::from(trip.end == TripEnd::NoWay);
            }
            let counters = traffic.counters();
            let present = traffic.vehicles().count() as u64;
            prop_assert_eq!(placed + counters.entered, present + counters.arrived + counters.removed);
            prop_assert_eq!((arrived, without_way), (counters.arrived, counters.removed));
            if step % 10 == 0 {
                assert_apart(&traffic, step);
            }
        }
        prop_assert!(leave || without_way == 0);
        prop_assert_eq!(traffic.counters().forced_stops, 0);
    }
}
