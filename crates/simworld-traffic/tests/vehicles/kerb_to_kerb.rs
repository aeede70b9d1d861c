//! Trips that begin and end in parking places: who departs waits for a gap and pulls out, who parks pulls in.

use std::collections::BTreeMap;
use std::sync::Arc;

use simworld_core::geometry::planar;
use simworld_core::id::LaneId;
use simworld_core::net::{CrossSection, DrivingSide, NetworkConfig, RoadNetwork, StreetPlan, polyline};
use simworld_core::seed::Seed;
use simworld_traffic::vehicle::VehicleKind;
use simworld_traffic::{
    Activity, ActivityChains, Kerbs, Leg, Person, Route, Router, Traffic, TrafficConfig, TrafficError,
    TripEnd,
};

fn town(section: CrossSection, side: DrivingSide) -> Arc<RoadNetwork> {
    let mut plan = StreetPlan { driving_side: side, ..StreetPlan::grid(4, 4, 150.0) };
    plan.sections = vec![section];
    if side == DrivingSide::Left {
        plan.sections[0].lanes.reverse();
    }
    Arc::new(RoadNetwork::derive(&plan, &NetworkConfig::default()).expect("a grid is a network"))
}

fn legs(network: &RoadNetwork) -> Vec<Leg> {
    let mut legs: Vec<Leg> =
        (0..network.lanes.len()).map(|lane| Leg::of(network, LaneId::from_index(lane))).collect();
    legs.sort_unstable();
    legs.dedup();
    legs
}

fn traffic(network: Arc<RoadNetwork>, vehicles: u32) -> Traffic {
    let config = TrafficConfig { vehicles, pedestrians: 60, ..TrafficConfig::default() };
    Traffic::new(network, &config, Seed(8)).expect("the settings are in range")
}

/// How far a vehicle is from the middle of the outermost lane of its leg, m.
fn beside(traffic: &Traffic, id: u32, leg: Leg) -> f64 {
    let network = traffic.network();
    let lane = leg.lanes(network).last().expect("a leg has lanes");
    let body = traffic.vehicle(id).expect("it is there");
    polyline::closest(&network.lanes[lane.index()].path, &planar(&body.pose))
        .expect("a lane has a path")
        .distance
}

/// Sends cars from kerb to kerb through a busy town, and sees to it that all of them come to park and touch nobody.
fn drive_from_kerb_to_kerb(section: CrossSection, side: DrivingSide, aside: f64) {
    let network = town(section, side);
    let (router, legs) = (Router::new(&network), legs(&network));
    let mut traffic = traffic(network, 60);
    let mut ways = BTreeMap::new();
    for index in 0..40 {
        let (from, to) = (legs[index % legs.len()], legs[(index * 7 + 11) % legs.len()]);
        let Some(route) = router.quickest(from, to).filter(|route| route.0.len() > 1) else { continue };
        let kerbs = Kerbs { from: Some(40.0 + index as f64), to: Some(90.0) };
        let number =
            traffic.insert_between(route, VehicleKind::Car.into(), 0.0, kerbs).expect("places are sound");
        ways.insert(number, (from, to));
    }
    let (sent, mut driving, mut parked, mut last) = (ways.len(), BTreeMap::new(), 0, BTreeMap::new());
    for _ in 0..9_000 {
        for id in driving.keys() {
            last.insert(*id, beside(&traffic, *id, driving[id]));
        }
        crate::watching::drive(&mut traffic, 1, |_| false);
        let admitted: Vec<(u32, Option<u64>)> = traffic.admitted().collect();
        for (id, number) in admitted {
            let (from, to) = ways[&number.expect("nobody else enters")];
            // It is still in its place, or nearly so.
            let off = beside(&traffic, id, from);
            assert!((off - aside).abs() < 0.1, "{off} m aside");
            driving.insert(id, to);
        }
        for trip in traffic.ended() {
            assert_eq!(trip.end, TripEnd::Parked, "{trip:?}");
            driving.remove(&trip.id).expect("only those end who were sent");
            let off = last[&trip.id];
            assert!((off - aside).abs() < 0.2, "it parked {off} m aside");
            assert!(trip.distance > 100.0 && trip.left > trip.entered + 18.0, "{trip:?}");
            parked += 1;
        }
        if parked == sent {
            break;
        }
    }
    let counters = traffic.counters();
    assert_eq!((parked, traffic.outside()), (sent, 0), "{counters:?}");
    assert_eq!((counters.forced_stops, counters.dilemmas), (0, 0), "{counters:?}");
    assert_eq!((counters.entered, counters.removed), (sent as u64, sent as u64), "{counters:?}");
}

#[test]
fn cars_pull_out_of_parking_strips_and_into_them() {
    // Half the lane of 3.25 m and half the strip of 2.2 m.
    let section = CrossSection::two_way(1, 1);
    let lane = section.lanes.iter().find(|lane| lane.kind.is_driven()).expect("it has lanes").width;
    drive_from_kerb_to_kerb(section.clone().with_parking(2.2), DrivingSide::Right, (lane + 2.2) * 0.5);
    drive_from_kerb_to_kerb(section.with_parking(2.2), DrivingSide::Left, (lane + 2.2) * 0.5);
}

/// Who departs close before a junction, in a lane that does not lead on, gets out of the way of others all the same.
#[test]
fn on_broad_streets_nobody_is_stuck_between_two_lanes() {
    let network = town(CrossSection::two_way(3, 3).with_parking(2.2), DrivingSide::Right);
    let (router, legs) = (Router::new(&network), legs(&network));
    let mut traffic = traffic(network, 200);
    for index in 0..60 {
        let (from, to) = (legs[(index * 5 + 2) % legs.len()], legs[(index * 7 + 11) % legs.len()]);
        let Some(route) = router.quickest(from, to).filter(|route| route.0.len() > 1) else { continue };
        let kerbs = Kerbs { from: Some(30.0 + index as f64), to: None };
        traffic.insert_between(route, VehicleKind::Car.into(), 0.0, kerbs).expect("places are sound");
    }
    // Who does not come into the lane of its turn is sent another way, and is the last to arrive.
    let counters = crate::watching::drive(&mut traffic, 7000, |_| false);
    assert_eq!((counters.forced_stops, traffic.outside()), (0, 0), "{counters:?}");
    // As in any busy town hardly anybody stands for three minutes: of those stuck, and all behind them, it would be most.
    assert!(counters.long_waits < 20, "{counters:?}");
    assert_eq!(counters.arrived, counters.entered, "{counters:?}");
}

#[test]
fn where_there_is_no_strip_they_stop_in_the_lane() {
    drive_from_kerb_to_kerb(CrossSection::two_way(2, 2), DrivingSide::Right, 0.0);
}

/// On a street with hardly a gap nobody brakes hard for who departs, and who departs waits for a gap.
#[test]
fn who_departs_makes_nobody_brake_hard() {
    let network = town(CrossSection::two_way(1, 1).with_parking(2.2), DrivingSide::Right);
    let (legs, router) = (legs(&network), Router::new(&network));
    let along = legs
        .iter()
        .flat_map(|from| legs.iter().map(move |to| (*from, *to)))
        .find_map(|(from, to)| router.quickest(from, to).filter(|route| route.0.len() == 3))
        .expect("some way has three legs");
    let mut traffic = traffic(network, 0);
    traffic.add_flow(simworld_traffic::Flow::new(along.clone(), 500.0)).expect("it can be driven");
    (0..1200).for_each(|_| traffic.step(0.1));
    let (mut before, mut hardest, mut entered) = (BTreeMap::new(), 0.0_f64, Vec::<f64>::new());
    let mut waited = Vec::new();
    for step in 0..4000_u32 {
        if step % 150 == 0 && step < 3000 {
            let kerbs = Kerbs { from: Some(30.0 + f64::from(step % 11) * 6.0), to: None };
            let now = traffic.seconds();
            traffic
                .insert_between(along.clone(), VehicleKind::Car.into(), now, kerbs)
                .expect("it is a place");
            entered.push(now);
        }
        traffic.step(0.1);
        for number in traffic.admitted().filter_map(|(_, number)| number) {
            waited.push(traffic.seconds() - entered[number as usize]);
        }
        let now: BTreeMap<u32, (u32, f64)> =
            traffic.stations().map(|(id, track, _, v)| (id, (track, v))).collect();
        for (id, (track, v)) in &now {
            let same = before.get(id).filter(|(old, _): &&(u32, f64)| old == track);
            // On the first leg, but not before its junction.
            if let Some((_, old)) = same.filter(|_| along.0[0].lanes(traffic.network())[0].0 == *track) {
                hardest = hardest.max((old - v) / 0.1);
            }
        }
        before = now;
    }
    assert_eq!((waited.len(), traffic.outside()), (20, 0));
    let delayed = waited.iter().filter(|waited| **waited > 1.0).count();
    assert!(delayed >= 3, "some had to wait for a gap: {waited:?}");
    assert!(hardest < 4.0, "somebody braked at {hardest} m/s²");
}

#[test]
fn places_that_are_none_are_refused() {
    let network = town(CrossSection::two_way(1, 1).with_parking(2.2), DrivingSide::Right);
    let legs = legs(&network);
    let mut traffic = traffic(network, 0);
    let mut send = |from: Option<f64>, to: Option<f64>| {
        traffic.insert_between(Route(vec![legs[0]]), VehicleKind::Car.into(), 0.0, Kerbs { from, to })
    };
    for bad in [2.0, -5.0, f64::NAN, f64::INFINITY, 140.0, 1e9] {
        assert!(matches!(send(Some(bad), None), Err(TrafficError::Kerb { .. })), "{bad}");
        assert!(matches!(send(None, Some(bad)), Err(TrafficError::Kerb { .. })), "{bad}");
    }
    assert!(matches!(send(Some(60.0), Some(50.0)), Err(TrafficError::Kerb { .. })));
    assert!(send(Some(50.0), Some(80.0)).is_ok());
}

#[test]
fn days_begin_and_end_in_parking_places() {
    let network = town(CrossSection::two_way(1, 1).with_parking(2.2), DrivingSide::Right);
    let (legs, router) = (legs(&network), Router::new(&network));
    let mut traffic = traffic(network, 30);
    let stay = |leg: usize, parking, duration, until| Activity {
        parking: Some(parking),
        ..Activity::new(legs[leg], duration, until)
    };
    let people = (0..12).map(|index| Person {
        name: format!("p{index}"),
        vehicle: VehicleKind::Car.into(),
        chain: vec![
            stay(index, 50.0, 0.0, 5.0 * index as f64),
            stay(index + 20, 70.0, 60.0, 0.0),
            stay(index, 50.0, 0.0, 0.0),
        ],
    });
    let mut chains = ActivityChains::new(people.collect());
    for _ in 0..12_000 {
        chains.feed(&mut traffic, |from, to| router.quickest(from, to)).expect("places are sound");
        crate::watching::drive(&mut traffic, 1, |_| false);
        chains.follow(&traffic, None);
    }
    assert_eq!(chains.stranded(), 0);
    let home = (0..12).filter(|person| chains.stay_of(*person) == Some(2)).count();
    assert_eq!(home, 12, "{:?}", traffic.counters());
}
